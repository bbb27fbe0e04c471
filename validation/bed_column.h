/* bed_column.h -- a bed as a column: load, centre of mass, top, fractions, frame by frame.
 *
 * All from the solid fraction on the lattice.  The halo's weights sum to 1 and
 * keep a grain's centre, so with V_k the cell of site k
 *
 *     load   = sum V_k rho_k / width                 height of solid (l)
 *     centre = sum V_k rho_k y_k / sum V_k rho_k     mass-weighted (l)
 *
 * are exactly those of the grains.  The top is bed_profile's; the bulk fraction
 * is load/top; the slab fraction is the mean between margin and top - margin, the
 * rows joined by straight lines.  The halo spreads a grain over less than 1 l, so
 * the slab's ends are blurred by as much: without effect where the bed is uniform
 * there, a wrong weight for 1 l of the bed where it is not.
 *
 *     weight = Pe gravity load,     freeboard = Pe q (height - top)/K(rho_min)
 *
 * are the pressure drops (P0) that carry the bed and that the flux q has in the
 * clear gas above it.
 *
 * Source:     docs/theory.md, "Fluidization"; MFM, Eqs. 8, 11 and 13.
 * Leaves out: grains in the freeboard, which add to its drop where rho > rho_min.
 * Checked by: tests/unit/test_observe_packed.c and _drop.c through the recipes.
 */
#ifndef VALIDATION_BED_COLUMN_H
#define VALIDATION_BED_COLUMN_H

#include "validation/observe.h"

struct bed_column {
    double load, centre, top; /* (l); top is NaN without a bed */
    double bulk_fraction;     /* load/top (1) */
    double slab_fraction;     /* (1); NaN where the margins leave nothing */
};

/* solid_fraction[0 .. box->sites-1]; margin_l is left out at the floor and under the top. */
struct bed_column bed_column_measure(const double *solid_fraction, const struct observe_box *box,
                                     double margin_l);

/* Height above which lies so much solid (l); NaN if there is less. On a rigid bed it moves
 * as the bed does, where the top, read off between two rows, swings by .07 l over each row. */
double bed_column_marker(const double *solid_fraction, const struct observe_box *box,
                         double solid_l);

/* Pressure at the floor less that at the upper wall, each the mean over the width (P0). */
double bed_column_drop(const double *pressure, const struct observe_box *box);
/* The drop that carries a column, and that of the freeboard above it at a flux (P0). */
double bed_column_weight(const struct bed_column *c, const struct observe_physics *physics);
double bed_column_freeboard(const struct bed_column *c, const struct observe_box *box,
                            const struct observe_physics *physics, double flux);

/* Straight line through x[0 .. count-1], y: its slope and the slope's standard error
 * from the scatter about it.  NaN with fewer than 3 points. */
double bed_column_slope(const double *x, const double *y, size_t count, double *error);

#endif
