/* kinematic_wave.h -- how a bed without pressure and inertia rises or settles: shocks and fans.
 *
 * Where drag is strong the speed of spheres is a function of the packing fraction alone
 * (bed_change.h), and continuity is a kinematic wave,
 *
 *     d phi/dt + d f/dz = 0,      f(phi) = phi v(phi)                          (1)
 *
 * for a slab of packing fraction `before` under z = load/before, on a floor that nothing passes.
 * Nothing but phibar rests on the floor (f = 0), so the solution starts as two Riemann problems:
 * from phibar to `before` at the floor, from `before` to 0 at the top.  Each is solved by
 * the convex envelope of f (lower one where phi rises with height, upper one where it falls).
 *
 * f is taken straight between KNOTS packing fractions.  (1) is then solved exactly: all states are
 * knots, all waves are jumps at constant speed, and where two meet there is a new Riemann
 * problem (front tracking).  A fan is a staircase of jumps; the error is of order (knot
 * spacing)^2 in f and first order in position.  One engine serves both laws and both directions.
 *
 * In closed form, for the linear law: all ends at load/(c before after) in compaction and at
 * load/(c after^2) in expansion; see docs/theory.md, S7.
 *
 * Source:     Kynch, Trans. Faraday Soc. 48, 166 (1952); Dafermos, J. Math. Anal. Appl. 38, 33
 *             (1972) for front tracking; Fiege & Zippelius, Eqs. 1 and 9.
 * Leaves out: pressure (pressure_wave.h), inertia, the layer over which phi is averaged.
 * Checked by: tests/unit/test_kinematic_wave.c (finite volumes, closed forms).
 */
#ifndef VALIDATION_KINEMATIC_WAVE_H
#define VALIDATION_KINEMATIC_WAVE_H

#include "validation/bed_change.h"

struct kinematic_wave; /* opaque */

enum status kinematic_wave_create(const struct bed_change *change, struct kinematic_wave **out,
                                  struct fault *fault);
void kinematic_wave_free(struct kinematic_wave *w); /* NULL is allowed */

/* On to this time after the change (s), not before the present one. */
enum status kinematic_wave_advance(struct kinematic_wave *w, double time_s, struct fault *fault);
/* Is there only the bed's top left? */
bool kinematic_wave_rests(const struct kinematic_wave *w);
/* On until it rests; *time_s: when it came to. */
enum status kinematic_wave_settle(struct kinematic_wave *w, double *time_s, struct fault *fault);

double kinematic_wave_centre(const struct kinematic_wave *w); /* of mass (m) */
/* Means over slabs of height bin_m from the floor: fraction[0 .. bins-1] (1). */
void kinematic_wave_profile(const struct kinematic_wave *w, double bin_m, double *fraction,
                            size_t bins);

/* When the linear law's waves have done (s): closed form. */
double kinematic_wave_end(const struct bed_change *change);

#endif
