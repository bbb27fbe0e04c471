/* test_thin.c -- a thinned curve looks the same. */
#include "report/thin.h"
#include "tests/unit/unit.h"

#include <math.h>
#include <stdlib.h>

enum { COUNT = 1733 };

static struct thin_point point[COUNT];
static bool keep[COUNT];

static size_t kept(void) {
    size_t n = 0;
    for (size_t i = 0; i < COUNT; i++)
        n += keep[i];
    return n;
}

/* Largest vertical gap between all points and the kept ones joined straight (x increases). */
static double worst_gap(size_t curve) {
    double worst = 0;
    for (size_t a = 0, b; a + 1 < COUNT; a = b) {
        for (b = a + 1; !keep[b]; b++)
            ;
        for (size_t i = a; i <= b; i++) {
            double part = (point[i].x - point[a].x) / (point[b].x - point[a].x);
            double line = point[a].y[curve] + part * (point[b].y[curve] - point[a].y[curve]);
            worst = fmax(worst, fabs(point[i].y[curve] - line));
        }
    }
    return worst;
}

static void wave(void) {
    for (size_t i = 0; i < COUNT; i++) {
        double x = .361 * (double)i, y = 143.7 + 61.3 * sin(x / 57.1);
        point[i] = (struct thin_point){x, {y, y - 7.3, y + 11.9 * cos(x / 23.7)}};
    }
}

START_TEST(what_is_left_out_is_not_seen) {
    wave();
    thin_curve(point, COUNT, .17, keep);
    ck_assert(keep[0] && keep[COUNT - 1]);
    ck_assert_uint_lt(kept(), COUNT / 6);
    for (size_t c = 0; c < THIN_CURVES; c++)
        ck_assert_double_lt(worst_gap(c),
                            .17 * 3.5); /* distances are to the chord, slopes up to 3 */
}
END_TEST

START_TEST(a_spike_of_one_curve_stays_in_all) {
    wave();
    point[811].y[2] += 5.9;
    thin_curve(point, COUNT, .17, keep);
    ck_assert(keep[810] && keep[811] && keep[812]);
}
END_TEST

START_TEST(straight_lines_need_their_ends_and_noise_all) {
    for (size_t i = 0; i < COUNT; i++)
        point[i] =
            (struct thin_point){.73 * (double)i, {1.9 * (double)i, 13.1, 400 - .37 * (double)i}};
    thin_curve(point, COUNT, 1e-6, keep);
    ck_assert_uint_eq(kept(), 2);
    for (size_t i = 0; i < COUNT; i++)
        point[i].y[0] += i % 2 ? 3.7 : -3.7;
    thin_curve(point, COUNT, .17, keep);
    ck_assert_uint_gt(kept(), COUNT - 4);
}
END_TEST

START_TEST(back_and_forth_and_standing_still) {
    static const double x[] = {0, 10.3, 4.1, 4.1, 4.1, 17.9};
    struct thin_point p[6];
    bool needed[6];
    for (size_t i = 0; i < 6; i++)
        p[i] = (struct thin_point){x[i], {0, 0, 0}};
    thin_curve(p, 6, .1, needed);
    ck_assert(needed[0] && needed[5]);
    thin_curve(p, 1, .1, needed);
    ck_assert(needed[0]);
    thin_curve(p, 0, .1, needed);
}
END_TEST

int main(void) {
    const TTest *const tests[] = {what_is_left_out_is_not_seen, a_spike_of_one_curve_stays_in_all,
                                  straight_lines_need_their_ends_and_noise_all,
                                  back_and_forth_and_standing_still, NULL};
    return unit_run("thin", tests);
}
