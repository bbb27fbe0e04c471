/* bed_column.c -- see bed_column.h. */
#include "validation/bed_column.h"

#include "validation/bed_profile.h"

#include <gsl/gsl_fit.h>
#include <math.h>

/* Integral of the profile from the floor up to y, rows joined by straight lines. */
static double integral(const double *field, const struct observe_box *box, double y) {
    double sum = 0, below = bed_profile_row(field, box->nx, 0);
    for (size_t j = 1; j < box->ny && y > (double)(j - 1); j++) {
        double above = bed_profile_row(field, box->nx, j);
        double share = fmin(y - (double)(j - 1), 1);
        sum += share * (below + share * (above - below) / 2);
        below = above;
    }
    return sum;
}

struct bed_column bed_column_measure(const double *solid_fraction, const struct observe_box *box,
                                     double margin_l) {
    struct bed_column c = {0};
    for (size_t j = 0; j < box->ny; j++) {
        double height = closure_site_volume(1, j, box->nx, box->ny);
        double solid = height * bed_profile_row(solid_fraction, box->nx, j);
        c.load += solid;
        c.centre += solid * (double)j;
    }
    c.centre /= c.load;
    c.top = bed_profile_top(solid_fraction, box->nx, box->ny);
    c.bulk_fraction = c.load / c.top;
    double low = margin_l, high = c.top - margin_l;
    c.slab_fraction = NAN;
    if (high > low)
        c.slab_fraction =
            (integral(solid_fraction, box, high) - integral(solid_fraction, box, low)) /
            (high - low);
    return c;
}

double bed_column_marker(const double *solid_fraction, const struct observe_box *box,
                         double solid_l) {
    double left = solid_l, above = bed_profile_row(solid_fraction, box->nx, box->ny - 1);
    for (size_t j = box->ny - 1; j-- > 0;) {
        double here = bed_profile_row(solid_fraction, box->nx, j), solid = (here + above) / 2;
        if (solid >= left && solid > 0) /* share above + share^2 (here - above)/2 = left */
            return (double)(j + 1) -
                   2 * left / (above + sqrt(above * above + 2 * left * (here - above)));
        left -= solid;
        above = here;
    }
    return NAN;
}

double bed_column_drop(const double *pressure, const struct observe_box *box) {
    return bed_profile_row(pressure, box->nx, 0) - bed_profile_row(pressure, box->nx, box->ny - 1);
}

double bed_column_weight(const struct bed_column *c, const struct observe_physics *physics) {
    return physics->peclet * physics->gravity * c->load;
}

double bed_column_freeboard(const struct bed_column *c, const struct observe_box *box,
                            const struct observe_physics *physics, double flux) {
    double rho_min = physics->solid_fraction_min;
    return physics->peclet * flux * (box->height_l - c->top) /
           closure_conductivity(physics->law, rho_min, rho_min);
}

double bed_column_slope(const double *x, const double *y, size_t count, double *error) {
    double value, slope, value_variance, covariance, slope_variance, squares;
    *error = NAN;
    if (count < 3)
        return NAN;
    gsl_fit_linear(x, 1, y, 1, count, &value, &slope, &value_variance, &covariance, &slope_variance,
                   &squares);
    *error = sqrt(slope_variance);
    return slope;
}
