/* across.c -- see across.h.
 *
 * All fits but `ends` and `spread` are straight lines by GSL.  Points of known uncertainty are
 * weighted with its inverse square and the fit's uncertainty follows from theirs; where any
 * uncertainty is unknown or zero, all points weigh the same and the uncertainty follows from the
 * scatter about the line (none with two points: then it is 0 when all points are exact, else
 * unknown).
 *
 * Source:     GSL, gsl_fit_wlinear and gsl_fit_linear.
 * Leaves out: errors of the swept parameter: it is exact.
 * Checked by: tests/unit/test_across.c.
 */
#include "validation/across.h"

#include <gsl/gsl_fit.h>
#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

/* y = value + slope (x - pivot). */
struct line {
    double value, slope;
    double value_variance, slope_variance, covariance;
};

static bool all_exact(const struct across_point *p, size_t count) {
    for (size_t i = 0; i < count; i++)
        if (p[i].uncertainty != 0)
            return false;
    return true;
}

static bool all_uncertain(const struct across_point *p, size_t count) {
    for (size_t i = 0; i < count; i++)
        if (!(p[i].uncertainty > 0))
            return false;
    return true;
}

/* x[0 .. count-1], y, weight (0 weights nothing): straight line, its uncertainty as above. */
static void fit_weighted(const double *x, const double *y, const double *weight, size_t count,
                         struct line *out) {
    double chi;
    gsl_fit_wlinear(x, 1, weight, 1, y, 1, count, &out->value, &out->slope, &out->value_variance,
                    &out->covariance, &out->slope_variance, &chi);
}

static void fit_plain(const double *x, const double *y, size_t count, bool exact,
                      struct line *out) {
    double sum;
    gsl_fit_linear(x, 1, y, 1, count, &out->value, &out->slope, &out->value_variance,
                   &out->covariance, &out->slope_variance, &sum);
    if (count == 2) {
        out->value_variance = out->slope_variance = out->covariance = exact ? 0 : NAN;
    }
}

static enum status no_memory(struct fault *fault) {
    return fault_set(fault, STATUS_NO_MEMORY, "no memory for a fit");
}

static enum status fit_line(const struct across_point *point, size_t count, bool logarithmic,
                            struct line *out, struct fault *fault) {
    double *x = calloc(3 * count, sizeof *x);
    if (!x)
        return no_memory(fault);
    double *y = x + count, *weight = y + count;
    enum status status = STATUS_OK;
    bool weighted = all_uncertain(point, count);
    for (size_t i = 0; i < count && !status; i++) {
        const struct across_point *p = &point[i];
        if (logarithmic && !(p->x > 0 && p->y > 0))
            status = fault_set(fault, STATUS_BAD_INPUT,
                               "an order needs positive numbers; %g at %g is none", p->y, p->x);
        x[i] = logarithmic ? log(p->x) : p->x;
        y[i] = logarithmic ? log(p->y) : p->y;
        double u = logarithmic ? p->uncertainty / p->y : p->uncertainty;
        weight[i] = 1 / (u * u);
    }
    if (!status && weighted)
        fit_weighted(x, y, weight, count, out);
    else if (!status)
        fit_plain(x, y, count, all_exact(point, count), out);
    free(x);
    return status;
}

/* -- orders of accuracy ------------------------------------------------------ */

static enum status fit_order(const struct across_point *point, size_t count, double *value,
                             double *uncertainty, struct fault *fault) {
    struct line l;
    enum status status = fit_line(point, count, true, &l, fault);
    if (status)
        return status;
    value[0] = l.slope;
    uncertainty[0] = sqrt(l.slope_variance);
    return STATUS_OK;
}

static enum status fit_order_of_refinement(const struct across_point *point, size_t count,
                                           double *value, double *uncertainty,
                                           struct fault *fault) {
    enum status status = fit_order(point, count, value, uncertainty, fault);
    value[0] = -value[0];
    return status;
}

/* -- straight lines ---------------------------------------------------------- */

static enum status fit_extrapolation(const struct across_point *point, size_t count, double *value,
                                     double *uncertainty, struct fault *fault) {
    struct line l;
    enum status status = fit_line(point, count, false, &l, fault);
    if (status)
        return status;
    value[0] = l.value;
    uncertainty[0] = sqrt(l.value_variance);
    value[1] = l.slope;
    uncertainty[1] = sqrt(l.slope_variance);
    return STATUS_OK;
}

/* y = value + slope (x - mean x): the value in the middle does not depend on the slope. */
static enum status fit_slope(const struct across_point *point, size_t count, double *value,
                             double *uncertainty, struct fault *fault) {
    struct line l;
    double chi = 0, sum = 0, weights = 0;
    enum status status = fit_line(point, count, false, &l, fault);
    if (status)
        return status;
    bool weighted = all_uncertain(point, count);
    for (size_t i = 0; i < count; i++) {
        double u = weighted ? point[i].uncertainty : 1;
        double off = point[i].y - l.value - l.slope * point[i].x;
        chi += off * off / (u * u);
        sum += point[i].x / (u * u);
        weights += 1 / (u * u);
    }
    double per = count > 2 ? chi / (double)(count - 2) : 0;
    double wider = weighted && per > 1 ? sqrt(per) : 1;
    double x = sum / weights, middle = l.value + l.slope * x;
    double variance = l.value_variance + x * x * l.slope_variance + 2 * x * l.covariance;
    value[0] = l.slope;
    uncertainty[0] = wider * sqrt(l.slope_variance);
    value[1] = l.slope / middle; /* the two do not depend on each other */
    uncertainty[1] =
        hypot(uncertainty[0], value[1] * wider * sqrt(fmax(variance, 0))) / fabs(middle);
    return middle == 0 ? fault_set(fault, STATUS_BAD_INPUT,
                                   "a line through 0 in its middle has "
                                   "no relative slope")
                       : STATUS_OK;
}

static enum status fit_zero(const struct across_point *point, size_t count, double *value,
                            double *uncertainty, struct fault *fault) {
    struct line l;
    enum status status = fit_line(point, count, false, &l, fault);
    if (status)
        return status;
    if (l.slope == 0)
        return fault_set(fault, STATUS_BAD_INPUT, "a level line has no zero");
    double zero = -l.value / l.slope;
    /* d zero = -(d value + zero d slope)/slope */
    double variance = l.value_variance + zero * zero * l.slope_variance + 2 * zero * l.covariance;
    value[0] = zero;
    uncertainty[0] = sqrt(fmax(variance, 0)) / fabs(l.slope);
    if (isnan(variance))
        uncertainty[0] = NAN;
    return STATUS_OK;
}

/* -- first and last ---------------------------------------------------------- */

static enum status fit_ends(const struct across_point *point, size_t count, double *value,
                            double *uncertainty, struct fault *fault) {
    const struct across_point *low = &point[0], *high = &point[count - 1];
    if (high->y == 0)
        return fault_set(fault, STATUS_BAD_INPUT, "no ratio to a zero at %g", high->x);
    double u_low = low->uncertainty, u_high = high->uncertainty;
    value[0] = low->y / high->y;
    uncertainty[0] = hypot(u_low, value[0] * u_high) / fabs(high->y);
    value[1] = low->y - high->y;
    uncertainty[1] = hypot(u_low, u_high);
    return STATUS_OK;
}

/* -- largest and smallest ---------------------------------------------------- */

static enum status fit_spread(const struct across_point *point, size_t count, double *value,
                              double *uncertainty, struct fault *fault) {
    const struct across_point *low = &point[0], *high = &point[0];
    double sum = 0, variance = 0;
    for (size_t i = 0; i < count; i++) {
        low = point[i].y < low->y ? &point[i] : low;
        high = point[i].y > high->y ? &point[i] : high;
        sum += point[i].y;
        variance += point[i].uncertainty * point[i].uncertainty;
    }
    if (!(low->y > 0))
        return fault_set(fault, STATUS_BAD_INPUT, "no ratio of the largest to %g at %g", low->y,
                         low->x);
    value[0] = high->y / low->y;
    uncertainty[0] = hypot(high->uncertainty, value[0] * low->uncertainty) / low->y;
    value[1] = sum / (double)count;
    uncertainty[1] = sqrt(variance) / (double)count;
    value[2] = value[0] - 1;
    uncertainty[2] = uncertainty[0];
    return STATUS_OK;
}

static const struct across ORDER = {
    .name = "order",
    .title = "Order of accuracy: error ~ x^order, x a step",
    .source = "weighted least squares of ln y on ln x",
    .min_points = 2,
    .output = {"order", NULL},
    .fit = fit_order,
};

static const struct across ORDER_OF_REFINEMENT = {
    .name = "order-of-refinement",
    .title = "Order of accuracy: error ~ x^-order, x a number of cells",
    .source = "weighted least squares of ln y on ln x",
    .min_points = 2,
    .output = {"order", NULL},
    .fit = fit_order_of_refinement,
};

static const struct across EXTRAPOLATE_LINEAR = {
    .name = "extrapolate-linear",
    .title = "Value at x = 0 and slope of a straight line",
    .source = "weighted least squares of y on x",
    .min_points = 2,
    .output = {"value", "slope", NULL},
    .fit = fit_extrapolation,
};

static const struct across SLOPE = {
    .name = "slope",
    .title = "Slope of a straight line, and slope over its value in the middle",
    .source = "weighted least squares of y on x; points that scatter more than their "
              "uncertainties say widen it by sqrt(chi^2/(n - 2))",
    .min_points = 2,
    .output = {"slope", "relative", NULL},
    .fit = fit_slope,
};

static const struct across ZERO = {
    .name = "zero",
    .title = "Where a straight line crosses 0",
    .source = "weighted least squares of y on x",
    .min_points = 2,
    .output = {"zero", NULL},
    .fit = fit_zero,
};

static const struct across ENDS = {
    .name = "ends",
    .title = "Value at the smallest x against that at the largest",
    .source = "ratio and difference",
    .min_points = 2,
    .output = {"ratio", "difference", NULL},
    .fit = fit_ends,
};

static const struct across SPREAD = {
    .name = "spread",
    .title = "Largest value over the smallest, at any x; the mean; by how much the ratio exceeds 1",
    .source = "ratio; with scatter it lies above that of the true values",
    .min_points = 2,
    .output = {"ratio", "mean", "excess", NULL},
    .fit = fit_spread,
};

static const struct across *const ALL[] = {
    &ORDER, &ORDER_OF_REFINEMENT, &EXTRAPOLATE_LINEAR, &SLOPE, &ZERO, &ENDS, &SPREAD};

const struct across *across_find(const char *name) {
    for (size_t i = 0; i < sizeof ALL / sizeof *ALL; i++)
        if (!strcmp(ALL[i]->name, name))
            return ALL[i];
    return NULL;
}

const struct across *const *across_all(size_t *count) {
    *count = sizeof ALL / sizeof *ALL;
    return ALL;
}
