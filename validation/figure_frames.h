/* figure_frames.h -- which frames of a run a sequence of pictures or an animation shows.
 *
 * A recipe opens its run, says what times the run's frames have, and lets the settings of the
 * figure choose among them:
 *
 * side by side   at the times of the first setting, `times`, or at six spread over the run from its
 * first time on.  A time that the run does not reach is left out, and `missing` says so for the
 * caption; one that lies between two frames is a fault. moving         all frames, or those at
 * multiples of the first setting (0: all), and of these evenly no more than the second setting,
 * `frames`.
 *
 * Used by:    figure_sequence.c (grains), figure_spheres.c (spheres).
 * Checked by: tests/unit/test_figure_frames.c.
 */
#ifndef VALIDATION_FIGURE_FRAMES_H
#define VALIDATION_FIGURE_FRAMES_H

#include "validation/figures.h"

struct figure_frames {
    const char *path;     /* of the result, for faults */
    const char *unit;     /* of all times */
    const double *time;   /* time[0 .. frames-1] of the run, increasing; borrowed */
    size_t frames;        /* >= 1 */
    double from;          /* the recipe's times count from here, where its first frame is */
    double slack;         /* a frame is at a time if it is no farther from it */
    size_t *shown, count; /* chosen: shown[0 .. count-1], of the run's frames */
    const char *missing;  /* chosen: " Not reached (s): 5." or empty */
};

/* The first usable run of the points shown.  STATUS_BAD_INPUT: there is none. */
enum status figure_frames_run(const struct figure_input *in, const struct measured_point **point,
                              const struct measured_run **run, struct fault *fault);

/* Fill in `shown`, `count` and `missing`, in the arena, from the settings of the figure wanted.
 * STATUS_BAD_INPUT: too many times, or none that the run has; STATUS_NOT_FOUND: between frames. */
enum status figure_frames_choose(struct figure_frames *f, const struct case_figure *wanted,
                                 bool moving, struct arena *a, struct fault *fault);

/* Time of frame shown[i] since `from`. */
double figure_frames_time(const struct figure_frames *f, size_t i);

#endif
