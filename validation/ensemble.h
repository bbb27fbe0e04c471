/* ensemble.h -- fits that see all seeds of a point at once.
 *
 * Some numbers cannot be had run by run: a rate fitted to the mean of many noisy
 * curves is not the mean of rates fitted to each.  An ensemble fit is given the
 * measurements, curves included, that one observable made of every seed of a point;
 * it gives numbers with standard uncertainties, found by resampling or leaving out
 * whole seeds, for the samples within one curve depend on each other.
 *
 *     across: {rate: {fit: relaxation, of: step, along: seeds}}
 *
 * One constant struct in a file of its own and one line in ensemble.c.  Resampling
 * draws from a stream (common/random.h) of a constant seed: the same measurements
 * give the same bits.
 *
 * Leaves out: seeds of different weight.
 * Checked by: tests/unit/test_ensemble.c.
 */
#ifndef VALIDATION_ENSEMBLE_H
#define VALIDATION_ENSEMBLE_H

#include "validation/recipe.h"

enum { ENSEMBLE_MAX_OUTPUTS = 8 };

struct ensemble {
    const char *name, *title;
    const char *source;
    /* The recipe whose outputs, settings and curves it knows; NULL: any that gives `curves`. */
    const char *recipe;
    const char *const *curves; /* that every measurement must have; NULL-terminated, may be NULL */
    struct recipe_output output[ENSEMBLE_MAX_OUTPUTS]; /* ends at name == NULL */
    size_t min_seeds;
    /* m[0 .. count-1]: one measurement a seed, all usable, with the curves asked for.
     * count is below min_seeds where a seed is left out of the fewest, or --seeds asked for
     * fewer: the value is wanted all the same, the uncertainty may stay NaN.
     * settings: of the observable, in its recipe's order.  value[i], uncertainty[i] for
     * each output, NaN on entry; what stays NaN is inconclusive.  STATUS_BAD_INPUT with
     * a reason where the data do not allow the fit. */
    enum status (*fit)(const struct measurement *const *m, size_t count, const double *settings,
                       double *value, double *uncertainty, struct fault *fault);
};

const struct ensemble *ensemble_find(const char *name);
const struct ensemble *const *ensemble_all(size_t *count);

/* The first curve of that name, or NULL. */
const struct curve *ensemble_curve(const struct measurement *m, const char *name);

#endif
