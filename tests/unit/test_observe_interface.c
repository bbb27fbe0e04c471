/* test_observe_interface.c -- beds of planted profiles: width, foot, temperatures, formation. */
#include "common/random.h"
#include "tests/unit/spheres_fixture.h"
#include "validation/bed_rest.h"

#include <gsl/gsl_cdf.h>
#include <gsl/gsl_randist.h>

enum { N = 1700, BINS = 520, FRAMES = 60 };
static const double R = 6e-4, SIDE[] = {13, 14, 130}, STEP_S = 0.017, T_J = 1.3 * 1.7e-9;

static const char PARAMETERS[] =
    "  gravity_m_per_s2: 9.7\n  density_contrast: 0.61\n  drive_scale: 0.3\n"
    "  layer_R: 9\n  restitution: 0.73\n";

static void profile(struct fake_run *f, const char *name, const double *value, double time_s) {
    char path[64];
    size_t bins = BINS;
    snprintf(path, sizeof path, "profiles/%s", name);
    fake_append(f, path, 1, &bins, value, time_s, 1.0 / SPHERES_STEP_PER_S);
}

/* 37 %, edge and sigma as given; a foot at 1.1 R; one temperature; noise of the counts. */
static void frame_at(struct fake_run *f, gsl_rng *rng, double edge, double sigma, double time_s) {
    static double phi[BINS], xy[BINS], zz[BINS];
    for (int k = 0; k < BINS; k++) {
        double z = (k + 0.5) * 0.25;
        phi[k] = 0.37 * gsl_cdf_gaussian_P(edge - z, sigma) + gsl_ran_gaussian(rng, 0.01);
        phi[k] += k == 4 ? 1.1 : 0;
        xy[k] = 0.91 * T_J;
        zz[k] = 0.94 * T_J;
    }
    profile(f, "packing_fraction", phi, time_s);
    profile(f, "temperature_xy", xy, time_s);
    profile(f, "temperature_zz", zz, time_s);
    spheres_list(f, "centre_of_mass", 3, (const double[]){0, 0, (50 + 2 * time_s) * R}, time_s);
    spheres_counter(f, "collisions", 211.0 * N * time_s / 2, time_s);
}

static void frame(struct fake_run *f, gsl_rng *rng, double sigma, double time_s) {
    frame_at(f, rng, 103, sigma, time_s);
}

static struct fake_run bed(double formed_s) {
    struct fault fault = FAULT_NONE;
    gsl_rng *rng;
    unit_ok(random_stream(31, "bed", &rng, &fault), &fault);
    struct fake_run f = spheres_start(N, R, SIDE, "hard", PARAMETERS);
    for (int n = 0; n < FRAMES; n++)
        frame(&f, rng, n * STEP_S < formed_s ? 0.7 + 4.6 * n * STEP_S / formed_s : 5.3, n * STEP_S);
    gsl_rng_free(rng);
    return f;
}

/* 60 frames of noise .01 in 480 slabs: sigma to .01 R, the plateau's rms .01/sqrt(60). */
START_TEST(an_edge_is_measured_as_planted) {
    struct fake_run f = bed(0);
    struct measurement m;
    unit_ok(fake_measure(&f, "bed-interface", "blocks", 6, &m), &f.fault);
    const char *r = "bed-interface";
    ck_assert_double_eq_tol(fake_value(&m, r, "sigma"), 5.3, 0.05);
    ck_assert_double_eq_tol(fake_value(&m, r, "height"), 103, 0.05);
    ck_assert_double_eq(fake_value(&m, r, "plateau"), 0.37);
    ck_assert_double_eq_tol(fake_value(&m, r, "fit_rms"), 0.01 / sqrt(FRAMES), 3e-4);
    ck_assert_double_eq_tol(fake_value(&m, r, "shoulder_ratio"), 1, 0.25);
    ck_assert_double_eq_tol(fake_value(&m, r, "bulk"), 0.37, 0.001);
    ck_assert_double_eq_tol(fake_value(&m, r, "bottom_peak"), 1.47, 0.01);
    ck_assert_double_eq_tol(fake_value(&m, r, "peak_height"), 1.125, 1e-12);
    ck_assert_double_eq_tol(fake_value(&m, r, "temperature"), 0.92 * T_J, 1e-9 * T_J);
    ck_assert_double_eq_tol(fake_value(&m, r, "temperature_zz"), 0.94 * T_J, 1e-9 * T_J);
    ck_assert_double_eq_tol(fake_value(&m, r, "collision_rate"), 211, 1e-6);
    ck_assert_double_eq_tol(fake_value(&m, r, "drift"), 2 * 30 * STEP_S, 1e-6);
    ck_assert_double_eq(fake_value(&m, r, "walls"), 1);
    double error = fake_value(&m, r, "sigma_error"); /* of 60 frames; 10 a block */
    ck_assert_double_gt(error, 0.003);
    ck_assert_double_lt(error, 0.05);
    ck_assert_uint_eq(m.curve_count, 6);
    measurement_free(&m);
}
END_TEST

/* With .94 T everywhere the balanced profile is that of .94 T and inelastic collisions. */
START_TEST(measured_temperatures_are_balanced) {
    struct fake_run f = bed(0);
    struct measurement m;
    unit_ok(fake_measure(&f, "bed-interface", NULL, 0, &m), &f.fault);
    double in[BED_INPUTS] = {0.37, 4.65, 9.7, 0.61, 0.3, 0.94 * 1.7e-9, 1.3, R,  2.3e-6,
                             9,    N,    13,  14,   4.9, 0.73,          1,   10, 0};
    double fraction[8], one[8];
    for (int i = 0; i < 8; i++) {
        fraction[i] = 0.01 + 0.045 * i;
        one[i] = 1;
    }
    struct bed_rest_measured t = {fraction, one, one, 8};
    struct hydrostatic_profile p;
    struct interface_fit fit;
    unit_ok(bed_rest_balance(in, &t, &p, &f.fault), &f.fault);
    unit_ok(bed_rest_fit(in, &p, &fit, &f.fault), &f.fault);
    hydrostatic_free(&p);
    ck_assert_double_eq_tol(fake_value(&m, "bed-interface", "balanced_sigma"), fit.sigma_R, 1e-3);
    ck_assert_double_eq_tol(fake_value(&m, "bed-interface", "balance"), 5.3 / fit.sigma_R, 0.02);
    measurement_free(&m);
    t.count = 7;
    ck_assert_int_eq(bed_rest_balance(in, &t, &p, &f.fault), STATUS_BAD_INPUT);
    unit_says(&f.fault, "7 temperatures are too few");
}
END_TEST

/* An edge that widens evenly until .4 s is nine tenths there at .36 s, and settled by .4 s. */
START_TEST(formation_ends_when_it_does) {
    struct fake_run f = bed(0.4);
    struct measurement m;
    unit_ok(fake_measure(&f, "bed-formation", "settled_s", 0.6, &m), &f.fault);
    const char *r = "bed-formation";
    ck_assert_double_eq_tol(fake_value(&m, r, "settled_sigma"), 5.3, 0.1);
    ck_assert_double_eq_tol(fake_value(&m, r, "sigma_time"), (0.9 * 5.3 - 0.7) / 4.6 * 0.4, 0.04);
    ck_assert_double_gt(fake_value(&m, r, "time"), 0.2);
    ck_assert_double_lt(fake_value(&m, r, "time"), 0.44);
    double collisions = 211 * fake_value(&m, r, "time");
    ck_assert_double_eq_tol(fake_value(&m, r, "collisions_per_particle"), collisions, 211 * STEP_S);
    measurement_free(&m);
    f = bed(0.4);
    ck_assert_int_eq(fake_measure(&f, "bed-formation", "settled_s", 0.95, &m), STATUS_BAD_INPUT);
    unit_says(&f.fault, "four blocks");
}
END_TEST

/* A bed that is empty above 10 R has no edge: widths and heights say so, all else is told. */
START_TEST(a_run_without_an_interface_says_so) {
    struct fault fault = FAULT_NONE;
    gsl_rng *rng;
    unit_ok(random_stream(31, "bed", &rng, &fault), &fault);
    for (int recipe = 0; recipe < 2; recipe++) {
        struct fake_run f = spheres_start(N, R, SIDE, "hard", PARAMETERS);
        struct measurement m;
        const char *r = recipe ? "bed-formation" : "bed-interface";
        for (int n = 0; n < FRAMES; n++)
            frame_at(&f, rng, 8.7, 0.6, n * STEP_S);
        unit_ok(fake_measure(&f, r, recipe ? "settled_s" : NULL, 0.6, &m), &f.fault);
        ck_assert(isnan(fake_value(&m, r, recipe ? "settled_sigma" : "sigma")));
        ck_assert(isnan(fake_value(&m, r, recipe ? "sigma_time" : "height_error")));
        ck_assert_ptr_nonnull(strstr(m.reason, "does not cross half"));
        if (recipe)
            ck_assert_double_gt(fake_value(&m, r, "floor"), 0);
        else
            ck_assert_double_eq_tol(fake_value(&m, r, "peak_height"), 1.125, 1e-12);
        measurement_free(&m);
    }
    gsl_rng_free(rng);
}
END_TEST

/* Edges of the first frames may be sharper than the slabs of R/4: they have a width of 0. */
START_TEST(a_sharp_start_counts_as_no_width) {
    struct fault fault = FAULT_NONE;
    gsl_rng *rng;
    unit_ok(random_stream(37, "bed", &rng, &fault), &fault);
    struct fake_run f = spheres_start(N, R, SIDE, "hard", PARAMETERS);
    struct measurement m;
    for (int n = 0; n < FRAMES; n++)
        frame(&f, rng, n < 10 ? 1e-4 : 5.3, n * STEP_S);
    unit_ok(fake_measure(&f, "bed-formation", "settled_s", 0.6, &m), &f.fault);
    const char *r = "bed-formation";
    ck_assert_double_eq_tol(fake_value(&m, r, "sigma_time"), 9.5 * STEP_S, STEP_S);
    ck_assert_double_eq(m.curve[0].y[0], 0);
    measurement_free(&m);
}
END_TEST

int main(void) {
    const TTest *const tests[] = {
        an_edge_is_measured_as_planted,   measured_temperatures_are_balanced,
        formation_ends_when_it_does,      a_run_without_an_interface_says_so,
        a_sharp_start_counts_as_no_width, NULL};
    return unit_run("observe_interface", tests);
}
