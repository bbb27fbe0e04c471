/* test_observe_packed.c -- a settled bed of known density, height and quietness. */
#include "tests/unit/bed_sample.h"

static const char BOX[] = "  width_l: 12\n  height_l: 60\n  gravity: 1.3\n  froude: 0.7\n";
static const double RADIUS[] = {0.17, 0.23, 0.251};

/* .59 below 3 l, .5637 from there to the top. */
static void write_frame(struct fake_run *f, double time, double top, double energy, double overlap,
                        double asleep) {
    static double rho[BED_SITES];
    memset(rho, 0, sizeof rho);
    bed_sample_add(rho, 0, 3, 0.59);
    bed_sample_add(rho, 3, top, 0.5637);
    fake_field(f, "fields/solid_fraction", BED_NX, BED_NY, rho, time, 0.0125);
    fake_scalar(f, "observables/kinetic_energy", energy, time, 0.0125);
    fake_scalar(f, "observables/largest_overlap", overlap, time, 0.0125);
    fake_scalar(f, "observables/sleeping", asleep, time, 0.0125);
}

static struct fake_run write_bed(void) {
    struct fake_run f = fake_start(BOX);
    fake_array(&f, "particles/grains/radius", RADIUS, 3);
    write_frame(&f, 29.5, 40, 7.7, 0.09, 3); /* before the window: wilder in every way */
    write_frame(&f, 30, 32, 0.0031, 0.0217, 1);
    write_frame(&f, 35, 31.5, 0.0017, 0.0311, 2);
    write_frame(&f, 40, 31, 0.0009, 0.0251, 3);
    return f;
}

START_TEST(a_bed_has_its_fraction_height_and_centre) {
    struct measurement m;
    struct fake_run f = write_bed();
    unit_ok(fake_measure(&f, "packed-bed", NULL, 0, &m), &f.fault);
    ck_assert_double_eq_tol(fake_value(&m, "packed-bed", "solid_fraction"), 0.5637, 1e-6);
    ck_assert_double_eq_tol(fake_value(&m, "packed-bed", "height"), 31.5, 1e-4);
    double bulk = 0, centre = 0;
    for (double top = 31; top < 32.1; top += 0.5) {
        double load = 0.59 * 3 + 0.5637 * (top - 3);
        bulk += load / top / 3;
        centre += (0.59 * 4.5 + 0.5637 * (top * top - 9) / 2) / load / 3;
    }
    ck_assert_double_eq_tol(fake_value(&m, "packed-bed", "bulk_fraction"), bulk, 1e-6);
    ck_assert_double_eq_tol(fake_value(&m, "packed-bed", "centre_of_mass"), centre, 1e-6);
    ck_assert_double_eq_tol(fake_value(&m, "packed-bed", "sinking"), 0.1, 1e-6);
    measurement_free(&m);
    f = write_bed(); /* a narrower margin takes in some of the dense floor */
    unit_ok(fake_measure(&f, "packed-bed", "margin_l", 1.5, &m), &f.fault);
    ck_assert_double_gt(fake_value(&m, "packed-bed", "solid_fraction"), 0.5637 + 1e-3);
    measurement_free(&m);
    f = write_bed(); /* nor does the frame before the window, unless it is asked for */
    unit_ok(fake_measure(&f, "packed-bed", "from_tau", 29, &m), &f.fault);
    ck_assert_double_gt(fake_value(&m, "packed-bed", "height"), 33);
    ck_assert_double_eq(fake_value(&m, "packed-bed", "largest_overlap"), 0.09);
    measurement_free(&m);
}
END_TEST

START_TEST(quietness_is_energy_over_what_lifts_a_grain) {
    struct measurement m;
    struct fake_run f = write_bed();
    double lift = 0;
    for (size_t i = 0; i < 3; i++)
        lift += M_PI * pow(RADIUS[i], 2) * 2 * RADIUS[i] * 1.3 / 0.7;
    unit_ok(fake_measure(&f, "packed-bed", NULL, 0, &m), &f.fault);
    ck_assert_double_eq_tol(fake_value(&m, "packed-bed", "kinetic_energy"), 0.0019 / lift, 1e-12);
    ck_assert_double_eq(fake_value(&m, "packed-bed", "largest_overlap"), 0.0311);
    ck_assert_double_eq_tol(fake_value(&m, "packed-bed", "sleeping_share"), 2.0 / 3, 1e-12);
    measurement_free(&m);
}
END_TEST

START_TEST(what_is_missing_is_said) {
    struct measurement m;
    struct fake_run f = write_bed();
    unit_ok(fake_measure(&f, "packed-bed", "from_tau", 50, &m), &f.fault);
    ck_assert(isnan(fake_value(&m, "packed-bed", "height")));
    ck_assert(isnan(fake_value(&m, "packed-bed", "kinetic_energy")));
    ck_assert_ptr_nonnull(strstr(m.reason, "no frame after 50 tau"));
    measurement_free(&m);
    f = write_bed();
    unit_ok(fake_measure(&f, "packed-bed", "margin_l", 16, &m), &f.fault);
    ck_assert(isnan(fake_value(&m, "packed-bed", "solid_fraction")));
    ck_assert_double_eq_tol(fake_value(&m, "packed-bed", "height"), 31.5, 1e-4);
    measurement_free(&m);
    f = write_bed();
    unit_ok(fake_measure(&f, "packed-bed", "from_tau", 34, &m), &f.fault);
    ck_assert(isnan(fake_value(&m, "packed-bed", "sinking")));
    ck_assert_ptr_nonnull(strstr(m.reason, "3 needed"));
    measurement_free(&m);
    f = fake_start(BOX);
    fake_array(&f, "particles/grains/radius", RADIUS, 3);
    ck_assert_int_ne(fake_measure(&f, "packed-bed", NULL, 0, &m), STATUS_OK);
}
END_TEST

int main(void) {
    const TTest *const tests[] = {a_bed_has_its_fraction_height_and_centre,
                                  quietness_is_energy_over_what_lifts_a_grain,
                                  what_is_missing_is_said, NULL};
    return unit_run("observe_packed", tests);
}
