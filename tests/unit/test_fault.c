/* test_fault.c -- common/fault.h. */
#include "tests/unit/unit.h"

START_TEST(findings_are_lines_and_the_first_status_stays) {
    struct fault fault = FAULT_NONE;
    fault_add(&fault, STATUS_NOT_FOUND, "%s:%d: gone", "a.yaml", 7);
    enum status status = fault_add(&fault, STATUS_IO, "disk");
    ck_assert_int_eq(status, STATUS_NOT_FOUND);
    ck_assert_int_eq(fault.findings, 2);
    ck_assert_str_eq(fault.text, "a.yaml:7: gone\ndisk");
    ck_assert_int_eq(fault_set(&fault, STATUS_NUMERICAL, "NaN in step %d", 4711), STATUS_NUMERICAL);
    ck_assert_str_eq(fault.text, "NaN in step 4711");
    ck_assert_int_eq(fault.findings, 1);
}
END_TEST

START_TEST(context_goes_in_front_and_own_text_may_be_an_argument) {
    struct fault fault = FAULT_NONE;
    fault_set(&fault, STATUS_IO, "full");
    ck_assert_int_eq(fault_within(&fault, "run %s", "x-s1101"), STATUS_IO);
    ck_assert_str_eq(fault.text, "run x-s1101: full");
    fault_set(&fault, STATUS_IO, "[%s]", fault.text);
    ck_assert_str_eq(fault.text, "[run x-s1101: full]");
}
END_TEST

START_TEST(a_flood_of_findings_is_cut_but_counted) {
    struct fault fault = FAULT_NONE;
    for (int i = 0; i < 1373; i++)
        fault_add(&fault, STATUS_BAD_INPUT, "finding number %d of many", i);
    ck_assert_int_eq(fault.findings, 1373);
    ck_assert_uint_lt(strlen(fault.text), FAULT_TEXT_SIZE);
    fault_within(&fault, "file");
    ck_assert_uint_lt(strlen(fault.text), FAULT_TEXT_SIZE);
    unit_says(&fault, "file: finding number 0");
}
END_TEST

START_TEST(exit_codes_tell_own_trouble_from_numerical_faults) {
    ck_assert_int_eq(fault_exit_code(STATUS_OK), 0);
    ck_assert_int_eq(fault_exit_code(STATUS_NUMERICAL), 1);
    ck_assert_int_eq(fault_exit_code(STATUS_BAD_INPUT), 2);
    ck_assert_int_eq(fault_exit_code(STATUS_NO_MEMORY), 2);
    ck_assert_int_eq(fault_exit_code(STATUS_INTERRUPTED), 130);
}
END_TEST

int main(void) {
    const TTest *const tests[] = {findings_are_lines_and_the_first_status_stays,
                                  context_goes_in_front_and_own_text_may_be_an_argument,
                                  a_flood_of_findings_is_cut_but_counted,
                                  exit_codes_tell_own_trouble_from_numerical_faults, NULL};
    return unit_run("fault", tests);
}
