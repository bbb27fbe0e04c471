#include "validation/desk.h"

#include "common/file.h"
#include "validation/agreement.h"
#include "validation/limits.h"
#include "validation/papers.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { LOG_LINES = 12 };

struct desk {
    const struct plan *plan;
    const struct outcome *outcome;
    const struct execute_options *execute;
    const struct console *console;
    struct measured_case **measured; /* measured[0 .. plan->case_count-1], NULL: not yet */
    struct rows **rows;
    const struct budget *budget; /* or NULL */
};

enum status desk_create(const struct plan *plan, const struct outcome *outcome,
                        const struct execute_options *execute, const struct console *console,
                        struct desk **out, struct fault *fault) {
    struct desk *d = calloc(1, sizeof *d);
    *out = d;
    if (d == NULL)
        return fault_set(fault, STATUS_NO_MEMORY, "judging: out of memory");
    *d = (struct desk){plan, outcome, execute, console, NULL, NULL, NULL};
    d->measured = calloc(plan->case_count + 1, sizeof *d->measured);
    d->rows = calloc(plan->case_count + 1, sizeof *d->rows);
    if (d->measured != NULL && d->rows != NULL)
        return STATUS_OK;
    desk_free(d);
    *out = NULL;
    return fault_set(fault, STATUS_NO_MEMORY, "judging: out of memory");
}

void desk_set_budget(struct desk *d, const struct budget *b) {
    d->budget = b;
}

void desk_free(struct desk *d) {
    if (d == NULL)
        return;
    for (size_t i = 0; i < d->plan->case_count; i++) {
        if (d->rows != NULL)
            rows_free(d->rows[i]);
        if (d->measured != NULL)
            measured_case_free(d->measured[i]);
    }
    free(d->rows);
    free(d->measured);
    free(d);
}

/* -- judging ---------------------------------------------------------------------- */

static const struct outcome *outcome_of(const struct desk *d, const struct plan_run *run) {
    return &d->outcome[run->index];
}

static bool is_settled(const struct desk *d, const struct plan_case *c) {
    for (size_t p = 0; p < c->point_count; p++) {
        for (size_t r = 0; r < c->point[p].run_count; r++) {
            enum run_state s = outcome_of(d, c->point[p].run[r])->state;
            if (s == RUN_WAITING || s == RUN_RUNNING)
                return false;
        }
    }
    return c->skip_reason == NULL;
}

static enum status describe(void *context, const struct plan_run *run, struct arena *arena,
                            struct measured_run *r, struct fault *fault) {
    const struct desk *d = context;
    const struct outcome *o = outcome_of(d, run);
    const struct folder *f = d->execute->folder;
    r->run_path = folder_run_file(f, arena, run);
    r->result_path = folder_result(f, arena, run);
    r->seconds = o->seconds;
    r->usable = o->state != RUN_FAILED;
    const char *log = folder_log(f, arena, run);
    if (r->run_path == NULL || r->result_path == NULL || log == NULL)
        return fault_set(fault, STATUS_NO_MEMORY, "%s: out of memory", run->name);
    if (r->usable)
        return STATUS_OK;
    r->failure = o->failure;
    r->log_end = execute_log_end(log, LOG_LINES, arena);
    return r->log_end == NULL ? fault_set(fault, STATUS_NO_MEMORY, "%s: out of memory", run->name)
                              : STATUS_OK;
}

/* -- telling ---------------------------------------------------------------------- */

static void tell_text(FILE *out, const char *head, const char *text) {
    for (const char *line = text; *line != '\0';) {
        size_t length = strcspn(line, "\n");
        fprintf(out, "        %s%.*s\n", head, (int)length, line);
        line += length + (line[length] == '\n');
    }
}

static void tell_row(FILE *out, const struct report_row *r, bool with_command) {
    static const char *const word[] = {"pass", "fail", "open", "known"};
    fprintf(out, "  %-5s %s [%s]: ", word[r->verdict], r->check, r->point);
    if (isfinite(r->measured))
        fprintf(out, "measured %.6g", r->measured);
    if (isfinite(r->measured) && r->uncertainty > 0)
        fprintf(out, " +- %.2g", r->uncertainty);
    if (isfinite(r->measured) && isfinite(r->expected))
        fprintf(out, ", expected %.6g, margin %.3g (%s); ", r->expected, r->tolerance,
                r->comparison);
    else if (isfinite(r->measured))
        fputs("; ", out);
    fprintf(out, "%s\n", r->reason);
    if (with_command)
        fprintf(out, "        repeat: %s\n", r->repeat);
    if (r->log_end != NULL && *r->log_end != '\0')
        tell_text(out, "log: ", r->log_end);
}

static bool is_claim(const struct report_row *r) {
    return strcmp(r->kind, "claim") == 0;
}

/* What repeats row i repeats a row above it as well, which has told it: claims are told last. */
static bool was_told(const struct report_row *row, size_t i) {
    for (size_t k = 0; k < i; k++)
        if (row[k].verdict != VERDICT_PASS && is_claim(&row[k]) == is_claim(&row[i]) &&
            strcmp(row[k].repeat, row[i].repeat) == 0)
            return true;
    return false;
}

static enum verdict worse(enum verdict a, enum verdict b) {
    static const int rank[] = {
        [VERDICT_PASS] = 0, [VERDICT_KNOWN] = 1, [VERDICT_INCONCLUSIVE] = 2, [VERDICT_FAIL] = 3};
    return rank[a] >= rank[b] ? a : b;
}

static enum verdict tell_case(const struct desk *d, size_t index) {
    static const char *const word[] = {"pass", "FAIL", "OPEN", "pass"};
    const struct rows *rows = d->rows[index];
    FILE *out = d->console == NULL ? NULL : d->console->out;
    size_t failed = 0, open = 0, known = 0;
    double seconds = 0;
    enum verdict v = VERDICT_PASS;
    const struct plan_case *c = &d->plan->cases[index];
    for (size_t i = 0; i < rows->count; i++) {
        failed += rows->row[i].verdict == VERDICT_FAIL;
        open += rows->row[i].verdict == VERDICT_INCONCLUSIVE;
        known += rows->row[i].verdict == VERDICT_KNOWN;
        v = worse(v, rows->row[i].verdict);
    }
    for (size_t p = 0; p < c->point_count; p++) {
        for (size_t r = 0; r < c->point[p].run_count; r++) {
            double s = outcome_of(d, c->point[p].run[r])->seconds;
            seconds += isfinite(s) ? s : 0;
        }
    }
    if (out == NULL)
        return v;
    if (d->console->live)
        fputs("\r\033[K", d->console->errors);
    fprintf(out, "%s  %-40s %zu rows", word[v], c->file->name, rows->count);
    if (failed > 0)
        fprintf(out, ", %zu fail", failed);
    if (open > 0)
        fprintf(out, ", %zu inconclusive", open);
    if (known > 0)
        fprintf(out, ", %zu known", known);
    fprintf(out, "  (%.1f s of solver)\n", seconds);
    for (size_t i = 0; i < rows->count; i++) {
        if (rows->row[i].verdict != VERDICT_PASS)
            tell_row(out, &rows->row[i], !was_told(rows->row, i));
    }
    fflush(out);
    return v;
}

enum status desk_judge(struct desk *d, enum verdict *worst, struct fault *fault) {
    const struct measure_source source = {describe, d};
    for (size_t i = 0; i < d->plan->case_count; i++) {
        if (d->rows[i] != NULL || !is_settled(d, &d->plan->cases[i]))
            continue;
        enum status status = measure_case(&d->plan->cases[i], &source, &d->measured[i], fault);
        if (status == STATUS_OK)
            status = rows_judge(d->measured[i], d->execute, d->budget, &d->rows[i], fault);
        if (status != STATUS_OK)
            return status;
        *worst = worse(*worst, tell_case(d, i));
    }
    return STATUS_OK;
}

const struct measured_case *desk_measured(const struct desk *d, size_t i) {
    return d->measured[i];
}

const struct rows *desk_rows(const struct desk *d, size_t i) {
    return d->rows[i];
}

/* -- filing ----------------------------------------------------------------------- */

static enum status write_all(const struct desk *d, const struct report *r, bool page,
                             struct arena *a, struct fault *fault) {
    static const struct {
        const char *name;
        enum status (*write)(const struct report *r, const char *path, struct fault *fault);
    } file[] = {{"results.json", report_write_json},
                {"junit.xml", report_write_junit},
                {"summary.md", report_write_markdown},
                {"report", report_write_html}};
    size_t count = sizeof file / sizeof *file - (page ? 0 : 1);
    enum status status = STATUS_OK;
    for (size_t i = 0; status == STATUS_OK && i < count; i++) {
        const char *path = arena_text(a, "%s/%s", folder_path(d->execute->folder), file[i].name);
        status = path == NULL ? fault_set(fault, STATUS_NO_MEMORY, "report: out of memory")
                              : file[i].write(r, path, fault);
    }
    return status;
}

static void tell_last(const struct desk *d, const struct report *r, bool page) {
    static const char *const word[] = {"PASS", "FAIL", "INCONCLUSIVE", "KNOWN"};
    struct report_count n = report_tally(r);
    FILE *out = d->console->out;
    if (r->modified)
        fprintf(out, "MODIFIED (%s) ", r->modification);
    fprintf(out,
            "%s: %zu checks: %zu pass, %zu fail, %zu inconclusive, %zu known; %zu skipped; %s: "
            "%s/%s\n",
            word[report_verdict(r)], n.pass + n.fail + n.inconclusive + n.known, n.pass, n.fail,
            n.inconclusive, n.known, n.skipped, page ? "report" : "results",
            folder_path(d->execute->folder), page ? "report/index.html" : "results.json");
}

static int exit_code_of(const struct report *r) {
    struct report_count n = report_tally(r);
    return n.fail > 0 ? 1 : n.inconclusive > 0 || n.pass == 0 ? 3 : 0;
}

/* What the papers claim, and which of it is another verdict than it was. */
static void tell_claims(const struct desk *d, const struct report *r) {
    size_t count[CLAIM_VERDICTS];
    FILE *out = d->console->out;
    if (r->ledger == NULL)
        return;
    for (size_t i = 0; i < r->case_count; i++) {
        for (size_t k = 0; k < r->cases[i].row_count; k++) {
            const struct report_row *row = r->cases[i].row;
            if (is_claim(&row[k]) && row[k].verdict != VERDICT_PASS)
                tell_row(out, &row[k], !was_told(row, k));
        }
    }
    claim_tally(r->ledger, count);
    fputs("claims of the papers:", out);
    for (enum claim_verdict v = 0; v < CLAIM_VERDICTS; v++)
        fprintf(out, "%s %zu %s", v == 0 ? "" : ",", count[v], claim_verdict_name(v));
    fputc('\n', out);
}

/* Cases of the budget's plan, which has all of the tier, that nobody asked for. */
static enum status name_unselected(const struct desk *d, struct report *r, struct arena *a,
                                   struct fault *fault) {
    const struct plan *all = d->budget == NULL ? NULL : d->budget->plan;
    const char **name = arena_take(a, all == NULL ? 0 : all->case_count, sizeof *name);
    if (name == NULL)
        return fault_set(fault, STATUS_NO_MEMORY, "report: out of memory");
    for (size_t i = 0; all != NULL && i < all->case_count; i++) {
        bool is_here = false;
        for (size_t k = 0; k < d->plan->case_count; k++)
            is_here |= strcmp(d->plan->cases[k].file->name, all->cases[i].file->name) == 0;
        if (!is_here &&
            (name[r->unselected_count++] = arena_copy(a, all->cases[i].file->name)) == NULL)
            return fault_set(fault, STATUS_NO_MEMORY, "report: out of memory");
    }
    r->unselected = name;
    return STATUS_OK;
}

/* What the rows say together, and what they cannot say. */
static enum status survey(const struct desk *d, const struct folder_record *record,
                          struct assembled *a, struct fault *fault) {
    enum status status = limits_add(record->cases_folder, &a->report, &a->arena, fault);
    if (status == STATUS_OK)
        status = name_unselected(d, &a->report, &a->arena, fault);
    return status == STATUS_OK ? agreement_add(&a->report, &a->arena, fault) : status;
}

enum status desk_file(struct desk *d, const struct folder_record *record, bool page, int *exit_code,
                      struct fault *fault) {
    struct assemble_case *cases = calloc(d->plan->case_count + 1, sizeof *cases);
    struct assembled *a = NULL;
    struct papers papers;
    if (cases == NULL)
        return fault_set(fault, STATUS_NO_MEMORY, "report: out of memory");
    for (size_t i = 0; i < d->plan->case_count; i++)
        cases[i] = (struct assemble_case){
            .plan = &d->plan->cases[i],
            .measured = d->measured[i],
            .rows = d->rows[i],
            .not_run = d->rows[i] == NULL ? "not run: stopped at the first failure (-x)" : NULL};
    struct assemble_input in = {.record = record,
                                .cases = cases,
                                .case_count = d->plan->case_count,
                                .plan = d->plan,
                                .outcome = d->outcome,
                                .folder = d->execute->folder,
                                .budget = d->budget,
                                .program = d->console->program,
                                .papers = &papers};
    enum status status =
        papers_open(record->cases_folder, record->references_folder, &papers, fault);
    if (status == STATUS_OK)
        status = assemble_report(&in, &a, fault);
    if (status == STATUS_OK)
        status = survey(d, record, a, fault);
    if (status == STATUS_OK)
        status = write_all(d, &a->report, page, &a->arena, fault);
    if (status == STATUS_OK) {
        tell_claims(d, &a->report);
        tell_last(d, &a->report, page);
        *exit_code = exit_code_of(&a->report);
    }
    assemble_free(a);
    papers_close(&papers);
    free(cases);
    return status;
}
