/* history_plot.c -- trends across commits as one page; see history.h. */
#include "validation/history.h"

#include "common/file.h"
#include "report/draw.h"
#include "report/escape.h"
#include "report/words.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { COLOURS = 6 };

static const char style[] =
    "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
    "<meta name=\"viewport\" content=\"width=device-width\">\n"
    "<title>bedcheck: trends</title>\n<style>\n"
    "body { font: 16px/1.5 sans-serif; max-width: 60em; margin: 2em auto; padding: 0 1em; "
    "color: #222; background: #fff }\n"
    "table { border-collapse: collapse; font-size: 14px }\n"
    "td, th { padding: .2em .7em; border-bottom: 1px solid #ddd; text-align: left }\n"
    "figure { margin: 1em 0 } svg { max-width: 100%; height: auto }\n"
    "</style>\n</head>\n<body>\n";

struct page {
    FILE *out;
    struct arena arena;
    const struct history_line **line; /* of one tier, line[0 .. count-1] */
    size_t count;
    double *number; /* number[i] = i + 1: the x axis */
    int figures;
    struct fault *fault;
};

static enum status no_memory(struct page *p) {
    return fault_set(p->fault, STATUS_NO_MEMORY, "history: out of memory");
}

static void put_cell(FILE *out, const char *text) {
    fprintf(out, "<td>");
    escape_markup(out, text);
    fprintf(out, "</td>");
}

static void put_table(struct page *p) {
    fprintf(p->out, "<table>\n<tr><th>run</th><th>commit</th><th>started</th><th>verdict</th>"
                    "<th>pass</th><th>known</th><th>fail</th><th>inconclusive</th>"
                    "<th>worst margin</th></tr>\n");
    for (size_t i = 0; i < p->count; i++) {
        const struct history_line *l = p->line[i];
        char commit[64];
        snprintf(commit, sizeof commit, "%.12s%s", l->commit,
                 strcmp(l->dirty, "clean") == 0 ? "" : " (not clean)");
        fprintf(p->out, "<tr><td>%zu</td>", i + 1);
        put_cell(p->out, commit);
        put_cell(p->out, l->started);
        put_cell(p->out, l->verdict);
        fprintf(p->out, "<td>%zu</td><td>%zu</td><td>%zu</td><td>%zu</td><td>%s ", l->counts.pass,
                l->counts.known, l->counts.fail, l->counts.inconclusive,
                words_margin(l->worst_used).text);
        escape_markup(p->out, l->worst);
        fprintf(p->out, "</td></tr>\n");
    }
    fprintf(p->out, "</table>\n");
}

static enum status put_figure(struct page *p, const char *title, const char *caption,
                              const struct report_panel *panel, size_t panels) {
    struct report_figure f = {.name = "trend",
                              .title = title,
                              .caption = caption,
                              .alt = caption,
                              .x_label = "run",
                              .panel_count = panels,
                              .panel = panel};
    struct sheet svg;
    char prefix[32];
    snprintf(prefix, sizeof prefix, "trend%d-", p->figures++);
    enum status status = draw_figure(&f, prefix, &svg, p->fault);
    if (status != STATUS_OK)
        return status;
    fprintf(p->out, "<h3>");
    escape_markup(p->out, title);
    fprintf(p->out, "</h3>\n<figure>\n%s\n<figcaption>", svg.text);
    escape_markup(p->out, caption);
    fprintf(p->out, "</figcaption>\n</figure>\n");
    sheet_free(&svg);
    return STATUS_OK;
}

/* -- the whole suite --------------------------------------------------------------- */

enum overview { NOT_PASSED, KNOWN, MARGIN, SECONDS, OVERVIEW_COUNT };

static double overview_of(const struct history_line *l, enum overview what) {
    switch (what) {
    case NOT_PASSED:
        return (double)(l->counts.fail + l->counts.inconclusive);
    case KNOWN:
        return (double)l->counts.known;
    case MARGIN:
        return 100 * l->worst_used;
    default:
        return isnan(l->cpu_s) ? l->wall_s : l->cpu_s;
    }
}

static enum status put_overview(struct page *p) {
    static const char *const label[OVERVIEW_COUNT] = {"fail or inconclusive", "known", "", ""};
    struct report_series series[OVERVIEW_COUNT];
    for (int k = 0; k < OVERVIEW_COUNT; k++) {
        double *y = arena_take(&p->arena, p->count, sizeof *y);
        if (y == NULL)
            return no_memory(p);
        for (size_t i = 0; i < p->count; i++)
            y[i] = overview_of(p->line[i], (enum overview)k);
        series[k] = (struct report_series){
            label[k], SERIES_LINE_POINTS, k == KNOWN ? 4 : 0, p->count, p->number, y, NULL};
    }
    struct report_panel panel[] = {
        {.y_label = "checks", .series_count = 2, .series = &series[NOT_PASSED]},
        {.y_label = "worst margin, %", .y_log = true, .series_count = 1, .series = &series[MARGIN]},
        {.y_label = "seconds", .series_count = 1, .series = &series[SECONDS]}};
    return put_figure(p, "The whole suite",
                      "Checks that did not pass; the largest share of a tolerance that any check "
                      "used; seconds of the solver, all runs.",
                      panel, 3);
}

/* -- one case ---------------------------------------------------------------------- */

static const struct history_value *find_value(const struct history_line *l,
                                              const struct history_value *like) {
    for (size_t i = 0; i < l->value_count; i++) {
        const struct history_value *v = &l->value[i];
        if (strcmp(v->case_name, like->case_name) == 0 && strcmp(v->check, like->check) == 0 &&
            strcmp(v->point, like->point) == 0)
            return v;
    }
    return NULL;
}

/* Distance from the expectation in tolerances, so that all observables share an axis. */
static enum status make_series(struct page *p, const struct history_value *like, int colour,
                               struct report_series *out) {
    double *y = arena_take(&p->arena, p->count, sizeof *y);
    double *error = arena_take(&p->arena, p->count, sizeof *error);
    const char *label = arena_text(&p->arena, "%s [%s]", like->check, like->point);
    if (y == NULL || error == NULL || label == NULL)
        return no_memory(p);
    for (size_t i = 0; i < p->count; i++) {
        const struct history_value *v = find_value(p->line[i], like);
        double unit = v == NULL ? NAN : v->tolerance > 0 ? v->tolerance : fabs(v->expected);
        y[i] = unit > 0 ? (v->measured - v->expected) / unit : NAN;
        error[i] = unit > 0 && isfinite(v->uncertainty) ? v->uncertainty / unit : 0;
    }
    *out = (struct report_series){label, SERIES_LINE_POINTS, colour, p->count, p->number, y, error};
    return STATUS_OK;
}

/* What one line first names is drawn; each check and point once. */
static bool is_first(const struct page *p, size_t line, size_t value) {
    const struct history_value *like = &p->line[line]->value[value];
    for (size_t i = 0; i < line; i++) {
        if (find_value(p->line[i], like) != NULL)
            return false;
    }
    return find_value(p->line[line], like) == like;
}

static enum status flush_case(struct page *p, const char *name, struct report_series *series,
                              size_t *count) {
    struct report_panel panel = {
        .y_label = "(measured - expected) / tolerance", .series_count = *count, .series = series};
    if (*count == 0)
        return STATUS_OK;
    *count = 0;
    return put_figure(p, name,
                      "Distance from the expectation in tolerances, with standard uncertainties; a "
                      "check without margin in parts of its expectation.",
                      &panel, 1);
}

static enum status put_case(struct page *p, const char *name) {
    struct report_series series[COLOURS];
    size_t count = 0;
    enum status status = STATUS_OK;
    for (size_t i = 0; i < p->count; i++) {
        for (size_t k = 0; k < p->line[i]->value_count && status == STATUS_OK; k++) {
            const struct history_value *v = &p->line[i]->value[k];
            if (strcmp(v->case_name, name) != 0 || !is_first(p, i, k))
                continue;
            status = make_series(p, v, (int)count, &series[count]);
            if (status == STATUS_OK && ++count == COLOURS)
                status = flush_case(p, name, series, &count);
        }
    }
    return status == STATUS_OK ? flush_case(p, name, series, &count) : status;
}

static bool is_first_of_case(const struct page *p, size_t line, size_t value) {
    const char *name = p->line[line]->value[value].case_name;
    for (size_t i = 0; i <= line; i++) {
        size_t end = i == line ? value : p->line[i]->value_count;
        for (size_t k = 0; k < end; k++) {
            if (strcmp(p->line[i]->value[k].case_name, name) == 0)
                return false;
        }
    }
    return true;
}

static enum status put_cases(struct page *p) {
    enum status status = STATUS_OK;
    for (size_t i = 0; i < p->count; i++) {
        for (size_t k = 0; k < p->line[i]->value_count && status == STATUS_OK; k++) {
            if (is_first_of_case(p, i, k))
                status = put_case(p, p->line[i]->value[k].case_name);
        }
    }
    return status;
}

/* -- all tiers --------------------------------------------------------------------- */

static enum status put_tier(struct page *p, const struct history *h, const char *tier) {
    p->count = 0;
    p->line = arena_take(&p->arena, h->count, sizeof *p->line);
    p->number = arena_take(&p->arena, h->count, sizeof *p->number);
    if (p->line == NULL || p->number == NULL)
        return no_memory(p);
    for (size_t i = 0; i < h->count; i++) {
        if (strcmp(h->line[i].tier, tier) != 0 || h->line[i].modification != NULL)
            continue;
        p->line[p->count] = &h->line[i];
        p->number[p->count] = (double)p->count + 1;
        p->count++;
    }
    if (p->count == 0)
        return STATUS_OK;
    fprintf(p->out, "<h2>Tier ");
    escape_markup(p->out, tier);
    fprintf(p->out, "</h2>\n");
    put_table(p);
    enum status status = put_overview(p);
    return status == STATUS_OK ? put_cases(p) : status;
}

static bool is_first_of_tier(const struct history *h, size_t line) {
    for (size_t i = 0; i < line; i++) {
        if (strcmp(h->line[i].tier, h->line[line].tier) == 0)
            return false;
    }
    return true;
}

static enum status put_page(struct page *p, const struct history *h) {
    size_t modified = 0;
    enum status status = STATUS_OK;
    fprintf(p->out, "%s<h1>Trends</h1>\n", style);
    for (size_t i = 0; i < h->count; i++)
        modified += h->line[i].modification != NULL;
    fprintf(p->out, "<p>%zu runs of the suite%s.</p>\n", h->count - modified,
            modified > 0 ? "; MODIFIED ones are left out" : "");
    for (size_t i = 0; i < h->count && status == STATUS_OK; i++) {
        if (is_first_of_tier(h, i))
            status = put_tier(p, h, h->line[i].tier);
    }
    fprintf(p->out, "</body>\n</html>\n");
    return status;
}

enum status history_plot(const struct history *h, const char *folder, struct fault *fault) {
    struct sheet sheet;
    char *path = file_join(folder, "index.html");
    enum status status = path == NULL ? fault_set(fault, STATUS_NO_MEMORY, "out of memory")
                                      : file_make_folder(folder, fault);
    if (status == STATUS_OK && (status = sheet_open(&sheet, fault)) == STATUS_OK) {
        struct page p = {.out = sheet.out, .fault = fault};
        status = put_page(&p, h);
        if (status == STATUS_OK)
            status = sheet_save(&sheet, path, fault);
        arena_free(&p.arena);
        sheet_free(&sheet);
    }
    free(path);
    return status;
}
