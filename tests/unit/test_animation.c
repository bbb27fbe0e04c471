/* test_animation.c -- the page with the player: its data are the grains, and it loads nothing. */
#include "common/random.h"
#include "report/draw.h"
#include "tests/unit/sequence_sample.h"
#include "tests/unit/unit.h"

#include <stdlib.h>
#include <zlib.h>

static struct sheet drawn(const struct report_sequence *s) {
    struct sheet page = {0};
    struct fault fault = FAULT_NONE;
    unit_ok(draw_animation(s, &page, &fault), &fault);
    return page;
}

static int digit(char c) {
    static const char all[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    const char *at = strchr(all, c);
    ck_assert_msg(at != NULL && c != '\0', "'%c' is no digit", c);
    return (int)(at - all);
}

/* Decode base64 up to the first '<' or newline: bytes[0 .. return-1]. */
static size_t decode(const char *text, unsigned char *bytes, size_t room) {
    size_t length = strcspn(text, "<\n"), count = 0;
    ck_assert_uint_eq(length % 4, 0);
    for (size_t i = 0; i < length; i += 4) {
        size_t have = text[i + 2] == '=' ? 1 : text[i + 3] == '=' ? 2 : 3;
        int word = digit(text[i]) << 18 | digit(text[i + 1]) << 12;
        word |= have > 1 ? digit(text[i + 2]) << 6 : 0;
        word |= have > 2 ? digit(text[i + 3]) : 0;
        ck_assert_uint_le(count + have, room);
        for (size_t k = 0; k < have; k++)
            bytes[count++] = (unsigned char)(word >> (16 - 8 * (int)k) & 255);
    }
    return count;
}

static const char *block(const char *page, const char *id) {
    char mark[64];
    snprintf(mark, sizeof mark, "id=\"%s\">", id);
    const char *at = strstr(page, mark);
    ck_assert_msg(at != NULL, "no block %s", id);
    return at + strlen(mark);
}

static double share(const unsigned char *at) {
    return (at[0] | at[1] << 8) / 65535.;
}

static double fact(const char *page, const char *name) {
    const char *at = strstr(page, name);
    ck_assert_msg(at != NULL, "no %s", name);
    return strtod(at + strlen(name), NULL);
}

/* One zigzag number of seven bits a byte. */
static long read_code(const unsigned char **at) {
    unsigned long code = 0;
    int shift = 0;
    do {
        code |= (unsigned long)(**at & 127) << shift;
        shift += 7;
    } while (*(*at)++ & 128);
    return code & 1 ? -(long)((code + 1) / 2) : (long)(code / 2);
}

/* place[frame][axis * SEQUENCE_GRAINS + grain], l */
static size_t unpack(const char *page, double place[][2 * SEQUENCE_GRAINS]) {
    static unsigned char packed[4096], plain[4096];
    uLongf length = sizeof plain;
    size_t have = decode(block(page, "frames"), packed, sizeof packed), frames = 0;
    long last[2 * SEQUENCE_GRAINS] = {0};
    ck_assert_int_eq(uncompress(plain, &length, packed, (uLong)have), Z_OK);
    for (const unsigned char *at = plain; at < plain + length; frames++) {
        for (size_t i = 0; i < 2 * SEQUENCE_GRAINS; i++) {
            last[i] += read_code(&at);
            place[frames][i] = (double)last[i] * fact(page, "\"unit\":");
        }
    }
    return frames;
}

START_TEST(the_data_are_the_grains) {
    struct sequence_sample s;
    unsigned char bytes[256];
    double place[SEQUENCE_FRAMES][2 * SEQUENCE_GRAINS];
    sequence_sample_fill(&s);
    double finest = s.radius[SEQUENCE_GRAINS - 1] / 16;
    struct sheet page = drawn(&s.sequence);
    ck_assert_uint_eq(decode(block(page.text, "kinds"), bytes, sizeof bytes), SEQUENCE_GRAINS);
    ck_assert_mem_eq(bytes, s.kind, SEQUENCE_GRAINS);
    ck_assert_uint_eq(decode(block(page.text, "radii"), bytes, sizeof bytes), 2 * SEQUENCE_GRAINS);
    for (int i = 0; i < SEQUENCE_GRAINS; i++)
        ck_assert_double_eq_tol(share(&bytes[2 * i]) * s.radius[SEQUENCE_GRAINS - 1], s.radius[i],
                                1e-5);
    ck_assert_double_eq_tol(fact(page.text, "\"unit\":"), finest, 1e-9);
    ck_assert_uint_eq(unpack(page.text, place), SEQUENCE_FRAMES);
    for (int f = 0; f < SEQUENCE_FRAMES; f++) {
        for (int i = 0; i < 2 * SEQUENCE_GRAINS; i++)
            ck_assert_double_eq_tol(place[f][i % 2 * SEQUENCE_GRAINS + i / 2], s.position[f][i],
                                    .501 * finest);
    }
    ck_assert_ptr_nonnull(strstr(page.text, "\"times\":[0,1.37,2.74]"));
    sheet_free(&page);
}
END_TEST

START_TEST(a_grain_outside_of_its_box_stays_at_the_wall) {
    struct sequence_sample s;
    double place[SEQUENCE_FRAMES][2 * SEQUENCE_GRAINS];
    sequence_sample_fill(&s);
    s.position[0][0] = -.113;
    s.position[0][3] = 9.81;
    struct sheet page = drawn(&s.sequence);
    unpack(page.text, place);
    ck_assert_double_eq(place[0][0], 0);
    ck_assert_double_eq_tol(place[0][SEQUENCE_GRAINS + 1], 9.7, .01);
    sheet_free(&page);
}
END_TEST

/* Grains that jump about cannot be packed: units grow first, then frames go, and the page says
 * how many are left. */
START_TEST(what_does_not_fit_loses_frames) {
    enum { GRAINS = 20011, FRAMES = 40 };
    gsl_rng *r = NULL;
    struct fault fault = FAULT_NONE;
    double *radius = calloc(GRAINS, sizeof *radius);
    unsigned char *kind = calloc(GRAINS, 1);
    static struct report_frame frame[FRAMES];
    double *place = calloc((size_t)2 * GRAINS * FRAMES, sizeof *place);
    unit_ok(random_stream(7, "places", &r, &fault), &fault);
    for (size_t i = 0; i < (size_t)2 * GRAINS * FRAMES; i++)
        place[i] = 60 * gsl_rng_uniform(r);
    for (size_t i = 0; i < GRAINS; i++)
        radius[i] = .29;
    for (size_t f = 0; f < FRAMES; f++)
        frame[f] =
            (struct report_frame){.time = .7 * (double)f, .position = place + f * 2 * GRAINS};
    struct report_sequence s = {.name = "gas",
                                .title = "Gas",
                                .caption = "",
                                .alt = "grains",
                                .time_unit = "tau",
                                .width = 60,
                                .height = 60,
                                .count = GRAINS,
                                .frame_count = FRAMES,
                                .radius = radius,
                                .kind = kind,
                                .frame = frame};
    struct sheet page = {0};
    unit_ok(draw_animation(&s, &page, &fault), &fault);
    ck_assert_uint_le(page.length, 2000 * 1000);
    ck_assert_uint_gt(page.length, 1200 * 1000);
    ck_assert_double_eq_tol(fact(page.text, "\"unit\":"), .29 / 4, 1e-9);
    ck_assert_ptr_null(strstr(page.text, "<p>40 stored frames"));
    sheet_free(&page);
    free(radius);
    free(kind);
    free(place);
    gsl_rng_free(r);
}
END_TEST

START_TEST(foreign_text_is_text_and_nothing_is_loaded) {
    struct sequence_sample s;
    sequence_sample_fill(&s);
    s.sequence.title = "</title><script>alert(1)</script>";
    struct sheet page = drawn(&s.sequence);
    ck_assert_ptr_null(strstr(page.text, "<script>alert"));
    ck_assert_ptr_null(strstr(page.text, "<b>x"));
    ck_assert_ptr_nonnull(strstr(page.text, "&lt;script&gt;alert(1)"));
    ck_assert_ptr_nonnull(strstr(page.text, "default-src 'none'"));
    static const char *const outside[] = {"http:", "https:", "src=", "href=", "import", "fetch("};
    for (size_t i = 0; i < sizeof outside / sizeof *outside; i++)
        ck_assert_msg(strstr(page.text, outside[i]) == NULL, "%s", outside[i]);
    ck_assert_ptr_nonnull(strstr(page.text, "prefers-reduced-motion"));
    sheet_free(&page);
}
END_TEST

START_TEST(tidy_accepts_the_page) {
    struct sequence_sample s;
    char command[512];
    const char *folder = unit_folder();
    sequence_sample_fill(&s);
    struct sheet page = drawn(&s.sequence);
    unit_write(unit_path(folder, "a.html"), page.text);
    snprintf(command, sizeof command, "tidy -q -e '%s'", unit_path(folder, "a.html"));
    if (system("command -v tidy >/dev/null") == 0)
        ck_assert_int_eq(system(command), 0);
    else
        printf("tidy is not installed: the page was not validated\n");
    sheet_free(&page);
    unit_remove(folder);
}
END_TEST

int main(void) {
    const TTest *const tests[] = {the_data_are_the_grains,
                                  what_does_not_fit_loses_frames,
                                  a_grain_outside_of_its_box_stays_at_the_wall,
                                  foreign_text_is_text_and_nothing_is_loaded,
                                  tidy_accepts_the_page,
                                  NULL};
    return unit_run("animation", tests);
}
