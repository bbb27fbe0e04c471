/* test_json_report.c -- results.json: strict, complete, a null is explained. */
#include "common/file.h"
#include "common/yaml.h"
#include "tests/unit/report_sample.h"
#include "tests/unit/unit.h"

static char *written(const struct report *r) {
    struct fault fault = FAULT_NONE;
    char *text;
    size_t length;
    const char *folder = unit_folder(), *path = unit_path(folder, "results.json");
    unit_ok(report_write_json(r, path, &fault), &fault);
    unit_ok(file_read(path, 1 << 20, &text, &length, &fault), &fault);
    unit_remove(folder);
    return text;
}

static const char *text_at(const struct yaml_node *map, const char *key) {
    const struct yaml_node *node = yaml_get(map, key);
    ck_assert_msg(node != NULL, "no key %s", key);
    return node->text;
}

START_TEST(every_row_has_every_member) {
    static const char *const members[] = {
        "case",      "point",    "check",       "observable",
        "unit",      "measured", "uncertainty", "expected",
        "tolerance", "kind",     "verdict",     "because",
        "reason",    "runs",     "comparison",  "expected_uncertainty",
        "values",    "seeds",    "detectable",  "alarm_rate",
        "since",     "bits",     "freedom",     "meaning",
        "key"};
    struct sample s;
    struct fault fault = FAULT_NONE;
    struct yaml_document *document;
    sample_fill(&s);
    char *text = written(&s.report);
    unit_ok(yaml_parse("results.json", text, strlen(text), &document, &fault), &fault);
    const struct yaml_node *root = yaml_root(document), *checks = yaml_get(root, "checks");
    ck_assert_str_eq(text_at(root, "schema"), "bedcheck-results 1");
    ck_assert_str_eq(text_at(root, "solver_key"), "3fe91a0c");
    ck_assert_uint_eq(checks->count, 5);
    for (size_t i = 0; i < checks->count; i++) {
        for (size_t k = 0; k < sizeof members / sizeof *members; k++)
            ck_assert_ptr_nonnull(yaml_get(&checks->child[i], members[k]));
    }
    ck_assert_str_eq(text_at(&checks->child[1], "verdict"), "fail");
    ck_assert_uint_eq(yaml_get(&checks->child[1], "runs")->count, 2);
    ck_assert_str_eq(yaml_get(&checks->child[1], "values")->child[1].text, "1.3217000000000001");
    ck_assert_str_eq(yaml_get(&checks->child[1], "seeds")->child[1].text, "1102");
    ck_assert_uint_eq(yaml_get(&checks->child[0], "values")->count, 0);
    ck_assert_str_eq(text_at(&checks->child[1], "detectable"), "0.047300000000000002");
    ck_assert_str_eq(text_at(&checks->child[0], "alarm_rate"), "null");
    ck_assert_str_eq(text_at(&checks->child[3], "case"), SAMPLE_HOSTILE);
    ck_assert_str_eq(text_at(&yaml_get(root, "skipped")->child[0], "reason"), "no time | today");
    yaml_free(document);
    free(text);
}
END_TEST

START_TEST(what_is_no_number_is_null_and_explained) {
    struct sample s;
    struct fault fault = FAULT_NONE;
    struct yaml_document *document;
    sample_fill(&s);
    s.second[0].reason = NULL; /* the judge forgot it */
    char *text = written(&s.report);
    ck_assert_ptr_null(strstr(text, ": nan"));
    ck_assert_ptr_null(strstr(text, ": -nan"));
    unit_ok(yaml_parse("results.json", text, strlen(text), &document, &fault), &fault);
    const struct yaml_node *row = &yaml_get(yaml_root(document), "checks")->child[3];
    ck_assert_str_eq(text_at(row, "measured"), "null");
    ck_assert_str_eq(text_at(row, "reason"), "nothing finite was measured");
    yaml_free(document);
    free(text);
}
END_TEST

START_TEST(a_modified_solver_is_named) {
    struct sample s;
    sample_fill(&s);
    s.report.modified = true;
    s.report.modification = "restitution=0.5";
    char *text = written(&s.report);
    ck_assert_ptr_nonnull(strstr(text, "\"modified\": true"));
    ck_assert_ptr_nonnull(strstr(text, "\"modification\": \"restitution=0.5\""));
    free(text);
}
END_TEST

START_TEST(a_known_disagreement_is_counted_and_dated) {
    struct sample s;
    sample_fill(&s);
    sample_know(&s);
    sample_budget(&s);
    char *text = written(&s.report);
    ck_assert_ptr_nonnull(strstr(text, "\"known\": 1"));
    ck_assert_ptr_nonnull(strstr(text, "\"statistical\": 400"));
    ck_assert_ptr_nonnull(strstr(text, "\"computed\": 1.45"));
    ck_assert_ptr_nonnull(strstr(text, "\"statistical\": true"));
    ck_assert_ptr_nonnull(strstr(text, "\"verdict\": \"known\""));
    ck_assert_ptr_nonnull(strstr(text, "\"since\": \"2026-11-20\""));
    free(text);
}
END_TEST

START_TEST(limits_and_agreement_are_there) {
    struct sample s;
    struct yaml_document *d;
    struct fault fault = FAULT_NONE;
    sample_fill(&s);
    const struct report_limit limit[] = {{"suspension", "\"wakes\"", "no flow"}};
    const char *unselected[] = {"graingas/packed-bed"};
    const struct report_group group[] = {
        {"graingas", 7, 2, .973, (double)NAN, (double)NAN, .0371, .021, .0613, .0119}};
    const struct report_agreement agreement = {
        .group_count = 1, .round_off = 5, .one_sided = 3, .other = 2, .group = group};
    s.report.limit = limit;
    s.report.unselected = unselected;
    s.report.limit_count = s.report.unselected_count = 1;
    s.report.agreement = &agreement;
    char *text = written(&s.report);
    unit_ok(yaml_parse("results.json", text, strlen(text), &d, &fault), &fault);
    const struct yaml_node *root = yaml_root(d), *all = yaml_get(root, "agreement");
    ck_assert_str_eq(text_at(&yaml_get(root, "limits")->child[0], "what"), "\"wakes\"");
    ck_assert_str_eq(yaml_get(root, "unselected")->child[0].text, "graingas/packed-bed");
    const struct yaml_node *first = &yaml_get(all, "groups")->child[0];
    ck_assert_double_eq(strtod(text_at(yaml_get(first, "bias"), "value"), NULL), .973);
    ck_assert_str_eq(text_at(yaml_get(first, "bias"), "low"), "null");
    ck_assert_double_eq(strtod(text_at(yaml_get(first, "scatter"), "high"), NULL), .0613);
    ck_assert_str_eq(text_at(yaml_get(all, "left_out"), "one_sided"), "3");
    yaml_free(d);
    free(text);
}
END_TEST

START_TEST(a_folder_that_is_none_is_a_fault) {
    struct sample s;
    struct fault fault = FAULT_NONE;
    sample_fill(&s);
    ck_assert_int_eq(report_write_json(&s.report, "/dev/null/x/results.json", &fault), STATUS_IO);
    unit_says(&fault, "/dev/null/x/results.json");
}
END_TEST

int main(void) {
    const TTest *const tests[] = {every_row_has_every_member,
                                  what_is_no_number_is_null_and_explained,
                                  a_modified_solver_is_named,
                                  limits_and_agreement_are_there,
                                  a_known_disagreement_is_counted_and_dated,
                                  a_folder_that_is_none_is_a_fault,
                                  NULL};
    return unit_run("json_report", tests);
}
