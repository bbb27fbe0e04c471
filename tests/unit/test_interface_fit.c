/* test_interface_fit.c -- planted error functions, with and without noise. */
#include "common/random.h"
#include "tests/unit/unit.h"
#include "validation/interface_fit.h"

#include <gsl/gsl_cdf.h>
#include <gsl/gsl_randist.h>
#include <math.h>

enum { COUNT = 700, TRIALS = 300 };
static const double STEP_R = 0.23, NOISE = 0.0061;

/* Layers below 6 R, then a step of this plateau smeared by a normal distribution. */
static void plant(double plateau, double height, double sigma, double *z, double *phi) {
    for (int i = 0; i < COUNT; i++) {
        z[i] = (i + 0.5) * STEP_R;
        phi[i] = plateau * gsl_cdf_gaussian_P(height - z[i], sigma) +
                 (z[i] < 6 ? 0.7 * exp(-z[i]) * cos(3.1 * z[i]) : 0);
    }
}

START_TEST(a_smeared_step_is_found_to_round_off) {
    static const double sigma[] = {0.61, 2.97, 11.3};
    double z[COUNT], phi[COUNT];
    struct fault fault = FAULT_NONE;
    struct interface_fit fit;
    for (int i = 0; i < 3; i++)
        for (int plateau_free = 0; plateau_free < 2; plateau_free++) {
            plant(0.437, 97.3, sigma[i], z, phi);
            struct interface_window w = {8.1, plateau_free ? 0.41 : 0.437, plateau_free};
            unit_ok(interface_fit(z, phi, COUNT, &w, &fit, &fault), &fault);
            ck_assert_double_eq_tol(fit.sigma_R, sigma[i], 1e-7);
            ck_assert_double_eq_tol(fit.height_R, 97.3, 1e-7);
            ck_assert_double_eq_tol(fit.plateau, 0.437, 1e-8);
            ck_assert_double_lt(fit.rms, 1e-8);
            ck_assert_double_eq_tol(interface_fit_at(&fit, 97.3), 0.437 / 2, 1e-8);
        }
}
END_TEST

/* Two of three fits of independent noise hold the truth within their error, and
 * their scatter is that error: 300 fits, sigma known to 4 %, shares to 2.7 %. */
START_TEST(errors_cover_the_truth_as_often_as_they_say) {
    double z[COUNT], clean[COUNT], phi[COUNT], covered[2] = {0}, square[2] = {0}, said[2] = {0};
    gsl_rng *rng;
    struct fault fault = FAULT_NONE;
    struct interface_fit fit;
    unit_ok(random_stream(417, "noise", &rng, &fault), &fault);
    plant(0.352, 88.1, 6.13, z, clean);
    for (int t = 0; t < TRIALS; t++) {
        for (int i = 0; i < COUNT; i++)
            phi[i] = clean[i] + gsl_ran_gaussian(rng, NOISE);
        struct interface_window w = {9.7, 0.352, false};
        unit_ok(interface_fit(z, phi, COUNT, &w, &fit, &fault), &fault);
        double off[] = {fit.sigma_R - 6.13, fit.height_R - 88.1};
        double error[] = {fit.sigma_error_R, fit.height_error_R};
        for (int k = 0; k < 2; k++) {
            covered[k] += fabs(off[k]) < error[k];
            square[k] += off[k] * off[k] / TRIALS;
            said[k] += error[k] / TRIALS;
        }
        ck_assert_double_eq_tol(fit.rms, NOISE, 0.15 * NOISE);
    }
    for (int k = 0; k < 2; k++) {
        ck_assert_double_eq_tol(covered[k] / TRIALS, 0.683, 0.08);
        ck_assert_double_eq_tol(sqrt(square[k]) / said[k], 1, 0.13);
    }
    gsl_rng_free(rng);
}
END_TEST

/* The foot is 2 % of what a fit of all heights sees; left in, it moves the edge. */
START_TEST(the_foot_is_left_out) {
    double z[COUNT], phi[COUNT];
    struct fault fault = FAULT_NONE;
    struct interface_fit with, without;
    plant(0.31, 57.7, 5.2, z, phi);
    struct interface_window all = {0, 0.31, true}, above = {6.2, 0.31, true};
    unit_ok(interface_fit(z, phi, COUNT, &all, &with, &fault), &fault);
    unit_ok(interface_fit(z, phi, COUNT, &above, &without, &fault), &fault);
    ck_assert_double_gt(fabs(with.plateau - 0.31), 1e-4);
    ck_assert_double_eq_tol(without.plateau, 0.31, 1e-8);
    ck_assert_uint_eq(with.used - without.used, 27); /* .115, .345, .. 6.095 */
}
END_TEST

/* A bulk that bends down towards the edge is worst fitted where it does. */
START_TEST(the_shoulder_is_told_apart) {
    double z[COUNT], phi[COUNT];
    struct fault fault = FAULT_NONE;
    struct interface_fit fit;
    plant(0.47, 101.3, 4.1, z, phi);
    for (int i = 0; i < COUNT; i++)
        phi[i] -= z[i] < 101.3 ? 0.05 * exp((z[i] - 101.3) / 12.7) : 0;
    struct interface_window w = {9, 0.47, false};
    unit_ok(interface_fit(z, phi, COUNT, &w, &fit, &fault), &fault);
    ck_assert_double_gt(fit.shoulder_rms, 1.5 * fit.rms);
    ck_assert_double_gt(fit.sigma_R, 4.5);
}
END_TEST

START_TEST(what_has_no_interface_is_refused) {
    double z[COUNT], phi[COUNT];
    struct fault fault = FAULT_NONE;
    struct interface_fit fit;
    plant(0.31, 57.7, 5.2, z, phi);
    struct interface_window w = {90, 0.31, false};
    ck_assert_int_eq(interface_fit(z, phi, COUNT, &w, &fit, &fault), STATUS_BAD_INPUT);
    unit_says(&fault, "does not cross half of 0.31");
    w.above_R = (COUNT - 5) * STEP_R;
    ck_assert_int_eq(interface_fit(z, phi, COUNT, &w, &fit, &fault), STATUS_BAD_INPUT);
    unit_says(&fault, "an interface needs 8");
}
END_TEST

/* Counts of spheres in slabs of STEP_R, 2.4 to a slab in the bulk, as few hundred spheres leave
 * them. */
static void scatter_counts(gsl_rng *rng, const double *clean, double plateau, double *phi) {
    for (int i = 0; i < COUNT; i++)
        phi[i] = gsl_ran_poisson(rng, 2.4 * fmax(clean[i], 0) / plateau) * plateau / 2.4;
}

/* The least squares of a noisy step fall towards sigma = 0: such an edge is called sharp, and has
 * its height all the same, to the few slabs that noise leaves. */
START_TEST(an_edge_sharper_than_its_slabs_is_a_step) {
    double z[COUNT], clean[COUNT], phi[COUNT], off = 0, mean = 0;
    int sharp = 0;
    gsl_rng *rng;
    struct fault fault = FAULT_NONE;
    struct interface_fit fit;
    unit_ok(random_stream(5315, "noise", &rng, &fault), &fault);
    plant(0.293, 117.19, 1e-3, z, clean);
    struct interface_window w = {9.7, 0.293, false};
    unit_ok(interface_fit(z, clean, COUNT, &w, &fit, &fault), &fault);
    ck_assert(fit.sharp);
    ck_assert_double_eq_tol(fit.height_R, 117.19, STEP_R / 2);
    ck_assert_double_eq_tol(fit.height_error_R, STEP_R / sqrt(12), 1e-12);
    ck_assert_double_lt(fit.rms, 1e-7);
    ck_assert_double_eq(interface_fit_at(&fit, 117), 0.293);
    ck_assert_double_eq(interface_fit_at(&fit, 118), 0);
    for (int t = 0; t < TRIALS; t++) {
        scatter_counts(rng, clean, 0.293, phi);
        unit_ok(interface_fit(z, phi, COUNT, &w, &fit, &fault), &fault);
        sharp += fit.sharp;
        ck_assert_double_eq(fit.sigma_R, fit.sharp ? 0 : fit.sigma_R);
        mean += fit.sigma_R / TRIALS;
        off += (fit.height_R - 117.19) / TRIALS;
    }
    ck_assert_int_gt(sharp, TRIALS / 2);
    ck_assert_double_eq_tol(off, 0, STEP_R);
    ck_assert_double_lt(mean, 0.7);
    gsl_rng_free(rng);
}
END_TEST

/* The same noise on a wide edge has many small steps to fall into; none of them is taken. */
START_TEST(a_wide_edge_is_no_step_of_its_noise) {
    double z[COUNT], clean[COUNT], phi[COUNT], mean = 0;
    gsl_rng *rng;
    struct fault fault = FAULT_NONE;
    struct interface_fit fit;
    unit_ok(random_stream(71, "noise", &rng, &fault), &fault);
    plant(0.293, 117.19, 6.4, z, clean);
    for (int t = 0; t < TRIALS; t++) {
        struct interface_window w = {9.7, 0.293, t % 2 == 1};
        scatter_counts(rng, clean, 0.293, phi);
        unit_ok(interface_fit(z, phi, COUNT, &w, &fit, &fault), &fault);
        ck_assert(!fit.sharp);
        ck_assert_double_gt(fit.sigma_R, 1);
        mean += fit.sigma_R / TRIALS;
    }
    ck_assert_double_eq_tol(mean, 6.4, 0.3);
    gsl_rng_free(rng);
}
END_TEST

int main(void) {
    const TTest *const tests[] = {a_smeared_step_is_found_to_round_off,
                                  errors_cover_the_truth_as_often_as_they_say,
                                  the_foot_is_left_out,
                                  the_shoulder_is_told_apart,
                                  what_has_no_interface_is_refused,
                                  an_edge_sharper_than_its_slabs_is_a_step,
                                  a_wide_edge_is_no_step_of_its_noise,
                                  NULL};
    return unit_run("interface_fit", tests);
}
