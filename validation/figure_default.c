/* figure_default.c -- the figure that every case has.
 *
 * For each check that is judged at two points or more along a swept parameter:
 * measured values with their standard uncertainty and expected values over that
 * parameter, one colour for each setting of the others, and below the residual
 * measured - expected with the margin dashed.  Numbers are preferred; labels and
 * words stand side by side, what is expected as a short line at each.  All
 * checks share one overview: residual in units of the margin, check by check.
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

/* What a check is drawn along: a swept number, or one of words. */
struct abscissa {
    const struct case_axis *axis; /* NULL: none */
    bool has_names;
};

/* Which of the axis' values a point has; the axis' count: none. */
static size_t value_index(const struct case_axis *axis, const struct measured_point *p,
                          struct arena *a) {
    const struct yaml_node *value =
        case_parameter_find(p->point->parameter, p->point->parameter_count, axis->name);
    const char *text = value == NULL ? NULL : case_value_text(a, value);
    for (size_t i = 0; text != NULL && i < axis->list->count; i++) {
        const char *other = case_value_text(a, &axis->list->child[i]);
        if (other != NULL && strcmp(text, other) == 0)
            return i;
    }
    return axis->list->count;
}

static double place_of(const struct abscissa *x, const struct measured_point *p, struct arena *a) {
    return x->has_names ? (double)value_index(x->axis, p, a) : measured_parameter(p, x->axis->name);
}

/* Do the check's points have two places or more, and all of them one? */
static bool tells_points_apart(const struct figure_input *in, const struct case_check *check,
                               const struct abscissa *x, struct arena *a) {
    double first = (double)NAN;
    bool differ = false;
    for (size_t i = 0; i < in->row_count; i++) {
        if (!is_drawn(in, i, check))
            continue;
        double place = place_of(x, in->row_point[i], a);
        if (!isfinite(place) || (x->has_names && place >= (double)x->axis->list->count))
            return false;
        differ |= isfinite(first) && place != first;
        first = place;
    }
    return differ;
}

static struct abscissa find_abscissa(const struct figure_input *in, const struct case_check *check,
                                     struct arena *a) {
    const struct case_tier *t = in->data->plan->tier;
    for (int names = 0; names < 2; names++) {
        for (size_t i = 0; i < t->axis_count; i++) {
            struct abscissa x = {&t->axis[i], names == 1};
            if (tells_points_apart(in, check, &x, a))
                return x;
        }
    }
    return (struct abscissa){NULL, false};
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
                           const struct abscissa *along, struct arena *a, struct branch *list,
                           size_t *count, struct fault *fault) {
    *count = 0;
    for (size_t i = 0; i < in->row_count; i++) {
        if (!is_drawn(in, i, check) || !isfinite(in->row[i].measured))
            continue;
        const char *label = figure_point_text(in->data, in->row_point[i], along->axis->name, a);
        if (label == NULL)
            return no_memory(fault);
        struct branch *b = find_branch(list, count, label);
        if (b == NULL)
            continue;
        if (!make_room(b, in->row_count, a))
            return no_memory(fault);
        const struct report_row *r = &in->row[i];
        b->quantity = r->observable;
        b->x[b->count] = place_of(along, in->row_point[i], a);
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

/* A line through values; over names a short one at each. */
static struct report_series level(const char *label, int colour, const struct branch *b,
                                  const double *y, bool has_names, struct arena *a) {
    enum { PLACES = 3 };
    static const double HALF = .2;
    double *x = has_names ? arena_take(a, PLACES * b->count, sizeof *x) : NULL;
    double *level = has_names ? arena_take(a, PLACES * b->count, sizeof *level) : NULL;
    if (x == NULL || level == NULL)
        return series(label, SERIES_DASHED, colour, b, y, NULL);
    for (size_t i = 0; i < b->count; i++) {
        for (size_t k = 0; k < PLACES; k++) {
            x[PLACES * i + k] = b->x[i] + (k == 0 ? -HALF : HALF);
            level[PLACES * i + k] = k + 1 < PLACES ? y[i] : (double)NAN;
        }
    }
    return (struct report_series){label, SERIES_DASHED, colour, PLACES * b->count, x, level, NULL};
}

/* Settings stand side by side at each name, not on each other. */
static void set_apart(struct branch *list, size_t count) {
    static const double STEP = .07;
    for (size_t k = 0; k < count; k++) {
        for (size_t i = 0; i < list[k].count; i++)
            list[k].x[i] += STEP * ((double)k - (double)(count - 1) / 2);
    }
}

/* The margin on both sides of zero, or on the one that counts. */
static size_t add_margins(const struct branch *b, enum comparison c, int colour, bool has_names,
                          struct arena *a, struct report_series *out) {
    size_t count = 0;
    double *below = arena_take(a, b->count, sizeof *below);
    for (size_t i = 0; below != NULL && i < b->count; i++)
        below[i] = -b->tolerance[i];
    if (c != COMPARE_AT_LEAST)
        out[count++] = level("", colour, b, b->tolerance, has_names, a);
    if (c != COMPARE_AT_MOST && below != NULL)
        out[count++] = level("", colour, b, below, has_names, a);
    return count;
}

static const char *label_axis(const char *text, const char *unit, struct arena *a) {
    return strcmp(unit, "1") == 0 ? text : arena_text(a, "%s (%s)", text, unit);
}

/* x_name[0 .. axis count-1] of an axis of words; NULL: no memory. */
static const char *const *names_of(const struct case_axis *axis, struct arena *a) {
    const char **name = arena_take(a, axis->list->count, sizeof *name);
    for (size_t i = 0; name != NULL && i < axis->list->count; i++) {
        name[i] = case_value_text(a, &axis->list->child[i]);
        if (name[i] == NULL)
            return NULL;
    }
    return name;
}

static size_t draw_branches(const struct branch *list, size_t count, enum comparison comparison,
                            bool has_names, struct arena *a, struct report_panel *panel) {
    size_t upper = 0, lower = 0;
    struct report_series *top = arena_take(a, 2 * COLOURS, sizeof *top);
    struct report_series *rest = arena_take(a, 3 * COLOURS, sizeof *rest);
    if (top == NULL || rest == NULL)
        return 0;
    for (size_t i = 0; i < count; i++) {
        const struct branch *b = &list[i];
        const char *name = *b->label == '\0' ? "measured" : b->label;
        const char *expected =
            *b->label == '\0' ? "expected" : arena_text(a, "%s, expected", b->label);
        top[upper++] = series(name, SERIES_POINTS, (int)i, b, b->measured, b->error);
        top[upper++] = level(expected, (int)i, b, b->expected, has_names, a);
        rest[lower++] = series("", SERIES_POINTS, (int)i, b, b->residual, b->error);
        lower += add_margins(b, comparison, (int)i, has_names, a, &rest[lower]);
    }
    panel[0] = (struct report_panel){.series_count = upper, .series = top};
    panel[1] = (struct report_panel){.series_count = lower, .series = rest};
    return upper;
}

static enum status draw_check(const struct figure_input *in, const struct case_check *check,
                              const struct abscissa *along, size_t number,
                              struct figure_output *out, struct fault *fault) {
    struct branch list[COLOURS];
    size_t count = 0;
    struct arena *a = out->arena;
    const char *axis = along->axis->name;
    enum status status = collect(in, check, along, a, list, &count, fault);
    struct report_panel *panel = arena_take(a, 2, sizeof *panel);
    if (status != STATUS_OK || count == 0)
        return status;
    if (along->has_names)
        set_apart(list, count);
    if (panel == NULL ||
        draw_branches(list, count, check->comparison, along->has_names, a, panel) == 0)
        return no_memory(fault);
    panel[0].y_label = label_axis(list[0].quantity, check->unit, a);
    panel[1].y_label = label_axis("measured - expected", check->unit, a);
    struct report_figure f = {
        .name = arena_text(a, "check-%zu", number),
        .title = check->name,
        .caption = arena_text(a,
                              "Points: measured, with standard uncertainty; dashed "
                              "above: expected; dashed below: the margin (%s).",
                              case_comparison_name(check->comparison)),
        .alt = arena_text(a, "%s measured and expected over %s, and their difference",
                          check->observable, axis),
        .x_label = figure_axis_text(axis, a),
        .x_name_count = along->has_names ? along->axis->list->count : 0,
        .x_name = along->has_names ? names_of(along->axis, a) : NULL,
        .panel_count = 2,
        .panel = panel};
    if (f.name == NULL || f.caption == NULL || f.alt == NULL || f.x_label == NULL ||
        panel[0].y_label == NULL || panel[1].y_label == NULL ||
        (along->has_names && f.x_name == NULL))
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
    size_t count = 1 + add_margins(&b, COMPARE_WITHIN, -1, false, out->arena, &s[1]);
    *panel = (struct report_panel){
        .y_label = "(measured - expected)/margin", .series_count = count, .series = s};
    struct report_figure f = {
        .name = "overview",
        .title = "All checks, in units of their margin",
        .caption = "One point a row of the table, in its order. What must lie within its margin "
                   "passes between the dashed lines, what must lie outside beyond them, what has "
                   "an upper limit below the upper line, a lower limit above the lower one. Limits "
                   "without a margin are left out.",
        .alt = "Residual of every check divided by its margin",
        .x_label = "row of the table",
        .panel_count = 1,
        .panel = panel};
    return figure_add(out, &f, fault);
}

enum status figure_default_build(const struct figure_input *in, struct figure_output *out,
                                 struct fault *fault) {
    const struct case_tier *t = in->data->plan->tier;
    enum status status = draw_overview(in, out, fault);
    for (size_t i = 0; status == STATUS_OK && i < t->check_count; i++) {
        struct abscissa along = find_abscissa(in, &t->check[i], out->arena);
        if (along.axis != NULL && out->figure_count < FIGURES_MAX)
            status = draw_check(in, &t->check[i], &along, i + 1, out, fault);
    }
    return status;
}
