/* observe_bubbles.c -- bubbles of a fluidized bed: when, how many, how large, how fast, what shape.
 *
 * All frames of the solid fraction are read in turn and their voids followed
 * (bubbles.h).  "Proper" bubbles reach area_min in two frames or more: what
 * flickers up once is no bubble.
 *
 *   window   the last window_tau of the run.  `number`, `mean_area`, `aspect` and
 *            the like are over it in any case; `steady` says whether they mean a
 *            steady state: the line through the heights of the bed's top
 *            (bed_profile.h) within the window rises or falls by steady_l at
 *            most in 10 tau.  With steady = 0 they describe a transient.
 *   early    the first 10 tau from onset_time; growth is the window's mean area
 *            over the early one, where the two do not overlap
 *   counts   births, merges, ... are of the whole run.  Merges and splits count
 *            if both partners have area_min and it lasts for 1 tau
 *   speeds   from the stretches of uninterrupted motion from rise_from_tau on,
 *            and the line u = a + c sqrt(g D_e), D_e = sqrt(4 A/pi), through those
 *            away from side walls by least squares.  Pieces of one bubble's motion are counted as
 *            independent, so the standard error of c is a lower bound.
 *   walls    the speed of each stretch along a side wall over the mean of those
 *            away from walls whose D_e is within 20 % of it (three at least)
 *
 * A plane bubble's own speed is .5 sqrt(g R_nose), measured about .4 to .5
 * sqrt(g D_e); the bed's motion is in a.
 *
 * Source:     MFM, Section IV and Fig. 5; definitions: docs/theory.md, "Bubbles".
 * Leaves out: the gas through a bubble.
 * Checked by: graingas/bubbles; tests/unit/test_observe_bubbles.c.
 */
#include "validation/bubbles.h"
#include "validation/observe.h"
#include "validation/recipes.h"

#include <gsl/gsl_fit.h>
#include <math.h>
#include <stdlib.h>

enum {
    THRESHOLD,
    AREA_MIN,
    LAYER_SPAN,
    WINDOW_TAU,
    STEADY_L,
    RISE_FROM_TAU,
    STRETCH_TAU,
    MIN_FRAMES
};
enum {
    ONSET_TIME,
    BIRTHS,
    NUMBER,
    NUMBER_EARLY,
    MEAN_AREA,
    AREA_WEIGHTED_AREA,
    GROWTH,
    LARGEST_AREA,
    ASPECT,
    FLOOR_FLATNESS,
    LAYER,
    RISE_SPEED,
    RISE_OFFSET,
    RISE_COEFFICIENT,
    RISE_COEFFICIENT_ERROR,
    WALL_RATIO,
    MERGES,
    SPLITS,
    BURSTS,
    VANISHED,
    MERGES_PER_BUBBLE,
    TOP_DRIFT,
    STEADY
};
enum { MIN_STRETCHES = 10, MIN_SIMILAR = 3 };
static const double SPAN_TAU = 10; /* of `early`, and of the drift */
static const double BRIEF_TAU = 1; /* merges and splits undone within this are none */
static const double SIMILAR = 0.2; /* difference of D_e, relative */

struct task {
    struct observe_box box;
    double gravity; /* (l/tau^2) */
    const double *settings;
    const struct series *field;
    struct bubbles *bubbles;
    struct bubble_history h;
    struct bubble_stretch *stretch; /* stretch[0 .. stretches-1] */
    size_t stretches;
    double *scratch; /* two columns of max(frames, stretches) */
    size_t rows;
};

/* -- areas and shapes over a span of time ------------------------------------------- */

struct average {
    double frames, bubbles; /* summed over the frames */
    double area, area_square, largest;
    double aspect;              /* times area */
    double flatness, flat_area; /* times area; area of those that have one */
    double layer;
};

static void add_bubble(struct average *a, const struct component *r) {
    a->bubbles++;
    a->area += r->area_l2;
    a->area_square += r->area_l2 * r->area_l2;
    a->largest = fmax(a->largest, r->area_l2);
    a->aspect += r->aspect * r->area_l2;
    if (isnan(r->flatness) || (r->walls & COMPONENT_BOTTOM)) /* the box's floor is no bubble's */
        return;
    a->flatness += r->flatness * r->area_l2;
    a->flat_area += r->area_l2;
}

static void add_frame(struct average *a, const struct task *k, const struct bubble_frame *f) {
    a->frames++;
    a->layer += f->layer_span;
    for (size_t n = f->first; n < f->first + f->points; n++)
        if (k->h.point[n].shape.area_l2 >= k->settings[AREA_MIN])
            add_bubble(a, &k->h.point[n].shape);
}

/* Frames from one time to another, both included. */
static struct average average_over(const struct task *k, double from_tau, double to_tau) {
    struct average a = {0};
    for (size_t i = 0; i < k->h.frames; i++)
        if (k->h.frame[i].time_tau >= from_tau - 1e-9 && k->h.frame[i].time_tau <= to_tau + 1e-9)
            add_frame(&a, k, &k->h.frame[i]);
    return a;
}

static double start_of(const struct task *k) {
    return k->h.frame[0].time_tau;
}

static double end_of(const struct task *k) {
    return k->h.frame[k->h.frames - 1].time_tau;
}

static void conclude_window(const struct task *k, const struct average *a,
                            struct measurement *out) {
    out->value[NUMBER] = a->bubbles / a->frames;
    out->value[LAYER] = a->layer / a->frames;
    out->value[LARGEST_AREA] = a->largest;
    out->value[MEAN_AREA] = a->area / a->bubbles;
    out->value[AREA_WEIGHTED_AREA] = a->area_square / a->area;
    out->value[ASPECT] = a->aspect / a->area;
    out->value[FLOOR_FLATNESS] = a->flatness / a->flat_area;
    const size_t of_bubbles[] = {MEAN_AREA, AREA_WEIGHTED_AREA, ASPECT};
    for (size_t i = 0; !(a->bubbles > 0) && i < sizeof of_bubbles / sizeof *of_bubbles; i++)
        observe_none(out, of_bubbles[i], "no bubble of %g l^2 in the last %g tau",
                     k->settings[AREA_MIN], k->settings[WINDOW_TAU]);
    if (!(a->flat_area > 0))
        observe_none(out, FLOOR_FLATNESS, "no bubble with three columns in the last %g tau",
                     k->settings[WINDOW_TAU]);
}

/* What has become of the first bubbles; onset is NaN where there are none. */
static void conclude_growth(const struct task *k, double onset, const struct average *window,
                            struct measurement *out) {
    double late = end_of(k) - k->settings[WINDOW_TAU];
    out->value[ONSET_TIME] = onset;
    if (isnan(onset)) {
        const size_t none[] = {ONSET_TIME, NUMBER_EARLY, GROWTH};
        for (size_t i = 0; i < sizeof none / sizeof *none; i++)
            observe_none(out, none[i], "no bubble of %g l^2 by %g tau", k->settings[AREA_MIN],
                         end_of(k));
        return;
    }
    struct average early = average_over(k, onset, onset + SPAN_TAU);
    out->value[NUMBER_EARLY] = early.bubbles / early.frames;
    out->value[GROWTH] = window->area / window->bubbles / (early.area / early.bubbles);
    if (onset + SPAN_TAU > end_of(k) + 1e-9)
        observe_none(out, NUMBER_EARLY, "the first bubble comes at %g tau, the end at %g tau",
                     onset, end_of(k));
    if (onset + SPAN_TAU > late + 1e-9)
        observe_none(out, GROWTH, "the %g tau from onset at %g tau reach into the last %g tau",
                     SPAN_TAU, onset, k->settings[WINDOW_TAU]);
    else if (!(window->bubbles > 0))
        observe_none(out, GROWTH, "no bubble left in the last %g tau", k->settings[WINDOW_TAU]);
}

/* -- events -------------------------------------------------------------------------- */

static bool is_proper(const struct bubble_track *t) {
    return t->large >= 2;
}

/* There at the start, or come out of the dense bed or a layer. */
static bool is_new(const struct bubble_track *t) {
    return t->initial || t->origin == BUBBLE_BIRTH || t->origin == BUBBLE_SHED;
}

/* Time of the first frame with a proper bubble at its full size; NaN if none. */
static double find_onset(const struct task *k) {
    for (size_t n = 0; n < k->h.points; n++) { /* in the order of time */
        const struct bubble_point *p = &k->h.point[n];
        const struct bubble_track *t = &k->h.track[p->track];
        if (is_proper(t) && is_new(t) && p->shape.area_l2 >= k->settings[AREA_MIN])
            return k->h.frame[p->frame].time_tau;
    }
    return NAN;
}

static void count_event(const struct task *k, const struct bubble_event *e,
                        struct measurement *out) {
    bool both = fmin(e->area_l2, e->other_l2) >= k->settings[AREA_MIN];
    bool proper = is_proper(&k->h.track[e->track]);
    switch (e->kind) {
    case BUBBLE_MERGE:
        out->value[MERGES] += both && !e->brief;
        break;
    case BUBBLE_SPLIT:
        out->value[SPLITS] += both && !e->brief;
        break;
    case BUBBLE_BURST:
        out->value[BURSTS] += proper;
        break;
    case BUBBLE_VANISH:
        out->value[VANISHED] += proper;
        break;
    case BUBBLE_BIRTH:
    case BUBBLE_SHED:
    case BUBBLE_ENCLOSE:
    case BUBBLE_ENGULF: /* births are counted by their tracks */
        break;
    }
}

static void conclude_events(const struct task *k, struct measurement *out) {
    double initial = 0;
    for (size_t e = 0; e < k->h.events; e++)
        count_event(k, &k->h.event[e], out);
    for (size_t t = 0; t < k->h.tracks; t++)
        if (is_proper(&k->h.track[t]) && is_new(&k->h.track[t])) {
            initial += k->h.track[t].initial;
            out->value[BIRTHS] += !k->h.track[t].initial;
        }
    double all = out->value[BIRTHS] + initial;
    out->value[MERGES_PER_BUBBLE] = out->value[MERGES] / all;
    if (!(all > 0))
        observe_none(out, MERGES_PER_BUBBLE, "no bubble of %g l^2 by %g tau", k->settings[AREA_MIN],
                     end_of(k));
}

/* -- speeds ----------------------------------------------------------------------------- */

static double diameter_of(const struct bubble_stretch *s) {
    return sqrt(4 * s->area_l2 / M_PI);
}

/* Keep the stretches from rise_from_tau on; the others go. */
static void choose_stretches(struct task *k) {
    size_t kept = 0;
    for (size_t i = 0; i < k->stretches; i++)
        if (k->stretch[i].from_tau >= k->settings[RISE_FROM_TAU] - 1e-9)
            k->stretch[kept++] = k->stretch[i];
    k->stretches = kept;
}

/* sqrt(g D_e) and speed of the stretches inside or along side walls; how many there are. */
static size_t gather(const struct task *k, bool at_side_wall, double *x, double *y) {
    size_t count = 0;
    for (size_t i = 0; i < k->stretches; i++)
        if (k->stretch[i].at_side_wall == at_side_wall) {
            x[count] = sqrt(k->gravity * diameter_of(&k->stretch[i]));
            y[count++] = k->stretch[i].speed_u0;
        }
    return count;
}

static void conclude_speed(const struct task *k, struct measurement *out) {
    double weight = 0, sum = 0;
    for (size_t i = 0; i < k->stretches; i++) {
        const struct bubble_stretch *s = &k->stretch[i];
        double share = s->area_l2 * (s->to_tau - s->from_tau);
        weight += share;
        sum += share * s->speed_u0;
    }
    out->value[RISE_SPEED] = sum / weight;
    if (!k->stretches)
        observe_none(out, RISE_SPEED, "no bubble moves undisturbed for %g frames",
                     k->settings[MIN_FRAMES]);
}

static void conclude_fit(const struct task *k, struct measurement *out) {
    double *x = k->scratch, *y = k->scratch + k->rows;
    double a = NAN, c = NAN, a_variance, covariance, c_variance = NAN, squares;
    size_t count = gather(k, false, x, y);
    if (count >= MIN_STRETCHES)
        gsl_fit_linear(x, 1, y, 1, count, &a, &c, &a_variance, &covariance, &c_variance, &squares);
    out->value[RISE_OFFSET] = a;
    out->value[RISE_COEFFICIENT] = c;
    out->value[RISE_COEFFICIENT_ERROR] = sqrt(c_variance);
    for (size_t i = RISE_OFFSET; i <= RISE_COEFFICIENT_ERROR; i++)
        if (!isfinite(out->value[i]))
            observe_none(out, i,
                         "%zu stretches of undisturbed rise inside, %d of unequal size needed",
                         count, (int)MIN_STRETCHES);
}

/* Mean speed of the stretches away from walls that are about as large; NaN if few. */
static double similar_speed(const struct task *k, const struct bubble_stretch *at_wall) {
    double sum = 0;
    size_t count = 0;
    for (size_t i = 0; i < k->stretches; i++) {
        const struct bubble_stretch *s = &k->stretch[i];
        if (!s->at_side_wall && fabs(diameter_of(s) / diameter_of(at_wall) - 1) <= SIMILAR) {
            sum += s->speed_u0;
            count++;
        }
    }
    return count >= MIN_SIMILAR ? sum / (double)count : NAN;
}

static void conclude_walls(const struct task *k, struct measurement *out) {
    double at_wall = 0, away = 0;
    size_t count = 0;
    for (size_t i = 0; i < k->stretches; i++) {
        double speed = k->stretch[i].at_side_wall ? similar_speed(k, &k->stretch[i]) : NAN;
        if (isnan(speed))
            continue;
        at_wall += k->stretch[i].speed_u0;
        away += speed;
        count++;
    }
    out->value[WALL_RATIO] = at_wall / away;
    if (count < MIN_SIMILAR)
        observe_none(out, WALL_RATIO, "%zu stretches at side walls with similar ones inside",
                     count);
}

/* -- the bed -------------------------------------------------------------------------------- */

static void conclude_bed(const struct task *k, struct measurement *out) {
    double *time = k->scratch, *top = k->scratch + k->rows;
    double start, slope = NAN, variance, covariance, slope_variance, squares;
    size_t count = 0;
    for (size_t i = 0; i < k->h.frames; i++)
        if (k->h.frame[i].time_tau >= end_of(k) - k->settings[WINDOW_TAU] - 1e-9) {
            time[count] = k->h.frame[i].time_tau;
            top[count++] = k->h.frame[i].top_l;
        }
    if (count >= 3)
        gsl_fit_linear(time, 1, top, 1, count, &start, &slope, &variance, &covariance,
                       &slope_variance, &squares);
    out->value[TOP_DRIFT] = slope * SPAN_TAU;
    out->value[STEADY] = fabs(out->value[TOP_DRIFT]) <= k->settings[STEADY_L];
    for (size_t i = TOP_DRIFT; count < 3 && i <= STEADY; i++)
        observe_none(out, i, "%zu samples in the last %g tau, 3 needed", count,
                     k->settings[WINDOW_TAU]);
}

/* -- curves ----------------------------------------------------------------------------------- */

enum { CURVE_NUMBER, CURVE_MEAN, CURVE_LARGEST, CURVE_RISE };
static const char *const CURVES[] = {"number", "mean area", "largest area", "rise", NULL};

/* One of the curves over time; frames without a bubble have no mean area. */
static enum status add_history(const struct task *k, size_t which, struct measurement *out,
                               struct fault *fault) {
    double *time = k->scratch, *value = k->scratch + k->rows;
    size_t count = 0;
    for (size_t i = 0; i < k->h.frames; i++) {
        struct average a = {0};
        add_frame(&a, k, &k->h.frame[i]);
        if (which == CURVE_MEAN && !(a.bubbles > 0))
            continue;
        time[count] = k->h.frame[i].time_tau;
        value[count++] = which == CURVE_NUMBER ? a.bubbles
                         : which == CURVE_MEAN ? a.area / a.bubbles
                                               : a.largest;
    }
    return measurement_add_curve(out, CURVES[which], "", time, value, count, fault);
}

static enum status add_curves(const struct task *k, struct measurement *out, struct fault *fault) {
    enum status status = STATUS_OK;
    for (size_t which = CURVE_NUMBER; which <= CURVE_LARGEST && !status; which++)
        status = add_history(k, which, out, fault);
    static const char *const where[] = {"inside", "at a side wall"};
    double *x = k->scratch, *y = k->scratch + k->rows;
    for (size_t wall = 0; wall < 2 && !status; wall++) {
        size_t count = gather(k, wall, x, y);
        status = measurement_add_curve(out, CURVES[CURVE_RISE], where[wall], x, y, count, fault);
    }
    return status;
}

/* -- all of it -------------------------------------------------------------------------------- */

static enum status follow(struct task *k, struct run_view *v, struct fault *fault) {
    const double *s = k->settings;
    struct bubble_rule rule = {
        .threshold = s[THRESHOLD], .area_min_l2 = s[AREA_MIN], .layer_span = s[LAYER_SPAN]};
    enum status status = bubbles_create(&rule, k->box.nx, k->box.ny, &k->bubbles, fault);
    for (size_t f = 0; f < k->field->frames && !status; f++)
        status =
            bubbles_add(k->bubbles, k->field->time[f], k->field->value + f * k->box.sites, fault);
    if (status) {
        fault_within(fault, "%s: fields/solid_fraction", run_view_path(v));
        return status;
    }
    bubbles_mark_brief(k->bubbles, BRIEF_TAU);
    k->h = bubbles_history(k->bubbles);
    if (end_of(k) - start_of(k) < s[WINDOW_TAU] * (1 - 1e-9))
        return fault_set(fault, STATUS_BAD_INPUT,
                         "%s: fields/solid_fraction lasts from %g to %g tau: no window of %g tau",
                         run_view_path(v), start_of(k), end_of(k), s[WINDOW_TAU]);
    status = bubbles_stretches(k->bubbles, (size_t)s[MIN_FRAMES], s[STRETCH_TAU], &k->stretch,
                               &k->stretches, fault);
    if (status)
        return status;
    choose_stretches(k);
    k->rows = k->stretches > k->h.frames ? k->stretches : k->h.frames;
    k->scratch = calloc(2 * k->rows, sizeof *k->scratch);
    return k->scratch ? STATUS_OK
                      : fault_set(fault, STATUS_NO_MEMORY, "no memory for %zu frames", k->rows);
}

static enum status measure(struct run_view *v, const double *settings, struct measurement *out,
                           struct fault *fault) {
    struct task k = {.settings = settings};
    struct observe_physics physics;
    enum status status = observe_box(v, &k.box, fault);
    if (!status)
        status = observe_physics(v, &physics, fault);
    if (!status)
        status = observe_field(v, "fields/solid_fraction", &k.box, 1, &k.field, fault);
    if (status)
        return status;
    k.gravity = physics.gravity / physics.froude;
    status = follow(&k, v, fault);
    if (status)
        goto done;
    struct average window = average_over(&k, end_of(&k) - settings[WINDOW_TAU], end_of(&k));
    conclude_window(&k, &window, out);
    conclude_growth(&k, find_onset(&k), &window, out);
    conclude_events(&k, out);
    conclude_speed(&k, out);
    conclude_fit(&k, out);
    conclude_walls(&k, out);
    conclude_bed(&k, out);
    status = add_curves(&k, out, fault);
done:
    free(k.scratch);
    free(k.stretch);
    bubbles_free(k.bubbles);
    return status;
}

static const char *const DATASETS[] = {"fields/solid_fraction", NULL};

const struct recipe recipe_bubbles = {
    .name = "bubbles",
    .title = "Bubbles: onset, number, size, shape, rise, merging",
    .source = "MFM, Section IV and Fig. 5",
    .datasets = DATASETS,
    .setting = {{"threshold", "1", "solid fraction below which a site is void", 0.33, 0.01, 0.6},
                {"area_min", "l^2", "area of the smallest bubble", 4, 1, 1e6},
                {"layer_span", "1", "a void over this share of the width is a layer", 0.5, 0.05, 1},
                {"window_tau", "tau", "length of the window at the end of the run", 10, 0.1, 1e6},
                {"steady_l", "l", "steady: drift of the top in 10 tau, at most", 0.1, 0, 1e3},
                {"rise_from_tau", "tau", "motion before this gives no speeds", 0, 0, 1e6},
                {"stretch_tau", "tau", "longer motion of a bubble is cut into pieces", 10, 0.1,
                 1e6},
                {"min_frames", "1", "frames that a speed needs", 5, 3, 1e4}},
    .output = {{"onset_time", "tau", "first bubble of area_min that lasts for two frames"},
               {"births", "1", "such bubbles that came up during the run; 0: none"},
               {"number", "1", "bubbles at a time, mean over the window"},
               {"number_early", "1", "the same over the first 10 tau from onset_time"},
               {"mean_area", "l^2", "mean over the bubbles in the window"},
               {"area_weighted_area", "l^2", "the same, weighted with area"},
               {"growth", "1", "mean_area over that of the first 10 tau from onset_time"},
               {"largest_area", "l^2", "largest bubble in the window; 0: none"},
               {"aspect", "1", "height over width in the window, weighted with area"},
               {"floor_flatness", "1", "0: disc, 1: flat floor, round roof; as aspect"},
               {"layer", "1", "widest layer over the width, mean over the window; 0: none"},
               {"rise_speed", "U0", "mean over stretches, weighted with area and duration"},
               {"rise_offset", "U0", "a of u = a + c sqrt(g D_e)"},
               {"rise_coefficient", "1", "c of the same"},
               {"rise_coefficient_error", "1", "standard error of c, at least"},
               {"wall_ratio", "1", "speed at side walls over that of bubbles of equal size inside"},
               {"merges", "1", "bubbles that became part of another"},
               {"splits", "1", "bubbles that came off another"},
               {"bursts", "1", "bubbles that joined the freeboard"},
               {"vanished", "1", "bubbles that shrank away in the bed"},
               {"merges_per_bubble", "1", "merges over births and bubbles of the first frame"},
               {"top_drift", "l", "change of the bed's top in 10 tau, fit over the window"},
               {"steady", "1", "1: drift of at most steady_l; 0: the window is a transient"}},
    .curves = CURVES,
    .measure = measure,
};
