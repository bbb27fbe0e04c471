/* bubbles.c -- see bubbles.h. */
#include "validation/bubbles.h"

#include "validation/bed_profile.h"
#include "validation/closures.h"

#include <gsl/gsl_fit.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_BUBBLES = 1024 };        /* in one frame: bounds the table of overlaps */
static const double LINK = 0.3;     /* share of the smaller area that links two regions */
static const double RISE_GUESS = 1; /* of a new bubble (U0) */
static const double MEMORY = 0.5;   /* share of the old velocity in the running mean */

/* What a site belongs to: a bubble of its frame, counted from 0, or */
enum { OF_BUBBLE = 0, OF_NOTHING = -1, OF_FREEBOARD = -2, OF_LAYER = -3 };

/* An array that grows. */
struct pile {
    void *data;
    size_t count, room, size;
};

struct bubbles {
    struct bubble_rule rule;
    size_t nx, ny;
    struct components found;
    long *region;               /* [0 .. found.count-1]: what a region is, as in owner */
    long *owner, *owner_before; /* [0 .. nx*ny-1] */
    size_t now, before;         /* bubbles in the latest frame and in the one before */
    double *overlap;            /* [before][now + 2] (l^2): with bubbles, freeboard, layer */
    double *origin;             /* [now][2] (l^2): where freeboard and layer were */
    size_t *best_now;           /* [before]: the new bubble that shares most; BUBBLE_NONE */
    size_t *best_before;        /* [now]: the earlier one */
    struct pile frames, points, tracks, events;
};

static void *pile_add(struct pile *p, struct fault *fault) {
    if (p->count == p->room) {
        size_t room = p->room ? 2 * p->room : 64;
        void *data = realloc(p->data, room * p->size);
        if (!data) {
            fault_set(fault, STATUS_NO_MEMORY, "no memory for %zu records of bubbles", room);
            return NULL;
        }
        p->data = data;
        p->room = room;
    }
    void *entry = (char *)p->data + p->size * p->count++;
    memset(entry, 0, p->size);
    return entry;
}

static struct bubble_frame *frame_at(const struct bubbles *b, size_t i) {
    return (struct bubble_frame *)b->frames.data + i;
}

static struct bubble_point *point_at(const struct bubbles *b, size_t i) {
    return (struct bubble_point *)b->points.data + i;
}

static struct bubble_track *track_at(const struct bubbles *b, size_t i) {
    return (struct bubble_track *)b->tracks.data + i;
}

/* Bubble n of the latest frame (age 0) or of the one before it (age 1). */
static struct bubble_point *bubble_at(const struct bubbles *b, size_t age, size_t n) {
    return point_at(b, frame_at(b, b->frames.count - 1 - age)->first + n);
}

enum status bubbles_create(const struct bubble_rule *rule, size_t nx, size_t ny,
                           struct bubbles **out, struct fault *fault) {
    struct bubbles *b = calloc(1, sizeof *b);
    *out = NULL;
    if (!b)
        return fault_set(fault, STATUS_NO_MEMORY, "no memory for bubbles");
    b->rule = *rule;
    b->nx = nx;
    b->ny = ny;
    b->frames.size = sizeof(struct bubble_frame);
    b->points.size = sizeof(struct bubble_point);
    b->tracks.size = sizeof(struct bubble_track);
    b->events.size = sizeof(struct bubble_event);
    enum status status = components_create(&b->found, nx, ny, fault);
    if (status)
        goto failed;
    b->region = calloc(nx * ny, sizeof *b->region);
    b->owner = calloc(nx * ny, sizeof *b->owner);
    b->owner_before = calloc(nx * ny, sizeof *b->owner_before);
    b->overlap = calloc((size_t)MAX_BUBBLES * (MAX_BUBBLES + 2), sizeof *b->overlap);
    b->origin = calloc((size_t)MAX_BUBBLES * 2, sizeof *b->origin);
    b->best_now = calloc(MAX_BUBBLES, sizeof *b->best_now);
    b->best_before = calloc(MAX_BUBBLES, sizeof *b->best_before);
    if (b->region && b->owner && b->owner_before && b->overlap && b->origin && b->best_now &&
        b->best_before) {
        for (size_t k = 0; k < nx * ny; k++) /* what the first frame finds before it */
            b->owner[k] = OF_NOTHING;
        *out = b;
        return STATUS_OK;
    }
    status = fault_set(fault, STATUS_NO_MEMORY, "no memory for bubbles on %zu x %zu sites", nx, ny);
failed:
    bubbles_free(b);
    return status;
}

void bubbles_free(struct bubbles *b) {
    if (!b)
        return;
    components_free(&b->found);
    free(b->region);
    free(b->owner);
    free(b->owner_before);
    free(b->overlap);
    free(b->origin);
    free(b->best_now);
    free(b->best_before);
    free(b->frames.data);
    free(b->points.data);
    free(b->tracks.data);
    free(b->events.data);
    free(b);
}

struct bubble_history bubbles_history(const struct bubbles *b) {
    return (struct bubble_history){.frames = b->frames.count,
                                   .points = b->points.count,
                                   .tracks = b->tracks.count,
                                   .events = b->events.count,
                                   .frame = b->frames.data,
                                   .point = b->points.data,
                                   .track = b->tracks.data,
                                   .event = b->events.data};
}

/* -- one frame ---------------------------------------------------------------- */

/* How much of the width a region reaches over (1). */
static double span_of(const struct bubbles *b, const struct component *r) {
    return (r->right_l - r->left_l) / (double)(b->nx - 1);
}

static long class_of(const struct bubbles *b, const struct component *r, double top_l) {
    if ((r->walls & COMPONENT_TOP) || r->y_l > top_l)
        return OF_FREEBOARD;
    if (span_of(b, r) >= b->rule.layer_span)
        return OF_LAYER;
    return r->area_l2 < b->rule.area_min_l2 / 2 ? OF_NOTHING : OF_BUBBLE;
}

/* Append region r to the latest frame's bubbles; no track is known yet. */
static enum status add_point(struct bubbles *b, const struct component *r, struct fault *fault) {
    struct bubble_frame *f = frame_at(b, b->frames.count - 1);
    if (f->points == MAX_BUBBLES)
        return fault_set(fault, STATUS_BAD_INPUT, "more than %d bubbles at %g tau",
                         (int)MAX_BUBBLES, f->time_tau);
    struct bubble_point *p = pile_add(&b->points, fault);
    if (!p)
        return STATUS_NO_MEMORY;
    *p = (struct bubble_point){.frame = b->frames.count - 1,
                               .track = BUBBLE_NONE,
                               .next = BUBBLE_NONE,
                               .fresh = true,
                               .velocity_y = RISE_GUESS,
                               .shape = *r};
    f->points++;
    return STATUS_OK;
}

/* Append a frame, its bubbles, and what each of its sites belongs to. */
static enum status read_frame(struct bubbles *b, double time_tau, const double *rho,
                              struct fault *fault) {
    enum status status = STATUS_OK;
    double top_l = bed_profile_top(rho, b->nx, b->ny);
    if (isnan(top_l))
        return fault_set(fault, STATUS_BAD_INPUT, "no bed at %g tau", time_tau);
    struct bubble_frame *f = pile_add(&b->frames, fault);
    if (!f)
        return STATUS_NO_MEMORY;
    *f = (struct bubble_frame){.time_tau = time_tau, .top_l = top_l, .first = b->points.count};
    components_find(&b->found, rho, b->rule.threshold);
    for (size_t n = 0; n < b->found.count && !status; n++) {
        const struct component *r = &b->found.list[n];
        b->region[n] = class_of(b, r, top_l);
        if (b->region[n] == OF_LAYER)
            f->layer_span = fmax(f->layer_span, span_of(b, r));
        if (b->region[n] != OF_BUBBLE)
            continue;
        b->region[n] = (long)f->points;
        status = add_point(b, r, fault);
    }
    for (size_t k = 0; k < b->nx * b->ny; k++)
        b->owner[k] = b->found.label[k] < 0 ? OF_NOTHING : b->region[b->found.label[k]];
    b->before = b->now;
    b->now = f->points;
    return status;
}

/* -- from frame to frame ------------------------------------------------------- */

static double *overlap_of(struct bubbles *b, size_t p, size_t c) {
    return b->overlap + p * (b->now + 2) + c;
}

/* Column of the table of overlaps for the owner of a site; BUBBLE_NONE for nothing. */
static size_t column_of(const struct bubbles *b, long owner) {
    switch (owner) {
    case OF_NOTHING:
        return BUBBLE_NONE;
    case OF_FREEBOARD:
        return b->now;
    case OF_LAYER:
        return b->now + 1;
    default:
        return (size_t)owner;
    }
}

/* Lay one site of an earlier bubble, moved, over the new frame. */
static void lay(struct bubbles *b, size_t p, size_t i, size_t j, double dt_tau) {
    const struct bubble_point *from = bubble_at(b, 1, p);
    double x = fmin(fmax((double)i + from->velocity_x * dt_tau, 0), (double)b->nx - 1);
    double y = fmin(fmax((double)j + from->velocity_y * dt_tau, 0), (double)b->ny - 1);
    double area = closure_site_volume(i, j, b->nx, b->ny);
    struct closure_halo h = closure_halo_at(x, y, b->nx, b->ny);
    for (size_t k = 0; k < 4; k++) {
        size_t column = column_of(b, b->owner[h.site[k]]);
        if (column != BUBBLE_NONE)
            *overlap_of(b, p, column) += area * h.weight[k];
    }
}

/* Areas shared by the bubbles of the two frames. */
static void find_overlaps(struct bubbles *b, double dt_tau) {
    memset(b->overlap, 0, b->before * (b->now + 2) * sizeof *b->overlap);
    memset(b->origin, 0, b->now * 2 * sizeof *b->origin);
    for (size_t j = 0; j < b->ny; j++)
        for (size_t i = 0; i < b->nx; i++) {
            long was = b->owner_before[j * b->nx + i], is = b->owner[j * b->nx + i];
            if (was >= 0)
                lay(b, (size_t)was, i, j, dt_tau);
            if (is >= 0 && (was == OF_FREEBOARD || was == OF_LAYER))
                b->origin[2 * (size_t)is + (was == OF_LAYER)] +=
                    closure_site_volume(i, j, b->nx, b->ny);
        }
}

static bool is_linked(struct bubbles *b, size_t p, size_t c) {
    double smaller = fmin(bubble_at(b, 1, p)->shape.area_l2, bubble_at(b, 0, c)->shape.area_l2);
    return *overlap_of(b, p, c) >= LINK * smaller;
}

static void find_best(struct bubbles *b) {
    for (size_t p = 0; p < b->before; p++)
        b->best_now[p] = BUBBLE_NONE;
    for (size_t c = 0; c < b->now; c++)
        b->best_before[c] = BUBBLE_NONE;
    for (size_t p = 0; p < b->before; p++)
        for (size_t c = 0; c < b->now; c++) {
            double shared = *overlap_of(b, p, c);
            if (!is_linked(b, p, c))
                continue;
            if (b->best_now[p] == BUBBLE_NONE || shared > *overlap_of(b, p, b->best_now[p]))
                b->best_now[p] = c;
            if (b->best_before[c] == BUBBLE_NONE || shared > *overlap_of(b, b->best_before[c], c))
                b->best_before[c] = p;
        }
}

static bool goes_on(const struct bubbles *b, size_t p) {
    return b->best_now[p] != BUBBLE_NONE && b->best_before[b->best_now[p]] == p;
}

/* Count a point to its track. */
static void extend(struct bubbles *b, size_t c, size_t track) {
    struct bubble_point *to = bubble_at(b, 0, c);
    struct bubble_track *t = track_at(b, track);
    to->track = track;
    t->points++;
    t->large += to->shape.area_l2 >= b->rule.area_min_l2;
}

static enum status begin(struct bubbles *b, size_t c, enum bubble_event_kind origin,
                         struct fault *fault) {
    struct bubble_track *t = pile_add(&b->tracks, fault);
    if (!t)
        return STATUS_NO_MEMORY;
    *t = (struct bubble_track){.first = frame_at(b, b->frames.count - 1)->first + c,
                               .initial = b->frames.count == 1,
                               .origin = origin};
    extend(b, c, b->tracks.count - 1);
    return STATUS_OK;
}

static enum status note(struct bubbles *b, enum bubble_event_kind kind,
                        const struct bubble_point *own, size_t other, double other_l2,
                        struct fault *fault) {
    struct bubble_event *e = pile_add(&b->events, fault);
    if (!e)
        return STATUS_NO_MEMORY;
    *e = (struct bubble_event){.kind = kind,
                               .time_tau = frame_at(b, b->frames.count - 1)->time_tau,
                               .track = own->track,
                               .other = other,
                               .area_l2 = own->shape.area_l2,
                               .other_l2 = other_l2};
    return STATUS_OK;
}

/* Bubbles that go on: the velocity is blended with the step just made. */
static void continue_tracks(struct bubbles *b, double dt_tau) {
    for (size_t p = 0; p < b->before; p++) {
        if (!goes_on(b, p))
            continue;
        struct bubble_point *from = bubble_at(b, 1, p), *to = bubble_at(b, 0, b->best_now[p]);
        double step_x = (to->shape.x_l - from->shape.x_l) / dt_tau;
        double step_y = (to->shape.y_l - from->shape.y_l) / dt_tau;
        from->next = frame_at(b, b->frames.count - 1)->first + b->best_now[p];
        to->fresh = false;
        to->velocity_x = MEMORY * from->velocity_x + (1 - MEMORY) * step_x;
        to->velocity_y = MEMORY * from->velocity_y + (1 - MEMORY) * step_y;
        extend(b, b->best_now[p], from->track);
    }
}

/* The bubble's centroid has jumped: its motion begins anew, its velocity stays what it was. */
static void interrupt(struct bubble_point *to, const struct bubble_point *from) {
    to->fresh = true;
    to->velocity_x = from->velocity_x;
    to->velocity_y = from->velocity_y;
}

/* Where a new bubble comes from that no earlier one goes on as. */
static enum bubble_event_kind origin_of(const struct bubbles *b, size_t c) {
    double least = LINK * bubble_at(b, 0, c)->shape.area_l2;
    if (b->best_before[c] != BUBBLE_NONE)
        return BUBBLE_SPLIT;
    if (b->origin[2 * c + 1] >= least)
        return BUBBLE_SHED;
    return b->origin[2 * c] >= least ? BUBBLE_ENCLOSE : BUBBLE_BIRTH;
}

static enum status begin_tracks(struct bubbles *b, struct fault *fault) {
    enum status status = STATUS_OK;
    for (size_t c = 0; c < b->now && !status; c++) {
        struct bubble_point *own = bubble_at(b, 0, c), *rest = NULL;
        if (own->track != BUBBLE_NONE)
            continue;
        enum bubble_event_kind kind = origin_of(b, c);
        if (kind == BUBBLE_SPLIT) {
            size_t p = b->best_before[c];
            const struct bubble_point *from = rest = bubble_at(b, 1, p);
            interrupt(own, from);
            if (goes_on(b, p)) {
                rest = bubble_at(b, 0, b->best_now[p]);
                interrupt(rest, from);
            }
        }
        status = begin(b, c, kind, fault);
        if (!status && b->frames.count > 1)
            status = note(b, kind, own, rest ? rest->track : BUBBLE_NONE,
                          rest ? rest->shape.area_l2 : 0, fault);
    }
    return status;
}

/* Earlier bubbles that do not go on.  All new ones have their tracks. */
static enum status end_tracks(struct bubbles *b, struct fault *fault) {
    enum status status = STATUS_OK;
    for (size_t p = 0; p < b->before && !status; p++) {
        const struct bubble_point *own = bubble_at(b, 1, p);
        double freeboard = *overlap_of(b, p, b->now), layer = *overlap_of(b, p, b->now + 1);
        size_t c = b->best_now[p];
        if (goes_on(b, p))
            continue;
        if (c != BUBBLE_NONE) {
            const struct bubble_point *main = bubble_at(b, 1, b->best_before[c]);
            struct bubble_point *into = bubble_at(b, 0, c);
            interrupt(into, main);
            status = note(b, BUBBLE_MERGE, own, into->track, main->shape.area_l2, fault);
        } else if (fmax(freeboard, layer) >= LINK * own->shape.area_l2)
            status = note(b, freeboard >= layer ? BUBBLE_BURST : BUBBLE_ENGULF, own, BUBBLE_NONE, 0,
                          fault);
        else
            status = note(b, BUBBLE_VANISH, own, BUBBLE_NONE, 0, fault);
    }
    return status;
}

enum status bubbles_add(struct bubbles *b, double time_tau, const double *solid_fraction,
                        struct fault *fault) {
    size_t frames = b->frames.count;
    double dt_tau = frames ? time_tau - frame_at(b, frames - 1)->time_tau : 1;
    if (!(dt_tau > 0))
        return fault_set(fault, STATUS_BAD_INPUT, "a frame at %g tau follows one at %g tau",
                         time_tau, frame_at(b, frames - 1)->time_tau);
    long *swap = b->owner;
    b->owner = b->owner_before;
    b->owner_before = swap;
    enum status status = read_frame(b, time_tau, solid_fraction, fault);
    if (status)
        return status;
    find_overlaps(b, dt_tau); /* of the first frame: with no bubble at all */
    find_best(b);
    continue_tracks(b, dt_tau);
    status = begin_tracks(b, fault);
    return status ? status : end_tracks(b, fault);
}

/* Does the later event undo the earlier one? */
static bool undoes(const struct bubble_event *late, const struct bubble_event *early) {
    if (early->kind == BUBBLE_MERGE)
        return late->kind == BUBBLE_SPLIT && late->other == early->other &&
               late->area_l2 >= early->area_l2 / 2;
    return early->kind == BUBBLE_SPLIT && late->kind == BUBBLE_MERGE &&
           ((late->track == early->track && late->other == early->other) ||
            (late->track == early->other && late->other == early->track));
}

void bubbles_mark_brief(struct bubbles *b, double within_tau) {
    struct bubble_event *e = b->events.data;
    for (size_t i = 0; i < b->events.count; i++)
        e[i].brief = false;
    for (size_t i = 0; i < b->events.count; i++)
        for (size_t j = i + 1;
             !e[i].brief && j < b->events.count && e[j].time_tau <= e[i].time_tau + within_tau; j++)
            if (!e[j].brief && undoes(&e[j], &e[i]))
                e[i].brief = e[j].brief = true;
}

/* -- motion ---------------------------------------------------------------------- */

/* Scratch of one stretch: time[] and height[] of its points. */
struct run {
    double *time, *height;
    size_t points, at_wall;
    double area;
};

static struct bubble_stretch conclude(const struct run *r, size_t track) {
    double start, speed, variance, covariance, slope_variance, squares;
    gsl_fit_linear(r->time, 1, r->height, 1, r->points, &start, &speed, &variance, &covariance,
                   &slope_variance, &squares);
    return (struct bubble_stretch){.track = track,
                                   .points = r->points,
                                   .from_tau = r->time[0],
                                   .to_tau = r->time[r->points - 1],
                                   .area_l2 = r->area / (double)r->points,
                                   .speed_u0 = speed,
                                   .at_side_wall = 2 * r->at_wall >= r->points};
}

static enum status end_run(const struct bubbles *b, struct run *r, size_t track, size_t min_points,
                           struct pile *out, struct fault *fault) {
    bool counts = r->points >= min_points && r->area >= b->rule.area_min_l2 * (double)r->points;
    struct bubble_stretch *s = counts ? pile_add(out, fault) : NULL;
    if (counts && !s)
        return STATUS_NO_MEMORY;
    if (s)
        *s = conclude(r, track);
    r->points = r->at_wall = 0;
    r->area = 0;
    return STATUS_OK;
}

static enum status add_stretches(const struct bubbles *b, size_t track, size_t min_points,
                                 double longest_tau, struct run *r, struct pile *out,
                                 struct fault *fault) {
    enum status status = STATUS_OK;
    for (size_t i = track_at(b, track)->first; i != BUBBLE_NONE && !status;
         i = point_at(b, i)->next) {
        const struct bubble_point *p = point_at(b, i);
        double time = frame_at(b, p->frame)->time_tau;
        if (p->fresh || (r->points && time > r->time[0] + longest_tau))
            status = end_run(b, r, track, min_points, out, fault);
        r->time[r->points] = time;
        r->height[r->points++] = p->shape.y_l;
        r->area += p->shape.area_l2;
        r->at_wall += (p->shape.walls & (COMPONENT_LEFT | COMPONENT_RIGHT)) != 0;
    }
    return status ? status : end_run(b, r, track, min_points, out, fault);
}

enum status bubbles_stretches(const struct bubbles *b, size_t min_points, double longest_tau,
                              struct bubble_stretch **out, size_t *count, struct fault *fault) {
    enum status status = STATUS_OK;
    struct pile found = {.size = sizeof(struct bubble_stretch)};
    size_t room = b->frames.count + 1;
    struct run r = {.time = calloc(room, sizeof *r.time), .height = calloc(room, sizeof *r.height)};
    *out = NULL;
    *count = 0;
    if (!r.time || !r.height)
        status = fault_set(fault, STATUS_NO_MEMORY, "no memory for stretches of bubbles");
    else if (min_points < 3)
        status =
            fault_set(fault, STATUS_BAD_INPUT, "a stretch of %zu points has no speed", min_points);
    for (size_t t = 0; t < b->tracks.count && !status; t++)
        status = add_stretches(b, t, min_points, longest_tau, &r, &found, fault);
    free(r.time);
    free(r.height);
    if (status) {
        free(found.data);
        return status;
    }
    *out = found.data;
    *count = found.count;
    return STATUS_OK;
}
