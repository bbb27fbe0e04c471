/* observe_packed.c -- one settled bed: how dense, how high, how quiet.
 *
 * Means over the frames from from_tau to the end of the run.  Fraction, height
 * and centre of mass as in bed_column.h.  Quiet is
 *
 *     kinetic_energy = sum m v^2/2 / sum m g d,      g = gravity/Fr
 *
 * the mean energy of the grains over what lifts each by its own diameter.  The
 * solid fraction is a mean over a slab, its ends blurred by 1 l; in a bed of
 * 50 l whose rows differ by .01 that is an error of 2e-4.
 *
 * Source:     MFM, Section IV; docs/theory.md, "Fluidization".
 * Leaves out: steps between frames; a surface that is not level.
 * Checked by: graingas/packed-bed; tests/unit/test_observe_packed.c.
 */
#include "validation/bed_column.h"
#include "validation/recipes.h"

#include <math.h>
#include <stdlib.h>

enum { FROM_TAU, MARGIN_L };
enum {
    SOLID_FRACTION,
    HEIGHT,
    CENTRE,
    BULK_FRACTION,
    KINETIC_ENERGY,
    LARGEST_OVERLAP,
    SINKING,
    SLEEPING_SHARE
};

struct window {
    double from, dt; /* (tau) */
};

static bool is_inside(const struct window *w, double time) {
    return time >= w->from - w->dt / 2;
}

/* Mean of an observable over the window, and its largest value; NaN where it has no frame. */
static enum status value_over(struct run_view *v, const char *name, const struct window *w,
                              double *mean, double *largest, struct fault *fault) {
    const struct series *s;
    size_t used = 0;
    double sum = 0;
    *largest = NAN;
    enum status status = observe_values(v, name, 1, &s, fault);
    if (status)
        return status;
    for (size_t f = 0; f < s->frames; f++)
        if (is_inside(w, s->time[f])) {
            sum += s->value[f];
            *largest = fmax(*largest, s->value[f]);
            used++;
        }
    *mean = used ? sum / (double)used : NAN;
    return STATUS_OK;
}

/* sum m g d (l^2 U0^2). */
static double lift_energy(const double *radius, size_t count, const struct observe_physics *p) {
    double sum = 0;
    for (size_t i = 0; i < count; i++)
        sum += M_PI * radius[i] * radius[i] * 2 * radius[i];
    return sum * p->gravity / p->froude;
}

static enum status measure_grains(struct run_view *v, const struct observe_physics *p,
                                  const struct window *w, struct measurement *out,
                                  struct fault *fault) {
    const double *radius;
    size_t count;
    double energy, overlap, asleep, largest;
    enum status status = run_view_array(v, "particles/grains/radius", &radius, &count, fault);
    if (!status)
        status = value_over(v, "observables/kinetic_energy", w, &energy, &largest, fault);
    if (!status)
        status = value_over(v, "observables/largest_overlap", w, &overlap,
                            &out->value[LARGEST_OVERLAP], fault);
    if (!status)
        status = value_over(v, "observables/sleeping", w, &asleep, &largest, fault);
    if (status)
        return status;
    out->value[SLEEPING_SHARE] = asleep / (double)count;
    out->value[KINETIC_ENERGY] = energy / lift_energy(radius, count, p);
    if (!(p->gravity > 0))
        observe_none(out, KINETIC_ENERGY, "no gravity: nothing to hold the energy against");
    return STATUS_OK;
}

/* Means over the window's frames, all of one bed. */
static void conclude(const struct bed_column *sum, const double *time, const double *top,
                     size_t used, struct measurement *out) {
    double n = (double)used, error;
    out->value[SOLID_FRACTION] = sum->slab_fraction / n;
    out->value[HEIGHT] = sum->top / n;
    out->value[CENTRE] = sum->centre / n;
    out->value[BULK_FRACTION] = sum->bulk_fraction / n;
    out->value[SINKING] = -bed_column_slope(time, top, used, &error);
    if (isnan(out->value[SINKING]))
        observe_none(out, SINKING, "%zu frames with a bed; 3 needed for a slope", used);
    if (isnan(out->value[SOLID_FRACTION]))
        observe_none(out, SOLID_FRACTION, "a bed of %g l leaves no slab between the margins",
                     out->value[HEIGHT]);
}

static enum status measure_beds(const struct series *s, const struct observe_box *box,
                                const struct window *w, double margin, struct measurement *out,
                                struct fault *fault) {
    struct bed_column sum = {0};
    size_t used = 0;
    double *time = calloc(2 * s->frames, sizeof *time);
    if (!time)
        return fault_set(fault, STATUS_NO_MEMORY, "no memory for %zu frames", s->frames);
    double *top = time + s->frames;
    for (size_t f = 0; f < s->frames; f++) {
        if (!is_inside(w, s->time[f]))
            continue;
        struct bed_column c = bed_column_measure(s->value + f * s->size, box, margin);
        sum.slab_fraction += c.slab_fraction;
        sum.top += c.top; /* NaN without a bed, and so are all means */
        sum.centre += c.centre;
        sum.bulk_fraction += c.bulk_fraction;
        time[used] = s->time[f];
        top[used++] = c.top;
    }
    if (used && isfinite(sum.top))
        conclude(&sum, time, top, used, out);
    else
        for (size_t i = SOLID_FRACTION; i <= SLEEPING_SHARE; i++)
            if (i <= BULK_FRACTION || i == SINKING)
                observe_none(out, i,
                             used ? "a frame after %g tau has no bed" : "no frame after %g tau",
                             w->from);
    enum status status =
        measurement_add_curve(out, "top", "bed", time, top, isfinite(sum.top) ? used : 0, fault);
    free(time);
    return status;
}

static enum status measure(struct run_view *v, const double *settings, struct measurement *out,
                           struct fault *fault) {
    struct observe_box box;
    struct observe_physics physics;
    struct window w = {.from = settings[FROM_TAU]};
    const struct series *s;
    enum status status = observe_box(v, &box, fault);
    if (!status)
        status = observe_physics(v, &physics, fault);
    if (!status)
        status = observe_field(v, "fields/solid_fraction", &box, 1, &s, fault);
    w.dt = status ? 0 : physics.dt_tau;
    if (!status)
        status = measure_beds(s, &box, &w, settings[MARGIN_L], out, fault);
    if (!status)
        status = measure_grains(v, &physics, &w, out, fault);
    return status;
}

static const char *const DATASETS[] = {"fields/solid_fraction",      "particles/grains/radius",
                                       "observables/kinetic_energy", "observables/largest_overlap",
                                       "observables/sleeping",       NULL};
static const char *const CURVES[] = {"top", NULL};

const struct recipe recipe_packed_bed = {
    .name = "packed-bed",
    .title = "A settled bed",
    .source = "MFM, Section IV; docs/theory.md",
    .datasets = DATASETS,
    .setting = {{"from_tau", "tau", "the window begins; it ends with the run", 30, 0, 1e6},
                {"margin_l", "l", "left out of the slab at the floor and under the top", 5, 0,
                 1000}},
    .output = {{"solid_fraction", "1", "mean over the slab between the margins"},
               {"height", "l", "of the top"},
               {"centre_of_mass", "l", "height, weighted with mass"},
               {"bulk_fraction", "1", "solid height over the top's height"},
               {"kinetic_energy", "1", "mean, over what lifts a grain by its diameter"},
               {"largest_overlap", "l", "of two grains, or of one with a wall, in the window"},
               {"sinking", "l/tau", "speed of the top, positive downwards"},
               {"sleeping_share", "1", "of all grains, asleep"}},
    .curves = CURVES,
    .measure = measure,
};
