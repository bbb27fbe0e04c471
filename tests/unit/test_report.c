/* test_report.c -- report/report.h and words.h: counting, the worst row, numbers as words. */
#include "report/report.h"
#include "report/words.h"
#include "tests/unit/report_sample.h"
#include "tests/unit/unit.h"

static struct report_row row_of(const char *comparison, double measured, double expected,
                                double tolerance) {
    struct report_row row = sample_row("c", "", "check", measured);
    row.comparison = comparison;
    row.expected = expected;
    row.tolerance = tolerance;
    return row;
}

static double used(const char *comparison, double measured, double expected, double tolerance) {
    struct report_row row = row_of(comparison, measured, expected, tolerance);
    return report_margin_used(&row);
}

START_TEST(rows_are_counted_and_a_failure_decides) {
    struct sample s;
    sample_fill(&s);
    struct report_count n = report_tally(&s.report);
    ck_assert_uint_eq(n.pass, 2);
    ck_assert_uint_eq(n.fail, 2);
    ck_assert_uint_eq(n.inconclusive, 1);
    ck_assert_uint_eq(n.skipped, 1);
    ck_assert_int_eq(report_verdict(&s.report), VERDICT_FAIL);
    s.first[1].verdict = s.second[0].verdict = VERDICT_PASS;
    ck_assert_int_eq(report_verdict(&s.report), VERDICT_INCONCLUSIVE);
    s.first[2].verdict = VERDICT_PASS;
    ck_assert_int_eq(report_verdict(&s.report), VERDICT_PASS);
}
END_TEST

static struct words sentence_of(const struct report *r) {
    struct words w = {""};
    FILE *out = fmemopen(w.text, sizeof w.text, "w");
    words_sentence(out, r);
    fclose(out);
    return w;
}

START_TEST(a_known_disagreement_is_counted_and_decides_nothing) {
    struct sample s;
    sample_fill(&s);
    sample_know(&s);
    s.second[0].verdict = s.first[2].verdict = VERDICT_PASS;
    struct report_count n = report_tally(&s.report);
    ck_assert(n.known == 1 && n.pass == 4 && n.fail == 0 && n.inconclusive == 0);
    ck_assert_int_eq(report_verdict(&s.report), VERDICT_PASS);
    ck_assert_str_eq(sentence_of(&s.report).text,
                     "4 of 5 checks pass; 1 disagrees as known; 1 case was not run.");
    ck_assert_ptr_ne(report_worst(&s.report), &s.first[1]); /* though it uses 286 % */
    s.first[2].verdict = VERDICT_INCONCLUSIVE;
    ck_assert_int_eq(report_verdict(&s.report), VERDICT_INCONCLUSIVE);
    s.first[2].verdict = VERDICT_FAIL;
    ck_assert_int_eq(report_verdict(&s.report), VERDICT_FAIL);
    s.cases[0].row = &s.first[1];
    s.cases[0].row_count = s.report.case_count = 1;
    ck_assert_int_eq(report_verdict(&s.report), VERDICT_KNOWN);
    ck_assert_str_eq(words_headline(&s.report), "ONLY KNOWN DISAGREEMENTS");
}
END_TEST

static const char *text_of(void (*put)(FILE *, const struct report *), const struct report *r) {
    static char text[600];
    FILE *out = fmemopen(text, sizeof text, "w");
    put(out, r);
    fclose(out);
    return text;
}

START_TEST(the_budget_and_the_bits_are_told) {
    struct sample s;
    sample_fill(&s);
    ck_assert_str_eq(text_of(words_budget, &s.report), "");
    ck_assert_str_eq(text_of(words_bits, &s.report), "");
    sample_budget(&s);
    struct report_alarms a = report_alarms(&s.report);
    ck_assert(a.rows == 3 && a.unknown == 1);
    ck_assert_double_eq_tol(a.sum, 1.45e-5, 1e-20);
    const char *text = text_of(words_budget, &s.report);
    ck_assert_msg(strstr(text, "for each of its 400 statistical checks") != NULL, "%s", text);
    ck_assert_msg(strstr(text, "Of the 3 judged here, the rates of 2 sum to 1.45·10⁻⁵; 1 have") !=
                      NULL,
                  "%s", text);
    text = text_of(words_bits, &s.report);
    ck_assert_str_eq(text,
                     "3 of 4 runs have the bits of their references: unchanged. 1 has others: "
                     "there statistics decide. For 2 more there are none of this class of "
                     "build.");
}
END_TEST

START_TEST(changes_are_what_comparisons_with_references_find) {
    struct sample s;
    sample_fill(&s);
    ck_assert_str_eq(text_of(words_changes, &s.report),
                     "No check here compares with a stored reference.");
    for (int i = 0; i < 3; i++)
        s.first[i].kind = "regression";
    ck_assert_str_eq(text_of(words_changes, &s.report),
                     "Of 3 comparisons with stored references 1 finds no change, 1 finds one, 1 "
                     "cannot tell.");
    sample_know(&s);
    s.first[2].verdict = VERDICT_PASS;
    ck_assert_str_eq(text_of(words_changes, &s.report),
                     "Of 3 comparisons with stored references 2 find no change, 1 finds one that "
                     "is known.");
}
END_TEST

START_TEST(nothing_judged_is_no_pass) {
    struct sample s;
    sample_fill(&s);
    s.report.cases = &s.cases[2]; /* the skipped one */
    s.report.case_count = 1;
    ck_assert_int_eq(report_verdict(&s.report), VERDICT_INCONCLUSIVE);
    ck_assert_str_eq(words_headline(&s.report), "NOTHING JUDGED");
    ck_assert_ptr_null(report_worst(&s.report));
}
END_TEST

START_TEST(margin_is_the_share_of_what_is_allowed) {
    ck_assert_double_eq_tol(used("within", 1.1973, 1.21, .0363), .0127 / .0363, 1e-12);
    ck_assert_double_eq_tol(used("at most", 1.23, 1.21, .05), .4, 1e-12);
    ck_assert_double_eq(used("at most", 1.13, 1.21, .05), 0);
    ck_assert_double_eq_tol(used("at least", 1.19, 1.21, .05), .4, 1e-12);
    ck_assert_double_eq_tol(used("outside", 1.51, 1.21, .06), .2, 1e-12);
    ck_assert_double_eq_tol(used("at most", .031, .05, 0), .62, 1e-12); /* of the limit itself */
    ck_assert_double_eq_tol(used("at least", 25, 8, 0), .32, 1e-12);
    ck_assert(isnan(used("within", (double)NAN, 1.21, .0363)));
}
END_TEST

static double used_share(const char *comparison, double measured, double expected) {
    struct report_row row = row_of(comparison, measured, expected, 0);
    row.unit = "1";
    return report_margin_used(&row);
}

START_TEST(a_share_near_one_has_used_little) {
    ck_assert_double_eq_tol(used_share("at least", .9998, .99), .02, 1e-12);
    ck_assert_double_eq_tol(used_share("at least", .9461, .9), .539, 1e-12);
    ck_assert_double_eq_tol(used_share("at least", .99, .99), 1, 1e-12);
    ck_assert_double_gt(used_share("at least", .97, .99), 1); /* beyond its limit */
    ck_assert_double_eq(used_share("at least", 1.0137, .99), 0);
    ck_assert_double_eq_tol(used_share("at least", 25, 8), .32, 1e-12); /* a count is no share */
    ck_assert_double_eq_tol(used_share("at least", .37, .15), .15 / .37, 1e-12);
    ck_assert_double_eq_tol(used("at least", 1.21, .98, 0), .98 / 1.21, 1e-12); /* has a unit */
}
END_TEST

START_TEST(without_tolerance_only_equality_is_within) {
    ck_assert_double_eq(used("within", 1.37e-6, 1.37e-6, 0), 0);
    ck_assert(isinf(used("within", 1.38e-6, 1.37e-6, 0)));
    ck_assert(isinf(used("at most", 1.37e-6, 0, 0)));
    ck_assert_double_eq(used("at most", -1.37e-6, 0, 0), 0);
    ck_assert(isinf(used("outside", 1.37, 1.37, .1)));
}
END_TEST

START_TEST(the_worst_row_is_a_failed_one_without_a_number) {
    struct sample s;
    sample_fill(&s);
    ck_assert_ptr_eq(report_worst(&s.report), &s.second[0]);
    s.second[0].verdict = VERDICT_PASS; /* no number and no failure: the least interesting */
    ck_assert_ptr_eq(report_worst(&s.report), &s.first[1]);
    s.first[1].verdict = VERDICT_PASS;
    s.first[1].measured = 1.21;
    ck_assert_ptr_eq(report_worst(&s.report), &s.first[2]);
    s.first[0] = row_of("at least", 1048, 1000, 0); /* enough, though "95 %" of it are used */
    ck_assert_ptr_eq(report_worst(&s.report), &s.first[2]);
    s.first[0].verdict = VERDICT_FAIL;
    ck_assert_ptr_eq(report_worst(&s.report), &s.first[0]);
}
END_TEST

START_TEST(an_uncertainty_has_two_digits_and_cuts_the_value) {
    ck_assert_str_eq(words_measured(1.19734, .01234).text, "1.197 ± 0.012");
    ck_assert_str_eq(words_measured(1.19734, .0999).text, "1.20 ± 0.10");
    ck_assert_str_eq(words_measured(18104.37, 123.4).text, "18100 ± 120");
    ck_assert_str_eq(words_measured(1.3712e-6, 3.1e-8).text, "(1.371 ± 0.031)·10⁻⁶");
    ck_assert_str_eq(words_measured(-.56789, 2.5).text, "-0.6 ± 2.5");
    ck_assert_str_eq(words_measured(1.1973456, 0).text, "1.19735");
    ck_assert_str_eq(words_measured(1.1973456, (double)NAN).text, "1.19735");
    ck_assert_str_eq(words_measured((double)NAN, .1).text, "–");
}
END_TEST

START_TEST(numbers_are_short_and_never_rounded_to_a_wrong_decade) {
    ck_assert_str_eq(words_number(0).text, "0");
    ck_assert_str_eq(words_number(1.37e-15).text, "1.37·10⁻¹⁵");
    ck_assert_str_eq(words_number(9.99996e-6).text, "1·10⁻⁵");
    ck_assert_str_eq(words_number(123456.7).text, "123457");
    ck_assert_str_eq(words_number(-2.5e7).text, "-2.5·10⁷");
    ck_assert_str_eq(words_number(-(double)INFINITY).text, "-∞");
    struct report_row row = row_of("within", 1.2, 1.21, .0363);
    ck_assert_str_eq(words_accepted(&row).text, "1.1737 to 1.2463");
    row.comparison = "at most";
    ck_assert_str_eq(words_accepted(&row).text, "≤ 1.2463");
}
END_TEST

static void check_sentence(const struct report *r, const char *expected) {
    char *text;
    size_t size;
    FILE *out = open_memstream(&text, &size);
    words_sentence(out, r);
    fclose(out);
    ck_assert_str_eq(text, expected);
    free(text);
}

START_TEST(one_sentence_says_it_all) {
    struct sample s;
    sample_fill(&s);
    check_sentence(&s.report, "2 of 5 checks fail, in 2 of 2 cases; 1 more cannot be decided; "
                              "1 case was not run.");
    s.first[1].verdict = s.second[0].verdict = VERDICT_PASS;
    check_sentence(&s.report, "No check fails, but 1 of 5 cannot be decided; 1 case was not run.");
    s.first[2].verdict = VERDICT_PASS;
    s.report.case_count = 2;
    check_sentence(&s.report, "All 5 checks of 2 cases pass.");
}
END_TEST

int main(void) {
    const TTest *const tests[] = {rows_are_counted_and_a_failure_decides,
                                  a_known_disagreement_is_counted_and_decides_nothing,
                                  the_budget_and_the_bits_are_told,
                                  changes_are_what_comparisons_with_references_find,
                                  nothing_judged_is_no_pass,
                                  margin_is_the_share_of_what_is_allowed,
                                  a_share_near_one_has_used_little,
                                  without_tolerance_only_equality_is_within,
                                  the_worst_row_is_a_failed_one_without_a_number,
                                  an_uncertainty_has_two_digits_and_cuts_the_value,
                                  numbers_are_short_and_never_rounded_to_a_wrong_decade,
                                  one_sentence_says_it_all,
                                  NULL};
    return unit_run("report", tests);
}
