#include "solver/suspension/grow.h"

#include "common/random.h"
#include "solver/suspension/grid.h"

#include <gsl/gsl_randist.h>
#include <math.h>
#include <stdlib.h>

static const double placed_packing = 0.12;
enum { MAX_TRIES = 100000 };           /* for one sphere */
static const double most_hits = 20000; /* collisions of a sphere during growth: jammed */
static const double slice_hits = 3;    /* collisions of a sphere between rescalings */
static const double let_pass = 0.05;   /* of the thermal speed */
static const double shortest = 1e-9;   /* slice over the whole growth: jammed too */

/* -- placing ---------------------------------------------------------------------- */

static bool is_free(void *context, size_t j, const double apart[3]) {
    (void)context;
    (void)j;
    (void)apart;
    return false; /* somebody is within the reach */
}

/* The diameter at which the spheres fill .12 of the box, or their own. */
static double placed_diameter(const struct engine_setup *s) {
    double d = 2 * s->radius_m, box = s->box_m[0] * s->box_m[1] * s->box_m[2];
    double packing = (double)s->count * (M_PI / 6 * d * d * d) / box;
    return packing > placed_packing ? d * cbrt(placed_packing / packing) : d;
}

static enum status place(const struct engine_setup *s, double diameter, uint64_t seed,
                         double *position, struct fault *fault) {
    struct grid g;
    gsl_rng *rng = NULL;
    if (grid_create(&g, s->box_m, s->boundary, diameter, position, s->count, fault) != STATUS_OK)
        return fault->status;
    random_stream(seed, "suspension places", &rng, fault);
    for (size_t i = 0; i < s->count && fault->status == STATUS_OK; i++) {
        double *x = position + 3 * i;
        int tries = 0;
        do {
            for (int a = 0; a < 3; a++) {
                double edge = s->boundary[a] == BOUNDARY_HARD ? s->radius_m : 0;
                x[a] = gsl_ran_flat(rng, edge, s->box_m[a] - edge);
            }
        } while (!grid_visit(&g, x, is_free, NULL) && ++tries < MAX_TRIES);
        if (tries == MAX_TRIES)
            fault_set(fault, STATUS_BAD_INPUT,
                      "start: no room for sphere %zu of %zu after %d tries: the box is too narrow",
                      i + 1, s->count, MAX_TRIES);
        grid_put(&g, i);
    }
    gsl_rng_free(rng);
    grid_free(&g);
    return fault->status;
}

/* -- growing ------------------------------------------------------------------------ */

struct growth {
    struct engine *engine;
    const struct grow_rule *rule;
    double *position, *velocity; /* scratch [3 count] */
};

static enum status set_going(struct growth *g, struct fault *fault) {
    const struct grow_rule *r = g->rule;
    gsl_rng *rng;
    if (random_stream(r->seed, "suspension growth", &rng, fault) != STATUS_OK)
        return fault->status;
    for (size_t k = 0; k < 3 * r->setup.count; k++)
        g->velocity[k] = gsl_ran_gaussian_ziggurat(rng, sqrt(r->square_speed));
    gsl_rng_free(rng);
    return engine_set_state(g->engine, g->position, g->velocity, fault);
}

/* Back to the temperature: every sphere is kicked along its own velocity.  That costs an
 * event a sphere, so a few per cent of speed are let pass. */
static void rescale(struct growth *g) {
    const size_t count = g->rule->setup.count;
    double sum = 0;
    engine_snapshot(g->engine, NULL, g->velocity, NULL);
    for (size_t k = 0; k < 3 * count; k++)
        sum += g->velocity[k] * g->velocity[k];
    double excess = sqrt(3 * (double)count * g->rule->square_speed / sum) - 1;
    if (fabs(excess) < let_pass)
        return;
    for (size_t i = 0; i < count; i++) {
        const double *v = g->velocity + 3 * i;
        engine_kick(g->engine, i, (double[3]){excess * v[0], excess * v[1], excess * v[2]});
    }
}

static enum status jammed(const struct growth *g, double end, struct fault *fault) {
    return fault_set(fault, STATUS_BAD_INPUT,
                     "start: the spheres jam when %.4f of their diameter is grown; the packing "
                     "fraction is too large for this box",
                     engine_diameter(g->engine) / end);
}

/* Slices shrink with the time between collisions, which tells a jam well before it. */
static enum status grow_all(struct growth *g, double start, double end, double speed,
                            struct fault *fault) {
    const struct engine_tally *t = engine_tally(g->engine);
    const double count = (double)g->rule->setup.count, duration = (end - start) / speed;
    double now = 0, slice = duration / 100;
    while (now < duration) {
        double before = (double)t->collisions, next = fmin(now + slice, duration);
        if (engine_advance(g->engine, next, fault) == STATUS_NUMERICAL)
            return jammed(g, end, fault);
        rescale(g);
        double hits = 2 * ((double)t->collisions - before) / count;
        slice = fmin(slice_hits * (next - now) / fmax(hits, 1e-3), duration / 100);
        now = next;
        bool crowded = slice < shortest * duration && now < duration;
        if (2 * (double)t->collisions > most_hits * count || crowded)
            return jammed(g, end, fault);
    }
    return STATUS_OK;
}

static enum status grow(const struct grow_rule *rule, double diameter, double *position,
                        double *collisions, struct fault *fault) {
    struct growth g = {.rule = rule, .position = position};
    double end = 2 * rule->setup.radius_m, speed = rule->rate * sqrt(rule->square_speed);
    g.velocity = malloc((3 * rule->setup.count + 1) * sizeof *g.velocity);
    if (!g.velocity)
        fault_set(fault, STATUS_NO_MEMORY, "no memory for %zu spheres", rule->setup.count);
    else if (engine_create(&g.engine, &rule->setup, fault) == STATUS_OK &&
             engine_set_growth(g.engine, diameter, speed, fault) == STATUS_OK &&
             set_going(&g, fault) == STATUS_OK &&
             grow_all(&g, diameter, end, speed, fault) == STATUS_OK) {
        *collisions = 2 * (double)engine_tally(g.engine)->collisions / (double)rule->setup.count;
        engine_snapshot(g.engine, position, NULL, NULL);
    }
    engine_free(g.engine);
    free(g.velocity);
    return fault->status;
}

enum status grow_spheres(const struct grow_rule *rule, double *position, double *collisions,
                         struct fault *fault) {
    double diameter = placed_diameter(&rule->setup);
    *collisions = 0;
    if (place(&rule->setup, diameter, rule->seed, position, fault) != STATUS_OK)
        return fault->status;
    if (diameter == 2 * rule->setup.radius_m)
        return STATUS_OK;
    return grow(rule, diameter, position, collisions, fault);
}
