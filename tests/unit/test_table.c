/* test_table.c -- validation/table.h: sorted tables of text, read to the last fault and written. */
#include "tests/unit/unit.h"
#include "validation/table.h"

static const char *const column[] = {"bed", "sigma_R", "reason"};
static const struct table_form form = {"widths", "# Widths.\n", column, 3, 1 << 12};

#define HEADER "# Widths.\n# Two comments.\nbed\tsigma_R\treason\n"

struct seen {
    size_t count;
    char last[3][64], whole[64];
};

static enum status take(void *owner, const struct table_place *at, char *const *field,
                        const char *whole) {
    struct seen *s = owner;
    for (int i = 0; i < 3; i++)
        snprintf(s->last[i], sizeof s->last[i], "%s", field[i]);
    snprintf(s->whole, sizeof s->whole, "%s", whole);
    s->count++;
    if (strcmp(field[1], "nan") == 0)
        table_refuse(at, "sigma_R", field[1], "is not finite");
    return STATUS_OK;
}

static enum status read_text(const char *text, struct seen *seen, struct fault *fault) {
    struct arena arena = {0};
    const struct table_place from = {"some.tsv", 0, &arena, fault};
    *fault = FAULT_NONE;
    *seen = (struct seen){0};
    enum status status = table_read(&form, &from, text, take, seen);
    arena_free(&arena);
    return status;
}

START_TEST(lines_come_in_columns_and_whole) {
    struct seen seen;
    struct fault fault;
    unit_ok(read_text(HEADER "large\t6.89\t\nsmall\t7.18\tfour seeds\n", &seen, &fault), &fault);
    ck_assert_uint_eq(seen.count, 2);
    ck_assert_str_eq(seen.last[0], "small");
    ck_assert_str_eq(seen.last[1], "7.18");
    ck_assert_str_eq(seen.last[2], "four seeds");
    ck_assert_str_eq(seen.whole, "small\t7.18\tfour seeds");
    unit_ok(read_text(HEADER, &seen, &fault), &fault);
    ck_assert_uint_eq(seen.count, 0);
}
END_TEST

static const struct {
    const char *text, *says;
} faulty[] = {
    {"", "some.tsv: does not end in a whole line"},
    {HEADER "large\t6.89\twhy", "some.tsv: does not end in a whole line"},
    {"# Widths.\n", "some.tsv: no header"},
    {"# Widths.\nbed\tsigma_R\n", "some.tsv:2: not the header of a table of widths"},
    {"bed\tsigma_R\treasons\n", "some.tsv:1: not the header"},
    {HEADER "large\t6.89\n", "some.tsv:4: 2 columns, must be 3"},
    {HEADER "a\tb\tc\td\te\tf\tg\th\ti\tj\tk\tl\tm\tn\n", "some.tsv:4: 14 columns, must be 3"},
    {HEADER "small\t7.18\ta\nlarge\t6.89\ta\n", "some.tsv:5: belongs before line 4"},
    {HEADER "large\t6.89\ta\nlarge\t6.89\ta\n", "some.tsv:5: the same as line 4"},
    {HEADER "# late\t1\t2\nlarge\t6.89\ta\x7f\n", "some.tsv:5: a control character"},
    {HEADER "<<<<<<< HEAD\n", "some.tsv:4: a merge conflict is not solved"},
    {HEADER "=======\n", "some.tsv:4: a merge conflict is not solved"},
    {HEADER ">>>>>>> other\n", "some.tsv:4: a merge conflict is not solved"},
    {HEADER "large\tnan\ta\n", "some.tsv:4: sigma_R: \"nan\" is not finite"},
};

START_TEST(every_fault_is_told) {
    struct seen seen;
    struct fault fault;
    ck_assert_int_eq(read_text(faulty[_i].text, &seen, &fault), STATUS_BAD_INPUT);
    unit_says(&fault, faulty[_i].says);
}
END_TEST

START_TEST(faults_of_all_lines_are_told_together) {
    struct seen seen;
    struct fault fault;
    ck_assert_int_eq(read_text(HEADER "large\tnan\ta\nmiddle\nsmall\tnan\tb\n", &seen, &fault),
                     STATUS_BAD_INPUT);
    ck_assert_uint_eq(seen.count, 2);
    unit_says(&fault, "some.tsv:4: sigma_R");
    unit_says(&fault, "some.tsv:5: 1 columns");
    unit_says(&fault, "some.tsv:6: sigma_R");
}
END_TEST

START_TEST(what_is_written_is_sorted_and_reads_again) {
    const char *line[] = {"small\t7.18\tb", "large\t6.89\ta", "middle\t6.87\tc"};
    const char *gone[] = {"small\t7.18\tb", NULL};
    char *text;
    struct seen seen;
    struct fault fault = FAULT_NONE;
    unit_ok(table_write(&form, "some.tsv", line, 3, &text, &fault), &fault);
    ck_assert_str_eq(text, "# Widths.\nbed\tsigma_R\treason\nlarge\t6.89\ta\nmiddle\t6.87\tc\n"
                           "small\t7.18\tb\n");
    unit_ok(read_text(text, &seen, &fault), &fault);
    ck_assert_uint_eq(seen.count, 3);
    free(text);
    ck_assert_int_eq(table_write(&form, "some.tsv", gone, 2, &text, &fault), STATUS_NO_MEMORY);
    unit_says(&fault, "some.tsv: out of memory");
    ck_assert_ptr_null(text);
}
END_TEST

START_TEST(a_file_with_a_null_byte_is_no_text) {
    struct arena arena = {0};
    struct fault fault = FAULT_NONE;
    struct seen seen = {0};
    const char *folder = unit_folder();
    const struct table_place from = {unit_path(folder, "w.tsv"), 0, &arena, &fault};
    unit_write(from.path, HEADER "large\t6.89\twhy\n");
    unit_ok(table_load(&form, &from, take, &seen), &fault);
    ck_assert_uint_eq(seen.count, 1);
    FILE *file = fopen(from.path, "ab");
    ck_assert_ptr_nonnull(file);
    ck_assert_uint_eq(fwrite("\0small", 1, 6, file), 6);
    ck_assert_int_eq(fclose(file), 0);
    ck_assert_int_eq(table_load(&form, &from, take, &seen), STATUS_BAD_INPUT);
    unit_says(&fault, "is not a text");
    arena_free(&arena);
    unit_remove(folder);
}
END_TEST

START_TEST(digits_are_counted) {
    ck_assert(table_is_hex("0f3a", 4));
    ck_assert(!table_is_hex("0F3a", 4));
    ck_assert(!table_is_hex("0f3a", 5));
    ck_assert(!table_is_hex("0g3a", 4));
}
END_TEST

int main(void) {
    Suite *suite = suite_create("table");
    TCase *group = tcase_create("table");
    tcase_add_test(group, lines_come_in_columns_and_whole);
    tcase_add_loop_test(group, every_fault_is_told, 0, sizeof faulty / sizeof *faulty);
    tcase_add_test(group, faults_of_all_lines_are_told_together);
    tcase_add_test(group, what_is_written_is_sorted_and_reads_again);
    tcase_add_test(group, a_file_with_a_null_byte_is_no_text);
    tcase_add_test(group, digits_are_counted);
    suite_add_tcase(suite, group);
    return unit_finish(suite);
}
