/* test_pressure_wave.c -- against the kinematic wave without heat, against an integrated balance of
 * forces at rest. */
#include "tests/unit/unit.h"
#include "validation/hydrostatic.h"
#include "validation/kinematic_wave.h"
#include "validation/pressure_wave.h"
#include "validation/sphere_laws.h"

#include <math.h>

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
                                  impossible_beds_are_refused,
                                  NULL};
    return unit_run("pressure_wave", tests);
}
