/* test_judge.c -- validation/judge.h: each comparison passes right data and fails planted faults.
 */
#include "tests/unit/unit.h"
#include "validation/judge.h"

#include <math.h>

static const struct case_amount nothing;

static struct case_amount amount(double value) {
    return (struct case_amount){.given = true, .value = value};
}

static struct case_amount percent(double value) {
    return (struct case_amount){.given = true, .percent = true, .value = value};
}

/* Up to four seeds of one expectation. */
struct seeds {
    size_t count;
    double measured[4], expected;
};

static struct judge_answer judge(enum comparison c, enum check_kind kind, struct case_amount margin,
                                 struct case_amount scatter, const struct seeds *s) {
    double expected[4] = {s->expected, s->expected, s->expected, s->expected};
    struct judge_question q = {.comparison = c,
                               .kind = kind,
                               .margin = margin,
                               .scatter = scatter,
                               .count = s->count,
                               .measured = s->measured,
                               .expected = expected};
    struct judge_answer a;
    judge_check(&q, &a);
    return a;
}

static void verdict_is(enum verdict wanted, const struct judge_answer *a) {
    ck_assert_msg(a->verdict == wanted, "verdict %d, not %d: %s", (int)a->verdict, (int)wanted,
                  a->reason);
}

/* The four comparisons on an interval that lies, straddles and misses. */
START_TEST(an_interval_passes_fails_or_stays_open) {
    static const struct {
        enum comparison c;
        double d, h, t;
        enum verdict v;
    } row[] = {
        {COMPARE_WITHIN, 0.031, 0.004, 0.0387, VERDICT_PASS},
        {COMPARE_WITHIN, -0.031, 0.004, 0.0387, VERDICT_PASS},
        {COMPARE_WITHIN, 0.051, 0.004, 0.0387, VERDICT_FAIL},
        {COMPARE_WITHIN, -0.051, 0.004, 0.0387, VERDICT_FAIL},
        {COMPARE_WITHIN, 0.0371, 0.004, 0.0387, VERDICT_INCONCLUSIVE},
        {COMPARE_WITHIN, -0.0371, 0.004, 0.0387, VERDICT_INCONCLUSIVE},
        {COMPARE_WITHIN, 0.001, 0.9, 0.0387, VERDICT_INCONCLUSIVE},
        {COMPARE_OUTSIDE, 0.051, 0.004, 0.0387, VERDICT_PASS},
        {COMPARE_OUTSIDE, -0.051, 0.004, 0.0387, VERDICT_PASS},
        {COMPARE_OUTSIDE, 0.031, 0.004, 0.0387, VERDICT_FAIL},
        {COMPARE_OUTSIDE, -0.031, 0.004, 0.0387, VERDICT_FAIL},
        {COMPARE_OUTSIDE, 0.0387, 0.004, 0.0387, VERDICT_INCONCLUSIVE},
        {COMPARE_OUTSIDE, 0.001, 0.9, 0.0387, VERDICT_INCONCLUSIVE},
        {COMPARE_AT_MOST, -3.7, 0.2, 0.011, VERDICT_PASS},
        {COMPARE_AT_MOST, 0.3, 0.2, 0.011, VERDICT_FAIL},
        {COMPARE_AT_MOST, 0.1, 0.2, 0.011, VERDICT_INCONCLUSIVE},
        {COMPARE_AT_LEAST, 3.7, 0.2, 0.011, VERDICT_PASS},
        {COMPARE_AT_LEAST, -0.3, 0.2, 0.011, VERDICT_FAIL},
        {COMPARE_AT_LEAST, -0.1, 0.2, 0.011, VERDICT_INCONCLUSIVE},
    };
    for (size_t i = 0; i < sizeof row / sizeof *row; i++)
        ck_assert_msg(judge_interval(row[i].c, row[i].d, row[i].h, row[i].t) == row[i].v, "row %zu",
                      i);
}
END_TEST

START_TEST(nothing_that_is_no_number_passes) {
    for (enum comparison c = COMPARE_WITHIN; c <= COMPARE_AT_LEAST; c++) {
        ck_assert_int_eq(judge_interval(c, NAN, 0.1, 0.2), VERDICT_INCONCLUSIVE);
        ck_assert_int_eq(judge_interval(c, 0.1, NAN, 0.2), VERDICT_INCONCLUSIVE);
        ck_assert_int_eq(judge_interval(c, 0.1, 0.1, NAN), VERDICT_INCONCLUSIVE);
        ck_assert_int_eq(judge_interval(c, 0.1, INFINITY, 0.2), VERDICT_INCONCLUSIVE);
    }
}
END_TEST

/* mean 1.2875, sd .0095394, t(3) = 3.1824: h = .015179 */
START_TEST(students_t_makes_the_interval_of_a_few_seeds) {
    const struct seeds s = {4, {1.29, 1.275, 1.287, 1.298}, 1.29};
    struct judge_answer a = judge(COMPARE_WITHIN, KIND_MODEL, percent(3), nothing, &s);
    verdict_is(VERDICT_PASS, &a);
    ck_assert_double_eq_tol(a.measured, 1.2875, 1e-12);
    ck_assert_double_eq_tol(a.uncertainty, 0.0095393920 / 2, 1e-8);
    ck_assert_double_eq_tol(a.interval, 3.1824463 * a.uncertainty, 1e-6);
    ck_assert_double_eq_tol(a.tolerance, 0.0387, 1e-12);
    const struct seeds off = {4, {1.35, 1.335, 1.347, 1.358}, 1.29};
    a = judge(COMPARE_WITHIN, KIND_MODEL, percent(3), nothing, &off);
    verdict_is(VERDICT_FAIL, &a);
    const struct seeds below = {4, {1.24, 1.225, 1.237, 1.228}, 1.29};
    a = judge(COMPARE_WITHIN, KIND_MODEL, percent(3), nothing, &below);
    verdict_is(VERDICT_FAIL, &a);
    const struct seeds two = {2, {1.29, 1.275, 0, 0}, 1.29}; /* t(1) = 12.7 */
    a = judge(COMPARE_WITHIN, KIND_MODEL, percent(3), nothing, &two);
    verdict_is(VERDICT_INCONCLUSIVE, &a);
}
END_TEST

START_TEST(a_known_scatter_lets_two_seeds_or_one_decide) {
    const struct seeds two = {2, {1.297, 1.281, 0, 0}, 1.29};
    struct judge_answer a = judge(COMPARE_WITHIN, KIND_MODEL, percent(3), percent(1), &two);
    verdict_is(VERDICT_PASS, &a);
    ck_assert_double_eq_tol(a.interval, 1.9599640 * 0.0129 / sqrt(2), 1e-7);
    const struct seeds one = {1, {1.297, 0, 0, 0}, 1.29};
    a = judge(COMPARE_WITHIN, KIND_MODEL, percent(3), percent(1), &one);
    verdict_is(VERDICT_PASS, &a);
    const struct seeds wrong = {1, {1.36, 0, 0, 0}, 1.29};
    a = judge(COMPARE_WITHIN, KIND_MODEL, percent(3), percent(1), &wrong);
    verdict_is(VERDICT_FAIL, &a);
}
END_TEST

START_TEST(seeds_that_contradict_the_declared_scatter_prove_nothing) {
    const struct seeds cancel = {2, {1.29 + 0.21, 1.29 - 0.21, 0, 0}, 1.29};
    struct judge_answer a = judge(COMPARE_WITHIN, KIND_MODEL, percent(3), percent(1), &cancel);
    verdict_is(VERDICT_INCONCLUSIVE, &a);
    ck_assert_ptr_nonnull(strstr(a.reason, "scatter"));
    const struct seeds fair = {2, {1.29 + 0.021, 1.29 - 0.021, 0, 0}, 1.29};
    a = judge(COMPARE_WITHIN, KIND_MODEL, percent(3), percent(1), &fair);
    verdict_is(VERDICT_PASS, &a);
}
END_TEST

START_TEST(one_seed_of_unknown_scatter_is_inconclusive) {
    const struct seeds s = {1, {1.29, 0, 0, 0}, 1.29};
    struct judge_answer a = judge(COMPARE_WITHIN, KIND_MODEL, percent(3), nothing, &s);
    verdict_is(VERDICT_INCONCLUSIVE, &a);
    a = judge(COMPARE_WITHIN, KIND_MODEL, percent(3), amount(0), &s);
    verdict_is(VERDICT_PASS, &a);
}
END_TEST

START_TEST(seeds_that_agree_to_the_last_bit_are_not_independent) {
    const struct seeds s = {3, {1.2837, 1.2837, 1.2837, 0}, 1.29};
    struct judge_answer a = judge(COMPARE_WITHIN, KIND_MODEL, percent(3), nothing, &s);
    verdict_is(VERDICT_INCONCLUSIVE, &a);
    ck_assert_ptr_nonnull(strstr(a.reason, "last bit"));
}
END_TEST

START_TEST(round_off_is_judged_sample_by_sample) {
    const struct seeds fine = {3, {1.3e-14, -0.7e-14, 0.2e-14, 0}, 0};
    struct judge_answer a = judge(COMPARE_WITHIN, KIND_ROUND_OFF, amount(1e-13), nothing, &fine);
    verdict_is(VERDICT_PASS, &a);
    ck_assert_double_eq_tol(a.measured, 1.3e-14, 1e-20);
    const struct seeds cancel = {2, {1.0, -1.0, 0, 0}, 0}; /* their mean is 0 */
    a = judge(COMPARE_WITHIN, KIND_ROUND_OFF, amount(1e-13), nothing, &cancel);
    verdict_is(VERDICT_FAIL, &a);
    a = judge(COMPARE_WITHIN, KIND_MODEL, amount(1e-13), amount(0), &cancel);
    verdict_is(VERDICT_FAIL, &a);
    const struct seeds last = {3, {1e-15, 1e-15, 3.1e-13, 0}, 0};
    a = judge(COMPARE_AT_MOST, KIND_ROUND_OFF, amount(1e-13), nothing, &last);
    verdict_is(VERDICT_FAIL, &a);
    ck_assert_double_eq_tol(a.measured, 3.1e-13, 1e-18);
    const struct seeds low = {3, {5.3, 5.1, 4.7, 0}, 5};
    a = judge(COMPARE_AT_LEAST, KIND_ROUND_OFF, nothing, nothing, &low);
    verdict_is(VERDICT_FAIL, &a);
    const struct seeds inside = {2, {1.31, 1.0713, 0, 0}, 1};
    a = judge(COMPARE_OUTSIDE, KIND_ROUND_OFF, amount(0.12), nothing, &inside);
    verdict_is(VERDICT_FAIL, &a);
    const struct seeds outside = {2, {1.31, 0.713, 0, 0}, 1};
    a = judge(COMPARE_OUTSIDE, KIND_ROUND_OFF, amount(0.12), nothing, &outside);
    verdict_is(VERDICT_PASS, &a);
}
END_TEST

START_TEST(a_bound_is_tested_on_the_side_that_it_names) {
    const struct seeds s = {3, {0.0271, 0.0283, 0.0262, 0}, 0.05};
    struct judge_answer a = judge(COMPARE_AT_MOST, KIND_MODEL, nothing, nothing, &s);
    verdict_is(VERDICT_PASS, &a);
    a = judge(COMPARE_AT_LEAST, KIND_MODEL, nothing, nothing, &s);
    verdict_is(VERDICT_FAIL, &a);
}
END_TEST

START_TEST(a_missing_value_is_inconclusive_and_says_why) {
    double measured[] = {1.29, NAN, 1.287}, expected[] = {1.29, 1.29, 1.29};
    struct judge_question q = {.margin = percent(3),
                               .kind = KIND_MODEL,
                               .scatter = percent(1),
                               .count = 3,
                               .measured = measured,
                               .expected = expected,
                               .missing = "too few rows"};
    struct judge_answer a;
    for (enum check_kind k = KIND_ROUND_OFF; k <= KIND_MODEL; k++) {
        q.kind = k;
        judge_check(&q, &a);
        verdict_is(VERDICT_INCONCLUSIVE, &a);
        ck_assert_ptr_nonnull(strstr(a.reason, "1 of 3 runs: too few rows"));
    }
    measured[1] = 1.288;
    expected[0] = NAN;
    judge_check(&q, &a);
    verdict_is(VERDICT_INCONCLUSIVE, &a);
    q.count = 0;
    judge_check(&q, &a);
    verdict_is(VERDICT_INCONCLUSIVE, &a);
    ck_assert(isnan(a.measured));
}
END_TEST

START_TEST(an_infinite_value_fails) {
    const struct seeds s = {2, {1.29, INFINITY, 0, 0}, 1.29};
    struct judge_answer a = judge(COMPARE_WITHIN, KIND_MODEL, percent(3), percent(1), &s);
    verdict_is(VERDICT_FAIL, &a);
    a = judge(COMPARE_AT_LEAST, KIND_ROUND_OFF, nothing, nothing, &s);
    verdict_is(VERDICT_FAIL, &a);
}
END_TEST

/* 1.96 * .04 = .078 */
START_TEST(a_fit_is_judged_with_its_own_uncertainty) {
    double measured = 1.97, expected = 2;
    struct judge_question q = {.margin = amount(0.15),
                               .kind = KIND_ORDER,
                               .count = 1,
                               .measured = &measured,
                               .expected = &expected,
                               .fitted = true,
                               .fit_uncertainty = 0.04};
    struct judge_answer a;
    judge_check(&q, &a);
    verdict_is(VERDICT_PASS, &a);
    measured = 1.02; /* first order where second is expected */
    judge_check(&q, &a);
    verdict_is(VERDICT_FAIL, &a);
    measured = 1.88;
    judge_check(&q, &a);
    verdict_is(VERDICT_INCONCLUSIVE, &a);
    q.fit_uncertainty = NAN;
    measured = 2;
    judge_check(&q, &a);
    verdict_is(VERDICT_INCONCLUSIVE, &a);
}
END_TEST

/* Each run has its own expectation; what counts is the scatter of the difference. */
START_TEST(expectations_that_follow_the_runs_take_their_scatter_away) {
    double measured[] = {1.13, 1.31, 0.97}, expected[] = {1.131, 1.3095, 0.9702};
    struct judge_question q = {.margin = amount(0.01),
                               .kind = KIND_MODEL,
                               .count = 3,
                               .measured = measured,
                               .expected = expected};
    struct judge_answer a;
    judge_check(&q, &a);
    verdict_is(VERDICT_PASS, &a);
    measured[0] = 1.31;
    measured[1] = 0.97;
    measured[2] = 1.13; /* the same values, of other runs */
    judge_check(&q, &a);
    verdict_is(VERDICT_INCONCLUSIVE, &a);
}
END_TEST

START_TEST(an_uncertain_expectation_widens_the_interval) {
    double measured[] = {1.31}, expected[] = {1.29};
    struct judge_question q = {.margin = amount(0.03),
                               .scatter = amount(0.003),
                               .kind = KIND_MODEL,
                               .count = 1,
                               .measured = measured,
                               .expected = expected};
    struct judge_answer a;
    judge_check(&q, &a);
    verdict_is(VERDICT_PASS, &a);
    q.expected_uncertainty = 0.013;
    judge_check(&q, &a);
    verdict_is(VERDICT_INCONCLUSIVE, &a);
    q.scatter = amount(0);
    judge_check(&q, &a);
    verdict_is(VERDICT_INCONCLUSIVE, &a);
}
END_TEST

int main(void) {
    const TTest *const tests[] = {an_interval_passes_fails_or_stays_open,
                                  nothing_that_is_no_number_passes,
                                  students_t_makes_the_interval_of_a_few_seeds,
                                  a_known_scatter_lets_two_seeds_or_one_decide,
                                  seeds_that_contradict_the_declared_scatter_prove_nothing,
                                  one_seed_of_unknown_scatter_is_inconclusive,
                                  seeds_that_agree_to_the_last_bit_are_not_independent,
                                  round_off_is_judged_sample_by_sample,
                                  a_bound_is_tested_on_the_side_that_it_names,
                                  a_missing_value_is_inconclusive_and_says_why,
                                  an_infinite_value_fails,
                                  a_fit_is_judged_with_its_own_uncertainty,
                                  expectations_that_follow_the_runs_take_their_scatter_away,
                                  an_uncertain_expectation_widens_the_interval,
                                  NULL};
    return unit_run("judge", tests);
}
