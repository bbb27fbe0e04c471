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
    struct contact *contact = realloc(c->contact, capacity * sizeof *contact);
    if (contact)
        c->contact = contact;
    uint64_t *todo = realloc(c->todo, words(capacity) * sizeof *todo);
    if (todo)
        c->todo = todo;
    int32_t *adjacent = realloc(c->adjacent, 2 * capacity * sizeof *adjacent);
    if (adjacent)
        c->adjacent = adjacent;
    if (!contact || !todo || !adjacent)
        return fault_set(fault, STATUS_NO_MEMORY, "no memory for %zu contacts", capacity);
    c->capacity = capacity;
    return STATUS_OK;
}

enum status contacts_create(struct contacts *c, size_t grains, double width, double height,
                            double diameter_max, struct fault *fault) {
    *c = (struct contacts){0};
    if (neighbours_create(&c->neighbours, grains, width, height, diameter_max, fault) != STATUS_OK)
        return fault->status;
    c->adjacent_first = calloc(grains + 2, sizeof *c->adjacent_first);
    c->rest_overlap = CONTACTS_REST_OVERLAP * diameter_max;
    c->sites_x = (int)width + 1;
    c->virial_field = calloc((size_t)c->sites_x * ((size_t)height + 1), sizeof *c->virial_field);
    if (c->adjacent_first && c->virial_field && make_room(c, 2 * grains, fault) == STATUS_OK)
        return STATUS_OK;
    contacts_free(c);
    return fault_set(fault, STATUS_NO_MEMORY, "no memory for the contacts of %zu grains", grains);
}

void contacts_free(struct contacts *c) {
    neighbours_free(&c->neighbours);
    free(c->contact);
    free(c->todo);
    free(c->adjacent_first);
    free(c->adjacent);
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
    double support = wall == WALL_BOTTOM ? 0.5 * threshold : 0;
    c->contact[c->count++] = (struct contact){.i = (int32_t)i,
                                              .j = (int32_t)g->count,
                                              .wall = wall,
                                              .overlap = (float)(g->radius[i] - distance),
                                              .rest = -0.98 * support,
                                              .support = support,
                                              .nx = nx,
                                              .ny = ny,
                                              .distance = distance};
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
        double d = sqrt(square);
        c->contact[c->count++] =
            (struct contact){.i = (int32_t)i,
                             .j = j,
                             .wall = -1,
                             .overlap = (float)(reach - d),
                             .rest = threshold * fmax(0, 1 - (reach - d) * per_rest),
                             .nx = d > 0 ? dx / d : 0,
                             .ny = d > 0 ? dy / d : 1,
                             .distance = d};
    }
}

static enum status find_contacts(struct contacts *c, const struct grains *g, double threshold,
                                 struct fault *fault) {
    const struct neighbours *n = &c->neighbours;
    c->count = 0;
    for (size_t i = 0; i < g->count; i++) {
        if (make_room(c, c->count + 4 + n->first[i + 1] - n->first[i], fault) != STATUS_OK)
            return fault->status;
        add_wall(c, g, threshold, i, WALL_BOTTOM, g->y[i], 0, 1);
        add_wall(c, g, threshold, i, WALL_LEFT, g->x[i], 1, 0);
        add_wall(c, g, threshold, i, WALL_RIGHT, n->width - g->x[i], -1, 0);
        add_pairs(c, g, threshold, i);
        add_wall(c, g, threshold, i, WALL_TOP, n->height - g->y[i], 0, -1);
    }
    return STATUS_OK;
}

/* adjacent[adjacent_first[i] .. adjacent_first[i+1]-1]: contacts of grain i. */
static void find_adjacent(struct contacts *c, size_t grains) {
    int32_t *first = c->adjacent_first;
    memset(first, 0, (grains + 2) * sizeof *first);
    for (size_t k = 0; k < c->count; k++) {
        first[c->contact[k].i + 1]++;
        if (c->contact[k].wall < 0)
            first[c->contact[k].j + 1]++;
    }
    for (size_t i = 0; i < grains; i++)
        first[i + 1] += first[i];
    for (size_t k = 0; k < c->count; k++) {
        c->adjacent[first[c->contact[k].i]++] = (int32_t)k;
        if (c->contact[k].wall < 0)
            c->adjacent[first[c->contact[k].j]++] = (int32_t)k;
    }
    memmove(first + 1, first, grains * sizeof *first);
    first[0] = 0;
}

/* -- resolving ------------------------------------------------------------- */

static inline double approach_speed(const struct contact *k, const struct grains *g) {
    return -((g->vx[k->i] - g->vx[k->j]) * k->nx + (g->vy[k->i] - g->vy[k->j]) * k->ny);
}

/* Collide contact k at an approach speed above the threshold. */
static inline void collide(struct contacts *c, struct contact *k, struct grains *g, double speed,
                           const struct contact_rule *rule) {
    bool elastic =
        g->last_hit[k->i] >= rule->step - 1 || (k->wall < 0 && g->last_hit[k->j] >= rule->step - 1);
    double leaving = (elastic ? 1 : rule->restitution) * speed;
    if (leaving < k->support)
        leaving = k->support;
    double wi = g->inverse_mass[k->i], wj = g->inverse_mass[k->j];
    double impulse = (speed + leaving) / (wi + wj);
    g->vx[k->i] += impulse * wi * k->nx;
    g->vy[k->i] += impulse * wi * k->ny;
    g->vx[k->j] -= impulse * wj * k->nx;
    g->vy[k->j] -= impulse * wj * k->ny;
    g->last_hit[k->i] = g->last_hit[k->j] = rule->step;
    k->impulse += impulse;
    c->tally.collisions++;
    c->tally.elastic += elastic;
    c->tally.dissipated += 0.5 * (speed * speed - leaving * leaving) / (wi + wj);
}

static inline void mark_adjacent(struct contacts *c, int32_t grain) {
    for (int32_t a = c->adjacent_first[grain]; a < c->adjacent_first[grain + 1]; a++)
        c->todo[c->adjacent[a] / 64] |= (uint64_t)1 << (c->adjacent[a] % 64);
}

/* Look at contact number n; collide it and mark what must be looked at again. */
static inline bool visit(struct contacts *c, struct grains *g, size_t n,
                         const struct contact_rule *rule) {
    struct contact *k = &c->contact[n];
    c->todo[n / 64] &= ~((uint64_t)1 << (n % 64));
    double speed = approach_speed(k, g);
    if (!(speed > k->rest))
        return false;
    collide(c, k, g, speed, rule);
    mark_adjacent(c, k->i);
    if (k->wall < 0)
        mark_adjacent(c, k->j);
    c->todo[n / 64] &= ~((uint64_t)1 << (n % 64));
    return true;
}

static bool sweep_up(struct contacts *c, struct grains *g, const struct contact_rule *rule) {
    bool any = false;
    for (size_t w = 0; w < words(c->count); w++) {
        uint64_t ahead = ~(uint64_t)0, bits;
        while ((bits = c->todo[w] & ahead)) {
            int bit = __builtin_ctzll(bits);
            ahead = bit == 63 ? 0 : ~(uint64_t)0 << (bit + 1);
            any |= visit(c, g, 64 * w + (size_t)bit, rule);
        }
    }
    return any;
}

static bool sweep_down(struct contacts *c, struct grains *g, const struct contact_rule *rule) {
    bool any = false;
    for (size_t w = words(c->count); w-- > 0;) {
        uint64_t ahead = ~(uint64_t)0, bits;
        while ((bits = c->todo[w] & ahead)) {
            int bit = 63 - __builtin_clzll(bits);
            ahead = ((uint64_t)1 << bit) - 1;
            any |= visit(c, g, 64 * w + (size_t)bit, rule);
        }
    }
    return any;
}

static enum status too_many_sweeps(const struct contacts *c, const struct grains *g,
                                   const struct contact_rule *rule, struct fault *fault) {
    size_t worst[3] = {0}, found = 0;
    for (size_t n = 0; n < c->count; n++) {
        if (approach_speed(&c->contact[n], g) <= c->contact[n].rest)
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
                  g->id[k->i], other, g->x[k->i], g->y[k->i], approach_speed(k, g));
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

static void tally_step(struct contacts *c, const struct grains *g, int sweeps) {
    struct contact_tally *t = &c->tally;
    t->last_sweeps = sweeps;
    t->sweeps += sweeps;
    if (sweeps > t->most_sweeps)
        t->most_sweeps = sweeps;
    float deepest = 0;
    for (size_t n = 0; n < c->count; n++) {
        const struct contact *k = &c->contact[n];
        if (k->overlap > deepest)
            deepest = k->overlap;
        if (k->wall < 0) {
            t->virial += k->impulse * k->distance;
            c->virial_field[site_of_pair(c, g, k)] += k->impulse * k->distance;
        } else {
            t->wall_impulse[k->wall] += k->impulse;
            t->wall_virial[k->wall] += k->impulse * k->distance;
        }
    }
    t->largest_overlap = deepest;
}

enum status contacts_resolve(struct contacts *c, struct grains *g, const struct contact_rule *rule,
                             struct fault *fault) {
    if (neighbours_update(&c->neighbours, g, fault) != STATUS_OK)
        return fault->status;
    if (find_contacts(c, g, rule->threshold, fault) != STATUS_OK)
        return fault->status;
    find_adjacent(c, g->count);
    g->vx[g->count] = g->vy[g->count] = 0;
    if (c->count > 0)
        memset(c->todo, 0xff, words(c->count) * sizeof *c->todo);
    if (c->count % 64)
        c->todo[c->count / 64] = ((uint64_t)1 << (c->count % 64)) - 1;
    int sweeps = 0;
    bool again = c->count > 0;
    while (again) {
        if (sweeps == CONTACTS_MAX_SWEEPS)
            return too_many_sweeps(c, g, rule, fault);
        again = sweeps++ % 2 ? sweep_down(c, g, rule) : sweep_up(c, g, rule);
    }
    g->last_hit[g->count] = GRAINS_NEVER_HIT;
    tally_step(c, g, sweeps);
    return STATUS_OK;
}
