/* test_raster.c -- boxes of grains as small pictures: they are PNG, and show the grains. */
#include "report/draw.h"
#include "tests/unit/sequence_sample.h"
#include "tests/unit/unit.h"

#include <math.h>
#include <stdlib.h>
#include <zlib.h>

struct seen {
    size_t width, height;
    unsigned char palette[256][3], *pixel; /* with a filter byte a row */
};

static size_t number(const unsigned char *at) {
    return (size_t)at[0] << 24 | (size_t)at[1] << 16 | (size_t)at[2] << 8 | at[3];
}

/* Reads every chunk and holds it to its check sum. */
static struct seen read_png(const struct drawing *d) {
    struct seen s = {0};
    const unsigned char *b = (const unsigned char *)d->bytes, *at = b + 8, *end = b + d->length;
    ck_assert_mem_eq(b, "\x89PNG\r\n\x1a\n", 8);
    while (at < end) {
        size_t length = number(at);
        ck_assert_uint_eq(number(at + 8 + length),
                          crc32(crc32(0, NULL, 0), at + 4, (uInt)length + 4));
        if (memcmp(at + 4, "IHDR", 4) == 0) {
            s.width = number(at + 8);
            s.height = number(at + 12);
            ck_assert_mem_eq(at + 16, "\x08\x03\0\0\0", 5);
        } else if (memcmp(at + 4, "PLTE", 4) == 0) {
            memcpy(s.palette, at + 8, sizeof s.palette);
        } else if (memcmp(at + 4, "IDAT", 4) == 0) {
            uLongf room = (uLongf)(s.height * (s.width + 1));
            s.pixel = malloc(room);
            ck_assert_int_eq(uncompress(s.pixel, &room, at + 8, (uLong)length), Z_OK);
            ck_assert_uint_eq(room, s.height * (s.width + 1));
        }
        at += length + 12;
    }
    ck_assert_ptr_nonnull(s.pixel);
    return s;
}

static const unsigned char *colour_at(const struct seen *s, double x, double y, double scale) {
    size_t column = (size_t)(x * scale), row = s->height - 1 - (size_t)(y * scale);
    ck_assert_uint_eq(s->pixel[row * (s->width + 1)], 0);
    return s->palette[s->pixel[row * (s->width + 1) + 1 + column]];
}

static unsigned char draw(const struct report_sequence *s, double scale, struct seen *out) {
    struct drawing d;
    struct fault fault = FAULT_NONE;
    unit_ok(draw_panel(s, 0, scale, &d, &fault), &fault);
    *out = read_png(&d);
    free(d.bytes);
    return 0;
}

START_TEST(discs_are_where_and_as_large_as_they_are) {
    struct sequence_sample s;
    struct seen seen;
    double dark = 0, light = 0, area[2] = {0, 0}, scale = 17;
    sequence_sample_fill(&s);
    draw(&s.sequence, scale, &seen);
    ck_assert_uint_eq(seen.width, 107); /* 6.3 l */
    ck_assert_uint_eq(seen.height, 165);
    for (int i = 0; i < SEQUENCE_GRAINS; i++) {
        const unsigned char *c =
            colour_at(&seen, s.position[0][2 * i], s.position[0][2 * i + 1], scale);
        ck_assert_uint_eq(c[1], s.kind[i] ? 0xff : 0x1d);
        area[s.kind[i]] += M_PI * s.radius[i] * s.radius[i] * scale * scale;
    }
    for (size_t row = 0; row < seen.height; row++) {
        for (size_t k = 1; k <= seen.width; k++) {
            size_t mixture = seen.pixel[row * (seen.width + 1) + k];
            dark += (double)(mixture / 10) / 9;
            light += (double)(mixture % 10) / 9;
        }
    }
    ck_assert_double_eq_tol(dark, area[0], .03 * area[0]);
    ck_assert_double_eq_tol(light, area[1], .03 * area[1]);
    free(seen.pixel);
}
END_TEST

START_TEST(the_nearest_sphere_is_seen_lit_from_the_upper_left) {
    static const double radius[] = {1, 1, 1}, position[] = {3.1, 2.7, 3.1, 2.7, 7.3, 3.9};
    static const double depth[] = {9.7, 1.3, 61.3};
    static const unsigned char kind[] = {4, 1, 4};
    struct seen seen;
    struct report_frame frame = {0, position, depth};
    struct report_sequence s = {.name = "few",
                                .lit = true,
                                .width = 10.7,
                                .height = 6.3,
                                .count = 3,
                                .frame_count = 1,
                                .radius = radius,
                                .kind = kind,
                                .frame = &frame};
    draw(&s, 13, &seen);
    const unsigned char *c = colour_at(&seen, 3.1, 2.7, 13);
    ck_assert_uint_gt(c[2], c[0]); /* kind 1 is blue, and hides kind 4, which is yellow */
    const unsigned char *lit = colour_at(&seen, 2.7, 3.1, 13),
                        *dark = colour_at(&seen, 3.7, 2.0, 13);
    ck_assert_uint_gt(lit[1], dark[1] + 60);
    const unsigned char *far = colour_at(&seen, 7.3, 3.9, 13);
    ck_assert(far[0] > far[2] && far[0] < 0xc0); /* yellow, and darker for its depth */
    ck_assert_uint_eq(colour_at(&seen, 9.9, .4, 13)[0], 0xee);
    free(seen.pixel);
}
END_TEST

START_TEST(the_papers_bed_is_small) {
    enum { GRAINS = 18104 };
    struct drawing d;
    struct fault fault = FAULT_NONE;
    double *radius = calloc(GRAINS, sizeof *radius), *place = calloc(2 * GRAINS, sizeof *place);
    unsigned char *kind = calloc(GRAINS, 1);
    for (int i = 0; i < GRAINS; i++) {
        radius[i] = .2 + .0113 * (i % 9);
        kind[i] = (unsigned char)(i / 2500 % 2);
        place[2 * i] = .23 + .47 * (i % 127) + .01 * (i % 7);
        place[2 * i + 1] = .23 + .46 * (i / 127) + .01 * (i % 5);
    }
    struct report_frame frame = {.time = 0, .position = place};
    struct report_sequence s = {.name = "bed",
                                .width = 60,
                                .height = 84,
                                .count = GRAINS,
                                .frame_count = 1,
                                .radius = radius,
                                .kind = kind,
                                .frame = &frame};
    unit_ok(draw_panel(&s, 0, 6, &d, &fault), &fault);
    ck_assert_uint_lt(d.length, 90 * 1000);
    free(d.bytes);
    free(radius);
    free(place);
    free(kind);
}
END_TEST

int main(void) {
    const TTest *const tests[] = {discs_are_where_and_as_large_as_they_are,
                                  the_nearest_sphere_is_seen_lit_from_the_upper_left,
                                  the_papers_bed_is_small, NULL};
    return unit_run("raster", tests);
}
