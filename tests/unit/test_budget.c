/* test_budget.c -- validation/budget.h: which rows share the false alarms, and checks that cannot
 * see what they say they detect. */
#include "tests/unit/judged_stage.h"

/* Statistical: `same` at two points, `model` at one, `slope` once. */
static const char text[] = STAGE_HEAD
    "across: {trend: {fit: zero, of: bed.sweeps_max, along: height_l},\n"
    "         exact: {fit: zero, of: bed.sweeps_max, along: height_l, exact: true}}\n"
    "checks:\n"
    "  - {name: same, observable: bed.largest_overlap, kind: regression, detects: 3 %, because: "
    "b}\n"
    "  - {name: pair, observable: bed.largest_overlap, kind: regression, paired: true,\n"
    "     detects: 1 %, margin: 1e-3, because: b}\n"
    "  - {name: model, observable: bed.sweeps_max, points: {height_l: 3.7}, expect: 1.37,\n"
    "     margin: 3 %, kind: model, because: b}\n"
    "  - {name: bare, observable: bed.sweeps_max, expect: 1.37, margin: 3 %, scatter: 0,\n"
    "     kind: model, because: b}\n"
    "  - {name: round, observable: bed.sweeps_max, expect: 0, margin: 1e-9, kind: round-off,\n"
    "     because: b}\n"
    "  - {name: slope, observable: trend.zero, expect: 2, margin: 1, kind: model, because: b}\n"
    "  - {name: line, observable: exact.zero, expect: 2, margin: 1, kind: order, because: b}\n"
    "tiers: {smoke: {}, paper: {sweep: {height_l: [3.7, 5.3, 7.1]}}}\n";

START_TEST(rows_that_hang_on_chance_share_the_budget_of_the_whole_tier) {
    struct stage s;
    struct fault fault;
    stage_begin(&s, text);
    unit_ok(stage_open(&s, TIER_SMOKE, &fault), &fault);
    ck_assert_uint_eq(s.budget->statistical, 4);
    ck_assert_double_eq_tol(s.budget->share, 2.5e-4, 1e-18);
    unit_ok(stage_open(&s, TIER_PAPER, &fault), &fault);
    ck_assert_uint_eq(s.budget->statistical, 5);
    char other[sizeof text + 8];
    snprintf(other, sizeof other, "name: fake/next%s", text + strlen("name: fake/case"));
    unit_write(unit_path(s.folder, "cases/fake/next.yaml"), other);
    unit_ok(stage_open(&s, TIER_PAPER, &fault), &fault);
    ck_assert_uint_eq(s.budget->statistical, 10); /* though nobody selected it */
    ck_assert_double_eq_tol(s.budget->share, 1e-4, 1e-18);
    ck_assert_ptr_nonnull(budget_references(s.budget, "fake/next"));
    ck_assert_ptr_null(budget_references(s.budget, "fake/none"));
    ck_assert_ptr_null(budget_references(NULL, "fake/case"));
    stage_end(&s);
}
END_TEST

/* 3 % of 1.37 is .0411. With two seeds against 32 and a share of 2.5e-4, s = .0111 is seen from
 * .0486 on, s = .0079 from .0346. */
START_TEST(a_check_that_cannot_see_what_it_says_is_refused_before_any_run) {
    struct stage s;
    struct fault fault;
    stage_begin(&s, text);
    unit_ok(stage_open(&s, TIER_SMOKE, &fault), &fault);
    struct reference line = stage_line(&s, 0, 1, ORIGIN_ENSEMBLE, 1.37, 0.0111);
    stage_write(&s, &line, 1);
    ck_assert_int_eq(stage_open(&s, TIER_SMOKE, &fault), STATUS_BAD_INPUT);
    ck_assert_ptr_null(s.budget);
    unit_says(&fault, "cases/fake/case.yaml:14:");
    unit_says(&fault, "check same at height_l=5.3: says that it detects 3 %, but with 2 seeds "
                      "against 32 no change below 0.0486");
    unit_ok(stage_open(&s, TIER_PAPER, &fault), &fault); /* that is another tier's reference */
    line.deviation = 0.0079;
    stage_write(&s, &line, 1);
    unit_ok(stage_open(&s, TIER_SMOKE, &fault), &fault);
    line.deviation = 0.0111;
    line.meaning = "00000000"; /* of another text: nothing is judged by it */
    stage_write(&s, &line, 1);
    unit_ok(stage_open(&s, TIER_SMOKE, &fault), &fault);
    stage_end(&s);
}
END_TEST

/* A margin of 1e-3 surely shows 2e-3; 1 % of .19 is less. */
START_TEST(a_pair_that_cannot_see_what_it_says_is_refused) {
    struct stage s;
    struct fault fault;
    stage_begin(&s, text);
    unit_ok(stage_open(&s, TIER_SMOKE, &fault), &fault);
    struct reference line = stage_line(&s, 1, 0, ORIGIN_SEED, 0.19, NAN);
    line.observable = "bed.largest_overlap@12";
    stage_write(&s, &line, 1);
    ck_assert_int_eq(stage_open(&s, TIER_SMOKE, &fault), STATUS_BAD_INPUT);
    unit_says(&fault, "check pair at height_l=3.7: says that it detects 1 %, but no change below "
                      "0.002 (1.05 %) is seen");
    line.value = 0.21;
    stage_write(&s, &line, 1);
    unit_ok(stage_open(&s, TIER_SMOKE, &fault), &fault);
    stage_end(&s);
}
END_TEST

/* Whoever opens a budget, a run or a report made anew, is told of a reference that counts for
 * nothing. */
START_TEST(a_reference_that_no_check_uses_opens_no_budget) {
    struct stage s;
    struct fault fault;
    struct budget *b;
    stage_begin(&s, text);
    unit_ok(stage_open(&s, TIER_SMOKE, &fault), &fault);
    struct reference line = stage_line(&s, 0, 1, ORIGIN_ENSEMBLE, 1.37, 0.0079);
    line.observable = "bed.largest_overlp";
    stage_write(&s, &line, 1);
    ck_assert_int_eq(stage_open(&s, TIER_SMOKE, &fault), STATUS_BAD_INPUT);
    unit_says(&fault,
              "case.tsv:3: bed.largest_overlp: no check of this point has such an observable; "
              "did you mean bed.largest_overlap?");
    /* who is to replace references may */
    unit_ok(budget_open_unrefused(unit_path(s.folder, "cases"), unit_path(s.folder, "references"),
                                  TIER_SMOKE, NULL, &b, &fault),
            &fault);
    budget_close(b);
    stage_end(&s);
}
END_TEST

START_TEST(a_broken_table_opens_no_budget) {
    struct stage s;
    struct fault fault;
    stage_begin(&s, text);
    unit_write(unit_path(s.folder, "references/fake/case.tsv"), "tier\tpoint\n");
    ck_assert_int_ne(stage_open(&s, TIER_SMOKE, &fault), STATUS_OK);
    unit_says(&fault, "references/fake/case.tsv");
    stage_end(&s);
}
END_TEST

/* Who runs one case is not stopped by another that is broken, or that sees too little. */
START_TEST(only_wanted_cases_must_be_good) {
    struct stage s;
    struct fault fault = FAULT_NONE;
    struct budget *b;
    stage_begin(&s, text);
    unit_ok(stage_open(&s, TIER_SMOKE, &fault), &fault);
    char next[sizeof text + 8];
    snprintf(next, sizeof next, "name: fake/next%s", text + strlen("name: fake/case"));
    unit_write(unit_path(s.folder, "cases/fake/next.yaml"), next);
    unit_write(unit_path(s.folder, "cases/fake/broken.yaml"), "name: [\n");
    unit_write(unit_path(s.folder, "references/fake/next.tsv"), "tier\tpoint\n");
    const char *cases = unit_path(s.folder, "cases"), *table = unit_path(s.folder, "references");
    unit_ok(budget_open(cases, table, TIER_SMOKE, s.budget->plan, &b, &fault), &fault);
    ck_assert_uint_eq(b->statistical, 8); /* both that can be read */
    budget_close(b);
    ck_assert_int_ne(budget_open(cases, table, TIER_SMOKE, NULL, &b, &fault), STATUS_OK);
    unit_says(&fault, "fake/broken.yaml");
    stage_end(&s);
}
END_TEST

int main(void) {
    const TTest *const tests[] = {rows_that_hang_on_chance_share_the_budget_of_the_whole_tier,
                                  a_check_that_cannot_see_what_it_says_is_refused_before_any_run,
                                  a_pair_that_cannot_see_what_it_says_is_refused,
                                  a_reference_that_no_check_uses_opens_no_budget,
                                  a_broken_table_opens_no_budget,
                                  only_wanted_cases_must_be_good,
                                  NULL};
    return unit_run("budget", tests);
}
