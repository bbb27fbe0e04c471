/* test_figure.c -- figures: nothing foreign is executed, nothing measured is hidden. */
#include "report/draw.h"
#include "report/gnuplot.h"
#include "tests/unit/report_sample.h"
#include "tests/unit/unit.h"

#include <sys/stat.h>

static size_t occurrences(const char *text, const char *part) {
    size_t count = 0;
    for (const char *s = text; (s = strstr(s, part)) != NULL; s += strlen(part))
        count++;
    return count;
}

static void draw(const struct report_figure *f, const char *prefix, struct sheet *svg) {
    struct fault fault = FAULT_NONE;
    unit_ok(draw_figure(f, prefix, svg, &fault), &fault);
}

START_TEST(labels_are_shown_and_not_executed) {
    struct sample s;
    struct sheet svg;
    char label[256];
    const char *folder = unit_folder();
    sample_fill(&s);
    snprintf(label, sizeof label, "<i>'; system('touch %s/a') `touch %s/b` \" @x %%s \\n", folder,
             folder);
    s.series[1].label = s.figure[0].x_label = s.panel[0].y_label = label;
    draw(&s.figure[0], "f-", &svg);
    ck_assert_ptr_nonnull(strstr(svg.text, "&lt;i>'; system('touch"));
    ck_assert_ptr_nonnull(strstr(svg.text, "_a^2 {/*}")); /* no markup of gnuplot's own */
    ck_assert_int_ne(access(unit_path(folder, "a"), F_OK), 0);
    ck_assert_int_ne(access(unit_path(folder, "b"), F_OK), 0);
    sheet_free(&svg);
    unit_remove(folder);
}
END_TEST

START_TEST(control_characters_are_refused_with_the_figure_named) {
    struct sample s;
    struct sheet svg;
    struct fault fault = FAULT_NONE;
    sample_fill(&s);
    s.series[1].label = "a\nset output '/tmp/x'";
    ck_assert_int_eq(draw_figure(&s.figure[0], "f-", &svg, &fault), STATUS_BAD_INPUT);
    unit_says(&fault, "figure curve: label of a series: control characters");
    s.series[1].label = "\xc3(";
    ck_assert_int_eq(draw_figure(&s.figure[0], "f-", &svg, &fault), STATUS_BAD_INPUT);
}
END_TEST

START_TEST(every_id_begins_with_the_prefix) {
    struct sample s;
    struct sheet svg;
    sample_fill(&s);
    draw(&s.figure[0], "figure7-", &svg);
    size_t ids = occurrences(svg.text, " id='") + occurrences(svg.text, " id=\"");
    ck_assert_uint_ge(ids, 3);
    ck_assert_uint_eq(ids, occurrences(svg.text, " id='figure7-") +
                               occurrences(svg.text, " id=\"figure7-"));
    ck_assert_uint_eq(occurrences(svg.text, "href='#"), occurrences(svg.text, "href='#figure7-"));
    ck_assert_ptr_nonnull(strstr(svg.text, "<desc id=\"figure7-desc\">Alternative text.</desc>"));
    ck_assert_uint_eq(occurrences(svg.text, "<title>"), 1);
    sheet_free(&svg);
}
END_TEST

START_TEST(a_measured_point_outside_of_given_limits_is_drawn) {
    struct sample s;
    struct sheet svg;
    sample_fill(&s);
    s.figure[0].panel_count = 1;
    s.panel[0].y_min = 1.1; /* two of the four points lie below */
    s.panel[0].y_max = 1.3;
    draw(&s.figure[0], "f-", &svg);
    /* discs are gnuplot's mark 6: its definition apart, four points and one in the key */
    ck_assert_uint_eq(occurrences(svg.text, "<use href='#f-gpPt6' x="), 5);
    sheet_free(&svg);
}
END_TEST

START_TEST(a_line_of_one_point_is_drawn_as_a_mark) {
    struct sample s;
    struct sheet svg;
    sample_fill(&s);
    s.figure[0].panel_count = 1;
    s.series[1].style = SERIES_LINE;
    s.series[1].count = 1;
    draw(&s.figure[0], "f-", &svg);
    /* crosses are gnuplot's mark 1: the point and one in the key */
    ck_assert_uint_eq(occurrences(svg.text, "<use href='#f-gpPt0' x="), 2);
    sheet_free(&svg);
}
END_TEST

START_TEST(what_cannot_be_drawn_leaves_a_legible_figure) {
    struct sample s;
    struct sheet svg;
    sample_fill(&s);
    s.panel[0].y_log = true;
    s.y[1] = -1.37; /* no place on a logarithmic axis */
    s.error[2] = 9; /* reaches below it */
    s.error[3] = (double)NAN;
    draw(&s.figure[0], "f-", &svg);
    ck_assert_ptr_null(strstr(svg.text, "nan"));
    sheet_free(&svg);
    for (int i = 0; i < 4; i++)
        s.x[i] = (double)NAN;
    draw(&s.figure[0], "f-", &svg);
    ck_assert_uint_eq(occurrences(svg.text, "no data"), 2);
    sheet_free(&svg);
}
END_TEST

START_TEST(the_same_figure_has_the_same_bytes) {
    struct sample s;
    struct sheet one, two;
    sample_fill(&s);
    draw(&s.figure[0], "f-", &one);
    draw(&s.figure[0], "f-", &two);
    ck_assert_str_eq(one.text, two.text);
    sheet_free(&one);
    sheet_free(&two);
}
END_TEST

START_TEST(no_gnuplot_is_said_clearly) {
    struct sample s;
    struct sheet svg;
    struct fault fault = FAULT_NONE;
    const char *folder = unit_folder();
    sample_fill(&s);
    setenv("PATH", folder, 1);
    ck_assert_int_eq(draw_figure(&s.figure[0], "f-", &svg, &fault), STATUS_NOT_FOUND);
    unit_says(&fault, "gnuplot is not installed");
    unit_says(&fault, "ci/setup");
    setenv("PATH", "/usr/bin:/bin", 1);
    unit_remove(folder);
}
END_TEST

/* It reads none of its script and says why: no signal, no hang, its words in the fault. */
START_TEST(a_gnuplot_that_fails_is_quoted) {
    struct sample s;
    struct sheet svg;
    struct fault fault = FAULT_NONE;
    const char *folder = unit_folder(), *fake = unit_path(folder, "gnuplot");
    sample_fill(&s);
    unit_write(fake, "#!/bin/sh\necho 'no font, sorry' >&2\nexit 3\n");
    ck_assert_int_eq(chmod(fake, 0700), 0);
    setenv("PATH", folder, 1);
    ck_assert_int_eq(draw_figure(&s.figure[0], "f-", &svg, &fault), STATUS_IO);
    unit_says(&fault, "exit code 3: no font, sorry");
    setenv("PATH", "/usr/bin:/bin", 1);
    unit_remove(folder);
}
END_TEST

START_TEST(names_stand_on_the_axis_once_and_long_ones_are_cut) {
    static const char *const name[] = {"as it is", "no guard's <here>",
                                       "0.35 to 0.30, and more words", "b"};
    struct sample s;
    struct sheet svg;
    sample_fill(&s);
    s.figure[0].x_name = name;
    s.figure[0].x_name_count = 4;
    for (int i = 0; i < 4; i++)
        s.x[i] = i % 3;
    draw(&s.figure[0], "f-", &svg);
    ck_assert_uint_eq(occurrences(svg.text, ">as it is<"), 1);
    ck_assert_uint_eq(occurrences(svg.text, "no guard&#39;s &lt;here&gt;") +
                          occurrences(svg.text, "no guard's &lt;here>"),
                      1);
    ck_assert_uint_eq(occurrences(svg.text, "0.35 to 0.30, and more…"), 1);
    ck_assert_uint_eq(occurrences(svg.text, "rotate(-27)"),
                      8); /* in both panels, above without words */
    sheet_free(&svg);
}
END_TEST

int main(void) {
    const TTest *const tests[] = {labels_are_shown_and_not_executed,
                                  control_characters_are_refused_with_the_figure_named,
                                  every_id_begins_with_the_prefix,
                                  names_stand_on_the_axis_once_and_long_ones_are_cut,
                                  a_measured_point_outside_of_given_limits_is_drawn,
                                  a_line_of_one_point_is_drawn_as_a_mark,
                                  what_cannot_be_drawn_leaves_a_legible_figure,
                                  the_same_figure_has_the_same_bytes,
                                  no_gnuplot_is_said_clearly,
                                  a_gnuplot_that_fails_is_quoted,
                                  NULL};
    return unit_run("figure", tests);
}
