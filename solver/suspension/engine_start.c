/* engine_start.c -- making an engine, placing its spheres, and the clock's rebase. */
#include "solver/suspension/engine_state.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { EVENTS_A_BUCKET = 5, EVENTS_A_REBUILD = 4, EVENTS_AT_LEAST = 1000 };
static const double deepest_allowed = 1e-10; /* diameters: what rounding to text may cost */

/* -- creation ----------------------------------------------------------------------- */

static void check_positive(const char *name, double value, struct fault *fault) {
    if (!(value > 0 && isfinite(value)))
        fault_add(fault, STATUS_BAD_INPUT, "%s is %g: it must be positive and finite", name, value);
}

static enum status check_setup(const struct engine_setup *s, struct fault *fault) {
    check_positive("radius_m", s->radius_m, fault);
    check_positive("mass_kg", s->mass_kg, fault);
    for (int a = 0; a < 3; a++) {
        bool periodic = s->boundary[a] == BOUNDARY_PERIODIC;
        double least = (periodic ? 4 : 2) * s->radius_m;
        check_positive("a side of the box", s->box_m[a], fault);
        if (!(periodic ? s->box_m[a] > least : s->box_m[a] >= least))
            fault_add(fault, STATUS_BAD_INPUT, "side %c of the box is %g m: a %s one needs %s %g m",
                      "xyz"[a], s -> box_m[a], periodic ? "periodic" : "hard",
                      periodic ? "more than" : "at least", least);
    }
    if (!(s->restitution > 0 && s->restitution <= 1))
        fault_add(fault, STATUS_BAD_INPUT, "restitution is %g: it must be in (0, 1]",
                  s->restitution);
    if (s->guard == GUARD_CONTACT_TIME && !(s->contact_time_s >= 0 && isfinite(s->contact_time_s)))
        fault_add(fault, STATUS_BAD_INPUT, "contact_time_s is %g: it must be >= 0 and finite",
                  s->contact_time_s);
    if (s->guard == GUARD_CUTOFF_SPEED &&
        !(s->cutoff_speed_m_s >= 0 && isfinite(s->cutoff_speed_m_s)))
        fault_add(fault, STATUS_BAD_INPUT, "cutoff_speed_m_s is %g: it must be >= 0 and finite",
                  s->cutoff_speed_m_s);
    if (s->count > INT32_MAX / 8)
        fault_add(fault, STATUS_BAD_INPUT, "%zu spheres are more than this engine can number",
                  s->count);
    return fault->status;
}

static enum status take_memory(struct engine *e, struct fault *fault) {
    size_t n = e->count + 1;
    e->sphere = spheres_memory(n * sizeof *e->sphere);
    e->event = spheres_memory(n * sizeof *e->event);
    e->last_hit = spheres_memory(n * sizeof *e->last_hit);
    e->image = spheres_memory(n * sizeof *e->image);
    e->id = spheres_memory(n * sizeof *e->id);
    e->place = spheres_memory(n * sizeof *e->place);
    if (!e->sphere || !e->event || !e->last_hit || !e->image || !e->id || !e->place)
        return fault_set(fault, STATUS_NO_MEMORY, "no memory for %zu spheres", e->count);
    memset(e->sphere, 0, n * sizeof *e->sphere);
    memset(e->event, 0, n * sizeof *e->event);
    memset(e->image, 0, n * sizeof *e->image);
    return STATUS_OK;
}

static enum status make_grid(struct engine *e, struct fault *fault) {
    const struct engine_setup *s = &e->setup;
    double low[3], high[3];
    bool periodic[3];
    for (int a = 0; a < 3; a++) {
        periodic[a] = s->boundary[a] == BOUNDARY_PERIODIC;
        low[a] = periodic[a] ? 0 : s->radius_m;
        high[a] = periodic[a] ? s->box_m[a] : s->box_m[a] - s->radius_m;
    }
    for (int k = 0; k < PREDICT_SHIFTS; k++) {
        const int side[3] = {k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1};
        for (int a = 0; a < 3; a++)
            e->shift[k][a] = side[a] * s->box_m[a];
    }
    return cells_create(&e->cells, e->count, low, high, periodic, 2 * s->radius_m, fault);
}

enum status engine_create(struct engine **out, const struct engine_setup *s, struct fault *fault) {
    *out = NULL;
    if (check_setup(s, fault) != STATUS_OK)
        return fault->status;
    struct engine *e = spheres_memory(sizeof *e);
    if (!e)
        return fault_set(fault, STATUS_NO_MEMORY, "no memory for an engine");
    memset(e, 0, sizeof *e);
    e->setup = *s;
    e->count = s->count;
    e->diameter = 2 * s->radius_m;
    e->contact_span = s->contact_time_s;
    e->rebase_at = INFINITY;
    e->broken = QUEUE_NONE;
    if (take_memory(e, fault) != STATUS_OK || make_grid(e, fault) != STATUS_OK ||
        queue_create(&e->queue, e->event, e->count, fault) != STATUS_OK) {
        engine_free(e);
        return fault->status;
    }
    for (size_t i = 0; i < e->count; i++) {
        e->event[i].time = e->sphere[i].pair_time = INFINITY;
        e->id[i] = e->place[i] = (uint32_t)i;
    }
    queue_rebuild(&e->queue, 0, 1);
    *out = e;
    return STATUS_OK;
}

void engine_free(struct engine *e) {
    if (!e)
        return;
    queue_free(&e->queue);
    cells_free(&e->cells);
    free(e->sphere);
    free(e->event);
    free(e->last_hit);
    free(e->image);
    free(e->id);
    free(e->place);
    free(e);
}

/* -- the start ---------------------------------------------------------------------- */

static enum status check_places(const struct engine *e, const double *x, const double *v,
                                struct fault *fault) {
    for (size_t i = 0; i < e->count; i++)
        for (int a = 0; a < 3; a++) {
            const double *edge = e->cells.edge[a];
            double low = edge[0], high = edge[e->cells.n[a]], at = x[3 * i + (size_t)a];
            double room = e->cells.periodic[a] ? 0 : 2 * deepest_allowed * e->setup.radius_m;
            if (!(at >= low - room && at <= high + room))
                return fault_set(fault, STATUS_BAD_INPUT,
                                 "sphere %zu: %c is %.17g m, outside of [%.17g, %.17g]", i,
                                 "xyz"[a], at, low, high);
            if (!isfinite(v[3 * i + (size_t)a]))
                return fault_set(fault, STATUS_BAD_INPUT, "sphere %zu: velocity %c is %g", i,
                                 "xyz"[a], v[3 * i + (size_t)a]);
        }
    return STATUS_OK;
}

static enum status refuse_overlap(const struct engine *e, struct fault *fault) {
    struct engine_overlap worst;
    if (engine_find_overlap(e, &worst) != STATUS_OK)
        return fault_set(fault, STATUS_NO_MEMORY, "no memory to look for overlaps");
    if (worst.depth > deepest_allowed)
        return fault_set(fault, STATUS_BAD_INPUT,
                         "spheres %u and %u overlap by %.3g diameters (diameter %g m)", worst.i,
                         worst.j, worst.depth, engine_diameter(e));
    return STATUS_OK;
}

/* All predictions anew, from the places now. */
static void predict_all(struct engine *e) {
    double sum = 0;
    size_t finite = 0;
    for (size_t i = 0; i < e->count; i++)
        e->event[i].time = e->sphere[i].pair_time = INFINITY;
    queue_rebuild(&e->queue, e->now, 1);
    for (size_t i = 0; i < e->count; i++) {
        sphere_advance(&e->sphere[i], e->now);
        engine_predict(e, (uint32_t)i);
        if (isfinite(e->event[i].time)) {
            sum += e->event[i].time - e->now;
            finite++;
        }
    }
    double wait = finite > 0 ? sum / (double)finite : 0;
    queue_rebuild(&e->queue, e->now, engine_bucket_width(e, wait));
}

enum status engine_set_state(struct engine *e, const double *position, const double *velocity,
                             struct fault *fault) {
    if (check_places(e, position, velocity, fault) != STATUS_OK)
        return fault->status;
    e->diameter = engine_diameter(e);
    e->gamma = e->origin_s = e->now = e->real_now_s = e->growth_from = e->tuned_from = 0;
    e->contact_span = e->setup.contact_time_s;
    e->rebase_at = INFINITY;
    e->events = e->standstill = 0;
    e->rebuild_events = EVENTS_AT_LEAST + EVENTS_A_REBUILD * (long long)e->count;
    e->broken = QUEUE_NONE;
    engine_reset_tally(e);
    memset(e->image, 0, e->count * sizeof *e->image);
    cells_clear(&e->cells);
    for (size_t i = 0; i < e->count; i++) {
        struct sphere *s = &e->sphere[i];
        struct event *v = &e->event[i];
        *s = (struct sphere){.t = 0, .pair_time = INFINITY};
        *v = (struct event){.time = INFINITY};
        for (int a = 0; a < 3; a++) {
            s->x[a] = position[3 * i + (size_t)a];
            s->w[a] = velocity[3 * i + (size_t)a];
            v->cell[a] = cells_find(&e->cells, a, s->x[a]);
        }
        e->last_hit[i] = -INFINITY;
        e->id[i] = e->place[i] = (uint32_t)i;
        cells_insert(&e->cells, cells_of(&e->cells, v->cell), (uint32_t)i);
    }
    e->placed = true;
    engine_rebuild(e);
    if (refuse_overlap(e, fault) != STATUS_OK)
        return fault->status;
    predict_all(e);
    engine_reset_tally(e);
    return STATUS_OK;
}

/* -- drag and growth ---------------------------------------------------------------- */

enum status engine_set_drag(struct engine *e, double gamma_per_s, struct fault *fault) {
    double t = e->setup.contact_time_s;
    if (!(gamma_per_s >= 0 && isfinite(gamma_per_s)))
        return fault_set(fault, STATUS_BAD_INPUT, "a drag rate of %g/s cannot be", gamma_per_s);
    if (gamma_per_s > 0 && e->growth > 0)
        return fault_set(fault, STATUS_BAD_INPUT, "no drag while diameters grow");
    engine_rebuild(e);
    e->gamma = gamma_per_s;
    e->contact_span = gamma_per_s > 0 ? -expm1(-gamma_per_s * t) / gamma_per_s : t;
    e->rebase_at = gamma_per_s > 0 ? -expm1(-1) / gamma_per_s : INFINITY;
    return STATUS_OK;
}

double engine_diameter(const struct engine *e) {
    return e->diameter + e->growth * (e->now - e->growth_from);
}

enum status engine_set_growth(struct engine *e, double diameter_m, double rate_m_per_s,
                              struct fault *fault) {
    double most = 2 * e->setup.radius_m * (1 + deepest_allowed);
    if (!(diameter_m >= 0 && diameter_m <= most))
        return fault_set(fault, STATUS_BAD_INPUT, "a diameter of %g m is not in [0, %g]",
                         diameter_m, 2 * e->setup.radius_m);
    if (!(rate_m_per_s >= 0 && isfinite(rate_m_per_s)) || (rate_m_per_s > 0 && e->gamma > 0))
        return fault_set(fault, STATUS_BAD_INPUT, "a growth of %g m/s with a drag of %g/s",
                         rate_m_per_s, e->gamma);
    double old_diameter = engine_diameter(e), old_growth = e->growth;
    e->diameter = diameter_m;
    e->growth = rate_m_per_s;
    e->growth_from = e->now;
    if (e->placed && refuse_overlap(e, fault) != STATUS_OK) {
        e->diameter = old_diameter;
        e->growth = old_growth;
        return fault->status;
    }
    if (e->placed)
        predict_all(e);
    return STATUS_OK;
}

/* -- the rebase --------------------------------------------------------------------- */

double engine_bucket_width(const struct engine *e, double seconds) {
    double width = EVENTS_A_BUCKET * seconds / fmax((double)e->count, 1);
    return width > 0 && isfinite(1 / width) ? width : 1;
}

/* A sphere without an event for 30/gamma and more: its time in the clock, which grows by e with
 * each 1/gamma, would overflow in the end.  It is brought to now; it has all but stopped. */
static void catch_up(const struct engine *e, struct sphere *s) {
    static const double LONG_AGO = -1e13; /* (1/gamma) */
    if (!(s->t * e->gamma < LONG_AGO))
        return;
    for (int a = 0; a < 3; a++)
        s->x[a] -= s->w[a] * s->t;
    s->t = 0;
}

/* Make now the origin of the common clock. */
static void rebase(struct engine *e) {
    double S = e->now, slowing = engine_slowing(e, S), per = 1 / slowing;
    e->origin_s = e->gamma > 0 ? e->origin_s - log1p(-e->gamma * S) / e->gamma : e->origin_s + S;
    for (size_t i = 0; i < e->count; i++) {
        struct sphere *s = &e->sphere[i];
        struct event *v = &e->event[i];
        s->t = (s->t - S) * per;
        for (int a = 0; a < 3; a++)
            s->w[a] *= slowing;
        catch_up(e, s);
        v->time = (v->time - S) * per;
        s->pair_time = (s->pair_time - S) * per;
        e->last_hit[i] = (e->last_hit[i] - S) * per;
    }
    e->growth_from -= S; /* there is no drag while diameters grow */
    e->tuned_from = (e->tuned_from - S) * per;
    e->now = 0;
    e->tally.rebases++;
}

/* Put every record where place[old] = new says, in place, cycle by cycle. */
static void sort_spheres(struct engine *e, uint32_t *place) {
    for (uint32_t k = 0; k < e->count; k++)
        if (e->event[k].partner < e->count)
            e->event[k].partner = place[e->event[k].partner];
    for (uint32_t k = 0; k < e->count; k++)
        while (place[k] != k) {
            uint32_t to = place[k], id = e->id[to];
            struct sphere s = e->sphere[to];
            struct event v = e->event[to];
            double hit = e->last_hit[to];
            int32_t image[3];
            memcpy(image, e->image[to], sizeof image);
            e->sphere[to] = e->sphere[k], e->sphere[k] = s;
            e->event[to] = e->event[k], e->event[k] = v;
            e->last_hit[to] = e->last_hit[k], e->last_hit[k] = hit;
            memcpy(e->image[to], e->image[k], sizeof image);
            memcpy(e->image[k], image, sizeof image);
            e->id[to] = e->id[k], e->id[k] = id;
            place[k] = place[to], place[to] = to;
        }
    for (uint32_t k = 0; k < e->count; k++)
        e->place[e->id[k]] = k;
}

void engine_rebuild(struct engine *e) {
    double waited = e->now - e->tuned_from;
    double wait = e->events > 0 ? waited / (double)e->events * (double)e->count : 0;
    double width = wait > 0 ? engine_bucket_width(e, wait) : 1 / e->queue.per_width;
    width /= engine_slowing(e, e->now);
    rebase(e);
    e->real_now_s = e->origin_s;
    if (!e->placed)
        return;
    uint32_t *place = e->queue.heap; /* free until the queue is rebuilt */
    cells_renumber(&e->cells, place);
    sort_spheres(e, place);
    e->queue.per_width = 1 / width;
    queue_rebuild(&e->queue, e->now, width);
    e->events = 0;
    e->tuned_from = e->now;
    e->tally.rebuilds++;
}
