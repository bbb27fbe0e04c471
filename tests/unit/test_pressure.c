/* test_pressure.c -- solver/graingas/multigrid.h against CHOLMOD's direct solution. */
#include "solver/graingas/multigrid.h"
#include "tests/unit/unit.h"

#include <cholmod.h>
#include <gsl/gsl_rng.h>
#include <math.h>
#include <stdbool.h>

struct equations {
    int nx, ny;
    double *east, *north, *mass, *b;
};

/* Faces over five decades, masses a thousandth of them, every size awkward. */
static struct equations draw(int nx, int ny, unsigned long seed, double mass) {
    size_t n = (size_t)(nx * ny);
    struct equations e = {nx, ny, malloc(8 * n), malloc(8 * n), malloc(8 * n), malloc(8 * n)};
    gsl_rng *rng = gsl_rng_alloc(gsl_rng_mt19937);
    gsl_rng_set(rng, seed);
    for (size_t k = 0; k < n; k++) {
        e.east[k] = 0.07 * pow(70, gsl_rng_uniform(rng));
        e.north[k] = 0.07 * pow(70, gsl_rng_uniform(rng));
        e.mass[k] = mass * (0.3 + gsl_rng_uniform(rng));
        e.b[k] = gsl_rng_uniform(rng) - 0.513;
    }
    gsl_rng_free(rng);
    return e;
}

static void drop(struct equations *e) {
    free(e->east);
    free(e->north);
    free(e->mass);
    free(e->b);
}

static void add(cholmod_triplet *t, size_t i, size_t j, double value) {
    ((int *)t->i)[t->nnz] = (int)i;
    ((int *)t->j)[t->nnz] = (int)j;
    ((double *)t->x)[t->nnz++] = value;
}

static void direct(const struct equations *e, double *x) {
    size_t n = (size_t)(e->nx * e->ny), nx = (size_t)e->nx;
    cholmod_common c;
    cholmod_start(&c);
    cholmod_triplet *t = cholmod_allocate_triplet(n, n, 7 * n, -1, CHOLMOD_REAL, &c);
    for (size_t k = 0; k < n; k++) {
        add(t, k, k, e->mass[k]);
        size_t other[2] = {k + 1, k + nx};
        bool inside[2] = {(k + 1) % nx != 0, k + nx < n};
        double face[2] = {e->east[k], e->north[k]};
        for (int d = 0; d < 2; d++)
            if (inside[d]) {
                add(t, k, k, face[d]);
                add(t, other[d], other[d], face[d]);
                add(t, other[d], k, -face[d]);
            }
    }
    cholmod_sparse *a = cholmod_triplet_to_sparse(t, 0, &c);
    cholmod_dense *b = cholmod_zeros(n, 1, CHOLMOD_REAL, &c);
    memcpy(b->x, e->b, n * sizeof(double));
    cholmod_factor *factor = cholmod_analyze(a, &c);
    cholmod_factorize(a, factor, &c);
    cholmod_dense *solution = cholmod_solve(CHOLMOD_A, factor, b, &c);
    memcpy(x, solution->x, n * sizeof(double));
    cholmod_free_dense(&solution, &c);
    cholmod_free_dense(&b, &c);
    cholmod_free_factor(&factor, &c);
    cholmod_free_sparse(&a, &c);
    cholmod_free_triplet(&t, &c);
    cholmod_finish(&c);
}

static struct multigrid_outcome solve(const struct equations *e, double tolerance, double *x) {
    struct fault fault = FAULT_NONE;
    struct multigrid *m;
    struct multigrid_outcome outcome;
    unit_ok(multigrid_create(&m, e->nx, e->ny, &fault), &fault);
    multigrid_set(m, e->east, e->north, e->mass);
    unit_ok(multigrid_solve(m, e->b, tolerance, x, &outcome, &fault), &fault);
    multigrid_free(m);
    return outcome;
}

static const int sizes[][2] = {{3, 3},   {4, 3},   {3, 17},  {5, 5},   {7, 64}, {61, 93},
                               {61, 59}, {60, 92}, {128, 3}, {33, 65}, {1, 9},  {50, 101}};
enum { SIZES = sizeof sizes / sizeof *sizes };

START_TEST(every_size_agrees_with_cholmod) {
    for (int s = 0; s < SIZES; s++) {
        struct equations e = draw(sizes[s][0], sizes[s][1], 4711 + (unsigned long)s, 1.37e-3);
        size_t n = (size_t)(e.nx * e.ny);
        double *x = calloc(n, 8), *y = calloc(n, 8), worst = 0, scale = 0;
        struct multigrid_outcome outcome = solve(&e, 1e-13, x);
        direct(&e, y);
        for (size_t k = 0; k < n; k++) {
            worst = fmax(worst, fabs(x[k] - y[k]));
            scale = fmax(scale, fabs(y[k]));
        }
        /* Residual 1e-13 times the condition, at most faces over mass = 2e4. */
        ck_assert_msg(worst <= 2e-9 * scale, "%d x %d: off by %g of %g", e.nx, e.ny, worst, scale);
        ck_assert_int_le(outcome.iterations, 30); /* uncorrelated faces: the worst case */
        free(x);
        free(y);
        drop(&e);
    }
}
END_TEST

START_TEST(cycles_do_not_grow_with_the_box) {
    int small, large;
    struct equations e = draw(31, 47, 99, 1e-3);
    double *x = calloc(481 * 721, 8);
    small = solve(&e, 1e-8, x).iterations;
    drop(&e);
    e = draw(481, 721, 99, 1e-3);
    memset(x, 0, 481 * 721 * 8);
    large = solve(&e, 1e-8, x).iterations;
    drop(&e);
    free(x);
    ck_assert_int_le(small, 20);
    ck_assert_int_le(large, small + 4);
}
END_TEST

START_TEST(a_good_guess_costs_nothing) {
    struct equations e = draw(61, 93, 5, 1e-2);
    double *x = calloc(61 * 93, 8);
    solve(&e, 1e-12, x);
    ck_assert_int_eq(solve(&e, 1e-8, x).iterations, 0);
    free(x);
    drop(&e);
}
END_TEST

START_TEST(no_right_hand_side_gives_zero) {
    struct equations e = draw(9, 14, 5, 1e-2);
    double x[9 * 14];
    for (int k = 0; k < 9 * 14; k++)
        x[k] = e.b[k] = 0;
    ck_assert_int_eq(solve(&e, 1e-8, x).iterations, 0);
    ck_assert_double_eq(x[17], 0);
    drop(&e);
}
END_TEST

START_TEST(what_cannot_converge_is_a_fault) {
    struct fault fault = FAULT_NONE;
    struct multigrid *m;
    struct multigrid_outcome outcome;
    struct equations e = draw(12, 13, 5, 1e-2);
    double x[12 * 13] = {0};
    e.east[40] = NAN;
    unit_ok(multigrid_create(&m, 12, 13, &fault), &fault);
    multigrid_set(m, e.east, e.north, e.mass);
    ck_assert_int_eq(multigrid_solve(m, e.b, 1e-8, x, &outcome, &fault), STATUS_NUMERICAL);
    unit_says(&fault, "did not converge");
    multigrid_free(m);
    drop(&e);
}
END_TEST

int main(void) {
    const TTest *const tests[] = {every_size_agrees_with_cholmod,  cycles_do_not_grow_with_the_box,
                                  a_good_guess_costs_nothing,      no_right_hand_side_gives_zero,
                                  what_cannot_converge_is_a_fault, NULL};
    return unit_run("pressure", tests);
}
