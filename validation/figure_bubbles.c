/* figure_bubbles.c -- rise speed of every bubble against sqrt(g D_e), with the fit u = a + c x.
 *
 * One dot a bubble, one colour a point, all its seeds; the fit is drawn with the mean over seeds of
 * the measured a and c.  Dashed: a plane bubble in still surroundings, a semicircle and a cap of
 * 60 degrees, from the prediction.  `of:` names the observable.
 *
 * Source:     Collins, J. Fluid Mech. 22, 763 (1965); docs/theory.md, "Bubbles".
 * Leaves out: bubbles that the observable did not follow long enough to have a speed.
 * Checked by: tests/unit/test_figure_recipes.c.
 */
#include "validation/figure_recipes.h"

#include <math.h>

enum { MAX_POINTS = 6, ANGLES = 2 };

struct drawing {
    const struct figure_input *in;
    struct arena *arena;
    double least, most; /* x of any bubble (U0) */
    size_t bubbles, series_count;
    struct report_series series[2 * MAX_POINTS + ANGLES];
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

static const struct curve *rise_of(const struct drawing *d, const struct measured_run *run) {
    return run->usable ? figure_curve_find(&run->observable[d->in->observable[0]], "rise", 0)
                       : NULL;
}

/* All bubbles of a point's seeds as one series; the fit as its key says. */
static enum status add_point(struct drawing *d, const struct measured_point *p, int colour,
                             struct fault *fault) {
    size_t count = 0, used = 0;
    const struct curve *c;
    for (size_t i = 0; i < p->run_count; i++)
        count += (c = rise_of(d, &p->run[i])) ? c->count : 0;
    if (count == 0)
        return STATUS_OK;
    double *x = arena_take(d->arena, count, sizeof *x), *y = arena_take(d->arena, count, sizeof *y);
    if (!x || !y)
        return no_memory(fault);
    double least = INFINITY, most = 0;
    for (size_t i = 0; i < p->run_count; i++)
        for (size_t k = 0; (c = rise_of(d, &p->run[i])) && k < c->count; k++, used++) {
            x[used] = c->x[k];
            y[used] = c->y[k];
            least = fmin(least, x[used]);
            most = fmax(most, x[used]);
        }
    d->bubbles += count;
    d->least = fmin(d->least, least);
    d->most = fmax(d->most, most);
    const char *text = figure_point_text(d->in->data, p, NULL, d->arena);
    enum status status =
        add(d, text && !*text ? "bubbles" : text, SERIES_POINTS, colour, count, x, y, fault);
    double error, a = figure_mean(d->in, p, "rise_offset", &error);
    double slope = figure_mean(d->in, p, "rise_coefficient", &error);
    double *line = arena_take(d->arena, 4, sizeof *line);
    if (status || !isfinite(a) || !isfinite(slope))
        return status;
    if (!line)
        return no_memory(fault);
    for (size_t i = 0; i < 2; i++) {
        line[i] = i == 0 ? least : most;
        line[2 + i] = a + slope * line[i];
    }
    return add(d, arena_text(d->arena, "u = %.2f + %.2f x", a, slope), SERIES_LINE, colour, 2, line,
               line + 2, fault);
}

static enum status add_plane(struct drawing *d, double half_angle_deg, const char *shape, int style,
                             struct fault *fault) {
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
    return add(d,
               arena_text(d->arena, "plane %s, c = %.2f", shape, coefficient->at(&half_angle_deg)),
               SERIES_DASHED, style, 2, x, x + 2, fault);
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
        .caption = wanted->caption
                       ? wanted->caption
                       : arena_text(d->arena,
                                    "%zu bubbles, one point each. Lines: fits u = a + c x, a and c "
                                    "as means over seeds. Dashed: plane bubbles in still "
                                    "surroundings; a moving bed adds its own speed.",
                                    d->bubbles),
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
    if (!status && in->data->point_count > MAX_POINTS)
        status = fault_set(fault, STATUS_BAD_INPUT,
                           "%zu points cannot be told apart in one figure, %d can: choose with "
                           "`points`",
                           in->data->point_count, (int)MAX_POINTS);
    for (size_t i = 0; i < in->data->point_count && !status; i++)
        status = add_point(&d, &in->data->point[i], (int)i, fault);
    if (!status && d.bubbles == 0)
        status = fault_set(fault, STATUS_BAD_INPUT, "no run has a bubble that rises");
    if (!status)
        status = add_plane(&d, 90, "semicircle", -1, fault);
    if (!status)
        status = add_plane(&d, 60, "cap of 60 degrees", -2, fault);
    return status ? status : draw(&d, out, fault);
}

const struct figure_recipe figure_bubble_rise = {
    .name = "bubble-rise",
    .title = "Rise speed of bubbles against sqrt(g D_e), with the fit",
    .observables = 1,
    .build = build,
};
