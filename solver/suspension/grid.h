/* grid.h -- spheres sorted into cells, to find those near a place.
 *
 * For what happens outside the run's events: placing spheres at the start and
 * counting neighbours for an observable.  Cells are at least as wide as the reach,
 * so that all within reach lie in the 27 cells around; periodic sides wrap round,
 * and a side of fewer than three cells is one cell.
 *
 * Checked by: tests/unit/test_bonds.c.
 */
#ifndef SUSPENSION_GRID_H
#define SUSPENSION_GRID_H

#include "solver/suspension/engine.h"

#include <stdint.h>

struct grid {
    double box[3], reach; /* (m) */
    bool periodic[3];
    size_t cells[3];
    const double *position; /* position[3*i+axis] of the spheres put in (m); borrowed */
    int32_t *first;         /* first[cell], or -1 */
    int32_t *next;          /* next[i] in the same cell, or -1 */
};

/* For up to count spheres of position[3*i+axis]; none is in yet. */
enum status grid_create(struct grid *g, const double box[3], const enum boundary boundary[3],
                        double reach, const double *position, size_t count, struct fault *fault);
void grid_free(struct grid *g);

/* Put sphere i in at its position. */
void grid_put(struct grid *g, size_t i);

/* Called with sphere j and the shortest vector to it (m); false ends the visit. */
typedef bool grid_visitor(void *context, size_t j, const double apart[3]);

/* Visit every sphere put in within the reach of x; false when a visitor ended it. */
bool grid_visit(const struct grid *g, const double x[3], grid_visitor *visit, void *context);

#endif
