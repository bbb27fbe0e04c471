/* test_observe_spheres_single.c -- flights and one collision worked out by hand. */
#include "tests/unit/spheres_fixture.h"
#include "validation/sphere_laws.h"

static const double R = 6e-4, SIDE[] = {57, 43, 71};

static void frame(struct fake_run *f, const double *x, const double *u, const double *image,
                  double t) {
    spheres_vectors(f, "position", 2, x, t);
    spheres_vectors(f, "velocity", 2, u, t);
    spheres_vectors(f, "image", 2, image, t);
}

/* Two spheres under drag; the first crosses the edge of the box along x. */
static void decay(double fault, struct measurement *m) {
    double gamma = spheres_drag(4.9, 0.37, 4.65), t = 0.031, left = exp(-gamma * t);
    double x[] = {56 * R, 3 * R, 5 * R, 9 * R, 11 * R, 13 * R}, image[6] = {0};
    double u[] = {0.21, 0.013, -0.029, -0.017, 0.019, 0.023};
    struct fake_run f = spheres_start(2, R, SIDE, "periodic", "");
    frame(&f, x, u, image, 0);
    for (int i = 0; i < 6; i++) {
        x[i] += u[i] * (1 - left) / gamma * (1 + fault);
        u[i] *= left * (1 + 2 * fault);
    }
    x[0] -= SIDE[0] * R;
    image[0] = 1;
    frame(&f, x, u, image, t);
    unit_ok(fake_measure(&f, "sphere-decay", NULL, 0, m), &f.fault);
}

START_TEST(decay_and_range_are_exponential) {
    struct measurement m;
    decay(0, &m);
    ck_assert_double_lt(fake_value(&m, "sphere-decay", "decay_error"), 1e-15);
    ck_assert_double_lt(fake_value(&m, "sphere-decay", "range_error"), 1e-13);
    double gamma = spheres_drag(4.9, 0.37, 4.65), share = 1 - exp(-gamma * 0.031);
    ck_assert_double_eq_tol(fake_value(&m, "sphere-decay", "range_share"), share, 1e-12);
    decay(1e-6, &m);
    double left = exp(-gamma * 0.031);
    ck_assert_double_gt(fake_value(&m, "sphere-decay", "decay_error"), 1e-6 * left);
    ck_assert_double_gt(fake_value(&m, "sphere-decay", "range_error"), 5e-7 * (1 - left));
}
END_TEST

/* Sphere 1 rests; sphere 0 comes along x, off centre by 1.2 R: n = (-.8, .6, 0) from 1 to 0. */
static void pair(double eps, double twist, struct measurement *m) {
    double u = 0.037, t = 0.05, n[] = {-0.8, 0.6, 0};
    double x[] = {20 * R, 21.2 * R, 9 * R, 20 * R + 2.9 * R + 1.6 * R, 20 * R, 9 * R};
    double v[] = {u, 0, 0, 0, 0, 0}, image[6] = {0};
    double time = 2.9 * R / u, kick = (1 + eps) / 2 * 0.8 * u; /* g.n = -.8 u */
    struct fake_run f = spheres_start(2, R, SIDE, "periodic", "");
    frame(&f, x, v, image, 0);
    for (int a = 0; a < 3; a++) {
        x[a] += v[a] * time;
        v[a] += kick * n[a] + (a == 2 ? twist : 0);
        v[3 + a] -= kick * n[a];
        x[a] += v[a] * (t - time);
        x[3 + a] += v[3 + a] * (t - time);
    }
    frame(&f, x, v, image, t);
    unit_ok(fake_measure(&f, "sphere-pair", NULL, 0, m), &f.fault);
}

START_TEST(restitution_is_that_along_the_centres) {
    struct measurement m;
    pair(0.713, 0, &m);
    ck_assert_double_eq_tol(fake_value(&m, "sphere-pair", "restitution"), 0.713, 1e-13);
    ck_assert_double_lt(fake_value(&m, "sphere-pair", "tangential_error"), 1e-13);
    ck_assert_double_lt(fake_value(&m, "sphere-pair", "momentum_error"), 1e-15);
    ck_assert_double_lt(fake_value(&m, "sphere-pair", "place_error"), 1e-13);
    ck_assert_double_eq_tol(fake_value(&m, "sphere-pair", "contact_time"), 2.9 * R / 0.037, 1e-14);
    pair(0.713, 3.7e-8, &m);
    ck_assert_double_eq_tol(fake_value(&m, "sphere-pair", "tangential_error"), 1e-6, 1e-9);
    ck_assert_double_eq_tol(fake_value(&m, "sphere-pair", "momentum_error"), 1e-6, 1e-9);
}
END_TEST

START_TEST(a_pair_that_misses_is_no_number) {
    double x[] = {20 * R, 23 * R, 9 * R, 25 * R, 20 * R, 9 * R}, v[] = {0.1, 0, 0, 0, 0, 0};
    double image[6] = {0};
    struct measurement m;
    struct fake_run f = spheres_start(2, R, SIDE, "periodic", "");
    frame(&f, x, v, image, 0);
    frame(&f, x, v, image, 0.1);
    unit_ok(fake_measure(&f, "sphere-pair", NULL, 0, &m), &f.fault);
    ck_assert(isnan(fake_value(&m, "sphere-pair", "restitution")));
    ck_assert_ptr_nonnull(strstr(m.reason, "does not meet"));
}
END_TEST

int main(void) {
    const TTest *const tests[] = {decay_and_range_are_exponential,
                                  restitution_is_that_along_the_centres,
                                  a_pair_that_misses_is_no_number, NULL};
    return unit_run("observe_spheres_single", tests);
}
