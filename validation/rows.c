#include "validation/rows.h"

#include "validation/judge.h"
#include "validation/reference.h"
#include "validation/rows_across.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

struct clerk {
    const struct measured_case *m;
    const struct execute_options *o;
    struct rows *rows;
    struct fault *fault;
};

static enum status no_memory(struct clerk *k) {
    return fault_set(k->fault, STATUS_NO_MEMORY, "judge: out of memory");
}

static enum status add(struct clerk *k, const struct report_row *row,
                       const struct measured_point *point, const struct case_check *check) {
    struct rows *r = k->rows;
    struct report_row *rows = arena_grow(&r->arena, r->row, r->count, sizeof *rows);
    const struct measured_point **points =
        arena_grow(&r->arena, r->point, r->count, sizeof *points);
    const struct case_check **checks = arena_grow(&r->arena, r->check, r->count, sizeof *checks);
    if (rows == NULL || points == NULL || checks == NULL || row->repeat == NULL)
        return no_memory(k);
    r->row = rows;
    r->point = points;
    r->check = checks;
    rows[r->count] = *row;
    points[r->count] = point;
    checks[r->count] = check;
    r->count++;
    return STATUS_OK;
}

/* -- runs of a row ------------------------------------------------------------ */

/* One command line that makes the point's runs again, in the current folder. */
static const char *repeat_point(struct clerk *k, const struct measured_point *p) {
    struct arena *a = &k->rows->arena;
    const char *all = "", *separate = "";
    for (size_t i = 0; i < p->run_count && all != NULL; i++) {
        const struct plan_run *run = p->run[i].run;
        const char *result = arena_text(a, "%s.h5", run->name);
        const char *line = result == NULL ? NULL : execute_command_line(run, k->o, result, a);
        if (line == NULL)
            return NULL;
        all = arena_text(a, "%s%s%s", all, separate, line);
        separate = " && ";
    }
    return all;
}

static const char *repeat_case(struct clerk *k) {
    const char *text =
        arena_text(&k->rows->arena, "bedcheck run %s --tier %s --out again", k->m->plan->file->name,
                   case_tier_name((enum tier)(k->m->plan->tier - k->m->plan->file->tier)));
    for (size_t i = 0; text != NULL && i < k->o->setting_count; i++)
        text = arena_text(&k->rows->arena, "%s --set %s", text, k->o->setting[i]);
    return text;
}

static enum status list_runs(struct clerk *k, const struct measured_point *p,
                             struct report_row *row) {
    const char **runs = arena_take(&k->rows->arena, row->run_count + p->run_count, sizeof *runs);
    if (runs == NULL)
        return no_memory(k);
    for (size_t i = 0; i < row->run_count; i++)
        runs[i] = row->runs[i];
    for (size_t i = 0; i < p->run_count; i++) {
        runs[row->run_count++] = p->run[i].run->name;
        if (isfinite(p->run[i].seconds))
            row->seconds += p->run[i].seconds;
    }
    row->runs = runs;
    return STATUS_OK;
}

/* value[i] is what run i of the point gave. */
static enum status list_values(struct clerk *k, const struct measured_point *p, const double *value,
                               struct report_row *row) {
    long long *seeds = arena_take(&k->rows->arena, p->run_count, sizeof *seeds);
    if (seeds == NULL)
        return no_memory(k);
    for (size_t i = 0; i < p->run_count; i++)
        seeds[i] = p->run[i].run->seed;
    row->value_count = p->run_count;
    row->values = value;
    row->seeds = seeds;
    return STATUS_OK;
}

/* -- checks --------------------------------------------------------------------- */

static enum status begin_row(struct clerk *k, const struct case_check *check, const char *point,
                             struct report_row *row) {
    struct arena *a = &k->rows->arena;
    *row = (struct report_row){.case_name = k->m->plan->file->name,
                               .point = point,
                               .check = check->name,
                               .observable = check->observable,
                               .unit = check->unit,
                               .comparison = case_comparison_name(check->comparison),
                               .kind = case_kind_name(check->kind),
                               .because = check->because,
                               .detectable = NAN,
                               .alarm_rate = NAN};
    if (check->per.prediction != NULL)
        row->observable = arena_text(a, "%s / %s", check->observable, check->per.prediction->name);
    return row->observable == NULL ? no_memory(k) : STATUS_OK;
}

/* What the row is kept under as a reference, so that other runs of the suite find it. */
static enum status name_row(struct clerk *k, size_t check, size_t point, struct report_row *row) {
    struct reference_key key;
    enum status status =
        reference_key_make(k->m->plan, check, point, &k->rows->arena, &key, k->fault);
    if (status == STATUS_OK) {
        row->key = key.observable;
        row->meaning = key.meaning;
    }
    return status;
}

/* Degrees of freedom of the uncertainty that the judge gives the mean. */
static double freedom_of(const struct judge_question *q) {
    if (q->kind == KIND_REGRESSION && !q->paired && q->ensemble.seeds > 0)
        return (double)q->ensemble.seeds - 1;
    if (q->fitted || (q->scatter.given && q->scatter.value > 0))
        return INFINITY;
    return q->count > 0 ? (double)q->count - 1 : 0;
}

static enum status end_row(struct clerk *k, const struct judge_question *q,
                           const struct measured_point *point, const struct case_check *check,
                           struct report_row *row) {
    struct judge_answer answer;
    judge_check(q, &answer);
    row->measured = answer.measured;
    row->uncertainty = answer.uncertainty;
    row->expected = answer.expected;
    row->expected_uncertainty = answer.expected_uncertainty;
    row->tolerance = answer.tolerance;
    row->verdict = answer.verdict;
    row->freedom = freedom_of(q);
    row->reason = arena_copy(&k->rows->arena, answer.reason);
    return row->reason == NULL ? no_memory(k) : add(k, row, point, check);
}

static struct judge_question ask(const struct case_check *check) {
    return (struct judge_question){.comparison = check->comparison,
                                   .kind = check->kind,
                                   .margin = check->margin,
                                   .scatter = check->scatter};
}

static enum status judge_point(struct clerk *k, size_t index, const struct measured_point *p) {
    const struct case_check *check = &k->m->plan->tier->check[index];
    struct report_row row;
    double *measured = arena_take(&k->rows->arena, p->run_count, sizeof *measured);
    double *expected = arena_take(&k->rows->arena, p->run_count, sizeof *expected);
    if (measured == NULL || expected == NULL)
        return no_memory(k);
    struct judge_question q = ask(check);
    q.count = p->run_count;
    q.measured = measured;
    q.expected = expected;
    for (size_t i = 0; i < p->run_count; i++) {
        const struct measured_run *r = &p->run[i];
        measured[i] = r->usable ? r->sample[index].measured : NAN;
        expected[i] = r->usable ? r->sample[index].expected : NAN;
        if (r->usable)
            q.expected_uncertainty = r->sample[index].expected_uncertainty;
        const char *reason = r->usable ? r->sample[index].reason : r->failure;
        if (q.missing == NULL && reason != NULL)
            q.missing = reason;
    }
    enum status status = begin_row(k, check, p->point->name, &row);
    if (status == STATUS_OK)
        status = list_runs(k, p, &row);
    if (status == STATUS_OK)
        status = list_values(k, p, measured, &row);
    if (status == STATUS_OK)
        status = name_row(k, index, (size_t)(p - k->m->point), &row);
    row.repeat = repeat_point(k, p);
    return status == STATUS_OK ? end_row(k, &q, p, check, &row) : status;
}

static enum status judge_group(struct clerk *k, size_t index, size_t first) {
    const struct case_check *check = &k->m->plan->tier->check[index];
    const struct case_across *a = &k->m->plan->file->across[check->number.index];
    struct report_row row;
    struct rows_group g;
    enum status status = rows_group_fit(k->m, index, first, &k->rows->arena, &g, k->fault);
    if (status == STATUS_OK)
        status = begin_row(k, check, g.name, &row);
    for (size_t p = first; status == STATUS_OK && p < k->m->point_count; p++) {
        if (rows_group_has(k->m, a, first, p))
            status = list_runs(k, &k->m->point[p], &row);
    }
    if (status == STATUS_OK)
        status = name_row(k, index, first, &row);
    if (status != STATUS_OK)
        return status;
    struct judge_question q = ask(check);
    q.count = 1;
    q.fitted = true;
    q.measured = &g.value;
    q.expected = &g.expected;
    q.expected_uncertainty = g.expected_uncertainty;
    q.fit_uncertainty = g.uncertainty;
    q.missing = g.reason;
    const struct measured_point *alone = a->ensemble != NULL ? &k->m->point[first] : NULL;
    row.repeat = alone != NULL ? repeat_point(k, alone) : repeat_case(k);
    return end_row(k, &q, alone, check, &row);
}

static enum status judge_one(struct clerk *k, size_t index) {
    const struct plan_case *plan = k->m->plan;
    const struct case_check *check = &plan->tier->check[index];
    const struct case_across *a =
        check->number.across ? &plan->file->across[check->number.index] : NULL;
    enum status status = STATUS_OK;
    for (size_t p = 0; status == STATUS_OK && p < k->m->point_count; p++) {
        const struct plan_point *point = k->m->point[p].point;
        if (!case_filter_takes(&check->points, point->parameter, point->parameter_count))
            continue;
        if (a == NULL)
            status = judge_point(k, index, &k->m->point[p]);
        else if (rows_group_first(k->m, a, p))
            status = judge_group(k, index, p);
    }
    return status;
}

/* -- failed runs ------------------------------------------------------------------ */

static enum status report_failure(struct clerk *k, const struct measured_point *p,
                                  const struct measured_run *r) {
    struct arena *a = &k->rows->arena;
    const char *result = arena_text(a, "%s.h5", r->run->name);
    const char **runs = arena_take(a, 1, sizeof *runs);
    if (result == NULL || runs == NULL)
        return no_memory(k);
    runs[0] = r->run->name;
    struct report_row row = {.case_name = k->m->plan->file->name,
                             .point = p->point->name,
                             .check = arena_text(a, "run with seed %lld", r->run->seed),
                             .observable = "run",
                             .unit = "1",
                             .measured = NAN,
                             .uncertainty = NAN,
                             .expected = NAN,
                             .expected_uncertainty = NAN,
                             .tolerance = NAN,
                             .comparison = "within",
                             .kind = "run",
                             .verdict = VERDICT_FAIL,
                             .because = "every run must end and give usable data",
                             .reason = r->failure,
                             .repeat = execute_command_line(r->run, k->o, result, a),
                             .log_end = r->log_end,
                             .runs = runs,
                             .run_count = 1,
                             .seconds = isfinite(r->seconds) ? r->seconds : 0,
                             .detectable = NAN,
                             .alarm_rate = NAN};
    return row.check == NULL ? no_memory(k) : add(k, &row, NULL, NULL);
}

static enum status judge_all(struct clerk *k) {
    enum status status = STATUS_OK;
    for (size_t p = 0; p < k->m->point_count; p++) {
        for (size_t r = 0; status == STATUS_OK && r < k->m->point[p].run_count; r++) {
            if (!k->m->point[p].run[r].usable)
                status = report_failure(k, &k->m->point[p], &k->m->point[p].run[r]);
        }
    }
    for (size_t i = 0; status == STATUS_OK && i < k->m->plan->tier->check_count; i++)
        status = judge_one(k, i);
    return status;
}

enum status rows_judge(const struct measured_case *m, const struct execute_options *o,
                       struct rows **out, struct fault *fault) {
    *out = NULL;
    struct rows *rows = calloc(1, sizeof *rows);
    if (rows == NULL)
        return fault_set(fault, STATUS_NO_MEMORY, "judge: out of memory");
    struct clerk k = {m, o, rows, fault};
    enum status status = judge_all(&k);
    if (status != STATUS_OK) {
        rows_free(rows);
        return status;
    }
    *out = rows;
    return STATUS_OK;
}

void rows_free(struct rows *r) {
    if (r == NULL)
        return;
    arena_free(&r->arena);
    free(r);
}
