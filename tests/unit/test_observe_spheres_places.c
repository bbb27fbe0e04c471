/* test_observe_spheres_places.c -- planted overlaps, layers, images and rescaled copies. */
#include "tests/unit/spheres_fixture.h"

static const double R = 6e-4, SIDE[] = {57, 43, 71};

START_TEST(the_deepest_overlap_of_any_sample_is_found) {
    struct fake_run f = spheres_start(3, R, SIDE, "hard", "");
    struct measurement m;
    double x[] = {9 * R, 9 * R, 9 * R, 11 * R, 9 * R, 9 * R, 31 * R, 9 * R, R};
    for (int n = 0; n < 3; n++) {
        x[3] = (n == 1 ? 10.94 : 11.1) * R;
        x[8] = (n == 2 ? 0.98 : 1) * R;
        spheres_vectors(&f, "position", 3, x, n);
        spheres_counter(&f, "largest_overlap", 1e-15 * n, n);
    }
    unit_ok(fake_measure(&f, "sphere-overlap", NULL, 0, &m), &f.fault);
    ck_assert_double_eq_tol(fake_value(&m, "sphere-overlap", "overlap"), 0.03, 1e-12);
    ck_assert_double_eq_tol(fake_value(&m, "sphere-overlap", "reported"), 2e-15, 1e-30);
    ck_assert_double_eq(fake_value(&m, "sphere-overlap", "samples"), 3);
}
END_TEST

/* 60 spheres on the floor (two at .7 R above its first layer), 140 evenly above. */
START_TEST(layers_are_told_from_an_even_filling) {
    enum { N = 200 };
    double x[3 * N];
    struct fake_run f = spheres_start(N, R, SIDE, "hard", "");
    struct measurement m;
    for (int i = 0; i < N; i++) {
        x[3 * i] = x[3 * i + 1] = 20 * R;
        x[3 * i + 2] = i < 58 ? 1.1 * R : i < 60 ? 1.7 * R : (6 + 64 * (i - 60) / 140.0) * R;
    }
    for (int n = 0; n < 3; n++) {
        spheres_vectors(&f, "position", N, x, n);
        spheres_counter(&f, "q6", 0.03 + 0.01 * n, n);
    }
    unit_ok(fake_measure(&f, "sphere-order", "from_s", 1, &m), &f.fault);
    ck_assert_double_eq_tol(fake_value(&m, "sphere-order", "q6"), 0.045, 1e-14);
    ck_assert_double_eq_tol(fake_value(&m, "sphere-order", "floor"), 58 * 71 / (200 * 0.5), 1e-10);
    ck_assert_double_lt(fake_value(&m, "sphere-order", "ceiling"), 2);
}
END_TEST

static enum status mirror(double shift, double start, struct measurement *m, struct fake_run *f) {
    double x[] = {9 * R, 3 * R, 5 * R, (57 - 9) * R, 3 * R, 5 * R};
    *f = spheres_start(2, R, SIDE, "hard", "");
    for (int n = 0; n < 3; n++) {
        x[0] = 9 * R + n * 0.37 * R;
        x[3] = (57 - 9) * R - n * 0.37 * R + (n ? 0 : start);
        x[5] = 5 * R + (n == 2 ? shift : 0);
        spheres_vectors(f, "position", 2, x, n);
        spheres_counter(f, "collisions", 3 * n, n);
    }
    return fake_measure(f, "sphere-mirror", NULL, 0, m);
}

START_TEST(asymmetry_is_the_worst_pairs) {
    struct measurement m;
    struct fake_run f;
    unit_ok(mirror(0.013 * R, 0, &m, &f), &f.fault);
    ck_assert_double_eq_tol(fake_value(&m, "sphere-mirror", "asymmetry"), 0.0065, 1e-12);
    ck_assert_double_eq_tol(fake_value(&m, "sphere-mirror", "collisions"), 6, 1e-14);
    ck_assert_int_eq(mirror(0, 0.01 * R, &m, &f), STATUS_BAD_INPUT);
    unit_says(&f.fault, "not its own mirror image");
}
END_TEST

/* The same state in units of length and time of another size; then with one speed changed. */
static void fingerprint(double length, double slip, double *places, double *velocities) {
    double x[] = {9.1, 3.3, 5.7, 31.9, 21.3, 63.1}, u[] = {1.3, -0.7, 0.4, -0.9, 1.1, -1.7};
    double speed = sqrt(1.7e-9 / 2.3e-6), r = R * length, t = 3.1 * r / speed;
    struct fake_run f = spheres_start(2, r, SIDE, "hard", "");
    struct measurement m;
    for (int i = 0; i < 6; i++) {
        x[i] *= r;
        u[i] *= speed;
    }
    u[4] += slip * speed;
    spheres_vectors(&f, "position", 2, x, t);
    spheres_vectors(&f, "velocity", 2, u, t);
    spheres_counter(&f, "collisions", 17, t);
    unit_ok(fake_measure(&f, "sphere-fingerprint", "at", 3.1, &m), &f.fault);
    *places = fake_value(&m, "sphere-fingerprint", "places");
    *velocities = fake_value(&m, "sphere-fingerprint", "velocities");
}

START_TEST(fingerprints_know_no_units) {
    double p[3], v[3];
    fingerprint(1, 0, &p[0], &v[0]);
    fingerprint(4, 0, &p[1], &v[1]);
    fingerprint(1, 1e-9, &p[2], &v[2]);
    ck_assert_double_eq(p[0], p[1]);
    ck_assert_double_eq(v[0], v[1]);
    ck_assert_double_eq(p[0], p[2]);
    ck_assert_double_eq_tol(v[2] - v[0], 1e-9 * (1 + 4.0 / 1024), 1e-14);
}
END_TEST

int main(void) {
    const TTest *const tests[] = {the_deepest_overlap_of_any_sample_is_found,
                                  layers_are_told_from_an_even_filling,
                                  asymmetry_is_the_worst_pairs, fingerprints_know_no_units, NULL};
    return unit_run("observe_spheres_places", tests);
}
