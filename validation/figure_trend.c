/* figure_trend.c -- a fitted curve and what the fit gives over the packing fraction: FZ, Figs. 2
 * and 7.
 *
 * interface-width   profiles of stationary beds with their error functions; sigma over phibar for
 *                   each layer thickness Delta, with the hydrostatic width.
 * relaxation        L(t) after a step of phibar with its exponential; lambda over the phibar
 * stepped to, for each restitution, with the rates of the two waves.
 *
 * Two figures for each reading, and one table of all.  The first figure shows the points that share
 * the first one's Delta (restitution): means over seeds, or the first seed where abscissae differ.
 * In the second, points are means over seeds with the standard error, or, of one seed, the error
 * that its own recipe gives.  Theory is the prediction of the checks, with the inputs that they
 * bind, at each point; lines join these.  It is left out where its inputs cannot be had.
 *
 * Source:     Fiege & Zippelius, Figs. 2 and 7.
 * Leaves out: points without a value.
 * Checked by: tests/unit/test_figure_trend.c.
 */
#include "validation/figure_beds.h"
#include "validation/figure_recipes.h"

#include <gsl/gsl_statistics_double.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { COLOURS = 6, THEORIES = 2, MAX_SEEDS = 256, MAX_EXTRA = 4 };

/* What differs between the two recipes. */
struct trend {
    const char *recipe;      /* of the observable */
    const char *curve, *fit; /* its curves */
    const char *curve_title, *x_label, *y_label;
    const char *output, *own_error; /* its outputs; own_error may be NULL */
    const char *output_title, *output_label;
    const char *abscissa, *abscissa_label; /* a parameter: its last value */
    const char *branch;                    /* a parameter: one colour a value */
    struct {
        const char *prediction, *label;
    } theory[THEORIES];
    const char *extra[MAX_EXTRA]; /* further outputs of the table; ends at NULL */
};

/* One point shown. */
struct spot {
    const struct measured_point *point;
    double x, y, error;
    double theory[THEORIES]; /* NaN: none */
    size_t branch;
};

struct drawing {
    const struct trend *t;
    const struct figure_input *in;
    struct arena *arena;
    struct measured_case data; /* points of one reading */
    const char *reading;
    size_t branches;
    double *branch; /* branch[0 .. branches-1]: its parameter; NaN where a point has none */
    size_t spots;
    struct spot *spot; /* spot[0 .. spots-1], by branch and x */
    bool has_theory[THEORIES], has_ensemble;
};

static enum status no_memory(struct fault *fault) {
    return fault_set(fault, STATUS_NO_MEMORY, "figure: out of memory");
}

/* -- what was measured ------------------------------------------------------ */

static size_t find_branch(struct drawing *d, double value) {
    size_t k = 0;
    while (k < d->branches && !(d->branch[k] == value || (isnan(d->branch[k]) && isnan(value))))
        k++;
    if (k == d->branches)
        d->branch[d->branches++] = value;
    return k;
}

static int by_place(const void *first, const void *second) {
    const struct spot *a = first, *b = second;
    if (a->branch != b->branch)
        return a->branch < b->branch ? -1 : 1;
    return a->x < b->x ? -1 : a->x > b->x;
}

/* A fit over all seeds of the observable, if the case has one with this output. */
static bool find_ensemble(struct drawing *d, const struct measured_point *p, struct spot *s) {
    const struct case_file *file = d->in->file;
    for (size_t a = 0; a < file->across_count && p->ensemble; a++) {
        const struct case_across *fit = &file->across[a];
        if (!fit->ensemble || fit->of.across || fit->of.index != d->in->observable[0])
            continue;
        for (size_t i = 0; i < ENSEMBLE_MAX_OUTPUTS && fit->ensemble->output[i].name; i++)
            if (strcmp(fit->ensemble->output[i].name, d->t->output) == 0) {
                s->y = p->ensemble[a].value[i];
                s->error = p->ensemble[a].uncertainty[i];
                d->has_ensemble = true;
                return true;
            }
    }
    return false;
}

static enum status take_spot(struct drawing *d, const struct measured_point *p,
                             struct fault *fault) {
    double ignored;
    struct spot s = {.point = p, .x = figure_bed_number(p, d->t->abscissa)};
    s.branch = find_branch(d, figure_bed_number(p, d->t->branch));
    if (!find_ensemble(d, p, &s)) {
        s.y = figure_mean(d->in, p, d->t->output, &s.error);
        if (!(s.error > 0) && d->t->own_error)
            s.error = figure_mean(d->in, p, d->t->own_error, &ignored);
    }
    if (!isfinite(s.x) || !isfinite(s.y))
        return STATUS_OK;
    s.error = isfinite(s.error) ? s.error : 0;
    for (size_t i = 0; i < THEORIES; i++) {
        const struct prediction *law = prediction_find(d->t->theory[i].prediction);
        struct fault why = FAULT_NONE; /* a case need not have all that theory asks for */
        s.theory[i] = NAN;
        if (law && figure_bed_predict(d->in, p, law, &s.theory[i], &why) == STATUS_NO_MEMORY)
            return no_memory(fault);
        d->has_theory[i] |= isfinite(s.theory[i]);
    }
    d->spot[d->spots++] = s;
    return STATUS_OK;
}

static enum status take_spots(struct drawing *d, struct fault *fault) {
    size_t points = d->data.point_count;
    enum status status = STATUS_OK;
    d->branch = arena_take(d->arena, points, sizeof *d->branch);
    d->spot = arena_take(d->arena, points, sizeof *d->spot);
    if (!d->branch || !d->spot)
        return no_memory(fault);
    for (size_t i = 0; i < points && !status; i++)
        status = take_spot(d, &d->data.point[i], fault);
    if (status)
        return status;
    qsort(d->spot, d->spots, sizeof *d->spot, by_place);
    for (size_t i = 1; i < d->spots; i++)
        if (by_place(&d->spot[i - 1], &d->spot[i]) == 0)
            return fault_set(fault, STATUS_BAD_INPUT,
                             "%s and %s have one place in the figure: choose with `points`",
                             d->spot[i - 1].point->point->name, d->spot[i].point->point->name);
    return d->branches <= COLOURS
               ? STATUS_OK
               : fault_set(fault, STATUS_BAD_INPUT, "%zu values of %s cannot be told apart",
                           d->branches, d->t->branch);
}

/* -- the fitted curves ------------------------------------------------------ */

/* Without the end of a curve where there is nothing: a thousandth of the largest value. */
static size_t shown_part(const double *y, size_t count) {
    double most = 0;
    for (size_t k = 0; k < count; k++)
        most = fmax(most, y[k]);
    while (count > 1 && !(y[count - 1] > 1e-3 * most))
        count--;
    return count;
}

/* A mean over seeds as a series; no seed has it: none. */
static enum status add_curve(struct drawing *d, const struct measured_point *p, const char *name,
                             struct report_series *out, struct fault *fault) {
    const struct curve *curve[MAX_SEEDS];
    size_t count = figure_bed_curves(d->in, p, name, curve, MAX_SEEDS);
    if (count == 0)
        return STATUS_OK;
    double *y = arena_take(d->arena, curve[0]->count, sizeof *y), at[MAX_SEEDS];
    double *error = arena_take(d->arena, curve[0]->count, sizeof *error);
    if (!y || !error)
        return no_memory(fault);
    for (size_t k = 0; k < curve[0]->count; k++) {
        for (size_t i = 0; i < count; i++)
            at[i] = curve[i]->y[k];
        y[k] = gsl_stats_mean(at, 1, count);
        error[k] = count > 1 ? gsl_stats_sd_m(at, 1, count, y[k]) / sqrt((double)count) : 0;
    }
    out->count = shown_part(y, curve[0]->count);
    out->x = curve[0]->x;
    out->y = y;
    out->error = count > 1 && out->style == SERIES_DOTS ? error : NULL;
    return STATUS_OK;
}

static const char *caption_of(const struct drawing *d, const char *own) {
    const char *wanted = d->in->wanted->caption;
    return arena_text(d->arena, "%s%s%s", wanted ? wanted : "", wanted ? " " : "", own);
}

static const char *title_of(const struct drawing *d, const char *own) {
    const char *wanted = d->in->wanted->title;
    const char *title = wanted ? arena_text(d->arena, "%s: %s", wanted, own) : own;
    return title ? figure_bed_title(title, d->reading, d->arena) : NULL;
}

static enum status add(struct drawing *d, const char *name, const char *title, const char *caption,
                       const char *alt, const char *x_label, const struct report_panel *panel,
                       struct figure_output *out, struct fault *fault) {
    struct report_figure f = {.name = arena_text(d->arena, "%s-%zu", name, out->figure_count + 1),
                              .title = title_of(d, title),
                              .caption = caption_of(d, caption),
                              .alt = alt,
                              .x_label = x_label,
                              .panel_count = 1,
                              .panel = panel};
    return f.name && f.title && f.caption && f.alt ? figure_add(out, &f, fault) : no_memory(fault);
}

/* The points of the first branch, up to as many as there are colours. */
static size_t first_branch(const struct drawing *d, struct measured_case *out) {
    struct measured_point *point = arena_take(d->arena, d->data.point_count, sizeof *point);
    *out = d->data;
    out->point = point;
    out->point_count = 0;
    for (size_t i = 0; point && i < d->data.point_count; i++) {
        double value = figure_bed_number(&d->data.point[i], d->t->branch);
        if (value == d->branch[0] || (isnan(value) && isnan(d->branch[0])))
            point[out->point_count++] = d->data.point[i];
    }
    return out->point_count;
}

/* Points of the data and a line of the fit, in one colour. */
static enum status fill_curves(struct drawing *d, const struct measured_case *shown,
                               struct report_series *s, size_t *count, struct fault *fault) {
    enum status status = STATUS_OK;
    for (size_t i = 0; i < shown->point_count && !status; i++) {
        const struct measured_point *p = &shown->point[i];
        struct report_series *at = &s[*count];
        at[0] = (struct report_series){.style = SERIES_DOTS, .colour = (int)i};
        at[1] = (struct report_series){.label = "", .style = SERIES_LINE, .colour = (int)i};
        at[0].label = figure_bed_label(shown, p, NULL, d->arena);
        status = at[0].label ? add_curve(d, p, d->t->curve, &at[0], fault) : no_memory(fault);
        if (!status)
            status = add_curve(d, p, d->t->fit, &at[1], fault);
        *count += at[0].count == 0 ? 0 : at[1].count == 0 ? 1 : 2;
    }
    return status;
}

static enum status draw_curves(struct drawing *d, struct figure_output *out, struct fault *fault) {
    struct measured_case shown;
    size_t points = first_branch(d, &shown), count = 0;
    if (points > COLOURS)
        return fault_set(fault, STATUS_BAD_INPUT,
                         "%zu curves cannot be told apart, %d can: choose with `points`", points,
                         (int)COLOURS);
    struct report_series *s = arena_take(d->arena, 2 * points, sizeof *s);
    struct report_panel *panel = arena_take(d->arena, 1, sizeof *panel);
    if (!s || !panel)
        return no_memory(fault);
    enum status status = fill_curves(d, &shown, s, &count, fault);
    if (status || count == 0)
        return status;
    *panel = (struct report_panel){.y_label = d->t->y_label, .series_count = count, .series = s};
    const char *branch =
        isnan(d->branch[0])
            ? ""
            : arena_text(d->arena, " Shown: %s.",
                         figure_value_text(d->t->branch, arena_text(d->arena, "%g", d->branch[0]),
                                           d->arena));
    const char *caption =
        branch ? arena_text(d->arena,
                            "Dots: means over seeds with their standard error, or the first seed "
                            "where seeds have different abscissae; lines: the fits, averaged "
                            "likewise.%s",
                            branch)
               : NULL;
    return caption ? add(d, d->in->wanted->recipe, d->t->curve_title, caption, d->t->curve_title,
                         d->t->x_label, panel, out, fault)
                   : no_memory(fault);
}

/* -- what the fits give ----------------------------------------------------- */

/* Points of a branch, from `first` on: how many; and their columns. */
static size_t branch_end(const struct drawing *d, size_t first) {
    size_t end = first;
    while (end < d->spots && d->spot[end].branch == d->spot[first].branch)
        end++;
    return end;
}

static bool fill_branch(struct drawing *d, size_t first, size_t count, struct report_series *s,
                        double *highest) {
    int colour = (int)d->spot[first].branch;
    double *column[3 + THEORIES];
    for (size_t c = 0; c < 3 + THEORIES; c++)
        if (!(column[c] = arena_take(d->arena, count, sizeof(double))))
            return false;
    for (size_t i = 0; i < count; i++) {
        const struct spot *at = &d->spot[first + i];
        column[0][i] = at->x;
        column[1][i] = at->y;
        column[2][i] = at->error;
        *highest = fmax(*highest, at->y + at->error);
        for (size_t c = 0; c < THEORIES; c++) {
            column[3 + c][i] = at->theory[c];
            *highest = fmax(*highest, at->theory[c]); /* a NaN is left out */
        }
    }
    double value = d->branch[colour];
    s[0] = (struct report_series){
        isnan(value) ? "measured"
                     : figure_value_text(d->t->branch, arena_text(d->arena, "%g", value), d->arena),
        SERIES_POINTS,
        colour,
        count,
        column[0],
        column[1],
        column[2]};
    for (size_t c = 0; c < THEORIES; c++)
        s[1 + c] = (struct report_series){
            "",  c == 0 ? SERIES_DASHED : SERIES_LINE, colour, count, column[0], column[3 + c],
            NULL};
    return s[0].label != NULL;
}

static bool same_curve(const struct report_series *a, const struct report_series *b) {
    bool same = a->count == b->count;
    for (size_t k = 0; same && k < a->count; k++)
        same = a->x[k] == b->x[k] && a->y[k] == b->y[k];
    return same;
}

/* Theory that knows nothing of the branch is drawn once, in grey: s[branch * (1 + THEORIES)]. */
static void join_theory(struct report_series *s, size_t branches) {
    for (size_t c = 1; c <= THEORIES; c++) {
        bool same = branches > 1;
        for (size_t b = 1; b < branches; b++)
            same = same && same_curve(&s[c], &s[b * (1 + THEORIES) + c]);
        for (size_t b = 0; same && b < branches; b++) {
            s[b * (1 + THEORIES) + c].colour = -1;
            s[b * (1 + THEORIES) + c].count = b == 0 ? s[c].count : 0;
        }
    }
}

static enum status draw_trend(struct drawing *d, struct figure_output *out, struct fault *fault) {
    struct report_panel *panel = arena_take(d->arena, 1, sizeof *panel);
    struct report_series *s = arena_take(d->arena, (1 + THEORIES) * (d->branches + 1), sizeof *s);
    size_t count = 0;
    double highest = 0;
    if (!panel || !s)
        return no_memory(fault);
    for (size_t i = 0, end; i < d->spots; i = end, count += 1 + THEORIES) {
        end = branch_end(d, i);
        if (!fill_branch(d, i, end - i, &s[count], &highest))
            return no_memory(fault);
    }
    join_theory(s, count / (1 + THEORIES));
    for (size_t c = 0; c < THEORIES; c++) { /* entries of the key; a single point with its mark */
        if (!d->has_theory[c])
            continue;
        s[count] = s[1 + c];
        s[count].label = d->t->theory[c].label;
        s[count].colour = -1;
        s[count].count = s[count].count == 1;
        count++;
    }
    *panel = (struct report_panel){
        .y_label = d->t->output_label, .y_max = 1.1 * highest, .series_count = count, .series = s};
    const char *caption = arena_text(
        d->arena, "Points: %s.%s",
        d->has_ensemble ? "one fit to all seeds, with the standard error that the fit gives"
                        : "means over seeds with their standard error, or one seed with the error "
                          "of its own fit",
        d->has_theory[0] || d->has_theory[1] ? " Lines, or crosses at a single point: what theory "
                                               "says, with the inputs that the checks "
                                               "use."
                                             : "");
    if (!caption)
        return no_memory(fault);
    return add(d, d->in->wanted->recipe, d->t->output_title, caption, d->t->output_title,
               d->t->abscissa_label, panel, out, fault);
}

/* -- table ------------------------------------------------------------------ */

struct table {
    size_t columns, rows, extras;
    const char **heading, **cell;
};

static const char *with_error(struct arena *a, double value, double error) {
    if (!isfinite(value))
        return "-";
    return error > 0 ? arena_text(a, "%.4g ± %.2g", value, error) : arena_text(a, "%.4g", value);
}

static const char *unit_of(const struct figure_input *in, const char *output) {
    const struct recipe *r = in->file->observable[in->observable[0]].recipe;
    for (size_t i = 0; i < RECIPE_MAX_OUTPUTS && r->output[i].name; i++)
        if (strcmp(r->output[i].name, output) == 0)
            return r->output[i].unit;
    return "1";
}

static enum status open_table(const struct trend *t, const struct figure_input *in, struct arena *a,
                              struct table *out, struct fault *fault) {
    *out = (struct table){0};
    while (out->extras < MAX_EXTRA && t->extra[out->extras])
        out->extras++;
    out->columns = 4 + 2 * THEORIES + out->extras;
    out->heading = arena_take(a, out->columns, sizeof *out->heading);
    out->cell = arena_take(a, out->columns * in->data->point_count, sizeof *out->cell);
    if (!out->heading || !out->cell)
        return no_memory(fault);
    const char **h = out->heading;
    *h++ = "reading";
    *h++ = figure_axis_text(t->branch, a);
    *h++ = t->abscissa_label;
    *h++ = t->output_label;
    for (size_t c = 0; c < THEORIES; c++) {
        *h++ = t->theory[c].label;
        *h++ = "measured/theory";
    }
    for (size_t i = 0; i < out->extras; i++)
        *h++ = arena_text(a, "%s (%s)", t->extra[i], unit_of(in, t->extra[i]));
    for (size_t i = 0; i < out->columns; i++)
        if (!out->heading[i])
            return no_memory(fault);
    return STATUS_OK;
}

static enum status add_row(const struct drawing *d, const struct spot *s, struct table *t,
                           struct fault *fault) {
    const char **cell = t->cell + t->rows++ * t->columns, **c = cell;
    *c++ = d->reading ? d->reading : "-";
    *c++ = with_error(d->arena, d->branch[s->branch], 0);
    *c++ = with_error(d->arena, s->x, 0);
    *c++ = with_error(d->arena, s->y, s->error);
    for (size_t i = 0; i < THEORIES; i++) {
        *c++ = with_error(d->arena, s->theory[i], 0);
        *c++ = with_error(d->arena, s->y / s->theory[i], s->error / s->theory[i]);
    }
    for (size_t i = 0; i < t->extras; i++) {
        double error, mean = figure_mean(d->in, s->point, d->t->extra[i], &error);
        *c++ = with_error(d->arena, mean, error);
    }
    for (size_t i = 0; i < t->columns; i++)
        if (!cell[i])
            return no_memory(fault);
    return STATUS_OK;
}

static enum status tabulate(const struct trend *trend, const struct figure_input *in,
                            const struct table *t, struct figure_output *out, struct fault *fault) {
    const char *wanted = in->wanted->title;
    struct report_table r = {
        .title = wanted ? arena_text(out->arena, "%s: %s", wanted, trend->output_title)
                        : trend->output_title,
        .caption = "Values and errors as in the figures; extra columns are means over seeds.",
        .columns = t->columns,
        .rows = t->rows,
        .heading = t->heading,
        .cell = t->cell};
    return r.title ? figure_add_table(out, &r, fault) : no_memory(fault);
}

/* -- the whole -------------------------------------------------------------- */

static enum status build_reading(struct drawing *d, struct table *table, struct figure_output *out,
                                 struct fault *fault) {
    d->reading = figure_bed_reading(&d->data.point[0]);
    enum status status = take_spots(d, fault);
    if (!status)
        status = draw_curves(d, out, fault);
    if (!status && d->spots > 0)
        status = draw_trend(d, out, fault);
    for (size_t i = 0; i < d->spots && !status; i++)
        status = add_row(d, &d->spot[i], table, fault);
    return status;
}

static enum status build(const struct trend *t, const struct figure_input *in,
                         struct figure_output *out, struct fault *fault) {
    struct table table;
    size_t figures = out->figure_count;
    enum status status = figure_needs(in, t->recipe, fault);
    if (!status)
        status = open_table(t, in, out->arena, &table, fault);
    struct drawing d = {.t = t, .in = in, .arena = out->arena};
    for (size_t nth = 0; !status && figure_bed_of_reading(in->data, nth, &d.data, out->arena);
         nth++) {
        d.branches = d.spots = 0;
        d.has_theory[0] = d.has_theory[1] = false;
        status = build_reading(&d, &table, out, fault);
    }
    if (status)
        return status;
    if (out->figure_count == figures)
        return fault_set(fault, STATUS_BAD_INPUT, "no run has %s or the curve %s", t->output,
                         t->curve);
    return table.rows > 0 ? tabulate(t, in, &table, out, fault) : STATUS_OK;
}

static const struct trend interface_width = {
    .recipe = "bed-interface",
    .curve = "profile",
    .fit = "fit",
    .curve_title = "packing fraction over height, with fits",
    .x_label = "height z (R)",
    .y_label = "packing fraction",
    .output = "sigma",
    .own_error = "sigma_error",
    .output_title = "width of the interface",
    .output_label = "sigma (R)",
    .abscissa = "phibar",
    .abscissa_label = "packing fraction phibar",
    .branch = "layer_R",
    .theory = {{"hydrostatic-width", "hydrostatics, one temperature"},
               {"hydrostatic-width-local", "hydrostatics, local temperature"}},
    .extra = {"height", "plateau", "fit_rms", NULL}};

static enum status build_interface(const struct figure_input *in, struct figure_output *out,
                                   struct fault *fault) {
    return build(&interface_width, in, out, fault);
}

const struct figure_recipe figure_trend_interface = {
    .name = "interface-width",
    .title = "Stationary profiles with fits, and the width over phibar with hydrostatics",
    .observables = 1,
    .build = build_interface,
};

static const struct trend relaxation = {
    .recipe = "bed-relaxation",
    .curve = "L",
    .fit = "fit",
    .curve_title = "distance from the first profile, with fits",
    .x_label = "time since phibar changed (s)",
    .y_label = "L (sqrt(R))",
    .output = "rate",
    .output_title = "rate of relaxation",
    .output_label = "lambda (1/s)",
    .abscissa = "phibar_values",
    .abscissa_label = "packing fraction phibar changed to",
    .branch = "restitution",
    .theory = {{"kinematic-relaxation-rate", "kinematic wave"},
               {"inertial-relaxation-rate", "wave with pressure and inertia"}},
    .extra = {"plateau", "exponential_rms", "root_rms", NULL}};

static enum status build_relaxation(const struct figure_input *in, struct figure_output *out,
                                    struct fault *fault) {
    return build(&relaxation, in, out, fault);
}

const struct figure_recipe figure_trend_relaxation = {
    .name = "relaxation",
    .title = "L(t) after a step with fits, and lambda over phibar with both waves",
    .observables = 1,
    .build = build_relaxation,
};
