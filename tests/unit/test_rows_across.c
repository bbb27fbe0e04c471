/* test_rows_across.c -- validation/rows_across.h: fits over seeds, and fits made of them. */
#include "tests/unit/case_stage.h"
#include "validation/rows.h"

#include <math.h>

static const char good[] =
    "name: fake/case\ntitle: t\nsource: s\nquestion: q\nmodel: fake\nexpect_s: 2\n"
    "sweep: {step: {up: {phibar: 0.3}, down: {phibar: 0.45}, far: {phibar: 0.6}}}\n"
    "samples: [1]\nseeds: {first: 11, count: 3}\nobservables: {drop: {recipe: front}}\n"
    "across:\n"
    "  peak: {fit: peak-of-mean, of: drop, along: seeds}\n"
    "  trend: {fit: slope, of: peak.peak, along: phibar}\n"
    "checks:\n"
    "  - {name: peak, observable: peak.peak, kind: model, margin: 0.05, because: b,\n"
    "     expect: {by: step, values: {up: 1.53, down: 1.455, far: 1.38}}}\n"
    "  - {name: trend, observable: trend.slope, kind: model, margin: 0.3, expect: -0.5, because: "
    "b}\n"
    "tiers: {smoke: {}}\n";

/* A measured case made by hand: peaks of the mean curve 1.68 - .5 phibar at .7. */
struct stage {
    struct case_file *c;
    struct plan *plan;
    struct measured_case *m;
    struct folder *folder;
    struct execute_options o;
    const char *parent;
};

/* Noise that cancels over three seeds. */
static const double noise[3] = {0.02, -0.05, 0.03};

static void fill(struct stage *s, struct measured_point *p, size_t seed) {
    static const double x[3] = {0.2, 0.7, 1.3};
    struct fault fault = FAULT_NONE;
    struct measured_run *r = &p->run[seed];
    double height = 1.68 - 0.5 * measured_parameter(p, "phibar");
    double y[3] = {0.4, height + noise[seed], 0.9 - noise[seed]};
    r->seconds = 0.25;
    r->observable = arena_take(&s->m->arena, 1, sizeof *r->observable);
    r->sample = arena_take(&s->m->arena, 2, sizeof *r->sample);
    ck_assert(r->observable != NULL && r->sample != NULL);
    unit_ok(measurement_add_curve(&r->observable[0], "front", "", x, y, 3, &fault), &fault);
    for (size_t k = 0; k < 2; k++) { /* the expectation differs from run to run, as from data */
        double expected = k == 1 ? -0.5 : height + 0.01 * (double)seed - 0.01;
        r->sample[k] = (struct measured_sample){.measured = NAN, .expected = expected};
    }
}

static void set_up(struct stage *s) {
    struct fault fault;
    s->parent = unit_folder();
    s->c = stage_case(s->parent, "fake/case", good, &fault);
    unit_ok(fault.status, &fault);
    s->plan = stage_plan(s->c, TIER_SMOKE);
    unit_ok(folder_open(unit_path(s->parent, "out"), true, &s->folder, &fault), &fault);
    s->o = (struct execute_options){.folder = s->folder, .solver = "./solver"};
    s->m = stage_runs(s->plan);
    for (size_t p = 0; p < s->m->point_count; p++)
        for (size_t i = 0; i < s->m->point[p].run_count; i++)
            fill(s, &s->m->point[p], i);
}

static struct rows *judge(struct stage *s) {
    struct fault fault = FAULT_NONE;
    struct rows *rows;
    for (size_t p = 0; p < s->m->point_count; p++)
        unit_ok(measured_fit_ensembles(s->m->plan, &s->m->arena, &s->m->point[p], &fault), &fault);
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

START_TEST(a_fit_over_seeds_is_a_row_a_point) {
    struct stage s;
    set_up(&s);
    struct rows *rows = judge(&s);
    ck_assert_uint_eq(rows->count, 4);
    for (size_t i = 0; i < 4; i++)
        ck_assert_msg(rows->row[i].verdict == VERDICT_PASS, "%s", rows->row[i].reason);
    ck_assert_str_eq(rows->row[1].point, "step=down");
    ck_assert_ptr_eq(rows->point[1], &s.m->point[1]); /* figures find it there */
    ck_assert_uint_eq(rows->row[1].run_count, 3);
    ck_assert_double_eq_tol(rows->row[1].measured, 1.455, 1e-12);
    ck_assert_double_eq_tol(rows->row[1].expected, 1.455, 1e-12); /* the runs' mean */
    double squares = 0; /* without one seed the mean moves by half its noise */
    for (size_t i = 0; i < 3; i++)
        squares += noise[i] * noise[i] / 4;
    ck_assert_double_eq_tol(rows->row[1].uncertainty, sqrt(squares * 2 / 3), 1e-12);
    ck_assert_ptr_nonnull(strstr(rows->row[1].repeat, "--seed 11 "));
    tear_down(&s, rows);
}
END_TEST

START_TEST(a_fit_over_a_sweep_is_made_of_fits_over_seeds) {
    struct stage s;
    set_up(&s);
    struct rows *rows = judge(&s);
    const struct report_row *trend = &rows->row[3];
    ck_assert_str_eq(trend->point, "single");
    ck_assert_uint_eq(trend->run_count, 9);
    ck_assert_double_eq_tol(trend->measured, -0.5, 1e-10);
    ck_assert_double_eq_tol(trend->uncertainty, rows->row[1].uncertainty / (0.15 * sqrt(2)), 1e-10);
    tear_down(&s, rows);
}
END_TEST

START_TEST(a_seed_without_its_curve_leaves_the_fit_open) {
    struct stage s;
    set_up(&s);
    struct measurement *bare = &s.m->point[1].run[2].observable[0];
    measurement_free(bare);
    *bare = (struct measurement){.reason = ""};
    struct rows *rows = judge(&s);
    ck_assert_int_eq((int)rows->row[0].verdict, (int)VERDICT_PASS);
    ck_assert_int_eq((int)rows->row[1].verdict, (int)VERDICT_INCONCLUSIVE);
    ck_assert_ptr_nonnull(strstr(rows->row[1].reason, "a run has no curve"));
    ck_assert_int_eq((int)rows->row[3].verdict, (int)VERDICT_INCONCLUSIVE);
    ck_assert_ptr_nonnull(strstr(rows->row[3].reason, "a run has no curve"));
    tear_down(&s, rows);
}
END_TEST

START_TEST(a_failed_run_leaves_the_fit_open) {
    struct stage s;
    set_up(&s);
    s.m->point[0].run[1].usable = false;
    s.m->point[0].run[1].failure = "crashed";
    struct rows *rows = judge(&s);
    ck_assert_str_eq(rows->row[0].kind, "run");
    ck_assert_int_eq((int)rows->row[1].verdict, (int)VERDICT_INCONCLUSIVE);
    ck_assert_ptr_nonnull(strstr(rows->row[1].reason, "crashed"));
    ck_assert_int_eq((int)rows->row[2].verdict, (int)VERDICT_PASS);
    tear_down(&s, rows);
}
END_TEST

static const struct {
    const char *from, *to, *says;
} bad[] = {
    {"count: 3", "count: 2", "across peak: 2 seeds in tier smoke, peak-of-mean needs 3"},
    {"fit: peak-of-mean", "fit: peak-of-men", "no such fit over seeds; did you mean peak-of-mean?"},
    {"fit: peak-of-mean", "fit: slope", "slope goes along a swept parameter, not along seeds"},
    {"of: drop,", "of: drop.height,", "a fit over seeds is of an observable, without an output"},
    {"of: drop,", "of: drip,", "drip: no such observable of this case; did you mean drop?"},
    {"along: seeds", "along: phibar", "peak-of-mean is a fit over seeds: along: seeds"},
    {"along: seeds", "along: seeds, exact: true", "a fit over seeds finds its own scatter"},
    {"recipe: front", "recipe: contacts", "fits curves, and contacts gives none"},
    {"peak.peak, along", "peak.pick, along", "pick: no such output of peak; did you mean peak?"},
    {"of: peak.peak", "of: trend.slope", "no such observable of this case"},
    {"along: seeds}", "along: seeds, points: {step: up}}", "trend: peak leaves out points"},
    {"  trend: {", "  more: {fit: slope, of: trend.slope, along: phibar}\n  trend: {",
     "no such observable of this case"},
    {"kind: model, margin: 0.3", "points: {step: up}, kind: model, margin: 0.3",
     "step is what the fit goes along"},
};

START_TEST(every_fault_is_told) {
    struct fault fault;
    ck_assert_ptr_null(stage_spoiled("fake/case", good, bad[_i].from, bad[_i].to, &fault));
    unit_says(&fault, bad[_i].says);
}
END_TEST

int main(void) {
    Suite *suite = suite_create("rows_across");
    TCase *group = tcase_create("rows_across");
    tcase_add_test(group, a_fit_over_seeds_is_a_row_a_point);
    tcase_add_test(group, a_fit_over_a_sweep_is_made_of_fits_over_seeds);
    tcase_add_test(group, a_seed_without_its_curve_leaves_the_fit_open);
    tcase_add_test(group, a_failed_run_leaves_the_fit_open);
    tcase_add_loop_test(group, every_fault_is_told, 0, sizeof bad / sizeof *bad);
    suite_add_tcase(suite, group);
    return unit_finish(suite);
}
