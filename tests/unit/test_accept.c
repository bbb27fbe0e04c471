/* test_accept.c -- validation/accept.h: all tables or none, and how large a change is. */
#include "tests/unit/unit.h"
#include "validation/accept.h"

#include <dirent.h>
#include <math.h>
#include <sys/stat.h>
#include <unistd.h>

#define COMMIT "0123456789abcdef0123456789abcdef01234567"
#define HASH   "00112233445566778899aabbccddeeff00112233445566778899aabbccddeeff"

static struct reference line_of(double value, double deviation, size_t seeds) {
    return (struct reference){.tier = TIER_SMOKE,
                              .origin = ORIGIN_ENSEMBLE,
                              .point = "-",
                              .observable = "bed.speed",
                              .value = value,
                              .deviation = deviation,
                              .seeds = seeds,
                              .meaning = "1a2b3c4d",
                              .commit = COMMIT,
                              .solver_key = HASH,
                              .date = "2026-11-22",
                              .reason = "a test"};
}

/* Two cases of one line each, both changed. */
struct stage {
    const char *folder;
    struct case_file file[2];
    struct plan_case plan[2];
    struct reference line[2];
    struct accept_change change;
    struct accept_case list[2];
};

static void set_up(struct stage *s) {
    *s = (struct stage){.folder = unit_folder()};
    for (int i = 0; i < 2; i++) {
        s->file[i].name = i == 0 ? "fake/first" : "fake/second";
        s->plan[i].file = &s->file[i];
        s->line[i] = line_of(1.37 + i, 0.0137, 37);
        s->list[i] = (struct accept_case){.plan = &s->plan[i],
                                          .count = 1,
                                          .item = &s->line[i],
                                          .change_count = 1,
                                          .change = &s->change};
    }
}

static size_t count_files(const char *folder) {
    size_t count = 0;
    DIR *d = opendir(unit_path(folder, "fake"));
    for (struct dirent *e; d != NULL && (e = readdir(d)) != NULL;)
        count += e->d_name[0] != '.';
    if (d != NULL)
        closedir(d);
    return count;
}

static double value_in(const char *folder, const char *name) {
    struct fault fault = FAULT_NONE;
    struct references *r;
    unit_ok(reference_load(folder, name, &r, &fault), &fault);
    double value = r->count == 1 ? r->item[0].value : NAN;
    reference_free(r);
    return value;
}

START_TEST(tables_are_written_and_nothing_is_left_beside_them) {
    struct fault fault = FAULT_NONE;
    struct stage s;
    set_up(&s);
    unit_ok(accept_write(s.folder, s.list, 2, NULL, &fault), &fault);
    ck_assert_double_eq(value_in(s.folder, "fake/first"), 1.37);
    ck_assert_double_eq(value_in(s.folder, "fake/second"), 2.37);
    s.line[0].value = 1.41;
    s.list[1].change_count = 0; /* that one stays as it is */
    s.line[1].value = 7;
    unit_ok(accept_write(s.folder, s.list, 2, NULL, &fault), &fault);
    ck_assert_double_eq(value_in(s.folder, "fake/first"), 1.41);
    ck_assert_double_eq(value_in(s.folder, "fake/second"), 2.37);
    ck_assert_uint_eq(count_files(s.folder), 2);
    unit_remove(s.folder);
}
END_TEST

/* A folder stands where the second table must go: the first is put back. */
START_TEST(a_table_that_cannot_be_replaced_leaves_all_as_they_were) {
    struct fault fault = FAULT_NONE;
    struct stage s;
    set_up(&s);
    unit_ok(accept_write(s.folder, s.list, 1, NULL, &fault), &fault);
    mkdir(unit_path(s.folder, "fake/second.tsv"), 0755);
    s.line[0].value = 1.41;
    ck_assert_int_ne(accept_write(s.folder, s.list, 2, NULL, &fault), STATUS_OK);
    ck_assert_double_eq(value_in(s.folder, "fake/first"), 1.37);
    ck_assert_uint_eq(count_files(s.folder), 2); /* the table and the folder */
    unlink(unit_path(s.folder, "fake/first.tsv"));
    ck_assert_int_ne(accept_write(s.folder, s.list, 2, NULL, &fault), STATUS_OK);
    ck_assert_uint_eq(count_files(s.folder), 1); /* nor is a new one left */
    unit_remove(s.folder);
}
END_TEST

START_TEST(a_bad_line_stops_all_tables) {
    struct fault fault = FAULT_NONE;
    struct stage s;
    set_up(&s);
    s.line[1].value = NAN;
    ck_assert_int_eq(accept_write(s.folder, s.list, 2, NULL, &fault), STATUS_BAD_INPUT);
    unit_says(&fault, "fake/second.tsv");
    ck_assert_uint_eq(count_files(s.folder), 0);
    unit_remove(s.folder);
}
END_TEST

/* Tables and verdicts are one step: either file keeps the other as it was. */
START_TEST(verdicts_and_tables_are_written_together_or_not_at_all) {
    struct fault fault = FAULT_NONE;
    struct stage s;
    struct claim_test test;
    struct claim one = {.id = "fake-one", .test_count = 1, .test = &test};
    struct claims all = {.count = 1, .claim = &one};
    struct accept_claims claims = {.claims = &all, .change_count = 1};
    const struct claim_stored line = {"fake-one", TIER_SMOKE,   CLAIM_NOT_REPRODUCED,
                                      COMMIT,     "2026-11-22", "a test"};
    set_up(&s);
    unit_ok(claims_stored_load(s.folder, &all, &claims.stored, &fault), &fault);
    unit_ok(claims_stored_put(claims.stored, &line, &fault), &fault);
    s.line[1].value = NAN;
    ck_assert_int_ne(accept_write(s.folder, s.list, 2, &claims, &fault), STATUS_OK);
    ck_assert(access(unit_path(s.folder, "claims.tsv"), F_OK) != 0);
    s.line[1].value = 2.37;
    mkdir(unit_path(s.folder, "claims.tsv"), 0755); /* in its way */
    ck_assert_int_ne(accept_write(s.folder, s.list, 2, &claims, &fault), STATUS_OK);
    ck_assert_uint_eq(count_files(s.folder), 0);
    rmdir(unit_path(s.folder, "claims.tsv"));
    fault = FAULT_NONE;
    unit_ok(accept_write(s.folder, s.list, 2, &claims, &fault), &fault);
    ck_assert_uint_eq(count_files(s.folder), 2);
    claims_stored_free(claims.stored);
    unit_ok(claims_stored_load(s.folder, &all, &claims.stored, &fault), &fault);
    ck_assert_int_eq(claims_stored_find(claims.stored, "fake-one", TIER_SMOKE)->verdict,
                     CLAIM_NOT_REPRODUCED);
    claims_stored_free(claims.stored);
    unit_remove(s.folder);
}
END_TEST

START_TEST(differences_are_in_units_of_their_uncertainty) {
    struct reference a = line_of(1.37, 0.012, 36), b = line_of(1.38, 0.021, 49);
    struct accept_change change = {&a, &b};
    /* .012/6 and .021/7: hypot(.002, .003) */
    ck_assert_double_eq_tol(accept_difference(&change), 0.01 / hypot(0.002, 0.003), 1e-9);
    change = (struct accept_change){&b, &a};
    ck_assert(accept_difference(&change) < 0);
    change.old = NULL;
    ck_assert(isnan(accept_difference(&change)));
}
END_TEST

int main(void) {
    const TTest *tests[] = {tables_are_written_and_nothing_is_left_beside_them,
                            a_table_that_cannot_be_replaced_leaves_all_as_they_were,
                            a_bad_line_stops_all_tables,
                            verdicts_and_tables_are_written_together_or_not_at_all,
                            differences_are_in_units_of_their_uncertainty,
                            NULL};
    return unit_run("accept", tests);
}
