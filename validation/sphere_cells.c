/* sphere_cells.c -- see sphere_cells.h. */
#include "validation/sphere_cells.h"

#include <math.h>
#include <stdlib.h>

static const size_t NONE = (size_t)-1;

struct grid {
    const struct sphere_cells_box *box;
    const double *position;
    size_t n[3];
    size_t *head, *next; /* head[cell], next[sphere]: lists that end with NONE */
};

static size_t cell_along(const struct grid *g, size_t axis, double x) {
    double share = x / g->box->side[axis] * (double)g->n[axis];
    size_t i = share > 0 ? (size_t)share : 0;
    return i < g->n[axis] ? i : g->n[axis] - 1;
}

static size_t cell_of(const struct grid *g, const size_t c[3]) {
    return (c[2] * g->n[1] + c[1]) * g->n[0] + c[0];
}

/* Not many more cells than spheres: an empty box needs no more. */
static enum status choose(struct grid *g, struct fault *fault) {
    const struct sphere_cells_box *b = g->box;
    double most = ceil(cbrt((double)b->count)) + 1;
    for (size_t a = 0; a < 3; a++) {
        double fit = floor(b->side[a] / (b->diameter * (1 + 1e-9)));
        if (b->periodic[a] && fit < 3)
            return fault_set(fault, STATUS_BAD_INPUT,
                             "a periodic side of %g diameters is too short to look for overlaps",
                             b->side[a] / b->diameter);
        g->n[a] = (size_t)fmax(1, fmin(fit, fmax(3, 3 * most)));
    }
    return STATUS_OK;
}

static enum status sort(struct grid *g, struct fault *fault) {
    const struct sphere_cells_box *b = g->box;
    size_t cells = g->n[0] * g->n[1] * g->n[2];
    g->head = malloc(cells * sizeof *g->head);
    g->next = malloc((b->count ? b->count : 1) * sizeof *g->next);
    if (!g->head || !g->next)
        return fault_set(fault, STATUS_NO_MEMORY, "no memory for %zu cells", cells);
    for (size_t c = 0; c < cells; c++)
        g->head[c] = NONE;
    for (size_t i = 0; i < b->count; i++) {
        size_t c[3];
        for (size_t a = 0; a < 3; a++) {
            double x = g->position[3 * i + a];
            if (!(x >= -b->diameter && x <= b->side[a] + b->diameter))
                return fault_set(fault, STATUS_BAD_INPUT, "sphere %zu is outside the box: %g of %g",
                                 i, x, b->side[a]);
            c[a] = cell_along(g, a, x);
        }
        g->next[i] = g->head[cell_of(g, c)];
        g->head[cell_of(g, c)] = i;
    }
    return STATUS_OK;
}

static double distance2(const struct grid *g, size_t i, size_t j) {
    double sum = 0;
    for (size_t a = 0; a < 3; a++) {
        double way = g->position[3 * i + a] - g->position[3 * j + a];
        if (g->box->periodic[a])
            way -= g->box->side[a] * round(way / g->box->side[a]);
        sum += way * way;
    }
    return sum;
}

/* Neighbouring cell along an axis, or NONE beyond a wall. */
static size_t beside(const struct grid *g, size_t axis, size_t c, int step) {
    size_t n = g->n[axis];
    if (step < 0 && c == 0)
        return g->box->periodic[axis] ? n - 1 : NONE;
    if (step > 0 && c == n - 1)
        return g->box->periodic[axis] ? 0 : NONE;
    return step < 0 ? c - 1 : step > 0 ? c + 1 : c;
}

/* Least squared distance of sphere i to any of higher index. */
static double closest2(const struct grid *g, size_t i, double least) {
    size_t own[3], c[3];
    for (size_t a = 0; a < 3; a++)
        own[a] = cell_along(g, a, g->position[3 * i + a]);
    for (int s = 0; s < 27; s++) {
        int step[3] = {s % 3 - 1, s / 3 % 3 - 1, s / 9 - 1};
        bool there = true;
        for (size_t a = 0; a < 3; a++) {
            c[a] = beside(g, a, own[a], step[a]);
            there = there && c[a] != NONE;
        }
        if (!there)
            continue;
        for (size_t j = g->head[cell_of(g, c)]; j != NONE; j = g->next[j])
            if (j > i)
                least = fmin(least, distance2(g, i, j));
    }
    return least;
}

enum status sphere_cells_overlap(const struct sphere_cells_box *box, const double *position,
                                 double *deepest, struct fault *fault) {
    struct grid g = {.box = box, .position = position};
    double least = box->diameter * box->diameter, wall = box->diameter / 2;
    enum status status = choose(&g, fault);
    if (!status)
        status = sort(&g, fault);
    for (size_t i = 0; !status && i < box->count; i++) {
        least = closest2(&g, i, least);
        for (size_t a = 0; a < 3; a++)
            if (!box->periodic[a])
                wall = fmin(wall, fmin(position[3 * i + a], box->side[a] - position[3 * i + a]));
    }
    *deepest = fmax(1 - sqrt(least) / box->diameter, 0.5 - wall / box->diameter);
    free(g.head);
    free(g.next);
    return status;
}
