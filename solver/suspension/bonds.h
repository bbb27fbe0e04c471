/* bonds.h -- global bond-orientational order Q6: is the fluid a crystal?
 *
 *     Q6 = sqrt(4 pi/13 sum_m |mean of Y_6m over all bonds|^2)
 *
 * over all ordered pairs of centres nearer than 1.4 diameters, between the first and
 * the second shell of a crystal of packing fraction .5 to .74.  A fluid of B bonds
 * has about 1/sqrt(B); a perfect face-centred cubic crystal .575, hexagonal close
 * packing .485, and several crystals in different directions less.
 *
 * Source:     P. J. Steinhardt, D. R. Nelson & M. Ronchetti, Phys. Rev. B 28, 784 (1983).
 * Leaves out: local order: many small crystals look like a fluid.
 * Checked by: tests/unit/test_bonds.c.
 */
#ifndef SUSPENSION_BONDS_H
#define SUSPENSION_BONDS_H

#include "solver/suspension/engine.h"

/* position[3*i+axis] (m) of setup->count spheres; *q6 is 0 without bonds. */
enum status bonds_order(const struct engine_setup *setup, const double *position, double *q6,
                        struct fault *fault);

#endif
