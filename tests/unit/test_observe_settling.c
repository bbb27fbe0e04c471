/* test_observe_settling.c -- settling, front, fluctuations and contacts on made-up suspensions.
 *
 * A box of 12 x 40 l: a settled bed, above it a suspension of known density and
 * speed, above that clear gas with, if wanted, stray grains that fall fast.
 */
#include "tests/unit/fake_run.h"

enum { W = 12, H = 40, PER_ROW = 60, MAX = H * PER_ROW + 4 };

struct mixture {
    double bed_top, front; /* (l) */
    double speed;          /* of the suspension (U0) */
    int strays;            /* grains in the clear gas, falling at 9 U0 */
    double tilt;           /* share of a row's grains beyond the front, one row up */
};

static const double RADIUS = 0.23;

/* Solid fraction of a full suspension row: 40 grains of PER_ROW's 60. */
static double suspension_fraction(void) {
    return 40 * M_PI * RADIUS * RADIUS * 2 / 3 / W;
}

static size_t fill(const struct mixture *m, double *x, double *v) {
    size_t n = 0;
    for (int row = 0; row < H; row++) {
        double y = row + 0.5;
        int count = y < m->bed_top ? PER_ROW : y < m->front ? 40 : 0;
        if (y > m->front && y < m->front + 1)
            count = (int)(40 * m->tilt);
        for (int i = 0; i < count; i++, n++) {
            x[2 * n] = 0.1 + 11.8 * fmod(0.618 * i + 0.37 * row, 1);
            x[2 * n + 1] = row + 0.05 + 0.9 * fmod(0.382 * i, 1);
            v[2 * n] = 0.01 * sin(i);
            v[2 * n + 1] = y < m->bed_top ? 0.02 * sin(3.0 * i) : -m->speed;
        }
    }
    for (int i = 0; i < m->strays; i++, n++) {
        x[2 * n] = 6;
        x[2 * n + 1] = 37.3 + i;
        v[2 * n] = 0;
        v[2 * n + 1] = -9;
    }
    return n;
}

/* Frames at 10, 20, 30 ... tau; the number of grains must stay: the rest lies in the bed. */
static struct fake_run write_frames(const struct mixture *m, size_t frames) {
    static double x[2 * MAX], v[2 * MAX], radius[MAX];
    struct fake_run f = fake_start("  width_l: 12\n  height_l: 40\n");
    size_t most = 0;
    for (size_t k = 0; k < frames; k++) {
        size_t n = fill(&m[k], x, v);
        most = n > most ? n : most;
    }
    for (size_t i = 0; i < most; i++)
        radius[i] = RADIUS;
    fake_array(&f, "particles/grains/radius", radius, most);
    for (size_t k = 0; k < frames; k++) {
        for (size_t n = fill(&m[k], x, v); n < most; n++) {
            x[2 * n] = 0.1 + 11.8 * fmod(0.618 * (double)n, 1);
            x[2 * n + 1] = 0.5;
            v[2 * n] = v[2 * n + 1] = 0;
        }
        fake_vectors(&f, "particles/grains/position", most, x, 10 * (double)(k + 1), 0.0125);
        fake_vectors(&f, "particles/grains/velocity", most, v, 10 * (double)(k + 1), 0.0125);
    }
    return f;
}

START_TEST(the_plateau_is_found_between_bed_and_clear_gas) {
    struct mixture m[] = {{6, 35, 0.613, 0, 0}, {11, 32, 0.593, 0, 0}};
    struct measurement out;
    struct fake_run f = write_frames(m, 2);
    unit_ok(fake_measure(&f, "settling", NULL, 0, &out), &f.fault);
    ck_assert_double_eq_tol(fake_value(&out, "settling", "speed"), 0.603, 1e-12);
    ck_assert_double_eq_tol(fake_value(&out, "settling", "solid_fraction"), suspension_fraction(),
                            1e-12);
    ck_assert_double_eq(fake_value(&out, "settling", "samples"), 2);
    ck_assert_double_eq(fake_value(&out, "settling", "rows"), 25);
    ck_assert_double_eq_tol(fake_value(&out, "settling", "speed_spread"), 0.01 / 0.603, 1e-9);
    ck_assert_uint_ge(out.curve_count, 3);
    measurement_free(&out);
}
END_TEST

START_TEST(stray_grains_do_not_set_the_maximum) {
    struct mixture m[] = {{6, 35, 0.613, 3, 0}};
    struct measurement out;
    struct fake_run f = write_frames(m, 1);
    unit_ok(fake_measure(&f, "settling", NULL, 0, &out), &f.fault);
    ck_assert_double_eq_tol(fake_value(&out, "settling", "speed"), 0.613, 1e-12);
    measurement_free(&out);
}
END_TEST

START_TEST(samples_end_when_settling_has_ended) {
    /* The third sample is slow, the fourth would be fast again: neither counts. */
    struct mixture m[] = {
        {6, 35, 0.613, 0, 0}, {11, 32, 0.593, 0, 0}, {14, 30, 0.05, 0, 0}, {14, 30, 0.6, 0, 0}};
    struct measurement out;
    struct fake_run f = write_frames(m, 4);
    unit_ok(fake_measure(&f, "settling", NULL, 0, &out), &f.fault);
    ck_assert_double_eq(fake_value(&out, "settling", "samples"), 2);
    ck_assert_double_eq(fake_value(&out, "settling", "last_tau"), 20);
    measurement_free(&out);
    f = write_frames(m, 4); /* every 20 tau: the first and third are not asked for */
    unit_ok(fake_measure(&f, "settling", "every_tau", 20, &out), &f.fault);
    ck_assert_double_eq_tol(fake_value(&out, "settling", "speed"), (0.593 + 0.6) / 2, 1e-12);
    measurement_free(&out);
}
END_TEST

START_TEST(too_few_rows_are_no_plateau) {
    struct mixture m[] = {{28, 35, 0.613, 0, 0}};
    struct measurement out;
    struct fake_run f = write_frames(m, 1);
    unit_ok(fake_measure(&f, "settling", NULL, 0, &out), &f.fault);
    ck_assert(isnan(fake_value(&out, "settling", "speed")));
    ck_assert_double_eq(fake_value(&out, "settling", "samples"), 0);
    ck_assert_ptr_nonnull(strstr(out.reason, "8 rows"));
    measurement_free(&out);
}
END_TEST

START_TEST(a_grain_outside_the_box_makes_the_run_unusable) {
    struct fake_run f = fake_start("  width_l: 12\n  height_l: 40\n");
    struct measurement out;
    fake_array(&f, "particles/grains/radius", (double[]){0.2, 0.2}, 2);
    fake_vectors(&f, "particles/grains/position", 2, (double[]){1, 1, 3, 40.1}, 10, 0.0125);
    fake_vectors(&f, "particles/grains/velocity", 2, (double[]){0, 0, 0, 0}, 10, 0.0125);
    ck_assert_int_eq(fake_measure(&f, "settling", NULL, 0, &out), STATUS_BAD_INPUT);
    unit_says(&f.fault, "grain 1 is at (3, 40.1) l");
}
END_TEST

START_TEST(a_front_has_its_width_and_growth_is_noticed) {
    /* Frames at 10, 20, 30, 40 tau: sharp at 20, one row of 30 % ahead of it at 40. */
    struct mixture m[] = {
        {3, 37, 0.1, 0, 0}, {6, 35, 0.1, 0, 0}, {8, 34, 0.1, 0, 0}, {11, 33, 0.1, 0, 0.3}};
    struct measurement out;
    struct fake_run f = write_frames(m, 4);
    unit_ok(fake_measure(&f, "front", NULL, 0, &out), &f.fault);
    /* From 0 to full between two rows: 80 % of a row. With .3 between: the
     * plateau's mean takes that row in no more than the others. */
    ck_assert_double_eq_tol(fake_value(&out, "front", "width_early"), 0.8, 1e-9);
    double late = (0.9 - 0.3) / 0.7 + (1 - 0.1 / 0.3);
    ck_assert_double_eq_tol(fake_value(&out, "front", "width_late"), late, 1e-9);
    ck_assert_double_eq_tol(fake_value(&out, "front", "growth"), late - 0.8, 1e-9);
    ck_assert_double_gt(fake_value(&out, "front", "fall_speed"), 0.05);
    measurement_free(&out);
    f = write_frames(m, 2); /* 40 tau was never sampled: no value, and no guess */
    unit_ok(fake_measure(&f, "front", NULL, 0, &out), &f.fault);
    ck_assert_double_eq_tol(fake_value(&out, "front", "width_early"), 0.8, 1e-9);
    ck_assert(isnan(fake_value(&out, "front", "growth")));
    measurement_free(&out);
}
END_TEST

/* Solid fraction as a wave across: mean .3, amplitude a, wavelength in l. */
static void measure_wave(double amplitude, double wavelength, struct measurement *out) {
    enum { NX = W + 1, NY = H + 1 };
    double rho[NX * NY];
    struct mixture m = {4, 36, 0.4, 0, 0};
    static double x[2 * MAX], v[2 * MAX], radius[MAX];
    struct fake_run f = fake_start("  width_l: 12\n  height_l: 40\n");
    size_t n = fill(&m, x, v);
    for (size_t i = 0; i < n; i++)
        radius[i] = RADIUS;
    fake_array(&f, "particles/grains/radius", radius, n);
    for (int frame = 0; frame < 3; frame++) {
        double length = frame ? wavelength : 4;
        for (int k = 0; k < NX * NY; k++)
            rho[k] = 0.3 + amplitude * cos(2 * M_PI * (k % NX) / length + 0.7 * (k / NX));
        fake_vectors(&f, "particles/grains/position", n, x, 20 * frame, 0.0125);
        fake_vectors(&f, "particles/grains/velocity", n, v, 20 * frame, 0.0125);
        fake_field(&f, "fields/solid_fraction", NX, NY, rho, 20 * frame, 0.0125);
    }
    unit_ok(fake_measure(&f, "fluctuations", NULL, 0, out), &f.fault);
}

START_TEST(a_wave_has_its_variance_and_its_length) {
    struct measurement m;
    measure_wave(0.06, 8, &m);
    ck_assert_double_eq_tol(fake_value(&m, "fluctuations", "variance_early"), 0.02, 0.002);
    /* cos(2 pi r/8) falls below 1/e at 1.52 l; linear between sites: 1.48. */
    ck_assert_double_eq_tol(fake_value(&m, "fluctuations", "length_early"), 1.48, 0.1);
    ck_assert_double_eq_tol(fake_value(&m, "fluctuations", "length_start"), 0.63, 0.05);
    ck_assert_double_eq_tol(fake_value(&m, "fluctuations", "variance_growth"), 1, 0.1);
    ck_assert_double_gt(fake_value(&m, "fluctuations", "length_growth"), 2);
    measurement_free(&m);
    measure_wave(0.12, 8, &m); /* twice the amplitude: four times the variance */
    ck_assert_double_eq_tol(fake_value(&m, "fluctuations", "variance_early"), 0.08, 0.008);
    measurement_free(&m);
}
END_TEST

START_TEST(contacts_take_the_worst_of_all_samples) {
    struct fake_run f = fake_start("  width_l: 12\n  height_l: 40\n");
    struct measurement out;
    const double overlap[] = {0.01, 0.0317, 0.02};
    for (int k = 0; k < 3; k++) {
        fake_scalar(&f, "observables/largest_overlap", overlap[k], k, 0.0125);
        fake_scalar(&f, "observables/sweeps_max", 7 + k, k, 0.0125);
        fake_scalar(&f, "observables/solid_fraction_max", 0.5, k, 0.0125);
    }
    unit_ok(fake_measure(&f, "contacts", NULL, 0, &out), &f.fault);
    ck_assert_double_eq(fake_value(&out, "contacts", "largest_overlap"), 0.0317);
    ck_assert_double_eq(fake_value(&out, "contacts", "sweeps_max"), 9);
}
END_TEST

int main(void) {
    const TTest *const tests[] = {the_plateau_is_found_between_bed_and_clear_gas,
                                  stray_grains_do_not_set_the_maximum,
                                  samples_end_when_settling_has_ended,
                                  too_few_rows_are_no_plateau,
                                  a_grain_outside_the_box_makes_the_run_unusable,
                                  a_front_has_its_width_and_growth_is_noticed,
                                  a_wave_has_its_variance_and_its_length,
                                  contacts_take_the_worst_of_all_samples,
                                  NULL};
    return unit_run("observe_settling", tests);
}
