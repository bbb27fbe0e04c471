/* queue.c -- see queue.h. */
#include "solver/suspension/queue.h"
#include "solver/suspension/lanes.h"

#include <stdlib.h>
#include <string.h>

#define IN_HEAP (UINT32_C(1) << 31)
enum { FIRST_RING = 64, SPHERES_A_BUCKET = 4 };

enum status queue_create(struct queue *q, struct event *event, size_t count, struct fault *fault) {
    *q = (struct queue){.event = event, .count = count, .ring = FIRST_RING, .per_width = 1};
    while ((size_t)q->ring * SPHERES_A_BUCKET < count)
        q->ring *= 2;
    q->bucket = spheres_memory(q->ring * QUEUE_SLOTS * sizeof *q->bucket);
    q->heap = spheres_memory((count + 1) * sizeof *q->heap);
    if (!q->bucket || !q->heap) {
        queue_free(q);
        return fault_set(fault, STATUS_NO_MEMORY, "no memory for the queue of %zu spheres", count);
    }
    memset(q->bucket, 0xff, q->ring * QUEUE_SLOTS * sizeof *q->bucket);
    return STATUS_OK;
}

void queue_free(struct queue *q) {
    free(q->bucket);
    free(q->heap);
    *q = (struct queue){.event = NULL};
}

size_t queue_bytes(const struct queue *q) {
    return sizeof *q->bucket * q->ring * QUEUE_SLOTS + sizeof *q->heap * (q->count + 1);
}

/* -- the heap of what is due ------------------------------------------------------ */

static inline bool is_before(const struct queue *q, uint32_t a, uint32_t b) {
    double ta = q->event[a].time, tb = q->event[b].time;
    return ta < tb || (ta == tb && a < b);
}

static inline void heap_put(struct queue *q, size_t k, uint32_t i) {
    q->heap[k] = i;
    q->event[i].where = IN_HEAP | (uint32_t)k;
}

static void heap_rise(struct queue *q, size_t k, uint32_t i) {
    while (k > 0) {
        size_t parent = (k - 1) / 2;
        if (!is_before(q, i, q->heap[parent]))
            break;
        heap_put(q, k, q->heap[parent]);
        k = parent;
    }
    heap_put(q, k, i);
}

static void heap_sink(struct queue *q, size_t k, uint32_t i) {
    for (size_t child = 2 * k + 1; child < q->heap_count; child = 2 * k + 1) {
        if (child + 1 < q->heap_count && is_before(q, q->heap[child + 1], q->heap[child]))
            child++;
        if (!is_before(q, q->heap[child], i))
            break;
        heap_put(q, k, q->heap[child]);
        k = child;
    }
    heap_put(q, k, i);
}

static void heap_remove(struct queue *q, size_t k) {
    uint32_t last = q->heap[--q->heap_count];
    if (k == q->heap_count)
        return;
    if (k > 0 && is_before(q, last, q->heap[(k - 1) / 2]))
        heap_rise(q, k, last);
    else
        heap_sink(q, k, last);
}

/* -- the ring ----------------------------------------------------------------------- */

/* The bucket of a time, INT64_MAX for one too far to be counted.  It never falls when
 * t rises, which is what keeps the order independent of the width. */
static inline int64_t bucket_of(const struct queue *q, double t) {
    double k = (t - q->origin) * q->per_width;
    return k < 0x1p60 ? (k > -1 ? (int64_t)k : -1) : INT64_MAX;
}

static void place(struct queue *q, uint32_t i) {
    int64_t k = bucket_of(q, q->event[i].time), half = q->ring / 2;
    if (k > q->present && k - q->present >= (int64_t)q->ring) /* spread what is far over half */
        k = q->present + half + ((int64_t)((i * UINT32_C(2654435761)) >> 7) & (half - 1));
    for (; k > q->present; k--) {
        size_t b = (size_t)(k & (int64_t)(q->ring - 1));
        unsigned free_slots = lanes_signs16(q->bucket + QUEUE_SLOTS * b);
        if (free_slots != 0) {
            uint32_t at = (uint32_t)(QUEUE_SLOTS * b) + (uint32_t)__builtin_ctz(free_slots);
            q->bucket[at] = i;
            q->event[i].where = at;
            return;
        }
    }
    heap_rise(q, q->heap_count++, i);
}

void queue_move(struct queue *q, uint32_t i) {
    uint32_t where = q->event[i].where;
    if (where & IN_HEAP) {
        size_t k = where & ~IN_HEAP;
        if (bucket_of(q, q->event[i].time) <= q->present) {
            if (k > 0 && is_before(q, i, q->heap[(k - 1) / 2]))
                heap_rise(q, k, i);
            else
                heap_sink(q, k, i);
            return;
        }
        heap_remove(q, k);
    } else {
        q->bucket[where] = QUEUE_NONE;
    }
    place(q, i);
}

/* The next bucket becomes the present one. */
static void open_bucket(struct queue *q) {
    uint32_t due[QUEUE_SLOTS], *slot;
    q->present++;
    slot = q->bucket + QUEUE_SLOTS * (size_t)(q->present & (int64_t)(q->ring - 1));
    memcpy(due, slot, sizeof due);
    memset(slot, 0xff, sizeof due);
    for (int k = 0; k < QUEUE_SLOTS; k++)
        if (due[k] != QUEUE_NONE)
            place(q, due[k]);
}

void queue_rebuild(struct queue *q, double now, double width) {
    memset(q->bucket, 0xff, q->ring * QUEUE_SLOTS * sizeof *q->bucket);
    q->heap_count = 0;
    q->present = 0;
    q->origin = now;
    q->per_width = 1 / width;
    for (size_t i = 0; i < q->count; i++)
        place(q, (uint32_t)i);
}

/* A whole round without an event: go to the earliest one, or to limit. */
static void leap(struct queue *q, double limit) {
    double earliest = limit;
    for (size_t i = 0; i < q->count; i++)
        if (q->event[i].time < earliest)
            earliest = q->event[i].time;
    queue_rebuild(q, earliest, 4 / q->per_width);
}

/* Is the head of the heap the earliest of all?  One whose bucket was full may be in the
 * heap before its time. */
static inline bool is_due(const struct queue *q) {
    return q->heap_count > 0 && bucket_of(q, q->event[q->heap[0]].time) <= q->present;
}

uint32_t queue_first(struct queue *q, double limit) {
    int64_t last = bucket_of(q, limit);
    for (uint32_t empty = 0; !is_due(q) && q->present < last; empty++) {
        if (q->count == 0)
            return QUEUE_NONE;
        if (empty > q->ring) {
            leap(q, limit);
            last = bucket_of(q, limit);
            empty = 0;
        } else {
            open_bucket(q);
        }
    }
    return is_due(q) && q->event[q->heap[0]].time <= limit ? q->heap[0] : QUEUE_NONE;
}
