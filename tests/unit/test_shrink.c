/* test_shrink.c -- gnuplot's SVG in fewer bytes, and still the same drawing. */
#include "report/sheet.h"
#include "report/shrink.h"
#include "tests/unit/unit.h"

#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

static char shrunk[4096];

static const char *shrink(const char *body) {
    struct sheet s = {0};
    struct fault fault = FAULT_NONE;
    unit_ok(sheet_open(&s, &fault), &fault);
    shrink_svg(s.out, body, "p7-");
    unit_ok(sheet_close(&s, &fault), &fault);
    ck_assert_uint_lt(s.length, sizeof shrunk);
    memcpy(shrunk, s.text, s.length + 1);
    sheet_free(&s);
    return shrunk;
}

START_TEST(paths_are_relative_and_do_not_drift) {
    ck_assert_str_eq(shrink("<path d='M107.99,408.19 L105.18,408.19 M107.99,403.43 L107.99,400.06 "
                            "L97.31,397.43 z'/>"),
                     "<path d='M108 408.2h-2.8M108 403.4v-3.3l-10.7-2.7z'/>");
    char body[4096] = "<path d='M0.04,0.00";
    for (int i = 1; i <= 100; i++)
        sprintf(body + strlen(body), " L%.2f,%.2f", i * 1.04 + .04, i * .33);
    strcat(body, "'/>");
    const char *at = strstr(shrink(body), "M0 0") + 4;
    double x = 0, y = 0;
    for (char *end; *at == 'l' || *at == 'h'; at = end) {
        bool both = *at == 'l';
        x += strtod(at + 1, &end);
        y += both ? strtod(end, &end) : 0;
    }
    ck_assert_double_eq_tol(x, 104.04, .051);
    ck_assert_double_eq_tol(y, 33, .051);
}
END_TEST

START_TEST(empty_groups_and_defaults_go) {
    ck_assert_str_eq(
        shrink("<g >\n<g stroke-linecap=\"butt\" stroke=\"rgb(  0, 114, 178)\">\n</g>\n"
               "<g color=\"black\" stroke-width=\"1.00\"><title>plot_1</title>"
               "<rect id='x' class=\"c\" width=\"3\"/></g></g>"),
        "<g><g><rect width='3'/></g>\n</g>\n");
}
END_TEST

START_TEST(points_share_a_group_and_only_their_symbols_stay) {
    const char *out =
        shrink("<defs><circle id='gpPt5' r='1'/><use xlink:href='#gpPt5' id='gpPt6' fill='x'/>"
               "<path id='gpPt7' d='M0,-1.33 L1,1 z'/></defs><g >"
               "<use xlink:href='#gpPt6' transform='translate(125.70,486.01) scale(2.50)' "
               "color='rgb(213,  94,   0)'/>\n"
               "<use xlink:href='#gpPt6' transform='translate(125.71,486.01) scale(2.50)' "
               "color='rgb(213,  94,   0)'/>\n"
               "<use xlink:href='#gpPt6' transform='translate(10.00,5.00) scale(2.50)' "
               "color='rgb(213,  94,   0)'/>\n"
               "<use xlink:href='#gpPt6' transform='translate(10.00,5.00) scale(2.50)' "
               "color='rgb(0,  94,   0)'/>\n</g>");
    ck_assert_str_eq(out, "<defs><circle id='p7-gpPt5' r='1'/>"
                          "<use xlink:href='#p7-gpPt5' id='p7-gpPt6' fill='x'/></defs>\n"
                          "<g><g transform='scale(2.5)' color='#d55e00'>"
                          "<use href='#p7-gpPt6' x='50.28' y='194.4'/>"
                          "<use href='#p7-gpPt6' x='4' y='2'/></g>\n"
                          "<g transform='scale(2.5)' color='#005e00'>"
                          "<use href='#p7-gpPt6' x='4' y='2'/></g>\n</g>\n");
}
END_TEST

START_TEST(bands_are_read_with_spaces_around_their_equals_signs) {
    ck_assert_str_eq(shrink("<polygon fill = 'rgb(0, 114, 178)' fill-opacity = '0.200000' "
                            "points = '107.99,423.82 115.61,424.85 '/>"),
                     "<polygon fill='#0072b2' fill-opacity='.2' points='108,423.8 115.6,424.9 '/>");
}
END_TEST

START_TEST(words_stay_as_they_are) {
    const char *text = "<text>a  id='x' L1,2 &lt;use href='#gp'/&gt;  <tspan dy='-7.5px'>-5</tspan>"
                       "</text>";
    ck_assert_str_eq(shrink(text), text);
}
END_TEST

START_TEST(broken_files_end) {
    shrink("<g");
    shrink("<path d='M1,2 L");
    shrink("<text>never ends");
    shrink("</g></g><g><g>");
    shrink("<use xlink:href=");
}
END_TEST

int main(void) {
    const TTest *const tests[] = {paths_are_relative_and_do_not_drift,
                                  empty_groups_and_defaults_go,
                                  points_share_a_group_and_only_their_symbols_stay,
                                  words_stay_as_they_are,
                                  bands_are_read_with_spaces_around_their_equals_signs,
                                  broken_files_end,
                                  NULL};
    return unit_run("shrink", tests);
}
