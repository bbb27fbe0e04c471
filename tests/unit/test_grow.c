/* test_grow.c -- solver/suspension/grow.h: what growth hands over: apart, inside, without
 * memory of where it came from, the same for a seed; and what it refuses. */
#include "solver/suspension/grow.h"
#include "tests/unit/unit.h"

#include <math.h>

enum { COUNT = 500 };

/* A box of 1.1 : .9 : 1/.99 at a packing fraction; z between hard sides. */
static struct grow_rule rule_of(size_t count, double packing, uint64_t seed) {
    const double R = 0.613e-3, side = cbrt((double)count * 4 * M_PI / 3 * R * R * R / packing);
    return (struct grow_rule){
        .setup = {.count = count,
                  .radius_m = R,
                  .mass_kg = 2.262e-6,
                  .box_m = {1.1 * side, 0.9 * side, side / 0.99},
                  .boundary = {BOUNDARY_PERIODIC, BOUNDARY_PERIODIC, BOUNDARY_HARD},
                  .restitution = 1},
        .rate = 0.1,
        .square_speed = 8.84e-4,
        .seed = seed};
}

static double grown(const struct grow_rule *rule, double *position) {
    struct fault fault = FAULT_NONE;
    double collisions = -1;
    unit_ok(grow_spheres(rule, position, &collisions, &fault), &fault);
    return collisions;
}

/* Distance of a pair by the nearest image, in diameters. */
static double distance(const struct engine_setup *s, const double *x, const double *y) {
    double square = 0;
    for (int a = 0; a < 3; a++) {
        double d = fabs(x[a] - y[a]);
        d = s->boundary[a] == BOUNDARY_PERIODIC ? fmin(d, s->box_m[a] - d) : d;
        square += d * d;
    }
    return sqrt(square) / (2 * s->radius_m);
}

static void expect_apart_and_inside(const struct grow_rule *rule, const double *position) {
    const struct engine_setup *s = &rule->setup;
    for (size_t i = 0; i < s->count; i++) {
        for (size_t j = 0; j < i; j++)
            ck_assert_double_ge(distance(s, position + 3 * i, position + 3 * j), 1 - 1e-10);
        for (size_t a = 0; a < 3; a++) {
            double edge = s->boundary[a] == BOUNDARY_HARD ? s->radius_m * (1 - 1e-12) : 0;
            ck_assert_double_ge(position[3 * i + a], edge);
            ck_assert_double_le(position[3 * i + a], s->box_m[a] - edge);
        }
    }
}

START_TEST(spheres_are_apart_and_inside_at_every_packing) {
    static double position[3 * COUNT];
    const double packing[] = {0.02, 0.119, 0.121, 0.3, 0.45, 0.54};
    for (int n = 0; n < 6; n++) {
        struct grow_rule rule = rule_of(COUNT, packing[n], 137u + (unsigned)n);
        double collisions = grown(&rule, position);
        expect_apart_and_inside(&rule, position);
        /* Up to .12 they are placed, and do not move. */
        ck_assert_int_eq(collisions > 0, packing[n] > 0.12);
    }
}
END_TEST

/* Collisions of a sphere while its diameter grows from .12 to .45 at `rate` thermal speeds:
 * Enskog's 24 phi g/(d sqrt(pi)) a thermal way, g by Carnahan and Starling; surfaces that
 * come at `rate` meet more often by sqrt(pi)/2 of it, to first order. */
static double expected_collisions(double rate) {
    const double first = cbrt(0.12 / 0.45), step = (1 - first) / 1000;
    double sum = 0;
    for (int k = 0; k < 1000; k++) {
        double d = first + (k + 0.5) * step, phi = 0.45 * d * d * d;
        sum += 24 * phi * (1 - phi / 2) / pow(1 - phi, 3) / d / sqrt(M_PI) * step / rate;
    }
    return sum * (1 + rate * sqrt(M_PI) / 2);
}

/* What is left: heat between the rescalings, every third collision, and order that lags behind;
 * 3 % were found.  36 and 360 collisions of 500 scatter by 1 and .3 %.  Without hard sides, which
 * crowd the middle. */
START_TEST(collisions_of_growth_are_those_of_enskog) {
    static double position[3 * COUNT];
    struct grow_rule fast = rule_of(COUNT, 0.45, 7), slow;
    fast.setup.boundary[2] = BOUNDARY_PERIODIC;
    slow = fast;
    slow.rate = 0.01;
    double few = grown(&fast, position), many = grown(&slow, position);
    ck_assert_double_eq_tol(few / expected_collisions(0.1), 1, 0.06);
    ck_assert_double_eq_tol(many / expected_collisions(0.01), 1, 0.06);
}
END_TEST

START_TEST(a_seed_gives_the_same_places_and_another_seed_others) {
    static double first[3 * COUNT], again[3 * COUNT], other[3 * COUNT];
    for (int n = 0; n < 2; n++) {
        struct grow_rule rule = rule_of(COUNT, n == 0 ? 0.1 : 0.4, 1371);
        double collisions = grown(&rule, first);
        ck_assert_double_eq(grown(&rule, again), collisions);
        ck_assert_mem_eq(first, again, sizeof first);
        rule.seed = 1372;
        grown(&rule, other);
        for (size_t k = 0; k < 3 * COUNT; k++)
            ck_assert_double_ne(first[k], other[k]);
    }
}
END_TEST

/* Uniform along periodic axes: the first Fourier sums of N places have the variance N S/2 with
 * S <= 1; of 20 starts of 500, eight sums' mean square over N/2 scatters by sqrt(2/160) at most:
 * below 1 + 4 (.11); above .003, where a lattice has 0. */
START_TEST(places_are_uniform_along_periodic_axes) {
    static double position[3 * COUNT];
    double square = 0;
    for (unsigned seed = 0; seed < 20; seed++) {
        struct grow_rule rule = rule_of(COUNT, 0.3, 41 + seed);
        grown(&rule, position);
        for (size_t wave = 0; wave < 8; wave++) {
            double sum = 0, turns = 1 + (double)(wave / 4);
            for (size_t i = 0; i < COUNT; i++) {
                size_t a = wave & 1;
                double phase = 2 * M_PI * turns * position[3 * i + a] / rule.setup.box_m[a];
                sum += wave & 2 ? sin(phase) : cos(phase);
            }
            square += sum * sum / (0.5 * COUNT) / 160;
        }
    }
    ck_assert_double_lt(square, 1.45);
    ck_assert_double_gt(square, 0.003);
}
END_TEST

/* At .02 a sphere expects n 4 pi/3 (2^3 - 1) d^3 = 8 (7 .02) others within two diameters.  Hard
 * sides and the next order in density are some 3 % each, 2800 pairs scatter by 2 %. */
START_TEST(a_dilute_start_has_the_neighbours_of_a_gas) {
    static double position[3 * COUNT];
    double pairs = 0;
    for (unsigned seed = 0; seed < 10; seed++) {
        struct grow_rule rule = rule_of(COUNT, 0.02, 410 + seed);
        grown(&rule, position);
        for (size_t i = 0; i < COUNT; i++)
            for (size_t j = 0; j < i; j++)
                pairs += distance(&rule.setup, position + 3 * i, position + 3 * j) < 2;
    }
    double expected = 10 * 0.5 * COUNT * 8 * 7 * 0.02;
    ck_assert_double_eq_tol(pairs / expected, 1, 0.12);
}
END_TEST

START_TEST(a_box_that_cannot_hold_them_is_refused) {
    static double position[3 * COUNT];
    struct fault fault = FAULT_NONE;
    double collisions;
    struct grow_rule rule = rule_of(200, 0.7, 3);
    ck_assert_int_eq(grow_spheres(&rule, position, &collisions, &fault), STATUS_BAD_INPUT);
    unit_says(&fault, "start: the spheres jam when");
}
END_TEST

int main(void) {
    const TTest *const tests[] = {spheres_are_apart_and_inside_at_every_packing,
                                  collisions_of_growth_are_those_of_enskog,
                                  a_seed_gives_the_same_places_and_another_seed_others,
                                  places_are_uniform_along_periodic_axes,
                                  a_dilute_start_has_the_neighbours_of_a_gas,
                                  a_box_that_cannot_hold_them_is_refused,
                                  NULL};
    return unit_run("grow", tests);
}
