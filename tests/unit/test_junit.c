/* test_junit.c -- junit.xml: what CI servers read must not call red green. */
#include "common/file.h"
#include "tests/unit/report_sample.h"
#include "tests/unit/unit.h"

static char *written(const struct report *r) {
    struct fault fault = FAULT_NONE;
    char *text;
    size_t length;
    const char *folder = unit_folder(), *path = unit_path(folder, "junit.xml");
    unit_ok(report_write_junit(r, path, &fault), &fault);
    unit_ok(file_read(path, 1 << 20, &text, &length, &fault), &fault);
    unit_remove(folder);
    return text;
}

static void has(const char *text, const char *part) {
    ck_assert_msg(strstr(text, part) != NULL, "expected '%s' in:\n%s", part, text);
}

static size_t occurrences(const char *text, const char *part) {
    size_t count = 0;
    for (const char *s = text; (s = strstr(s, part)) != NULL; s += strlen(part))
        count++;
    return count;
}

START_TEST(counts_names_and_times) {
    struct sample s;
    sample_fill(&s);
    char *text = written(&s.report);
    has(text, "tests=\"6\" failures=\"3\" errors=\"0\" skipped=\"1\" time=\"6.850\"");
    has(text, "classname=\"smoke.graingas.sedimentation\" name=\"own law [height_l=64]\" "
              "time=\"1.370\"/>");
    has(text, "<skipped message=\"no time | today\"/>");
    free(text);
}
END_TEST

START_TEST(two_rows_of_one_name_are_told_apart) {
    struct sample s;
    sample_fill(&s);
    char *text = written(&s.report);
    ck_assert_uint_eq(occurrences(text, "name=\"own law [height_l=82]\""), 1);
    ck_assert_uint_eq(occurrences(text, "name=\"own law [height_l=82] (2)\""), 1);
    free(text);
}
END_TEST

START_TEST(undecided_is_a_failure_of_its_own_type) {
    struct sample s;
    sample_fill(&s);
    char *text = written(&s.report);
    has(text, "<failure type=\"inconclusive\" message=\"the interval crosses 1.2463\">");
    has(text, "<failure type=\"fail\" message=\"1.3137 lies above 1.2463\">");
    has(text, "measured  1.314 ± 0.012 U0\nexpected  1.2100 ± 0.0040 U0\n"
              "accepted  1.1737 to 1.2463 U0\nmargin used  286 %");
    has(text, "repeat  bedsim run &#39;a b.yaml&#39; --seed 1101");
    free(text);
}
END_TEST

START_TEST(foreign_text_stays_text) {
    struct sample s;
    sample_fill(&s);
    char *text = written(&s.report);
    ck_assert_ptr_null(strstr(text, "<script"));
    ck_assert_ptr_null(strstr(text, "<b>"));
    ck_assert_ptr_null(strchr(text, '\x1b'));
    ck_assert_ptr_null(strchr(text, '\x01'));
    ck_assert_ptr_null(strchr(text, '\xff'));
    has(text, "&lt;script&gt;alert(1)&lt;/script&gt; \xef\xbf\xbd");
    free(text);
}
END_TEST

START_TEST(a_time_that_is_none_is_zero) {
    struct sample s;
    sample_fill(&s);
    s.first[0].seconds = (double)NAN;
    char *text = written(&s.report);
    has(text, "name=\"own law [height_l=64]\" time=\"0.000\"/>");
    ck_assert_ptr_null(strstr(text, "time=\"nan"));
    free(text);
}
END_TEST

START_TEST(a_known_disagreement_is_skipped_with_its_reason) {
    struct sample s;
    sample_fill(&s);
    sample_know(&s);
    char *text = written(&s.report);
    has(text, "tests=\"6\" failures=\"2\" errors=\"0\" skipped=\"2\" time=\"6.850\"");
    has(text, "tests=\"3\" failures=\"1\" errors=\"0\" skipped=\"1\"");
    has(text, "<skipped message=\"known since 2026-11-20: 1.3137 lies above 1.2463\"/>");
    free(text);
}
END_TEST

int main(void) {
    const TTest *const tests[] = {counts_names_and_times,
                                  two_rows_of_one_name_are_told_apart,
                                  undecided_is_a_failure_of_its_own_type,
                                  a_known_disagreement_is_skipped_with_its_reason,
                                  foreign_text_stays_text,
                                  a_time_that_is_none_is_zero,
                                  NULL};
    return unit_run("junit", tests);
}
