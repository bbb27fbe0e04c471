/* test_predict_spheres.c -- predictions of the suspension model by other roads: sums over kicks,
 * integration in time. */
#include "tests/unit/unit.h"
#include "validation/prediction.h"

#include <math.h>
#include <stdbool.h>
#include <string.h>

static double at(const char *name, const double *input) {
    const struct prediction *p = prediction_find(name);
    ck_assert_msg(p != NULL, "no prediction %s", name);
    return p->at(input);
}

/* Haff: dT/dt = -(1/3)(1-eps^2) f(T) T in small steps. */
START_TEST(cooling_rate_is_that_of_the_equation_for_the_temperature) {
    double gas[] = {0.21, 1.9e-9, 5.7e-4, 2.11e-6, 0.87}, now[4] = {0.21, 1.9e-9, 5.7e-4, 2.11e-6};
    double h = 1e-5, time = 0.2;
    for (int i = 0; i < 20000; i++) {
        double half[4] = {now[0], 0, now[2], now[3]}, loss = (1 - 0.87 * 0.87) / 3;
        half[1] = now[1] * (1 - h / 2 * loss * at("sphere-collision-rate", now));
        now[1] -= h * loss * at("sphere-collision-rate", half) * half[1];
    }
    double rate = at("sphere-cooling-rate", gas);
    ck_assert_double_eq_tol(sqrt(1.9e-9 / now[1]), 1 + rate * time, 1e-5);
    ck_assert_double_gt(rate * time, 0.5);
}
END_TEST

/* Cumulants of a sum over kicks at known ages: a Bernoulli kick of probability p a short
 * interval, each of variance q exp(-2 gamma age) and normal. */
START_TEST(kicked_moments_are_sums_over_kicks) {
    double in[] = {4.9, 0.31, 4.3, 211, 3.1e-6}, gamma = at("suspension-drag", in);
    double second = 0, fourth = 0, h = 1e-5;
    for (double age = h / 2; age < 3; age += h) {
        double left = in[4] * exp(-2 * gamma * age), p = in[3] * h;
        second += p * left;
        fourth += 3 * p * left * left;
    }
    ck_assert_double_eq_tol(at("kicked-velocity-variance", in), second, 1e-6 * second);
    double kick[] = {in[0], in[1], in[2], in[3]};
    ck_assert_double_eq_tol(at("kicked-kurtosis-poisson", kick), fourth / (second * second), 1e-6);
    /* Periodic kicks: moments of normals averaged over the phase. */
    double two = 0, four = 0;
    for (int i = 0; i < 1000; i++) {
        double phase = (i + 0.5) / 1000 / in[3], variance = 0;
        for (int k = 0; k < 3000; k++)
            variance += in[4] * exp(-2 * gamma * (phase + k / in[3]));
        two += variance / 1000;
        four += 3 * variance * variance / 1000;
    }
    ck_assert_double_eq_tol(two, second, 1e-6 * second);
    ck_assert_double_eq_tol(at("kicked-kurtosis-periodic", kick), four / (two * two) - 3, 1e-6);
}
END_TEST

/* <dx^2> is twice the integral of (t - s) times the covariance <v^2> exp(-gamma s). */
START_TEST(kicked_displacement_is_the_integral_of_its_covariance) {
    double in[] = {4.9, 0.31, 4.3, 211, 3.1e-6, 0.173}, gamma = at("suspension-drag", in);
    double sum = 0, h = in[5] / 100000;
    for (int i = 0; i < 100000; i++) {
        double s = (i + 0.5) * h;
        sum += 2 * h * (in[5] - s) * at("kicked-velocity-variance", in) * exp(-gamma * s);
    }
    ck_assert_double_eq_tol(at("kicked-displacement", in), sum, 1e-8 * sum);
}
END_TEST

START_TEST(slab_speed_is_where_push_and_drag_lead) {
    double in[] = {4.9, 0.31, 4.3, 9.7, 0.61, 0.37, 0.334, 0.081}, gamma = 4.9 * pow(0.69, -4.3);
    double push = 4.3 * 9.7 * 0.61 * 0.37 / 0.69 * 0.024, v = 0, h = 0.081 / 100000;
    for (int i = 0; i < 100000; i++)
        v += h * (push - gamma * (v + h / 2 * (push - gamma * v)));
    ck_assert_double_eq_tol(at("slab-speed", in), v, 1e-8 * fabs(v));
    in[6] = 0.286;
    ck_assert_double_eq_tol(at("slab-speed", in), -v, 1e-8 * fabs(v));
}
END_TEST

/* The table of docs/theory.md S8, at .30 .35 ... .55. */
START_TEST(ratios_of_the_readings_are_those_of_the_theory) {
    static const struct {
        double drive, heat;
        bool heated;
        double ratio[6];
    } row[] = {{1, 1, false, {4.7, 3.4, 2.4, 1.56, 0.97, 0.57}},
               {1, 1, true, {6.1, 4.4, 3.1, 2.0, 1.24, 0.72}},
               {0.284, 2.84, false, {0.79, 0.58, 0.40, 0.26, 0.16, 0.10}},
               {0.284, 2.84, true, {1.08, 0.78, 0.54, 0.36, 0.22, 0.13}},
               {0.444, 4.44, true, {1.38, 1.00, 0.69, 0.46, 0.28, 0.16}},
               {0.1, 1, true, {0.61, 0.44, 0.31, 0.20, 0.12, 0.07}}};
    for (size_t i = 0; i < sizeof row / sizeof *row; i++)
        for (int k = 0; k < 6; k++) {
            double phi = 0.3 + 0.05 * k, told = row[i].ratio[k];
            double last = row[i].heated ? 0.7 : 1e4; /* restitution, or wavelength */
            double heat = 2e-9 * row[i].heat;
            double in[] = {5,   phi,  4.65, 9.81,     0.6, row[i].drive,
                           phi, heat, 6e-4, 2.262e-6, 10,  last};
            double ratio = at(row[i].heated ? "heated-stability-ratio" : "stability-ratio", in);
            ck_assert_double_eq_tol(ratio, told, told < 1.3 ? 0.0051 : 0.051);
        }
}
END_TEST

/* drag, phibar, n, g, contrast, scale, phi, T, R, m, layer, wavelength */
START_TEST(waves_grow_where_the_kinematic_wave_outruns_sound) {
    double in[] = {5, 0.3, 4.65, 9.81, 0.6, 1, 0.3, 2e-9, 6e-4, 2.262e-6, 10, 0.3};
    double k = 2 * M_PI / 0.3, gamma = at("suspension-drag", in);
    double c = 4.65 * 9.81 * 0.6 / 0.7 * 0.3 / gamma, sound[] = {0.3, 2e-9, 2.262e-6};
    double ratio = c / sqrt(at("sphere-sound-square", sound));
    ck_assert_double_eq_tol(ratio, 4.7, 0.05); /* shared figure of the stability table */
    double far[12];
    memcpy(far, in, sizeof far);
    far[11] = 1e4; /* neither layers nor viscosity matter */
    ck_assert_double_eq_tol(at("stability-ratio", far), ratio, 1e-6 * ratio);
    double elastic[] = {5, 0.3, 4.65, 9.81, 0.6, 1, 0.3, 2e-9, 6e-4, 2.262e-6, 10, 0.3, 1};
    double hot = at("heated-wave-growth", elastic), speed = at("heated-wave-speed", elastic);
    ck_assert_double_eq_tol(hot, at("density-wave-growth", in), 0.15 * hot);
    ck_assert_double_eq_tol(speed, at("density-wave-speed", in), 0.1 * speed);
    elastic[11] = 1;
    ck_assert_double_eq_tol(at("heated-stability-ratio", elastic), ratio, 1e-6 * ratio);
    double peak = at("fastest-wavelength", in) * in[8], beside[12];
    memcpy(beside, in, sizeof beside);
    beside[11] = peak;
    double most = at("density-wave-growth", beside);
    ck_assert_double_eq_tol(at("fastest-wave-speed", in), at("density-wave-speed", beside), 1e-12);
    double rise = most / at("density-wave-speed", beside) * in[8];
    ck_assert_double_eq_tol(at("growth-with-height", in), rise, 1e-12);
    for (int side = -1; side <= 1; side += 2) {
        beside[11] = peak * (1 + 0.03 * side);
        ck_assert_double_lt(at("density-wave-growth", beside), most);
    }
    ck_assert_double_gt(at("density-wave-growth", in), 0);
    in[5] = 0.9 / ratio; /* slower than sound */
    ck_assert_double_lt(at("density-wave-growth", in), 0);
    in[5] = 0.01;
    in[11] = 3; /* slow and long: the kinematic wave's own speed */
    ck_assert_double_eq_tol(at("density-wave-speed", in), 0.01 * c, 1e-3 * c);
    double gas[] = {0.3, 2e-9, 6e-4, 2.262e-6}, q = k / 10;
    double decay = (at("sphere-sound-square", sound) - pow(0.01 * c, 2)) * q * q / gamma;
    ck_assert_double_eq_tol(at("density-wave-growth", in), -decay, 0.02 * decay);
    ck_assert_double_gt(at("sphere-longitudinal-viscosity", gas), 0);
}
END_TEST

int main(void) {
    const TTest *const tests[] = {cooling_rate_is_that_of_the_equation_for_the_temperature,
                                  kicked_moments_are_sums_over_kicks,
                                  kicked_displacement_is_the_integral_of_its_covariance,
                                  slab_speed_is_where_push_and_drag_lead,
                                  ratios_of_the_readings_are_those_of_the_theory,
                                  waves_grow_where_the_kinematic_wave_outruns_sound,
                                  NULL};
    return unit_run("predict_spheres", tests);
}
