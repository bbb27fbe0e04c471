/* push.h -- free flight: along parabolas for one step, the force held constant
 * (MFM, Section II B, step 1). */
#ifndef GRAINGAS_PUSH_H
#define GRAINGAS_PUSH_H

#include "solver/graingas/grains.h"

/* x += v dt. */
void push_free(struct grains *g, double dt);

/* x += v dt + a dt^2/2, v += a dt with a = (ax, ay - fall); ax, ay[0 .. count-1] and
 * fall in U0/tau, dt in tau. */
void push_forced(struct grains *g, const double *ax, const double *ay, double fall, double dt);

#endif
