/* test_case_regression.c -- checks against references, and known disagreements, as cases say
 * them: what is read, and what is refused. */
#include "tests/unit/case_stage.h"

#include <math.h>

static const char good[] =
    "name: fake/steady\n"
    "title: A title\n"
    "source: a paper\n"
    "question: does it?\n"
    "model: fake\n"
    "sweep: {height_l: [58, 64.5]}\n"
    "samples: {from: 0, to: 0.3, every: 0.1}\n"
    "expect_s: 2\n"
    "observables: {bed: {recipe: contacts}, fall: {recipe: settling, min_rows: 5}}\n"
    "across: {trend: {fit: zero, of: bed.sweeps_max, along: height_l}}\n"
    "checks:\n"
    "  - {name: same, observable: fall.speed, kind: regression, detects: 3 %, because: b}\n"
    "  - {name: pair, observable: bed.largest_overlap, kind: regression, paired: true,\n"
    "     detects: 1e-6, margin: 4e-7, because: round-off, points: {height_l: 58}}\n"
    "  - {name: slope, observable: trend.zero, kind: regression, detects: 0.7, because: b}\n"
    "  - {name: paper, observable: fall.speed, kind: model, margin: 3 %, because: b,\n"
    "     expect: {by: height_l, values: {58: {reference: published}, 64.5: 1.2}},\n"
    "     known: {because: their law is another, since: 2026-11-20}}\n"
    "tiers:\n"
    "  smoke: {checks: {same: {detects: 11 %}}}\n"
    "  paper: {}\n";

static struct case_file *load(const char *from, const char *to, struct fault *fault) {
    return stage_spoiled("fake/steady", good, from, to, fault);
}

START_TEST(checks_against_references_are_read) {
    struct fault fault;
    struct case_file *c = load("A title", "A title", &fault);
    ck_assert_msg(c != NULL, "%s", fault.text);
    const struct case_check *smoke = c->tier[TIER_SMOKE].check, *k = c->tier[TIER_PAPER].check;
    ck_assert_int_eq(k[0].kind, KIND_REGRESSION);
    ck_assert_int_eq(k[0].expect.kind, EXPECT_NONE);
    ck_assert(k[0].detects.percent && k[0].detects.value == 3 && !k[0].paired);
    ck_assert(smoke[0].detects.value == 11 && smoke[0].detects_node != k[0].detects_node);
    ck_assert(k[1].paired && k[1].margin.value == 4e-7);
    ck_assert_str_eq(case_kind_name(k[2].kind), "regression");
    ck_assert_ptr_null(k[0].known_since);
    ck_assert_str_eq(k[3].known_since, "2026-11-20");
    ck_assert_str_eq(k[3].known_because, "their law is another");
    const struct case_expect *e = &k[3].expect.entry[0].expect;
    ck_assert_int_eq(e->kind, EXPECT_REFERENCE);
    ck_assert_str_eq(e->reference, "published");
    case_free(c);
}
END_TEST

struct spoiled {
    const char *from, *to, *says;
};

static const struct spoiled faults[] = {
    {"detects: 3 %, ", "", "check same: detects: is missing"},
    {"detects: 3 %", "detects: 0", "check same: detects: must be above 0"},
    {"detects: 3 %", "detects: some", "detects: must be a number >= 0 or a percentage"},
    {"detects: 3 %", "detects: 3 %, expect: 1.2", "check same: expect: a regression check takes"},
    {"detects: 3 %", "detects: 3 %, scatter: 1 %", "check same: scatter: a regression check"},
    {"detects: 3 %", "detects: 3 %, comparison: at most", "check same: comparison: a regression"},
    {"detects: 3 %", "detects: 3 %, margin: 1 %",
     "margin: a regression check takes it from its "
     "reference unless it is `paired`"},
    {"detects: 3 %", "detect: 3 %", "did you mean 'detects'?"},
    {", margin: 4e-7", "", "check pair: a paired check needs a margin above 0"},
    {"margin: 4e-7", "margin: 6e-7",
     "check pair: detects: 1e-06, but with this margin only "
     "1.2e-06 is surely seen"},
    {"paired: true", "paired: perhaps", "paired"},
    {"margin: 3 %, because: b,", "margin: 3 %, because: b, detects: 3 %,",
     "check paper: detects: belongs to regression checks"},
    {"margin: 3 %, because: b,", "margin: 3 %, because: b, paired: true,",
     "check paper: paired: belongs to regression checks"},
    {"detects: 0.7", "detects: 0.7, paired: true, margin: 0.1",
     "trend.zero is no number of single"},
    {"along: height_l}", "along: height_l, exact: true}", "check slope: trend.zero is exact"},
    {"kind: regression, detects: 0.7", "kind: model, margin: 2", "check slope: expect: is missing"},
    {"reference: published", "reference: publshed", "did you mean 'published'?"},
    {"reference: published", "reference: ensemble", "ensemble"},
    {", since: 2026-11-20", "", "since"},
    {"since: 2026-11-20", "since: 2026-13-20", "since: must be a date, as 2026-11-22"},
    {"since: 2026-11-20", "since: yesterday", "since: must be a date"},
    {"because: their law is another", "because: ' '", "must not be empty"},
    {"same: {detects: 11 %}", "same: {detects: 0 %}", "detects: must be above 0"},
    {"same: {detects: 11 %}", "same: {margin: 11 %}", "margin: a regression check takes it"},
};

START_TEST(every_fault_is_told) {
    const struct spoiled *f = &faults[_i];
    struct fault fault;
    struct case_file *c = load(f->from, f->to, &fault);
    ck_assert_msg(c == NULL, "'%s' was accepted", f->to);
    unit_says(&fault, f->says);
    unit_says(&fault, "steady.yaml:");
}
END_TEST

int main(void) {
    Suite *suite = suite_create("case_regression");
    TCase *group = tcase_create("case_regression");
    tcase_add_test(group, checks_against_references_are_read);
    tcase_add_loop_test(group, every_fault_is_told, 0, (int)(sizeof faults / sizeof *faults));
    suite_add_tcase(suite, group);
    return unit_finish(suite);
}
