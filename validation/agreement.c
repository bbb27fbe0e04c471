#include "validation/agreement.h"

#include <gsl/gsl_cdf.h>
#include <math.h>
#include <string.h>

enum { MAX_GROUPS = 5, PANELS = 3, LINES = 4, NO_CASE = -1 };

struct sample {
    double x, noise2; /* ln(measured/expected); its relative variance */
    long index;       /* of its case */
    const struct report_case *in;
    const struct report_row *row;
};

struct survey {
    struct report_agreement *out;
    struct arena *arena;
    struct sample *sample;
    size_t count;
    struct report_group *group;
    struct fault *fault;
};

static enum status no_memory(struct survey *s) {
    return fault_set(s->fault, STATUS_NO_MEMORY, "agreement: out of memory");
}

static bool is(const char *text, const char *other) {
    return strcmp(text == NULL ? "" : text, other) == 0;
}

static double square(double x) {
    return x * x;
}

/* A row without an uncertainty has none. */
static double part2(double uncertainty, double value) {
    return isfinite(uncertainty) ? square(uncertainty / value) : 0;
}

static void take(struct survey *s, const struct report_case *c, long index,
                 const struct report_row *row) {
    double ratio = row->measured / row->expected;
    bool is_within = row->comparison == NULL || is(row->comparison, "within");
    if (is(row->kind, "round-off"))
        s->out->round_off++;
    else if (is(row->comparison, "at most") || is(row->comparison, "at least"))
        s->out->one_sided++;
    else if (!is_within || is(row->kind, "regression") || is(row->kind, "claim") || !(ratio > 0) ||
             !isfinite(ratio) || !(row->tolerance > 0 && row->tolerance < fabs(row->expected) / 2))
        s->out->other++;
    else
        s->sample[s->count++] = (struct sample){log(ratio),
                                                part2(row->uncertainty, row->measured) +
                                                    part2(row->expected_uncertainty, row->expected),
                                                index, c, row};
}

/* -- a group ---------------------------------------------------------------------------- */

static bool is_of(const struct sample *s, const char *model) {
    size_t length = model == NULL ? 0 : strlen(model);
    return model == NULL ||
           (strncmp(s->in->name, model, length) == 0 && s->in->name[length] == '/');
}

struct moments {
    size_t rows;
    double mean, deviation, noise;
};

/* Of a model's samples but those of one case. */
static struct moments moments_of(const struct survey *s, const char *model, long without) {
    struct moments m = {0};
    double sum2 = 0, noise2 = 0;
    for (int pass = 0; pass < 2; pass++) {
        for (size_t i = 0; i < s->count; i++) {
            const struct sample *one = &s->sample[i];
            if (!is_of(one, model) || one->index == without)
                continue;
            m.rows += pass == 0;
            m.mean += pass == 0 ? one->x : 0;
            noise2 += pass == 0 ? one->noise2 : 0;
            sum2 += pass == 1 ? square(one->x - m.mean) : 0;
        }
        m.mean = pass == 0 && m.rows > 0 ? m.mean / (double)m.rows : m.mean;
    }
    m.deviation = m.rows > 1 ? sqrt(sum2 / ((double)m.rows - 1)) : (double)NAN;
    m.noise = m.rows > 0 ? sqrt(noise2 / (double)m.rows) : (double)NAN;
    return m;
}

static bool has_case(const struct survey *s, const char *model, long index) {
    for (size_t i = 0; i < s->count; i++) {
        if (s->sample[i].index == index && is_of(&s->sample[i], model))
            return true;
    }
    return false;
}

/* Sums over the cases left out, one after the other, of theta = <x> and ln s. */
static void judge_group(const struct survey *s, struct report_group *g, const char *model,
                        long cases) {
    struct moments all = moments_of(s, model, NO_CASE);
    double sum[2] = {0}, sum2[2] = {0}, half[2];
    for (long c = 0; c < cases; c++) {
        if (!has_case(s, model, c))
            continue;
        struct moments m = moments_of(s, model, c);
        const double theta[2] = {m.mean - all.mean, log(m.deviation / all.deviation)};
        for (int k = 0; k < 2; k++) {
            sum[k] += theta[k];
            sum2[k] += square(theta[k]);
        }
        g->cases++;
    }
    double n = (double)g->cases;
    for (int k = 0; k < 2; k++) {
        half[k] = (double)NAN;
        if (g->cases > 2)
            half[k] = gsl_cdf_tdist_Pinv(.975, n - 1) *
                      sqrt((n - 1) / n * fmax(sum2[k] - square(sum[k]) / n, 0));
    }
    g->rows = all.rows;
    g->bias = exp(all.mean);
    g->bias_low = exp(all.mean - half[0]);
    g->bias_high = exp(all.mean + half[0]);
    g->scatter = all.deviation;
    g->scatter_low = all.deviation * exp(-half[1]);
    g->scatter_high = all.deviation * exp(half[1]);
    g->noise = all.noise;
}

static enum status judge_groups(struct survey *s, long cases) {
    struct report_group *g = s->group = arena_take(s->arena, MAX_GROUPS + 1, sizeof *g);
    size_t count = 0;
    if (g == NULL)
        return no_memory(s);
    for (size_t i = 0; i < s->count; i++) {
        const char *name = s->sample[i].in->name;
        bool is_new = true;
        for (size_t k = 0; k < count; k++)
            is_new = is_new && !is_of(&s->sample[i], g[k].name);
        if (!is_new || count == MAX_GROUPS)
            continue;
        g[count].name = arena_text(s->arena, "%.*s", (int)strcspn(name, "/"), name);
        if (g[count].name == NULL)
            return no_memory(s);
        judge_group(s, &g[count], g[count].name, cases);
        count++;
    }
    if (count > 1) {
        g[count].name = "all";
        judge_group(s, &g[count++], NULL, cases);
    }
    s->out->group = g;
    s->out->group_count = count;
    return STATUS_OK;
}

/* -- the plot --------------------------------------------------------------------------- */

/* Of one group, what panel 0, 1 or 2 shows over |expected|. */
static enum status draw_points(struct survey *s, int panel, int colour,
                               const struct report_group *g, struct report_series *out) {
    double *x = arena_take(s->arena, g->rows, sizeof *x);
    double *y = arena_take(s->arena, g->rows, sizeof *y);
    size_t n = 0;
    if (x == NULL || y == NULL)
        return no_memory(s);
    for (size_t i = 0; i < s->count; i++) {
        const struct report_row *row = s->sample[i].row;
        if (!is_of(&s->sample[i], g->name))
            continue;
        x[n] = fabs(row->expected);
        y[n++] = panel == 0   ? fabs(row->measured)
                 : panel == 1 ? row->measured / row->expected
                              : (row->measured - row->expected) / row->tolerance;
    }
    *out = (struct report_series){g->name, SERIES_POINTS, colour, n, x, y, NULL};
    return STATUS_OK;
}

static enum status draw_line(struct survey *s, const char *label, enum series_style style,
                             const double *x, double y0, double y1, struct report_series *out) {
    double *y = arena_take(s->arena, 2, sizeof *y);
    if (y == NULL)
        return no_memory(s);
    y[0] = y0;
    y[1] = y1;
    *out = (struct report_series){label, style, -1, 2, x, y, NULL};
    return STATUS_OK;
}

static enum status draw_lines(struct survey *s, int panel, const double *x,
                              struct report_series *out, size_t *count) {
    const struct report_group *all = &s->group[s->out->group_count - 1];
    double wide = exp(2 * all->scatter);
    enum status status;
    if (panel == 0) {
        *count = 1;
        return draw_line(s, "measured = expected", SERIES_LINE, x, x[0], x[1], &out[0]);
    }
    const double at[2][3] = {{all->bias, all->bias / wide, all->bias * wide}, {0, -1, 1}};
    const char *const label[2][3] = {{"bias", "bias and twice the scatter", ""},
                                     {"", "tolerance", ""}};
    for (*count = 0; *count < 3; ++*count) {
        double y = at[panel - 1][*count];
        status = draw_line(s, label[panel - 1][*count], *count == 0 ? SERIES_LINE : SERIES_DASHED,
                           x, y, y, &out[*count]);
        if (status != STATUS_OK)
            return status;
    }
    return STATUS_OK;
}

static enum status draw_panel(struct survey *s, int panel, const double *x,
                              struct report_panel *out) {
    static const char *const label[] = {"|measured|", "ratio", "of tolerance"};
    size_t groups = s->out->group_count > 1 ? s->out->group_count - 1 : 1, lines = 0;
    struct report_series *series = arena_take(s->arena, groups + LINES, sizeof *series);
    if (series == NULL)
        return no_memory(s);
    enum status status = draw_lines(s, panel, x, series, &lines);
    for (size_t i = 0; i < groups && status == STATUS_OK; i++)
        status = draw_points(s, panel, (int)i, &s->group[i], &series[lines + i]);
    *out = (struct report_panel){.y_label = label[panel],
                                 .y_log = panel == 0,
                                 .series_count = lines + groups,
                                 .series = series};
    return status;
}

static enum status draw(struct survey *s) {
    struct report_panel *panel = arena_take(s->arena, PANELS, sizeof *panel);
    double *x = arena_take(s->arena, 2, sizeof *x);
    enum status status = STATUS_OK;
    if (panel == NULL || x == NULL)
        return no_memory(s);
    x[0] = (double)INFINITY;
    for (size_t i = 0; i < s->count; i++) {
        x[0] = fmin(x[0], fabs(s->sample[i].row->expected));
        x[1] = fmax(x[1], fabs(s->sample[i].row->expected));
    }
    for (int k = 0; k < PANELS && status == STATUS_OK; k++)
        status = draw_panel(s, k, x, &panel[k]);
    s->out->figure = (struct report_figure){
        .name = "agreement",
        .title = "Measured against expected, all checks",
        .caption = "Every check that compares a number with a number, each in its own unit. Above: "
                   "all should lie on the line. Middle: the ratio, with the bias and twice the "
                   "scatter of all. Below: the difference in units of each check's tolerance; "
                   "between the dashed lines it passes.",
        .alt = "Measured over expected for all checks on logarithmic axes, their ratio, and their "
               "difference in units of the tolerance; the table above has bias and scatter.",
        .x_label = "|expected|",
        .x_log = true,
        .panel_count = PANELS,
        .panel = panel};
    return status;
}

enum status agreement_add(struct report *r, struct arena *a, struct fault *fault) {
    size_t rows = 0;
    for (size_t i = 0; i < r->case_count; i++)
        rows += r->cases[i].row_count;
    struct survey s = {.arena = a,
                       .out = arena_take(a, 1, sizeof *s.out),
                       .sample = arena_take(a, rows, sizeof *s.sample),
                       .fault = fault};
    if (s.out == NULL || s.sample == NULL)
        return no_memory(&s);
    for (size_t i = 0; i < r->case_count; i++) {
        for (size_t k = 0; k < r->cases[i].row_count; k++)
            take(&s, &r->cases[i], (long)i, &r->cases[i].row[k]);
    }
    if (s.count < 2)
        return STATUS_OK;
    enum status status = judge_groups(&s, (long)r->case_count);
    if (status == STATUS_OK)
        status = draw(&s);
    if (status == STATUS_OK)
        r->agreement = s.out;
    return status;
}
