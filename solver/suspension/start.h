/* start.h -- initial states of the spheres.
 *
 * random     Centres one after the other at uniform places that touch no other, up
 *            to a packing fraction of .12; denser, with spheres small enough for .12,
 *            which then grow while they move (Lubachevsky & Stillinger, J. Stat. Phys.
 *            60, 561 (1990)): elastic, diameters at start_growth_rate thermal speeds,
 *            hard sides fixed, the temperature set back every now and then.  Then
 *            Maxwell velocities; the total momentum is 0 along periodic axes, and
 *            the kinetic energy is exactly that of the temperature.
 *            With a wave, spheres grow to 1 + A times the diameter; then heights are
 *            mapped so that the density is 1 + A sin(2 pi k z/L): distances shrink by
 *            1 + A at most, so that none overlap.
 * sharp      The same, grown not in the whole box but between the floor and a hard lid at
 *            the height h = N V/(phibar A) where phibar fills it: a fluid in equilibrium
 *            without gravity, layered at floor and lid.  Then the lid is lifted.  Centres
 *            keep a radius from both, so phi(z) of centres is phibar h/(h - 2R) between.
 *            Source: Fiege & Zippelius (2014), Section IV A.
 * from-file  The last particle sample of an earlier suspension result, whose spheres
 *            must be as many and as large; the box may be another.
 * list       Centres and velocities as given.
 *
 * Checked by: tests/unit/test_suspension_start.c.
 */
#ifndef SUSPENSION_START_H
#define SUSPENSION_START_H

#include "solver/suspension/parameters.h"

/* Fill position, velocity[3*i+axis] (m, m/s) of v->particles spheres.  file: the
 * earlier result, for from-file only.  *collisions: of the growth, per sphere. */
enum status suspension_start(const struct suspension_parameters *v, struct h5_reader *file,
                             uint64_t seed, double *position, double *velocity, double *collisions,
                             struct fault *fault);

/* The engine's set-up that the parameters mean. */
struct engine_setup suspension_start_setup(const struct suspension_parameters *v);

#endif
