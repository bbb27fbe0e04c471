/* html_rows.c -- a case's rows: one table a check, what failed in full, and its runs.
 *
 * Rows of one check share its name, observable, kind and reason for the
 * tolerance: these are said once, above the table of its points.
 */
#include "report/html.h"

#include "report/words.h"

#include <math.h>
#include <string.h>

static bool same(const char *a, const char *b) {
    return strcmp(a ? a : "", b ? b : "") == 0;
}

static bool same_check(const struct report_row *a, const struct report_row *b) {
    return same(a->check, b->check) && same(a->because, b->because) && same(a->kind, b->kind) &&
           same(a->comparison, b->comparison) && same(a->observable, b->observable) &&
           same(a->unit, b->unit);
}

void html_margin(struct page *p, const struct report_row *row) {
    double used = report_margin_used(row);
    double part = isnan(used) ? row->verdict == VERDICT_FAIL : fmin(used, 1);
    fprintf(p->out, "<span class=\"margin %s\" style=\"--part:%.0f%%\">%s</span>",
            verdict_name(row->verdict), 100 * part, words_margin(used).text);
}

static void put_check_head(struct page *p, const struct report_row *row) {
    html_text(p, "<h4>", row->check, "</h4>\n");
    html_text(p, "<p class=\"meta\"><code>", row->observable, "</code>");
    if (*words_unit(row->unit).text)
        html_text(p, " in ", row->unit, "");
    if (row->kind && *row->kind)
        html_text(p, ", kind of tolerance: ", row->kind, "");
    fprintf(p->out, "</p>\n");
    if (row->because && *row->because)
        html_text(p, "<p class=\"because\"><b>Because:</b> ", row->because, "</p>\n");
}

static void put_row(struct page *p, const struct report_case *c, size_t i) {
    const struct report_row *row = &c->row[i];
    bool is_plain = same(row->comparison, "within") || same(row->comparison, "");
    fprintf(p->out, "<tr id=\"");
    html_row_id(p, c, i);
    fprintf(p->out, "\"><td>");
    html_verdict(p, row->verdict);
    html_text(p, "</td><th scope=\"row\">", row->point, "</th>");
    fprintf(p->out, "<td class=\"num\">%s</td>",
            words_measured(row->measured, row->uncertainty).text);
    html_text(p, "<td class=\"num\">", is_plain ? "" : row->comparison, is_plain ? "" : " ");
    fprintf(p->out, "%s</td><td class=\"num\">%s</td><td>",
            words_measured(row->expected, row->expected_uncertainty).text,
            words_tolerance(row).text);
    html_margin(p, row);
    html_text(p, "</td><td class=\"reason\">", row->reason, "</td></tr>\n");
}

static void put_table(struct page *p, const struct report_case *c, size_t first) {
    html_text(p, "<div class=\"scroll\" tabindex=\"0\" role=\"region\" aria-label=\"Rows of check ",
              c->row[first].check, "\">\n<table class=\"rows\">\n<thead><tr>");
    fprintf(p->out, "<th scope=\"col\">Verdict</th><th scope=\"col\">Point</th>"
                    "<th scope=\"col\" class=\"num\">Measured</th>"
                    "<th scope=\"col\" class=\"num\">Expected</th>"
                    "<th scope=\"col\" class=\"num\">Tolerance</th>"
                    "<th scope=\"col\">Margin used</th>"
                    "<th scope=\"col\">Reason</th></tr></thead>\n<tbody>\n");
    for (size_t i = first; i < c->row_count; i++) {
        if (same_check(&c->row[i], &c->row[first]))
            put_row(p, c, i);
    }
    fprintf(p->out, "</tbody></table></div>\n");
}

static void put_point(struct page *p, const struct report_row *row) {
    if (row->point && *row->point)
        html_text(p, " at ", row->point, "");
}

/* What a reader of a red row needs next, without opening anything. */
static void put_trouble(struct page *p, const struct report_row *row) {
    fprintf(p->out, "<div class=\"trouble %s\">\n<p>", verdict_name(row->verdict));
    html_verdict(p, row->verdict);
    put_point(p, row);
    html_text(p, ": ", row->reason, "</p>\n");
    if (row->repeat && *row->repeat) {
        fprintf(p->out, "<div class=\"again\"><p>To repeat it:</p>\n");
        html_pre(p, row->repeat);
        fprintf(p->out, "</div>\n");
    }
    if (row->log_end && *row->log_end) {
        fprintf(p->out, "<p>The log ends:</p>\n");
        html_pre(p, row->log_end);
    }
    fprintf(p->out, "</div>\n");
}

/* A run's name; where only the seed differs from the one before, as "s5102" alone. */
static const char *short_name(const char *run, const char *before) {
    const char *seed = strrchr(run, '-');
    size_t same = seed == NULL ? 0 : (size_t)(seed - run) + 1;
    return before != NULL && same > 0 && strncmp(run, before, same) == 0 ? seed + 1 : run;
}

static void put_runs_of(struct page *p, const struct report_row *row) {
    html_text(p, "<dt>", row->point && *row->point ? row->point : "the only point", "");
    fprintf(p->out, "</dt>\n<dd><p>");
    for (size_t i = 0; i < row->run_count; i++)
        html_text(p, i > 0 ? ", <code>" : "<code>",
                  short_name(row->runs[i], i > 0 ? row->runs[i - 1] : NULL), "</code>");
    if (isfinite(row->seconds) && row->seconds > 0)
        fprintf(p->out, "%s%s", row->run_count > 0 ? "; " : "", words_seconds(row->seconds).text);
    fprintf(p->out, "</p>\n");
    if (row->repeat && *row->repeat)
        html_pre(p, row->repeat);
    fprintf(p->out, "</dd>\n");
}

static void put_runs(struct page *p, const struct report_case *c, size_t first) {
    size_t runs = 0;
    for (size_t i = first; i < c->row_count; i++) {
        if (same_check(&c->row[i], &c->row[first]))
            runs += c->row[i].run_count;
    }
    if (runs == 0)
        return;
    html_text(p, "<details><summary>Seeds and runs of ", c->row[first].check,
              ", and how to repeat them</summary>\n<dl class=\"runs\">\n");
    for (size_t i = first; i < c->row_count; i++) {
        if (same_check(&c->row[i], &c->row[first]))
            put_runs_of(p, &c->row[i]);
    }
    fprintf(p->out, "</dl></details>\n");
}

static bool is_first_of_check(const struct report_case *c, size_t row) {
    for (size_t i = 0; i < row; i++) {
        if (same_check(&c->row[i], &c->row[row]))
            return false;
    }
    return true;
}

void html_rows(struct page *p, const struct report_case *c) {
    if (c->row_count == 0)
        return;
    fprintf(p->out, "<h3>Checks</h3>\n");
    for (size_t i = 0; i < c->row_count; i++) {
        if (!is_first_of_check(c, i))
            continue;
        fprintf(p->out, "<div class=\"check\">\n");
        put_check_head(p, &c->row[i]);
        put_table(p, c, i);
        for (size_t k = i; k < c->row_count; k++) {
            if (c->row[k].verdict != VERDICT_PASS && same_check(&c->row[k], &c->row[i]))
                put_trouble(p, &c->row[k]);
        }
        put_runs(p, c, i);
        fprintf(p->out, "</div>\n");
    }
}
