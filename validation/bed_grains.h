/* bed_grains.h -- what the grains of a bed did: how mixed they are, how many never moved.
 *
 * Mixing is Lacey's index over square cells of n_c grains each, p_c of them of
 * species 1 (P in all),
 *
 *     M = (s0^2 - s^2)/(s0^2 - sr^2),   s^2 = sum n_c (p_c - P)^2 / N
 *     s0^2 = P (1 - P),                 sr^2 = s0^2 (C - 1)/(N - 1)
 *
 * with C the cells that hold a grain: 0 where every cell has one species only, 1
 * on average where colours are drawn at random (sr^2 is the exact mean of s^2 over
 * all permutations).  Layers that end inside a cell count as mixed: a start has its
 * own M, above 0.
 *
 * The static layer is how far up from the floor the grains of a row have moved, on
 * average, less than a limit; the layer left behind, how far up rows have risen less:
 * its grains may be pushed about, but it stays. Both straight between the middles of
 * two rows, and from 0 at the floor.
 *
 * Source:     P. M. C. Lacey, J. Appl. Chem. 4, 257 (1954); docs/theory.md.
 * Leaves out: mixing below the size of a cell.
 * Checked by: tests/unit/test_observe_bed.c.
 */
#ifndef VALIDATION_BED_GRAINS_H
#define VALIDATION_BED_GRAINS_H

#include "validation/observe.h"

/* species[0 .. g->count-1]: 0 or another number.  NaN where all are of one species. */
enum status bed_grains_mixing(struct run_view *v, const struct observe_grains *g,
                              const struct observe_box *box, const double *species, size_t frame,
                              double cell_l, double *mixing, struct fault *fault);

struct bed_grains_layers {
    double still; /* up to here rows have moved less than the limit (l) */
    double left;  /* up to here they have risen less (l) */
};
/* Rows of row_l by the positions at the start frame. */
enum status bed_grains_layers(struct run_view *v, const struct observe_grains *g,
                              const struct observe_box *box, size_t start, size_t end, double row_l,
                              double limit_l, struct bed_grains_layers *out, struct fault *fault);

#endif
