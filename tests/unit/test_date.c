/* test_date.c -- common/date.h: days that there are, written one way. */
#include "common/date.h"
#include "tests/unit/unit.h"

START_TEST(a_day_is_written_one_way) {
    static const char *const days[] = {"2026-11-22", "2028-02-29", "2000-01-01"};
    static const char *const others[] = {
        "2026-2-03", "2026-11-22 ", " 2026-11-22", "22.11.2026", "2026-11-22T", "2026-11", ""};
    for (size_t i = 0; i < sizeof days / sizeof *days; i++)
        ck_assert_msg(date_is_day(days[i]), "%s", days[i]);
    for (size_t i = 0; i < sizeof others / sizeof *others; i++)
        ck_assert_msg(!date_is_day(others[i]), "%s", others[i]);
}
END_TEST

START_TEST(a_day_that_is_not_in_the_calendar_is_none) {
    static const char *const none[] = {"2026-02-29", "2026-02-31", "2026-13-01", "2026-00-10",
                                       "2026-06-31", "2026-11-00", "1026-11-22"};
    for (size_t i = 0; i < sizeof none / sizeof *none; i++)
        ck_assert_msg(!date_is_day(none[i]), "%s", none[i]);
}
END_TEST

int main(void) {
    const TTest *tests[] = {a_day_is_written_one_way, a_day_that_is_not_in_the_calendar_is_none,
                            NULL};
    return unit_run("date", tests);
}
