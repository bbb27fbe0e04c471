#include "solver/suspension/grid.h"

#include <math.h>
#include <stdlib.h>

/* Cells no narrower than the reach, and not many more than spheres. */
static void choose_cells(struct grid *g, size_t count) {
    double most = fmax(1, ceil(cbrt((double)count)) * 4);
    for (int a = 0; a < 3; a++) {
        double cells = fmin(floor(g->box[a] / g->reach), most);
        g->cells[a] = cells >= 3 ? (size_t)cells : 1;
    }
}

enum status grid_create(struct grid *g, const double box[3], const enum boundary boundary[3],
                        double reach, const double *position, size_t count, struct fault *fault) {
    *g = (struct grid){.reach = reach, .position = position};
    for (int a = 0; a < 3; a++) {
        g->box[a] = box[a];
        g->periodic[a] = boundary[a] == BOUNDARY_PERIODIC;
    }
    choose_cells(g, count);
    size_t cells = g->cells[0] * g->cells[1] * g->cells[2];
    g->first = malloc(cells * sizeof *g->first);
    g->next = malloc((count + 1) * sizeof *g->next);
    if (!g->first || !g->next) {
        grid_free(g);
        return fault_set(fault, STATUS_NO_MEMORY, "no memory for %zu cells", cells);
    }
    for (size_t k = 0; k < cells; k++)
        g->first[k] = -1;
    return STATUS_OK;
}

void grid_free(struct grid *g) {
    free(g->first);
    free(g->next);
    *g = (struct grid){0};
}

static size_t index_along(const struct grid *g, int a, double x) {
    double k = floor(x / g->box[a] * (double)g->cells[a]);
    return (size_t)fmin(fmax(k, 0), (double)(g->cells[a] - 1));
}

static size_t cell_at(const struct grid *g, const size_t k[3]) {
    return (k[2] * g->cells[1] + k[1]) * g->cells[0] + k[0];
}

void grid_put(struct grid *g, size_t i) {
    size_t k[3];
    for (int a = 0; a < 3; a++)
        k[a] = index_along(g, a, g->position[3 * i + (size_t)a]);
    size_t cell = cell_at(g, k);
    g->next[i] = g->first[cell];
    g->first[cell] = (int32_t)i;
}

static bool visit_cell(const struct grid *g, size_t cell, const double x[3], grid_visitor *visit,
                       void *context) {
    for (int32_t j = g->first[cell]; j >= 0; j = g->next[j]) {
        double apart[3], square = 0;
        for (size_t a = 0; a < 3; a++) {
            apart[a] = g->position[3 * (size_t)j + a] - x[a];
            if (g->periodic[a])
                apart[a] -= g->box[a] * round(apart[a] / g->box[a]);
            square += apart[a] * apart[a];
        }
        if (square <= g->reach * g->reach && !visit(context, (size_t)j, apart))
            return false;
    }
    return true;
}

/* The cell `step` from k along an axis; false when there is none. */
static bool step_along(const struct grid *g, int a, size_t k, int step, size_t *out) {
    size_t n = g->cells[a];
    bool outside = step < 0 ? k == 0 : step > 0 && k + 1 == n;
    if ((n == 1 && step != 0) || (outside && !g->periodic[a]))
        return false;
    *out = step < 0 ? (k + n - 1) % n : (k + (size_t)step) % n;
    return true;
}

bool grid_visit(const struct grid *g, const double x[3], grid_visitor *visit, void *context) {
    size_t home[3], k[3];
    for (int a = 0; a < 3; a++)
        home[a] = index_along(g, a, x[a]);
    for (int c = -1; c <= 1; c++)
        for (int b = -1; b <= 1; b++)
            for (int a = -1; a <= 1; a++)
                if (step_along(g, 2, home[2], c, &k[2]) && step_along(g, 1, home[1], b, &k[1]) &&
                    step_along(g, 0, home[0], a, &k[0]) &&
                    !visit_cell(g, cell_at(g, k), x, visit, context))
                    return false;
    return true;
}
