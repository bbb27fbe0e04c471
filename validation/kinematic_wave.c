/* kinematic_wave.c -- see kinematic_wave.h. */
#include "validation/kinematic_wave.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum {
    LOW_KNOTS = 300,  /* from 0 to the smaller of the two packing fractions */
    HIGH_KNOTS = 300, /* from there to the larger */
    KNOTS = LOW_KNOTS + HIGH_KNOTS + 1,
    FRONTS = 4 * KNOTS,
    MEETINGS = 100 * KNOTS /* more means that something is wrong */
};

struct front {
    double place_m, speed_m_per_s;
    int left, right; /* knots below and above it */
};

struct kinematic_wave {
    double phi[KNOTS], flux[KNOTS]; /* (1), (m/s) */
    double load_m, time_s;
    int count;
    struct front front[FRONTS]; /* from the floor upwards */
};

/* -- Riemann problems -------------------------------------------------------------- */

static double chord(const struct kinematic_wave *w, int a, int b) {
    return (w->flux[b] - w->flux[a]) / (w->phi[b] - w->phi[a]);
}

/* Waves between two knots: corner[0 .. return], corners of the envelope of f, from `left` on.
 * Their chords rise along it: the wave next to `left` is the slowest. */
static int find_envelope(const struct kinematic_wave *w, int left, int right, int corner[KNOTS]) {
    int step = right > left ? 1 : -1, n = 0;
    corner[0] = left;
    for (int k = left; k != right;) {
        k += step;
        while (n > 0 && chord(w, corner[n], k) <= chord(w, corner[n - 1], corner[n]))
            n--;
        corner[++n] = k;
    }
    return n;
}

/* In place of the fronts first .. last, which are all at place_m, what comes out of their outer
 * states. */
static enum status solve_riemann(struct kinematic_wave *w, int first, int last, double place_m,
                                 int left, int right, struct fault *fault) {
    int corner[KNOTS], n = 0;
    if (left != right)
        n = find_envelope(w, left, right, corner);
    int gone = last - first + 1, rest = w->count - last - 1;
    if (w->count - gone + n > FRONTS)
        return fault_set(fault, STATUS_BAD_INPUT, "a kinematic wave of more than %d fronts",
                         (int)FRONTS);
    memmove(&w->front[first + n], &w->front[last + 1], (size_t)rest * sizeof *w->front);
    for (int i = 0; i < n; i++)
        w->front[first + i] = (struct front){.place_m = place_m,
                                             .speed_m_per_s = chord(w, corner[i], corner[i + 1]),
                                             .left = corner[i],
                                             .right = corner[i + 1]};
    w->count += n - gone;
    return STATUS_OK;
}

/* -- creation ---------------------------------------------------------------------- */

static void make_knots(struct kinematic_wave *w, const struct bed_change *c) {
    double low = fmin(c->before, c->after), high = fmax(c->before, c->after);
    for (int k = 0; k < KNOTS; k++) {
        double phi = k <= LOW_KNOTS ? low * k / LOW_KNOTS
                                    : low + (high - low) * (k - LOW_KNOTS) / HIGH_KNOTS;
        w->phi[k] = phi;
        w->flux[k] = phi * bed_change_speed(c, phi, c->after);
    }
}

enum status kinematic_wave_create(const struct bed_change *change, struct kinematic_wave **out,
                                  struct fault *fault) {
    struct kinematic_wave *w = *out = calloc(1, sizeof *w);
    if (!w)
        return fault_set(fault, STATUS_NO_MEMORY, "no memory for a kinematic wave");
    make_knots(w, change);
    w->load_m = change->load_m;
    int before = change->before < change->after ? LOW_KNOTS : KNOTS - 1;
    int after = before == LOW_KNOTS ? KNOTS - 1 : LOW_KNOTS;
    w->flux[after] = 0; /* to round-off it is */
    enum status status = solve_riemann(w, 0, -1, 0, after, before, fault);
    if (!status)
        status =
            solve_riemann(w, w->count, w->count - 1, w->load_m / change->before, before, 0, fault);
    if (status) {
        kinematic_wave_free(w);
        *out = NULL;
    }
    return status;
}

void kinematic_wave_free(struct kinematic_wave *w) {
    free(w);
}

/* -- in time ----------------------------------------------------------------------- */

/* The two neighbours that meet next, the first of them; -1: none. *after_s: in what time. */
static int next_meeting(const struct kinematic_wave *w, double *after_s) {
    int next = -1;
    *after_s = INFINITY;
    for (int i = 0; i + 1 < w->count; i++) {
        const struct front *a = &w->front[i], *b = a + 1;
        double closing = a->speed_m_per_s - b->speed_m_per_s;
        double apart = fmax(b->place_m - a->place_m, 0);
        if (closing > 0 && apart / closing < *after_s) {
            *after_s = apart / closing;
            next = i;
        }
    }
    return next;
}

static void move(struct kinematic_wave *w, double by_s) {
    for (int i = 0; i < w->count; i++)
        w->front[i].place_m += by_s * w->front[i].speed_m_per_s;
    w->time_s += by_s;
}

static enum status advance(struct kinematic_wave *w, double time_s, struct fault *fault) {
    for (int meetings = 0; meetings < MEETINGS; meetings++) {
        double after_s;
        int i = next_meeting(w, &after_s);
        if (i < 0 && isinf(time_s))
            return STATUS_OK;
        if (i < 0 || w->time_s + after_s > time_s) {
            move(w, time_s - w->time_s);
            return STATUS_OK;
        }
        move(w, after_s);
        enum status status =
            solve_riemann(w, i, i + 1, (w->front[i].place_m + w->front[i + 1].place_m) / 2,
                          w->front[i].left, w->front[i + 1].right, fault);
        if (status)
            return status;
    }
    return fault_set(fault, STATUS_NUMERICAL, "a kinematic wave meets itself without end");
}

enum status kinematic_wave_advance(struct kinematic_wave *w, double time_s, struct fault *fault) {
    if (!(time_s >= w->time_s && time_s < INFINITY))
        return fault_set(fault, STATUS_BAD_INPUT, "a kinematic wave at %g s cannot go on to %g s",
                         w->time_s, time_s);
    return advance(w, time_s, fault);
}

bool kinematic_wave_rests(const struct kinematic_wave *w) {
    return w->count == 1;
}

enum status kinematic_wave_settle(struct kinematic_wave *w, double *time_s, struct fault *fault) {
    enum status status = advance(w, INFINITY, fault);
    *time_s = w->time_s;
    if (!status && w->count != 1)
        status =
            fault_set(fault, STATUS_NUMERICAL, "a kinematic wave ends with %d fronts", w->count);
    return status;
}

double kinematic_wave_end(const struct bed_change *change) {
    return change->load_m /
           (bed_change_slope(change) * fmin(change->before, change->after) * change->after);
}

/* -- moments ----------------------------------------------------------------------- */

double kinematic_wave_centre(const struct kinematic_wave *w) {
    double moment = 0;
    for (int i = 0; i < w->count; i++) {
        const struct front *f = &w->front[i];
        moment += (w->phi[f->left] - w->phi[f->right]) * f->place_m * f->place_m / 2;
    }
    return moment / w->load_m;
}

/* Solid below a height (m): each front is where phi jumps by left - right. */
static double solid_below(const struct kinematic_wave *w, double height_m) {
    double solid = w->count > 0 ? w->phi[w->front[0].left] * height_m : 0;
    for (int i = 0; i < w->count && w->front[i].place_m < height_m; i++)
        solid += (w->phi[w->front[i].right] - w->phi[w->front[i].left]) *
                 (height_m - w->front[i].place_m);
    return solid;
}

void kinematic_wave_profile(const struct kinematic_wave *w, double bin_m, double *fraction,
                            size_t bins) {
    double below = 0;
    for (size_t i = 0; i < bins; i++) {
        double here = solid_below(w, (double)(i + 1) * bin_m);
        fraction[i] = (here - below) / bin_m;
        below = here;
    }
}
