/* figure.c -- one report_figure as a gnuplot script; see draw.h. */
#include "report/draw.h"
#include "report/gnuplot.h"
#include "report/thin.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum {
    WIDTH = 760, /* all of these in px of the drawing */
    LEFT = 108,
    RIGHT = 24,
    TOP = 14,
    KEY_ROW = 24,
    GAP = 20,
    BOTTOM = 68,
    FONT = 15,
    CHARACTER = 10, /* of the key, on average */
    KEY_SAMPLE = 64,
    NAME_CHARACTER = 9, /* of names on the x axis */
    MAX_NAME = 22,
    MAX_PANELS = 3,
    TALLEST = 360
};

static const double POINT = .9, SMALL_POINT = .5; /* gnuplot's unit */

struct range {
    double low, high;
};

struct layout {
    double height, top[MAX_PANELS], bottom[MAX_PANELS]; /* px from above */
    int key_count, key_columns;
};

static const char *colour_of(int colour) {
    static const char *const house[] = {"#0072B2", "#D55E00", "#009E73",
                                        "#CC79A7", "#E69F00", "#56B4E9"};
    return colour < 0 ? "#666666" : house[colour % 6];
}

/* Shapes differ too, for print without colour. */
static int shape_of(int colour) {
    static const int shape[] = {7, 5, 9, 13, 11, 6};
    return colour < 0 ? 2 : shape[colour % 6];
}

static bool has_points(const struct report_series *s) {
    return s->style == SERIES_POINTS || s->style == SERIES_DOTS || s->style == SERIES_LINE_POINTS;
}

static bool is_drawable(const struct report_figure *f, const struct report_panel *p,
                        const struct report_series *s, size_t i) {
    return isfinite(s->x[i]) && isfinite(s->y[i]) && (!f->x_log || s->x[i] > 0) &&
           (!p->y_log || s->y[i] > 0);
}

static size_t count_drawable(const struct report_figure *f, const struct report_panel *p,
                             const struct report_series *s) {
    size_t count = 0;
    for (size_t i = 0; i < s->count; i++)
        count += is_drawable(f, p, s, i);
    return count;
}

static double error_of(const struct report_series *s, size_t i) {
    return s->error && isfinite(s->error[i]) ? fabs(s->error[i]) : 0;
}

static void range_hold(struct range *r, double value) {
    r->low = fmin(r->low, value);
    r->high = fmax(r->high, value);
}

/* Room around the data; a range of no or one value becomes a proper one. */
static struct range range_padded(struct range r, bool is_log, double part) {
    if (r.low > r.high)
        return is_log ? (struct range){1, 10} : (struct range){0, 1};
    if (is_log) {
        double factor = fmax(pow(r.high / r.low, part), 1.1);
        return (struct range){r.low / factor, r.high * factor};
    }
    double size = fmax(fabs(r.low), fabs(r.high)), pad = part * (r.high - r.low);
    if (r.high - r.low < 1e-6 * size || size == 0)
        pad = size > 0 ? .05 * size : 1;
    bool from_zero = r.low >= 0 && r.low < pad; /* nothing is below 0: no room for it */
    return (struct range){from_zero ? 0 : r.low - pad, r.high + pad};
}

static struct range x_range(const struct report_figure *f) {
    struct range r = {(double)INFINITY, -(double)INFINITY};
    for (size_t p = 0; p < f->panel_count; p++) {
        for (size_t k = 0; k < f->panel[p].series_count; k++) {
            const struct report_series *s = &f->panel[p].series[k];
            for (size_t i = 0; i < s->count; i++) {
                if (is_drawable(f, &f->panel[p], s, i))
                    range_hold(&r, s->x[i]);
            }
        }
    }
    if (f->x_name_count > 0)
        return (struct range){-.6, (double)f->x_name_count - .4};
    return range_padded(r, f->x_log, .03);
}

static struct range y_range(const struct report_figure *f, const struct report_panel *p) {
    struct range r = {(double)INFINITY, -(double)INFINITY};
    bool given = p->y_min < p->y_max && (!p->y_log || p->y_min > 0);
    for (size_t k = 0; k < p->series_count; k++) {
        const struct report_series *s = &p->series[k];
        for (size_t i = 0; i < s->count; i++) {
            if (!is_drawable(f, p, s, i) || (given && !has_points(s)))
                continue;
            range_hold(&r, s->y[i] + error_of(s, i));
            if (!p->y_log || s->y[i] > error_of(s, i))
                range_hold(&r, s->y[i] - error_of(s, i));
            else
                range_hold(&r, s->y[i]);
        }
    }
    if (!given)
        return range_padded(r, p->y_log, .08);
    bool is_wider = r.low < p->y_min || r.high > p->y_max;
    range_hold(&r, p->y_min);
    range_hold(&r, p->y_max);
    return is_wider ? range_padded(r, p->y_log, .03) : r;
}

/* -- the key ---------------------------------------------------------------- */

static bool same_entry(const struct report_series *a, const struct report_series *b) {
    return a->colour == b->colour && strcmp(a->label, b->label) == 0;
}

/* Shown once, though both panels have it. */
static bool is_first_of_its_kind(const struct report_figure *f, size_t panel, size_t series) {
    const struct report_series *s = &f->panel[panel].series[series];
    if (!s->label || !*s->label)
        return false;
    for (size_t p = 0; p <= panel; p++) {
        size_t end = p < panel ? f->panel[p].series_count : series;
        for (size_t k = 0; k < end; k++) {
            if (f->panel[p].series[k].label && same_entry(&f->panel[p].series[k], s))
                return false;
        }
    }
    return true;
}

static int character_count(const char *text) {
    int count = 0;
    for (; *text; text++)
        count += ((unsigned char)*text & 0xc0) != 0x80;
    return count;
}

/* Hundreds of points hide each other: they become small. */
enum { CROWD = 150 };

static void put_style(FILE *out, const struct report_series *s, double size) {
    const char *colour = colour_of(s->colour);
    size *= s->style == SERIES_DOTS || s->count > CROWD ? 0.4 : 1;
    if (s->count == 1 && (s->style == SERIES_LINE || s->style == SERIES_DASHED)) {
        /* A line of one point would not be seen. */
        fprintf(out, "points pt %d ps %.2g lw 2 lc rgb '%s'", s->style == SERIES_LINE ? 1 : 2,
                1.5 * size, colour);
        return;
    }
    switch (s->style) {
    case SERIES_POINTS:
    case SERIES_DOTS:
        fprintf(out, "points pt %d ps %.2g lc rgb '%s'", shape_of(s->colour), size, colour);
        break;
    case SERIES_LINE:
        fprintf(out, "lines lw 2 lc rgb '%s'", colour);
        break;
    case SERIES_DASHED:
        fprintf(out, "lines lw 2 dt (9,6) lc rgb '%s'", colour);
        break;
    case SERIES_LINE_POINTS:
        fprintf(out, "linespoints lw 1.5 pt %d ps %.2g lc rgb '%s'", shape_of(s->colour), size,
                colour);
        break;
    }
}

static void put_key_entries(FILE *out, const struct report_figure *f) {
    for (size_t p = 0; p < f->panel_count; p++) {
        for (size_t k = 0; k < f->panel[p].series_count; k++) {
            if (!is_first_of_its_kind(f, p, k))
                continue;
            fprintf(out, ", keyentry with ");
            put_style(out, &f->panel[p].series[k], POINT);
            fprintf(out, " title ");
            gnuplot_put_text(out, f->panel[p].series[k].label);
        }
    }
}

/* Characters of the longest name on the x axis, as it is drawn. */
static int longest_name(const struct report_figure *f) {
    int longest = 0;
    for (size_t i = 0; i < f->x_name_count; i++) {
        int length = character_count(f->x_name[i]);
        longest = length > longest ? length : longest;
    }
    return longest < MAX_NAME ? longest : MAX_NAME;
}

/* Names that would run into each other stand at a slope. */
static bool names_are_sloped(const struct report_figure *f) {
    return longest_name(f) * NAME_CHARACTER * (int)f->x_name_count > WIDTH - LEFT - RIGHT;
}

static struct layout lay_out(const struct report_figure *f) {
    static const double tall[MAX_PANELS] = {TALLEST, 300, 270}, low = 150;
    struct layout l = {0};
    int longest = 1;
    for (size_t p = 0; p < f->panel_count; p++) {
        for (size_t k = 0; k < f->panel[p].series_count; k++) {
            if (!is_first_of_its_kind(f, p, k))
                continue;
            int length = character_count(f->panel[p].series[k].label);
            longest = length > longest ? length : longest;
            l.key_count++;
        }
    }
    l.key_columns = (WIDTH - LEFT - RIGHT) / (CHARACTER * longest + KEY_SAMPLE);
    l.key_columns = l.key_columns < 1 ? 1 : l.key_columns > 3 ? 3 : l.key_columns;
    int rows = (l.key_count + l.key_columns - 1) / l.key_columns;
    double y = TOP + KEY_ROW * rows + (rows > 0 ? 6 : 0);
    for (size_t p = 0; p < f->panel_count; p++) {
        l.top[p] = y;
        l.bottom[p] = y + (p == 0 ? tall[f->panel_count - 1] : low);
        y = l.bottom[p] + GAP;
    }
    l.height = y - GAP + BOTTOM;
    if (names_are_sloped(f))
        l.height += .45 * NAME_CHARACTER * longest_name(f);
    return l;
}

/* -- axes ------------------------------------------------------------------- */

static double nice_step(double span) {
    double raw = span / 5, decade = pow(10, floor(log10(raw))), part = raw / decade;
    return decade * (part < 1.5 ? 1 : part < 3.5 ? 2 : part < 7.5 ? 5 : 10);
}

/* gnuplot labels decades only: on a short logarithmic axis that is one number or none. */
static void put_log_tics(FILE *out, char axis, struct range r) {
    static const double dense[] = {1, 2, 3, 4, 5, 6, 8}, thin[] = {1, 2, 5};
    double ratio = r.high / r.low;
    const double *part = ratio < 20 ? dense : thin;
    size_t parts = ratio < 20 ? sizeof dense / sizeof *dense : sizeof thin / sizeof *thin;
    if (ratio > 1000) {
        fprintf(out, "set format %c '10^{%%T}'\nset %ctics enhanced\n", axis, axis);
        return;
    }
    fprintf(out, "set %ctics (%.9g", axis, r.low / 10); /* off the axis: keeps the list valid */
    if (ratio < 2.5) {
        double step = nice_step(r.high - r.low);
        for (double k = ceil(r.low / step); k * step <= r.high; k++)
            fprintf(out, ", %.9g", k * step);
    } else {
        for (double decade = pow(10, floor(log10(r.low))); decade <= r.high; decade *= 10) {
            for (size_t i = 0; i < parts; i++)
                fprintf(out, ", %.9g", part[i] * decade);
        }
    }
    fprintf(out, ")\n");
}

static void put_axis(FILE *out, char axis, bool is_log, struct range r) {
    fprintf(out, "set %ctics autofreq\nset format %c '%%g'\nunset logscale %c\n", axis, axis, axis);
    if (is_log) {
        fprintf(out, "set logscale %c\n", axis);
        put_log_tics(out, axis, r);
    }
    fprintf(out, "set %crange [%.12g:%.12g]\n", axis, r.low, r.high);
}

/* The name, or its beginning. */
static void put_name(FILE *out, const char *name) {
    char text[4 * MAX_NAME + 8];
    size_t bytes = 0;
    int count = 0;
    if (character_count(name) <= MAX_NAME) {
        gnuplot_put_text(out, name);
        return;
    }
    for (; count < MAX_NAME && name[bytes] != '\0'; count++)
        do
            bytes++;
        while (((unsigned char)name[bytes] & 0xc0) == 0x80);
    snprintf(text, sizeof text, "%.*s…", (int)bytes, name);
    gnuplot_put_text(out, text);
}

static void put_names(FILE *out, const struct report_figure *f, bool shown) {
    fprintf(out, "set xtics noenhanced %s (",
            names_are_sloped(f) ? "rotate by 27 right" : "norotate");
    for (size_t i = 0; i < f->x_name_count; i++) {
        if (i > 0)
            fprintf(out, ", ");
        put_name(out, shown ? f->x_name[i] : "");
        fprintf(out, " %zu", i);
    }
    fprintf(out, ")\n");
}

/* Labels stand at fixed places: gnuplot's own move with the width of the numbers, and are left
 * out when it finds the margin too small. */
static void put_labels(FILE *out, const struct report_figure *f, const struct layout *l,
                       size_t panel) {
    fprintf(out, "set label 2 ");
    gnuplot_put_text(out, f->panel[panel].y_label);
    fprintf(out, " noenhanced center rotate by 90 at screen %.6f,%.6f\n", 20. / WIDTH,
            1 - (l->top[panel] + l->bottom[panel]) / 2 / l->height);
    if (panel + 1 < f->panel_count)
        return;
    fprintf(out, "set label 3 ");
    gnuplot_put_text(out, f->x_label);
    fprintf(out, " noenhanced center at screen %.6f,%.6f\n", (LEFT + WIDTH - RIGHT) / 2. / WIDTH,
            18 / l->height);
}

/* -- data ------------------------------------------------------------------- */

static const double UNSEEN_PX = .15;

static double place_px(double value, struct range r, bool is_log, double size_px) {
    if (is_log)
        return log(value / r.low) / log(r.high / r.low) * size_px;
    return (value - r.low) / (r.high - r.low) * size_px;
}

/* keep[0 .. count-1]: the points of a line that are needed to see it; all of what has points. */
static void choose_points(const struct report_figure *f, const struct report_panel *p,
                          const struct report_series *s, struct range x, struct range y,
                          struct thin_point *point, bool *keep) {
    for (size_t i = 0; i < s->count; i++)
        keep[i] = true;
    for (size_t from = 0, to; !has_points(s) && from < s->count; from = to + 1) {
        for (to = from; to < s->count && is_drawable(f, p, s, to); to++) {
            double value[THIN_CURVES] = {s->y[to], s->y[to] - error_of(s, to),
                                         s->y[to] + error_of(s, to)};
            point[to].x = place_px(s->x[to], x, f->x_log, WIDTH);
            for (size_t c = 0; c < THIN_CURVES; c++)
                point[to].y[c] =
                    place_px(p->y_log ? fmax(value[c], y.low) : value[c], y, p->y_log, TALLEST);
        }
        thin_curve(&point[from], to - from, UNSEEN_PX, &keep[from]);
    }
}

static void put_points(FILE *out, const struct report_figure *f, const struct report_panel *p,
                       const struct report_series *s, double lowest, const bool *keep) {
    for (size_t i = 0; i < s->count; i++) {
        if (!keep[i])
            continue;
        if (!is_drawable(f, p, s, i)) {
            fprintf(out, "NaN NaN NaN NaN\n");
            continue;
        }
        double low = s->y[i] - error_of(s, i);
        if (p->y_log)
            low = fmax(low, lowest);
        fprintf(out, "%.9g %.9g %.9g %.9g\n", s->x[i], s->y[i], low, s->y[i] + error_of(s, i));
    }
}

static enum status put_data(FILE *out, const struct report_figure *f, size_t panel,
                            struct fault *fault) {
    const struct report_panel *p = &f->panel[panel];
    struct range x = x_range(f), y = y_range(f, p);
    for (size_t k = 0; k < p->series_count; k++) {
        const struct report_series *s = &p->series[k];
        if (count_drawable(f, p, s) == 0)
            continue;
        struct thin_point *point = calloc(s->count, sizeof *point);
        bool *keep = calloc(s->count, sizeof *keep);
        if (point && keep) {
            choose_points(f, p, s, x, y, point, keep);
            fprintf(out, "$data_%zu_%zu << EOD\n", panel, k);
            put_points(out, f, p, s, y.low, keep);
            fprintf(out, "EOD\n");
        }
        bool is_done = point && keep;
        free(point);
        free(keep);
        if (!is_done)
            return fault_set(fault, STATUS_NO_MEMORY, "figure %s: out of memory", f->name);
    }
    return STATUS_OK;
}

/* Uncertainty: a band around a line, bars on points (vectors with flat heads: around the points
 * of its own error bars gnuplot wipes a white disc, and with it short bars).  A low panel has
 * smaller points, so that short bars are seen. */
static void put_series(FILE *out, const struct report_series *s, size_t panel, size_t k) {
    double size = panel == 0 ? POINT : SMALL_POINT;
    const char *colour = colour_of(s->colour);
    if (s->error && !has_points(s))
        fprintf(out,
                ", $data_%zu_%zu using 1:3:4 with filledcurves fc rgb '%s' fs transparent solid .2 "
                "noborder notitle",
                panel, k, colour);
    if (s->error && has_points(s))
        fprintf(out,
                ", $data_%zu_%zu using 1:3:(0):($4-$3) with vectors heads size screen .006,90 "
                "nofilled lw 1.5 lc rgb '%s' notitle",
                panel, k, colour);
    fprintf(out, ", $data_%zu_%zu using 1:2 with ", panel, k);
    put_style(out, s, size);
    fprintf(out, " notitle");
}

static void put_panel(FILE *out, const struct report_figure *f, const struct layout *l,
                      size_t panel, struct range x) {
    const struct report_panel *p = &f->panel[panel];
    bool is_last = panel + 1 == f->panel_count, is_empty = true;
    struct range y = y_range(f, p);
    fprintf(out, "set tmargin at screen %.6f\nset bmargin at screen %.6f\n",
            1 - l->top[panel] / l->height, 1 - l->bottom[panel] / l->height);
    put_axis(out, 'x', f->x_log, x);
    put_axis(out, 'y', p->y_log, y);
    put_labels(out, f, l, panel);
    if (f->x_name_count > 0)
        put_names(out, f, is_last);
    else if (!is_last)
        fprintf(out, "set format x ''\n");
    if (panel > 0 && !p->y_log)
        fprintf(out, "set ytics autofreq %.9g\n", nice_step(y.high - y.low));
    fprintf(out, "%s", p->y_log ? "unset xzeroaxis\n" : "set xzeroaxis lw 1 lc rgb '#888888'\n");
    for (size_t k = 0; k < p->series_count; k++)
        is_empty &= count_drawable(f, p, &p->series[k]) == 0;
    if (is_empty)
        fprintf(out, "set label 1 'no data' at graph .5,.5 center tc rgb '#444444'\n");
    fprintf(out, "plot NaN notitle");
    if (panel == 0)
        put_key_entries(out, f);
    for (size_t k = 0; k < p->series_count; k++) {
        if (count_drawable(f, p, &p->series[k]) > 0)
            put_series(out, &p->series[k], panel, k);
    }
    fprintf(out, "\nunset label 1\n");
}

static enum status put_script(FILE *out, const struct report_figure *f, struct fault *fault) {
    enum status status = STATUS_OK;
    struct layout l = lay_out(f);
    struct range x = x_range(f);
    fprintf(out, "set terminal svg size %d,%.0f font 'sans-serif,%d' background '#ffffff'\n", WIDTH,
            l.height, FONT);
    fprintf(out,
            "set encoding utf8\nset border 3 lw 1 lc rgb '#444444'\nset tics out nomirror scale "
            ".5\nset pointintervalbox 0\n"
            "set grid lw .7 lc rgb '#dddddd'\nset key at screen .5,%.6f center top horizontal "
            "Left reverse noenhanced samplen 2.5 spacing 1.2 maxcols %d\n",
            1 - (TOP - 6) / l.height, l.key_columns);
    for (size_t p = 0; p < f->panel_count && !status; p++)
        status = put_data(out, f, p, fault);
    fprintf(out, "set multiplot\nset lmargin at screen %.6f\nset rmargin at screen %.6f\n",
            (double)LEFT / WIDTH, 1 - (double)RIGHT / WIDTH);
    for (size_t p = 0; p < f->panel_count; p++)
        put_panel(out, f, &l, p, x);
    fprintf(out, "unset multiplot\n");
    return status;
}

static enum status check(const struct report_figure *f, struct fault *fault) {
    if (f->panel_count < 1 || f->panel_count > MAX_PANELS)
        return fault_set(fault, STATUS_BAD_INPUT, "figure %s: %zu panels; 1 to %d can be drawn",
                         f->name, f->panel_count, MAX_PANELS);
    enum status status = gnuplot_check_text(f->x_label, "x label", fault);
    for (size_t i = 0; i < f->x_name_count && !status; i++)
        status = gnuplot_check_text(f->x_name[i], "name on the x axis", fault);
    for (size_t p = 0; p < f->panel_count && !status; p++) {
        status = gnuplot_check_text(f->panel[p].y_label, "y label", fault);
        for (size_t k = 0; k < f->panel[p].series_count && !status; k++)
            status = gnuplot_check_text(f->panel[p].series[k].label, "label of a series", fault);
    }
    return status ? fault_within(fault, "figure %s", f->name) : STATUS_OK;
}

enum status draw_figure(const struct report_figure *f, const char *prefix, struct sheet *svg,
                        struct fault *fault) {
    struct sheet script = {0};
    char *file = NULL;
    size_t length;
    enum status status = check(f, fault);
    if (status)
        return status;
    if ((status = sheet_open(&script, fault)))
        return status;
    if ((status = put_script(script.out, f, fault)) || (status = sheet_close(&script, fault)))
        goto done;
    if ((status = gnuplot_run(&script, &file, &length, fault))) {
        fault_within(fault, "figure %s", f->name);
        goto done;
    }
    status = draw_embed_svg(file, f, prefix, svg, fault);
done:
    free(file);
    sheet_free(&script);
    return status;
}
