/* profiles.h -- packing fraction and granular temperatures in slabs of height.
 *
 *     phi(z) = V/(A w) (centres in the slab)                        (FZ Eq. 11, corrected)
 *     T_xy = m sum (v_x - u_x)^2 + (v_y - u_y)^2 / (2 (n - 1))
 *     T_zz = m sum (v_z - u_z)^2 / (n - 1)
 *
 * n centres in the slab, u their mean velocity, w the slab's height, A the box's
 * cross-section, V a sphere's volume.  FZ's prefactor phibar/N makes phi(z)
 * integrate to phibar rather than to phibar times the bed's height.  Slabs with
 * fewer than two centres have temperature 0.  The temperatures of the whole are the
 * same sums over all slabs: about the slabs' own velocities, so that slugs that move
 * up and down do not count as heat.
 *
 * Source:     Fiege & Zippelius (2014), "FZ".
 * Leaves out: shear within a slab, which counts as heat.
 * Checked by: tests/unit/test_bonds.c.
 */
#ifndef SUSPENSION_PROFILES_H
#define SUSPENSION_PROFILES_H

#include "solver/suspension/parameters.h"

struct profiles {
    size_t bins;
    double *packing, *xy, *zz; /* [0 .. bins-1] (1, J, J) */
    double whole_xy, whole_zz; /* (J) */
    double *mean;              /* scratch: n, u_x, u_y, u_z of each slab */
};

enum status profiles_create(struct profiles *f, const struct suspension_parameters *p,
                            struct fault *fault);
void profiles_free(struct profiles *f);

/* From position, velocity[3*i+axis] (m, m/s) of all spheres. */
void profiles_make(struct profiles *f, const struct suspension_parameters *p,
                   const double *position, const double *velocity);

#endif
