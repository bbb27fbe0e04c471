/* observe_settling.c -- settling speed and density of the suspension below the front.
 *
 * At each sample the plateau of the profile gives one pair (solid fraction,
 * speed), the mean over its rows; the pairs of all samples are averaged (MFM,
 * Section III, five samples).  Three things make it robust: sparse rows are
 * dropped before the maxima are taken (observe_profile.h); a sample whose
 * plateau has fewer than min_rows rows is not used; and once the plateau's speed
 * has fallen below a share of the largest one seen, the settled bed's upper edge
 * has reached it, settling has ended, and that sample and all later ones are not
 * used.
 *
 * Source:     MFM, Section III and Fig. 4; robustness: docs/theory.md.
 * Leaves out: the front's speed (observe_front.c).
 * Checked by: graingas/sedimentation; tests/unit/test_observe_settling.c.
 */
#include "validation/observe_profile.h"
#include "validation/recipes.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { MIN_ROWS, ROW_L, FROM_TAU, EVERY_TAU, ENDED, MIN_SAMPLES };
enum { SPEED, SOLID_FRACTION, SAMPLES, ROWS, SPEED_SPREAD, LAST_TAU };

struct sums {
    size_t used;
    double speed, speed_square, solid_fraction, rows, fastest, last_tau;
    size_t first_frame, last_frame;
};

/* Room for one point a frame of the curves. */
struct trace {
    size_t count;
    double *time, *speed, *solid_fraction;
};

static void use_sample(struct sums *s, struct trace *t, const struct plateau *p, double time,
                       size_t frame) {
    if (!s->used)
        s->first_frame = frame;
    s->last_frame = frame;
    s->used++;
    s->speed += p->speed;
    s->speed_square += p->speed * p->speed;
    s->solid_fraction += p->solid_fraction;
    s->rows += (double)p->rows;
    s->fastest = fmax(s->fastest, p->speed);
    s->last_tau = time;
    t->time[t->count] = time;
    t->speed[t->count] = p->speed;
    t->solid_fraction[t->count++] = p->solid_fraction;
}

/* What all frames of one run are measured with. */
struct task {
    struct run_view *view;
    struct observe_box box;
    struct observe_physics physics;
    struct observe_grains grains;
    struct profile profile;
};

static bool is_wanted(double time, const double *settings, double dt) {
    double every = settings[EVERY_TAU];
    if (time <= 0 || time < settings[FROM_TAU] - dt / 2)
        return false;
    return every == 0 || fabs(time - every * nearbyint(time / every)) <= dt / 2;
}

static enum status collect(struct task *k, const double *settings, struct sums *s, struct trace *t,
                           struct fault *fault) {
    for (size_t f = 0; f < k->grains.frames; f++) {
        double time = k->grains.time[f];
        if (!is_wanted(time, settings, k->physics.dt_tau))
            continue;
        enum status status = profile_measure(&k->profile, k->view, &k->box, &k->grains,
                                             k->physics.area_to_volume, f, fault);
        if (status)
            return status;
        struct plateau p = profile_plateau(&k->profile, &PLATEAU_RULE);
        if (s->used && p.speed < settings[ENDED] * s->fastest)
            return STATUS_OK;
        if ((double)p.rows >= settings[MIN_ROWS])
            use_sample(s, t, &p, time, f);
    }
    return STATUS_OK;
}

static void conclude(const struct sums *s, const double *settings, struct measurement *out) {
    double n = (double)s->used;
    out->value[SAMPLES] = n;
    if (n < settings[MIN_SAMPLES]) {
        for (size_t i = 0; i <= LAST_TAU; i++)
            if (i != SAMPLES)
                observe_none(out, i, "%zu samples with a plateau of at least %g rows; %g needed",
                             s->used, settings[MIN_ROWS], settings[MIN_SAMPLES]);
        return;
    }
    out->value[SPEED] = s->speed / n;
    out->value[SOLID_FRACTION] = s->solid_fraction / n;
    out->value[ROWS] = s->rows / n;
    out->value[LAST_TAU] = s->last_tau;
    double variance = s->speed_square / n - out->value[SPEED] * out->value[SPEED];
    out->value[SPEED_SPREAD] = sqrt(fmax(variance, 0)) / fabs(out->value[SPEED]);
}

static enum status add_profiles(struct task *k, const struct sums *s, struct measurement *out,
                                struct fault *fault) {
    const struct profile *p = &k->profile;
    const size_t frame[2] = {s->first_frame, s->last_frame};
    for (size_t i = 0; i < 2; i++) {
        char label[64];
        enum status status = profile_measure(&k->profile, k->view, &k->box, &k->grains,
                                             k->physics.area_to_volume, frame[i], fault);
        snprintf(label, sizeof label, "%g tau", k->grains.time[frame[i]]);
        if (!status)
            status = measurement_add_curve(out, "density profile", label, p->height,
                                           p->solid_fraction, p->rows, fault);
        if (!status)
            status = measurement_add_curve(out, "speed profile", label, p->height, p->speed,
                                           p->rows, fault);
        if (status)
            return status;
    }
    return STATUS_OK;
}

static enum status measure(struct run_view *v, const double *settings, struct measurement *out,
                           struct fault *fault) {
    struct task k = {.view = v};
    struct sums s = {0};
    struct trace t = {0};
    enum status status = observe_box(v, &k.box, fault);
    if (!status)
        status = observe_physics(v, &k.physics, fault);
    if (!status)
        status = observe_grains(v, true, &k.grains, fault);
    if (!status)
        status = profile_create(&k.profile, &k.box, settings[ROW_L], fault);
    if (status)
        return status;
    t.time = calloc(3 * k.grains.frames, sizeof *t.time);
    if (!t.time) {
        status = fault_set(fault, STATUS_NO_MEMORY, "no memory for %zu frames", k.grains.frames);
        goto done;
    }
    t.speed = t.time + k.grains.frames;
    t.solid_fraction = t.speed + k.grains.frames;
    status = collect(&k, settings, &s, &t, fault);
    if (status)
        goto done;
    conclude(&s, settings, out);
    if (s.used)
        status = add_profiles(&k, &s, out, fault);
    if (!status && s.used)
        status = measurement_add_curve(out, "speed", "over time", t.time, t.speed, t.count, fault);
done:
    free(t.time);
    profile_free(&k.profile);
    return status;
}

static const char *const DATASETS[] = {"particles/grains/position", "particles/grains/velocity",
                                       "particles/grains/radius", NULL};
static const char *const CURVES[] = {"density profile", "speed profile", "speed", NULL};

const struct recipe recipe_settling = {
    .name = "settling",
    .title = "Speed and solid fraction of the settling plateau",
    .source = "MFM, Section III and Fig. 4",
    .datasets = DATASETS,
    .setting = {{"min_rows", "1", "rows that a plateau must have to be used", 8, 1, 1000},
                {"row_l", "l", "height of a row", 1, 0.1, 10},
                {"from_tau", "tau", "samples before this are not used", 0, 0, 1e6},
                {"every_tau", "tau", "only samples at multiples of this are used; 0: all", 0, 0,
                 1e6},
                {"ended", "1", "settling has ended below this share of the largest speed", 0.5, 0,
                 1},
                {"min_samples", "1", "samples needed", 1, 1, 1000}},
    .output = {{"speed", "U0", "mean speed of the plateau, positive downwards"},
               {"solid_fraction", "1", "its mean solid volume fraction"},
               {"samples", "1", "samples used"},
               {"rows", "1", "mean number of rows of the plateau"},
               {"speed_spread", "1", "standard deviation of the speed over the samples, relative"},
               {"last_tau", "tau", "time of the last sample used"}},
    .curves = CURVES,
    .measure = measure,
};
