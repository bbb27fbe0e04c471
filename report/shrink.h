/* shrink.h -- the body of gnuplot's SVG in a third of its bytes.
 *
 * gnuplot writes a group for every pen, most of them empty, coordinates to a hundredth of a pixel,
 * all its symbols in every file, and 110 bytes a point.  Here empty groups and symbols that
 * nothing uses go, paths are relative and in tenths of a pixel (rounded before differences are
 * taken, so that nothing drifts), and points of one kind share a group.  Points that fall on the
 * point before are left out.
 *
 * Checked by: tests/unit/test_shrink.c.
 */
#ifndef REPORT_SHRINK_H
#define REPORT_SHRINK_H

#include <stdio.h>

/* Style of the element around the body: what its groups would each repeat. */
#define SHRINK_STYLE "font-family:sans-serif;fill:none;color:#000"

/* body: elements, from behind gnuplot's own head to </svg>.  Ids and what refers to them get the
 * prefix; ids that nothing can refer to go, and so do titles, which are gnuplot's own names. */
void shrink_svg(FILE *out, const char *body, const char *prefix);

#endif
