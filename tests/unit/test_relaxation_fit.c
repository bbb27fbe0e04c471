/* test_relaxation_fit.c -- L(t) from noisy profiles, its rate, and what tells the two laws apart.
 */
#include "common/random.h"
#include "tests/unit/unit.h"
#include "validation/ensemble.h"
#include "validation/relaxation_theory.h"

#include <gsl/gsl_randist.h>
#include <math.h>

enum { BINS = 90, STILL = 15, FRAMES = 75, ALL = STILL + FRAMES };
static const double BIN_R = 0.97, DT = 0.02, RATE = 3.17, NOISE = 0.021;

/* A bed whose lower 37 bins fall from .35 by .05 (1 - exp(-RATE t)) at noise of their own. */
static void plant(double *profile, gsl_rng *rng, double noise) {
    for (int f = 0; f < ALL; f++)
        for (int i = 0; i < BINS; i++) {
            double t = DT * (f - STILL + 1), gone = t > 0 && i < 37 ? -expm1(-RATE * t) : 0;
            profile[f * BINS + i] = 0.35 - 0.05 * gone + gsl_ran_gaussian(rng, noise);
        }
}

static void times(double *time) {
    for (int k = 0; k < FRAMES; k++)
        time[k] = DT * (k + 1);
}

START_TEST(noise_is_taken_off) {
    static double profile[ALL * BINS];
    struct fault fault = FAULT_NONE;
    gsl_rng *rng;
    unit_ok(random_stream(71, "noise", &rng, &fault), &fault);
    double square[ALL], floor, sum = 0, still = 0, raw = 0;
    const int rounds = 200;
    for (int n = 0; n < rounds; n++) {
        plant(profile, rng, NOISE);
        unit_ok(relaxation_square(profile, ALL, BINS, BIN_R, STILL, square, &floor, &fault),
                &fault);
        double expected = BINS * BIN_R * NOISE * NOISE * (1 + 1.0 / STILL);
        ck_assert_double_eq_tol(floor, expected, 0.2 * expected);
        raw += floor / rounds;
        sum += (square[ALL - 1] + square[ALL - 2]) / (2 * rounds);
        still += square[STILL] / rounds; /* .02 s after the change: 3e-3 of the plateau */
    }
    double way = 0.05 * -expm1(-RATE * DT * (FRAMES - 0.5)), plateau = 37 * BIN_R * way * way;
    ck_assert_double_eq_tol(sum, plateau, 0.03 * plateau);
    ck_assert_double_eq_tol(still, 0.0036 * plateau, 0.02 * plateau);
    ck_assert_double_gt(raw, 0.3 * plateau); /* it would have been seen */
    gsl_rng_free(rng);
}
END_TEST

START_TEST(without_noise_the_rate_is_exact) {
    static double profile[ALL * BINS];
    struct fault fault = FAULT_NONE;
    gsl_rng *rng;
    unit_ok(random_stream(71, "noise", &rng, &fault), &fault);
    plant(profile, rng, 0);
    double square[ALL], length[FRAMES], time[FRAMES], floor;
    unit_ok(relaxation_square(profile, ALL, BINS, BIN_R, STILL, square, &floor, &fault), &fault);
    ck_assert_double_eq_tol(floor, 0, 1e-25);
    for (int k = 0; k < FRAMES; k++)
        length[k] = relaxation_length(square[STILL + k]);
    times(time);
    struct relaxation_fit fit;
    unit_ok(relaxation_fit(time, length, FRAMES, &fit, &fault), &fault);
    ck_assert_double_eq_tol(fit.rate_per_s, RATE, 1e-6);
    ck_assert_double_eq_tol(fit.plateau, 0.05 * sqrt(37 * BIN_R), 1e-7);
    ck_assert_double_lt(fit.exponential_rms, 1e-7);
    ck_assert_double_gt(fit.root_rms, 0.02);
    ck_assert_double_eq_tol(relaxation_exponential(&fit, 0.41), fit.plateau * -expm1(-RATE * 0.41),
                            1e-6);
    gsl_rng_free(rng);
}
END_TEST

/* A front and a fan that widen and stop. */
START_TEST(the_root_law_is_told_from_the_exponential) {
    struct fault fault = FAULT_NONE;
    double time[FRAMES], length[FRAMES];
    times(time);
    for (int k = 0; k < FRAMES; k++)
        length[k] = 0.83 * sqrt(fmin(time[k], 0.71));
    struct relaxation_fit fit;
    unit_ok(relaxation_fit(time, length, FRAMES, &fit, &fault), &fault);
    ck_assert_double_eq_tol(fit.end_s, 0.71, 2e-3);
    ck_assert_double_eq_tol(fit.growth, 0.83, 1e-3);
    ck_assert_double_lt(fit.root_rms, 0.1 * fit.exponential_rms);
    ck_assert_double_eq_tol(relaxation_root(&fit, 0.3), 0.83 * sqrt(0.3), 1e-3);
    ck_assert_double_eq_tol(relaxation_length(-0.25), -0.5, 1e-15);
}
END_TEST

/* -- all seeds together --------------------------------------------------------------- */

enum { SEEDS = 4, ROUNDS = 60 };

/* A seed of its own rate (they differ by 6 %) with noise, as the recipe would give it. */
static struct measurement seed(gsl_rng *rng, const double *time) {
    struct fault fault = FAULT_NONE;
    struct measurement m = {0};
    double y[FRAMES], rate = RATE * (1 + gsl_ran_gaussian(rng, 0.06));
    for (int k = 0; k < FRAMES; k++) {
        double l = 0.31 * -expm1(-rate * time[k]);
        y[k] = l * l + gsl_ran_gaussian(rng, 0.004);
    }
    unit_ok(measurement_add_curve(&m, "L2", "L^2", time, y, FRAMES, &fault), &fault);
    return m;
}

START_TEST(uncertainty_from_four_seeds_holds_the_truth_as_often_as_it_says) {
    struct fault fault = FAULT_NONE;
    const struct ensemble *e = ensemble_find("relaxation");
    ck_assert_ptr_nonnull(e);
    gsl_rng *rng;
    unit_ok(random_stream(72, "seeds", &rng, &fault), &fault);
    double time[FRAMES], sum = 0;
    int held = 0;
    times(time);
    for (int n = 0; n < ROUNDS; n++) {
        struct measurement m[SEEDS];
        const struct measurement *all[SEEDS];
        double value[3], uncertainty[3];
        for (int i = 0; i < SEEDS; i++) {
            m[i] = seed(rng, time);
            all[i] = &m[i];
        }
        unit_ok(e->fit(all, SEEDS, NULL, value, uncertainty, &fault), &fault);
        held += fabs(value[0] - RATE) <= 1.96 * uncertainty[0];
        sum += value[0] / ROUNDS;
        for (int i = 0; i < SEEDS; i++)
            measurement_free(&m[i]);
    }
    /* 57 of 60 with a standard deviation of 1.7; without Student's factor some 51. */
    ck_assert_int_ge(held, 54);
    ck_assert_double_eq_tol(sum, RATE, 0.02 * RATE);
    gsl_rng_free(rng);
}
END_TEST

START_TEST(seeds_of_different_times_are_refused) {
    struct fault fault = FAULT_NONE;
    gsl_rng *rng;
    unit_ok(random_stream(72, "seeds", &rng, &fault), &fault);
    double time[FRAMES], value[3], uncertainty[3];
    times(time);
    struct measurement a = seed(rng, time);
    time[40] += 0.003;
    struct measurement b = seed(rng, time);
    const struct measurement *all[] = {&a, &b};
    ck_assert_int_eq(ensemble_find("relaxation")->fit(all, 2, NULL, value, uncertainty, &fault),
                     STATUS_BAD_INPUT);
    unit_says(&fault, "L^2 at");
    measurement_free(&a);
    measurement_free(&b);
    gsl_rng_free(rng);
}
END_TEST

/* -- theory ------------------------------------------------------------------------------ */

/* FZ's bed: 1e4 spheres on 16R x 16R. */
static struct bed_change bed(double before, double after) {
    return (struct bed_change){.before = before,
                               .after = after,
                               .load_m = 1e4 * 4 * M_PI / 3 * 6e-4 / 256,
                               .radius_m = 6e-4,
                               .drag_per_s = 5,
                               .exponent = 4.65,
                               .pull_m_per_s2 = 9.81 * 0.6};
}

/* While the fan is below where the top was, both are as wide as t: from the closed form of the fan,
 * with x from 0 (phibar) to 1 (phi0) along it, and of the top,
 *   L^2/t = c phibar d^2 + 2 c d integral of d^2 (1-x)^2 dx + c d phi0^2,   d = phi0 - phibar. */
START_TEST(kinematic_length_is_the_root_of_time_until_the_fan_is_at_the_old_top) {
    struct fault fault = FAULT_NONE;
    struct bed_change c = bed(0.35, 0.3);
    double slope = bed_change_slope(&c) / c.radius_m, d = 0.05;
    double growth = slope * (0.3 * d * d + 2 * d * d * d / 3 + d * 0.35 * 0.35);
    double met = c.load_m / c.before / (bed_change_slope(&c) * (0.35 + d)), time[4], length[4];
    for (int k = 0; k < 4; k++)
        time[k] = met * (0.25 + 0.2 * k);
    unit_ok(relaxation_theory_length(&c, false, time, 4, length, &fault), &fault);
    /* Bins of 1R see the share x of a bin that the top has crossed as x^2: up to a quarter less
     * where it is and where it was. */
    for (int k = 0; k < 4; k++)
        ck_assert_double_eq_tol(length[k] * length[k], growth * time[k],
                                0.5 * 0.35 * 0.35 + 0.002 * growth * time[k]);
    ck_assert_double_eq_tol(relaxation_theory_window(&c), 2 * 0.733, 0.004);
}
END_TEST

/* (phi(z,t) - phi(z,0))^2 summed over a closed-form expansion, lengths in R. */
static double square_by_hand(const struct bed_change *c, double t) {
    double slope = bed_change_slope(c) / c->radius_m, h0 = c->load_m / c->before / c->radius_m;
    double met = h0 / (slope * c->before), dz = 0.01, sum = 0;
    double top = t < met ? h0 + slope * (c->before - c->after) * t
                         : 2 * sqrt(h0 * slope * c->before * t) - slope * c->after * t;
    if (t > h0 * c->before / (slope * c->after * c->after))
        top = h0 * c->before / c->after; /* at rest */
    for (double z = dz / 2; z < 1.3 * h0; z += dz) {
        double fan = (z / (slope * t) + c->after) / 2;
        double phi = z > top ? 0 : fmin(fmax(fan, c->after), c->before);
        double gone = phi - (z < h0 ? c->before : 0);
        sum += gone * gone * dz;
    }
    return sum;
}

/* The rate by trial: least squares over a fine grid of rates. */
START_TEST(kinematic_rate_is_that_of_the_closed_form) {
    struct fault fault = FAULT_NONE;
    struct bed_change c = bed(0.35, 0.3);
    struct relaxation_fit fit;
    unit_ok(relaxation_theory_fit(&c, false, 0, &fit, &fault), &fault);
    double length[FRAMES], time[FRAMES], best = INFINITY, rate = 0;
    for (int k = 0; k < FRAMES; k++) {
        time[k] = 2 * 0.733 * (k + 1) / FRAMES;
        length[k] = sqrt(square_by_hand(&c, time[k]));
    }
    for (double r = 1; r < 9; r += 0.002) {
        double a = 0, b = 0, left = 0;
        for (int k = 0; k < FRAMES; k++) {
            a += length[k] * (1 - exp(-r * time[k]));
            b += pow(1 - exp(-r * time[k]), 2);
        }
        for (int k = 0; k < FRAMES; k++)
            left += pow(length[k] - a / b * (1 - exp(-r * time[k])), 2);
        if (left < best) {
            best = left;
            rate = r;
        }
    }
    ck_assert_double_eq_tol(fit.rate_per_s, rate, 0.015 * rate); /* bins of 1R */
    ck_assert_double_lt(fit.root_rms, fit.exponential_rms);
    ck_assert_double_lt(fit.end_s, 0.733);
}
END_TEST

START_TEST(too_little_is_said_to_be_too_little) {
    struct fault fault = FAULT_NONE;
    double time[FRAMES], length[FRAMES], floor, square[4], profile[4] = {0.1, 0.2, 0.1, 0.3};
    struct relaxation_fit fit;
    times(time);
    ck_assert_int_eq(relaxation_fit(time, time, 4, &fit, &fault), STATUS_BAD_INPUT);
    unit_says(&fault, "no relaxation");
    for (int k = 0; k < FRAMES; k++)
        length[k] = time[k] * time[k]; /* slower and slower would be needed */
    fault = FAULT_NONE;
    ck_assert_int_eq(relaxation_fit(time, length, FRAMES, &fit, &fault), STATUS_BAD_INPUT);
    unit_says(&fault, "no rate");
    unit_ok(relaxation_square(profile, 2, 2, 1, 1, square, &floor, &fault), NULL);
    ck_assert(isnan(floor));
    ck_assert_double_eq_tol(square[1], 0.01, 1e-15);
    ck_assert_int_eq(relaxation_square(profile, 2, 2, 1, 3, square, &floor, &fault),
                     STATUS_BAD_INPUT);
}
END_TEST

int main(void) {
    const TTest *const tests[] = {
        noise_is_taken_off,
        without_noise_the_rate_is_exact,
        the_root_law_is_told_from_the_exponential,
        uncertainty_from_four_seeds_holds_the_truth_as_often_as_it_says,
        seeds_of_different_times_are_refused,
        kinematic_length_is_the_root_of_time_until_the_fan_is_at_the_old_top,
        kinematic_rate_is_that_of_the_closed_form,
        too_little_is_said_to_be_too_little,
        NULL};
    return unit_run("relaxation_fit", tests);
}
