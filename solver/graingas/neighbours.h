/* neighbours.h -- which grains may touch soon: a pair list with a skin.
 *
 * Cells a little wider than the largest diameter; at a rebuild the grains are
 * reordered cell by cell, row by row from the bottom, so that the candidates
 * of a grain are two runs of consecutive grains: the rest of its own cell with
 * the cell to the right, and three cells of the row above.  Pairs closer than
 * the sum of radii plus the skin are kept, each once, with the lower index
 * first.  The list is good until some grain has moved half a skin.
 *
 * Cost: O(grains) a rebuild; ci/bench shows the search as a whole.
 */
#ifndef GRAINGAS_NEIGHBOURS_H
#define GRAINGAS_NEIGHBOURS_H

#include "solver/graingas/grains.h"

#include <stdbool.h>

struct neighbours {
    double width, height, skin, cell; /* (l) */
    int columns, rows;
    size_t count;             /* grains */
    int32_t *cell_start;      /* cell_start[0 .. columns*rows] */
    int32_t *cell_of, *order; /* [0 .. count-1] */
    double *x, *y;            /* positions at the last rebuild */
    size_t *first;            /* pairs of grain i: other[first[i] .. first[i+1]-1] */
    int32_t *other;           /* grown as needed, at a rebuild */
    size_t capacity;
    long long rebuilds;
    bool built;
};

enum status neighbours_create(struct neighbours *n, size_t count, double width, double height,
                              double diameter_max, struct fault *fault);
void neighbours_free(struct neighbours *n);

/* Rebuild (and reorder the grains) if the list may have become incomplete. */
enum status neighbours_update(struct neighbours *n, struct grains *g, struct fault *fault);

#endif
