/* engine_look.c -- reading an engine, and the check that does not trust it. */
#include "solver/suspension/engine_state.h"

#include <math.h>
#include <stdlib.h>

/* Place now of the sphere at k, inside the box, and its image. */
static void place_now(const struct engine *e, size_t k, double x[3], int64_t image[3]) {
    const struct sphere *s = &e->sphere[k];
    for (int a = 0; a < 3; a++) {
        double side = e->setup.box_m[a];
        x[a] = s->x[a] + s->w[a] * (e->now - s->t);
        image[a] = e->image[k][a];
        if (!e->cells.periodic[a])
            continue;
        if (x[a] >= side) { /* by round-off: the passage is due now */
            x[a] -= side;
            image[a]++;
        } else if (x[a] < 0) {
            x[a] = fmin(x[a] + side, nextafter(side, 0));
            image[a]--;
        }
    }
}

void engine_place(const struct engine *e, size_t i, double position[3], double velocity[3]) {
    int64_t image[3];
    size_t k = e->place[i];
    double slowing = engine_slowing(e, e->now);
    place_now(e, k, position, image);
    for (int a = 0; a < 3; a++)
        velocity[a] = e->sphere[k].w[a] * slowing;
}

void engine_snapshot(const struct engine *e, double *position, double *velocity, int64_t *image) {
    double slowing = engine_slowing(e, e->now);
    for (size_t i = 0; i < e->count; i++) {
        size_t k = e->place[i];
        double x[3];
        int64_t times[3];
        place_now(e, k, x, times);
        for (size_t a = 0; a < 3; a++) {
            if (position)
                position[3 * i + a] = x[a];
            if (velocity)
                velocity[3 * i + a] = e->sphere[k].w[a] * slowing;
            if (image)
                image[3 * i + a] = times[a];
        }
    }
}

const struct engine_tally *engine_tally(const struct engine *e) {
    return &e->tally;
}

void engine_reset_tally(struct engine *e) {
    e->tally = (struct engine_tally){.collisions = 0};
}

size_t engine_bytes(const struct engine *e) {
    size_t a_sphere = sizeof *e->sphere + sizeof *e->event + sizeof *e->last_hit +
                      sizeof *e->image + sizeof *e->id + sizeof *e->place;
    return sizeof *e + (e->count + 1) * a_sphere + cells_bytes(&e->cells) + queue_bytes(&e->queue);
}

/* -- overlaps, by a search of its own ------------------------------------------------- */

/* Chains of spheres in cells of at least a diameter, filled from places now.  A periodic
 * axis with fewer than three such cells is one cell: nearest images are enough then. */
struct chains {
    int n[3];
    double *x;      /* x[3 count] */
    uint32_t *next; /* next[count], in the same cell */
    uint32_t *head; /* head[n0 n1 n2] */
};

static int chain_cell(const struct engine *e, const struct chains *c, const double *x, int axis) {
    int k = (int)(x[axis] / e->setup.box_m[axis] * c->n[axis]);
    return k < 0 ? 0 : k < c->n[axis] ? k : c->n[axis] - 1;
}

static enum status fill_chains(const struct engine *e, struct chains *c) {
    size_t total = 1;
    double most = ceil(cbrt(2.0 * (double)e->count + 8));
    for (int a = 0; a < 3; a++) {
        double n = fmin(floor(e->setup.box_m[a] / (2 * e->setup.radius_m)), 4 * most);
        c->n[a] = n < 3 ? 1 : (int)n;
        total *= (size_t)c->n[a];
    }
    c->x = malloc((3 * e->count + 1) * sizeof *c->x);
    c->next = malloc((e->count + 1) * sizeof *c->next);
    c->head = malloc(total * sizeof *c->head);
    if (!c->x || !c->next || !c->head)
        return STATUS_NO_MEMORY;
    for (size_t k = 0; k < total; k++)
        c->head[k] = QUEUE_NONE;
    engine_snapshot(e, c->x, NULL, NULL);
    for (size_t i = 0; i < e->count; i++) {
        const double *x = c->x + 3 * i;
        size_t cell =
            ((size_t)chain_cell(e, c, x, 2) * (size_t)c->n[1] + (size_t)chain_cell(e, c, x, 1)) *
                (size_t)c->n[0] +
            (size_t)chain_cell(e, c, x, 0);
        c->next[i] = c->head[cell];
        c->head[cell] = (uint32_t)i;
    }
    return STATUS_OK;
}

static double gap_squared(const struct engine *e, const double *a, const double *b) {
    double sum = 0;
    for (int k = 0; k < 3; k++) {
        double r = b[k] - a[k], side = e->setup.box_m[k];
        if (e->setup.boundary[k] == BOUNDARY_PERIODIC)
            r -= side * nearbyint(r / side);
        sum += r * r;
    }
    return sum;
}

static void look_in_cell(const struct engine *e, const struct chains *c, uint32_t i, size_t cell,
                         struct engine_overlap *worst) {
    double d = engine_diameter(e), unit = 2 * e->setup.radius_m;
    for (uint32_t j = c->head[cell]; j != QUEUE_NONE; j = c->next[j]) {
        double rr = j < i ? gap_squared(e, c->x + 3 * i, c->x + 3 * j) : INFINITY;
        if (rr < d * d && (d - sqrt(rr)) / unit > worst->depth)
            *worst = (struct engine_overlap){(d - sqrt(rr)) / unit, j, i};
    }
}

/* Spheres of the cells around that of sphere i, each cell once. */
static void look_around(const struct engine *e, const struct chains *c, uint32_t i,
                        struct engine_overlap *worst) {
    int at[3], low[3], high[3];
    for (int a = 0; a < 3; a++) {
        at[a] = chain_cell(e, c, c->x + 3 * i, a);
        low[a] = c->n[a] == 1 ? 0 : at[a] - 1;
        high[a] = c->n[a] == 1 ? 0 : at[a] + 1;
    }
    for (int z = low[2]; z <= high[2]; z++)
        for (int y = low[1]; y <= high[1]; y++)
            for (int x = low[0]; x <= high[0]; x++) {
                int k[3] = {(x + c->n[0]) % c->n[0], (y + c->n[1]) % c->n[1],
                            (z + c->n[2]) % c->n[2]};
                look_in_cell(e, c, i,
                             ((size_t)k[2] * (size_t)c->n[1] + (size_t)k[1]) * (size_t)c->n[0] +
                                 (size_t)k[0],
                             worst);
            }
}

static void look_at_walls(const struct engine *e, const double *x, uint32_t i,
                          struct engine_overlap *worst) {
    double unit = 2 * e->setup.radius_m;
    for (int a = 0; a < 3; a++) {
        double gap = fmin(x[a], e->setup.box_m[a] - x[a]) - e->setup.radius_m;
        if (e->setup.boundary[a] == BOUNDARY_HARD && -gap / unit > worst->depth)
            *worst = (struct engine_overlap){-gap / unit, i, i};
    }
}

enum status engine_find_overlap(const struct engine *e, struct engine_overlap *worst) {
    struct chains c = {.x = NULL};
    enum status status = fill_chains(e, &c);
    *worst = (struct engine_overlap){0, 0, 0};
    for (size_t i = 0; status == STATUS_OK && i < e->count; i++) {
        look_around(e, &c, (uint32_t)i, worst);
        look_at_walls(e, c.x + 3 * i, (uint32_t)i, worst);
    }
    free(c.x);
    free(c.next);
    free(c.head);
    return status;
}

double engine_deepest_overlap(const struct engine *e) {
    struct engine_overlap worst;
    return engine_find_overlap(e, &worst) == STATUS_OK ? worst.depth : -1;
}
