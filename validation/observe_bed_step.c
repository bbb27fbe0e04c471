/* observe_bed_step.c -- a bed that rests, then compacts or expands when phibar changes.
 *
 * The change and its time are the run's phibar_times_s and phibar_values; samples up to it give the
 * bed at rest.  Centre of mass, top, front and rise come from the profiles (bed_track.h); the
 * same is read off the kinematic wave and the wave with pressure and inertia of the run's own law
 * (drive linear or full) at the times of the samples, and told is the largest distance up to
 * theory's end.
 *
 *     time_90, end_time    the centre of mass has gone 90, 98 % of its way to the mean of the last
 * rest_s front_time           the front that rises from the floor meets the top (compaction)
 *     overshoot            the most by which the centre goes beyond, over its way
 *     rise                 mean of the profile's rise while the kinematic wave's fan has not met
 * the top (h0/(c phi0)); the same of the wave with pressure, and of the bed at rest speed_ratio way
 * of the centre over that of the kinematic wave, when the latter has gone 30 %: over both lies v_ex
 * or c
 *
 * A collision counts for both spheres: 2 N_coll/N a sphere.  Speeds are sqrt(T/m), T horizontal.
 *
 * Source:     Fiege & Zippelius, Section IV B, Figs. 3 to 6; docs/theory.md, S7.
 * Leaves out: more than one change.
 * Checked by: suspension/compaction, -expansion; tests/unit/test_observe_bed_step.c.
 */
#include "validation/bed_track.h"
#include "validation/observe_spheres.h"
#include "validation/recipes.h"

#include <math.h>
#include <stdlib.h>

enum { ABOVE_R, SMOOTH_R, REST_S, COUNT_S };
enum {
    START_CENTRE,
    END_CENTRE,
    TIME_90,
    END_TIME,
    FRONT_TIME,
    OVERSHOOT,
    KINEMATIC_CENTRE,
    KINEMATIC_TOP,
    KINEMATIC_FRONT,
    PRESSURE_CENTRE,
    PRESSURE_TOP,
    PRESSURE_FRONT,
    COLLISIONS,
    RATE_BEFORE,
    RATE_AFTER,
    SPEED_BEFORE,
    SPEED_AFTER,
    HEAT_RATIO,
    START_BULK,
    END_BULK,
    SPEED_RATIO,
    RISE,
    STILL_RISE,
    PRESSURE_RISE
};

static const double END_SHARE = 0.98, EARLY_SHARE = 0.3;

struct step {
    struct run_view *v;
    const double *settings;
    struct observe_spheres spheres;
    struct bed_change change;
    struct bed_reading reading;
    double change_s;
    const struct series *profile, *collisions, *heat;
    size_t still;                               /* samples up to the change */
    struct bed_track seen, kinematic, pressure; /* times since the change */
};

static enum status open_run(struct run_view *v, const double *settings, struct step *s,
                            struct fault *fault) {
    *s = (struct step){.v = v, .settings = settings};
    enum status status = observe_spheres(v, &s->spheres, fault);
    if (!status)
        status = bed_change_read(v, &s->change, &s->change_s, fault);
    s->change.inertia = true;
    if (!status)
        status = run_view_series(v, "profiles/packing_fraction", &s->profile, fault);
    if (!status)
        status = observe_values(v, "observables/collisions", 1, &s->collisions, fault);
    if (!status)
        status = observe_values(v, "observables/temperature_xy", 1, &s->heat, fault);
    if (!status)
        status = observe_spheres_together(v, s->profile, s->collisions, fault);
    if (!status)
        status = observe_spheres_together(v, s->profile, s->heat, fault);
    if (status)
        return status;
    const struct series *p = s->profile;
    while (s->still < p->frames && p->time[s->still] <= s->change_s * (1 + 1e-9))
        s->still++;
    if (s->still < 1 || p->frames < s->still + 5)
        return fault_set(fault, STATUS_BAD_INPUT,
                         "%s: %zu samples up to the change of phibar and %zu after it: too few",
                         run_view_path(v), s->still, p->frames - s->still);
    s->reading =
        (struct bed_reading){.before = s->change.before,
                             .after = s->change.after,
                             .above_R = settings[ABOVE_R],
                             .smooth_R = settings[SMOOTH_R],
                             .bin_R = s->spheres.box_m[2] / (double)p->size / s->spheres.radius_m,
                             .bins = p->size};
    return STATUS_OK;
}

static enum status follow(struct step *s, struct fault *fault) {
    const struct series *p = s->profile;
    double *scratch = calloc(p->size + p->frames, sizeof *scratch), *time = scratch + p->size;
    if (!scratch)
        return fault_set(fault, STATUS_NO_MEMORY, "no memory for %zu profiles", p->frames);
    enum status status = bed_track_create(p->frames, &s->seen, fault);
    for (size_t f = 0; !status && f < p->frames; f++) {
        time[f] = p->time[f] - s->change_s;
        bed_track_read(&s->seen, f, time[f], &s->reading, p->value + f * p->size, scratch);
    }
    /* theory begins with the change itself, at the last sample up to it */
    size_t first = s->still - 1, count = p->frames - first;
    time[first] = 0;
    if (!status)
        status = bed_track_kinematic(&s->change, &s->reading, time + first, count, &s->kinematic,
                                     NULL, fault);
    if (!status) {
        struct fault poor = FAULT_NONE; /* where a bed is unstable theory may have no solution */
        status = bed_track_pressure(&s->change, &s->reading, time + first, count, &s->pressure,
                                    NULL, &poor);
        if (status == STATUS_NUMERICAL)
            status = STATUS_OK;
        else if (status)
            *fault = poor;
    }
    free(scratch);
    return status;
}

/* Mean of value[first .. last]; of what is not NaN. */
static double mean_of(const double *value, size_t first, size_t last) {
    double sum = 0;
    size_t n = 0;
    for (size_t i = first; i <= last; i++)
        if (!isnan(value[i])) {
            sum += value[i];
            n++;
        }
    return n > 0 ? sum / (double)n : NAN;
}

static size_t rest_from(const struct step *s) {
    size_t last = s->profile->frames - 1, first = last;
    double from = s->profile->time[last] - s->settings[REST_S];
    while (first > s->still && s->profile->time[first - 1] >= from * (1 - 1e-9))
        first--;
    return first;
}

/* -- times ------------------------------------------------------------------------------ */

static void find_times(const struct step *s, struct measurement *out) {
    double *value = out->value;
    size_t last = s->seen.count - 1;
    value[START_CENTRE] = mean_of(s->seen.centre_R, 0, s->still - 1);
    value[END_CENTRE] = mean_of(s->seen.centre_R, rest_from(s), last);
    double way = value[END_CENTRE] - value[START_CENTRE];
    value[TIME_90] = bed_track_time(&s->seen, value[START_CENTRE], value[END_CENTRE], 0.9);
    value[END_TIME] = bed_track_time(&s->seen, value[START_CENTRE], value[END_CENTRE], END_SHARE);
    for (size_t k = s->still; k <= last; k++)
        value[OVERSHOOT] = fmax(value[OVERSHOOT], (s->seen.centre_R[k] - value[END_CENTRE]) / way);
    struct bed_track since = s->seen; /* only what follows the change */
    since.count -= s->still - 1;
    since.time_s += s->still - 1;
    since.top_R += s->still - 1;
    since.front_R += s->still - 1;
    value[FRONT_TIME] = s->change.after > s->change.before ? bed_track_meeting(&since) : NAN;
    if (isnan(value[FRONT_TIME]))
        observe_none(out, FRONT_TIME, "no front rises from the floor to meet the top");
}

/* -- against theory --------------------------------------------------------------------- */

static enum status compare(const struct step *s, const struct bed_track *theory, size_t centre,
                           struct measurement *out, struct fault *fault) {
    for (size_t i = centre; theory->count == 0 && i <= centre + 2; i++)
        observe_none(out, i, "the wave has no solution: the bed is unstable");
    if (theory->count == 0)
        return STATUS_OK;
    enum status status =
        bed_track_distances(&s->seen, s->still - 1, theory, END_SHARE, out->value + centre, fault);
    for (size_t i = centre; !status && i <= centre + 2; i++)
        if (isnan(out->value[i]))
            observe_none(out, i, "theory and bed have no top or front at the same time");
    return status;
}

static void find_ratio(const struct step *s, struct measurement *out) {
    const struct bed_track *k = &s->kinematic;
    double start = k->centre_R[0], way = k->centre_R[k->count - 1] - start;
    size_t i = 1;
    while (i + 1 < k->count && (k->centre_R[i] - start) / way < EARLY_SHARE)
        i++;
    out->value[SPEED_RATIO] =
        (s->seen.centre_R[s->still - 1 + i] - out->value[START_CENTRE]) / (k->centre_R[i] - start);
}

static void find_rise(const struct step *s, struct measurement *out) {
    const struct bed_change *c = &s->change;
    double met = c->load_m / (c->before * c->before * bed_change_slope(c));
    size_t last = s->still;
    while (last + 1 < s->seen.count && s->seen.time_s[last + 1] <= met)
        last++;
    out->value[STILL_RISE] = mean_of(s->seen.rise, 0, s->still - 1);
    out->value[RISE] = mean_of(s->seen.rise, s->still, last);
    out->value[PRESSURE_RISE] =
        s->pressure.count > 0 ? mean_of(s->pressure.rise, 1, last - s->still + 1) : NAN;
}

/* -- state ------------------------------------------------------------------------------ */

/* Mean packing fraction from above_R to half the height that all spheres would have. */
static double find_bulk(const struct step *s, size_t first, size_t last, double phibar) {
    const struct bed_reading *r = &s->reading;
    double half = s->change.load_m / phibar / s->change.radius_m / 2, sum = 0;
    size_t low = (size_t)ceil(r->above_R / r->bin_R), high = (size_t)(half / r->bin_R), n = 0;
    for (size_t f = first; f <= last; f++)
        for (size_t i = low; i < high && i < r->bins; i++, n++)
            sum += s->profile->value[f * r->bins + i];
    return n > 0 ? sum / (double)n : NAN;
}

static double rate(const struct step *s, size_t first, size_t last) {
    const struct series *c = s->collisions;
    return 2 * (c->value[last] - c->value[first]) /
           ((double)s->spheres.count * (c->time[last] - c->time[first]));
}

static void find_state(const struct step *s, struct measurement *out) {
    size_t frames = s->profile->frames, rest = rest_from(s), at = s->still;
    double mass = s->spheres.mass_kg;
    while (at + 1 < frames && s->seen.time_s[at] < s->settings[COUNT_S] * (1 - 1e-6))
        at++;
    out->value[COLLISIONS] = 2 * (s->collisions->value[at] - s->collisions->value[s->still - 1]) /
                             (double)s->spheres.count;
    if (s->seen.time_s[at] < s->settings[COUNT_S] * (1 - 1e-6))
        observe_none(out, COLLISIONS, "the run ends before %g s", s->settings[COUNT_S]);
    out->value[RATE_BEFORE] = rate(s, 0, s->still - 1);
    if (s->still < 2)
        observe_none(out, RATE_BEFORE, "no two samples before the change");
    out->value[RATE_AFTER] = rate(s, rest, frames - 1);
    double before = mean_of(s->heat->value, 0, s->still - 1);
    double after = mean_of(s->heat->value, rest, frames - 1);
    out->value[SPEED_BEFORE] = 1e3 * sqrt(before / mass);
    out->value[SPEED_AFTER] = 1e3 * sqrt(after / mass);
    out->value[HEAT_RATIO] = after / (s->change.heat_m2_per_s2 * mass);
    out->value[START_BULK] = find_bulk(s, 0, s->still - 1, s->change.before);
    out->value[END_BULK] = find_bulk(s, rest, frames - 1, s->change.after);
}

static enum status add_curves(const struct step *s, struct measurement *out, struct fault *fault) {
    const struct bed_track *track[] = {&s->seen, &s->kinematic, &s->pressure};
    static const char *const label[] = {"measured", "kinematic wave", "with pressure and inertia"};
    enum status status = STATUS_OK;
    for (size_t i = 0; !status && i < 3; i++)
        status = bed_track_curve(track[i], track[i]->centre_R, "centre", label[i], out, fault);
    for (size_t i = 0; !status && i < 3; i++)
        status = bed_track_curve(track[i], track[i]->top_R, "top", label[i], out, fault);
    for (size_t i = 0; !status && i < 2; i++)
        status = bed_track_curve(track[i], track[i]->front_R, "front", label[i], out, fault);
    return status;
}

static enum status measure(struct run_view *v, const double *settings, struct measurement *out,
                           struct fault *fault) {
    struct step s;
    enum status status = open_run(v, settings, &s, fault);
    if (!status)
        status = follow(&s, fault);
    if (!status) {
        find_times(&s, out);
        find_ratio(&s, out);
        find_rise(&s, out);
        find_state(&s, out);
        status = compare(&s, &s.kinematic, KINEMATIC_CENTRE, out, fault);
    }
    if (!status)
        status = compare(&s, &s.pressure, PRESSURE_CENTRE, out, fault);
    if (!status)
        status = add_curves(&s, out, fault);
    bed_track_free(&s.seen);
    bed_track_free(&s.kinematic);
    bed_track_free(&s.pressure);
    return status;
}

static const char *const DATASETS[] = {"profiles/packing_fraction", "observables/collisions",
                                       "observables/temperature_xy", NULL};
static const char *const CURVES[] = {"centre", "top", "front", NULL};

const struct recipe recipe_bed_step = {
    .name = "bed-step",
    .title = "A bed after a change of phibar",
    .source = "Fiege & Zippelius, Section IV B",
    .datasets = DATASETS,
    .setting = {{"above_R", "R", "left out at the floor", 10, 0, 1e6},
                {"smooth_R", "R", "profiles are smoothed over", 5, 0.1, 1e6},
                {"rest_s", "s", "end of the run that counts as the new state", 0.3, 0, 1e9},
                {"count_s", "s", "collisions are counted up to, from the change", 2, 0, 1e9}},
    .output = {{"start_centre", "R", "centre of mass before the change"},
               {"end_centre", "R", "centre of mass over the last rest_s"},
               {"time_90", "s", "centre of mass has gone 90 % of its way"},
               {"end_time", "s", "centre of mass has gone 98 % of its way"},
               {"front_time", "s", "front from the floor meets the top"},
               {"overshoot", "1", "of the centre of mass, over its way"},
               {"kinematic_centre", "R",
                "centre of mass, largest distance from the kinematic wave"},
               {"kinematic_top", "R", "top, the same"},
               {"kinematic_front", "R", "front from the floor, the same"},
               {"pressure_centre", "R",
                "centre of mass, largest distance from the wave with pressure"},
               {"pressure_top", "R", "top, the same"},
               {"pressure_front", "R", "front from the floor, the same"},
               {"collisions", "1", "a sphere takes part in from the change to count_s"},
               {"rate_before", "1/s", "collisions of a sphere before the change"},
               {"rate_after", "1/s", "over the last rest_s"},
               {"speed_before", "mm/s", "sqrt(T/m) up to the change, T horizontal"},
               {"speed_after", "mm/s", "over the last rest_s"},
               {"heat_ratio", "1", "T of the last rest_s over the one asked for"},
               {"start_bulk", "1", "packing fraction of the lower half before the change"},
               {"end_bulk", "1", "over the last rest_s"},
               {"speed_ratio", "1", "way of the centre over the kinematic wave's at 30 % of that"},
               {"rise", "1", "of the profile with height, while a fan would be there"},
               {"still_rise", "1", "before the change"},
               {"pressure_rise", "1", "of the wave with pressure"}},
    .curves = CURVES,
    .measure = measure,
};
