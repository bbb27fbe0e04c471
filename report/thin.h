/* thin.h -- a curve with as few points as it looks the same with.
 *
 * Between two points that are kept the curve runs straight; a point is left out only where the
 * drawn curve passes it by less than a tolerance far below a pixel (Douglas and Peucker, 1973).
 * Curves that share their abscissae, such as a line and the edges of its band, are thinned
 * together.
 *
 * Checked by: tests/unit/test_thin.c.
 */
#ifndef REPORT_THIN_H
#define REPORT_THIN_H

#include <stdbool.h>
#include <stddef.h>

enum { THIN_CURVES = 3 };

struct thin_point {
    double x, y[THIN_CURVES]; /* px */
};

/* keep[0 .. count-1]: which points are needed; the first and the last always are.  All numbers
 * must be finite. */
void thin_curve(const struct thin_point *point, size_t count, double tolerance_px, bool *keep);

#endif
