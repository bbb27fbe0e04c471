/* markdown.c -- summary.md: the verdict for a merge request or a job's page.
 *
 * First the sentence, counts and worst margin, then each failed or undecided
 * row in full, then all rows in one compact table.  Hosts cut summaries off at
 * 1 MB: rows that do not fit are counted, and results.json has them all.
 */
#include "report/escape.h"
#include "report/ledger.h"
#include "report/report.h"
#include "report/sheet.h"
#include "report/words.h"

#include <math.h>
#include <string.h>

enum { DETAIL_LIMIT = 600 * 1000, SIZE_LIMIT = 980 * 1000, ONE_ROW_LIMIT = 60 * 1000 };

static const char *symbol(enum verdict v) {
    static const char *const text[] = {"✓ pass", "✗ **FAIL**", "? **inconclusive**", "≠ known"};
    return text[v];
}

static void put_value(FILE *out, struct words value, const char *unit) {
    fprintf(out, "%s", value.text);
    escape_markdown(out, words_unit(unit).text);
}

static void put_item(FILE *out, const char *name, const char *text) {
    if (!text || !*text)
        return;
    fprintf(out, "- %s: ", name);
    escape_markdown(out, text);
    fprintf(out, "\n");
}

/* Indented code: nothing in it has a meaning.  Foreign control characters go. */
static void put_log(FILE *out, const char *log) {
    if (!log || !*log)
        return;
    fprintf(out, "\nThe log ends:\n\n    ");
    for (const char *s = log; *s; s++) {
        if (*s == '\n' && s[1])
            fprintf(out, "\n    ");
        else if ((unsigned char)*s >= 0x20 && *s != 0x7f)
            fputc(*s, out);
    }
    fprintf(out, "\n");
}

static void put_detail(FILE *out, const struct report_row *row) {
    static const char *const sign[] = {"✓", "✗", "?", "≠"};
    static const char *const said[] = {"passed", "failed", "inconclusive", "known"};
    fprintf(out, "\n### %s ", sign[row->verdict]);
    escape_markdown(out, row->case_name);
    fprintf(out, ": ");
    escape_markdown(out, row->check);
    if (row->point && *row->point) {
        fprintf(out, ", ");
        escape_markdown(out, row->point);
    }
    fprintf(out, "\n\n");
    put_item(out, said[row->verdict], row->reason);
    fprintf(out, "- measured: ");
    put_value(out, words_measured(row->measured, row->uncertainty), row->unit);
    fprintf(out, "; expected: ");
    put_value(out, words_measured(row->expected, row->expected_uncertainty), row->unit);
    fprintf(out, "; accepted: ");
    put_value(out, words_accepted(row), row->unit);
    fprintf(out, "; margin used: %s\n", words_margin(report_margin_used(row)).text);
    put_item(out, "observable", row->observable);
    put_item(out, "because", row->because);
    put_item(out, "repeat", row->repeat);
    put_log(out, row->log_end);
}

static void put_compact(FILE *out, const struct report_row *row) {
    fprintf(out, "| %s | ", symbol(row->verdict));
    escape_markdown(out, row->case_name);
    fprintf(out, " | ");
    escape_markdown(out, row->check);
    fprintf(out, " | ");
    escape_markdown(out, row->point);
    fprintf(out, " | ");
    put_value(out, words_measured(row->measured, row->uncertainty), row->unit);
    fprintf(out, " | %s | %s |\n", words_accepted(row).text,
            words_margin(report_margin_used(row)).text);
}

/* Print one row if it fits below the limit. */
static enum status put_if_it_fits(FILE *out, const struct report_row *row, long limit,
                                  void (*put)(FILE *, const struct report_row *), size_t *left_out,
                                  struct fault *fault) {
    struct sheet one;
    enum status status = sheet_open(&one, fault);
    if (status)
        return status;
    put(one.out, row);
    status = sheet_close(&one, fault);
    if (!status) {
        if (one.length <= ONE_ROW_LIMIT && ftell(out) + (long)one.length <= limit)
            fwrite(one.text, 1, one.length, out);
        else
            ++*left_out;
    }
    sheet_free(&one);
    return status;
}

static enum status put_rows(FILE *out, const struct report *r, bool only_bad, long limit,
                            void (*put)(FILE *, const struct report_row *), struct fault *fault) {
    size_t left_out = 0;
    enum status status = STATUS_OK;
    for (size_t i = 0; i < r->case_count; i++) {
        for (size_t k = 0; k < r->cases[i].row_count && !status; k++) {
            const struct report_row *row = &r->cases[i].row[k];
            if (!only_bad || row->verdict != VERDICT_PASS)
                status = put_if_it_fits(out, row, limit, put, &left_out, fault);
        }
    }
    if (left_out > 0)
        fprintf(out, "\n%zu more do not fit in here: see results.json.\n", left_out);
    return status;
}

static void put_worst(FILE *out, const struct report *r) {
    const struct report_row *worst = report_worst(r);
    if (!worst)
        return;
    double used = report_margin_used(worst);
    if (isnan(used))
        fprintf(out, "\nWorst: no number from ");
    else
        fprintf(out, "\nWorst margin: %s of its tolerance used by ", words_margin(used).text);
    escape_markdown(out, worst->case_name);
    fprintf(out, ", ");
    escape_markdown(out, worst->check);
    if (worst->point && *worst->point) {
        fprintf(out, " at ");
        escape_markdown(out, worst->point);
    }
    fprintf(out, ".\n");
}

static void put_head(FILE *out, const struct report *r) {
    struct report_count n = report_tally(r);
    fprintf(out, "# %s%s: ", r->modified ? "MODIFIED, " : "", words_headline(r));
    escape_markdown(out, r->suite);
    fprintf(out, ", tier ");
    escape_markdown(out, r->tier);
    fprintf(out, "\n\n");
    if (r->modified) {
        fprintf(out, "**MODIFIED**: the solver was run with ");
        escape_markdown(out, r->modification);
        fprintf(out, "; this is no validation of it.\n\n");
    }
    words_sentence(out, r);
    fprintf(out, "\n\n| pass | fail | inconclusive | known | cases not run |\n"
                 "|--:|--:|--:|--:|--:|\n");
    fprintf(out, "| %zu | %zu | %zu | %zu | %zu |\n", n.pass, n.fail, n.inconclusive, n.known,
            n.skipped);
    put_worst(out, r);
    fputs(r->budget.statistical > 0 ? "\n" : "", out);
    words_budget(out, r);
    fputs(r->budget.statistical > 0 ? "\n\n" : "\n", out);
    words_bits(out, r);
    fputs(words_has_bits(r) ? "\n" : "", out);
    for (size_t i = 0; i < r->case_count; i++) {
        if (!r->cases[i].skipped)
            continue;
        fprintf(out, "\nNot run: ");
        escape_markdown(out, r->cases[i].name);
        fprintf(out, ": ");
        escape_markdown(out, r->cases[i].skip_reason);
        fprintf(out, "\n");
    }
}

/* Counts, and each claim whose stored verdict is another. */
static void put_claims(FILE *out, const struct report *r) {
    size_t count[CLAIM_VERDICTS];
    if (!r->ledger)
        return;
    claim_tally(r->ledger, count);
    fprintf(out, "\nClaims of the papers:");
    for (enum claim_verdict v = 0; v < CLAIM_VERDICTS; v++)
        fprintf(out, "%s %zu %s", v == 0 ? "" : ",", count[v], claim_verdict_name(v));
    fprintf(out, ".\n");
    for (size_t i = 0; i < r->ledger->count; i++) {
        const struct report_claim *c = &r->ledger->claim[i];
        if (!c->stored || !c->is_tested || !strcmp(c->stored, claim_verdict_name(c->verdict)))
            continue;
        fprintf(out, "\nClaim %s: %s, stored as %s: ", c->id, claim_verdict_name(c->verdict),
                c->stored);
        escape_markdown(out, c->reason);
        fprintf(out, "\n");
    }
}

/* Bias and scatter by model, and what no check can see. */
static void put_cover(FILE *out, const struct report *r) {
    if (r->agreement) {
        for (size_t i = 0; i < r->agreement->group_count; i++) {
            const struct report_group *g = &r->agreement->group[i];
            fprintf(out, "%s", i == 0 ? "\nMeasured over expected: " : "; ");
            escape_markdown(out, g->name);
            fprintf(out, " bias %s", words_number(g->bias).text);
            if (isfinite(g->bias_low))
                fprintf(out, " (95 %%: %s to %s)", words_number(g->bias_low).text,
                        words_number(g->bias_high).text);
            fprintf(out, ", scatter %s over %zu rows", words_number(g->scatter).text, g->rows);
        }
        fprintf(out, "%s", r->agreement->group_count > 0 ? ".\n" : "");
    }
    for (size_t i = 0; i < r->limit_count; i++) {
        fprintf(out, "%s", i == 0 ? "\nNo check here can see: " : "; ");
        escape_markdown(out, r->limit[i].what);
    }
    fprintf(out, "%s", r->limit_count > 0 ? ".\n" : "");
}

static void put_facts(FILE *out, const struct report *r) {
    fprintf(out, "\n## Where it comes from\n\n");
    put_item(out, "started", r->started);
    put_item(out, "solver", r->solver);
    put_item(out, "solver key", r->solver_key);
    for (size_t i = 0; i < r->fact_count; i++) {
        fprintf(out, "- ");
        escape_markdown(out, r->fact[i].name);
        fprintf(out, ": ");
        escape_markdown(out, r->fact[i].value);
        fprintf(out, "\n");
    }
}

enum status report_write_markdown(const struct report *r, const char *path, struct fault *fault) {
    struct report_count n = report_tally(r);
    struct sheet sheet;
    enum status status = sheet_open(&sheet, fault);
    if (status)
        return status;
    put_head(sheet.out, r);
    put_claims(sheet.out, r);
    put_cover(sheet.out, r);
    put_facts(sheet.out, r);
    if (n.fail + n.inconclusive + n.known > 0) {
        fprintf(sheet.out, "\n## Failed, undecided, or known to disagree\n");
        status = put_rows(sheet.out, r, true, DETAIL_LIMIT, put_detail, fault);
    }
    if (!status && n.pass + n.fail + n.inconclusive + n.known > 0) {
        fprintf(sheet.out, "\n## All checks\n\n| verdict | case | check | point | measured | "
                           "accepted | margin used |\n|---|---|---|---|---|---|---|\n");
        status = put_rows(sheet.out, r, false, SIZE_LIMIT, put_compact, fault);
    }
    if (!status)
        status = sheet_save(&sheet, path, fault);
    sheet_free(&sheet);
    return status;
}
