/* json_claims.h -- the papers' claims in results.json; only json_report.c includes this. */
#ifndef REPORT_JSON_CLAIMS_H
#define REPORT_JSON_CLAIMS_H

#include "common/json.h"
#include "report/report.h"

/* The member "claims" of the object that is being written; empty where there is no ledger. */
void json_claims(struct json *j, const struct report *r);

#endif
