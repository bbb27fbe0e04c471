/* figure_default.c -- the figure that every case has.
 *
 * For each check that is judged at two points or more along a swept number:
 * measured values with their standard uncertainty and expected values over that
 * parameter, one colour for each setting of the others, and below the residual
 * measured - expected with the margin dashed.  All other checks share one
 * overview: residual in units of the margin, check by check.
 */
#include "validation/figures.h"

#include <math.h>
#include <string.h>

enum { COLOURS = 6 };

/* One setting of the parameters other than the one drawn along. */
struct branch {
    const char *label;
    const char *quantity; /* what is drawn: "settling.speed / settling-own-law-published" */
    size_t count;
    double *x, *measured, *expected, *residual, *error, *tolerance; /* [0 .. count-1] */
};

static enum status no_memory(struct fault *fault) {
    return fault_set(fault, STATUS_NO_MEMORY, "figure: out of memory");
}

static bool is_drawn(const struct figure_input *in, size_t row, const struct case_check *check) {
    return in->row_check[row] == check && in->row_point[row] != NULL;
}

/* The first swept parameter that is a number at every point; NULL: none. */
static const char *find_abscissa(const struct figure_input *in) {
    const struct case_tier *t = in->data->plan->tier;
    for (size_t i = 0; i < t->axis_count; i++) {
        bool numbers = t->axis[i].list->count > 1;
        for (size_t p = 0; p < in->data->point_count; p++)
            numbers &= isfinite(measured_parameter(&in->data->point[p], t->axis[i].name));
        if (numbers)
            return t->axis[i].name;
    }
    return NULL;
}

static struct branch *find_branch(struct branch *list, size_t *count, const char *label) {
    for (size_t i = 0; i < *count; i++) {
        if (strcmp(list[i].label, label) == 0)
            return &list[i];
    }
    if (*count == COLOURS)
        return NULL; /* more would not be told apart */
    list[*count] = (struct branch){.label = label};
    return &list[(*count)++];
}

static bool make_room(struct branch *b, size_t rows, struct arena *a) {
    double **const column[] = {&b->x,        &b->measured, &b->expected,
                               &b->residual, &b->error,    &b->tolerance};
    for (size_t i = 0; i < sizeof column / sizeof *column; i++) {
        if (*column[i] == NULL)
            *column[i] = arena_take(a, rows, sizeof **column[i]);
        if (*column[i] == NULL)
            return false;
    }
    return true;
}

static enum status collect(const struct figure_input *in, const struct case_check *check,
                           const char *along, struct arena *a, struct branch *list, size_t *count,
                           struct fault *fault) {
    *count = 0;
    for (size_t i = 0; i < in->row_count; i++) {
        if (!is_drawn(in, i, check) || !isfinite(in->row[i].measured))
            continue;
        const char *label = figure_point_text(in->data, in->row_point[i], along, a);
        if (label == NULL)
            return no_memory(fault);
        struct branch *b = find_branch(list, count, label);
        if (b == NULL)
            continue;
        if (!make_room(b, in->row_count, a))
            return no_memory(fault);
        const struct report_row *r = &in->row[i];
        b->quantity = r->observable;
        b->x[b->count] = measured_parameter(in->row_point[i], along);
        b->measured[b->count] = r->measured;
        b->expected[b->count] = r->expected;
        b->residual[b->count] = r->measured - r->expected;
        b->error[b->count] = isfinite(r->uncertainty) ? r->uncertainty : 0;
        b->tolerance[b->count] = r->tolerance;
        b->count++;
    }
    return STATUS_OK;
}

static struct report_series series(const char *label, enum series_style style, int colour,
                                   const struct branch *b, const double *y, const double *error) {
    return (struct report_series){label, style, colour, b->count, b->x, y, error};
}

/* The margin on both sides of zero, or on the one that counts. */
static size_t add_margins(const struct branch *b, enum comparison c, int colour, struct arena *a,
                          struct report_series *out) {
    size_t count = 0;
    double *below = arena_take(a, b->count, sizeof *below);
    for (size_t i = 0; below != NULL && i < b->count; i++)
        below[i] = -b->tolerance[i];
    if (c != COMPARE_AT_LEAST)
        out[count++] = series("", SERIES_DASHED, colour, b, b->tolerance, NULL);
    if (c != COMPARE_AT_MOST && below != NULL)
        out[count++] = series("", SERIES_DASHED, colour, b, below, NULL);
    return count;
}

static const char *label_axis(const char *text, const char *unit, struct arena *a) {
    return strcmp(unit, "1") == 0 ? text : arena_text(a, "%s (%s)", text, unit);
}

static enum status draw_check(const struct figure_input *in, const struct case_check *check,
                              const char *along, size_t number, struct figure_output *out,
                              struct fault *fault) {
    struct branch list[COLOURS];
    size_t count = 0, upper = 0, lower = 0;
    enum status status = collect(in, check, along, out->arena, list, &count, fault);
    struct report_panel *panel = arena_take(out->arena, 2, sizeof *panel);
    struct report_series *top = arena_take(out->arena, 2 * COLOURS, sizeof *top);
    struct report_series *rest = arena_take(out->arena, 3 * COLOURS, sizeof *rest);
    if (status != STATUS_OK || count == 0)
        return status;
    if (panel == NULL || top == NULL || rest == NULL)
        return no_memory(fault);
    for (size_t i = 0; i < count; i++) {
        const struct branch *b = &list[i];
        const char *name = *b->label == '\0' ? "measured" : b->label;
        const char *expected =
            *b->label == '\0' ? "expected" : arena_text(out->arena, "%s, expected", b->label);
        top[upper++] = series(name, SERIES_POINTS, (int)i, b, b->measured, b->error);
        top[upper++] = series(expected, SERIES_DASHED, (int)i, b, b->expected, NULL);
        rest[lower++] = series("", SERIES_POINTS, (int)i, b, b->residual, b->error);
        lower += add_margins(b, check->comparison, (int)i, out->arena, &rest[lower]);
    }
    panel[0] =
        (struct report_panel){.y_label = label_axis(list[0].quantity, check->unit, out->arena),
                              .series_count = upper,
                              .series = top};
    panel[1] = (struct report_panel){
        .y_label = "measured - expected", .series_count = lower, .series = rest};
    struct report_figure f = {
        .name = arena_text(out->arena, "check-%zu", number),
        .title = check->name,
        .caption = arena_text(out->arena,
                              "Points: measured, with standard uncertainty; dashed "
                              "above: expected; dashed below: the margin (%s).",
                              case_comparison_name(check->comparison)),
        .alt = arena_text(out->arena, "%s measured and expected over %s, and their difference",
                          check->observable, along),
        .x_label = figure_axis_text(along, out->arena),
        .panel_count = 2,
        .panel = panel};
    if (f.name == NULL || f.caption == NULL || f.alt == NULL || f.x_label == NULL ||
        panel[0].y_label == NULL)
        return no_memory(fault);
    return figure_add(out, &f, fault);
}

/* Residual over margin of every row with numbers, in the order of the table. */
static enum status draw_overview(const struct figure_input *in, struct figure_output *out,
                                 struct fault *fault) {
    struct branch b = {0};
    if (in->row_count == 0)
        return STATUS_OK;
    if (!make_room(&b, in->row_count, out->arena))
        return no_memory(fault);
    for (size_t i = 0; i < in->row_count; i++) {
        const struct report_row *r = &in->row[i];
        if (!isfinite(r->measured) || !isfinite(r->expected) || !(r->tolerance > 0))
            continue;
        b.x[b.count] = (double)i + 1;
        b.residual[b.count] = (r->measured - r->expected) / r->tolerance;
        b.error[b.count] = isfinite(r->uncertainty) ? r->uncertainty / r->tolerance : 0;
        b.tolerance[b.count] = 1;
        b.count++;
    }
    struct report_panel *panel = arena_take(out->arena, 1, sizeof *panel);
    struct report_series *s = arena_take(out->arena, 3, sizeof *s);
    if (panel == NULL || s == NULL)
        return no_memory(fault);
    if (b.count == 0)
        return STATUS_OK;
    s[0] = series("(measured - expected)/margin", SERIES_POINTS, 0, &b, b.residual, b.error);
    size_t count = 1 + add_margins(&b, COMPARE_WITHIN, -1, out->arena, &s[1]);
    *panel = (struct report_panel){
        .y_label = "(measured - expected)/margin", .series_count = count, .series = s};
    struct report_figure f = {
        .name = "overview",
        .title = "All checks, in units of their margin",
        .caption = "One point a row of the table, in its order. `within` passes between the dashed "
                   "lines, `outside` beyond them, `at most` below the upper and `at least` above "
                   "the lower one.",
        .alt = "Residual of every check divided by its margin",
        .x_label = "row of the table",
        .panel_count = 1,
        .panel = panel};
    return figure_add(out, &f, fault);
}

enum status figure_default_build(const struct figure_input *in, struct figure_output *out,
                                 struct fault *fault) {
    const struct case_tier *t = in->data->plan->tier;
    const char *along = find_abscissa(in);
    enum status status = draw_overview(in, out, fault);
    for (size_t i = 0; status == STATUS_OK && along != NULL && i < t->check_count; i++) {
        size_t points = 0;
        for (size_t k = 0; k < in->row_count; k++)
            points += is_drawn(in, k, &t->check[i]);
        if (points > 1 && out->figure_count < FIGURES_MAX)
            status = draw_check(in, &t->check[i], along, i + 1, out, fault);
    }
    return status;
}
