/* figure_bubbles.c -- rise speed of every bubble against sqrt(g D_e), with the fit u = a + c x.
 *
 * One dot a stretch of a bubble's motion, one colour a point, all its seeds; grey crosses at side
 * walls. The fit is drawn with the mean over seeds of the measured a and c. Grey lines: a plane
 * bubble in still surroundings, a semicircle and a cap of 60 degrees, from the prediction.  `of:`
 * names the observable.
 *
 * Source:     Collins, J. Fluid Mech. 22, 763 (1965); docs/theory.md, "Bubbles".
 * Leaves out: bubbles that the observable did not follow long enough to have a speed.
 * Checked by: tests/unit/test_figure_recipes.c.
 */
#include "validation/figure_recipes.h"

#include <math.h>

enum { MAX_POINTS = 6, MAX_PLACES = 1, ANGLES = 2 };

struct drawing {
    const struct figure_input *in;
    struct arena *arena;
    double least, most; /* x of any bubble (U0) */
    size_t dots, series_count;
    struct report_series series[(2 + MAX_PLACES) * MAX_POINTS + ANGLES];
};

static enum status no_memory(struct fault *fault) {
    return fault_set(fault, STATUS_NO_MEMORY, "bubble rise: out of memory");
}

static enum status add(struct drawing *d, const char *label, enum series_style style, int colour,
                       size_t count, const double *x, const double *y, struct fault *fault) {
    if (!label || !x || !y)
        return no_memory(fault);
    d->series[d->series_count++] = (struct report_series){
        .label = label, .style = style, .colour = colour, .count = count, .x = x, .y = y};
    return STATUS_OK;
}

static const struct curve *rise_of(const struct drawing *d, const struct measured_run *run,
                                   size_t where) {
    return run->usable ? figure_curve_find(&run->observable[d->in->observable[0]], "rise", where)
                       : NULL;
}

/* What all seeds of a point saw at one place, as one series; its label from the curve or given. */
static enum status add_dots(struct drawing *d, const struct measured_point *p, size_t where,
                            int colour, const char *label, struct fault *fault) {
    size_t count = 0, used = 0;
    const struct curve *c;
    for (size_t i = 0; i < p->run_count; i++)
        count += (c = rise_of(d, &p->run[i], where)) ? c->count : 0;
    if (count == 0)
        return STATUS_OK;
    double *x = arena_take(d->arena, count, sizeof *x), *y = arena_take(d->arena, count, sizeof *y);
    if (!x || !y)
        return no_memory(fault);
    for (size_t i = 0; i < p->run_count; i++) {
        c = rise_of(d, &p->run[i], where);
        for (size_t k = 0; c && k < c->count; k++, used++) {
            x[used] = c->x[k];
            y[used] = c->y[k];
            d->least = fmin(d->least, x[used]);
            d->most = fmax(d->most, x[used]);
        }
        if (c && where > 0)
            label = c->label;
    }
    d->dots += count;
    return add(d, label, SERIES_POINTS, colour, count, x, y, fault);
}

/* Over the range of all dots so far. */
static enum status add_fit(struct drawing *d, const struct measured_point *p, int colour,
                           struct fault *fault) {
    double error, a = figure_mean(d->in, p, "rise_offset", &error);
    double slope = figure_mean(d->in, p, "rise_coefficient", &error);
    double *line = arena_take(d->arena, 4, sizeof *line);
    if (!isfinite(a) || !isfinite(slope))
        return STATUS_OK;
    if (!line)
        return no_memory(fault);
    for (size_t i = 0; i < 2; i++) {
        line[i] = i == 0 ? d->least : d->most;
        line[2 + i] = a + slope * line[i];
    }
    return add(d, arena_text(d->arena, "u = %.2f + %.2f x", a, slope), SERIES_LINE, colour, 2, line,
               line + 2, fault);
}

/* All dots first: lines go over their whole range. */
static enum status add_points(struct drawing *d, struct fault *fault) {
    const struct measured_case *data = d->in->data;
    enum status status = STATUS_OK;
    bool seen[MAX_POINTS];
    for (size_t i = 0; i < data->point_count && !status; i++) {
        size_t before = d->dots;
        const char *text = figure_point_text(data, &data->point[i], NULL, d->arena);
        if (!text)
            return no_memory(fault);
        status = add_dots(d, &data->point[i], 0, (int)i, *text ? text : "bubbles", fault);
        for (size_t where = 1; where <= MAX_PLACES && !status; where++)
            status = add_dots(d, &data->point[i], where, -1, "", fault);
        seen[i] = d->dots > before;
    }
    for (size_t i = 0; i < data->point_count && !status; i++)
        if (seen[i])
            status = add_fit(d, &data->point[i], (int)i, fault);
    return status;
}

static enum status add_plane(struct drawing *d, double half_angle_deg, const char *shape,
                             enum series_style style, struct fault *fault) {
    const struct prediction *rise = prediction_find("plane-bubble-rise");
    const struct prediction *coefficient = prediction_find("plane-bubble-coefficient");
    double *x = arena_take(d->arena, 4, sizeof *x);
    if (!x)
        return no_memory(fault);
    for (size_t i = 0; i < 2; i++) {
        const double in[] = {i == 0 ? d->least : d->most, half_angle_deg};
        x[i] = in[0];
        x[2 + i] = rise->at(in);
    }
    return add(d, arena_text(d->arena, "%s, c = %.2f", shape, coefficient->at(&half_angle_deg)),
               style, -1, 2, x, x + 2, fault);
}

static enum status draw(struct drawing *d, struct figure_output *out, struct fault *fault) {
    const struct case_figure *wanted = d->in->wanted;
    struct report_panel *panel = arena_take(d->arena, 1, sizeof *panel);
    struct report_series *series = arena_take(d->arena, d->series_count, sizeof *series);
    if (!panel || !series)
        return no_memory(fault);
    for (size_t i = 0; i < d->series_count; i++)
        series[i] = d->series[i];
    *panel = (struct report_panel){
        .y_label = "rise speed (U0)", .series_count = d->series_count, .series = series};
    struct report_figure f = {
        .name = arena_text(d->arena, "bubble-rise-%zu", out->figure_count + 1),
        .title = wanted->title ? wanted->title : "Rise of the bubbles against their size",
        .caption =
            wanted->caption
                ? wanted->caption
                : arena_text(d->arena,
                             "%zu points, each a stretch of a bubble's motion; grey crosses: at "
                             "a side wall, left out of the fits. Coloured lines: u = a + c "
                             "x, a and c as means over seeds. Grey lines: plane bubbles in "
                             "still surroundings; a moving bed adds its own speed.",
                             d->dots),
        .alt = "Rise speed of bubbles over the root of gravity times equivalent diameter",
        .x_label = "x = sqrt(g D_e) (U0), D_e: diameter of the circle of the same area",
        .panel_count = 1,
        .panel = panel};
    return f.name && f.caption ? figure_add(out, &f, fault) : no_memory(fault);
}

static enum status build(const struct figure_input *in, struct figure_output *out,
                         struct fault *fault) {
    struct drawing d = {.in = in, .arena = out->arena, .least = INFINITY};
    enum status status = figure_needs(in, "bubbles", fault);
    if (!status)
        status = figure_at_most(in, MAX_POINTS, fault);
    if (!status)
        status = add_points(&d, fault);
    if (!status && d.dots == 0)
        status = fault_set(fault, STATUS_BAD_INPUT, "no run has a bubble that rises");
    if (!status)
        status = add_plane(&d, 90, "semicircle", SERIES_DASHED, fault);
    if (!status)
        status = add_plane(&d, 60, "cap of 60°", SERIES_LINE, fault);
    return status ? status : draw(&d, out, fault);
}

const struct figure_recipe figure_bubble_rise = {
    .name = "bubble-rise",
    .title = "Rise speed of bubbles against sqrt(g D_e), with the fit",
    .observables = 1,
    .build = build,
};
