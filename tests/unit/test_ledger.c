/* test_ledger.c -- report/ledger.h in all outputs: verdicts, measured values, hostile names. */
#include "common/file.h"
#include "report/ledger.h"
#include "tests/unit/report_sample.h"
#include "tests/unit/unit.h"

struct stage {
    struct sample s;
    size_t row[3];
    struct report_claim_test test[3];
    struct report_claim claim[3];
    struct report_ledger ledger;
};

static void set_up(struct stage *g) {
    sample_fill(&g->s);
    for (size_t i = 0; i < 3; i++)
        g->row[i] = i;
    g->test[0] = (struct report_claim_test){.case_name = "graingas/sedimentation",
                                            .check = "own law",
                                            .points = "height_l 64 82",
                                            .wants_pass = true,
                                            .result = CLAIM_CONTRARY,
                                            .in = &g->s.cases[0],
                                            .row_count = 3,
                                            .row = g->row};
    g->test[1] = (struct report_claim_test){.case_name = SAMPLE_HOSTILE,
                                            .check = SAMPLE_HOSTILE,
                                            .points = "",
                                            .result = CLAIM_MISSING,
                                            .missing = SAMPLE_HOSTILE};
    g->test[2] = g->test[0];
    g->test[2].row_count = 1;
    g->test[2].result = CLAIM_AS_SAID;
    for (size_t i = 0; i < 3; i++)
        g->claim[i] = (struct report_claim){.id = i == 0   ? "a-1"
                                                  : i == 1 ? "b-2"
                                                           : "c-3",
                                            .paper = "MFM",
                                            .where = SAMPLE_HOSTILE,
                                            .says = SAMPLE_HOSTILE,
                                            .because = SAMPLE_HOSTILE,
                                            .reason = SAMPLE_HOSTILE};
    g->claim[0].verdict = CLAIM_NOT_REPRODUCED;
    g->claim[0].stored = "reproduced";
    g->claim[0].is_tested = true;
    g->claim[0].test = g->test;
    g->claim[0].test_count = 2;
    g->claim[1].verdict = CLAIM_WRONG;
    g->claim[1].proof = "S2";
    g->claim[2].verdict = CLAIM_REPRODUCED;
    g->claim[2].is_tested = true;
    g->claim[2].reading = SAMPLE_HOSTILE;
    g->claim[2].test = &g->test[2];
    g->claim[2].test_count = 1;
    g->ledger = (struct report_ledger){3, g->claim};
    g->s.report.ledger = &g->ledger;
}

static char *written(enum status (*write)(const struct report *, const char *, struct fault *),
                     const struct report *r, const char *path, const char *file) {
    struct fault fault = FAULT_NONE;
    char *text;
    size_t length;
    unit_ok(write(r, path, &fault), &fault);
    unit_ok(file_read(file, 1 << 24, &text, &length, &fault), &fault);
    return text;
}

static void has(const char *text, const char *part) {
    ck_assert_msg(strstr(text, part) != NULL, "expected '%s' in %.4000s", part, text);
}

START_TEST(the_page_shows_verdicts_and_what_was_measured) {
    struct stage g;
    set_up(&g);
    const char *folder = unit_folder();
    char *text = written(report_write_html, &g.s.report, folder, unit_path(folder, "index.html"));
    const char *part = strstr(text, "<section id=\"claims\">");
    ck_assert_ptr_nonnull(part);
    has(part, "<strong>1</strong> wrong in the paper");
    has(part, "<strong>0</strong> not tested");
    has(part, "<tr id=\"claim-a-1\">");
    has(part, "not reproduced</span><br><span class=\"caption\">stored: reproduced</span>");
    has(part, "none stored");
    has(part, "[height_l 64 82]: 1.197 to 1.314 U0 at 3 points, contrary");
    has(part, "1.197 ± 0.012 U0 (");
    has(part, "Proof: docs/theory.md, section S2.");
    ck_assert_ptr_null(strstr(text, "<b>x"));
    free(text);
    unit_remove(folder);
}
END_TEST

START_TEST(claims_without_a_verdict_are_folded_behind_the_others) {
    struct stage g;
    set_up(&g);
    g.claim[0].verdict = CLAIM_NOT_TESTED;
    const char *folder = unit_folder();
    char *text = written(report_write_html, &g.s.report, folder, unit_path(folder, "index.html"));
    const char *fold = strstr(text, "<summary>1 claim that this run does not test</summary>");
    ck_assert_ptr_nonnull(fold);
    has(fold, "<tr id=\"claim-a-1\">");
    ck_assert_ptr_null(strstr(fold, "wrong in the paper</span>"));
    free(text);
    unit_remove(folder);
}
END_TEST

START_TEST(the_summary_counts_and_tells_a_change) {
    struct stage g;
    set_up(&g);
    const char *folder = unit_folder(), *path = unit_path(folder, "summary.md");
    char *text = written(report_write_markdown, &g.s.report, path, path);
    has(text, "Claims of the papers: 1 reproduced, 1 not reproduced, 0 underdetermined, 1 wrong in "
              "the paper, 0 undecided, 0 not tested.");
    has(text, "Claim a-1: not reproduced, stored as reproduced: ");
    ck_assert_ptr_null(strstr(text, "Claim c-3"));
    ck_assert_ptr_null(strstr(text, "<b>x"));
    free(text);
    unit_remove(folder);
}
END_TEST

START_TEST(results_have_every_claim) {
    struct stage g;
    set_up(&g);
    const char *folder = unit_folder(), *path = unit_path(folder, "results.json");
    char *text = written(report_write_json, &g.s.report, path, path);
    has(text, "\"id\": \"c-3\"");
    has(text, "\"verdict\": \"not reproduced\"");
    has(text, "\"stored\": \"reproduced\"");
    has(text, "\"result\": \"missing\"");
    has(text, "1.3137");
    free(text);
    g.s.report.ledger = NULL;
    text = written(report_write_json, &g.s.report, path, path);
    has(text, "\"claims\": []");
    free(text);
    unit_remove(folder);
}
END_TEST

START_TEST(names_of_verdicts_are_read_again) {
    for (enum claim_verdict v = 0; v < CLAIM_VERDICTS; v++) {
        enum claim_verdict again = CLAIM_VERDICTS;
        ck_assert(claim_verdict_find(claim_verdict_name(v), &again));
        ck_assert_int_eq(again, v);
    }
    enum claim_verdict none;
    ck_assert(!claim_verdict_find("Reproduced", &none));
}
END_TEST

int main(void) {
    const TTest *const tests[] = {the_page_shows_verdicts_and_what_was_measured,
                                  claims_without_a_verdict_are_folded_behind_the_others,
                                  the_summary_counts_and_tells_a_change,
                                  results_have_every_claim,
                                  names_of_verdicts_are_read_again,
                                  NULL};
    return unit_run("ledger", tests);
}
