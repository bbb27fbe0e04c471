/* observe_bed_wave.c -- a bed after a change of phibar, by its profiles alone.
 *
 * What can be asked of any program that says how much solid lies at which height, with spheres or
 * without: is the solid kept, and do centre, top and front (bed_track.h) go as the exact kinematic
 * wave of the run's own law does?
 *
 *     front_time           the front that rises from the floor meets the top (compaction)
 *     kinematic_centre, _top, _front   largest distance from the kinematic wave, up to its end
 *     solid_error          the largest of |sum phi dz/load - 1|
 *
 * Source:     Fiege & Zippelius, Section IV B; docs/theory.md, S7.
 * Leaves out: what bed-step reads off particles; more than one change.
 * Checked by: suspension/compaction-kinematic; tests/unit/test_observe_bed_wave.c.
 */
#include "validation/bed_track.h"
#include "validation/observe.h"
#include "validation/recipes.h"

#include <math.h>
#include <stdlib.h>

enum { ABOVE_R, SMOOTH_R };
enum { FRONT_TIME, CENTRE, TOP, FRONT, SOLID_ERROR };

static const double END_SHARE = 0.98;

struct wave {
    struct bed_change change;
    struct bed_reading reading;
    const struct series *profile;
    double change_s;
    size_t skip;                      /* samples before the last one up to the change */
    struct bed_track seen, kinematic; /* times since the change; kinematic's from skip on */
};

static enum status open_run(struct run_view *v, const double *settings, struct wave *w,
                            struct fault *fault) {
    double height_R = 0;
    size_t still = 0;
    *w = (struct wave){0};
    enum status status = run_view_parameter(v, "height_R", &height_R, fault);
    if (!status)
        status = bed_change_read(v, &w->change, &w->change_s, fault);
    if (!status)
        status = run_view_series(v, "profiles/packing_fraction", &w->profile, fault);
    if (status)
        return status;
    const struct series *p = w->profile;
    if (p->rank != 1 || !(height_R > 0))
        return fault_set(fault, STATUS_BAD_INPUT,
                         "%s: profiles/packing_fraction is not [frame][slab] of a height_R",
                         run_view_path(v));
    while (still < p->frames && p->time[still] <= w->change_s * (1 + 1e-9))
        still++;
    if (still < 1 || p->frames < still + 5)
        return fault_set(fault, STATUS_BAD_INPUT,
                         "%s: %zu samples up to the change of phibar and %zu after it: too few",
                         run_view_path(v), still, p->frames - still);
    w->skip = still - 1;
    w->reading = (struct bed_reading){.before = w->change.before,
                                      .after = w->change.after,
                                      .above_R = settings[ABOVE_R],
                                      .smooth_R = settings[SMOOTH_R],
                                      .bin_R = height_R / (double)p->size,
                                      .bins = p->size};
    return STATUS_OK;
}

static enum status follow(struct wave *w, struct fault *fault) {
    const struct series *p = w->profile;
    double *scratch = calloc(p->size + p->frames, sizeof *scratch), *time = scratch + p->size;
    if (!scratch)
        return fault_set(fault, STATUS_NO_MEMORY, "no memory for %zu profiles", p->frames);
    enum status status = bed_track_create(p->frames, &w->seen, fault);
    for (size_t f = 0; !status && f < p->frames; f++) {
        time[f] = p->time[f] - w->change_s;
        bed_track_read(&w->seen, f, time[f], &w->reading, p->value + f * p->size, scratch);
    }
    time[w->skip] = 0; /* theory begins with the change itself */
    if (!status)
        status = bed_track_kinematic(&w->change, &w->reading, time + w->skip, p->frames - w->skip,
                                     &w->kinematic, NULL, fault);
    free(scratch);
    return status;
}

static void find_solid(const struct wave *w, struct measurement *out) {
    const struct series *p = w->profile;
    double slab_m = w->reading.bin_R * w->change.radius_m;
    for (size_t f = 0; f < p->frames; f++) {
        double sum = 0;
        for (size_t i = 0; i < p->size; i++)
            sum += p->value[f * p->size + i];
        out->value[SOLID_ERROR] =
            fmax(out->value[SOLID_ERROR], fabs(sum * slab_m / w->change.load_m - 1));
    }
}

static enum status find_distances(const struct wave *w, struct measurement *out,
                                  struct fault *fault) {
    enum status status = bed_track_distances(&w->seen, w->skip, &w->kinematic, END_SHARE,
                                             out->value + CENTRE, fault);
    for (size_t i = CENTRE; !status && i <= FRONT; i++)
        if (isnan(out->value[i]))
            observe_none(out, i, "theory and bed have no top or front at the same time");
    struct bed_track since = w->seen; /* from the change on */
    since.count -= w->skip;
    since.time_s += w->skip;
    since.top_R += w->skip;
    since.front_R += w->skip;
    out->value[FRONT_TIME] = w->change.after > w->change.before ? bed_track_meeting(&since) : NAN;
    if (isnan(out->value[FRONT_TIME]))
        observe_none(out, FRONT_TIME, "no front rises from the floor to meet the top");
    return status;
}

static enum status add_curves(const struct wave *w, struct measurement *out, struct fault *fault) {
    const struct bed_track *track[] = {&w->seen, &w->kinematic};
    static const char *const label[] = {"measured", "kinematic wave"};
    enum status status = STATUS_OK;
    for (size_t i = 0; !status && i < 2; i++)
        status = bed_track_curve(track[i], track[i]->top_R, "top", label[i], out, fault);
    for (size_t i = 0; !status && i < 2; i++)
        status = bed_track_curve(track[i], track[i]->front_R, "front", label[i], out, fault);
    return status;
}

static enum status measure(struct run_view *v, const double *settings, struct measurement *out,
                           struct fault *fault) {
    struct wave w;
    enum status status = open_run(v, settings, &w, fault);
    if (!status)
        status = follow(&w, fault);
    if (!status) {
        find_solid(&w, out);
        status = find_distances(&w, out, fault);
    }
    if (!status)
        status = add_curves(&w, out, fault);
    bed_track_free(&w.seen);
    bed_track_free(&w.kinematic);
    return status;
}

static const char *const DATASETS[] = {"profiles/packing_fraction", NULL};
static const char *const CURVES[] = {"top", "front", NULL};

const struct recipe recipe_bed_wave = {
    .name = "bed-wave",
    .title = "A bed after a change of phibar, by its profiles alone",
    .source = "Fiege & Zippelius, Section IV B; docs/theory.md, S7",
    .datasets = DATASETS,
    .setting = {{"above_R", "R", "left out at the floor", 10, 0, 1e6},
                {"smooth_R", "R", "profiles are smoothed over", 5, 0.1, 1e6}},
    .output = {{"front_time", "s", "front from the floor meets the top"},
               {"kinematic_centre", "R",
                "centre of mass, largest distance from the kinematic wave"},
               {"kinematic_top", "R", "top, the same"},
               {"kinematic_front", "R", "front from the floor, the same"},
               {"solid_error", "1", "largest share of the solid that is missing or too much"}},
    .curves = CURVES,
    .measure = measure,
};
