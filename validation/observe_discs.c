/* observe_discs.c -- pressure of elastic hard discs from their collisions.
 *
 * With W the sum over collisions of impulse times distance of centres, N discs
 * of temperature kT = (1/2) m <v^2> in two dimensions and a time t,
 *
 *     Z = p A/(N kT) = 1 + W/(2 N kT t)          (virial theorem)
 *
 * in the bulk: W and N are taken from sites at least margin_d diameters from
 * the walls, N as the mean over samples.  Walls order the discs beside them, so
 * that the whole box differs from the bulk by d/L.
 *
 * For the whole box the virial theorem holds with the walls' impulses I and
 * their virials w (impulse times the centre's distance from the wall),
 *
 *     dG = 2 E t + W + sum over axes (w_low + w_high - L I_high),  G = sum m x.v,
 *
 * exactly: with w = I d/2 this is the known F (L - d) summed over axes = 2 N kT + W.
 *
 * Collisions are found at the end of a step, which shrinks the disc by
 * (sqrt(pi)/2) v_th dt on average: see docs/theory.md.
 *
 * Source:     virial theorem; Clisby & McCoy, J. Stat. Phys. 122, 15 (2006).
 * Leaves out: discs of unequal size, inelastic ones, gas, gravity.
 * Checked by: graingas/verification-hard-discs; tests/unit/test_observe_discs.c.
 */
#include "validation/observe.h"
#include "validation/recipes.h"

#include <math.h>

enum { FROM_TAU, MARGIN_D };
enum { COMPRESSIBILITY, AREA_FRACTION, RATIO, IDENTITY_ERROR, STEP_RATIO, COLLISIONS };

struct task {
    struct run_view *view;
    struct observe_box box;
    struct observe_physics physics;
    struct observe_grains grains;
    const struct series *virial, *collisions, *impulse, *wall_virial, *site_virial, *rho;
    size_t first, last;            /* frames of all series */
    double time, diameter, energy; /* (tau), (l), mean kinetic energy (l^2 U0^2) */
    size_t margin;                 /* sites left out at each wall */
};

static enum status load(struct task *k, struct fault *fault) {
    struct run_view *v = k->view;
    enum status status = observe_box(v, &k->box, fault);
    if (!status)
        status = observe_physics(v, &k->physics, fault);
    if (!status)
        status = observe_grains(v, true, &k->grains, fault);
    if (!status)
        status = observe_values(v, "observables/collision_virial", 1, &k->virial, fault);
    if (!status)
        status = observe_values(v, "observables/collisions", 1, &k->collisions, fault);
    if (!status)
        status = observe_values(v, "observables/wall_impulse", 4, &k->impulse, fault);
    if (!status)
        status = observe_values(v, "observables/wall_virial", 4, &k->wall_virial, fault);
    if (!status)
        status = observe_field(v, "fields/collision_virial", &k->box, 1, &k->site_virial, fault);
    if (!status)
        status = observe_field(v, "fields/solid_fraction", &k->box, 1, &k->rho, fault);
    if (status)
        return status;
    size_t n = k->grains.frames;
    if (n < 2 || k->virial->frames != n || k->collisions->frames != n || k->impulse->frames != n ||
        k->wall_virial->frames != n || k->site_virial->frames != n || k->rho->frames != n)
        return fault_set(fault, STATUS_BAD_INPUT,
                         "%s: disc pressure needs all its data at the same two or more times",
                         run_view_path(v));
    return STATUS_OK;
}

static double kinetic_energy(const struct observe_grains *g, size_t frame) {
    double sum = 0;
    for (size_t i = 0; i < g->count; i++) {
        const double *u = observe_vector(g->velocity, g, frame, i);
        sum += observe_area(g, i) * (u[0] * u[0] + u[1] * u[1]) / 2;
    }
    return sum;
}

/* Sum of m x.v (l^3 U0). */
static double moment(const struct observe_grains *g, size_t frame) {
    double sum = 0;
    for (size_t i = 0; i < g->count; i++) {
        const double *x = observe_vector(g->position, g, frame, i);
        const double *u = observe_vector(g->velocity, g, frame, i);
        sum += observe_area(g, i) * (x[0] * u[0] + x[1] * u[1]);
    }
    return sum;
}

static enum status prepare(struct task *k, const double *settings, struct fault *fault) {
    const struct observe_grains *g = &k->grains;
    enum status status = observe_frame(k->view, "particles/grains/position", g->series,
                                       settings[FROM_TAU], &k->first, fault);
    if (status)
        return status;
    k->last = g->frames - 1;
    k->diameter = 2 * g->radius[0];
    for (size_t i = 1; i < g->count; i++)
        if (fabs(2 * g->radius[i] - k->diameter) > 1e-12)
            return fault_set(fault, STATUS_BAD_INPUT, "%s: the discs are not of one size",
                             run_view_path(k->view));
    k->time = g->time[k->last] - g->time[k->first];
    k->energy = (kinetic_energy(g, k->first) + kinetic_energy(g, k->last)) / 2;
    k->margin = (size_t)ceil(settings[MARGIN_D] * k->diameter);
    if (!(k->time > 0) || 2 * k->margin + 2 > k->box.nx || 2 * k->margin + 2 > k->box.ny)
        return fault_set(fault, STATUS_BAD_INPUT,
                         "%s: no time after %g tau, or no sites %g diameters from the walls",
                         run_view_path(k->view), settings[FROM_TAU], settings[MARGIN_D]);
    return STATUS_OK;
}

/* Sum over inner sites of a field's frame, weighted with `weight` (all inner volumes are 1). */
static double inner_sum(const struct task *k, const struct series *s, size_t frame) {
    const double *value = s->value + frame * s->size;
    double sum = 0;
    for (size_t j = k->margin; j < k->box.ny - k->margin; j++)
        for (size_t i = k->margin; i < k->box.nx - k->margin; i++)
            sum += value[j * k->box.nx + i];
    return sum;
}

static void measure_bulk(const struct task *k, struct measurement *out) {
    double area = 0, disc = M_PI * k->diameter * k->diameter / 4;
    for (size_t f = k->first; f <= k->last; f++)
        area += inner_sum(k, k->rho, f) / k->physics.area_to_volume;
    area /= (double)(k->last - k->first + 1);
    double virial = inner_sum(k, k->site_virial, k->last) - inner_sum(k, k->site_virial, k->first);
    double temperature = k->energy / (double)k->grains.count;
    double sites = (double)((k->box.nx - 2 * k->margin) * (k->box.ny - 2 * k->margin));
    out->value[COMPRESSIBILITY] = 1 + virial / (2 * (area / disc) * temperature * k->time);
    out->value[AREA_FRACTION] = area / sites;
    out->value[RATIO] =
        out->value[COMPRESSIBILITY] / closure_disc_compressibility(out->value[AREA_FRACTION]);
    out->value[STEP_RATIO] = sqrt(temperature / disc) * k->physics.dt_tau / k->diameter;
}

/* Growth of entry `wall` (left, right, bottom, top) of a counter. */
static double growth(const struct task *k, const struct series *s, size_t wall) {
    return s->value[4 * k->last + wall] - s->value[4 * k->first + wall];
}

static double identity_error(const struct task *k) {
    double length[2] = {k->box.width_l, k->box.height_l}, walls = 0;
    for (size_t a = 0; a < 2; a++) {
        walls += growth(k, k->wall_virial, 2 * a) + growth(k, k->wall_virial, 2 * a + 1);
        walls -= length[a] * growth(k, k->impulse, 2 * a + 1);
    }
    double inside =
        2 * k->energy * k->time + k->virial->value[k->last] - k->virial->value[k->first];
    double change = moment(&k->grains, k->last) - moment(&k->grains, k->first);
    return fabs(change - inside - walls) / inside;
}

static enum status measure(struct run_view *v, const double *settings, struct measurement *out,
                           struct fault *fault) {
    struct task k = {.view = v};
    enum status status = load(&k, fault);
    if (!status)
        status = prepare(&k, settings, fault);
    if (status)
        return status;
    measure_bulk(&k, out);
    out->value[IDENTITY_ERROR] = identity_error(&k);
    out->value[COLLISIONS] =
        (k.collisions->value[k.last] - k.collisions->value[k.first]) / (double)k.grains.count;
    return STATUS_OK;
}

static const char *const DATASETS[] = {"particles/grains/position", "particles/grains/velocity",
                                       "particles/grains/radius",   "observables/collision_virial",
                                       "observables/collisions",    "observables/wall_impulse",
                                       "observables/wall_virial",   "fields/collision_virial",
                                       "fields/solid_fraction",     NULL};

const struct recipe recipe_disc_pressure = {
    .name = "disc-pressure",
    .title = "Pressure of elastic hard discs",
    .source = "virial theorem",
    .datasets = DATASETS,
    .setting = {{"from_tau", "tau", "what happens before is left out", 0, 0, 1e6},
                {"margin_d", "d", "distance of the bulk from the walls, in diameters", 5, 0, 100}},
    .output = {{"compressibility", "1", "p A/(N kT) of the bulk"},
               {"area_fraction", "1", "mean area fraction of the bulk"},
               {"ratio", "1", "compressibility over the virial series at that area fraction"},
               {"identity_error", "1", "virial theorem of the whole box, walls included"},
               {"step_ratio", "1", "v_th dt/d"},
               {"collisions", "1", "collisions per disc in the time measured"}},
    .measure = measure,
};
