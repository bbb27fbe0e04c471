/* spheres.h -- what is known of a sphere, in two records: one for its neighbours,
 * one for the queue.
 *
 * Neighbours read the first while they look for collisions: one cache line with
 * place, velocity and when it next collides.  The place is that of the sphere's local time; now it
 * is at x + w (now - t).  All times are in the common clock (engine.h): w is the
 * velocity that the sphere would have at the clock's origin.
 */
#ifndef SUSPENSION_SPHERES_H
#define SUSPENSION_SPHERES_H

#include <math.h>
#include <stddef.h>
#include <stdint.h>

struct sphere {
    double x[3];      /* (m), centre at time t */
    double t;         /* (s, common clock) */
    double w[3];      /* (m/s), dx/ds */
    double pair_time; /* (s, common clock) of its next collision; INFINITY: none known */
};

/* time = the earlier of pair_time and the time of leaving the cell (or meeting a wall). */
struct event {
    double time;      /* (s, common clock): the queue's key */
    uint16_t cell[3]; /* tracked from passage to passage, never found from x again */
    uint16_t spare;
    uint32_t partner;       /* of the collision at pair_time: place in memory */
    uint32_t partner_count; /* the partner's count when this was predicted */
    uint32_t count;         /* changes of velocity of this sphere */
    uint32_t where;         /* kept by queue.c */
};

_Static_assert(sizeof(struct sphere) == 64, "a sphere is one cache line");
_Static_assert(sizeof(struct event) == 32, "two events a cache line");

/* Bring a sphere to time t. */
static inline void sphere_advance(struct sphere *s, double t) {
    double dt = t - s->t;
    s->x[0] += s->w[0] * dt;
    s->x[1] += s->w[1] * dt;
    s->x[2] += s->w[2] * dt;
    s->t = t;
}

/* Cache-line aligned, in huge pages where the system gives them; freed with free(). */
void *spheres_memory(size_t bytes);

#endif
