/* gas.h -- the gas: one pressure field on the lattice, moved by Darcy's law.
 *
 *   linear (MFM Eq. 8):  phi dp/dt = (1/Pe) div(K grad p) - div u
 *   full   (MFM Eq. 6):  phi (dp/dt + u . grad p) = (1/Pe) div(K (1+p) grad p) - (1+p) div u
 *
 * with p = P/P0 - 1, u the grains' velocity field and K of darcy.h.  Sites own
 * the volumes of halo.h; nothing flows through walls but the injected flux q,
 * which adds q w_k to the bottom sites' volume-integrated equation and takes as
 * much from the top ones (w: 1 l, half in corners).  Backward Euler in time;
 * under `full` (1+p), u . grad p and (1+p) div u are taken from the step before,
 * which keeps the matrix symmetric.
 *
 * div u is the sum of face fluxes, a face's velocity the mean of its two sites'.
 * The gradient at a site is the exact adjoint of that divergence (in the sense
 * sum V_k u_k . g_k = - sum p_k (div u)_k), so that the gas's force on the
 * grains, plus the part that sites below rho_min do not pass on, equals the
 * pressure difference on the walls to round-off.
 *
 * Leaves out: gas inertia, gas weight.
 * Checked by: graingas/verification-* and tests/unit/test_gas.c.
 */
#ifndef GRAINGAS_GAS_H
#define GRAINGAS_GAS_H

#include "solver/graingas/halo.h"
#include "solver/graingas/multigrid.h"
#include "solver/graingas/parameters.h"

struct gas {
    const struct lattice *lattice; /* borrowed */
    struct multigrid *solver;
    /* All arrays [0 .. sites-1]. */
    double *fixed_fraction; /* immobile packing (1) */
    double *solid_fraction; /* grains and immobile packing (1), not clipped */
    double *clipped;        /* max(solid_fraction, rho_min) */
    double *coefficient;    /* K(clipped) */
    double *ux, *uy;        /* grain velocity field (U0), flux over clipped fraction */
    double *pressure;       /* p (P0) */
    double *east, *north, *mass, *rhs;
    struct site_pull *pull; /* acceleration given to grains (U0/tau) */
    struct site_load *load;
    struct multigrid_outcome outcome; /* of the last solve */
};

enum status gas_create(struct gas *gas, const struct lattice *l,
                       const struct graingas_parameters *p, struct fault *fault);
void gas_free(struct gas *gas);

/* Solid fraction, permeability and grain velocity field from the grains. */
void gas_take_grains(struct gas *gas, const struct graingas_parameters *p, const struct grains *g);

/* Pressure one step later; flux in l/tau.  STATUS_NUMERICAL with the range of
 * coefficients where the solve fails. */
enum status gas_step(struct gas *gas, const struct graingas_parameters *p, double flux,
                     struct fault *fault);

/* pull from the present pressure: -(1/(Fr Pe)) g_k / max(rho_k, rho_min). */
void gas_find_pull(struct gas *gas, const struct graingas_parameters *p);

/* Largest solid fraction of any site. */
double gas_densest(const struct gas *gas);

/* Force (rho_g g l^2) that sites below rho_min do not pass on to solids. */
void gas_unabsorbed(const struct gas *gas, const struct graingas_parameters *p, double force[2]);

#endif
