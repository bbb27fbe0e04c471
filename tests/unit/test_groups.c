/* test_groups.c -- solver/suspension/groups.h: each group from its definition for random
 * numbers, the same in other units, and its limits. */
#include "solver/suspension/groups.h"
#include "tests/unit/unit.h"

#include <gsl/gsl_randist.h>
#include <gsl/gsl_rng.h>
#include <math.h>

static struct suspension_parameters parameters(gsl_rng *rng) {
    struct suspension_parameters v = {.particles = 300 + gsl_rng_uniform_int(rng, 1000),
                                      .radius = gsl_ran_flat(rng, 3e-4, 3e-3),
                                      .mass = gsl_ran_flat(rng, 1e-6, 1e-5),
                                      .restitution = 0.7,
                                      .drag = gsl_ran_flat(rng, 1, 9),
                                      .exponent = gsl_ran_flat(rng, 2.4, 4.65),
                                      .temperature = gsl_ran_flat(rng, 1e-9, 9e-9),
                                      .kick_rate = gsl_ran_flat(rng, 50, 300),
                                      .drive = DRIVE_LINEAR,
                                      .drive_scale = gsl_ran_flat(rng, 0.2, 1),
                                      .gravity = gsl_ran_flat(rng, 1, 10),
                                      .density_contrast = gsl_ran_flat(rng, 0.1, 0.9)};
    for (int a = 0; a < 3; a++)
        v.box[a] = v.radius * gsl_ran_flat(rng, 20, 60);
    return v;
}

/* phi Z of Carnahan and Starling: the pressure over (6/pi d^3) kT. */
static double pressure(double phi) {
    return phi * (1 + phi + phi * phi - phi * phi * phi) / pow(1 - phi, 3);
}

static void expect(double value, double expected, double tolerance) {
    ck_assert_double_eq_tol(value, expected, tolerance * fabs(expected));
}

/* The speed of sound by a centred difference of the pressure: off by h^2/6 of its third
 * derivative and by round-off over h: 1e-7. */
START_TEST(groups_are_as_they_are_defined) {
    gsl_rng *rng = gsl_rng_alloc(gsl_rng_mt19937);
    const double h = 1e-5;
    for (int k = 0; k < 500; k++) {
        struct suspension_parameters v = parameters(rng);
        double phi = gsl_ran_flat(rng, 0.02, 0.6), R = v.radius, T = v.temperature, m = v.mass;
        struct groups g = groups_of(&v, phi);
        double thermal = sqrt(T / m), gamma = v.drag * pow(1 - phi, -v.exponent);
        double weight = m * v.density_contrast * v.gravity; /* (rho_s - rho_f) g pi d^3/6 */
        double b = v.exponent * v.drive_scale * v.gravity * v.density_contrast;
        expect(g.thermal_speed, thermal, 1e-14);
        expect(g.lift, 2 * weight * 2 * R / T, 1e-13);
        expect(g.drag, gamma * R / thermal, 1e-13);
        expect(g.drive, b * R / (T / m), 1e-13);
        expect(g.kick, v.kick_rate * R / thermal, 1e-13);
        double sound = sqrt(T / m * (pressure(phi + h) - pressure(phi - h)) / (2 * h));
        expect(g.stability, phi * (b / (1 - phi)) / gamma / sound, 1e-7);
        double volume = (double)v.particles * 4 * M_PI / 3 * R * R * R;
        expect(g.packing_in_box, volume / (v.box[0] * v.box[1] * v.box[2]), 1e-13);
    }
    gsl_rng_free(rng);
}
END_TEST

/* Metres, seconds and kilograms of any other size leave every group, and change the speed. */
START_TEST(groups_are_the_same_in_other_units) {
    gsl_rng *rng = gsl_rng_alloc(gsl_rng_mt19937);
    for (int k = 0; k < 200; k++) {
        double metre = gsl_ran_flat(rng, 0.1, 9), second = gsl_ran_flat(rng, 0.1, 9);
        double kilogram = gsl_ran_flat(rng, 0.1, 9), phi = gsl_ran_flat(rng, 0.1, 0.6);
        struct suspension_parameters v = parameters(rng), w = v;
        w.radius *= metre;
        w.mass *= kilogram;
        w.drag /= second;
        w.kick_rate /= second;
        w.gravity *= metre / (second * second);
        w.temperature *= kilogram * metre * metre / (second * second);
        for (int a = 0; a < 3; a++)
            w.box[a] *= metre;
        struct groups g = groups_of(&v, phi), f = groups_of(&w, phi);
        expect(f.lift, g.lift, 1e-13);
        expect(f.drag, g.drag, 1e-13);
        expect(f.drive, g.drive, 1e-13);
        expect(f.kick, g.kick, 1e-13);
        expect(f.stability, g.stability, 1e-13);
        expect(f.packing_in_box, g.packing_in_box, 1e-13);
        expect(f.thermal_speed, g.thermal_speed * metre / second, 1e-13);
    }
    gsl_rng_free(rng);
}
END_TEST

START_TEST(without_temperature_or_drag_groups_are_infinite_not_wrong) {
    gsl_rng *rng = gsl_rng_alloc(gsl_rng_mt19937);
    struct suspension_parameters v = parameters(rng);
    v.temperature = 0;
    struct groups g = groups_of(&v, 0.3);
    ck_assert(isinf(g.lift) && isinf(g.drag) && isinf(g.drive) && isinf(g.kick));
    ck_assert(isinf(g.stability) && g.thermal_speed == 0);
    v = parameters(rng);
    v.drag = 0;
    g = groups_of(&v, 0.3);
    ck_assert(isinf(g.stability) && g.drag == 0 && isfinite(g.lift) && isfinite(g.drive));
    gsl_rng_free(rng);
}
END_TEST

int main(void) {
    const TTest *const tests[] = {groups_are_as_they_are_defined,
                                  groups_are_the_same_in_other_units,
                                  without_temperature_or_drag_groups_are_infinite_not_wrong, NULL};
    return unit_run("groups", tests);
}
