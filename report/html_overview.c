/* html_overview.c -- the first screen: verdict, counts, worst margin, what was not run, where it
 * comes from, and the matrix of cases. */
#include "report/html.h"

#include "report/words.h"

#include <math.h>

enum { MAX_SYMBOLS = 60, RANKS = 5 };

static void put_banner(struct page *p) {
    const struct report *r = p->report;
    if (!r->modified)
        return;
    html_text(p, "<p class=\"banner\"><strong>MODIFIED.</strong> The solver was run with <code>",
              r->modification && *r->modification ? r->modification : "other parameters",
              "</code> behind the judge's back: the expectations are the cases', and this is no "
              "validation of the solver.</p>\n");
}

/* A pass of a modified solver is not shown in green. */
static void put_sentence(struct page *p) {
    static const char *const symbol[] = {"✓", "✗", "?", "≠"};
    enum verdict verdict = report_verdict(p->report);
    bool is_doubtful = p->report->modified && verdict == VERDICT_PASS;
    fprintf(p->out,
            "<h1 class=\"%s\"><span class=\"symbol\" aria-hidden=\"true\">%s</span> "
            "<span class=\"headline\">%s%s.</span> ",
            is_doubtful ? "inconclusive" : verdict_name(verdict), symbol[verdict],
            p->report->modified ? "MODIFIED, " : "", words_headline(p->report));
    words_sentence(p->out, p->report);
    fprintf(p->out, "</h1>\n");
}

static void put_count(struct page *p, const char *class, size_t count, const char *what) {
    fprintf(p->out, "<li class=\"%s%s\"><strong>%zu</strong> %s</li>\n", class,
            count == 0 ? " none" : "", count, what);
}

static void put_counts(struct page *p) {
    struct report_count n = report_tally(p->report);
    fprintf(p->out, "<ul class=\"counts\">\n");
    put_count(p, "pass", n.pass, n.pass == 1 ? "check passes" : "checks pass");
    put_count(p, "fail", n.fail, n.fail == 1 ? "check fails" : "checks fail");
    put_count(p, "inconclusive", n.inconclusive, "inconclusive");
    put_count(p, "known", n.known, n.known == 1 ? "known disagreement" : "known disagreements");
    put_count(p, "skipped", n.skipped, n.skipped == 1 ? "case not run" : "cases not run");
    fprintf(p->out, "</ul>\n");
}

/* The case that holds a row, and the row's place in it. */
static const struct report_case *case_of(const struct report *r, const struct report_row *row,
                                         size_t *index) {
    for (size_t i = 0; i < r->case_count; i++) {
        for (size_t k = 0; k < r->cases[i].row_count; k++) {
            if (&r->cases[i].row[k] == row) {
                *index = k;
                return &r->cases[i];
            }
        }
    }
    return NULL;
}

static void put_worst(struct page *p) {
    const struct report_row *row = report_worst(p->report);
    size_t index = 0;
    if (!row)
        return;
    const struct report_case *c = case_of(p->report, row, &index);
    double used = report_margin_used(row);
    fprintf(p->out, "<p class=\"worst\">%s: ",
            row->verdict == VERDICT_FAIL ? "Worst failure" : "Tightest margin");
    if (isnan(used))
        fprintf(p->out, "nothing measured by <a href=\"#");
    else
        fprintf(p->out, "<strong>%s</strong> of its tolerance used by <a href=\"#",
                words_margin(used).text);
    html_row_id(p, c, index);
    html_text(p, "\">", row->case_name, ", ");
    html_text(p, "", row->check, row->point && *row->point ? ", " : "");
    html_text(p, "", row->point, "</a>");
    if (row->verdict != VERDICT_PASS)
        html_text(p, ": ", row->reason, "");
    fprintf(p->out, "</p>\n");
}

static void put_allowance(struct page *p) {
    if (p->report->budget.statistical > 0) {
        fprintf(p->out, "<p class=\"budget\">");
        words_budget(p->out, p->report);
        fprintf(p->out, "</p>\n");
    }
    if (p->report->bits.same + p->report->bits.other > 0) {
        fprintf(p->out, "<p class=\"bits\">");
        words_bits(p->out, p->report);
        fprintf(p->out, "</p>\n");
    }
}

static void put_skipped(struct page *p) {
    const struct report *r = p->report;
    if (report_tally(r).skipped == 0) {
        fprintf(p->out, "<p class=\"notrun\">Every selected case was run.</p>\n");
        return;
    }
    fprintf(p->out, "<div class=\"notrun\"><p>Not run, and so not judged:</p>\n<ul>\n");
    for (size_t i = 0; i < r->case_count; i++) {
        if (!r->cases[i].skipped)
            continue;
        html_text(p, "<li><code>", r->cases[i].name, "</code>: ");
        html_text(p, "", r->cases[i].skip_reason, "</li>\n");
    }
    fprintf(p->out, "</ul></div>\n");
}

static void put_fact(struct page *p, const char *name, const char *value) {
    if (!value || !*value)
        return;
    html_text(p, "<li><b>", name, "</b> ");
    html_text(p, "", value, "</li>\n");
}

static void put_facts(struct page *p) {
    const struct report *r = p->report;
    fprintf(p->out, "<h2 class=\"quiet\">Where it comes from</h2>\n<ul class=\"facts\">\n");
    put_fact(p, "suite", r->suite);
    put_fact(p, "tier", r->tier);
    put_fact(p, "started", r->started);
    put_fact(p, "solver", r->solver);
    put_fact(p, "solver key", r->solver_key);
    for (size_t i = 0; i < r->fact_count; i++)
        put_fact(p, r->fact[i].name, r->fact[i].value);
    fprintf(p->out, "</ul>\n");
}

static void put_symbols(struct page *p, const struct report_case *c) {
    static const char *const symbol[] = {"✓", "✗", "?", "≠"};
    fprintf(p->out, "<td class=\"symbols\" aria-hidden=\"true\">");
    for (size_t i = 0; i < c->row_count && i < MAX_SYMBOLS; i++)
        fprintf(p->out, "<i class=\"%s\">%s</i>", verdict_name(c->row[i].verdict),
                symbol[c->row[i].verdict]);
    fprintf(p->out, "%s</td>", c->row_count > MAX_SYMBOLS ? "…" : "");
}

static void put_matrix_row(struct page *p, const struct report_case *c) {
    struct report one = {.cases = c, .case_count = 1};
    struct report_count n = report_tally(&one);
    fprintf(p->out, "<tr><td>");
    if (c->row_count == 0)
        fprintf(p->out,
                "<span class=\"verdict skipped\"><span class=\"symbol\" "
                "aria-hidden=\"true\">–</span> %s</span>",
                c->skipped ? "not run" : "no check");
    else
        html_verdict(p, html_case_verdict(c));
    fprintf(p->out, "</td><th scope=\"row\"><a href=\"#");
    html_case_id(p, c);
    html_text(p, "\">", c->name, "</a>");
    html_text(p, "<span class=\"title\">", c->title, "</span></th>");
    fprintf(p->out,
            "<td class=\"num\">%zu</td><td class=\"num\">%zu</td><td class=\"num\">%zu</td>"
            "<td class=\"num\">%zu</td>",
            n.pass, n.fail, n.inconclusive, n.known);
    put_symbols(p, c);
    fprintf(p->out, "<td>");
    if (report_worst(&one))
        html_margin(p, report_worst(&one));
    fprintf(p->out, "</td></tr>\n");
}

/* What needs a look stands first; within a rank the order of the cases stays. */
static int rank_of(const struct report_case *c) {
    if (c->row_count == 0)
        return RANKS - 1;
    static const int rank[] = {
        [VERDICT_FAIL] = 0, [VERDICT_INCONCLUSIVE] = 1, [VERDICT_KNOWN] = 2, [VERDICT_PASS] = 3};
    return rank[html_case_verdict(c)];
}

static void put_matrix(struct page *p) {
    fprintf(p->out, "<h2>Cases</h2>\n<div class=\"scroll\" tabindex=\"0\" role=\"region\" "
                    "aria-label=\"Verdict of each case\">\n<table class=\"matrix\">\n<thead><tr>"
                    "<th scope=\"col\">Verdict</th><th scope=\"col\">Case</th>"
                    "<th scope=\"col\" class=\"num\">Pass</th>"
                    "<th scope=\"col\" class=\"num\">Fail</th>"
                    "<th scope=\"col\" class=\"num\">Inconclusive</th>"
                    "<th scope=\"col\" class=\"num\">Known</th>"
                    "<th scope=\"col\" aria-hidden=\"true\">Check by check</th>"
                    "<th scope=\"col\">Worst margin used</th></tr></thead>\n<tbody>\n");
    for (int rank = 0; rank < RANKS; rank++) {
        for (size_t i = 0; i < p->report->case_count; i++) {
            if (rank_of(&p->report->cases[i]) == rank)
                put_matrix_row(p, &p->report->cases[i]);
        }
    }
    fprintf(p->out, "</tbody></table></div>\n");
}

void html_overview(struct page *p) {
    fprintf(p->out, "<header>\n");
    html_text(p, "<p class=\"kicker\">Validation report of ", p->report->suite, ", tier ");
    html_text(p, "", p->report->tier, "</p>\n");
    put_banner(p);
    put_sentence(p);
    put_counts(p);
    put_worst(p);
    put_allowance(p);
    put_skipped(p);
    put_facts(p);
    fprintf(p->out, "</header>\n<main id=\"cases\">\n");
    if (p->report->case_count > 0)
        put_matrix(p);
}
