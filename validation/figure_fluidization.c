/* figure_fluidization.c -- pressure drop over the bed's weight against the flux, with the break.
 *
 * Points: the steps of the way up and of the way down; lines: what was fitted to them on either
 * side of the break, which is marked.  Dashed: what is expected, q/q_mf below and 1 above, with
 * q_mf of the prediction at the measured solid fraction.  A figure shows one Darcy law (choose it
 * with `points:`); `of:` names the observable.  A table gives the breaks with their scatter.
 *
 * Source:     docs/theory.md, "Fluidization".
 * Leaves out: seeds without a break in the table's means.
 * Checked by: tests/unit/test_figure_recipes.c.
 */
#include "validation/figure_recipes.h"
#include "validation/observe.h"

#include <math.h>
#include <string.h>

enum { WAYS = 2, MAX_POINTS = 3, MAX_SERIES = 256, COLUMNS = 8 };

static const char *const WAY[WAYS] = {"up", "down"};

struct drawing {
    const struct figure_input *in;
    struct arena *arena;
    const struct prediction *law;
    double gravity;
    double largest_flux; /* of any curve (l/tau) */
    size_t series_count;
    struct report_series *series; /* room for MAX_SERIES */
};

static enum status no_memory(struct fault *fault) {
    return fault_set(fault, STATUS_NO_MEMORY, "fluidization curve: out of memory");
}

/* -- the law ---------------------------------------------------------------- */

static enum status take_law(struct drawing *d, const struct measured_run *run,
                            struct fault *fault) {
    struct run_view *v = NULL;
    struct observe_physics physics;
    enum status status = run_view_open(run->run_path, run->result_path, &v, fault);
    if (!status)
        status = observe_physics(v, &physics, fault);
    run_view_close(v);
    if (status)
        return status;
    const struct prediction *law =
        prediction_find(physics.law == CLOSURE_PUBLISHED ? "minimum-fluidization-published"
                                                         : "minimum-fluidization-corrected");
    if (d->law && (law != d->law || physics.gravity != d->gravity))
        return fault_set(fault, STATUS_BAD_INPUT,
                         "one figure shows one Darcy law and gravity: choose with `points`");
    d->law = law;
    d->gravity = physics.gravity;
    return STATUS_OK;
}

static enum status take_laws(struct drawing *d, struct fault *fault) {
    for (size_t i = 0; i < d->in->data->point_count; i++) {
        const struct measured_point *p = &d->in->data->point[i];
        enum status status = STATUS_OK;
        for (size_t k = 0; k < p->run_count; k++)
            if (p->run[k].usable) {
                status = take_law(d, &p->run[k], fault);
                break;
            }
        if (status)
            return status;
    }
    return d->law ? STATUS_OK : fault_set(fault, STATUS_BAD_INPUT, "no run can be used");
}

static double expected_break(const struct drawing *d, double solid_fraction) {
    const double in[] = {solid_fraction, d->gravity};
    return d->law->at(in);
}

/* -- series ----------------------------------------------------------------- */

static enum status add(struct drawing *d, const char *label, enum series_style style, int colour,
                       size_t count, const double *x, const double *y, struct fault *fault) {
    if (!label || !x)
        return no_memory(fault);
    if (d->series_count == MAX_SERIES)
        return fault_set(fault, STATUS_BAD_INPUT, "more than %d curves", (int)MAX_SERIES);
    d->series[d->series_count++] = (struct report_series){
        .label = label, .style = style, .colour = colour, .count = count, .x = x, .y = y};
    return STATUS_OK;
}

static const char *label_of(struct drawing *d, const struct measured_point *p, const char *text) {
    const char *point = figure_point_text(d->in->data, p, NULL, d->arena);
    return point ? arena_text(d->arena, "%s%s%s", point, *point ? ", " : "", text) : NULL;
}

/* The fit of a way is that of its label: either may be missing. */
static const struct curve *find_fit(const struct measurement *m, const char *way) {
    const struct curve *c;
    for (size_t nth = 0; (c = figure_curve_find(m, "fit", nth)) != NULL; nth++)
        if (strcmp(c->label, way) == 0)
            return c;
    return NULL;
}

static enum status add_way(struct drawing *d, const struct measured_point *p, size_t point,
                           size_t way, struct fault *fault) {
    const char *label = label_of(d, p, way == 0 ? "flux rising" : "flux falling");
    enum status status = STATUS_OK;
    int colour = (int)(point * WAYS + way);
    for (size_t i = 0; i < p->run_count && !status; i++) {
        const struct measurement *m =
            p->run[i].usable ? &p->run[i].observable[d->in->observable[0]] : NULL;
        const struct curve *c = m ? figure_curve_find(m, WAY[way], 0) : NULL;
        const struct curve *fit = m ? find_fit(m, WAY[way]) : NULL;
        for (size_t k = 0; c && k < c->count; k++)
            d->largest_flux = fmax(d->largest_flux, c->x[k]);
        if (c && c->count > 0) {
            status = add(d, label, SERIES_POINTS, colour, c->count, c->x, c->y, fault);
            label = "";
        }
        if (fit && !status)
            status = add(d, "", SERIES_LINE, colour, fit->count, fit->x, fit->y, fault);
    }
    return status;
}

static double *pair(struct drawing *d, double a, double b) {
    double *x = arena_take(d->arena, 2, sizeof *x);
    if (x) {
        x[0] = a;
        x[1] = b;
    }
    return x;
}

/* An upright line where the way up breaks. */
static enum status add_break(struct drawing *d, const struct measured_point *p, size_t point,
                             struct fault *fault) {
    static const double height[] = {0, 1};
    double error, q = figure_mean(d->in, p, "q_mf_up", &error);
    if (!isfinite(q))
        return STATUS_OK;
    const char *text = error > 0 ? arena_text(d->arena, "break: %.4f ± %.4f", q, error)
                                 : arena_text(d->arena, "break: %.4f", q);
    return add(d, text ? label_of(d, p, text) : NULL, SERIES_LINE, (int)(point * WAYS), 2,
               pair(d, q, q), height, fault);
}

/* q/q_mf up to 1, and 1 from there on, in a bed of the mean solid fraction of all points. */
static enum status add_expected(struct drawing *d, struct fault *fault) {
    static const double ratio[] = {0, 1, 1};
    double sum = 0, count = 0, error;
    for (size_t i = 0; i < d->in->data->point_count; i++) {
        double rho = figure_mean(d->in, &d->in->data->point[i], "solid_fraction", &error);
        if (isfinite(rho)) {
            sum += rho;
            count++;
        }
    }
    if (count == 0)
        return STATUS_OK; /* no way up to a break: nothing is expected of it */
    double q = expected_break(d, sum / count), *x = arena_take(d->arena, 3, sizeof *x);
    if (!x)
        return no_memory(fault);
    x[1] = q;
    x[2] = fmax(d->largest_flux, q);
    return add(d, arena_text(d->arena, "expected: %.4f", q), SERIES_DASHED, -1, 3, x, ratio, fault);
}

static enum status draw(struct drawing *d, struct figure_output *out, struct fault *fault) {
    const struct case_figure *wanted = d->in->wanted;
    struct report_panel *panel = arena_take(d->arena, 1, sizeof *panel);
    enum status status = STATUS_OK;
    d->series = arena_take(d->arena, MAX_SERIES, sizeof *d->series);
    if (!panel || !d->series)
        return no_memory(fault);
    for (size_t i = 0; i < d->in->data->point_count && !status; i++)
        for (size_t way = 0; way < WAYS && !status; way++)
            status = add_way(d, &d->in->data->point[i], i, way, fault);
    if (!status && d->series_count == 0)
        status = fault_set(fault, STATUS_BAD_INPUT, "no run has a step of constant flux to draw");
    if (!status)
        status = add_expected(d, fault);
    for (size_t i = 0; i < d->in->data->point_count && !status; i++)
        status = add_break(d, &d->in->data->point[i], i, fault);
    if (status)
        return status;
    *panel = (struct report_panel){.y_label = "(drop - freeboard)/weight",
                                   .series_count = d->series_count,
                                   .series = d->series};
    struct report_figure f = {
        .name = arena_text(d->arena, "fluidization-curve-%zu", out->figure_count + 1),
        .title = wanted->title ? wanted->title : "Pressure drop against flux",
        .caption = wanted->caption
                       ? wanted->caption
                       : "The gas carries the bed from the break on: below it the drop grows with "
                         "the flux, above it equals the weight. Points: means over the end of each "
                         "step, every seed; lines: fitted below and above; upright: the break on "
                         "the way up, in l/tau. Dashed: what the permeability at the measured "
                         "solid fraction gives.",
        .alt = "Pressure drop over weight against the flux through the bed",
        .x_label = "flux less the bed's own speed, q - u (l/tau)",
        .panel_count = 1,
        .panel = panel};
    return f.name ? figure_add(out, &f, fault) : no_memory(fault);
}

/* -- table ------------------------------------------------------------------ */

static const char *with_error(struct arena *a, double value, double error) {
    if (!isfinite(value))
        return "-";
    return error > 0 ? arena_text(a, "%.4f ± %.4f", value, error) : arena_text(a, "%.4f", value);
}

static void fill_row(struct drawing *d, const struct measured_point *p, const char **cell) {
    struct arena *a = d->arena;
    double up_error, down_error, error, ignored;
    double up = figure_mean(d->in, p, "q_mf_up", &up_error);
    double down = figure_mean(d->in, p, "q_mf_down", &down_error);
    double hysteresis = figure_mean(d->in, p, "hysteresis", &error);
    double rho = figure_mean(d->in, p, "solid_fraction", &ignored);
    double above = figure_mean(d->in, p, "above", &ignored), q = expected_break(d, rho);
    cell[0] = p->point->name;
    cell[1] = with_error(a, up, up_error);
    cell[2] = with_error(a, down, down_error);
    cell[3] = with_error(a, hysteresis, error);
    cell[4] = with_error(a, rho, 0);
    cell[5] = with_error(a, q, 0);
    cell[6] = with_error(a, up / q, up_error / q);
    cell[7] = with_error(a, above, 0);
}

static enum status tabulate(struct drawing *d, struct figure_output *out, struct fault *fault) {
    static const char *const heading[COLUMNS] = {
        "point",          "q_mf, rising (l/tau)",   "q_mf, falling (l/tau)", "hysteresis",
        "solid fraction", "predicted q_mf (l/tau)", "measured/predicted",    "drop/weight above"};
    size_t rows = d->in->data->point_count;
    const char **cell = arena_take(d->arena, rows * COLUMNS, sizeof *cell);
    if (!cell)
        return no_memory(fault);
    for (size_t i = 0; i < rows; i++)
        fill_row(d, &d->in->data->point[i], &cell[i * COLUMNS]);
    for (size_t i = 0; i < rows * COLUMNS; i++)
        if (!cell[i])
            return no_memory(fault);
    struct report_table t = {.title = "Minimum fluidization",
                             .caption = "Means over seeds with their standard errors. Predicted: "
                                        "from the permeability at the measured solid fraction.",
                             .columns = COLUMNS,
                             .rows = rows,
                             .heading = heading,
                             .cell = cell};
    return figure_add_table(out, &t, fault);
}

static enum status build(const struct figure_input *in, struct figure_output *out,
                         struct fault *fault) {
    struct drawing d = {.in = in, .arena = out->arena};
    enum status status = figure_needs(in, "pressure-drop", fault);
    if (!status)
        status = figure_at_most(in, MAX_POINTS, fault);
    if (!status)
        status = take_laws(&d, fault);
    if (!status)
        status = draw(&d, out, fault);
    return status ? status : tabulate(&d, out, fault);
}

const struct figure_recipe figure_fluidization_curve = {
    .name = "fluidization-curve",
    .title = "Pressure drop over weight against flux, with the break",
    .observables = 1,
    .build = build,
};
