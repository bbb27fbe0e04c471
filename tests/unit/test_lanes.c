/* test_lanes.c -- solver/suspension/lanes.h: vectors against plain C, bit by bit.
 *
 * The header is read twice: as the engine has it, and as a processor without SSE2
 * would. */
#include "solver/suspension/lanes.h"
#include "tests/unit/unit.h"

#include <gsl/gsl_rng.h>

#undef SUSPENSION_LANES_H
#undef __SSE2__
#define lanes          plain
#define lanes_mask     plain_mask
#define lanes_load     plain_load
#define lanes_all      plain_all
#define lanes_low      plain_low
#define lanes_high     plain_high
#define lanes_root     plain_root
#define lanes_positive plain_positive
#define lanes_bits     plain_bits
#define lanes_copy4    plain_copy4
#define lanes_signs16  plain_signs16
#include "solver/suspension/lanes.h"
#undef lanes
#undef lanes_mask
#undef lanes_load
#undef lanes_all
#undef lanes_low
#undef lanes_high
#undef lanes_root
#undef lanes_positive
#undef lanes_bits
#undef lanes_copy4
#undef lanes_signs16

/* Any 64 bits are a double: numbers of all sizes, now and then infinite, NaN, or +-0. */
static double any_double(gsl_rng *rng) {
    static const double special[] = {0.0, -0.0, INFINITY, -INFINITY, NAN, 0x1p-1074, -0x1p-1074};
    uint64_t bits = (uint64_t)gsl_rng_get(rng) << 32 | gsl_rng_get(rng);
    double out;
    memcpy(&out, &bits, sizeof out);
    return bits % 5 == 0 ? special[bits / 5 % 7] : out;
}

static void expect_same(double a, double b) {
    ck_assert_msg(memcmp(&a, &b, sizeof a) == 0, "%a against %a", a, b);
}

START_TEST(roots_and_positive_parts_have_the_same_bits_as_plain_c) {
    gsl_rng *rng = gsl_rng_alloc(gsl_rng_mt19937);
    for (int n = 0; n < 100000; n++) {
        const double a[2] = {any_double(rng), any_double(rng)};
        lanes root = lanes_root((lanes){a[0], a[1]}), some = lanes_positive((lanes){a[0], a[1]});
        plain root_plain = plain_root((plain){a[0], a[1]});
        plain some_plain = plain_positive((plain){a[0], a[1]});
        for (int k = 0; k < 2; k++) {
            double positive = isnan(a[k]) || a[k] <= 0 ? 0.0 : a[k];
            expect_same(some[k], positive);
            expect_same(some_plain[k], positive);
            expect_same(root[k], sqrt(positive));
            expect_same(root_plain[k], sqrt(positive));
        }
    }
    gsl_rng_free(rng);
}
END_TEST

START_TEST(lanes_are_where_they_are_put) {
    _Alignas(16) const double a[2] = {0.731, -3.17}, b[2] = {1.93, 0.0071};
    lanes p = lanes_load(a), q = lanes_load(b);
    for (unsigned k = 0; k < 2; k++) {
        ck_assert_double_eq(p[k], a[k]);
        ck_assert_double_eq(lanes_low(p, q)[k], k == 0 ? a[0] : b[0]);
        ck_assert_double_eq(lanes_high(p, q)[k], k == 0 ? a[1] : b[1]);
        ck_assert_double_eq(lanes_all(2.9)[k], 2.9);
    }
    for (unsigned bits = 0; bits < 4; bits++) {
        lanes v = {bits & 1 ? -1 : 1, bits & 2 ? -1 : 1};
        ck_assert_uint_eq(lanes_bits(v < lanes_all(0)), bits);
        ck_assert_uint_eq(plain_bits((plain_mask)(v < lanes_all(0))), bits);
    }
}
END_TEST

/* Highest bits at random, lower ones too: packing to bytes must not saturate them away. */
START_TEST(signs_of_labels_are_their_highest_bits) {
    gsl_rng *rng = gsl_rng_alloc(gsl_rng_mt19937);
    _Alignas(64) uint32_t label[16];
    for (int n = 0; n < 70000; n++) {
        unsigned expected = 0;
        for (unsigned k = 0; k < 16; k++) {
            uint32_t any = (uint32_t)gsl_rng_get(rng), pick = any >> 9 & 7;
            any = (uint32_t)gsl_rng_get(rng);
            label[k] = pick == 0   ? UINT32_MAX
                       : pick == 1 ? 0
                       : pick == 2 ? UINT32_C(1) << 31
                       : pick == 3 ? INT32_MAX
                       : pick == 4 ? any & 0xffff
                                   : any;
            expected |= (label[k] > INT32_MAX ? 1u : 0u) << k;
        }
        ck_assert_uint_eq(lanes_signs16(label), expected);
        ck_assert_uint_eq(plain_signs16(label), expected);
        uint32_t to[6] = {17, 17, 17, 17, 17, 17}, plain_to[6] = {17, 17, 17, 17, 17, 17};
        ck_assert_uint_eq(lanes_copy4(to + 1, label + 4), expected >> 4 & 15);
        ck_assert_uint_eq(plain_copy4(plain_to + 1, label + 4), expected >> 4 & 15);
        ck_assert_mem_eq(to + 1, label + 4, 4 * sizeof *to);
        ck_assert_mem_eq(to, plain_to, sizeof to);
        ck_assert(to[0] == 17 && to[5] == 17);
    }
    gsl_rng_free(rng);
}
END_TEST

int main(void) {
    const TTest *const tests[] = {roots_and_positive_parts_have_the_same_bits_as_plain_c,
                                  lanes_are_where_they_are_put,
                                  signs_of_labels_are_their_highest_bits, NULL};
    return unit_run("lanes", tests);
}
