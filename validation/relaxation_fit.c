/* relaxation_fit.c -- see relaxation_fit.h. */
#include "validation/relaxation_fit.h"

#include <gsl/gsl_errno.h>
#include <gsl/gsl_min.h>
#include <math.h>
#include <stdbool.h>
#include <stdlib.h>

enum status relaxation_square(const double *profile, size_t count, size_t bins, double bin_R,
                              size_t still, double *square_R, double *floor_R,
                              struct fault *fault) {
    if (still < 1 || still > count || bins < 1)
        return fault_set(fault, STATUS_BAD_INPUT, "%zu of %zu profiles before the change", still,
                         count);
    double *start = calloc(bins, sizeof *start), scatter = 0;
    if (!start)
        return fault_set(fault, STATUS_NO_MEMORY, "no memory for %zu bins", bins);
    for (size_t f = 0; f < still; f++)
        for (size_t i = 0; i < bins; i++)
            start[i] += profile[f * bins + i] / (double)still;
    for (size_t f = 0; f < count; f++) {
        double sum = 0;
        for (size_t i = 0; i < bins; i++) {
            double d = profile[f * bins + i] - start[i];
            sum += d * d * bin_R;
        }
        square_R[f] = sum;
        if (f < still)
            scatter += sum;
    }
    free(start);
    *floor_R = still > 1 ? scatter / (double)(still - 1) * (1 + 1 / (double)still) : NAN;
    for (size_t f = 0; still > 1 && f < count; f++)
        square_R[f] -= *floor_R;
    return STATUS_OK;
}

double relaxation_length(double square_R) {
    return copysign(sqrt(fabs(square_R)), square_R);
}

/* -- one height, one time -------------------------------------------------------------- */

enum { GRID = 41, ROUNDS = 100 };

struct samples {
    const double *time_s, *length;
    size_t count;
    double (*shape)(double time_s, double scale_s);
};

static double rising(double time_s, double scale_s) {
    return -expm1(-time_s / scale_s);
}

static double rooted(double time_s, double scale_s) {
    return sqrt(fmin(time_s, scale_s));
}

/* Best height at a time scale, and the sum of squares that it leaves. */
static double best_height(const struct samples *s, double scale_s, double *left) {
    double cross = 0, own = 0;
    for (size_t i = 0; i < s->count; i++) {
        double y = s->shape(s->time_s[i], scale_s);
        cross += y * s->length[i];
        own += y * y;
    }
    double height = cross / own;
    *left = 0;
    for (size_t i = 0; i < s->count; i++) {
        double d = s->length[i] - height * s->shape(s->time_s[i], scale_s);
        *left += d * d;
    }
    return height;
}

static double left_at(double log_scale, void *samples) {
    double left;
    best_height(samples, exp(log_scale), &left);
    return left;
}

/* The time scale from low_s to high_s that leaves least; on a grid, then by Brent.
 * *at_end: is it one of the two? */
static enum status best_scale(struct samples *s, double low_s, double high_s, double *scale_s,
                              bool *at_end, struct fault *fault) {
    double step = log(high_s / low_s) / (GRID - 1), best = INFINITY;
    int at = 0;
    for (int i = 0; i < GRID; i++) {
        double left = left_at(log(low_s) + i * step, s);
        if (left < best) {
            best = left;
            at = i;
        }
    }
    double x = log(low_s) + at * step;
    *scale_s = exp(x);
    *at_end = at == 0 || at == GRID - 1;
    gsl_min_fminimizer *m = gsl_min_fminimizer_alloc(gsl_min_fminimizer_brent);
    if (!m)
        return fault_set(fault, STATUS_NO_MEMORY, "no memory for a fit");
    gsl_function f = {left_at, s};
    /* Without a minimum between its neighbours (ends, exact data) the grid's own stands; GSL would
     * call its handler of errors. */
    if (!*at_end && left_at(x - step, s) > best && left_at(x + step, s) > best) {
        gsl_min_fminimizer_set(m, &f, x, x - step, x + step);
        for (int i = 0; i < ROUNDS; i++)
            if (gsl_min_fminimizer_iterate(m) != GSL_SUCCESS ||
                gsl_min_fminimizer_x_upper(m) - gsl_min_fminimizer_x_lower(m) < 1e-9)
                break;
        *scale_s = exp(gsl_min_fminimizer_x_minimum(m));
    }
    gsl_min_fminimizer_free(m);
    return STATUS_OK;
}

enum status relaxation_fit(const double *time_s, const double *length, size_t count,
                           struct relaxation_fit *out, struct fault *fault) {
    struct samples s = {time_s, length, count, rising};
    double scale_s = 0, left = 0, last_s = count > 0 ? time_s[count - 1] : 0;
    bool at_end = false;
    if (count < 5 || !(time_s[0] > 0 && last_s > time_s[0]))
        return fault_set(fault, STATUS_BAD_INPUT, "%zu samples to %g s are no relaxation", count,
                         last_s);
    enum status status = best_scale(&s, last_s / 100, last_s * 10, &scale_s, &at_end, fault);
    if (!status && at_end)
        status = fault_set(fault, STATUS_BAD_INPUT,
                           "no rate from .1 to 100 over %g s describes the relaxation", last_s);
    if (status)
        return status;
    out->plateau = best_height(&s, scale_s, &left);
    out->rate_per_s = 1 / scale_s;
    out->exponential_rms = sqrt(left / (double)count) / fabs(out->plateau);
    s.shape = rooted;
    status = best_scale(&s, time_s[0], last_s, &out->end_s, &at_end, fault);
    out->growth = best_height(&s, out->end_s, &left);
    out->root_rms = sqrt(left / (double)count) / fabs(out->plateau);
    return status;
}

double relaxation_exponential(const struct relaxation_fit *fit, double time_s) {
    return fit->plateau * rising(time_s, 1 / fit->rate_per_s);
}

double relaxation_root(const struct relaxation_fit *fit, double time_s) {
    return fit->growth * rooted(time_s, fit->end_s);
}
