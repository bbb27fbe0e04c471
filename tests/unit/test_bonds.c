/* test_bonds.c -- solver/suspension/{grid,bonds,profiles}.h: neighbours, Q6, slabs. */
#include "solver/suspension/bonds.h"
#include "solver/suspension/grid.h"
#include "solver/suspension/profiles.h"
#include "tests/unit/unit.h"

#include <gsl/gsl_rng.h>
#include <math.h>

enum { COUNT = 500, CELLS = 5 };

static bool count_one(void *context, size_t j, const double apart[3]) {
    (void)j;
    (void)apart;
    ++*(size_t *)context;
    return true;
}

/* All within reach of a place, by looking at every sphere and image. */
static size_t near(const double *position, const double x[3], const double box[3],
                   const enum boundary kind[3], double reach) {
    size_t n = 0;
    for (size_t j = 0; j < COUNT; j++) {
        double square = 0;
        for (size_t a = 0; a < 3; a++) {
            double d = fabs(position[3 * j + a] - x[a]);
            d = kind[a] == BOUNDARY_PERIODIC ? fmin(d, box[a] - d) : d;
            square += d * d;
        }
        n += square <= reach * reach;
    }
    return n;
}

START_TEST(a_visit_meets_all_within_reach_once) {
    const double box[3] = {7.3, 5.1, 2.9};
    double position[3 * COUNT];
    gsl_rng *rng = gsl_rng_alloc(gsl_rng_mt19937);
    for (size_t k = 0; k < 3 * COUNT; k++)
        position[k] = box[k % 3] * gsl_rng_uniform(rng);
    gsl_rng_free(rng);
    for (int kinds = 0; kinds < 8; kinds++)
        for (double reach = 0.4; reach < 1.4; reach += 0.23) {
            struct fault fault = FAULT_NONE;
            struct grid g;
            enum boundary kind[3];
            for (int a = 0; a < 3; a++)
                kind[a] = kinds >> a & 1 ? BOUNDARY_HARD : BOUNDARY_PERIODIC;
            unit_ok(grid_create(&g, box, kind, reach, position, COUNT, &fault), &fault);
            for (size_t i = 0; i < COUNT; i++)
                grid_put(&g, i);
            for (size_t i = 0; i < COUNT; i += 7) {
                size_t found = 0;
                ck_assert(grid_visit(&g, position + 3 * i, count_one, &found));
                ck_assert_uint_eq(found, near(position, position + 3 * i, box, kind, reach));
            }
            grid_free(&g);
        }
}
END_TEST

static double order(const struct engine_setup *s, const double *position) {
    struct fault fault = FAULT_NONE;
    double q6 = -1;
    unit_ok(bonds_order(s, position, &q6, &fault), &fault);
    return q6;
}

/* Periodic face-centred cubic crystal of 4 CELLS^3 spheres, nearest neighbours 1.03 d. */
START_TEST(a_face_centred_cubic_crystal_has_its_known_order) {
    static const double base[4][3] = {{0, 0, 0}, {.5, .5, 0}, {.5, 0, .5}, {0, .5, .5}};
    double side = sqrt(2) * 1.03, position[3 * COUNT];
    struct engine_setup s = {.count = COUNT, .radius_m = 0.5};
    size_t n = 0;
    for (int c = 0; c < CELLS * CELLS * CELLS; c++)
        for (int b = 0; b < 4; b++, n += 3) {
            position[n] = side * (c % CELLS + base[b][0] + 0.01);
            position[n + 1] = side * (c / CELLS % CELLS + base[b][1] + 0.01);
            position[n + 2] = side * (c / CELLS / CELLS + base[b][2] + 0.01);
        }
    for (int a = 0; a < 3; a++)
        s.box_m[a] = CELLS * side;
    ck_assert_uint_eq(n, 3 * COUNT);
    ck_assert_double_eq_tol(order(&s, position), 0.57452, 1e-5); /* sqrt(169/512) = .574524 */
}
END_TEST

/* 500 uniform places with some 5500 ordered bonds: about 1/sqrt(2750) = .02, as pairs
 * count from both ends; a lattice would have .3 or more. */
START_TEST(a_gas_has_little_order) {
    double position[3 * COUNT];
    struct engine_setup s = {.count = COUNT, .radius_m = 0.5, .box_m = {10, 10, 10}};
    gsl_rng *rng = gsl_rng_alloc(gsl_rng_mt19937);
    for (size_t k = 0; k < 3 * COUNT; k++)
        position[k] = 10 * gsl_rng_uniform(rng);
    gsl_rng_free(rng);
    ck_assert_double_gt(order(&s, position), 0.002);
    ck_assert_double_lt(order(&s, position), 0.06);
}
END_TEST

/* Two slabs of moving spheres: packing by volume, temperatures about each slab's velocity. */
START_TEST(slabs_know_their_own_velocity) {
    struct fault fault = FAULT_NONE;
    struct profiles f;
    struct suspension_parameters p = {
        .particles = 5, .radius = 0.31, .mass = 1.7, .box = {2.1, 3.3, 4.0}, .profile_bin = 1.9};
    const double position[] = {1, 1, .5, 1, 2, 1.5, 2, 1, 3.1, 1, 3, 3.3, 2, 2, 3.9};
    const double velocity[] = {7.1, 0, 5, 7.3, 0, 5.4, 0, 1, -9, 0, 1.6, -9, 0, 1, -9.3};
    unit_ok(profiles_create(&f, &p, &fault), &fault);
    ck_assert_uint_eq(f.bins, 2);
    profiles_make(&f, &p, position, velocity);
    double volume = 4 * M_PI / 3 * 0.31 * 0.31 * 0.31;
    ck_assert_double_eq_tol(f.packing[0], 2 * volume / (2.1 * 3.3 * 2), 1e-13);
    ck_assert_double_eq_tol(f.packing[1], 3 * volume / (2.1 * 3.3 * 2), 1e-13);
    ck_assert_double_eq_tol(f.xy[0], 1.7 * 0.02 / 2, 1e-13);    /* x: .1, .1 off the mean */
    ck_assert_double_eq_tol(f.zz[0], 1.7 * 0.08, 1e-13);        /* .2, .2 */
    ck_assert_double_eq_tol(f.xy[1], 1.7 * 0.24 / 4, 1e-13);    /* y: .2, .4, .2 */
    ck_assert_double_eq_tol(f.zz[1], 1.7 * 0.06 / 2, 1e-13);    /* .1, .1, .2 */
    ck_assert_double_eq_tol(f.whole_xy, 1.7 * 0.26 / 6, 1e-13); /* 3 pairs of freedoms */
    ck_assert_double_eq_tol(f.whole_zz, 1.7 * 0.14 / 3, 1e-13);
    profiles_free(&f);
}
END_TEST

int main(void) {
    const TTest *const tests[] = {a_visit_meets_all_within_reach_once,
                                  a_face_centred_cubic_crystal_has_its_known_order,
                                  a_gas_has_little_order, slabs_know_their_own_velocity, NULL};
    return unit_run("bonds", tests);
}
