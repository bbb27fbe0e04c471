/* test_observe_bed_step.c -- runs whose profiles are theory's own: the recipes find what was put
 * in. */
#include "tests/unit/spheres_fixture.h"
#include "validation/bed_track.h"
#include "validation/relaxation_theory.h"

#include <math.h>

enum { BINS = 200, N = 10007 };
static const double R = 6.1e-4, SIDE[] = {30.7, 29.3, 200};

/* The run's parameters: those of the fixture, and what drives. */
static struct bed_change bed(double after, bool full) {
    return (struct bed_change){.before = 0.37,
                               .after = after,
                               .load_m = N * 4 * M_PI / 3 * R / (30.7 * 29.3),
                               .radius_m = R,
                               .restitution = 0.83,
                               .layer_m = 9.3 * R,
                               .drag_per_s = 4.9,
                               .exponent = 4.65,
                               .pull_m_per_s2 = 9.7 * 0.61 * 0.29,
                               .heat_m2_per_s2 = 1.3 * 1.7e-9 / 2.3e-6,
                               .full = full,
                               .inertia = true};
}

static struct fake_run start(const char *after, const char *drive, const char *changes) {
    char more[512];
    snprintf(more, sizeof more,
             "  phibar_times_s: [%s]\n  phibar_values: [%s]\n  drive: %s\n  start: from-file\n"
             "  layer_R: 9.3\n  gravity_m_per_s2: 9.7\n  density_contrast: 0.61\n"
             "  drive_scale: 0.29\n  restitution: 0.83\n",
             changes, after, drive);
    return spheres_start(N, R, SIDE, "hard", more);
}

/* Samples every DT from 0, the change at .2 s; profiles of a wave, or `late` times its time. */
enum { STILL = 11, FRAMES = 111 };
static const double DT = 0.02;
static void plant(struct fake_run *f, const struct bed_change *c, bool pressure, double late) {
    struct fault fault = FAULT_NONE;
    static double phi[FRAMES * BINS];
    double time[FRAMES];
    struct bed_reading r = {c->before, c->after, 10, 5, 1, BINS};
    struct bed_track t;
    for (int n = 0; n < FRAMES; n++)
        time[n] = fmax(0, DT * (n - STILL + 1) * late);
    unit_ok(pressure ? bed_track_pressure(c, &r, time, FRAMES, &t, phi, &fault)
                     : bed_track_kinematic(c, &r, time, FRAMES, &t, phi, &fault),
            &fault);
    bed_track_free(&t);
    for (int n = 0; n < FRAMES; n++) {
        size_t bins = BINS;
        fake_append(f, "profiles/packing_fraction", 1, &bins, phi + n * BINS, DT * n, 1e-6);
        spheres_counter(f, "collisions", N * (n < STILL ? 3.1 * n : 34.1 + 4.7 * (n - STILL)),
                        DT * n);
        spheres_counter(f, "temperature_xy", n < STILL ? 1.9e-9 : 2.1e-9, DT * n);
    }
}

static double step_value(const struct measurement *m, const char *output) {
    return fake_value(m, "bed-step", output);
}

START_TEST(a_run_that_is_theory_lies_on_it) {
    struct fake_run f = start("0.5", "linear", "0.2");
    struct bed_change c = bed(0.5, false);
    struct measurement m;
    plant(&f, &c, true, 1);
    unit_ok(fake_measure(&f, "bed-step", "count_s", 1, &m), &f.fault);
    ck_assert_double_lt(step_value(&m, "pressure_centre"), 0.05);
    ck_assert_double_lt(step_value(&m, "pressure_top"), 0.05);
    ck_assert_double_lt(step_value(&m, "pressure_front"), 0.05);
    ck_assert_double_gt(step_value(&m, "kinematic_centre"), 0.5);
    ck_assert_double_eq_tol(step_value(&m, "start_bulk"), 0.37, 0.01);
    ck_assert_double_eq_tol(step_value(&m, "end_bulk"), 0.5, 0.01);
    ck_assert_double_lt(step_value(&m, "end_time"), 1.9);
    ck_assert_double_gt(step_value(&m, "end_time"), step_value(&m, "time_90"));
    measurement_free(&m);
}
END_TEST

/* A bed that goes its way at 1.1 times the speed. */
START_TEST(a_faster_run_is_told_from_theory) {
    struct fake_run f = start("0.5", "linear", "0.2");
    struct bed_change c = bed(0.5, false);
    struct measurement m;
    plant(&f, &c, false, 1.1);
    unit_ok(fake_measure(&f, "bed-step", NULL, 0, &m), &f.fault);
    ck_assert_double_eq_tol(step_value(&m, "speed_ratio"), 1.1, 0.02); /* it slows down by itself */
    double top = c.load_m / 0.37 / R, slope = bed_change_slope(&c) / R,
           end = c.load_m / R / (slope * 0.37 * 0.5) / 1.1;
    ck_assert_double_eq_tol(step_value(&m, "front_time"), end, 0.01 * end);
    ck_assert_double_eq_tol(step_value(&m, "time_90"), end * (1 - sqrt(0.1)), 0.01);
    ck_assert_double_eq_tol(step_value(&m, "end_time"), end * (1 - sqrt(0.02)), 0.01);
    ck_assert_double_eq_tol(step_value(&m, "kinematic_front"),
                            0.1 * top * (0.37 / 0.5) * (1 - 20 / top), 0.4);
    measurement_free(&m);
}
END_TEST

START_TEST(collisions_and_speeds_are_counted_from_the_change) {
    struct fake_run f = start("0.31", "full", "0.2");
    struct bed_change c = bed(0.31, true);
    struct measurement m;
    plant(&f, &c, true, 1);
    unit_ok(fake_measure(&f, "bed-step", "count_s", 0.6, &m), &f.fault);
    /* 2 N_coll/N: frame 10 is the change, frame 40 is .6 s later */
    ck_assert_double_eq_tol(step_value(&m, "collisions"), 2 * (34.1 + 4.7 * 29 - 31), 1e-6);
    ck_assert_double_eq_tol(step_value(&m, "rate_before"), 2 * 3.1 / DT, 1e-6);
    ck_assert_double_eq_tol(step_value(&m, "rate_after"), 2 * 4.7 / DT, 1e-6);
    ck_assert_double_eq_tol(step_value(&m, "speed_before"), 1e3 * sqrt(1.91818181818e-9 / 2.3e-6),
                            0.3);
    ck_assert_double_eq_tol(step_value(&m, "speed_after"), 1e3 * sqrt(2.1e-9 / 2.3e-6), 1e-6);
    ck_assert_double_eq_tol(step_value(&m, "heat_ratio"), 2.1 / (1.3 * 1.7), 1e-6);
    ck_assert(isnan(step_value(&m, "front_time"))); /* an expansion */
    ck_assert_str_ne(m.reason, "");
    ck_assert_double_lt(step_value(&m, "pressure_centre"), 0.05); /* of the full law */
    ck_assert_double_gt(step_value(&m, "rise"), step_value(&m, "still_rise"));
    ck_assert_double_eq_tol(step_value(&m, "rise"), step_value(&m, "pressure_rise"), 1e-3);
    measurement_free(&m);
}
END_TEST

START_TEST(relaxation_of_a_run_that_is_theory_is_theorys) {
    struct fake_run f = start("0.33", "linear", "0.2");
    struct bed_change c = bed(0.33, false);
    struct relaxation_fit theory;
    struct measurement m;
    plant(&f, &c, true, 1);
    unit_ok(relaxation_theory_fit(&c, true, 1.3, &theory, &f.fault), &f.fault);
    unit_ok(fake_measure(&f, "bed-relaxation", "to_s", 1.3, &m), &f.fault);
    ck_assert_double_eq_tol(fake_value(&m, "bed-relaxation", "rate"), theory.rate_per_s,
                            0.01 * theory.rate_per_s);
    ck_assert_double_eq_tol(fake_value(&m, "bed-relaxation", "plateau"), theory.plateau, 0.01);
    ck_assert_double_lt(fake_value(&m, "bed-relaxation", "floor"), 1e-12);
    ck_assert_double_eq_tol(fake_value(&m, "bed-relaxation", "window"), 1.3, 1e-12);
    ck_assert_double_eq_tol(fake_value(&m, "bed-relaxation", "still"), STILL, 1e-12);
    ck_assert_uint_eq(m.curve[1].count, 65); /* L2: the window's samples */
    measurement_free(&m);
}
END_TEST

START_TEST(runs_without_one_change_are_refused) {
    const struct {
        const char *after, *times, *drive, *words;
    } bad[] = {{"", "", "linear", "0 times"},
               {"0.3, 0.4", "0.1, 0.2", "linear", "2 times"},
               {"0.3", "0.2", "none", "drive none"},
               {"0.3", "9", "linear", "too few"}};
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        struct fake_run f = start(bad[i].after, bad[i].drive, bad[i].times);
        struct bed_change c = bed(0.3, false);
        struct measurement m;
        plant(&f, &c, false, 1);
        ck_assert_int_ne(fake_measure(&f, "bed-step", NULL, 0, &m), STATUS_OK);
        unit_says(&f.fault, bad[i].words);
        measurement_free(&m);
    }
}
END_TEST

int main(void) {
    const TTest *const tests[] = {a_run_that_is_theory_lies_on_it,
                                  a_faster_run_is_told_from_theory,
                                  collisions_and_speeds_are_counted_from_the_change,
                                  relaxation_of_a_run_that_is_theory_is_theorys,
                                  runs_without_one_change_are_refused,
                                  NULL};
    return unit_run("observe_bed_step", tests);
}
