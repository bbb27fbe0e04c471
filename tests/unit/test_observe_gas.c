/* test_observe_gas.c -- recipes of the gas and of the halo on results made by hand. */
#include "tests/unit/fake_run.h"
#include "validation/closures.h"

static const double DT = 0.0125;

/* -- mode decay ------------------------------------------------------------------ */

/* Amplitude falls by 1/(1 + s dt) a step; `spoil` is added to one site at the end. */
static enum status measure_mode(double s, double spoil, struct measurement *m) {
    enum { NX = 13, NY = 9, STEPS = 40 };
    struct fake_run f = fake_start("  width_l: 12\n  height_l: 8\n  pressure_mode_x: 2\n"
                                   "  pressure_mode_y: 1\n  peclet: 3.7\n");
    double p[NX * NY], rho[NX * NY] = {0};
    for (int frame = 0; frame < 2; frame++) {
        double a = 0.0137 * pow(1 + s * DT, frame ? -STEPS : 0);
        for (int k = 0; k < NX * NY; k++)
            p[k] = a * cos(M_PI * 2 * (k % NX) / 12) * cos(M_PI * (k / NX) / 8);
        p[31] += frame ? spoil : 0;
        fake_field(&f, "fields/pressure", NX, NY, p, frame * STEPS * DT, DT);
        fake_field(&f, "fields/solid_fraction", NX, NY, rho, frame * STEPS * DT, DT);
    }
    return fake_measure(&f, "mode-decay", NULL, 0, m);
}

START_TEST(a_mode_that_decays_as_the_lattice_does_has_no_lattice_error) {
    struct measurement m;
    double d = closure_diffusivity(CLOSURE_PUBLISHED, 0, 0.25, 3.7);
    double s = d * closure_mode_square_lattice(2, 1, 12, 8);
    double continuum = d * closure_mode_square(2, 1, 12, 8);
    ck_assert_int_eq(measure_mode(s, 0, &m), STATUS_OK);
    ck_assert_double_eq_tol(fake_value(&m, "mode-decay", "rate"), log(1 + s * DT) / DT, 1e-10);
    ck_assert_double_eq_tol(fake_value(&m, "mode-decay", "step_rate"), s, 1e-10);
    ck_assert_double_lt(fake_value(&m, "mode-decay", "lattice_error"), 1e-10);
    ck_assert_double_eq_tol(fake_value(&m, "mode-decay", "space_error"), 1 - s / continuum, 1e-10);
    ck_assert_double_eq_tol(fake_value(&m, "mode-decay", "time_error"),
                            1 - log(1 + s * DT) / (s * DT), 1e-10);
    ck_assert_double_lt(fake_value(&m, "mode-decay", "impurity"), 1e-12);
}
END_TEST

START_TEST(a_wrong_rate_and_another_mode_are_seen) {
    struct measurement m;
    double d = closure_diffusivity(CLOSURE_PUBLISHED, 0, 0.25, 3.7);
    double s = d * closure_mode_square_lattice(2, 1, 12, 8);
    ck_assert_int_eq(measure_mode(s * 1.001, 0, &m), STATUS_OK);
    ck_assert_double_eq_tol(fake_value(&m, "mode-decay", "lattice_error"), 0.001, 1e-9);
    ck_assert_int_eq(measure_mode(s, 1e-6, &m), STATUS_OK);
    ck_assert_double_gt(fake_value(&m, "mode-decay", "impurity"), 5e-5);
}
END_TEST

/* -- column ---------------------------------------------------------------------- */

/* Pressure from the flux through each face; `full`: (1+p) in the face's coefficient. */
static void measure_column(bool full, double bump, struct measurement *m) {
    enum { NX = 4, NY = 12 };
    const double band[] = {0.30, 0.55, 0.40};
    struct fake_run f =
        fake_start(full ? "  width_l: 3\n  height_l: 11\n  fixed_bed: [0.45]\n  peclet: 0.01\n"
                          "  flux_l_per_tau: 0.7\n"
                        : "  width_l: 3\n  height_l: 11\n  fixed_bed: [0.30, 0.55, 0.40]\n"
                          "  flux_l_per_tau: 0.7\n");
    double peclet = full ? 0.01 : 2e-4, p[NX * NY], rho[NX * NY], row = 0.003;
    for (size_t j = 0; j < NY; j++) {
        double here = full ? 0.45 : band[3 * j / 11 < 3 ? 3 * j / 11 : 2];
        double below = full ? 0.45 : band[j ? 3 * (j - 1) / 11 : 0];
        double k =
            closure_face_conductivity(CLOSURE_PUBLISHED, CLOSURE_ARITHMETIC, below, here, 0.25);
        if (j && full)
            row = sqrt((1 + row) * (1 + row) - 2 * peclet * 0.7 / k) - 1;
        else if (j)
            row -= peclet * 0.7 / k;
        for (size_t i = 0; i < NX; i++) {
            p[j * NX + i] = row + (j == 5 && i == 2 ? bump : 0);
            rho[j * NX + i] = here;
        }
    }
    for (int frame = 1; frame <= 2; frame++) {
        fake_field(&f, "fields/pressure", NX, NY, p, frame, DT);
        fake_field(&f, "fields/solid_fraction", NX, NY, rho, frame, DT);
    }
    unit_ok(fake_measure(&f, "column", NULL, 0, m), &f.fault);
}

START_TEST(a_layered_column_is_a_series_of_faces) {
    struct measurement m;
    measure_column(false, 0, &m);
    ck_assert_double_eq_tol(fake_value(&m, "column", "series_ratio"), 1, 1e-12);
    ck_assert_double_gt(fake_value(&m, "column", "continuum_error"), 0.01);
    ck_assert_double_lt(fake_value(&m, "column", "continuum_error"), 0.2);
    ck_assert_double_gt(fake_value(&m, "column", "bend"), 0.1);
    ck_assert_double_eq_tol(fake_value(&m, "column", "unevenness"), 0, 1e-12);
    ck_assert_double_eq(fake_value(&m, "column", "unsteadiness"), 0);
    measurement_free(&m);
    measure_column(false, 1e-6, &m);
    ck_assert_double_gt(fake_value(&m, "column", "unevenness"), 1e-5);
    measurement_free(&m);
}
END_TEST

START_TEST(a_full_column_has_a_linear_square) {
    struct measurement m;
    measure_column(true, 0, &m);
    double k = closure_conductivity(CLOSURE_PUBLISHED, 0.45, 0.25);
    ck_assert_double_eq_tol(fake_value(&m, "column", "square_slope"), -2 * 0.01 * 0.7 / k, 1e-14);
    ck_assert_double_lt(fake_value(&m, "column", "square_bend"), 1e-13);
    ck_assert_double_gt(fake_value(&m, "column", "bend"), 0.01);
    measurement_free(&m);
}
END_TEST

/* -- invariant, halo, work ------------------------------------------------------- */

enum { NX = 6, NY = 8, SITES = NX * NY, GRAINS = 60 };

struct scene {
    double x[2 * GRAINS], v[2 * GRAINS], force[2 * GRAINS], radius[GRAINS];
    double rho[SITES], u[2 * SITES], p[SITES], kept[2];
};

/* Grains anywhere, fields deposited from them, forces gathered from any pressure:
 * everything as it should be. */
static void make_scene(struct scene *s) {
    double area[SITES] = {0}, flux[2 * SITES] = {0}, pull[2 * SITES];
    memset(s, 0, sizeof *s);
    for (int i = 0; i < GRAINS; i++) {
        s->radius[i] = 0.31 + 0.07 * sin(3.1 * i);
        s->x[2 * i] = 2.5 + 2.4 * sin(1.7 * i);
        s->x[2 * i + 1] = 2.1 + 2.0 * cos(2.3 * i); /* the upper part stays empty */
        s->v[2 * i] = 0.3 * cos(1.1 * i);
        s->v[2 * i + 1] = -0.4 + 0.2 * sin(5.3 * i);
        struct closure_halo h = closure_halo_at(s->x[2 * i], s->x[2 * i + 1], NX, NY);
        for (int n = 0; n < 4; n++) {
            double share = h.weight[n] * M_PI * s->radius[i] * s->radius[i] * 2 / 3;
            area[h.site[n]] += share;
            flux[2 * h.site[n]] += share * s->v[2 * i];
            flux[2 * h.site[n] + 1] += share * s->v[2 * i + 1];
        }
    }
    for (int k = 0; k < SITES; k++)
        s->p[k] = 1e-3 * sin(0.37 * k) - 1e-4 * k;
    for (size_t k = 0; k < SITES; k++) {
        double g[2], volume = closure_site_volume(k % NX, k / NX, NX, NY);
        closure_gradient(s->p, k % NX, k / NX, NX, NY, g);
        s->rho[k] = area[k] / volume;
        double clipped = closure_clip(s->rho[k], 0.25);
        for (size_t a = 0; a < 2; a++) {
            s->u[2 * k + a] = flux[2 * k + a] / (volume * clipped);
            pull[2 * k + a] = -g[a] / (2e-4 * clipped);
            s->kept[a] -= volume * g[a] / 2e-4 * (1 - s->rho[k] / clipped);
        }
    }
    for (int i = 0; i < GRAINS; i++) {
        struct closure_halo h = closure_halo_at(s->x[2 * i], s->x[2 * i + 1], NX, NY);
        for (int n = 0; n < 4; n++)
            for (size_t a = 0; a < 2; a++)
                s->force[2 * i + (int)a] +=
                    h.weight[n] * M_PI * s->radius[i] * s->radius[i] * pull[2 * h.site[n] + a];
    }
}

static struct fake_run write_scene(const struct scene *s) {
    struct fake_run f = fake_start("  width_l: 5\n  height_l: 7\n");
    fake_array(&f, "particles/grains/radius", s->radius, GRAINS);
    fake_vectors(&f, "particles/grains/position", GRAINS, s->x, 0.5, DT);
    fake_vectors(&f, "particles/grains/velocity", GRAINS, s->v, 0.5, DT);
    fake_vectors(&f, "particles/grains/force", GRAINS, s->force, 0.5, DT);
    fake_field(&f, "fields/pressure", NX, NY, s->p, 0.5, DT);
    fake_field(&f, "fields/solid_fraction", NX, NY, s->rho, 0.5, DT);
    fake_site_vectors(&f, "fields/grain_velocity", NX, NY, s->u, 0.5, DT);
    fake_append(&f, "observables/unabsorbed_force", 1, (const size_t[]){2}, s->kept, 0.5, DT);
    return f;
}

START_TEST(a_right_deposit_is_found_right_and_a_lost_share_is_not) {
    struct scene s;
    struct measurement m;
    make_scene(&s);
    struct fake_run f = write_scene(&s);
    unit_ok(fake_measure(&f, "halo", NULL, 0, &m), &f.fault);
    ck_assert_double_lt(fake_value(&m, "halo", "total_error"), 1e-13);
    ck_assert_double_lt(fake_value(&m, "halo", "fraction_error"), 1e-13);
    ck_assert_double_lt(fake_value(&m, "halo", "velocity_error"), 1e-13);
    s.rho[13] *= 1 + 1e-6;
    s.u[27] += 1e-7;
    f = write_scene(&s);
    unit_ok(fake_measure(&f, "halo", NULL, 0, &m), &f.fault);
    ck_assert_double_gt(fake_value(&m, "halo", "total_error"), 1e-9);
    ck_assert_double_gt(fake_value(&m, "halo", "fraction_error"), 1e-8);
    ck_assert_double_eq_tol(fake_value(&m, "halo", "velocity_error"), 1e-7, 1e-12);
    f = write_scene(&s);
    unit_ok(fake_measure(&f, "uniform-fraction", NULL, 0, &m), &f.fault);
    ck_assert_double_gt(fake_value(&m, "uniform-fraction", "unevenness"), 0.1);
}
END_TEST

START_TEST(what_the_gas_loses_the_grains_receive) {
    struct scene s;
    struct measurement m;
    make_scene(&s);
    struct fake_run f = write_scene(&s);
    unit_ok(fake_measure(&f, "gas-work", NULL, 0, &m), &f.fault);
    ck_assert_double_lt(fake_value(&m, "gas-work", "gather_error"), 1e-13);
    ck_assert_double_lt(fake_value(&m, "gas-work", "adjoint_error"), 1e-13);
    ck_assert_double_lt(fake_value(&m, "gas-work", "balance_x"), 1e-13);
    ck_assert_double_lt(fake_value(&m, "gas-work", "balance_y"), 1e-13);
    ck_assert_double_lt(fake_value(&m, "gas-work", "unabsorbed_error"), 1e-13);
    ck_assert_double_gt(fake_value(&m, "gas-work", "unabsorbed_share"), 0.01);
    s.force[17] *= 1.001; /* one grain's share */
    s.kept[1] *= 1.001;
    f = write_scene(&s);
    unit_ok(fake_measure(&f, "gas-work", NULL, 0, &m), &f.fault);
    ck_assert_double_gt(fake_value(&m, "gas-work", "gather_error"), 1e-7);
    ck_assert_double_gt(fake_value(&m, "gas-work", "balance_y"), 1e-7);
    ck_assert_double_gt(fake_value(&m, "gas-work", "unabsorbed_error"), 1e-5);
}
END_TEST

/* Two steps of Eq. 8 in which gas only moves from site to site. */
static void measure_invariant(double leak, double skipped_step, struct measurement *m,
                              enum status *status) {
    struct scene s;
    make_scene(&s);
    struct fake_run f = fake_start("  width_l: 5\n  height_l: 7\n");
    for (int frame = 0; frame < 3; frame++) {
        double time = frame * DT + (frame == 2 ? skipped_step : 0);
        fake_field(&f, "fields/pressure", NX, NY, s.p, time, DT);
        fake_field(&f, "fields/solid_fraction", NX, NY, s.rho, time, DT);
        fake_site_vectors(&f, "fields/grain_velocity", NX, NY, s.u, time, DT);
        size_t from = 8, to = 33;
        double moved = 1e-5 * (frame + 1);
        double v[2];
        for (int k = 0; k < 2; k++) {
            size_t site = k ? to : from;
            v[k] = closure_site_volume(site % NX, site / NX, NX, NY) *
                   (1 - closure_clip(s.rho[site], 0.25));
        }
        s.p[from] -= moved / v[0];
        s.p[to] += moved * (1 + leak) / v[1];
    }
    *status = fake_measure(&f, "gas-invariant", NULL, 0, m);
    if (*status)
        unit_says(&f.fault, "a sample every step");
}

START_TEST(gas_that_only_moves_keeps_its_sum_and_a_leak_does_not) {
    struct measurement m;
    enum status status;
    measure_invariant(0, 0, &m, &status);
    ck_assert_int_eq(status, STATUS_OK);
    ck_assert_double_lt(fake_value(&m, "gas-invariant", "imbalance"), 1e-16);
    ck_assert_double_lt(fake_value(&m, "gas-invariant", "drift"), 1e-12);
    ck_assert_double_gt(fake_value(&m, "gas-invariant", "motion"), 1e-4);
    measure_invariant(1e-3, 0, &m, &status);
    ck_assert_double_gt(fake_value(&m, "gas-invariant", "imbalance"), 1e-9);
    ck_assert_double_gt(fake_value(&m, "gas-invariant", "drift"), 1e-4);
    measure_invariant(0, DT, &m, &status);
    ck_assert_int_eq(status, STATUS_BAD_INPUT);
}
END_TEST

/* One grain .37 l above the bottom passes site (2, 0), whose cell is half a site's; its weight is
 * wrong by `lost` once it is in the halo. */
static struct fake_run write_passage(double lost) {
    const double radius = 0.23, y = 0.37;
    struct fake_run f = fake_start("  width_l: 5\n  height_l: 7\n");
    fake_array(&f, "particles/grains/radius", &radius, 1);
    for (int k = 0; k < 27; k++) {
        double x = 0.613 + 0.1 * k, rho[SITES] = {0};
        double weight = fmax(0, 1 - fabs(x - 2)) * (1 - y);
        rho[2] = (weight - (k == 11 ? lost : 0)) * M_PI * radius * radius * 2 / 3 / 0.5;
        fake_vectors(&f, "particles/grains/position", 1, (const double[]){x, y}, 0.1 * k, DT);
        fake_field(&f, "fields/solid_fraction", NX, NY, rho, 0.1 * k, DT);
    }
    return f;
}

START_TEST(a_passing_grain_draws_its_halo) {
    struct measurement m;
    struct fake_run f = write_passage(0);
    unit_ok(fake_measure(&f, "halo-shape", "site_x", 2, &m), &f.fault);
    ck_assert_double_lt(fake_value(&m, "halo-shape", "error"), 1e-14);
    ck_assert_double_eq_tol(fake_value(&m, "halo-shape", "largest"), 0.987 * 0.63, 1e-12);
    ck_assert_double_eq(fake_value(&m, "halo-shape", "inside"), 20);
    f = write_passage(1e-9);
    unit_ok(fake_measure(&f, "halo-shape", "site_x", 2, &m), &f.fault);
    ck_assert_double_eq_tol(fake_value(&m, "halo-shape", "error"), 1e-9, 1e-14);
    f = write_passage(0);
    ck_assert_int_eq(fake_measure(&f, "halo-shape", "site_x", 6, &m), STATUS_BAD_INPUT);
}
END_TEST

int main(void) {
    const TTest *const tests[] = {a_mode_that_decays_as_the_lattice_does_has_no_lattice_error,
                                  a_wrong_rate_and_another_mode_are_seen,
                                  a_layered_column_is_a_series_of_faces,
                                  a_full_column_has_a_linear_square,
                                  a_right_deposit_is_found_right_and_a_lost_share_is_not,
                                  a_passing_grain_draws_its_halo,
                                  what_the_gas_loses_the_grains_receive,
                                  gas_that_only_moves_keeps_its_sum_and_a_leak_does_not,
                                  NULL};
    return unit_run("observe_gas", tests);
}
