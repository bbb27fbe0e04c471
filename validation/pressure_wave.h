/* pressure_wave.h -- how a bed rises or settles when spheres push each other: the joint of the
 * kinematic wave and the hydrostatic interface.
 *
 * Momentum at constant temperature, for the mean speed v of spheres at z; without inertia
 *
 *     phi v = phi v_k(<phi>, phibar) - mu dp/dz,   mu = 1/gamma
 *     p = (T/m) phi (1 + ((1 + eps)/2) (Z(phi) - 1))
 *     d phi/dt + d(phi v)/dz = 0,                    v = 0 at the floor           (1)
 *
 * with v_k the speed without pressure (bed_change.h) at the mean packing fraction <phi> of the
 * layer of thickness Delta about z, cut off at the floor, and Z of Carnahan and Starling; inelastic
 * spheres press each other by (1 + eps)/2 of what elastic ones do.  For T ->
 * 0, Delta -> 0 this is the kinematic wave; at rest it is the hydrostatic balance.
 *
 * With inertia (bed_change.inertia) the flux j follows phi v: dj/dt = -gamma (j - phi v), and (1)
 * is d phi/dt + dj/dz = 0.
 *
 * Finite volumes of a height of cell_m: v_k phi with the value upstream, its slope limited (van
 * Leer); pressure implicitly, linear in the change, by a tridiagonal system a step. Solid is
 * conserved to round-off and a state of rest is that of the balance between cells.
 *
 * Source:     Fiege & Zippelius, Eqs. 1 and 9; Carnahan & Starling (sphere_laws.h); docs/theory.md,
 *             S7.
 * Leaves out: d(j^2/phi)/dz, viscosity, changes of temperature, crystals, the layers of spheres
 *             at floor and sides (hydrostatic.h has those of the sides).
 * Checked by: tests/unit/test_pressure_wave.c.
 */
#ifndef VALIDATION_PRESSURE_WAVE_H
#define VALIDATION_PRESSURE_WAVE_H

#include "validation/bed_change.h"

struct pressure_wave; /* opaque */

/* A sharp slab of packing fraction `before`; phibar is `before` until pressure_wave_change. */
enum status pressure_wave_create(const struct bed_change *change, double cell_m,
                                 struct pressure_wave **out, struct fault *fault);
void pressure_wave_free(struct pressure_wave *w); /* NULL is allowed */

/* On until phi changes nowhere by more than 1e-4 a second; the time is then 0 again. */
enum status pressure_wave_settle(struct pressure_wave *w, struct fault *fault);
/* From now on phibar is `after`. */
void pressure_wave_change(struct pressure_wave *w);
enum status pressure_wave_advance(struct pressure_wave *w, double time_s, struct fault *fault);

double pressure_wave_centre(const struct pressure_wave *w); /* of mass (m) */
double pressure_wave_solid(const struct pressure_wave *w);  /* height of solid (m) */
/* Means over slabs of height bin_m from the floor: fraction[0 .. bins-1] (1). */
void pressure_wave_profile(const struct pressure_wave *w, double bin_m, double *fraction,
                           size_t bins);

#endif
