/* test_figure_beds.c -- figures of beds: the right samples, heights, counts, spheres and readings.
 */
#include "tests/unit/beds_stage.h"
#include "validation/figure_beds.h"
#include "validation/kinematic_wave.h"
#include "validation/prediction.h"
#include "validation/pressure_wave.h"

static const char readings[] = "model: suspension\n"
                               "readings:\n"
                               "  one: {title: t, because: b, parameters: {drive_scale: 1}}\n"
                               "  two: {title: t, because: b, parameters: {drive_scale: 0.37}}\n";

static const char text[] =
    "name: fake/case\ntitle: t\nsource: s\nquestion: q\nmodel: suspension\nexpect_s: 2\n"
    "parameters: {layer_R: 9.7, phibar_values: [0.41]}\n"
    "sweep: {reading: [one, two], phibar: [0.31, 0.37]}\nsamples: [1]\n"
    "seeds: {first: 11, count: 2}\n"
    "also_write: [profiles/packing_fraction]\n"
    "observables: {bed: {recipe: sphere-conservation}}\n"
    "checks:\n"
    "  - {name: value, observable: bed.collisions, expect: 1, margin: 1, kind: model, because: b}\n"
    "figures:\n"
    "  - {recipe: profiles, bin_R: 0.1, times: [0, 0.3, 0.4, 5], points: {reading: two, phibar: "
    "0.37}}\n"
    "  - {recipe: profiles, times: [0.33], points: {reading: two, phibar: 0.37}}\n"
    "  - {recipe: profiles, collisions: [5, 20, 22, 100], points: {reading: one, phibar: 0.31}}\n"
    "  - {recipe: profiles, times: [0, 0.1], bin_R: 1.6, caption: Mine.}\n"
    "  - {recipe: sphere-sequence, times: [0.1, 0.8, 3], points: {reading: two}}\n"
    "  - {recipe: sphere-sequence, points: {reading: two}}\n"
    "  - {recipe: sphere-animation, every_s: 0.2, frames: 3}\n"
    "  - {recipe: profiles, bin_R: 0.5, times: [0, 0.3], theory: kinematic}\n"
    "  - {recipe: profiles}\n"
    "  - {recipe: profiles, bin_R: 0.5, times: [0, 0.3], theory: inertial}\n"
    "tiers: {smoke: {}}\n";

enum { AT_TIMES, BETWEEN, COUNTED, ALL, PANELS, SPREAD, MOVIE, WAVE, NEITHER, INERTIAL };

START_TEST(profiles_are_means_over_seeds_at_their_times_in_R) {
    struct beds_stage s;
    struct fault fault;
    beds_set_up(&s, text, readings, false);
    unit_ok(beds_build(&s, AT_TIMES, &fault), &fault);
    ck_assert_uint_eq(s.out->figure_count, 1);
    const struct report_figure *f = &s.out->figure[0];
    const struct report_series *series = f->panel[0].series;
    ck_assert_uint_eq(f->panel[0].series_count, 3);
    ck_assert_uint_eq(series[1].count, 37); /* 36 slabs with spheres and one more */
    ck_assert_double_eq_tol(series[1].x[4], 4.5 * 26 / BEDS_BINS, 1e-12);
    double a = beds_fraction(4, 3, 0), b = beds_fraction(4, 3, 1);
    ck_assert_double_eq_tol(series[1].y[4], (a + b) / 2, 1e-12);
    ck_assert_double_eq_tol(series[1].error[4], (b - a) / 2, 1e-12);
    ck_assert_str_eq(series[1].label, "0.3 s");
    ck_assert_double_eq(f->panel[0].y_min, 0);
    beds_says(f->title, "reading two");
    beds_says(f->caption, "means over 2 seeds");
    beds_says(f->caption, "since the start");
    beds_says(f->caption, "Not reached (s): 5.");
    ck_assert_int_eq(beds_build(&s, BETWEEN, &fault), STATUS_NOT_FOUND);
    unit_says(&fault, "no sample at 0.33 s");
    ck_assert_int_eq(beds_build(&s, NEITHER, &fault), STATUS_BAD_INPUT);
    unit_says(&fault, "either times or collisions");
    beds_tear_down(&s);
}
END_TEST

/* 2 N_coll/N since the start: 10.57 f^2 for both seeds. */
START_TEST(collisions_are_those_of_each_sphere_at_the_nearest_sample) {
    struct beds_stage s;
    struct fault fault;
    beds_set_up(&s, text, readings, false);
    unit_ok(beds_build(&s, COUNTED, &fault), &fault);
    const struct report_panel *p = s.out->figure[0].panel;
    ck_assert_uint_eq(p->series_count, 3); /* 5: nearest to 0; 20 and 22: to 11; 100: to 95 */
    ck_assert_str_eq(p->series[0].label, "0 collisions, 0 s");
    ck_assert_str_eq(p->series[1].label, "11 collisions, 0.1 s");
    ck_assert_str_eq(p->series[2].label, "95 collisions, 0.3 s");
    beds_says(s.out->figure[0].caption, "No sample of its own (collisions): 22.");
    beds_tear_down(&s);
}
END_TEST

START_TEST(a_figure_for_each_point_that_says_its_reading) {
    struct beds_stage s;
    struct fault fault;
    beds_set_up(&s, text, readings, false);
    for (size_t i = 0; i < 2; i++)
        s.m->point[2].run[i].usable = false;
    s.m->point[3].run[0].usable = false;
    unit_ok(beds_build(&s, ALL, &fault), &fault);
    ck_assert_uint_eq(s.out->figure_count, 3);
    beds_says(s.out->figure[0].title, "(reading one, phibar 0.31)");
    beds_says(s.out->figure[2].title, "(reading two, phibar 0.37)");
    beds_says(s.out->figure[2].caption, "Mine. Solid: one seed");
    const struct report_series *joined = &s.out->figure[2].panel[0].series[1];
    ck_assert_ptr_null(joined->error);
    ck_assert_double_eq_tol(joined->x[1], 4.5 * 26 / BEDS_BINS, 1e-12); /* three slabs a bin */
    ck_assert_double_eq_tol(joined->y[1], beds_fraction(4, 1, 1), 1e-12);
    ck_assert_int_ne(beds_build(&s, WAVE, &fault), STATUS_OK); /* phibar does not change */
    ck_assert_uint_eq(s.out->figure_count, 3);
    beds_tear_down(&s);
}
END_TEST

START_TEST(spheres_are_shown_from_the_side_in_the_colours_of_their_heights) {
    struct beds_stage s;
    struct fault fault;
    beds_set_up(&s, text, readings, false);
    unit_ok(beds_build(&s, PANELS, &fault), &fault);
    const struct report_sequence *r = &s.out->sequence[0];
    ck_assert_uint_eq(r->frame_count, 2);
    ck_assert_double_eq_tol(r->frame[1].time, .8, 1e-12);
    for (size_t i = 0; i < BEDS_SPHERES; i++) {
        double at[3];
        beds_place(i, 8, at);
        ck_assert_double_eq_tol(r->frame[1].position[2 * i], at[0], 1e-9);
        ck_assert_double_eq_tol(r->frame[1].position[2 * i + 1], at[2], 1e-9);
        ck_assert_double_eq_tol(r->frame[1].depth[i], at[1], 1e-9);
        ck_assert_double_eq(r->radius[i], 1);
        ck_assert_uint_eq(r->kind[i], i * 4 % 7 * 5 / 7); /* rank from below, in fifths */
    }
    ck_assert_double_eq_tol(r->width, 8.3, 1e-9);
    ck_assert_double_eq_tol(r->height, 20, 1e-9); /* the highest is at 14.6 */
    ck_assert(r->lit);
    beds_says(r->title, "(reading two)");
    beds_says(r->caption, "Seed 11 of reading=two,phibar=0.31");
    beds_says(r->caption, "Not reached (s): 3.");
    beds_tear_down(&s);
}
END_TEST

START_TEST(without_times_six_and_an_animation_thinned_evenly) {
    struct beds_stage s;
    struct fault fault;
    beds_set_up(&s, text, readings, false);
    unit_ok(beds_build(&s, SPREAD, &fault), &fault);
    ck_assert_uint_eq(s.out->sequence[0].frame_count, 6);
    ck_assert_double_eq_tol(s.out->sequence[0].frame[5].time, .8, 1e-12);
    unit_ok(beds_build(&s, MOVIE, &fault), &fault); /* 0 .2 .4 .6 .8, three at the most */
    ck_assert_uint_eq(s.out->animation[0].frame_count, 3);
    ck_assert_double_eq_tol(s.out->animation[0].frame[1].time, .4, 1e-12);
    for (size_t p = 0; p < s.m->point_count; p++)
        s.m->point[p].run[0].usable = s.m->point[p].run[1].usable = false;
    ck_assert_int_eq(beds_build(&s, SPREAD, &fault), STATUS_BAD_INPUT);
    unit_says(&fault, "no run can be used");
    ck_assert_int_eq(beds_build(&s, ALL, &fault), STATUS_BAD_INPUT);
    unit_says(&fault, "no run can be used");
    beds_tear_down(&s);
}
END_TEST

START_TEST(times_count_from_the_change_and_theory_is_the_wave_of_the_checks) {
    struct beds_stage s;
    struct fault fault;
    struct run_view *v = NULL;
    struct bed_change change;
    struct kinematic_wave *w = NULL;
    double change_s, y[BEDS_BINS];
    beds_set_up(&s, text, readings, true);
    unit_ok(beds_build(&s, WAVE, &fault), &fault);
    const struct report_panel *p = s.out->figure[0].panel;
    ck_assert_uint_eq(p->series_count, 5); /* two measured, two of theory, its entry in the key */
    ck_assert_double_eq_tol(p->series[0].y[3], beds_fraction(3, 2, 0) + .0037 / 2, 1e-12);
    beds_says(s.out->figure[0].caption, "since phibar changed");
    unit_ok(run_view_open(s.run[0].run, s.run[0].result, &v, &fault), &fault);
    unit_ok(bed_change_read(v, &change, &change_s, &fault), &fault);
    unit_ok(kinematic_wave_create(&change, &w, &fault), &fault);
    unit_ok(kinematic_wave_advance(w, .3, &fault), &fault);
    kinematic_wave_profile(w, .5 * BEDS_RADIUS_M, y, BEDS_BINS);
    for (size_t k = 0; k < p->series[3].count; k++)
        ck_assert_double_eq_tol(p->series[3].y[k], y[k], 1e-12);
    ck_assert_double_gt(fabs(y[2] - .31), .01); /* it has moved */
    ck_assert_int_eq(p->series[3].colour, p->series[1].colour);
    ck_assert_str_eq(p->series[4].label, "kinematic wave");
    kinematic_wave_free(w);
    run_view_close(v);
    beds_tear_down(&s);
}
END_TEST

/* The wave of the checks has inertia: it starts late, where the one without does not. */
START_TEST(theory_with_inertia_is_that_of_the_checks) {
    struct beds_stage s;
    struct fault fault;
    struct run_view *v = NULL;
    struct bed_change change;
    struct pressure_wave *w = NULL;
    double change_s, y[2][BEDS_BINS], apart = 0;
    beds_set_up(&s, text, readings, true);
    unit_ok(beds_build(&s, INERTIAL, &fault), &fault);
    const struct report_panel *p = s.out->figure[0].panel;
    unit_ok(run_view_open(s.run[0].run, s.run[0].result, &v, &fault), &fault);
    unit_ok(bed_change_read(v, &change, &change_s, &fault), &fault);
    for (int inertia = 0; inertia < 2; inertia++) {
        change.inertia = inertia;
        unit_ok(pressure_wave_create(&change, BEDS_RADIUS_M / 2, &w, &fault), &fault);
        if (!change.sharp)
            unit_ok(pressure_wave_settle(w, &fault), &fault);
        pressure_wave_change(w);
        unit_ok(pressure_wave_advance(w, .3, &fault), &fault);
        pressure_wave_profile(w, .5 * BEDS_RADIUS_M, y[inertia], BEDS_BINS);
        pressure_wave_free(w);
    }
    for (size_t k = 0; k < p->series[3].count; k++) {
        ck_assert_double_eq_tol(p->series[3].y[k], y[1][k], 1e-12);
        apart = fmax(apart, fabs(y[1][k] - y[0][k]));
    }
    ck_assert_double_gt(apart, 1e-5); /* the drag of the fixture is strong */
    ck_assert_str_eq(p->series[4].label, "inertial wave");
    beds_says(s.out->figure[0].caption, "theory, the wave with pressure and inertia, for");
    run_view_close(v);
    beds_tear_down(&s);
}
END_TEST

START_TEST(points_are_told_apart_by_reading) {
    struct beds_stage s;
    struct measured_case of;
    beds_set_up(&s, text, readings, false);
    ck_assert(figure_bed_of_reading(s.m, 1, &of, &s.arena));
    ck_assert_uint_eq(of.point_count, 2);
    ck_assert_str_eq(figure_bed_reading(&of.point[0]), "two");
    ck_assert_str_eq(figure_bed_label(&of, &of.point[1], NULL, &s.arena), "phibar 0.37");
    ck_assert_str_eq(figure_bed_label(&of, &of.point[1], "phibar", &s.arena), "");
    ck_assert_str_eq(figure_bed_text(&of, &of.point[1], "phibar", &s.arena), "reading two");
    ck_assert_double_eq(figure_bed_number(&of.point[1], "phibar_values"), .41);
    ck_assert(isnan(figure_bed_number(&of.point[1], "absent")));
    ck_assert(!figure_bed_of_reading(s.m, 2, &of, &s.arena));
    beds_tear_down(&s);
}
END_TEST

int main(void) {
    const TTest *const tests[] = {profiles_are_means_over_seeds_at_their_times_in_R,
                                  collisions_are_those_of_each_sphere_at_the_nearest_sample,
                                  a_figure_for_each_point_that_says_its_reading,
                                  spheres_are_shown_from_the_side_in_the_colours_of_their_heights,
                                  without_times_six_and_an_animation_thinned_evenly,
                                  times_count_from_the_change_and_theory_is_the_wave_of_the_checks,
                                  theory_with_inertia_is_that_of_the_checks,
                                  points_are_told_apart_by_reading,
                                  NULL};
    return unit_run("figure_beds", tests);
}
