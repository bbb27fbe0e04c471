/* test_alarm.c -- validation/alarm.h against simulation: what an ensemble predicts is drawn, and
 * the judge himself is asked.
 *
 * Seeds are fixed; with others each bound, four standard deviations, would be broken once in 16000
 * times. */
#include "common/random.h"
#include "tests/unit/unit.h"
#include "validation/alarm.h"

#include <gsl/gsl_randist.h>
#include <math.h>

enum { MOST_SEEDS = 8, TRIALS = 20000 };

static const double expected_value = 1.2873;

/* Share of drawn runs that do not get the usual verdict. */
static double simulate(const struct alarm_question *q, uint64_t seed) {
    const struct judge_ensemble *e = &q->ensemble;
    struct fault fault = FAULT_NONE;
    gsl_rng *r;
    size_t alarms = 0;
    double measured[MOST_SEEDS], expected[MOST_SEEDS];
    unit_ok(random_stream(seed, "alarm", &r, &fault), &fault);
    struct judge_question j = {.comparison = q->comparison,
                               .kind = KIND_MODEL,
                               .margin = {true, false, q->tolerance},
                               .scatter = {isfinite(q->declared), false, q->declared},
                               .count = q->seeds,
                               .measured = measured,
                               .expected = expected,
                               .expected_uncertainty = q->expected_uncertainty,
                               .alarm_rate = q->share,
                               .known_since = q->known ? "2026-11-20" : NULL};
    for (int i = 0; i < TRIALS; i++) {
        double k = (double)e->seeds;
        double sigma = e->deviation * sqrt((k - 1) / gsl_ran_chisq(r, k - 1));
        double mean = expected_value + e->mean + gsl_ran_gaussian(r, sigma / sqrt(k));
        struct judge_answer a;
        for (size_t s = 0; s < q->seeds; s++) {
            expected[s] = expected_value;
            measured[s] = mean + gsl_ran_gaussian(r, sigma);
        }
        judge_check(&j, &a);
        alarms += a.verdict != (q->known ? VERDICT_KNOWN : VERDICT_PASS);
    }
    gsl_rng_free(r);
    return (double)alarms / TRIALS;
}

static void agrees(const struct alarm_question *q, uint64_t seed) {
    double p = alarm_rate(q), found = simulate(q, seed);
    ck_assert_msg(fabs(found - p) < 4 * sqrt(p * (1 - p) / TRIALS) + 1e-6,
                  "%s, %zu seeds: computed %g, found %g", case_comparison_name(q->comparison),
                  q->seeds, p, found);
}

static struct alarm_question question(double difference, double tolerance, size_t seeds) {
    return (struct alarm_question){.comparison = COMPARE_WITHIN,
                                   .tolerance = tolerance,
                                   .ensemble = {32, difference, 0.0131},
                                   .seeds = seeds,
                                   .declared = NAN};
}

START_TEST(without_a_declared_scatter_the_interval_follows_the_seeds) {
    static const double wide[] = {0.21, 0.061, 0.043, 0.031}; /* for 2, 3, 4, 7 seeds */
    static const size_t seeds[] = {2, 3, 4, 7};
    for (size_t i = 0; i < 4; i++) {
        struct alarm_question q = question(0.0047, wide[i], seeds[i]);
        double p = alarm_rate(&q);
        ck_assert_msg(p > 0.01 && p < 0.9, "%g tests nothing", p);
        agrees(&q, 100 + i);
        q.expected_uncertainty = 0.0061;
        agrees(&q, 200 + i);
    }
}
END_TEST

START_TEST(a_declared_scatter_may_be_right_or_too_small) {
    static const double declared[] = {0.0131, 0.0043, 0.021};
    for (size_t i = 0; i < 3; i++) {
        struct alarm_question q = question(-0.0047, 0.037, 2);
        q.declared = declared[i];
        q.share = 0.31;
        agrees(&q, 300 + i);
        q.seeds = 1;
        agrees(&q, 400 + i);
        q.seeds = 5;
        q.tolerance = 0.026;
        agrees(&q, 500 + i);
    }
}
END_TEST

START_TEST(each_comparison_and_known_disagreements) {
    struct alarm_question q = question(0.051, 0.031, 4);
    q.comparison = COMPARE_OUTSIDE;
    agrees(&q, 601);
    q.declared = 0.0131;
    agrees(&q, 602);
    q = question(0.051, 0.073, 4);
    q.comparison = COMPARE_AT_MOST;
    agrees(&q, 603);
    q = question(-0.051, 0.073, 4);
    q.comparison = COMPARE_AT_LEAST;
    agrees(&q, 604);
    q.declared = 0.012;
    agrees(&q, 605);
    q = question(0.051, 0.031, 4);
    q.known = true; /* within, and it usually fails */
    agrees(&q, 606);
    q.comparison = COMPARE_AT_MOST;
    agrees(&q, 607);
}
END_TEST

/* A margin of many deviations: the rate of the tails, which no simulation reaches, is that of
 * Student's t itself. */
START_TEST(small_rates_keep_their_digits) {
    struct alarm_question q = question(0, 0.11, 2);
    q.declared = 0.0131;
    double h = judge_half_width(0.0131 / sqrt(2), 0, INFINITY);
    double x = (0.11 - h) / (0.0131 * sqrt(0.5 + 1.0 / 32));
    ck_assert_double_gt(x, 9);
    /* Seeds that refute the scatter, F(1, 31) beyond 19.51, and far fewer in the two tails. */
    ck_assert_double_eq_tol(alarm_rate(&q), 1.1322e-4, 1e-7);
    q.fitted = true;
    ck_assert_double_lt(alarm_rate(&q), 3e-10);
    ck_assert_double_gt(alarm_rate(&q), 3e-12);
}
END_TEST

START_TEST(what_cannot_be_known_is_no_number) {
    struct alarm_question q = question(0.0047, 0.05, 2);
    ck_assert(isfinite(alarm_rate(&q)));
    q.ensemble.seeds = 0;
    ck_assert(isnan(alarm_rate(&q)));
    q = question(0.0047, 0.05, 2);
    q.ensemble.deviation = 0;
    ck_assert(isnan(alarm_rate(&q)));
    q = question(0.0047, NAN, 2);
    ck_assert(isnan(alarm_rate(&q)));
    q = question(0.0047, 0.05, 1); /* one seed of unknown scatter never passes */
    ck_assert_double_eq(alarm_rate(&q), 1);
}
END_TEST

int main(void) {
    const TTest *const tests[] = {without_a_declared_scatter_the_interval_follows_the_seeds,
                                  a_declared_scatter_may_be_right_or_too_small,
                                  each_comparison_and_known_disagreements,
                                  small_rates_keep_their_digits,
                                  what_cannot_be_known_is_no_number,
                                  NULL};
    return unit_run("alarm", tests);
}
