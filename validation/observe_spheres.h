/* observe_spheres.h -- what the recipes of the suspension model share.
 *
 * The spheres and their box as the parameters give them, arrays of particles,
 * counters by name, and the frames of a window of time.  The box's sides are
 * width_x_R, width_y_R, height_R radii; a side of 0 follows from packing_fraction:
 * all three 0 is a cube.  Everything is borrowed from the run view.
 *
 * Leaves out: spheres of several sizes.
 * Checked by: tests/unit/test_observe_spheres*.c through the recipes.
 */
#ifndef VALIDATION_OBSERVE_SPHERES_H
#define VALIDATION_OBSERVE_SPHERES_H

#include "validation/observe.h"

struct observe_spheres {
    size_t count;
    double radius_m, mass_kg, thermal_energy_J;
    double box_m[3];
    bool periodic[3];
    double packing_fraction; /* of the whole box (1) */
};
enum status observe_spheres(struct run_view *v, struct observe_spheres *out, struct fault *fault);

/* particles/spheres/NAME: [frame][count][3]. */
enum status observe_spheres_vectors(struct run_view *v, const char *name,
                                    const struct observe_spheres *spheres,
                                    const struct series **out, struct fault *fault);
/* Entry of a sphere: [0 .. 2]. */
const double *observe_spheres_at(const struct series *s, size_t frame, size_t sphere);

/* First and last frame with from_s <= time <= to_s (to_s <= 0: the last there is), which must be
 * two or more; times count as equal to a millionth. */
enum status observe_spheres_window(struct run_view *v, const struct series *s, double from_s,
                                   double to_s, size_t *first, size_t *last, struct fault *fault);

/* Do two series have the same times, frame by frame? A fault names them. */
enum status observe_spheres_together(struct run_view *v, const struct series *a,
                                     const struct series *b, struct fault *fault);

/* gamma (1/s) of the run's parameters; phibar must not change. */
enum status observe_spheres_drag(struct run_view *v, double *gamma, struct fault *fault);

#endif
