/* test_observe_spheres_wave.c -- a planted wave that grows and travels round the box. */
#include "tests/unit/spheres_fixture.h"

enum { N = 20000 };
static const double R = 6e-4, SIDE[] = {57, 43, 71};

/* Places with the density 1 + a cos(k z - theta), two wavelengths, by inverting the sum. */
static void places(double a, double theta, double *x) {
    double l = SIDE[2] * R, k = 4 * M_PI / l;
    for (int i = 0; i < N; i++) {
        double goal = (i + 0.5) / N * l, z = goal;
        for (int it = 0; it < 60; it++)
            z -= (z + a / k * (sin(k * z - theta) + sin(theta)) - goal) /
                 (1 + a * cos(k * z - theta));
        x[3 * i] = x[3 * i + 1] = R;
        x[3 * i + 2] = z;
    }
}

START_TEST(growth_and_speed_of_a_planted_wave_are_found) {
    static double x[3 * N];
    double l = SIDE[2] * R, k = 4 * M_PI / l, speed = 0.0713, sigma = 1.93;
    struct fake_run f = spheres_start(N, R, SIDE, "periodic", "");
    struct measurement m;
    for (int n = 0; n < 15; n++) { /* the phase turns by 5 radians in all */
        double t = 0.02 * n;
        places(0.11 * exp(sigma * t), 0.3 + k * speed * t, x);
        spheres_vectors(&f, "position", N, x, t);
        spheres_counter(&f, "temperature_xy", 1.9e-9 * (1 + t), t);
    }
    unit_ok(fake_measure(&f, "sphere-wave", "mode", 2, &m), &f.fault);
    ck_assert_double_eq_tol(fake_value(&m, "sphere-wave", "growth"), sigma, 1e-3);
    ck_assert_double_eq_tol(fake_value(&m, "sphere-wave", "speed"), speed, 1e-5);
    ck_assert_double_eq_tol(fake_value(&m, "sphere-wave", "wavelength"), l / 2, 1e-15);
    ck_assert_double_eq_tol(fake_value(&m, "sphere-wave", "first_amplitude"), 0.11, 1e-5);
    ck_assert_double_eq_tol(fake_value(&m, "sphere-wave", "last_amplitude"),
                            0.11 * exp(sigma * 0.28), 1e-4);
    ck_assert_double_lt(fake_value(&m, "sphere-wave", "misfit"), 1e-3);
    ck_assert_double_eq_tol(fake_value(&m, "sphere-wave", "temperature"), 1.9e-9 * 1.14, 1e-20);
    measurement_free(&m);
}
END_TEST

START_TEST(slab_speed_is_momentum_over_mass) {
    struct fake_run f = spheres_start(431, R, SIDE, "periodic", "");
    struct measurement m;
    double mass = 431 * 2.3e-6, v = 0.0317, t0 = 2.1e-9;
    for (int n = 0; n < 4; n++) {
        double p[] = {1e-6, 2e-6, mass * v * n};
        spheres_list(&f, "momentum", 3, p, 0.03 * n);
        spheres_counter(&f, "kinetic_energy", 1.5 * 431 * t0 + mass * v * v * n * n / 2, 0.03 * n);
    }
    unit_ok(fake_measure(&f, "sphere-slab", "at_s", 0.06, &m), &f.fault);
    ck_assert_double_eq_tol(fake_value(&m, "sphere-slab", "speed"), 2 * v, 1e-14);
    ck_assert_double_eq_tol(fake_value(&m, "sphere-slab", "time"), 0.06, 1e-14);
    ck_assert_double_eq_tol(fake_value(&m, "sphere-slab", "temperature"), t0, 1e-10 * t0);
}
END_TEST

int main(void) {
    const TTest *const tests[] = {growth_and_speed_of_a_planted_wave_are_found,
                                  slab_speed_is_momentum_over_mass, NULL};
    return unit_run("observe_spheres_wave", tests);
}
