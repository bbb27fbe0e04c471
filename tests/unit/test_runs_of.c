/* test_runs_of.c -- validation/case.h, validation/plan.h: a case that reads the runs of another. */
#include "tests/unit/unit.h"
#include "validation/plan.h"

#include <sys/stat.h>

#define CHECKS(recipe, output)                                                                     \
    "observables: {bed: {recipe: " recipe "}}\n"                                                   \
    "checks: [{name: c, observable: bed." output ", expect: 1.37, margin: 0.21, kind: model, "     \
    "because: b}]\n"

static const char texts[] = "title: t\nsource: s\nquestion: q\nmodel: fake\n";
static const char owner[] = "expect_s: 2.5\nparameters: {grains: 137}\n"
                            "sweep: {height_l: [58, 64.5]}\nsamples: [0, 1.3]\n"
                            "seeds: {first: 1101, count: 3}\n" CHECKS(
                                "contacts", "sweeps_max") "tiers: {smoke: {parameters: {grains: "
                                                          "41}}, paper: {}}\n";
static const char reader[] =
    "runs_of: fake/owner\n" CHECKS("contacts", "largest_overlap") "tiers: {smoke: {}, paper: {}}\n";

static void write_case(const char *folder, const char *name, const char *rest) {
    char file[80], path[300];
    snprintf(file, sizeof file, "fake/%s.yaml", name);
    snprintf(path, sizeof path, "%s", unit_path(folder, file));
    FILE *out = fopen(path, "w");
    ck_assert_ptr_nonnull(out);
    fprintf(out, "name: fake/%s\n%s%s", name, texts, rest);
    fclose(out);
}

static const char *make_folder(const char *owner_text, const char *reader_text) {
    const char *folder = unit_folder();
    ck_assert_int_eq(mkdir(unit_path(folder, "fake"), 0755), 0);
    write_case(folder, "owner", owner_text);
    write_case(folder, "reader", reader_text);
    return folder;
}

START_TEST(both_cases_share_the_owners_runs) {
    const char *folder = make_folder(owner, reader);
    struct fault fault = FAULT_NONE;
    struct case_file *c[2];
    struct plan *both, *one;
    unit_ok(case_load(folder, "fake/owner", &c[0], &fault), &fault);
    unit_ok(case_load(folder, "fake/reader", &c[1], &fault), &fault);
    const struct case_file *const all[] = {c[0], c[1]};
    const struct plan_order order[] = {{c[1], NULL}, {c[0], NULL}};
    unit_ok(plan_make(order, 2, all, 2, TIER_SMOKE, 0, &both, &fault), &fault);
    unit_ok(plan_make(order, 1, all, 2, TIER_SMOKE, 0, &one, &fault), &fault);
    ck_assert_uint_eq(both->run_count, 6); /* two heights, three seeds */
    ck_assert_uint_eq(one->run_count, 6);
    for (size_t i = 0; i < 6; i++) {
        ck_assert_str_eq(both->run[i]->name, one->run[i]->name);
        ck_assert_str_eq(both->run[i]->text, one->run[i]->text);
        ck_assert_str_eq(both->run[i]->case_name, "fake/owner");
    }
    ck_assert_ptr_nonnull(strstr(one->run[0]->text, "grains: 41"));
    ck_assert_double_eq(one->run[0]->expect_s, 2.5);
    ck_assert_str_eq(one->cases[0].point[1].name, "height_l=64.5");
    plan_free(both);
    plan_free(one);
    case_free(c[0]);
    case_free(c[1]);
    unit_remove(folder);
}
END_TEST

static const struct {
    const char *owner, *reader, *says;
} bad[] = {
    {owner, "runs_of: fake/owner\nsamples: [2]\n" CHECKS("contacts", "sweeps_max") "tiers: {}\n",
     "samples: the runs are those of fake/owner"},
    {owner, "runs_of: fake/nobody\n" CHECKS("contacts", "sweeps_max") "tiers: {smoke: {}}\n",
     "runs_of: case fake/nobody cannot be read"},
    {owner, "runs_of: fake/reader\n" CHECKS("contacts", "sweeps_max") "tiers: {smoke: {}}\n",
     "so they must be its own"},
    {owner, "runs_of: fake/owner\n" CHECKS("settling", "speed") "tiers: {smoke: {}}\n",
     "the runs of fake/owner do not hold"},
    {owner,
     "runs_of: fake/owner\n" CHECKS("contacts", "sweeps_max") "tiers: {smoke: {}, large: {}}\n",
     "large: fake/owner, whose runs it reads, has no such tier"},
    {owner,
     "runs_of: fake/owner\n" CHECKS("contacts", "sweeps_max") "tiers: {smoke: {expect_s: 3}}\n",
     "expect_s: the runs are those of fake/owner"},
    {reader, reader, "so they must be its own"},
};

START_TEST(what_does_not_fit_is_refused_with_its_place) {
    struct fault fault = FAULT_NONE;
    struct case_file *c;
    const char *folder = make_folder(bad[_i].owner, bad[_i].reader);
    ck_assert_int_ne(case_load(folder, "fake/reader", &c, &fault), STATUS_OK);
    ck_assert_ptr_null(c);
    unit_says(&fault, bad[_i].says);
    unit_says(&fault, "reader.yaml:");
    unit_remove(folder);
}
END_TEST

int main(void) {
    Suite *suite = suite_create("runs_of");
    TCase *tests = tcase_create("all");
    tcase_add_test(tests, both_cases_share_the_owners_runs);
    tcase_add_loop_test(tests, what_does_not_fit_is_refused_with_its_place, 0,
                        sizeof bad / sizeof *bad);
    suite_add_tcase(suite, tests);
    return unit_finish(suite);
}
