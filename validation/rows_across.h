/* rows_across.h -- fits over a sweep, for rows.c.
 *
 * A group is all points that an across observable takes and that differ in the
 * parameter it goes along, and in nothing else; for a fit over seeds it is one point.
 */
#ifndef VALIDATION_ROWS_ACROSS_H
#define VALIDATION_ROWS_ACROSS_H

#include "validation/measure.h"

struct rows_group {
    const char *name; /* "darcy=published", or "single" */
    double value, uncertainty, expected, expected_uncertainty;
    const char *reason; /* why one of them is NaN, or NULL */
};

/* Is point q in the group of point p? */
bool rows_group_has(const struct measured_case *m, const struct case_across *a, size_t p, size_t q);
/* Is point p the first one of its group? */
bool rows_group_first(const struct measured_case *m, const struct case_across *a, size_t p);

/* Fit the group of point `first` for the check of that index. */
enum status rows_group_fit(const struct measured_case *m, size_t check, size_t first,
                           struct arena *arena, struct rows_group *out, struct fault *fault);

#endif
