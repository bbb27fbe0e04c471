/* test_hydrostatic.c -- the profile of a bed at rest by other roads: closed limits,
 * quadrature, relaxation in time, balances of forces. */
#include "tests/unit/unit.h"
#include "validation/bed_rest.h"
#include "validation/sphere_laws.h"

#include <gsl/gsl_integration.h>
#include <math.h>

static const struct hydrostatic_bed BED = {
    .phibar = 0.413, .a_R = 0.317, .layer_R = 9.3, .column_R = 47.9, .width_R = {29.3, 31.1}};

static struct hydrostatic_profile solve(const struct hydrostatic_bed *bed) {
    struct hydrostatic_profile out;
    struct fault fault = FAULT_NONE;
    unit_ok(hydrostatic_solve(bed, &out, &fault), &fault);
    return out;
}

static double total(const struct hydrostatic_profile *p) {
    double sum = 0;
    for (size_t i = 0; i < p->count; i++)
        sum += p->fraction[i] * p->spacing_R;
    return sum;
}

static struct interface_fit edge(const struct hydrostatic_profile *p, double phibar) {
    struct fault fault = FAULT_NONE;
    struct interface_fit fit;
    struct interface_window w = {10, phibar, false};
    unit_ok(interface_fit(p->height_R, p->fraction, p->count, &w, &fit, &fault), &fault);
    return fit;
}

START_TEST(every_sphere_is_in_the_profile) {
    struct hydrostatic_bed bed = BED;
    for (int k = 0; k < 4; k++) {
        bed.walls[0] = bed.floor = k & 1;
        bed.local_temperature = k & 2;
        bed.heat_ratio = 1.23;
        struct hydrostatic_profile p = solve(&bed);
        ck_assert_double_eq_tol(total(&p), 47.9, 1e-9);
        for (size_t i = 1; i < p.count; i++)
            ck_assert_double_gt(p.fraction[i], 0);
        hydrostatic_free(&p);
    }
}
END_TEST

/* Far above the bed a sphere feels -phibar alone: a gas under gravity, exp(-phibar z/a). */
START_TEST(the_dilute_end_is_barometric) {
    struct hydrostatic_profile p = solve(&BED);
    size_t i = p.count - 40, j = p.count - 10;
    double fall = log(p.fraction[i] / p.fraction[j]) / (p.height_R[j] - p.height_R[i]);
    ck_assert_double_lt(p.fraction[i], 1e-8);
    ck_assert_double_eq_tol(fall, 0.413 / 0.317, 1e-5);
    hydrostatic_free(&p);
}
END_TEST

/* z(phi) of the local bed by quadrature: a S(p)/(p (p - phibar)) dp = dz. */
static double climb_of(double p, void *context) {
    const struct hydrostatic_bed *bed = context;
    return bed->a_R * spheres_stiffness(p) / (p * (p - bed->phibar));
}

/* With a layer much thinner than the edge the lift is that of the place, and the height between
 * two packing fractions is an integral. */
START_TEST(a_thin_layer_is_the_local_law) {
    struct hydrostatic_bed bed = BED;
    bed.layer_R = 0.2;
    bed.column_R = 60;
    struct hydrostatic_profile p = solve(&bed);
    gsl_integration_workspace *w = gsl_integration_workspace_alloc(200);
    gsl_function f = {climb_of, &bed};
    size_t low = 0, high;
    while (p.fraction[low] > 0.39)
        low++;
    for (high = low; p.fraction[high] > 0.007; high++)
        ;
    double way, error;
    gsl_integration_qag(&f, p.fraction[low], p.fraction[high], 0, 1e-9, 200, 6, w, &way, &error);
    ck_assert_double_eq_tol(p.height_R[high] - p.height_R[low], way, 2e-3 * way);
    ck_assert_double_gt(way, 8);
    gsl_integration_workspace_free(w);
    hydrostatic_free(&p);
}
END_TEST

/* The layer's average by the trapezoidal rule over the profile itself. */
static double lift(const struct hydrostatic_bed *bed, const struct hydrostatic_profile *p,
                   double z) {
    double sum = 0, low = fmax(z - bed->layer_R / 2, 0), high = z + bed->layer_R / 2;
    for (size_t i = 0; i < p->count; i++) {
        double from = fmax(low, p->height_R[i] - p->spacing_R / 2);
        double to = fmin(high, p->height_R[i] + p->spacing_R / 2);
        sum += to > from ? (to - from) * p->fraction[i] : 0;
    }
    return sum / (high - low) - bed->phibar;
}

/* What all above weighs, by summing forces sphere by sphere, is the pressure there, for any
 * temperature: no equation of the solver is used. */
START_TEST(the_pressure_carries_what_is_above) {
    struct hydrostatic_bed bed = BED;
    for (int local = 0; local < 2; local++) {
        bed.local_temperature = local;
        bed.heat_ratio = 1.31;
        bed.spacing_R = 0.08;
        struct hydrostatic_profile p = solve(&bed);
        double weight = 0;
        for (size_t i = p.count; i-- > 1;) {
            weight -= p.fraction[i] * lift(&bed, &p, p.height_R[i]) * p.spacing_R;
            double phi = (p.fraction[i] + p.fraction[i - 1]) / 2;
            double carried =
                bed.a_R * phi * spheres_compressibility(phi) * hydrostatic_temperature(&bed, phi);
            if (i % 37 == 0 && phi > 1e-3)
                ck_assert_double_eq_tol(carried, weight, 0.01 * carried);
        }
        ck_assert_double_gt(weight, 0.5);
        hydrostatic_free(&p);
    }
}
END_TEST

/* The same bed as the end of an overdamped motion, by explicit steps:
 * d phi/dt = -d/dz [phi lift - a d(phi Z)/dz]. */
START_TEST(relaxation_in_time_ends_at_the_same_profile) {
    enum { N = 290 };
    struct hydrostatic_bed bed = BED;
    bed.column_R = 21.3;
    bed.spacing_R = 9.3 / 2 / 16;
    struct hydrostatic_profile p = solve(&bed);
    double phi[N], flux[N + 1] = {0}, d = p.spacing_R, dt = 0.0035;
    struct hydrostatic_profile now = {
        .count = N, .height_R = p.height_R, .fraction = phi, .spacing_R = d};
    ck_assert_uint_ge(p.count, N);
    for (int i = 0; i < N; i++)
        phi[i] = (i + 1) * d < 21.3 / 0.45 ? 0.45 : 1e-9;
    double scale = 21.3 / total(&now);
    for (int i = 0; i < N; i++)
        phi[i] *= scale;
    for (int step = 0; step < 200000; step++) {
        double above[N + 1] = {0};
        for (int i = N; i-- > 0;)
            above[i] = above[i + 1] + phi[i] * d;
        for (int i = 1; i < N; i++) {
            int low = i > 16 ? i - 16 : 0, high = i + 16 < N ? i + 16 : N;
            double thick = i * d + 16 * d - fmax(i * d - 16 * d, 0);
            double force = (above[low] - above[high]) / thick - bed.phibar;
            double push = phi[i] * spheres_compressibility(phi[i]) -
                          phi[i - 1] * spheres_compressibility(phi[i - 1]);
            double ratio = phi[i] / phi[i - 1];
            double mean = fabs(ratio - 1) < 1e-6 ? phi[i] : phi[i - 1] * (ratio - 1) / log(ratio);
            flux[i] = mean * force - bed.a_R * push / d;
        }
        for (int i = 0; i < N; i++)
            phi[i] -= dt * (flux[i + 1] - flux[i]) / d;
    }
    struct interface_fit relaxed = edge(&now, bed.phibar), solved = edge(&p, bed.phibar);
    ck_assert_double_eq_tol(relaxed.sigma_R, solved.sigma_R, 1e-4 * solved.sigma_R);
    ck_assert_double_eq_tol(relaxed.height_R, solved.height_R, 1e-3);
    for (int i = 8; i < N; i += 17)
        ck_assert_double_eq_tol(phi[i], p.fraction[i], 2e-5);
    hydrostatic_free(&p);
}
END_TEST

START_TEST(half_the_spacing_gives_the_same_edge) {
    struct hydrostatic_bed bed = BED;
    struct hydrostatic_profile chosen = solve(&bed);
    bed.spacing_R = chosen.spacing_R / 3;
    struct hydrostatic_profile fine = solve(&bed);
    double sigma = edge(&fine, 0.413).sigma_R;
    ck_assert_double_eq_tol(edge(&chosen, 0.413).sigma_R, sigma, 2e-3 * sigma);
    hydrostatic_free(&chosen);
    hydrostatic_free(&fine);
}
END_TEST

/* Depth free at a wall: R less the excess over the density, the excess from a numerical
 * derivative of the tension. Without density a wall keeps R free. */
START_TEST(walls_crowd_as_their_tension_says) {
    for (double p = 0.07; p < 0.5; p += 0.11) {
        double h = 1e-5, tension[2];
        for (int i = 0; i < 2; i++) {
            double x = p + (i ? h : -h);
            tension[i] = -9 / (2 * M_PI) * x * x * (1 + x) / pow(1 - x, 3) / 4; /* T/R^2 */
        }
        double slope = (tension[1] - tension[0]) / (2 * h) / (spheres_stiffness(p) / p);
        double density = p / (4 * M_PI / 3);
        ck_assert_double_eq_tol(hydrostatic_depth_R(p), 1 + slope / density, 1e-7);
    }
    ck_assert_double_eq_tol(hydrostatic_depth_R(1e-9), 1, 1e-8);
    struct hydrostatic_bed bed = BED;
    bed.walls[0] = bed.walls[1] = true;
    double p = hydrostatic_bulk_of(&bed, 0.379);
    ck_assert_double_gt(p, 0.379 * 1.02);
    ck_assert_double_eq_tol(hydrostatic_fraction_of(&bed, p), 0.379, 1e-12);
}
END_TEST

/* Twice the temperature and twice the drive is the same bed. */
START_TEST(only_temperature_over_drive_counts) {
    double in[BED_INPUTS] = {0.37, 4.65, 9.79, 0.61, 0.29, 1.9e-9, 2.7, 5.7e-4, 2.2e-6,
                             9.1,  9100, 29,   31,   4.9,  0.73,   1,   10.1,   0};
    struct fault fault = FAULT_NONE;
    struct hydrostatic_profile p;
    struct interface_fit one, two;
    unit_ok(bed_rest_solve(in, false, &p, &fault), &fault);
    unit_ok(bed_rest_fit(in, &p, &one, &fault), &fault);
    hydrostatic_free(&p);
    in[BED_DRIVE_SCALE] *= 2;
    in[BED_THERMAL_J] *= 2;
    unit_ok(bed_rest_solve(in, false, &p, &fault), &fault);
    unit_ok(bed_rest_fit(in, &p, &two, &fault), &fault);
    hydrostatic_free(&p);
    ck_assert_double_eq_tol(one.sigma_R, two.sigma_R, 1e-9);
    in[BED_THERMAL_J] *= 1.3;
    unit_ok(bed_rest_solve(in, false, &p, &fault), &fault);
    unit_ok(bed_rest_fit(in, &p, &two, &fault), &fault);
    hydrostatic_free(&p);
    ck_assert_double_gt(two.sigma_R, 1.2 * one.sigma_R);
    ck_assert_double_eq_tol(bed_rest_height_R(in), 9100 * 4 * M_PI / 3 / (29 * 31 * 0.37), 1e-9);
}
END_TEST

/* Balance of powers at each height: what kicks give is the same everywhere. */
START_TEST(dilute_spheres_are_hotter) {
    struct hydrostatic_bed bed = BED;
    bed.local_temperature = true;
    bed.heat_ratio = 1.17;
    ck_assert_double_eq_tol(hydrostatic_temperature(&bed, 0.413), 1, 1e-12);
    ck_assert_double_eq_tol(hydrostatic_temperature(&bed, 0), 1 + 1.17, 1e-9);
    for (double p = 0.02; p < 0.5; p += 0.07) {
        double t = hydrostatic_temperature(&bed, p);
        double rate = p * spheres_contact(p) / (0.413 * spheres_contact(0.413)) * sqrt(t);
        ck_assert_double_eq_tol(t * (1 + 1.17 * rate), 1 + 1.17, 1e-10);
    }
    struct hydrostatic_profile cool = solve(&BED), hot = solve(&bed);
    ck_assert_double_gt(edge(&hot, 0.413).sigma_R, 1.1 * edge(&cool, 0.413).sigma_R);
    hydrostatic_free(&cool);
    hydrostatic_free(&hot);
}
END_TEST

START_TEST(what_is_no_bed_is_refused) {
    struct hydrostatic_bed bed = BED;
    struct hydrostatic_profile p;
    struct fault fault = FAULT_NONE;
    bed.column_R = 3;
    ck_assert_int_eq(hydrostatic_solve(&bed, &p, &fault), STATUS_BAD_INPUT);
    unit_says(&fault, "no bed: phibar 0.413");
    ck_assert_ptr_null(p.height_R);
    bed = BED;
    bed.phibar = NAN;
    ck_assert_int_eq(hydrostatic_solve(&bed, &p, &fault), STATUS_BAD_INPUT);
}
END_TEST

int main(void) {
    const TTest *const tests[] = {every_sphere_is_in_the_profile,
                                  the_dilute_end_is_barometric,
                                  a_thin_layer_is_the_local_law,
                                  the_pressure_carries_what_is_above,
                                  relaxation_in_time_ends_at_the_same_profile,
                                  half_the_spacing_gives_the_same_edge,
                                  walls_crowd_as_their_tension_says,
                                  only_temperature_over_drive_counts,
                                  dilute_spheres_are_hotter,
                                  what_is_no_bed_is_refused,
                                  NULL};
    return unit_run("hydrostatic", tests);
}
