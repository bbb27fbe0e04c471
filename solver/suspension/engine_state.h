/* engine_state.h -- what the engine is made of; for engine*.c only. */
#ifndef SUSPENSION_ENGINE_STATE_H
#define SUSPENSION_ENGINE_STATE_H

#include "solver/suspension/cells.h"
#include "solver/suspension/engine.h"
#include "solver/suspension/predict.h"
#include "solver/suspension/queue.h"

struct engine {
    struct engine_setup setup;
    size_t count;
    struct sphere *sphere; /* [0 .. count-1], by place in memory */
    struct event *event;   /* the same */
    double *last_hit;      /* (s, common clock) the last pair collision, -INFINITY */
    int32_t (*image)[3];   /* times the sphere left the box upwards */
    uint32_t *id;          /* id[place]: the caller's index */
    uint32_t *place;       /* place[id] */
    struct cells cells;
    struct queue queue;
    struct candidates near;
    _Alignas(16) double shift[PREDICT_SHIFTS][4]; /* (m), of cells beyond a boundary */

    double gamma;                     /* (1/s) */
    double origin_s;                  /* real time at the clock's origin */
    double now;                       /* (s, common clock) */
    double real_now_s;                /* real time */
    double contact_span;              /* (s) (1 - exp(-gamma t_c))/gamma */
    double diameter, growth;          /* of pairs at common time growth_from (m), its rate (m/s) */
    double growth_from;               /* (s, common clock; drag is 0) */
    double rebase_at;                 /* (s, common clock): the latest time of the next rebase */
    long long events, rebuild_events; /* since the last rebuild; that ask for the next */
    double tuned_from;                /* (s, common clock): events are counted since then */
    long long standstill;             /* collisions at one time in a row */
    int64_t looked_at;                /* bucket for which memory was asked ahead */
    uint32_t broken;                  /* a sphere whose velocity is not finite, or QUEUE_NONE */
    bool placed;                      /* engine_set_state was called */
    struct engine_tally tally;
};

/* The true velocity is the stored one times this. */
static inline double engine_slowing(const struct engine *e, double t) {
    return 1 - e->gamma * t;
}

/* engine.c: predict sphere i, whose record is at local time now, and queue it. */
void engine_predict(struct engine *e, uint32_t i);

/* engine_start.c: make the present time the clock's origin, sort spheres by cell,
 * take all events into the queue anew. */
void engine_rebuild(struct engine *e);

/* engine_look.c: the deepest overlap now, and between whom (i = j: with a wall). */
struct engine_overlap {
    double depth; /* diameters of the set-up; 0: none */
    uint32_t i, j;
};
enum status engine_find_overlap(const struct engine *e, struct engine_overlap *worst);

/* Width of the queue's buckets for `seconds` between two events of one sphere. */
double engine_bucket_width(const struct engine *e, double seconds);

#endif
