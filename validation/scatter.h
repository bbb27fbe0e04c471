/* scatter.h -- what the seeds of a row gave: the ensembles that chance is judged by.
 *
 * For every row that chance may decide (scatter_is_statistical): the judged quantity of
 * each seed, its mean and its standard deviation from seed to seed.  The quantity is
 * what reference_key names: a value, a ratio, or a difference from an expectation that
 * differs from run to run.
 *
 * A fit over a sweep has no value of one seed.  Its seeds are the jackknife's
 * pseudo-values, K t - (K-1) t_i with t the fit to all K seeds and t_i to all but seed i:
 * their mean is t less its bias, and their deviation s such that s/sqrt(K) is the
 * jackknife's uncertainty of t.
 *
 * Source:     Tukey, Ann. Math. Stat. 29, 614 (1958), for pseudo-values.
 * Leaves out: points whose numbers of seeds differ within one fit.
 * Checked by: tests/unit/test_scatter.c.
 */
#ifndef VALIDATION_SCATTER_H
#define VALIDATION_SCATTER_H

#include "validation/measure.h"
#include "validation/reference.h"

/* Does the verdict hang on scatter between seeds?  Not of round-off, `scatter: 0`, exact fits,
 * and pairs of the same seed. */
bool scatter_is_statistical(const struct case_file *file, const struct case_check *check);

struct scatter {
    const struct case_check *check;
    size_t check_index, point; /* in the tier; the first point of a fit's group */
    struct reference_key key;
    size_t count;
    const long long *seed;  /* seed[0 .. count-1] */
    const double *value;    /* value[0 .. count-1]; NaN: missing */
    const double *expected; /* expected[0 .. count-1], 0 of differences; NaN: none or missing */
    double expected_uncertainty;
    double scale; /* of what margins in percent are a part: the expectation, a mean over seeds */
    double mean, deviation; /* NaN with a reason in `missing` */
    const char *missing;    /* why there is no ensemble, or NULL */
};

/* Every statistical row of a measured case, in the order of checks and points. */
enum status scatter_measure(const struct measured_case *m, struct arena *a, struct scatter **out,
                            size_t *count, struct fault *fault);

#endif
