/* json_claims.h -- members of results.json beside its rows. */
#ifndef REPORT_JSON_CLAIMS_H
#define REPORT_JSON_CLAIMS_H

#include "report/report.h"

#include "common/json.h"

/* The member "claims": an empty array where the report has no ledger. */
void json_claims(struct json *j, const struct report *r);

/* The members "limits" (what no check can see), "unselected" (cases that nobody asked for) and
 * "agreement" (bias and scatter of all checks; null where there is none). */
void json_limits(struct json *j, const struct report *r);
void json_agreement(struct json *j, const struct report *r);

#endif
