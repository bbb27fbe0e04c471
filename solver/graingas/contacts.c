#include "solver/graingas/contacts.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static size_t words(size_t bits) {
    return (bits + 63) / 64;
}

static enum status make_room(struct contacts *c, size_t needed, struct fault *fault) {
    if (needed <= c->capacity)
        return STATUS_OK;
    size_t capacity = 2 * needed + 64;
    struct contact *contact = aligned_alloc(64, capacity * sizeof *contact);
    if (contact) {
        if (c->count > 0)
            memcpy(contact, c->contact, c->count * sizeof *contact);
        free(c->contact);
        c->contact = contact;
    }
    uint64_t *todo = realloc(c->todo, words(capacity) * sizeof *todo);
    if (todo)
        c->todo = todo;
    int32_t *other = realloc(c->other, capacity * sizeof *other);
    if (other)
        c->other = other;
    if (!contact || !todo || !other)
        return fault_set(fault, STATUS_NO_MEMORY, "no memory for %zu contacts", capacity);
    c->capacity = capacity;
    return STATUS_OK;
}

enum status contacts_create(struct contacts *c, size_t grains, double width, double height,
                            double diameter_max, struct fault *fault) {
    *c = (struct contacts){0};
    if (neighbours_create(&c->neighbours, grains, width, height, diameter_max, fault) != STATUS_OK)
        return fault->status;
    c->own = calloc(grains + 2, sizeof *c->own);
    c->other_first = calloc(grains + 2, sizeof *c->other_first);
    c->body = aligned_alloc(32, (grains + 1) * sizeof *c->body);
    c->rest_overlap = CONTACTS_REST_OVERLAP * diameter_max;
    c->sites_x = (int)width + 1;
    c->virial_field = calloc((size_t)c->sites_x * ((size_t)height + 1), sizeof *c->virial_field);
    if (c->own && c->other_first && c->body && c->virial_field &&
        make_room(c, 2 * grains, fault) == STATUS_OK)
        return STATUS_OK;
    contacts_free(c);
    return fault_set(fault, STATUS_NO_MEMORY, "no memory for the contacts of %zu grains", grains);
}

void contacts_free(struct contacts *c) {
    neighbours_free(&c->neighbours);
    free(c->contact);
    free(c->todo);
    free(c->body);
    free(c->own);
    free(c->other_first);
    free(c->other);
    free(c->virial_field);
    *c = (struct contacts){0};
}

/* -- finding --------------------------------------------------------------- */

/* A wall does not fall with the grains: its contacts know no rest, and the floor
 * sends a grain back at half of what gravity adds in a step at the least, so
 * that a grain at rest on it does not sink from step to step. */
static void add_wall(struct contacts *c, const struct grains *g, double threshold, size_t i,
                     int wall, double distance, double nx, double ny) {
    if (distance >= g->radius[i])
        return;
    if (g->radius[i] - distance > c->deepest)
        c->deepest = g->radius[i] - distance;
    if (g->inverse_mass[i] == 0)
        return;
    double support = wall == WALL_BOTTOM ? 0.5 * threshold : 0;
    c->contact[c->count++] = (struct contact){.i = (int32_t)i,
                                              .j = (int32_t)g->count,
                                              .wall = wall,
                                              .rest = -0.98 * support,
                                              .support = support,
                                              .reduced_mass = g->area[i],
                                              .nx = nx,
                                              .ny = ny};
}

/* The threshold fades with depth, so that a pair that creeps together stops. */
static void add_pairs(struct contacts *c, const struct grains *g, double threshold, size_t i) {
    const struct neighbours *n = &c->neighbours;
    double x = g->x[i], y = g->y[i], r = g->radius[i], per_rest = 1 / c->rest_overlap;
    for (size_t p = n->first[i]; p < n->first[i + 1]; p++) {
        int32_t j = n->other[p];
        double dx = x - g->x[j], dy = y - g->y[j], reach = r + g->radius[j];
        double square = dx * dx + dy * dy;
        if (square >= reach * reach)
            continue;
        double d = sqrt(square), depth = (reach - d) * per_rest;
        double inverse_mass = g->inverse_mass[i] + g->inverse_mass[j];
        bool held = g->inverse_mass[i] == 0 || g->inverse_mass[j] == 0;
        if (reach - d > c->deepest)
            c->deepest = reach - d;
        if (inverse_mass == 0)
            continue;
        c->contact[c->count++] =
            (struct contact){.i = (int32_t)i,
                             .j = j,
                             .wall = -1,
                             .held = held,
                             .rest = threshold * fmax(held ? 0.5 : 0, 1 - depth),
                             .reduced_mass = 1 / inverse_mass,
                             .nx = d > 0 ? dx / d : 0,
                             .ny = d > 0 ? dy / d : 1};
    }
}

static enum status list_contacts(struct contacts *c, const struct grains *g, double threshold,
                                 struct fault *fault) {
    const struct neighbours *n = &c->neighbours;
    c->count = 0;
    c->deepest = 0;
    for (size_t i = 0; i < g->count; i++) {
        if (make_room(c, c->count + 4 + n->first[i + 1] - n->first[i], fault) != STATUS_OK)
            return fault->status;
        c->own[i] = (int32_t)c->count;
        add_wall(c, g, threshold, i, WALL_BOTTOM, g->y[i], 0, 1);
        add_wall(c, g, threshold, i, WALL_LEFT, g->x[i], 1, 0);
        add_wall(c, g, threshold, i, WALL_RIGHT, n->width - g->x[i], -1, 0);
        add_pairs(c, g, threshold, i);
        add_wall(c, g, threshold, i, WALL_TOP, n->height - g->y[i], 0, -1);
    }
    c->own[g->count] = (int32_t)c->count;
    return STATUS_OK;
}

/* The contacts in which each grain is j, by counting. */
static void find_others(struct contacts *c, size_t grains) {
    int32_t *first = c->other_first;
    memset(first, 0, (grains + 2) * sizeof *first);
    for (size_t k = 0; k < c->count; k++)
        first[c->contact[k].j + 1]++; /* walls count too, past the last grain */
    for (size_t i = 0; i < grains; i++)
        first[i + 1] += first[i];
    for (size_t k = 0; k < c->count; k++)
        if (c->contact[k].wall < 0)
            c->other[first[c->contact[k].j]++] = (int32_t)k;
    memmove(first + 1, first, grains * sizeof *first);
    first[0] = 0;
}

enum status contacts_find(struct contacts *c, struct grains *g, const struct contact_rule *rule,
                          struct fault *fault) {
    if (neighbours_update(&c->neighbours, g, fault) != STATUS_OK ||
        list_contacts(c, g, rule->threshold, fault) != STATUS_OK)
        return fault->status;
    find_others(c, g->count);
    return STATUS_OK;
}

/* -- resolving ------------------------------------------------------------- */

static inline double approach_speed(const struct contact *k, const struct body *body) {
    const struct body *a = &body[k->i], *b = &body[k->j];
    return -((a->vx - b->vx) * k->nx + (a->vy - b->vy) * k->ny);
}

/* Collide contact k at an approach speed above its rest. */
static inline void collide(struct contacts *c, struct contact *k, double speed,
                           const struct contact_rule *rule) {
    struct body *a = &c->body[k->i], *b = &c->body[k->j];
    bool elastic = !k->held && (a->last_hit >= rule->step - 1 || b->last_hit >= rule->step - 1);
    double leaving = (elastic ? 1 : rule->restitution) * speed;
    if (leaving < k->support)
        leaving = k->support;
    double impulse = (speed + leaving) * k->reduced_mass;
    double to_a = impulse * a->inverse_mass, to_b = impulse * b->inverse_mass;
    a->vx += to_a * k->nx;
    a->vy += to_a * k->ny;
    b->vx -= to_b * k->nx;
    b->vy -= to_b * k->ny;
    a->last_hit = rule->step;
    b->last_hit = k->wall < 0 ? rule->step : GRAINS_NEVER_HIT;
    k->impulse += impulse;
    c->tally.collisions++;
    c->tally.elastic += elastic;
    c->tally.dissipated += 0.5 * (speed * speed - leaving * leaving) * k->reduced_mass;
}

/* Set the bits from first to end - 1, a word at a time. */
static inline void mark_run(uint64_t *todo, int32_t first, int32_t end) {
    while (first < end) {
        int32_t room = 64 - first % 64, run = end - first < room ? end - first : room;
        todo[first / 64] |= ~(uint64_t)0 >> (64 - run) << (first % 64);
        first += run;
    }
}

static inline void mark(struct contacts *c, int32_t grain) {
    mark_run(c->todo, c->own[grain], c->own[grain + 1]);
    for (int32_t n = c->other_first[grain]; n < c->other_first[grain + 1]; n++)
        c->todo[c->other[n] / 64] |= (uint64_t)1 << (c->other[n] % 64);
}

/* Look at contact number n; collide it and mark what must be looked at again. */
static inline bool visit(struct contacts *c, size_t n, const struct contact_rule *rule) {
    struct contact *k = &c->contact[n];
    c->todo[n / 64] &= ~((uint64_t)1 << (n % 64));
    double speed = approach_speed(k, c->body);
    if (!(speed > k->rest))
        return false;
    collide(c, k, speed, rule);
    mark(c, k->i);
    if (k->wall < 0)
        mark(c, k->j);
    c->todo[n / 64] &= ~((uint64_t)1 << (n % 64));
    return true;
}

static bool sweep_up(struct contacts *c, const struct contact_rule *rule) {
    bool any = false;
    for (size_t w = 0; w < words(c->count); w++) {
        uint64_t ahead = ~(uint64_t)0, bits;
        while ((bits = c->todo[w] & ahead)) {
            int bit = __builtin_ctzll(bits);
            ahead = bit == 63 ? 0 : ~(uint64_t)0 << (bit + 1);
            any |= visit(c, 64 * w + (size_t)bit, rule);
        }
    }
    return any;
}

static bool sweep_down(struct contacts *c, const struct contact_rule *rule) {
    bool any = false;
    for (size_t w = words(c->count); w-- > 0;) {
        uint64_t ahead = ~(uint64_t)0, bits;
        while ((bits = c->todo[w] & ahead)) {
            int bit = 63 - __builtin_clzll(bits);
            ahead = ((uint64_t)1 << bit) - 1;
            any |= visit(c, 64 * w + (size_t)bit, rule);
        }
    }
    return any;
}

static enum status too_many_sweeps(const struct contacts *c, const struct grains *g,
                                   const struct contact_rule *rule, struct fault *fault) {
    size_t worst[3] = {0}, found = 0;
    for (size_t n = 0; n < c->count; n++) {
        if (approach_speed(&c->contact[n], c->body) <= c->contact[n].rest)
            continue;
        size_t at = found < 3 ? found++ : 2;
        for (worst[at] = n;
             at > 0 && c->contact[worst[at]].impulse > c->contact[worst[at - 1]].impulse; at--) {
            size_t swap = worst[at];
            worst[at] = worst[at - 1];
            worst[at - 1] = swap;
        }
    }
    fault_set(fault, STATUS_NUMERICAL, "step %lld: collisions did not end in %d sweeps", rule->step,
              CONTACTS_MAX_SWEEPS);
    for (size_t w = 0; w < found; w++) {
        const struct contact *k = &c->contact[worst[w]];
        int32_t other = k->wall < 0 ? g->id[k->j] : -1 - k->wall;
        fault_add(fault, STATUS_NUMERICAL,
                  "  grains %d and %d (negative: wall) at (%.3f, %.3f) l approach at %.3g U0",
                  g->id[k->i], other, g->x[k->i], g->y[k->i], approach_speed(k, c->body));
    }
    return fault->status;
}

/* Site nearest to the middle of a pair. */
static size_t site_of_pair(const struct contacts *c, const struct grains *g,
                           const struct contact *k) {
    size_t i = (size_t)(0.5 * (g->x[k->i] + g->x[k->j]) + 0.5);
    size_t j = (size_t)(0.5 * (g->y[k->i] + g->y[k->j]) + 0.5);
    return j * (size_t)c->sites_x + i;
}

static double wall_distance(const struct contacts *c, const struct grains *g,
                            const struct contact *k) {
    const struct neighbours *n = &c->neighbours;
    const double distance[WALL_COUNT] = {g->x[k->i], n->width - g->x[k->i], g->y[k->i],
                                         n->height - g->y[k->i]};
    return distance[k->wall];
}

static void tally_step(struct contacts *c, const struct grains *g, int sweeps) {
    struct contact_tally *t = &c->tally;
    t->last_sweeps = sweeps;
    t->sweeps += sweeps;
    if (sweeps > t->most_sweeps)
        t->most_sweeps = sweeps;
    for (size_t n = 0; n < c->count; n++) {
        const struct contact *k = &c->contact[n];
        if (k->impulse == 0)
            continue;
        if (k->wall < 0) {
            double virial = k->impulse * hypot(g->x[k->i] - g->x[k->j], g->y[k->i] - g->y[k->j]);
            t->virial += virial;
            c->virial_field[site_of_pair(c, g, k)] += virial;
        } else {
            t->wall_impulse[k->wall] += k->impulse;
            t->wall_virial[k->wall] += k->impulse * wall_distance(c, g, k);
        }
    }
    t->largest_overlap = c->deepest;
}

static void take_bodies(struct contacts *c, const struct grains *g) {
    for (size_t i = 0; i < g->count; i++)
        c->body[i] = (struct body){g->vx[i], g->vy[i], g->inverse_mass[i], g->last_hit[i]};
    c->body[g->count] = (struct body){.last_hit = GRAINS_NEVER_HIT}; /* the walls */
}

static void give_bodies(const struct contacts *c, struct grains *g) {
    for (size_t i = 0; i < g->count; i++) {
        g->vx[i] = c->body[i].vx;
        g->vy[i] = c->body[i].vy;
        g->inverse_mass[i] = c->body[i].inverse_mass;
        g->last_hit[i] = c->body[i].last_hit;
    }
}

/* Grains that are squeezed for good between others held in place are no ground: held grains
 * that were hit in this step get their mass back. */
static void release_held(struct contacts *c, const struct grains *g) {
    for (size_t n = 0; n < c->count; n++) {
        struct contact *k = &c->contact[n];
        if (k->held && k->impulse > 0)
            for (int side = 0; side < 2; side++) {
                int32_t grain = side ? k->j : k->i;
                c->body[grain].inverse_mass = 1 / g->area[grain];
            }
    }
    for (size_t n = 0; n < c->count; n++) {
        struct contact *k = &c->contact[n];
        if (!k->held)
            continue;
        double a = c->body[k->i].inverse_mass, b = c->body[k->j].inverse_mass;
        k->held = a == 0 || b == 0;
        k->reduced_mass = 1 / (a + b);
    }
}

enum status contacts_resolve(struct contacts *c, struct grains *g, const struct contact_rule *rule,
                             struct fault *fault) {
    take_bodies(c, g);
    if (c->count > 0)
        memset(c->todo, 0xff, words(c->count) * sizeof *c->todo);
    if (c->count % 64)
        c->todo[c->count / 64] = ((uint64_t)1 << (c->count % 64)) - 1;
    int sweeps = 0;
    bool again = c->count > 0;
    while (again) {
        if (sweeps == CONTACTS_MAX_SWEEPS)
            return too_many_sweeps(c, g, rule, fault);
        if (sweeps > 0 && sweeps % CONTACTS_PATIENCE == 0)
            release_held(c, g);
        again = sweeps++ % 2 ? sweep_down(c, rule) : sweep_up(c, rule);
    }
    give_bodies(c, g);
    tally_step(c, g, sweeps);
    return STATUS_OK;
}
