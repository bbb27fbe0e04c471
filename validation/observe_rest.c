/* observe_rest.c -- inside a bed at rest: temperature over height, velocities, diffusion across.
 *
 * bed-temperature: horizontal and vertical temperature about each slab's mean velocity, over T of
 * the parameters, averaged over a window of time with a slab's spheres less one as weights.  Bulk:
 * the middle fifth of N V/(Wx Wy phibar); surface: within one sigma of the fitted height; spray:
 * from one to three sigma above it.  Curves: both over height.
 *
 * bed-velocities: of the spheres of the bulk, by component, about the mean of each sample: excess
 * kurtosis averaged over samples, and the last sample's distance from a normal distribution of its
 * own width (normality.h).  x and y count as one sample.  Curve: how many are as fast as so many
 * root mean squares, over what a normal distribution has, all samples together.
 *
 * bed-diffusion: mean-square displacement along x and y of spheres that are in the bulk when
 * the lag begins, over all pairs of samples a lag apart; D is half the slope over the lags.
 *
 * Source:     Fiege & Zippelius, Section V: temperature profile, velocity distributions and
 *             mean-square displacements are its outlook.
 * Leaves out: hard sides for the displacement, which ends at the width of such a box.
 * Checked by: suspension/bed-at-rest; tests/unit/test_observe_rest.c.
 */
#include "validation/bed_rest.h"
#include "validation/normality.h"
#include "validation/recipes.h"
#include "validation/sphere_profile.h"

#include <gsl/gsl_cdf.h>
#include <gsl/gsl_fit.h>
#include <math.h>
#include <stdlib.h>

enum { FROM_S, TO_S, LAG_FROM_S, LAG_TO_S };
enum {
    BULK_XY,
    BULK_ZZ,
    SURFACE_XY,
    SURFACE_ZZ,
    SPRAY_XY,
    SPRAY_ZZ,
    SURFACE_FRACTION,
    SPRAY_FRACTION
};
enum { KURTOSIS_XY, KURTOSIS_Z, DISTANCE_XY, DISTANCE_Z, PROBABILITY_XY, PROBABILITY_Z, USED };
enum { DIFFUSION, TEMPERATURE, FRACTION, CURVATURE, PATHS };

struct bed {
    struct observe_spheres spheres;
    double phibar, target_J; /* T of the parameters */
    double low_m, high_m;    /* the bulk */
};

static enum status open_bed(struct run_view *v, struct bed *b, struct fault *fault) {
    double gamma, scale = 0, input[BED_INPUTS] = {0};
    enum status status = observe_spheres(v, &b->spheres, fault);
    if (!status)
        status = observe_spheres_drag(v, &gamma, fault); /* refuses a phibar that changes */
    if (!status)
        status = run_view_parameter(v, "phibar", &b->phibar, fault);
    if (!status)
        status = run_view_parameter(v, "temperature_scale", &scale, fault);
    if (status)
        return status;
    const struct observe_spheres *s = &b->spheres;
    input[BED_PHIBAR] = b->phibar;
    input[BED_PARTICLES] = (double)s->count;
    input[BED_WIDTH_X_R] = s->box_m[0] / s->radius_m;
    input[BED_WIDTH_Y_R] = s->box_m[1] / s->radius_m;
    bed_rest_bulk(input, &b->low_m, &b->high_m);
    b->low_m *= s->radius_m;
    b->high_m *= s->radius_m;
    b->target_J = scale * s->thermal_energy_J;
    return STATUS_OK;
}

static bool in_bulk(const struct bed *b, const double *position) {
    return position[2] >= b->low_m && position[2] <= b->high_m;
}

/* -- bed-temperature ------------------------------------------------------------------ */

struct heat {
    struct sphere_profile fraction, t[2]; /* xy, zz */
    struct interface_fit edge;
    size_t first, last;
};

static enum status open_heat(struct run_view *v, const struct bed *b, const double *settings,
                             struct heat *h, struct fault *fault) {
    enum status status =
        sphere_profile_open(v, "packing_fraction", &b->spheres, &h->fraction, fault);
    if (!status)
        status = sphere_profile_open(v, "temperature_xy", &b->spheres, &h->t[0], fault);
    if (!status)
        status = sphere_profile_open(v, "temperature_zz", &b->spheres, &h->t[1], fault);
    if (!status)
        status = observe_spheres_window(v, h->fraction.series, settings[FROM_S], settings[TO_S],
                                        &h->first, &h->last, fault);
    if (status)
        return status;
    double *mean = malloc(h->fraction.bins * sizeof *mean);
    if (!mean)
        return fault_set(fault, STATUS_NO_MEMORY, "no memory for a profile");
    struct interface_window window = {.above_R = 10, .phibar = b->phibar};
    sphere_profile_mean(&h->fraction, h->first, h->last, mean);
    status = interface_fit(h->fraction.height_R, mean, h->fraction.bins, &window, &h->edge, fault);
    free(mean);
    return status;
}

/* Slabs where fewer than two spheres are found on average are left out. */
static enum status heat_curves(const struct bed *b, const struct heat *h, struct measurement *out,
                               struct fault *fault) {
    static const char *const name[] = {"temperature-xy", "temperature-zz"};
    static const char *const label[] = {"horizontal", "vertical"};
    size_t bins = h->fraction.bins;
    double *z = malloc(2 * bins * sizeof *z), *y = z + bins;
    if (!z)
        return fault_set(fault, STATUS_NO_MEMORY, "no memory for a profile");
    enum status status = STATUS_OK;
    for (size_t a = 0; a < 2 && !status; a++) {
        size_t n = 0;
        for (size_t k = 0; k < bins; k++) {
            double middle = h->fraction.height_R[k], half = h->fraction.bin_R / 4;
            double phi = sphere_profile_level(&h->fraction, NULL, h->first, h->last, middle - half,
                                              middle + half);
            if (phi * h->fraction.spheres < 2)
                continue;
            z[n] = middle;
            y[n++] = sphere_profile_level(&h->t[a], &h->fraction, h->first, h->last, middle - half,
                                          middle + half) /
                     b->target_J;
        }
        status = measurement_add_curve(out, name[a], label[a], z, y, n, fault);
    }
    free(z);
    return status;
}

static enum status measure_temperature(struct run_view *v, const double *settings,
                                       struct measurement *out, struct fault *fault) {
    struct bed b = {0};
    struct heat h = {0};
    enum status status = open_bed(v, &b, fault);
    if (!status)
        status = open_heat(v, &b, settings, &h, fault);
    if (!status) {
        double r = b.spheres.radius_m, top = h.edge.height_R, sigma = h.edge.sigma_R;
        double low[] = {b.low_m / r, top - sigma, top + sigma};
        double high[] = {b.high_m / r, top + sigma, top + 3 * sigma};
        for (size_t i = 0; i < 3; i++)
            for (size_t a = 0; a < 2; a++)
                out->value[2 * i + a] =
                    sphere_profile_level(&h.t[a], &h.fraction, h.first, h.last, low[i], high[i]) /
                    b.target_J;
        for (size_t i = 1; i < 3; i++)
            out->value[SURFACE_FRACTION + i - 1] =
                sphere_profile_level(&h.fraction, &h.fraction, h.first, h.last, low[i], high[i]);
        for (size_t i = 0; i <= SPRAY_FRACTION; i++)
            if (isnan(out->value[i]))
                observe_none(out, i, "no two spheres in a slab there");
        status = heat_curves(&b, &h, out, fault);
    }
    sphere_profile_close(&h.fraction);
    sphere_profile_close(&h.t[0]);
    sphere_profile_close(&h.t[1]);
    return status;
}

/* -- bed-velocities -------------------------------------------------------------------- */

/* Components first_axis .. last_axis of the bulk's spheres about their means: u[0 .. n-1]. */
static size_t take(const struct bed *b, const struct series *x, const struct series *u,
                   size_t frame, size_t first_axis, size_t last_axis, double *out) {
    size_t n = 0;
    for (size_t a = first_axis; a <= last_axis; a++) {
        size_t start = n;
        double mean = 0;
        for (size_t i = 0; i < b->spheres.count; i++)
            if (in_bulk(b, observe_spheres_at(x, frame, i))) {
                out[n] = observe_spheres_at(u, frame, i)[a];
                mean += out[n++];
            }
        for (size_t i = start; i < n; i++)
            out[i] -= mean / (double)(n - start);
    }
    return n;
}

static double variance_of(const double *u, size_t n, double *kurtosis) {
    double second = 0, fourth = 0;
    for (size_t i = 0; i < n; i++) {
        second += u[i] * u[i] / (double)n;
        fourth += pow(u[i], 4) / (double)n;
    }
    *kurtosis = fourth / (second * second) - 3;
    return second;
}

/* Numbers of |u| in bins of BIN root mean squares: in[0 .. BINS-1], and all of them. */
enum { BINS = 16 };
static const double BIN = 0.25;
struct histogram {
    double in[BINS], all;
};

static void count(struct histogram *h, const double *u, size_t n, double second) {
    h->all += (double)n;
    for (size_t i = 0; i < n; i++) {
        double bin = fabs(u[i]) / sqrt(second) / BIN;
        if (bin < BINS)
            h->in[(size_t)bin]++;
    }
}

static enum status distribution(const struct histogram *h, const char *label,
                                struct measurement *out, struct fault *fault) {
    double x[BINS], y[BINS];
    for (size_t k = 0; k < BINS; k++) {
        double low = (double)k * BIN;
        x[k] = low + BIN / 2;
        y[k] =
            h->in[k] / h->all / (2 * (gsl_cdf_ugaussian_Q(low) - gsl_cdf_ugaussian_Q(low + BIN)));
    }
    return measurement_add_curve(out, "distribution", label, x, y, BINS, fault);
}

static enum status measure_velocities(struct run_view *v, const double *settings,
                                      struct measurement *out, struct fault *fault) {
    static const size_t axis[2][2] = {{0, 1}, {2, 2}};
    struct histogram speeds[2] = {{{0}, 0}, {{0}, 0}};
    struct bed b = {0};
    const struct series *x, *u;
    size_t first = 0, last = 0;
    enum status status = open_bed(v, &b, fault);
    if (!status)
        status = observe_spheres_vectors(v, "position", &b.spheres, &x, fault);
    if (!status)
        status = observe_spheres_vectors(v, "velocity", &b.spheres, &u, fault);
    if (!status)
        status = observe_spheres_together(v, x, u, fault);
    if (!status)
        status =
            observe_spheres_window(v, x, settings[FROM_S], settings[TO_S], &first, &last, fault);
    if (status)
        return status;
    double *sample = malloc(2 * b.spheres.count * sizeof *sample);
    if (!sample)
        return fault_set(fault, STATUS_NO_MEMORY, "no memory for velocities");
    for (size_t c = 0; c < 2; c++)
        for (size_t f = first; f <= last; f++) {
            double kurtosis;
            size_t n = take(&b, x, u, f, axis[c][0], axis[c][1], sample);
            double second = variance_of(sample, n, &kurtosis);
            out->value[KURTOSIS_XY + c] += kurtosis / (double)(last - first + 1);
            count(&speeds[c], sample, n, second);
            if (f < last)
                continue;
            out->value[DISTANCE_XY + c] = normality_distance(sample, n, sqrt(second));
            out->value[PROBABILITY_XY + c] = normality_probability(out->value[DISTANCE_XY + c], n);
            out->value[USED] = (double)n;
        }
    free(sample);
    if (!(out->value[USED] >= 100))
        return fault_set(fault, STATUS_BAD_INPUT, "%s: %g spheres in the bulk are too few",
                         run_view_path(v), out->value[USED]);
    status = distribution(&speeds[0], "across", out, fault);
    return status ? status : distribution(&speeds[1], "upwards", out, fault);
}

/* -- bed-diffusion ---------------------------------------------------------------------- */

struct paths {
    struct bed bed;
    const struct series *x, *image;
    size_t first, last;
    double step_s;
};

static enum status open_paths(struct run_view *v, const double *settings, struct paths *p,
                              struct fault *fault) {
    enum status status = open_bed(v, &p->bed, fault);
    if (!status)
        status = observe_spheres_vectors(v, "position", &p->bed.spheres, &p->x, fault);
    if (!status)
        status = observe_spheres_vectors(v, "image", &p->bed.spheres, &p->image, fault);
    if (!status)
        status = observe_spheres_together(v, p->x, p->image, fault);
    if (!status)
        status = observe_spheres_window(v, p->x, settings[FROM_S], settings[TO_S], &p->first,
                                        &p->last, fault);
    if (status)
        return status;
    p->step_s = p->x->time[p->first + 1] - p->x->time[p->first];
    for (size_t f = p->first + 1; f <= p->last; f++)
        if (fabs(p->x->time[f] - p->x->time[f - 1] - p->step_s) > 1e-4 * p->step_s)
            return fault_set(fault, STATUS_BAD_INPUT, "%s: displacements need even samples",
                             run_view_path(v));
    if (!p->bed.spheres.periodic[0] || !p->bed.spheres.periodic[1])
        return fault_set(fault, STATUS_BAD_INPUT, "%s: displacements need periodic sides",
                         run_view_path(v));
    return STATUS_OK;
}

/* A component, mean over x and y, spheres of the bulk and pairs of frames that far apart. */
static double mean_square(const struct paths *p, size_t lag, double *paths) {
    double sum = 0;
    *paths = 0;
    for (size_t f = p->first; f + lag <= p->last; f++)
        for (size_t i = 0; i < p->bed.spheres.count; i++) {
            const double *here = observe_spheres_at(p->x, f, i);
            const double *there = observe_spheres_at(p->x, f + lag, i);
            if (!in_bulk(&p->bed, here))
                continue;
            for (size_t a = 0; a < 2; a++) {
                double crossings = observe_spheres_at(p->image, f + lag, i)[a] -
                                   observe_spheres_at(p->image, f, i)[a];
                double way = there[a] - here[a] + crossings * p->bed.spheres.box_m[a];
                sum += way * way / 2;
            }
            ++*paths;
        }
    return *paths > 0 ? sum / *paths : NAN;
}

static double slope(const double *t, const double *y, size_t n) {
    double start, out, c00, c01, c11, sum;
    gsl_fit_linear(t, 1, y, 1, n, &start, &out, &c00, &c01, &c11, &sum);
    return out;
}

static enum status fit_paths(const struct paths *p, const double *settings, struct measurement *out,
                             struct fault *fault) {
    size_t first = (size_t)fmax(1, round(settings[LAG_FROM_S] / p->step_s));
    size_t last = (size_t)round(settings[LAG_TO_S] / p->step_s), n = last - first + 1;
    if (last < first + 3 || p->first + last > p->last)
        return fault_set(
            fault, STATUS_BAD_INPUT,
            "lags from %g to %g s: at least four, no longer than the window, are needed",
            settings[LAG_FROM_S], settings[LAG_TO_S]);
    double *t = malloc(2 * (last + 1) * sizeof *t), *y = t + last + 1;
    if (!t)
        return fault_set(fault, STATUS_NO_MEMORY, "no memory for %zu lags", last);
    for (size_t lag = 0; lag <= last; lag++) {
        t[lag] = (double)lag * p->step_s;
        y[lag] = mean_square(p, lag, &out->value[PATHS]);
    }
    out->value[DIFFUSION] = slope(t + first, y + first, n) / 2;
    out->value[CURVATURE] = slope(t + first + n / 2, y + first + n / 2, n - n / 2) /
                                slope(t + first, y + first, n / 2) -
                            1;
    enum status status = measurement_add_curve(out, "displacement", "mean-square displacement", t,
                                               y, last + 1, fault);
    free(t);
    return status;
}

static enum status measure_diffusion(struct run_view *v, const double *settings,
                                     struct measurement *out, struct fault *fault) {
    struct paths p = {0};
    const struct series *u;
    double kurtosis, count = 0;
    enum status status = open_paths(v, settings, &p, fault);
    if (!status)
        status = observe_spheres_vectors(v, "velocity", &p.bed.spheres, &u, fault);
    if (!status)
        status = observe_spheres_together(v, p.x, u, fault);
    if (!status)
        status = fit_paths(&p, settings, out, fault);
    double *sample = status ? NULL : malloc(2 * p.bed.spheres.count * sizeof *sample);
    if (!status && !sample)
        status = fault_set(fault, STATUS_NO_MEMORY, "no memory for velocities");
    for (size_t f = p.first; f <= p.last && !status; f++) {
        size_t n = take(&p.bed, p.x, u, f, 0, 1, sample);
        out->value[TEMPERATURE] += p.bed.spheres.mass_kg * variance_of(sample, n, &kurtosis) /
                                   (double)(p.last - p.first + 1);
        count += (double)n / 2 / (double)(p.last - p.first + 1);
    }
    const struct observe_spheres *s = &p.bed.spheres;
    if (!status)
        out->value[FRACTION] = count * 4 * M_PI / 3 * pow(s->radius_m, 3) /
                               (s->box_m[0] * s->box_m[1] * (p.bed.high_m - p.bed.low_m));
    free(sample);
    return status;
}

static const char *const TEMPERATURE_DATASETS[] = {
    "profiles/packing_fraction", "profiles/temperature_xy", "profiles/temperature_zz", NULL};
static const char *const TEMPERATURE_CURVES[] = {"temperature-xy", "temperature-zz", NULL};
static const char *const VELOCITY_CURVES[] = {"distribution", NULL};
static const char *const VELOCITY_DATASETS[] = {"particles/spheres/position",
                                                "particles/spheres/velocity", NULL};
static const char *const DIFFUSION_DATASETS[] = {
    "particles/spheres/position", "particles/spheres/velocity", "particles/spheres/image", NULL};
static const char *const DIFFUSION_CURVES[] = {"displacement", NULL};

const struct recipe recipe_bed_temperature = {
    .name = "bed-temperature",
    .title = "Temperature over height of a bed at rest",
    .source = "Fiege & Zippelius, Section V",
    .datasets = TEMPERATURE_DATASETS,
    .setting = {{"from_s", "s", "samples before are left out", 0, 0, 1e9},
                {"to_s", "s", "samples after are left out; 0: none", 0, 0, 1e9}},
    .output = {{"bulk_xy", "T", "horizontal, of the middle fifth"},
               {"bulk_zz", "T", "vertical, of the middle fifth"},
               {"surface_xy", "T", "horizontal, within sigma of the interface"},
               {"surface_zz", "T", "vertical, within sigma of the interface"},
               {"spray_xy", "T", "horizontal, one to three sigma above it"},
               {"spray_zz", "T", "vertical, one to three sigma above it"},
               {"surface_fraction", "1", "packing fraction that surface spheres are at"},
               {"spray_fraction", "1", "packing fraction that spray spheres are at"}},
    .curves = TEMPERATURE_CURVES,
    .measure = measure_temperature,
};

const struct recipe recipe_bed_velocities = {
    .name = "bed-velocities",
    .title = "Distribution of velocities in the bulk of a bed, by component",
    .source = "Fiege & Zippelius, Section V",
    .datasets = VELOCITY_DATASETS,
    .setting = {{"from_s", "s", "samples before are left out", 0, 0, 1e9},
                {"to_s", "s", "samples after are left out; 0: none", 0, 0, 1e9}},
    .output = {{"kurtosis_xy", "1", "excess, of x and y, mean over samples"},
               {"kurtosis_z", "1", "excess, of z, mean over samples"},
               {"distance_xy", "1", "Kolmogorov and Smirnov's D of the last sample, x and y"},
               {"distance_z", "1", "the same of z"},
               {"probability_xy", "1", "of a D as large or larger"},
               {"probability_z", "1", "of a D as large or larger"},
               {"spheres", "1", "spheres of the bulk in the last sample"}},
    .curves = VELOCITY_CURVES,
    .measure = measure_velocities,
};

const struct recipe recipe_bed_diffusion = {
    .name = "bed-diffusion",
    .title = "Diffusion across the bulk of a bed",
    .source = "Fiege & Zippelius, Section V; Einstein",
    .datasets = DIFFUSION_DATASETS,
    .setting = {{"from_s", "s", "samples before are left out", 0, 0, 1e9},
                {"to_s", "s", "samples after are left out; 0: none", 0, 0, 1e9},
                {"lag_from_s", "s", "shortest lag of the fit", 0.02, 0, 1e9},
                {"lag_to_s", "s", "longest lag of the fit", 0.1, 0, 1e9}},
    .output = {{"diffusion", "m^2/s",
                "half the slope of the mean-square displacement, a component"},
               {"temperature", "J", "horizontal, of the bulk, mean over samples"},
               {"packing_fraction", "1", "of the bulk, mean over samples"},
               {"curvature", "1", "slope of the later half of the lags over the earlier's, - 1"},
               {"paths", "1", "spheres and pairs of samples at the longest lag"}},
    .curves = DIFFUSION_CURVES,
    .measure = measure_diffusion,
};
