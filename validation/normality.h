/* normality.h -- how far a sample is from a normal distribution of a given width.
 *
 * D = max |F_n - F| of Kolmogorov and Smirnov, and the probability of a D as large or larger
 *
 *     p = 2 sum over j of (-1)^(j-1) exp(-2 j^2 l^2),  l = D (sqrt n + .12 + .11/sqrt n)
 *
 * A width that comes from the same sample makes p larger: a p below alpha refuses the
 * normal distribution at less than alpha.
 *
 * Source:     Stephens, J. Am. Stat. Assoc. 69, 730 (1974).
 * Leaves out: Lilliefors' correction for the fitted width.
 * Checked by: tests/unit/test_observe_spheres_velocity.c, test_observe_rest.c.
 */
#ifndef VALIDATION_NORMALITY_H
#define VALIDATION_NORMALITY_H

#include <stddef.h>

/* D of x[0 .. count-1], of mean 0 and this standard deviation.  Sorts x. */
double normality_distance(double *x, size_t count, double width);
double normality_probability(double distance, size_t count);

#endif
