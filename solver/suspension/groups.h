/* groups.h -- the dimensionless groups that a run's numbers make.
 *
 *   Z                = pi (rho_s - rho_f) g d^4/(3 kT) = 2 c m g d/kT      (FZ Eq. 10)
 *   drag_group       = gamma(phibar) R/v_th,  v_th^2 = kT/m
 *   drive_group      = b R/v_th^2,  b = n g' (drive.h)
 *   kick_group       = f_dr R/v_th
 *   stability_ratio  = (phi b'/gamma)/c_T at phi = phibar, b' = b/(1 - phibar):
 *                      speed of kinematic waves over that of sound at constant
 *                      temperature, c_T^2 = kT/m d(phi Z_CS)/dphi, with Carnahan and
 *                      Starling's pressure; a homogeneous bed is unstable above 1.
 *
 * kT includes temperature_scale, b drive_scale.  Z is twice the energy that lifts a
 * sphere by its diameter over kT.  With the remaining ratios (Delta/R, box/R, N,
 * eps, n, phibar(t), guard, times) equal groups mean the same run in other units.
 *
 * Source:     Fiege & Zippelius (2014), "FZ"; the ratio: docs/theory.md.
 * Checked by: tests/unit/test_suspension_parameters.c.
 */
#ifndef SUSPENSION_GROUPS_H
#define SUSPENSION_GROUPS_H

#include "solver/suspension/parameters.h"

struct groups {
    double lift;                          /* Z */
    double drag, drive, kick, stability;  /* (1) */
    double thermal_speed, packing_in_box; /* (m/s), (1) */
};

/* With the flow that supports phibar; infinite where kT or the drag is 0. */
struct groups groups_of(const struct suspension_parameters *v, double phibar);

#endif
