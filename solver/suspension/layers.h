/* layers.h -- the packing fraction that a sphere feels: of the layer around its height.
 *
 * phi(z) = V n/(A h): n centres within Delta/2 of z, the sphere's own among them,
 * V a sphere's volume, A the box's cross-section, h the part of the layer's
 * thickness Delta that lies inside the box.  A periodic height wraps round.
 *
 * Two ways.  Exact: every centre is looked at, O(N) a count; the reference.
 * Histogram: the number of centres below the edges of narrow bins, made anew now
 * and then, O(N); a count is the difference of two linear interpolations, O(1).
 * It is off by how centres lie within the two bins at the layer's edges and by how
 * they moved since; both are measured at each sample (observables/layer_fraction_error).
 *
 * Source: Fiege & Zippelius (2014), Section III ("we count the number of particles
 *         in a layer"); the truncation at walls is not stated there.
 * Leaves out: any structure across the layer.
 * Checked by: tests/unit/test_layers.c, suspension/verification-terminal-velocity.
 */
#ifndef SUSPENSION_LAYERS_H
#define SUSPENSION_LAYERS_H

#include "common/fault.h"

#include <stdbool.h>
#include <stddef.h>

struct layers {
    double thickness, height; /* Delta, and the box's inner height (m) */
    double rise;              /* V/A: height that one sphere fills (m) */
    bool periodic;
    size_t count;  /* spheres */
    size_t bins;   /* of equal width, over the whole height */
    double *below; /* below[0 .. bins]: centres under each edge */
};

struct layers_setup {
    double thickness_m, height_m, rise_m, bin_m; /* the bin is made to divide the height */
    bool periodic;
    size_t count;
};

enum status layers_create(struct layers *l, const struct layers_setup *s, struct fault *fault);
void layers_free(struct layers *l);

/* position[3*i+2]: heights in [0, height] (m) of all spheres. */
void layers_refresh(struct layers *l, const double *position);

/* phi at height z by the histogram of the last refresh. */
double layers_fraction(const struct layers *l, double z);

/* phi at height z by looking at every sphere. */
double layers_exact(const struct layers *l, const double *position, double z);

/* Root mean square and largest difference of histogram and exact count over all spheres'
 * present heights.  O(N log N). */
enum status layers_error(const struct layers *l, const double *position, double *rms,
                         double *largest, struct fault *fault);

/* The histogram's packing fraction averaged over the spheres that it counted. */
double layers_mean(const struct layers *l);

#endif
