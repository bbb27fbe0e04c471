/* html_overview.c -- the first screen: verdict, counts, and four answers: the worst margin, what
 * changed since the reference, what is not covered, which code on which machine. */
#include "report/html.h"

#include "report/words.h"

#include <math.h>
#include <string.h>

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
    fprintf(p->out, "<dt>%s</dt>\n<dd class=\"worst\"><p>",
            row->verdict == VERDICT_FAIL ? "Worst failure" : "Tightest margin");
    if (isnan(used))
        fprintf(p->out, "Nothing measured by <a href=\"#");
    else
        fprintf(p->out, "<strong>%s</strong> of its tolerance used by <a href=\"#",
                words_margin(used).text);
    html_row_id(p, c, index);
    html_text(p, "\">", row->case_name, ", ");
    html_text(p, "", row->check, row->point && *row->point ? ", " : "");
    html_text(p, "", row->point, "</a>");
    if (row->verdict != VERDICT_PASS)
        html_text(p, ": ", row->reason, "");
    else
        fprintf(p->out, ": %s, accepted %s", words_measured(row->measured, row->uncertainty).text,
                words_accepted(row).text);
    fprintf(p->out, "</p></dd>\n");
}

static void put_changes(struct page *p) {
    const struct report *r = p->report;
    fprintf(p->out, "<dt>Since the reference</dt>\n<dd><p class=\"changes\">");
    words_changes(p->out, r);
    fprintf(p->out, "</p>\n");
    if (words_has_bits(r)) {
        fprintf(p->out, "<p class=\"bits\">");
        words_bits(p->out, r);
        fprintf(p->out, "</p>\n");
    }
    if (r->budget.statistical > 0) {
        fprintf(p->out, "<p class=\"budget\">");
        words_budget(p->out, r);
        fprintf(p->out, "</p>\n");
    }
    fprintf(p->out, "</dd>\n");
}

static void put_skipped(struct page *p) {
    const struct report *r = p->report;
    fprintf(p->out, "<p>Not run, and so not judged:</p>\n<ul>\n");
    for (size_t i = 0; i < r->case_count; i++) {
        if (!r->cases[i].skipped)
            continue;
        html_text(p, "<li><code>", r->cases[i].name, "</code>: ");
        html_text(p, "", r->cases[i].skip_reason, "</li>\n");
    }
    fprintf(p->out, "</ul>\n");
}

static void put_not_covered(struct page *p) {
    const struct report *r = p->report;
    fprintf(p->out, "<dt>Not covered</dt>\n<dd class=\"notrun\">");
    if (report_tally(r).skipped > 0)
        put_skipped(p);
    fprintf(p->out, "<p>%s", report_tally(r).skipped > 0 ? "" : "Every selected case was run. ");
    if (r->unselected_count > 0)
        fprintf(p->out, "%zu more case%s of this tier w%s not asked for. ", r->unselected_count,
                r->unselected_count == 1 ? "" : "s", r->unselected_count == 1 ? "as" : "ere");
    fprintf(p->out, "<a href=\"#cover\">What no check here can see</a>");
    for (size_t i = 0; i < r->limit_count && i < 3; i++)
        html_text(p, i == 0 ? ": " : "; ", r->limit[i].what, "");
    fprintf(p->out, "%s</p></dd>\n",
            r->limit_count > 3   ? "; and more."
            : r->limit_count > 0 ? "."
                                 : " has a section of its own.");
}

static void put_fact(struct page *p, const char *name, const char *value) {
    if (!value || !*value)
        return;
    html_text(p, "<li><b>", name, "</b> ");
    html_text(p, "", value, "</li>\n");
}

/* Commit and machine belong on the first screen, versions of libraries at the end. */
static bool is_first(const struct report_fact *f) {
    static const char *const first[] = {"commit", "dirty", "cpu", "host", "all runs"};
    size_t length = strlen(f->name);
    for (size_t i = 0; i < sizeof first / sizeof *first; i++) {
        size_t n = strlen(first[i]);
        if (length >= n && strcmp(f->name + length - n, first[i]) == 0)
            return true;
    }
    return false;
}

/* Whether a build was of its commit, in words. */
static void put_named(struct page *p, const struct report_fact *f) {
    size_t length = strlen(f->name), n = strlen("dirty");
    if (length < n || strcmp(f->name + length - n, "dirty") != 0) {
        put_fact(p, f->name, f->value);
        return;
    }
    char name[80];
    snprintf(name, sizeof name, "%.*ssource tree", (int)(length - n), f->name);
    put_fact(p, name,
             f->value && strcmp(f->value, "dirty") == 0 ? "changed since that commit" : f->value);
}

static void put_facts(struct page *p, bool first) {
    const struct report *r = p->report;
    fprintf(p->out, "<ul class=\"facts\">\n");
    put_fact(p, first ? "started" : "suite", first ? r->started : r->suite);
    put_fact(p, first ? "solver" : "solver key", first ? r->solver : r->solver_key);
    for (size_t i = 0; i < r->fact_count; i++) {
        if (is_first(&r->fact[i]) == first)
            put_named(p, &r->fact[i]);
    }
    fprintf(p->out, "</ul>\n");
}

void html_origin(struct page *p) {
    fprintf(p->out, "<section id=\"origin\">\n<h2>Where it comes from</h2>\n");
    put_facts(p, false);
    fprintf(p->out, "</section>\n");
}

void html_overview(struct page *p) {
    fprintf(p->out, "<header>\n");
    html_text(p, "<p class=\"kicker\">Validation report of ", p->report->suite, ", tier ");
    html_text(p, "", p->report->tier, "</p>\n");
    put_banner(p);
    put_sentence(p);
    put_counts(p);
    fprintf(p->out, "<dl class=\"answers\">\n");
    put_worst(p);
    put_changes(p);
    put_not_covered(p);
    fprintf(p->out, "<dt>Made by</dt>\n<dd>");
    put_facts(p, true);
    fprintf(p->out, "</dd>\n</dl>\n</header>\n");
}
