/* test_observe_spheres_gas.c -- rates and pressures from counters of known value; the virial
 * theorem on one sphere that shuttles between walls. */
#include "tests/unit/spheres_fixture.h"

static const double R = 1.9e-3, M = 2.3e-6; /* m, kg: of the fixture */

static void frame(struct fake_run *f, double n, double energy, double virial, double elastic,
                  double t) {
    spheres_counter(f, "collisions", n, t);
    spheres_counter(f, "kinetic_energy", energy, t);
    spheres_counter(f, "collision_virial", virial, t);
    spheres_counter(f, "elastic_collisions", elastic, t);
}

static struct fake_run gas(void) {
    const double side[] = {41.3, 37.7, 53.9};
    struct fake_run f = spheres_start(431, R, side, "periodic", "");
    frame(&f, 17, 9e-6, 1e-6, 3, 0);
    frame(&f, 2017, 4.4e-6, 5e-6, 103, 0.37);
    frame(&f, 5017, 4.4e-6, 8.7e-6, 353, 1.13);
    frame(&f, 9999, 2.1e-6, 9.9e-6, 999, 1.7);
    return f;
}

static double measured(const char *recipe, const char *output) {
    struct fake_run f = gas();
    const struct recipe *r = recipe_find(recipe);
    double settings[RECIPE_MAX_SETTINGS] = {0};
    struct measurement m = {0};
    settings[fake_setting_index(r, "from_s")] = 0.37;
    settings[fake_setting_index(r, "to_s")] = 1.13;
    struct run_view *v = fake_open(&f);
    unit_ok(r->measure(v, settings, &m, &f.fault), &f.fault);
    run_view_close(v);
    unit_remove(f.folder);
    return fake_value(&m, recipe, output);
}

START_TEST(rate_counts_both_partners_in_the_window) {
    double t = 0.76, n = 431;
    ck_assert_double_eq_tol(measured("sphere-collisions", "rate"), 2 * 3000 / (n * t), 1e-12);
    ck_assert_double_eq_tol(measured("sphere-collisions", "collisions"), 6000 / n, 1e-12);
    ck_assert_double_eq_tol(measured("sphere-collisions", "elastic_share"), 250.0 / 3000, 1e-14);
    double temperature = 2 * 4.4e-6 / (3 * n);
    ck_assert_double_eq_tol(measured("sphere-collisions", "temperature"), temperature,
                            1e-12 * temperature);
    ck_assert_double_eq_tol(measured("sphere-collisions", "packing_fraction"),
                            n * 4 * M_PI / 3 / (41.3 * 37.7 * 53.9), 1e-14);
}
END_TEST

START_TEST(compressibility_is_one_plus_the_virial) {
    double temperature = 2 * 4.4e-6 / (3 * 431);
    ck_assert_double_eq_tol(measured("sphere-virial", "compressibility"),
                            1 + 3.7e-6 / (3 * 431 * temperature * 0.76), 1e-12);
}
END_TEST

/* A box not given is a cube of the packing fraction; of a base, its height follows. */
START_TEST(sides_that_are_not_given_follow_from_the_packing_fraction) {
    const double sides[][3] = {{0, 0, 0}, {21.7, 13.3, 0}};
    for (int n = 0; n < 2; n++) {
        struct fake_run f = spheres_start(431, R, sides[n], "periodic", "");
        struct measurement m;
        frame(&f, 0, 1e-6, 0, 0, 0);
        frame(&f, 9, 1e-6, 0, 0, 1);
        unit_ok(fake_measure(&f, "sphere-virial", NULL, 0, &m), &f.fault);
        ck_assert_double_eq_tol(fake_value(&m, "sphere-virial", "packing_fraction"), 0.3, 1e-14);
    }
}
END_TEST

/* Two spheres: one shuttles along x at 91 R/s between x = R and 40.3 R, first to the right:
 * 22.5 + 39.3 + 30 R in 91.8/91 s; the other rests. */
static void shuttle(double lost, double spin, struct measurement *m) {
    const double side[] = {41.3, 37.7, 53.9};
    double u = 91 * R, t = 91.8 / 91;
    double x[] = {17.8 * R, 9 * R, 11 * R, 20 * R, 30 * R, 40 * R}, v[] = {u, spin, 0, 0, 0, 0};
    double impulse[6] = {0};
    struct fake_run f = spheres_start(2, R, side, "hard", "");
    for (int n = 0; n < 2; n++) {
        frame(&f, 0, M * (u * u + spin * spin) / 2, 0, 0, n * t);
        spheres_vectors(&f, "position", 2, x, n * t);
        spheres_vectors(&f, "velocity", 2, v, n * t);
        spheres_list(&f, "wall_impulse", 6, impulse, n * t);
        x[0] = 31 * R;
        x[1] += spin * t;
        impulse[0] = impulse[1] = 2 * M * u * (1 - lost);
    }
    unit_ok(fake_measure(&f, "sphere-walls", NULL, 0, m), &f.fault);
}

START_TEST(the_virial_theorem_closes_on_a_sphere_between_walls) {
    struct measurement m;
    shuttle(0, 3.1 * R, &m);
    ck_assert_double_lt(fake_value(&m, "sphere-walls", "identity_error"), 1e-14);
    /* Two hits of the pair of walls, 39.3 R apart, against twice the energy times the time. */
    double twice = 91 * 91 + 3.1 * 3.1;
    ck_assert_double_eq_tol(fake_value(&m, "sphere-walls", "wall_compressibility"),
                            2 * 39.3 * 91 / (twice * 91.8 / 91), 1e-12);
    ck_assert_double_eq_tol(fake_value(&m, "sphere-walls", "virial_compressibility"), 1, 1e-12);
    shuttle(1e-3, 0, &m);
    ck_assert_double_gt(fake_value(&m, "sphere-walls", "identity_error"), 3e-4);
}
END_TEST

START_TEST(the_identity_is_refused_without_walls) {
    const double side[] = {41.3, 37.7, 53.9};
    struct fake_run f = spheres_start(1, R, side, "periodic", "");
    struct measurement m;
    double x[] = {R, R, R}, w[6] = {0};
    for (int n = 0; n < 2; n++) {
        frame(&f, 0, 1e-6, 0, 0, n);
        spheres_vectors(&f, "position", 1, x, n);
        spheres_vectors(&f, "velocity", 1, x, n);
        spheres_list(&f, "wall_impulse", 6, w, n);
    }
    ck_assert_int_eq(fake_measure(&f, "sphere-walls", NULL, 0, &m), STATUS_BAD_INPUT);
    unit_says(&f.fault, "needs six of them");
}
END_TEST

int main(void) {
    const TTest *const tests[] = {rate_counts_both_partners_in_the_window,
                                  compressibility_is_one_plus_the_virial,
                                  sides_that_are_not_given_follow_from_the_packing_fraction,
                                  the_virial_theorem_closes_on_a_sphere_between_walls,
                                  the_identity_is_refused_without_walls,
                                  NULL};
    return unit_run("observe_spheres_gas", tests);
}
