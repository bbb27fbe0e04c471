/* prediction.h -- what theory says: a number for given inputs, with its source.
 *
 * One constant struct in predict_TOPIC.c and one line in predictions.c.  The
 * figure draws the same function that the check used.  Inputs are named; a case
 * binds each to an observable ("settling.solid_fraction"), to a number, or, by
 * default, to the run's parameter of that name.
 */
#ifndef VALIDATION_PREDICTION_H
#define VALIDATION_PREDICTION_H

#include "common/fault.h"

#include <stddef.h>

enum { PREDICTION_MAX_INPUTS = 24 };

struct prediction {
    const char *name, *title, *unit;
    const char *source;                             /* paper and equation */
    const char *const input[PREDICTION_MAX_INPUTS]; /* NULL-terminated */
    /* input[i] in the order of `input`; choices come as their index is not known
     * here: name the choice in the prediction ("settling-law-published"). */
    double (*at)(const double *input);
};

const struct prediction *prediction_find(const char *name);
const struct prediction *const *prediction_all(size_t *count);

#endif
