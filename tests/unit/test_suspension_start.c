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

int main(void) {
    const TTest *const tests[] = {a_dilute_start_is_placed_without_overlap,
                                  packing_55_between_hard_walls_is_reached_without_overlap,
                                  the_largest_packings_are_reached,
                                  a_box_too_narrow_for_its_packing_is_said_to_jam,
                                  velocities_are_maxwell_s_at_the_temperature_asked_for,
                                  a_wave_of_density_has_its_amplitude_and_phase_and_no_overlap,
                                  NULL};
    return unit_run("suspension start", tests);
}
