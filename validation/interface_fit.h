/* interface_fit.h -- height and width of a bed's upper edge, read off a profile.
 *
 * The profile of packing fraction over height is fitted with
 *
 *     phi(z) = (p/2) erfc((z - h)/(sqrt(2) sigma))                         (1)
 *
 * by least squares, all heights in the window alike, z from `above_R` over the floor to the
 * end of the profile.  The bottom is left out: spheres are layered on the floor.
 * The plateau p is either fixed at phibar, as (1) says in the bed's bulk, or a third
 * unknown.
 *
 * sigma depends on this choice, and on the window, by as much as a fifth, because a bed's
 * upper edge is not an error function.  Measured profiles and solved ones are
 * therefore read by this one function with the same settings.
 *
 * An edge sharper than the profile's slabs has no width to be read: the sum of squares then falls
 * towards a step, without end.  Least squares are therefore sought from several starts, and a step
 * between two heights is tried beside them; where it is told apart as the best, `sharp` says so,
 * sigma is 0, and height and sigma are known to a slab over the root of 12.
 *
 * Uncertainties are those of the fit, from the scatter about it, for
 * independent noise.  Noise of neighbouring heights in one run is not independent:
 * runs are compared by blocks of time and by seeds.
 *
 * Source:     Fiege & Zippelius, Eqs. 13 and 14; GSL, gsl_multifit_nlinear.
 * Leaves out: weights; profiles that bend over more than once.
 * Checked by: tests/unit/test_interface_fit.c, suspension/interface-width.
 */
#ifndef VALIDATION_INTERFACE_FIT_H
#define VALIDATION_INTERFACE_FIT_H

#include "common/fault.h"

#include <stdbool.h>
#include <stddef.h>

struct interface_window {
    double above_R;    /* heights below are left out */
    double phibar;     /* the plateau, or its first guess (1) */
    bool plateau_free; /* is the plateau a third unknown? */
};

struct interface_fit {
    double sigma_R, height_R, plateau;                   /* (R, R, 1) */
    double sigma_error_R, height_error_R, plateau_error; /* standard; 0: not fitted */
    double rms;                                          /* of the residuals in the window (1) */
    double shoulder_rms; /* of those from h - 4 sigma to h - sigma: where the bulk starts to drop */
    size_t used;         /* heights in the window */
    bool sharp;          /* sharper than the slabs: a step, sigma_R 0 */
};

/* height_R[0 .. count-1] rising, fraction[0 .. count-1].  STATUS_BAD_INPUT where the window
 * has fewer than eight heights, does not cross phibar/2 or has its best edge outside,
 * STATUS_NUMERICAL where the best fit does not converge. */
enum status interface_fit(const double *height_R, const double *fraction, size_t count,
                          const struct interface_window *window, struct interface_fit *out,
                          struct fault *fault);

/* (1) at a height. */
double interface_fit_at(const struct interface_fit *fit, double height_R);

#endif
