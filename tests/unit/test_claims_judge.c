/* test_claims_judge.c -- validation/claims_judge.h: what rows make of a claim, and of a stored
 * verdict. */
#include "tests/unit/unit.h"
#include "validation/claims_judge.h"

#include <sys/stat.h>

static const char case_text[] =
    "name: fake/bed\ntitle: t\nsource: s\nquestion: q\nmodel: fake\nexpect_s: 2\n"
    "sweep: {darcy: [published, corrected], step: [0.1, 0.2]}\nsamples: [1]\n"
    "seeds: {first: 11, count: 2}\nobservables: {bed: {recipe: contacts}}\n"
    "across: {fit: {fit: ends, of: bed.sweeps_max, along: step}}\n"
    "checks:\n"
    "  - {name: value, observable: bed.largest_overlap, expect: 1.37,\n"
    "     margin: 3 %, scatter: 0.5 %, kind: model, because: b}\n"
    "  - {name: ratio, observable: fit.ratio, kind: model, margin: 0.05, because: b, expect: 2}\n"
    "tiers: {smoke: {}, paper: {checks: {ratio: off}}}\n";

static const char claims_text[] =
    "paper: FAKE\n"
    "title: A. Fake, J. Fakes 1, 1 (1999)\n"
    "claims:\n"
    "  - id: fake-value\n"
    "    where: Section II\n"
    "    says: It is so.\n"
    "    tests:\n"
    "      - {case: fake/bed, check: value, points: {darcy: published}}\n"
    "      - {case: fake/bed, check: ratio, points: {darcy: corrected}}\n"
    "    verdict: reproduced\n"
    "    otherwise: not reproduced\n"
    "    because: it must\n"
    "  - id: fake-fails\n"
    "    where: Section III\n"
    "    says: It is not so.\n"
    "    tests: [{case: fake/bed, check: value, result: fail, points: {step: 0.2}}]\n"
    "    verdict: not reproduced\n"
    "    otherwise: reproduced\n"
    "    because: it must\n"
    "  - id: fake-cost\n"
    "    where: Section IV\n"
    "    says: It is fast.\n"
    "    verdict: underdetermined\n"
    "    untested: no such machine\n"
    "    because: nothing follows\n";

/* A plan of four points; value has a row a point, ratio one for each darcy. */
struct stage {
    const char *folder;
    struct claims *claims;
    struct claims_stored *stored;
    struct case_file *file;
    struct plan *plan;
    struct measured_point point[4];
    struct report_row row[6];
    const struct measured_point *row_point[6];
    const struct case_check *row_check[6];
    struct rows rows;
    struct assemble_case cases[1];
    struct report_case report[1];
    struct arena arena;
    struct report_ledger ledger;
};

static void set_rows(struct stage *s) {
    static const char *const group[] = {"darcy=published", "darcy=corrected"};
    for (size_t i = 0; i < 6; i++) {
        s->point[i % 4].point = &s->plan->cases[0].point[i % 4];
        s->row_point[i] = i < 4 ? &s->point[i] : NULL;
        s->row_check[i] = &s->plan->cases[0].tier->check[i < 4 ? 0 : 1];
        s->row[i] = (struct report_row){.case_name = "fake/bed",
                                        .kind = "model",
                                        .point = i < 4 ? s->point[i].point->name : group[i - 4],
                                        .check = s->row_check[i]->name,
                                        .verdict = VERDICT_PASS};
    }
    s->rows =
        (struct rows){.count = 6, .row = s->row, .point = s->row_point, .check = s->row_check};
    s->cases[0] = (struct assemble_case){.plan = &s->plan->cases[0], .rows = &s->rows};
    s->report[0] = (struct report_case){.name = "fake/bed", .row = s->row, .row_count = 6};
}

static void set_up(struct stage *s, const char *stored) {
    struct fault fault = FAULT_NONE;
    *s = (struct stage){.folder = unit_folder()};
    static const char *const folder[] = {"cases", "cases/fake", "claims", "reference"};
    for (size_t i = 0; i < 4; i++)
        ck_assert_int_eq(mkdir(unit_path(s->folder, folder[i]), 0755), 0);
    unit_write(unit_path(s->folder, "cases/fake/bed.yaml"), case_text);
    unit_write(unit_path(s->folder, "claims/fake.yaml"), claims_text);
    if (stored != NULL) {
        char text[2048];
        snprintf(text, sizeof text, "id\ttier\tverdict\tcommit\tdate\treason\n%s", stored);
        unit_write(unit_path(s->folder, "reference/claims.tsv"), text);
    }
    unit_ok(claims_load(unit_path(s->folder, "cases"), &s->claims, &fault), &fault);
    unit_ok(claims_stored_load(unit_path(s->folder, "reference"), s->claims, &s->stored, &fault),
            &fault);
    unit_ok(case_load(unit_path(s->folder, "cases"), "fake/bed", &s->file, &fault), &fault);
    struct plan_order order = {.file = s->file};
    const struct case_file *all[] = {s->file};
    unit_ok(plan_make(&order, 1, all, 1, TIER_SMOKE, 0, &s->plan, &fault), &fault);
    set_rows(s);
}

static const struct report_claim *judge(struct stage *s, enum tier tier) {
    struct fault fault = FAULT_NONE;
    struct claims_input in = {s->claims, s->stored, tier, s->cases, s->report, 1};
    unit_ok(claims_judge(&in, &s->arena, &s->ledger, &fault), &fault);
    ck_assert_uint_eq(s->ledger.count, 3);
    return s->ledger.claim;
}

static void tear_down(struct stage *s) {
    arena_free(&s->arena);
    plan_free(s->plan);
    case_free(s->file);
    claims_stored_free(s->stored);
    claims_free(s->claims);
    unit_remove(s->folder);
}

START_TEST(rows_of_the_right_points_decide) {
    struct stage s;
    set_up(&s, NULL);
    const struct report_claim *c = judge(&s, TIER_SMOKE);
    ck_assert_int_eq(c[0].verdict, CLAIM_REPRODUCED);
    ck_assert_uint_eq(c[0].test[0].row_count, 2); /* published at two steps */
    ck_assert_uint_eq(c[0].test[0].row[1], 1);
    ck_assert_uint_eq(c[0].test[1].row_count, 1); /* the group of the corrected law */
    ck_assert_uint_eq(c[0].test[1].row[0], 5);
    ck_assert_str_eq(c[0].test[1].points, "darcy corrected");
    ck_assert(c[0].is_tested && c[0].stored == NULL);
    ck_assert_int_eq(c[1].verdict, CLAIM_REPRODUCED); /* it had to fail */
    ck_assert_ptr_nonnull(strstr(c[1].reason, "[step 0.2], comes out the other way"));
    ck_assert_int_eq(c[2].verdict, CLAIM_UNDERDETERMINED);
    ck_assert(!c[2].is_tested);
    ck_assert_uint_eq(s.report[0].row_count, 6); /* nothing is stored */
    tear_down(&s);
}
END_TEST

/* Rows of other points decide nothing; each verdict of a row that counts is met. */
static const struct {
    size_t row;
    enum verdict verdict;
    enum claim_verdict value, fails;
} turn[] = {
    {0, VERDICT_FAIL, CLAIM_NOT_REPRODUCED, CLAIM_REPRODUCED},
    {0, VERDICT_INCONCLUSIVE, CLAIM_UNDECIDED, CLAIM_REPRODUCED},
    {0, VERDICT_KNOWN, CLAIM_NOT_REPRODUCED, CLAIM_REPRODUCED},
    {2, VERDICT_FAIL, CLAIM_REPRODUCED, CLAIM_REPRODUCED},
    {3, VERDICT_FAIL, CLAIM_REPRODUCED, CLAIM_REPRODUCED}, /* the other step still passes */
    {4, VERDICT_FAIL, CLAIM_REPRODUCED, CLAIM_REPRODUCED},
    {5, VERDICT_FAIL, CLAIM_NOT_REPRODUCED, CLAIM_REPRODUCED},
    {5, VERDICT_INCONCLUSIVE, CLAIM_UNDECIDED, CLAIM_REPRODUCED},
};

START_TEST(one_row_turns_a_claim) {
    struct stage s;
    set_up(&s, NULL);
    s.row[turn[_i].row].verdict = turn[_i].verdict;
    const struct report_claim *c = judge(&s, TIER_SMOKE);
    ck_assert_int_eq(c[0].verdict, turn[_i].value);
    ck_assert_int_eq(c[1].verdict, turn[_i].fails);
    tear_down(&s);
}
END_TEST

START_TEST(what_fails_throughout_fails) {
    struct stage s;
    set_up(&s, NULL);
    s.row[1].verdict = VERDICT_FAIL;
    s.row[3].verdict = VERDICT_KNOWN;
    ck_assert_int_eq(judge(&s, TIER_SMOKE)[1].verdict, CLAIM_NOT_REPRODUCED);
    s.row[3].verdict = VERDICT_INCONCLUSIVE;
    ck_assert_int_eq(judge(&s, TIER_SMOKE)[1].verdict, CLAIM_UNDECIDED);
    tear_down(&s);
}
END_TEST

START_TEST(a_missing_test_is_told) {
    struct stage s;
    set_up(&s, NULL);
    s.rows.count = 4; /* no fit in this tier */
    const struct report_claim *c = judge(&s, TIER_PAPER);
    ck_assert_int_eq(c[0].verdict, CLAIM_NOT_TESTED);
    ck_assert_ptr_nonnull(strstr(c[0].reason, "fake/bed, ratio: not in tier paper"));
    s.row[0].verdict = VERDICT_FAIL; /* decides by itself */
    ck_assert_int_eq(judge(&s, TIER_PAPER)[0].verdict, CLAIM_NOT_REPRODUCED);
    s.cases[0].rows = NULL;
    c = judge(&s, TIER_SMOKE);
    ck_assert_int_eq(c[1].verdict, CLAIM_NOT_TESTED);
    ck_assert_ptr_nonnull(strstr(c[1].reason, "not run"));
    ck_assert(!c[1].is_tested);
    tear_down(&s);
}
END_TEST

#define COMMIT                    "0123456789012345678901234567890123456789"
#define STORED(id, tier, verdict) id "\t" tier "\t" verdict "\t" COMMIT "\t2026-11-21\tfirst\n"

START_TEST(a_changed_verdict_fails_and_an_unchanged_one_passes) {
    struct stage s;
    set_up(&s, STORED("fake-fails", "smoke", "not reproduced")
                   STORED("fake-value", "smoke", "reproduced"));
    const struct report_claim *c = judge(&s, TIER_SMOKE);
    ck_assert_str_eq(c[0].stored, "reproduced");
    ck_assert_uint_eq(s.report[0].row_count, 8);
    const struct report_row *same = &s.report[0].row[6], *other = &s.report[0].row[7];
    ck_assert_str_eq(same->check, "claim fake-value");
    ck_assert_str_eq(same->kind, "claim");
    ck_assert_int_eq(same->verdict, VERDICT_PASS);
    ck_assert_str_eq(other->case_name, "fake/bed");
    ck_assert_int_eq(other->verdict, VERDICT_FAIL);
    ck_assert_ptr_nonnull(strstr(other->reason, "reproduced, but not reproduced on 2026-11-21"));
    tear_down(&s);
}
END_TEST

START_TEST(an_undecided_claim_leaves_its_row_open) {
    struct stage s;
    set_up(&s, STORED("fake-value", "smoke", "reproduced"));
    s.row[5].verdict = VERDICT_INCONCLUSIVE;
    judge(&s, TIER_SMOKE);
    ck_assert_uint_eq(s.report[0].row_count, 7);
    ck_assert_int_eq(s.report[0].row[6].verdict, VERDICT_INCONCLUSIVE);
    tear_down(&s);
}
END_TEST

START_TEST(other_tiers_and_cases_that_were_not_run_have_no_row) {
    struct stage s;
    set_up(&s, STORED("fake-value", "paper", "reproduced"));
    judge(&s, TIER_SMOKE);
    ck_assert_uint_eq(s.report[0].row_count, 6);
    s.cases[0].rows = NULL;
    judge(&s, TIER_PAPER);
    ck_assert_uint_eq(s.report[0].row_count, 6);
    tear_down(&s);
}
END_TEST

int main(void) {
    Suite *suite = suite_create("claims_judge");
    TCase *group = tcase_create("claims_judge");
    tcase_add_test(group, rows_of_the_right_points_decide);
    tcase_add_loop_test(group, one_row_turns_a_claim, 0, sizeof turn / sizeof *turn);
    tcase_add_test(group, what_fails_throughout_fails);
    tcase_add_test(group, a_missing_test_is_told);
    tcase_add_test(group, a_changed_verdict_fails_and_an_unchanged_one_passes);
    tcase_add_test(group, an_undecided_claim_leaves_its_row_open);
    tcase_add_test(group, other_tiers_and_cases_that_were_not_run_have_no_row);
    suite_add_tcase(suite, group);
    return unit_finish(suite);
}
