/* across.h -- observables of a whole sweep: orders of accuracy, extrapolations, slopes.
 *
 * Given one scalar observable at several values of one swept parameter (all
 * other parameters equal), an across recipe fits it (GSL) and gives numbers
 * with standard uncertainties.  One constant struct and one line in across.c.
 */
#ifndef VALIDATION_ACROSS_H
#define VALIDATION_ACROSS_H

#include "common/fault.h"

#include <stddef.h>

enum { ACROSS_MAX_OUTPUTS = 4 };

struct across_point {
    double x;           /* the swept parameter */
    double y;           /* mean over seeds */
    double uncertainty; /* standard uncertainty of y; 0 when it is exact, NaN when unknown */
};

struct across {
    const char *name, *title, *source;
    size_t min_points;
    const char *const output[ACROSS_MAX_OUTPUTS]; /* names, NULL-terminated: {"order"} */
    /* value[i], uncertainty[i] for each output. point[] is sorted by x. */
    enum status (*fit)(const struct across_point *point, size_t count, double *value,
                       double *uncertainty, struct fault *fault);
};

const struct across *across_find(const char *name);
const struct across *const *across_all(size_t *count);

#endif
