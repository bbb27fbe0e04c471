/* observe_collision.c -- one collision seen from both grains, and hits in a corner.
 *
 * pair-collision: two grains, no gas, no gravity, a sample every step.  The
 * impulse J = m0 (v0' - v0) gives the normal n = J/|J| without knowing the
 * contact; the restitution is -(v0' - v1').n / (v0 - v1).n; momentum must be
 * conserved and n must lie along the centres.
 *
 * corner-hits: grains that fly into corners hit two walls, in the same step, in
 * two steps that follow each other, or later.  By the contact rule the second
 * hit is elastic in the first two cases and loses energy in the third.
 *
 * Source:     MFM, Section II B, step 3.
 * Leaves out: three grains at once.
 * Checked by: graingas/verification-collision, graingas/verification-contact-rule;
 *             tests/unit/test_observe_grains.c.
 */
#include "validation/observe.h"
#include "validation/recipes.h"

#include <math.h>

enum { RESTITUTION, MOMENTUM_ERROR, NORMAL_ERROR, CHANGES };
enum { FIRST, SAME_STEP, NEXT_STEP, LATER, HIT_OUTPUTS };

static enum status load_steps(struct run_view *v, struct observe_grains *g, struct fault *fault) {
    enum status status = observe_grains(v, true, g, fault);
    if (status)
        return status;
    for (size_t f = 1; f < g->frames; f++)
        if (g->series->step[f] != g->series->step[f - 1] + 1)
            return fault_set(fault, STATUS_BAD_INPUT,
                             "%s: collisions need a sample every step; step %g follows %g",
                             run_view_path(v), g->series->step[f], g->series->step[f - 1]);
    return STATUS_OK;
}

/* -- two grains --------------------------------------------------------------- */

static double dot(const double a[2], const double b[2]) {
    return a[0] * b[0] + a[1] * b[1];
}

static void judge_pair(const struct observe_grains *g, size_t f, struct measurement *out) {
    double m[2] = {observe_area(g, 0), observe_area(g, 1)};
    const double *x[2], *before[2], *after[2];
    for (size_t i = 0; i < 2; i++) {
        x[i] = observe_vector(g->position, g, f, i);
        before[i] = observe_vector(g->velocity, g, f - 1, i);
        after[i] = observe_vector(g->velocity, g, f, i);
    }
    double n[2], centres[2], was[2], is[2], sum[2], size = 0;
    for (size_t a = 0; a < 2; a++) {
        n[a] = m[0] * (after[0][a] - before[0][a]);
        centres[a] = x[0][a] - x[1][a];
        was[a] = before[0][a] - before[1][a];
        is[a] = after[0][a] - after[1][a];
        sum[a] = m[0] * (after[0][a] - before[0][a]) + m[1] * (after[1][a] - before[1][a]);
        size += m[0] * fabs(before[0][a]) + m[1] * fabs(before[1][a]);
    }
    double impulse = hypot(n[0], n[1]), distance = hypot(centres[0], centres[1]);
    out->value[RESTITUTION] = -dot(is, n) / dot(was, n);
    out->value[MOMENTUM_ERROR] = hypot(sum[0], sum[1]) / size;
    out->value[NORMAL_ERROR] =
        hypot(n[0] / impulse - centres[0] / distance, n[1] / impulse - centres[1] / distance);
}

static enum status measure_pair(struct run_view *v, const double *settings, struct measurement *out,
                                struct fault *fault) {
    (void)settings;
    struct observe_grains g;
    enum status status = load_steps(v, &g, fault);
    if (status)
        return status;
    if (g.count != 2)
        return fault_set(fault, STATUS_BAD_INPUT, "%s: a pair needs two grains, not %zu",
                         run_view_path(v), g.count);
    for (size_t f = 1; f < g.frames; f++) {
        const double *before = observe_vector(g.velocity, &g, f - 1, 0);
        const double *after = observe_vector(g.velocity, &g, f, 0);
        if (before[0] == after[0] && before[1] == after[1])
            continue;
        if (out->value[CHANGES] == 0)
            judge_pair(&g, f, out);
        out->value[CHANGES]++;
    }
    for (size_t i = RESTITUTION; out->value[CHANGES] == 0 && i <= NORMAL_ERROR; i++)
        observe_none(out, i, "the grains never collide");
    return STATUS_OK;
}

/* -- corners ------------------------------------------------------------------ */

struct hit {
    size_t frame; /* 0: none */
    double restitution;
};

/* The first change of sign of one component of a grain's velocity. */
static struct hit find_hit(const struct observe_grains *g, size_t grain, size_t axis) {
    for (size_t f = 1; f < g->frames; f++) {
        double before = observe_vector(g->velocity, g, f - 1, grain)[axis];
        double after = observe_vector(g->velocity, g, f, grain)[axis];
        if (before * after < 0)
            return (struct hit){f, -after / before};
    }
    return (struct hit){0, NAN};
}

static enum status measure_corners(struct run_view *v, const double *settings,
                                   struct measurement *out, struct fault *fault) {
    (void)settings;
    struct observe_grains g;
    double sum[HIT_OUTPUTS] = {0};
    size_t count[HIT_OUTPUTS] = {0};
    enum status status = load_steps(v, &g, fault);
    if (status)
        return status;
    for (size_t i = 0; i < g.count; i++) {
        struct hit a = find_hit(&g, i, 0), b = find_hit(&g, i, 1);
        if (!a.frame || !b.frame)
            continue;
        struct hit first = a.frame < b.frame ? a : b, second = a.frame < b.frame ? b : a;
        size_t delay = second.frame - first.frame;
        size_t kind = delay == 0 ? SAME_STEP : delay == 1 ? NEXT_STEP : LATER;
        sum[kind] += delay == 0 ? a.restitution * b.restitution : second.restitution;
        count[kind]++;
        if (delay) {
            sum[FIRST] += first.restitution;
            count[FIRST]++;
        }
    }
    for (size_t k = 0; k < HIT_OUTPUTS; k++) {
        out->value[k] = sum[k] / (double)count[k];
        if (!count[k])
            observe_none(out, k, "no grain hits two walls so");
    }
    return STATUS_OK;
}

static const char *const DATASETS[] = {"particles/grains/position", "particles/grains/velocity",
                                       "particles/grains/radius", NULL};

const struct recipe recipe_pair = {
    .name = "pair-collision",
    .title = "One collision of two grains",
    .source = "MFM, Section II B",
    .datasets = DATASETS,
    .output = {{"restitution", "1", "normal speed after over before"},
               {"momentum_error", "1", "change of momentum over sum m |v|"},
               {"normal_error", "1", "unit impulse less unit line of centres"},
               {"changes", "1", "steps in which the first grain's velocity changes"}},
    .measure = measure_pair,
};

const struct recipe recipe_corner_hits = {
    .name = "corner-hits",
    .title = "Two walls hit one after the other",
    .source = "MFM, Section II B, step 3",
    .datasets = DATASETS,
    .output = {{"first", "1", "restitution of a first hit"},
               {"same_step", "1", "product of both, where both fall into one step"},
               {"next_step", "1", "restitution of the second hit, one step after the first"},
               {"later", "1", "the same, two or more steps after"}},
    .measure = measure_corners,
};
