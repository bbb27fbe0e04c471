/* cells.h -- which spheres are near: a grid of cells no smaller than a diameter.
 *
 * Partners of a sphere are in its cell and the 26 around it.  A cell is a block of
 * four labels, so that three neighbours along x are 48 bytes in a row and most are
 * copied by one vector store; a cell with more than four continues in a further
 * block, to which its fourth label points.  Along a periodic axis the neighbour
 * across the boundary is seen through a shift of one side, which follows from the
 * cells and not from the distance: so two or three cells along an axis suffice,
 * and with two the same cell is seen twice, through either side.
 *
 * The grid covers the places of centres: [0, L] along a periodic axis, [R, L - R]
 * between hard sides, where one cell may do and no partner lies beyond.
 */
#ifndef SUSPENSION_CELLS_H
#define SUSPENSION_CELLS_H

#include "common/fault.h"
#include "solver/suspension/spheres.h"

#include <stdbool.h>

enum { CELL_LABELS = 4, CELLS_MOST = 65535 }; /* labels a block; cells along one axis */
#define CELLS_EMPTY UINT32_MAX
#define CELLS_LINK  (UINT32_C(1) << 31) /* in a fourth label: the block that continues */

struct cells {
    uint32_t n[3];
    bool periodic[3];
    double side[3];  /* (m) the period along a periodic axis */
    double *edge[3]; /* edge[axis][0 .. n[axis]]: planes between cells (m) */
    uint32_t *label; /* label[CELL_LABELS (total + spare)]; EMPTY after the last */
    uint32_t total;  /* cells */
    uint32_t spare;  /* blocks for crowded cells */
    uint32_t free_block;
};

/* For `count` spheres in [low, high] along each axis, cells of at least `least` (m). */
enum status cells_create(struct cells *c, size_t count, const double low[3], const double high[3],
                         const bool periodic[3], double least, struct fault *fault);
void cells_free(struct cells *c);
void cells_clear(struct cells *c); /* no sphere in any */
size_t cells_bytes(const struct cells *c);

void cells_insert(struct cells *c, uint32_t cell, uint32_t sphere);
void cells_remove(struct cells *c, uint32_t cell, uint32_t sphere);

/* Give the spheres new labels 0, 1, 2 ... in the order of cells: place[old] = new. */
void cells_renumber(struct cells *c, uint32_t *place);

/* The cell along an axis that holds x, for the start only. */
uint16_t cells_find(const struct cells *c, int axis, double x);

static inline uint32_t cells_index(const struct cells *c, uint32_t ix, uint32_t iy, uint32_t iz) {
    return (iz * c->n[1] + iy) * c->n[0] + ix;
}

static inline uint32_t cells_of(const struct cells *c, const uint16_t cell[3]) {
    return cells_index(c, cell[0], cell[1], cell[2]);
}

/* How long until a sphere leaves its cell (s, from its local time), and along which
 * axis, upwards or downwards; INFINITY for one at rest. */
static inline double cells_exit(const struct cells *c, const struct sphere *s,
                                const uint16_t cell[3], int *axis) {
    double best = INFINITY;
    *axis = 0;
    for (int a = 0; a < 3; a++) {
        double plane = c->edge[a][cell[a] + (s->w[a] > 0)];
        double dt = (plane - s->x[a]) / s->w[a];
        if (s->w[a] != 0 && dt < best) {
            best = dt;
            *axis = a;
        }
    }
    return best;
}

#endif
