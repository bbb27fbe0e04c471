/* test_calibrate.c -- validation/calibrate.h: predicted rates are met by seeds held out. */
#include "common/random.h"
#include "tests/unit/unit.h"
#include "validation/calibrate.h"

#include <gsl/gsl_randist.h>
#include <gsl/gsl_statistics_double.h>
#include <math.h>

enum { MANY = 4000 };

struct sample {
    struct case_check check;
    struct scatter s;
    double value[MANY], expected[MANY];
};

/* `count` seeds of mean and deviation, judged within a margin of 1. */
static void draw(struct sample *x, size_t count, double mean, double deviation, unsigned seed) {
    struct fault fault = FAULT_NONE;
    gsl_rng *stream;
    unit_ok(random_stream(seed, "test", &stream, &fault), &fault);
    *x = (struct sample){.check = {.kind = KIND_MODEL, .margin = {true, false, 0.05}}};
    for (size_t i = 0; i < count; i++) {
        x->value[i] = mean + gsl_ran_gaussian(stream, deviation);
        x->expected[i] = 1;
    }
    gsl_rng_free(stream);
    x->s = (struct scatter){.check = &x->check,
                            .count = count,
                            .value = x->value,
                            .expected = x->expected,
                            .mean = gsl_stats_mean(x->value, 1, count),
                            .deviation = gsl_stats_sd(x->value, 1, count)};
}

START_TEST(the_margin_proposed_keeps_to_the_share) {
    static struct sample x;
    struct calibrate_row now, then;
    draw(&x, 64, 1.0137, 0.0071, 7);
    calibrate_row(&x.s, 4, 1.3e-5, &now);
    ck_assert_double_eq(now.tolerance, 0.05);
    /* |d| + h + some five standard deviations of the mean of 4 */
    ck_assert(now.margin > 0.0137 + 5 * 0.0071 / 2 && now.margin < 0.0137 + 10 * 0.0071 / 2);
    ck_assert(now.scatter > x.s.deviation && now.scatter < 2 * x.s.deviation);
    x.check.margin.value = now.margin;
    x.check.scatter = (struct case_amount){true, false, now.scatter};
    calibrate_row(&x.s, 4, 1.3e-5, &then);
    ck_assert(then.rate <= 1.3e-5 && then.rate > 1.2e-5); /* and no more than it must be */
    x.check.margin.value = 0.8 * now.margin;
    calibrate_row(&x.s, 4, 1.3e-5, &then);
    ck_assert(then.rate > 1e-4);
}
END_TEST

/* Measured less a curve's 1.27, within 4 % of it: as good as measured within 4 % of 1.27. */
START_TEST(percentages_of_a_difference_are_of_what_was_subtracted) {
    static struct sample x;
    struct calibrate_row row;
    struct calibrate_count count;
    draw(&x, 64, 0.0137, 0.0071, 7);
    for (size_t i = 0; i < x.s.count; i++)
        x.expected[i] = 0;
    x.s.scale = 1.27;
    x.check.margin = (struct case_amount){true, true, 4};
    x.check.scatter = (struct case_amount){true, true, 0.6};
    calibrate_row(&x.s, 4, 1.3e-5, &row);
    ck_assert(fabs(row.tolerance - 0.04 * 1.27) < 1e-15 && row.rate < 1e-3);
    calibrate_hold_out(&x.s, 4, 1.3e-5, &count);
    ck_assert_uint_eq(count.groups, 8);
    ck_assert_uint_eq(count.not_pass, 0);
    x.s.scale = 0.127;
    calibrate_hold_out(&x.s, 4, 1.3e-5, &count);
    ck_assert_uint_eq(count.not_pass, 8);
}
END_TEST

START_TEST(a_change_that_is_called_detectable_is_of_the_size_of_the_scatter) {
    static struct sample x;
    struct calibrate_row few, many;
    draw(&x, 64, 1.0137, 0.0071, 7);
    calibrate_row(&x.s, 2, 1e-5, &few);
    calibrate_row(&x.s, 16, 1e-5, &many);
    /* (4.9 + 1.7) s sqrt(1/2 + 1/64), normal quantiles; those of t are larger */
    double normal = 6.06 * x.s.deviation * sqrt(1 / 2. + 1 / 64.);
    ck_assert(few.detectable > normal && few.detectable < 1.25 * normal);
    ck_assert(many.detectable < few.detectable / 2);
}
END_TEST

/* Of 2000 runs held out: the rate that the first half predicts. */
START_TEST(seeds_held_out_meet_the_predicted_rate) {
    static struct sample x;
    struct calibrate_count c;
    draw(&x, MANY, 1.0413, 0.0091, 11);
    x.check.scatter = (struct case_amount){true, false, 0.0093};
    calibrate_hold_out(&x.s, 4, 1e-5, &c);
    ck_assert_uint_eq(c.calibrating, 2000);
    ck_assert_uint_eq(c.groups, 500);
    ck_assert(c.expected > 20 && c.expected < 480);
    double spread = sqrt(c.expected * (1 - c.expected / 500));
    ck_assert(fabs((double)c.not_pass - c.expected) < 4 * spread);
    ck_assert(fabs((double)c.beyond - 50) < 4 * sqrt(50 * 0.9));
}
END_TEST

START_TEST(seeds_that_drift_part_from_the_first_half) {
    static struct sample x;
    struct calibrate_count c;
    draw(&x, 80, 1.0137, 0.0071, 13);
    for (size_t i = 40; i < 80; i++)
        x.value[i] += 0.03;
    calibrate_hold_out(&x.s, 4, 1e-5, &c);
    ck_assert_uint_eq(c.groups, 10);
    ck_assert_uint_eq(c.beyond, 10);
}
END_TEST

START_TEST(too_few_seeds_hold_out_nothing) {
    static struct sample x;
    struct calibrate_count c;
    draw(&x, 7, 1.0137, 0.0071, 17);
    calibrate_hold_out(&x.s, 5, 1e-5, &c);
    ck_assert_uint_eq(c.groups, 0);
    x.s.missing = "a run failed";
    calibrate_hold_out(&x.s, 2, 1e-5, &c);
    ck_assert_uint_eq(c.groups, 0);
    struct calibrate_row row;
    calibrate_row(&x.s, 2, 1e-5, &row);
    ck_assert(isnan(row.rate) && isnan(row.margin) && isnan(row.detectable));
}
END_TEST

START_TEST(regression_rows_alarm_at_their_share) {
    static struct sample x;
    struct calibrate_row row;
    struct calibrate_count c;
    draw(&x, MANY, 1.0137, 0.0071, 19);
    x.check = (struct case_check){.kind = KIND_REGRESSION};
    calibrate_row(&x.s, 4, 0.02, &row);
    ck_assert_double_eq(row.rate, 0.02);
    ck_assert(isnan(row.margin));
    calibrate_hold_out(&x.s, 4, 0.02, &c);
    ck_assert_double_eq_tol(c.expected, 10, 1e-9);
    ck_assert(fabs((double)c.not_pass - 10) < 4 * sqrt(10));
}
END_TEST

int main(void) {
    const TTest *tests[] = {the_margin_proposed_keeps_to_the_share,
                            percentages_of_a_difference_are_of_what_was_subtracted,
                            a_change_that_is_called_detectable_is_of_the_size_of_the_scatter,
                            seeds_held_out_meet_the_predicted_rate,
                            seeds_that_drift_part_from_the_first_half,
                            too_few_seeds_hold_out_nothing,
                            regression_rows_alarm_at_their_share,
                            NULL};
    return unit_run("calibrate", tests);
}
