/* ensemble.c -- the list of ensemble fits, and the plainest of them. */
#include "validation/ensembles.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

const struct curve *ensemble_curve(const struct measurement *m, const char *name) {
    for (size_t i = 0; i < m->curve_count; i++)
        if (strcmp(m->curve[i].name, name) == 0)
            return &m->curve[i];
    return NULL;
}

/* -- the peak of a mean curve ----------------------------------------------------- */

/* The first curve of every seed, all on the same abscissae. */
static enum status check_first_curves(const struct measurement *const *m, size_t count,
                                      struct fault *fault) {
    for (size_t i = 0; i < count; i++) {
        if (m[i]->curve_count == 0 || m[i]->curve[0].count == 0)
            return fault_set(fault, STATUS_BAD_INPUT, "a run has no curve");
        const struct curve *a = &m[0]->curve[0], *b = &m[i]->curve[0];
        if (a->count != b->count || memcmp(a->x, b->x, a->count * sizeof *a->x) != 0)
            return fault_set(fault, STATUS_BAD_INPUT, "the curves of %s have different abscissae",
                             a->name);
    }
    return STATUS_OK;
}

/* Largest value of the mean of the curves, one left out (count: none), and where. */
static void find_peak(const struct measurement *const *m, size_t count, size_t left_out,
                      double *value, double *place) {
    const struct curve *first = &m[0]->curve[0];
    size_t kept = left_out < count ? count - 1 : count;
    *value = -INFINITY;
    for (size_t k = 0; k < first->count; k++) {
        double sum = 0;
        for (size_t i = 0; i < count; i++)
            sum += i == left_out ? 0 : m[i]->curve[0].y[k];
        if (sum / (double)kept > *value) {
            *value = sum / (double)kept;
            *place = first->x[k];
        }
    }
}

/* Standard uncertainty by the jackknife: sqrt((n-1)/n sum (t_i - mean t)^2), t_i the
 * statistic without seed i. */
static double jackknife(const double *t, size_t count) {
    double mean = 0, squares = 0;
    for (size_t i = 0; i < count; i++)
        mean += t[i] / (double)count;
    for (size_t i = 0; i < count; i++)
        squares += (t[i] - mean) * (t[i] - mean);
    return sqrt(squares * (double)(count - 1) / (double)count);
}

static enum status fit_peak(const struct measurement *const *m, size_t count,
                            const double *settings, double *value, double *uncertainty,
                            struct fault *fault) {
    (void)settings;
    if (check_first_curves(m, count, fault) != STATUS_OK)
        return fault->status;
    double *t = calloc(2 * count, sizeof *t);
    if (t == NULL)
        return fault_set(fault, STATUS_NO_MEMORY, "peak of mean: out of memory");
    for (size_t i = 0; i < count && count > 1; i++)
        find_peak(m, count, i, &t[i], &t[count + i]);
    find_peak(m, count, count, &value[0], &value[1]);
    for (size_t k = 0; k < 2 && count > 1; k++)
        uncertainty[k] = jackknife(t + k * count, count);
    free(t);
    return STATUS_OK;
}

/* The mean of each seed's own peak would count the noise as height. */
static const struct ensemble PEAK_OF_MEAN = {
    .name = "peak-of-mean",
    .title = "Largest value of the seeds' mean curve (the observable's first), and where",
    .source = "jackknife over seeds: Efron, The Jackknife, the Bootstrap (SIAM, 1982), Section 3",
    .output = {{"peak", "1", "largest value, in the curve's unit"},
               {"place", "1", "its abscissa, in the curve's unit"}},
    .min_seeds = 3,
    .fit = fit_peak,
};

/* -- the list ------------------------------------------------------------------- */

static const struct ensemble *const ENSEMBLES[] = {&PEAK_OF_MEAN, &ensemble_relaxation};
enum { ENSEMBLE_COUNT = sizeof ENSEMBLES / sizeof *ENSEMBLES };

const struct ensemble *ensemble_find(const char *name) {
    for (size_t i = 0; i < ENSEMBLE_COUNT; i++)
        if (strcmp(ENSEMBLES[i]->name, name) == 0)
            return ENSEMBLES[i];
    return NULL;
}

const struct ensemble *const *ensemble_all(size_t *count) {
    *count = ENSEMBLE_COUNT;
    return ENSEMBLES;
}
