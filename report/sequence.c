/* sequence.c -- grains at several times side by side as an SVG file; see draw.h.
 *
 * A grain is a line of no length with round ends: one path for each kind and class of diameter
 * and "m12,-34h0" for each grain, in whole units of a twenty-fifth of the largest radius. Ordered
 * along rows, a grain then takes some 10 bytes, which is the price of staying sharp when zoomed.
 */
#include "report/draw.h"
#include "report/escape.h"

#include <math.h>
#include <stdlib.h>

enum {
    WIDTH = 900, /* all of these in px of the drawing */
    MARGIN = 14,
    GAP = 22,
    LABEL = 80, /* of a time above its box */
    HEAD = 26,  /* the time, above its panel */
    FOOT = 44,  /* the key, below all panels */
    TALLEST = 640,
    POSTER = 420,
    FONT = 16,
    WALL = 3
};
enum { CLASSES = 12, UNITS = 25, KINDS = 2 };

const char *const DRAW_KIND_COLOUR[2] = {"#1d1d1d", "#ffffff"};
const char DRAW_GROUND_COLOUR[] = "#8fbce6";

const char *draw_kind_colour(const struct report_sequence *s, size_t kind) {
    if (s->lit)
        return kind < REPORT_KINDS ? DRAW_LIT_COLOUR[kind] : NULL;
    return kind < KINDS ? DRAW_KIND_COLOUR[kind] : NULL;
}

const char *draw_length_unit(const struct report_sequence *s) {
    return s->length_unit ? s->length_unit : "l";
}

const char *draw_ground_colour(const struct report_sequence *s) {
    return s->lit ? DRAW_LIT_GROUND_COLOUR : DRAW_GROUND_COLOUR;
}
/* Pixels of a picture for one of the drawing: smooth edges need fewer than hard ones. */
static const double PIXELS = 1.25, PIXELS_LIT = 1.5;
static const char INK[] = "#222222";

struct layout {
    size_t columns, rows;
    double scale;                                /* px per l */
    double panel_width, panel_height, gap, left; /* px */
    double width, height;
};

/* A grain on its way to the paper. */
struct dot {
    int group; /* kind * CLASSES + class */
    long row, x, y;
};

struct pen {
    FILE *out;
    const struct report_sequence *s;
    double pixels; /* of a picture, for one of the drawing; 0: shapes */
    double unit;   /* l */
    double least, most;
    struct dot *dot; /* dot[0 .. count-1] */
};

/* -- layout ----------------------------------------------------------------- */

/* px per l with so many columns. */
static double scale_of(const struct report_sequence *s, size_t columns) {
    double room = WIDTH - 2 * MARGIN - GAP * ((double)columns - 1);
    return fmin(room / (double)columns / s->width, TALLEST / s->height);
}

/* Columns so that the whole is about as wide as it is high; more where panels lose no size. */
static struct layout lay_out(const struct report_sequence *s) {
    struct layout l = {.width = WIDTH};
    double wanted = ceil(sqrt((double)s->frame_count * s->height / s->width) - .2);
    l.columns = wanted < 1 ? 1 : wanted > 6 ? 6 : (size_t)wanted;
    l.columns = l.columns > s->frame_count ? s->frame_count : l.columns;
    while (s->lit && l.columns < 6 && l.columns < s->frame_count &&
           scale_of(s, l.columns + 1) > .9 * scale_of(s, l.columns))
        l.columns++;
    l.rows = (s->frame_count + l.columns - 1) / l.columns;
    l.scale = scale_of(s, l.columns);
    l.panel_width = l.scale * s->width;
    l.panel_height = l.scale * s->height;
    double spare = (WIDTH - 2 * MARGIN - (double)l.columns * l.panel_width) / (double)l.columns;
    l.gap = fmax(GAP, fmin(spare, LABEL - l.panel_width)); /* a time is wider than a narrow box */
    l.left = (WIDTH - (double)l.columns * l.panel_width - l.gap * ((double)l.columns - 1)) / 2;
    l.height = MARGIN + (double)l.rows * (HEAD + l.panel_height + GAP) + FOOT;
    return l;
}

/* The longest of 1, 2, 5, 10, ... l that is no longer than a third of the box. */
static double bar_length(double width) {
    double decade = pow(10, floor(log10(width / 3))), part = width / 3 / decade;
    return decade * (part >= 5 ? 5 : part >= 2 ? 2 : 1);
}

/* -- grains ----------------------------------------------------------------- */

static int class_of(const struct pen *p, double radius) {
    double share = p->most > p->least ? (radius - p->least) / (p->most - p->least) : 0;
    int class = (int)(share * CLASSES);
    return class < CLASSES ? class : CLASSES - 1;
}

static double class_diameter(const struct pen *p, int class) {
    return 2 * (p->least + (class + .5) * (p->most - p->least) / CLASSES);
}

/* By path, then along rows that run to and fro. */
static int compare_dots(const void *first, const void *second) {
    const struct dot *a = first, *b = second;
    if (a->group != b->group)
        return a->group < b->group ? -1 : 1;
    if (a->row != b->row)
        return a->row < b->row ? -1 : 1;
    int order = a->x < b->x ? -1 : a->x > b->x;
    return a->row % 2 ? -order : order;
}

static void place_dots(struct pen *p, const struct report_frame *f) {
    double row = 16 * p->most; /* several grains high: a class has few of each row */
    for (size_t i = 0; i < p->s->count; i++) {
        const double *at = &f->position[2 * i];
        p->dot[i] = (struct dot){.group = p->s->kind[i] * CLASSES + class_of(p, p->s->radius[i]),
                                 .row = lround(floor(at[1] / row)),
                                 .x = lround(at[0] / p->unit),
                                 .y = lround(at[1] / p->unit)};
    }
    qsort(p->dot, p->s->count, sizeof *p->dot, compare_dots);
}

static void put_path(struct pen *p, const struct dot *dot, size_t count) {
    long x = 0, y = 0;
    fprintf(p->out, "<path stroke=\"%s\" stroke-width=\"%.4g\" d=\"",
            DRAW_KIND_COLOUR[dot->group / CLASSES],
            class_diameter(p, dot->group % CLASSES) / p->unit);
    for (size_t i = 0; i < count; i++) {
        long step_x = dot[i].x - x, step_y = dot[i].y - y;
        fprintf(p->out, i == 0 ? "M%ld%s%ldh0" : "m%ld%s%ldh0", step_x, step_y < 0 ? "" : ",",
                step_y);
        x = dot[i].x;
        y = dot[i].y;
    }
    fputs("\"/>\n", p->out);
}

static void put_grains(struct pen *p, const struct report_frame *f, double left, double floor_px,
                       double scale) {
    fprintf(p->out,
            "<g transform=\"translate(%.2f,%.2f) scale(%.6g,-%.6g)\" fill=\"none\" "
            "stroke-linecap=\"round\">\n",
            left, floor_px, scale * p->unit, scale * p->unit);
    place_dots(p, f);
    for (size_t i = 0, end; i < p->s->count; i = end) {
        for (end = i; end < p->s->count && p->dot[end].group == p->dot[i].group; end++)
            ;
        put_path(p, &p->dot[i], end - i);
    }
    fputs("</g>\n", p->out);
}

static enum status put_spheres(struct pen *p, size_t frame, double left, double floor_px,
                               double scale, struct fault *fault) {
    char prefix[32];
    snprintf(prefix, sizeof prefix, "f%zu-", frame);
    fprintf(p->out, "<g transform=\"translate(%.2f,%.2f)\">\n", left, floor_px);
    enum status status = draw_spheres(p->s, frame, scale, prefix, p->out, fault);
    fputs("</g>\n", p->out);
    return status;
}

static enum status put_picture(struct pen *p, size_t frame, double left, double top, double scale,
                               struct fault *fault) {
    struct drawing panel;
    double px_per_l = fmax(p->pixels * scale, DRAW_LEAST_PX_PER_L);
    enum status status = draw_panel(p->s, frame, px_per_l, &panel, fault);
    if (status)
        return status;
    fprintf(p->out,
            "<image x=\"%.2f\" y=\"%.2f\" width=\"%.2f\" height=\"%.2f\" "
            "preserveAspectRatio=\"none\" href=\"data:image/png;base64,",
            left, top, scale * p->s->width, scale * p->s->height);
    escape_base64(p->out, panel.bytes, panel.length);
    fputs("\"/>\n", p->out);
    free(panel.bytes);
    return STATUS_OK;
}

/* A panel whose upper left corner lies at (left, top) px. */
static enum status put_panel(struct pen *p, size_t frame, double left, double top, double scale,
                             struct fault *fault) {
    double width = scale * p->s->width, height = scale * p->s->height;
    enum status status = STATUS_OK;
    fprintf(p->out, "<rect x=\"%.2f\" y=\"%.2f\" width=\"%.2f\" height=\"%.2f\" fill=\"%s\"/>\n",
            left, top, width, height, draw_ground_colour(p->s));
    if (p->pixels > 0)
        status = put_picture(p, frame, left, top, scale, fault);
    else if (p->s->lit)
        status = put_spheres(p, frame, left, top + height, scale, fault);
    else
        put_grains(p, &p->s->frame[frame], left, top + height, scale);
    fprintf(p->out,
            "<path fill=\"none\" stroke=\"%s\" stroke-width=\"%d\" "
            "d=\"M%.2f,%.2fv%.2fh%.2fv%.2f\"/>\n",
            INK, (int)WALL, left - WALL / 2., top, height + WALL / 2., width + WALL,
            -height - WALL / 2.);
    return status;
}

/* -- words ------------------------------------------------------------------ */

static void put_text(FILE *out, double x, double y, const char *anchor, const char *text) {
    fprintf(out, "<text x=\"%.2f\" y=\"%.2f\" text-anchor=\"%s\">", x, y, anchor);
    escape_markup(out, text);
    fputs("</text>\n", out);
}

static void put_time(FILE *out, const struct report_sequence *s, double time, double x, double y) {
    fprintf(out, "<text x=\"%.2f\" y=\"%.2f\">%.4g ", x, y, time);
    escape_markup(out, s->time_unit);
    fputs("</text>\n", out);
}

/* A square of the colour and its name; returns where the next may begin. */
static double put_swatch(FILE *out, double x, double y, const char *colour, const char *label) {
    size_t letters = 0;
    if (!label || !*label)
        return x;
    for (const char *c = label; *c; c++)
        letters += ((unsigned char)*c & 0xc0) != 0x80;
    fprintf(out,
            "<rect x=\"%.2f\" y=\"%.2f\" width=\"16\" height=\"16\" fill=\"%s\" stroke=\"%s\"/>\n",
            x, y - 13, colour, INK);
    put_text(out, x + 24, y, "start", label);
    return x + 50 + .55 * FONT * (double)letters;
}

static void put_key(FILE *out, const struct report_sequence *s, const struct layout *l) {
    double y = l->height - 20, x = MARGIN, bar = bar_length(s->width);
    char text[32];
    for (size_t k = 0; k < REPORT_KINDS && draw_kind_colour(s, k); k++)
        x = put_swatch(out, x, y, draw_kind_colour(s, k), s->kind_label[k]);
    put_swatch(out, x, y, draw_ground_colour(s), s->ground_label);
    snprintf(text, sizeof text, "%g %s", bar, draw_length_unit(s));
    x = WIDTH - MARGIN - l->scale * bar;
    fprintf(out,
            "<path stroke=\"%s\" stroke-width=\"2\" fill=\"none\" "
            "d=\"M%.2f,%.2fv10m0,-5h%.2fm0,-5v10\"/>\n",
            INK, x, y - 11, l->scale * bar);
    put_text(out, x - 10, y, "end", text);
}

static void put_head(FILE *out, const struct report_sequence *s, double width, double height) {
    fprintf(out,
            "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"%.0f\" height=\"%.0f\" "
            "viewBox=\"0 0 %.0f %.0f\" role=\"img\" font-family=\"system-ui,sans-serif\" "
            "font-size=\"%d\" fill=\"%s\">\n<title>",
            width, height, width, height, (int)FONT, INK);
    escape_markup(out, s->title);
    fputs("</title>\n<desc>", out);
    escape_markup(out, s->alt);
    fprintf(out, "</desc>\n<rect width=\"%.0f\" height=\"%.0f\" fill=\"#ffffff\"/>\n", width,
            height);
}

/* -- the whole -------------------------------------------------------------- */

static enum status check_frame(const struct report_sequence *s, size_t f, struct fault *fault) {
    const struct report_frame *frame = &s->frame[f];
    if (!isfinite(frame->time) || (f > 0 && frame->time <= s->frame[f - 1].time))
        return fault_set(fault, STATUS_BAD_INPUT, "sequence %s: times do not increase at frame %zu",
                         s->name, f);
    if (s->lit && !frame->depth)
        return fault_set(fault, STATUS_BAD_INPUT, "sequence %s: no depths in frame %zu", s->name,
                         f);
    for (size_t i = 0; i < s->count; i++)
        if (!(fabs(frame->position[2 * i]) < 1e5 && fabs(frame->position[2 * i + 1]) < 1e5 &&
              (!s->lit || fabs(frame->depth[i]) < 1e5)))
            return fault_set(fault, STATUS_BAD_INPUT,
                             "sequence %s: grain %zu has no finite place at %g %s", s->name, i,
                             frame->time, s->time_unit);
    return STATUS_OK;
}

enum status draw_check_sequence(const struct report_sequence *s, struct fault *fault) {
    enum status status = STATUS_OK;
    if (!(s->width > 0 && s->height > 0 && s->width < 1e5 && s->height < 1e5))
        return fault_set(fault, STATUS_BAD_INPUT, "sequence %s: no box of %g x %g l can be drawn",
                         s->name, s->width, s->height);
    if (s->count == 0 || s->frame_count == 0)
        return fault_set(fault, STATUS_BAD_INPUT, "sequence %s: %zu grains at %zu times: nothing",
                         s->name, s->count, s->frame_count);
    for (size_t i = 0; i < s->count; i++)
        if (!(s->radius[i] > 0 && s->radius[i] < 1e5) || !draw_kind_colour(s, s->kind[i]))
            return fault_set(fault, STATUS_BAD_INPUT,
                             "sequence %s: grain %zu has no radius and kind", s->name, i);
    for (size_t f = 0; f < s->frame_count && !status; f++)
        status = check_frame(s, f, fault);
    return status;
}

static enum status pen_open(struct pen *p, const struct report_sequence *s, double pixels,
                            struct sheet *svg, struct fault *fault) {
    enum status status = draw_check_sequence(s, fault);
    *p = (struct pen){.s = s, .pixels = pixels, .least = (double)INFINITY};
    if (status)
        return status;
    for (size_t i = 0; i < s->count; i++) {
        p->least = fmin(p->least, s->radius[i]);
        p->most = fmax(p->most, s->radius[i]);
    }
    p->unit = p->most / UNITS;
    p->dot = calloc(s->count, sizeof *p->dot);
    if (!p->dot)
        return fault_set(fault, STATUS_NO_MEMORY, "sequence %s: out of memory", s->name);
    status = sheet_open(svg, fault);
    p->out = svg->out;
    return status;
}

static enum status pen_close(struct pen *p, struct sheet *svg, enum status status,
                             struct fault *fault) {
    free(p->dot);
    if (!p->out)
        return status;
    fputs("</svg>\n", p->out);
    enum status closed = sheet_close(svg, fault);
    status = status ? status : closed;
    if (status)
        sheet_free(svg);
    return status;
}

static enum status draw(const struct report_sequence *s, double pixels, struct sheet *svg,
                        struct fault *fault) {
    struct pen p;
    enum status status = pen_open(&p, s, pixels, svg, fault);
    if (status)
        return pen_close(&p, svg, status, fault);
    struct layout l = lay_out(s);
    put_head(p.out, s, l.width, l.height);
    for (size_t f = 0; f < s->frame_count && !status; f++) {
        double left = l.left + (double)(f % l.columns) * (l.panel_width + l.gap);
        double top = MARGIN + HEAD + (double)(f / l.columns) * (HEAD + l.panel_height + GAP);
        put_time(p.out, s, s->frame[f].time, left, top - 8);
        status = put_panel(&p, f, left, top, l.scale, fault);
    }
    put_key(p.out, s, &l);
    return pen_close(&p, svg, status, fault);
}

enum status draw_sequence(const struct report_sequence *s, struct sheet *svg, struct fault *fault) {
    return draw(s, 0, svg, fault);
}

enum status draw_sequence_small(const struct report_sequence *s, struct sheet *svg,
                                struct fault *fault) {
    return draw(s, s->lit ? PIXELS_LIT : PIXELS, svg, fault);
}

enum status draw_poster(const struct report_sequence *s, struct sheet *svg, struct fault *fault) {
    struct pen p;
    enum status status = pen_open(&p, s, s->lit ? PIXELS_LIT : PIXELS, svg, fault);
    if (status)
        return pen_close(&p, svg, status, fault);
    size_t middle = s->frame_count / 2;
    double scale = fmin((POSTER - 2. * MARGIN) / s->width, TALLEST / s->height);
    double width = scale * s->width + 2 * MARGIN, height = scale * s->height + HEAD + 2 * MARGIN;
    double x = width / 2, y = HEAD + MARGIN + scale * s->height / 2;
    put_head(p.out, s, width, height);
    put_time(p.out, s, s->frame[middle].time, MARGIN, MARGIN + HEAD - 8);
    status = put_panel(&p, middle, MARGIN, MARGIN + HEAD, scale, fault);
    fprintf(p.out,
            "<circle cx=\"%.2f\" cy=\"%.2f\" r=\"44\" fill=\"#ffffff\" fill-opacity=\".9\" "
            "stroke=\"%s\" stroke-width=\"3\"/>\n<path d=\"M%.2f,%.2fl38,22l-38,22z\"/>\n",
            x, y, INK, x - 13, y - 22);
    return pen_close(&p, svg, status, fault);
}
