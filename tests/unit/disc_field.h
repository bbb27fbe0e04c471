/* disc_field.h -- made-up solid fractions: round voids with smooth edges in a dense bed. */
#ifndef DISC_FIELD_H
#define DISC_FIELD_H

#include <math.h>
#include <stddef.h>

static const double DISC_BED = 0.53, DISC_VOID = 0.04; /* solid fraction: half way lies .285 */

struct disc {
    double x, y, r; /* (l) */
};

/* Each site's share of void falls from 1 to 0 over 1 l across a disc's edge. */
static inline void disc_field(double *field, size_t nx, size_t ny, const struct disc *discs,
                              size_t count) {
    for (size_t k = 0; k < nx * ny; k++) {
        double share = 0;
        for (size_t n = 0; n < count; n++) {
            double away = hypot((double)(k % nx) - discs[n].x, (double)(k / nx) - discs[n].y);
            share = fmax(share, fmin(fmax(discs[n].r + 0.5 - away, 0), 1));
        }
        field[k] = DISC_BED + (DISC_VOID - DISC_BED) * share;
    }
}

#endif
