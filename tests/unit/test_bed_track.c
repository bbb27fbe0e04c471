/* test_bed_track.c -- centre, top, front, rise of planted profiles, and their times. */
#include "tests/unit/unit.h"
#include "validation/bed_track.h"

#include <math.h>

enum { BINS = 230 };

static struct bed_reading reading(double before, double after) {
    return (struct bed_reading){
        .before = before, .after = after, .above_R = 9, .smooth_R = 5, .bin_R = 0.9, .bins = BINS};
}

/* low up to front_R, high from there to top_R; edges share a bin. */
static void slab(double low, double front_R, double high, double top_R, double *phi) {
    for (int i = 0; i < BINS; i++) {
        double from = 0.9 * i, below = fmax(0, fmin(1, (front_R - from) / 0.9));
        double under = fmax(0, fmin(1, (top_R - from) / 0.9));
        phi[i] = low * fmin(below, under) + high * fmax(0, under - below);
    }
}

static struct bed_track read_one(const struct bed_reading *r, const double *phi) {
    struct fault fault = FAULT_NONE;
    struct bed_track t;
    double scratch[BINS];
    unit_ok(bed_track_create(1, &t, &fault), &fault);
    bed_track_read(&t, 0, 0.7, r, phi, scratch);
    return t;
}

START_TEST(edges_of_a_compacting_bed_are_found) {
    double phi[BINS];
    struct bed_reading r = reading(0.3, 0.55);
    slab(0.55, 61.37, 0.3, 121.91, phi);
    struct bed_track t = read_one(&r, phi);
    double solid = 0.55 * 61.37 + 0.3 * 60.54;
    double moment = 0.55 * 61.37 * 61.37 / 2 + 0.3 * 60.54 * (61.37 + 60.54 / 2);
    ck_assert_double_eq_tol(t.centre_R[0], moment / solid, 0.005);
    ck_assert_double_eq_tol(t.top_R[0], 121.91, 0.02);
    ck_assert_double_eq_tol(t.front_R[0], 61.37, 0.02);
    ck_assert_double_eq_tol(t.rise[0], 0, 1e-12);
    ck_assert_double_eq_tol(t.time_s[0], 0.7, 1e-15);
    bed_track_free(&t);
}
END_TEST

START_TEST(edges_and_rise_of_an_expanding_bed_are_found) {
    double phi[BINS];
    struct bed_reading r = reading(0.55, 0.3);
    slab(0.3, 48.13, 0.55, 99.7, phi);
    phi[4] = 0.2; /* what lies below above_R counts for nothing */
    struct bed_track t = read_one(&r, phi);
    ck_assert_double_eq_tol(t.front_R[0], 48.13, 0.02);
    ck_assert_double_eq_tol(t.top_R[0], 99.7 + 0.23 * 4.5, 0.02); /* .15 of .55, smoothed */
    ck_assert_double_eq_tol(t.rise[0], 0.25, 1e-12);
    bed_track_free(&t);
    slab(0.31, 48.13, 0.3, 150.2, phi); /* all is new */
    t = read_one(&r, phi);
    ck_assert(isnan(t.front_R[0]));
    ck_assert_double_eq_tol(t.rise[0], 0, 1e-12);
    bed_track_free(&t);
}
END_TEST

START_TEST(shares_of_the_way_and_meetings_have_their_times) {
    struct fault fault = FAULT_NONE;
    struct bed_track t;
    unit_ok(bed_track_create(60, &t, &fault), &fault);
    for (int k = 0; k < 60; k++) {
        t.time_s[k] = 0.05 * (k - 3);
        double x = fmax(t.time_s[k], 0);
        t.centre_R[k] = 80 - 35 * -expm1(-1.7 * x);
        t.top_R[k] = 150 - 31 * x;
        t.front_R[k] = x > 0.1 ? 43 * x : NAN;
    }
    ck_assert_double_eq_tol(bed_track_time(&t, 80, 45, 0.9), log(10) / 1.7, 2e-3);
    ck_assert(isnan(bed_track_time(&t, 80, 45, 0.999)));
    ck_assert_double_eq_tol(bed_track_meeting(&t), 150.0 / 74, 1e-9);
    bed_track_free(&t);
}
END_TEST

/* What is read off theory at given times is theory: a sharp bed's kinematic fronts in closed
 * form, bottom up at c phi0, top down at c (phibar - phi0). */
START_TEST(kinematic_fronts_of_a_compaction_are_those_of_the_closed_form) {
    struct fault fault = FAULT_NONE;
    struct bed_change c = {.before = 0.3,
                           .after = 0.55,
                           .load_m = 46.5 * 6e-4,
                           .radius_m = 6e-4,
                           .drag_per_s = 5,
                           .exponent = 4.65,
                           .pull_m_per_s2 = 1.67};
    struct bed_reading r = reading(0.3, 0.55);
    double time[] = {0, 0.61, 1.13}, slope = bed_change_slope(&c) / c.radius_m;
    static double phi[3 * BINS];
    struct bed_track t;
    unit_ok(bed_track_kinematic(&c, &r, time, 3, &t, phi, &fault), &fault);
    for (int k = 1; k < 3; k++) {
        ck_assert_double_eq_tol(t.front_R[k], slope * 0.3 * time[k], 0.05);
        ck_assert_double_eq_tol(t.top_R[k], 155 - slope * 0.25 * time[k], 0.05);
    }
    ck_assert_double_eq_tol(t.centre_R[0], 77.5, 0.01);
    ck_assert_double_eq_tol(phi[2 * BINS + 20], 0.55, 1e-9);
    bed_track_free(&t);
}
END_TEST

START_TEST(a_curve_has_the_numbers_of_a_track_alone) {
    struct fault fault = FAULT_NONE;
    struct measurement m = {.curve_count = 0};
    double time_s[] = {0.13, 0.26, 0.39, 0.52}, front_R[] = {NAN, 31.7, NAN, 29.3};
    struct bed_track t = {.count = 4, .time_s = time_s, .front_R = front_R};
    unit_ok(bed_track_curve(&t, t.front_R, "front", "measured", &m, &fault), &fault);
    ck_assert_uint_eq(m.curve_count, 1);
    ck_assert_str_eq(m.curve[0].name, "front");
    ck_assert_str_eq(m.curve[0].label, "measured");
    ck_assert_uint_eq(m.curve[0].count, 2);
    ck_assert_double_eq(m.curve[0].x[0], 0.26);
    ck_assert_double_eq(m.curve[0].y[0], 31.7);
    ck_assert_double_eq(m.curve[0].x[1], 0.52);
    ck_assert_double_eq(m.curve[0].y[1], 29.3);
    t.count = 0;
    unit_ok(bed_track_curve(&t, t.front_R, "front", "empty", &m, &fault), &fault);
    ck_assert_uint_eq(m.curve_count, 1);
    measurement_free(&m);
}
END_TEST

int main(void) {
    const TTest *const tests[] = {edges_of_a_compacting_bed_are_found,
                                  edges_and_rise_of_an_expanding_bed_are_found,
                                  shares_of_the_way_and_meetings_have_their_times,
                                  kinematic_fronts_of_a_compaction_are_those_of_the_closed_form,
                                  a_curve_has_the_numbers_of_a_track_alone,
                                  NULL};
    return unit_run("bed_track", tests);
}
