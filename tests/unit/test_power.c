/* test_power.c -- validation/power.h against tables, simulation and the normal limit.
 *
 * The simulations have fixed seeds; another seed would break one of their bounds, four standard
 * deviations of a binomial count, once in 16000 times. */
#include "common/random.h"
#include "tests/unit/unit.h"
#include "validation/power.h"

#include <gsl/gsl_cdf.h>
#include <gsl/gsl_randist.h>
#include <math.h>

/* Student's table: two-sided 5 % of 31, .1 % of 10 degrees of freedom. */
START_TEST(quantiles_are_those_of_the_table) {
    ck_assert_double_eq_tol(power_quantile(0.05, 31), 2.0395, 5e-5);
    ck_assert_double_eq_tol(power_quantile(0.001, 10), 4.587, 5e-4);
}
END_TEST

/* The textbook problem of two samples of 20 with means one standard deviation apart, at 5 %:
 * power .8689528; and .90 with 22.02110 in each (R manual, power.t.test). */
START_TEST(power_is_that_of_the_table) {
    ck_assert_double_eq_tol(power_of_shift(sqrt(20 / 2.0), 0.05, 38), 0.8689528, 5e-7);
    double n = 22.02110;
    ck_assert_double_eq_tol(power_of_shift(sqrt(n / 2), 0.05, 2 * (n - 1)), 0.9, 1e-6);
    ck_assert_double_eq_tol(power_shift(0.9, 0.05, 2 * (n - 1)), sqrt(n / 2), 1e-5);
}
END_TEST

START_TEST(without_a_change_the_power_is_the_alarm_rate) {
    static const double alpha[] = {0.37, 0.0131, 1.7e-4, 2.3e-6, 4.1e-8};
    static const double freedom[] = {2, 5, 31, 127, 3001};
    for (size_t i = 0; i < 5; i++) {
        for (size_t k = 0; k < 5; k++)
            ck_assert_double_eq_tol(power_of_shift(0, alpha[i], freedom[k]) / alpha[i], 1, 1e-5);
    }
}
END_TEST

START_TEST(many_degrees_of_freedom_are_the_normal_limit) {
    double z = gsl_cdf_ugaussian_Qinv(1.3e-6 / 2) + gsl_cdf_ugaussian_Pinv(POWER_WANTED);
    ck_assert_double_eq_tol(power_shift(POWER_WANTED, 1.3e-6, 4e6), z, 2e-5);
    ck_assert_double_gt(power_shift(POWER_WANTED, 1.3e-6, 31), z + 1);
}
END_TEST

static void draw(gsl_rng *r, size_t count, double mean, double sigma, double *m, double *s) {
    double sum = 0, squares = 0, x;
    for (size_t i = 0; i < count; i++) {
        x = gsl_ran_gaussian(r, sigma);
        sum += x;
        squares += x * x;
    }
    double offset = sum / (double)count;
    *m = mean + offset;
    *s = sqrt((squares - (double)count * offset * offset) / (double)(count - 1));
}

enum { SEEDS = 3, REFERENCE_SEEDS = 7, TRIALS = 40000 };

/* Share of trials with |m - mu| above the quantile, new ensembles and runs each time. */
static double simulate(uint64_t seed, double shift, double sigma, double alpha) {
    struct fault fault = FAULT_NONE;
    gsl_rng *r;
    size_t seen = 0;
    unit_ok(random_stream(seed, "power", &r, &fault), &fault);
    for (int i = 0; i < TRIALS; i++) {
        double mu, s, m, own;
        draw(r, REFERENCE_SEEDS, 1.2871, sigma, &mu, &s);
        draw(r, SEEDS, 1.2871 + shift, sigma, &m, &own);
        double scale = s * sqrt(1.0 / SEEDS + 1.0 / REFERENCE_SEEDS);
        seen += fabs(m - mu) > power_quantile(alpha, REFERENCE_SEEDS - 1) * scale;
    }
    gsl_rng_free(r);
    return (double)seen / TRIALS;
}

START_TEST(simulated_changes_are_seen_as_often_as_computed) {
    double sigma = 0.0713, scale = power_scale(sigma, SEEDS, REFERENCE_SEEDS);
    static const double shift[] = {0, 0.9, 2.3, 4.7};
    for (size_t i = 0; i < 4; i++) {
        double p = power_of_shift(shift[i], 0.0171, REFERENCE_SEEDS - 1);
        double found = simulate(311 + i, shift[i] * scale, sigma, 0.0171);
        ck_assert_msg(fabs(found - p) < 4 * sqrt(p * (1 - p) / TRIALS),
                      "shift %g: computed %g, found %g", shift[i], p, found);
    }
}
END_TEST

START_TEST(what_is_called_detectable_is_seen_with_95_percent) {
    double sigma = 0.0713, delta = power_detectable(sigma, SEEDS, REFERENCE_SEEDS, 0.0171);
    double found = simulate(677, -delta, sigma, 0.0171);
    ck_assert_double_eq_tol(found, 0.95, 4 * sqrt(0.95 * 0.05 / TRIALS));
}
END_TEST

START_TEST(more_seeds_see_less_and_nonsense_is_no_number) {
    double one = power_detectable(0.013, 1, 32, 1e-5), four = power_detectable(0.013, 4, 32, 1e-5);
    ck_assert_double_eq_tol(one / four, sqrt((1 + 1.0 / 32) / (0.25 + 1.0 / 32)), 1e-12);
    ck_assert_double_lt(power_detectable(0.013, 4, 64, 1e-5), four);
    ck_assert_double_gt(power_detectable(0.013, 4, 32, 1e-7), four);
    ck_assert(isnan(power_detectable(0.013, 0, 32, 1e-5)));
    ck_assert(isnan(power_detectable(0.013, 4, 1, 1e-5)));
    ck_assert(isnan(power_shift(0.95, 0, 31)) && isnan(power_shift(0.95, 0.96, 31)));
    ck_assert(isnan(power_shift(1, 0.05, 31)) && isnan(power_detectable(NAN, 4, 32, 1e-5)));
}
END_TEST

int main(void) {
    const TTest *const tests[] = {quantiles_are_those_of_the_table,
                                  power_is_that_of_the_table,
                                  without_a_change_the_power_is_the_alarm_rate,
                                  many_degrees_of_freedom_are_the_normal_limit,
                                  simulated_changes_are_seen_as_often_as_computed,
                                  what_is_called_detectable_is_seen_with_95_percent,
                                  more_seeds_see_less_and_nonsense_is_no_number,
                                  NULL};
    return unit_run("power", tests);
}
