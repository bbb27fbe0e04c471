/* test_random.c -- common/random.h: streams repeat, and do not touch one another. */
#include "common/random.h"
#include "tests/unit/unit.h"

static unsigned long first(uint64_t seed, const char *purpose) {
    struct fault fault = FAULT_NONE;
    gsl_rng *r;
    unit_ok(random_stream(seed, purpose, &r, &fault), &fault);
    unsigned long value = gsl_rng_get(r);
    gsl_rng_free(r);
    return value;
}

START_TEST(a_stream_is_named_by_seed_and_purpose) {
    ck_assert_uint_eq(first(1101, "positions"), first(1101, "positions"));
    ck_assert_uint_ne(first(1101, "positions"), first(1102, "positions"));
    ck_assert_uint_ne(first(1101, "positions"), first(1101, "kicks"));
    ck_assert_uint_ne(first(1, "1x"), first(11, "x"));
    ck_assert_uint_ne(first(7, "x"), first(7 + (1ull << 40), "x"));
}
END_TEST

/* Results are compared over years: the stream itself must never change. */
START_TEST(the_numbers_are_those_of_always) {
    ck_assert_uint_eq(first(1101, "positions"), 1128837961);
}
END_TEST

START_TEST(neighbouring_seeds_are_not_correlated) {
    double sum = 0;
    enum { SEEDS = 4000 };
    for (uint64_t seed = 0; seed < SEEDS; seed++)
        sum += ((double)first(seed, "a") / 4294967296.0 - 0.5) *
               ((double)first(seed + 1, "a") / 4294967296.0 - 0.5);
    /* The product of two uniform deviates has standard deviation 1/12. */
    ck_assert_double_lt(sum / SEEDS * 12, 4 / 63.2);
    ck_assert_double_gt(sum / SEEDS * 12, -4 / 63.2);
}
END_TEST

int main(void) {
    const TTest *const tests[] = {a_stream_is_named_by_seed_and_purpose,
                                  the_numbers_are_those_of_always,
                                  neighbouring_seeds_are_not_correlated, NULL};
    return unit_run("random", tests);
}
