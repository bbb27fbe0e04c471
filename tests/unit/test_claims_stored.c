/* test_claims_stored.c -- validation/claims_stored.h: read, written, and every way to spoil it. */
#include "tests/unit/unit.h"
#include "validation/claims_stored.h"

#define COMMIT                  "0123456789abcdef0123456789abcdef01234567"
#define HEADER                  "# a comment\nid\ttier\tverdict\tcommit\tdate\treason\n"
#define LINE(id, tier, verdict) id "\t" tier "\t" verdict "\t" COMMIT "\t2026-02-28\tfirst runs\n"

static struct claim_test some_test;
static struct claim claim[] = {{.id = "mfm-one", .test_count = 1, .test = &some_test},
                               {.id = "mfm-two", .test_count = 1, .test = &some_test},
                               {.id = "mfm-cost"}};
static const struct claims claims = {.count = 3, .claim = claim};

static const char good[] = HEADER LINE("mfm-one", "paper", "reproduced")
    LINE("mfm-one", "smoke", "not reproduced") LINE("mfm-two", "paper", "wrong in the paper");

static enum status load(const char *folder, const char *text, struct claims_stored **out,
                        struct fault *fault) {
    if (text != NULL)
        unit_write(unit_path(folder, "claims.tsv"), text);
    return claims_stored_load(folder, &claims, out, fault);
}

START_TEST(verdicts_are_read) {
    struct fault fault = FAULT_NONE;
    struct claims_stored *s;
    const char *folder = unit_folder();
    unit_ok(load(folder, good, &s, &fault), &fault);
    ck_assert_uint_eq(s->count, 3);
    const struct claim_stored *one = claims_stored_find(s, "mfm-one", TIER_SMOKE);
    ck_assert_int_eq(one->verdict, CLAIM_NOT_REPRODUCED);
    ck_assert_str_eq(one->commit, COMMIT);
    ck_assert_str_eq(one->date, "2026-02-28");
    ck_assert_str_eq(one->reason, "first runs");
    ck_assert_ptr_null(claims_stored_find(s, "mfm-two", TIER_SMOKE));
    ck_assert_ptr_null(claims_stored_find(NULL, "mfm-two", TIER_PAPER));
    claims_stored_free(s);
    unit_remove(folder);
}
END_TEST

START_TEST(no_file_and_no_folder_are_no_verdict) {
    struct fault fault = FAULT_NONE;
    struct claims_stored *s;
    const char *folder = unit_folder();
    unit_ok(load(folder, NULL, &s, &fault), &fault);
    ck_assert_uint_eq(s->count, 0);
    claims_stored_free(s);
    unit_ok(claims_stored_load(NULL, &claims, &s, &fault), &fault);
    ck_assert_uint_eq(s->count, 0);
    claims_stored_free(s);
    unit_remove(folder);
}
END_TEST

static enum status write_again(const struct claims_stored *s, struct fault *fault) {
    char *text;
    enum status status = claims_stored_text(s, &claims, &text, fault);
    if (status == STATUS_OK)
        unit_write(s->path, text);
    else
        ck_assert_ptr_null(text);
    free(text);
    return status;
}

START_TEST(what_is_written_is_read_again) {
    struct fault fault = FAULT_NONE;
    struct claims_stored *s;
    const char *folder = unit_folder();
    const struct claim_stored fresh = {"mfm-two", TIER_LARGE,   CLAIM_UNDERDETERMINED,
                                       COMMIT,    "2026-11-22", "another width"};
    struct claim_stored changed = {"mfm-one", TIER_SMOKE,   CLAIM_REPRODUCED,
                                   COMMIT,    "2026-11-22", "a fault was mended"};
    unit_ok(load(folder, good, &s, &fault), &fault);
    unit_ok(claims_stored_put(s, &fresh, &fault), &fault);
    unit_ok(claims_stored_put(s, &changed, &fault), &fault);
    unit_ok(write_again(s, &fault), &fault);
    claims_stored_free(s);
    unit_ok(load(folder, NULL, &s, &fault), &fault);
    ck_assert_uint_eq(s->count, 4);
    ck_assert_int_eq(claims_stored_find(s, "mfm-two", TIER_LARGE)->verdict, CLAIM_UNDERDETERMINED);
    ck_assert_str_eq(claims_stored_find(s, "mfm-one", TIER_SMOKE)->reason, "a fault was mended");
    changed.reason = "with a\ttab"; /* reading would refuse it: the file stays */
    unit_ok(claims_stored_put(s, &changed, &fault), &fault);
    ck_assert_int_eq(write_again(s, &fault), STATUS_BAD_INPUT);
    claims_stored_free(s);
    fault = FAULT_NONE;
    unit_ok(load(folder, NULL, &s, &fault), &fault);
    ck_assert_str_eq(claims_stored_find(s, "mfm-one", TIER_SMOKE)->reason, "a fault was mended");
    claims_stored_free(s);
    unit_remove(folder);
}
END_TEST

START_TEST(the_line_of_one_claim_and_tier_is_removed) {
    struct fault fault = FAULT_NONE;
    struct claims_stored *s;
    const char *folder = unit_folder();
    unit_ok(load(folder, good, &s, &fault), &fault);
    claims_stored_remove(s, "mfm-one", TIER_LARGE); /* none */
    claims_stored_remove(s, "mfm-one", TIER_PAPER);
    ck_assert_uint_eq(s->count, 2);
    ck_assert_ptr_null(claims_stored_find(s, "mfm-one", TIER_PAPER));
    ck_assert_ptr_nonnull(claims_stored_find(s, "mfm-one", TIER_SMOKE));
    ck_assert_ptr_nonnull(claims_stored_find(s, "mfm-two", TIER_PAPER));
    claims_stored_free(s);
    unit_remove(folder);
}
END_TEST

static const struct {
    const char *text, *says;
} bad[] = {
    {"", "does not end in a whole line"},
    {"# nothing\n", "claims.tsv: no header"},
    {"id\ttier\tverdict\n", "claims.tsv:1: not the header of a table of claims"},
    {HEADER "mfm-one\tpaper\n", "claims.tsv:3: 2 columns, must be 6"},
    {HEADER LINE("mfm-on", "paper", "reproduced"), "is no such claim; did you mean 'mfm-one'?"},
    {HEADER LINE("mfm-cost", "paper", "reproduced"), "\"mfm-cost\" has no tests"},
    {HEADER LINE("mfm-one", "papers", "reproduced"), "tier: \"papers\" is no tier"},
    {HEADER LINE("mfm-one", "paper", "reproduce"), "did you mean 'reproduced'?"},
    {HEADER LINE("mfm-one", "paper", "undecided"), "\"undecided\" is none to be kept"},
    {HEADER LINE("mfm-one", "paper", "not tested"), "\"not tested\" is none to be kept"},
    {HEADER LINE("mfm-one", "paper", "reproduced") LINE("mfm-one", "paper", "reproduced"),
     "claims.tsv:4: the same as line 3"},
    {HEADER LINE("mfm-one", "paper", "reproduced") LINE("mfm-one", "paper", "underdetermined"),
     "\"mfm-one\" has a line in this tier already"},
    {HEADER LINE("mfm-two", "paper", "reproduced") LINE("mfm-one", "paper", "reproduced"),
     "belongs before line 3: sort with LC_ALL=C"},
    {HEADER "mfm-one\tpaper\treproduced\tunknown\t2026-02-28\twhy\n", "is no commit"},
    {HEADER "mfm-one\tpaper\treproduced\t" COMMIT "\t2026-02-31\twhy\n", "is no day"},
    {HEADER "mfm-one\tpaper\treproduced\t" COMMIT "\t2026-02-28\t - \n", "says nothing"},
    {HEADER "mfm-one\tpaper\treproduced\t" COMMIT "\t2026-02-28\ta\x01b\n", "control character"},
    {HEADER "<<<<<<< HEAD\n", "a merge conflict is not solved"},
    {HEADER "mfm-one\tpaper\treproduced\t" COMMIT "\t2026-02-28\twhy", "a whole line"},
};

START_TEST(every_fault_is_told) {
    struct fault fault = FAULT_NONE;
    struct claims_stored *s;
    const char *folder = unit_folder();
    ck_assert_int_eq(load(folder, bad[_i].text, &s, &fault), STATUS_BAD_INPUT);
    ck_assert_ptr_null(s);
    unit_says(&fault, bad[_i].says);
    unit_remove(folder);
}
END_TEST

int main(void) {
    Suite *suite = suite_create("claims_stored");
    TCase *group = tcase_create("claims_stored");
    tcase_add_test(group, verdicts_are_read);
    tcase_add_test(group, no_file_and_no_folder_are_no_verdict);
    tcase_add_test(group, what_is_written_is_read_again);
    tcase_add_test(group, the_line_of_one_claim_and_tier_is_removed);
    tcase_add_loop_test(group, every_fault_is_told, 0, sizeof bad / sizeof *bad);
    suite_add_tcase(suite, group);
    return unit_finish(suite);
}
