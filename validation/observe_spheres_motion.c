/* observe_spheres_motion.c -- how far spheres go: self-diffusion and free kicked spheres.
 *
 * Unfolded positions are position + image times side along periodic axes.  The
 * mean-square displacement of a lag is averaged over spheres and over all pairs
 * of samples that far apart; along an axis it tends to 2 D t.
 *
 *     sphere-diffusion: D from the straight line through the lags of the window, and
 *     D + 2.837 T/(6 pi eta L) for the box (sphere_laws.h, Enskog's viscosity)
 *     sphere-displacement: mean square over one given lag, a component
 *
 * Source:     Einstein; Duenweg & Kremer, J. Chem. Phys. 99, 6983 (1993).
 * Leaves out: hard walls; boxes that are no cubes.
 * Checked by: suspension/verification-self-diffusion, -kicks;
 *             tests/unit/test_observe_spheres_motion.c.
 */
#include "validation/observe_spheres.h"
#include "validation/recipes.h"
#include "validation/sphere_laws.h"

#include <gsl/gsl_fit.h>
#include <math.h>
#include <stdlib.h>

enum { FROM_S, LAG_FROM_S, LAG_TO_S };
enum { DIFFUSION, UNBOUNDED, TEMPERATURE, FRACTION, CURVATURE };
enum { LAG_S = 1 };
enum { SQUARE, LAG, PAIRS };

struct paths {
    struct observe_spheres spheres;
    const struct series *x, *image;
    size_t first;  /* frame */
    double step_s; /* between samples */
};

static enum status load(struct run_view *v, double from_s, struct paths *p, struct fault *fault) {
    size_t last = 0;
    enum status status = observe_spheres(v, &p->spheres, fault);
    if (!status)
        status = observe_spheres_vectors(v, "position", &p->spheres, &p->x, fault);
    if (!status)
        status = observe_spheres_vectors(v, "image", &p->spheres, &p->image, fault);
    if (!status)
        status = observe_spheres_together(v, p->x, p->image, fault);
    if (!status)
        status = observe_spheres_window(v, p->x, from_s, 0, &p->first, &last, fault);
    if (status)
        return status;
    const bool *periodic = p->spheres.periodic;
    p->step_s = p->x->time[p->first + 1] - p->x->time[p->first];
    for (size_t f = p->first + 1; f <= last; f++)
        if (fabs(p->x->time[f] - p->x->time[f - 1] - p->step_s) > 1e-4 * p->step_s)
            return fault_set(fault, STATUS_BAD_INPUT, "%s: displacements need even samples",
                             run_view_path(v));
    if (!periodic[0] || !periodic[1] || !periodic[2])
        return fault_set(fault, STATUS_BAD_INPUT, "%s: displacements need a periodic box",
                         run_view_path(v));
    return STATUS_OK;
}

/* A component, mean over spheres, axes and the pairs of frames that far apart. */
static double mean_square(const struct paths *p, size_t lag) {
    double sum = 0;
    size_t pairs = p->x->frames - p->first - lag, n = p->spheres.count;
    for (size_t f = p->first; f + lag < p->x->frames; f++)
        for (size_t i = 0; i < n; i++)
            for (size_t a = 0; a < 3; a++) {
                double crossings = observe_spheres_at(p->image, f + lag, i)[a] -
                                   observe_spheres_at(p->image, f, i)[a];
                double way = observe_spheres_at(p->x, f + lag, i)[a] -
                             observe_spheres_at(p->x, f, i)[a] + crossings * p->spheres.box_m[a];
                sum += way * way;
            }
    return sum / ((double)pairs * (double)n * 3);
}

/* Of the sphere's velocities, as the energies of the samples have it. */
static enum status temperature(struct run_view *v, const struct paths *p, double *out,
                               struct fault *fault) {
    const struct series *energy;
    enum status status = observe_values(v, "observables/kinetic_energy", 1, &energy, fault);
    size_t first, last;
    if (!status)
        status = observe_spheres_window(v, energy, p->x->time[p->first], 0, &first, &last, fault);
    if (status)
        return status;
    double sum = 0;
    for (size_t f = first; f <= last; f++)
        sum += energy->value[f];
    *out = 2 * sum / (3 * (double)p->spheres.count * (double)(last - first + 1));
    return STATUS_OK;
}

/* Slope of y over lag times first .. last (in steps). */
static double slope(const double *y, size_t first, size_t last, double step_s) {
    double intercept, out, c00, c01, c11, sum;
    size_t n = last - first + 1;
    double *t = malloc(n * sizeof *t);
    if (!t)
        return NAN;
    for (size_t i = 0; i < n; i++)
        t[i] = (double)(first + i) * step_s;
    gsl_fit_linear(t, 1, y, 1, n, &intercept, &out, &c00, &c01, &c11, &sum);
    free(t);
    return out;
}

static enum status fit(const struct paths *p, const double *settings, struct measurement *out,
                       struct fault *fault) {
    size_t first = (size_t)lround(settings[LAG_FROM_S] / p->step_s);
    size_t last = (size_t)lround(settings[LAG_TO_S] / p->step_s);
    if (last < first + 3 || p->first + last >= p->x->frames)
        return fault_set(fault, STATUS_BAD_INPUT,
                         "lags from %g to %g s: at least four, no longer than the run, are needed",
                         settings[LAG_FROM_S], settings[LAG_TO_S]);
    size_t n = last - first + 1;
    double *y = malloc(2 * n * sizeof *y);
    if (!y)
        return fault_set(fault, STATUS_NO_MEMORY, "no memory for %zu lags", n);
    for (size_t i = 0; i < n; i++) {
        y[i] = mean_square(p, first + i);
        y[n + i] = (double)(first + i) * p->step_s;
    }
    size_t half = n / 2;
    double early = slope(y, first, first + half - 1, p->step_s);
    double late = slope(y + half, first + half, last, p->step_s);
    out->value[DIFFUSION] = slope(y, first, last, p->step_s) / 2;
    out->value[CURVATURE] = late / early - 1;
    enum status status =
        measurement_add_curve(out, "displacement", "mean-square displacement", y + n, y, n, fault);
    free(y);
    return status;
}

static enum status measure_diffusion(struct run_view *v, const double *settings,
                                     struct measurement *out, struct fault *fault) {
    struct paths p = {0};
    double kinetic = 0;
    enum status status = load(v, settings[FROM_S], &p, fault);
    if (!status)
        status = temperature(v, &p, &kinetic, fault);
    if (!status)
        status = fit(&p, settings, out, fault);
    if (status)
        return status;
    const struct observe_spheres *b = &p.spheres;
    struct spheres_gas g = {b->packing_fraction, kinetic, b->radius_m, b->mass_kg};
    out->value[TEMPERATURE] = kinetic;
    out->value[FRACTION] = b->packing_fraction;
    if (fabs(b->box_m[0] / b->box_m[2] - 1) > 1e-9 || fabs(b->box_m[1] / b->box_m[2] - 1) > 1e-9)
        observe_none(out, UNBOUNDED, "the correction for the box is that of a cube");
    else
        out->value[UNBOUNDED] = out->value[DIFFUSION] + spheres_box_correction(&g, b->box_m[0]);
    return STATUS_OK;
}

static enum status measure_displacement(struct run_view *v, const double *settings,
                                        struct measurement *out, struct fault *fault) {
    struct paths p = {0};
    enum status status = load(v, settings[FROM_S], &p, fault);
    if (status)
        return status;
    size_t lag = (size_t)lround(settings[LAG_S] / p.step_s);
    if (!lag || p.first + lag >= p.x->frames ||
        fabs((double)lag * p.step_s - settings[LAG_S]) > 1e-3 * p.step_s)
        return fault_set(fault, STATUS_BAD_INPUT, "%s: no two samples from %g s on are %g s apart",
                         run_view_path(v), settings[FROM_S], settings[LAG_S]);
    out->value[SQUARE] = mean_square(&p, lag);
    out->value[LAG] = (double)lag * p.step_s;
    out->value[PAIRS] = (double)(p.x->frames - p.first - lag);
    return STATUS_OK;
}

static const char *const DATASETS[] = {"particles/spheres/position", "particles/spheres/image",
                                       "observables/kinetic_energy", NULL};
static const char *const CURVES[] = {"displacement", NULL};

const struct recipe recipe_sphere_diffusion = {
    .name = "sphere-diffusion",
    .title = "Self-diffusion of spheres in a periodic cube",
    .source = "Duenweg & Kremer, J. Chem. Phys. 99, 6983 (1993)",
    .datasets = DATASETS,
    .setting = {{"from_s", "s", "samples before are left out", 0, 0, 1e9},
                {"lag_from_s", "s", "shortest lag of the fit", 0.1, 0, 1e9},
                {"lag_to_s", "s", "longest lag of the fit", 0.5, 0, 1e9}},
    .output = {{"diffusion", "m^2/s", "half the slope of the mean-square displacement"},
               {"unbounded", "m^2/s", "corrected for the box"},
               {"temperature", "J", "mean of the samples"},
               {"packing_fraction", "1", "of the whole box"},
               {"curvature", "1", "slope of the later half of the lags over the earlier's, - 1"}},
    .curves = CURVES,
    .measure = measure_diffusion,
};

const struct recipe recipe_sphere_displacement = {
    .name = "sphere-displacement",
    .title = "Mean-square displacement over a lag",
    .source = "Ornstein & Uhlenbeck, Phys. Rev. 36, 823 (1930)",
    .datasets =
        (const char *const[]){"particles/spheres/position", "particles/spheres/image", NULL},
    .setting = {{"from_s", "s", "samples before are left out", 0, 0, 1e9},
                {"lag_s", "s", "the lag", 0.1, 0, 1e9}},
    .output = {{"square", "m^2", "mean-square displacement, a component"},
               {"lag", "s", "the lag"},
               {"pairs", "1", "pairs of samples averaged"}},
    .measure = measure_displacement,
};
