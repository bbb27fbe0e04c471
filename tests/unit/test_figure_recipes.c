/* test_figure_recipes.c -- figure recipes: they draw the runs, times and laws that they say. */
#include "tests/unit/case_stage.h"
#include "tests/unit/fake_run.h"
#include "validation/prediction.h"

static const char text[] =
    "name: fake/case\ntitle: t\nsource: s\nquestion: q\nmodel: graingas\nexpect_s: 2\n"
    "sweep: {darcy: [published, corrected], flux_l_per_tau: [0.13, 0.27]}\nsamples: [1]\n"
    "seeds: {first: 11, count: 2}\n"
    "observables: {bed: {recipe: contacts}, fall: {recipe: settling}, drop: {recipe: "
    "pressure-drop}}\n"
    "checks:\n"
    "  - {name: value, observable: bed.largest_overlap, expect: 1, margin: 1, kind: model,\n"
    "     because: b}\n"
    "figures:\n"
    "  - {recipe: time-sequence, times: [0, 0.2, 0.3, 7], caption: Mine.}\n"
    "  - {recipe: time-sequence, times: [0.13]}\n"
    "  - {recipe: time-sequence}\n"
    "  - {recipe: animation, every_tau: 0.2, frames: 3}\n"
    "  - {recipe: curves, of: fall, curve: speed, y: speed (U0), points: {flux_l_per_tau: 0.27}}\n"
    "  - {recipe: fluidization-curve, of: drop, points: {darcy: published, flux_l_per_tau: 0.13}}\n"
    "  - {recipe: fluidization-curve, of: drop}\n"
    "  - {recipe: bubble-rise, of: drop, points: {darcy: corrected}}\n"
    "  - {recipe: curves, of: fall, curve: density profile, x: height (l), y: fraction}\n"
    "  - {recipe: settling-curve, of: fall}\n"
    "  - {recipe: snapshot, points: {darcy: corrected}}\n"
    "  - {recipe: outputs, of: fall, points: {darcy: corrected}}\n"
    "tiers: {smoke: {}}\n";

enum {
    PANELS,
    BETWEEN,
    SPREAD,
    MOVIE,
    SPEED,
    DROP,
    TWO_LAWS,
    RISE,
    NO_CURVE,
    SETTLING,
    SNAPSHOT,
    OUTPUTS
};
enum { NX = 8, NY = 13 }; /* sites of the box */
enum { GRAINS = 5, FRAMES = 11, OBSERVABLES = 3, FALL = 1, DROPS = 2 };

/* Four points of two seeds each; the first seed of all is unusable. */
struct stage {
    struct case_file *c;
    struct plan *plan;
    struct measured_case *m;
    struct fake_run run[2]; /* published and corrected */
    const char *parent;
    struct figure_output *out;
    struct arena arena;
};

static void write_run(struct fake_run *f, const char *darcy) {
    char parameters[256];
    double position[2 * GRAINS], radius[GRAINS], species[GRAINS];
    snprintf(parameters, sizeof parameters,
             "  width_l: 7.3\n  height_l: 11.9\n  darcy: %s\n  gravity: 1.25\n", darcy);
    *f = fake_start(parameters);
    for (int i = 0; i < GRAINS; i++) {
        radius[i] = .21 + .011 * i;
        species[i] = i % 4; /* four layers, two colours */
    }
    fake_array(f, "particles/grains/radius", radius, GRAINS);
    fake_array(f, "particles/grains/species", species, GRAINS);
    for (int frame = 0; frame < FRAMES; frame++) {
        double field[NX * NY];
        for (int i = 0; i < NX * NY; i++) /* the same everywhere: interpolated to itself */
            field[i] = .013 * frame + (darcy[0] == 'c' ? .2 : .1);
        fake_field(f, "fields/solid_fraction", NX, NY, field, .1 * frame, .0125);
        for (int i = 0; i < 2 * GRAINS; i++)
            position[i] = .37 + .613 * i + .01 * frame;
        fake_vectors(f, "particles/grains/position", GRAINS, position, .1 * frame, .0125);
    }
    unit_ok(h5_commit(f->writer, &f->fault), &f->fault);
}

static void fill(struct stage *s, struct measured_point *p, size_t point) {
    const struct fake_run *f = &s->run[point / 2];
    for (size_t i = 0; i < p->run_count; i++) {
        p->run[i].run_path = f->run;
        p->run[i].result_path = f->result;
        p->run[i].usable = point > 0 || i > 0;
        p->run[i].observable = arena_take(&s->m->arena, OBSERVABLES, sizeof *p->run[i].observable);
    }
}

static void set_up(struct stage *s) {
    static char parent[64];
    struct fault fault = FAULT_NONE;
    *s = (struct stage){0};
    write_run(&s->run[0], "published");
    snprintf(parent, sizeof parent, "%s", s->run[0].folder); /* unit_folder has one buffer */
    s->parent = parent;
    write_run(&s->run[1], "corrected");
    s->c = stage_case(parent, "fake/case", text, &fault);
    unit_ok(fault.status, &fault);
    s->plan = stage_plan(s->c, TIER_SMOKE);
    s->m = stage_runs(s->plan);
    for (size_t p = 0; p < s->m->point_count; p++)
        fill(s, &s->m->point[p], p);
    s->out = arena_take(&s->arena, 1, sizeof *s->out);
    s->out->arena = &s->arena;
}

static void tear_down(struct stage *s) {
    measured_case_free(s->m);
    plan_free(s->plan);
    case_free(s->c);
    arena_free(&s->arena);
    unit_remove(s->parent);
    unit_remove(s->run[1].folder);
}

/* Build one of the case's figures, with the observables of `file`. */
static enum status build(struct stage *s, const struct case_file *file, size_t figure,
                         struct fault *fault) {
    return stage_figure(s->m, &s->c->figure[figure], file, s->out, fault);
}

static void says(const char *caption, const char *words) {
    ck_assert_msg(strstr(caption, words) != NULL, "'%s' is not in: %s", words, caption);
}

static struct measurement *measured(struct stage *s, size_t point, size_t seed, size_t observable) {
    return &s->m->point[point].run[seed].observable[observable];
}

static void add_curve(struct measurement *m, const char *name, const char *label, const double *x,
                      const double *y, size_t count) {
    struct fault fault = FAULT_NONE;
    unit_ok(measurement_add_curve(m, name, label, x, y, count, &fault), &fault);
}

/* -- sequences -------------------------------------------------------------- */

START_TEST(the_first_usable_run_is_shown_at_the_times_asked_for) {
    struct stage s;
    struct fault fault;
    set_up(&s);
    unit_ok(build(&s, s.c, PANELS, &fault), &fault);
    const struct report_sequence *r = &s.out->sequence[0];
    ck_assert_uint_eq(r->frame_count, 3);
    ck_assert_double_eq_tol(r->frame[1].time, .2, 1e-12);
    ck_assert_double_eq_tol(r->frame[2].position[7], .37 + .613 * 7 + .03, 1e-12);
    ck_assert_double_eq(r->width, 7.3);
    for (int i = 0; i < GRAINS; i++)
        ck_assert_uint_eq(r->kind[i], (unsigned)i % 2);
    says(r->caption, "Mine. ");
    says(r->caption, "seed 12 of darcy=published,flux_l_per_tau=0.13");
    says(r->caption, "Not reached (tau): 7.");
    tear_down(&s);
}
END_TEST

START_TEST(a_time_without_a_frame_is_a_fault) {
    struct stage s;
    struct fault fault;
    set_up(&s);
    ck_assert_int_eq(build(&s, s.c, BETWEEN, &fault), STATUS_NOT_FOUND);
    unit_says(&fault, "has no frame at 0.13 tau");
    ck_assert_uint_eq(s.out->sequence_count, 0);
    tear_down(&s);
}
END_TEST

START_TEST(without_times_six_are_spread_over_the_run) {
    struct stage s;
    struct fault fault;
    set_up(&s);
    unit_ok(build(&s, s.c, SPREAD, &fault), &fault);
    ck_assert_uint_eq(s.out->sequence[0].frame_count, 6);
    for (int i = 0; i < 6; i++)
        ck_assert_double_eq_tol(s.out->sequence[0].frame[i].time, .2 * i, 1e-12);
    tear_down(&s);
}
END_TEST

START_TEST(an_animation_thins_its_frames_evenly) {
    struct stage s;
    struct fault fault;
    set_up(&s);
    unit_ok(build(&s, s.c, MOVIE, &fault), &fault); /* 0 .2 .4 .6 .8 1, three at the most */
    const struct report_sequence *r = &s.out->animation[0];
    ck_assert_uint_eq(r->frame_count, 3);
    ck_assert_double_eq_tol(r->frame[2].time, .8, 1e-12);
    tear_down(&s);
}
END_TEST

START_TEST(no_usable_run_is_said) {
    struct stage s;
    struct fault fault;
    set_up(&s);
    for (size_t p = 0; p < s.m->point_count; p++)
        s.m->point[p].run[0].usable = s.m->point[p].run[1].usable = false;
    ck_assert_int_eq(build(&s, s.c, PANELS, &fault), STATUS_BAD_INPUT);
    unit_says(&fault, "no run can be used");
    ck_assert_int_eq(build(&s, s.c, DROP, &fault), STATUS_BAD_INPUT);
    tear_down(&s);
}
END_TEST

/* -- curves ----------------------------------------------------------------- */

START_TEST(seeds_of_the_same_times_are_averaged_others_drawn_one_by_one) {
    static const double x[] = {0, .37, 1.1}, other[] = {0, .41, 1.1};
    static const double a[] = {1.3, 2.7, 4.1}, b[] = {1.7, 2.1, 4.9};
    struct stage s;
    struct fault fault;
    set_up(&s);
    add_curve(measured(&s, 1, 0, FALL), "speed", "l", x, a, 3);
    add_curve(measured(&s, 1, 1, FALL), "speed", "l", x, b, 3);
    add_curve(measured(&s, 3, 0, FALL), "speed", "l", x, a, 3);
    add_curve(measured(&s, 3, 1, FALL), "speed", "l", other, b, 3);
    add_curve(measured(&s, 0, 1, FALL), "speed", "l", x, a, 3); /* not among the points */
    unit_ok(build(&s, s.c, SPEED, &fault), &fault);
    const struct report_figure *f = &s.out->figure[0];
    const struct report_series *series = f->panel[0].series;
    ck_assert_uint_eq(f->panel[0].series_count, 3);
    ck_assert_double_eq_tol(series[0].y[1], 2.4, 1e-12);
    ck_assert_double_eq_tol(series[0].error[1], .3, 1e-12); /* of the mean of 2.7 and 2.1 */
    ck_assert_str_eq(series[0].label, "darcy published");
    ck_assert_str_eq(series[1].label, "darcy corrected");
    ck_assert_str_eq(series[2].label, "");
    ck_assert_int_eq(series[1].colour, series[2].colour);
    ck_assert_int_ne(series[0].colour, series[1].colour);
    ck_assert_double_eq(series[2].x[1], .41);
    ck_assert_str_eq(f->x_label, "time (tau)");
    says(f->caption, "one line a seed");
    ck_assert_int_eq(build(&s, s.c, NO_CURVE, &fault), STATUS_BAD_INPUT);
    unit_says(&fault, "no run has the curve \"density profile\"");
    tear_down(&s);
}
END_TEST

/* -- fluidization ----------------------------------------------------------- */

static void set_output(struct measurement *m, const struct recipe *r, const char *name,
                       double value) {
    for (size_t i = 0; i < RECIPE_MAX_OUTPUTS && r->output[i].name; i++)
        if (strcmp(r->output[i].name, name) == 0) {
            m->value[i] = value;
            return;
        }
    ck_abort_msg("no output %s", name);
}

START_TEST(the_break_is_marked_and_the_law_at_the_measured_fraction_drawn) {
    static const double x[] = {.02, .05, .09}, y[] = {.31, .77, 1.003};
    static const double fit_x[] = {0, .0641, .12}, fit_y[] = {0, .999, .999};
    static const double in[] = {.5673, 1.25};
    struct stage s;
    struct fault fault;
    set_up(&s);
    struct measurement *m = measured(&s, 0, 1, DROPS);
    const struct recipe *r = s.c->observable[DROPS].recipe;
    for (size_t i = 0; i < RECIPE_MAX_OUTPUTS; i++)
        m->value[i] = NAN;
    set_output(m, r, "q_mf_up", .0641);
    set_output(m, r, "solid_fraction", in[0]);
    add_curve(m, "up", "up", x, y, 3);
    add_curve(m, "fit", "down", x, y, 3);
    add_curve(m, "fit", "up", fit_x, fit_y, 3);
    unit_ok(build(&s, s.c, DROP, &fault), &fault);
    const struct report_panel *p = s.out->figure[0].panel;
    double q = prediction_find("minimum-fluidization-published")->at(in);
    ck_assert_uint_eq(p->series_count, 5); /* points, fit up, fit down, expected, break */
    ck_assert_double_eq(p->series[1].x[1], .0641);
    ck_assert_double_eq(p->series[3].x[1], q);
    ck_assert_double_eq(p->series[3].y[1], 1);
    says(p->series[4].label, "break: 0.0641");
    ck_assert_double_eq(p->series[4].x[0], .0641);
    char ratio[32];
    snprintf(ratio, sizeof ratio, "%.4f", .0641 / q);
    ck_assert_str_eq(s.out->table[0].cell[6], ratio);
    ck_assert_str_eq(s.out->table[0].cell[2], "-"); /* no way down */
    tear_down(&s);
}
END_TEST

START_TEST(two_laws_are_two_figures) {
    struct stage s;
    struct fault fault;
    set_up(&s);
    s.m->point_count = 3; /* as many as can be told apart */
    ck_assert_int_eq(build(&s, s.c, TWO_LAWS, &fault), STATUS_BAD_INPUT);
    unit_says(&fault, "one figure shows one Darcy law");
    s.m->point_count = 4;
    ck_assert_int_eq(build(&s, s.c, TWO_LAWS, &fault), STATUS_BAD_INPUT);
    unit_says(&fault, "4 points cannot be told apart");
    tear_down(&s);
}
END_TEST

/* -- settling --------------------------------------------------------------- */

START_TEST(settling_speeds_are_drawn_over_their_own_law) {
    static const double rho[] = {.4137, .4273}, speed[] = {.351, .377};
    struct stage s;
    struct fault fault;
    set_up(&s);
    const struct recipe *r = s.c->observable[FALL].recipe;
    for (size_t p = 0; p < 4; p++)
        for (size_t seed = 0; seed < 2; seed++)
            for (size_t i = 0; i < RECIPE_MAX_OUTPUTS; i++)
                measured(&s, p, seed, FALL)->value[i] = NAN;
    for (size_t seed = 0; seed < 2; seed++) { /* corrected, the first flux */
        set_output(measured(&s, 2, seed, FALL), r, "solid_fraction", rho[seed]);
        set_output(measured(&s, 2, seed, FALL), r, "speed", speed[seed]);
    }
    unit_ok(build(&s, s.c, SETTLING, &fault), &fault);
    const struct report_panel *p = s.out->figure[0].panel;
    const struct prediction *own = prediction_find("settling-own-law-corrected");
    double factor = 0;
    for (size_t seed = 0; seed < 2; seed++)
        factor += speed[seed] / own->at((const double[]){rho[seed], .25}) / 2;
    ck_assert_uint_eq(p[0].series[0].count, 1);
    ck_assert_double_eq_tol(p[0].series[0].x[0], .4205, 1e-12);
    ck_assert_double_eq_tol(p[0].series[0].y[0], .364, 1e-12);
    ck_assert_double_eq_tol(p[1].series[0].y[0], factor, 1e-12);
    ck_assert_uint_eq(s.out->table[0].rows, 1);
    ck_assert_str_eq(s.out->table[0].cell[0], "corrected");
    tear_down(&s);
}
END_TEST

START_TEST(a_table_shows_every_output_that_some_point_has) {
    static const double speed[] = {.351, .377};
    struct stage s;
    struct fault fault;
    set_up(&s);
    const struct recipe *r = s.c->observable[FALL].recipe;
    for (size_t p = 0; p < 4; p++)
        for (size_t seed = 0; seed < 2; seed++)
            for (size_t i = 0; i < RECIPE_MAX_OUTPUTS; i++)
                measured(&s, p, seed, FALL)->value[i] = NAN;
    ck_assert_int_eq(build(&s, s.c, OUTPUTS, &fault), STATUS_BAD_INPUT);
    unit_says(&fault, "fall gives nothing at any point");
    for (size_t seed = 0; seed < 2; seed++)
        set_output(measured(&s, 3, seed, FALL), r, "speed", speed[seed]);
    unit_ok(build(&s, s.c, OUTPUTS, &fault), &fault);
    const struct report_table *t = &s.out->table[0];
    ck_assert_uint_eq(t->rows, 1);
    ck_assert_uint_eq(t->columns, 3);
    ck_assert_str_eq(t->heading[1], "flux 0.13 l/tau");
    ck_assert_str_eq(t->cell[0], "speed (U0)");
    ck_assert_str_eq(t->cell[1], "-");
    ck_assert_str_eq(t->cell[2], "0.364 ± 0.013");
    tear_down(&s);
}
END_TEST

START_TEST(a_snapshot_is_shaded_by_the_solid_fraction_at_each_grain) {
    struct stage s;
    struct fault fault;
    set_up(&s);
    unit_ok(build(&s, s.c, SNAPSHOT, &fault), &fault);
    const struct report_picture *p = &s.out->picture[0];
    ck_assert_uint_eq(p->count, GRAINS);
    ck_assert_double_eq_tol(p->x[3], .37 + .613 * 6 + .1, 1e-12); /* the last frame, 1 tau */
    for (int i = 0; i < GRAINS; i++)
        ck_assert_double_eq_tol(p->shade[i] * .6, .33, 1e-12);
    says(p->caption, s.m->point[2].run[0].run->name);
    tear_down(&s);
}
END_TEST

/* -- bubbles ---------------------------------------------------------------- */

START_TEST(bubbles_their_fit_and_the_plane_bubbles_share_an_axis) {
    static const struct recipe recipe = {
        .name = "bubbles", .output = {{"rise_offset", "U0", ""}, {"rise_coefficient", "1", ""}}};
    static const double x[] = {1.37, 2.11, 1.81}, y[] = {.91, 1.13, 1.07};
    struct stage s;
    struct fault fault;
    set_up(&s);
    ck_assert_int_eq(build(&s, s.c, RISE, &fault), STATUS_BAD_INPUT);
    unit_says(&fault, "draws an observable of the recipe bubbles, not pressure-drop");
    struct case_observable observable[OBSERVABLES] = {{0}};
    struct case_file file = *s.c;
    observable[DROPS].recipe = &recipe;
    file.observable = observable;
    ck_assert_int_eq(build(&s, &file, RISE, &fault), STATUS_BAD_INPUT);
    unit_says(&fault, "no run has a bubble that rises");
    for (size_t seed = 0; seed < 2; seed++) {
        struct measurement *m = measured(&s, 3, seed, DROPS);
        add_curve(m, "rise", "inside", x, y, 3);
        add_curve(m, "rise", "at a side wall", y, x, 3);
        m->value[0] = .2 + .1 * (double)seed;
        m->value[1] = .43;
    }
    unit_ok(build(&s, &file, RISE, &fault), &fault);
    const struct report_panel *p = s.out->figure[0].panel;
    ck_assert_uint_eq(p->series_count, 5);
    ck_assert_uint_eq(p->series[0].count, 6);
    ck_assert_str_eq(p->series[0].label, "flux 0.27 l/tau");
    ck_assert_str_eq(p->series[1].label, "at a side wall");
    ck_assert_int_eq(p->series[1].colour, -1);
    ck_assert_double_eq_tol(p->series[2].y[1], .25 + .43 * 2.11, 1e-12);
    ck_assert_str_eq(p->series[2].label, "u = 0.25 + 0.43 x");
    const double in[] = {2.11, 90};
    ck_assert_double_eq(p->series[3].y[1], prediction_find("plane-bubble-rise")->at(in));
    tear_down(&s);
}
END_TEST

START_TEST(names_of_parameters_become_quantities) {
    struct arena a = {NULL};
    ck_assert_str_eq(figure_axis_text("flux_l_per_tau", &a), "flux (l/tau)");
    ck_assert_str_eq(figure_axis_text("height_l", &a), "height (l)");
    ck_assert_str_eq(figure_axis_text("_l", &a), " l");
    ck_assert_str_eq(figure_axis_text("restitution", &a), "restitution");
    ck_assert_str_eq(figure_value_text("flux_on_tau", "3.7", &a), "flux on 3.7 tau");
    ck_assert_str_eq(figure_value_text("darcy", "corrected", &a), "darcy corrected");
    arena_free(&a);
}
END_TEST

int main(void) {
    const TTest *const tests[] = {the_first_usable_run_is_shown_at_the_times_asked_for,
                                  a_time_without_a_frame_is_a_fault,
                                  without_times_six_are_spread_over_the_run,
                                  an_animation_thins_its_frames_evenly,
                                  no_usable_run_is_said,
                                  seeds_of_the_same_times_are_averaged_others_drawn_one_by_one,
                                  the_break_is_marked_and_the_law_at_the_measured_fraction_drawn,
                                  two_laws_are_two_figures,
                                  bubbles_their_fit_and_the_plane_bubbles_share_an_axis,
                                  settling_speeds_are_drawn_over_their_own_law,
                                  a_table_shows_every_output_that_some_point_has,
                                  a_snapshot_is_shaded_by_the_solid_fraction_at_each_grain,
                                  names_of_parameters_become_quantities,
                                  NULL};
    return unit_run("figure_recipes", tests);
}
