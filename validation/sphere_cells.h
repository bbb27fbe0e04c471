/* sphere_cells.h -- the deepest overlap of spheres, by sorting them into cells.
 *
 * Cells are a diameter or more a side, so that two spheres that overlap lie in the
 * same cell or in neighbours; O(N).
 *
 * Source:     geometry.
 * Leaves out: spheres of several sizes.
 * Checked by: tests/unit/test_sphere_cells.c, against all pairs.
 */
#ifndef VALIDATION_SPHERE_CELLS_H
#define VALIDATION_SPHERE_CELLS_H

#include "common/fault.h"

#include <stdbool.h>
#include <stddef.h>

struct sphere_cells_box {
    size_t count;
    double diameter, side[3]; /* of one unit of length */
    bool periodic[3];
};

/* position[3*i + axis], in the box.  *deepest: (diameter - distance)/diameter of the closest
 * pair, and (diameter/2 - distance)/diameter of the sphere closest to a wall; 0 when
 * nothing overlaps.  STATUS_BAD_INPUT names a sphere outside the box, and a periodic side under
 * three diameters. */
enum status sphere_cells_overlap(const struct sphere_cells_box *box, const double *position,
                                 double *deepest, struct fault *fault);

#endif
