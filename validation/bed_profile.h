/* bed_profile.h -- where a bed ends: its top from the solid fraction on the lattice.
 *
 * The profile is the mean of the solid fraction over the width, row by row, the
 * half cells at the side walls counted as half.  The bulk is the median of the
 * rows above .3, so that neither the dilute gas above nor a gap at the floor
 * moves it.  The top is the height where the profile, coming from above, first
 * reaches half the bulk, straight between two rows:
 *
 *     <rho>(top) = bulk/2,     <rho>(y) < bulk/2 for all rows above
 *
 * so single grains thrown into the freeboard do not count as bed.
 *
 * Source:     own definition; docs/theory.md, "Bubbles".
 * Leaves out: a surface that is not level: its bumps are averaged.
 * Checked by: tests/unit/test_bed_profile.c.
 */
#ifndef VALIDATION_BED_PROFILE_H
#define VALIDATION_BED_PROFILE_H

#include <stddef.h>

/* solid_fraction[j*nx + i] (1) at the site x = i, y = j, as in fields/solid_fraction. */

/* Mean over row j (1). */
double bed_profile_row(const double *solid_fraction, size_t nx, size_t j);
/* Median of the rows above .3 (1), the mean of the middle two of an even number.
 * NaN if there is none, or if there are more than 4096 rows. */
double bed_profile_bulk(const double *solid_fraction, size_t nx, size_t ny);
/* Height of the top (l); NaN where the bulk is, so NaN: there is no bed. */
double bed_profile_top(const double *solid_fraction, size_t nx, size_t ny);

#endif
