/* test_observe_spheres_velocity.c -- distributions drawn on purpose: normal, flat, uneven. */
#include "common/random.h"
#include "tests/unit/spheres_fixture.h"

#include <gsl/gsl_randist.h>

enum { N = 3000 };
static const double SIDE[] = {81, 83, 87};

/* width: normal; flat > 0: uniform instead; x_factor: on the x components. */
static void measure(bool flat, double x_factor, struct measurement *m) {
    static double u[3 * N];
    struct fault fault = FAULT_NONE;
    gsl_rng *rng;
    unit_ok(random_stream(4711, "velocities", &rng, &fault), &fault);
    struct fake_run f = spheres_start(N, 6e-4, SIDE, "periodic", "");
    for (int frame = 0; frame < 2; frame++) {
        for (int i = 0; i < 3 * N; i++) {
            double c = flat ? 0.037 * sqrt(12) * (gsl_rng_uniform(rng) - 0.5)
                            : gsl_ran_gaussian(rng, 0.037);
            u[i] = 1.3 + c * (i % 3 ? 1 : x_factor); /* a mean is no temperature */
        }
        spheres_vectors(&f, "velocity", N, u, frame);
    }
    gsl_rng_free(rng);
    unit_ok(fake_measure(&f, "sphere-velocities", NULL, 0, m), &f.fault);
}

static double value(const struct measurement *m, const char *output) {
    return fake_value(m, "sphere-velocities", output);
}

START_TEST(normal_velocities_pass_and_flat_ones_do_not) {
    struct measurement m;
    measure(false, 1, &m);
    ck_assert_double_gt(value(&m, "probability"), 0.05);
    ck_assert_double_eq_tol(value(&m, "kurtosis"), 0, 0.1); /* sqrt(24/18000) = .037 */
    ck_assert_double_eq_tol(value(&m, "variance"), 0.037 * 0.037, 0.03 * 0.037 * 0.037);
    ck_assert_double_lt(value(&m, "anisotropy"), 0.1);
    ck_assert_double_eq(value(&m, "samples"), 2);
    measure(true, 1, &m);
    ck_assert_double_lt(value(&m, "probability"), 1e-4);
    ck_assert_double_eq_tol(value(&m, "kurtosis"), -1.2, 0.05);
}
END_TEST

START_TEST(one_hot_axis_shows) {
    struct measurement m;
    measure(false, 1.5, &m);
    double mean = (2.25 + 2) / 3;
    ck_assert_double_eq_tol(value(&m, "anisotropy"), 2.25 / mean - 1, 0.08);
    ck_assert_double_gt(value(&m, "kurtosis"), 0.1);
}
END_TEST

/* D of three components by hand: -a, 0, a with the variance 2a^2/3. */
START_TEST(the_statistic_is_the_largest_gap) {
    double u[] = {-0.3, 0.1, 0, 0.3, -0.1, 0}; /* means 0; components -.3 -.1 0 0 .1 .3 */
    struct fake_run f = spheres_start(2, 6e-4, SIDE, "periodic", "");
    struct measurement m;
    spheres_vectors(&f, "velocity", 2, u, 0);
    unit_ok(fake_measure(&f, "sphere-velocities", NULL, 0, &m), &f.fault);
    double width = sqrt(0.2 / 6), p1 = 0.5 * erfc(0.1 / width / M_SQRT2);
    double gap = fmax(0.5 - 2.0 / 6, p1 - 1.0 / 6); /* at the zeros, at -.1 */
    ck_assert_double_eq_tol(value(&m, "statistic"), gap, 1e-12);
    ck_assert_double_gt(value(&m, "probability"), 0.9);
}
END_TEST

START_TEST(drifts_are_of_the_first_energy_and_its_speed) {
    struct fake_run f = spheres_start(431, 6e-4, SIDE, "periodic", "");
    struct measurement m;
    const double e[] = {3.1e-6, 3.1e-6 * (1 + 2e-9), 3.1e-6 * (1 - 1e-9)};
    for (int n = 0; n < 3; n++) {
        double p[] = {1e-7, -2e-7 + 4e-14 * n, 3e-7};
        spheres_counter(&f, "kinetic_energy", e[n], n);
        spheres_list(&f, "momentum", 3, p, n);
        spheres_counter(&f, "collisions", 431 * 5 * n, n);
    }
    unit_ok(fake_measure(&f, "sphere-conservation", NULL, 0, &m), &f.fault);
    double unit = 431 * 2.3e-6 * sqrt(2 * 3.1e-6 / (3 * 431 * 2.3e-6));
    ck_assert_double_eq_tol(fake_value(&m, "sphere-conservation", "energy_drift"), 2e-9, 1e-14);
    ck_assert_double_eq_tol(fake_value(&m, "sphere-conservation", "momentum_drift"), 8e-14 / unit,
                            1e-3 * 8e-14 / unit);
    ck_assert_double_eq_tol(fake_value(&m, "sphere-conservation", "collisions"), 20, 1e-12);
}
END_TEST

int main(void) {
    const TTest *const tests[] = {normal_velocities_pass_and_flat_ones_do_not, one_hot_axis_shows,
                                  the_statistic_is_the_largest_gap,
                                  drifts_are_of_the_first_energy_and_its_speed, NULL};
    return unit_run("observe_spheres_velocity", tests);
}
