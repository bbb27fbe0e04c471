/* observe_spheres_places.c -- overlaps, order, and symmetry, from places alone.
 *
 * sphere-overlap: the deepest overlap of any pair, or of a sphere and a hard wall, in
 * every sample: spheres are sorted into cells of a diameter or more a side and each
 * meets those of the 27 cells about it.  It knows nothing of the solver's events.
 *
 * sphere-order: the solver's Q6, and layering at the floor and ceiling: the largest packing
 * fraction of a slice of half a radius within 2 R of where centres can be, over the box's.
 *
 * sphere-mirror: spheres i and i + N/2 start as images of each other in the plane
 * x = Lx/2; the largest distance from that up to a time, in diameters.
 *
 * sphere-fingerprint: a weighted sum of places (in R) and of velocities (in sqrt(T/m), T the
 * parameter) at a time given in units of R/sqrt(T/m), and counters: runs with the same
 * dimensionless groups in other units have the same numbers.
 *
 * Source:     docs/theory.md.
 * Leaves out: boxes less than three diameters wide along a periodic axis.
 * Checked by: suspension/verification-no-overlap, -mirror, -units;
 *             tests/unit/test_observe_spheres_places.c.
 */
#include "validation/observe_spheres.h"
#include "validation/recipes.h"
#include "validation/sphere_cells.h"

#include <math.h>

enum { OVERLAP, REPORTED, SAMPLES };
enum { FROM_S };
enum { Q6, FLOOR, CEILING };
enum { UNTIL_S };
enum { ASYMMETRY, MIRROR_COLLISIONS };
enum { AT_TIME };
enum { PLACES, VELOCITIES, COLLISIONS, ENERGY };

static enum status measure_overlap(struct run_view *v, const double *settings,
                                   struct measurement *out, struct fault *fault) {
    (void)settings;
    struct observe_spheres b;
    const struct series *x, *reported;
    enum status status = observe_spheres(v, &b, fault);
    if (!status)
        status = observe_spheres_vectors(v, "position", &b, &x, fault);
    if (!status)
        status = observe_values(v, "observables/largest_overlap", 1, &reported, fault);
    if (status)
        return status;
    struct sphere_cells_box box = {.count = b.count, .diameter = 2 * b.radius_m};
    for (size_t a = 0; a < 3; a++) {
        box.side[a] = b.box_m[a];
        box.periodic[a] = b.periodic[a];
    }
    for (size_t f = 0; f < x->frames && !status; f++) {
        double deepest = 0;
        status = sphere_cells_overlap(&box, x->value + f * x->size, &deepest, fault);
        out->value[OVERLAP] = fmax(out->value[OVERLAP], deepest);
    }
    for (size_t f = 0; f < reported->frames; f++)
        out->value[REPORTED] = fmax(out->value[REPORTED], reported->value[f]);
    out->value[SAMPLES] = (double)x->frames;
    return status;
}

/* Packing fraction of each slice of half a radius above a plane, the largest of four, over
 * the box's; up > 0 from the floor, < 0 from the ceiling. */
static double layering(const struct observe_spheres *b, const struct series *x, size_t first,
                       int up) {
    double number[4] = {0}, slice = b->radius_m / 2;
    for (size_t f = first; f < x->frames; f++)
        for (size_t i = 0; i < b->count; i++) {
            double z = observe_spheres_at(x, f, i)[2];
            double height = (up > 0 ? z : b->box_m[2] - z) - b->radius_m;
            if (height < 4 * slice)
                number[height > 0 ? (size_t)(height / slice) : 0]++;
        }
    double most = fmax(fmax(number[0], number[1]), fmax(number[2], number[3]));
    double even = (double)(b->count * (x->frames - first)) * slice / b->box_m[2];
    return most / even;
}

static enum status measure_order(struct run_view *v, const double *settings,
                                 struct measurement *out, struct fault *fault) {
    struct observe_spheres b;
    const struct series *x, *q6;
    enum status status = observe_spheres(v, &b, fault);
    if (!status)
        status = observe_spheres_vectors(v, "position", &b, &x, fault);
    if (!status)
        status = observe_values(v, "observables/q6", 1, &q6, fault);
    if (status)
        return status;
    size_t first = 0, used = 0;
    while (first + 1 < x->frames && x->time[first] < settings[FROM_S] * (1 - 1e-6))
        first++;
    for (size_t f = 0; f < q6->frames; f++)
        if (q6->time[f] >= settings[FROM_S] * (1 - 1e-6)) {
            out->value[Q6] += q6->value[f];
            used++;
        }
    if (used)
        out->value[Q6] /= (double)used;
    else
        observe_none(out, Q6, "no sample from %g s on", settings[FROM_S]);
    out->value[FLOOR] = layering(&b, x, first, 1);
    out->value[CEILING] = layering(&b, x, first, -1);
    return STATUS_OK;
}

static double asymmetry(const struct observe_spheres *b, const struct series *x, size_t frame) {
    double worst = 0;
    for (size_t i = 0; i < b->count / 2; i++) {
        const double *p = observe_spheres_at(x, frame, i);
        const double *q = observe_spheres_at(x, frame, i + b->count / 2);
        worst = fmax(worst, fabs(p[0] + q[0] - b->box_m[0]));
        worst = fmax(worst, fmax(fabs(p[1] - q[1]), fabs(p[2] - q[2])));
    }
    return worst / (2 * b->radius_m);
}

static enum status measure_mirror(struct run_view *v, const double *settings,
                                  struct measurement *out, struct fault *fault) {
    struct observe_spheres b;
    const struct series *x, *collisions;
    size_t first = 0, last = 0;
    enum status status = observe_spheres(v, &b, fault);
    if (!status)
        status = observe_spheres_vectors(v, "position", &b, &x, fault);
    if (!status)
        status = observe_values(v, "observables/collisions", 1, &collisions, fault);
    if (!status)
        status = observe_spheres_together(v, x, collisions, fault);
    if (!status)
        status = observe_spheres_window(v, x, 0, settings[UNTIL_S], &first, &last, fault);
    if (!status && (b.count % 2 || asymmetry(&b, x, 0) > 1e-12))
        status = fault_set(fault, STATUS_BAD_INPUT, "%s: the start is not its own mirror image",
                           run_view_path(v));
    if (status)
        return status;
    for (size_t f = 1; f <= last; f++)
        out->value[ASYMMETRY] = fmax(out->value[ASYMMETRY], asymmetry(&b, x, f));
    out->value[MIRROR_COLLISIONS] = 2 * collisions->value[last] / (double)b.count;
    return STATUS_OK;
}

static enum status measure_fingerprint(struct run_view *v, const double *settings,
                                       struct measurement *out, struct fault *fault) {
    struct observe_spheres b;
    const struct series *x, *u, *collisions;
    enum status status = observe_spheres(v, &b, fault);
    if (!status)
        status = observe_spheres_vectors(v, "position", &b, &x, fault);
    if (!status)
        status = observe_spheres_vectors(v, "velocity", &b, &u, fault);
    if (!status)
        status = observe_values(v, "observables/collisions", 1, &collisions, fault);
    if (!status)
        status = observe_spheres_together(v, x, u, fault);
    if (!status)
        status = observe_spheres_together(v, x, collisions, fault);
    if (status)
        return status;
    double speed = sqrt(b.thermal_energy_J / b.mass_kg);
    double at = settings[AT_TIME] * b.radius_m / speed;
    size_t frame = 0;
    while (frame + 1 < x->frames && x->time[frame] < at * (1 - 1e-6))
        frame++;
    if (fabs(x->time[frame] - at) > 1e-5 * at)
        return fault_set(fault, STATUS_NOT_FOUND, "%s: no sample at %.9g s", run_view_path(v), at);
    for (size_t i = 0; i < x->size; i++) {
        double weight = 1 + (double)(i % 1009) / 1024;
        out->value[PLACES] += weight * x->value[frame * x->size + i] / b.radius_m;
        out->value[VELOCITIES] += weight * u->value[frame * x->size + i] / speed;
        out->value[ENERGY] += pow(u->value[frame * x->size + i] / speed, 2);
    }
    out->value[ENERGY] /= (double)x->size;
    out->value[COLLISIONS] = collisions->value[frame];
    return STATUS_OK;
}

static const char *const OVERLAP_DATASETS[] = {"particles/spheres/position",
                                               "observables/largest_overlap", NULL};
static const char *const ORDER_DATASETS[] = {"particles/spheres/position", "observables/q6", NULL};
static const char *const MIRROR_DATASETS[] = {"particles/spheres/position",
                                              "observables/collisions", NULL};
static const char *const FINGERPRINT_DATASETS[] = {
    "particles/spheres/position", "particles/spheres/velocity", "observables/collisions", NULL};

const struct recipe recipe_sphere_overlap = {
    .name = "sphere-overlap",
    .title = "Deepest overlap of any two spheres",
    .source = "geometry",
    .datasets = OVERLAP_DATASETS,
    .output = {{"overlap", "d", "of the samples' places, walls included"},
               {"reported", "d", "as the solver has it"},
               {"samples", "1", "samples looked at"}},
    .measure = measure_overlap,
};

const struct recipe recipe_sphere_order = {
    .name = "sphere-order",
    .title = "Crystal order and layering at the walls",
    .source = "Steinhardt, Nelson & Ronchetti, PRB 28, 784 (1983)",
    .datasets = ORDER_DATASETS,
    .setting = {{"from_s", "s", "samples before are left out", 0, 0, 1e9}},
    .output = {{"q6", "1", "mean over samples"},
               {"floor", "1",
                "densest slice of R/2 within 2 R of the lowest centres, over the mean"},
               {"ceiling", "1", "the same at the upper wall"}},
    .measure = measure_order,
};

const struct recipe recipe_sphere_mirror = {
    .name = "sphere-mirror",
    .title = "Mirror symmetry of spheres between walls",
    .source = "docs/theory.md",
    .datasets = MIRROR_DATASETS,
    .setting = {{"until_s", "s", "up to here; 0: the last sample", 0, 0, 1e9}},
    .output = {{"asymmetry", "d", "largest of any pair"},
               {"collisions", "1", "2 N_coll/N by then"}},
    .measure = measure_mirror,
};

const struct recipe recipe_sphere_fingerprint = {
    .name = "sphere-fingerprint",
    .title = "State in its own units",
    .source = "docs/theory.md",
    .datasets = FINGERPRINT_DATASETS,
    .setting = {{"at", "1", "time in R/sqrt(T/m)", 1, 0, 1e9}},
    .output = {{"places", "R", "weighted sum of all coordinates"},
               {"velocities", "sqrt(T/m)", "weighted sum of all components"},
               {"collisions", "1", "so far"},
               {"energy", "T", "m <v^2>/3"}},
    .measure = measure_fingerprint,
};
