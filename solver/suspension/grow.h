/* grow.h -- spheres placed at random, then grown while they move until they are
 * as large as they should be (Lubachevsky & Stillinger, J. Stat. Phys. 60, 561 (1990)).
 *
 * Placing stops at a packing fraction of .12, where a uniform place is free often
 * enough; the diameter then grows at a constant speed.  Collisions with growing
 * surfaces heat the spheres; their velocities are set back to the temperature when,
 * after a slice of time that shrinks with the time between collisions, speeds are 5 % off.
 *
 * Leaves out: a check that the result is in equilibrium: the slower the growth, the
 *             nearer.  Above .494 it stays a fluid, or a glass, for as long as it takes.
 * Checked by: tests/unit/test_suspension_start.c.
 */
#ifndef SUSPENSION_GROW_H
#define SUSPENSION_GROW_H

#include "solver/suspension/engine.h"

struct grow_rule {
    struct engine_setup setup; /* of the full-grown spheres; elastic */
    double rate;               /* of the diameter (thermal speeds) */
    double square_speed;       /* T/m (m^2/s^2) */
    uint64_t seed;
};

/* position[3*i+axis] (m) of setup.count spheres; *collisions of each during growth.
 * STATUS_BAD_INPUT when they cannot be placed or jam before they are grown. */
enum status grow_spheres(const struct grow_rule *rule, double *position, double *collisions,
                         struct fault *fault);

#endif
