#include "solver/suspension/bonds.h"

#include "solver/suspension/grid.h"

#include <complex.h>
#include <gsl/gsl_sf_legendre.h>
#include <math.h>

enum { DEGREE = 6 };
static const double reach = 1.4; /* (diameters) */

struct bonds {
    double complex sum[DEGREE + 1]; /* of Y_6m, m >= 0 */
    double count;
};

/* Y_6m(-r) = Y_6m(r): each pair is met from both ends. */
static bool add_bond(void *context, size_t j, const double apart[3]) {
    struct bonds *b = context;
    double flat = hypot(apart[0], apart[1]), length = hypot(flat, apart[2]);
    (void)j;
    if (!(length > 0))
        return true; /* itself */
    double complex turn = flat > 0 ? (apart[0] + I * apart[1]) / flat : 1, power = 1;
    for (int m = 0; m <= DEGREE; m++) {
        b->sum[m] += gsl_sf_legendre_sphPlm(DEGREE, m, apart[2] / length) * power;
        power *= turn;
    }
    b->count += 1;
    return true;
}

enum status bonds_order(const struct engine_setup *setup, const double *position, double *q6,
                        struct fault *fault) {
    struct grid g;
    struct bonds b = {.count = 0};
    if (grid_create(&g, setup->box_m, setup->boundary, 2 * reach * setup->radius_m, position,
                    setup->count, fault) != STATUS_OK)
        return fault->status;
    for (size_t i = 0; i < setup->count; i++)
        grid_put(&g, i);
    for (size_t i = 0; i < setup->count; i++)
        grid_visit(&g, position + 3 * i, add_bond, &b);
    grid_free(&g);
    double square = 0;
    for (int m = 0; m <= DEGREE; m++) {
        double size = cabs(b.sum[m]) / fmax(1, b.count);
        square += (m > 0 ? 2 : 1) * size * size;
    }
    *q6 = sqrt(4 * M_PI / (2 * DEGREE + 1) * square);
    return STATUS_OK;
}
