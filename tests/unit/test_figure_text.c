/* test_figure_text.c -- validation/figures.h: points as a legend shows them. */
#include "tests/unit/case_stage.h"

static const char head[] =
    "name: fake/case\ntitle: t\nsource: s\nquestion: q\nmodel: fake\nexpect_s: 2\n"
    "samples: [0, 1]\nobservables: {bed: {recipe: contacts}}\n"
    "checks: [{name: c, observable: bed.sweeps_max, expect: 1, margin: 1, kind: model, "
    "because: b}]\ntiers: {smoke: {}}\n";
static const char readings[] = "model: fake\nreadings:\n"
                               "  literal: {title: t, because: b, parameters: {scale: 1}}\n"
                               "  fitted: {title: t, because: b, parameters: {scale: 0.284}}\n";

struct stage {
    struct case_file *c;
    struct plan *plan;
    struct measured_case *data;
    struct arena arena;
};

static void set_up(struct stage *s, const char *rest) {
    struct fault fault;
    char text[2048];
    const char *folder = unit_folder();
    *s = (struct stage){0};
    ck_assert_int_eq(mkdir(unit_path(folder, "readings"), 0755), 0);
    unit_write(unit_path(folder, "readings/fake.yaml"), readings);
    snprintf(text, sizeof text, "%s%s", head, rest);
    s->c = stage_case(folder, "fake/case", text, &fault);
    unit_ok(fault.status, &fault);
    s->plan = stage_plan(s->c, TIER_SMOKE);
    s->data = stage_runs(s->plan);
    unit_remove(folder);
}

static const char *text_of(struct stage *s, size_t point, const char *along) {
    return figure_point_text(s->data, &s->data->point[point], along, &s->arena);
}

static void tear_down(struct stage *s) {
    measured_case_free(s->data);
    plan_free(s->plan);
    case_free(s->c);
    arena_free(&s->arena);
}

START_TEST(a_reading_is_shown_also_where_it_is_the_only_one) {
    struct stage s;
    set_up(&s, "parameters: {reading: fitted}\nsweep: {phibar: [0.3, 0.35], rest: [0.7]}\n");
    ck_assert_str_eq(text_of(&s, 1, NULL), "reading fitted, phibar 0.35");
    ck_assert_str_eq(text_of(&s, 1, "phibar"), "reading fitted");
    tear_down(&s);
    set_up(&s, "sweep: {rest: [0.7], reading: [literal]}\n");
    ck_assert_str_eq(text_of(&s, 0, NULL), "reading literal");
    tear_down(&s);
    set_up(&s, "sweep: {rest: [0.7, 0.9], reading: [literal, fitted]}\n");
    ck_assert_str_eq(text_of(&s, 3, NULL), "reading fitted, rest 0.9");
    ck_assert_str_eq(text_of(&s, 3, "reading"), "rest 0.9");
    tear_down(&s);
}
END_TEST

START_TEST(a_reading_that_a_label_sets_is_shown_too) {
    struct stage s;
    set_up(&s, "sweep: {bed: {wide and flat: {reading: literal}, as fitted: {reading: fitted}}}\n");
    ck_assert_str_eq(text_of(&s, 0, NULL), "reading literal, bed wide and flat");
    tear_down(&s);
}
END_TEST

START_TEST(an_axis_is_left_out_with_what_its_labels_set) {
    struct stage s;
    set_up(&s, "sweep: {step: {0.35 to 0.30: {phibar: 0.35}, 0.40 to 0.35: {phibar: 0.4}}, "
               "rest: [0.7, 0.9]}\n");
    ck_assert_str_eq(text_of(&s, 2, NULL), "step 0.40 to 0.35, rest 0.7");
    ck_assert_str_eq(text_of(&s, 2, "phibar"), "rest 0.7");
    ck_assert_str_eq(text_of(&s, 2, "step"), "rest 0.7");
    tear_down(&s);
}
END_TEST

START_TEST(a_single_point_of_no_reading_needs_no_name) {
    struct stage s;
    set_up(&s, "parameters: {phibar: 0.3}\n");
    ck_assert_str_eq(text_of(&s, 0, NULL), "");
    tear_down(&s);
}
END_TEST

int main(void) {
    const TTest *const tests[] = {a_reading_is_shown_also_where_it_is_the_only_one,
                                  a_reading_that_a_label_sets_is_shown_too,
                                  an_axis_is_left_out_with_what_its_labels_set,
                                  a_single_point_of_no_reading_needs_no_name, NULL};
    return unit_run("figure text", tests);
}
