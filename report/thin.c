/* thin.c -- see thin.h. */
#include "report/thin.h"

#include <math.h>

/* Distance from point p of curve c to the chord from a to b. */
static double distance(const struct thin_point *p, const struct thin_point *a,
                       const struct thin_point *b, size_t c) {
    double dx = b->x - a->x, dy = b->y[c] - a->y[c];
    double px = p->x - a->x, py = p->y[c] - a->y[c];
    double square = dx * dx + dy * dy;
    double along = square > 0 ? fmin(fmax((px * dx + py * dy) / square, 0), 1) : 0;
    return hypot(px - along * dx, py - along * dy);
}

static double largest_distance(const struct thin_point *point, size_t i, size_t first,
                               size_t last) {
    double most = 0;
    for (size_t c = 0; c < THIN_CURVES; c++)
        most = fmax(most, distance(&point[i], &point[first], &point[last], c));
    return most;
}

static void thin_between(const struct thin_point *point, size_t first, size_t last,
                         double tolerance_px, bool *keep) {
    while (last > first + 1) {
        double most = tolerance_px;
        size_t farthest = first;
        for (size_t i = first + 1; i < last; i++) {
            double here = largest_distance(point, i, first, last);
            if (here > most) {
                most = here;
                farthest = i;
            }
        }
        if (farthest == first)
            return;
        keep[farthest] = true;
        thin_between(point, first, farthest, tolerance_px, keep);
        first = farthest;
    }
}

void thin_curve(const struct thin_point *point, size_t count, double tolerance_px, bool *keep) {
    for (size_t i = 0; i < count; i++)
        keep[i] = i == 0 || i + 1 == count;
    if (count > 2)
        thin_between(point, 0, count - 1, tolerance_px, keep);
}
