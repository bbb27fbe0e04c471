/* test_observe_bed_wave.c -- profiles that are the kinematic wave, late, or short of solid: the
 * recipe finds what was put in, from profiles and parameters alone. */
#include "tests/unit/spheres_fixture.h"
#include "validation/bed_track.h"

#include <math.h>

enum { BINS = 210, N = 10007, FRAMES = 96 };
static const double R = 6.1e-4, SIDE[] = {30.7, 29.3, 199.5}, DT = 0.02;

static struct bed_change bed(double after, bool full) {
    return (struct bed_change){.before = 0.37,
                               .after = after,
                               .load_m = N * 4 * M_PI / 3 * R / (30.7 * 29.3),
                               .radius_m = R,
                               .layer_m = 9.3 * R,
                               .drag_per_s = 4.9,
                               .exponent = 4.65,
                               .pull_m_per_s2 = 9.7 * 0.61 * 0.29,
                               .full = full,
                               .sharp = true};
}

static struct fake_run start(const char *drive) {
    char more[512];
    snprintf(more, sizeof more,
             "  phibar_times_s: [0]\n  phibar_values: [0.5]\n  drive: %s\n  start: sharp\n"
             "  layer_R: 9.3\n  gravity_m_per_s2: 9.7\n  density_contrast: 0.61\n"
             "  drive_scale: 0.29\n  restitution: 0.83\n",
             drive);
    return spheres_start(N, R, SIDE, "hard", more);
}

/* The wave at `late` times the time, `share` of its solid. */
static void plant(struct fake_run *f, const struct bed_change *c, double late, double share) {
    struct fault fault = FAULT_NONE;
    static double phi[FRAMES * BINS];
    double time[FRAMES];
    struct bed_reading r = {c->before, c->after, 10, 5, 199.5 / BINS, BINS};
    struct bed_track t;
    for (int n = 0; n < FRAMES; n++)
        time[n] = DT * n * late;
    unit_ok(bed_track_kinematic(c, &r, time, FRAMES, &t, phi, &fault), &fault);
    bed_track_free(&t);
    for (int n = 0; n < FRAMES; n++) {
        size_t bins = BINS;
        for (int i = 0; i < BINS; i++)
            phi[n * BINS + i] *= n < FRAMES / 2 ? 1 : share;
        fake_append(f, "profiles/packing_fraction", 1, &bins, phi + n * BINS, DT * n, 1e-6);
    }
}

static double value(const struct measurement *m, const char *output) {
    return fake_value(m, "bed-wave", output);
}

START_TEST(a_run_that_is_the_wave_lies_on_it) {
    for (int full = 0; full < 2; full++) {
        struct fake_run f = start(full ? "full" : "linear");
        struct bed_change c = bed(0.5, full);
        struct measurement m;
        plant(&f, &c, 1, 1);
        unit_ok(fake_measure(&f, "bed-wave", NULL, 0, &m), &f.fault);
        ck_assert_double_lt(value(&m, "kinematic_centre"), 1e-9);
        ck_assert_double_lt(value(&m, "kinematic_top"), 1e-9);
        ck_assert_double_lt(value(&m, "kinematic_front"), 1e-9);
        ck_assert_double_lt(value(&m, "solid_error"), 1e-9);
        measurement_free(&m);
    }
}
END_TEST

START_TEST(a_faster_wave_is_told_from_theory) {
    struct fake_run f = start("linear");
    struct bed_change c = bed(0.5, false);
    struct measurement m;
    plant(&f, &c, 1.1, 1);
    unit_ok(fake_measure(&f, "bed-wave", NULL, 0, &m), &f.fault);
    double end = c.load_m / (bed_change_slope(&c) * 0.37 * 0.5) / 1.1;
    ck_assert_double_eq_tol(value(&m, "front_time"), end, 0.01 * end);
    double top = c.load_m / 0.37 / R;
    ck_assert_double_eq_tol(value(&m, "kinematic_front"), 0.1 * top * (0.37 / 0.5) * (1 - 20 / top),
                            0.5);
    ck_assert_double_gt(value(&m, "kinematic_centre"), 0.3);
    ck_assert_double_gt(value(&m, "kinematic_top"), 0.5);
    measurement_free(&m);
}
END_TEST

START_TEST(solid_that_is_lost_is_missed) {
    struct fake_run f = start("linear");
    struct bed_change c = bed(0.5, false);
    struct measurement m;
    plant(&f, &c, 1, 0.9973);
    unit_ok(fake_measure(&f, "bed-wave", NULL, 0, &m), &f.fault);
    ck_assert_double_eq_tol(value(&m, "solid_error"), 0.0027, 1e-9);
    measurement_free(&m);
}
END_TEST

int main(void) {
    const TTest *const tests[] = {a_run_that_is_the_wave_lies_on_it,
                                  a_faster_wave_is_told_from_theory, solid_that_is_lost_is_missed,
                                  NULL};
    return unit_run("observe_bed_wave", tests);
}
