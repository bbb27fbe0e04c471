/* observe_spheres_single.c -- exact motions of few spheres: drag, one collision.
 *
 * sphere-decay: spheres that meet nothing: v(t) = v(0) exp(-gamma t) and
 * x(t) - x(0) = v(0) (1 - exp(-gamma t))/gamma, unfolded; so each goes v(0)/gamma at most.
 *
 * sphere-pair: spheres 0 and 1 meet once, without drag, far from walls.  The
 * place of the contact follows from the first sample: |r + g t| = d; n is the line of
 * centres then.  Afterwards (g.n)' = -eps (g.n) (FZ Eq. 2), the rest of g as before,
 * the pair's momentum the same, and the places those of straight flights from there.
 *
 * Source:     Fiege & Zippelius, Eqs. 2 and 6.
 * Leaves out: unequal masses; the guard's elastic collisions.
 * Checked by: suspension/verification-drag, -restitution;
 *             tests/unit/test_observe_spheres_single.c.
 */
#include "validation/observe_spheres.h"
#include "validation/recipes.h"

#include <math.h>

enum { DECAY_ERROR, RANGE_ERROR, RANGE_SHARE };
enum { RESTITUTION, TANGENTIAL_ERROR, MOMENTUM_ERROR, PLACE_ERROR, CONTACT };

struct flight {
    struct observe_spheres spheres;
    const struct series *x, *u, *image;
};

static enum status load(struct run_view *v, struct flight *k, struct fault *fault) {
    enum status status = observe_spheres(v, &k->spheres, fault);
    if (!status)
        status = observe_spheres_vectors(v, "position", &k->spheres, &k->x, fault);
    if (!status)
        status = observe_spheres_vectors(v, "velocity", &k->spheres, &k->u, fault);
    if (!status)
        status = observe_spheres_vectors(v, "image", &k->spheres, &k->image, fault);
    if (!status)
        status = observe_spheres_together(v, k->x, k->u, fault);
    if (!status)
        status = observe_spheres_together(v, k->x, k->image, fault);
    if (!status && k->x->frames < 2)
        status =
            fault_set(fault, STATUS_BAD_INPUT, "%s: a motion needs two samples", run_view_path(v));
    return status;
}

/* Way of a sphere along an axis since the first sample (m). */
static double way(const struct flight *k, size_t frame, size_t sphere, size_t axis) {
    double crossings = observe_spheres_at(k->image, frame, sphere)[axis] -
                       observe_spheres_at(k->image, 0, sphere)[axis];
    return observe_spheres_at(k->x, frame, sphere)[axis] -
           observe_spheres_at(k->x, 0, sphere)[axis] + crossings * k->spheres.box_m[axis];
}

/* Errors of one sphere at one sample, of its first speed and of speed/gamma. */
static void compare_decay(const struct flight *k, double gamma, size_t frame, size_t sphere,
                          double *decay, double *range) {
    const double *start = observe_spheres_at(k->u, 0, sphere);
    const double *now = observe_spheres_at(k->u, frame, sphere);
    double time = k->x->time[frame] - k->x->time[0];
    double left = exp(-gamma * time), clock = -expm1(-gamma * time) / gamma;
    double speed = hypot(hypot(start[0], start[1]), start[2]);
    if (!(speed > 0))
        return;
    for (size_t a = 0; a < 3; a++) {
        *decay = fmax(*decay, fabs(now[a] - start[a] * left) / speed);
        *range = fmax(*range, fabs(way(k, frame, sphere, a) - start[a] * clock) * gamma / speed);
    }
}

static enum status measure_decay(struct run_view *v, const double *settings,
                                 struct measurement *out, struct fault *fault) {
    (void)settings;
    struct flight k;
    double gamma = 0;
    enum status status = load(v, &k, fault);
    if (!status)
        status = observe_spheres_drag(v, &gamma, fault);
    if (!status && !(gamma > 0))
        status = fault_set(fault, STATUS_BAD_INPUT, "%s: there is no drag", run_view_path(v));
    if (status)
        return status;
    for (size_t f = 1; f < k.x->frames; f++)
        for (size_t i = 0; i < k.spheres.count; i++)
            compare_decay(&k, gamma, f, i, &out->value[DECAY_ERROR], &out->value[RANGE_ERROR]);
    const double *start = observe_spheres_at(k.u, 0, 0);
    size_t last = k.x->frames - 1;
    double speed = hypot(hypot(start[0], start[1]), start[2]);
    double far = hypot(hypot(way(&k, last, 0, 0), way(&k, last, 0, 1)), way(&k, last, 0, 2));
    if (speed > 0)
        out->value[RANGE_SHARE] = far * gamma / speed;
    else
        observe_none(out, RANGE_SHARE, "the first sphere is at rest");
    return STATUS_OK;
}

/* -- one collision ------------------------------------------------------------------ */

static double dot(const double *a, const double *b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* Time and line of centres of the contact; NAN when they never touch. */
static double contact(const double r[3], const double g[3], double diameter, double n[3]) {
    double speed2 = dot(g, g), approach = dot(r, g);
    double under = approach * approach - speed2 * (dot(r, r) - diameter * diameter);
    if (!(approach < 0) || !(under > 0))
        return NAN;
    double time = (-approach - sqrt(under)) / speed2;
    for (size_t a = 0; a < 3; a++)
        n[a] = (r[a] + g[a] * time) / diameter;
    return time;
}

static double place_error(const struct flight *k, size_t last, double time) {
    double rest = k->x->time[last] - k->x->time[0] - time, worst = 0;
    for (size_t i = 0; i < 2; i++)
        for (size_t a = 0; a < 3; a++) {
            double expected = observe_spheres_at(k->u, 0, i)[a] * time +
                              observe_spheres_at(k->u, last, i)[a] * rest;
            worst = fmax(worst, fabs(way(k, last, i, a) - expected));
        }
    return worst / (2 * k->spheres.radius_m);
}

static enum status measure_pair(struct run_view *v, const double *settings, struct measurement *out,
                                struct fault *fault) {
    (void)settings;
    struct flight k;
    enum status status = load(v, &k, fault);
    if (!status && k.spheres.count < 2)
        status =
            fault_set(fault, STATUS_BAD_INPUT, "%s: a pair needs two spheres", run_view_path(v));
    if (status)
        return status;
    size_t last = k.x->frames - 1;
    double r[3], before[3], after[3], n[3] = {0}, lost = 0, momentum = 0;
    for (size_t a = 0; a < 3; a++) {
        const double *u[2] = {observe_spheres_at(k.u, 0, 0), observe_spheres_at(k.u, 0, 1)};
        const double *w[2] = {observe_spheres_at(k.u, last, 0), observe_spheres_at(k.u, last, 1)};
        r[a] = observe_spheres_at(k.x, 0, 0)[a] - observe_spheres_at(k.x, 0, 1)[a];
        before[a] = u[0][a] - u[1][a];
        after[a] = w[0][a] - w[1][a];
        momentum = fmax(momentum, fabs(u[0][a] + u[1][a] - w[0][a] - w[1][a]));
    }
    double time = contact(r, before, 2 * k.spheres.radius_m, n);
    if (!(time < k.x->time[last] - k.x->time[0])) {
        for (size_t i = RESTITUTION; i <= PLACE_ERROR; i++)
            observe_none(out, i, "the pair does not meet in the run");
        return STATUS_OK;
    }
    double speed = sqrt(dot(before, before));
    for (size_t a = 0; a < 3; a++)
        lost =
            fmax(lost, fabs(after[a] - dot(after, n) * n[a] - before[a] + dot(before, n) * n[a]));
    out->value[RESTITUTION] = -dot(after, n) / dot(before, n);
    out->value[TANGENTIAL_ERROR] = lost / speed;
    out->value[MOMENTUM_ERROR] = momentum / speed;
    out->value[PLACE_ERROR] = place_error(&k, last, time);
    out->value[CONTACT] = time;
    return STATUS_OK;
}

static const char *const DATASETS[] = {"particles/spheres/position", "particles/spheres/velocity",
                                       "particles/spheres/image", NULL};

const struct recipe recipe_sphere_decay = {
    .name = "sphere-decay",
    .title = "Spheres under drag alone",
    .source = "Fiege & Zippelius, Eq. 6",
    .datasets = DATASETS,
    .output = {{"decay_error", "1", "largest error of any velocity, of the sphere's first speed"},
               {"range_error", "1", "largest error of any way, of first speed/gamma"},
               {"range_share", "1", "way of the first sphere by the last sample over speed/gamma"}},
    .measure = measure_decay,
};

const struct recipe recipe_sphere_pair = {
    .name = "sphere-pair",
    .title = "One collision of two spheres",
    .source = "Fiege & Zippelius, Eq. 2",
    .datasets = DATASETS,
    .output = {{"restitution", "1", "-(g.n)'/(g.n)"},
               {"tangential_error", "1", "change of g across n, of |g|"},
               {"momentum_error", "1", "change of the sum of velocities, of |g|"},
               {"place_error", "d", "largest error of a place at the last sample"},
               {"contact_time", "s", "of the contact, from the first sample"}},
    .measure = measure_pair,
};
