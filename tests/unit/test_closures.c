/* test_closures.c -- validation/closures.h against values worked out by hand. */
#include "tests/unit/unit.h"
#include "validation/closures.h"

#include <math.h>

START_TEST(conductivity_of_both_laws_holds_below_the_cut_off) {
    ck_assert_double_eq_tol(closure_conductivity(CLOSURE_PUBLISHED, 0.45, 0.25),
                            0.09150625 / 0.2025, 1e-15);
    ck_assert_double_eq_tol(closure_conductivity(CLOSURE_CORRECTED, 0.45, 0.25), 0.166375 / 0.2025,
                            1e-15);
    ck_assert_double_eq(closure_conductivity(CLOSURE_PUBLISHED, 0.01, 0.25),
                        closure_conductivity(CLOSURE_PUBLISHED, 0.25, 0.25));
    ck_assert_double_eq_tol(closure_conductivity(CLOSURE_CORRECTED, 0, 0.25), 6.75, 1e-15);
}
END_TEST

START_TEST(face_rules_differ_where_the_solid_fraction_does) {
    double k_a = 0.2401 / 0.09, k_b = 0.0625 / 0.25; /* .3 and .5, published */
    enum closure_law m = CLOSURE_PUBLISHED;
    ck_assert_double_eq_tol(closure_face_conductivity(m, CLOSURE_ARITHMETIC, 0.3, 0.5, 0.25),
                            (k_a + k_b) / 2, 1e-15);
    ck_assert_double_eq_tol(closure_face_conductivity(m, CLOSURE_HARMONIC, 0.3, 0.5, 0.25),
                            2 / (1 / k_a + 1 / k_b), 1e-15);
    ck_assert_double_eq_tol(closure_face_conductivity(m, CLOSURE_OF_MEAN, 0.3, 0.5, 0.25),
                            0.1296 / 0.16, 1e-15);
    /* The mean is of clipped fractions: .1 counts as .25. */
    ck_assert_double_eq_tol(closure_face_conductivity(m, CLOSURE_OF_MEAN, 0.1, 0.35, 0.25),
                            0.2401 / 0.09, 1e-15);
}
END_TEST

START_TEST(own_law_and_eq_20_differ_by_one_minus_rho_squared) {
    for (double rho = 0.26; rho < 0.6; rho += 0.0437) {
        double own = closure_settling_speed(CLOSURE_PUBLISHED, rho, 0.25);
        ck_assert_double_eq_tol(own / (1 - rho * rho), closure_settling_speed_eq20(rho),
                                1e-14 * own);
        ck_assert_double_eq_tol(closure_settling_speed(CLOSURE_CORRECTED, rho, 0.25) * (1 - rho),
                                own, 1e-14 * own);
    }
    ck_assert_double_eq_tol(closure_settling_speed(CLOSURE_PUBLISHED, 0.2, 0.25), 0.31640625 / 0.2,
                            1e-14);
}
END_TEST

START_TEST(disc_pressure_is_near_henderson_and_its_stiffness_is_its_slope) {
    /* Second and third virial coefficient: Z = 1 + 2 eta + 3.128 eta^2 + ... */
    ck_assert_double_eq_tol(closure_disc_compressibility(1e-3), 1 + 2e-3 + 3.12802e-6, 1e-8);
    const double high[][2] = {{0.3, 0.025}, {0.5, 0.455}, {0.6, 1.151}}; /* per cent */
    for (size_t i = 0; i < 3; i++) {
        double eta = high[i][0], z = closure_disc_compressibility(eta);
        double excess = 100 * (closure_disc_compressibility_henderson(eta) / z - 1);
        ck_assert_double_eq_tol(excess, high[i][1], 0.001);
        double h = 1e-5, up = closure_disc_compressibility(eta * (1 + h));
        double down = closure_disc_compressibility(eta * (1 - h));
        ck_assert_double_eq_tol(closure_disc_stiffness(eta), log(up / down) / (2 * h), 1e-7);
    }
}
END_TEST

START_TEST(halo_weights_sum_to_one_and_find_the_last_cell) {
    const double x[][2] = {{0.137, 3.9999}, {6, 9}, {0, 0}, {2.5, 1.37e-6}, {5.999, 9}};
    for (size_t i = 0; i < sizeof x / sizeof *x; i++) {
        struct closure_halo h = closure_halo_at(x[i][0], x[i][1], 7, 10);
        double sum = 0, mean_x = 0, mean_y = 0;
        for (int k = 0; k < 4; k++) {
            ck_assert_uint_lt(h.site[k], 70);
            ck_assert_double_ge(h.weight[k], 0);
            sum += h.weight[k];
            mean_x += h.weight[k] * (double)(h.site[k] % 7);
            mean_y += h.weight[k] * (double)(h.site[k] / 7);
        }
        ck_assert_double_eq_tol(sum, 1, 1e-15);
        ck_assert_double_eq_tol(mean_x, x[i][0], 1e-14); /* bilinear weights keep the centre */
        ck_assert_double_eq_tol(mean_y, x[i][1], 1e-14);
    }
}
END_TEST

/* sum V g.u = -sum p outflow for any fields: what the force balance rests on. */
START_TEST(gradient_is_the_adjoint_of_the_outflow) {
    enum { NX = 5, NY = 7 };
    double p[NX * NY], u[2 * NX * NY], left = 0, right = 0, volume = 0;
    for (int k = 0; k < NX * NY; k++) {
        p[k] = sin(1.7 * k) + 0.01 * k;
        u[2 * k] = cos(2.3 * k);
        u[2 * k + 1] = sin(0.9 * k + 1);
    }
    for (size_t j = 0; j < NY; j++)
        for (size_t i = 0; i < NX; i++) {
            size_t k = j * NX + i;
            double g[2], v = closure_site_volume(i, j, NX, NY);
            closure_gradient(p, i, j, NX, NY, g);
            left += v * (g[0] * u[2 * k] + g[1] * u[2 * k + 1]);
            right -= p[k] * closure_outflow(u, i, j, NX, NY);
            volume += v;
        }
    ck_assert_double_eq_tol(left, right, 1e-13);
    ck_assert_double_eq_tol(volume, (NX - 1) * (NY - 1), 1e-14);
}
END_TEST

START_TEST(lattice_modes_tend_to_the_continuum_from_below) {
    double exact = closure_mode_square(2, 3, 160, 120);
    double lattice = closure_mode_square_lattice(2, 3, 160, 120);
    ck_assert_double_lt(lattice, exact);
    double kx = M_PI * 2 / 160, ky = M_PI * 3 / 120;
    ck_assert_double_eq_tol(exact - lattice, (pow(kx, 4) + pow(ky, 4)) / 12, 1e-6 * exact);
    ck_assert_double_eq_tol(closure_diffusivity(CLOSURE_PUBLISHED, 0.1, 0.25, 2e-4), 33750, 1e-9);
}
END_TEST

int main(void) {
    const TTest *const tests[] = {conductivity_of_both_laws_holds_below_the_cut_off,
                                  face_rules_differ_where_the_solid_fraction_does,
                                  own_law_and_eq_20_differ_by_one_minus_rho_squared,
                                  disc_pressure_is_near_henderson_and_its_stiffness_is_its_slope,
                                  halo_weights_sum_to_one_and_find_the_last_cell,
                                  gradient_is_the_adjoint_of_the_outflow,
                                  lattice_modes_tend_to_the_continuum_from_below,
                                  NULL};
    return unit_run("closures", tests);
}
