/* start.h -- initial states of the grains.
 *
 * random        uniform centres, then sweeps in which every overlapping pair is
 *               pushed apart by its overlap, half each, until none overlaps;
 *               random sequential placement would jam near area fraction .55.
 * equilibrated  random, then elastic motion without gravity and gas: Gaussian
 *               velocities of standard deviation equilibrate_speed, for
 *               equilibrate_tau; velocities are set to zero afterwards.
 * from-file     the last particle sample of an earlier result.
 * list          centres, diameters and velocities as given.
 *
 * The paper does not say which state it starts from; the settling speed depends
 * on it by up to 15 % (docs/theory.md).
 */
#ifndef GRAINGAS_START_H
#define GRAINGAS_START_H

#include "solver/graingas/grains.h"
#include "solver/graingas/parameters.h"

/* Fill g (made by grains_create for p->grains).  start: the earlier result, for
 * from-file only.  collisions_per_grain: of the equilibration, else 0. */
enum status start_make(struct grains *g, const struct graingas_parameters *p,
                       struct h5_reader *start, uint64_t seed, double *collisions_per_grain,
                       struct fault *fault);

#endif
