/* test_observe_bed.c -- a made-up plug that rises and sinks, colours that mix, rows that stay. */
#include "tests/unit/bed_sample.h"
#include "validation/bed_column.h"
#include "validation/bed_grains.h"
#include "validation/closures.h"

enum { W = 12, H = 60, FRAMES = 21, LINES = 40, COLUMNS = 24, GRAINS = LINES * COLUMNS };

static const char BOX[] = "  width_l: 12\n  height_l: 60\n  flux_on_tau: 1\n";

/* Every 1 tau: up by .5 l until 14 tau, then down again, with a kick in the plug's window.
 * Multiples of .5 l, at which the halo's blurred edge has its half where the edge is. */
static double top_at(size_t f) {
    double plug = 30 + 0.5 * (f < 14 ? (double)f : 28 - (double)f);
    return plug + (f == 4 ? 0.5 : f == 0 ? 9 : 0);
}

/* A grain of the lattice of lines; the first frame stands for the time before injection. */
static void place(size_t k, size_t f, double *x, double *start) {
    double y = ((double)(k / COLUMNS) + 0.5) * 0.25; /* two lines a row of .5 l */
    double moved = y > 0.6 ? 0.03 * (y - 0.6) * (double)(f ? f - 1 : 0) : 0;
    start[0] = 0.5 + 0.45 * (double)(k % COLUMNS);
    start[1] = y;
    x[0] = start[0] + 0.06 * moved * (k % 2 ? 1 : -1);
    x[1] = start[1] + sqrt(1 - 0.06 * 0.06) * moved;
    if (f == 0) /* elsewhere before injection begins at 1 tau */
        x[0] += 0.3;
}

static struct fake_run write_run(size_t frames, int species_lines) {
    static double rho[BED_SITES], x[2 * GRAINS], radius[GRAINS], species[GRAINS];
    struct fake_run f = fake_start(BOX);
    for (size_t k = 0; k < GRAINS; k++) {
        radius[k] = 0.17 + 0.001 * (double)(k % 61);
        species[k] = species_lines ? (double)(k / COLUMNS / (size_t)species_lines % 2) : 0;
    }
    fake_array(&f, "particles/grains/radius", radius, GRAINS);
    fake_array(&f, "particles/grains/species", species, GRAINS);
    for (size_t frame = 0; frame < frames; frame++) {
        double top = top_at(frame), start[2];
        memset(rho, 0, sizeof rho);
        bed_sample_add(rho, 0, 2.5, 0.61);
        bed_sample_add(rho, 2.5, top, 0.5137);
        for (size_t k = 0; k < GRAINS; k++)
            place(k, frame, x + 2 * k, start);
        fake_field(&f, "fields/solid_fraction", BED_NX, BED_NY, rho, (double)frame, 0.0125);
        fake_vectors(&f, "particles/grains/position", GRAINS, x, (double)frame, 0.0125);
    }
    return f;
}

static double value(const struct measurement *m, const char *output) {
    return fake_value(m, "bed-motion", output);
}

START_TEST(a_plug_has_its_speed_peak_and_drift) {
    struct measurement m;
    struct fake_run f = write_run(FRAMES, 0);
    unit_ok(fake_measure(&f, "bed-motion", "end_tau", 4, &m), &f.fault);
    /* The line through seven points of slope .5, the third .5 too high, by hand. */
    double slope = 0.5 + 0.5 * -1 / 28, residual = 0, error;
    for (int i = -3; i <= 3; i++) {
        double y = (i == -1 ? 0.5 : 0) - 0.5 / 7 + 0.5 / 28 * i;
        residual += y * y;
    }
    error = sqrt(residual / 5 / 28);
    ck_assert_double_eq_tol(value(&m, "plug_speed"), slope, 1e-5);
    ck_assert_double_eq_tol(value(&m, "plug_speed_error"), error, 1e-5);
    ck_assert_double_eq_tol(value(&m, "top_peak"), 37, 1e-4); /* not the 39 before injection */
    ck_assert_double_eq_tol(value(&m, "top_end_drift"), -2, 1e-4);
    measurement_free(&m);
}
END_TEST

/* A plug of any height between the rows: its marker moves as far as it does. */
START_TEST(the_marker_moves_with_the_plug_between_rows) {
    static double rho[BED_SITES];
    struct observe_box box = {.width_l = W, .height_l = H, .nx = BED_NX, .ny = BED_NY};
    double worst = 0;
    for (int k = 0; k < 20; k++) {
        double lifted = 2.173 + 0.137 * k;
        memset(rho, 0, sizeof rho);
        bed_sample_add(rho, lifted, lifted + 20, 0.5437);
        ck_assert_double_eq_tol(bed_column_marker(rho, &box, 2), lifted + 20 - 2 / 0.5437, 1e-4);
        worst = fmax(worst, fabs(bed_column_measure(rho, &box, 5).top - lifted - 20));
    }
    ck_assert_double_gt(worst, 0.05); /* the top is not that exact */
    ck_assert(isnan(bed_column_marker(rho, &box, 20 * 0.5437 + 0.01)));
}
END_TEST

/* A profile that falls by .004 a row up to row 40: slab and marker are exact between rows. */
START_TEST(a_graded_bed_is_integrated_between_its_rows) {
    static double rho[BED_SITES];
    struct observe_box box = {.width_l = W, .height_l = H, .nx = BED_NX, .ny = BED_NY};
    memset(rho, 0, sizeof rho);
    for (size_t j = 0; j <= 40; j++)
        for (size_t i = 0; i < BED_NX; i++)
            rho[j * BED_NX + i] = (0.6 - 0.004 * (double)j) * bed_sample_wave(i, 0.2);
    struct bed_column c = bed_column_measure(rho, &box, 5.3);
    double top = 40 + (0.44 - 0.26) / 0.44; /* half of the middle row's .52 */
    ck_assert_double_eq_tol(c.top, top, 1e-9);
    ck_assert_double_eq_tol(c.slab_fraction, 0.6 - 0.004 * top / 2, 1e-9);
    double y = bed_column_marker(rho, &box, 1.37);
    ck_assert_double_eq_tol(0.22 + 0.6 * (40 - y) - 0.002 * (1600 - y * y), 1.37, 1e-9);
}
END_TEST

START_TEST(values_are_those_of_the_time_asked_for) {
    struct measurement m;
    struct fake_run f = write_run(FRAMES, 0);
    unit_ok(fake_measure(&f, "bed-motion", "at_tau", 11, &m), &f.fault);
    double top = 35.5, load = 0.61 * 2.5 + 0.5137 * (top - 2.5);
    ck_assert_double_eq_tol(value(&m, "top"), top, 1e-4);
    ck_assert_double_eq_tol(value(&m, "bulk_fraction"), load / top, 1e-6);
    ck_assert_double_eq_tol(value(&m, "slab_fraction"), 0.5137, 1e-6);
    ck_assert_double_eq_tol(value(&m, "centre_of_mass"),
                            (0.61 * 2.5 * 2.5 + 0.5137 * (top * top - 2.5 * 2.5)) / 2 / load, 1e-6);
    ck_assert_uint_eq(m.curve_count, 3); /* one species: no curve of mixing */
    ck_assert_uint_eq(m.curve[1].count, FRAMES);
    measurement_free(&m);
    f = write_run(FRAMES, 0); /* 40 tau was not reached: no value and no guess */
    unit_ok(fake_measure(&f, "bed-motion", NULL, 0, &m), &f.fault);
    ck_assert(isnan(value(&m, "top")) && isnan(value(&m, "static_layer")));
    ck_assert(isnan(value(&m, "mixing")));
    ck_assert_double_eq_tol(value(&m, "top_peak"), 37, 1e-4);
    ck_assert_ptr_nonnull(strstr(m.reason, "40 tau"));
    measurement_free(&m);
}
END_TEST

START_TEST(the_dense_floor_ends_where_its_density_does) {
    struct measurement m;
    struct fake_run f = write_run(FRAMES, 0);
    unit_ok(fake_measure(&f, "bed-motion", "at_tau", 11, &m), &f.fault);
    /* Rows 2 and 3 hold 7/8 and 1/8 of the step from .61 to .5137. */
    double step = 0.61 - 0.5137, level = 0.05 * 0.5137 / step;
    ck_assert_double_eq_tol(value(&m, "dense_layer"), 2 + (0.875 - level) / 0.75, 1e-4);
    measurement_free(&m);
}
END_TEST

START_TEST(rows_that_stay_are_the_static_layer) {
    struct measurement m;
    struct fake_run f = write_run(FRAMES, 0);
    unit_ok(fake_measure(&f, "bed-motion", "at_tau", 20, &m), &f.fault);
    /* .03 (y - .6) 19 = .25 */
    ck_assert_double_eq_tol(value(&m, "static_layer"), 0.6 + 0.25 / 0.57, 1e-9);
    ck_assert_double_eq_tol(value(&m, "left_layer"), 0.6 + 0.25 / (0.57 * sqrt(0.9964)), 1e-9);
    measurement_free(&m);
    f = write_run(FRAMES, 0); /* half the time: the layer reaches farther up */
    unit_ok(fake_measure(&f, "bed-motion", "at_tau", 10, &m), &f.fault);
    ck_assert_double_eq_tol(value(&m, "static_layer"), 0.6 + 0.25 / 0.27, 1e-9);
    measurement_free(&m);
}
END_TEST

/* Mean index of grains at random places, of random colour; denser to the left. */
static double mean_mixing(size_t grains, double cell_l, int trials) {
    static double x[2 * GRAINS], radius[GRAINS], species[GRAINS];
    struct observe_grains g = {.count = grains, .frames = 1, .radius = radius, .position = x};
    struct observe_box box = {.width_l = W, .height_l = H, .nx = BED_NX, .ny = BED_NY};
    struct fault fault = FAULT_NONE;
    unsigned long long state = 88172645463325252ULL;
    double sum = 0, mixing;
    for (int trial = 0; trial < trials; trial++) {
        for (size_t k = 0; k < grains; k++) {
            double u[3];
            for (int n = 0; n < 3; n++) {
                state = state * 6364136223846793005ULL + 1442695040888963407ULL;
                u[n] = (double)(state >> 11) / 9007199254740992.0;
            }
            x[2 * k] = W * u[0] * u[0];
            x[2 * k + 1] = 30 * u[1];
            species[k] = u[2] < 0.3;
        }
        unit_ok(bed_grains_mixing(NULL, &g, &box, species, 0, cell_l, &mixing, &fault), &fault);
        sum += mixing;
    }
    return sum / trials;
}

START_TEST(layers_are_segregated_and_shuffled_grains_are_not) {
    struct measurement m;
    struct fake_run f = write_run(FRAMES, 4); /* layers of 1 l: those of the cells */
    unit_ok(fake_measure(&f, "bed-motion", "at_tau", 20, &m), &f.fault);
    ck_assert_double_eq_tol(value(&m, "mixing_start"), 0, 1e-12);
    ck_assert_double_gt(value(&m, "mixing"), 0.05);
    ck_assert_str_eq(m.curve[m.curve_count - 1].name, "mixing");
    measurement_free(&m);
    ck_assert_double_eq_tol(mean_mixing(GRAINS, 1.3, 100), 1, 0.01);
    ck_assert_double_eq_tol(mean_mixing(30, 10, 1000), 1, 0.02); /* some six cells */
}
END_TEST

/* Load and centre of mass from the lattice are those of the grains themselves. */
START_TEST(the_column_is_that_of_its_grains) {
    static double rho[BED_SITES];
    struct observe_box box = {.width_l = W, .height_l = H, .nx = BED_NX, .ny = BED_NY};
    double solid = 0, moment = 0;
    memset(rho, 0, sizeof rho);
    for (int k = 0; k < 3000; k++) {
        double x = W * fmod(0.6180339887 * k, 1), y = 0.2 + 33 * fmod(0.4142135623 * k, 1);
        double area = 0.09 + 0.0001 * (k % 431);
        struct closure_halo h = closure_halo_at(x, y, BED_NX, BED_NY);
        for (int s = 0; s < 4; s++)
            rho[h.site[s]] +=
                area * h.weight[s] /
                closure_site_volume(h.site[s] % BED_NX, h.site[s] / BED_NX, BED_NX, BED_NY);
        solid += area;
        moment += area * y;
    }
    struct bed_column c = bed_column_measure(rho, &box, 5);
    ck_assert_double_eq_tol(c.load, solid / W, 1e-12 * solid);
    ck_assert_double_eq_tol(c.centre, moment / solid, 1e-11);
    ck_assert_double_eq_tol(c.slab_fraction, solid / W / 33, 0.005);
}
END_TEST

START_TEST(a_run_without_a_bed_is_unusable) {
    static double rho[BED_SITES], x[2] = {1, 1}, radius[1] = {0.2}, species[1] = {0};
    struct measurement m;
    struct fake_run f = fake_start(BOX);
    memset(rho, 0, sizeof rho);
    fake_array(&f, "particles/grains/radius", radius, 1);
    fake_array(&f, "particles/grains/species", species, 1);
    fake_field(&f, "fields/solid_fraction", BED_NX, BED_NY, rho, 3.5, 0.0125);
    fake_vectors(&f, "particles/grains/position", 1, x, 3.5, 0.0125);
    ck_assert_int_eq(fake_measure(&f, "bed-motion", NULL, 0, &m), STATUS_BAD_INPUT);
    unit_says(&f.fault, "no bed at 3.5 tau");
}
END_TEST

int main(void) {
    const TTest *const tests[] = {a_plug_has_its_speed_peak_and_drift,
                                  the_marker_moves_with_the_plug_between_rows,
                                  values_are_those_of_the_time_asked_for,
                                  a_graded_bed_is_integrated_between_its_rows,
                                  the_dense_floor_ends_where_its_density_does,
                                  rows_that_stay_are_the_static_layer,
                                  layers_are_segregated_and_shuffled_grains_are_not,
                                  the_column_is_that_of_its_grains,
                                  a_run_without_a_bed_is_unusable,
                                  NULL};
    return unit_run("observe_bed", tests);
}
