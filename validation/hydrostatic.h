/* hydrostatic.h -- the profile of a bed at rest: pressure against weight and lift.
 *
 * At rest, and without mean motion, the pressure of the spheres carries the force on each
 * slab of the bed.  With n = p/V the density of the bulk fluid at a height, P = n T Z(p)
 * after Carnahan & Starling, and F(z) = m b' (phi_layer(z) - phibar), b' = b/(1 - phibar),
 *
 *     dP/dz = n F    or    a (d(p Z t)/dz)/p = phi_layer(z) - phibar,   a = T/(m b')       (1)
 *
 * t(p) = 1: the bed has one temperature.  In the dilute end p falls as exp(-phibar z/a), the
 * law of barometers.  phi_layer is what a sphere at z counts,
 *
 *     phi_layer(z) = 1/(u - l) integral from l to u of phi,  u = z + Delta/2, l = max(z - Delta/2,
 * 0)
 *
 * with phi(z) = (V/A) sum of delta(z - z_i), A the whole cross-section.  It is not p: centres keep
 * R away from side walls, but crowd there.  Spheres missing at a wall fill the depth
 *
 *     d(p) = R - G/n,   G/n = 3 p (1 + 2p)/(1 + 4p + 4p^2 - 4p^3 + p^4) R                  (2)
 *
 * G = -d(tension)/d mu the excess of centres at a wall, the tension that of scaled-particle
 * theory, -(9/2 pi) p^2 (1+p)/(1-p)^3 T/(4R^2), mu Carnahan and Starling's; so phi = p (1 -
 * 2d/Wx)(1 - 2d/Wy). The walls' tension takes part in the balance of a slab exactly so that (1)
 * holds with p: both are d mu = F dz.  A floor keeps the same depth free: the profile starts at
 * d(phibar).
 *
 * With `local_temperature` t(p) follows from the balance of powers at each height alone, for the
 * kicks of the run: t (2 gamma + (1/3) f(p, T t)(1 - eps^2)) is the same at all heights, f Enskog's
 * rate, and t = 1 at p of phi = phibar.  Conduction of heat, left out, would spread it.
 *
 * or is a smooth law through temperatures measured at packing fractions, which leaves the
 * balance of forces alone to be tested.  Collisions of restitution eps push (1 + eps)/2 as hard, so
 * that
 *
 *     Z = 1 + ((1 + eps)/2) 4 p chi(p)                                                       (3)
 *
 * Solved for N(z), the column above z, on a grid that Delta/2 is a multiple of, by Newton's method:
 * second order in the spacing, and exact for the dilute end's exponential.
 *
 * Source:     Fiege & Zippelius, Eq. 9; Carnahan & Starling, J. Chem. Phys. 51, 635 (1969); Reiss,
 *             Frisch, Helfand & Lebowitz, J. Chem. Phys. 32, 119 (1960) for the tension.
 * Leaves out: layering (phi is smooth down to the floor), correlations across the box, anisotropy
 * of the temperature, the drive's own fluctuations, motion of the bed as a whole. Checked by:
 * tests/unit/test_hydrostatic.c, suspension/interface-width.
 */
#ifndef VALIDATION_HYDROSTATIC_H
#define VALIDATION_HYDROSTATIC_H

#include "common/fault.h"

#include <stdbool.h>
#include <stddef.h>

enum { HYDROSTATIC_TERMS = 4 };

struct hydrostatic_bed {
    double phibar;   /* (1) */
    double a_R;      /* T/(m b') over R (R) */
    double layer_R;  /* Delta (R) */
    double column_R; /* N V/(Wx Wy): all spheres, as the height of a solid layer (R) */
    double width_R[2];
    bool walls[2]; /* are the sides across x, y hard? else periodic, and (2) is left out */
    bool floor;    /* is the depth (2) free on the floor? */
    /* Local balance of powers; heat_ratio = (1/3)(1 - eps^2) f(phibar, T)/(2 gamma) (1) */
    bool local_temperature;
    double heat_ratio;
    /* Measured: ln t = sum c[i] phi^i up to phi = measured_to, constant beyond; measured_to 0:
     * none. */
    double c[HYDROSTATIC_TERMS], measured_to;
    double restitution; /* of (3); 0: elastic */
    double spacing_R;   /* 0: chosen; else made to divide Delta/2 */
};

struct hydrostatic_profile {
    size_t count;
    double *height_R, *fraction; /* [0 .. count-1], middles of cells; owned (R, 1) */
    double spacing_R;            /* (R) */
};

/* STATUS_BAD_INPUT where a bed is no bed (phibar outside (0, .6), nothing positive, not ten layers
 * high: column/phibar > Delta is enough); STATUS_NUMERICAL without convergence. On error
 * the profile is empty. */
enum status hydrostatic_solve(const struct hydrostatic_bed *bed, struct hydrostatic_profile *out,
                              struct fault *fault);
void hydrostatic_free(struct hydrostatic_profile *p);

/* p from phi and phi from p (2) (1). */
double hydrostatic_bulk_of(const struct hydrostatic_bed *bed, double fraction);
double hydrostatic_fraction_of(const struct hydrostatic_bed *bed, double bulk);
/* d(p) in R (2). */
double hydrostatic_depth_R(double bulk);
/* t(p): 1 where nothing says otherwise. */
double hydrostatic_temperature(const struct hydrostatic_bed *bed, double bulk);

#endif
