/* rows.h -- the judged rows of a case: one a check and point, one a failed run.
 *
 * Point checks are judged from their seeds, across checks from a fit over each
 * group of points that differ in one swept parameter alone.  A run that failed
 * or gave unusable data is a failed row of kind "run" at each point it serves,
 * and its missing value leaves the checks there inconclusive.
 */
#ifndef VALIDATION_ROWS_H
#define VALIDATION_ROWS_H

#include "report/report.h"
#include "validation/budget.h"
#include "validation/execute.h"
#include "validation/measure.h"
#include "validation/unchanged.h"

struct rows {
    struct arena arena;
    size_t count;
    struct report_row *row;              /* row[0 .. count-1] */
    const struct measured_point **point; /* point[i]: NULL for fits over a sweep and run rows */
    const struct case_check **check;     /* check[i]: NULL for run rows */
    struct unchanged_count bits;         /* of all runs of the case */
};

/* `o` serves the commands that repeat a run; m must outlive the rows.  Without a budget there are
 * no references, and what needs one is inconclusive. */
enum status rows_judge(const struct measured_case *m, const struct execute_options *o,
                       const struct budget *budget, struct rows **out, struct fault *fault);
void rows_free(struct rows *r); /* NULL is allowed */

#endif
