/* halo.h -- grains <-> gas lattice by bilinear weights.
 *
 * A grain at x gives each of the four lattice sites k around it the weight
 * s(x - x_k), MFM Eq. 13; the weights sum to 1 (Eq. 14).  The same weights
 * deposit solid area and flux on sites (Eqs. 15, 16, weighted by grain area so
 * that all grains feel the same acceleration from the gas) and gather the
 * gas's acceleration on grains (Eq. 17): what the gas loses the grains receive.
 *
 * The lattice has nx x ny sites a distance 1 l apart, site (i, j) at x = i,
 * y = j; wall sites own half a cell's area, corners a quarter.
 *
 * Source:     MFM, Eqs. 13-17.
 * Leaves out: grains wider than one lattice constant.
 * Checked by: graingas/verification-halo, graingas/verification-force-balance.
 */
#ifndef GRAINGAS_HALO_H
#define GRAINGAS_HALO_H

#include "solver/graingas/grains.h"

struct lattice {
    int nx, ny;
    size_t sites;   /* nx * ny */
    double *volume; /* volume[0 .. sites-1] (l^2): 1, 1/2 at walls, 1/4 in corners */
};

/* A box of width x height l; sites are one more each way. */
enum status lattice_create(struct lattice *l, int width_l, int height_l, struct fault *fault);
void lattice_free(struct lattice *l);

/* What a site carries, together so that one cache line serves a deposit. */
struct site_load {
    double area;           /* sum of grain area times weight (l^2) */
    double flux_x, flux_y; /* the same times grain velocity (l^2 U0) */
    double unused;
};
struct site_pull {
    double x, y; /* acceleration that the gas gives a grain there (U0/tau) */
};

/* Index of the grain that left the box, or -1 when all are inside. */
long halo_first_outside(const struct lattice *l, const struct grains *g);

/* load[0 .. sites-1]: overwritten. All grains must be inside. */
void halo_deposit(const struct lattice *l, const struct grains *g, struct site_load *load);

/* ax, ay[0 .. count-1] (U0/tau): sum over the four sites of weight times pull. */
void halo_gather(const struct lattice *l, const struct grains *g, const struct site_pull *pull,
                 double *ax, double *ay);

#endif
