/* normality.c -- see normality.h. */
#include "validation/normality.h"

#include <gsl/gsl_cdf.h>
#include <gsl/gsl_sort.h>
#include <math.h>

double normality_probability(double distance, size_t count) {
    double root = sqrt((double)count), l = distance * (root + 0.12 + 0.11 / root), sum = 0;
    if (l < 0.2)
        return 1;
    for (int j = 1; j <= 100; j++)
        sum += (j % 2 ? 2 : -2) * exp(-2 * j * j * l * l);
    return fmin(fmax(sum, 0), 1);
}

double normality_distance(double *x, size_t count, double width) {
    double worst = 0, n = (double)count;
    gsl_sort(x, 1, count);
    for (size_t i = 0; i < count; i++) {
        double f = gsl_cdf_ugaussian_P(x[i] / width);
        worst = fmax(worst, fmax(fabs(f - (double)i / n), fabs((double)(i + 1) / n - f)));
    }
    return worst;
}
