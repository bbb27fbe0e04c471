/* bed_profile.c -- see bed_profile.h. */
#include "validation/bed_profile.h"

#include <gsl/gsl_sort.h>
#include <gsl/gsl_statistics_double.h>
#include <math.h>

enum { MAX_ROWS = 4096 };
static const double DENSE = 0.3; /* rows above are bed, whatever its bubbles (1) */

double bed_profile_row(const double *solid_fraction, size_t nx, size_t j) {
    const double *row = solid_fraction + j * nx;
    double sum = (row[0] + row[nx - 1]) / 2;
    for (size_t i = 1; i + 1 < nx; i++)
        sum += row[i];
    return sum / (double)(nx - 1);
}

double bed_profile_bulk(const double *solid_fraction, size_t nx, size_t ny) {
    double dense[MAX_ROWS];
    size_t count = 0;
    if (ny > MAX_ROWS)
        return NAN;
    for (size_t j = 0; j < ny; j++) {
        double mean = bed_profile_row(solid_fraction, nx, j);
        if (mean > DENSE)
            dense[count++] = mean;
    }
    if (!count)
        return NAN;
    gsl_sort(dense, 1, count);
    return gsl_stats_median_from_sorted_data(dense, 1, count);
}

double bed_profile_top(const double *solid_fraction, size_t nx, size_t ny) {
    double level = bed_profile_bulk(solid_fraction, nx, ny) / 2, above = 0;
    if (isnan(level))
        return NAN;
    for (size_t j = ny; j-- > 0;) {
        double here = bed_profile_row(solid_fraction, nx, j);
        if (here >= level) /* the row above the lid does not exist: the bed ends there */
            return j + 1 == ny ? (double)j : (double)j + (here - level) / (here - above);
        above = here;
    }
    return NAN;
}
