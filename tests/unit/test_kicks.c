/* test_kicks.c -- solver/suspension/kicks.h: when and whom the three schedules kick. */
#include "solver/suspension/kicks.h"
#include "tests/unit/unit.h"

#include <math.h>

static struct kicks made(enum kick_schedule schedule, size_t count, double rate) {
    struct fault fault = FAULT_NONE;
    struct kicks k;
    unit_ok(kicks_create(&k, schedule, count, rate, 1371, &fault), &fault);
    return k;
}

START_TEST(round_robin_meets_every_sphere_once_a_period_half_a_turn_from_its_ends) {
    struct kicks k = made(KICKS_ROUND_ROBIN, 7, 13.7);
    for (int n = 0; n < 21; n++) {
        ck_assert_double_eq_tol(k.time, (n + 0.5) / (7 * 13.7), 1e-15);
        ck_assert_int_eq((int)kicks_take(&k), n % 7);
    }
    kicks_free(&k);
}
END_TEST

START_TEST(synchronous_kicks_all_at_half_periods) {
    struct kicks k = made(KICKS_SYNCHRONOUS, 7, 13.7);
    for (int n = 0; n < 21; n++) {
        ck_assert_double_eq_tol(k.time, (n / 7 + 0.5) / 13.7, 1e-15);
        ck_assert_int_eq((int)kicks_take(&k), n % 7);
    }
    kicks_free(&k);
}
END_TEST

/* 40000 waits of mean 1 have a mean within 4/sqrt(40000) of 1 and a variance within
 * 4 sqrt(8/40000) of 1; counts of 8 spheres scatter as sqrt(5000).  Bounds of 4 standard
 * deviations: false alarms of 1e-3 for ten numbers, were the seed not fixed. */
START_TEST(poisson_waits_are_exponential_and_spheres_uniform) {
    enum { KICKS = 40000, SPHERES = 8 };
    struct kicks k = made(KICKS_POISSON, SPHERES, 13.7);
    double last = 0, sum = 0, square = 0, hit[SPHERES] = {0};
    for (int n = 0; n < KICKS; n++) {
        double wait = (k.time - last) * SPHERES * 13.7;
        last = k.time;
        sum += wait;
        square += wait * wait;
        hit[kicks_take(&k)] += 1;
    }
    double mean = sum / KICKS;
    ck_assert_double_eq_tol(mean, 1, 4 / sqrt(KICKS));
    ck_assert_double_eq_tol(square / KICKS - mean * mean, 1, 4 * sqrt(8.0 / KICKS));
    for (int i = 0; i < SPHERES; i++)
        ck_assert_double_eq_tol(hit[i], KICKS / SPHERES, 4 * sqrt(KICKS / SPHERES));
    kicks_free(&k);
}
END_TEST

START_TEST(rates_in_other_units_give_the_same_bits) {
    struct kicks a = made(KICKS_POISSON, 5, 13.7), b = made(KICKS_POISSON, 5, 13.7 * 1024);
    for (int n = 0; n < 1000; n++) {
        ck_assert_double_eq(a.time, 1024 * b.time);
        ck_assert_int_eq((int)kicks_take(&a), (int)kicks_take(&b));
    }
    kicks_free(&a);
    kicks_free(&b);
}
END_TEST

int main(void) {
    const TTest *const tests[] = {
        round_robin_meets_every_sphere_once_a_period_half_a_turn_from_its_ends,
        synchronous_kicks_all_at_half_periods, poisson_waits_are_exponential_and_spheres_uniform,
        rates_in_other_units_give_the_same_bits, NULL};
    return unit_run("kicks", tests);
}
