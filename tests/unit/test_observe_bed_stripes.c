/* test_observe_bed_stripes.c -- planted waves that travel and grow with height, planted noise. */
#include "tests/unit/spheres_fixture.h"

#include "common/random.h"

#include <gsl/gsl_randist.h>

enum { BINS = 620, SAMPLES = 41 };
static const double R = 6.1e-4, SIDE[] = {31, 29, 155}, STEP = 0.0073;

static void plant(struct fake_run *f, const double *profile, double time) {
    size_t bins = BINS;
    fake_append(f, "profiles/packing_fraction", 1, &bins, profile, time, 1e-6);
    spheres_counter(f, "temperature_xy", 1.9e-9, time);
}

static enum status seek(struct fake_run *f, double to_R, double smooth_R, struct measurement *m) {
    const struct recipe *r = recipe_find("bed-stripes");
    double settings[RECIPE_MAX_SETTINGS] = {0};
    for (size_t i = 0; r->setting[i].name; i++)
        settings[i] = r->setting[i].standard;
    settings[fake_setting_index(r, "from_R")] = 12;
    settings[fake_setting_index(r, "to_R")] = to_R;
    settings[fake_setting_index(r, "smooth_R")] = smooth_R;
    struct run_view *v = fake_open(f);
    *m = (struct measurement){0};
    enum status status = r->measure(v, settings, m, &f->fault);
    run_view_close(v);
    unit_remove(f->folder);
    return status;
}

static double got(const struct measurement *m, const char *output) {
    return fake_value(m, "bed-stripes", output);
}

/* phi (1 + a(z) cos(k (z - c t))) with the amplitude rising along z. */
static struct measurement travelling(double speed_R_per_s, double rise_per_R) {
    struct fake_run f = spheres_start(10007, R, SIDE, "hard", "");
    double profile[BINS];
    for (int n = 0; n < SAMPLES; n++) {
        for (int i = 0; i < BINS; i++) {
            double z = (i + 0.5) * SIDE[2] / BINS, t = n * STEP;
            profile[i] = 0.31 * (1 + (0.11 + rise_per_R * z) *
                                         cos(2 * M_PI / 21.7 * (z - speed_R_per_s * t)));
        }
        plant(&f, profile, n * STEP);
    }
    struct measurement m;
    unit_ok(seek(&f, 140, 0.25, &m), &f.fault);
    return m;
}

START_TEST(speed_direction_and_spacing_of_planted_stripes_are_found) {
    for (int sign = -1; sign <= 1; sign += 2) {
        struct measurement m = travelling(sign * 173.0, 0);
        ck_assert_double_eq_tol(got(&m, "speed"), sign * 173 * R, 0.006 * 173 * R);
        ck_assert_double_eq_tol(got(&m, "contrast"), 0.11 / M_SQRT2, 0.02 * 0.11);
        ck_assert_double_eq_tol(got(&m, "packing_fraction"), 0.31, 0.001);
        ck_assert_double_eq_tol(got(&m, "densest"), 0.31 * 1.11, 0.002);
        ck_assert_double_eq_tol(got(&m, "spacing"), 21.7, 2.2);
        ck_assert_double_gt(got(&m, "likeness"), 0.95);
        ck_assert_double_eq_tol(got(&m, "rise"), 1, 0.03);
        ck_assert_double_eq_tol(got(&m, "temperature"), 1.9e-9, 1e-20);
        measurement_free(&m);
    }
}
END_TEST

START_TEST(a_wave_that_grows_with_height_rises) {
    struct measurement m = travelling(173, 0.0013);
    /* Mean squares of .11 + .0013 z over 12 to 76 R and 76 to 140 R: .1682 and .2510. */
    ck_assert_double_eq_tol(got(&m, "rise"), 0.2510 / 0.1682, 0.03);
    /* ln (.11 + .0013 z) by least squares over 12 to 140 R, from its integrals. */
    double sum = 0, moment = 0, square = 0;
    for (double z = 12.05; z < 140; z += 0.1) {
        sum += log(0.11 + 0.0013 * z) * (z - 76);
        moment += z - 76;
        square += (z - 76) * (z - 76);
    }
    ck_assert_double_eq_tol(moment, 0, 1e-6);
    ck_assert_double_eq_tol(got(&m, "slope"), sum / square, 0.02 * sum / square);
    ck_assert_double_gt(got(&m, "upper"), got(&m, "contrast"));
    ck_assert_double_lt(got(&m, "lower"), got(&m, "contrast"));
    measurement_free(&m);
}
END_TEST

/* Noise of a fluid at rest: in each slab a variance of S/n, in slices of many slabs that over
 * their number.  No stripe is alike a moment later. */
START_TEST(noise_of_a_still_fluid_has_no_excess) {
    struct fake_run f = spheres_start(10007, R, SIDE, "hard", "");
    gsl_rng *noise;
    unit_ok(random_stream(4711, "stripes", &noise, &f.fault), &f.fault);
    double profile[BINS], p = 0.31, slab = SIDE[2] / BINS;
    double n = p * SIDE[0] * SIDE[1] * slab / (4 * M_PI / 3);
    double stiffness = (1 + 4 * p + 4 * p * p - 4 * p * p * p + p * p * p * p) / pow(1 - p, 4);
    for (int t = 0; t < SAMPLES; t++) {
        for (int i = 0; i < BINS; i++)
            profile[i] = p * (1 + gsl_ran_ugaussian(noise) / sqrt(n * stiffness));
        plant(&f, profile, t * STEP);
    }
    gsl_rng_free(noise);
    struct measurement m;
    unit_ok(seek(&f, 140, 9.25, &m), &f.fault);
    ck_assert_double_eq_tol(got(&m, "excess"), 1, 0.08);
    ck_assert_double_lt(got(&m, "likeness"), 0.3);
    measurement_free(&m);
}
END_TEST

START_TEST(too_few_slabs_are_a_fault) {
    struct fake_run f = spheres_start(10007, R, SIDE, "hard", "");
    double profile[BINS] = {0};
    for (int n = 0; n < SAMPLES; n++)
        plant(&f, profile, n * STEP);
    struct measurement m;
    ck_assert_int_eq(seek(&f, 15, 1, &m), STATUS_BAD_INPUT);
    unit_says(&f.fault, "16 slabs");
}
END_TEST

int main(void) {
    const TTest *const tests[] = {speed_direction_and_spacing_of_planted_stripes_are_found,
                                  a_wave_that_grows_with_height_rises,
                                  noise_of_a_still_fluid_has_no_excess, too_few_slabs_are_a_fault,
                                  NULL};
    return unit_run("observe_bed_stripes", tests);
}
