/* test_gas.c -- solver/graingas/gas.h: conservation, adjointness and exact columns. */
#include "solver/graingas/darcy.h"
#include "tests/unit/graingas_fixture.h"

#include <math.h>

static const char crowd[] = "grains: 211\nwidth_l: 7\nheight_l: 9\nstart_speed: 0.7\n"
                            "dt_tau: 0.003\npressure_tolerance: 1.0e-13\n";

/* sum V phi[n] (p[n+1] - p[n]) = 0 in a closed box: nothing is made of nothing. */
START_TEST(a_closed_box_keeps_its_gas) {
    struct graingas *s = fixture_state(crowd, 17);
    double *before = malloc(s->lattice.sites * sizeof *before);
    for (int n = 0; n < 20; n++) {
        memcpy(before, s->gas.pressure, s->lattice.sites * sizeof *before);
        fixture_steps(s, 1);
        double sum = 0, scale = 0;
        for (size_t k = 0; k < s->lattice.sites; k++) {
            double amount = s->lattice.volume[k] * (1 - s->gas.clipped[k]);
            sum += amount * (s->gas.pressure[k] - before[k]);
            scale += amount * fabs(s->gas.pressure[k]);
        }
        ck_assert_double_le(fabs(sum), 1e-10 * scale);
        ck_assert_double_gt(scale, 0);
    }
    free(before);
    graingas_model.free(s);
}
END_TEST

START_TEST(injected_gas_is_counted) {
    struct graingas *s = fixture_state("grains: 0\nwidth_l: 7\nheight_l: 9\nflux_l_per_tau: 0.37\n"
                                       "dt_tau: 0.003\npressure_tolerance: 1.0e-13\n",
                                       1);
    fixture_steps(s, 1);
    double bottom = 0, top = 0;
    for (size_t k = 0; k < s->lattice.sites; k++) {
        double held = s->lattice.volume[k] * 0.75 * s->gas.pressure[k];
        *(k < s->lattice.sites / 2 ? &bottom : &top) += held;
    }
    ck_assert_double_eq_tol(bottom, -top, 1e-14);
    ck_assert_double_gt(bottom, 0);
    graingas_model.free(s);
}
END_TEST

/* Gas force on grains + what thin sites do not pass on = pressure difference of the
 * walls; unit rho_g g l^2, so the area's 2/3 enters once. */
START_TEST(the_force_on_grains_is_the_pressure_on_walls) {
    struct graingas *s = fixture_state(crowd, 23);
    fixture_steps(s, 7);
    gas_take_grains(&s->gas, &s->parameters, &s->grains);
    gas_find_pull(&s->gas, &s->parameters);
    halo_gather(&s->lattice, &s->grains, s->gas.pull, s->ax, s->ay);
    double force = 0, missing[2], walls = 0, scale = 0;
    for (size_t i = 0; i < s->grains.count; i++)
        force += s->parameters.area_to_volume * s->grains.area[i] * s->ay[i] * s->parameters.froude;
    gas_unabsorbed(&s->gas, &s->parameters, missing);
    for (int i = 0; i < s->lattice.nx; i++) {
        double half = i == 0 || i == s->lattice.nx - 1 ? 0.5 : 1;
        double low = s->gas.pressure[i];
        double high =
            s->gas.pressure[(size_t)s->lattice.nx * (size_t)(s->lattice.ny - 1) + (size_t)i];
        walls += half * (low - high) / s->parameters.peclet;
        scale += half * fabs(low) / s->parameters.peclet;
    }
    ck_assert_double_eq_tol(force + missing[1], walls, 1e-13 * scale);
    ck_assert_double_gt(fabs(missing[1]), 1e-6 * fabs(walls));
    graingas_model.free(s);
}
END_TEST

/* Arithmetic faces: the pressure drop is q times the sum of 1/K_face, to round-off. */
START_TEST(a_steady_column_is_a_series_of_faces) {
    struct graingas *s = fixture_state("grains: 0\nwidth_l: 5\nheight_l: 12\nflux_l_per_tau: 0.37\n"
                                       "fixed_bed: [0.31, 0.55, 0.42]\ndt_tau: 0.5\n"
                                       "pressure_tolerance: 1.0e-13\n",
                                       1);
    fixture_steps(s, 60);
    double drop = 0;
    for (int j = 0; j < 12; j++) {
        double a = s->gas.coefficient[(size_t)j * 6 + 2],
               b = s->gas.coefficient[(size_t)(j + 1) * 6 + 2];
        drop += 0.37 * s->parameters.peclet * 2 / (a + b);
    }
    double measured = s->gas.pressure[2] - s->gas.pressure[12 * 6 + 2];
    ck_assert_double_eq_tol(measured, drop, 1e-9 * drop);
    ck_assert_double_eq_tol(s->gas.coefficient[2], pow(0.69, 4) / pow(0.31, 2), 1e-14);
    graingas_model.free(s);
}
END_TEST

START_TEST(the_face_rules_differ_as_they_should) {
    double a = darcy_coefficient(DARCY_PUBLISHED, 0.3), b = darcy_coefficient(DARCY_PUBLISHED, 0.5);
    ck_assert_double_eq_tol(darcy_face(FACE_ARITHMETIC, DARCY_PUBLISHED, a, b, 0.3, 0.5),
                            (a + b) / 2, 1e-15);
    ck_assert_double_eq_tol(darcy_face(FACE_HARMONIC, DARCY_PUBLISHED, a, b, 0.3, 0.5),
                            1 / (0.5 / a + 0.5 / b), 1e-15);
    ck_assert_double_eq_tol(darcy_face(FACE_OF_MEAN, DARCY_PUBLISHED, a, b, 0.3, 0.5),
                            pow(0.6, 4) / 0.16, 1e-15);
    ck_assert_double_eq_tol(darcy_coefficient(DARCY_CORRECTED, 0.4), pow(0.6, 3) / 0.16, 1e-15);
    /* rho/(Fr (1-rho)^4): the rate that bounds dt at .067 tau for rho = .62. */
    ck_assert_double_eq_tol(2 / darcy_drag_rate(DARCY_PUBLISHED, 0.62, 1), 0.06726, 1e-4);
    ck_assert_double_eq_tol(2 / darcy_drag_rate(DARCY_CORRECTED, 0.62, 1), 0.17700, 1e-4);
}
END_TEST

/* Small Peclet number: both laws agree to its order; large: they part. */
START_TEST(the_full_law_tends_to_the_linear_one) {
    double gap[2];
    for (int n = 0; n < 2; n++) {
        const char *peclet = n ? "peclet: 0.02\n" : "peclet: 0.0002\n";
        const char column[] = "grains: 0\nwidth_l: 4\nheight_l: 9\nfixed_bed: [0.47, 0.53]\n"
                              "flux_l_per_tau: 0.41\ndt_tau: 0.2\n";
        char linear[512], full[512];
        snprintf(linear, sizeof linear, "%s%sgas: linear\n", column, peclet);
        snprintf(full, sizeof full, "%s%sgas: full\n", column, peclet);
        struct graingas *a = fixture_state(linear, 23), *b = fixture_state(full, 23);
        fixture_steps(a, 300);
        fixture_steps(b, 300);
        double difference = 0, scale = 0;
        for (size_t k = 0; k < a->lattice.sites; k++) {
            difference = fmax(difference, fabs(a->gas.pressure[k] - b->gas.pressure[k]));
            scale = fmax(scale, fabs(a->gas.pressure[k]));
        }
        gap[n] = difference / scale;
        graingas_model.free(a);
        graingas_model.free(b);
    }
    ck_assert_double_lt(gap[0], 0.01);
    ck_assert_double_gt(gap[1], 10 * gap[0]);
}
END_TEST

int main(void) {
    const TTest *const tests[] = {a_closed_box_keeps_its_gas,
                                  injected_gas_is_counted,
                                  the_force_on_grains_is_the_pressure_on_walls,
                                  a_steady_column_is_a_series_of_faces,
                                  the_face_rules_differ_as_they_should,
                                  the_full_law_tends_to_the_linear_one,
                                  NULL};
    return unit_run("gas", tests);
}
