/* observe.h -- what the recipes of the grain-gas model share.
 *
 * The physics of a run by name, its grains frame by frame, its lattice, and
 * the frame of a given time.  Everything is borrowed from the run view.
 *
 * Leaves out: three dimensions.
 * Checked by: tests/unit/test_observe_*.c through the recipes.
 */
#ifndef VALIDATION_OBSERVE_H
#define VALIDATION_OBSERVE_H

#include "validation/closures.h"
#include "validation/recipe.h"

struct observe_physics {
    enum closure_law law;
    enum closure_face face;
    double solid_fraction_min, area_to_volume; /* (1) */
    double peclet, froude, gravity;            /* (1) */
    double dt_tau;
};
enum status observe_physics(struct run_view *v, struct observe_physics *out, struct fault *fault);

struct observe_box {
    double width_l, height_l;
    size_t nx, ny, sites; /* lattice sites: one more than the box has l */
};
enum status observe_box(struct run_view *v, struct observe_box *out, struct fault *fault);

struct observe_grains {
    size_t count, frames;
    const double *time;          /* time[0 .. frames-1] (tau) */
    const double *radius;        /* radius[0 .. count-1] (l) */
    const double *position;      /* position[(frame*count + grain)*2 + axis] (l) */
    const double *velocity;      /* the same (U0); NULL when not asked for */
    const struct series *series; /* of the positions */
};
enum status observe_grains(struct run_view *v, bool velocity, struct observe_grains *out,
                           struct fault *fault);
/* Area, which is also the mass (l^2). */
double observe_area(const struct observe_grains *g, size_t grain);
/* Entry of a grain in position or velocity: [0] across, [1] up. */
const double *observe_vector(const double *values, const struct observe_grains *g, size_t frame,
                             size_t grain);

/* A field on the lattice with `components` values a site; its shape is checked. */
enum status observe_field(struct run_view *v, const char *name, const struct observe_box *box,
                          size_t components, const struct series **out, struct fault *fault);

/* An observable with `size` values a frame. */
enum status observe_values(struct run_view *v, const char *name, size_t size,
                           const struct series **out, struct fault *fault);

/* The frame within half a time step of a time; STATUS_NOT_FOUND names the series. */
enum status observe_frame(struct run_view *v, const char *name, const struct series *s,
                          double time_tau, size_t *frame, struct fault *fault);

/* Does the series go on to this time at all? */
bool observe_reaches(const struct series *s, double time_tau);

/* value[output] becomes NaN; the first reason said is kept. */
void observe_none(struct measurement *m, size_t output, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

#endif
