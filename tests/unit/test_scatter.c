/* test_scatter.c -- validation/scatter.h: what each seed gave, of values, differences and fits. */
#include "common/random.h"
#include "tests/unit/case_stage.h"
#include "validation/scatter.h"

#include <gsl/gsl_randist.h>
#include <gsl/gsl_statistics_double.h>
#include <math.h>

enum { SEEDS = 40 };

static const char text[] =
    "name: fake/case\ntitle: t\nsource: s\nquestion: q\nmodel: fake\nexpect_s: 2\n"
    "sweep: {step: [0.1, 0.2, 0.4]}\nsamples: [1]\nseeds: {first: 11, count: 40}\n"
    "observables: {bed: {recipe: contacts}}\n"
    "across: {fit: {fit: order, of: bed.sweeps_max, along: step},\n"
    "         exact: {fit: order, of: bed.sweeps_max, along: step, exact: true}}\n"
    "checks:\n"
    "  - {name: value, observable: bed.largest_overlap, expect: 1.37, margin: 3 %, kind: model,\n"
    "     because: b, points: {step: 0.2}}\n"
    "  - {name: to the bit, observable: bed.largest_overlap, expect: 1.37, margin: 3 %,\n"
    "     kind: round-off, because: b}\n"
    "  - {name: without, observable: bed.largest_overlap, expect: 1.37, margin: 3 %, scatter: 0,\n"
    "     kind: model, because: b}\n"
    "  - {name: along, observable: bed.largest_overlap, margin: 3 %, kind: model, because: b,\n"
    "     expect: {along: bed.solid_fraction_max, values: {0: 1, 1: 2}}, points: {step: 0.4}}\n"
    "  - {name: order, observable: fit.order, expect: 2, margin: 0.05, kind: order, because: b}\n"
    "  - {name: exactly, observable: exact.order, expect: 2, margin: 0.05, kind: order,\n"
    "     because: b}\n"
    "tiers: {smoke: {}}\n";
enum { VALUE, TO_THE_BIT, WITHOUT, ALONG, ORDER, EXACTLY, CHECKS };

struct stage {
    struct case_file *file;
    struct plan *plan;
    struct measured_case *m;
    struct arena arena;
    const char *folder;
    struct scatter *list;
    size_t count;
};

/* Overlaps scatter by 1 %, the expectation along with them; sweeps go as step^2, by 3 %. */
static void fill(struct stage *s, struct measured_run *r, double step, gsl_rng *stream) {
    double noise = gsl_ran_gaussian(stream, 0.0137);
    r->observable = arena_take(&s->m->arena, 1, sizeof *r->observable);
    r->sample = arena_take(&s->m->arena, CHECKS, sizeof *r->sample);
    ck_assert(r->observable != NULL && r->sample != NULL);
    const struct recipe *recipe = recipe_find("contacts");
    for (size_t i = 0; recipe->output[i].name != NULL; i++) {
        bool sweeps = strcmp(recipe->output[i].name, "sweeps_max") == 0;
        r->observable[0].value[i] =
            sweeps ? 7 * step * step * (1 + gsl_ran_gaussian(stream, 0.03)) : 1.37 + noise;
    }
    for (size_t i = 0; i < CHECKS; i++)
        r->sample[i] = (struct measured_sample){.measured = 1.37 + noise, .expected = 1.37};
    r->sample[ALONG].expected = 1.36 + noise;
    r->sample[ORDER] = r->sample[EXACTLY] =
        (struct measured_sample){.measured = NAN, .expected = 2};
}

static void set_up(struct stage *s) {
    struct fault fault;
    gsl_rng *stream;
    *s = (struct stage){.folder = unit_folder()};
    s->file = stage_case(s->folder, "fake/case", text, &fault);
    unit_ok(fault.status, &fault);
    s->plan = stage_plan(s->file, TIER_SMOKE);
    s->m = stage_runs(s->plan);
    unit_ok(random_stream(23, "test", &stream, &fault), &fault);
    for (size_t p = 0; p < s->m->point_count; p++)
        for (size_t i = 0; i < s->m->point[p].run_count; i++)
            fill(s, &s->m->point[p].run[i], measured_parameter(&s->m->point[p], "step"), stream);
    gsl_rng_free(stream);
}

static void look(struct stage *s) {
    struct fault fault = FAULT_NONE;
    unit_ok(scatter_measure(s->m, &s->arena, &s->list, &s->count, &fault), &fault);
}

static void tear_down(struct stage *s) {
    measured_case_free(s->m);
    plan_free(s->plan);
    case_free(s->file);
    arena_free(&s->arena);
    unit_remove(s->folder);
}

START_TEST(only_rows_that_chance_decides_are_measured) {
    struct stage s;
    set_up(&s);
    look(&s);
    ck_assert_uint_eq(s.count, 3);
    ck_assert_str_eq(s.list[0].check->name, "value");
    ck_assert_str_eq(s.list[0].key.point, "step=0.2");
    ck_assert_str_eq(s.list[1].check->name, "along");
    ck_assert_str_eq(s.list[2].check->name, "order");
    ck_assert_str_eq(s.list[2].key.point, "-");
    tear_down(&s);
}
END_TEST

START_TEST(values_and_differences_seed_by_seed) {
    struct stage s;
    double value[SEEDS];
    set_up(&s);
    look(&s);
    for (size_t i = 0; i < SEEDS; i++) {
        value[i] = s.m->point[1].run[i].sample[VALUE].measured;
        ck_assert_double_eq(s.list[0].value[i], value[i]);
        ck_assert_int_eq((int)s.list[0].seed[i], 11 + (int)i);
        ck_assert_double_eq_tol(s.list[1].value[i], 0.01, 1e-12); /* the noise is in both */
        ck_assert_double_eq(s.list[1].expected[i], 0);
    }
    ck_assert_double_eq_tol(s.list[0].mean, gsl_stats_mean(value, 1, SEEDS), 1e-15);
    ck_assert_double_eq_tol(s.list[0].deviation, gsl_stats_sd(value, 1, SEEDS), 1e-15);
    ck_assert(s.list[0].deviation > 0.009 && s.list[0].deviation < 0.019);
    ck_assert(s.list[1].key.difference && !s.list[0].key.difference);
    tear_down(&s);
}
END_TEST

/* ln y = ln 7 + p ln x: p of one seed scatters by 0.03 / (sqrt(2) ln 2). */
START_TEST(pseudo_values_of_a_fit_scatter_as_single_seeds_would) {
    struct stage s;
    set_up(&s);
    look(&s);
    const struct scatter *fit = &s.list[2];
    ck_assert_ptr_null(fit->missing);
    double single = 0.03 / (sqrt(2) * log(2));
    ck_assert(fit->deviation > 0.7 * single && fit->deviation < 1.4 * single);
    ck_assert(fabs(fit->mean - 2) < 4 * single / sqrt(SEEDS));
    ck_assert_double_eq(fit->expected[0], 2);
    tear_down(&s);
}
END_TEST

START_TEST(what_is_missing_or_the_same_gives_no_ensemble) {
    struct stage s;
    set_up(&s);
    s.m->point[1].run[17].usable = false;
    s.m->point[1].run[17].failure = "crashed: signal 11";
    for (size_t i = 0; i < SEEDS; i++)
        s.m->point[2].run[i].sample[ALONG].measured = s.m->point[2].run[i].sample[ALONG].expected;
    look(&s);
    ck_assert_str_eq(s.list[0].missing, "crashed: signal 11");
    ck_assert(isnan(s.list[0].mean) && isnan(s.list[0].deviation));
    ck_assert_ptr_nonnull(strstr(s.list[1].missing, "agree to the last bit"));
    ck_assert_ptr_nonnull(s.list[2].missing); /* the fit needs that run, too */
    tear_down(&s);
}
END_TEST

START_TEST(a_fit_of_unequal_seeds_gives_no_ensemble) {
    struct stage s;
    set_up(&s);
    s.m->point[2].run_count = SEEDS - 1;
    look(&s);
    ck_assert_ptr_nonnull(strstr(s.list[2].missing, "different numbers of seeds"));
    tear_down(&s);
}
END_TEST

int main(void) {
    const TTest *tests[] = {only_rows_that_chance_decides_are_measured,
                            values_and_differences_seed_by_seed,
                            pseudo_values_of_a_fit_scatter_as_single_seeds_would,
                            what_is_missing_or_the_same_gives_no_ensemble,
                            a_fit_of_unequal_seeds_gives_no_ensemble,
                            NULL};
    return unit_run("scatter", tests);
}
