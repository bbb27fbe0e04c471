/* interface_fit.c -- see interface_fit.h. */
#include "validation/interface_fit.h"

#include <gsl/gsl_blas.h>
#include <gsl/gsl_multifit_nlinear.h>
#include <math.h>

enum { HEIGHT, WIDTH, PLATEAU, FREE_MAX };
enum { HEIGHTS_MIN = 8, ROUNDS_MAX = 200 };
static const double SMOOTH_R = 2; /* for first guesses */

struct data {
    const double *z, *phi; /* [0 .. count-1] of the window (R, 1) */
    size_t count;
    double grid_R;  /* from one height to the next */
    double plateau; /* where it is fixed */
    bool plateau_free;
};

static double plateau_of(const gsl_vector *x, const struct data *d) {
    return d->plateau_free ? gsl_vector_get(x, PLATEAU) : d->plateau;
}

static int residuals(const gsl_vector *x, void *context, gsl_vector *out) {
    const struct data *d = context;
    double h = gsl_vector_get(x, HEIGHT), sigma = gsl_vector_get(x, WIDTH), p = plateau_of(x, d);
    for (size_t i = 0; i < d->count; i++)
        gsl_vector_set(out, i, p / 2 * erfc((d->z[i] - h) / (M_SQRT2 * sigma)) - d->phi[i]);
    return GSL_SUCCESS;
}

/* d/du erfc(u) = -2 exp(-u^2)/sqrt(pi). */
static int slopes(const gsl_vector *x, void *context, gsl_matrix *out) {
    const struct data *d = context;
    double h = gsl_vector_get(x, HEIGHT), sigma = gsl_vector_get(x, WIDTH), p = plateau_of(x, d);
    for (size_t i = 0; i < d->count; i++) {
        double u = (d->z[i] - h) / (M_SQRT2 * sigma), bell = p * exp(-u * u) / sqrt(M_PI);
        gsl_matrix_set(out, i, HEIGHT, bell / (M_SQRT2 * sigma));
        gsl_matrix_set(out, i, WIDTH, bell * u / sigma);
        if (d->plateau_free)
            gsl_matrix_set(out, i, PLATEAU, erfc(u) / 2);
    }
    return GSL_SUCCESS;
}

/* Mean over SMOOTH_R around height i: the noise of single slabs is no edge. */
static double level(const struct data *d, size_t i) {
    size_t reach = (size_t)fmax(0, round(SMOOTH_R / 2 / d->grid_R));
    size_t first = i > reach ? i - reach : 0,
           last = i + reach < d->count ? i + reach : d->count - 1;
    double sum = 0;
    for (size_t k = first; k <= last; k++)
        sum += d->phi[k];
    return sum / (double)(last - first + 1);
}

/* Highest z, from the top down, below which the smoothed profile exceeds a level; NAN: nowhere. */
static double crossing(const struct data *d, double wanted) {
    double above = level(d, d->count - 1);
    for (size_t i = d->count - 1; i-- > 0;) {
        double below = level(d, i);
        if (below > wanted && above <= wanted)
            return d->z[i] + (d->z[i + 1] - d->z[i]) * (below - wanted) / (below - above);
        above = below;
    }
    return NAN;
}

/* An error function falls from .9 to .1 of its plateau over 2.563 sigma. */
static enum status guess(const struct data *d, double x[FREE_MAX], struct fault *fault) {
    double low = crossing(d, 0.1 * d->plateau), high = crossing(d, 0.9 * d->plateau);
    x[HEIGHT] = crossing(d, 0.5 * d->plateau);
    if (isnan(x[HEIGHT]))
        return fault_set(fault, STATUS_BAD_INPUT,
                         "the profile does not cross half of %g from %g to %g R", d->plateau,
                         d->z[0], d->z[d->count - 1]);
    x[WIDTH] = low > high ? fmax((low - high) / 2.563, d->grid_R) : 2 * d->grid_R;
    x[PLATEAU] = d->plateau;
    return STATUS_OK;
}

static double mean_square(const struct data *d, const struct interface_fit *fit, double from_R,
                          double to_R) {
    double sum = 0, n = 0;
    for (size_t i = 0; i < d->count; i++)
        if (d->z[i] >= from_R && d->z[i] <= to_R) {
            sum += pow(d->phi[i] - interface_fit_at(fit, d->z[i]), 2);
            n++;
        }
    return n > 0 ? sum / n : NAN;
}

static void take(const gsl_multifit_nlinear_workspace *w, const struct data *d,
                 struct interface_fit *out, gsl_matrix *covariance) {
    const gsl_vector *x = gsl_multifit_nlinear_position(w);
    *out = (struct interface_fit){.sigma_R = fabs(gsl_vector_get(x, WIDTH)),
                                  .height_R = gsl_vector_get(x, HEIGHT),
                                  .plateau = plateau_of(x, d),
                                  .used = d->count};
    double sum = mean_square(d, out, -INFINITY, INFINITY) * (double)d->count;
    double scatter = sum / (double)(d->count - x->size);
    gsl_multifit_nlinear_covar(gsl_multifit_nlinear_jac(w), 0, covariance);
    out->height_error_R = sqrt(scatter * gsl_matrix_get(covariance, HEIGHT, HEIGHT));
    out->sigma_error_R = sqrt(scatter * gsl_matrix_get(covariance, WIDTH, WIDTH));
    if (d->plateau_free)
        out->plateau_error = sqrt(scatter * gsl_matrix_get(covariance, PLATEAU, PLATEAU));
    out->rms = sqrt(sum / (double)d->count);
}

/* The nearest minimum; *converged says whether it was reached. */
static enum status solve(struct data *d, const double *start, struct interface_fit *out,
                         bool *converged, struct fault *fault) {
    size_t unknowns = d->plateau_free ? FREE_MAX : PLATEAU;
    gsl_multifit_nlinear_fdf system = {
        .f = residuals, .df = slopes, .n = d->count, .p = unknowns, .params = d};
    gsl_multifit_nlinear_parameters how = gsl_multifit_nlinear_default_parameters();
    gsl_multifit_nlinear_workspace *w =
        gsl_multifit_nlinear_alloc(gsl_multifit_nlinear_trust, &how, d->count, unknowns);
    gsl_matrix *covariance = gsl_matrix_alloc(unknowns, unknowns);
    enum status status = STATUS_OK;
    int info = 0;
    if (!w || !covariance) {
        status = fault_set(fault, STATUS_NO_MEMORY, "no memory to fit %zu heights", d->count);
        goto done;
    }
    gsl_vector_const_view x = gsl_vector_const_view_array(start, unknowns);
    gsl_multifit_nlinear_init(&x.vector, &system, w);
    int end = gsl_multifit_nlinear_driver(ROUNDS_MAX, 1e-10, 1e-12, 0, NULL, NULL, &info, w);
    take(w, d, out, covariance);
    *converged = (end == GSL_SUCCESS || end == GSL_ENOPROG) && isfinite(out->sigma_error_R);
done:
    gsl_matrix_free(covariance);
    gsl_multifit_nlinear_free(w);
    return status;
}

/* The best step: its plateau below, nothing above.  Each place between two heights is tried. */
static void step(const struct data *d, struct interface_fit *out) {
    double above = 0, square = 0, below = 0, least = INFINITY; /* sums of phi^2, phi^2, phi */
    double half_slab = d->grid_R / sqrt(12);
    for (size_t i = 0; i < d->count; i++)
        above += d->phi[i] * d->phi[i];
    for (size_t i = 1; i < d->count; i++) {
        below += d->phi[i - 1];
        square += d->phi[i - 1] * d->phi[i - 1];
        above -= d->phi[i - 1] * d->phi[i - 1];
        double n = (double)i, p = d->plateau_free ? below / n : d->plateau;
        double sum = square - 2 * p * below + n * p * p + above;
        if (sum < least) {
            least = sum;
            *out = (struct interface_fit){.height_R = (d->z[i - 1] + d->z[i]) / 2, .plateau = p};
        }
    }
    out->sharp = true;
    out->used = d->count;
    out->height_error_R = out->sigma_error_R = half_slab;
    out->rms = sqrt(mean_square(d, out, -INFINITY, INFINITY));
}

/* Sums of squares that differ by less than 2 standard errors of one unknown are not told apart. */
static bool told_apart(double less_rms, double more_rms, size_t count) {
    double n = (double)count, scatter = more_rms * more_rms * n / (n - 2);
    return n * (more_rms * more_rms - less_rms * less_rms) > 4 * scatter;
}

/* A noisy profile may have several minima, one of them a step: a few starts, and the least; the
 * step only where it is better than any width that can be told apart from none. */
static enum status least(struct data *d, const double *start, struct interface_fit *out,
                         struct fault *fault) {
    static const double wider[] = {1, 0.25, 4, 2, 0.5};
    struct interface_fit best = {.rms = INFINITY};
    bool settled = true;
    for (size_t i = 0; i < sizeof wider / sizeof *wider; i++) {
        double x[] = {start[HEIGHT], start[WIDTH] * wider[i], start[PLATEAU]};
        struct interface_fit fit = {0};
        bool converged = false;
        enum status status = solve(d, x, &fit, &converged, fault);
        if (status)
            return status;
        if (!(fit.rms < best.rms) || fit.sigma_R < d->grid_R / sqrt(12))
            continue;
        best = fit;
        settled = converged;
    }
    step(d, out);
    if (best.used > 0 && (best.rms <= out->rms || !told_apart(out->rms, best.rms, d->count)))
        *out = best;
    else
        settled = true;
    if (!settled)
        return fault_set(
            fault, STATUS_NUMERICAL,
            "the fit of an interface does not settle: %g R wide at %g R after %d rounds",
            out->sigma_R, out->height_R, (int)ROUNDS_MAX);
    if (!(out->height_R > d->z[0] && out->height_R < d->z[d->count - 1]))
        return fault_set(fault, STATUS_BAD_INPUT,
                         "no interface from %g to %g R: the fit's is at %g R", d->z[0],
                         d->z[d->count - 1], out->height_R);
    out->shoulder_rms =
        sqrt(mean_square(d, out, out->height_R - 4 * out->sigma_R, out->height_R - out->sigma_R));
    return STATUS_OK;
}

enum status interface_fit(const double *height_R, const double *fraction, size_t count,
                          const struct interface_window *window, struct interface_fit *out,
                          struct fault *fault) {
    size_t first = 0;
    while (first < count && height_R[first] < window->above_R)
        first++;
    struct data d = {.z = height_R + first,
                     .phi = fraction + first,
                     .count = count - first,
                     .plateau = window->phibar,
                     .plateau_free = window->plateau_free};
    double start[FREE_MAX] = {0};
    *out = (struct interface_fit){0};
    if (d.count < HEIGHTS_MIN)
        return fault_set(fault, STATUS_BAD_INPUT, "%zu heights above %g R: an interface needs %d",
                         d.count, window->above_R, (int)HEIGHTS_MIN);
    d.grid_R = d.z[1] - d.z[0];
    enum status status = guess(&d, start, fault);
    if (!status)
        status = least(&d, start, out, fault);
    return status;
}

double interface_fit_at(const struct interface_fit *fit, double height_R) {
    if (fit->sharp)
        return height_R < fit->height_R ? fit->plateau : 0;
    return fit->plateau / 2 * erfc((height_R - fit->height_R) / (M_SQRT2 * fit->sigma_R));
}
