/* darcy.h -- the closures of the gas: permeability and drag.
 *
 * Carman-Kozeny (MFM Eq. 1) in units of kappa0 = a^2/45 gives kappa =
 * (1-rho)^3/rho^2, rho the solid volume fraction.  MFM's Eq. 3 moves the gas
 * with phi kappa/mu grad P, so that Eq. 8 has K = phi^4/(1-phi)^2 (published);
 * Darcy's law proper has no extra phi, K = phi^3/(1-phi)^2 (corrected).
 * Below rho_min both are held at their value there (Section II C).
 *
 * Leaves out: any dependence on the Reynolds number.
 * Checked by: graingas/verification-darcy-column, graingas/verification-neutral-flux.
 */
#ifndef GRAINGAS_DARCY_H
#define GRAINGAS_DARCY_H

#include "solver/graingas/parameters.h"

/* K(rho) (1); rho > 0 already clipped at rho_min by the caller. */
static inline double darcy_coefficient(enum darcy_law law, double rho) {
    double phi = 1 - rho, kappa = phi * phi * phi / (rho * rho);
    return law == DARCY_PUBLISHED ? phi * kappa : kappa;
}

/* Rate at which the gas slows grains of solid fraction rho in a closed box:
 * rho/(Fr (1-rho)^m), m = 4 published, 3 corrected.  (1/tau) */
double darcy_drag_rate(enum darcy_law law, double rho, double froude);

/* Coefficient of the face between two sites of coefficients a, b and clipped
 * solid fractions rho_a, rho_b. */
double darcy_face(enum face_rule rule, enum darcy_law law, double a, double b, double rho_a,
                  double rho_b);

#endif
