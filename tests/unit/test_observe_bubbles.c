/* test_observe_bubbles.c -- the recipe on made-up beds of 60 x 60 l with round voids. */
#include "tests/unit/disc_field.h"
#include "tests/unit/fake_run.h"

enum { NX = 61, NY = 61, MAX_DISCS = 16 };

/* Share of a row j that a bed up to `top` fills, put down with the weights of a halo. */
static double share_of_row(double j, double top) {
    double above = fmin(fmax(top - j, -1), 1);
    return above < 0 ? (1 + above) * (1 + above) / 2 : 1 - (1 - above) * (1 - above) / 2;
}

static void write_frame(struct fake_run *f, double time, const struct disc *discs, size_t count,
                        double top) {
    static double field[NX * NY];
    disc_field(field, NX, NY, discs, count);
    for (size_t k = 0; k < NX * NY; k++)
        field[k] *= share_of_row((double)(k / NX), top);
    fake_field(f, "fields/solid_fraction", NX, NY, field, time, 0.0125);
}

static struct fake_run start(void) {
    return fake_start("  width_l: 60\n  height_l: 60\n  froude: 0.8\n");
}

static double value(const struct measurement *m, const char *output) {
    return fake_value(m, "bubbles", output);
}

/* A place for disc n of a grid that keeps them apart. */
static struct disc placed(size_t n, double r) {
    return (struct disc){6.3 + 12.1 * (double)(n % 5), 5.7 + 13.3 * (double)(n / 5), r};
}

START_TEST(number_size_and_onset_are_found) {
    /* None until 8 tau; four of radius 1.9 from 8 tau on; three of 3.4 from 25 to 40 tau. */
    struct fake_run f = start();
    struct measurement m;
    for (int k = 0; k <= 80; k++) {
        struct disc d[4];
        double t = k * 0.5;
        size_t count = t < 8 ? 0 : t < 25 ? 4 : 3;
        for (size_t n = 0; n < count; n++)
            d[n] = placed(n, t < 25 ? 1.9 : 3.4);
        write_frame(&f, t, d, count, 50.5);
    }
    unit_ok(fake_measure(&f, "bubbles", "threshold", 0.285, &m), &f.fault);
    double small = M_PI * 1.9 * 1.9, large = M_PI * 3.4 * 3.4;
    ck_assert_double_eq(value(&m, "onset_time"), 8);
    ck_assert_double_eq(value(&m, "births"), 4);
    ck_assert_double_eq(value(&m, "number"), 3);
    ck_assert_double_eq(value(&m, "number_early"), 4);
    ck_assert_double_eq_tol(value(&m, "mean_area") / large, 1, 0.04);
    ck_assert_double_eq_tol(value(&m, "growth") / (large / small), 1, 0.12);
    ck_assert_double_eq(value(&m, "vanished"), 1);
    ck_assert_double_eq(value(&m, "merges_per_bubble"), 0);
    ck_assert_double_eq_tol(value(&m, "aspect"), 1, 0.1);
    ck_assert_double_eq_tol(value(&m, "floor_flatness"), 0, 0.15);
    ck_assert_double_eq(value(&m, "steady"), 1);
    ck_assert_double_eq_tol(value(&m, "top_drift"), 0, 1e-9);
    ck_assert_str_eq(m.curve[0].name, "number");
    ck_assert_uint_eq(m.curve[0].count, 81);
    ck_assert_double_eq(m.curve[0].y[15], 0);
    ck_assert_double_eq(m.curve[0].y[16], 4);
    ck_assert_uint_eq(m.curve[1].count, 65); /* no mean area before there is a bubble */
    ck_assert_double_eq(m.curve[2].y[80], value(&m, "largest_area"));
    measurement_free(&m);
}
END_TEST

START_TEST(unequal_sizes_have_unequal_means) {
    struct fake_run f = start();
    struct measurement m;
    for (int k = 0; k <= 24; k++) {
        struct disc d[] = {placed(0, 1.77), placed(2, 4.1)};
        write_frame(&f, k * 0.5, d, 2, 43.3 + 0.117 * k);
    }
    unit_ok(fake_measure(&f, "bubbles", "threshold", 0.285, &m), &f.fault);
    double a = M_PI * 1.77 * 1.77, b = M_PI * 4.1 * 4.1;
    ck_assert_double_eq_tol(value(&m, "mean_area") / ((a + b) / 2), 1, 0.04);
    ck_assert_double_eq_tol(value(&m, "area_weighted_area") / ((a * a + b * b) / (a + b)), 1, 0.04);
    ck_assert_double_eq_tol(value(&m, "largest_area") / b, 1, 0.05);
    ck_assert_double_eq(value(&m, "births"), 0); /* there from the first frame */
    ck_assert_double_eq(value(&m, "onset_time"), 0);
    ck_assert_double_eq_tol(value(&m, "top_drift"), 2.34, 0.05); /* .117 each half tau */
    ck_assert_double_eq(value(&m, "steady"), 0);
    ck_assert(isnan(value(&m, "growth"))); /* 12 tau: early and late overlap */
    measurement_free(&m);
}
END_TEST

static const double OFFSET = 0.21, SLOPE = 0.47, GRAVITY = 1 / 0.8;

/* Twelve voids inside that rise by the law, but for noise, and four half discs at the walls that
 * are 1.4 times as fast as a whole disc of their area, of radius r/sqrt 2, would be. */
static size_t fill_rising(struct disc *d, double t) {
    for (size_t n = 0; n < 16; n++) {
        bool inside = n < 12;
        double r = inside ? 1.5 + 0.13 * (double)n : 3.1, noise = 0.02 * sin(7.7 * (double)n);
        double own = OFFSET + SLOPE * sqrt(GRAVITY * 2 * (inside ? r : r / sqrt(2)));
        double speed = inside ? own + noise : 1.4 * own;
        d[n] = (struct disc){inside  ? 9.2 + 8.3 * (double)(n % 6)
                             : n % 2 ? 0
                                     : 60,
                             (inside ? n < 6 : n < 14) ? 5.4 : 28.3, r};
        d[n].y += speed * t;
    }
    return 16;
}

START_TEST(the_planted_law_of_rise_is_recovered) {
    struct fake_run f = start();
    struct measurement m;
    for (int k = 0; k <= 40; k++) {
        struct disc d[MAX_DISCS];
        write_frame(&f, k * 0.25, d, fill_rising(d, k * 0.25), 56.5);
    }
    unit_ok(fake_measure(&f, "bubbles", "threshold", 0.285, &m), &f.fault);
    double error = value(&m, "rise_coefficient_error");
    ck_assert_double_eq_tol(value(&m, "rise_coefficient"), SLOPE, 0.08);
    ck_assert_double_eq_tol(value(&m, "rise_coefficient"), SLOPE, 3 * error);
    ck_assert_double_eq_tol(value(&m, "rise_offset"), OFFSET, 0.16);
    ck_assert_double_gt(error, 0.005); /* noise of .014 over a range of .54 in sqrt(g D) */
    ck_assert_double_lt(error, 0.05);
    ck_assert_double_eq_tol(value(&m, "wall_ratio"), 1.4, 0.03);
    ck_assert_double_gt(value(&m, "rise_speed"), 1.2); /* those at walls are in the mean */
    ck_assert_double_eq(value(&m, "merges"), 0);
    ck_assert_str_eq(m.curve[3].name, "rise");
    ck_assert_uint_eq(m.curve[3].count, 12);
    ck_assert_str_eq(m.curve[4].label, "at a side wall");
    ck_assert_uint_eq(m.curve[4].count, 4);
    measurement_free(&m);
}
END_TEST

START_TEST(no_bubble_is_said_with_a_reason) {
    struct fake_run f = start();
    struct measurement m;
    for (int k = 0; k <= 40; k++) {
        struct disc d = {31.2, 11.7, k == 17 ? 1.9 : 0.3}; /* one frame is a flicker */
        write_frame(&f, k, &d, 1, 50.5);
    }
    unit_ok(fake_measure(&f, "bubbles", "threshold", 0.285, &m), &f.fault);
    ck_assert_double_eq(value(&m, "births"), 0);
    ck_assert_double_eq(value(&m, "number"), 0);
    ck_assert_double_eq(value(&m, "largest_area"), 0);
    ck_assert_double_eq(value(&m, "merges"), 0);
    const char *const none[] = {"onset_time", "number_early",      "mean_area",
                                "growth",     "rise_speed",        "rise_coefficient",
                                "aspect",     "merges_per_bubble", "wall_ratio"};
    for (size_t i = 0; i < sizeof none / sizeof *none; i++)
        ck_assert_msg(isnan(value(&m, none[i])), "%s", none[i]);
    ck_assert_ptr_nonnull(strstr(m.reason, "no bubble of 4 l^2"));
    measurement_free(&m);
}
END_TEST

START_TEST(merges_and_bursts_are_counted) {
    struct fake_run f = start();
    struct measurement m;
    for (int k = 0; k <= 40; k++) {
        double t = k * 0.5;
        /* Two that close in and merge at about 8 tau; one that bursts at about 12 tau. */
        struct disc d[] = {{14.2, 12.1 + 0.2 * t, 3.1},
                           {14.2 + fmax(13 - t, 4.6), 12.1 + 0.2 * t, 2.6},
                           {44.1, 35.3 + 1.1 * t, 2.8}};
        write_frame(&f, t, d, 3, 50.5);
    }
    unit_ok(fake_measure(&f, "bubbles", "threshold", 0.285, &m), &f.fault);
    ck_assert_double_eq(value(&m, "merges"), 1);
    ck_assert_double_eq(value(&m, "splits"), 0);
    ck_assert_double_eq(value(&m, "bursts"), 1);
    ck_assert_double_eq_tol(value(&m, "merges_per_bubble"), 1. / 3, 1e-12);
    ck_assert(isnan(value(&m, "rise_coefficient")));
    ck_assert_ptr_nonnull(strstr(m.reason, "rise inside, 10 of unequal size needed"));
    measurement_free(&m);
}
END_TEST

START_TEST(a_gas_layer_is_reported_apart) {
    struct fake_run f = start();
    struct measurement m;
    static double field[NX * NY];
    for (int k = 0; k <= 20; k++) {
        struct disc d = placed(7, 2.9);
        disc_field(field, NX, NY, &d, 1);
        for (int n = 0; n < NX * NY; n++)
            if (n / NX > 50 || (n / NX < 4 && n % NX < 45))
                field[n] = 0.03;
        fake_field(&f, "fields/solid_fraction", NX, NY, field, k, 0.0125);
    }
    unit_ok(fake_measure(&f, "bubbles", "threshold", 0.285, &m), &f.fault);
    ck_assert_double_eq(value(&m, "number"), 1);
    ck_assert_double_eq_tol(value(&m, "layer"), 44.5 / 60, 1e-12);
    measurement_free(&m);
}
END_TEST

START_TEST(a_run_without_bed_or_window_is_refused) {
    struct fake_run f = start();
    struct measurement m;
    write_frame(&f, 0, NULL, 0, 50.5);
    write_frame(&f, 2.5, NULL, 0, -7);
    ck_assert_int_eq(fake_measure(&f, "bubbles", NULL, 0, &m), STATUS_BAD_INPUT);
    unit_says(&f.fault, "fields/solid_fraction: no bed at 2.5 tau");
    f = start();
    write_frame(&f, 0, NULL, 0, 50.5);
    write_frame(&f, 2.5, NULL, 0, 50.5);
    ck_assert_int_eq(fake_measure(&f, "bubbles", NULL, 0, &m), STATUS_BAD_INPUT);
    unit_says(&f.fault, "lasts from 0 to 2.5 tau: no window of 10 tau");
}
END_TEST

int main(void) {
    const TTest *const tests[] = {
        number_size_and_onset_are_found,        unequal_sizes_have_unequal_means,
        the_planted_law_of_rise_is_recovered,   no_bubble_is_said_with_a_reason,
        merges_and_bursts_are_counted,          a_gas_layer_is_reported_apart,
        a_run_without_bed_or_window_is_refused, NULL};
    return unit_run("observe_bubbles", tests);
}
