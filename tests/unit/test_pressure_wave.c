/* test_pressure_wave.c -- against the kinematic wave without heat, against an integrated balance of
 * forces at rest, and while it moves against lines: central differences, advanced by Runge-Kutta-
 * Fehlberg steps, with neither slopes upstream nor implicit pressure. */
#include "tests/unit/unit.h"
#include "validation/hydrostatic.h"
#include "validation/kinematic_wave.h"
#include "validation/pressure_wave.h"
#include "validation/relaxation_fit.h"
#include "validation/sphere_laws.h"

#include <gsl/gsl_errno.h>
#include <gsl/gsl_odeiv2.h>
#include <math.h>
#include <string.h>

static const double R = 6e-4;

/* The calibrated bed of 1e4 spheres on 30R x 30R. */
static struct bed_change bed(double before, double after, double heat, double layer) {
    return (struct bed_change){.before = before,
                               .after = after,
                               .load_m = 1e4 * 4 * M_PI / 3 * R / 900,
                               .radius_m = R,
                               .restitution = 1,
                               .layer_m = layer * R,
                               .drag_per_s = 5,
                               .exponent = 4.65,
                               .pull_m_per_s2 = 9.81 * 0.6 * 0.284,
                               .heat_m2_per_s2 = heat * 2.84 * 2e-9 / 2.262e-6};
}

static struct pressure_wave *wave_of(const struct bed_change *c, double cell) {
    struct fault fault = FAULT_NONE;
    struct pressure_wave *w;
    unit_ok(pressure_wave_create(c, cell * R, &w, &fault), &fault);
    return w;
}

/* Where pressure and layers vanish, the kinematic wave is left: mean |phi - phi'| over the bed. */
static double against_kinematic(double before, double after, bool full, double heat, double layer) {
    enum { BINS = 200 };
    static double phi[BINS], own[BINS];
    struct fault fault = FAULT_NONE;
    struct bed_change c = bed(before, after, heat, layer);
    struct kinematic_wave *k;
    c.full = full;
    double sum = 0, time = 0.4 * kinematic_wave_end(&c) * (full ? 0.4 : 1);
    struct pressure_wave *w = wave_of(&c, 0.25);
    pressure_wave_change(w);
    unit_ok(pressure_wave_advance(w, time, &fault), &fault);
    unit_ok(kinematic_wave_create(&c, &k, &fault), &fault);
    unit_ok(kinematic_wave_advance(k, time, &fault), &fault);
    pressure_wave_profile(w, R, phi, BINS);
    kinematic_wave_profile(k, R, own, BINS);
    for (int i = 0; i < BINS; i++)
        sum += fabs(phi[i] - own[i]) * R * c.before / c.load_m;
    ck_assert_double_eq_tol(pressure_wave_solid(w), c.load_m, 1e-9 * c.load_m);
    pressure_wave_free(w);
    kinematic_wave_free(k);
    return sum;
}

START_TEST(without_heat_it_is_the_kinematic_wave) {
    const struct {
        double before, after;
        bool full;
    } way[] = {{0.3, 0.55, false}, {0.55, 0.3, false}, {0.3, 0.55, true}, {0.55, 0.3, true}};
    for (int i = 0; i < 4; i++) {
        double before = way[i].before, after = way[i].after;
        double warm = against_kinematic(before, after, way[i].full, 1, 10);
        double cool = against_kinematic(before, after, way[i].full, 0.1, 4);
        double cold = against_kinematic(before, after, way[i].full, 0.01, 2);
        ck_assert_double_lt(cool, 0.5 * warm);
        ck_assert_double_lt(cold, 0.5 * cool);
        ck_assert_double_lt(cold, 0.01);
    }
}
END_TEST

/* At rest: heat d(phi Z)/dz = b' phi (<phi> - phibar), integrated over slabs of the solved profile.
 */
START_TEST(at_rest_pressure_carries_what_the_flow_does_not) {
    enum { BINS = 400 };
    static double phi[BINS];
    struct fault fault = FAULT_NONE;
    struct bed_change c = bed(0.37, 0.3, 1, 10);
    struct pressure_wave *w = wave_of(&c, 0.5);
    unit_ok(pressure_wave_settle(w, &fault), &fault);
    pressure_wave_profile(w, 0.5 * R, phi, BINS);
    double push = spheres_push(4.65, c.pull_m_per_s2, 1, 1, 0.37), force = 0, largest = 0;
    double foot = phi[20] * spheres_compressibility(phi[20]) * c.heat_m2_per_s2;
    for (int i = 21; i < BINS - 20; i++) { /* midpoint to midpoint */
        double mean = 0;
        for (int j = i - 10; j < i + 10; j++)
            mean += phi[j] / 20;
        force += push * (mean - 0.37) * (phi[i - 1] + phi[i]) / 2 * 0.5 * R;
        double pressure = phi[i] * spheres_compressibility(phi[i]) * c.heat_m2_per_s2;
        largest = fmax(largest, fabs(pressure - foot - force));
    }
    ck_assert_double_lt(largest, 0.005 * foot);
    ck_assert_double_gt(fabs(force), 0.9 * foot);
    pressure_wave_free(w);
}
END_TEST

/* After a change it comes to the hydrostatic profile of the new state, solved by another method. */
START_TEST(long_after_a_change_it_is_the_hydrostatic_profile) {
    enum { BINS = 240 };
    static double phi[BINS];
    struct fault fault = FAULT_NONE;
    struct bed_change c = bed(0.35, 0.3, 1, 10);
    c.inertia = true; /* which moves nothing that rests */
    struct pressure_wave *w = wave_of(&c, 0.5);
    unit_ok(pressure_wave_settle(w, &fault), &fault);
    double before = pressure_wave_centre(w);
    pressure_wave_change(w);
    unit_ok(pressure_wave_advance(w, 6, &fault), &fault);
    ck_assert_double_gt(pressure_wave_centre(w), before + 5 * R);
    double push = spheres_push(4.65, c.pull_m_per_s2, 1, 1, 0.3);
    struct hydrostatic_bed rest = {.phibar = 0.3,
                                   .a_R = c.heat_m2_per_s2 / push / R,
                                   .layer_R = 10,
                                   .column_R = c.load_m / R,
                                   .width_R = {30, 30},
                                   .spacing_R = 0.5};
    struct hydrostatic_profile profile;
    unit_ok(hydrostatic_solve(&rest, &profile, &fault), &fault);
    ck_assert_double_eq_tol(profile.spacing_R, 0.5, 1e-12);
    pressure_wave_profile(w, 0.5 * R, phi, BINS);
    for (size_t i = 0; i < profile.count && i < BINS; i++)
        ck_assert_double_eq_tol(phi[i], profile.fraction[i], 0.002);
    hydrostatic_free(&profile);
    pressure_wave_free(w);
}
END_TEST

/* A cold bed all of one speed u starts as u (t - (1 - exp(-gamma t))/gamma); so slow that waves go
 * some 2R meanwhile. */
START_TEST(with_inertia_a_bed_starts_as_its_friction_lets_it) {
    struct fault fault = FAULT_NONE;
    struct bed_change c = bed(0.45, 0.3, 1e-3, 4);
    c.pull_m_per_s2 *= 0.05;
    double gamma = 5 * pow(0.7, -4.65), time = 0.0613, way[2];
    for (int i = 0; i < 2; i++) {
        c.inertia = i;
        struct pressure_wave *w = wave_of(&c, 0.25);
        double start = pressure_wave_centre(w);
        pressure_wave_change(w);
        unit_ok(pressure_wave_advance(w, time, &fault), &fault);
        way[i] = pressure_wave_centre(w) - start;
        ck_assert_double_eq_tol(pressure_wave_solid(w), c.load_m, 1e-9 * c.load_m);
        pressure_wave_free(w);
    }
    ck_assert_double_gt(way[0], 0.3 * R);
    ck_assert_double_eq_tol(way[1] / way[0], 1 - (1 - exp(-gamma * time)) / (gamma * time), 0.015);
}
END_TEST

/* Half the cell: the way of the centre of mass hardly changes. */
START_TEST(cells_of_half_a_radius_are_enough) {
    struct fault fault = FAULT_NONE;
    struct bed_change c = bed(0.55, 0.3, 1, 10);
    double centre[3];
    for (int i = 0; i < 3; i++) {
        struct pressure_wave *w = wave_of(&c, 1.0 / (1 << i));
        unit_ok(pressure_wave_settle(w, &fault), &fault);
        pressure_wave_change(w);
        unit_ok(pressure_wave_advance(w, 0.2, &fault), &fault);
        centre[i] = pressure_wave_centre(w) / R;
        pressure_wave_free(w);
    }
    ck_assert_double_eq_tol(centre[1], centre[2], 0.15);
    ck_assert_double_lt(fabs(centre[1] - centre[2]), 0.7 * fabs(centre[0] - centre[1]));
}
END_TEST

/* -- lines --------------------------------------------------------------------------- */

enum { CELLS = 240, SHOTS = 60 };

/* y: phi of cells of height R, then, with inertia, the flux through the face below each. */
struct lines {
    struct bed_change change;
    double phibar;
};

static double pressure_of(const struct bed_change *c, double phi) {
    double z = (1 + phi + phi * phi - phi * phi * phi) / pow(1 - phi, 3);
    return c->heat_m2_per_s2 * phi * (1 + (1 + c->restitution) / 2 * (z - 1));
}

static int slopes(double time, const double *y, double *slope, void *lines) {
    (void)time;
    const struct lines *l = lines;
    const struct bed_change *c = &l->change;
    double below[CELLS + 1] = {0}, flux[CELLS + 1] = {0};
    int half = (int)(c->layer_m / R / 2 + 0.5);
    for (int i = 0; i < CELLS; i++)
        below[i + 1] = below[i] + y[i];
    for (int f = 1; f < CELLS; f++) {
        int low = f > half ? f - half : 0, high = f + half < CELLS ? f + half : CELLS;
        double mean = (below[high] - below[low]) / (f + half - low);
        double mobility = bed_change_mobility(c, mean, l->phibar);
        flux[f] = (y[f - 1] + y[f]) / 2 * bed_change_speed(c, mean, l->phibar) -
                  mobility * (pressure_of(c, y[f]) - pressure_of(c, y[f - 1])) / R;
        if (c->inertia) {
            slope[CELLS + f] = (flux[f] - y[CELLS + f]) / mobility;
            flux[f] = y[CELLS + f];
        }
    }
    slope[CELLS] = 0;
    for (int i = 0; i < CELLS; i++)
        slope[i] = (flux[i] - flux[i + 1]) / R;
    return GSL_SUCCESS;
}

static const double FORM = 0.09, EVERY = 0.025; /* (s) before the change, between shots */

/* Profiles at the change and every EVERY after it: shot[SHOTS][CELLS]. */
static void shoot_lines(const struct bed_change *c, double (*shot)[CELLS]) {
    struct lines l = {*c, c->before};
    size_t count = c->inertia ? 2 * CELLS : CELLS;
    gsl_odeiv2_system system = {slopes, NULL, count, &l};
    gsl_odeiv2_driver *d =
        gsl_odeiv2_driver_alloc_y_new(&system, gsl_odeiv2_step_rkf45, 1e-5, 1e-7, 0);
    double y[2 * CELLS] = {0}, time = 0;
    for (int i = 0; i < CELLS; i++)
        y[i] = c->before * fmax(0, fmin(1, c->load_m / c->before / R - i));
    ck_assert_int_eq(gsl_odeiv2_driver_apply(d, &time, FORM, y), GSL_SUCCESS);
    l.phibar = c->after;
    gsl_odeiv2_driver_reset(d);
    for (int k = 0; k < SHOTS; k++) {
        if (k > 0)
            ck_assert_int_eq(gsl_odeiv2_driver_apply(d, &time, FORM + k * EVERY, y), GSL_SUCCESS);
        memcpy(shot[k], y, sizeof shot[k]);
    }
    gsl_odeiv2_driver_free(d);
}

static void shoot_wave(const struct bed_change *c, double (*shot)[CELLS]) {
    struct fault fault = FAULT_NONE;
    struct pressure_wave *w = wave_of(c, 0.25);
    unit_ok(pressure_wave_advance(w, FORM, &fault), &fault);
    pressure_wave_change(w);
    for (int k = 0; k < SHOTS; k++) {
        unit_ok(pressure_wave_advance(w, FORM + k * EVERY, &fault), &fault);
        pressure_wave_profile(w, R, shot[k], CELLS);
    }
    pressure_wave_free(w);
}

static struct relaxation_fit fit_of(const double (*shot)[CELLS]) {
    struct fault fault = FAULT_NONE;
    struct relaxation_fit fit;
    double square[SHOTS], length[SHOTS], time[SHOTS], none;
    unit_ok(relaxation_square(shot[0], SHOTS, CELLS, 1, 1, square, &none, &fault), &fault);
    for (int k = 0; k < SHOTS; k++) {
        time[k] = k * EVERY;
        length[k] = relaxation_length(square[k]);
    }
    unit_ok(relaxation_fit(time + 1, length + 1, SHOTS - 1, &fit, &fault), &fault);
    return fit;
}

START_TEST(profiles_and_rates_of_a_change_are_those_of_lines) {
    static double wave[SHOTS][CELLS], line[SHOTS][CELLS];
    const struct {
        double before, after;
        bool inertia, full;
        double apart; /* share of the solid; more where a top runs ahead, a few cells wide */
    } step[] = {{0.35, 0.3, true, false, 0.004},
                {0.3, 0.55, false, false, 0.004},
                {0.55, 0.3, true, false, 0.03},
                {0.47, 0.33, false, true, 0.004}};
    for (size_t i = 0; i < sizeof step / sizeof *step; i++) {
        struct bed_change c = bed(step[i].before, step[i].after, 1, 10);
        c.restitution = 0.7;
        c.inertia = step[i].inertia;
        c.full = step[i].full;
        shoot_wave(&c, wave);
        shoot_lines(&c, line);
        for (int k = 0; k < SHOTS; k++) {
            double apart = 0;
            for (int j = 0; j < CELLS; j++)
                apart += fabs(wave[k][j] - line[k][j]) * R / c.load_m;
            ck_assert_double_lt(apart, step[i].apart);
        }
        struct relaxation_fit ours = fit_of(wave), theirs = fit_of(line);
        ck_assert_double_eq_tol(ours.rate_per_s, theirs.rate_per_s, 0.006 * theirs.rate_per_s);
        ck_assert_double_eq_tol(ours.plateau, theirs.plateau, 0.003 * theirs.plateau);
    }
}
END_TEST

START_TEST(impossible_beds_are_refused) {
    struct fault fault = FAULT_NONE;
    struct bed_change c = bed(0.35, 0.3, 1, 10);
    struct pressure_wave *w;
    ck_assert_int_eq(pressure_wave_create(&c, 1e-9, &w, &fault), STATUS_BAD_INPUT);
    ck_assert_ptr_null(w);
    unit_says(&fault, "in cells of");
    pressure_wave_free(NULL);
}
END_TEST

int main(void) {
    const TTest *const tests[] = {without_heat_it_is_the_kinematic_wave,
                                  at_rest_pressure_carries_what_the_flow_does_not,
                                  long_after_a_change_it_is_the_hydrostatic_profile,
                                  with_inertia_a_bed_starts_as_its_friction_lets_it,
                                  cells_of_half_a_radius_are_enough,
                                  profiles_and_rates_of_a_change_are_those_of_lines,
                                  impossible_beds_are_refused,
                                  NULL};
    return unit_run("pressure_wave", tests);
}
