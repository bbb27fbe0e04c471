/* test_observe_grains.c -- flight, energy, mirror and collisions on motions made by hand. */
#include "tests/unit/fake_run.h"

static const double DT = 0.0125;

static void write_frame(struct fake_run *f, size_t n, const double *x, const double *v, double t) {
    fake_vectors(f, "particles/grains/position", n, x, t, DT);
    fake_vectors(f, "particles/grains/velocity", n, v, t, DT);
}

START_TEST(acceleration_is_the_change_over_the_last_step) {
    struct fake_run f = fake_start("  width_l: 5\n  height_l: 7\n");
    double x[] = {1.3, 2.7, 3.1, 4.9}, y[] = {1.3, 2.71, 3.1, 4.92};
    double held[] = {0, -0.1, 0, -0.1}, moved[] = {1e-9, -0.1 + 0.3 * DT, 0, -0.1 + 0.31 * DT};
    struct measurement m;
    fake_array(&f, "particles/grains/radius", (double[]){0.2, 0.25}, 2);
    write_frame(&f, 2, x, held, 0);
    write_frame(&f, 2, x, held, 1);
    write_frame(&f, 2, y, moved, 1 + DT);
    unit_ok(fake_measure(&f, "acceleration", NULL, 0, &m), &f.fault);
    ck_assert_double_eq_tol(fake_value(&m, "acceleration", "acceleration"), 0.305, 1e-12);
    ck_assert_double_eq_tol(fake_value(&m, "acceleration", "spread"), 0.01, 1e-12);
    ck_assert_double_eq_tol(fake_value(&m, "acceleration", "sideways"), 8e-8, 1e-12);
    ck_assert_double_eq_tol(fake_value(&m, "acceleration", "speed"), 0.1, 1e-15);
}
END_TEST

START_TEST(acceleration_refuses_grains_that_were_not_held) {
    struct fake_run f = fake_start("  width_l: 5\n  height_l: 7\n");
    double x[] = {1.3, 2.7}, y[] = {1.3, 2.71}, v[] = {0, 0};
    struct measurement m;
    fake_array(&f, "particles/grains/radius", (double[]){0.2}, 1);
    write_frame(&f, 1, x, v, 0);
    write_frame(&f, 1, y, v, 1);
    write_frame(&f, 1, y, v, 1 + DT);
    ck_assert_int_eq(fake_measure(&f, "acceleration", NULL, 0, &m), STATUS_BAD_INPUT);
    unit_says(&f.fault, "moves before it is let go");
}
END_TEST

static void measure_fall(double gravity_felt, struct measurement *m) {
    struct fake_run f = fake_start("  width_l: 5\n  height_l: 70\n  froude: 1.7\n");
    fake_array(&f, "particles/grains/radius", (double[]){0.2}, 1);
    for (int k = 0; k < 3; k++) {
        double t = 1.25 * k, g = gravity_felt / 1.7;
        double x[] = {1.3 + 0.31 * t, 60.7 - 0.11 * t - g * t * t / 2}, v[] = {0.31, -0.11 - g * t};
        write_frame(&f, 1, x, v, t);
    }
    unit_ok(fake_measure(&f, "free-fall", NULL, 0, m), &f.fault);
}

START_TEST(a_parabola_is_free_fall_and_a_steeper_one_is_not) {
    struct measurement m;
    measure_fall(1, &m);
    ck_assert_double_lt(fake_value(&m, "free-fall", "position_error"), 2e-14);
    measure_fall(1.0001, &m);
    ck_assert_double_eq_tol(fake_value(&m, "free-fall", "position_error"),
                            1e-4 / 1.7 * 2.5 * 2.5 / 2, 1e-9);
    ck_assert_double_eq_tol(fake_value(&m, "free-fall", "velocity_error"), 1e-4 / 1.7 * 2.5, 1e-9);
}
END_TEST

static void measure_energy(double lost, struct measurement *m) {
    struct fake_run f = fake_start("  width_l: 5\n  height_l: 7\n  froude: 1.7\n");
    fake_array(&f, "particles/grains/radius", (double[]){0.2, 0.3}, 2);
    /* Unequal grains exchange speed 1 and height for speed. */
    double x[] = {1, 3, 2, 4}, v[] = {0.4, 0, 0, 0.3};
    write_frame(&f, 2, x, v, 0);
    double w = sqrt(0.16 + 2 * 0.5 / 1.7) * (1 - lost); /* the first falls by .5 l */
    write_frame(&f, 2, (double[]){1, 2.5, 2, 4}, (double[]){0, -w, 0.3, 0}, 2);
    fake_scalar(&f, "observables/collisions", 3, 0, DT);
    fake_scalar(&f, "observables/collisions", 9, 2, DT);
    unit_ok(fake_measure(&f, "energy", NULL, 0, m), &f.fault);
}

START_TEST(energy_counts_masses_and_heights) {
    struct measurement m;
    measure_energy(0, &m);
    ck_assert_double_lt(fake_value(&m, "energy", "drift"), 1e-15);
    ck_assert_double_eq(fake_value(&m, "energy", "collisions"), 4.5);
    measure_energy(1e-6, &m);
    ck_assert_double_gt(fake_value(&m, "energy", "drift"), 1e-8);
}
END_TEST

START_TEST(a_mirror_image_lasts_to_its_horizon) {
    struct fake_run f = fake_start("  width_l: 5\n  height_l: 7\n");
    double id[] = {2, 0, 3, 1}, off[] = {0, 0, 1e-7, 1e-3}; /* rows are not in the order of ids */
    struct measurement m;
    fake_array(&f, "particles/grains/radius", (double[]){0.2, 0.2, 0.3, 0.3}, 4);
    fake_array(&f, "particles/grains/id", id, 4);
    for (int k = 0; k < 4; k++) {
        double x0 = 1.3 + 0.1 * k, x1 = 2.1 - 0.05 * k;
        double x[] = {5 - x0, 3.3, x0, 3.3, 5 - x1 + off[k], 4.4, x1, 4.4};
        fake_vectors(&f, "particles/grains/position", 4, x, 0.5 * k, DT);
        fake_scalar(&f, "observables/collisions", 2 * k, 0.5 * k, DT);
    }
    unit_ok(fake_measure(&f, "mirror", NULL, 0, &m), &f.fault);
    ck_assert_double_eq_tol(fake_value(&m, "mirror", "asymmetry"), 1e-7, 1e-12);
    ck_assert_double_eq(fake_value(&m, "mirror", "horizon"), 0.5);
    ck_assert_double_eq(fake_value(&m, "mirror", "collisions"), 1);
}
END_TEST

/* Grain 1 hits grain 0 along the centres with restitution r; `twist` turns the impulse. */
static void measure_pair(double r, double twist, double gain, struct measurement *m) {
    double m0 = 0.25 * 0.25, m1 = 0.13 * 0.13; /* radii squared: pi cancels */
    double x[] = {2, 3, 2.3, 3.2}, v[] = {0.7, 0.1, -0.9, -0.3};
    double angle = atan2(-0.2, -0.3) + twist;
    double n[] = {cos(angle), sin(angle)};
    double approach = (v[0] - v[2]) * n[0] + (v[1] - v[3]) * n[1];
    double impulse = -(1 + r) * approach * m0 * m1 / (m0 + m1);
    double w[] = {v[0] + impulse * n[0] / m0, v[1] + impulse * n[1] / m0,
                  v[2] - impulse * n[0] / m1 * gain, v[3] - impulse * n[1] / m1 * gain};
    struct fake_run f = fake_start("  width_l: 5\n  height_l: 7\n");
    fake_array(&f, "particles/grains/radius", (double[]){0.25, 0.13}, 2);
    write_frame(&f, 2, (double[]){1.99, 3, 2.31, 3.2}, v, 0);
    write_frame(&f, 2, x, w, DT);
    write_frame(&f, 2, x, w, 2 * DT);
    unit_ok(fake_measure(&f, "pair-collision", NULL, 0, m), &f.fault);
}

START_TEST(one_collision_is_told_from_velocities_alone) {
    struct measurement m;
    measure_pair(0.37, 0, 1, &m);
    ck_assert_double_eq_tol(fake_value(&m, "pair-collision", "restitution"), 0.37, 1e-13);
    ck_assert_double_lt(fake_value(&m, "pair-collision", "momentum_error"), 1e-15);
    ck_assert_double_lt(fake_value(&m, "pair-collision", "normal_error"), 1e-14);
    ck_assert_double_eq(fake_value(&m, "pair-collision", "changes"), 1);
    measure_pair(0.37, 1e-5, 1.00001, &m);
    ck_assert_double_gt(fake_value(&m, "pair-collision", "momentum_error"), 1e-7);
    ck_assert_double_eq_tol(fake_value(&m, "pair-collision", "normal_error"), 1e-5, 1e-8);
}
END_TEST

/* One grain, hits of both walls `delay` steps apart with restitutions a and b. */
static void corner(size_t delay, double a, double b, struct measurement *m) {
    struct fake_run f = fake_start("  width_l: 5\n  height_l: 7\n");
    double x[] = {1, 1}, v[] = {-0.7, -0.4};
    fake_array(&f, "particles/grains/radius", (double[]){0.2}, 1);
    for (size_t k = 0; k < 8; k++) {
        if (k == 2)
            v[0] *= -a;
        if (k == 2 + delay)
            v[1] *= -b;
        write_frame(&f, 1, x, v, DT * (double)k);
    }
    unit_ok(fake_measure(&f, "corner-hits", NULL, 0, m), &f.fault);
}

START_TEST(corner_hits_are_sorted_by_their_delay) {
    struct measurement m;
    corner(0, 0.8, 1, &m);
    ck_assert_double_eq_tol(fake_value(&m, "corner-hits", "same_step"), 0.8, 1e-15);
    ck_assert(isnan(fake_value(&m, "corner-hits", "next_step")));
    corner(0, 0.8, 0.8, &m); /* a rule that forgets the step */
    ck_assert_double_eq_tol(fake_value(&m, "corner-hits", "same_step"), 0.64, 1e-15);
    corner(1, 0.8, 1, &m);
    ck_assert_double_eq_tol(fake_value(&m, "corner-hits", "first"), 0.8, 1e-15);
    ck_assert_double_eq_tol(fake_value(&m, "corner-hits", "next_step"), 1, 1e-15);
    corner(2, 0.8, 0.7, &m);
    ck_assert_double_eq_tol(fake_value(&m, "corner-hits", "later"), 0.7, 1e-15);
}
END_TEST

START_TEST(collisions_need_every_step) {
    struct fake_run f = fake_start("  width_l: 5\n  height_l: 7\n");
    double x[] = {1, 1}, v[] = {-0.7, -0.4};
    struct measurement m;
    fake_array(&f, "particles/grains/radius", (double[]){0.2}, 1);
    write_frame(&f, 1, x, v, 0);
    write_frame(&f, 1, x, v, 2 * DT);
    ck_assert_int_eq(fake_measure(&f, "corner-hits", NULL, 0, &m), STATUS_BAD_INPUT);
    unit_says(&f.fault, "step 2 follows 0");
}
END_TEST

int main(void) {
    const TTest *const tests[] = {acceleration_is_the_change_over_the_last_step,
                                  acceleration_refuses_grains_that_were_not_held,
                                  a_parabola_is_free_fall_and_a_steeper_one_is_not,
                                  energy_counts_masses_and_heights,
                                  a_mirror_image_lasts_to_its_horizon,
                                  one_collision_is_told_from_velocities_alone,
                                  corner_hits_are_sorted_by_their_delay,
                                  collisions_need_every_step,
                                  NULL};
    return unit_run("observe_grains", tests);
}
