/* components.h -- connected regions of the lattice where a field is low, and their shapes.
 *
 * Sites belong to one region when a path over neighbours across or up and down
 * (not diagonal: 4-connectivity) leads from one to the other below the
 * threshold.  Two voids whose sites meet at a corner only are thus two: the
 * other pair of that corner is dense, the halo of a grain covers both of it,
 * and the roof between the voids still holds.
 *
 * A site owns its control volume: 1 l^2, half along walls, a quarter in corners.
 *   area      sum of the control volumes
 *   centroid  of the control volumes' middles, each weighted with its area times
 *             the depth threshold - field: it moves smoothly where a count of
 *             sites would jump as sites cross the threshold
 *   aspect    sqrt(<y'^2>/<x'^2>) of the control volumes: 1 for a disc or a
 *             square, above 1 for what is taller than wide
 *   flatness  of the floor, (T - B)/(|T| + |B|), with the bows
 *                 T = -sum_i q_i t_i,  B = sum_i q_i b_i,  q_i = (i - m)^2 - (n^2 - 1)/12
 *             over the n columns i of the region (mean m), t_i and b_i its upper
 *             and lower edge, where the field crosses the threshold, straight
 *             between two sites.  T and B are in proportion to the curvatures of
 *             parabolas through the edges, positive where the edge bulges
 *             outwards.  0: a disc, a square, whatever is symmetric up and down;
 *             1: a round roof over a floor that is flat or bulges inwards;
 *             -1: the reverse.  NaN below three columns.
 *
 * Source:     own definitions; docs/theory.md, "Bubbles".
 * Leaves out: areas finer than a control volume; overhangs (edges are outermost).
 * Checked by: tests/unit/test_components.c.
 */
#ifndef VALIDATION_COMPONENTS_H
#define VALIDATION_COMPONENTS_H

#include "common/fault.h"

#include <stddef.h>

enum component_wall {
    COMPONENT_LEFT = 1,
    COMPONENT_RIGHT = 2,
    COMPONENT_BOTTOM = 4,
    COMPONENT_TOP = 8
};

struct component {
    size_t sites;
    double area_l2, x_l, y_l;                /* centroid */
    double left_l, right_l, bottom_l, top_l; /* extents, of control volumes */
    unsigned walls;                          /* those it touches: enum component_wall */
    double aspect, flatness;                 /* (1); flatness may be NaN */
};

struct components {
    size_t nx, ny;          /* sites */
    size_t count;           /* regions found */
    struct component *list; /* list[0 .. count-1], in the order of their first site */
    long *label;            /* label[j*nx + i]: index in list, or -1 */
    size_t *stack;          /* [0 .. nx*ny-1], scratch */
    struct component_sums *sums;
};

/* STATUS_BAD_INPUT below 2 x 2 sites. */
enum status components_create(struct components *c, size_t nx, size_t ny, struct fault *fault);
void components_free(struct components *c);
/* Regions of field[0 .. nx*ny-1] < threshold, row by row from the floor.  Overwrites. */
void components_find(struct components *c, const double *field, double threshold);

#endif
