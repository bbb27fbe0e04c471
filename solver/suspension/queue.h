/* queue.h -- who is next: a calendar of events, one event a sphere.
 *
 * Time is cut into buckets of one cache line, 16 spheres each, in a ring; those of
 * the present bucket are in a binary heap.  An event is put into the bucket of
 * its time; one beyond the ring, or whose bucket is full, into some earlier bucket,
 * and is looked at again when that one comes.  So the queue is bounded, moves are
 * O(1), and what queue_first gives is the smallest by (time, place in memory),
 * whatever the width of the buckets: that is a matter of speed only.
 *
 * Source: Lubachevsky, J. Comput. Phys. 94, 255 (1991); Paul, J. Comput. Phys. 221,
 *         615 (2007), whose heap in front of a calendar this is, with cache lines
 *         in place of lists.
 * Checked by: tests/unit/test_queue.c
 */
#ifndef SUSPENSION_QUEUE_H
#define SUSPENSION_QUEUE_H

#include "common/fault.h"
#include "solver/suspension/spheres.h"

#include <stdbool.h>

enum { QUEUE_SLOTS = 16 };
#define QUEUE_NONE UINT32_MAX

struct queue {
    struct event *event; /* borrowed: event[0 .. count-1] */
    size_t count;
    uint32_t *bucket; /* bucket[QUEUE_SLOTS (ring + 1)]: spheres, QUEUE_NONE where free */
    uint32_t ring;    /* number of buckets, a power of two */
    uint32_t *heap;   /* heap[0 .. heap_count-1]: spheres of buckets up to the present one */
    size_t heap_count;
    double origin, per_width; /* bucket of t is (t - origin) per_width */
    int64_t present;          /* bucket; all before it are empty */
};

enum status queue_create(struct queue *q, struct event *event, size_t count, struct fault *fault);
void queue_free(struct queue *q);

/* Take in all spheres anew: present bucket at time `now`, buckets of the given width. */
void queue_rebuild(struct queue *q, double now, double width);

/* The sphere of the earliest event, if that is not after limit, else QUEUE_NONE. */
uint32_t queue_first(struct queue *q, double limit);

/* event[i].time has changed. */
void queue_move(struct queue *q, uint32_t i);

/* The spheres of a bucket to come: bucket[0 .. QUEUE_SLOTS-1], QUEUE_NONE where free. */
static inline const uint32_t *queue_ahead(const struct queue *q, int64_t buckets) {
    return q->bucket + QUEUE_SLOTS * (size_t)((q->present + buckets) & (int64_t)(q->ring - 1));
}

size_t queue_bytes(const struct queue *q);

#endif
