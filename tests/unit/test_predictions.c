/* test_predictions.c -- theory by another road: quadrature and integration in time. */
#include "tests/unit/unit.h"
#include "validation/prediction.h"

#include <math.h>

static double at(const char *name, const double *input) {
    const struct prediction *p = prediction_find(name);
    ck_assert_msg(p != NULL, "no prediction %s", name);
    return p->at(input);
}

START_TEST(names_are_unique_and_inputs_end) {
    size_t count;
    const struct prediction *const *all = prediction_all(&count);
    for (size_t i = 0; i < count; i++) {
        ck_assert_ptr_eq(prediction_find(all[i]->name), all[i]);
        ck_assert_ptr_null(all[i]->input[PREDICTION_MAX_INPUTS - 1]);
        ck_assert_ptr_nonnull(all[i]->source);
    }
    ck_assert_ptr_null(prediction_find("settling-own-law"));
}
END_TEST

/* Grains of one speed in a closed column, Eqs. 8 and 11 integrated in time: the
 * pressure gradient G obeys (1/Pe) G = u/K at once (small Pe), and Fr dv/dt =
 * 1 - G/(Pe rho').  The speed tends to the own law. */
static double terminal_speed(double rho, double rho_min, int exponent) {
    double clipped = rho > rho_min ? rho : rho_min, v = 0;
    double k = 1;
    for (int i = 0; i < exponent; i++)
        k *= 1 - clipped;
    k /= clipped * clipped;
    for (int step = 0; step < 1000000; step++)
        v += 1e-4 * (1 - v * rho / clipped / k / clipped);
    return v;
}

START_TEST(own_laws_are_where_grains_stop_accelerating) {
    const double rho[] = {0.137, 0.2431, 0.313, 0.4971};
    for (size_t i = 0; i < 4; i++) {
        double in[] = {rho[i], 0.25};
        ck_assert_double_eq_tol(at("settling-own-law-published", in),
                                terminal_speed(rho[i], 0.25, 4), 1e-9);
        ck_assert_double_eq_tol(at("settling-own-law-corrected", in),
                                terminal_speed(rho[i], 0.25, 3), 1e-9);
        double v = at("settling-own-law-published", in);
        double drag[] = {0.3 * v, rho[i], 0.25, 1.3, 1};
        ck_assert_double_eq_tol(at("settling-acceleration-published", drag), -0.7 / 1.3, 1e-14);
    }
    ck_assert_double_eq_tol(at("settling-eq20", (double[]){0.4}), 0.216 / 0.56, 1e-15);
}
END_TEST

START_TEST(darcy_drop_is_the_integral_of_its_gradient) {
    double in[] = {0.31, 2e-4, 13, 0.43, 0.25}, sum = 0;
    for (int i = 0; i < 1000; i++) /* dp = -q Pe dz/K, in slices */
        sum += in[0] * in[1] * (in[2] / 1000) / (pow(1 - in[3], 4) / (in[3] * in[3]));
    ck_assert_double_eq_tol(at("darcy-drop-published", in), sum, 1e-12 * sum);
    ck_assert_double_eq_tol(at("darcy-drop-corrected", in), sum * (1 - in[3]), 1e-12 * sum);
}
END_TEST

/* (1+p) dp/dz = -Pe q/K by small steps; then the bend read off the curve. */
START_TEST(full_column_follows_from_its_flux) {
    enum { N = 200000 };
    static double p[N + 1];
    double in[] = {0.5, 0.02, 0.45, 0.25}, k = pow(0.55, 4) / 0.2025, h = 20.0 / N;
    p[0] = 0.21;
    for (int i = 0; i < N; i++) {
        double half = p[i] - h / 2 * in[1] * in[0] / (k * (1 + p[i]));
        p[i + 1] = p[i] - h * in[1] * in[0] / (k * (1 + half));
    }
    double slope = ((1 + p[N]) * (1 + p[N]) - (1 + p[0]) * (1 + p[0])) / 20, bend = 0;
    ck_assert_double_eq_tol(at("full-square-slope-published", in), slope, 1e-9);
    for (int i = 0; i <= N; i++)
        bend = fmax(bend, p[i] - p[0] - (p[N] - p[0]) * i / N);
    double drop = p[0] - p[N], ends[] = {drop, (p[0] + p[N]) / 2};
    ck_assert_double_eq_tol(at("full-bend", ends), bend / drop, 1e-8);
}
END_TEST

/* One step of the heat equation on a line of sites, by hand. */
START_TEST(mode_rates_are_those_of_the_difference_equation) {
    enum { N = 12 };
    double p[N + 1], k = 0.31640625 / 0.0625, d = k / (0.75 * 3.7);
    for (int i = 0; i <= N; i++)
        p[i] = cos(M_PI * 3 * i / N);
    double in[] = {3, 0, N, 9, 3.7, 0, 0.25};
    double lattice = at("mode-decay-lattice-published", in);
    for (int i = 1; i < N; i++) {
        double laplacian = p[i + 1] - 2 * p[i] + p[i - 1];
        ck_assert_double_eq_tol(d * laplacian, -lattice * p[i], 1e-13 * d);
    }
    ck_assert_double_eq_tol(d * 2 * (p[1] - p[0]), -lattice * p[0], 1e-13 * d); /* half a cell */
    double fine[] = {3, 0, 12000, 9, 3.7, 0, 0.25};
    ck_assert_double_eq_tol(at("mode-decay-published", fine),
                            at("mode-decay-lattice-published", fine), 1e-6 * d);
    ck_assert_double_eq_tol(at("mode-decay-corrected", in) * 0.75, at("mode-decay-published", in),
                            1e-12);
    ck_assert_double_gt(at("mode-decay-lattice-corrected", in), lattice);
}
END_TEST

START_TEST(a_grain_floats_at_the_neutral_flux) {
    double published = at("neutral-flux-published", (double[]){0.25, 1});
    double corrected = at("neutral-flux-corrected", (double[]){0.25, 1});
    ck_assert_double_eq_tol(published, 1.265625, 1e-15);
    ck_assert_double_eq_tol(corrected, 1.6875, 1e-15);
    double in[] = {published, 0.25, 1.7, 1};
    ck_assert_double_eq_tol(at("grain-acceleration-published", in), 0, 1e-15);
    in[0] = 1.9 * corrected;
    ck_assert_double_eq_tol(at("grain-acceleration-corrected", in), 0.9 / 1.7, 1e-14);
}
END_TEST

/* Mean overlap at the step's end: relative normal speeds v of colliding pairs are
 * distributed as v exp(-v^2/(4 v_th^2)), and the step is a random share over. */
START_TEST(the_step_shrinks_discs_by_the_mean_overlap) {
    double flux = 0, depth = 0;
    for (double v = 5e-4; v < 14; v += 1e-3) {
        double weight = v * exp(-v * v / 4);
        flux += weight;
        depth += weight * v / 2;
    }
    double shrinkage = depth / flux, eta = 0.5, h = 1e-4; /* in v_th dt */
    double z[2];
    for (int i = 0; i < 2; i++) {
        double smaller = 1 - (i ? h : 0) * shrinkage;
        z[i] = at("disc-compressibility", (double[]){eta * smaller * smaller});
    }
    ck_assert_double_eq_tol(at("disc-step-slope", (double[]){eta}), log(z[1] / z[0]) / h, 2e-3);
    const double per_cent[][2] = {{0.3, -1.6}, {0.5, -3.7}, {0.6, -5.5}};
    for (int i = 0; i < 3; i++)
        ck_assert_double_eq_tol(at("disc-step-slope", per_cent[i]), per_cent[i][1], 0.15);
    ck_assert_double_eq_tol(at("disc-compressibility-henderson", (double[]){0.5}), 4.125, 1e-14);
}
END_TEST

/* The drop of a bed at rest grows in proportion to the flux; it carries the bed where
 * it is the weight: found by halving, slice by slice. */
static double carrying_flux(double rho, double gravity, int exponent) {
    double low = 0, high = 100, k = pow(1 - rho, exponent) / (rho * rho);
    for (int i = 0; i < 200; i++) {
        double q = (low + high) / 2, drop = 0, weight = 0;
        for (int slice = 0; slice < 100; slice++) {
            drop += q / k * 0.31;
            weight += gravity * rho * 0.31;
        }
        *(drop < weight ? &low : &high) = q;
    }
    return low;
}

START_TEST(a_bed_is_carried_where_the_drop_is_its_weight) {
    double in[] = {0.5673, 1.3};
    ck_assert_double_eq_tol(at("minimum-fluidization-published", in), carrying_flux(0.5673, 1.3, 4),
                            1e-13);
    ck_assert_double_eq_tol(at("minimum-fluidization-corrected", in), carrying_flux(0.5673, 1.3, 3),
                            1e-13);
    ck_assert_double_eq_tol(at("plug-speed", (double[]){0.31, 0.0637}), 0.2463, 1e-15);
    double plug[] = {0.31, 1.07, 0.5673, 1.3};
    ck_assert_double_eq_tol(at("plug-speed-published", plug),
                            0.31 - 1.07 * carrying_flux(0.5673, 1.3, 4), 1e-13);
    ck_assert_double_eq_tol(at("plug-speed-corrected", plug),
                            0.31 - 1.07 * carrying_flux(0.5673, 1.3, 3), 1e-13);
}
END_TEST

/* The cap's area by slices of the circle above its chord. */
START_TEST(a_plane_bubble_rises_with_the_root_of_its_nose) {
    const double angle[] = {37, 60, 90, 180};
    for (size_t i = 0; i < 4; i++) {
        double radius = 1.7, g = 0.6, area = 0, low = radius * cos(angle[i] * M_PI / 180);
        for (int s = 0; s < 1000000; s++) {
            double y = low + (radius - low) * (s + 0.5) / 1e6;
            area += 2 * sqrt(radius * radius - y * y) * (radius - low) / 1e6;
        }
        double root = sqrt(g * sqrt(4 * area / M_PI)), speed = 0.5 * sqrt(g * radius);
        ck_assert_double_eq_tol(at("plane-bubble-rise", (double[]){root, angle[i]}), speed, 1e-6);
        ck_assert_double_eq_tol(at("plane-bubble-coefficient", &angle[i]), speed / root, 1e-6);
    }
}
END_TEST

int main(void) {
    const TTest *const tests[] = {names_are_unique_and_inputs_end,
                                  own_laws_are_where_grains_stop_accelerating,
                                  darcy_drop_is_the_integral_of_its_gradient,
                                  full_column_follows_from_its_flux,
                                  mode_rates_are_those_of_the_difference_equation,
                                  a_grain_floats_at_the_neutral_flux,
                                  the_step_shrinks_discs_by_the_mean_overlap,
                                  a_bed_is_carried_where_the_drop_is_its_weight,
                                  a_plane_bubble_rises_with_the_root_of_its_nose,
                                  NULL};
    return unit_run("predictions", tests);
}
