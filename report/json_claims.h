/* json_claims.h -- the papers' claims in results.json; only json_report.c includes this. */
#ifndef REPORT_JSON_CLAIMS_H
#define REPORT_JSON_CLAIMS_H

#include "report/report.h"

#include "common/json.h"

/* The member "claims": an empty array where the report has no ledger. */
void json_claims(struct json *j, const struct report *r);

#endif
