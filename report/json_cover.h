/* json_cover.h -- what results.json says of the whole; only json_report.c includes this. */
#ifndef REPORT_JSON_COVER_H
#define REPORT_JSON_COVER_H

#include "report/report.h"

#include "common/json.h"

/* The members "limits" (what no check can see) and "unselected" (cases that nobody asked for). */
void json_cover_limits(struct json *j, const struct report *r);

/* The member "agreement": bias and scatter of all checks; null where there is none. */
void json_cover_agreement(struct json *j, const struct report *r);

#endif
