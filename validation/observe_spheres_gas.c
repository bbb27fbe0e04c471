/* observe_spheres_gas.c -- collision rate and pressure of a gas of spheres.
 *
 * With W the sum over pair collisions of impulse times distance of centres in a
 * time t, and T = m <v^2>/3,
 *
 *     Z = p V/(N T) = 1 + W/(3 N T t)                             (virial theorem)
 *     f = 2 N_coll/(N t)
 *
 * Between hard walls that reflect centres at R and L - R, with the impulses I
 * given to the six walls and G = sum m (x - L/2).v,
 *
 *     dG = 2 E t + W - sum over walls (L/2 - R) I
 *
 * is exact for every free flight and collision: averaged, it is the identity
 * sum over axes of F (L - d) = 3 N T + W/t.
 *
 * Source:     virial theorem.
 * Leaves out: drag and kicks in the identity (a fault says so).
 * Checked by: suspension/verification-elastic-collision-rate, -compressibility,
 *             -wall-identity; tests/unit/test_observe_spheres_gas.c.
 */
#include "validation/observe_spheres.h"
#include "validation/recipes.h"

#include <math.h>

enum { FROM_S, TO_S };
enum { RATE, TEMPERATURE, FRACTION, COLLISIONS, ELASTIC };
enum { COMPRESSIBILITY, VIRIAL_FRACTION, VIRIAL_COLLISIONS };
enum { IDENTITY_ERROR, WALL_COMPRESSIBILITY, WALL_VIRIAL, WALL_FRACTION };

struct task {
    struct observe_spheres spheres;
    const struct series *collisions, *energy, *counter, *elastic;
    size_t first, last;
    double time, count; /* of the window (s); spheres */
};

static enum status load(struct run_view *v, const double *settings, struct task *k,
                        const char *counter, struct fault *fault) {
    enum status status = observe_spheres(v, &k->spheres, fault);
    if (!status)
        status = observe_values(v, "observables/collisions", 1, &k->collisions, fault);
    if (!status)
        status = observe_values(v, "observables/kinetic_energy", 1, &k->energy, fault);
    if (!status)
        status = observe_values(v, counter, 1, &k->counter, fault);
    if (!status)
        status = observe_spheres_together(v, k->collisions, k->energy, fault);
    if (!status)
        status = observe_spheres_together(v, k->collisions, k->counter, fault);
    if (!status)
        status = observe_spheres_window(v, k->collisions, settings[FROM_S], settings[TO_S],
                                        &k->first, &k->last, fault);
    if (status)
        return status;
    k->time = k->collisions->time[k->last] - k->collisions->time[k->first];
    k->count = (double)k->spheres.count;
    return STATUS_OK;
}

static double growth(const struct task *k, const struct series *s) {
    return s->value[k->last] - s->value[k->first];
}

/* Square of the mean of sqrt(T) over the window's samples: rates go as sqrt(T). */
static double temperature(const struct task *k) {
    double sum = 0;
    for (size_t f = k->first; f <= k->last; f++)
        sum += sqrt(2 * k->energy->value[f] / (3 * k->count));
    sum /= (double)(k->last - k->first + 1);
    return sum * sum;
}

static enum status measure_rate(struct run_view *v, const double *settings, struct measurement *out,
                                struct fault *fault) {
    struct task k = {0};
    enum status status = load(v, settings, &k, "observables/elastic_collisions", fault);
    if (status)
        return status;
    double collisions = growth(&k, k.collisions);
    out->value[RATE] = 2 * collisions / (k.count * k.time);
    out->value[TEMPERATURE] = temperature(&k);
    out->value[FRACTION] = k.spheres.packing_fraction;
    out->value[COLLISIONS] = 2 * collisions / k.count;
    if (collisions > 0)
        out->value[ELASTIC] = growth(&k, k.counter) / collisions;
    else
        observe_none(out, ELASTIC, "there was no collision");
    return STATUS_OK;
}

static enum status measure_virial(struct run_view *v, const double *settings,
                                  struct measurement *out, struct fault *fault) {
    struct task k = {0};
    enum status status = load(v, settings, &k, "observables/collision_virial", fault);
    if (status)
        return status;
    out->value[VIRIAL_FRACTION] = k.spheres.packing_fraction;
    out->value[VIRIAL_COLLISIONS] = 2 * growth(&k, k.collisions) / k.count;
    double energy = (k.energy->value[k.first] + k.energy->value[k.last]) / 2;
    if (!(energy > 0)) {
        observe_none(out, COMPRESSIBILITY, "the spheres are at rest");
        return STATUS_OK;
    }
    out->value[COMPRESSIBILITY] = 1 + growth(&k, k.counter) / (2 * energy * k.time);
    return STATUS_OK;
}

/* -- between walls ---------------------------------------------------------------- */

static double moment(const struct observe_spheres *b, const struct series *x,
                     const struct series *u, size_t frame) {
    double sum = 0;
    for (size_t i = 0; i < b->count; i++)
        for (size_t a = 0; a < 3; a++)
            sum += b->mass_kg * (observe_spheres_at(x, frame, i)[a] - b->box_m[a] / 2) *
                   observe_spheres_at(u, frame, i)[a];
    return sum;
}

static enum status check_walls(struct run_view *v, const struct task *k, struct fault *fault) {
    const struct observe_spheres *b = &k->spheres;
    double first = k->energy->value[k->first], last = k->energy->value[k->last];
    if (b->periodic[0] || b->periodic[1] || b->periodic[2] || !(fabs(last / first - 1) < 1e-6))
        return fault_set(fault, STATUS_BAD_INPUT,
                         "%s: the identity of the walls needs six of them and conserved energy",
                         run_view_path(v));
    return STATUS_OK;
}

static enum status measure_walls(struct run_view *v, const double *settings,
                                 struct measurement *out, struct fault *fault) {
    struct task k = {0};
    const struct series *x, *u, *impulse;
    enum status status = load(v, settings, &k, "observables/collision_virial", fault);
    if (!status)
        status = observe_spheres_vectors(v, "position", &k.spheres, &x, fault);
    if (!status)
        status = observe_spheres_vectors(v, "velocity", &k.spheres, &u, fault);
    if (!status)
        status = observe_values(v, "observables/wall_impulse", 6, &impulse, fault);
    if (!status)
        status = observe_spheres_together(v, k.energy, x, fault);
    if (!status)
        status = observe_spheres_together(v, x, u, fault);
    if (!status)
        status = observe_spheres_together(v, x, impulse, fault);
    if (!status)
        status = check_walls(v, &k, fault);
    if (status)
        return status;
    double walls = 0; /* sum of (L/2 - R) I (kg m^2/s) */
    for (size_t w = 0; w < 6; w++)
        walls += (k.spheres.box_m[w / 2] / 2 - k.spheres.radius_m) *
                 (impulse->value[6 * k.last + w] - impulse->value[6 * k.first + w]);
    double twice = k.energy->value[k.first] + k.energy->value[k.last];
    double inside = twice * k.time + growth(&k, k.counter);
    double change = moment(&k.spheres, x, u, k.last) - moment(&k.spheres, x, u, k.first);
    out->value[IDENTITY_ERROR] = fabs(change - inside + walls) / inside;
    out->value[WALL_COMPRESSIBILITY] = walls / (twice * k.time);
    out->value[WALL_VIRIAL] = inside / (twice * k.time);
    out->value[WALL_FRACTION] = k.spheres.packing_fraction;
    return STATUS_OK;
}

#define WINDOW                                                                                     \
    {"from_s", "s", "start of the window", 0, 0, 1e9}, {                                           \
        "to_s", "s", "end of the window; 0: the last sample", 0, 0, 1e9                            \
    }

static const char *const RATE_DATASETS[] = {"observables/collisions", "observables/kinetic_energy",
                                            "observables/elastic_collisions", NULL};
static const char *const VIRIAL_DATASETS[] = {
    "observables/collisions", "observables/kinetic_energy", "observables/collision_virial", NULL};
static const char *const WALL_DATASETS[] = {"observables/collisions",
                                            "observables/kinetic_energy",
                                            "observables/collision_virial",
                                            "observables/wall_impulse",
                                            "particles/spheres/position",
                                            "particles/spheres/velocity",
                                            NULL};

const struct recipe recipe_sphere_collisions = {
    .name = "sphere-collisions",
    .title = "Collision rate of spheres",
    .source = "Fiege & Zippelius, Section III",
    .datasets = RATE_DATASETS,
    .setting = {WINDOW},
    .output = {{"rate", "1/s", "2 N_coll/(N t)"},
               {"temperature", "J", "square of the samples' mean sqrt(m <v^2>/3)"},
               {"packing_fraction", "1", "of the whole box"},
               {"collisions", "1", "2 N_coll/N in the window"},
               {"elastic_share", "1", "collisions that the guard made elastic"}},
    .measure = measure_rate,
};

const struct recipe recipe_sphere_virial = {
    .name = "sphere-virial",
    .title = "Compressibility factor of spheres, from their collisions",
    .source = "virial theorem",
    .datasets = VIRIAL_DATASETS,
    .setting = {WINDOW},
    .output = {{"compressibility", "1", "1 + W/(3 N T t)"},
               {"packing_fraction", "1", "of the whole box"},
               {"collisions", "1", "2 N_coll/N in the window"}},
    .measure = measure_virial,
};

const struct recipe recipe_sphere_walls = {
    .name = "sphere-walls",
    .title = "Impulses on six hard walls against the virial",
    .source = "virial theorem",
    .datasets = WALL_DATASETS,
    .setting = {WINDOW},
    .output = {{"identity_error", "1", "virial theorem of the box, of 3 N T t + W"},
               {"wall_compressibility", "1", "sum over axes of F (L - d)/(3 N T)"},
               {"virial_compressibility", "1", "1 + W/(3 N T t)"},
               {"packing_fraction", "1", "of the whole box"}},
    .measure = measure_walls,
};
