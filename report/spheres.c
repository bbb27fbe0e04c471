/* spheres.c -- lit spheres seen from the side, the nearest in front; see draw.h.
 *
 * Painter's order costs an element a sphere in SVG.  It need not: spheres do not overlap, so two
 * whose centres are less than SLAB radii apart in depth hardly overlap on the paper (2 R -
 * sqrt(4 - SLAB^2) R = .06 R).  So the spheres of a slab of that depth can be drawn together, a
 * path for each kind, used once for each shade: a sphere is three discs, the smaller ones lighter
 * and moved to the light, upper left.  Slabs farther back are darker.
 *
 * A sphere is left out when it covers none of the points, a twelfth of a radius apart, that nearer
 * ones leave free.
 *
 * Leaves out: perspective, shadows; all spheres are drawn as large as the largest.
 * Checked by: tests/unit/test_spheres_drawn.c.
 */
#include "report/draw.h"

#include <math.h>
#include <stdlib.h>

enum { SHADES = 3, UNITS = 20, PER_RADIUS = 12 };
static const double SLAB = .5;             /* R */
static const double DARKEST = .45;         /* of the colour, at the back */
static const double FADE = 14;             /* R: depth of half the darkening */
static const double MOST_POINTS = 1 << 24; /* of the paper */

const char *const DRAW_LIT_COLOUR[REPORT_KINDS] = {"#3b2a8c", "#2a7fb8", "#2fa37c", "#e08f2c",
                                                   "#f5d547"};
const char DRAW_LIT_GROUND_COLOUR[] = "#eef1f4";

struct ball {
    double depth;
    size_t slab, grain;
    unsigned char kind;
    bool seen;
};

struct paper { /* what is covered: points[row * columns + column] */
    size_t columns, rows;
    double step; /* l */
    unsigned char *points;
};

/* -- hidden ones ------------------------------------------------------------ */

static size_t clamp(double x, size_t count) {
    return x <= 0 ? 0 : x >= (double)count ? count : (size_t)x;
}

/* Covers the disc; was any point of it free? */
static bool cover(struct paper *p, double x, double y, double radius) {
    bool seen = false;
    size_t top = clamp(ceil((y + radius) / p->step), p->rows);
    for (size_t row = clamp(floor((y - radius) / p->step), p->rows); row < top; row++) {
        double dy = ((double)row + .5) * p->step - y, half = radius * radius - dy * dy;
        if (half <= 0)
            continue;
        half = sqrt(half);
        size_t end = clamp(round((x + half) / p->step), p->columns);
        for (size_t c = clamp(round((x - half) / p->step), p->columns); c < end; c++) {
            unsigned char *point = &p->points[row * p->columns + c];
            seen |= !*point;
            *point = 1;
        }
    }
    return seen;
}

static int by_depth(const void *first, const void *second) {
    const struct ball *a = first, *b = second;
    if (a->depth != b->depth)
        return a->depth < b->depth ? -1 : 1;
    return a->grain < b->grain ? -1 : a->grain > b->grain;
}

/* The farthest slab first, in it by kind. */
static int by_slab(const void *first, const void *second) {
    const struct ball *a = first, *b = second;
    if (a->slab != b->slab)
        return a->slab > b->slab ? -1 : 1;
    if (a->kind != b->kind)
        return a->kind < b->kind ? -1 : 1;
    return a->grain < b->grain ? -1 : a->grain > b->grain;
}

/* ball[0 .. return-1]: those that are seen, in the order in which they are painted. */
static size_t find_seen(const struct report_sequence *s, const struct report_frame *f,
                        double largest, struct paper *paper, struct ball *ball) {
    size_t seen = 0;
    for (size_t i = 0; i < s->count; i++)
        ball[i] = (struct ball){.depth = f->depth[i], .grain = i, .kind = s->kind[i]};
    qsort(ball, s->count, sizeof *ball, by_depth);
    double front = ball[0].depth;
    for (size_t i = 0; i < s->count; i++) {
        struct ball b = ball[i];
        const double *at = &f->position[2 * b.grain];
        if (!cover(paper, at[0], at[1], s->radius[b.grain]))
            continue;
        b.slab = (size_t)((b.depth - front) / (SLAB * largest));
        ball[seen++] = b;
    }
    qsort(ball, seen, sizeof *ball, by_slab);
    return seen;
}

/* -- painting --------------------------------------------------------------- */

/* A colour "#rrggbb", made lighter (share > 0) or darker (share < 0), then dimmed. */
static void put_colour(FILE *out, const char *colour, double share, double dim) {
    long rgb = strtol(colour + 1, NULL, 16);
    fputc('#', out);
    for (int shift = 16; shift >= 0; shift -= 8) {
        double value = (double)(rgb >> shift & 255);
        value += share * (share > 0 ? 255 - value : value);
        fprintf(out, "%02lx", lround(value * dim));
    }
}

static void put_places(FILE *out, const struct report_frame *f, double unit,
                       const struct ball *ball, size_t count) {
    long x = 0, y = 0;
    for (size_t i = 0; i < count; i++) {
        const double *at = &f->position[2 * ball[i].grain];
        long to_x = lround(at[0] / unit), to_y = lround(at[1] / unit);
        fprintf(out, i == 0 ? "M%ld%s%ldh0" : "m%ld%s%ldh0", to_x - x, to_y < y ? "" : ",",
                to_y - y);
        x = to_x;
        y = to_y;
    }
}

/* The balls of a slab and kind: one path, used for each shade. */
static void put_group(FILE *out, const struct report_frame *f, double radius,
                      const struct ball *ball, size_t count, const char *id) {
    static const struct {
        double size, towards, share;
    } shade[SHADES] = {{1, 0, -.42}, {.86, .09, 0}, {.34, .34, .55}};
    double depth = (double)ball->slab * SLAB;
    double dim = DARKEST + (1 - DARKEST) * FADE / (FADE + depth);
    fprintf(out, "<defs><path id=\"%s\" d=\"", id);
    put_places(out, f, radius / UNITS, ball, count);
    fputs("\"/></defs>", out);
    for (size_t i = 0; i < SHADES; i++) {
        double move = shade[i].towards * UNITS / sqrt(2);
        fprintf(out, "<use href=\"#%s\" x=\"%.3g\" y=\"%.3g\" stroke=\"", id, -move, move);
        put_colour(out, DRAW_LIT_COLOUR[ball->kind], shade[i].share, dim);
        fprintf(out, "\" stroke-width=\"%.4g\"/>", 2 * UNITS * shade[i].size);
    }
    fputc('\n', out);
}

static void put_groups(FILE *out, const struct report_frame *f, double radius,
                       const struct ball *ball, size_t count, const char *prefix) {
    char id[64];
    size_t number = 0;
    for (size_t i = 0, end; i < count; i = end) {
        for (end = i;
             end < count && ball[end].slab == ball[i].slab && ball[end].kind == ball[i].kind; end++)
            ;
        snprintf(id, sizeof id, "%s%zu", prefix, ++number);
        put_group(out, f, radius, &ball[i], end - i, id);
    }
}

static struct paper paper_of(const struct report_sequence *s, double radius) {
    struct paper p = {.step = radius / PER_RADIUS};
    if (s->width / p.step * (s->height / p.step) > MOST_POINTS)
        p.step = sqrt(s->width * s->height / MOST_POINTS);
    p.columns = (size_t)ceil(s->width / p.step);
    p.rows = (size_t)ceil(s->height / p.step);
    p.points = calloc(p.columns * p.rows, 1);
    return p;
}

enum status draw_spheres(const struct report_sequence *s, size_t frame, double px_per_l,
                         const char *prefix, FILE *out, struct fault *fault) {
    double largest = 0;
    for (size_t i = 0; i < s->count; i++)
        largest = fmax(largest, s->radius[i]);
    struct paper paper = paper_of(s, largest);
    struct ball *ball = calloc(s->count, sizeof *ball);
    enum status status = STATUS_OK;
    if (paper.points && ball) {
        const struct report_frame *f = &s->frame[frame];
        size_t seen = find_seen(s, f, largest, &paper, ball);
        double scale = px_per_l * largest / UNITS;
        fprintf(out, "<g transform=\"scale(%.6g,-%.6g)\" fill=\"none\" stroke-linecap=\"round\">\n",
                scale, scale);
        put_groups(out, f, largest, ball, seen, prefix);
        fputs("</g>\n", out);
    } else {
        status = fault_set(fault, STATUS_NO_MEMORY, "sequence %s: out of memory", s->name);
    }
    free(paper.points);
    free(ball);
    return status;
}
