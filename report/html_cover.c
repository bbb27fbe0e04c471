/* html_cover.c -- what this report does not cover: limits of the suite, cases that nobody asked
 * for, and the smallest change that each check would see. */
#include "report/html.h"

#include "report/words.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static void put_limits(struct page *p) {
    const struct report *r = p->report;
    if (r->limit_count == 0)
        return;
    fprintf(p->out, "<p>Whatever the verdicts, no check here can see:</p>\n<ul>\n");
    for (size_t i = 0; i < r->limit_count; i++) {
        html_text(p, "<li><b>", r->limit[i].what, "</b>");
        html_text(p, " (", r->limit[i].model, "): ");
        html_text(p, "", r->limit[i].because, "</li>\n");
    }
    fprintf(p->out, "</ul>\n");
}

static void put_unselected(struct page *p) {
    const struct report *r = p->report;
    if (r->unselected_count == 0)
        return;
    fprintf(p->out,
            "<details><summary>%zu case%s of this tier that nobody asked for here</summary>\n<p>",
            r->unselected_count, r->unselected_count == 1 ? "" : "s");
    for (size_t i = 0; i < r->unselected_count; i++)
        html_text(p, i == 0 ? "<code>" : ", <code>", r->unselected[i], "</code>");
    fprintf(p->out, ".</p></details>\n");
}

static double relative(const struct report_row *row) {
    return row->detectable / fabs(row->expected);
}

static bool is_known(const struct report_row *row) {
    return isfinite(row->detectable) && isfinite(relative(row));
}

/* The point of a check that sees least; NULL unless `first` is the check's first row. */
static const struct report_row *least_of(const struct report_case *c, size_t first) {
    const struct report_row *least = NULL;
    for (size_t i = 0; i < c->row_count; i++) {
        const struct report_row *row = &c->row[i];
        if (strcmp(row->check, c->row[first].check) != 0)
            continue;
        if (i < first)
            return NULL;
        if (is_known(row) && (!least || relative(row) > relative(least)))
            least = row;
    }
    return least;
}

static int compare_numbers(const void *a, const void *b) {
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* The median of the rows' smallest visible changes, their range, and how many have none. */
static void put_range(struct page *p, double *change, size_t known, size_t unknown) {
    qsort(change, known, sizeof *change, compare_numbers);
    fprintf(p->out, "<p>The smallest change that a check sees with 95 %% probability: ");
    fprintf(p->out, "%s of what is expected for half of them, ",
            words_margin(change[known / 2]).text);
    fprintf(p->out, "%s at best, ", words_margin(change[0]).text);
    fprintf(p->out, "%s at worst, over %zu rows.", words_margin(change[known - 1]).text, known);
    if (unknown > 0)
        fprintf(p->out,
                " For the %zu others that hang on scatter it is not known: their references are "
                "too few, or there are none.",
                unknown);
    fprintf(p->out, "</p>\n");
}

static void put_least(struct page *p, const struct report_case *c, const struct report_row *row) {
    html_text(p, "<tr><td>", c->name, "</td>");
    fprintf(p->out, "<th scope=\"row\"><a href=\"#");
    html_row_id(p, c, (size_t)(row - c->row));
    html_text(p, "\">", row->check, "</a> ");
    html_text(p, "<span class=\"title\">", row->point, "</span></th>");
    fprintf(p->out, "<td class=\"num\">%s", words_number(row->detectable).text);
    html_text(p, "", words_unit(row->unit).text, "</td>");
    fprintf(p->out, "<td class=\"num\">%s</td></tr>\n", words_margin(relative(row)).text);
}

static void put_table(struct page *p) {
    const struct report *r = p->report;
    fprintf(p->out,
            "<details><summary>Check by check, at the point that sees least</summary>\n"
            "<div class=\"scroll\" tabindex=\"0\" role=\"region\" "
            "aria-label=\"Smallest change seen\">\n<table class=\"data\">\n<thead><tr>"
            "<th scope=\"col\">Case</th><th scope=\"col\">Check</th>"
            "<th scope=\"col\" class=\"num\">Change seen with 95 %%</th>"
            "<th scope=\"col\" class=\"num\">of what is expected</th></tr></thead>\n<tbody>\n");
    for (size_t i = 0; i < r->case_count; i++) {
        for (size_t k = 0; k < r->cases[i].row_count; k++) {
            const struct report_row *row = least_of(&r->cases[i], k);
            if (row)
                put_least(p, &r->cases[i], row);
        }
    }
    fprintf(p->out, "</tbody></table></div></details>\n");
}

static enum status put_sensitivity(struct page *p, struct fault *fault) {
    const struct report *r = p->report;
    size_t known = 0, unknown = 0, rows = 0;
    for (size_t i = 0; i < r->case_count; i++)
        rows += r->cases[i].row_count;
    double *change = calloc(rows + 1, sizeof *change);
    if (!change)
        return fault_set(fault, STATUS_NO_MEMORY, "report: out of memory");
    for (size_t i = 0; i < r->case_count; i++) {
        for (size_t k = 0; k < r->cases[i].row_count; k++) {
            const struct report_row *row = &r->cases[i].row[k];
            if (is_known(row))
                change[known++] = relative(row);
            else
                unknown += row->statistical;
        }
    }
    if (known > 0) {
        put_range(p, change, known, unknown);
        put_table(p);
    } else if (unknown > 0) {
        fprintf(p->out,
                "<p>The smallest change that the %zu checks with scatter would see is not known: "
                "their references are too few, or there are none.</p>\n",
                unknown);
    }
    free(change);
    return STATUS_OK;
}

enum status html_cover(struct page *p, struct fault *fault) {
    fprintf(p->out, "<section id=\"cover\">\n<h2>What this does not cover</h2>\n");
    put_limits(p);
    put_unselected(p);
    enum status status = put_sensitivity(p, fault);
    fprintf(p->out,
            "<p>A check sees nothing of what its case does not run, and a tolerance is what "
            "it leaves unseen: each stands with its reason beside its check.</p>\n"
            "</section>\n");
    return status;
}
