/* interface_fit.c -- see interface_fit.h. */
#include "validation/interface_fit.h"

#include <gsl/gsl_blas.h>
#include <gsl/gsl_multifit_nlinear.h>
#include <math.h>

enum { HEIGHT, WIDTH, PLATEAU, FREE_MAX };
enum { HEIGHTS_MIN = 8, ROUNDS_MAX = 200 };

struct data {
    const double *z, *phi; /* [0 .. count-1] of the window (R, 1) */
    size_t count;
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

/* Highest z, from the top down, below which the profile exceeds a level; NAN: nowhere. */
static double crossing(const struct data *d, double level) {
    for (size_t i = d->count - 1; i-- > 0;)
        if (d->phi[i] > level && d->phi[i + 1] <= level)
            return d->z[i] +
                   (d->z[i + 1] - d->z[i]) * (d->phi[i] - level) / (d->phi[i] - d->phi[i + 1]);
    return NAN;
}

/* An error function falls from .84 to .16 of its plateau over two sigma. */
static enum status guess(const struct data *d, double x[FREE_MAX], struct fault *fault) {
    double low = crossing(d, 0.16 * d->plateau), high = crossing(d, 0.84 * d->plateau);
    x[HEIGHT] = crossing(d, 0.5 * d->plateau);
    if (isnan(x[HEIGHT]))
        return fault_set(fault, STATUS_BAD_INPUT,
                         "the profile does not cross half of %g from %g to %g R", d->plateau,
                         d->z[0], d->z[d->count - 1]);
    double grid = d->z[1] - d->z[0];
    x[WIDTH] = low > high ? fmax((low - high) / 2, grid) : 2 * grid;
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
    out->shoulder_rms =
        sqrt(mean_square(d, out, out->height_R - 4 * out->sigma_R, out->height_R - out->sigma_R));
}

static enum status solve(struct data *d, double *start, struct interface_fit *out,
                         struct fault *fault) {
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
    if ((end != GSL_SUCCESS && end != GSL_ENOPROG) || !isfinite(out->sigma_R + out->height_R))
        status =
            fault_set(fault, STATUS_NUMERICAL, "the fit of an interface: %s", gsl_strerror(end));
done:
    gsl_matrix_free(covariance);
    gsl_multifit_nlinear_free(w);
    return status;
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
    double start[FREE_MAX];
    *out = (struct interface_fit){0};
    if (d.count < HEIGHTS_MIN)
        return fault_set(fault, STATUS_BAD_INPUT, "%zu heights above %g R: an interface needs %d",
                         d.count, window->above_R, (int)HEIGHTS_MIN);
    enum status status = guess(&d, start, fault);
    if (!status)
        status = solve(&d, start, out, fault);
    return status;
}

double interface_fit_at(const struct interface_fit *fit, double height_R) {
    return fit->plateau / 2 * erfc((height_R - fit->height_R) / (M_SQRT2 * fit->sigma_R));
}
