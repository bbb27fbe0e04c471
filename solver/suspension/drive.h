/* drive.h -- what a kick adds to a sphere's vertical velocity for the fluid's sake.
 *
 * The engine's drag -gamma(phibar) v acts on every sphere at all times.  What is
 * left of the force depends on the packing fraction phi_i around the sphere, and is
 * given by kicks at the mean rate f_dr:
 *
 *   linear   dv = b (phi_i - phibar)/(1 - phibar)/f_dr,   b = n g'       (FZ Eq. 9)
 *   full     dv = min(1, (gamma(phi_i) - gamma(phibar))/f_dr) (v_ex - v)  (FZ Eq. 1)
 *
 * with g' = drive_scale g (rho_s - rho_f)/rho_s and, by FZ Eq. 7, v_ex = g'/gamma(phibar).
 * `full` is Eq. 1 less the drag that the engine has: -gamma_i (v - v_ex) - g' +
 * gammabar v = -(gamma_i - gammabar)(v - v_ex).  Kicks at random times (poisson)
 * meet a sphere at its time average, so both laws have the exact mean force; the
 * bound 1, a sphere that moves with the fluid, is met above gamma_i - gammabar =
 * f_dr only.  phi_i is taken at .74 at most, the densest packing: a thin layer on a
 * wall can count more.  Both laws act along z only, as FZ's do.
 *
 * Source:     Fiege & Zippelius (2014), "FZ".
 * Leaves out: the density dependence of the drag in x and y (FZ, Section III).
 * Checked by: tests/unit/test_suspension.c, suspension/verification-terminal-velocity.
 */
#ifndef SUSPENSION_DRIVE_H
#define SUSPENSION_DRIVE_H

#include "solver/suspension/parameters.h"

struct drive {
    enum drive_law law;
    double per_fraction; /* linear: dv over phi_i - phibar (m/s) */
    double phibar;
    double drag, fluid;    /* full: gamma(phibar) (1/s), v_ex (m/s) */
    double lone, exponent; /* gamma0 (1/s), n */
    double interval;       /* 1/f_dr (s) */
};

/* The drive of a flow that supports phibar. */
struct drive drive_at(const struct suspension_parameters *v, double phibar);

/* dv_z (m/s) of a sphere with packing fraction phi around it and velocity v_z (m/s). */
double drive_kick(const struct drive *d, double phi, double v_z);

/* g' = drive_scale g (rho_s - rho_f)/rho_s; b = n g' (m/s^2). */
double drive_gravity(const struct suspension_parameters *v);

#endif
