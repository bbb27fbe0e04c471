/* test_figure_trend.c -- fitted curves and what the fits give: each value at its place. */
#include "tests/unit/beds_stage.h"
#include "validation/figure_beds.h"
#include "validation/prediction.h"

static const char readings[] = "model: suspension\n"
                               "readings:\n"
                               "  one: {title: t, because: b, parameters: {drive_scale: 1}}\n"
                               "  two: {title: t, because: b, parameters: {drive_scale: 0.37}}\n";

#define HEAD                                                                                       \
    "name: fake/case\ntitle: t\nsource: s\nquestion: q\nmodel: suspension\nexpect_s: 2\n"          \
    "samples: [1]\nseeds: {first: 11, count: 2}\ntiers: {smoke: {}}\n"
#define CHECK(OBSERVABLE)                                                                          \
    "checks:\n"                                                                                    \
    "  - {name: value, observable: " OBSERVABLE                                                    \
    ", expect: 1, margin: 1, kind: model, because: b}\n"

static const char width[] =
    HEAD "sweep: {reading: [one, two], layer_R: [9.7, 6.1], phibar: [0.37, 0.31]}\n"
         "observables: {bed: {recipe: bed-interface}}\n" CHECK(
             "bed.sigma") "figures:\n"
                          "  - {recipe: interface-width, of: bed, title: Mine}\n";

static const char twice[] = HEAD "sweep: {restitution: [0.7, 0.9], phibar: [0.37, 0.31]}\n"
                                 "observables: {bed: {recipe: bed-interface}}\n" CHECK(
                                     "bed.sigma") "figures:\n"
                                                  "  - {recipe: interface-width, of: bed}\n"
                                                  "  - {recipe: relaxation, of: bed}\n";

static const char step[] = HEAD "parameters: {reading: two, phibar_times_s: [0.2]}\n"
                                "sweep: {step: {0.35 to 0.30: {phibar: 0.35, phibar_values: "
                                "[0.3]}, 0.42 to 0.37: {phibar: 0.42, "
                                "phibar_values: [0.37]}}, restitution: [0.7, 0.9]}\n"
                                "observables: {step: {recipe: bed-relaxation}}\n"
                                "across: {all: {fit: relaxation, of: step, along: seeds}}\n" CHECK(
                                    "all.rate") "figures:\n"
                                                "  - {recipe: relaxation, of: step}\n";

static void set(struct beds_stage *s, size_t point, size_t seed, const char *output, double value) {
    const struct recipe *r = s->c->observable[0].recipe;
    for (size_t i = 0; i < RECIPE_MAX_OUTPUTS && r->output[i].name; i++)
        if (strcmp(r->output[i].name, output) == 0) {
            s->m->point[point].run[seed].observable[0].value[i] = value;
            return;
        }
    ck_abort_msg("no output %s", output);
}

static void add_curve(struct beds_stage *s, size_t point, size_t seed, const char *name,
                      const double *x, const double *y, size_t count) {
    struct fault fault = FAULT_NONE;
    unit_ok(measurement_add_curve(&s->m->point[point].run[seed].observable[0], name, name, x, y,
                                  count, &fault),
            &fault);
}

static double sigma_of(size_t point, size_t seed) {
    return 6.13 + .37 * (double)point + .11 * (double)seed;
}

static void fill_widths(struct beds_stage *s) {
    static const double x[] = {.7, 1.9, 3.1, 5.3}, y[] = {.31, .29, .13, 0},
                        fit[] = {.3, .3, .1, 0};
    for (size_t p = 0; p < s->m->point_count; p++)
        for (size_t i = 0; i < 2; i++) {
            set(s, p, i, "sigma", sigma_of(p, i));
            set(s, p, i, "walls", 1);
            set(s, p, i, "above", 10);
            set(s, p, i, "plateau_free", 0);
            add_curve(s, p, i, "profile", x, y, 4);
            add_curve(s, p, i, "fit", x, fit, 4);
        }
}

START_TEST(widths_stand_over_phibar_one_figure_a_reading) {
    struct beds_stage s;
    struct fault fault;
    beds_set_up(&s, width, readings, false);
    fill_widths(&s);
    unit_ok(beds_build(&s, 0, &fault), &fault);
    ck_assert_uint_eq(s.out->figure_count, 4);
    beds_says(s.out->figure[3].title, "Mine: width of the interface (reading two)");
    const struct report_series *series = s.out->figure[3].panel[0].series;
    /* points of reading two: 4 and 5 are of 9.7 R, 6 and 7 of 6.1 R; the second is of phibar .31 */
    ck_assert_str_eq(series[0].label, "layer 9.7 R");
    ck_assert_uint_eq(series[0].count, 2);
    ck_assert_double_eq(series[0].x[0], .31);
    ck_assert_double_eq_tol(series[0].y[0], (sigma_of(5, 0) + sigma_of(5, 1)) / 2, 1e-12);
    ck_assert_double_eq_tol(series[0].error[0], .055, 1e-12);
    ck_assert_str_eq(series[3].label, "layer 6.1 R");
    ck_assert_double_eq_tol(series[3].y[1], sigma_of(6, 0) + .055, 1e-12);
    ck_assert_int_ne(series[0].colour, series[3].colour);
    beds_tear_down(&s);
}
END_TEST

START_TEST(profiles_of_one_layer_are_drawn_with_fits_in_their_colour_and_without_empty_ends) {
    struct beds_stage s;
    struct fault fault;
    beds_set_up(&s, width, readings, false);
    fill_widths(&s);
    unit_ok(beds_build(&s, 0, &fault), &fault);
    const struct report_figure *f = &s.out->figure[0];
    ck_assert_uint_eq(f->panel[0].series_count, 4); /* two phibar, dots and line each */
    ck_assert_str_eq(f->panel[0].series[2].label, "phibar 0.31");
    ck_assert_int_eq(f->panel[0].series[2].style, SERIES_DOTS);
    ck_assert_int_eq(f->panel[0].series[3].style, SERIES_LINE);
    ck_assert_int_eq(f->panel[0].series[2].colour, f->panel[0].series[3].colour);
    ck_assert_uint_eq(f->panel[0].series[2].count, 3); /* nothing is at 5.3 R */
    beds_says(f->title, "(reading one)");
    beds_says(f->caption, "Shown: layer 9.7 R.");
    beds_tear_down(&s);
}
END_TEST

static double weigh(const double *in) {
    return in[0] + 10 * in[1] + 100 * in[2] + 1000 * in[3];
}

/* A parameter of the run, and outputs of the observable by name and by name and unit. */
START_TEST(theory_takes_parameters_and_outputs) {
    static const struct prediction law = {
        .name = "l", .input = {"exponent", "walls", "above_R", "plateau_free", NULL}, .at = weigh};
    static const struct prediction lost = {.name = "l", .input = {"absent", NULL}, .at = weigh};
    struct beds_stage s;
    struct fault fault = FAULT_NONE;
    double value;
    beds_set_up(&s, width, readings, false);
    struct figure_input in = {.data = s.m,
                              .file = s.c,
                              .wanted = &s.c->figure[0],
                              .observable = s.c->figure[0].observable,
                              .observable_count = 1};
    for (size_t i = 0; i < 2; i++) {
        set(&s, 5, i, "walls", 1.3);
        set(&s, 5, i, "above", 7.1 + .2 * (double)i);
        set(&s, 5, i, "plateau", 99);
        set(&s, 5, i, "plateau_free", .7);
    }
    unit_ok(figure_bed_predict(&in, &s.m->point[5], &law, &value, &fault), &fault);
    ck_assert_double_eq_tol(value, 4.65 + 13 + 720 + 700, 1e-9);
    ck_assert_int_eq(figure_bed_predict(&in, &s.m->point[5], &lost, &value, &fault),
                     STATUS_NOT_FOUND);
    beds_tear_down(&s);
}
END_TEST

START_TEST(two_points_at_one_place_and_another_recipe_are_faults) {
    struct beds_stage s;
    struct fault fault;
    beds_set_up(&s, twice, NULL, false);
    fill_widths(&s);
    ck_assert_int_eq(beds_build(&s, 0, &fault), STATUS_BAD_INPUT);
    unit_says(&fault, "have one place in the figure");
    ck_assert_int_eq(beds_build(&s, 1, &fault), STATUS_BAD_INPUT);
    unit_says(&fault, "draws an observable of the recipe bed-relaxation");
    beds_tear_down(&s);
}
END_TEST

START_TEST(rates_are_of_the_fit_over_seeds_at_the_phibar_changed_to) {
    static const double x[] = {.1, .2}, y[] = {.31, .47};
    struct beds_stage s;
    struct fault fault;
    beds_set_up(&s, step, readings, true);
    for (size_t p = 0; p < s.m->point_count; p++) {
        struct measured_point *at = &s.m->point[p];
        at->ensemble = arena_take(&s.m->arena, 1, sizeof *at->ensemble);
        at->ensemble[0].value[0] = 3.1 + .17 * (double)p;
        at->ensemble[0].uncertainty[0] = .023 + .01 * (double)p;
        for (size_t i = 0; i < 2; i++) {
            set(&s, p, i, "rate", 99);
            add_curve(&s, p, i, "L", x, y, 2);
        }
    }
    unit_ok(beds_build(&s, 0, &fault), &fault);
    const struct report_series *series = s.out->figure[1].panel[0].series;
    ck_assert_str_eq(series[0].label, "restitution 0.7");
    ck_assert_double_eq(series[0].x[0], .3);
    ck_assert_double_eq(series[0].x[1], .37);
    ck_assert_double_eq_tol(series[0].y[1], 3.1 + .34, 1e-12);
    ck_assert_double_eq_tol(series[0].error[1], .043, 1e-12);
    beds_says(s.out->figure[1].title, "(reading two)");
    beds_says(s.out->figure[1].caption, "one fit to all seeds");
    beds_says(s.out->figure[0].panel[0].series[1].label, "step 0.42 to 0.37");
    const struct report_table *t = &s.out->table[0];
    ck_assert_uint_eq(t->rows, 4);
    ck_assert_str_eq(t->cell[0], "two");
    ck_assert_str_eq(t->cell[1], "0.7");
    ck_assert_str_eq(t->cell[2], "0.3");
    ck_assert_str_eq(t->cell[3], "3.1 ± 0.023");
    beds_tear_down(&s);
}
END_TEST

int main(void) {
    const TTest *const tests[] = {
        widths_stand_over_phibar_one_figure_a_reading,
        profiles_of_one_layer_are_drawn_with_fits_in_their_colour_and_without_empty_ends,
        theory_takes_parameters_and_outputs,
        two_points_at_one_place_and_another_recipe_are_faults,
        rates_are_of_the_fit_over_seeds_at_the_phibar_changed_to,
        NULL};
    return unit_run("figure_trend", tests);
}
