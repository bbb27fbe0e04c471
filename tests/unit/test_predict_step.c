/* test_predict_step.c -- times and rates after a change of phibar, against physics' own figures. */
#include "tests/unit/unit.h"
#include "validation/prediction.h"

#include <math.h>
#include <stdbool.h>

/* FZ's bed of 1e4 spheres: as stated on 16R x 16R, or calibrated on 30R x 30R. */
static double at(const char *name, bool calibrated, double before, double after) {
    const struct prediction *p = prediction_find(name);
    ck_assert_msg(p != NULL, "no prediction %s", name);
    double width = calibrated ? 30 : 16, scale = calibrated ? 0.284 : 1;
    const struct {
        const char *name;
        double value;
    } known[] = {{"drag_per_s", 5},
                 {"exponent", 4.65},
                 {"gravity_m_per_s2", 9.81},
                 {"density_contrast", 0.6},
                 {"drive_scale", scale},
                 {"particles", 1e4},
                 {"width_x_R", width},
                 {"width_y_R", width},
                 {"radius_m", 6e-4},
                 {"phibar", before},
                 {"phibar_values", after},
                 {"thermal_energy_J", 2e-9},
                 {"temperature_scale", calibrated ? 2.84 : 1},
                 {"mass_kg", 2.262e-6},
                 {"layer_R", 10},
                 {"restitution", 0.7},
                 {"window_s", 0}};
    double input[PREDICTION_MAX_INPUTS] = {0};
    for (size_t i = 0; p->input[i]; i++) {
        size_t k = 0;
        while (k < sizeof known / sizeof *known && strcmp(known[k].name, p->input[i]) != 0)
            k++;
        ck_assert_msg(k < sizeof known / sizeof *known, "no value of %s", p->input[i]);
        input[i] = known[k].value;
    }
    return p->at(input);
}

START_TEST(kinematic_times_are_known) {
    ck_assert_double_eq_tol(at("kinematic-end-time", false, 0.3, 0.55), 2.0, 0.01);
    ck_assert_double_eq_tol(at("kinematic-end-time", true, 0.3, 0.55), 2.0, 0.01);
    ck_assert_double_eq_tol(at("kinematic-end-time", false, 0.55, 0.3), 0.733, 0.001);
    ck_assert_double_eq_tol(at("kinematic-time-90", false, 0.3, 0.55), 1.37, 0.005);
    ck_assert_double_eq_tol(at("kinematic-time-90", false, 0.55, 0.3), 0.33, 0.006);
    ck_assert_double_eq_tol(at("kinematic-full-time-90", false, 0.3, 0.55), 0.53, 0.006);
    ck_assert_double_eq_tol(at("kinematic-full-time-90", false, 0.55, 0.3), 0.52, 0.006);
    /* g'/gamma(.3) */
    ck_assert_double_eq_tol(at("external-velocity", false, 0.3, 0.3), 5.886 / 5 * pow(0.7, 4.65),
                            1e-12);
}
END_TEST

/* Pressure delays both ways at the end; inertia the start of expansion, which then coasts. */
START_TEST(pressure_and_inertia_change_times_as_they_should) {
    double cold = at("pressure-time-90", false, 0.3, 0.55);
    ck_assert_double_eq_tol(cold, at("kinematic-time-90", false, 0.3, 0.55), 0.01);
    ck_assert_double_gt(at("pressure-time-90", true, 0.3, 0.55), 1.05 * cold);
    double slow = at("pressure-time-90", true, 0.55, 0.3);
    double coasting = at("inertial-time-90", true, 0.55, 0.3);
    ck_assert_double_lt(coasting, 0.85 * slow);
    ck_assert_double_gt(coasting, at("kinematic-time-90", true, 0.55, 0.3) + 0.04);
    ck_assert_double_gt(at("inertial-time-98", true, 0.55, 0.3), coasting);
    ck_assert_double_eq_tol(at("inertial-time-90", true, 0.3, 0.55),
                            at("pressure-time-90", true, 0.3, 0.55), 0.01);
    ck_assert_double_eq_tol(at("inertial-meeting-time", true, 0.3, 0.55), 1.91, 0.02);
    ck_assert_double_lt(at("inertial-full-time-90", true, 0.3, 0.55),
                        0.6 * at("inertial-time-90", true, 0.3, 0.55));
}
END_TEST

START_TEST(rates_fall_with_phibar_in_every_theory) {
    static const char *const name[] = {"kinematic-relaxation-rate", "pressure-relaxation-rate",
                                       "inertial-relaxation-rate"};
    for (int i = 0; i < 3; i++) {
        double last = INFINITY;
        for (int k = 0; k < 5; k += 2) {
            double rate = at(name[i], true, 0.35 + 0.05 * k, 0.30 + 0.05 * k);
            ck_assert_double_lt(rate, last);
            ck_assert_double_gt(rate, 2);
            last = rate;
        }
    }
}
END_TEST

START_TEST(what_is_no_bed_has_no_time) {
    ck_assert(isnan(at("kinematic-time-90", true, 0.3, 0.3)));
    ck_assert(isnan(at("inertial-time-90", true, 0.3, 0.8)));
    ck_assert(isnan(at("pressure-relaxation-rate", true, -0.1, 0.3)));
}
END_TEST

int main(void) {
    const TTest *const tests[] = {
        kinematic_times_are_known, pressure_and_inertia_change_times_as_they_should,
        rates_fall_with_phibar_in_every_theory, what_is_no_bed_has_no_time, NULL};
    return unit_run("predict_step", tests);
}
