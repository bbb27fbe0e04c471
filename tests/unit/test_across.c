/* test_across.c -- validation/across.h on points of known slope. */
#include "tests/unit/unit.h"
#include "validation/across.h"

#include <math.h>

static enum status fit(const char *name, const struct across_point *p, size_t count, double *value,
                       double *uncertainty) {
    struct fault fault = FAULT_NONE;
    const struct across *a = across_find(name);
    ck_assert_ptr_nonnull(a);
    ck_assert_uint_ge(count, a->min_points);
    return a->fit(p, count, value, uncertainty, &fault);
}

START_TEST(an_order_is_found_and_its_sign_told_apart) {
    struct across_point p[4];
    double value[2], u[2];
    for (int i = 0; i < 4; i++) {
        p[i].x = 8 * pow(2, i);
        p[i].y = 0.0137 * pow(p[i].x, -1.93);
        p[i].uncertainty = 0;
    }
    ck_assert_int_eq(fit("order", p, 4, value, u), STATUS_OK);
    ck_assert_double_eq_tol(value[0], -1.93, 1e-12);
    ck_assert_int_eq(fit("order-of-refinement", p, 4, value, u), STATUS_OK);
    ck_assert_double_eq_tol(value[0], 1.93, 1e-12);
    ck_assert_double_lt(u[0], 1e-12);
    p[2].y *= 1.1; /* a planted fault: the order moves and its uncertainty says so */
    ck_assert_int_eq(fit("order-of-refinement", p, 4, value, u), STATUS_OK);
    ck_assert_double_gt(fabs(value[0] - 1.93), 0.01);
    ck_assert_double_gt(u[0], 0.02);
    p[2].y = 0; /* no logarithm */
    ck_assert_int_eq(fit("order", p, 4, value, u), STATUS_BAD_INPUT);
}
END_TEST

START_TEST(uncertain_points_weigh_by_their_uncertainty) {
    const struct across_point p[] = {{1, 3.1, 0.1}, {2, 5.0, 0.1}, {4, 9.0, 0.1}, {5, 99, 1e6}};
    double value[2], u[2];
    ck_assert_int_eq(fit("extrapolate-linear", p, 4, value, u), STATUS_OK);
    /* Least squares of the first three by hand: slope 27.5/14, value at 0 through the means. */
    double x[] = {1, 2, 4}, y[] = {3.1, 5, 9}, mx = 7.0 / 3, my = 17.1 / 3, sxy = 0, sxx = 0;
    for (int i = 0; i < 3; i++) {
        sxy += (x[i] - mx) * (y[i] - my);
        sxx += (x[i] - mx) * (x[i] - mx);
    }
    ck_assert_double_eq_tol(value[1], sxy / sxx, 1e-6);
    ck_assert_double_eq_tol(value[0], my - mx * sxy / sxx, 1e-6);
    ck_assert_double_eq_tol(u[1], 0.1 / sqrt(sxx), 1e-6);
    ck_assert_double_eq_tol(u[0], 0.1 * sqrt(1.0 / 3 + mx * mx / sxx), 1e-6);
}
END_TEST

START_TEST(two_points_without_scatter_are_exact_only_when_said_so) {
    struct across_point p[] = {{0.5, 1.2, 0}, {1.5, 0.7, 0}};
    double value[2], u[2];
    ck_assert_int_eq(fit("zero", p, 2, value, u), STATUS_OK);
    ck_assert_double_eq_tol(value[0], 2.9, 1e-14);
    ck_assert_double_eq(u[0], 0);
    p[0].uncertainty = NAN;
    ck_assert_int_eq(fit("zero", p, 2, value, u), STATUS_OK);
    ck_assert(isnan(u[0]));
}
END_TEST

START_TEST(a_zero_carries_the_uncertainty_of_the_line) {
    const struct across_point p[] = {{1, -1, 0.02}, {3, 1, 0.02}};
    double value[2], u[2];
    ck_assert_int_eq(fit("zero", p, 2, value, u), STATUS_OK);
    ck_assert_double_eq_tol(value[0], 2, 1e-14);
    ck_assert_double_eq_tol(u[0], 0.02 / sqrt(2), 1e-10); /* half-way between two equal points */
    const struct across_point level[] = {{1, 1, 0}, {3, 1, 0}};
    ck_assert_int_eq(fit("zero", level, 2, value, u), STATUS_BAD_INPUT);
}
END_TEST

START_TEST(ends_compare_the_smallest_with_the_largest) {
    const struct across_point p[] = {{0.1, 1.03, 0.03}, {0.15, 7, 1}, {0.2, 1.01, 0.04}};
    double value[2], u[2];
    ck_assert_int_eq(fit("ends", p, 3, value, u), STATUS_OK);
    ck_assert_double_eq_tol(value[0], 1.03 / 1.01, 1e-14);
    ck_assert_double_eq_tol(value[1], 0.02, 1e-14);
    ck_assert_double_eq_tol(u[1], 0.05, 1e-14);
    ck_assert_double_eq_tol(u[0], hypot(0.03, 0.04 * value[0]) / 1.01, 1e-14);
}
END_TEST

START_TEST(a_spread_is_of_the_largest_and_the_smallest_wherever_they_are) {
    const struct across_point p[] = {{0.3, 7.18, 0.09}, {0.35, 6.83, 0.07}, {0.4, 7.21, 0.11}};
    double value[3], u[3], ratio = 7.21 / 6.83;
    ck_assert_int_eq(fit("spread", p, 3, value, u), STATUS_OK);
    ck_assert_double_eq_tol(value[0], ratio, 1e-14);
    ck_assert_double_eq_tol(u[0], hypot(0.11, 0.07 * ratio) / 6.83, 1e-14);
    ck_assert_double_eq_tol(value[1], 7.0733333333333333, 1e-12);
    ck_assert_double_eq_tol(u[1], sqrt(0.0251) / 3, 1e-12);
    ck_assert_double_eq_tol(value[2], ratio - 1, 1e-14);
    ck_assert_double_eq(u[2], u[0]);
    const struct across_point none[] = {{0.3, 7.18, 0.09}, {0.4, 0, 0.1}};
    ck_assert_int_eq(fit("spread", none, 2, value, u), STATUS_BAD_INPUT);
}
END_TEST

/* y = 3.1 - 1.7 x at x = .3, .4, .5, .6 with equal uncertainties: slope u/sqrt(sum (x - .45)^2). */
START_TEST(a_slope_is_weighted_and_widened_by_scatter) {
    const struct across *fit = across_find("slope");
    double u = 0.02, spread = sqrt(2 * (0.15 * 0.15 + 0.05 * 0.05)), value[4], error[4];
    struct across_point p[4];
    struct fault fault = FAULT_NONE;
    ck_assert_ptr_nonnull(fit);
    for (size_t i = 0; i < 4; i++) {
        double x = 0.3 + 0.1 * (double)i;
        p[i] = (struct across_point){x, 3.1 - 1.7 * x, u};
    }
    unit_ok(fit->fit(p, 4, value, error, &fault), &fault);
    double middle = 3.1 - 1.7 * 0.45;
    ck_assert_double_eq_tol(value[0], -1.7, 1e-10);
    ck_assert_double_eq_tol(error[0], u / spread, 1e-10);
    ck_assert_double_eq_tol(value[1], -1.7 / middle, 1e-10);
    ck_assert_double_eq_tol(error[1], hypot(u / spread, 1.7 / middle * u / 2) / middle, 1e-10);
    /* Off by +-.1 in a way that no line follows: chi^2 = 4 (.1/.02)^2 = 100 for 2 degrees. */
    for (size_t i = 0; i < 4; i++)
        p[i].y += i == 0 || i == 3 ? 0.1 : -0.1;
    unit_ok(fit->fit(p, 4, value, error, &fault), &fault);
    ck_assert_double_eq_tol(value[0], -1.7, 1e-10);
    ck_assert_double_eq_tol(error[0], sqrt(50) * u / spread, 1e-10);
}
END_TEST

int main(void) {
    const TTest *const tests[] = {an_order_is_found_and_its_sign_told_apart,
                                  uncertain_points_weigh_by_their_uncertainty,
                                  two_points_without_scatter_are_exact_only_when_said_so,
                                  a_zero_carries_the_uncertainty_of_the_line,
                                  ends_compare_the_smallest_with_the_largest,
                                  a_spread_is_of_the_largest_and_the_smallest_wherever_they_are,
                                  a_slope_is_weighted_and_widened_by_scatter,
                                  NULL};
    return unit_run("across", tests);
}
