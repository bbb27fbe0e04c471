/* test_observe_spheres_motion.c -- random walks of known step, folded into the box. */
#include "common/random.h"
#include "tests/unit/spheres_fixture.h"
#include "validation/sphere_laws.h"

#include <gsl/gsl_randist.h>

enum { N = 1500, FRAMES = 41 };
static const double R = 6e-4, SIDE[] = {31, 31, 31}, STEP_S = 0.0125, WIDTH = 2.3e-3; /* m */

static struct fake_run walk(void) {
    static double x[3 * N], image[3 * N];
    struct fault fault = FAULT_NONE;
    gsl_rng *rng;
    unit_ok(random_stream(29, "walk", &rng, &fault), &fault);
    struct fake_run f = spheres_start(N, R, SIDE, "periodic", "");
    for (int i = 0; i < 3 * N; i++) {
        x[i] = 31 * R * gsl_rng_uniform(rng);
        image[i] = 7;
    }
    for (int n = 0; n < FRAMES; n++) {
        spheres_vectors(&f, "position", N, x, n * STEP_S);
        spheres_vectors(&f, "image", N, image, n * STEP_S);
        spheres_counter(&f, "kinetic_energy", 1.5 * N * 1.9e-9, n * STEP_S);
        for (int i = 0; i < 3 * N; i++) {
            x[i] += gsl_ran_gaussian(rng, WIDTH);
            double turns = floor(x[i] / (31 * R));
            x[i] -= turns * 31 * R;
            image[i] += turns;
        }
    }
    gsl_rng_free(rng);
    return f;
}

/* A walk of variance w^2 a step has D = w^2/(2 step); 1500 spheres, 3 axes, 40 steps: 1 %. */
START_TEST(diffusion_is_half_the_variance_a_time) {
    struct fake_run f = walk();
    struct measurement m;
    double d = WIDTH * WIDTH / (2 * STEP_S);
    unit_ok(fake_measure(&f, "sphere-diffusion", "lag_to_s", 0.25, &m), &f.fault);
    ck_assert_double_eq_tol(fake_value(&m, "sphere-diffusion", "diffusion"), d, 0.03 * d);
    ck_assert_double_eq_tol(fake_value(&m, "sphere-diffusion", "temperature"), 1.9e-9, 1e-20);
    struct spheres_gas g = {fake_value(&m, "sphere-diffusion", "packing_fraction"), 1.9e-9, R,
                            2.3e-6};
    double more = fake_value(&m, "sphere-diffusion", "unbounded") -
                  fake_value(&m, "sphere-diffusion", "diffusion");
    ck_assert_double_eq_tol(more, spheres_box_correction(&g, 31 * R), 1e-12 * d);
    ck_assert_uint_eq(m.curve_count, 1);
    measurement_free(&m);
}
END_TEST

START_TEST(displacement_of_a_lag_is_that_of_its_steps) {
    struct fake_run f = walk();
    struct measurement m;
    unit_ok(fake_measure(&f, "sphere-displacement", "lag_s", 0.05, &m), &f.fault);
    ck_assert_double_eq_tol(fake_value(&m, "sphere-displacement", "square"), 4 * WIDTH * WIDTH,
                            0.04 * WIDTH * WIDTH);
    ck_assert_double_eq(fake_value(&m, "sphere-displacement", "pairs"), FRAMES - 4);
    f = walk();
    ck_assert_int_eq(fake_measure(&f, "sphere-displacement", "lag_s", 0.053, &m), STATUS_BAD_INPUT);
    unit_says(&f.fault, "0.053 s apart");
}
END_TEST

int main(void) {
    const TTest *const tests[] = {diffusion_is_half_the_variance_a_time,
                                  displacement_of_a_lag_is_that_of_its_steps, NULL};
    return unit_run("observe_spheres_motion", tests);
}
