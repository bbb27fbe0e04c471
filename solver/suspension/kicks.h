/* kicks.h -- when the next sphere is kicked, and which.
 *
 *   poisson      a random sphere at random times: a Poisson process of rate N f_dr,
 *                so that each sphere is kicked at the rate f_dr without memory
 *   round-robin  the spheres one after the other, at (k + 1/2)/(N f_dr)
 *   synchronous  all at once at (k + 1/2)/f_dr
 *
 * The half keeps samples at multiples of 1/f_dr away from kicks: they meet
 * synchronous kicks half way between two, when the temperature is that after a
 * kick times exp(-gamma/f_dr) less collisions.  Every other phase reads another
 * temperature: one that swings within each period is the price of that schedule.
 *
 * Source:     kicks of the mean frequency f_dr: Fiege & Zippelius (2014), Section III;
 *             how they are spaced is not stated there.
 * Checked by: tests/unit/test_kicks.c.
 */
#ifndef SUSPENSION_KICKS_H
#define SUSPENSION_KICKS_H

#include "common/random.h"
#include "solver/suspension/parameters.h"

struct kicks {
    enum kick_schedule schedule;
    size_t count;          /* spheres */
    double interval;       /* mean time between kicks of any two spheres, or of all (s) */
    long long done;        /* kicks so far */
    double time;           /* of the next kick (s) */
    gsl_rng *times, *whom; /* poisson; NULL otherwise */
};

enum status kicks_create(struct kicks *k, enum kick_schedule schedule, size_t count, double rate,
                         uint64_t seed, struct fault *fault);
void kicks_free(struct kicks *k);

/* The sphere kicked at k->time; k->time becomes that of the kick after it. */
size_t kicks_take(struct kicks *k);

#endif
