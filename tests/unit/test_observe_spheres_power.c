/* test_observe_spheres_power.c -- Haff's law planted; energies that balance and do not. */
#include "tests/unit/spheres_fixture.h"
#include "validation/sphere_laws.h"

static const double SIDE[] = {57, 43, 71};

START_TEST(the_rate_of_haffs_law_is_found) {
    struct fake_run f = spheres_start(431, 6e-4, SIDE, "periodic", "");
    struct measurement m;
    for (int n = 0; n < 23; n++) {
        double t = 0.03 * n, late = t > 0.4 ? 1.5 : 1; /* not Haff's after .4 s */
        spheres_counter(&f, "kinetic_energy", 7.1e-6 / pow(1 + 3.71 * t, 2) * late, t);
        spheres_counter(&f, "collisions", 431 * 20 * t, t);
    }
    unit_ok(fake_measure(&f, "sphere-cooling", "to_s", 0.39, &m), &f.fault);
    ck_assert_double_eq_tol(fake_value(&m, "sphere-cooling", "rate"), 3.71, 1e-11);
    ck_assert_double_lt(fake_value(&m, "sphere-cooling", "deviation"), 1e-12);
    ck_assert_double_eq_tol(fake_value(&m, "sphere-cooling", "collisions"), 2 * 20 * 0.39, 1e-10);
    ck_assert_double_eq_tol(fake_value(&m, "sphere-cooling", "fall"), pow(1 + 3.71 * 0.39, 2),
                            1e-10);
    double start = 2 * 7.1e-6 / (3 * 431);
    ck_assert_double_eq_tol(fake_value(&m, "sphere-cooling", "temperature"), start, 1e-12 * start);
}
END_TEST

/* T stands; noise pays for drag and collisions with the coefficient c, plus `extra`. */
static void balance(double c, double extra, struct measurement *m) {
    double n = 431, t0 = 2.9e-9, gamma = spheres_drag(4.9, 0.37, 4.65), f_coll = 83, eps = 0.77;
    double drag = 3 * n * gamma * t0, loss = 1.5 * n * c * f_coll * (1 - eps * eps) * t0;
    struct fake_run f = spheres_start(431, 6e-4, SIDE, "periodic", "  restitution: 0.77\n");
    for (int k = 0; k < 5; k++) {
        double t = 0.7 * k;
        spheres_counter(&f, "kinetic_energy", 1.5 * n * t0, t);
        spheres_counter(&f, "noise_energy", (0.8 * (drag + loss) + extra * drag) * t, t);
        spheres_counter(&f, "drive_energy", 0.2 * (drag + loss) * t, t);
        spheres_counter(&f, "dissipated_energy", loss * t, t);
        spheres_counter(&f, "drag_energy", drag * t, t);
        spheres_counter(&f, "collisions", n * f_coll * t / 2, t);
        spheres_counter(&f, "kicks", n * 250 * t, t);
    }
    unit_ok(fake_measure(&f, "sphere-power", "from_s", 0.7, m), &f.fault);
}

static double value(const struct measurement *m, const char *output) {
    return fake_value(m, "sphere-power", output);
}

START_TEST(coefficient_and_temperature_come_from_the_powers) {
    struct measurement m;
    balance(1.0 / 3, 0, &m);
    ck_assert_double_eq_tol(value(&m, "coefficient"), 1.0 / 3, 1e-12);
    ck_assert_double_eq_tol(value(&m, "closure"), 0, 1e-12);
    ck_assert_double_lt(value(&m, "bookkeeping"), 1e-12);
    ck_assert_double_eq_tol(value(&m, "temperature"), 2.9e-9, 1e-20);
    ck_assert_double_eq_tol(value(&m, "temperature_ratio"), 2.9 / (1.7 * 1.3), 1e-12);
    ck_assert_double_eq_tol(value(&m, "sampled_ratio"), 1, 1e-12);
    ck_assert_double_eq_tol(value(&m, "collision_rate"), 83, 1e-10);
    ck_assert_double_eq_tol(value(&m, "kick_rate"), 250, 1e-10);
    balance(0.75, 0, &m);
    ck_assert_double_eq_tol(value(&m, "coefficient"), 0.75, 1e-12);
}
END_TEST

START_TEST(energy_from_nowhere_shows) {
    struct measurement m;
    balance(1.0 / 3, 0.01, &m);
    double share = 1 - value(&m, "dissipated_share");
    ck_assert_double_eq_tol(value(&m, "bookkeeping"), 0.01 * share, 1e-10);
    ck_assert_double_eq_tol(value(&m, "closure"), 0.01 * share, 1e-10);
    ck_assert_double_gt(share, 0.3);
}
END_TEST

int main(void) {
    const TTest *const tests[] = {the_rate_of_haffs_law_is_found,
                                  coefficient_and_temperature_come_from_the_powers,
                                  energy_from_nowhere_shows, NULL};
    return unit_run("observe_spheres_power", tests);
}
