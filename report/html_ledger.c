/* html_ledger.c -- the ledger: what the papers claim, what was measured, and what follows. */
#include "report/html.h"

#include "report/ledger.h"
#include "report/words.h"

#include <math.h>

/* Colours of the checks' verdicts: a claim that does not hold is no fault of the solver. */
static void put_badge(struct page *p, enum claim_verdict v) {
    static const struct {
        const char *class, *symbol;
    } look[CLAIM_VERDICTS] = {{"pass", "✓"},  {"known", "≠"},        {"inconclusive", "∅"},
                              {"known", "✗"}, {"inconclusive", "?"}, {"skipped", "–"}};
    fprintf(p->out,
            "<span class=\"verdict %s\"><span class=\"symbol\" aria-hidden=\"true\">%s</span> "
            "%s</span>",
            look[v].class, look[v].symbol, claim_verdict_name(v));
}

static void put_counts(struct page *p, const struct report_ledger *l) {
    static const char *const class[CLAIM_VERDICTS] = {"pass",  "known",        "inconclusive",
                                                      "known", "inconclusive", "skipped"};
    size_t count[CLAIM_VERDICTS];
    claim_tally(l, count);
    fprintf(p->out, "<ul class=\"counts\">\n");
    for (enum claim_verdict v = 0; v < CLAIM_VERDICTS; v++)
        fprintf(p->out, "<li class=\"%s%s\"><strong>%zu</strong> %s</li>\n", class[v],
                count[v] == 0 ? " none" : "", count[v], claim_verdict_name(v));
    fprintf(p->out, "</ul>\n");
}

/* One row's value and what is accepted, or the span of several. */
static void put_measured(struct page *p, const struct report_claim_test *t) {
    const struct report_row *row = &t->in->row[t->row[0]];
    double low = (double)INFINITY, high = -(double)INFINITY;
    for (size_t i = 0; i < t->row_count; i++) {
        low = fmin(low, t->in->row[t->row[i]].measured);
        high = fmax(high, t->in->row[t->row[i]].measured);
    }
    if (t->row_count == 1) {
        fprintf(p->out, "%s", words_measured(row->measured, row->uncertainty).text);
        html_text(p, "", words_unit(row->unit).text, "");
        fprintf(p->out, " (%s", words_accepted(row).text);
        html_text(p, "", words_unit(row->unit).text, ")");
    } else if (low <= high) {
        fprintf(p->out, "%s", words_number(low).text);
        if (low < high)
            fprintf(p->out, " to %s", words_number(high).text);
        html_text(p, "", words_unit(row->unit).text, "");
        fprintf(p->out, " at %zu points", t->row_count);
    } else {
        fprintf(p->out, "no number at %zu points", t->row_count);
    }
}

static void put_test(struct page *p, const struct report_claim_test *t) {
    static const char *const word[] = {
        [CLAIM_AS_SAID] = "", [CLAIM_CONTRARY] = "contrary", [CLAIM_OPEN] = "inconclusive"};
    bool there = t->in != NULL && t->row_count > 0;
    fprintf(p->out, "<li>");
    if (there) {
        fprintf(p->out, "<a href=\"#");
        html_row_id(p, t->in, t->row[0]);
        fprintf(p->out, "\">");
    }
    html_text(p, "", t->case_name, ", ");
    html_text(p, "", t->check, there ? "</a>" : "");
    if (*t->points != '\0')
        html_text(p, " [", t->points, "]");
    if (!there) {
        html_text(p, ": ", t->missing, "</li>\n");
        return;
    }
    fprintf(p->out, ": ");
    put_measured(p, t);
    fprintf(p->out, "%s%s%s</li>\n", t->wants_pass ? "" : ", has to fail",
            *word[t->result] == '\0' ? "" : ", ", word[t->result]);
}

static void put_tests(struct page *p, const struct report_claim *c) {
    if (c->test_count == 0) {
        html_text(p, "<p>No check: ", c->reason, "</p>");
        return;
    }
    fprintf(p->out, "<ul>\n");
    for (size_t i = 0; i < c->test_count; i++)
        put_test(p, &c->test[i]);
    fprintf(p->out, "</ul>");
}

static void put_stored(struct page *p, const struct report_claim *c) {
    if (c->stored != NULL)
        html_text(p, "<br><span class=\"caption\">stored: ", c->stored, "</span>");
    else if (c->is_tested)
        fprintf(p->out, "<br><span class=\"caption\">none stored</span>");
}

static void put_claim(struct page *p, const struct report_claim *c) {
    html_text(p, "<tr id=\"claim-", c->id, "\"><td>");
    put_badge(p, c->verdict);
    put_stored(p, c);
    html_text(p, "</td><th scope=\"row\"><span class=\"title\">", c->paper, ", ");
    html_text(p, "", c->where, "</span>");
    html_text(p, "<p>", c->says, "</p>");
    if (c->reading != NULL)
        html_text(p, "<p class=\"caption\">Read as: ", c->reading, "</p>");
    fprintf(p->out, "</th><td>");
    put_tests(p, c);
    html_text(p, "</td><td>", c->because, "");
    if (c->proof != NULL)
        html_text(p, " Proof: docs/theory.md, section ", c->proof, ".");
    fprintf(p->out, "</td></tr>\n");
}

/* The claims with (or without) a verdict from this run. */
static void put_table(struct page *p, const struct report_ledger *l, const char *label,
                      bool untested) {
    html_text(p, "<div class=\"scroll\" tabindex=\"0\" role=\"region\" aria-label=\"", label,
              "\">\n");
    fprintf(p->out, "<table class=\"ledger\">\n<thead><tr>"
                    "<th scope=\"col\">Verdict</th><th scope=\"col\">Claim</th>"
                    "<th scope=\"col\">Decided by, and measured</th>"
                    "<th scope=\"col\">Why, and what follows</th></tr></thead>\n<tbody>\n");
    for (size_t i = 0; i < l->count; i++) {
        if ((l->claim[i].verdict == CLAIM_NOT_TESTED) == untested)
            put_claim(p, &l->claim[i]);
    }
    fprintf(p->out, "</tbody></table></div>\n");
}

void html_ledger(struct page *p) {
    const struct report_ledger *l = p->report->ledger;
    if (l == NULL || l->count == 0)
        return;
    fprintf(p->out, "<section id=\"claims\">\n<h2>What the papers claim</h2>\n"
                    "<p>Verdicts are made from the rows below. None of them decides whether this "
                    "report passes; one that changes from a stored one does.</p>\n");
    put_counts(p, l);
    size_t count[CLAIM_VERDICTS];
    claim_tally(l, count);
    if (count[CLAIM_NOT_TESTED] < l->count)
        put_table(p, l, "Claims of the papers", false);
    if (count[CLAIM_NOT_TESTED] > 0) {
        fprintf(p->out, "<details><summary>%zu claim%s that this run does not test</summary>\n",
                count[CLAIM_NOT_TESTED], count[CLAIM_NOT_TESTED] == 1 ? "" : "s");
        put_table(p, l, "Claims that this run does not test", true);
        fprintf(p->out, "</details>\n");
    }
    fprintf(p->out, "</section>\n");
}
