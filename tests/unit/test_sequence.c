/* test_sequence.c -- grains in time as SVG: each where it was, small, well-formed. */
#include "report/draw.h"
#include "tests/unit/sequence_sample.h"
#include "tests/unit/unit.h"

#include <time.h>

static struct sheet drawn(const struct report_sequence *s) {
    struct sheet svg = {0};
    struct fault fault = FAULT_NONE;
    unit_ok(draw_sequence(s, &svg, &fault), &fault);
    return svg;
}

static double number_after(const char *text, const char *mark) {
    const char *at = strstr(text, mark);
    ck_assert_msg(at != NULL, "no %s", mark);
    return strtod(at + strlen(mark), NULL);
}

/* The nearest drawn grain of a colour in one panel: distance in l and its diameter. */
struct nearest {
    double distance, diameter;
    size_t dots;
};

/* `group`: the <g> of a panel; unit: l a drawing unit. */
static struct nearest find(const char *group, const char *end, const char *colour, double unit,
                           const double *at) {
    struct nearest best = {.distance = 1e9};
    char mark[64];
    snprintf(mark, sizeof mark, "<path stroke=\"%s\" stroke-width=\"", colour);
    for (const char *p = group; (p = strstr(p, mark)) != NULL && p < end; p++) {
        double width = number_after(p, "stroke-width=\"");
        long x = 0, y = 0, dx, dy;
        int length;
        const char *d = strstr(p, " d=\"") + 4;
        for (; *d != '"'; d += length, best.dots++) {
            bool signs = sscanf(d, "%*1[Mm]%ld,%ldh0%n", &dx, &dy, &length) == 2 ||
                         sscanf(d, "%*1[Mm]%ld%ldh0%n", &dx, &dy, &length) == 2;
            ck_assert_msg(signs, "no step: %.20s", d);
            x += dx;
            y += dy;
            double away = hypot((double)x * unit - at[0], (double)y * unit - at[1]);
            if (away < best.distance) {
                best.distance = away;
                best.diameter = width * unit;
            }
        }
    }
    return best;
}

START_TEST(every_grain_is_drawn_where_and_as_large_as_it_was) {
    struct sequence_sample s;
    sequence_sample_fill(&s);
    struct sheet svg = drawn(&s.sequence);
    double unit = s.radius[SEQUENCE_GRAINS - 1] / 25; /* sequence.c */
    const char *group = svg.text;
    for (int f = 0; f < SEQUENCE_FRAMES; f++) {
        group = strstr(group + 1, "<g transform");
        ck_assert_ptr_nonnull(group);
        const char *end = strstr(group, "</g>");
        for (int i = 0; i < SEQUENCE_GRAINS; i++) {
            struct nearest n =
                find(group, end, DRAW_KIND_COLOUR[s.kind[i]], unit, &s.position[f][2 * i]);
            ck_assert_uint_eq(n.dots, s.kind[i] ? 2 : 5);
            ck_assert_double_le(n.distance, .72 * unit);
            ck_assert_double_le(fabs(n.diameter - 2 * s.radius[i]), .008); /* half a class */
        }
    }
    ck_assert_ptr_null(strstr(group + 1, "<g transform"));
    ck_assert_ptr_nonnull(strstr(svg.text, ">1.37 tau<"));
    sheet_free(&svg);
}
END_TEST

/* tidy reads XML as strictly as a browser reads an SVG file. */
static void is_well_formed(const struct sheet *svg) {
    const char *folder = unit_folder();
    char command[512];
    unit_write(unit_path(folder, "a.svg"), svg->text);
    snprintf(command, sizeof command, "tidy -xml -q -e '%s'", unit_path(folder, "a.svg"));
    if (system("command -v tidy >/dev/null") == 0)
        ck_assert_int_eq(system(command), 0);
    else
        printf("tidy is not installed: the SVG was not validated\n");
    unit_remove(folder);
}

START_TEST(foreign_text_is_text_and_the_file_is_well_formed) {
    struct sequence_sample s;
    struct sheet poster = {0};
    struct fault fault = FAULT_NONE;
    sequence_sample_fill(&s);
    s.sequence.time_unit = "<t>&";
    struct sheet svg = drawn(&s.sequence);
    ck_assert_ptr_null(strstr(svg.text, "<b>"));
    ck_assert_ptr_null(strstr(svg.text, "<t>"));
    ck_assert_ptr_nonnull(strstr(svg.text, "&lt;b&gt;x"));
    is_well_formed(&svg);
    unit_ok(draw_poster(&s.sequence, &poster, &fault), &fault);
    ck_assert_ptr_nonnull(strstr(poster.text, ">1.37 &lt;t&gt;")); /* the middle frame */
    is_well_formed(&poster);
    sheet_free(&poster);
    sheet_free(&svg);
}
END_TEST

START_TEST(panels_of_any_number_and_shape_stay_on_the_paper) {
    static const double shape[][2] = {{6.3, 9.7}, {97, 6.1}, {2.3, 211}};
    static struct report_frame frame[24];
    struct sequence_sample s;
    sequence_sample_fill(&s);
    s.sequence.frame = frame;
    s.sequence.kind_label[1] = "light layers";
    for (int f = 0; f < 24; f++)
        frame[f] = (struct report_frame){.time = .1 + f, .position = s.position[f % 3]};
    for (size_t n = 1; n <= 24; n++) {
        s.sequence.frame_count = n;
        s.sequence.width = shape[n % 3][0];
        s.sequence.height = shape[n % 3][1];
        struct sheet svg = drawn(&s.sequence);
        double width = number_after(svg.text, " width=\""),
               height = number_after(svg.text, " height=\"");
        size_t panels = 0;
        for (const char *r = svg.text; (r = strstr(r, "<rect x=\"")) != NULL; r++, panels++) {
            double x = number_after(r, "x=\""), y = number_after(r, "y=\"");
            ck_assert_double_ge(x, 0);
            ck_assert_double_ge(y, 0);
            ck_assert_double_le(x + number_after(r, "width=\""), width);
            ck_assert_double_le(y + number_after(r, "height=\""), height);
        }
        ck_assert_uint_eq(panels, n + 3); /* three squares of the key */
        sheet_free(&svg);
    }
}
END_TEST

START_TEST(the_papers_bed_six_times_is_small_and_quick) {
    enum { GRAINS = 18104 };
    static double position[2 * GRAINS], radius[GRAINS];
    static unsigned char kind[GRAINS];
    static struct report_frame frame[6];
    struct sequence_sample s;
    struct timespec from, to;
    sequence_sample_fill(&s);
    for (int i = 0; i < GRAINS; i++) { /* in no order, as after mixing */
        int place = (int)((long)i * 7919 % GRAINS);
        position[2 * i] = .25 + .4488 * (place % 133);
        position[2 * i + 1] = .25 + .4 * (place / 133);
        radius[i] = .175 + .075 * (i * 31 % 1000) / 1000;
        kind[i] = place / 1300 % 2 == 1;
    }
    for (int f = 0; f < 6; f++)
        frame[f] = (struct report_frame){.time = f, .position = position};
    s.sequence.width = 60;
    s.sequence.height = 84;
    s.sequence.count = GRAINS;
    s.sequence.frame_count = 6;
    s.sequence.frame = frame;
    s.sequence.radius = radius;
    s.sequence.kind = kind;
    clock_gettime(CLOCK_MONOTONIC, &from);
    struct sheet svg = drawn(&s.sequence);
    clock_gettime(CLOCK_MONOTONIC, &to);
    ck_assert_uint_lt(svg.length, 1300 * 1000);
    ck_assert_int_lt(to.tv_sec - from.tv_sec, 5); /* about .1 s on a quiet core */
    sheet_free(&svg);
}
END_TEST

static void refused(const struct report_sequence *s, const char *words) {
    struct sheet out = {0};
    struct fault fault = FAULT_NONE;
    ck_assert_int_eq(draw_sequence(s, &out, &fault), STATUS_BAD_INPUT);
    unit_says(&fault, words);
    fault = (struct fault)FAULT_NONE;
    ck_assert_int_eq(draw_animation(s, &out, &fault), STATUS_BAD_INPUT);
    ck_assert_int_eq(draw_poster(s, &out, &fault), STATUS_BAD_INPUT);
}

START_TEST(what_cannot_be_drawn_is_named) {
    struct sequence_sample s;
    sequence_sample_fill(&s);
    s.position[1][9] = (double)NAN;
    refused(&s.sequence, "sequence time-sequence-1: grain 4 has no finite place at 1.37 tau");
    sequence_sample_fill(&s);
    s.kind[3] = 2;
    refused(&s.sequence, "grain 3 has no radius and kind");
    sequence_sample_fill(&s);
    s.radius[2] = 0;
    refused(&s.sequence, "grain 2 has no radius and kind");
    sequence_sample_fill(&s);
    s.frame[2].time = s.frame[1].time;
    refused(&s.sequence, "times do not increase at frame 2");
    sequence_sample_fill(&s);
    s.sequence.count = 0;
    refused(&s.sequence, "0 grains at 3 times");
    sequence_sample_fill(&s);
    s.sequence.frame_count = 0;
    refused(&s.sequence, "7 grains at 0 times");
    sequence_sample_fill(&s);
    s.sequence.height = (double)INFINITY;
    refused(&s.sequence, "no box of 6.3 x inf l");
}
END_TEST

int main(void) {
    const TTest *const tests[] = {every_grain_is_drawn_where_and_as_large_as_it_was,
                                  foreign_text_is_text_and_the_file_is_well_formed,
                                  panels_of_any_number_and_shape_stay_on_the_paper,
                                  the_papers_bed_six_times_is_small_and_quick,
                                  what_cannot_be_drawn_is_named,
                                  NULL};
    return unit_run("sequence", tests);
}
