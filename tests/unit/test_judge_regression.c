/* test_judge_regression.c -- comparisons with a stored ensemble and with single seeds of it, and
 * known disagreements.
 *
 * Simulations have fixed seeds. With other seeds each of the four bounds, four standard deviations
 * of a binomial count, would be broken once in 16000 times. */
#include "common/random.h"
#include "tests/unit/unit.h"
#include "validation/judge.h"
#include "validation/power.h"

#include <gsl/gsl_randist.h>
#include <math.h>

static struct judge_question against(const double *measured, size_t count) {
    return (struct judge_question){.kind = KIND_REGRESSION,
                                   .count = count,
                                   .measured = measured,
                                   .ensemble = {32, 1.2873, 0.0131},
                                   .alarm_rate = 2.3e-6};
}

static struct judge_answer answer(const struct judge_question *q) {
    struct judge_answer a;
    judge_check(q, &a);
    return a;
}

static void verdict_is(enum verdict wanted, const struct judge_answer *a) {
    ck_assert_msg(a->verdict == wanted, "verdict %d, not %d: %s", (int)a->verdict, (int)wanted,
                  a->reason);
}

START_TEST(a_run_like_the_ensemble_passes_and_a_shifted_one_fails_on_both_sides) {
    const double same[] = {1.2931, 1.2779}, more[] = {1.3731, 1.3579}, less[] = {1.2131, 1.1979};
    struct judge_question q = against(same, 2);
    struct judge_answer a = answer(&q);
    verdict_is(VERDICT_PASS, &a);
    ck_assert_double_eq_tol(a.measured, 1.2855, 1e-12);
    ck_assert_double_eq_tol(a.tolerance,
                            power_quantile(0.9 * 2.3e-6, 31) * 0.0131 * sqrt(17 / 32.0), 1e-9);
    ck_assert_double_eq_tol(a.uncertainty, 0.0131 / sqrt(2), 1e-12);
    ck_assert_double_gt(judge_detectable(&q), a.tolerance);
    q = against(more, 2);
    a = answer(&q);
    verdict_is(VERDICT_FAIL, &a);
    q = against(less, 2);
    a = answer(&q);
    verdict_is(VERDICT_FAIL, &a);
    ck_assert_ptr_nonnull(strstr(a.reason, "does not lie within"));
}
END_TEST

/* Student's own interval of two seeds, t(1) = 12.7, would swallow this; the ensemble's does not. */
START_TEST(the_run_s_own_scatter_does_not_widen_what_is_accepted) {
    const double off[] = {1.3401, 1.4059};
    struct judge_question q = against(off, 2);
    struct judge_answer a = answer(&q);
    verdict_is(VERDICT_FAIL, &a);
}
END_TEST

START_TEST(seeds_that_part_in_both_directions_do_not_cancel) {
    const double parted[] = {1.2873 + 1, 1.2873 - 1}, frozen[] = {1.2871, 1.2871};
    struct judge_question q = against(parted, 2);
    struct judge_answer a = answer(&q);
    verdict_is(VERDICT_FAIL, &a);
    ck_assert_ptr_nonnull(strstr(a.reason, "scatter"));
    q = against(frozen, 2); /* the seed is not used any more */
    a = answer(&q);
    verdict_is(VERDICT_INCONCLUSIVE, &a);
}
END_TEST

START_TEST(without_a_usable_ensemble_nothing_passes) {
    const double same[] = {1.2931, 1.2779};
    struct judge_question q = against(same, 2);
    const struct judge_ensemble poor[] = {
        {0, 0, 0},       {1, 1.2873, 0.0131},    {32, NAN, 0.0131},
        {32, 1.2873, 0}, {32, 1.2873, INFINITY}, {32, 1.2873, NAN}};
    for (size_t i = 0; i < sizeof poor / sizeof *poor; i++) {
        q.ensemble = poor[i];
        struct judge_answer a = answer(&q);
        verdict_is(VERDICT_INCONCLUSIVE, &a);
    }
    q = against(same, 2);
    q.no_reference = "the reference was made from another case text";
    struct judge_answer a = answer(&q);
    verdict_is(VERDICT_INCONCLUSIVE, &a);
    ck_assert_ptr_nonnull(strstr(a.reason, "another case text"));
    q = against(same, 2);
    q.alarm_rate = 0;
    a = answer(&q);
    verdict_is(VERDICT_INCONCLUSIVE, &a);
}
END_TEST

START_TEST(a_missing_sample_is_inconclusive_and_an_infinite_one_fails) {
    double hole[] = {1.2931, NAN};
    struct judge_question q = against(hole, 2);
    q.missing = "too few rows";
    struct judge_answer a = answer(&q);
    verdict_is(VERDICT_INCONCLUSIVE, &a);
    ck_assert_ptr_nonnull(strstr(a.reason, "1 of 2 runs: too few rows"));
    hole[1] = -INFINITY;
    q.ensemble.seeds = 0;
    a = answer(&q);
    verdict_is(VERDICT_FAIL, &a);
    q.count = 0;
    a = answer(&q);
    verdict_is(VERDICT_INCONCLUSIVE, &a);
}
END_TEST

/* -- pairs ----------------------------------------------------------------------- */

START_TEST(a_paired_check_judges_every_seed_against_its_own) {
    const double expected[] = {1.13, 1.31, 0.97};
    double measured[] = {1.1301, 1.3099, 0.9701};
    struct judge_question q = {.kind = KIND_REGRESSION,
                               .paired = true,
                               .count = 3,
                               .measured = measured,
                               .expected = expected,
                               .margin = {true, false, 2e-4}};
    struct judge_answer a = answer(&q);
    verdict_is(VERDICT_PASS, &a);
    ck_assert_double_eq_tol(judge_detectable(&q), 4e-4, 1e-15);
    measured[0] += 0.1; /* and back: the mean is as before */
    measured[1] -= 0.1;
    a = answer(&q);
    verdict_is(VERDICT_FAIL, &a);
    measured[0] = 0.97; /* the right values, of other seeds */
    measured[1] = 1.13;
    measured[2] = 1.31;
    a = answer(&q);
    verdict_is(VERDICT_FAIL, &a);
}
END_TEST

START_TEST(a_pair_without_its_reference_or_margin_is_inconclusive) {
    const double measured[] = {1.1301, 1.3099}, expected[] = {1.13, NAN}, fair[] = {1.13, 1.31};
    struct judge_question q = {.kind = KIND_REGRESSION,
                               .paired = true,
                               .count = 2,
                               .measured = measured,
                               .expected = expected,
                               .margin = {true, false, 2e-4}};
    struct judge_answer a = answer(&q);
    verdict_is(VERDICT_INCONCLUSIVE, &a);
    q.expected = fair;
    q.margin.given = false;
    a = answer(&q);
    verdict_is(VERDICT_INCONCLUSIVE, &a);
    q.margin.given = true;
    a = answer(&q);
    verdict_is(VERDICT_PASS, &a);
}
END_TEST

/* -- known ------------------------------------------------------------------------- */

START_TEST(a_known_disagreement_is_known_until_it_agrees) {
    double off[] = {1.3731, 1.3579}, same[] = {1.2931, 1.2779};
    struct judge_question q = against(off, 2);
    q.known_since = "2026-11-20";
    struct judge_answer a = answer(&q);
    verdict_is(VERDICT_KNOWN, &a);
    ck_assert_ptr_nonnull(strstr(a.reason, "known since 2026-11-20: 1.3655 does not lie"));
    q.measured = same;
    a = answer(&q);
    verdict_is(VERDICT_FAIL, &a);
    ck_assert_ptr_nonnull(strstr(a.reason, "agrees now"));
    q.ensemble.seeds = 0;
    a = answer(&q);
    verdict_is(VERDICT_INCONCLUSIVE, &a);
    off[1] = INFINITY; /* nobody knew of that */
    q = against(off, 2);
    q.known_since = "2026-11-20";
    a = answer(&q);
    verdict_is(VERDICT_FAIL, &a);
}
END_TEST

START_TEST(other_kinds_may_disagree_as_known_too) {
    const double measured[] = {1.37, 1.351, 1.362}, expected[] = {1.29, 1.29, 1.29};
    for (enum check_kind k = KIND_ROUND_OFF; k <= KIND_MODEL; k++) {
        struct judge_question q = {.kind = k,
                                   .count = 3,
                                   .measured = measured,
                                   .expected = expected,
                                   .margin = {true, false, 0.01},
                                   .known_since = "2026-11-20"};
        struct judge_answer a = answer(&q);
        verdict_is(VERDICT_KNOWN, &a);
        q.margin.value = 0.4;
        a = answer(&q);
        verdict_is(VERDICT_FAIL, &a);
    }
}
END_TEST

/* -- alarms, simulated -------------------------------------------------------------- */

static double mean_of(const double *x, size_t count) {
    double sum = 0;
    for (size_t i = 0; i < count; i++)
        sum += x[i];
    return sum / (double)count;
}

/* A fresh ensemble of `seeds` seeds, as it would be accepted. */
static struct judge_ensemble draw_ensemble(gsl_rng *r, size_t seeds, double sigma) {
    double x[64], squares = 0;
    for (size_t i = 0; i < seeds; i++)
        x[i] = 0.7193 + gsl_ran_gaussian(r, sigma);
    double mean = mean_of(x, seeds);
    for (size_t i = 0; i < seeds; i++)
        squares += (x[i] - mean) * (x[i] - mean);
    return (struct judge_ensemble){seeds, mean, sqrt(squares / (double)(seeds - 1))};
}

/* Does a run of `count` seeds, of changed code, raise an alarm? */
static bool alarm_raised(gsl_rng *r, const struct judge_ensemble *e, size_t count, double sigma,
                         double shift, double alarm_rate) {
    double x[8];
    for (size_t i = 0; i < count; i++)
        x[i] = 0.7193 + shift + gsl_ran_gaussian(r, sigma);
    struct judge_question q = {.kind = KIND_REGRESSION,
                               .count = count,
                               .measured = x,
                               .ensemble = *e,
                               .alarm_rate = alarm_rate};
    return answer(&q).verdict != VERDICT_PASS;
}

static void as_often_as(size_t found, size_t trials, double p) {
    double expected = p * (double)trials, spread = sqrt(expected * (1 - p));
    ck_assert_msg(fabs((double)found - expected) < 4 * spread, "%zu of %zu, expected %g +- %g",
                  found, trials, expected, spread);
}

/* Ensembles of 32 seeds, runs of 1 to 4: unchanged code is alarmed about as often as declared.
 * The two questions are asked of the same s, so their alarms overlap a little: by less than
 * their product, far below the bound. */
START_TEST(unchanged_code_raises_alarms_at_the_declared_rate) {
    enum { TRIALS = 12000 };
    struct fault fault = FAULT_NONE;
    gsl_rng *r;
    unit_ok(random_stream(40961, "alarms", &r, &fault), &fault);
    for (size_t n = 1; n <= 4; n++) {
        size_t alarms = 0;
        for (int i = 0; i < TRIALS; i++) {
            struct judge_ensemble e = draw_ensemble(r, 32, 0.0173);
            alarms += alarm_raised(r, &e, n, 0.0173, 0, 0.0137);
        }
        as_often_as(alarms, TRIALS, 0.0137);
    }
    gsl_rng_free(r);
}
END_TEST

/* Whole suites of 41 checks that share 5 %: as many of them are clean as the budget says. Each
 * check has an ensemble of its own; tests of one check at 5 % each would alarm in 88 % of them. */
START_TEST(a_suite_of_many_checks_keeps_its_budget) {
    enum { SUITES = 3000, CHECKS = 41 };
    struct fault fault = FAULT_NONE;
    gsl_rng *r;
    size_t alarmed = 0;
    unit_ok(random_stream(7177, "suites", &r, &fault), &fault);
    for (int i = 0; i < SUITES; i++) {
        bool any = false;
        for (int k = 0; k < CHECKS; k++) {
            struct judge_ensemble e = draw_ensemble(r, 32, 0.0173);
            any |= alarm_raised(r, &e, 2, 0.0173, 0, 0.05 / CHECKS);
        }
        alarmed += any;
    }
    as_often_as(alarmed, SUITES, 1 - pow(1 - 0.05 / CHECKS, CHECKS));
    gsl_rng_free(r);
}
END_TEST

START_TEST(a_detectable_change_is_detected_with_95_percent) {
    enum { TRIALS = 6000 };
    struct fault fault = FAULT_NONE;
    gsl_rng *r;
    size_t seen[2] = {0, 0};
    double level = judge_share_of_mean(1.1e-3, 2), delta = power_detectable(0.0173, 2, 32, level);
    unit_ok(random_stream(991, "changes", &r, &fault), &fault);
    for (int i = 0; i < TRIALS; i++) {
        struct judge_ensemble e = draw_ensemble(r, 32, 0.0173);
        seen[0] += alarm_raised(r, &e, 2, 0.0173, delta, 1.1e-3);
        seen[1] += alarm_raised(r, &e, 2, 0.0173, -delta, 1.1e-3);
    }
    as_often_as(seen[0], TRIALS, 0.95);
    as_often_as(seen[1], TRIALS, 0.95);
    gsl_rng_free(r);
}
END_TEST

int main(void) {
    const TTest *const tests[] = {
        a_run_like_the_ensemble_passes_and_a_shifted_one_fails_on_both_sides,
        the_run_s_own_scatter_does_not_widen_what_is_accepted,
        seeds_that_part_in_both_directions_do_not_cancel,
        without_a_usable_ensemble_nothing_passes,
        a_missing_sample_is_inconclusive_and_an_infinite_one_fails,
        a_paired_check_judges_every_seed_against_its_own,
        a_pair_without_its_reference_or_margin_is_inconclusive,
        a_known_disagreement_is_known_until_it_agrees,
        other_kinds_may_disagree_as_known_too,
        unchanged_code_raises_alarms_at_the_declared_rate,
        a_suite_of_many_checks_keeps_its_budget,
        a_detectable_change_is_detected_with_95_percent,
        NULL};
    return unit_run("judge_regression", tests);
}
