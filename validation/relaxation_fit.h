/* relaxation_fit.h -- how fast a bed leaves its old profile: L(t) of FZ Eq. 15 and the rate of it.
 *
 *     L^2(t) = sum over bins of (phi(z,t) - phi(z,0))^2 dz                         (1)
 *
 * phi(z,0) is the mean of M profiles of the stationary state before the change. Profiles of finite
 * numbers of spheres scatter about their mean with a variance s^2(z), so (1) never vanishes: a
 * profile of the same state has L^2 = F = (1 + 1/M) sum s^2 dz on average. F comes from the M
 * profiles themselves, s^2 over M - 1, and is taken off. What is left may be negative; then
 * L = -sqrt(-L^2).
 *
 * Two laws are fitted by least squares, all samples of the window alike, each with a height and
 * a time of its own:
 *
 *     L = A (1 - exp(-lambda t))           FZ, Fig. 7                               (2)
 *     L = B sqrt(min(t, t_e))              a fan and a front that widen, and stop   (3)
 *
 * The height is linear and eliminated; the time is found on a logarithmic grid and then by Brent's
 * method. Theory's profiles are read by these functions too, in the same bins, window and samples.
 *
 * Source:     Fiege & Zippelius, Eq. 15 and Fig. 7; docs/theory.md, S7; GSL, gsl_min.
 * Leaves out: slow wanderings of the stationary bed, which M profiles in a row do not show;
 *             the different scatter of the new state.
 * Checked by: tests/unit/test_relaxation_fit.c; suspension/expansion-rate.
 */
#ifndef VALIDATION_RELAXATION_FIT_H
#define VALIDATION_RELAXATION_FIT_H

#include "common/fault.h"

#include <stddef.h>

/* profile[frame*bins + bin] (1), bins of bin_R, frames[0 .. count-1] of which the first `still` are
 * before the change: square[0 .. count-1] is L^2 less the floor (R), *floor_R the floor.  With
 * still = 1 there is no floor to be known: 0 is taken off, *floor_R is NaN. */
enum status relaxation_square(const double *profile, size_t count, size_t bins, double bin_R,
                              size_t still, double *square_R, double *floor_R, struct fault *fault);
/* L (sqrt(R)) from L^2 (R). */
double relaxation_length(double square_R);

struct relaxation_fit {
    double rate_per_s, plateau;       /* lambda, A (sqrt(R)) */
    double end_s, growth;             /* t_e, B (sqrt(R/s)) */
    double exponential_rms, root_rms; /* of the residuals of (2), (3), over A (1) */
};

/* time_s[0 .. count-1] since the change, length[] (sqrt(R)).  STATUS_BAD_INPUT with fewer than five
 * samples or where no rate inside the grid (.1 to 100 over the last time) fits best. */
enum status relaxation_fit(const double *time_s, const double *length, size_t count,
                           struct relaxation_fit *out, struct fault *fault);

double relaxation_exponential(const struct relaxation_fit *fit, double time_s); /* (2) */
double relaxation_root(const struct relaxation_fit *fit, double time_s);        /* (3) */

#endif
