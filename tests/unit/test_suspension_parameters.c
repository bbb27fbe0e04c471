/* test_suspension_parameters.c -- solver/suspension/{parameters,groups,noise,drive}.h: the box,
 * the derived groups, rates and forces in numbers, and input that is refused. */
#include "solver/suspension/groups.h"
#include "tests/unit/suspension_fixture.h"

#include <math.h>

/* -- what the numbers mean ------------------------------------------------------------- */

static struct suspension_parameters read_parameters(const char *yaml) {
    struct fault fault = FAULT_NONE;
    struct yaml_document *document;
    struct parameter_set set;
    struct suspension_parameters out;
    unit_ok(yaml_parse("fixture", yaml, strlen(yaml), &document, &fault), &fault);
    unit_ok(parameters_read(&suspension_model, yaml_root(document), NULL, 0, &set, &fault), &fault);
    unit_ok(suspension_parameters_read(&set, &out, &fault), &fault);
    parameters_free(&set);
    yaml_free(document);
    return out;
}

START_TEST(sides_left_out_follow_from_the_packing_fraction) {
    struct suspension_parameters cube = read_parameters("particles: 731\npacking_fraction: 0.37\n");
    ck_assert_double_eq_tol(cube.box[0] / 6e-4, cbrt(731 * 4 * M_PI / 3 / 0.37), 1e-12);
    ck_assert_double_eq(cube.box[0], cube.box[2]);
    ck_assert_double_eq_tol(suspension_parameters_packing(&cube), 0.37, 1e-14);
    struct suspension_parameters tall =
        read_parameters("particles: 731\npacking_fraction: 0.37\nwidth_x_R: 16\nwidth_y_R: 13\n");
    ck_assert_double_eq_tol(tall.box[2] / 6e-4, 731 * 4 * M_PI / 3 / 0.37 / (16 * 13), 1e-11);
    struct suspension_parameters given = read_parameters(
        "particles: 731\nwidth_x_R: 16\nwidth_y_R: 13\nheight_R: 57\nboundary_y: periodic\n");
    ck_assert_double_eq_tol(suspension_parameters_packing(&given),
                            731 * 4 * M_PI / 3 / (16. * 13 * 57), 1e-14);
    ck_assert_int_eq(given.boundary[1], BOUNDARY_PERIODIC);
    ck_assert_int_eq(given.boundary[2], BOUNDARY_HARD);
}
END_TEST

/* FZ's numbers: Z = 16 (Section III); the stability ratios were worked out by hand from
 * Carnahan and Starling's pressure: 4.7 at .3, .97 at .5. */
START_TEST(groups_are_those_of_the_paper_s_numbers) {
    struct suspension_parameters v = read_parameters("layer_R: 10\n");
    struct groups g = groups_of(&v, 0.3);
    ck_assert_double_eq_tol(g.lift, 15.977, 1e-3);
    ck_assert_double_eq_tol(g.thermal_speed / 6e-4, 49.56, 5e-3);
    ck_assert_double_eq_tol(g.drag, 5 * pow(0.7, -4.65) / 49.558, 1e-4);
    ck_assert_double_eq_tol(g.drive, 4.65 * 9.81 * 0.6 * 2.262e-6 * 6e-4 / 2e-9, 1e-10);
    ck_assert_double_eq_tol(g.kick, 250 / 49.558, 1e-3);
    ck_assert_double_eq_tol(g.stability, 4.69, 0.01);
    ck_assert_double_eq_tol(groups_of(&v, 0.5).stability, 0.97, 0.005);
    v = read_parameters("drive_scale: 0.284\ntemperature_scale: 2.84\n");
    ck_assert_double_eq_tol(groups_of(&v, 0.3).drive, g.drive / 10, 1e-12);
    ck_assert_double_eq_tol(groups_of(&v, 0.3).lift, g.lift / 2.84, 1e-12);
}
END_TEST

/* 24 phi g(d)/d sqrt(T/(pi m)) at .3, .45: g(d) = .85/.343 and .775/.166375. */
START_TEST(enskog_s_rate_is_that_of_carnahan_and_starling) {
    double t = 2e-9 / 2.262e-6, d = 1.2e-3;
    ck_assert_double_eq_tol(noise_enskog(0.3, t, d), 24 * 0.3 * 2.478134 / d * sqrt(t / M_PI),
                            1e-4);
    ck_assert_double_eq_tol(noise_enskog(0.3, t, d), 249.4, 0.1);
    ck_assert_double_eq_tol(noise_enskog(0.45, t, d),
                            24 * 0.45 * 0.775 / 0.166375 / d * sqrt(t / M_PI), 1e-9);
}
END_TEST

START_TEST(kick_variances_are_those_of_the_power_balance) {
    struct noise n;
    const double t = 2e-9 / 2.262e-6;
    struct suspension_parameters v = read_parameters("restitution: 0.7\n");
    noise_start(&n, &v, 0.3, 26.3);
    double rate = noise_enskog(0.3, t, 1.2e-3);
    ck_assert_double_eq_tol(n.variance, t * (rate * 0.51 / 3 + 2 * 26.3) / 250, 1e-15);
    v = read_parameters("noise_rate: fixed-kick\n");
    noise_start(&n, &v, 0.3, 26.3);
    ck_assert_double_eq_tol(n.variance, t * 2 * 5 / 250, 1e-17);
    noise_change(&n, 100);
    ck_assert_double_eq_tol(n.variance, t * 2 * 5 / 250, 1e-17);
    v = read_parameters("noise_rate: given\nkick_variance_m2_per_s2: 3.7e-4\n");
    noise_start(&n, &v, 0.3, 26.3);
    ck_assert_double_eq(n.variance, 3.7e-4);
    v = read_parameters("noise_rate: none\n");
    noise_start(&n, &v, 0.3, 26.3);
    ck_assert_double_eq(n.variance, 0);
}
END_TEST

/* The measured rate is approached within ten kicks: 1 - 1/e after 10/f_dr = .04 s. */
START_TEST(a_measured_rate_comes_into_force_over_ten_kicks) {
    struct noise n;
    struct suspension_parameters v = read_parameters("noise_rate: measured\n");
    noise_start(&n, &v, 0.3, 26.3);
    double from = n.collision_rate;
    for (int k = 0; k < 100; k++)
        noise_look(&n,
                   &(struct noise_reading){.elapsed = 4e-4, .collision_rate = 371, .packing = 0.3});
    ck_assert_double_eq_tol(n.collision_rate, from + (371 - from) * (1 - exp(-1)), 1e-9);
}
END_TEST

START_TEST(drives_push_up_where_it_is_dense_by_the_paper_s_amounts) {
    struct suspension_parameters v = read_parameters("drive: linear\ndrive_scale: 0.5\n");
    struct drive d = drive_at(&v, 0.4);
    ck_assert_double_eq_tol(drive_kick(&d, 0.43, 0.1), 0.5 * 4.65 * 9.81 * 0.6 * 0.03 / 0.6 / 250,
                            1e-15);
    v.drive = DRIVE_FULL;
    d = drive_at(&v, 0.4);
    double mine = 5 * pow(0.57, -4.65), gamma = 5 * pow(0.6, -4.65), g = 0.5 * 9.81 * 0.6;
    ck_assert_double_eq_tol(drive_kick(&d, 0.43, 0.1), (mine - gamma) / 250 * (g / gamma - 0.1),
                            1e-15);
    /* gamma(.74) = 2620/s: more than f_dr; the sphere then moves with the fluid. */
    ck_assert_double_eq_tol(drive_kick(&d, 0.9, 0.1), g / gamma - 0.1, 1e-15);
    /* Small differences: both laws agree to first order. */
    struct drive linear = d;
    linear.law = DRIVE_LINEAR;
    ck_assert_double_eq_tol(drive_kick(&d, 0.4001, 0) / drive_kick(&linear, 0.4001, 0), 1, 1e-3);
}
END_TEST

/* -- what is refused ------------------------------------------------------------------- */

START_TEST(more_than_a_start_can_pack_is_refused_with_the_numbers) {
    fixture_refused("packing_fraction: 0.585\n",
                    "10000 spheres fill 0.5850 of the box; the start reaches 0.58 between hard");
    fixture_refused("packing_fraction: 0.61\nboundary_x: periodic\nboundary_y: periodic\n"
                    "boundary_z: periodic\n",
                    "fill 0.6100 of the box; the start reaches 0.60 in a periodic");
    fixture_refused("packing_fraction: 0.5\nboundary_x: periodic\nboundary_y: periodic\n"
                    "boundary_z: periodic\nwave_mode: 1\nwave_amplitude: 0.1\n",
                    "before the wave is made");
    fixture_refused("width_x_R: 9\nwidth_y_R: 9\nheight_R: 9\n", "the start reaches");
}
END_TEST

START_TEST(boxes_that_cannot_be_are_refused) {
    fixture_refused("width_x_R: 16\n", "width_y_R: 0 beside other sides");
    fixture_refused("height_R: 16\n", "width_x_R: 0 beside other sides");
    fixture_refused("particles: 2\nwidth_x_R: 1.9\nwidth_y_R: 30\nheight_R: 30\n",
                    "a hard side of 1.9 R; it must be longer than 2 R");
    fixture_refused("particles: 2\nwidth_x_R: 30\nwidth_y_R: 30\nheight_R: 3.9\n"
                    "boundary_z: periodic\n",
                    "height_R: a periodic side of 3.9 R");
    fixture_refused("width_x_R: 40\nwidth_y_R: 40\nheight_R: 100\npacking_fraction: 0.3\n",
                    "leave one of them out");
    fixture_refused("width_x_R: -3\n", "width_x_R");
    fixture_refused("height_R: .nan\n", "height_R");
}
END_TEST

START_TEST(drives_and_noise_that_cannot_be_are_refused) {
    fixture_refused("drive: linear\nkick_rate_per_s: 0\n", "0 with a drive");
    fixture_refused("drive: full\ndrag_per_s: 0\n", "0 with drive: full");
    fixture_refused("kick_rate_per_s: 0\n", "0 with random kicks");
    fixture_refused("drive: linear\nwidth_x_R: 60\nwidth_y_R: 60\nheight_R: 39\nlayer_R: 40\n",
                    "a layer of 40 R in a box 39 R high");
    fixture_refused("drive: linear\nlayer_R: 2\nhistogram_bin_R: 3\n", "bins of 3 R for layers");
    fixture_refused("noise_rate: given\n", "0 with noise_rate: given");
    fixture_refused("kick_variance_m2_per_s2: 1.0e-4\n", "0.0001 with noise_rate: enskog");
    fixture_refused("noise_rate: feedback\nthermal_energy_J: 0\npacking_fraction: 0.1\n",
                    "feedback needs a temperature above 0");
    fixture_refused("kick_rate_per_s: -1\n", "kick_rate_per_s");
    fixture_refused("restitution: 1.1\n", "restitution");
    fixture_refused("drag_per_s: .inf\n", "drag_per_s");
}
END_TEST

START_TEST(schedules_of_phibar_must_be_in_order_and_complete) {
    fixture_refused("phibar_times_s: [0.5, 0.2]\nphibar_values: [0.3, 0.4]\n",
                    "out of order: 0.2 s comes after 0.5 s");
    fixture_refused("phibar_times_s: [0.5, 0.5]\nphibar_values: [0.3, 0.4]\n", "out of order");
    fixture_refused("phibar_times_s: [0.5]\n", "0 values for 1 phibar_times_s");
    fixture_refused("phibar_times_s: [0.5]\nphibar_values: [1.2]\n", "phibar_values");
    fixture_refused("phibar_times_s: [-0.5]\nphibar_values: [0.3]\n", "phibar_times_s");
}
END_TEST

START_TEST(numbers_of_spheres_that_cannot_be_are_refused) {
    fixture_refused("particles: 0\n", "particles");
    fixture_refused("particles: 1\n", "a single sphere has no temperature; use start: list");
    fixture_refused("particles: -4\n", "particles");
    fixture_refused("particles: 2\nstart: list\nsphere_x: [0.003]\n",
                    "sphere_x: 1 values where start: list has 2 particles");
    fixture_refused("sphere_y: [0.003]\n", "sphere_y: is used with start: list only");
    fixture_refused("particles: 2\nwidth_x_R: 9\nwidth_y_R: 9\nheight_R: 9\nstart: list\n"
                    "sphere_x: [0.002, 0.0029]\nsphere_y: [0.002, 0.002]\n"
                    "sphere_z: [0.002, 0.002]\nsphere_velocity_x: [0, 0]\n"
                    "sphere_velocity_y: [0, 0]\nsphere_velocity_z: [0, 0]\n",
                    "overlap");
}
END_TEST

START_TEST(waves_need_a_periodic_height_and_both_numbers) {
    fixture_refused("wave_mode: 2\nwave_amplitude: 0.1\n", "needs start: random and boundary_z");
    fixture_refused("wave_mode: 2\nboundary_z: periodic\n", "2 with a wave_amplitude of 0");
    fixture_refused("wave_amplitude: 0.1\nboundary_z: periodic\n",
                    "0 with a wave_amplitude of 0.1");
}
END_TEST

START_TEST(a_start_file_is_needed_and_used_only_where_it_is_said) {
    fixture_refused("start: from-file\n", "needs a start_file");
}
END_TEST

int main(void) {
    const TTest *const tests[] = {sides_left_out_follow_from_the_packing_fraction,
                                  groups_are_those_of_the_paper_s_numbers,
                                  enskog_s_rate_is_that_of_carnahan_and_starling,
                                  kick_variances_are_those_of_the_power_balance,
                                  a_measured_rate_comes_into_force_over_ten_kicks,
                                  drives_push_up_where_it_is_dense_by_the_paper_s_amounts,
                                  more_than_a_start_can_pack_is_refused_with_the_numbers,
                                  boxes_that_cannot_be_are_refused,
                                  drives_and_noise_that_cannot_be_are_refused,
                                  schedules_of_phibar_must_be_in_order_and_complete,
                                  numbers_of_spheres_that_cannot_be_are_refused,
                                  waves_need_a_periodic_height_and_both_numbers,
                                  a_start_file_is_needed_and_used_only_where_it_is_said,
                                  NULL};
    return unit_run("suspension parameters", tests);
}
