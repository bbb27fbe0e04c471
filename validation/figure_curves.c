/* figure_curves.c -- one named curve of an observable, for all points shown.
 *
 * Seeds that have the same abscissae (samples of a run) are averaged: a line with the standard
 * error as a band.  Seeds that have not (something that is not always there) are drawn one by one
 * in the colour of their point.  The key names what tells the points apart.
 *
 * Leaves out: points without the curve.
 * Checked by: tests/unit/test_figure_recipes.c.
 */
#include "validation/figure_recipes.h"

#include <ctype.h>
#include <gsl/gsl_statistics_double.h>
#include <math.h>
#include <string.h>

enum { COLOURS = 6, MAX_POINTS = 2 * COLOURS, MAX_SEEDS = 256, MAX_SERIES = 512 };
enum { CURVE, X_LABEL, Y_LABEL }; /* settings */

struct drawing {
    const struct figure_input *in;
    struct arena *arena;
    const char *name; /* of the curve */
    size_t series_count;
    size_t first, drawn;   /* number of the point's first colour; curves of the point so far */
    size_t others;         /* curves so far of points that have several of the name */
    bool averaged, single; /* some point is a mean; some is drawn seed by seed */
    struct report_series *series; /* series[0 .. series_count-1], room for MAX_SERIES */
};

static enum status no_memory(struct fault *fault) {
    return fault_set(fault, STATUS_NO_MEMORY, "curves: out of memory");
}

/* The nth curve of each usable seed that has it: curve[0 .. return-1]. */
static size_t collect(const struct drawing *d, const struct measured_point *p, size_t nth,
                      const struct curve **curve) {
    size_t count = 0;
    for (size_t i = 0; i < p->run_count && count < MAX_SEEDS; i++) {
        const struct curve *c =
            p->run[i].usable
                ? figure_curve_find(&p->run[i].observable[d->in->observable[0]], d->name, nth)
                : NULL;
        if (c != NULL && c->count > 0)
            curve[count++] = c;
    }
    return count;
}

static bool have_same_abscissae(const struct curve *const *curve, size_t count) {
    for (size_t i = 1; i < count; i++) {
        if (curve[i]->count != curve[0]->count)
            return false;
        double span = fabs(curve[0]->x[curve[0]->count - 1] - curve[0]->x[0]);
        for (size_t k = 0; k < curve[i]->count; k++)
            if (!(fabs(curve[i]->x[k] - curve[0]->x[k]) <= 1e-9 * span))
                return false;
    }
    return true;
}

static struct report_series *next_series(struct drawing *d, const char *label) {
    size_t number = d->first + d->drawn;
    if (d->series_count == MAX_SERIES)
        return NULL;
    struct report_series *s = &d->series[d->series_count++];
    *s = (struct report_series){.label = label,
                                .style = number < COLOURS ? SERIES_LINE : SERIES_DASHED,
                                .colour = (int)(number % COLOURS)};
    return s;
}

static enum status add_mean(struct drawing *d, const struct curve *const *curve, size_t count,
                            const char *label, struct fault *fault) {
    size_t length = curve[0]->count;
    double *y = arena_take(d->arena, length, sizeof *y), at[MAX_SEEDS];
    double *error = count > 1 ? arena_take(d->arena, length, sizeof *error) : NULL;
    struct report_series *s = next_series(d, label);
    if (!y || (count > 1 && !error))
        return no_memory(fault);
    if (!s)
        return fault_set(fault, STATUS_BAD_INPUT, "more than %d curves", (int)MAX_SERIES);
    for (size_t k = 0; k < length; k++) {
        for (size_t i = 0; i < count; i++)
            at[i] = curve[i]->y[k];
        y[k] = gsl_stats_mean(at, 1, count);
        if (error)
            error[k] = gsl_stats_sd_m(at, 1, count, y[k]) / sqrt((double)count);
    }
    s->count = length;
    s->x = curve[0]->x;
    s->y = y;
    s->error = error;
    d->averaged |= count > 1;
    return STATUS_OK;
}

static enum status add_each(struct drawing *d, const struct curve *const *curve, size_t count,
                            const char *label, struct fault *fault) {
    for (size_t i = 0; i < count; i++) {
        struct report_series *s = next_series(d, i == 0 ? label : "");
        if (!s)
            return fault_set(fault, STATUS_BAD_INPUT, "more than %d curves", (int)MAX_SERIES);
        s->count = curve[i]->count;
        s->x = curve[i]->x;
        s->y = curve[i]->y;
    }
    d->single = true;
    return STATUS_OK;
}

/* "flux 0.2 l/tau"; with the curve's own label where a run has several of one name. */
static const char *label_of(struct drawing *d, const struct measured_point *p,
                            const struct curve *c, bool several) {
    const char *text = figure_point_text(d->in->data, p, NULL, d->arena);
    if (!several || text == NULL)
        return text;
    return arena_text(d->arena, "%s%s%s", text, *text ? ", " : "", c->label);
}

/* A point has the colour of its place among the points, whether those before it have the curve or
 * not: the same in all figures of these points. */
static enum status add_point(struct drawing *d, const struct measured_point *p,
                             struct fault *fault) {
    const struct curve *curve[MAX_SEEDS], *more[MAX_SEEDS];
    enum status status = STATUS_OK;
    bool several = collect(d, p, 1, more) > 0;
    d->first = several ? d->others : (size_t)(p - d->in->data->point);
    d->drawn = 0;
    for (size_t nth = 0, count; !status && (count = collect(d, p, nth, curve)) > 0; nth++) {
        const char *label = label_of(d, p, curve[0], several);
        if (!label)
            return no_memory(fault);
        if (d->first + d->drawn >= MAX_POINTS)
            return fault_set(fault, STATUS_BAD_INPUT,
                             "more than %d curves cannot be told apart: choose with `points`",
                             (int)MAX_POINTS);
        status = have_same_abscissae(curve, count) ? add_mean(d, curve, count, label, fault)
                                                   : add_each(d, curve, count, label, fault);
        d->drawn++;
    }
    d->others += several ? d->drawn : 0;
    return status;
}

static const char *title_of(const struct drawing *d) {
    if (d->in->wanted->title)
        return d->in->wanted->title;
    char *title = arena_copy(d->arena, d->name);
    if (title)
        title[0] = (char)toupper((unsigned char)title[0]);
    return title;
}

static const char *caption_of(const struct drawing *d) {
    const char *own = d->in->wanted->caption;
    const char *seeds = d->averaged && d->single
                            ? "Lines: means over seeds, with their standard error, or, where seeds "
                              "have different times, one line a seed."
                        : d->averaged ? "Lines: means over seeds, with their standard error."
                        : d->single   ? "One line a seed."
                                      : "";
    return arena_text(d->arena, "%s%s%s", own ? own : "", own && *seeds ? " " : "", seeds);
}

static enum status build(const struct figure_input *in, struct figure_output *out,
                         struct fault *fault) {
    const struct case_figure_setting *setting = in->wanted->setting;
    struct drawing d = {.in = in, .arena = out->arena, .name = setting[CURVE].text};
    struct report_panel *panel = arena_take(d.arena, 1, sizeof *panel);
    enum status status = STATUS_OK;
    d.series = arena_take(d.arena, MAX_SERIES, sizeof *d.series);
    if (!panel || !d.series)
        return no_memory(fault);
    for (size_t i = 0; i < in->data->point_count && !status; i++)
        status = add_point(&d, &in->data->point[i], fault);
    if (status)
        return status;
    if (d.series_count == 0)
        return fault_set(fault, STATUS_BAD_INPUT, "no run has the curve \"%s\"", d.name);
    *panel = (struct report_panel){
        .y_label = setting[Y_LABEL].text, .series_count = d.series_count, .series = d.series};
    struct report_figure f = {
        .name = arena_text(d.arena, "curves-%zu", out->figure_count + 1),
        .title = title_of(&d),
        .caption = caption_of(&d),
        .alt = arena_text(d.arena, "%s over %s", d.name,
                          setting[X_LABEL].text ? setting[X_LABEL].text : "time"),
        .x_label = setting[X_LABEL].text ? setting[X_LABEL].text : "time (tau)",
        .panel_count = 1,
        .panel = panel};
    if (!f.name || !f.title || !f.caption || !f.alt)
        return no_memory(fault);
    return figure_add(out, &f, fault);
}

const struct figure_recipe figure_curves = {
    .name = "curves",
    .title = "A curve of an observable, for every point shown",
    .observables = 1,
    .setting = {{"curve", "its name", FIGURE_CURVE, true, 0, 0, 0},
                {"x", "label of its x axis; without it: time (tau)", FIGURE_TEXT, false, 0, 0, 0},
                {"y", "label of its y axis, with the unit", FIGURE_TEXT, true, 0, 0, 0}},
    .build = build,
};
