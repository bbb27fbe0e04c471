/* test_case_parameters.c -- readings and labelled axes, from the case file to the run file. */
#include "tests/unit/unit.h"
#include "validation/plan.h"

#include <sys/stat.h>

static const char head[] = "title: t\nsource: s\nquestion: q\nmodel: fake\nexpect_s: 2\n"
                           "samples: [0, 1]\nseeds: {first: 7, count: 2}\n"
                           "observables: {bed: {recipe: contacts}}\n";
static const char checks[] = "checks: [{name: c, observable: bed.sweeps_max, expect: 1, margin: 1, "
                             "kind: model, because: b}]\n";
static const char readings[] =
    "model: fake\nreadings:\n"
    "  literal: {title: t, because: b, parameters: {scale: 1, width_R: 16}}\n"
    "  fitted: {title: t, because: b, parameters: {scale: 0.284, width_R: 30, noise: fixed}}\n";

struct bench {
    struct case_file *c;
    struct plan *plan;
};

/* The case of `rest` (its checks included) and the plan of its tier; NULLs on a fault. */
static struct bench set_up(const char *rest, enum tier tier, struct fault *fault) {
    struct bench b = {0};
    char text[4096];
    const char *folder = unit_folder();
    ck_assert_int_eq(mkdir(unit_path(folder, "fake"), 0755), 0);
    ck_assert_int_eq(mkdir(unit_path(folder, "readings"), 0755), 0);
    unit_write(unit_path(folder, "readings/fake.yaml"), readings);
    snprintf(text, sizeof text, "name: fake/case\n%s%s", head, rest);
    unit_write(unit_path(folder, "fake/case.yaml"), text);
    *fault = FAULT_NONE;
    if (case_load(folder, "fake/case", &b.c, fault) == STATUS_OK) {
        struct plan_order order = {.file = b.c};
        const struct case_file *const all[] = {b.c};
        plan_make(&order, 1, all, 1, tier, 0, &b.plan, fault);
    }
    unit_remove(folder);
    return b;
}

static struct bench set_up_good(const char *rest, enum tier tier) {
    struct fault fault;
    struct bench b = set_up(rest, tier, &fault);
    unit_ok(fault.status, &fault);
    return b;
}

static void tear_down(struct bench *b) {
    plan_free(b->plan);
    case_free(b->c);
}

static const struct plan_point *point(const struct bench *b, size_t index) {
    return &b->plan->cases[0].point[index];
}

/* A parameter of a point as text; "-" where it has none. */
static const char *value(const struct plan_point *p, const char *name) {
    const struct yaml_node *n = case_parameter_find(p->parameter, p->parameter_count, name);
    return n == NULL ? "-" : n->text;
}

static void has_line(const struct plan_run *run, const char *line) {
    ck_assert_msg(strstr(run->text, line) != NULL, "no '%s' in\n%s", line, run->text);
}

/* -- readings --------------------------------------------------------------------- */

START_TEST(a_reading_sets_what_nothing_else_sets) {
    char rest[1024];
    snprintf(rest, sizeof rest,
             "parameters: {reading: fitted, grains: 137}\nsweep: {width_R: [12, 13.7]}\n%s"
             "tiers: {smoke: {}, paper: {parameters: {scale: 0.37}}}\n",
             checks);
    struct bench b = set_up_good(rest, TIER_SMOKE);
    ck_assert_str_eq(point(&b, 1)->name, "reading=fitted,width_R=13.7");
    ck_assert_str_eq(value(point(&b, 1), "scale"), "0.284");
    ck_assert_str_eq(value(point(&b, 1), "width_R"), "13.7"); /* swept: the case's own */
    ck_assert_ptr_null(strstr(b.plan->run[0]->text, "width_R: 30"));
    has_line(b.plan->run[0], "  noise: fixed    # ");
    has_line(b.plan->run[0], "readings/fake.yaml:4, reading fitted\n");
    has_line(b.plan->run[0], "  grains: 137    # ");
    ck_assert_ptr_null(strstr(b.plan->run[0]->text, "  reading:"));
    ck_assert_ptr_null(strstr(b.plan->run[0]->meaning, "#"));
    tear_down(&b);
    b = set_up_good(rest, TIER_PAPER);
    ck_assert_str_eq(value(point(&b, 0), "scale"), "0.37"); /* the tier's own */
    ck_assert_str_eq(value(point(&b, 0), "noise"), "fixed");
    tear_down(&b);
}
END_TEST

START_TEST(a_swept_reading_makes_points_of_their_own) {
    char rest[1024];
    snprintf(rest, sizeof rest,
             "parameters: {grains: 137}\nsweep: {reading: [literal, fitted]}\n"
             "checks: [{name: c, observable: bed.sweeps_max, points: {reading: fitted, scale: "
             "0.2840}, expect: {by: noise, values: {fixed: 1}}, margin: 1, kind: model, because: "
             "b}]\n"
             "tiers: {smoke: {}, paper: {parameters: {reading: literal}, checks: {c: {points: "
             "{scale: 1}, expect: 2}}}}\n");
    struct bench b = set_up_good(rest, TIER_SMOKE);
    ck_assert_uint_eq(b.plan->cases[0].point_count, 2);
    ck_assert_str_eq(point(&b, 0)->name, "reading=literal");
    ck_assert_str_eq(value(point(&b, 0), "noise"), "-");
    ck_assert_str_eq(value(point(&b, 1), "noise"), "fixed");
    ck_assert_str_ne(point(&b, 0)->run[0]->id, point(&b, 1)->run[0]->id);
    tear_down(&b);
    b = set_up_good(rest, TIER_PAPER);
    ck_assert_uint_eq(b.plan->cases[0].point_count, 1);
    ck_assert_str_eq(point(&b, 0)->name, "reading=literal");
    tear_down(&b);
}
END_TEST

START_TEST(a_reading_is_nothing_but_its_parameters) {
    char rest[1024];
    snprintf(rest, sizeof rest, "parameters: {reading: literal}\n%stiers: {smoke: {}}\n", checks);
    struct bench named = set_up_good(rest, TIER_SMOKE);
    snprintf(rest, sizeof rest, "parameters: {scale: 1, width_R: 16}\n%stiers: {smoke: {}}\n",
             checks);
    struct bench plain = set_up_good(rest, TIER_SMOKE);
    ck_assert_str_eq(named.plan->run[0]->id, plain.plan->run[0]->id);
    ck_assert_str_eq(point(&plain, 0)->name, "single");
    tear_down(&named);
    tear_down(&plain);
}
END_TEST

/* A run of `own` reading that starts from one of `first`; `point`: what `start` says. */
static void start_from(const char *first, const char *own, const char *point, struct fault *fault) {
    struct case_file *c[2] = {NULL, NULL};
    struct plan *plan = NULL;
    static const char *const name[2] = {"fake/heir", "fake/first"};
    const char *folder = unit_folder();
    ck_assert_int_eq(mkdir(unit_path(folder, "fake"), 0755), 0);
    ck_assert_int_eq(mkdir(unit_path(folder, "readings"), 0755), 0);
    unit_write(unit_path(folder, "readings/fake.yaml"), readings);
    for (size_t i = 0; i < 2; i++) {
        char text[2048];
        snprintf(text, sizeof text,
                 "name: %s\n%sparameters: {grains: 137, %s}\n%s%s%stiers: {smoke: {}}\n", name[i],
                 head, i == 0 ? own : first, checks, i == 0 ? "start: {case: fake/first" : "",
                 i == 0 ? point : "");
        unit_write(unit_path(folder, i == 0 ? "fake/heir.yaml" : "fake/first.yaml"), text);
        unit_ok(case_load(folder, name[i], &c[i], fault), fault);
    }
    struct plan_order order = {.file = c[0]};
    const struct case_file *const all[] = {c[0], c[1]};
    plan_make(&order, 1, all, 2, TIER_SMOKE, 0, &plan, fault);
    plan_free(plan);
    case_free(c[0]);
    case_free(c[1]);
    unit_remove(folder);
}

START_TEST(a_start_of_another_reading_must_be_said) {
    struct fault fault = FAULT_NONE;
    start_from("reading: fitted", "reading: fitted", "}\n", &fault);
    unit_ok(fault.status, &fault);
    start_from("reading: fitted", "scale: 1", "}\n", &fault); /* of no reading itself */
    unit_ok(fault.status, &fault);
    start_from("reading: fitted", "reading: literal", ", point: {reading: fitted}}\n", &fault);
    unit_ok(fault.status, &fault);
    start_from("reading: fitted", "reading: literal", "}\n", &fault);
    unit_says(&fault, "no point of fake/first in tier smoke is meant by reading=literal");
    fault = FAULT_NONE;
    start_from("reading: fitted", "scale: 1", ", point: {reading: same}}\n", &fault);
    unit_says(&fault, "reading: same, but single has no one value of it");
}
END_TEST

/* -- labels ----------------------------------------------------------------------- */

static const char steps[] =
    "parameters: {grains: 137, noise: none}\n"
    "sweep: {step: {0.35 to 0.30: {phibar: 0.35, to: [0.3]}, "
    "0.40 to 0.35: {phibar: 0.4, to: [0.35], noise: strong}}, rest: [0.7, 0.9]}\n"
    "across: {trend: {fit: ends, of: bed.largest_overlap, along: phibar}}\n"
    "checks:\n"
    "  - {name: c, observable: bed.sweeps_max, points: {step: 0.35 to 0.30}, expect: {by: rest, "
    "values: {0.7: 1, 0.9: 2}}, margin: 1, kind: model, because: b}\n"
    "  - {name: by step, observable: bed.sweeps_max, expect: {by: step, values: {0.35 to 0.30: 1, "
    "0.40 to 0.35: 2}}, margin: 1, kind: model, because: b}\n"
    "  - {name: trend, observable: trend.ratio, expect: 1, margin: 1, kind: model, because: b, "
    "tiers: [smoke]}\n"
    "tiers:\n"
    "  smoke: {}\n"
    "  paper: {sweep: {step: [0.35 to 0.30]}, parameters: {rest: 0.8}, "
    "checks: {c: {expect: 1}}}\n"
    "  large: {parameters: {step: 0.40 to 0.35}, checks: {c: off}}\n";

START_TEST(a_label_stands_for_its_parameters) {
    struct bench b = set_up_good(steps, TIER_SMOKE);
    ck_assert_uint_eq(b.plan->cases[0].point_count, 4);
    ck_assert_str_eq(point(&b, 1)->name, "step=0.35 to 0.30,rest=0.9");
    ck_assert_str_eq(value(point(&b, 1), "phibar"), "0.35");
    ck_assert_str_eq(value(point(&b, 1), "noise"), "none");
    ck_assert_str_eq(value(point(&b, 2), "noise"), "strong"); /* in place of the case's */
    const struct plan_run *run = point(&b, 2)->run[0];
    has_line(run, "point: \"step=0.40 to 0.35,rest=0.7\"\n");
    has_line(run, "  to: [0.35]    # ");
    has_line(run, "  noise: strong    # ");
    ck_assert_ptr_null(strstr(run->text, "noise: none"));
    ck_assert_ptr_null(strstr(run->text, "  step:"));
    tear_down(&b);
}
END_TEST

START_TEST(a_tier_chooses_labels_or_fixes_one) {
    struct bench b = set_up_good(steps, TIER_PAPER);
    ck_assert_uint_eq(b.plan->cases[0].point_count, 1);
    ck_assert_str_eq(point(&b, 0)->name, "step=0.35 to 0.30");
    ck_assert_str_eq(value(point(&b, 0), "phibar"), "0.35");
    tear_down(&b);
    b = set_up_good(steps, TIER_LARGE);
    ck_assert_uint_eq(b.plan->cases[0].point_count, 2);
    ck_assert_str_eq(point(&b, 0)->name, "rest=0.7");
    ck_assert_str_eq(value(point(&b, 0), "phibar"), "0.4");
    ck_assert_str_eq(value(point(&b, 0), "step"), "0.40 to 0.35");
    ck_assert_ptr_null(strstr(b.plan->run[0]->text, "  step:"));
    tear_down(&b);
}
END_TEST

START_TEST(a_tier_may_have_labels_of_its_own) {
    char rest[1024];
    snprintf(rest, sizeof rest,
             "parameters: {grains: 137, phibar: 0.3}\n"
             "sweep: {step: {small: {kick: 1}, nothing more: {}}}\n%s"
             "tiers: {smoke: {sweep: {step: {far: {phibar: 0.55, reading: fitted}}}}}\n",
             checks);
    struct bench b = set_up_good(rest, TIER_SMOKE);
    ck_assert_uint_eq(b.plan->cases[0].point_count, 1);
    ck_assert_str_eq(point(&b, 0)->name, "reading=fitted,step=far");
    ck_assert_str_eq(value(point(&b, 0), "phibar"), "0.55");
    ck_assert_str_eq(value(point(&b, 0), "scale"), "0.284");
    tear_down(&b);
}
END_TEST

/* -- faults ----------------------------------------------------------------------- */

static const struct {
    const char *rest, *says;
} bad[] = {
    {"parameters: {reading: fited}\n", "fited: no such reading; did you mean fitted?"},
    {"parameters: {reading: [fitted]}\n", "no such reading"},
    {"sweep: {reading: [literal, fittest]}\n", "fittest: no such reading; did you mean fitted?"},
    {"sweep: {reading: {literal: {}}}\n", "reading: a list of readings; they stand in"},
    {"sweep: {step: {a: {reading: litteral}}}\n", "did you mean literal?"},
    {"sweep: {step: {a: 3}}\n", "a: a label is a map of parameters"},
    {"sweep: {step: {}}\n", "a list of values or a map of labels"},
    {"sweep: {step: {'a=b': {x: 1}}}\n", "'a=b' is no label"},
    {"sweep: {step: {' a': {x: 1}}}\n", "' a' is no label"},
    {"sweep: {step: {0.3: {x: 1}, 0.30: {x: 2}}}\n", "0.30: the same label as 0.3"},
    {"sweep: {step: {a: {x: {y: 1}}}}\n", "x: must be a value or a list of values"},
    {"sweep: {step: {a: {step: 1}}}\n", "step: is the name of the axis itself"},
    {"sweep: {step: {a: {x: 1}, b: {}}, x: [1, 2]}\n", "x: is swept, and set by a label of step"},
    {"sweep: {step: {a: {x: 1}}, other: {b: {x: 2}}}\n",
     "x: is set by labels of step and of other"},
    {"parameters: {x: 3}\nsweep: {step: {a: {x: 1}, b: {x: 2}}}\n", "every label of step sets it"},
    {"sweep: {step: [a b]}\n", "not a value that can be swept"},
};

START_TEST(every_fault_is_told) {
    char rest[1024];
    struct fault fault;
    snprintf(rest, sizeof rest, "%s%stiers: {smoke: {}}\n", bad[_i].rest, checks);
    struct bench b = set_up(rest, TIER_SMOKE, &fault);
    ck_assert_ptr_null(b.c);
    unit_says(&fault, bad[_i].says);
}
END_TEST

static const struct {
    const char *tier, *says;
} bad_tier[] = {
    {"sweep: {step: [low, hihg]}", "hihg: no such label of this axis; did you mean high?"},
    {"parameters: {step: lo}", "lo: no such label of this axis; did you mean low?"},
    {"parameters: {step: low}, sweep: {z: [1, 2]}", "z: is swept, and set by a label of step"},
    {"parameters: {phibar: 0.3}", "phibar: every label of step sets it"},
    {"sweep: {rest: {a: {y: 1}}}", "rest: has values in the case and labels in the tier"},
    {"sweep: {step: [low, low]}", "step: low stands twice in the sweep"},
};

START_TEST(every_fault_of_a_tier_is_told) {
    char rest[1024];
    struct fault fault;
    snprintf(rest, sizeof rest,
             "sweep: {step: {low: {phibar: 0.3, z: 2}, high: {phibar: 0.4}}, rest: [1, 2]}\n"
             "%stiers: {smoke: {%s}}\n",
             checks, bad_tier[_i].tier);
    struct bench b = set_up(rest, TIER_SMOKE, &fault);
    ck_assert_ptr_null(b.c);
    unit_says(&fault, bad_tier[_i].says);
}
END_TEST

static const struct {
    const char *from, *to, *says;
} bad_use[] = {
    {"along: phibar", "along: noise", "along: noise is not swept in every tier"},
    {"along: phibar", "along: step", "'0.35 to 0.30' is not a number"},
    {"points: {step: 0.35 to 0.30}", "points: {step: 0.35 to 0.31}",
     "check c: applies to no point of tier smoke"},
    {"values: {0.35 to 0.30: 1, ", "values: {", "no entry for step = 0.35 to 0.30"},
    {"observable: trend.ratio, ", "observable: trend.ratio, points: {step: 0.35 to 0.30}, ",
     "step is what the fit goes along"},
    {"observable: trend.ratio, expect: 1",
     "observable: trend.ratio, expect: {by: step, values: {0.35 to 0.30: 1, 0.40 to 0.35: 2}}",
     "one fit along step has one expectation"},
};

START_TEST(labels_are_used_as_values_are) {
    char rest[4096];
    struct fault fault;
    const char *at = strstr(steps, bad_use[_i].from);
    ck_assert_ptr_nonnull(at);
    snprintf(rest, sizeof rest, "%.*s%s%s", (int)(at - steps), steps, bad_use[_i].to,
             at + strlen(bad_use[_i].from));
    struct bench b = set_up(rest, TIER_SMOKE, &fault);
    ck_assert_ptr_null(b.c);
    unit_says(&fault, bad_use[_i].says);
}
END_TEST

/* -- inputs of predictions ---------------------------------------------------------- */

static const char inputs[] =
    "parameters: {particles: 137, phibar_values: %s}\n"
    "across: {ends: {fit: ends, of: bed.largest_overlap, along: values}}\n"
    "sweep: {step: {a: {values: [0.3]}, b: {values: [0.35]}}}\n"
    "checks:\n"
    "  - {name: c, observable: bed.sweeps_max, expect: {prediction: PREDICTION, %s: "
    "phibar_values}, margin: 1, kind: model, because: b}\n"
    "  - {name: e, observable: ends.ratio, expect: 1, margin: 1, kind: model, because: b}\n"
    "tiers: {smoke: {}}\n";

START_TEST(a_list_of_one_number_is_an_input) {
    static const struct {
        const char *value, *says;
    } list[] = {{"[0.31]", NULL},
                {"0.31", NULL},
                {"true", NULL},
                {"[0.31, 0.4]", "phibar_values: a list of 2, where one number is needed"},
                {"[]", "phibar_values: a list of 0"},
                {"[none]", "is not a number"},
                {"none", "is the parameter phibar_values, which is no number"}};
    size_t count;
    const struct prediction *p = prediction_all(&count)[0];
    for (size_t i = 0; i < sizeof list / sizeof *list; i++) {
        char rest[2048], name[2048];
        struct fault fault;
        snprintf(name, sizeof name, inputs, list[i].value, p->input[0]);
        char *at = strstr(name, "PREDICTION");
        snprintf(rest, sizeof rest, "%.*s%s%s", (int)(at - name), name, p->name,
                 at + strlen("PREDICTION"));
        struct bench b = set_up(rest, TIER_SMOKE, &fault);
        if (list[i].says == NULL)
            unit_ok(fault.status, &fault);
        else
            unit_says(&fault, list[i].says);
        tear_down(&b);
    }
}
END_TEST

START_TEST(a_model_without_readings_is_told_where_they_would_stand) {
    struct fault fault = FAULT_NONE;
    struct case_file *c;
    char text[2048];
    const char *folder = unit_folder();
    ck_assert_int_eq(mkdir(unit_path(folder, "fake"), 0755), 0);
    snprintf(text, sizeof text,
             "name: fake/case\n%sparameters: {reading: a}\n%stiers: {smoke: {}}\n", head, checks);
    unit_write(unit_path(folder, "fake/case.yaml"), text);
    ck_assert_int_eq(case_load(folder, "fake/case", &c, &fault), STATUS_BAD_INPUT);
    unit_says(&fault, "reading: fake has none: there is no /tmp/");
    unit_remove(folder);
}
END_TEST

int main(void) {
    Suite *suite = suite_create("case_parameters");
    TCase *group = tcase_create("case_parameters");
    tcase_add_test(group, a_reading_sets_what_nothing_else_sets);
    tcase_add_test(group, a_swept_reading_makes_points_of_their_own);
    tcase_add_test(group, a_reading_is_nothing_but_its_parameters);
    tcase_add_test(group, a_start_of_another_reading_must_be_said);
    tcase_add_test(group, a_label_stands_for_its_parameters);
    tcase_add_test(group, a_tier_chooses_labels_or_fixes_one);
    tcase_add_test(group, a_tier_may_have_labels_of_its_own);
    tcase_add_loop_test(group, every_fault_is_told, 0, sizeof bad / sizeof *bad);
    tcase_add_loop_test(group, every_fault_of_a_tier_is_told, 0,
                        sizeof bad_tier / sizeof *bad_tier);
    tcase_add_loop_test(group, labels_are_used_as_values_are, 0, sizeof bad_use / sizeof *bad_use);
    tcase_add_test(group, a_list_of_one_number_is_an_input);
    tcase_add_test(group, a_model_without_readings_is_told_where_they_would_stand);
    suite_add_tcase(suite, group);
    return unit_finish(suite);
}
