/* bubbles.h -- the voids of a bed followed from frame to frame.
 *
 * Regions of low solid fraction (components.h) of each frame are told apart:
 *   freeboard  touches the lid, or its centroid lies above the bed's top
 *              (bed_profile.h): the gas above and hollows in the spray
 *   layer      spans layer_span of the width or more: the gas below a rising
 *              plug, or a slug; its gas is not a bubble's
 *   speckle    below area_min/2: not followed
 *   bubble     all others.  Only from area_min on are they counted; the smaller
 *              ones are followed so that one that wavers about area_min stays
 *              the same bubble.
 *
 * From frame to frame, each bubble is moved by its own velocity, a running mean
 * of its centroid's motion that begins with the guess (0, 1) U0, and laid over
 * the new regions with bilinear weights.  A bubble p and a region c are linked
 * when they share .3 of the smaller one's area.  Each takes the one that it
 * shares most with; where the choice is mutual the bubble goes on under its
 * number.  What is left over is an event:
 *   merge      p is linked, but its c goes on as another bubble
 *   split      c is linked, but its p goes on elsewhere
 *   burst      p is not linked, and .3 of it is freeboard now
 *   engulf     the same with a layer
 *   vanish     p is not linked
 *   birth      c is not linked
 *   shed       the same, where a layer was
 *   enclose    the same, where freeboard was: the surface closed over a hollow
 * Merges and splits break the stretch of motion of both partners.
 *
 * A bubble moves by less than its diameter between frames only if frames are
 * closer than sqrt(area_min)/speed, 2 tau for 4 l^2 at 1 U0; .5 tau is ample.
 *
 * Source:     own definitions; docs/theory.md, "Bubbles".
 * Leaves out: a bubble that appears and is gone between two frames.
 * Checked by: tests/unit/test_bubbles.c.
 */
#ifndef VALIDATION_BUBBLES_H
#define VALIDATION_BUBBLES_H

#include "validation/components.h"

#include <stdbool.h>

enum bubble_event_kind {
    BUBBLE_BIRTH,
    BUBBLE_SHED,
    BUBBLE_ENCLOSE,
    BUBBLE_SPLIT,
    BUBBLE_MERGE,
    BUBBLE_BURST,
    BUBBLE_ENGULF,
    BUBBLE_VANISH
};

struct bubble_rule {
    double threshold;   /* solid fraction below which a site is void (1) */
    double area_min_l2; /* of a bubble */
    double layer_span;  /* of a layer, over the box's width (1) */
};

/* A bubble in a frame. */
struct bubble_point {
    size_t frame, track;
    size_t next;                   /* point of the same track in the next frame, or BUBBLE_NONE */
    bool fresh;                    /* no uninterrupted motion leads here from the frame before */
    double velocity_x, velocity_y; /* running mean (U0) */
    struct component shape;
};

struct bubble_track {
    size_t first, points;          /* index of its first point; how many it has */
    size_t large;                  /* those of them of area_min or more */
    bool initial;                  /* it is there in the first frame */
    enum bubble_event_kind origin; /* BIRTH, SHED, ENCLOSE or SPLIT */
};

struct bubble_event {
    enum bubble_event_kind kind;
    bool brief;          /* see bubbles_mark_brief */
    double time_tau;     /* of the frame that shows it */
    size_t track, other; /* other: split from, merged into; BUBBLE_NONE without */
    double area_l2;      /* before a merge, burst, engulf or vanish; after the others */
    double other_l2;     /* the same of the other; 0 without */
};

struct bubble_frame {
    double time_tau, top_l; /* of the bed */
    double layer_span;      /* widest layer over the width; 0: none */
    size_t first, points;   /* point[first .. first+points-1] */
};

#define BUBBLE_NONE ((size_t)-1)

struct bubbles; /* opaque: the history so far, and the latest frame's sites */

enum status bubbles_create(const struct bubble_rule *rule, size_t nx, size_t ny,
                           struct bubbles **out, struct fault *fault);
void bubbles_free(struct bubbles *b); /* NULL is allowed */

/* solid_fraction[0 .. nx*ny-1].  STATUS_BAD_INPUT where time does not increase, there is no bed,
 * or more than 1024 bubbles; STATUS_NO_MEMORY.  After a fault it can only be freed. */
enum status bubbles_add(struct bubbles *b, double time_tau, const double *solid_fraction,
                        struct fault *fault);

/* What was found; borrowed, until the next frame is added. */
struct bubble_history {
    size_t frames, points, tracks, events;
    const struct bubble_frame *frame;
    const struct bubble_point *point; /* frame by frame */
    const struct bubble_track *track;
    const struct bubble_event *event; /* in the order of time */
};
struct bubble_history bubbles_history(const struct bubbles *b);

/* Voids that touch and part again make pairs of events that mean nothing.  Marks as brief a merge
 * after which at least half of what came leaves again within within_tau, a split whose parts are
 * one again within that time, and the event that undoes it. */
void bubbles_mark_brief(struct bubbles *b, double within_tau);

/* Uninterrupted motion of one bubble over several frames. */
struct bubble_stretch {
    size_t track, points;
    double from_tau, to_tau;
    double area_l2;    /* mean */
    double speed_u0;   /* upwards: slope of the least-squares line through the centroid's height */
    bool at_side_wall; /* it touches one in at least half of the frames */
};
/* Stretches of at least min_points (3 or more) points whose mean area is area_min or more, in
 * the order of their bubbles.  Motion that lasts for more than longest_tau is cut into several,
 * because bubbles change on the way.  *out is the caller's to free. */
enum status bubbles_stretches(const struct bubbles *b, size_t min_points, double longest_tau,
                              struct bubble_stretch **out, size_t *count, struct fault *fault);

#endif
