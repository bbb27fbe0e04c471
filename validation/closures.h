/* closures.h -- what the model's equations say, written down once for the judge.
 *
 * The solver has its own permeability, halo and gradient in solver/graingas;
 * these were written from the paper without looking at them, so that a fault
 * in one does not cancel in the other.  Every observable, prediction and
 * figure of this folder takes its formula from here.
 *
 *     K(rho)   = (1-rho)^m / rho^2,  rho = max(rho, rho_min)      MFM Eqs. 1, 8
 *     v(rho)   = K rho = (1-rho)^m / rho                          see docs/theory.md
 *     s(x-x_k) = (1-|dx|)(1-|dy|)                                 MFM Eq. 13
 *
 * with m = 4 for the published law (Eq. 3 moves the gas by phi kappa/mu grad P)
 * and m = 3 for the corrected one (Darcy's law proper, kappa/mu grad P).  rho
 * is the solid volume fraction, 2/3 of the area fraction.  Units: l, tau, U0,
 * pressure p = P/P0 - 1.
 *
 * Lattice: site (i, j) at x = i, y = j, index j*nx + i; walls run through the
 * outer sites, which own half a cell, corners a quarter.
 *
 * Source:     McNamara, Flekkoey & Maaloey, PRE 61, 4054 (2000), "MFM".
 * Leaves out: Crank-Nicolson; grains wider than a cell.
 * Checked by: tests/unit/test_closures.c.
 */
#ifndef VALIDATION_CLOSURES_H
#define VALIDATION_CLOSURES_H

#include <stddef.h>

enum closure_law { CLOSURE_CORRECTED = 3, CLOSURE_PUBLISHED = 4 }; /* the exponent m */
enum closure_face { CLOSURE_ARITHMETIC, CLOSURE_HARMONIC, CLOSURE_OF_MEAN };

/* The solid fraction that the gas feels: no less than solid_fraction_min (1). */
double closure_clip(double solid_fraction, double solid_fraction_min);

/* K (1), clipped. */
double closure_conductivity(enum closure_law law, double solid_fraction, double solid_fraction_min);

/* K of the face between two sites. */
double closure_face_conductivity(enum closure_law law, enum closure_face rule, double a, double b,
                                 double solid_fraction_min);

/* Settling speed of a homogeneous suspension in a closed box (U0), positive
 * downwards: (1-rho')^m/rho with rho' = max(rho, rho_min). */
double closure_settling_speed(enum closure_law law, double solid_fraction,
                              double solid_fraction_min);
/* MFM Eq. 20, which does not follow from Eq. 3: (1-rho)^3/(rho (1+rho)). */
double closure_settling_speed_eq20(double solid_fraction);

/* Gas diffusivity of Eq. 8 (l^2/tau): K/(phi Pe), phi = 1 - rho. */
double closure_diffusivity(enum closure_law law, double solid_fraction, double solid_fraction_min,
                           double peclet);
/* (pi mx/W)^2 + (pi my/H)^2 (1/l^2), and what a five-point Laplacian of mesh 1 l
 * makes of it: 4 sin^2(pi mx/2W) + 4 sin^2(pi my/2H). */
double closure_mode_square(double mode_x, double mode_y, double width_l, double height_l);
double closure_mode_square_lattice(double mode_x, double mode_y, double width_l, double height_l);

/* Compressibility factor p/(n k T) of elastic hard discs at an area fraction below .7. */
double closure_disc_compressibility(double area_fraction);
double closure_disc_compressibility_henderson(double area_fraction);
/* d ln Z / d ln(area fraction) of closure_disc_compressibility. */
double closure_disc_stiffness(double area_fraction);

/* Area of the cell that a site owns (l^2). */
double closure_site_volume(size_t i, size_t j, size_t nx, size_t ny);

struct closure_halo {
    size_t site[4];   /* indices j*nx + i */
    double weight[4]; /* sum to 1 */
};
/* The four sites around (x, y), which must lie in the box [0, nx-1] x [0, ny-1]. */
struct closure_halo closure_halo_at(double x, double y, size_t nx, size_t ny);

/* Gradient at a site of values on sites: mean of the two face differences,
 * one-sided (the one face's, whole) at walls.  Out: gradient[2] (per l). */
void closure_gradient(const double *value, size_t i, size_t j, size_t nx, size_t ny,
                      double gradient[2]);
/* Net outflow of the cell of a site (l U0), faces taking the mean of their two
 * sites, half as long along walls; no flow through walls. u[2*site + axis]. */
double closure_outflow(const double *u, size_t i, size_t j, size_t nx, size_t ny);

#endif
