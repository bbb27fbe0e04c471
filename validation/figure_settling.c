/* figure_settling.c -- settling speed over solid fraction: MFM, Fig. 4, and what lies behind it.
 *
 * Above: measured speeds for both laws and both initial states, the two own
 * laws and Eq. 20.  Middle: the speed-up factor, measured over the own law of
 * that run.  Below: measured over Eq. 20, less 1.  A table gives the numbers
 * with the seeds' scatter.  The curves are drawn with the predictions that the
 * checks use.  `of:` names the settling observable.
 *
 * Source:     MFM, Section III and Fig. 4.
 * Leaves out: points without a plateau.
 */
#include "validation/figure_recipes.h"
#include "validation/run_view.h"

#include <gsl/gsl_statistics_double.h>
#include <math.h>
#include <string.h>

enum { MAX_SEEDS = 256, BRANCHES = 4, LAWS = 2, CURVE_POINTS = 120, TABLE_COLUMNS = 8 };

/* One Darcy law with one initial state. */
struct branch {
    const char *darcy, *start, *label;
    size_t count;
    double *rho, *speed, *speed_error;   /* [0 .. count-1] (1), (U0) */
    double *factor, *factor_error;       /* speed over own law */
    double *against, *against_error;     /* speed over Eq. 20, less 1 */
    const struct measured_point **point; /* [0 .. count-1] */
};

struct law {
    const struct prediction *own;
    double *rho, *speed, *one; /* [0 .. CURVE_POINTS-1] */
};

struct drawing {
    const struct figure_input *in;
    struct arena *arena;
    double solid_fraction_min;
    const struct prediction *eq20;
    struct branch branch[BRANCHES];
    struct law law[LAWS + 1]; /* the last: Eq. 20 */
};

static enum status no_memory(struct fault *fault) {
    return fault_set(fault, STATUS_NO_MEMORY, "settling curve: out of memory");
}

static bool make_columns(struct arena *a, size_t count, double **const *column, size_t columns) {
    for (size_t i = 0; i < columns; i++)
        if (!(*column[i] = arena_take(a, count, sizeof **column[i])))
            return false;
    return true;
}

/* Index of an output of the settling recipe. */
static size_t output_index(const struct recipe *r, const char *name) {
    size_t i = 0;
    while (i < RECIPE_MAX_OUTPUTS - 1 && strcmp(r->output[i].name, name) != 0)
        i++;
    return i;
}

/* -- measured --------------------------------------------------------------- */

static double own_law(const struct drawing *d, const char *darcy, double rho) {
    const double in[] = {rho, d->solid_fraction_min};
    return d->law[strcmp(darcy, "corrected") == 0].own->at(in);
}

/* Mean of x[0 .. count-1] and its standard error, 0 for a single value. */
static void mean_of_seeds(const double *x, size_t count, double *mean, double *error) {
    *mean = gsl_stats_mean(x, 1, count);
    *error = count < 2 ? 0 : gsl_stats_sd_m(x, 1, count, *mean) / sqrt((double)count);
}

/* Ratios are taken seed by seed: speed and density of a seed go together. */
static void take_point(struct drawing *d, struct branch *b, const struct measured_point *p) {
    size_t observable = d->in->observable[0], used = 0;
    const struct recipe *r = d->in->file->observable[observable].recipe;
    size_t at_speed = output_index(r, "speed"), at_rho = output_index(r, "solid_fraction");
    double rho[MAX_SEEDS], speed[MAX_SEEDS], factor[MAX_SEEDS], against[MAX_SEEDS], ignored;
    for (size_t i = 0; i < p->run_count && used < MAX_SEEDS; i++) {
        const double *value = p->run[i].usable ? p->run[i].observable[observable].value : NULL;
        if (!value || !isfinite(value[at_speed]) || !isfinite(value[at_rho]))
            continue;
        rho[used] = value[at_rho];
        speed[used] = value[at_speed];
        factor[used] = speed[used] / own_law(d, b->darcy, rho[used]);
        against[used] = speed[used] / d->eq20->at(&rho[used]) - 1;
        used++;
    }
    if (used == 0)
        return;
    size_t k = b->count++;
    b->point[k] = p;
    mean_of_seeds(rho, used, &b->rho[k], &ignored);
    mean_of_seeds(speed, used, &b->speed[k], &b->speed_error[k]);
    mean_of_seeds(factor, used, &b->factor[k], &b->factor_error[k]);
    mean_of_seeds(against, used, &b->against[k], &b->against_error[k]);
}

static bool is_of(const struct measured_point *p, const char *name, const char *value,
                  const char *standard) {
    bool set = false;
    for (size_t i = 0; i < p->point->parameter_count; i++)
        set |= strcmp(p->point->parameter[i].name, name) == 0;
    return set ? measured_parameter_is(p, name, value) : strcmp(value, standard) == 0;
}

static enum status take_branches(struct drawing *d, struct fault *fault) {
    static const char *const name[BRANCHES][3] = {
        {"published", "random", "published law, random start"},
        {"corrected", "random", "corrected law, random start"},
        {"published", "equilibrated", "published law, equilibrated"},
        {"corrected", "equilibrated", "corrected law, equilibrated"}};
    size_t points = d->in->data->point_count;
    for (size_t i = 0; i < BRANCHES; i++) {
        struct branch *b = &d->branch[i];
        *b = (struct branch){.darcy = name[i][0], .start = name[i][1], .label = name[i][2]};
        double **const column[] = {&b->rho,          &b->speed,   &b->speed_error,  &b->factor,
                                   &b->factor_error, &b->against, &b->against_error};
        b->point = arena_take(d->arena, points, sizeof *b->point);
        if (!b->point || !make_columns(d->arena, points, column, 7))
            return no_memory(fault);
        for (size_t k = 0; k < points; k++) {
            const struct measured_point *p = &d->in->data->point[k];
            if (is_of(p, "darcy", b->darcy, "published") && is_of(p, "start", b->start, "random"))
                take_point(d, b, p);
        }
    }
    return STATUS_OK;
}

/* -- theory ----------------------------------------------------------------- */

static enum status take_laws(struct drawing *d, struct fault *fault) {
    double low = 1, high = 0;
    for (size_t i = 0; i < BRANCHES; i++)
        for (size_t k = 0; k < d->branch[i].count; k++) {
            low = fmin(low, d->branch[i].rho[k]);
            high = fmax(high, d->branch[i].rho[k]);
        }
    if (!(high > 0))
        return fault_set(fault, STATUS_BAD_INPUT, "no run has a settling plateau to draw");
    for (size_t i = 0; i <= LAWS; i++) {
        struct law *l = &d->law[i];
        double **const column[] = {&l->rho, &l->speed, &l->one};
        if (!make_columns(d->arena, CURVE_POINTS, column, 3))
            return no_memory(fault);
        for (size_t k = 0; k < CURVE_POINTS; k++) {
            double share = (double)k / (CURVE_POINTS - 1);
            l->rho[k] = low - 0.02 + share * (high - low + 0.04);
            const double in[] = {l->rho[k], d->solid_fraction_min};
            l->speed[k] = l->own->at(in);
            l->one[k] = i < LAWS ? 1 : 0;
        }
    }
    return STATUS_OK;
}

/* The cut-off that the runs used, from the first one that can be read. */
static enum status find_cut_off(struct drawing *d, struct fault *fault) {
    for (size_t i = 0; i < d->in->data->point_count; i++)
        for (size_t k = 0; k < d->in->data->point[i].run_count; k++) {
            const struct measured_run *r = &d->in->data->point[i].run[k];
            struct run_view *v = NULL;
            if (!r->usable)
                continue;
            enum status status = run_view_open(r->run_path, r->result_path, &v, fault);
            if (!status)
                status = run_view_parameter(v, "solid_fraction_min", &d->solid_fraction_min, fault);
            run_view_close(v);
            return status;
        }
    return fault_set(fault, STATUS_BAD_INPUT, "no run can be used");
}

/* -- drawing ---------------------------------------------------------------- */

static struct report_series measured(const struct branch *b, int colour, const double *y,
                                     const double *error, bool labelled) {
    return (struct report_series){.label = labelled ? b->label : "",
                                  .style = SERIES_POINTS,
                                  .colour = colour,
                                  .count = b->count,
                                  .x = b->rho,
                                  .y = y,
                                  .error = error};
}

static struct report_series theory(const struct law *l, const char *label, int colour,
                                   const double *y) {
    return (struct report_series){.label = label,
                                  .style = colour < 0 ? SERIES_DASHED : SERIES_LINE,
                                  .colour = colour,
                                  .count = CURVE_POINTS,
                                  .x = l->rho,
                                  .y = y};
}

static enum status draw(struct drawing *d, struct figure_output *out, struct fault *fault) {
    static const char *const label[] = {"own law, published", "own law, corrected", "MFM, Eq. 20"};
    static const int colour[] = {0, 1, -1};
    struct report_panel *panel = arena_take(d->arena, 3, sizeof *panel);
    struct report_series *s[3];
    size_t count[3] = {0, 0, 0};
    for (size_t i = 0; i < 3; i++)
        s[i] = arena_take(d->arena, BRANCHES + LAWS + 1, sizeof *s[i]);
    if (!panel || !s[0] || !s[1] || !s[2])
        return no_memory(fault);
    for (size_t i = 0; i < BRANCHES; i++) {
        const struct branch *b = &d->branch[i];
        if (!b->count)
            continue;
        s[0][count[0]++] = measured(b, (int)i, b->speed, b->speed_error, true);
        s[1][count[1]++] = measured(b, (int)i, b->factor, b->factor_error, false);
        s[2][count[2]++] = measured(b, (int)i, b->against, b->against_error, false);
    }
    for (size_t i = 0; i <= LAWS; i++)
        s[0][count[0]++] = theory(&d->law[i], label[i], colour[i], d->law[i].speed);
    s[1][count[1]++] = theory(&d->law[0], "", -1, d->law[0].one);
    s[2][count[2]++] = theory(&d->law[LAWS], "", -1, d->law[LAWS].one);
    static const char *const y_label[] = {"settling speed (U0)", "speed-up: v/own law",
                                          "v/Eq. 20 - 1"};
    for (size_t i = 0; i < 3; i++)
        panel[i] = (struct report_panel){
            .y_label = y_label[i], .y_log = i == 0, .series_count = count[i], .series = s[i]};
    struct report_figure f = {
        .name = "settling-curve",
        .title = d->in->wanted->title ? d->in->wanted->title : "Settling speed (MFM, Fig. 4)",
        .caption = d->in->wanted->caption
                       ? d->in->wanted->caption
                       : "Mean over seeds with standard error. Above: measured speeds, the own law "
                         "of each Darcy law (with its cut-off below .25) and Eq. 20. Middle: what "
                         "density fluctuations add to the own law. Below: against Eq. 20; the "
                         "published law agrees with it because two effects cancel.",
        .alt = "Settling speed over solid fraction, its ratio to the own law and to Eq. 20",
        .x_label = "solid fraction of the plateau",
        .panel_count = 3,
        .panel = panel};
    return figure_add(out, &f, fault);
}

/* Relative standard deviation of v/own law over the seeds, from the error of its mean. */
static const char *scatter_text(const struct branch *b, size_t k, struct arena *a) {
    double scatter = b->factor_error[k] * sqrt((double)b->point[k]->run_count) / b->factor[k];
    return scatter > 0 ? arena_text(a, "%.1f %%", 100 * scatter) : "-";
}

static enum status tabulate(struct drawing *d, struct figure_output *out, struct fault *fault) {
    static const char *const heading[TABLE_COLUMNS] = {
        "law",        "start",     "height (l)", "solid fraction",
        "speed (U0)", "v/own law", "v/Eq. 20",   "seeds' scatter of v/own law"};
    size_t rows = 0, r = 0;
    for (size_t i = 0; i < BRANCHES; i++)
        rows += d->branch[i].count;
    const char **cell = arena_take(d->arena, rows * TABLE_COLUMNS, sizeof *cell);
    if (!cell)
        return no_memory(fault);
    for (size_t i = 0; i < BRANCHES; i++)
        for (size_t k = 0; k < d->branch[i].count; k++, r++) {
            const struct branch *b = &d->branch[i];
            const char **c = &cell[r * TABLE_COLUMNS];
            c[0] = b->darcy;
            c[1] = b->start;
            c[2] = arena_text(d->arena, "%g", measured_parameter(b->point[k], "height_l"));
            c[3] = arena_text(d->arena, "%.4f", b->rho[k]);
            c[4] = arena_text(d->arena, "%.4f", b->speed[k]);
            c[5] = arena_text(d->arena, "%.3f", b->factor[k]);
            c[6] = arena_text(d->arena, "%.3f", b->against[k] + 1);
            c[7] = scatter_text(b, k, d->arena);
        }
    for (size_t i = 0; i < rows * TABLE_COLUMNS; i++)
        if (!cell[i])
            return no_memory(fault);
    struct report_table t = {.title = "Settling speeds",
                             .caption =
                                 "Means over seeds; own law with its cut-off, taken seed by seed.",
                             .columns = TABLE_COLUMNS,
                             .rows = rows,
                             .heading = heading,
                             .cell = cell};
    return figure_add_table(out, &t, fault);
}

static enum status build(const struct figure_input *in, struct figure_output *out,
                         struct fault *fault) {
    struct drawing d = {.in = in, .arena = out->arena};
    if (figure_needs(in, "settling", fault))
        return fault->status;
    d.law[0].own = prediction_find("settling-own-law-published");
    d.law[1].own = prediction_find("settling-own-law-corrected");
    d.law[LAWS].own = d.eq20 = prediction_find("settling-eq20");
    enum status status = find_cut_off(&d, fault);
    if (!status)
        status = take_branches(&d, fault);
    if (!status)
        status = take_laws(&d, fault);
    if (!status)
        status = draw(&d, out, fault);
    return status ? status : tabulate(&d, out, fault);
}

const struct figure_recipe figure_settling_curve = {
    .name = "settling-curve",
    .title = "Settling speed over solid fraction, with both own laws and Eq. 20",
    .observables = 1,
    .build = build,
};
