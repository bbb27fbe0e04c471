/* test_picture.c -- grain pictures: palette PNG, small and fast at the paper's size. */
#include "report/draw.h"
#include "tests/unit/report_sample.h"
#include "tests/unit/unit.h"

#include <time.h>

enum { COLOUR_TYPE = 25, PALETTE = 3 }; /* byte of a PNG file; its value */

static unsigned big_endian(const char *bytes) {
    const unsigned char *b = (const unsigned char *)bytes;
    return (unsigned)b[0] << 24 | (unsigned)b[1] << 16 | (unsigned)b[2] << 8 | (unsigned)b[3];
}

START_TEST(the_size_is_that_of_the_box) {
    struct sample s;
    struct drawing d;
    struct fault fault = FAULT_NONE;
    sample_fill(&s);
    s.picture.width = 60;
    s.picture.height = 92;
    unit_ok(draw_picture(&s.picture, 8, &d, &fault), &fault);
    ck_assert_int_eq(memcmp(d.bytes, "\x89PNG\r\n", 6), 0);
    ck_assert_int_eq(d.bytes[COLOUR_TYPE], PALETTE);
    ck_assert_uint_eq(big_endian(d.bytes + 16), (unsigned)d.width_px);
    ck_assert_uint_eq(big_endian(d.bytes + 20), (unsigned)d.height_px);
    ck_assert_int_gt(d.width_px, 60 * 8);
    ck_assert_int_gt(d.height_px, 92 * 8);
    free(d.bytes);
}
END_TEST

START_TEST(small_and_huge_boxes_stay_legible) {
    struct sample s;
    struct drawing d;
    struct fault fault = FAULT_NONE;
    sample_fill(&s);
    s.picture.shade = NULL;
    unit_ok(draw_picture(&s.picture, 12, &d, &fault), &fault); /* 5.3 x 2.1 l */
    ck_assert_int_gt(d.width_px, 400);
    free(d.bytes);
    s.picture.width = 1.3e5;
    s.picture.height = 7e4;
    unit_ok(draw_picture(&s.picture, 12, &d, &fault), &fault);
    ck_assert_int_le(d.width_px, DRAW_MAX_PX);
    free(d.bytes);
}
END_TEST

START_TEST(the_papers_bed_is_drawn_within_seconds) {
    enum { GRAINS = 18104 };
    static double x[GRAINS], y[GRAINS], radius[GRAINS], shade[GRAINS];
    struct sample s;
    struct drawing d;
    struct fault fault = FAULT_NONE;
    struct timespec from, to;
    sample_fill(&s);
    for (int i = 0; i < GRAINS; i++) {
        x[i] = .25 + .4488 * (i % 133);
        y[i] = .25 + .4 * (i / 133);
        radius[i] = .175 + .075 * (i * 7919 % 1000) / 1000;
        shade[i] = (i * 104729 % 1009) / 1009.;
    }
    s.picture = (struct report_picture){"bed", "Bed", "",     "",    60,      92, GRAINS,
                                        x,     y,     radius, shade, "layer", 0,  1};
    clock_gettime(CLOCK_MONOTONIC, &from);
    unit_ok(draw_picture(&s.picture, DRAW_INLINE_PX_PER_L, &d, &fault), &fault);
    clock_gettime(CLOCK_MONOTONIC, &to);
    ck_assert_uint_lt(d.length, 600 * 1000);
    ck_assert_int_lt(to.tv_sec - from.tv_sec, 10); /* about .5 s on a quiet core */
    free(d.bytes);
}
END_TEST

START_TEST(grains_without_a_finite_place_are_refused) {
    struct sample s;
    struct drawing d;
    struct fault fault = FAULT_NONE;
    sample_fill(&s);
    s.y[2] = (double)NAN;
    ck_assert_int_eq(draw_picture(&s.picture, 8, &d, &fault), STATUS_BAD_INPUT);
    unit_says(&fault, "picture snapshot: grain 2 has no finite place");
    s.y[2] = 1.37;
    s.picture.height = 0;
    ck_assert_int_eq(draw_picture(&s.picture, 8, &d, &fault), STATUS_BAD_INPUT);
    s.picture.height = 2.1;
    s.picture.shade_label = "a\x07";
    ck_assert_int_eq(draw_picture(&s.picture, 8, &d, &fault), STATUS_BAD_INPUT);
}
END_TEST

START_TEST(an_empty_box_is_drawn_too) {
    struct sample s;
    struct drawing d;
    struct fault fault = FAULT_NONE;
    sample_fill(&s);
    s.picture.count = 0;
    unit_ok(draw_picture(&s.picture, 8, &d, &fault), &fault);
    free(d.bytes);
}
END_TEST

int main(void) {
    const TTest *const tests[] = {the_size_is_that_of_the_box,
                                  small_and_huge_boxes_stay_legible,
                                  the_papers_bed_is_drawn_within_seconds,
                                  grains_without_a_finite_place_are_refused,
                                  an_empty_box_is_drawn_too,
                                  NULL};
    return unit_run("picture", tests);
}
