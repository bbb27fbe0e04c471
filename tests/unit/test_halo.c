/* test_halo.c -- solver/graingas/halo.h: weights sum to one, deposit and gather are adjoint. */
#include "solver/graingas/halo.h"
#include "tests/unit/unit.h"

#include <gsl/gsl_rng.h>
#include <math.h>

enum { GRAINS = 257, WIDTH = 7, HEIGHT = 11 };

static void draw(struct lattice *l, struct grains *g) {
    struct fault fault = FAULT_NONE;
    gsl_rng *rng = gsl_rng_alloc(gsl_rng_mt19937);
    gsl_rng_set(rng, 31337);
    unit_ok(lattice_create(l, WIDTH, HEIGHT, &fault), &fault);
    unit_ok(grains_create(g, GRAINS, &fault), &fault);
    for (int i = 0; i < GRAINS; i++) {
        g->x[i] = WIDTH * gsl_rng_uniform(rng);
        g->y[i] = HEIGHT * gsl_rng_uniform(rng);
        g->radius[i] = 0.1 + 0.13 * gsl_rng_uniform(rng);
        g->vx[i] = gsl_rng_uniform(rng) - 0.43;
        g->vy[i] = gsl_rng_uniform(rng) - 0.61;
    }
    g->x[0] = 0; /* exactly on a corner, on walls, on a site */
    g->y[0] = HEIGHT;
    g->x[1] = WIDTH;
    g->y[1] = 4.25;
    g->x[2] = 3;
    g->y[2] = 5;
    grains_weigh(g);
    gsl_rng_free(rng);
}

START_TEST(what_is_deposited_is_what_the_grains_have) {
    struct lattice l;
    struct grains g;
    draw(&l, &g);
    struct site_load *load = malloc(l.sites * sizeof *load);
    halo_deposit(&l, &g, load);
    double area = 0, flux = 0, there = 0, flux_there = 0;
    for (int i = 0; i < GRAINS; i++) {
        area += g.area[i];
        flux += g.area[i] * g.vy[i];
    }
    for (size_t k = 0; k < l.sites; k++) {
        there += load[k].area;
        flux_there += load[k].flux_y;
    }
    ck_assert_double_eq_tol(there, area, 1e-13 * area);
    ck_assert_double_eq_tol(flux_there, flux, 1e-13 * area);
    free(load);
    grains_free(&g);
    lattice_free(&l);
}
END_TEST

START_TEST(a_grain_on_a_site_gives_all_to_it) {
    struct lattice l;
    struct grains g;
    draw(&l, &g);
    struct site_load *load = malloc(l.sites * sizeof *load);
    g.count = 3;
    halo_deposit(&l, &g, load);
    ck_assert_double_eq(load[5 * (WIDTH + 1) + 3].area, g.area[2]);
    ck_assert_double_eq(load[HEIGHT * (WIDTH + 1)].area, g.area[0]);
    ck_assert_double_eq_tol(load[4 * (WIDTH + 1) + WIDTH].area, 0.75 * g.area[1], 1e-15);
    g.count = GRAINS;
    free(load);
    grains_free(&g);
    lattice_free(&l);
}
END_TEST

/* sum_i A_i v_i . gather(pull)_i = sum_k deposit(A v)_k . pull_k for any pull. */
START_TEST(deposit_and_gather_are_adjoint) {
    struct lattice l;
    struct grains g;
    draw(&l, &g);
    struct site_load *load = malloc(l.sites * sizeof *load);
    struct site_pull *pull = malloc(l.sites * sizeof *pull);
    double ax[GRAINS], ay[GRAINS], grains = 0, sites = 0, scale = 0;
    for (size_t k = 0; k < l.sites; k++) {
        pull[k].x = sin(1.7 * (double)k);
        pull[k].y = cos(2.3 * (double)(k * k % 97));
    }
    halo_deposit(&l, &g, load);
    halo_gather(&l, &g, pull, ax, ay);
    for (int i = 0; i < GRAINS; i++) {
        grains += g.area[i] * (g.vx[i] * ax[i] + g.vy[i] * ay[i]);
        scale += g.area[i];
    }
    for (size_t k = 0; k < l.sites; k++)
        sites += load[k].flux_x * pull[k].x + load[k].flux_y * pull[k].y;
    ck_assert_double_eq_tol(grains, sites, 1e-14 * scale * 10);
    ck_assert_double_gt(fabs(grains), 1e-3 * scale); /* not zero equal to zero */
    free(load);
    free(pull);
    grains_free(&g);
    lattice_free(&l);
}
END_TEST

START_TEST(a_grain_that_left_is_found) {
    struct lattice l;
    struct grains g;
    draw(&l, &g);
    ck_assert_int_eq(halo_first_outside(&l, &g), -1);
    g.x[77] = -1e-12;
    ck_assert_int_eq(halo_first_outside(&l, &g), 77);
    g.x[77] = NAN;
    ck_assert_int_eq(halo_first_outside(&l, &g), 77);
    grains_free(&g);
    lattice_free(&l);
}
END_TEST

int main(void) {
    const TTest *const tests[] = {what_is_deposited_is_what_the_grains_have,
                                  a_grain_on_a_site_gives_all_to_it, deposit_and_gather_are_adjoint,
                                  a_grain_that_left_is_found, NULL};
    return unit_run("halo", tests);
}
