/* test_rows.c -- validation/rows.h: rows of points, of fits over a sweep, of failed runs. */
#include "tests/unit/case_stage.h"
#include "validation/rows.h"

#include <math.h>

static const char text[] =
    "name: fake/case\ntitle: t\nsource: s\nquestion: q\nmodel: fake\nexpect_s: 2\n"
    "sweep: {darcy: [published, corrected], step: [0.1, 0.2, 0.4]}\nsamples: [1]\n"
    "seeds: {first: 11, count: 2}\nobservables: {bed: {recipe: contacts}}\n"
    "across: {fit: {fit: order, of: bed.sweeps_max, along: step, exact: true}}\n"
    "checks:\n"
    "  - {name: value, observable: bed.largest_overlap, points: {darcy: published}, expect: 1.37,\n"
    "     margin: 3 %, scatter: 0.5 %, kind: model, because: b}\n"
    "  - {name: order, observable: fit.order, kind: order, margin: 0.05, because: b,\n"
    "     expect: {by: darcy, values: {published: 2, corrected: 1}}}\n"
    "tiers: {smoke: {}}\n";

/* A measured case made by hand: every run has overlap 1.37 and sweeps step^order. */
struct stage {
    struct case_file *c;
    struct plan *plan;
    struct measured_case *m;
    struct folder *folder;
    struct execute_options o;
    const char *parent;
};

static void fill(struct stage *s, struct measured_run *r, const struct measured_point *p) {
    struct arena *a = &s->m->arena;
    double step = measured_parameter(p, "step");
    double order = measured_parameter_is(p, "darcy", "published") ? 2 : 1;
    r->seconds = 0.25;
    r->observable = arena_take(a, 1, sizeof *r->observable);
    r->sample = arena_take(a, 2, sizeof *r->sample);
    ck_assert(r->observable != NULL && r->sample != NULL);
    r->observable[0].value[1] = 3.1 * pow(step, order);
    r->sample[0] =
        (struct measured_sample){.measured = 1.37 + 1e-4 * (double)r->run->seed, .expected = 1.37};
    r->sample[1] = (struct measured_sample){.measured = NAN, .expected = order};
}

static void set_up(struct stage *s) {
    struct fault fault;
    s->parent = unit_folder();
    s->c = stage_case(s->parent, "fake/case", text, &fault);
    unit_ok(fault.status, &fault);
    s->plan = stage_plan(s->c, TIER_SMOKE);
    unit_ok(folder_open(unit_path(s->parent, "out"), true, &s->folder, &fault), &fault);
    s->o = (struct execute_options){.folder = s->folder, .solver = "./solver"};
    s->m = stage_runs(s->plan);
    for (size_t p = 0; p < s->m->point_count; p++)
        for (size_t i = 0; i < s->m->point[p].run_count; i++)
            fill(s, &s->m->point[p].run[i], &s->m->point[p]);
}

static struct rows *judge(struct stage *s) {
    struct fault fault = FAULT_NONE;
    struct rows *rows;
    unit_ok(rows_judge(s->m, &s->o, NULL, &rows, &fault), &fault);
    return rows;
}

static void tear_down(struct stage *s, struct rows *rows) {
    rows_free(rows);
    measured_case_free(s->m);
    plan_free(s->plan);
    case_free(s->c);
    folder_close(s->folder);
    unit_remove(s->parent);
}

START_TEST(points_and_groups_become_rows) {
    struct stage s;
    set_up(&s);
    struct rows *rows = judge(&s);
    ck_assert_uint_eq(rows->count, 5); /* three points, two groups */
    for (size_t i = 0; i < 5; i++)
        ck_assert_msg(rows->row[i].verdict == VERDICT_PASS, "%s", rows->row[i].reason);
    ck_assert_str_eq(rows->row[1].point, "darcy=published,step=0.2");
    ck_assert_uint_eq(rows->row[1].run_count, 2);
    ck_assert_double_eq(rows->row[1].seconds, 0.5);
    ck_assert_uint_eq(rows->row[1].value_count, 2);
    for (size_t i = 0; i < 2; i++) {
        ck_assert_int_eq(rows->row[1].seeds[i], 11 + (int)i);
        ck_assert_double_eq(rows->row[1].values[i], 1.37 + 1e-4 * (11 + (double)i));
    }
    ck_assert(isnan(rows->row[1].detectable) && isnan(rows->row[1].alarm_rate));
    ck_assert_ptr_eq(rows->point[1], &s.m->point[1]);
    ck_assert_str_eq(rows->row[4].point, "darcy=corrected");
    ck_assert_uint_eq(rows->row[4].run_count, 6);
    ck_assert_double_eq_tol(rows->row[3].measured, 2, 1e-12);
    ck_assert_double_eq(rows->row[4].expected, 1);
    ck_assert_ptr_null(rows->point[4]);
    ck_assert_ptr_nonnull(strstr(rows->row[0].repeat, "--seed 11 "));
    ck_assert_ptr_nonnull(strstr(rows->row[0].repeat, " && "));
    tear_down(&s, rows);
}
END_TEST

START_TEST(a_wrong_order_and_a_wrong_value_fail_alone) {
    struct stage s;
    set_up(&s);
    for (size_t i = 0; i < 2; i++) {
        s.m->point[2].run[i].sample[0].measured = 1.29;
        for (size_t p = 3; p < 6; p++)
            s.m->point[p].run[i].observable[0].value[1] =
                1.7 * pow(measured_parameter(&s.m->point[p], "step"), 1.2);
    }
    struct rows *rows = judge(&s);
    static const enum verdict wanted[] = {VERDICT_PASS, VERDICT_PASS, VERDICT_FAIL, VERDICT_PASS,
                                          VERDICT_FAIL};
    for (size_t i = 0; i < 5; i++)
        ck_assert_msg(rows->row[i].verdict == wanted[i], "row %zu: %s", i, rows->row[i].reason);
    tear_down(&s, rows);
}
END_TEST

START_TEST(a_failed_run_is_a_row_and_leaves_its_checks_open) {
    struct stage s;
    set_up(&s);
    struct measured_run *r = &s.m->point[1].run[1];
    r->usable = false;
    r->failure = "the solver crashed";
    r->log_end = "the end";
    struct rows *rows = judge(&s);
    ck_assert_uint_eq(rows->count, 6);
    ck_assert_int_eq(rows->row[0].verdict, VERDICT_FAIL);
    ck_assert_str_eq(rows->row[0].kind, "run");
    ck_assert_str_eq(rows->row[0].check, "run with seed 12");
    ck_assert_str_eq(rows->row[0].reason, "the solver crashed");
    ck_assert_str_eq(rows->row[0].log_end, "the end");
    ck_assert_int_eq(rows->row[1].verdict, VERDICT_PASS);
    ck_assert_int_eq(rows->row[2].verdict, VERDICT_INCONCLUSIVE);
    ck_assert_ptr_nonnull(strstr(rows->row[2].reason, "1 of 2 runs: the solver crashed"));
    ck_assert_int_eq(rows->row[4].verdict, VERDICT_INCONCLUSIVE); /* the fit over these points */
    ck_assert_int_eq(rows->row[5].verdict, VERDICT_PASS);
    tear_down(&s, rows);
}
END_TEST

START_TEST(a_value_that_cannot_be_had_is_open_with_its_reason) {
    struct stage s;
    set_up(&s);
    s.m->point[0].run[0].sample[0].measured = NAN;
    s.m->point[0].run[0].sample[0].reason = "too few rows";
    s.m->point[4].run[0].observable[0].value[1] = NAN;
    snprintf(s.m->point[4].run[0].observable[0].reason, 160, "no frame left");
    s.m->point[1].run[0].observable[0].value[1] = -1; /* no order of negative numbers */
    s.m->point[1].run[1].observable[0].value[1] = -1;
    struct rows *rows = judge(&s);
    ck_assert_int_eq(rows->row[0].verdict, VERDICT_INCONCLUSIVE);
    ck_assert_ptr_nonnull(strstr(rows->row[0].reason, "too few rows"));
    ck_assert_int_eq(rows->row[3].verdict, VERDICT_INCONCLUSIVE);
    ck_assert_ptr_nonnull(strstr(rows->row[3].reason, "positive"));
    ck_assert_int_eq(rows->row[4].verdict, VERDICT_INCONCLUSIVE);
    ck_assert_ptr_nonnull(strstr(rows->row[4].reason, "no frame left"));
    tear_down(&s, rows);
}
END_TEST

START_TEST(means_for_figures_leave_unusable_runs_out) {
    struct stage s;
    double mean, error;
    set_up(&s);
    struct measured_point *p = &s.m->point[0];
    p->run[0].observable[0].value[0] = 1.25;
    p->run[1].observable[0].value[0] = 1.75;
    ck_assert_uint_eq(measured_mean(p, 0, 0, &mean, &error), 2);
    ck_assert_double_eq(mean, 1.5);
    ck_assert_double_eq_tol(error, 0.25, 1e-15);
    p->run[1].usable = false;
    ck_assert_uint_eq(measured_mean(p, 0, 0, &mean, &error), 1);
    ck_assert(mean == 1.25 && isnan(error));
    ck_assert(isnan(measured_parameter(p, "darcy")) && isnan(measured_parameter(p, "none")));
    tear_down(&s, NULL);
}
END_TEST

int main(void) {
    const TTest *const tests[] = {points_and_groups_become_rows,
                                  a_wrong_order_and_a_wrong_value_fail_alone,
                                  a_failed_run_is_a_row_and_leaves_its_checks_open,
                                  a_value_that_cannot_be_had_is_open_with_its_reason,
                                  means_for_figures_leave_unusable_runs_out,
                                  NULL};
    return unit_run("rows", tests);
}
