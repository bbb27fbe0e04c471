/* test_reference.c -- validation/reference.h: the table is believed only when every line is good.
 */
#include "tests/unit/unit.h"
#include "validation/reference.h"

#include <math.h>
#include <sys/stat.h>

#define HEADER                                                                                     \
    "tier\tpoint\tobservable\torigin\tvalue\tdeviation\tseeds\tmeaning\tcommit\tsolver_key\t"      \
    "date\treason\n"
#define COMMIT "0123456789abcdef0123456789abcdef01234567"
#define KEY    "00112233445566778899aabbccddeeff00112233445566778899aabbccddeeff"
#define MADE   "1a2b3c4d\t" COMMIT "\t" KEY "\t2026-11-22\tfirst set\n"
#define READ   "-\t-\t-\t2026-11-21\tread off Fig. 3\n"

static const char good[] =
    "# References\n" HEADER
    "paper\theight_l=3.7\tbed.speed\tensemble\t1.2843750000000001\t0.0137\t37\t" MADE
    "paper\theight_l=3.7\tbed.speed\tpublished\t1.31\t0.02\t0\t" READ
    "smoke\t-\tbits@1101\tbits\tgcc-12/-O2/x86_64/glibc:" KEY "\t-\t1\t" MADE
    "smoke\t-\tbits@1101\tbits\tgcc-13/-O2/x86_64/glibc:" KEY "\t-\t1\t" MADE
    "smoke\theight_l=3.7\tbed.speed\tensemble\t-7.03e-05\t1.9e-07\t64\t" MADE
    "smoke\theight_l=3.7\tbed.speed@1102\tseed\t0.25\t-\t1\t" MADE;

static const char *write_table(const char *text) {
    const char *folder = unit_folder();
    ck_assert_int_eq(mkdir(unit_path(folder, "fake"), 0755), 0);
    unit_write(unit_path(folder, "fake/steady.tsv"), text);
    return folder;
}

/* The table is refused, and the fault says where and why. */
static void refused(const char *text, const char *where, const char *why) {
    struct fault fault = FAULT_NONE;
    struct references *r;
    const char *folder = write_table(text);
    ck_assert_int_eq(reference_load(folder, "fake/steady", &r, &fault), STATUS_BAD_INPUT);
    ck_assert_ptr_null(r);
    unit_says(&fault, where);
    unit_says(&fault, why);
    unit_remove(folder);
}

/* `good` with the first `old` replaced. */
static const char *with(const char *old, const char *new) {
    static char text[4096];
    const char *at = strstr(good, old);
    ck_assert_ptr_nonnull(at);
    snprintf(text, sizeof text, "%.*s%s%s", (int)(at - good), good, new, at + strlen(old));
    return text;
}

START_TEST(lines_are_found_by_their_whole_key) {
    struct fault fault = FAULT_NONE;
    struct references *r;
    const char *folder = write_table(good);
    unit_ok(reference_load(folder, "fake/steady", &r, &fault), &fault);
    ck_assert_uint_eq(r->count, 6);
    struct reference_key key = {TIER_SMOKE, "height_l=3.7", "bed.speed", "1a2b3c4d", false};
    const struct reference *line = reference_find(r, &key, ORIGIN_ENSEMBLE);
    ck_assert_ptr_nonnull(line);
    ck_assert_double_eq(line->value, -7.03e-5);
    ck_assert_double_eq(line->deviation, 1.9e-7);
    ck_assert_uint_eq(line->seeds, 64);
    ck_assert_uint_eq(line->line, 7);
    ck_assert(reference_is_meant(line, key.meaning) && !reference_is_meant(line, "1a2b3c4e"));
    ck_assert_ptr_null(reference_find(r, &key, ORIGIN_PUBLISHED)); /* that is of the paper tier */
    ck_assert_double_eq(reference_find_seed(r, &key, 1102)->value, 0.25);
    ck_assert_ptr_null(reference_find_seed(r, &key, 110));
    key.tier = TIER_PAPER;
    ck_assert_double_eq(reference_find(r, &key, ORIGIN_ENSEMBLE)->value, 1.2843750000000001);
    line = reference_find(r, &key, ORIGIN_PUBLISHED);
    ck_assert(reference_is_meant(line, "1a2b3c4e")); /* no run of ours gave it */
    key.observable = "bed.spee";
    ck_assert_ptr_null(reference_find(r, &key, ORIGIN_ENSEMBLE));
    key.tier = TIER_LARGE;
    ck_assert_ptr_null(reference_find(r, &key, ORIGIN_ENSEMBLE));
    reference_free(r);
    unit_remove(folder);
}
END_TEST

START_TEST(bits_are_found_by_seed_and_class_of_build) {
    struct fault fault = FAULT_NONE;
    struct references *r;
    const char *folder = write_table(good);
    unit_ok(reference_load(folder, "fake/steady", &r, &fault), &fault);
    struct plan_point point = {.name = "single"};
    struct plan_run run = {.id = "fake.steady.1a2b3c4d", .seed = 1101};
    const char *class = "gcc-13/-O2/x86_64/glibc";
    const struct reference *line = reference_find_bits(r, TIER_SMOKE, &point, &run, class);
    ck_assert_ptr_nonnull(line);
    ck_assert_str_eq(line->digest, KEY);
    ck_assert(isnan(line->value) && isnan(line->deviation));
    ck_assert_str_eq(reference_run_meaning(&run), line->meaning);
    ck_assert_ptr_null(reference_find_bits(r, TIER_PAPER, &point, &run, class));
    ck_assert_ptr_null(reference_find_bits(r, TIER_SMOKE, &point, &run, "gcc-14/-O2/x86_64/glibc"));
    run.seed = 1102;
    ck_assert_ptr_null(reference_find_bits(r, TIER_SMOKE, &point, &run, class));
    reference_free(r);
    unit_remove(folder);
}
END_TEST

START_TEST(no_file_is_no_reference) {
    struct fault fault = FAULT_NONE;
    struct references *r;
    const char *folder = write_table(good);
    unit_ok(reference_load(folder, "fake/other", &r, &fault), &fault);
    ck_assert_uint_eq(r->count, 0);
    reference_free(r);
    unit_ok(reference_load(NULL, "fake/steady", &r, &fault), &fault);
    ck_assert_uint_eq(r->count, 0);
    reference_free(r);
    unit_remove(folder);
}
END_TEST

START_TEST(order_and_duplicates_are_refused) {
    static const char first[] = "smoke\t-\tbed.speed\tensemble\t1\t2\t37\t" MADE;
    static const char second[] = "smoke\t-\tbed.speed\tensemble\t1.5\t2\t37\t" MADE;
    static const char other[] = "smoke\t-\tbed.speedy\tensemble\t1\t2\t37\t" MADE;
    char text[2048];
    snprintf(text, sizeof text, HEADER "%s%s", other, first);
    refused(text, "fake/steady.tsv:3", "belongs before line 2");
    snprintf(text, sizeof text, HEADER "%s%s", first, first);
    refused(text, "fake/steady.tsv:3", "the same as line 2");
    snprintf(text, sizeof text, HEADER "%s%s", first, second);
    refused(text, "fake/steady.tsv:3", "the same key as in line 2");
    snprintf(text, sizeof text, HEADER "<<<<<<< ours\n%s=======\n%s>>>>>>> theirs\n", first,
             second);
    refused(text, "fake/steady.tsv:2", "merge conflict");
}
END_TEST

START_TEST(bad_lines_are_refused_where_they_stand) {
    refused(with("1.2843750000000001", "nan"), "steady.tsv:3: value", "not a decimal");
    refused(with("1.2843750000000001", "1e999"), "steady.tsv:3: value", "not a finite");
    refused(with("1.2843750000000001", "0x1p3"), "steady.tsv:3: value", "not a decimal");
    refused(with("1.2843750000000001", ""), "steady.tsv:3: value", "not a decimal");
    refused(with("\t0.0137", "\t0"), "steady.tsv:3: deviation", "positive");
    refused(with("\t0.0137", "\t-"), "steady.tsv:3: deviation", "finite");
    refused(with("\t37\t", "\t31\t"), "steady.tsv:3: seeds", "32");
    refused(with("\t0.02\t", "\t0\t"), "steady.tsv:4: deviation", "positive");
    refused(with("\tpublished\t", "\tpublishd\t"), "steady.tsv:4: origin", "published");
    refused(with("paper\theight", "papre\theight"), "steady.tsv:3: tier", "no tier");
    refused(with("1a2b3c4d", "1a2b3c4"), "steady.tsv:3: meaning", "hex digits");
    refused(with("-\t-\t-\t2026", "-\t" COMMIT "\t-\t2026"), "steady.tsv:4: commit", "no run");
    refused(with("2026-11-22", "2026-02-30"), "steady.tsv:3: date", "no day");
    refused(with("2026-11-22", "22.11.2026"), "steady.tsv:3: date", "no day");
    refused(with("first set", " - "), "steady.tsv:3: reason", "nothing");
    refused(with("first set", "first\tset"), "steady.tsv:3", "13 columns");
    refused(with("first set", "first\rset"), "steady.tsv:3", "control character");
    refused(with("bed.speed@1102", "bed.speed@"), "steady.tsv:8: observable", "@SEED");
    refused(with("bits@1101", "bit@1101"), "steady.tsv:5: observable", "bits@SEED");
    refused(with("glibc:" KEY, "glibc:" COMMIT), "steady.tsv:5: value", "64 hex");
    refused(with("reason\n", "why\n"), "steady.tsv:2", "header");
    refused(with("Fig. 3\n", "Fig. 3"), "steady.tsv:4", "columns");
    refused("# nothing else\n", "steady.tsv", "no header");
    refused(HEADER "smoke\t-\ta.b\tensemble", "steady.tsv", "whole line");
    refused("", "steady.tsv", "whole line");
}
END_TEST

/* All faults of a table are told at once. */
START_TEST(every_finding_is_told) {
    struct fault fault = FAULT_NONE;
    struct references *r;
    const char *folder = write_table(HEADER "smoke\t-\ta.b\tensemble\tx\t2\t37\t" MADE
                                            "smoke\t-\ta.c\tensemble\t1\t2\t7\t" MADE);
    ck_assert_int_eq(reference_load(folder, "fake/steady", &r, &fault), STATUS_BAD_INPUT);
    ck_assert_int_eq(fault.findings, 2);
    unit_remove(folder);
}
END_TEST

START_TEST(what_is_written_is_sorted_and_read_back_bit_by_bit) {
    struct fault fault = FAULT_NONE;
    struct references *r, *again;
    struct reference item[6];
    char *text, *same;
    const char *folder = write_table(good);
    unit_ok(reference_load(folder, "fake/steady", &r, &fault), &fault);
    for (size_t i = 0; i < 6; i++)
        item[i] = r->item[(i * 5 + 3) % 6]; /* out of order */
    item[3].value = 0.1 + 0.2;              /* the first line of the file */
    item[3].text = NULL;
    unit_ok(reference_text("x.tsv", item, 6, &text, &fault), &fault);
    unit_write(unit_path(folder, "fake/steady.tsv"), text);
    unit_ok(reference_load(folder, "fake/steady", &again, &fault), &fault);
    unit_ok(reference_text("x.tsv", again->item, 6, &same, &fault), &fault);
    ck_assert_str_eq(text, same);
    ck_assert_double_eq(again->item[0].value, 0.1 + 0.2);
    free(text);
    free(same);
    reference_free(r);
    reference_free(again);
    unit_remove(folder);
}
END_TEST

START_TEST(nothing_is_written_that_reading_would_refuse) {
    struct fault fault = FAULT_NONE;
    struct references *r;
    const char *folder = write_table(good);
    unit_ok(reference_load(folder, "fake/steady", &r, &fault), &fault);
    struct reference bad[] = {r->item[0], r->item[0], r->item[0], r->item[0]};
    char *text;
    bad[0].value = NAN;
    bad[1].reason = "two\nlines";
    bad[2].seeds = 31;
    bad[3].deviation = 0;
    for (size_t i = 0; i < 4; i++)
        bad[i].text = NULL;
    for (size_t i = 0; i < 4; i++) {
        fault = FAULT_NONE;
        ck_assert_int_eq(reference_text("x.tsv", &bad[i], 1, &text, &fault), STATUS_BAD_INPUT);
        ck_assert_ptr_null(text);
    }
    reference_free(r);
    unit_remove(folder);
}
END_TEST

int main(void) {
    const TTest *tests[] = {lines_are_found_by_their_whole_key,
                            bits_are_found_by_seed_and_class_of_build,
                            no_file_is_no_reference,
                            order_and_duplicates_are_refused,
                            bad_lines_are_refused_where_they_stand,
                            every_finding_is_told,
                            what_is_written_is_sorted_and_read_back_bit_by_bit,
                            nothing_is_written_that_reading_would_refuse,
                            NULL};
    return unit_run("reference", tests);
}
