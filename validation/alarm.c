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

static double with_known_scatter(const struct alarm_question *q) {
    const struct judge_ensemble *e = &q->ensemble;
    double n = (double)q->seeds, freedom = (double)e->seeds - 1;
    double scatter = q->fitted ? e->deviation : q->declared;
    double h = judge_half_width(scatter / sqrt(n), q->expected_uncertainty, INFINITY);
    double rate = misses(q, h, e->deviation, freedom);
    double ratio = judge_refuting_ratio(q->seeds, q->share) * scatter / e->deviation;
    if (!q->fitted && q->seeds > 1)
        rate += gsl_cdf_fdist_Q(ratio * ratio, n - 1, freedom);
    return fmin(rate, 1);
}

/* Density of w = v/s times the probability of an alarm at that w. */
static double integrand(double w, void *context) {
    const struct alarm_question *q = context;
    const struct judge_ensemble *e = &q->ensemble;
    double own = (double)q->seeds - 1, stored = (double)e->seeds - 1, both = own + stored;
    double pooled = e->deviation * sqrt((stored + own * w * w) / both);
    double u = e->deviation * w / sqrt((double)q->seeds);
    double h = judge_half_width(u, q->expected_uncertainty, own);
    return 2 * w * gsl_ran_fdist_pdf(w * w, own, stored) * misses(q, h, pooled, both);
}

/* Where the interval of w becomes wider than what it must lie in. */
static double widest(const struct alarm_question *q) {
    double h = judge_half_width(1, 0, (double)q->seeds - 1); /* of unit uncertainty */
    double u = q->tolerance / h, e = q->expected_uncertainty;
    if (!(q->tolerance > 0))
        return INFINITY;
    return u > e ? sqrt(u * u - e * e) * sqrt((double)q->seeds) / q->ensemble.deviation : INFINITY;
}

static double with_scatter_of_its_own(struct alarm_question *q) {
    double own = (double)q->seeds - 1, stored = (double)q->ensemble.seeds - 1;
    double end = sqrt(gsl_cdf_fdist_Qinv(remote, own, stored)), edge = fmin(widest(q), end);
    gsl_integration_glfixed_table *table = gsl_integration_glfixed_table_alloc(NODES);
    gsl_function f = {.function = integrand, .params = q};
    double sum = gsl_cdf_fdist_Q(end * end, own, stored), from = 0;
    const double stop[] = {0.1, 0.5, 1, 2, 4, 8, 32, 512, INFINITY};
    for (size_t i = 0; table != NULL && i < sizeof stop / sizeof *stop; i++) {
        double to = fmin(stop[i], end);
        if (edge > from && edge < to) {
            sum += gsl_integration_glfixed(&f, from, edge, table);
            from = edge;
        }
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
    if (q->fitted || isfinite(q->declared))
        return with_known_scatter(q);
    struct alarm_question copy = *q;
    return q->seeds < 2 ? 1 : with_scatter_of_its_own(&copy);
}
