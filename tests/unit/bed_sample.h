/* bed_sample.h -- solid fraction and pressure of made-up beds, on the lattice. */
#ifndef BED_SAMPLE_H
#define BED_SAMPLE_H

#include "tests/unit/fake_run.h"

enum { BED_NX = 13, BED_NY = 61, BED_SITES = BED_NX * BED_NY };

/* Across the width: mean 1 with half cells at the sides, and only with them. */
static inline double bed_sample_wave(size_t i, double amplitude) {
    return 1 + amplitude * cos(2 * M_PI * (double)i / (BED_NX - 1));
}

/* Adds a layer of a solid fraction from one height to another (l), in thin slices by the halo's
 * weights. */
static inline void bed_sample_add(double *rho, double from, double to, double fraction) {
    enum { SLICES = 4000 };
    for (int s = 0; s < SLICES; s++) {
        double y = from + (to - from) * (s + 0.5) / SLICES, solid = fraction * (to - from) / SLICES;
        size_t j = (size_t)y;
        double up = y - (double)j;
        for (size_t i = 0; i < BED_NX; i++) {
            double here = solid * bed_sample_wave(i, 0.2);
            rho[j * BED_NX + i] += here * (1 - up) / (j == 0 ? 0.5 : 1);
            rho[(j + 1) * BED_NX + i] += here * up / (j + 2 == BED_NY ? 0.5 : 1);
        }
    }
}

/* A pressure whose means over floor and lid differ by `drop` (P0). */
static inline void bed_sample_pressure(double *p, double drop) {
    for (size_t j = 0; j < BED_NY; j++)
        for (size_t i = 0; i < BED_NX; i++)
            p[j * BED_NX + i] =
                3.1e-4 + drop * (1 - (double)j / (BED_NY - 1)) * bed_sample_wave(i, 0.3);
}

#endif
