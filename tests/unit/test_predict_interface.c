/* test_predict_interface.c -- predictions of beds at rest against their parts. */
#include "tests/unit/unit.h"
#include "validation/bed_rest.h"
#include "validation/prediction.h"
#include "validation/sphere_laws.h"

#include <math.h>

static const double BED[BED_INPUTS + 1] = {0.37,   4.65,   9.7, 0.61, 0.3, 1.7e-9, 2.9,
                                           5.7e-4, 2.3e-6, 9,   9100, 29,  31,     4.9,
                                           0.73,   1,      10,  0,    0.17};

static double at(const char *name, const double *input) {
    const struct prediction *p = prediction_find(name);
    ck_assert_msg(p != NULL, "no prediction %s", name);
    return p->at(input);
}

/* Narrower with a thicker drive, higher with more spheres; the bulk nearly phibar; hot where
 * dilute. */
START_TEST(beds_go_as_their_inputs) {
    double in[BED_INPUTS + 1], narrow;
    memcpy(in, BED, sizeof in);
    double sigma = at("hydrostatic-width", in), height = at("hydrostatic-height", in);
    double flat[] = {9100, 29, 31, 0.37};
    ck_assert_double_eq_tol(at("bed-height", flat), 9100 * 4 * M_PI / 3 / (29 * 31 * 0.37), 1e-9);
    ck_assert_double_eq_tol(height, at("bed-height", flat), 0.03 * height);
    ck_assert_double_eq_tol(at("hydrostatic-bulk", in), 0.37, 0.004);
    ck_assert_double_gt(at("hydrostatic-width-local", in), 1.01 * sigma);
    ck_assert_double_lt(at("hydrostatic-height-local", in), height);
    ck_assert_double_gt(at("hydrostatic-bulk-local", in), at("hydrostatic-bulk", in));
    in[BED_DRIVE_SCALE] *= 2;
    narrow = at("hydrostatic-width", in);
    ck_assert_double_eq_tol(narrow / sigma, 0.5, 0.05);
    in[BED_PHIBAR] = NAN;
    ck_assert_double_nan(at("hydrostatic-width", in));
}
END_TEST

/* The table of docs/theory.md S6 and the ratios that suspension/interface-width expects. */
START_TEST(calibrated_beds_are_those_of_the_theory) {
    static const double sigma[] = {7.40, 7.28, 7.31, 7.44, 7.65, 7.95};
    static const double thinner[] = {1.024, 1.027, 1.031, 1.034, 1.037, 1.040};
    for (int i = 0; i < 6; i++) {
        double in[BED_INPUTS + 1] = {[BED_PHIBAR] = 0.30 + 0.05 * i,
                                     [BED_EXPONENT] = 4.65,
                                     [BED_GRAVITY] = 9.81,
                                     [BED_CONTRAST] = 0.6,
                                     [BED_DRIVE_SCALE] = 0.284,
                                     [BED_THERMAL_J] = 2e-9,
                                     [BED_TEMPERATURE_SCALE] = 2.84,
                                     [BED_RADIUS_M] = 6e-4,
                                     [BED_MASS_KG] = 2.262e-6,
                                     [BED_LAYER_R] = 10,
                                     [BED_PARTICLES] = 1e4,
                                     [BED_WIDTH_X_R] = 30,
                                     [BED_WIDTH_Y_R] = 30,
                                     [BED_DRAG] = 5,
                                     [BED_RESTITUTION] = 0.7,
                                     [BED_WALLS] = 1,
                                     [BED_ABOVE_R] = 10};
        double thick = at("hydrostatic-width", in);
        ck_assert_double_eq_tol(thick, sigma[i], 0.02);
        in[BED_LAYER_R] = 6;
        ck_assert_double_eq_tol(at("hydrostatic-width", in) / thick, thinner[i], 0.0015);
    }
}
END_TEST

/* Kicks give f_dr m s^2 at all packing fractions: drag and collisions at t must take as much. */
START_TEST(temperature_balances_the_powers) {
    double t = at("hydrostatic-temperature", BED), eps = 0.73, taken[2];
    double drag = spheres_drag(4.9, 0.37, 4.65), depth = hydrostatic_depth_R(0.17);
    for (int i = 0; i < 2; i++) {
        double fraction = i ? 0.17 : 0.37, bulk = fraction, warm = (i ? t : 1) * 1.7e-9 * 2.9;
        for (int k = 0; k < 50; k++) {
            depth = hydrostatic_depth_R(bulk);
            bulk = fraction / ((1 - 2 * depth / 29) * (1 - 2 * depth / 31));
        }
        struct spheres_gas g = {bulk, warm, 5.7e-4, 2.3e-6};
        taken[i] = (2 * drag + (1 - eps * eps) / 3 * spheres_collision_rate(&g)) * warm;
    }
    ck_assert_double_eq_tol(taken[0] / taken[1], 1, 1e-9);
    ck_assert_double_gt(t, 1.3);
}
END_TEST

/* Without collisions T/(m gamma); with little drag and eps = 1 the elastic fluid's. */
START_TEST(diffusion_has_both_its_limits) {
    double in[] = {4.9, 0.37, 4.65, 1e-9, 5e-9, 5.7e-4, 2.3e-6, 0.7};
    double gamma = spheres_drag(4.9, 0.37, 4.65);
    ck_assert_double_eq_tol(at("bed-diffusion", in) * gamma * 2.3e-6 / 5e-9, 1, 1e-5);
    in[0] = 1e-7;
    in[3] = 0.37;
    in[7] = 1;
    struct spheres_gas g = {0.37, 5e-9, 5.7e-4, 2.3e-6};
    ck_assert_double_eq_tol(at("bed-diffusion", in) / spheres_diffusion(&g), 1, 1e-6);
    in[7] = 0.6;
    ck_assert_double_eq_tol(at("bed-diffusion", in) / spheres_diffusion(&g), 1 / 0.8, 1e-6);
}
END_TEST

int main(void) {
    const TTest *const tests[] = {beds_go_as_their_inputs, calibrated_beds_are_those_of_the_theory,
                                  temperature_balances_the_powers, diffusion_has_both_its_limits,
                                  NULL};
    return unit_run("predict_interface", tests);
}
