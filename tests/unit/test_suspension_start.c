/* test_suspension_start.c -- solver/suspension/{start,grow}.h: dense starts without overlap,
 * Maxwell velocities, waves of density. */
#include "tests/unit/suspension_fixture.h"

#include <math.h>

/* Deepest overlap of any pair, in diameters, by looking at all of them. */
static double deepest(const struct suspension *s) {
    const struct suspension_parameters *p = &s->parameters;
    double least = INFINITY;
    for (size_t i = 0; i < p->particles; i++)
        for (size_t j = 0; j < i; j++) {
            double square = 0;
            for (size_t a = 0; a < 3; a++) {
                double d = fabs(s->position[3 * i + a] - s->position[3 * j + a]);
                if (p->boundary[a] == BOUNDARY_PERIODIC)
                    d = fmin(d, p->box[a] - d);
                square += d * d;
            }
            least = fmin(least, square);
        }
    return 1 - sqrt(least) / (2 * p->radius);
}

static void expect_packed(const char *yaml, double packing) {
    struct suspension *s = fixture_state(yaml, 1371);
    const struct suspension_parameters *p = &s->parameters;
    fixture_look(s);
    ck_assert_double_eq_tol(suspension_parameters_packing(p), packing, 1e-12);
    ck_assert_double_le(deepest(s), 1e-10); /* the engine's own bound for a start */
    for (size_t k = 0; k < 3 * p->particles; k++) {
        double edge = p->boundary[k % 3] == BOUNDARY_HARD ? p->radius * (1 - 1e-12) : 0;
        ck_assert_double_ge(s->position[k], edge);
        ck_assert_double_le(s->position[k], p->box[k % 3] - edge);
    }
    suspension_model.free(s);
}

START_TEST(a_dilute_start_is_placed_without_overlap) {
    expect_packed("particles: 700\npacking_fraction: 0.11\nboundary_x: periodic\n", 0.11);
}
END_TEST

START_TEST(packing_55_between_hard_walls_is_reached_without_overlap) {
    expect_packed("particles: 1000\nwidth_x_R: 16\nwidth_y_R: 16\npacking_fraction: 0.55\n", 0.55);
}
END_TEST

/* The largest that parameters let pass. */
START_TEST(the_largest_packings_are_reached) {
    expect_packed("particles: 1500\nwidth_x_R: 16\nwidth_y_R: 16\npacking_fraction: 0.58\n", 0.58);
    expect_packed("particles: 1000\npacking_fraction: 0.6\nboundary_x: periodic\n"
                  "boundary_y: periodic\nboundary_z: periodic\n",
                  0.6);
}
END_TEST

START_TEST(a_box_too_narrow_for_its_packing_is_said_to_jam) {
    fixture_refused("particles: 300\nwidth_x_R: 3.9\nwidth_y_R: 3.9\npacking_fraction: 0.57\n",
                    "start: the spheres jam");
}
END_TEST

/* Energy exactly that of the temperature; no momentum along the periodic axis; moments of
 * 6000 components: <v^4>/<v^2>^2 = 3 within 4 sqrt(24/6000) = .25. */
START_TEST(velocities_are_maxwell_s_at_the_temperature_asked_for) {
    struct suspension *s = fixture_state("particles: 2000\npacking_fraction: 0.1\n"
                                         "boundary_z: periodic\nstart_temperature: 1.7\n"
                                         "temperature_scale: 1.3\n",
                                         77);
    double momentum = 0, fourth = 0, square = s->parameters.temperature * 1.7 / 2.262e-6;
    ck_assert_double_eq_tol(fixture_temperature(s), 1.7 * 1.3 * 2e-9, 1e-21);
    for (size_t i = 0; i < 2000; i++)
        momentum += s->velocity[3 * i + 2];
    for (size_t k = 0; k < 6000; k++)
        fourth += pow(s->velocity[k], 4) / 6000;
    ck_assert_double_eq_tol(momentum, 0, 1e-12 * 2000 * sqrt(square));
    ck_assert_double_eq_tol(fourth / (square * square), 3, 0.25);
    suspension_model.free(s);
}
END_TEST

/* Fourier component of the density: N A/2 in the sine of mode k; that of a uniform fluid
 * scatters by sqrt(N S/2), S < .3 here: 25 of 225. */
START_TEST(a_wave_of_density_has_its_amplitude_and_phase_and_no_overlap) {
    struct suspension *s =
        fixture_state("particles: 3000\nwidth_x_R: 14\nwidth_y_R: 14\npacking_fraction: 0.3\n"
                      "boundary_x: periodic\nboundary_y: periodic\nboundary_z: periodic\n"
                      "wave_mode: 2\nwave_amplitude: 0.15\n",
                      78);
    double sine = 0, cosine = 0;
    fixture_look(s);
    for (size_t i = 0; i < 3000; i++) {
        double phase = 2 * M_PI * 2 * s->position[3 * i + 2] / s->parameters.box[2];
        sine += sin(phase);
        cosine += cos(phase);
    }
    ck_assert_double_eq_tol(sine, 3000 * 0.15 / 2, 60);
    ck_assert_double_eq_tol(cosine, 0, 60);
    ck_assert_double_le(deepest(s), 1e-10);
    suspension_model.free(s);
}
END_TEST

/* A bed 24.6 R high in a box of 60 R. */
static const char sharp[] = "start: sharp\nparticles: 900\nphibar: 0.37\nwidth_x_R: 19.7\n"
                            "width_y_R: 21\nheight_R: 60\ntemperature_scale: 1.3\n"
                            "start_temperature: 1.7\n";

/* Centres lie at random between R and h - R: their share in the lower half, the quarter
 * next to it and so on scatters by less than sqrt(n (1 - x)) of an ideal gas. */
START_TEST(a_sharp_start_is_uniform_up_to_its_top_and_empty_above) {
    struct suspension *s = fixture_state(sharp, 4711);
    const struct suspension_parameters *p = &s->parameters;
    const double h = 900 * (4 * M_PI / 3) / (0.37 * 19.7 * 21) * p->radius;
    size_t bin[4] = {0};
    ck_assert_double_eq_tol(suspension_parameters_filled_height(p), h, 1e-12 * h);
    fixture_look(s);
    ck_assert_double_le(deepest(s), 1e-10);
    for (size_t i = 0; i < 900; i++) {
        double z = s->position[3 * i + 2];
        ck_assert_double_ge(z, p->radius * (1 - 1e-12));
        ck_assert_double_le(z, h - p->radius * (1 - 1e-12));
        bin[(int)fmin(3, 4 * z / h)]++;
    }
    for (size_t k = 0; k < 4; k++) /* 225 each, less than 4 sqrt(225 3/4) apart; layering adds 5 */
        ck_assert_double_eq_tol((double)bin[k], 225, 40);
    suspension_model.free(s);
}
END_TEST

START_TEST(a_sharp_start_has_its_energy_and_repeats) {
    struct suspension *a = fixture_state(sharp, 4711), *b = fixture_state(sharp, 4711),
                      *c = fixture_state(sharp, 4712);
    ck_assert_double_eq_tol(fixture_temperature(a), 1.7 * 1.3 * 2e-9, 1e-21);
    fixture_look(b);
    fixture_look(c);
    ck_assert_mem_eq(a->position, b->position, 3 * 900 * sizeof(double));
    ck_assert_mem_eq(a->velocity, b->velocity, 3 * 900 * sizeof(double));
    ck_assert_mem_ne(a->position, c->position, 3 * 900 * sizeof(double));
    suspension_model.free(a);
    suspension_model.free(b);
    suspension_model.free(c);
}
END_TEST

/* With a drive the packing that Enskog's rate is made of is that of the spheres' layers,
 * 10 R thick: phibar, but for the top where a part of the layer is empty (1/2 at the very
 * top, 3/4 on average over 5 of 25 R) and the centres' lack of room at the walls. */
START_TEST(the_noise_of_a_sharp_start_is_that_of_the_bed_not_of_the_box) {
    char yaml[512];
    snprintf(yaml, sizeof yaml, "%sdrive: linear\nnoise_rate: enskog\n", sharp);
    struct suspension *s = fixture_state(yaml, 4711);
    double packing = s->noise.packing;
    ck_assert_double_ge(packing, 0.37 * 0.93);
    ck_assert_double_le(packing, 0.37 * 1.07);
    ck_assert_double_eq_tol(s->noise.collision_rate,
                            noise_enskog(packing, 1.3 * 2e-9 / 2.262e-6, 2 * 6e-4),
                            1e-9 * s->noise.collision_rate);
    ck_assert_double_le(suspension_parameters_packing(&s->parameters), 0.16);
    suspension_model.free(s);
}
END_TEST

START_TEST(a_sharp_start_that_has_no_room_is_refused) {
    fixture_refused("start: sharp\nparticles: 900\nphibar: 0.37\nwidth_x_R: 19.7\n"
                    "width_y_R: 21\nheight_R: 24.6\n",
                    "start: sharp fills 24.6");
    fixture_refused("start: sharp\nparticles: 900\nphibar: 0.3\npacking_fraction: 0.3\n"
                    "width_x_R: 16\nwidth_y_R: 16\n",
                    "it must be higher");
    fixture_refused("start: sharp\nparticles: 900\nphibar: 0\nwidth_x_R: 16\nwidth_y_R: 16\n"
                    "height_R: 70\n",
                    "0 with start: sharp");
    fixture_refused("start: sharp\nparticles: 900\nphibar: 0.3\nwidth_x_R: 16\nwidth_y_R: 16\n"
                    "height_R: 70\nboundary_z: periodic\n",
                    "boundary_z: hard");
    fixture_refused("start: sharp\nparticles: 900\nphibar: 0.6\nwidth_x_R: 16\nwidth_y_R: 16\n"
                    "height_R: 70\n",
                    "the start reaches 0.58 between hard walls");
    fixture_refused("start: sharp\nparticles: 20\nphibar: 0.3\nwidth_x_R: 16\nwidth_y_R: 16\n"
                    "height_R: 70\n",
                    "it must be higher than 2 R");
    fixture_refused("start: sharp\nparticles: 1\nphibar: 0.3\nwidth_x_R: 3\nwidth_y_R: 2.1\n"
                    "height_R: 70\n",
                    "a single sphere has no temperature");
    fixture_refused("start: sharp\nparticles: 900\nphibar: 0.3\nwidth_x_R: 16\nwidth_y_R: 16\n"
                    "height_R: 70\nthermal_energy_J: 0\n",
                    "are grown while they move");
}
END_TEST

int main(void) {
    const TTest *const tests[] = {a_dilute_start_is_placed_without_overlap,
                                  packing_55_between_hard_walls_is_reached_without_overlap,
                                  the_largest_packings_are_reached,
                                  a_box_too_narrow_for_its_packing_is_said_to_jam,
                                  velocities_are_maxwell_s_at_the_temperature_asked_for,
                                  a_wave_of_density_has_its_amplitude_and_phase_and_no_overlap,
                                  a_sharp_start_is_uniform_up_to_its_top_and_empty_above,
                                  a_sharp_start_has_its_energy_and_repeats,
                                  the_noise_of_a_sharp_start_is_that_of_the_bed_not_of_the_box,
                                  a_sharp_start_that_has_no_room_is_refused,
                                  NULL};
    return unit_run("suspension start", tests);
}
