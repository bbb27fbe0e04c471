/* engine.c -- the event loop: see engine.h. */
#include "solver/suspension/engine_state.h"

#include <math.h>
#include <string.h>

enum { STANDSTILL = 100, STANDSTILL_A_SPHERE = 16 };

/* -- search ------------------------------------------------------------------------- */

/* The neighbourhood that is searched: cells at offsets from..to of the sphere's own. */
struct search {
    struct engine *e;
    const struct sphere *s;
    const uint16_t *cell;
    int from[3], to[3];
    bool shifted; /* some of the cells are seen across a boundary */
    double time;  /* (s, common clock) the earliest contact found so far */
    uint32_t partner;
};

/* Take the earliest of the candidates, unless that partner has a collision before. */
static inline __attribute__((always_inline)) void judge(struct search *f, bool shifted) {
    struct engine *e = f->e;
    struct candidates *k = &e->near;
    struct contact contact = {.now = e->now, .diameter = e->diameter, .growth = e->growth};
    if (__builtin_expect(e->growth > 0, 0)) {
        contact.diameter += e->growth * (e->now - e->growth_from);
        predict_candidates(f->s, e->sphere, &contact, shifted, true, e->shift, k);
    } else {
        predict_candidates(f->s, e->sphere, &contact, shifted, false, e->shift, k);
    }
    for (uint32_t n = 0; n < k->hits; n++) {
        double time = e->now + k->tau[n];
        uint32_t j = k->hit[n];
        if (time < f->time || (time == f->time && j < f->partner))
            if (e->sphere[j].pair_time > time) {
                f->time = time;
                f->partner = j;
            }
    }
}

static __attribute__((noinline)) void judge_plain(struct search *f) {
    judge(f, false);
}

static __attribute__((noinline)) void judge_shifted(struct search *f) {
    judge(f, true);
}

static const uint8_t labels_of[16] = {[0] = 4, [8] = 3, [12] = 2, [14] = 1, [15] = 0};

/* The blocks behind a cell's first, and an early judgement if the room is used up. */
static __attribute__((noinline)) void take_more(struct search *f, const uint32_t *label,
                                                uint32_t code) {
    const struct cells *c = &f->e->cells;
    struct candidates *k = &f->e->near;
    while ((label[3] & CELLS_LINK) != 0 && label[3] != CELLS_EMPTY) {
        if (k->count + 2 * CELL_LABELS > PREDICT_MOST) {
            f->shifted ? judge_shifted(f) : judge_plain(f);
        }
        label = c->label + CELL_LABELS * (size_t)(label[3] & ~CELLS_LINK);
        memcpy(k->shift + k->count, &code, sizeof code);
        k->count += labels_of[lanes_copy4(k->label + k->count, label)];
    }
}

/* Copy the labels of one cell behind the candidates found so far. */
static inline __attribute__((always_inline)) void take_cell(struct search *f, uint32_t cell,
                                                            bool shifted, uint32_t code) {
    struct candidates *k = &f->e->near;
    const uint32_t *label = f->e->cells.label + CELL_LABELS * (size_t)cell;
    unsigned bits = lanes_copy4(k->label + k->count, label);
    if (shifted)
        memcpy(k->shift + k->count, &code, sizeof code);
    k->count += labels_of[bits];
    if (__builtin_expect(bits == 8 && label[3] != CELLS_EMPTY, 0))
        take_more(f, label, code);
}

/* All cells inside the grid, none across a boundary. */
static inline __attribute__((always_inline)) void search_inside(struct search *f) {
    const struct cells *c = &f->e->cells;
    uint32_t own = cells_of(c, f->cell);
    f->shifted = false;
    for (int z = f->from[2]; z <= f->to[2]; z++)
        for (int y = f->from[1]; y <= f->to[1]; y++) {
            uint32_t row = own + (uint32_t)(z * (int)c->n[1] + y) * c->n[0];
            if (f->e->near.count > PREDICT_MOST - 4 * CELL_LABELS)
                judge_plain(f);
            for (int x = f->from[0]; x <= f->to[0]; x++)
                take_cell(f, row + (uint32_t)x, false, 0);
        }
    judge_plain(f);
}

struct line { /* cells along one axis, and through which boundary they are seen */
    int count;
    uint32_t cell[3], side[3];
};

static struct line line_of(const struct search *f, int axis) {
    const struct cells *c = &f->e->cells;
    struct line l = {.count = 0};
    for (int d = f->from[axis]; d <= f->to[axis]; d++) {
        int k = f->cell[axis] + d, n = (int)c->n[axis], side = k < 0 ? 0 : k < n ? 1 : 2;
        if (side != 1 && !c->periodic[axis])
            continue;
        l.cell[l.count] = (uint32_t)(side == 0 ? k + n : side == 2 ? k - n : k);
        l.side[l.count++] = (uint32_t)side;
    }
    return l;
}

/* The same at a side of the box. */
static __attribute__((noinline)) void search_boundary(struct search *f) {
    const struct cells *c = &f->e->cells;
    struct line x = line_of(f, 0), y = line_of(f, 1), z = line_of(f, 2);
    f->shifted = true;
    for (int n = 0; n < z.count; n++)
        for (int m = 0; m < y.count; m++) {
            if (f->e->near.count > PREDICT_MOST - 4 * CELL_LABELS)
                judge_shifted(f);
            for (int l = 0; l < x.count; l++)
                take_cell(f, cells_index(c, x.cell[l], y.cell[m], z.cell[n]), true,
                          0x01010101u * (x.side[l] + 3 * y.side[m] + 9 * z.side[n]));
        }
    judge_shifted(f);
}

static inline bool is_inside(const struct cells *c, const uint16_t cell[3]) {
    return cell[0] - 1u < c->n[0] - 2u && cell[1] - 1u < c->n[1] - 2u &&
           cell[2] - 1u < c->n[2] - 2u && c->n[0] > 2 && c->n[1] > 2 && c->n[2] > 2;
}

/* -- prediction --------------------------------------------------------------------- */

/* The earlier of the pair event and the way out of the cell; into the queue. */
static inline void schedule(struct engine *e, uint32_t i) {
    int axis;
    struct event *v = &e->event[i];
    const struct sphere *s = &e->sphere[i];
    double leave = s->t + cells_exit(&e->cells, s, v->cell, &axis);
    v->time = s->pair_time <= leave ? s->pair_time : leave;
    queue_move(&e->queue, i);
}

/* The earliest collision of sphere i, whose local time is now, with any other. */
static void find_pair(struct engine *e, uint32_t i) {
    struct search f = {.e = e,
                       .s = &e->sphere[i],
                       .cell = e->event[i].cell,
                       .from = {-1, -1, -1},
                       .to = {1, 1, 1},
                       .time = INFINITY,
                       .partner = QUEUE_NONE};
    if (is_inside(&e->cells, f.cell))
        search_inside(&f);
    else
        search_boundary(&f);
    struct event *v = &e->event[i];
    e->sphere[i].pair_time = f.time;
    v->partner = f.partner;
    if (f.partner != QUEUE_NONE)
        v->partner_count = e->event[f.partner].count;
}

void engine_predict(struct engine *e, uint32_t i) {
    find_pair(e, i);
    schedule(e, i);
}

/* The same after a passage: only the nine cells that came into reach. */
static void predict_ahead(struct engine *e, uint32_t i, int axis, int step) {
    struct event *v = &e->event[i];
    struct search f = {.e = e,
                       .s = &e->sphere[i],
                       .cell = e->event[i].cell,
                       .from = {-1, -1, -1},
                       .to = {1, 1, 1},
                       .time = e->sphere[i].pair_time,
                       .partner = v->partner};
    f.from[axis] = f.to[axis] = step;
    if (is_inside(&e->cells, f.cell))
        search_inside(&f);
    else
        search_boundary(&f);
    /* The same partner counts as well: it may have changed since it was foreseen. */
    if (f.time < e->sphere[i].pair_time || f.partner != v->partner) {
        e->sphere[i].pair_time = f.time;
        v->partner = f.partner;
        v->partner_count = e->event[f.partner].count;
    }
    schedule(e, i);
}

/* -- walls and cells ---------------------------------------------------------------- */

static void reflect(struct engine *e, uint32_t i, int axis, bool up) {
    struct sphere *s = &e->sphere[i];
    double impulse = 2 * e->setup.mass_kg * fabs(s->w[axis]) * engine_slowing(e, e->now);
    e->tally.wall_collisions++;
    e->tally.wall_impulse[2 * axis + up] += impulse;
    e->tally.wall_virial_J += impulse * (0.5 * e->setup.box_m[axis] - e->setup.radius_m);
    s->w[axis] = up ? -fabs(s->w[axis]) : fabs(s->w[axis]);
    e->event[i].count++;
    engine_predict(e, i);
}

/* Sphere i reaches a face of its cell: a wall, or the next cell. */
static void leave_cell(struct engine *e, uint32_t i) {
    struct sphere *s = &e->sphere[i];
    struct cells *c = &e->cells;
    int axis;
    uint16_t *cell = e->event[i].cell;
    (void)cells_exit(c, s, cell, &axis);
    bool up = s->w[axis] > 0, last = up ? cell[axis] + 1u == c->n[axis] : cell[axis] == 0;
    sphere_advance(s, e->now);
    if (last && !c->periodic[axis]) {
        reflect(e, i, axis, up);
        return;
    }
    e->tally.cell_crossings++;
    cells_remove(c, cells_of(c, cell), i);
    if (last) {
        s->x[axis] += up ? -c->side[axis] : c->side[axis];
        e->image[i][axis] += up ? 1 : -1;
        cell[axis] = (uint16_t)(up ? 0 : c->n[axis] - 1);
    } else {
        cell[axis] = (uint16_t)(cell[axis] + (up ? 1 : -1));
    }
    cells_insert(c, cells_of(c, cell), i);
    predict_ahead(e, i, axis, up ? 1 : -1);
}

/* -- collisions --------------------------------------------------------------------- */

/* From i to j by the nearest images: in contact they are unambiguous. */
static inline void separation(const struct engine *e, uint32_t i, uint32_t j, double r[3]) {
    for (int a = 0; a < 3; a++) {
        double side = e->cells.side[a];
        r[a] = e->sphere[j].x[a] - e->sphere[i].x[a];
        if (e->cells.periodic[a])
            r[a] += r[a] > 0.5 * side ? -side : r[a] < -0.5 * side ? side : 0;
    }
}

/* Did i or j collide less than a contact time ago?  t2 - t1 < t_c in real time is
 * s2 - s1 < (1 - gamma s1) (1 - exp(-gamma t_c))/gamma in the common clock. */
static inline bool is_in_contact(const struct engine *e, uint32_t i, uint32_t j) {
    double last = fmax(e->last_hit[i], e->last_hit[j]);
    return e->now - last < e->contact_span * engine_slowing(e, last);
}

/* What the guard makes of the restitution at this normal speed (m/s, true). */
static inline double restitution_of(struct engine *e, uint32_t i, uint32_t j, double speed) {
    bool elastic = false;
    if (e->growth > 0)
        return 1;
    if (e->setup.guard == GUARD_CONTACT_TIME)
        elastic = is_in_contact(e, i, j);
    else if (e->setup.guard == GUARD_CUTOFF_SPEED)
        elastic = speed < e->setup.cutoff_speed_m_s;
    e->tally.elastic += elastic;
    return elastic ? 1 : e->setup.restitution;
}

/* Collide spheres at local time now; false if by round-off they do not approach. */
static bool collide(struct engine *e, uint32_t i, uint32_t j) {
    struct sphere *p = &e->sphere[i], *q = &e->sphere[j];
    double r[3], slowing = engine_slowing(e, e->now);
    separation(e, i, j, r);
    double rr = r[0] * r[0] + r[1] * r[1] + r[2] * r[2], distance = sqrt(rr);
    double normal =
        (r[0] * (q->w[0] - p->w[0]) + r[1] * (q->w[1] - p->w[1]) + r[2] * (q->w[2] - p->w[2])) /
        distance;
    if (!(normal < e->growth))
        return false;
    double back = restitution_of(e, i, j, -normal * slowing);
    double change = 0.5 * (1 + back) * (normal - e->growth); /* of either sphere's speed */
    double true_change = change * slowing, per = change / distance;
    for (int a = 0; a < 3; a++) {
        p->w[a] += per * r[a];
        q->w[a] -= per * r[a];
    }
    e->tally.collisions++;
    e->tally.virial_J -= e->setup.mass_kg * true_change * distance;
    /* m/4 (v^2 - v'^2) with v' = v - 2 change */
    e->tally.dissipated_J += e->setup.mass_kg * true_change * (normal * slowing - true_change);
    e->last_hit[i] = e->last_hit[j] = e->now;
    e->event[i].count++;
    e->event[j].count++;
    return true;
}

/* The pair event of sphere i is due. */
static void meet(struct engine *e, uint32_t i) {
    struct event *v = &e->event[i];
    uint32_t j = v->partner;
    sphere_advance(&e->sphere[i], e->now);
    if (e->event[j].count != v->partner_count) {
        e->tally.stale++;
        engine_predict(e, i);
        return;
    }
    sphere_advance(&e->sphere[j], e->now);
    if (!collide(e, i, j))
        e->tally.stale++;
    e->sphere[i].pair_time = e->sphere[j].pair_time = INFINITY;
    engine_predict(e, i);
    engine_predict(e, j);
}

/* -- memory of what is to come -------------------------------------------------------- */

/* Large systems do not fit in the cache: what an event will read is asked for some
 * buckets of events before it is due, step by step, as each shows where the next is:
 * the sphere; its partner and its cells; the partner's cells and its neighbours; the
 * partner's neighbours.  Hints to the processor only: no result depends on them.
 * always_inline is needed: gcc takes a function that does nothing but prefetch for one
 * without effect, and leaves its calls out. */
#define ALWAYS_INLINE __attribute__((always_inline))
enum { AHEAD_FROM = 30000, AHEAD_RECORDS = 4, AHEAD_CELLS = 3, AHEAD_SPHERES = 2, AHEAD_LAST = 1 };

static inline ALWAYS_INLINE void ask_for_cells(const struct engine *e, const uint16_t cell[3]) {
    const struct cells *c = &e->cells;
    if (!is_inside(c, cell))
        return;
    for (int z = -1; z <= 1; z++)
        for (int y = -1; y <= 1; y++) {
            uint32_t row = cells_of(c, cell) + (uint32_t)(z * (int)c->n[1] + y) * c->n[0];
            __builtin_prefetch(c->label + CELL_LABELS * (size_t)row - CELL_LABELS);
            __builtin_prefetch(c->label + CELL_LABELS * (size_t)row + 2 * CELL_LABELS - 1);
        }
}

static inline ALWAYS_INLINE void ask_for_spheres(const struct engine *e, const uint16_t cell[3]) {
    const struct cells *c = &e->cells;
    if (!is_inside(c, cell))
        return;
    for (int z = -1; z <= 1; z++)
        for (int y = -1; y <= 1; y++) {
            uint32_t row = cells_of(c, cell) + (uint32_t)(z * (int)c->n[1] + y) * c->n[0];
            const uint32_t *label = c->label + CELL_LABELS * (size_t)row - CELL_LABELS;
            for (int k = 0; k < 3 * CELL_LABELS; k += CELL_LABELS) {
                if (label[k] < e->count)
                    __builtin_prefetch(&e->sphere[label[k]]);
                if (label[k + 1] < e->count)
                    __builtin_prefetch(&e->sphere[label[k + 1]]);
            }
        }
}

static inline ALWAYS_INLINE void ask_for_records(const struct engine *e, uint32_t i) {
    __builtin_prefetch(&e->sphere[i]);
    __builtin_prefetch(&e->event[i]);
}

/* The event of i is `buckets` ahead, if it is due there and not only parked. */
static inline ALWAYS_INLINE void ask_for(const struct engine *e, uint32_t i, int buckets) {
    const struct queue *q = &e->queue;
    const struct event *v = &e->event[i];
    if ((v->time - q->origin) * q->per_width >= (double)(q->present + buckets + 1))
        return;
    uint32_t j = e->sphere[i].pair_time <= v->time ? v->partner : QUEUE_NONE;
    if (buckets == AHEAD_CELLS) {
        ask_for_cells(e, v->cell);
        if (j != QUEUE_NONE)
            ask_for_records(e, j);
    } else if (buckets == AHEAD_SPHERES) {
        ask_for_spheres(e, v->cell);
        if (j != QUEUE_NONE)
            ask_for_cells(e, e->event[j].cell);
    } else if (j != QUEUE_NONE) {
        ask_for_spheres(e, e->event[j].cell);
    }
}

static __attribute__((noinline)) void look_ahead(struct engine *e) {
    const struct queue *q = &e->queue;
    const uint32_t *records = queue_ahead(q, AHEAD_RECORDS);
    __builtin_prefetch(queue_ahead(q, AHEAD_RECORDS + 2));
    e->looked_at = q->present;
    for (int k = 0; k < QUEUE_SLOTS; k++)
        if (records[k] != QUEUE_NONE)
            ask_for_records(e, records[k]);
    for (int buckets = AHEAD_CELLS; buckets >= AHEAD_LAST; buckets--) {
        const uint32_t *due = queue_ahead(q, buckets);
        for (int k = 0; k < QUEUE_SLOTS; k++)
            if (due[k] != QUEUE_NONE)
                ask_for(e, due[k], buckets);
    }
}

/* -- the loop ----------------------------------------------------------------------- */

static enum status check_headway(struct engine *e, double time, uint32_t i, struct fault *fault) {
    double limit = STANDSTILL + STANDSTILL_A_SPHERE * (double)e->count;
    e->standstill = time > e->now ? 0 : e->standstill + 1;
    if (__builtin_expect((double)e->standstill > limit, 0))
        return fault_set(fault, STATUS_NUMERICAL,
                         "at %.9g s sphere %u and %lld events before it make no headway: "
                         "an inelastic collapse needs a guard",
                         engine_time(e), e->id[i], e->standstill);
    return STATUS_OK;
}

/* All events up to a time of the common clock (s) that no rebase may come before. */
static enum status run_events(struct engine *e, double until, struct fault *fault) {
    uint32_t i;
    while ((i = queue_first(&e->queue, until)) != QUEUE_NONE) {
        if (e->count >= AHEAD_FROM && e->queue.present != e->looked_at)
            look_ahead(e);
        struct event *v = &e->event[i];
        if (check_headway(e, v->time, i, fault) != STATUS_OK)
            return fault->status;
        e->now = v->time > e->now ? v->time : e->now;
        if (e->sphere[i].pair_time <= v->time)
            meet(e, i);
        else
            leave_cell(e, i);
        if (++e->events >= e->rebuild_events)
            break;
    }
    return STATUS_OK;
}

/* The common clock at a real time. */
static double clock_of(const struct engine *e, double time_s) {
    double t = time_s - e->origin_s;
    return e->gamma > 0 ? -expm1(-e->gamma * t) / e->gamma : t;
}

double engine_time(const struct engine *e) {
    return e->real_now_s;
}

enum status engine_advance(struct engine *e, double time_s, struct fault *fault) {
    while (e->real_now_s < time_s) {
        double target = clock_of(e, time_s), until = fmin(target, e->rebase_at);
        if (!isfinite(time_s) || e->broken != QUEUE_NONE)
            return fault_set(fault, STATUS_NUMERICAL,
                             "at %.9g s: the end (%g s) or the velocity of sphere %u is not finite",
                             e->real_now_s, time_s, e->broken);
        if (run_events(e, until, fault) != STATUS_OK)
            return fault->status;
        if (e->events >= e->rebuild_events) {
            engine_rebuild(e);
            e->real_now_s = fmin(e->real_now_s, time_s);
            continue;
        }
        e->now = fmax(e->now, until);
        if (until < target)
            engine_rebuild(e);
        else
            e->real_now_s = time_s;
    }
    return STATUS_OK;
}

void engine_kick(struct engine *e, size_t i, const double dv[3]) {
    uint32_t k = e->place[i];
    struct sphere *s = &e->sphere[k];
    double per = 1 / engine_slowing(e, e->now);
    sphere_advance(s, e->now);
    for (int a = 0; a < 3; a++)
        s->w[a] += dv[a] * per;
    if (!isfinite(s->w[0] + s->w[1] + s->w[2]))
        e->broken = (uint32_t)i;
    e->event[k].count++;
    e->tally.kicks++;
    engine_predict(e, k);
}
