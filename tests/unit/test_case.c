/* test_case.c -- validation/case.h: a good case as it is read, and every way to spoil one. */
#include "tests/unit/case_stage.h"

#include <math.h>

static const char good[] =
    "name: fake/steady\n"
    "title: A title\n"
    "source: a paper\n"
    "question: does it?\n"
    "model: fake\n"
    "tags: [quick]\n"
    "parameters: {grains: 137, wall_l: 3.7, darcy: published}\n"
    "sweep: {height_l: [58, 64.5], start: [random, lattice]}\n"
    "samples: {from: 0, to: 0.3, every: 0.1}\n"
    "particle_samples: [0, 0.3]\n"
    "seeds: {first: 1101, count: [{points: {start: random}, count: 4}, {count: 2}]}\n"
    "expect_s: 2\n"
    "observables: {bed: {recipe: contacts}, fall: {recipe: settling, min_rows: 5}}\n"
    "across: {trend: {fit: zero, of: bed.sweeps_max, along: height_l}}\n"
    "checks:\n"
    "  - name: overlap\n"
    "    observable: bed.largest_overlap\n"
    "    expect: {by: height_l, values: {58: 0.02, 64.50: 0.031}}\n"
    "    margin: 3 %\n"
    "    kind: model\n"
    "    because: measured\n"
    "  - name: speed\n"
    "    observable: fall.speed\n"
    "    points: {start: random}\n"
    "    expect: {value: 1.2, uncertainty: 0.01}\n"
    "    comparison: at most\n"
    "    kind: model\n"
    "    because: measured\n"
    "  - name: trend\n"
    "    observable: trend.zero\n"
    "    expect: 2\n"
    "    margin: 0.3\n"
    "    kind: order\n"
    "    because: measured\n"
    "    tiers: [smoke]\n"
    "tiers:\n"
    "  smoke: {}\n"
    "  paper:\n"
    "    parameters: {grains: 18104, height_l: 58}\n"
    "    sweep: {darcy: [published, corrected]}\n"
    "    seeds: {count: 3}\n"
    "    limit_s: 77\n"
    "    checks: {overlap: {margin: 0.001, because: finer}, speed: off}\n";

/* `good` with one text replaced by another, loaded. */
static struct case_file *load(const char *from, const char *to, struct fault *fault) {
    return stage_spoiled("fake/steady", good, from, to, fault);
}

START_TEST(a_good_case_is_read_with_its_tiers) {
    struct fault fault;
    struct case_file *c = load("A title", "A title", &fault);
    ck_assert_msg(c != NULL, "%s", fault.text);
    const struct case_tier *smoke = &c->tier[TIER_SMOKE], *paper = &c->tier[TIER_PAPER];
    ck_assert_uint_eq(smoke->point_count, 4);
    ck_assert_uint_eq(smoke->samples.count, 4);
    ck_assert_double_eq(smoke->samples.time[3], 0.3); /* not 0.30000000000000004 */
    ck_assert_uint_eq(smoke->particle_samples.count, 2);
    ck_assert_double_eq(smoke->limit_s, 60); /* not 10 expect_s: a minute at least */
    ck_assert_uint_eq(smoke->check_count, 3);
    ck_assert_double_eq(c->observable[1].setting[0], 5);
    ck_assert(smoke->check[0].margin.percent);
    ck_assert_int_eq(smoke->check[1].comparison, COMPARE_AT_MOST);
    ck_assert(smoke->check[2].number.across);
    ck_assert(!c->tier[TIER_LARGE].present);
    ck_assert_uint_eq(paper->point_count, 4); /* start x darcy; height is fixed */
    ck_assert_uint_eq(paper->check_count, 1);
    ck_assert_str_eq(paper->check[0].because, "finer");
    ck_assert_double_eq(paper->check[0].margin.value, 0.001);
    ck_assert_double_eq(paper->limit_s, 77);
    ck_assert_int_eq((int)paper->seeds.first, 1101);
    case_free(c);
}
END_TEST

START_TEST(points_run_through_the_sweep_the_last_axis_fastest) {
    struct fault fault;
    struct case_file *c = load("A title", "A title", &fault);
    const struct case_tier *t = &c->tier[TIER_SMOKE];
    struct case_parameter p[8];
    case_point(t, 1, p);
    ck_assert_str_eq(case_parameter_find(p, 5, "height_l")->text, "58");
    ck_assert_str_eq(case_parameter_find(p, 5, "start")->text, "lattice");
    ck_assert_uint_eq(case_seed_count(&t->seeds, p, 5), 2);
    case_point(t, 2, p);
    ck_assert_str_eq(case_parameter_find(p, 5, "height_l")->text, "64.5");
    ck_assert_uint_eq(case_seed_count(&t->seeds, p, 5), 4);
    const struct case_expect *e = case_expect_find(&t->check[0].expect, p, 5);
    ck_assert_double_eq(e->value, 0.031);
    ck_assert_ptr_null(case_parameter_find(p, 5, "width_l"));
    case_free(c);
}
END_TEST

START_TEST(a_run_s_seconds_go_by_point) {
    struct fault fault;
    struct case_file *c = load(
        "expect_s: 2\n", "expect_s: [{points: {height_l: 64.5}, s: 7.5}, {s: 2.25}]\n", &fault);
    ck_assert_msg(c != NULL, "%s", fault.text);
    const struct case_tier *t = &c->tier[TIER_SMOKE];
    struct case_parameter p[8];
    case_point(t, 1, p);
    ck_assert_double_eq(case_rule_value(&t->expect_s, p, 5), 2.25);
    case_point(t, 2, p);
    ck_assert_double_eq(case_rule_value(&t->expect_s, p, 5), 7.5);
    ck_assert_double_eq(t->limit_s, 75);
    case_free(c);
}
END_TEST

START_TEST(a_curve_is_straight_between_its_points_and_ends_soon_after) {
    struct fault fault;
    struct case_file *c = load(
        "expect: {by: height_l, values: {58: 0.02, 64.50: 0.031}}",
        "expect: {along: fall.solid_fraction, values: {0.21: 1.3, 0.37: 1.1, 0.45: 0.9}}", &fault);
    const struct case_expect *e = &c->tier[TIER_SMOKE].check[0].expect;
    ck_assert_int_eq(e->kind, EXPECT_CURVE);
    ck_assert_double_eq_tol(case_curve_at(e, 0.29), 1.2, 1e-14);
    ck_assert_double_eq_tol(case_curve_at(e, 0.41), 1.0, 1e-14);
    ck_assert_double_eq_tol(case_curve_at(e, 0.46), 0.875, 1e-14);
    ck_assert_double_eq_tol(case_curve_at(e, 0.18), 1.3375, 1e-14);
    ck_assert(isnan(case_curve_at(e, 0.4701)) && isnan(case_curve_at(e, 0.16)));
    ck_assert(isnan(case_curve_at(e, NAN)));
    case_free(c);
}
END_TEST

/* What is replaced, by what, and what the fault must say. */
static const struct {
    const char *from, *to, *says;
} spoiled[] = {
    {"name: fake/steady", "name: fake/other", "1:7: name: fake/other, but the file must hold"},
    {"{by: height_l, values: {58: 0.02, 64.50: 0.031}}",
     "{along: fall.speed, values: {0.4: 1, 0.3: 2}}", "must be a number above the one before"},
    {"{by: height_l, values: {58: 0.02, 64.50: 0.031}}",
     "{along: fall.sped, values: {0.4: 1, 1: 2}}", "did you mean"},
    {"title: A title", "titel: A title", "2:1: titel: no such key in a case; did you mean 'title'"},
    {"question: does it?", "question: ''", "question: must not be empty"},
    {"model: fake", "model: ../fake", "no name of a model"},
    {"expect_s: 2\n", "", "expect_s: missing"},
    {"expect_s: 2", "expect_s: 2s", "expect_s"},
    {"expect_s: 2", "expect_s: [{points: {start: random}, s: 3}]", "no rule of `expect_s` fits"},
    {"expect_s: 2", "expect_s: [{points: {start: rendom}, s: 3}, {s: 1}]",
     "12:29: start: no point of any tier has this value"},
    {"expect_s: 2", "expect_s: [{s: 3}, {points: {start: random}}]", "s: missing"},
    {"expect_s: 2", "expect_s: [{s: 90}, {s: 80}]\nlimit_s: 85", "is less than expect_s, 90"},
    {"expect_s: 2", "expect_s: 2\nlimit_s: 1", "limit_s: 1 is less than expect_s"},
    {"[0, 0.3]", "[0.3, 0]", "times are >= 0 and increase"},
    {"[0, 0.3]", "[0, nan]", "10:23:"},
    {"every: 0.1", "every: 0.07", "no whole number of steps"},
    {"height_l: [58, 64.5]", "height_l: [58, 58.0]", "58.0 stands twice"},
    {"height_l: [58, 64.5]", "height_l: 58", "a sweep needs a list"},
    {"height_l: [58, 64.5]", "grains: [58, 64.5]", "grains: is fixed and swept at once"},
    {"recipe: contacts", "recipe: contact", "no such recipe; did you mean contacts"},
    {"min_rows: 5", "min_row: 5", "min_row: no such key"},
    {"min_rows: 5", "min_rows: 0", "min_rows: 0 is outside"},
    {"bed: {", "spare: {recipe: contacts}, bed: {", "observable spare: no check and no figure"},
    {"fit: zero", "fit: zorro", "zorro: no such fit; did you mean zero"},
    {"along: height_l", "along: heigth_l", "heigth_l is not swept"},
    {"of: bed.sweeps_max", "of: bed.sweep_max", "no such output of bed; did you mean sweeps_max"},
    {"trend: {fit", "bed: {fit", "an observable has this name"},
    {"observable: trend.zero\n    expect: 2\n    margin: 0.3\n    kind: order",
     "observable: bed.sweeps_max\n    expect: 2\n    margin: 0.3\n    kind: model",
     "across trend: no check uses it"},
    {"observable: fall.speed", "observable: fal.speed", "did you mean fall"},
    {"observable: fall.speed", "observable: fall", "must be OBSERVABLE.OUTPUT"},
    {"observable: fall.speed", "observable: fall.sped", "did you mean speed"},
    {"points: {start: random}\n", "points: {strat: random}\n",
     "strat: no such parameter of this case"},
    {"points: {start: random}\n", "points: {start: cold}\n", "no point of tier smoke"},
    {"points: {start: random}\n", "points: {start: [random, cold]}\n",
     "cold: no point of any tier"},
    {"58: 0.02, 64.50", "58: 0.02, 66", "check overlap: no entry for height_l = 64.5"},
    {"58: 0.02,", "58: 0.02, 71: 0.1,", "71: no point of any tier has this value"},
    {"58: 0.02,", "58: 0.02, 58.0: 0.1,", "58.0: the same value as 58"},
    {"by: height_l", "by: hight_l", "did you mean height_l"},
    {"margin: 3 %", "margin: -3 %", "must be a number >= 0 or a percentage"},
    {"margin: 3 %", "margin: 3 %%", "must be a number >= 0 or a percentage"},
    {"margin: 3 %", "margin: 0", "margin 0 is for round-off checks only"},
    {"    margin: 3 %\n", "", "check overlap: a margin is needed"},
    {"    margin: 3 %\n", "    margin: 0x10\n", "must be a number >= 0"},
    {"expect: 2\n    margin: 0.3", "expect: 0\n    margin: 3 %", "a percentage of 0 is no margin"},
    {"kind: order\n", "kind: ordre\n", "did you mean 'order'"},
    {"observable: trend.zero\n    expect: 2", "observable: bed.sweeps_max\n    expect: 2",
     "an order is fitted by `across`"},
    {"comparison: at most", "comparison: atmost", "did you mean 'at most'"},
    {"because: measured", "because: ' '", "must not be empty"},
    {"name: speed", "name: overlap", "check overlap: stands twice"},
    {"tiers: [smoke]", "tiers: [smok]", "a list of smoke, paper, large"},
    {"tiers: [smoke]", "tiers: [large]", "the case has no tier large"},
    {"speed: off", "sped: off", "sped: no such check; did you mean speed"},
    {"speed: off", "trend: off", "check trend: is not in tier paper"},
    {"speed: off", "speed: {observable: bed.sweeps_max}", "observable: no such key"},
    {"  smoke: {}\n", "", "tiers: no smoke tier"},
    {"  smoke: {}\n", "  smoke: {checks: {overlap: off, speed: off, trend: off}}\n",
     "tier smoke: has no check"},
    {"  smoke: {}\n", "  smoke: {sweep: {start: [lattice]}}\n", "check speed: applies to no point"},
    {"model: fake\n", "model: fake\nlarge_only: why not\n", "has a smoke tier all the same"},
    {"count: 3", "count: 0", "count: 0 is outside"},
    {"{count: 2}]", "{points: {start: cold}, count: 2}]", "no rule of `seeds` fits"},
    {"seeds: {first", "seeds: {frist", "did you mean 'first'"},
    {"model: fake\n", "model: fake\nstart: {case: ../../etc/passwd}\n", "is no name of a case"},
    {"model: fake\n", "model: fake\nfigures: [{recipe: no-such-figure}]\n", "no such figure"},
    {"model: fake\n", "model: fake\nfigures: [{recipe: time-sequence, tims: [1]}]\n",
     "tims: no such key in a figure; did you mean 'times'"},
    {"model: fake\n", "model: fake\nfigures: [{recipe: time-sequence, times: [1, 1]}]\n",
     "times: numbers must increase"},
    {"model: fake\n", "model: fake\nfigures: [{recipe: time-sequence, times: []}]\n",
     "times: an empty list"},
    {"model: fake\n", "model: fake\nfigures: [{recipe: animation, frames: 1}]\n",
     "frames: 1 is outside"},
    {"model: fake\n", "model: fake\nfigures: [{recipe: snapshot, times: [1]}]\n", "no such key"},
    {"model: fake\n", "model: fake\nfigures: [{recipe: curves, of: fall, curve: sped, y: v}]\n",
     "sped: no such curve of settling; did you mean speed"},
    {"model: fake\n", "model: fake\nfigures: [{recipe: curves, of: fall, y: v}]\n",
     "curve: missing"},
    {"model: fake\n", "model: fake\nfigures: [{recipe: curves, curve: speed, y: v}]\n",
     "`of` must name 1 observables, not 0"},
    {"model: fake\n", "model: fake\nfigures: [{recipe: snapshot, points: {strat: random}}]\n",
     "strat: no such parameter of this case"},
    {"model: fake\n",
     "model: fake\nfigures: [{recipe: snapshot, points: {start: [random, cold]}}]\n",
     "cold: no point of any tier"},
    {"model: fake\n", "model: fake\nfigures: [{recipe: snapshot, points: {height_l: 64.5}}]\n",
     "figure snapshot: shows no point of tier paper"},
    {"model: fake\n", "model: fake\nfigures: [{recipe: snapshot, tiers: [large]}]\n",
     "the case has no tier large"},
    {"model: fake\n", "model: fake\nfigures: [{recipe: snapshot, tiers: []}]\n", "is in no tier"},
    {"grains: 137", "grains: {a: 1}", "must be a value or a list of values"},
    {"expect: {value: 1.2, uncertainty: 0.01}", "expect: {prediction: no-such}",
     "no such prediction"},
    {"expect: {value: 1.2, uncertainty: 0.01}", "expect: {value: 1.2}", "uncertainty: missing"},
    {"expect: {value: 1.2, uncertainty: 0.01}", "expect: {vale: 1.2}", "must be a number, {value"},
    {"expect: {value: 1.2, uncertainty: 0.01}", "expect: 1.2.3", "is not a number"},
    {"tags: [quick]", "tags: [Quick]", "a tag has lower-case letters"},
    {"tags: [quick]", "also_write: [/etc/passwd]", "not the name of a dataset"},
};

START_TEST(every_fault_is_told_with_its_place) {
    struct fault fault;
    struct case_file *c = load(spoiled[_i].from, spoiled[_i].to, &fault);
    case_free(c);
    ck_assert_msg(c == NULL, "accepted: %s", spoiled[_i].to);
    ck_assert_int_eq(fault.status, STATUS_BAD_INPUT);
    unit_says(&fault, spoiled[_i].says);
    unit_says(&fault, "fake/steady.yaml:");
}
END_TEST

START_TEST(a_figure_has_points_tiers_and_settings) {
    struct fault fault;
    struct case_file *c = load(
        "model: fake\n",
        "model: fake\nfigures:\n"
        "  - {recipe: time-sequence, points: {height_l: 64.5}, tiers: [smoke], times: [.1, .3]}\n"
        "  - {recipe: animation, every_tau: 0.7}\n",
        &fault);
    unit_ok(fault.status, &fault);
    const struct case_figure *f = c->figure;
    ck_assert_uint_eq(c->figure_count, 2);
    ck_assert(f[0].in_tier[TIER_SMOKE] && !f[0].in_tier[TIER_PAPER]);
    ck_assert(f[1].in_tier[TIER_SMOKE] && f[1].in_tier[TIER_PAPER]);
    ck_assert_uint_eq(f[0].points.count, 1);
    ck_assert_uint_eq(f[0].setting[0].count, 2);
    ck_assert_double_eq(f[0].setting[0].numbers[1], .3);
    ck_assert(f[1].setting[0].given && !f[1].setting[1].given);
    ck_assert_double_eq(f[1].setting[0].number, .7);
    ck_assert_double_eq(f[1].setting[1].number, 161); /* the standard */
    case_free(c);
}
END_TEST

START_TEST(several_faults_are_told_at_once_and_each_once) {
    struct fault fault;
    struct case_file *c = load("margin: 3 %", "margin: x\n    marign: 3", &fault);
    ck_assert_ptr_null(c);
    ck_assert_int_eq(fault.findings, 1); /* fields first: what they say of is not read twice */
    c = load("recipe: contacts}, fall: {recipe: settling",
             "recipe: contcts}, fall: {recipe: setling", &fault);
    ck_assert_ptr_null(c);
    ck_assert_int_ge(fault.findings, 2);
    unit_says(&fault, "did you mean contacts");
    unit_says(&fault, "did you mean settling");
}
END_TEST

START_TEST(names_and_values_are_compared_as_meant) {
    ck_assert(case_name_is_safe("graingas/verification-halo"));
    static const char *const bad[] = {"",  "/a", "a/",   "a//b", "../a", "a/../b", "a b",
                                      "A", "-a", "a/-b", "a.b",  "a\n",  "a*"};
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++)
        ck_assert_msg(!case_name_is_safe(bad[i]), "%s", bad[i]);
    ck_assert(case_value_equal("64", "64.0"));
    ck_assert(case_value_equal("1e3", "1000"));
    ck_assert(case_value_equal("published", "published"));
    ck_assert(!case_value_equal("64", "64 l"));
    ck_assert(!case_value_equal("published", "corrected"));
    ck_assert(!case_value_equal("", "0"));
}
END_TEST

int main(void) {
    Suite *suite = suite_create("case");
    TCase *group = tcase_create("case");
    tcase_set_timeout(group, 120);
    tcase_add_test(group, a_good_case_is_read_with_its_tiers);
    tcase_add_test(group, a_figure_has_points_tiers_and_settings);
    tcase_add_test(group, points_run_through_the_sweep_the_last_axis_fastest);
    tcase_add_test(group, a_run_s_seconds_go_by_point);
    tcase_add_test(group, a_curve_is_straight_between_its_points_and_ends_soon_after);
    tcase_add_loop_test(group, every_fault_is_told_with_its_place, 0,
                        (int)(sizeof spoiled / sizeof *spoiled));
    tcase_add_test(group, several_faults_are_told_at_once_and_each_once);
    tcase_add_test(group, names_and_values_are_compared_as_meant);
    suite_add_tcase(suite, group);
    return unit_finish(suite);
}
