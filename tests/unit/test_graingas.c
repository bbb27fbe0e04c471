/* test_graingas.c -- solver/graingas/graingas.h: whole runs: exact motions, bits that
 * repeat, checkpoints, starts, refused input. */
#include "tests/unit/graingas_fixture.h"

#include <math.h>

static const char settling[] = "grains: 900\nwidth_l: 14\nheight_l: 20\n";

/* Fingerprint of positions and velocities by id. */
static double fingerprint(const struct graingas *s) {
    double sum = 0;
    for (size_t i = 0; i < s->grains.count; i++) {
        double weight = 1 + 1e-3 * s->grains.id[i];
        sum += weight * (s->grains.x[i] + 1.3 * s->grains.y[i] + 1.7 * s->grains.vx[i] +
                         2.1 * s->grains.vy[i]);
    }
    return sum;
}

START_TEST(the_same_seed_gives_the_same_bits_and_another_does_not) {
    double value[3];
    const uint64_t seed[3] = {41, 41, 42};
    for (int n = 0; n < 3; n++) {
        struct graingas *s = fixture_state(settling, seed[n]);
        fixture_steps(s, 200);
        value[n] = fingerprint(s);
        graingas_model.free(s);
    }
    ck_assert_double_eq(value[0], value[1]);
    ck_assert_double_ne(value[0], value[2]);
}
END_TEST

START_TEST(a_run_that_is_saved_and_loaded_gives_the_same_bits) {
    struct fault fault = FAULT_NONE;
    const char *folder = unit_folder();
    const char *path = unit_path(folder, "state.h5");
    struct graingas *a = fixture_state(settling, 41), *b = fixture_state(settling, 99);
    fixture_steps(a, 133); /* not at a rebuild of the pair list */
    unit_ok(graingas_model.save(a, path, &fault), &fault);
    unit_ok(graingas_model.load(b, path, &fault), &fault);
    ck_assert_int_eq(graingas_model.steps(b), 133);
    fixture_steps(a, 150);
    fixture_steps(b, 150);
    ck_assert_double_eq(fingerprint(a), fingerprint(b));
    ck_assert_int_eq(a->contacts.tally.collisions, b->contacts.tally.collisions);
    ck_assert_double_eq(a->contacts.tally.dissipated, b->contacts.tally.dissipated);
    graingas_model.free(a);
    graingas_model.free(b);
    unit_remove(folder);
}
END_TEST

START_TEST(a_checkpoint_of_another_size_is_refused) {
    struct fault fault = FAULT_NONE;
    const char *folder = unit_folder();
    const char *path = unit_path(folder, "state.h5");
    struct graingas *a = fixture_state(settling, 41);
    struct graingas *b = fixture_state("grains: 899\nwidth_l: 14\nheight_l: 20\n", 41);
    unit_ok(graingas_model.save(a, path, &fault), &fault);
    ck_assert_int_eq(graingas_model.load(b, path, &fault), STATUS_BAD_INPUT);
    unit_says(&fault, "900 values, at most 899 expected");
    graingas_model.free(a);
    graingas_model.free(b);
    unit_remove(folder);
}
END_TEST

START_TEST(a_grain_in_free_fall_follows_the_parabola) {
    struct graingas *s = fixture_state("grains: 1\nwidth_l: 5\nheight_l: 50\nstart: list\n"
                                       "grain_x: [2.37]\ngrain_y: [41.3]\ngrain_diameter: [0.43]\n"
                                       "grain_velocity_x: [0.11]\ngrain_velocity_y: [0.9]\n"
                                       "froude: 1.7\ngas: none\ndt_tau: 0.0117\n",
                                       1);
    fixture_steps(s, 500);
    double t = 500 * 0.0117;
    ck_assert_double_eq_tol(s->grains.y[0], 41.3 + 0.9 * t - t * t / 3.4, 1e-11);
    ck_assert_double_eq_tol(s->grains.x[0], 2.37 + 0.11 * t, 1e-12);
    ck_assert_double_eq_tol(graingas_model.time(s), t, 1e-13);
    graingas_model.free(s);
}
END_TEST

/* A single grain at rest feels q rho_min/(Fr (1-rho_min)^m) - 1/Fr wherever it stands. */
START_TEST(a_grain_at_rest_in_a_through_flow_feels_the_exact_force) {
    for (int corrected = 0; corrected < 2; corrected++) {
        char yaml[512];
        snprintf(yaml, sizeof yaml,
                 "grains: 1\nwidth_l: 6\nheight_l: 9\nstart: list\ngrain_x: [2.37]\n"
                 "grain_y: [4.81]\ngrain_diameter: [0.43]\ngrain_velocity_x: [0]\n"
                 "grain_velocity_y: [0]\nfroude: 1.3\nflux_l_per_tau: 0.9\nhold_tau: 2\n"
                 "pressure_tolerance: 1.0e-13\ndarcy: %s\n",
                 corrected ? "corrected" : "published");
        struct graingas *s = fixture_state(yaml, 1);
        fixture_steps(s, 161); /* held for 160 */
        double a = (0.9 * 0.25 / pow(0.75, corrected ? 3 : 4) - 1) / 1.3;
        ck_assert_double_eq_tol(s->grains.vy[0] / 0.0125, a, 1e-8);
        ck_assert_double_eq_tol(s->grains.vx[0], 0, 1e-12);
        graingas_model.free(s);
    }
}
END_TEST

START_TEST(the_random_start_has_no_overlap_and_stays_inside) {
    struct graingas *s = fixture_state("grains: 700\nwidth_l: 11\nheight_l: 12\n", 8);
    const struct grains *g = &s->grains; /* area fraction .76 */
    double smallest = 1, largest = 0;
    for (size_t i = 0; i < g->count; i++) {
        ck_assert(g->x[i] >= g->radius[i] && g->x[i] <= 11 - g->radius[i]);
        ck_assert(g->y[i] >= g->radius[i] && g->y[i] <= 12 - g->radius[i]);
        smallest = fmin(smallest, 2 * g->radius[i]);
        largest = fmax(largest, 2 * g->radius[i]);
        for (size_t j = 0; j < i; j++)
            ck_assert_double_ge(hypot(g->x[i] - g->x[j], g->y[i] - g->y[j]),
                                g->radius[i] + g->radius[j]);
    }
    ck_assert(smallest >= 0.35 && smallest < 0.352 && largest <= 0.5 && largest > 0.498);
    graingas_model.free(s);
}
END_TEST

START_TEST(equilibration_ends_at_rest_and_says_its_collisions) {
    struct graingas *s =
        fixture_state("grains: 300\nwidth_l: 9\nheight_l: 10\nstart: equilibrated\n", 8);
    ck_assert_double_eq(grains_kinetic_energy(&s->grains), 0);
    ck_assert_double_gt(s->start_collisions, 20);
    graingas_model.free(s);
}
END_TEST

START_TEST(layers_alternate_from_the_floor) {
    struct graingas *s = fixture_state("grains: 300\nwidth_l: 9\nheight_l: 10\nlayers: 4\n", 8);
    double top = 0;
    for (size_t i = 0; i < 300; i++)
        top = fmax(top, s->grains.y[i]);
    for (size_t i = 0; i < 300; i++)
        if (s->grains.y[i] < top * 0.999)
            ck_assert_int_eq(s->grains.species[i], (int)(4 * s->grains.y[i] / top) % 2);
    graingas_model.free(s);
}
END_TEST

/* In an empty closed box the pressure of the whole lattice cannot change, but the floor row's
 * rises with the flux: steady, dp = Pe q H/K, so its steps tell which flux was on. */
START_TEST(a_schedule_of_fluxes_goes_step_by_step_and_ends) {
    struct graingas *s = fixture_state("grains: 0\nwidth_l: 4\nheight_l: 6\nflux_on_tau: 0.5\n"
                                       "flux_schedule_l_per_tau: [0.21, 0.13, -0.34]\n"
                                       "flux_schedule_every_tau: 1.5\ndt_tau: 0.01\n",
                                       1);
    static const struct {
        double until, flux;
    } turn[] = {{0.5, 0}, {2, 0.21}, {3.5, 0.13}, {5, -0.34}, {7, 0}};
    double k = pow(0.75, 4) / (0.25 * 0.25);
    for (size_t n = 0; n < sizeof turn / sizeof *turn; n++) {
        while (!graingas_model.reached(s, turn[n].until))
            fixture_steps(s, 1);
        const double *p = s->gas.pressure;
        double drop = p[0] - p[s->lattice.sites - 1];
        ck_assert_double_eq_tol(drop / 2e-4, turn[n].flux * 6 / k, 2e-3);
    }
    graingas_model.free(s);
}
END_TEST

START_TEST(what_cannot_be_run_is_refused_before_the_first_step) {
    const struct {
        const char *yaml, *says;
    } bad[] = {
        {"dt_tau: 0.07\n", "beyond the drag's stability bound 0.0672"},
        {"grains: 31500\n", "at most 0.80 can be placed"},
        {"grains: 2\nstart: list\ngrain_x: [1.5]\n", "1 values where start: list has 2"},
        {"grain_x: [1.5]\n", "used with start: list only"},
        {"grains: 3\nmirror: true\n", "an even number of grains"},
        {"flux_on_tau: 3\nflux_off_tau: 2\n", "is before flux_on_tau"},
        {"grains: 300\nwidth_l: 9\nheight_l: 10\nstart: equilibrated\nequilibrate_speed: 60\n",
         "equilibrate_speed 60 is too fast for steps of 0.0125 tau: start: grain"},
        {"flux_l_per_tau: 0.3\nflux_schedule_l_per_tau: [0.1, 0.2]\n",
         "flux_l_per_tau: 0.3 beside a schedule of 2 fluxes"},
        {"start: from-file\n", "needs a start_file"}};
    for (size_t n = 0; n < sizeof bad / sizeof *bad; n++) {
        struct fault fault = fixture_refused(bad[n].yaml);
        unit_says(&fault, bad[n].says);
    }
}
END_TEST

/* Faster than a box a step: nothing may be read outside of the lattice. */
START_TEST(a_grain_that_leaves_the_box_stops_the_run) {
    struct fault fault = FAULT_NONE;
    struct graingas *s = fixture_state("grains: 1\nwidth_l: 5\nheight_l: 5\nstart: list\n"
                                       "grain_x: [0.3]\ngrain_y: [2.5]\ngrain_diameter: [0.43]\n"
                                       "grain_velocity_x: [-90]\ngrain_velocity_y: [0]\n",
                                       1);
    ck_assert_int_eq(graingas_model.step(s, &fault), STATUS_NUMERICAL);
    unit_says(&fault, "step 1: grain 0 is at");
    graingas_model.free(s);
}
END_TEST

int main(void) {
    const TTest *const tests[] = {the_same_seed_gives_the_same_bits_and_another_does_not,
                                  a_run_that_is_saved_and_loaded_gives_the_same_bits,
                                  a_checkpoint_of_another_size_is_refused,
                                  a_grain_in_free_fall_follows_the_parabola,
                                  a_grain_at_rest_in_a_through_flow_feels_the_exact_force,
                                  the_random_start_has_no_overlap_and_stays_inside,
                                  equilibration_ends_at_rest_and_says_its_collisions,
                                  layers_alternate_from_the_floor,
                                  a_schedule_of_fluxes_goes_step_by_step_and_ends,
                                  what_cannot_be_run_is_refused_before_the_first_step,
                                  a_grain_that_leaves_the_box_stops_the_run,
                                  NULL};
    return unit_run("graingas", tests);
}
