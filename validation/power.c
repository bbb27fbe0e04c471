#include "validation/power.h"

#include <gsl/gsl_cdf.h>
#include <gsl/gsl_errno.h>
#include <gsl/gsl_integration.h>
#include <gsl/gsl_randist.h>
#include <gsl/gsl_roots.h>
#include <gsl/gsl_sort.h>
#include <math.h>

enum { NODES = 128, EDGES = 5, STEPS = 100 };

struct noncentral {
    double shift, quantile, freedom, power;
    double alpha;
};

double power_quantile(double alpha, double freedom) {
    return gsl_cdf_tdist_Qinv(alpha / 2, freedom);
}

double power_scale(double deviation, size_t seeds, size_t reference_seeds) {
    return deviation * sqrt(1 / (double)seeds + 1 / (double)reference_seeds);
}

/* Density of w = s/sigma times the probability of an alarm at that w. */
static double integrand(double w, void *context) {
    const struct noncentral *n = context;
    double density = 2 * n->freedom * w * gsl_ran_chisq_pdf(n->freedom * w * w, n->freedom);
    return density * (gsl_cdf_ugaussian_P(n->shift - n->quantile * w) +
                      gsl_cdf_ugaussian_P(-n->shift - n->quantile * w));
}

/* From a to b, where the integrand is smooth on the scale of b - a. */
static double integrate(struct noncentral *n, double a, double b) {
    gsl_function f = {.function = integrand, .params = n};
    gsl_integration_glfixed_table *table = gsl_integration_glfixed_table_alloc(NODES);
    if (table == NULL)
        return NAN;
    double sum = gsl_integration_glfixed(&f, a, b, table);
    gsl_integration_glfixed_table_free(table);
    return sum;
}

static double between(double x, double low, double high) {
    return fmin(fmax(x, low), high);
}

/* The integrand has two scales: the width of the density about 1, and that of an alarm about
 * shift/quantile. 12 and 8 of each: what lies beyond is below 1e-13. */
double power_of_shift(double shift, double alpha, double freedom) {
    struct noncentral n = {shift, power_quantile(alpha, freedom), freedom, 0, alpha};
    double width = 12 / sqrt(2 * freedom), low = fmax(0, 1 - width), high = 1 + width;
    double edge[] = {low, 1, between((shift - 8) / n.quantile, low, high),
                     between((shift + 8) / n.quantile, low, high), high};
    double sum = 0;
    gsl_sort(edge, 1, EDGES);
    for (size_t i = 0; i + 1 < EDGES; i++)
        sum += integrate(&n, edge[i], edge[i + 1]);
    return fmin(1, sum);
}

static double missing_power(double shift, void *context) {
    const struct noncentral *n = context;
    return power_of_shift(shift, n->alpha, n->freedom) - n->power;
}

double power_shift(double power, double alpha, double freedom) {
    if (!(alpha > 0 && alpha < power && power < 1 && freedom > 0))
        return NAN;
    struct noncentral n = {.freedom = freedom, .power = power, .alpha = alpha};
    double low = 0, high = power_quantile(alpha, freedom) + 1;
    while (isfinite(high) && missing_power(high, &n) < 0)
        high *= 2;
    gsl_function f = {.function = missing_power, .params = &n};
    gsl_root_fsolver *solver = gsl_root_fsolver_alloc(gsl_root_fsolver_brent);
    double root = NAN;
    if (solver == NULL || !isfinite(high) ||
        gsl_root_fsolver_set(solver, &f, low, high) != GSL_SUCCESS)
        goto done;
    for (int i = 0; i < STEPS && isnan(root); i++) {
        if (gsl_root_fsolver_iterate(solver) != GSL_SUCCESS)
            break;
        low = gsl_root_fsolver_x_lower(solver);
        high = gsl_root_fsolver_x_upper(solver);
        if (gsl_root_test_interval(low, high, 0, 1e-7) == GSL_SUCCESS)
            root = gsl_root_fsolver_root(solver);
    }
done:
    if (solver != NULL)
        gsl_root_fsolver_free(solver);
    return root;
}

double power_detectable(double deviation, size_t seeds, size_t reference_seeds, double alpha) {
    if (seeds < 1 || reference_seeds < 2)
        return NAN;
    return power_shift(POWER_WANTED, alpha, (double)reference_seeds - 1) *
           power_scale(deviation, seeds, reference_seeds);
}
