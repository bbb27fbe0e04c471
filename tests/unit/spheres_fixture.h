/* spheres_fixture.h -- results of the suspension model with known content. */
#ifndef SPHERES_FIXTURE_H
#define SPHERES_FIXTURE_H

#include "tests/unit/fake_run.h"

/* The box as sides in radii; boundary: hard, periodic, or sides for periodic ones over a hard
 * floor; `more`: further lines of parameters. */
static inline struct fake_run spheres_start(int count, double radius_m, const double side_R[3],
                                            const char *boundary, const char *more) {
    char text[4096];
    bool sides = !strcmp(boundary, "sides");
    const char *across = sides ? "periodic" : boundary, *up = sides ? "hard" : boundary;
    snprintf(text, sizeof text,
             "  particles: %d\n  radius_m: %.17g\n  mass_kg: 2.3e-6\n  thermal_energy_J: 1.7e-9\n"
             "  packing_fraction: 0.3\n  width_x_R: %.17g\n  width_y_R: %.17g\n  height_R: %.17g\n"
             "  boundary_x: %s\n  boundary_y: %s\n  boundary_z: %s\n  temperature_scale: 1.3\n"
             "  drag_per_s: 4.9\n  phibar: 0.37\n  exponent: 4.65\n%s%s",
             count, radius_m, side_R[0], side_R[1], side_R[2], across, across, up,
             strstr(more, "  phibar_times_s:") ? "" : "  phibar_times_s: []\n", more);
    return fake_start(text);
}

enum { SPHERES_STEP_PER_S = 1000000 };

static inline void spheres_vectors(struct fake_run *f, const char *name, int count,
                                   const double *data, double time_s) {
    char path[64];
    snprintf(path, sizeof path, "particles/spheres/%s", name);
    fake_append(f, path, 2, (const size_t[]){(size_t)count, 3}, data, time_s,
                1.0 / SPHERES_STEP_PER_S);
}

static inline void spheres_counter(struct fake_run *f, const char *name, double value,
                                   double time_s) {
    char path[64];
    snprintf(path, sizeof path, "observables/%s", name);
    fake_scalar(f, path, value, time_s, 1.0 / SPHERES_STEP_PER_S);
}

static inline void spheres_list(struct fake_run *f, const char *name, size_t size,
                                const double *value, double time_s) {
    char path[64];
    snprintf(path, sizeof path, "observables/%s", name);
    fake_append(f, path, 1, &size, value, time_s, 1.0 / SPHERES_STEP_PER_S);
}

#endif
