/* test_sphere_cells.c -- validation/sphere_cells.h against all pairs. */
#include "tests/unit/unit.h"
#include "validation/sphere_cells.h"

#include <math.h>

enum { N = 700 };

static double random_share(unsigned *state) {
    *state = *state * 1664525u + 1013904223u;
    return (*state >> 8) / 16777216.0;
}

static double all_pairs(const struct sphere_cells_box *b, const double *x) {
    double least = b->diameter, wall = b->diameter / 2;
    for (size_t i = 0; i < b->count; i++)
        for (size_t a = 0; a < 3; a++)
            if (!b->periodic[a])
                wall = fmin(wall, fmin(x[3 * i + a], b->side[a] - x[3 * i + a]));
    for (size_t i = 0; i < b->count; i++)
        for (size_t j = 0; j < i; j++) {
            double sum = 0;
            for (size_t a = 0; a < 3; a++) {
                double way = fabs(x[3 * i + a] - x[3 * j + a]);
                if (b->periodic[a])
                    way = fmin(way, b->side[a] - way);
                sum += way * way;
            }
            least = fmin(least, sqrt(sum));
        }
    return fmax(1 - least / b->diameter, 0.5 - wall / b->diameter);
}

START_TEST(the_deepest_overlap_is_that_of_all_pairs) {
    unsigned state = 71;
    static double x[3 * N];
    for (int round = 0; round < 40; round++) {
        struct sphere_cells_box b = {.count = N,
                                     .diameter = 0.0113,
                                     .side = {1.37, 0.93, 1.71},
                                     .periodic = {round % 2, round / 2 % 2, round / 4 % 2}};
        for (int i = 0; i < 3 * N; i++) {
            double room = b.periodic[i % 3] ? 0 : 0.006;
            x[i] = room + (b.side[i % 3] - 2 * room) * random_share(&state);
        }
        if (round % 3 == 0) /* a pair across the edge, a sphere in the wall */
            for (int a = 0; a < 3; a++) {
                x[a] = 1e-4 * (1 + a);
                x[3 + a] = b.side[a] - 2e-4;
            }
        double deepest;
        struct fault fault = FAULT_NONE;
        unit_ok(sphere_cells_overlap(&b, x, &deepest, &fault), &fault);
        ck_assert_double_eq_tol(deepest, fmax(all_pairs(&b, x), 0), 1e-12);
    }
}
END_TEST

START_TEST(spheres_apart_do_not_overlap_and_strangers_are_refused) {
    struct sphere_cells_box b = {.count = 2, .diameter = 0.3, .side = {1.1, 1.3, 1.7}};
    double x[] = {0.2, 0.3, 0.4, 0.2 + 0.2999, 0.3, 0.4}, deepest = 7;
    struct fault fault = FAULT_NONE;
    unit_ok(sphere_cells_overlap(&b, x, &deepest, &fault), &fault);
    ck_assert_double_eq_tol(deepest, 1e-4 / 0.3, 1e-12);
    x[3] = 0.2 + 0.3001;
    unit_ok(sphere_cells_overlap(&b, x, &deepest, &fault), &fault);
    ck_assert_double_eq(deepest, 0);
    x[5] = 2.3;
    ck_assert_int_eq(sphere_cells_overlap(&b, x, &deepest, &fault), STATUS_BAD_INPUT);
    unit_says(&fault, "sphere 1 is outside");
    b.periodic[0] = true;
    b.side[0] = 0.8;
    fault = (struct fault)FAULT_NONE;
    ck_assert_int_eq(sphere_cells_overlap(&b, x, &deepest, &fault), STATUS_BAD_INPUT);
    unit_says(&fault, "too short");
}
END_TEST

int main(void) {
    const TTest *const tests[] = {the_deepest_overlap_is_that_of_all_pairs,
                                  spheres_apart_do_not_overlap_and_strangers_are_refused, NULL};
    return unit_run("sphere_cells", tests);
}
