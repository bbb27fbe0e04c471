/* observe_bed_stripes.c -- slugs, stripes and mere noise inside a bed of spheres.
 *
 * The profiles of packing fraction of a window of time, averaged over slices of smooth_R,
 * less their mean over that time at each height, leave delta(z, t).  Between the
 * heights from_R and to_R it tells
 *
 *     contrast      sqrt(<delta^2>)/<phi>, and the same of the lower and the upper half
 *     equilibrium   sqrt(S/n): what an undriven fluid of spheres has in slices of n spheres,
 *                   S = 1/(d(phi Z)/d phi), Carnahan & Starling
 *     excess        contrast over equilibrium
 *     slope         of ln contrast over height: straight line through the heights looked at
 *     stripes       dense regions one above the other: delta rises above +half of its root mean
 *                   square, then falls below -half; mean over samples
 *     speed         shift s > or < 0 that makes <delta(z, t) delta(z + s, t + tau)> largest, over
 *                   tau: upwards is positive.  A parabola through three slabs refines s
 *
 * A wave of noise loses its shape within tau, a slug keeps it: `likeness` is the largest
 * correlation over that at s = 0, tau = 0.
 *
 * Source:     Fiege & Zippelius, Sections I and V; docs/theory.md S8.
 * Leaves out: stripes that do not move (their mean is taken off); waves across.
 * Checked by: suspension/striped-phases, suspension/slugs; tests/unit/test_observe_bed_stripes.c.
 */
#include "validation/observe_spheres.h"
#include "validation/recipes.h"
#include "validation/sphere_laws.h"

#include <gsl/gsl_fit.h>
#include <math.h>
#include <stdlib.h>

enum { FROM_S, TO_S, FROM_R, TO_R, SMOOTH_R, LAG_S, FASTEST };
enum {
    CONTRAST,
    LOWER,
    UPPER,
    RISE,
    SLOPE,
    EQUILIBRIUM,
    EXCESS,
    STRIPES,
    SPACING,
    SPEED,
    LIKENESS,
    FRACTION,
    DENSEST,
    TEMPERATURE
};

/* delta, and the smoothed profile it came from: [sample*rows + row]. */
struct stripes {
    size_t samples, rows;  /* rows: slabs between from_R and to_R */
    double slab_m, step_s; /* height of a slab; time between samples */
    double bottom_m;       /* middle of the lowest of the slabs */
    double *smooth, *delta;
    double fraction; /* mean of smooth (1) */
};

/* Mean of an odd number of slabs about each; the window keeps away from the ends. */
static double slice(const double *profile, size_t middle, size_t half) {
    double sum = 0;
    for (size_t i = middle - half; i <= middle + half; i++)
        sum += profile[i];
    return sum / (double)(2 * half + 1);
}

static void take_mean_off(struct stripes *p) {
    double total = 0;
    for (size_t r = 0; r < p->rows; r++) {
        double sum = 0;
        for (size_t t = 0; t < p->samples; t++)
            sum += p->smooth[t * p->rows + r];
        for (size_t t = 0; t < p->samples; t++)
            p->delta[t * p->rows + r] = p->smooth[t * p->rows + r] - sum / (double)p->samples;
        total += sum;
    }
    p->fraction = total / (double)(p->rows * p->samples);
}

/* Root mean square of delta in rows first .. end-1. */
static double deviation(const struct stripes *p, size_t first, size_t end) {
    double sum = 0;
    for (size_t t = 0; t < p->samples; t++)
        for (size_t r = first; r < end; r++)
            sum += p->delta[t * p->rows + r] * p->delta[t * p->rows + r];
    return sqrt(sum / (double)(p->samples * (end - first)));
}

static double count_stripes(const struct stripes *p, double threshold) {
    size_t count = 0;
    for (size_t t = 0; t < p->samples; t++) {
        bool dense = false;
        for (size_t r = 0; r < p->rows; r++) {
            double d = p->delta[t * p->rows + r];
            if (!dense && d > threshold)
                count++;
            if (d > threshold)
                dense = true;
            else if (d < -threshold)
                dense = false;
        }
    }
    return (double)count / (double)p->samples;
}

/* <delta(z, t) delta(z + shift, t + lag)>. */
static double correlation(const struct stripes *p, size_t lag, long shift) {
    size_t low = shift < 0 ? (size_t)-shift : 0, high = p->rows - (size_t)(shift > 0 ? shift : 0);
    double sum = 0;
    for (size_t t = 0; t + lag < p->samples; t++)
        for (size_t r = low; r < high; r++)
            sum += p->delta[t * p->rows + r] *
                   p->delta[(t + lag) * p->rows + (size_t)((long)r + shift)];
    return sum / (double)((p->samples - lag) * (high - low));
}

static void follow(const struct stripes *p, size_t lag, double fastest, struct measurement *out) {
    long most = (long)(fastest * (double)lag * p->step_s / p->slab_m) + 1;
    if (most > (long)p->rows / 2)
        most = (long)p->rows / 2;
    long best = 0;
    double largest = -INFINITY;
    for (long s = -most; s <= most; s++) {
        double c = correlation(p, lag, s);
        if (c > largest) {
            largest = c;
            best = s;
        }
    }
    double shift = (double)best;
    if (best > -most && best < most) {
        double below = correlation(p, lag, best - 1), above = correlation(p, lag, best + 1);
        double bend = below - 2 * largest + above;
        if (bend < 0)
            shift += (below - above) / (2 * bend);
    }
    out->value[SPEED] = shift * p->slab_m / ((double)lag * p->step_s);
    out->value[LIKENESS] = largest / correlation(p, 0, 0);
}

static void conclude(const struct stripes *p, const struct observe_spheres *b, double slice_m,
                     struct measurement *out) {
    double all = deviation(p, 0, p->rows), densest = 0;
    double lower = deviation(p, 0, p->rows / 2), upper = deviation(p, p->rows / 2, p->rows);
    for (size_t i = 0; i < p->samples * p->rows; i++)
        densest = fmax(densest, p->smooth[i]);
    double sphere = 4 * M_PI / 3 * pow(b->radius_m, 3);
    double spheres = p->fraction * b->box_m[0] * b->box_m[1] * slice_m / sphere;
    double still = sqrt(1 / (spheres_stiffness(p->fraction) * spheres));
    out->value[CONTRAST] = all / p->fraction;
    out->value[LOWER] = lower / p->fraction;
    out->value[UPPER] = upper / p->fraction;
    out->value[RISE] = upper / lower;
    out->value[EQUILIBRIUM] = still;
    out->value[EXCESS] = all / p->fraction / still;
    out->value[STRIPES] = count_stripes(p, all / 2);
    if (out->value[STRIPES] > 0)
        out->value[SPACING] = (double)p->rows * p->slab_m / b->radius_m / out->value[STRIPES];
    else
        observe_none(out, SPACING, "no dense region");
    out->value[FRACTION] = p->fraction;
    out->value[DENSEST] = densest;
}

/* Contrast over height and its slope; the last sample's profile. */
static enum status add_curves(const struct stripes *p, double radius_m, struct measurement *out,
                              struct fault *fault) {
    double *z = malloc(3 * p->rows * sizeof *z);
    if (!z)
        return fault_set(fault, STATUS_NO_MEMORY, "no memory for %zu heights", p->rows);
    double *y = z + p->rows, *logarithm = y + p->rows;
    bool still = false;
    for (size_t r = 0; r < p->rows; r++) {
        z[r] = (p->bottom_m + (double)r * p->slab_m) / radius_m;
        y[r] = deviation(p, r, r + 1) / p->fraction;
        logarithm[r] = log(y[r]);
        still = still || !(y[r] > 0);
    }
    double start, c00, c01, c11, sum;
    if (still)
        observe_none(out, SLOPE, "a height where nothing changes");
    else
        gsl_fit_linear(z, 1, logarithm, 1, p->rows, &start, &out->value[SLOPE], &c00, &c01, &c11,
                       &sum);
    enum status status = measurement_add_curve(out, "contrast", "contrast", z, y, p->rows, fault);
    if (!status)
        status = measurement_add_curve(out, "profile", "packing fraction", z,
                                       p->smooth + (p->samples - 1) * p->rows, p->rows, fault);
    free(z);
    return status;
}

/* Horizontal temperature, mean of the window's samples. */
static enum status add_temperature(struct run_view *v, const double *settings,
                                   struct measurement *out, struct fault *fault) {
    const struct series *s;
    size_t first = 0, last = 0;
    enum status status = observe_values(v, "observables/temperature_xy", 1, &s, fault);
    if (!status)
        status =
            observe_spheres_window(v, s, settings[FROM_S], settings[TO_S], &first, &last, fault);
    if (status)
        return status;
    double sum = 0;
    for (size_t f = first; f <= last; f++)
        sum += s->value[f];
    out->value[TEMPERATURE] = sum / (double)(last - first + 1);
    return STATUS_OK;
}

static enum status fill(struct run_view *v, const double *settings, const struct series *s,
                        const struct observe_spheres *b, struct stripes *p, size_t *half,
                        struct fault *fault) {
    size_t first = 0, last = 0;
    enum status status =
        observe_spheres_window(v, s, settings[FROM_S], settings[TO_S], &first, &last, fault);
    if (status)
        return status;
    p->slab_m = b->box_m[2] / (double)s->size;
    p->step_s = (s->time[last] - s->time[first]) / (double)(last - first);
    double slab_R = p->slab_m / b->radius_m;
    *half = (size_t)fmax(0, round((settings[SMOOTH_R] / slab_R - 1) / 2));
    double top = settings[TO_R] > 0 ? settings[TO_R] : b->box_m[2] / b->radius_m;
    size_t low = (size_t)(settings[FROM_R] / slab_R) + *half, high = (size_t)(top / slab_R);
    if (high > s->size)
        high = s->size;
    if (high < low + *half + 16 || last < first + 4)
        return fault_set(
            fault, STATUS_BAD_INPUT,
            "%s: stripes are sought in 16 slabs and 5 samples or more; from %g to %g R "
            "and %g to %g s have fewer",
            run_view_path(v), settings[FROM_R], top, settings[FROM_S], settings[TO_S]);
    p->samples = last - first + 1;
    p->rows = high - *half - low;
    p->bottom_m = ((double)low + 0.5) * p->slab_m;
    p->smooth = malloc(2 * p->samples * p->rows * sizeof *p->smooth);
    if (!p->smooth)
        return fault_set(fault, STATUS_NO_MEMORY, "no memory for %zu profiles", p->samples);
    p->delta = p->smooth + p->samples * p->rows;
    for (size_t t = 0; t < p->samples; t++)
        for (size_t r = 0; r < p->rows; r++)
            p->smooth[t * p->rows + r] = slice(s->value + (first + t) * s->size, low + r, *half);
    take_mean_off(p);
    return STATUS_OK;
}

static enum status measure(struct run_view *v, const double *settings, struct measurement *out,
                           struct fault *fault) {
    struct observe_spheres b;
    struct stripes p = {0};
    const struct series *s;
    size_t half = 0;
    enum status status = observe_spheres(v, &b, fault);
    if (!status)
        status = run_view_series(v, "profiles/packing_fraction", &s, fault);
    if (!status)
        status = fill(v, settings, s, &b, &p, &half, fault);
    if (!status)
        status = add_temperature(v, settings, out, fault);
    if (!status) {
        size_t lag = (size_t)fmax(1, round(settings[LAG_S] / p.step_s));
        if (lag > p.samples / 2)
            lag = p.samples / 2;
        follow(&p, lag, settings[FASTEST], out);
        conclude(&p, &b, (double)(2 * half + 1) * p.slab_m, out);
        status = add_curves(&p, b.radius_m, out, fault);
    }
    free(p.smooth);
    return status;
}

static const char *const DATASETS[] = {"profiles/packing_fraction", "observables/temperature_xy",
                                       NULL};
static const char *const CURVES[] = {"contrast", "profile", NULL};

const struct recipe recipe_bed_stripes = {
    .name = "bed-stripes",
    .title = "Slugs and stripes in a bed",
    .source = "Fiege & Zippelius, Sections I and V",
    .datasets = DATASETS,
    .setting = {{"from_s", "s", "start of the window", 0, 0, 1e9},
                {"to_s", "s", "end of the window; 0: the last sample", 0, 0, 1e9},
                {"from_R", "R", "lower edge of the heights looked at", 10, 0, 1e7},
                {"to_R", "R", "upper edge; 0: the lid", 0, 0, 1e7},
                {"smooth_R", "R", "thickness of the slices", 10, 0.1, 1e4},
                {"lag_s", "s", "tau: time over which a stripe is followed", 0.02, 0, 1e9},
                {"fastest", "m/s", "largest speed that is sought, up or down", 0.6, 1e-9, 1e9}},
    .output = {{"contrast", "1", "root mean square of delta over the mean packing fraction"},
               {"lower", "1", "the same in the lower half"},
               {"upper", "1", "the same in the upper half"},
               {"rise", "1", "upper over lower"},
               {"slope", "1/R", "of ln contrast over height"},
               {"equilibrium", "1", "contrast of a fluid at rest"},
               {"excess", "1", "contrast over that"},
               {"stripes", "1", "dense regions one above the other, mean over samples"},
               {"spacing", "R", "heights looked at over stripes"},
               {"speed", "m/s", "at which delta travels, upwards"},
               {"likeness", "1", "of delta to itself after tau, shifted"},
               {"packing_fraction", "1", "mean over heights and samples"},
               {"densest", "1", "largest packing fraction of any slice"},
               {"temperature", "J", "horizontal, mean over samples"}},
    .curves = CURVES,
    .measure = measure,
};
