/* test_observe_drop.c -- a made-up bed through whose break the flux is stepped, up and down.
 *
 * Per step of 5 tau: the bed (17.8 l of solid) creeps at a known speed, the ratio is
 * (q - u)/q_mf or the planted one where the bed is carried, the freeboard's drop is
 * added. In the first 3 tau of a step the pressure is far off. On the way down, at .06,
 * the bed still falls: that point is neither below nor above. */
#include "tests/unit/bed_sample.h"

enum { STEPS = 15, PER_STEP = 10 };

static const double FLUX[STEPS] = {0.02, 0.03, 0.04, 0.05, 0.065, 0.07, 0.08, 0.1,
                                   0.08, 0.07, 0.06, 0.05, 0.04,  0.03, 0.02};
static const double CREEP[STEPS] = {0.0004, -0.0007, 0.0011, 0.0023, 0,       0.003,   0.004, 0.007,
                                    -0.002, -0.004,  -0.02,  -0.002, -0.0013, -0.0005, 0.0002};
static const double CARRIED[STEPS] = {0, 0, 0, 0, 1.043, 1.004, 0.998, 1.001, 0.999, 0.995, 0.87};
static const double PECLET = 3e-4, GRAVITY = 1.2, FRACTION = 0.5637, HEIGHT = 31.5;

struct plan {
    double up, down;  /* q_mf (l/tau) */
    double freeboard; /* share of its drop that is planted */
    size_t steps;     /* completed */
};

static double weight(void) {
    return PECLET * GRAVITY * FRACTION * HEIGHT;
}

/* K(.25), published: .75^4/.25^2. */
static double freeboard(double flux, double top) {
    return PECLET * flux * (BED_NY - 1 - top) / (0.31640625 / 0.0625);
}

static double ratio_at(const struct plan *p, size_t step) {
    double q_mf = step < 8 ? p->up : p->down, through = FLUX[step] - CREEP[step];
    return CARRIED[step] > 0 ? CARRIED[step] : through / q_mf;
}

static void write_frame(struct fake_run *f, const struct plan *p, size_t step, double time,
                        double lifted, bool early) {
    static double rho[BED_SITES], pressure[BED_SITES];
    memset(rho, 0, sizeof rho);
    bed_sample_add(rho, lifted, lifted + HEIGHT, FRACTION);
    double drop = weight() * (early ? 3 : ratio_at(p, step));
    drop += p->freeboard * freeboard(FLUX[step], lifted + HEIGHT);
    bed_sample_pressure(pressure, drop);
    fake_field(f, "fields/solid_fraction", BED_NX, BED_NY, rho, time, 0.0125);
    fake_field(f, "fields/pressure", BED_NX, BED_NY, pressure, time, 0.0125);
}

static struct fake_run write_run(const struct plan *p) {
    char text[1024];
    int n = snprintf(text, sizeof text,
                     "  width_l: 12\n  height_l: 60\n  peclet: 3e-4\n  gravity: 1.2\n"
                     "  flux_on_tau: 2\n  flux_off_tau: 1e9\n  flux_l_per_tau: 0\n"
                     "  flux_schedule_every_tau: 5\n  flux_schedule_l_per_tau: [");
    for (size_t i = 0; i < STEPS; i++)
        n += snprintf(text + n, sizeof text - (size_t)n, "%s%g", i ? ", " : "", FLUX[i]);
    snprintf(text + n, sizeof text - (size_t)n, "]\n");
    struct fake_run f = fake_start(text);
    double lifted = 1;
    write_frame(&f, p, 0, 1.5, lifted, true); /* before injection */
    for (size_t step = 0; step < p->steps; step++)
        for (size_t k = 1; k <= PER_STEP; k++) {
            lifted += CREEP[step] * 5 / PER_STEP;
            double time = 2 + 5 * ((double)step + (double)k / PER_STEP);
            write_frame(&f, p, step, time, lifted, k < 6);
        }
    return f;
}

static double value(const struct measurement *m, const char *output) {
    return fake_value(m, "pressure-drop", output);
}

static const struct plan PLAN = {.up = 0.0623, .down = 0.0571, .freeboard = 1, .steps = STEPS};

START_TEST(the_break_is_where_it_was_planted) {
    struct measurement m;
    struct fake_run f = write_run(&PLAN);
    unit_ok(fake_measure(&f, "pressure-drop", NULL, 0, &m), &f.fault);
    double up = 0.0623 * (1.004 + 0.998 + 1.001) / 3, down = 0.0571 * (1.001 + 0.999 + 0.995) / 3;
    ck_assert_double_eq_tol(value(&m, "q_mf_up"), up, 2e-4 * up);
    ck_assert_double_eq_tol(value(&m, "q_mf_down"), down, 2e-4 * down);
    ck_assert_double_eq_tol(value(&m, "hysteresis"), 1 - down / up, 5e-4);
    /* The points below lie on a line: only the scatter above is left. */
    ck_assert_double_eq_tol(value(&m, "q_mf_up_error"), up * 0.003 / sqrt(3), 1e-5);
    ck_assert_double_eq_tol(value(&m, "overshoot"), 1.043, 3e-4);
    double sum = 1.004 + 0.998 + 1.001 + 1.001 + 0.999 + 0.995;
    ck_assert_double_eq_tol(value(&m, "above"), sum / 6, 3e-4);
    ck_assert_double_eq_tol(value(&m, "above_spread"), 0.00306594, 1e-4);
    ck_assert_double_eq(value(&m, "points"), STEPS);
    measurement_free(&m);
}
END_TEST

START_TEST(the_bed_at_rest_has_its_fraction_and_creep) {
    struct measurement m;
    struct fake_run f = write_run(&PLAN);
    unit_ok(fake_measure(&f, "pressure-drop", NULL, 0, &m), &f.fault);
    ck_assert_double_eq_tol(value(&m, "solid_fraction"), FRACTION, 1e-6);
    ck_assert_double_eq_tol(value(&m, "solid_fraction_down"), FRACTION, 1e-6);
    ck_assert_double_eq_tol(value(&m, "fixed_speed"), 0.0023, 1e-6);
    measurement_free(&m);
}
END_TEST

START_TEST(a_falling_bed_is_not_below_unless_asked_for) {
    struct measurement m;
    struct fake_run f = write_run(&PLAN);
    unit_ok(fake_measure(&f, "pressure-drop", "fixed", 0.4, &m), &f.fault);
    ck_assert_double_eq_tol(value(&m, "fixed_speed"), 0.02, 1e-6);
    ck_assert(isnan(value(&m, "q_mf_down"))); /* too flat a line: one point is left above */
    ck_assert_ptr_nonnull(strstr(m.reason, "down: 4 points below the break, 1 clearly above"));
    measurement_free(&m);
    f = write_run(&PLAN); /* and none at all is below where nothing may move */
    unit_ok(fake_measure(&f, "pressure-drop", "fixed", 0, &m), &f.fault);
    ck_assert(isnan(value(&m, "q_mf_up")));
    measurement_free(&m);
}
END_TEST

static const struct curve *curve_of(const struct measurement *m, const char *name,
                                    const char *label) {
    for (size_t i = 0; i < m->curve_count; i++)
        if (!strcmp(m->curve[i].name, name) && !strcmp(m->curve[i].label, label))
            return &m->curve[i];
    ck_abort_msg("no curve %s, %s", name, label);
    return NULL;
}

START_TEST(curves_show_both_ways_the_lines_and_time) {
    struct measurement m;
    struct fake_run f = write_run(&PLAN);
    unit_ok(fake_measure(&f, "pressure-drop", NULL, 0, &m), &f.fault);
    const struct curve *up = curve_of(&m, "up", "up"), *down = curve_of(&m, "down", "down");
    ck_assert_uint_eq(up->count, 8);
    ck_assert_uint_eq(down->count, 8); /* the turning point belongs to both */
    ck_assert_double_eq_tol(up->x[3], 0.05 - 0.0023, 1e-6);
    ck_assert_double_eq_tol(up->y[3], up->x[3] / 0.0623, 1e-3);
    ck_assert_double_eq(up->x[7], down->x[0]);
    const struct curve *fit = curve_of(&m, "fit", "up");
    ck_assert_double_eq(fit->x[1], value(&m, "q_mf_up"));
    ck_assert_double_eq_tol(fit->y[1], 1.001, 3e-4);
    const struct curve *time = curve_of(&m, "time", "bed");
    ck_assert_uint_eq(time->count, STEPS * PER_STEP);
    ck_assert_double_eq_tol(time->y[PER_STEP + 8], ratio_at(&PLAN, 1), 1e-3);
    ck_assert_double_eq_tol(time->y[PER_STEP + 2], 3, 1e-3);
    measurement_free(&m);
}
END_TEST

START_TEST(without_its_freeboard_the_ratio_is_off) {
    struct plan p = PLAN;
    struct measurement m;
    p.freeboard = 0; /* the pressure lacks what is taken off */
    struct fake_run f = write_run(&p);
    unit_ok(fake_measure(&f, "pressure-drop", NULL, 0, &m), &f.fault);
    ck_assert_double_lt(value(&m, "above"), 0.985);
    measurement_free(&m);
}
END_TEST

START_TEST(too_few_points_are_no_break) {
    struct plan p = PLAN;
    struct measurement m;
    p.steps = 6; /* four below, one clearly above, none on the way down */
    struct fake_run f = write_run(&p);
    unit_ok(fake_measure(&f, "pressure-drop", NULL, 0, &m), &f.fault);
    ck_assert(isnan(value(&m, "q_mf_up")) && isnan(value(&m, "q_mf_down")));
    ck_assert(isnan(value(&m, "hysteresis")) && isnan(value(&m, "above")));
    ck_assert_double_eq(value(&m, "points"), 6);
    ck_assert_double_eq_tol(value(&m, "solid_fraction"), FRACTION, 1e-6);
    ck_assert_ptr_nonnull(strstr(m.reason, "up: 4 points below the break, 1 clearly above"));
    measurement_free(&m);
    f = write_run(&PLAN); /* the last frame of each step alone has no speed */
    ck_assert_int_eq(fake_measure(&f, "pressure-drop", "average_tau", 0.2, &m), STATUS_BAD_INPUT);
    unit_says(&f.fault, "1 frames in the last 0.2 of the step that ends at 7 tau");
}
END_TEST

/* `fluxes`: text of the parameters that say how gas is injected. */
static struct fake_run write_constant(const char *fluxes, double flux) {
    static double rho[BED_SITES], pressure[BED_SITES];
    char text[512];
    snprintf(text, sizeof text, "  width_l: 12\n  height_l: 60\n  peclet: 3e-4\n  gravity: 1.2\n%s",
             fluxes);
    struct fake_run f = fake_start(text);
    memset(rho, 0, sizeof rho);
    bed_sample_add(rho, 0, HEIGHT, FRACTION);
    for (int k = 0; k <= 30; k++) {
        double ratio = k < 10 || k > 20 ? 7 : k % 2 ? 1.01 : 0.99;
        bed_sample_pressure(pressure, weight() * ratio + freeboard(flux, HEIGHT));
        fake_field(&f, "fields/solid_fraction", BED_NX, BED_NY, rho, k, 0.0125);
        fake_field(&f, "fields/pressure", BED_NX, BED_NY, pressure, k, 0.0125);
    }
    return f;
}

START_TEST(a_constant_flux_gives_the_ratio_above_only) {
    static const char on[] = "  flux_l_per_tau: 0.31\n  flux_on_tau: 0\n  flux_off_tau: 25\n"
                             "  flux_schedule_l_per_tau: []\n";
    struct measurement m;
    struct fake_run f = write_constant(on, 0.31);
    unit_ok(fake_measure(&f, "pressure-drop", "to_tau", 20, &m), &f.fault);
    ck_assert_double_eq_tol(value(&m, "above"), (5 * 1.01 + 6 * 0.99) / 11, 1e-5);
    ck_assert(isnan(value(&m, "q_mf_up")));
    ck_assert_ptr_nonnull(strstr(m.reason, "no schedule"));
    ck_assert_uint_eq(m.curve_count, 1);
    ck_assert_uint_eq(m.curve[0].count, 30);
    measurement_free(&m);
    f = write_constant("  flux_l_per_tau: 0.31\n  flux_on_tau: 0\n  flux_off_tau: 25\n", 0.31);
    unit_ok(fake_measure(&f, "pressure-drop", "to_tau", 20, &m), &f.fault);
    ck_assert_double_eq_tol(value(&m, "above"), (5 * 1.01 + 6 * 0.99) / 11, 1e-5);
    measurement_free(&m);
    f = write_constant(on, 0.31); /* injection ends at 25 tau */
    unit_ok(fake_measure(&f, "pressure-drop", "to_tau", 30, &m), &f.fault);
    ck_assert(isnan(value(&m, "above")));
    ck_assert_ptr_nonnull(strstr(m.reason, "10 to 30 tau is not a time of injection"));
    measurement_free(&m);
}
END_TEST

START_TEST(fluxes_that_make_no_sense_are_refused) {
    struct measurement m;
    struct fake_run f = write_constant("  flux_l_per_tau: 0\n  flux_on_tau: 0\n"
                                       "  flux_off_tau: 99\n  flux_schedule_every_tau: 3\n"
                                       "  flux_schedule_l_per_tau: [.02, .05, .03, .04]\n",
                                       0);
    ck_assert_int_eq(fake_measure(&f, "pressure-drop", NULL, 0, &m), STATUS_BAD_INPUT);
    unit_says(&f.fault, "value 4, 0.04, after 0.03");
    f = write_constant("  flux_l_per_tau: 0.1\n  flux_on_tau: 0\n  flux_off_tau: 99\n"
                       "  flux_schedule_every_tau: 3\n  flux_schedule_l_per_tau: [.02, .05]\n",
                       0);
    ck_assert_int_eq(fake_measure(&f, "pressure-drop", NULL, 0, &m), STATUS_BAD_INPUT);
    unit_says(&f.fault, "beside a schedule");
}
END_TEST

int main(void) {
    const TTest *const tests[] = {the_break_is_where_it_was_planted,
                                  the_bed_at_rest_has_its_fraction_and_creep,
                                  a_falling_bed_is_not_below_unless_asked_for,
                                  curves_show_both_ways_the_lines_and_time,
                                  without_its_freeboard_the_ratio_is_off,
                                  too_few_points_are_no_break,
                                  a_constant_flux_gives_the_ratio_above_only,
                                  fluxes_that_make_no_sense_are_refused,
                                  NULL};
    return unit_run("observe_drop", tests);
}
