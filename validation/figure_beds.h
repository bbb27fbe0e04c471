/* figure_beds.h -- what the figures of the suspension share: one reading each, lengths in R, times
 * since the change.
 *
 * A bed's figure shows points of one reading (parameter `reading` of the point) and says which.
 * Times count from the run's first change of phibar, or from its start where phibar stays.
 *
 * Checked by: tests/unit/test_figure_beds.c.
 */
#ifndef VALIDATION_FIGURE_BEDS_H
#define VALIDATION_FIGURE_BEDS_H

#include "validation/figures.h"
#include "validation/observe_spheres.h"

/* What tells a point from the others, with its reading in front; without it.  The parameter `along`
 * (or NULL) is left out.  NULL: no memory. */
const char *figure_bed_text(const struct measured_case *data, const struct measured_point *p,
                            const char *along, struct arena *a);
const char *figure_bed_label(const struct measured_case *data, const struct measured_point *p,
                             const char *along, struct arena *a);
/* "TITLE (reading literal)"; the title alone where no reading is named. */
const char *figure_bed_title(const char *title, const char *reading, struct arena *a);

/* The reading of a point as written, or NULL. */
const char *figure_bed_reading(const struct measured_point *p);
/* Those of data's points that have the nth (from 0) of its readings, in *out, taken from the
 * arena; false beyond the last. */
bool figure_bed_of_reading(const struct measured_case *data, size_t nth, struct measured_case *out,
                           struct arena *a);

/* A point's parameter as a number, the last one of a list; NaN where it has none. */
double figure_bed_number(const struct measured_point *p, const char *name);

/* An open run.  Close the view. */
struct figure_bed {
    struct run_view *view;
    struct observe_spheres spheres;
    bool changes;  /* of phibar */
    double from_s; /* the first change, or 0 */
};
enum status figure_bed_open(const struct measured_run *run, struct figure_bed *out,
                            struct fault *fault);

/* A sample is at a time (s) if it is no farther from it. */
double figure_bed_slack(const struct series *s);
/* Does a series go on to a time since from_s?  Its frame there; none is a fault. */
bool figure_bed_reaches(const struct figure_bed *b, const struct series *s, double time_s);
enum status figure_bed_frame(const struct figure_bed *b, const char *name, const struct series *s,
                             double time_s, size_t *frame, struct fault *fault);

/* Curves of a name of the usable seeds that have the abscissae of the first such seed, or that
 * seed's alone where they differ: curve[0 .. return-1]. */
size_t figure_bed_curves(const struct figure_input *in, const struct measured_point *p,
                         const char *name, const struct curve **curve, size_t room);

/* What a prediction says for a point: inputs as the case's checks bind them, else the run's
 * parameters, else outputs of the figure's observable; NaN where an output has no value. */
enum status figure_bed_predict(const struct figure_input *in, const struct measured_point *p,
                               const struct prediction *prediction, double *out,
                               struct fault *fault);

#endif
