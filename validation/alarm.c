#include "validation/alarm.h"

#include "validation/power.h"

#include <gsl/gsl_cdf.h>
#include <gsl/gsl_integration.h>
#include <gsl/gsl_randist.h>
#include <math.h>

enum { NODES = 64 };

/* What is farther out is not integrated: it counts as an alarm. */
static const double remote = 1e-12;

/* Probability that t lies beyond x upwards, or below it. */
static double above(double x, double freedom) {
    return isinf(x) ? x < 0 : gsl_cdf_tdist_Q(x, freedom);
}

static double below(double x, double freedom) {
    return isinf(x) ? x > 0 : gsl_cdf_tdist_P(x, freedom);
}

/* Probability that the mean does not lie where the usual verdict needs it. */
static double misses(const struct alarm_question *q, double h, double pooled, double freedom) {
    double scale = power_scale(pooled, q->seeds, q->ensemble.seeds);
    struct judge_range r = q->known ? judge_failing(q->comparison, h, q->tolerance)
                                    : judge_passing(q->comparison, h, q->tolerance);
    double low = (r.low - q->ensemble.mean) / scale, high = (r.high - q->ensemble.mean) / scale;
    if (!r.outside)
        return low > high ? 1 : below(low, freedom) + above(high, freedom);
    if (low > high)
        return 0;
    return low > 0 ? above(low, freedom) - above(high, freedom)
                   : below(high, freedom) - below(low, freedom);
}

/* Half width of the interval where the seeds scatter by w times the ensemble's deviation. */
static double half_width(const struct alarm_question *q, double w) {
    double n = (double)q->seeds, s = q->ensemble.deviation;
    if (q->fitted || isfinite(q->declared))
        return judge_half_width((q->fitted ? s : q->declared) / sqrt(n), q->expected_uncertainty,
                                INFINITY);
    return judge_half_width(s * w / sqrt(n), q->expected_uncertainty, n - 1);
}

/* Density of w = v/s times the probability of an alarm at that w. */
static double integrand(double w, void *context) {
    const struct alarm_question *q = context;
    double own = (double)q->seeds - 1, stored = (double)q->ensemble.seeds - 1, both = own + stored;
    double pooled = q->ensemble.deviation * sqrt((stored + own * w * w) / both);
    return 2 * w * gsl_ran_fdist_pdf(w * w, own, stored) *
           misses(q, half_width(q, w), pooled, both);
}

/* The w beyond which every run raises an alarm, as far as that is known: a declared scatter is
 * refuted, or an interval is wider than what it must lie in. */
static double hopeless(const struct alarm_question *q) {
    double h = judge_half_width(1, 0, (double)q->seeds - 1); /* of unit uncertainty */
    double u = q->tolerance / h, e = q->expected_uncertainty, s = q->ensemble.deviation;
    if (isfinite(q->declared))
        return judge_refuting_ratio(q->seeds, q->share) * q->declared / s;
    if (q->comparison != COMPARE_WITHIN || q->known)
        return INFINITY;
    return u > e ? sqrt((u * u - e * e) * (double)q->seeds) / s : 0;
}

static double integrate(struct alarm_question *q) {
    double own = (double)q->seeds - 1, stored = (double)q->ensemble.seeds - 1;
    double end = fmin(sqrt(gsl_cdf_fdist_Qinv(remote, own, stored)), hopeless(q));
    gsl_integration_glfixed_table *table = gsl_integration_glfixed_table_alloc(NODES);
    gsl_function f = {.function = integrand, .params = q};
    double sum = gsl_cdf_fdist_Q(end * end, own, stored), from = 0;
    const double stop[] = {0.1, 0.5, 1, 2, 4, 8, 32, 512, INFINITY};
    for (size_t i = 0; table != NULL && i < sizeof stop / sizeof *stop; i++) {
        double to = fmin(stop[i], end);
        sum += gsl_integration_glfixed(&f, from, to, table);
        from = to;
    }
    if (table == NULL)
        return NAN;
    gsl_integration_glfixed_table_free(table);
    return fmin(sum, 1);
}

double alarm_rate(const struct alarm_question *q) {
    const struct judge_ensemble *e = &q->ensemble;
    if (e->seeds < 2 || q->seeds < 1 || !(e->deviation > 0) || !isfinite(e->deviation) ||
        !isfinite(e->mean) || !isfinite(q->tolerance) || !isfinite(q->expected_uncertainty))
        return NAN;
    bool scatter_is_known = q->fitted || isfinite(q->declared);
    if (q->seeds < 2 && !scatter_is_known)
        return 1; /* one seed of unknown scatter never passes */
    if (q->seeds < 2 || q->fitted)
        return misses(q, half_width(q, 1), e->deviation, (double)e->seeds - 1);
    struct alarm_question copy = *q;
    return integrate(&copy);
}
