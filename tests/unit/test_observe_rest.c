/* test_observe_rest.c -- planted temperatures, velocities of known kurtosis, a random walk. */
#include "common/random.h"
#include "tests/unit/spheres_fixture.h"

#include <gsl/gsl_cdf.h>
#include <gsl/gsl_randist.h>

enum { N = 3600, BINS = 140, FRAMES = 21 };
static const double R = 6e-4, SIDE[] = {19, 18, 140}, STEP_S = 0.0125, WALK = 1.9e-4; /* m */
static const double T_J = 1.3 * 1.7e-9, SPEED = 0.031;                                /* m/s */

static gsl_rng *stream(const char *name) {
    struct fault fault = FAULT_NONE;
    gsl_rng *rng;
    unit_ok(random_stream(53, name, &rng, &fault), &fault);
    return rng;
}

/* Even over the height; u normal across, Laplace (excess kurtosis 3) upwards; x and y walk by WALK
 * a step in the middle of the box and twice as far elsewhere; bulk: 40 to 60 % of N V/(Wx Wy .37).
 */
static struct fake_run bed(void) {
    static double x[3 * N], u[3 * N], image[3 * N];
    gsl_rng *rng = stream("walk");
    struct fake_run f = spheres_start(N, R, SIDE, "sides", "");
    double height = N * 4 * M_PI / 3 / (19.0 * 18 * 0.37);
    for (int i = 0; i < 3 * N; i++) {
        x[i] = SIDE[i % 3] * R * gsl_rng_uniform(rng);
        image[i] = -3;
    }
    for (int n = 0; n < FRAMES; n++) {
        for (int i = 0; i < 3 * N; i++)
            u[i] = i % 3 < 2 ? gsl_ran_gaussian(rng, SPEED) : gsl_ran_laplace(rng, SPEED);
        spheres_vectors(&f, "position", N, x, n * STEP_S);
        spheres_vectors(&f, "velocity", N, u, n * STEP_S);
        spheres_vectors(&f, "image", N, image, n * STEP_S);
        for (int i = 0; i < 3 * N; i++) {
            double z = x[i - i % 3 + 2] / (R * height), wide = fabs(z - 0.5) < 0.1 ? 1 : 2;
            if (i % 3 == 2)
                continue;
            x[i] += gsl_ran_gaussian(rng, wide * WALK);
            double side = SIDE[i % 3] * R, turns = floor(x[i] / side);
            x[i] -= turns * side;
            image[i] += turns;
        }
    }
    gsl_rng_free(rng);
    return f;
}

/* Fourth moments of 600 Laplace numbers scatter by 1.5 and lie .3 low; 21 samples. */
START_TEST(velocities_are_told_apart_by_component) {
    struct fake_run f = bed();
    struct measurement m;
    const char *r = "bed-velocities";
    unit_ok(fake_measure(&f, r, NULL, 0, &m), &f.fault);
    double n = fake_value(&m, r, "spheres");
    ck_assert_double_eq_tol(n, N * 23.8 / 140, 80);
    ck_assert_double_eq_tol(fake_value(&m, r, "kurtosis_xy"), 0, 4 * sqrt(24 / (2 * n * FRAMES)));
    ck_assert_double_eq_tol(fake_value(&m, r, "kurtosis_z"), 3, 0.9);
    ck_assert_double_gt(fake_value(&m, r, "probability_xy"), 0.01);
    ck_assert_double_lt(fake_value(&m, r, "probability_z"), 0.01);
    ck_assert_double_lt(fake_value(&m, r, "distance_xy"), fake_value(&m, r, "distance_z"));
    ck_assert_uint_eq(m.curve_count, 2);
    for (int k = 0; k < 16; k++) { /* 25200 normal numbers, 12600 Laplace ones of scale 1/sqrt 2 */
        double x = m.curve[0].x[k], low = x - 0.125, high = x + 0.125;
        double normal = gsl_cdf_gaussian_P(high, 1) - gsl_cdf_gaussian_P(low, 1);
        double laplace = gsl_cdf_laplace_P(high, M_SQRT1_2) - gsl_cdf_laplace_P(low, M_SQRT1_2);
        double across = 5 / sqrt(2 * n * FRAMES * 2 * normal);
        ck_assert_double_eq_tol(m.curve[0].y[k], 1, fmax(across, 0.02));
        double upwards = laplace / normal, noise = 5 / sqrt(n * FRAMES * 2 * laplace);
        ck_assert_double_eq_tol(m.curve[1].y[k], upwards, fmax(noise, 0.1) * upwards);
    }
    measurement_free(&m);
}
END_TEST

/* 600 spheres of the bulk, 2 axes, lags up to .1 s of .25 s: 1 to 2 %. */
START_TEST(only_the_bulk_is_followed_across) {
    struct fake_run f = bed();
    struct measurement m;
    const char *r = "bed-diffusion";
    unit_ok(fake_measure(&f, r, NULL, 0, &m), &f.fault);
    double d = WALK * WALK / (2 * STEP_S);
    ck_assert_double_eq_tol(fake_value(&m, r, "diffusion"), d, 0.06 * d);
    ck_assert_double_eq_tol(fake_value(&m, r, "temperature"), 2.3e-6 * SPEED * SPEED,
                            0.03 * 2.3e-6 * SPEED * SPEED);
    double even = N * 4 * M_PI / 3 / (19.0 * 18 * 140);
    ck_assert_double_eq_tol(fake_value(&m, r, "packing_fraction"), even, 0.1 * even);
    ck_assert_uint_eq(m.curve_count, 1);
    ck_assert_double_eq(m.curve[0].y[0], 0);
    measurement_free(&m);
}
END_TEST

/* .8 T across and .85 T upwards below the edge, twice that above. */
static struct fake_run heat(void) {
    struct fake_run f = spheres_start(N, R, SIDE, "hard", "");
    gsl_rng *rng = stream("heat");
    static double v[3][BINS];
    size_t bins = BINS;
    for (int n = 0; n < FRAMES; n++) {
        for (int k = 0; k < BINS; k++) {
            double z = k + 0.5, scale = z < 118 ? 1 : 2;
            v[0][k] = 0.37 * gsl_cdf_gaussian_P(112 - z, 6) + gsl_ran_gaussian(rng, 1e-3);
            v[1][k] = 0.8 * scale * T_J;
            v[2][k] = 0.85 * scale * T_J;
        }
        static const char *const name[] = {"packing_fraction", "temperature_xy", "temperature_zz"};
        for (int i = 0; i < 3; i++) {
            char path[64];
            snprintf(path, sizeof path, "profiles/%s", name[i]);
            fake_append(&f, path, 1, &bins, v[i], n * STEP_S, 1.0 / SPHERES_STEP_PER_S);
        }
    }
    gsl_rng_free(rng);
    return f;
}

START_TEST(temperatures_of_bulk_and_spray) {
    struct fake_run f = heat();
    struct measurement m;
    const char *r = "bed-temperature";
    unit_ok(fake_measure(&f, r, NULL, 0, &m), &f.fault);
    ck_assert_double_eq_tol(fake_value(&m, r, "bulk_xy"), 0.8, 1e-9);
    ck_assert_double_eq_tol(fake_value(&m, r, "bulk_zz"), 0.85, 1e-9);
    ck_assert_double_eq_tol(fake_value(&m, r, "surface_zz"), 0.85, 0.01);
    ck_assert_double_eq_tol(fake_value(&m, r, "spray_xy"), 1.6, 0.02);
    ck_assert_double_gt(fake_value(&m, r, "surface_fraction"), 0.185);
    ck_assert_double_lt(fake_value(&m, r, "spray_fraction"), 0.05);
    ck_assert_uint_eq(m.curve_count, 2);
    ck_assert_double_eq_tol(m.curve[0].y[3], 0.8, 1e-9);
    measurement_free(&m);
}
END_TEST

int main(void) {
    const TTest *const tests[] = {velocities_are_told_apart_by_component,
                                  only_the_bulk_is_followed_across, temperatures_of_bulk_and_spray,
                                  NULL};
    return unit_run("observe_rest", tests);
}
