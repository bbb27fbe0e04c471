/* test_markdown.c -- summary.md: verdict first, tables that stay tables, under 1 MB. */
#include "common/file.h"
#include "tests/unit/report_sample.h"
#include "tests/unit/unit.h"

static char *written(const struct report *r, size_t *length) {
    struct fault fault = FAULT_NONE;
    char *text;
    const char *folder = unit_folder(), *path = unit_path(folder, "summary.md");
    unit_ok(report_write_markdown(r, path, &fault), &fault);
    unit_ok(file_read(path, 1 << 22, &text, length, &fault), &fault);
    unit_remove(folder);
    return text;
}

static void has(const char *text, const char *part) {
    ck_assert_msg(strstr(text, part) != NULL, "expected '%s' in:\n%s", part, text);
}

START_TEST(the_verdict_comes_first_and_failures_in_full) {
    struct sample s;
    size_t length;
    sample_fill(&s);
    char *text = written(&s.report, &length);
    ck_assert_int_eq(strncmp(text, "# FAIL: ", 8), 0);
    has(text, "2 of 5 checks fail");
    has(text, "| 2 | 2 | 1 | 0 | 1 |");
    has(text, "- failed: 1.3137 lies above 1.2463");
    has(text, "- inconclusive: the interval crosses 1.2463");
    has(text, "Not run: graingas/fluidization: no time \\| today");
    free(text);
}
END_TEST

START_TEST(a_name_with_markup_stays_in_its_cell) {
    struct sample s;
    size_t length;
    sample_fill(&s);
    char *text = written(&s.report, &length);
    ck_assert_ptr_null(strstr(text, "<b>"));
    const char *row = strstr(text, "| ✗ **FAIL** | &lt;b&gt;x&lt;/b&gt;");
    ck_assert_ptr_nonnull(row);
    size_t bars = 0;
    for (const char *c = row; *c != '\n'; c++)
        bars += *c == '|' && c[-1] != '\\';
    ck_assert_uint_eq(bars, 8);
    free(text);
}
END_TEST

START_TEST(thousands_of_rows_stay_below_a_megabyte_and_are_counted) {
    enum { ROWS = 20000 };
    struct sample s;
    size_t length;
    sample_fill(&s);
    struct report_row *rows = calloc(ROWS, sizeof *rows);
    for (size_t i = 0; i < ROWS; i++)
        rows[i] = s.first[i % 3];
    s.cases[0].row = rows;
    s.cases[0].row_count = ROWS;
    char *text = written(&s.report, &length);
    ck_assert_uint_lt(length, 1000 * 1000);
    has(text, "more do not fit in here: see results.json.");
    free(text);
    free(rows);
}
END_TEST

START_TEST(a_modified_solver_is_named_first) {
    struct sample s;
    size_t length;
    sample_fill(&s);
    s.report.modified = true;
    s.report.modification = "dt_tau=0.05";
    char *text = written(&s.report, &length);
    ck_assert_int_eq(strncmp(text, "# MODIFIED, FAIL: ", 18), 0);
    has(text, "dt\\_tau=0.05");
    free(text);
}
END_TEST

START_TEST(a_known_disagreement_has_a_count_and_a_sign_of_its_own) {
    struct sample s;
    size_t length;
    sample_fill(&s);
    sample_know(&s);
    sample_budget(&s);
    char *text = written(&s.report, &length);
    has(text, "| 2 | 1 | 1 | 1 | 1 |");
    has(text, "\n\nUnchanged code may raise a false alarm");
    has(text, "\n\n3 of 4 runs have the bits");
    has(text, "### ≠ graingas/sedimentation: own law");
    has(text, "- known: known since 2026-11-20: 1.3137 lies above 1.2463");
    has(text, "| ≠ known | graingas/sedimentation | own law |");
    free(text);
}
END_TEST

START_TEST(limits_and_agreement_are_told_in_short) {
    struct sample s;
    sample_fill(&s);
    const struct report_limit limit[] = {{"suspension", "<wakes>", "no flow"},
                                         {"any", "experiments", "none enters"}};
    const struct report_group group[] = {
        {"graingas", 7, 3, .973, .9612, .9851, .0371, .021, .0613, .0119},
        {"suspension", 2, 1, 1.0213, (double)NAN, (double)NAN, .0113, (double)NAN, (double)NAN, 0}};
    const struct report_agreement agreement = {.group_count = 2, .group = group};
    s.report.limit = limit;
    s.report.limit_count = 2;
    s.report.agreement = &agreement;
    size_t length;
    char *text = written(&s.report, &length);
    ck_assert_ptr_nonnull(strstr(
        text,
        "Measured over expected: graingas bias 0.973 (95 %: 0.9612 to 0.9851), scatter 0.0371 "
        "over 7 rows; suspension bias 1.021, scatter 0.0113 over 2 rows.\n"));
    ck_assert_ptr_nonnull(strstr(text, "No check here can see: &lt;wakes&gt;; experiments.\n"));
    free(text);
}
END_TEST

int main(void) {
    const TTest *const tests[] = {limits_and_agreement_are_told_in_short,
                                  a_known_disagreement_has_a_count_and_a_sign_of_its_own,
                                  the_verdict_comes_first_and_failures_in_full,
                                  a_name_with_markup_stays_in_its_cell,
                                  thousands_of_rows_stay_below_a_megabyte_and_are_counted,
                                  a_modified_solver_is_named_first,
                                  NULL};
    return unit_run("markdown", tests);
}
