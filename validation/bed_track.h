/* bed_track.h -- a bed that rises or settles, profile by profile: centre, top, front, rise.
 *
 * Measured profiles and theory's are read by these functions alike.  Profiles are smoothed with a
 * box of smooth_R (smaller at the ends), then
 *
 *     centre   of mass, of the profile as it is
 *     top      the highest place where phi falls through half the smaller phibar
 *     front    coming from above_R over the floor, the first place where phi leaves the new
 *              side of the mean of both phibar: the edge of what has reached the new state
 *     rise     the most by which phi grows from any height above above_R to a higher one: 0 for a
 *              profile that falls all the way
 *
 * straight between the middles of bins.  The front is NaN while there is none, and where nothing of
 * the old state is left in an expansion; after compaction it is the shoulder of the top.
 *
 * Source:     docs/theory.md, S7.
 * Leaves out: what differs across.
 * Checked by: tests/unit/test_bed_track.c.
 */
#ifndef VALIDATION_BED_TRACK_H
#define VALIDATION_BED_TRACK_H

#include "validation/bed_change.h"
#include "validation/recipe.h"

struct bed_reading {
    double before, after; /* phibar (1) */
    double above_R, smooth_R, bin_R;
    size_t bins;
};

struct bed_track {
    size_t count;
    double *time_s, *centre_R, *top_R, *front_R, *rise; /* [0 .. count-1]; one block, by time_s */
};

enum status bed_track_create(size_t count, struct bed_track *out, struct fault *fault);
void bed_track_free(struct bed_track *t); /* of {0} is allowed */

/* Entry `at` from a profile: fraction[0 .. bins-1]; scratch[0 .. bins-1]. */
void bed_track_read(struct bed_track *t, size_t at, double time_s, const struct bed_reading *r,
                    const double *fraction, double *scratch);

/* Theory at times since the change, time_s[0 .. count-1], rising and not negative; *out is
 * created.  profile: NULL, or [count][bins] that is filled (1). */
enum status bed_track_kinematic(const struct bed_change *change, const struct bed_reading *r,
                                const double *time_s, size_t count, struct bed_track *out,
                                double *profile, struct fault *fault);
enum status bed_track_pressure(const struct bed_change *change, const struct bed_reading *r,
                               const double *time_s, size_t count, struct bed_track *out,
                               double *profile, struct fault *fault);

/* When the centre of mass has gone this share of the way from start_R to end_R for the first
 * time; NaN: never. */
double bed_track_time(const struct bed_track *t, double start_R, double end_R, double share);
/* When front and top meet: where a straight line through the gap between them, from .8 to .2 of the
 * first top's height, has none; NaN with fewer than three samples. */
double bed_track_meeting(const struct bed_track *t);
/* Largest distances from theory (R) of centre, top and front, in distance_R: theory's entry k is
 * seen's skip + k.  Up to where theory's centre has gone `share` of its way, and for the front
 * while theory's is well below its top; NaN where bed and theory never have both. */
enum status bed_track_distances(const struct bed_track *seen, size_t skip,
                                const struct bed_track *theory, double share, double distance_R[3],
                                struct fault *fault);

/* A curve of those entries of y[0 .. count-1], one of t's, that are numbers; none of an empty
 * track. */
enum status bed_track_curve(const struct bed_track *t, const double *y, const char *name,
                            const char *label, struct measurement *out, struct fault *fault);

#endif
