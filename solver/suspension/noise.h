/* noise.h -- how strong the random kicks are: the variance s^2 of each component.
 *
 * Power balance of a sphere at temperature T (docs/theory.md):
 *     f_dr m s^2 = (1/3) f_coll (1 - eps^2) T + 2 gamma T                      (1)
 * with f_coll the collisions of a sphere in a time (each pair's counts for both).
 * FZ print 3/4 where 1/3 follows, and give no f_coll; `rule` says which is used:
 *
 *   enskog      Enskog's rate with Carnahan and Starling's contact value, at T
 *               and the mean packing fraction: that of the box, or with a drive
 *               that of the spheres' layers at the last look
 *   measured    the rate of this run, averaged over the last ten kicks a sphere
 *   feedback    (1) with Enskog's rate, times 1 + e + I: e = 1 - T_now/T, I its
 *               integral over time in units of (1)'s relaxation; critically
 *               damped.  T_now is about the mean velocity of thin slabs.
 *   fixed-kick  set once for a sphere alone in the fluid at rest: (1) without
 *               collisions at gamma0
 *   given       a variance; none: 0
 *
 * Source:     Fiege & Zippelius (2014), Section III; the coefficient: docs/theory.md.
 * Leaves out: velocity correlations (recollisions), so T is off where (1) is.
 * Checked by: tests/unit/test_suspension_parameters.c, test_suspension.c.
 */
#ifndef SUSPENSION_NOISE_H
#define SUSPENSION_NOISE_H

#include "solver/suspension/parameters.h"

struct noise {
    enum noise_rate rule;
    bool keep;              /* what is in force at the first change of phibar stays */
    double temperature;     /* target T over m (m^2/s^2) */
    double diameter;        /* (m) */
    double inelasticity;    /* (1 - eps^2)/3 */
    double kick_rate;       /* f_dr (1/s) */
    double lone_drag;       /* gamma0 (1/s) */
    double drag;            /* gamma(phibar) (1/s) */
    double packing;         /* mean packing fraction in force (1) */
    double collision_rate;  /* f_coll in force (1/s) */
    double error, integral; /* feedback: e, I */
    double variance;        /* s^2 in force (m^2/s^2) */
    bool frozen;
};

/* What is read off the run at a look. */
struct noise_reading {
    double elapsed;        /* since the last look (s) */
    double collision_rate; /* of a sphere, over that time (1/s) */
    double packing;        /* mean packing fraction (1) */
    double temperature;    /* over m (m^2/s^2) */
};

/* packing: mean packing fraction at the start; drag: gamma(phibar) (1/s). */
void noise_start(struct noise *n, const struct suspension_parameters *v, double packing,
                 double drag);

/* Measured rates, packing and temperature come into force. */
void noise_look(struct noise *n, const struct noise_reading *r);

/* phibar has changed: a new drag (1/s), or nothing any more with `keep`. */
void noise_change(struct noise *n, double drag);

/* Collisions of a sphere in a time (1/s) after Enskog: packing fraction, T over m
 * (m^2/s^2), diameter (m). */
double noise_enskog(double packing, double temperature, double diameter);

#endif
