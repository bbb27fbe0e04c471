/* ensemble_relaxation.c -- lambda of FZ Fig. 7 from the L(t) of all seeds of a point.
 *
 * The mean of L^2, noise taken off, over the seeds is turned into L and fitted (relaxation_fit.h).
 * The uncertainty comes from refits of resampled seeds: n seeds are drawn with replacement
 * 200 times; the standard deviation of the refits is that of a mean of n with 1/n for 1/(n-1), so
 * it is multiplied by sqrt(n/(n-1)); and few seeds know their own scatter badly, so it is
 * multiplied by t(n-1)/1.96, Student's 97.5 % quantile over the normal one, whereby value +- 1.96 u
 * holds the truth 95 times in 100 (tests/unit/test_relaxation_fit.c).
 *
 * Source:     Efron & Tibshirani, An Introduction to the Bootstrap (1993); Fiege & Zippelius,
 * Eq. 15. Leaves out: nothing that all seeds share (bins, samples). Checked by:
 * suspension/expansion-rate; tests/unit/test_relaxation_fit.c.
 */
#include "common/random.h"
#include "validation/ensembles.h"
#include "validation/relaxation_fit.h"

#include <gsl/gsl_cdf.h>
#include <gsl/gsl_randist.h>
#include <gsl/gsl_statistics_double.h>
#include <math.h>
#include <stdlib.h>

enum { REFITS = 200, RATE = 0, PLATEAU, ROOT_OVER, OUTPUTS };
static const uint64_t SEED = 20131;

struct seeds {
    const struct measurement *const *m;
    size_t count, samples;
    const double *time;
    double *length; /* [0 .. samples-1] */
};

/* The fit of the mean L^2 with these weights (which sum to the number of seeds). */
static enum status fit_weighted(const struct seeds *s, const unsigned *weight, double *value,
                                struct fault *fault) {
    struct relaxation_fit fit;
    for (size_t k = 0; k < s->samples; k++) {
        double sum = 0;
        for (size_t i = 0; i < s->count; i++)
            sum += weight[i] * ensemble_curve(s->m[i], "L2")->y[k];
        s->length[k] = relaxation_length(sum / (double)s->count);
    }
    enum status status = relaxation_fit(s->time, s->length, s->samples, &fit, fault);
    if (status)
        return status;
    value[RATE] = fit.rate_per_s;
    value[PLATEAU] = fit.plateau;
    value[ROOT_OVER] = fit.root_rms / fit.exponential_rms;
    return STATUS_OK;
}

static enum status check_curves(const struct measurement *const *m, size_t count,
                                struct fault *fault) {
    const struct curve *first = ensemble_curve(m[0], "L2");
    for (size_t i = 0; i < count; i++) {
        const struct curve *c = ensemble_curve(m[i], "L2");
        if (c->count != first->count || c->count < 5)
            return fault_set(fault, STATUS_BAD_INPUT,
                             "seeds have %zu and %zu samples of L^2 in the window", first->count,
                             c->count);
        for (size_t k = 0; k < c->count; k++)
            if (fabs(c->x[k] - first->x[k]) > 1e-9 * first->x[c->count - 1])
                return fault_set(fault, STATUS_BAD_INPUT, "seeds have L^2 at %g and %g s",
                                 first->x[k], c->x[k]);
    }
    return STATUS_OK;
}

static enum status resample(const struct seeds *s, double *uncertainty, struct fault *fault) {
    gsl_rng *rng = NULL;
    double *value = calloc(OUTPUTS * REFITS, sizeof *value), *p = calloc(s->count, sizeof *p);
    unsigned *weight = calloc(s->count, sizeof *weight);
    enum status status = value && p && weight
                             ? random_stream(SEED, "relaxation refits", &rng, fault)
                             : fault_set(fault, STATUS_NO_MEMORY, "no memory for refits");
    for (size_t i = 0; !status && i < s->count; i++)
        p[i] = 1;
    for (size_t n = 0; !status && n < REFITS; n++) {
        double one[OUTPUTS];
        gsl_ran_multinomial(rng, s->count, (unsigned)s->count, p, weight);
        status = fit_weighted(s, weight, one, fault);
        for (size_t k = 0; !status && k < OUTPUTS; k++)
            value[k * REFITS + n] = one[k];
    }
    double n = (double)s->count;
    double factor =
        sqrt(n / (n - 1)) * gsl_cdf_tdist_Pinv(0.975, n - 1) / gsl_cdf_ugaussian_Pinv(0.975);
    for (size_t k = 0; !status && k < OUTPUTS; k++)
        uncertainty[k] = factor * gsl_stats_sd(value + k * REFITS, 1, REFITS);
    free(value);
    free(p);
    free(weight);
    if (rng)
        gsl_rng_free(rng);
    return status;
}

static enum status fit(const struct measurement *const *m, size_t count, const double *settings,
                       double *value, double *uncertainty, struct fault *fault) {
    (void)settings;
    unsigned *all = NULL;
    enum status status = check_curves(m, count, fault);
    if (status)
        return status;
    const struct curve *first = ensemble_curve(m[0], "L2");
    struct seeds s = {m, count, first->count, first->x, calloc(first->count, sizeof(double))};
    all = calloc(count, sizeof *all);
    if (!s.length || !all)
        status = fault_set(fault, STATUS_NO_MEMORY, "no memory for %zu samples", s.samples);
    for (size_t i = 0; !status && i < count; i++)
        all[i] = 1;
    if (!status)
        status = fit_weighted(&s, all, value, fault);
    if (!status)
        status = resample(&s, uncertainty, fault);
    free(s.length);
    free(all);
    return status;
}

static const char *const CURVES[] = {"L2", NULL};

const struct ensemble ensemble_relaxation = {
    .name = "relaxation",
    .title = "Rate of L(t), all seeds together",
    .source = "Fiege & Zippelius, Eq. 15 and Fig. 7",
    .recipe = "bed-relaxation",
    .curves = CURVES,
    .output = {{"rate", "1/s", "lambda of A (1 - exp(-lambda t))"},
               {"plateau", "sqrt(R)", "A"},
               {"root_over_exponential", "1",
                "residual of sqrt(min(t, t_e)) over that of the "
                "exponential"}},
    .min_seeds = 2,
    .fit = fit,
};
