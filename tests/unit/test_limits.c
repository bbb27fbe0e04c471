/* test_limits.c -- validation/limits.h: what no check can see, of the models in a report. */
#include "tests/unit/report_sample.h"
#include "tests/unit/unit.h"
#include "validation/limits.h"

static enum status add(const char *text, struct report *r, struct arena *a, struct fault *fault) {
    const char *folder = unit_folder();
    if (text != NULL)
        unit_write(unit_path(folder, "limits.yaml"), text);
    enum status status = limits_add(unit_path(folder, "cases"), r, a, fault);
    unit_remove(folder);
    return status;
}

START_TEST(those_of_the_reports_models_are_named_any_last) {
    struct sample s;
    struct arena a = {0};
    struct fault fault = FAULT_NONE;
    sample_fill(&s); /* of graingas and of a hostile name */
    unit_ok(add("limits:\n"
                "  - {model: any, what: experiments, because: none}\n"
                "  - {model: suspension, what: lubrication, because: mean drag}\n"
                "  - {model: graingas, what: friction, because: smooth discs}\n"
                "  - {model: grain, what: part of a name, because: no model}\n",
                &s.report, &a, &fault),
            &fault);
    ck_assert_uint_eq(s.report.limit_count, 2);
    ck_assert_str_eq(s.report.limit[0].what, "friction");
    ck_assert_str_eq(s.report.limit[0].because, "smooth discs");
    ck_assert_str_eq(s.report.limit[1].what, "experiments");
    arena_free(&a);
}
END_TEST

START_TEST(no_file_is_no_limit) {
    struct sample s;
    struct arena a = {0};
    struct fault fault = FAULT_NONE;
    sample_fill(&s);
    unit_ok(add(NULL, &s.report, &a, &fault), &fault);
    ck_assert_uint_eq(s.report.limit_count, 0);
    arena_free(&a);
}
END_TEST

START_TEST(what_is_mistyped_is_refused_with_its_place) {
    static const char *const text[][2] = {
        {"limits:\n  - {model: any, what: '  ', because: x}\n", "limits.yaml:2:24"},
        {"limits:\n  - {model: any, wat: x, because: x}\n", "did you mean 'what'"},
        {"limits: [friction]\n", "limits: each must be"},
        {"limit: []\n", "did you mean 'limits'"}};
    for (size_t i = 0; i < sizeof text / sizeof *text; i++) {
        struct sample s;
        struct arena a = {0};
        struct fault fault = FAULT_NONE;
        sample_fill(&s);
        ck_assert_int_eq(add(text[i][0], &s.report, &a, &fault), STATUS_BAD_INPUT);
        unit_says(&fault, text[i][1]);
        arena_free(&a);
    }
}
END_TEST

int main(void) {
    const TTest *const tests[] = {those_of_the_reports_models_are_named_any_last,
                                  no_file_is_no_limit, what_is_mistyped_is_refused_with_its_place,
                                  NULL};
    return unit_run("limits", tests);
}
