/* test_spheres_drawn.c -- lit spheres: the nearest in front, hidden ones left out, small files. */
#include "report/draw.h"
#include "tests/unit/unit.h"

#include <math.h>

enum { FEW = 4, MANY = 10000, PANELS = 6 };

static struct report_sequence sequence_of(size_t count, const double *radius,
                                          const unsigned char *kind,
                                          const struct report_frame *frame, size_t frames) {
    return (struct report_sequence){.name = "spheres",
                                    .title = "t",
                                    .alt = "a",
                                    .time_unit = "s",
                                    .length_unit = "R",
                                    .lit = true,
                                    .kind_label = {"low", "2", "3", "4", "high"},
                                    .width = 31.7,
                                    .height = 163,
                                    .count = count,
                                    .frame_count = frames,
                                    .radius = radius,
                                    .kind = kind,
                                    .frame = frame};
}

static struct sheet drawn(const struct report_sequence *s) {
    struct sheet svg = {0};
    struct fault fault = FAULT_NONE;
    unit_ok(draw_sequence(s, &svg, &fault), &fault);
    return svg;
}

/* Spheres in the path of an id, and the first one's place in units of R/20. */
static size_t path(const char *svg, const char *id, long *x, long *y) {
    char mark[64];
    size_t count = 0;
    snprintf(mark, sizeof mark, "<path id=\"%s\" d=\"", id);
    const char *at = strstr(svg, mark);
    if (at == NULL)
        return 0;
    at += strlen(mark);
    ck_assert(sscanf(at, "M%ld,%ldh0", x, y) == 2 || sscanf(at, "M%ld%ldh0", x, y) == 2);
    for (; *at != '"'; at++)
        count += *at == 'h';
    return count;
}

static void fill_few(double position[2 * FEW], double depth[FEW]) {
    static const double place[FEW][3] = {/* x, y, depth */
                                         {7.31, 11.93, 5.17},
                                         {7.31, 11.93, 7.41},   /* behind the first */
                                         {8.73, 12.57, 7.19},   /* half behind it */
                                         {21.37, 14.11, 23.3}}; /* far back, free */
    for (size_t i = 0; i < FEW; i++) {
        position[2 * i] = place[i][0];
        position[2 * i + 1] = place[i][1];
        depth[i] = place[i][2];
    }
}

START_TEST(what_is_hidden_is_left_out_and_the_nearest_is_painted_last) {
    static const double radius[FEW] = {1, 1, 1, 1};
    static const unsigned char kind[FEW] = {3, 1, 1, 0};
    double position[2 * FEW], depth[FEW];
    long x = 0, y = 0;
    fill_few(position, depth);
    struct report_frame frame = {.37, position, depth};
    struct report_sequence s = sequence_of(FEW, radius, kind, &frame, 1);
    struct sheet svg = drawn(&s);
    ck_assert_uint_eq(path(svg.text, "f0-1", &x, &y), 1);
    ck_assert_int_eq(x, lround(20 * 21.37));
    ck_assert_int_eq(y, lround(20 * 14.11));
    ck_assert_uint_eq(path(svg.text, "f0-2", &x, &y), 1);
    ck_assert_int_eq(x, lround(20 * 8.73));
    ck_assert_uint_eq(path(svg.text, "f0-3", &x, &y), 1);
    ck_assert_int_eq(x, lround(20 * 7.31));
    ck_assert_uint_eq(path(svg.text, "f0-4", &x, &y), 0);
    ck_assert_ptr_nonnull(strstr(svg.text, "10 R<"));
    sheet_free(&svg);
}
END_TEST

START_TEST(without_the_one_in_front_the_hidden_one_is_seen) {
    static const double radius[FEW] = {1, 1, 1, 1};
    static const unsigned char kind[FEW] = {3, 1, 1, 0};
    double position[2 * FEW], depth[FEW];
    long x = 0, y = 0;
    fill_few(position, depth);
    position[0] += 9; /* aside */
    struct report_frame frame = {.37, position, depth};
    struct report_sequence s = sequence_of(FEW, radius, kind, &frame, 1);
    struct sheet svg = drawn(&s);
    ck_assert_uint_eq(path(svg.text, "f0-2", &x, &y), 2); /* of one kind, .22 R apart in depth */
    sheet_free(&svg);
}
END_TEST

START_TEST(spheres_need_depths_and_known_kinds) {
    static const double radius[FEW] = {1, 1, 1, 1};
    unsigned char kind[FEW] = {3, 1, 1, REPORT_KINDS};
    double position[2 * FEW], depth[FEW];
    struct fault fault = FAULT_NONE;
    struct sheet svg = {0};
    fill_few(position, depth);
    struct report_frame frame = {.37, position, depth};
    struct report_sequence s = sequence_of(FEW, radius, kind, &frame, 1);
    ck_assert_int_eq(draw_sequence(&s, &svg, &fault), STATUS_BAD_INPUT);
    unit_says(&fault, "grain 3 has no radius and kind");
    kind[3] = 0;
    depth[2] = (double)NAN;
    fault = (struct fault)FAULT_NONE;
    ck_assert_int_eq(draw_sequence(&s, &svg, &fault), STATUS_BAD_INPUT);
    unit_says(&fault, "grain 2 has no finite place");
    frame.depth = NULL;
    fault = (struct fault)FAULT_NONE;
    ck_assert_int_eq(draw_sequence(&s, &svg, &fault), STATUS_BAD_INPUT);
    unit_says(&fault, "no depths in frame 0");
}
END_TEST

/* Of 0 to 1, the same each time. */
static double next(unsigned long long *state) {
    *state = *state * 6364136223846793005ULL + 1442695040888963407ULL;
    return (double)(*state >> 11) / 9007199254740992.;
}

START_TEST(six_panels_of_ten_thousand_stay_small) {
    static double radius[MANY], position[2 * MANY], depth[MANY];
    static unsigned char kind[MANY];
    struct report_frame frame[PANELS];
    unsigned long long state = 20131;
    for (size_t i = 0; i < MANY; i++) {
        radius[i] = 1;
        kind[i] = (unsigned char)(next(&state) * REPORT_KINDS);
        position[2 * i] = 1 + 29.7 * next(&state);
        position[2 * i + 1] = 1 + 153 * next(&state);
        depth[i] = 1 + 28 * next(&state);
    }
    for (size_t f = 0; f < PANELS; f++)
        frame[f] = (struct report_frame){.4 * (double)f, position, depth};
    struct report_sequence s = sequence_of(MANY, radius, kind, frame, PANELS);
    struct sheet svg = drawn(&s);
    ck_assert_uint_le(svg.length, 1500000);
    ck_assert_uint_ge(svg.length, 100000); /* they are there */
    sheet_free(&svg);
}
END_TEST

START_TEST(an_animation_carries_depths_and_five_colours) {
    static const double radius[FEW] = {1, 1, 1, 1};
    static const unsigned char kind[FEW] = {3, 1, 2, 0};
    double position[2 * FEW], depth[FEW];
    struct fault fault = FAULT_NONE;
    struct sheet page = {0};
    fill_few(position, depth);
    struct report_frame frame[2] = {{0, position, depth}, {.31, position, depth}};
    struct report_sequence s = sequence_of(FEW, radius, kind, frame, 2);
    unit_ok(draw_animation(&s, &page, &fault), &fault);
    ck_assert_ptr_nonnull(strstr(page.text, "\"lit\":true"));
    ck_assert_ptr_nonnull(strstr(page.text, "\"unit\":0.0625,"));
    for (size_t k = 0; k < REPORT_KINDS; k++)
        ck_assert_ptr_nonnull(strstr(page.text, DRAW_LIT_COLOUR[k]));
    sheet_free(&page);
}
END_TEST

int main(void) {
    const TTest *const tests[] = {what_is_hidden_is_left_out_and_the_nearest_is_painted_last,
                                  without_the_one_in_front_the_hidden_one_is_seen,
                                  spheres_need_depths_and_known_kinds,
                                  six_panels_of_ten_thousand_stay_small,
                                  an_animation_carries_depths_and_five_colours,
                                  NULL};
    return unit_run("spheres_drawn", tests);
}
