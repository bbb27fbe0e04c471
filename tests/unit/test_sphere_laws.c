/* test_sphere_laws.c -- validation/sphere_laws.h against quadrature, integration in time and
 * tables. */
#include "tests/unit/unit.h"
#include "validation/sphere_laws.h"

#include <math.h>

static const struct spheres_gas GAS = {0.317, 1.9e-9, 5.7e-4, 2.11e-6};

START_TEST(virial_series_and_carnahan_starling_agree_where_both_hold) {
    for (double p = 0.01; p < 0.31; p += 0.0471) {
        double cs = spheres_compressibility(p);
        ck_assert_double_eq_tol(spheres_virial(p), cs, 0.004 * cs);
        ck_assert_double_eq_tol(cs, (1 + p + p * p - p * p * p) / pow(1 - p, 3), 1e-13 * cs);
    }
    /* B2 = 4, B3 = 10, B4 = 18.3648: differences of Z - 1 at small phi. */
    double h = 1e-3, z = spheres_virial(h);
    ck_assert_double_eq_tol((z - 1) / h, 4 + 10 * h + 18.3648 * h * h, 1e-7);
    /* Where spheres freeze, phi = .4917, p d^3/T = 11.57 (Frenkel & Smit, table of coexistence). */
    ck_assert_double_eq_tol(spheres_compressibility(0.4917), 11.57 * M_PI / 6 / 0.4917, 0.05);
}
END_TEST

START_TEST(stiffness_is_the_slope_of_the_pressure) {
    for (double p = 0.05; p < 0.56; p += 0.0713) {
        double h = 1e-5, up = (p + h) * spheres_compressibility(p + h);
        double down = (p - h) * spheres_compressibility(p - h);
        ck_assert_double_eq_tol(spheres_stiffness(p), (up - down) / (2 * h), 1e-6 * up / h * 1e-3);
    }
}
END_TEST

/* A sphere sweeps a cylinder of section pi d^2 at the mean relative speed, by quadrature
 * over Maxwell's distribution of relative velocities (twice the variance). */
START_TEST(collision_rate_is_the_swept_volume) {
    double v2 = GAS.temperature_J / GAS.mass_kg, mean = 0, norm = 0, d = 2 * GAS.radius_m;
    for (double g = 0; g < 12; g += 1e-3) { /* in sqrt(T/m) */
        double weight = g * g * exp(-g * g / 4);
        norm += weight;
        mean += weight * g;
    }
    mean *= sqrt(v2) / norm;
    double n = GAS.packing_fraction / (M_PI / 6 * d * d * d);
    double rate = n * M_PI * d * d * mean * spheres_contact(GAS.packing_fraction);
    ck_assert_double_eq_tol(spheres_collision_rate(&GAS), rate, 1e-6 * rate);
    ck_assert_double_eq_tol(spheres_compressibility(0.2), 1 + 4 * 0.2 * spheres_contact(0.2),
                            1e-14);
}
END_TEST

/* Dilute: D n and eta are Chapman and Enskog's; the ratio rho D/eta is 1.2 in first order,
 * 1.2036 with the corrections 1.01896 and 1.016. */
START_TEST(dilute_gas_has_chapman_and_enskogs_coefficients) {
    struct spheres_gas g = GAS;
    g.packing_fraction = 1e-7;
    double d = 2 * g.radius_m, v = spheres_thermal_speed(&g);
    double rho = g.mass_kg * g.packing_fraction / (M_PI / 6 * d * d * d);
    ck_assert_double_eq_tol(rho * spheres_diffusion(&g) / spheres_viscosity(&g),
                            1.2 * 1.01896 / 1.016, 1e-5);
    double eta = 1.016 * 5.0 / 16 * g.mass_kg * v / (sqrt(M_PI) * d * d);
    ck_assert_double_eq_tol(spheres_viscosity(&g), eta, 1e-5 * eta);
    ck_assert_double_eq_tol(spheres_longitudinal(&g), 4 * eta / 3 / rho, 1e-5 * eta / rho);
}
END_TEST

/* By hand at phi = .3: chi = 2.4781, 1.2 (1/2.9738 + .8 + .7614 2.9738) = 4.081. */
START_TEST(dense_gas_is_more_viscous_and_diffuses_less) {
    struct spheres_gas dilute = GAS, dense = GAS;
    dilute.packing_fraction = 1e-7;
    dense.packing_fraction = 0.3;
    ck_assert_double_eq_tol(spheres_viscosity(&dense) / spheres_viscosity(&dilute), 4.081, 0.002);
    /* Erpenbeck and Wood's factor at .3 is 1.339, at .45 .93. */
    double n_d = 0.3 * spheres_contact(0.3) * spheres_diffusion(&dense);
    ck_assert_double_eq_tol(n_d / (1e-7 * spheres_diffusion(&dilute)), 1.339, 0.001);
    dense.packing_fraction = 0.45;
    n_d = 0.45 * spheres_contact(0.45) * spheres_diffusion(&dense);
    ck_assert_double_eq_tol(n_d / (1e-7 * spheres_diffusion(&dilute)), 0.928, 0.001);
    double l = 0.021, take = spheres_box_correction(&GAS, l) / spheres_diffusion(&GAS);
    ck_assert_double_gt(take, 0.01);
    ck_assert_double_lt(take, 0.2);
    ck_assert_double_eq_tol(spheres_box_correction(&GAS, l) / 3,
                            spheres_box_correction(&GAS, 3 * l), 1e-20);
}
END_TEST

/* phi' and u of the linear equations integrated in time: the fastest root takes over. */
START_TEST(wave_root_is_what_integration_tends_to) {
    const double push[] = {0.9, 21.7};
    for (int n = 0; n < 2; n++) {
        struct spheres_wave w = {.packing_fraction = 0.31,
                                 .push_m_per_s2 = push[n],
                                 .drag_per_s = 27.3,
                                 .layer_m = 6e-3,
                                 .wavelength_m = 0.047,
                                 .sound2_m2_per_s2 = 9.1e-3,
                                 .viscosity_m2_per_s = 9e-5};
        double k = 2 * M_PI / w.wavelength_m, window = sin(k * 3e-3) / (k * 3e-3), h = 2e-6;
        double complex phi = 1e-3, u = 0, before = 0, s = spheres_wave_root(&w);
        int steps = 1000000;
        for (int i = 0; i < steps; i++) {
            if (i == steps - 50000)
                before = phi;
            double complex force = w.push_m_per_s2 * window * phi -
                                   I * k * w.sound2_m2_per_s2 * phi / w.packing_fraction;
            u = (u + h * force) / (1 + h * (w.drag_per_s + w.viscosity_m2_per_s * k * k));
            phi -= h * I * k * w.packing_fraction * u;
        }
        double complex rate = clog(phi / before) / (50000 * h);
        ck_assert_double_eq_tol(creal(rate), creal(s), 2e-3 * cabs(s));
        ck_assert_double_eq_tol(cimag(rate), cimag(s), 2e-3 * cabs(s));
        ck_assert_double_lt(cimag(s), 0); /* upwards */
        ck_assert_int_eq(creal(s) > 0, n == 1);
    }
}
END_TEST

/* On both sides of the ratio 1, by a millionth, the root changes its sign. */
START_TEST(waves_grow_exactly_where_their_ratio_is_above_one) {
    struct spheres_wave w = {.packing_fraction = 0.37,
                             .push_m_per_s2 = 11.3,
                             .drag_per_s = 31.7,
                             .layer_m = 5.3e-3,
                             .wavelength_m = 0.0217,
                             .sound2_m2_per_s2 = 8.7e-3,
                             .viscosity_m2_per_s = 1.1e-4};
    double push = w.push_m_per_s2 / spheres_wave_ratio(&w);
    w.push_m_per_s2 = push * (1 + 1e-6);
    ck_assert_double_gt(creal(spheres_wave_root(&w)), 0);
    w.push_m_per_s2 = push * (1 - 1e-6);
    ck_assert_double_lt(creal(spheres_wave_root(&w)), 0);
}
END_TEST

/* Density, speed and temperature integrated in time: pressure by differences, heat from its
 * balance. Elastic spheres first, then inelastic ones. */
START_TEST(heated_root_is_what_integration_tends_to) {
    const double eps[] = {1, 0.73};
    for (int n = 0; n < 2; n++) {
        struct spheres_gas g = {0.33, 2.3e-9, 5.9e-4, 2.2e-6};
        struct spheres_wave w = {.packing_fraction = 0.33,
                                 .push_m_per_s2 = 11.7,
                                 .drag_per_s = 27.3,
                                 .layer_m = 6e-3,
                                 .wavelength_m = 0.047,
                                 .viscosity_m2_per_s = spheres_longitudinal(&g)};
        double k = 2 * M_PI / w.wavelength_m, window = sin(k * 3e-3) / (k * 3e-3), h = 1e-6;
        double p = g.packing_fraction, t = g.temperature_J / g.mass_kg, d = 1e-5;
        double number = p / (4 * M_PI / 3 * pow(g.radius_m, 3));
        struct spheres_gas up = g, down = g;
        up.packing_fraction += d;
        down.packing_fraction -= d;
        double z = 1 + 2 * (1 + eps[n]) * p * spheres_contact(p);
        double rise = ((p + d) * (1 + 2 * (1 + eps[n]) * (p + d) * spheres_contact(p + d)) -
                       (p - d) * (1 + 2 * (1 + eps[n]) * (p - d) * spheres_contact(p - d))) /
                      (2 * d);
        double loss = (1 - eps[n] * eps[n]) / 3;
        double rate = spheres_collision_rate(&g);
        double steeper = (spheres_collision_rate(&up) - spheres_collision_rate(&down)) / (2 * d);
        double spread = 2 * spheres_conductivity(&g) / (3 * number) * k * k;
        double complex phi = 1e-3, u = 0, heat = 0, before = 0;
        int steps = 600000;
        for (int i = 0; i < steps; i++) {
            before = i == steps - 50000 ? phi : before;
            double complex force =
                w.push_m_per_s2 * window * phi - I * k * (t * rise * phi + p * z * heat) / p;
            u = (u + h * force) / (1 + h * (w.drag_per_s + w.viscosity_m2_per_s * k * k));
            heat -= h * (2.0 / 3 * z * t * I * k * u + loss * t * steeper * phi +
                         (2 * w.drag_per_s + 1.5 * loss * rate + spread) * heat);
            phi -= h * I * k * p * u;
        }
        double complex now = clog(phi / before) / (50000 * h);
        double complex s = spheres_heated_root(&w, &g, eps[n]);
        ck_assert_double_eq_tol(creal(now), creal(s), 2e-3 * cabs(s));
        ck_assert_double_eq_tol(cimag(now), cimag(s), 2e-3 * cabs(s));
    }
}
END_TEST

/* Long waves change sign where the ratio is 1. */
START_TEST(heated_ratio_is_that_of_long_waves) {
    struct spheres_gas g = {0.33, 2.3e-9, 5.9e-4, 2.2e-6};
    struct spheres_wave w = {.packing_fraction = 0.33,
                             .push_m_per_s2 = 3.1,
                             .drag_per_s = 27.3,
                             .layer_m = 6e-3,
                             .wavelength_m = 30,
                             .viscosity_m2_per_s = spheres_longitudinal(&g)};
    double push = w.push_m_per_s2 / spheres_heated_ratio(&w, &g, 0.73);
    w.push_m_per_s2 = push * 1.001;
    ck_assert_double_gt(creal(spheres_heated_root(&w, &g, 0.73)), 0);
    w.push_m_per_s2 = push * 0.999;
    ck_assert_double_lt(creal(spheres_heated_root(&w, &g, 0.73)), 0);
}
END_TEST

START_TEST(no_wavelength_grows_faster_than_the_fastest) {
    struct spheres_wave w = {.packing_fraction = 0.31,
                             .push_m_per_s2 = 39.1,
                             .drag_per_s = 26.3,
                             .layer_m = 6e-3,
                             .sound2_m2_per_s2 = 9.1e-3,
                             .viscosity_m2_per_s = 9e-5};
    double fastest = spheres_fastest_wave(&w), most = -INFINITY, at = 0;
    for (w.wavelength_m = 6e-3; w.wavelength_m < 1; w.wavelength_m *= 1.0003) {
        double growth = creal(spheres_wave_root(&w));
        if (growth > most) {
            most = growth;
            at = w.wavelength_m;
        }
    }
    ck_assert_double_gt(most, 10);
    ck_assert_double_eq_tol(fastest, at, 1e-3 * at);
    w.push_m_per_s2 /= 10;
    ck_assert_double_nan(spheres_fastest_wave(&w));
}
END_TEST

START_TEST(drag_and_push_are_the_papers) {
    ck_assert_double_eq_tol(spheres_drag(5, 0.3, 4.65), 5 * exp(4.65 * -log1p(-0.3)), 1e-12);
    ck_assert_double_eq_tol(spheres_push(4.65, 9.81, 0.6, 0.284, 0.45),
                            4.65 * 9.81 * 0.6 * 0.284 / 0.55, 1e-13);
}
END_TEST

int main(void) {
    const TTest *const tests[] = {virial_series_and_carnahan_starling_agree_where_both_hold,
                                  stiffness_is_the_slope_of_the_pressure,
                                  collision_rate_is_the_swept_volume,
                                  dilute_gas_has_chapman_and_enskogs_coefficients,
                                  dense_gas_is_more_viscous_and_diffuses_less,
                                  wave_root_is_what_integration_tends_to,
                                  waves_grow_exactly_where_their_ratio_is_above_one,
                                  no_wavelength_grows_faster_than_the_fastest,
                                  heated_root_is_what_integration_tends_to,
                                  heated_ratio_is_that_of_long_waves,
                                  drag_and_push_are_the_papers,
                                  NULL};
    return unit_run("sphere_laws", tests);
}
