/* test_engine_many.c -- solver/suspension/engine.h: what must hold for many spheres. */
#include "common/random.h"
#include "solver/suspension/engine.h"
#include "tests/unit/unit.h"

#include <gsl/gsl_randist.h>
#include <math.h>

enum { MOST = 2000 };
static double x[3 * MOST], v[3 * MOST], y[3 * MOST], u[3 * MOST];
static int64_t image[3 * MOST];

static struct engine_setup cube(size_t count, double packing, enum boundary side) {
    struct engine_setup s = {.count = count, .radius_m = 0.57, .mass_kg = 1.3, .restitution = 1};
    for (int a = 0; a < 3; a++) {
        s.box_m[a] = cbrt((double)count * 4 * M_PI / 3 / packing) * s.radius_m;
        s.boundary[a] = side;
    }
    return s;
}

static struct engine *create(const struct engine_setup *s) {
    struct fault fault = FAULT_NONE;
    struct engine *e = NULL;
    unit_ok(engine_create(&e, s, &fault), &fault);
    return e;
}

static void set(struct engine *e, const double *place, const double *velocity) {
    struct fault fault = FAULT_NONE;
    unit_ok(engine_set_state(e, place, velocity, &fault), &fault);
}

static void advance(struct engine *e, double dt) {
    struct fault fault = FAULT_NONE;
    unit_ok(engine_advance(e, engine_time(e) + dt, &fault), &fault);
}

static double energy(size_t count, const double *velocity) {
    double sum = 0;
    for (size_t k = 0; k < 3 * count; k++)
        sum += 0.5 * velocity[k] * velocity[k];
    return sum;
}

/* Places x by growth from points, velocities v Gaussian of unit variance, no momentum. */
static void start(const struct engine_setup *s, unsigned long seed) {
    struct fault fault = FAULT_NONE;
    struct engine_setup elastic = *s;
    elastic.restitution = 1;
    struct engine *e = create(&elastic);
    gsl_rng *r = gsl_rng_alloc(gsl_rng_mt19937);
    gsl_rng_set(r, seed);
    for (size_t k = 0; k < 3 * s->count; k++) {
        double wall = s->boundary[k % 3] == BOUNDARY_HARD ? s->radius_m : 0;
        x[k] = wall + (s->box_m[k % 3] - 2 * wall) * gsl_rng_uniform(r);
    }
    double rate = 0.1, size = 0, most = 2 * s->radius_m;
    while (size < most) {
        for (size_t k = 0; k < 3 * s->count; k++)
            v[k] = gsl_ran_gaussian(r, 1);
        unit_ok(engine_set_growth(e, size, rate, &fault), &fault);
        set(e, x, v);
        double next = fmin(size + 0.1, most);
        advance(e, (next - size) / rate);
        ck_assert_double_eq_tol(engine_diameter(e), next, 1e-12);
        ck_assert_double_lt(engine_deepest_overlap(e), 1e-12);
        engine_snapshot(e, x, NULL, NULL);
        size = next;
    }
    for (size_t a = 0; a < 3; a++) {
        double mean = 0;
        for (size_t i = 0; i < s->count; i++)
            mean += v[3 * i + a] / (double)s->count;
        for (size_t i = 0; i < s->count; i++)
            v[3 * i + a] -= mean;
    }
    gsl_rng_free(r);
    engine_free(e);
}

/* Round-off of 1000 collisions a sphere grows as a random walk: sqrt(1000 N) eps in each
 * sum, 1e-12 of the whole leaves a factor of some ten. */
START_TEST(energy_and_momentum_stay) {
    struct engine_setup s = cube(432, 0.35, BOUNDARY_PERIODIC);
    start(&s, 71);
    struct engine *e = create(&s);
    set(e, x, v);
    double before = energy(s.count, v);
    while (engine_tally(e)->collisions < 500 * (long long)s.count) {
        advance(e, 2.3);
        ck_assert_double_lt(engine_deepest_overlap(e), 1e-12);
    }
    engine_snapshot(e, y, u, NULL);
    ck_assert_double_eq_tol(energy(s.count, u) / before, 1, 1e-12);
    for (size_t a = 0; a < 3; a++) {
        double sum = 0;
        for (size_t i = 0; i < s.count; i++)
            sum += u[3 * i + a];
        ck_assert_double_eq_tol(sum, 0, 1e-11);
    }
    ck_assert_double_eq(engine_tally(e)->dissipated_J + 1, 1 + engine_tally(e)->dissipated_J);
    ck_assert_double_eq_tol(engine_tally(e)->dissipated_J, 0, 1e-11 * before);
    engine_free(e);
}
END_TEST

/* Forth, velocities reversed, and back: chaos multiplies round-off by some ten a
 * collision of each sphere, so that after 3 of them 1e-9 is left of 1e-16 times 1e4. */
START_TEST(time_can_be_reversed) {
    for (int side = BOUNDARY_PERIODIC; side <= BOUNDARY_HARD; side++) {
        struct engine_setup s = cube(250, 0.3, (enum boundary)side);
        start(&s, 72);
        struct engine *e = create(&s);
        set(e, x, v);
        advance(e, 0.37);
        ck_assert_int_gt(engine_tally(e)->collisions, 250);
        engine_snapshot(e, y, u, NULL);
        for (size_t k = 0; k < 3 * s.count; k++)
            u[k] = -u[k];
        set(e, y, u);
        advance(e, 0.37);
        engine_snapshot(e, y, u, NULL);
        for (size_t k = 0; k < 3 * s.count; k++) {
            double gap = y[k] - x[k];
            if (side == BOUNDARY_PERIODIC)
                gap -= s.box_m[0] * nearbyint(gap / s.box_m[0]);
            ck_assert_double_eq_tol(gap, 0, 1e-9);
            ck_assert_double_eq_tol(u[k], -v[k], 1e-8);
        }
        engine_free(e);
    }
}
END_TEST

/* A rebase (here: by setting the drag there is) changes nothing beyond round-off. */
START_TEST(a_rebase_changes_nothing) {
    struct engine_setup s = cube(250, 0.3, BOUNDARY_HARD);
    struct fault fault = FAULT_NONE;
    s.restitution = 0.8;
    start(&s, 73);
    struct engine *e = create(&s), *f = create(&s);
    set(e, x, v);
    set(f, x, v);
    unit_ok(engine_set_drag(e, 0.83, &fault), &fault);
    unit_ok(engine_set_drag(f, 0.83, &fault), &fault);
    for (int n = 0; n < 20; n++) {
        advance(e, 0.02);
        advance(f, 0.02);
        unit_ok(engine_set_drag(f, 0.83, &fault), &fault);
    }
    ck_assert_int_gt(engine_tally(e)->collisions, 250);
    ck_assert_int_eq(engine_tally(e)->collisions, engine_tally(f)->collisions);
    engine_snapshot(e, x, v, NULL);
    engine_snapshot(f, y, u, NULL);
    for (size_t k = 0; k < 3 * s.count; k++) {
        ck_assert_double_eq_tol(x[k], y[k], 1e-9);
        ck_assert_double_eq_tol(v[k], u[k], 1e-8);
    }
    engine_free(e);
    engine_free(f);
}
END_TEST

/* Enskog with Carnahan-Starling; 1e6 collisions counted: .1 % of noise, the closure itself
 * is good to .5 % here and the size of the system costs some .1 %. */
START_TEST(spheres_collide_as_often_as_enskog_says) {
    double packing = 0.3, chi = (1 - packing / 2) / pow(1 - packing, 3), d = 1.14;
    struct engine_setup s = cube(2000, packing, BOUNDARY_PERIODIC);
    start(&s, 74);
    struct engine *e = create(&s);
    set(e, x, v);
    advance(e, 3);
    engine_reset_tally(e);
    double began = engine_time(e), n = 2000 / pow(s.box_m[0], 3);
    while (engine_tally(e)->collisions < 500000)
        advance(e, 3);
    double speed = sqrt(2 * energy(2000, v) / 6000), took = engine_time(e) - began;
    double enskog = 4 * sqrt(M_PI) * n * d * d * chi * speed; /* a sphere */
    double seen = 2 * (double)engine_tally(e)->collisions / 2000 / took;
    ck_assert_double_eq_tol(seen / enskog, 1, 0.008);
    double Z = 1 + engine_tally(e)->virial_J / (3 * 2000 * s.mass_kg * speed * speed * took);
    double cs = (1 + packing + packing * packing - pow(packing, 3)) / pow(1 - packing, 3);
    ck_assert_double_eq_tol(Z / cs, 1, 0.008);
    engine_free(e);
}
END_TEST

static void same_bits(const struct engine *e, const struct engine *f, size_t count) {
    static int64_t other[3 * MOST];
    engine_snapshot(e, x, v, image);
    engine_snapshot(f, y, u, other);
    ck_assert_mem_eq(x, y, 3 * count * sizeof *x);
    ck_assert_mem_eq(v, u, 3 * count * sizeof *v);
    ck_assert_mem_eq(image, other, 3 * count * sizeof *image);
}

START_TEST(a_run_continues_from_a_file_to_the_same_bits) {
    struct fault fault = FAULT_NONE;
    const char *folder = unit_folder(), *path = unit_path(folder, "state.h5");
    struct h5_writer *w = NULL;
    struct h5_reader *r = NULL;
    struct engine_setup s = cube(300, 0.4, BOUNDARY_PERIODIC);
    s.boundary[2] = BOUNDARY_HARD;
    s.restitution = 0.9;
    s.guard = GUARD_CONTACT_TIME;
    s.contact_time_s = 1e-3;
    start(&s, 75);
    struct engine *e = create(&s), *f = create(&s);
    set(e, x, v);
    unit_ok(engine_set_drag(e, 0.31, &fault), &fault);
    advance(e, 1.1);
    unit_ok(h5_create(path, &w, &fault), &fault);
    unit_ok(engine_save(e, w, "engine", &fault), &fault);
    unit_ok(h5_commit(w, &fault), &fault);
    unit_ok(h5_open(path, &r, &fault), &fault);
    unit_ok(engine_load(f, r, "engine", &fault), &fault);
    h5_close(r);
    advance(e, 9.3); /* past several rebases */
    advance(f, 9.3);
    same_bits(e, f, s.count);
    ck_assert_mem_eq(engine_tally(e), engine_tally(f), sizeof(struct engine_tally));
    ck_assert_int_gt(engine_tally(f)->elastic, 0);
    engine_free(e);
    engine_free(f);
    unit_remove(folder);
}
END_TEST

/* Lengths times 2^3, times 2^-2, masses times 2^5. */
START_TEST(powers_of_two_rescale_to_the_same_bits) {
    struct fault fault = FAULT_NONE;
    struct engine_setup s = cube(300, 0.4, BOUNDARY_PERIODIC);
    s.boundary[0] = BOUNDARY_HARD;
    s.restitution = 0.9;
    s.guard = GUARD_CUTOFF_SPEED;
    s.cutoff_speed_m_s = 0.05;
    start(&s, 76);
    struct engine_setup big = s;
    big.radius_m *= 8;
    big.mass_kg *= 32;
    big.cutoff_speed_m_s *= 32;
    for (int a = 0; a < 3; a++)
        big.box_m[a] *= 8;
    struct engine *e = create(&s), *f = create(&big);
    set(e, x, v);
    for (size_t k = 0; k < 3 * s.count; k++) {
        y[k] = 8 * x[k];
        u[k] = 32 * v[k];
    }
    set(f, y, u);
    unit_ok(engine_set_drag(e, 0.31, &fault), &fault);
    unit_ok(engine_set_drag(f, 4 * 0.31, &fault), &fault);
    advance(e, 7.7);
    advance(f, 7.7 / 4);
    engine_snapshot(e, x, v, NULL);
    engine_snapshot(f, y, u, NULL);
    for (size_t k = 0; k < 3 * s.count; k++) {
        ck_assert_double_eq(8 * x[k], y[k]);
        ck_assert_double_eq(32 * v[k], u[k]);
    }
    ck_assert_int_eq(engine_tally(e)->collisions, engine_tally(f)->collisions);
    ck_assert_double_eq(engine_tally(e)->dissipated_J * 32768, engine_tally(f)->dissipated_J);
    engine_free(e);
    engine_free(f);
}
END_TEST

/* In one stride or in many, the same bits. */
START_TEST(strides_do_not_matter) {
    struct engine_setup s = cube(300, 0.4, BOUNDARY_HARD);
    struct fault fault = FAULT_NONE;
    start(&s, 77);
    struct engine *e = create(&s), *f = create(&s);
    set(e, x, v);
    set(f, x, v);
    unit_ok(engine_set_drag(e, 0.31, &fault), &fault);
    unit_ok(engine_set_drag(f, 0.31, &fault), &fault);
    unit_ok(engine_advance(e, 8.25, &fault), &fault);
    for (int n = 1; n <= 33; n++)
        unit_ok(engine_advance(f, 0.25 * n, &fault), &fault);
    same_bits(e, f, s.count);
    engine_free(e);
    engine_free(f);
}
END_TEST

/* Few large cells, many small systems, dense and dilute: no overlap is ever found. */
START_TEST(no_overlap_is_found) {
    static const size_t count[] = {2, 3, 9, 30, 111, 700};
    static const double packing[] = {0.02, 0.2, 0.45};
    for (size_t c = 0; c < 6; c++)
        for (size_t p = 0; p < 3; p++)
            for (int side = 0; side < 2; side++) {
                struct engine_setup s = cube(count[c], packing[p], (enum boundary)side);
                if (s.box_m[0] <= 4 * s.radius_m || (side == 1 && count[c] < 100 && p == 2))
                    continue;
                start(&s, 80 + c);
                struct engine *e = create(&s);
                set(e, x, v);
                for (int n = 0; n < 30; n++) {
                    advance(e, 0.7);
                    ck_assert_double_lt(engine_deepest_overlap(e), 1e-12);
                }
                ck_assert_int_gt(engine_tally(e)->collisions + engine_tally(e)->wall_collisions, 0);
                engine_free(e);
            }
}
END_TEST

int main(void) {
    const TTest *tests[] = {energy_and_momentum_stay,
                            time_can_be_reversed,
                            a_rebase_changes_nothing,
                            spheres_collide_as_often_as_enskog_says,
                            a_run_continues_from_a_file_to_the_same_bits,
                            powers_of_two_rescale_to_the_same_bits,
                            strides_do_not_matter,
                            no_overlap_is_found,
                            NULL};
    return unit_run("engine_many", tests);
}
