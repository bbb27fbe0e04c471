/* draw.h -- figures and grain pictures as bytes: by gnuplot, and grains in time by ourselves.
 *
 * Figures are SVG to stand inline in a page: panels above each other with one
 * x axis, common margins, the key above all data.  A measured point is never
 * cut off: limits given for an axis are widened to hold it.  The background is
 * white, on dark pages too.
 *
 * Grain pictures are palette PNG by gnuplot's gd terminal: discs have their
 * true radii and equal axes.  They are drawn at twice the size they are shown
 * at, and the browser's scaling smooths their edges.
 *
 * Sequences of the same grains are SVG files (side by side) and HTML pages with a player on a
 * canvas (animations), both drawn from shapes, so that they stay sharp when zoomed. In the report's
 * page stand small palette PNGs of them (raster.c). They have a light ground of their own.
 */
#ifndef REPORT_DRAW_H
#define REPORT_DRAW_H

#include "report/report.h"
#include "report/sheet.h"

#include <stdio.h>

/* An <svg> element in svg->text; every id in it begins with prefix, so that
 * figures of different prefixes can share a page.  On success sheet_free it. */
enum status draw_figure(const struct report_figure *f, const char *prefix, struct sheet *svg,
                        struct fault *fault);

/* Make gnuplot's SVG file one element of a page: title and alternative text for
 * screen readers, ids with the prefix, nothing of gnuplot's own head. */
enum status draw_embed_svg(const char *file, const struct report_figure *f, const char *prefix,
                           struct sheet *svg, struct fault *fault);

enum {
    DRAW_INLINE_PX_PER_L = 12,
    DRAW_FULL_PX_PER_L = 24,
    DRAW_LEAST_PX_PER_L = 4,
    DRAW_MAX_PX = 8000
};

struct drawing {
    char *bytes; /* bytes[0 .. length-1], a PNG file; free() it */
    size_t length;
    int width_px, height_px;
};

/* At least px_per_l pixels a lattice constant, more for small boxes, fewer only
 * where the picture would be wider or higher than DRAW_MAX_PX. */
enum status draw_picture(const struct report_picture *p, double px_per_l, struct drawing *out,
                         struct fault *fault);

/* Of the grains of a sequence by kind, and of what is between them: discs, lit spheres. */
extern const char *const DRAW_KIND_COLOUR[2];
extern const char DRAW_GROUND_COLOUR[];
extern const char *const DRAW_LIT_COLOUR[REPORT_KINDS];
extern const char DRAW_LIT_GROUND_COLOUR[];
const char *draw_kind_colour(const struct report_sequence *s, size_t kind); /* NULL: no such */
const char *draw_length_unit(const struct report_sequence *s);
const char *draw_ground_colour(const struct report_sequence *s);

/* The lit spheres of a frame as a group of an SVG file, the floor's left end at its origin; its ids
 * begin with prefix.  Spheres that others hide are left out: see spheres.c. */
enum status draw_spheres(const struct report_sequence *s, size_t frame, double px_per_l,
                         const char *prefix, FILE *out, struct fault *fault);

/* STATUS_BAD_INPUT names the grain or frame that cannot be drawn; no grains or frames is a fault.
 */
enum status draw_check_sequence(const struct report_sequence *s, struct fault *fault);

/* The box of a frame as a palette PNG of so many pixels a lattice constant; free out->bytes. */
enum status draw_panel(const struct report_sequence *s, size_t frame, double px_per_l,
                       struct drawing *out, struct fault *fault);

/* All frames side by side, an SVG file of shapes.  On success sheet_free it; the same for those
 * below. */
enum status draw_sequence(const struct report_sequence *s, struct sheet *svg, struct fault *fault);

/* The same for a page: the boxes are pictures (draw_panel) of at least DRAW_LEAST_PX_PER_L. */
enum status draw_sequence_small(const struct report_sequence *s, struct sheet *svg,
                                struct fault *fault);

/* The middle frame as such a picture with a sign to start playing, an SVG file. */
enum status draw_poster(const struct report_sequence *s, struct sheet *svg, struct fault *fault);

/* A page that plays the frames, needing nothing else, below 2 MB: frames are left out if need be
 * (animation.h). */
enum status draw_animation(const struct report_sequence *s, struct sheet *page,
                           struct fault *fault);

#endif
