/* test_observe_discs.c -- the discs' pressure from counters of known value, and the virial
 * theorem on one disc whose motion between two walls is worked out by hand. */
#include "tests/unit/fake_run.h"
#include "validation/closures.h"

static const double DT = 0.001;

struct counters {
    double virial, collisions, impulse[4], wall_virial[4], site_virial;
};

enum { NX = 13, NY = 15, SITES = NX * NY };

static void write_frame(struct fake_run *f, size_t n, const double *x, const double *v,
                        double fraction, const struct counters *c, double t) {
    double rho[SITES], virial[SITES];
    for (int k = 0; k < SITES; k++) {
        rho[k] = fraction;
        virial[k] = c->site_virial;
    }
    fake_vectors(f, "particles/grains/position", n, x, t, DT);
    fake_vectors(f, "particles/grains/velocity", n, v, t, DT);
    fake_field(f, "fields/solid_fraction", NX, NY, rho, t, DT);
    fake_field(f, "fields/collision_virial", NX, NY, virial, t, DT);
    fake_scalar(f, "observables/collision_virial", c->virial, t, DT);
    fake_scalar(f, "observables/collisions", c->collisions, t, DT);
    fake_append(f, "observables/wall_impulse", 1, (const size_t[]){4}, c->impulse, t, DT);
    fake_append(f, "observables/wall_virial", 1, (const size_t[]){4}, c->wall_virial, t, DT);
}

static struct fake_run start(void) {
    return fake_start("  width_l: 12\n  height_l: 14\n  dt_tau: 0.001\n");
}

/* W is put in so that Z is that of the virial series, times `wrong`. */
static void measure_fluid(double wrong, struct measurement *m) {
    enum { N = 50 };
    double x[2 * N], v[2 * N], radius[N], eta = 0.43, disc = M_PI * 0.25 * 0.25;
    double speed_square = 0;
    for (int i = 0; i < N; i++) {
        radius[i] = 0.25;
        x[2 * i] = 6 + 5 * sin(1.7 * i);
        x[2 * i + 1] = 7 + 6 * cos(2.3 * i);
        v[2 * i] = 0.5 * sin(3.1 * i);
        v[2 * i + 1] = 0.5 * cos(5.7 * i);
        speed_square += (v[2 * i] * v[2 * i] + v[2 * i + 1] * v[2 * i + 1]) / N;
    }
    double t = 3, temperature = disc * speed_square / 2; /* kT = m <v^2>/2 */
    double z = closure_disc_compressibility(eta) * wrong;
    struct counters c = {0};
    struct fake_run f = start();
    fake_array(&f, "particles/grains/radius", radius, N);
    write_frame(&f, N, x, v, eta * 2 / 3, &c, 1);
    c.site_virial = (z - 1) * 2 * (eta / disc) * temperature * t; /* a site owns 1 l^2 */
    c.collisions = 7 * N;
    write_frame(&f, N, x, v, eta * 2 / 3, &c, 1 + t);
    unit_ok(fake_measure(&f, "disc-pressure", "from_tau", 1, m), &f.fault);
}

START_TEST(compressibility_is_one_plus_the_virial) {
    struct measurement m;
    measure_fluid(1, &m);
    ck_assert_double_eq_tol(fake_value(&m, "disc-pressure", "ratio"), 1, 1e-12);
    ck_assert_double_eq_tol(fake_value(&m, "disc-pressure", "area_fraction"), 0.43, 1e-12);
    ck_assert_double_eq_tol(fake_value(&m, "disc-pressure", "collisions"), 7, 1e-12);
    ck_assert_double_gt(fake_value(&m, "disc-pressure", "identity_error"), 0.1);
    measure_fluid(1.01, &m);
    ck_assert_double_eq_tol(fake_value(&m, "disc-pressure", "ratio"), 1.01, 1e-12);
}
END_TEST

/* One disc flies to and fro along x between the walls: 9 U0, turned back at x = .25
 * and 11.75, first at the right.  Nothing happens along y but for a drift. */
static void measure_shuttle(double lost, struct measurement *m) {
    double mass = M_PI * 0.25 * 0.25, speed = 9, radius = 0.25;
    double x[] = {5.75, 3}, v[] = {speed, 0.5};
    struct counters c = {0};
    struct fake_run f = start();
    fake_array(&f, "particles/grains/radius", &radius, 1);
    write_frame(&f, 1, x, v, 0.2, &c, 0);
    /* 3 tau: 27 l: 6 to the right wall, 11.5 back, 9.5 towards the right again. */
    double impulse = 2 * mass * speed * (1 - lost);
    x[0] = 9.75;
    x[1] = 4.5;
    c.impulse[0] = c.impulse[1] = impulse;
    c.wall_virial[0] = c.wall_virial[1] = impulse * 0.25;
    write_frame(&f, 1, x, v, 0.2, &c, 3);
    unit_ok(fake_measure(&f, "disc-pressure", NULL, 0, m), &f.fault);
}

START_TEST(the_virial_theorem_closes_on_a_disc_between_walls) {
    struct measurement m;
    measure_shuttle(0, &m);
    ck_assert_double_lt(fake_value(&m, "disc-pressure", "identity_error"), 1e-14);
    measure_shuttle(1e-3, &m);
    ck_assert_double_gt(fake_value(&m, "disc-pressure", "identity_error"), 1e-4);
}
END_TEST

START_TEST(discs_of_two_sizes_are_refused) {
    struct counters c = {0};
    struct measurement m;
    double x[] = {5.75, 3, 2, 2}, v[] = {1, 0.5, 1, 1};
    struct fake_run f = start();
    fake_array(&f, "particles/grains/radius", (double[]){0.25, 0.24}, 2);
    write_frame(&f, 2, x, v, 0.2, &c, 0);
    write_frame(&f, 2, x, v, 0.2, &c, 3);
    ck_assert_int_eq(fake_measure(&f, "disc-pressure", NULL, 0, &m), STATUS_BAD_INPUT);
    unit_says(&f.fault, "not of one size");
}
END_TEST

int main(void) {
    const TTest *const tests[] = {compressibility_is_one_plus_the_virial,
                                  the_virial_theorem_closes_on_a_disc_between_walls,
                                  discs_of_two_sizes_are_refused, NULL};
    return unit_run("observe_discs", tests);
}
