/* test_claims.c -- validation/claims.h: claims read and looked up, and every way to spoil one. */
#include "tests/unit/unit.h"
#include "validation/claims.h"

#include <sys/stat.h>

static const char case_text[] =
    "name: fake/bed\ntitle: t\nsource: s\nquestion: q\nmodel: fake\nexpect_s: 2\n"
    "sweep: {darcy: [published, corrected], step: [0.1, 0.2, 0.4]}\nsamples: [1]\n"
    "seeds: {first: 11, count: 2}\nobservables: {bed: {recipe: contacts}}\n"
    "across: {fit: {fit: order, of: bed.sweeps_max, along: step, exact: true}}\n"
    "checks:\n"
    "  - {name: value, observable: bed.largest_overlap, points: {darcy: published}, expect: 1.37,\n"
    "     margin: 3 %, scatter: 0.5 %, kind: model, because: b}\n"
    "  - {name: order, observable: fit.order, kind: order, margin: 0.05, because: b, expect: 2}\n"
    "tiers: {smoke: {sweep: {step: [0.1, 0.2]}, checks: {order: off}}, paper: {}}\n";

static const char good[] = "paper: FAKE\n"
                           "title: A. Fake, J. Fakes 1, 1 (1999)\n"
                           "claims:\n"
                           "  - id: fake-value\n"
                           "    where: Section II\n"
                           "    says: It is so.\n"
                           "    reading: as stated\n"
                           "    tests:\n"
                           "      - {case: fake/bed, check: value, points: {step: [0.4, 0.20]}}\n"
                           "      - {case: fake/bed, check: order, result: fail}\n"
                           "    verdict: wrong in the paper\n"
                           "    otherwise: reproduced\n"
                           "    because: it must\n"
                           "    proof: S2\n"
                           "  - id: fake-cost\n"
                           "    where: Section III\n"
                           "    says: It is fast.\n"
                           "    verdict: underdetermined\n"
                           "    untested: no such machine\n"
                           "    because: nothing follows\n";

/* `good` with one text replaced by another, beside the case; the folder of cases. */
static const char *stage(const char *file, const char *from, const char *to) {
    const char *folder = unit_folder(), *at = strstr(good, from);
    char text[4096], path[256];
    ck_assert_msg(at != NULL, "no '%s' in the claims", from);
    snprintf(text, sizeof text, "%.*s%s%s", (int)(at - good), good, to, at + strlen(from));
    ck_assert_int_eq(mkdir(unit_path(folder, "cases"), 0755), 0);
    ck_assert_int_eq(mkdir(unit_path(folder, "cases/fake"), 0755), 0);
    ck_assert_int_eq(mkdir(unit_path(folder, "claims"), 0755), 0);
    unit_write(unit_path(folder, "cases/fake/bed.yaml"), case_text);
    snprintf(path, sizeof path, "%s/claims/%s", folder, file);
    unit_write(path, text);
    return folder;
}

START_TEST(good_claims_are_read) {
    struct fault fault = FAULT_NONE;
    struct claims *c;
    const char *folder = stage("fake.yaml", "FAKE", "FAKE");
    unit_ok(claims_load(unit_path(folder, "cases/"), &c, &fault), &fault);
    ck_assert_uint_eq(c->count, 2);
    const struct claim *one = &c->claim[0];
    ck_assert_str_eq(one->paper, "FAKE");
    ck_assert_str_eq(one->proof, "S2");
    ck_assert_int_eq(one->verdict, CLAIM_WRONG);
    ck_assert_int_eq(one->otherwise, CLAIM_REPRODUCED);
    ck_assert_uint_eq(one->test_count, 2);
    ck_assert(one->test[0].wants_pass && !one->test[1].wants_pass);
    /* .2 is a point of both tiers; the order is judged in one only, and none is large */
    ck_assert(one->test[0].in_tier[TIER_SMOKE] && one->test[0].in_tier[TIER_PAPER]);
    ck_assert(!one->test[1].in_tier[TIER_SMOKE] && one->test[1].in_tier[TIER_PAPER]);
    ck_assert(!one->test[0].in_tier[TIER_LARGE]);
    ck_assert_uint_eq(c->claim[1].test_count, 0);
    ck_assert_int_eq(c->claim[1].verdict, CLAIM_UNDERDETERMINED);
    ck_assert_ptr_null(c->claim[1].reading);
    claims_free(c);
    unit_remove(folder);
}
END_TEST

START_TEST(no_folder_is_no_claim) {
    struct fault fault = FAULT_NONE;
    struct claims *c;
    const char *folder = unit_folder();
    ck_assert_int_eq(mkdir(unit_path(folder, "cases"), 0755), 0);
    unit_ok(claims_load(unit_path(folder, "cases"), &c, &fault), &fault);
    ck_assert_uint_eq(c->count, 0);
    claims_free(c);
    unit_remove(folder);
}
END_TEST

static const struct {
    const char *from, *to, *says;
} bad[] = {
    {"paper: FAKE\n", "", "paper: missing"},
    {"claims:\n", "claim:\n", "did you mean 'claims'?"},
    {"    says: It is so.\n", "", "fake.yaml:4:5: says: missing"},
    {"says: It is so.", "says: ' '", "says: must not be empty"},
    {"case: fake/bed, check: value", "case: fake/bad, check: value",
     "fake.yaml:9:16: fake/bad: no such case; did you mean 'fake/bed'?"},
    {"case: fake/bed, check: value", "case: ../bed, check: value", "../bed: no such case"},
    {"check: value", "check: valve", "valve: no such check; did you mean 'value'?"},
    {"{step: [0.4, 0.20]}", "{stop: 0.4}", "stop: no such parameter of this case; did you mean"},
    {"{step: [0.4, 0.20]}", "{step: [0.4, 0.3]}",
     "fake.yaml:9:61: step 0.3: no point of check 'value' of fake/bed has it"},
    {"{step: [0.4, 0.20]}", "{darcy: corrected}", "darcy corrected: no point of check 'value'"},
    {"{step: [0.4, 0.20]}", "{step: {a: 1}}", "step: must be a value or a list of values"},
    {"check: order", "check: order, points: {step: 0.4}", "step: the check is a fit along it"},
    {"result: fail", "result: failed", "result"},
    {"verdict: wrong in the paper", "verdict: wrong", "wrong is no verdict of a claim"},
    {"verdict: wrong in the paper", "verdict: not reproducd", "did you mean 'not reproduced'?"},
    {"verdict: wrong in the paper", "verdict: undecided", "undecided is no verdict of a claim"},
    {"otherwise: reproduced", "otherwise: wrong in the paper", "whatever its tests say"},
    {"    otherwise: reproduced\n", "", "`otherwise` is for claims with tests"},
    {"otherwise: reproduced", "otherwise: not tested", "not tested, but there are tests"},
    {"    proof: S2\n", "", "fake-value: wrong in the paper needs `proof`"},
    {"proof: S2", "proof: S", "proof: S is no section"},
    {"proof: S2", "proof: somewhere", "somewhere is no section"},
    {"    because: it must\n", "", "because: missing"},
    {"id: fake-cost", "id: fake-value", "id: fake-value is that of"},
    {"id: fake-cost", "id: Fake", "id: Fake: must have lower-case letters"},
    {"    untested: no such machine\n", "", "fake-cost: no tests; say why with `untested`"},
    {"verdict: underdetermined", "verdict: reproduced", "fake-cost: reproduced without a test"},
    {"    proof: S2\n", "    proof: S2\n    untested: why\n", "`untested`, but there are tests"},
    {"claims:\n", "claims: []\nclaimz:\n", "did you mean 'claims'?"},
};

START_TEST(every_fault_is_told) {
    struct fault fault = FAULT_NONE;
    struct claims *c;
    const char *folder = stage("fake.yaml", bad[_i].from, bad[_i].to);
    ck_assert_int_eq(claims_load(unit_path(folder, "cases"), &c, &fault), STATUS_BAD_INPUT);
    ck_assert_ptr_null(c);
    unit_says(&fault, bad[_i].says);
    unit_remove(folder);
}
END_TEST

START_TEST(the_folder_holds_nothing_else) {
    struct fault fault = FAULT_NONE;
    struct claims *c;
    const char *folder = stage("fake.yml", "FAKE", "FAKE");
    ck_assert_int_eq(claims_load(unit_path(folder, "cases"), &c, &fault), STATUS_BAD_INPUT);
    unit_says(&fault, "/claims/fake.yml: this folder is for claims alone");
    unit_remove(folder);
}
END_TEST

START_TEST(the_place_is_beside_the_cases) {
    struct arena a = {0};
    static const char *const place[][2] = {{"cases", "claims"},       {"a/cases", "a/claims"},
                                           {"a/cases//", "a/claims"}, {"/cases", "/claims"},
                                           {"..", "../../claims"},    {".", "./../claims"},
                                           {"a/..", "a/../../claims"}};
    for (size_t i = 0; i < sizeof place / sizeof *place; i++)
        ck_assert_str_eq(claims_beside(place[i][0], "claims", &a), place[i][1]);
    arena_free(&a);
}
END_TEST

/* Every claim of the suite names what exists, and every proof is a section of docs/theory.md. */
START_TEST(the_claims_of_the_suite_are_whole) {
    struct fault fault = FAULT_NONE;
    struct claims *c;
    static char theory[1 << 20];
    unit_ok(claims_load("validation/cases", &c, &fault), &fault);
    FILE *file = fopen("docs/theory.md", "r");
    ck_assert_ptr_nonnull(file);
    ck_assert_uint_gt(fread(theory, 1, sizeof theory - 1, file), 0);
    fclose(file);
    ck_assert_uint_ge(c->count, 12);
    for (size_t i = 0; i < c->count; i++) {
        char heading[64];
        if (c->claim[i].proof == NULL)
            continue;
        snprintf(heading, sizeof heading, "\n## %s. ", c->claim[i].proof);
        ck_assert_msg(strstr(theory, heading) != NULL, "%s: docs/theory.md has no section %s",
                      c->claim[i].id, c->claim[i].proof);
    }
    claims_free(c);
}
END_TEST

int main(void) {
    Suite *suite = suite_create("claims");
    TCase *group = tcase_create("claims");
    tcase_add_test(group, good_claims_are_read);
    tcase_add_test(group, no_folder_is_no_claim);
    tcase_add_loop_test(group, every_fault_is_told, 0, sizeof bad / sizeof *bad);
    tcase_add_test(group, the_folder_holds_nothing_else);
    tcase_add_test(group, the_place_is_beside_the_cases);
    tcase_add_test(group, the_claims_of_the_suite_are_whole);
    suite_add_tcase(suite, group);
    return unit_finish(suite);
}
