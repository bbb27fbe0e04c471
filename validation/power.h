/* power.h -- what a comparison with a stored ensemble can and cannot see.
 *
 * K seeds gave the mean mu and the standard deviation s; n new seeds give the
 * mean m.  Of unchanged code
 *
 *     z = (m - mu) / (s sqrt(1/n + 1/K))
 *
 * is Student's t of K-1 degrees of freedom, because s was taken from the
 * ensemble alone.  |z| > t is an alarm, t chosen for the alarm rate alpha.  A
 * change that shifts the mean by delta makes z noncentral t, with noncentrality
 * lambda = delta / (sigma sqrt(1/n + 1/K)), and is seen with probability
 *
 *     integral over w of f(w) [Phi(lambda - t w) + Phi(-lambda - t w)],
 *
 * w = s/sigma, (K-1) w^2 chi-square of K-1 degrees of freedom.  What is called
 * detectable is the delta seen with 95 %, with s in place of sigma.
 *
 * Source:     Student, Biometrika 6, 1 (1908); Johnson & Welch, Biometrika 31,
 *             362 (1940), for the noncentral distribution.
 * Leaves out: distributions that are not normal.  alpha holds on average over
 *             ensembles: one whose s came out small raises more alarms.
 * Checked by: tests/unit/test_power.c, against tables, simulation, and normal
 *             approximations where they hold.
 */
#ifndef VALIDATION_POWER_H
#define VALIDATION_POWER_H

#include <stddef.h>

/* With this probability a detectable change is seen. */
#define POWER_WANTED 0.95

/* |t| that Student's t exceeds with probability alpha, both sides together. */
double power_quantile(double alpha, double freedom);

/* Probability of |z| > power_quantile(alpha, freedom) at this noncentrality. */
double power_of_shift(double shift, double alpha, double freedom);

/* The noncentrality that is seen with probability `power`; NaN unless
 * 0 < alpha < power < 1 and freedom > 0. */
double power_shift(double power, double alpha, double freedom);

/* s sqrt(1/n + 1/K): what z is measured in, in the unit of s. */
double power_scale(double deviation, size_t seeds, size_t reference_seeds);

/* Smallest change of the mean of `seeds` seeds that is seen with POWER_WANTED,
 * in the unit of the deviation. */
double power_detectable(double deviation, size_t seeds, size_t reference_seeds, double alpha);

#endif
