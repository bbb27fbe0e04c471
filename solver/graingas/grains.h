/* grains.h -- the discs: positions, velocities, sizes, as plain arrays.
 *
 * Grains are kept in an order that follows the contact cells, so that grains
 * near in space are near in memory; `id` is what names a grain for ever.  One
 * entry past the last grain stands for the walls: no inverse mass, no speed.
 */
#ifndef GRAINGAS_GRAINS_H
#define GRAINGAS_GRAINS_H

#include "common/fault.h"

#include <stddef.h>
#include <stdint.h>

struct grains {
    size_t count;
    double *x, *y;        /* centres, x[0 .. count-1] (l) */
    double *vx, *vy;      /* velocities, [0 .. count] (U0); entry count: the walls */
    double *radius;       /* radius[0 .. count-1] (l) */
    double *area;         /* pi radius^2, which is also the mass (l^2) */
    double *inverse_mass; /* [0 .. count] (1/l^2); entry count: 0, the walls */
    int64_t *last_hit;    /* step of the last collision, [0 .. count] */
    int32_t *id;          /* id[0 .. count-1], from 0 */
    int32_t *species;     /* species[0 .. count-1], 0 or 1 */
    double *scratch;      /* room for a permutation, scratch[0 .. count-1] */
};

enum { GRAINS_NEVER_HIT = -1000 };

/* Room for count grains; all zero, ids 0 .. count-1, never hit. */
enum status grains_create(struct grains *g, size_t count, struct fault *fault);
void grains_free(struct grains *g);

/* Area and inverse mass from the radii. */
void grains_weigh(struct grains *g);

/* Reorder all arrays: new entry k is the old entry order[k]. */
void grains_permute(struct grains *g, const int32_t *order);

/* Sum of (1/2) m v^2 (l^2 U0^2). */
double grains_kinetic_energy(const struct grains *g);

#endif
