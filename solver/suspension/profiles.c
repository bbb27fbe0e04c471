#include "solver/suspension/profiles.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MEANS = 4 };

enum status profiles_create(struct profiles *f, const struct suspension_parameters *p,
                            struct fault *fault) {
    double bins = fmax(1, round(p->box[2] / p->profile_bin));
    *f = (struct profiles){.bins = (size_t)fmin(bins, 1e8)};
    f->packing = calloc(f->bins, sizeof *f->packing);
    f->xy = calloc(f->bins, sizeof *f->xy);
    f->zz = calloc(f->bins, sizeof *f->zz);
    f->mean = calloc(MEANS * f->bins, sizeof *f->mean);
    if (f->packing && f->xy && f->zz && f->mean)
        return STATUS_OK;
    profiles_free(f);
    return fault_set(fault, STATUS_NO_MEMORY, "no memory for profiles of %g slabs", bins);
}

void profiles_free(struct profiles *f) {
    free(f->packing);
    free(f->xy);
    free(f->zz);
    free(f->mean);
    *f = (struct profiles){0};
}

static size_t slab_of(const struct profiles *f, const struct suspension_parameters *p, double z) {
    size_t k = (size_t)fmax(0, z * ((double)f->bins / p->box[2]));
    return k < f->bins ? k : f->bins - 1;
}

/* Number and mean velocity in each slab. */
static void find_means(struct profiles *f, const struct suspension_parameters *p,
                       const double *position, const double *velocity) {
    memset(f->mean, 0, MEANS * f->bins * sizeof *f->mean);
    for (size_t i = 0; i < p->particles; i++) {
        double *m = f->mean + MEANS * slab_of(f, p, position[3 * i + 2]);
        m[0] += 1;
        for (size_t a = 0; a < 3; a++)
            m[1 + a] += velocity[3 * i + a];
    }
    for (size_t k = 0; k < f->bins; k++)
        for (size_t a = 1; a < MEANS; a++)
            f->mean[MEANS * k + a] /= fmax(1, f->mean[MEANS * k]);
}

void profiles_make(struct profiles *f, const struct suspension_parameters *p,
                   const double *position, const double *velocity) {
    const double slab = p->box[0] * p->box[1] * (p->box[2] / (double)f->bins);
    const double share = suspension_parameters_volume(p) / slab;
    double xy = 0, zz = 0, freedoms = 0;
    find_means(f, p, position, velocity);
    memset(f->xy, 0, f->bins * sizeof *f->xy);
    memset(f->zz, 0, f->bins * sizeof *f->zz);
    for (size_t i = 0; i < p->particles; i++) {
        size_t k = slab_of(f, p, position[3 * i + 2]);
        const double *v = velocity + 3 * i, *m = f->mean + MEANS * k;
        double x = v[0] - m[1], y = v[1] - m[2], z = v[2] - m[3];
        f->xy[k] += 0.5 * p->mass * (x * x + y * y);
        f->zz[k] += p->mass * (z * z);
    }
    for (size_t k = 0; k < f->bins; k++) {
        double n = f->mean[MEANS * k];
        xy += n > 1 ? f->xy[k] : 0;
        zz += n > 1 ? f->zz[k] : 0;
        freedoms += fmax(0, n - 1);
        f->packing[k] = n * share;
        f->xy[k] = n > 1 ? f->xy[k] / (n - 1) : 0;
        f->zz[k] = n > 1 ? f->zz[k] / (n - 1) : 0;
    }
    f->whole_xy = freedoms > 0 ? xy / freedoms : 0;
    f->whole_zz = freedoms > 0 ? zz / freedoms : 0;
}
