/* animation_data.c -- places of grains at many times in few bytes.
 *
 * A place is a whole number of units.  Of the first frame it stands as it is, of all others as the
 * difference to the frame before: x of all grains, then y, then, for lit spheres, depth.  Numbers
 * are zigzag coded (0, -1, 1, -2, ... are 0, 1, 2, 3, ...) in groups of seven bits, the lowest
 * first, the eighth bit set where another follows; and all is deflated (RFC 1950), which every
 * browser undoes by itself.  Differences are between rounded places, so that nothing drifts.
 */
#include "report/animation.h"

#include <math.h>
#include <stdlib.h>
#include <zlib.h>

enum { MAX_CODE = 5, FINEST = 16, COARSEST = 4 };

struct packing {
    const struct report_sequence *s;
    size_t axes;
    long *last; /* last[axis * count + grain], units */
    unsigned char *plain, *packed;
    size_t room; /* of packed */
};

static size_t put_code(unsigned char *at, long value) {
    unsigned long code = value < 0 ? (unsigned long)(-value) * 2 - 1 : (unsigned long)value * 2;
    size_t length = 0;
    for (; code > 127; code >>= 7)
        at[length++] = (unsigned char)(code & 127) | 128;
    at[length++] = (unsigned char)code;
    return length;
}

/* Outside of the box there is nothing to see; depths are from the front, without an end. */
static double place_of(const struct report_sequence *s, const struct report_frame *f, size_t grain,
                       size_t axis) {
    if (axis == 2)
        return fmax(f->depth[grain], 0);
    return fmin(fmax(f->position[2 * grain + axis], 0), axis == 0 ? s->width : s->height);
}

static size_t write_plain(struct packing *p, double unit, size_t stride) {
    const struct report_sequence *s = p->s;
    size_t length = 0;
    for (size_t f = 0; f < s->frame_count; f += stride) {
        for (size_t axis = 0; axis < p->axes; axis++) {
            for (size_t i = 0; i < s->count; i++) {
                long now = lround(place_of(s, &s->frame[f], i, axis) / unit);
                long *last = &p->last[axis * s->count + i];
                length += put_code(p->plain + length, f == 0 ? now : now - *last);
                *last = now;
            }
        }
    }
    return length;
}

/* Finer units first, then fewer frames. */
static enum status pack(struct packing *p, struct animation_data *out, struct fault *fault) {
    double most = 0;
    for (size_t i = 0; i < p->s->count; i++)
        most = fmax(most, p->s->radius[i]);
    int parts = FINEST;
    for (size_t stride = 1;; parts > COARSEST ? (void)(parts /= 2) : (void)stride++) {
        size_t length = write_plain(p, most / parts, stride);
        uLongf packed = (uLongf)p->room;
        if (compress2(p->packed, &packed, p->plain, (uLong)length, 9) != Z_OK)
            return fault_set(fault, STATUS_NO_MEMORY, "animation %s: out of memory", p->s->name);
        if (packed <= ANIMATION_MAX_BYTES || stride >= p->s->frame_count) {
            *out = (struct animation_data){p->packed, packed, stride, most / parts};
            p->packed = NULL;
            return STATUS_OK;
        }
    }
}

enum status animation_pack(const struct report_sequence *s, struct animation_data *out,
                           struct fault *fault) {
    struct packing p = {.s = s, .axes = s->lit ? 3 : 2};
    size_t numbers = s->count * p.axes * s->frame_count;
    p.room = compressBound((uLong)(numbers * MAX_CODE));
    p.last = calloc(s->count * p.axes, sizeof *p.last);
    p.plain = malloc(numbers * MAX_CODE);
    p.packed = malloc(p.room);
    enum status status =
        p.last && p.plain && p.packed
            ? pack(&p, out, fault)
            : fault_set(fault, STATUS_NO_MEMORY, "animation %s: out of memory", s->name);
    free(p.last);
    free(p.plain);
    free(p.packed);
    return status;
}
