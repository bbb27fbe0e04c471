#include "validation/rows.h"

#include "validation/alarm.h"
#include "validation/judge.h"
#include "validation/reference.h"
#include "validation/rows_across.h"
#include "validation/scatter.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

struct clerk {
    const struct measured_case *m;
    const struct execute_options *o;
    struct rows *rows;
    struct fault *fault;
    const struct references *references; /* NULL: none */
    double share;                        /* of the false alarms; 0: no budget */
    enum unchanged **bits;               /* bits[point][run] */
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

/* -- what is stored ------------------------------------------------------------- */

/* One row in the making. */
struct draft {
    const struct case_check *check;
    size_t index, first; /* of the check in the tier, of its first point */
    struct reference_key key;
    struct judge_question q;
    double *expected; /* q.expected, to be filled in from a reference */
    struct unchanged_count bits;
    struct report_row row;
};

/* The line of that origin, or NULL and why. */
static const struct reference *look_up(struct clerk *k, const struct draft *d,
                                       enum reference_origin origin, const char **why) {
    const struct reference *line = reference_find(k->references, &d->key, origin);
    if (line != NULL && reference_is_meant(line, d->key.meaning))
        return line;
    *why = line == NULL ? arena_text(&k->rows->arena, "no %s reference for this tier and point",
                                     reference_origin_name(origin))
                        : "the reference was made from another text of the case";
    return NULL;
}

static void take_ensemble(struct clerk *k, struct draft *d) {
    const struct reference *line = look_up(k, d, ORIGIN_ENSEMBLE, &d->q.no_reference);
    if (line != NULL)
        d->q.ensemble = (struct judge_ensemble){line->seeds, line->value, line->deviation};
}

static void take_pairs(struct clerk *k, struct draft *d) {
    const struct measured_point *p = &k->m->point[d->first];
    for (size_t i = 0; i < d->q.count; i++) {
        long long seed = p->run[i].run->seed;
        const struct reference *line = reference_find_seed(k->references, &d->key, seed);
        bool meant = line != NULL && reference_is_meant(line, d->key.meaning);
        d->expected[i] = meant ? line->value : NAN;
        if (line == NULL)
            d->q.no_reference = arena_text(&k->rows->arena, "no reference for seed %lld", seed);
        else if (!meant)
            d->q.no_reference = "the reference was made from another text of the case";
    }
}

/* An expectation that stands in the table, with its uncertainty. */
static void take_expected(struct clerk *k, struct draft *d, const struct case_expect *e) {
    enum reference_origin origin = ORIGIN_COUNT;
    const char *why = NULL;
    reference_origin_find(e->reference, &origin);
    const struct reference *line = look_up(k, d, origin, &why);
    for (size_t i = 0; i < d->q.count; i++)
        d->expected[i] = line == NULL ? NAN : line->value;
    d->q.expected_uncertainty = line == NULL ? NAN : line->deviation;
    if (line == NULL && d->q.missing == NULL)
        d->q.missing = why;
}

/* What the row is kept under, so that other runs of the suite find it, and what is kept there. */
static enum status consult(struct clerk *k, struct draft *d) {
    const struct plan_point *p = k->m->point[d->first].point;
    const struct case_expect *e =
        case_expect_find(&d->check->expect, p->parameter, p->parameter_count);
    enum status status =
        reference_key_make(k->m->plan, d->index, d->first, &k->rows->arena, &d->key, k->fault);
    if (status != STATUS_OK)
        return status;
    d->row.key = d->key.observable;
    d->row.meaning = d->key.meaning;
    d->row.since = d->check->known_since;
    d->row.statistical = scatter_is_statistical(k->m->plan->file, d->check);
    d->q.comparison = d->check->comparison;
    d->q.kind = d->check->kind;
    d->q.margin = d->check->margin;
    d->q.scatter = d->check->scatter;
    d->q.paired = d->check->paired;
    d->q.known_since = d->check->known_since;
    d->q.alarm_rate = k->share;
    if (d->q.kind == KIND_REGRESSION && d->q.paired)
        take_pairs(k, d);
    else if (d->q.kind == KIND_REGRESSION)
        take_ensemble(k, d);
    else if (e != NULL && e->kind == EXPECT_REFERENCE)
        take_expected(k, d, e);
    return STATUS_OK;
}

/* -- bits --------------------------------------------------------------------------- */

static enum status look_at_bits(struct clerk *k) {
    struct arena *a = &k->rows->arena;
    enum status status = STATUS_OK;
    k->bits = arena_take(a, k->m->point_count, sizeof *k->bits);
    for (size_t p = 0; k->bits != NULL && status == STATUS_OK && p < k->m->point_count; p++) {
        const struct measured_point *point = &k->m->point[p];
        k->bits[p] = arena_take(a, point->run_count, sizeof *k->bits[p]);
        for (size_t i = 0; k->bits[p] != NULL && status == STATUS_OK && i < point->run_count; i++) {
            status = unchanged_look(k->m->plan, k->references, k->o->folder, point, &point->run[i],
                                    &k->bits[p][i], k->fault);
            unchanged_add(&k->rows->bits, k->bits[p][i]);
        }
        if (k->bits[p] == NULL)
            return no_memory(k);
    }
    return k->bits == NULL ? no_memory(k) : status;
}

static void count_bits(const struct clerk *k, size_t point, struct draft *d) {
    for (size_t i = 0; i < k->m->point[point].run_count; i++)
        unchanged_add(&d->bits, k->bits[point][i]);
}

/* -- judging ---------------------------------------------------------------------- */

/* Degrees of freedom of the uncertainty that the judge gives the mean. */
static double freedom_of(const struct judge_question *q) {
    if (q->kind == KIND_REGRESSION && !q->paired && q->ensemble.seeds > 0)
        return (double)q->ensemble.seeds - 1;
    if (q->fitted || (q->scatter.given && q->scatter.value > 0))
        return INFINITY;
    return q->count > 0 ? (double)q->count - 1 : 0;
}

/* Probability that unchanged code gets another verdict. */
static double rate_of(struct clerk *k, const struct draft *d, const struct judge_answer *answer) {
    const struct judge_question *q = &d->q;
    const char *why;
    if (!d->row.statistical)
        return 0;
    if (q->kind == KIND_REGRESSION)
        return isfinite(d->row.detectable) ? k->share : NAN;
    const struct reference *line = look_up(k, d, ORIGIN_ENSEMBLE, &why);
    if (line == NULL)
        return NAN;
    double mean = d->key.difference ? line->value : line->value - answer->expected;
    struct alarm_question a = {.comparison = q->comparison,
                               .tolerance = answer->tolerance,
                               .ensemble = {line->seeds, mean, line->deviation},
                               .seeds = q->fitted ? q->seeds : q->count,
                               .fitted = q->fitted,
                               .declared = NAN,
                               .expected_uncertainty = answer->expected_uncertainty,
                               .share = k->share,
                               .known = q->known_since != NULL};
    if (q->scatter.given)
        a.declared = judge_amount(&q->scatter, answer->expected);
    return alarm_rate(&a);
}

/* "; a change of 0.05 (4 %) is seen with 95 %", and what the bits say. */
static const char *tell_power(struct clerk *k, const struct draft *d, const char *reason) {
    double seen = d->row.detectable, e = d->row.expected;
    if (reason != NULL && d->q.kind == KIND_REGRESSION && d->row.bits != NULL)
        reason = arena_text(&k->rows->arena, "%s: %s", d->row.bits, reason);
    if (reason == NULL)
        return NULL;
    if (!isfinite(seen))
        return arena_copy(&k->rows->arena, reason);
    if (!(fabs(e) > 0))
        return arena_text(&k->rows->arena, "%s; a change of %.3g is seen with 95 %%", reason, seen);
    return arena_text(&k->rows->arena, "%s; a change of %.3g (%.2g %%) is seen with 95 %%", reason,
                      seen, 100 * seen / fabs(e));
}

static enum status end_row(struct clerk *k, struct draft *d, const struct measured_point *point) {
    struct judge_answer answer;
    struct report_row *row = &d->row;
    judge_check(&d->q, &answer);
    row->measured = answer.measured;
    row->uncertainty = answer.uncertainty;
    row->expected = answer.expected;
    row->expected_uncertainty = answer.expected_uncertainty;
    row->tolerance = answer.tolerance;
    row->verdict = answer.verdict;
    row->freedom = freedom_of(&d->q);
    row->detectable = judge_detectable(&d->q);
    row->alarm_rate = rate_of(k, d, &answer);
    row->bits = unchanged_text(&d->bits, &k->rows->arena);
    row->reason = tell_power(k, d, answer.reason);
    return row->reason == NULL ? no_memory(k) : add(k, row, point, d->check);
}

static enum status judge_point(struct clerk *k, size_t index, const struct measured_point *p) {
    struct draft d = {.check = &k->m->plan->tier->check[index],
                      .index = index,
                      .first = (size_t)(p - k->m->point)};
    double *measured = arena_take(&k->rows->arena, p->run_count, sizeof *measured);
    d.expected = arena_take(&k->rows->arena, p->run_count, sizeof *d.expected);
    if (measured == NULL || d.expected == NULL)
        return no_memory(k);
    d.q = (struct judge_question){
        .count = p->run_count, .measured = measured, .expected = d.expected};
    for (size_t i = 0; i < p->run_count; i++) {
        const struct measured_run *r = &p->run[i];
        measured[i] = r->usable ? r->sample[index].measured : NAN;
        d.expected[i] = r->usable ? r->sample[index].expected : NAN;
        if (r->usable)
            d.q.expected_uncertainty = r->sample[index].expected_uncertainty;
        const char *reason = r->usable ? r->sample[index].reason : r->failure;
        if (d.q.missing == NULL && reason != NULL)
            d.q.missing = reason;
    }
    enum status status = begin_row(k, d.check, p->point->name, &d.row);
    if (status == STATUS_OK)
        status = list_runs(k, p, &d.row);
    if (status == STATUS_OK)
        status = list_values(k, p, measured, &d.row);
    if (status == STATUS_OK)
        status = consult(k, &d);
    d.row.repeat = repeat_point(k, p);
    count_bits(k, d.first, &d);
    return status == STATUS_OK ? end_row(k, &d, p) : status;
}

static enum status judge_group(struct clerk *k, size_t index, size_t first) {
    struct draft d = {.check = &k->m->plan->tier->check[index], .index = index, .first = first};
    const struct case_across *a = &k->m->plan->file->across[d.check->number.index];
    struct rows_group g;
    enum status status = rows_group_fit(k->m, index, first, &k->rows->arena, &g, k->fault);
    if (status == STATUS_OK)
        status = begin_row(k, d.check, g.name, &d.row);
    for (size_t p = first; status == STATUS_OK && p < k->m->point_count; p++) {
        if (!rows_group_has(k->m, a, first, p))
            continue;
        status = list_runs(k, &k->m->point[p], &d.row);
        count_bits(k, p, &d);
    }
    if (status != STATUS_OK)
        return status;
    d.expected = &g.expected;
    d.q = (struct judge_question){.count = 1,
                                  .fitted = true,
                                  .seeds = k->m->point[first].run_count,
                                  .measured = &g.value,
                                  .expected = &g.expected,
                                  .expected_uncertainty = g.expected_uncertainty,
                                  .fit_uncertainty = g.uncertainty,
                                  .missing = g.reason};
    const struct measured_point *alone = a->ensemble != NULL ? &k->m->point[first] : NULL;
    d.row.repeat = alone != NULL ? repeat_point(k, alone) : repeat_case(k);
    status = consult(k, &d);
    return status == STATUS_OK ? end_row(k, &d, alone) : status;
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
                             .alarm_rate = 0};
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
                       const struct budget *budget, struct rows **out, struct fault *fault) {
    *out = NULL;
    struct rows *rows = calloc(1, sizeof *rows);
    if (rows == NULL)
        return fault_set(fault, STATUS_NO_MEMORY, "judge: out of memory");
    struct clerk k = {.m = m, .o = o, .rows = rows, .fault = fault};
    k.references = budget_references(budget, m->plan->file->name);
    k.share = budget == NULL ? 0 : budget->share;
    enum status status = look_at_bits(&k);
    if (status == STATUS_OK)
        status = judge_all(&k);
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
