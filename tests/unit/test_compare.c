/* test_compare.c -- validation/compare.h: each conclusion from planted rows, both signs. */
#include "tests/unit/unit.h"
#include "validation/compare.h"

#include <math.h>

enum { SEEDS = 4 };

struct side {
    struct results results;
    struct results_row row[2];
    double value[SEEDS];
    long long seed[SEEDS];
    const char *run[SEEDS];
};

/* A row of four seeds with the given values and the uncertainty that they have themselves. */
static void fill(struct side *s, const double *value) {
    static const char *const run[SEEDS] = {"fake.a.1a2b3c4d-s11", "fake.a.1a2b3c4d-s12",
                                           "fake.a.1a2b3c4d-s13", "fake.a.1a2b3c4d-s14"};
    double mean = 0, squares = 0;
    for (int i = 0; i < SEEDS; i++) {
        s->value[i] = value[i];
        s->seed[i] = 11 + i;
        s->run[i] = run[i];
        mean += value[i] / SEEDS;
    }
    for (int i = 0; i < SEEDS; i++)
        squares += (value[i] - mean) * (value[i] - mean);
    s->row[0] = (struct results_row){.case_name = "fake/a",
                                     .point = "x=1.7",
                                     .check = "speed",
                                     .observable = "o.speed",
                                     .unit = "l",
                                     .comparison = "within",
                                     .kind = "model",
                                     .verdict = "pass",
                                     .reason = "",
                                     .meaning = "deadbeef",
                                     .measured = mean,
                                     .uncertainty = sqrt(squares / (SEEDS - 1) / SEEDS),
                                     .expected = 1.3,
                                     .tolerance = .2,
                                     .freedom = SEEDS - 1,
                                     .run_count = SEEDS,
                                     .value_count = SEEDS,
                                     .run = s->run,
                                     .value = s->value,
                                     .seed = s->seed};
    s->results = (struct results){.tier = "smoke", .row_count = 1, .row = s->row};
}

static const double base[SEEDS] = {1.313, 1.297, 1.288, 1.331};

static void fill_pair(struct side *a, struct side *b, double scale, double shift) {
    double value[SEEDS];
    for (int i = 0; i < SEEDS; i++)
        value[i] = base[SEEDS - 1 - i] * scale + shift;
    fill(a, base);
    fill(b, value);
}

static struct compared *of(const struct side *a, const struct side *b, double level) {
    struct compared *c;
    struct fault fault = FAULT_NONE;
    unit_ok(compare_results(&a->results, &b->results, level, &c, &fault), &fault);
    return c;
}

static void expect(const struct side *a, const struct side *b, enum change change, int code) {
    struct compared *c = of(a, b, 1e-3);
    ck_assert_uint_eq(c->row_count, 1);
    ck_assert_msg(c->row[0].change == change, "%s, d %g, h %g, T %g",
                  compare_change_name(c->row[0].change), c->row[0].difference, c->row[0].half_width,
                  c->row[0].unit);
    ck_assert_int_eq(compare_exit_code(c), code);
    compare_free(c);
}

START_TEST(equal_bits_are_unchanged) {
    struct side a, b;
    fill(&a, base);
    fill(&b, base);
    expect(&a, &b, CHANGE_UNCHANGED, 0);
}
END_TEST

START_TEST(exchanged_seeds_are_the_same) {
    struct side a, b;
    fill_pair(&a, &b, 1, 0);
    b.row[0].tolerance = a.row[0].tolerance = .31;
    expect(&a, &b, CHANGE_SAME, 0);
}
END_TEST

START_TEST(a_change_of_five_tolerances_is_seen_on_either_side) {
    struct side a, b;
    fill_pair(&a, &b, 1, 1);
    expect(&a, &b, CHANGE_SIGNIFICANT, 1);
    fill_pair(&a, &b, 1, -1);
    expect(&a, &b, CHANGE_SIGNIFICANT, 1);
}
END_TEST

START_TEST(scatter_as_large_as_the_tolerance_decides_nothing) {
    struct side a, b;
    fill_pair(&a, &b, 1, .01);
    a.row[0].tolerance = .02;
    expect(&a, &b, CHANGE_UNDECIDED, 3);
}
END_TEST

/* A mean of 36 stored seeds against four fresh ones, whose difference is within their scatter. */
static void fill_stored(struct side *a, struct side *b, double shift) {
    fill_pair(a, b, 1, shift);
    a->results.references = a->row[0].reference = true;
    a->row[0].run_count = a->row[0].value_count = 0;
    a->row[0].uncertainty = .018 / 6;
    b->row[0].uncertainty = .018 / 2;
    a->row[0].freedom = b->row[0].freedom = 35;
    a->row[0].kind = b->row[0].kind = "regression";
    a->row[0].tolerance = b->row[0].tolerance = .034;
}

START_TEST(a_regression_check_must_have_seen_what_it_can_see) {
    struct side a, b;
    fill_stored(&a, &b, .013);
    /* u .00949, h = t(1e-3, 35) u = .0341; with 95 % a change of h + 1.645 u is seen: .0497 */
    a.row[0].detectable = b.row[0].detectable = .0499;
    expect(&a, &b, CHANGE_SAME, 0);
    a.row[0].detectable = b.row[0].detectable = .0493;
    expect(&a, &b, CHANGE_UNDECIDED, 3);
    a.row[0].detectable = b.row[0].detectable = NAN;
    expect(&a, &b, CHANGE_UNDECIDED, 3);
    fill_stored(&a, &b, .037);
    a.row[0].detectable = b.row[0].detectable = 1;
    expect(&a, &b, CHANGE_SIGNIFICANT, 1);
}
END_TEST

START_TEST(the_bits_of_a_reference_are_unchanged_at_once) {
    struct side a, b;
    fill_stored(&a, &b, .013);
    a.row[0].detectable = b.row[0].detectable = NAN;
    a.row[0].same_bits = true;
    expect(&a, &b, CHANGE_UNCHANGED, 0);
}
END_TEST

START_TEST(seeds_that_agree_sharpen_the_comparison) {
    struct side a, b;
    double value[SEEDS];
    for (int i = 0; i < SEEDS; i++)
        value[i] = base[i] + 1e-4 + 1e-7 * i * i;
    fill(&a, base);
    fill(&b, value);
    expect(&a, &b, CHANGE_SIGNIFICANT, 1);
    struct compared *c = of(&a, &b, 1e-3);
    double d = 1e-4 + 1e-7 * 14 / 4, mean = 14 / 4., squares = 0;
    for (int i = 0; i < SEEDS; i++)
        squares += (i * i - mean) * (i * i - mean);
    ck_assert_double_eq_tol(c->row[0].difference, d, 1e-12);
    ck_assert_double_eq_tol(c->row[0].uncertainty, 1e-7 * sqrt(squares / 3 / 4), 1e-12);
    ck_assert_str_eq(c->row[0].how, "paired, 4 seeds");
    compare_free(c);
}
END_TEST

/* Half of the level, two-sided, 2 (n - 1) = 6 degrees of freedom: t(6) at 2.5e-4 above is 6.788
 * (tables of Student's t give 5.208 at 1e-3 and 5.959 at 5e-4 for comparison). */
START_TEST(the_interval_is_students) {
    struct side a, b;
    fill_pair(&a, &b, 1, 0);
    struct compared *c = of(&a, &b, 1e-3);
    double u = hypot(a.row[0].uncertainty, b.row[0].uncertainty);
    ck_assert_uint_eq(c->tests, 1);
    ck_assert_double_eq_tol(c->row[0].uncertainty, u, 1e-12);
    ck_assert_double_eq_tol(c->row[0].half_width / u, 6.788, 5e-3);
    compare_free(c);
}
END_TEST

START_TEST(the_level_is_divided_over_the_rows) {
    struct side a, b;
    fill_pair(&a, &b, 1, 0);
    a.row[1] = a.row[0];
    b.row[1] = b.row[0];
    a.row[1].check = b.row[1].check = "another";
    a.results.row_count = b.results.row_count = 2;
    struct compared *two = of(&a, &b, 2e-3);
    a.results.row_count = b.results.row_count = 1;
    struct compared *one = of(&a, &b, 1e-3);
    ck_assert_uint_eq(two->tests, 2);
    ck_assert_double_eq_tol(two->row[0].half_width, one->row[0].half_width, 1e-12);
    compare_free(one);
    compare_free(two);
}
END_TEST

START_TEST(without_scatter_every_seed_counts) {
    struct side a, b;
    double value[SEEDS] = {base[0] + 1e-3, base[1] - 1e-3, base[2], base[3]};
    fill(&a, base);
    fill(&b, value);
    a.row[0].uncertainty = b.row[0].uncertainty = 0;
    expect(&a, &b, CHANGE_SIGNIFICANT, 1);
    b.value[0] = base[0] * (1 + 1e-12);
    b.value[1] = base[1];
    expect(&a, &b, CHANGE_SAME, 0);
}
END_TEST

START_TEST(round_off_checks_allow_their_tolerance) {
    struct side a, b;
    double value[SEEDS] = {3.1e-15, 2.7e-15, 1.9e-15, 2.2e-15}, worse[SEEDS];
    fill(&a, value);
    for (int i = 0; i < SEEDS; i++)
        worse[i] = value[i] + (i == 2 ? 3.7e-13 : 0);
    fill(&b, worse);
    a.row[0].uncertainty = b.row[0].uncertainty = 0;
    a.row[0].kind = b.row[0].kind = "round-off";
    a.row[0].tolerance = b.row[0].tolerance = 4e-13;
    expect(&a, &b, CHANGE_SAME, 0);
    a.row[0].tolerance = b.row[0].tolerance = 3e-13;
    expect(&a, &b, CHANGE_SIGNIFICANT, 1);
}
END_TEST

START_TEST(a_bound_on_each_seed_allows_what_it_bounds) {
    struct side a, b;
    double value[SEEDS] = {.0137, .0151, .0129, .0143}, other[SEEDS] = {.0211, .0128, .0155, .0133};
    fill(&a, value);
    fill(&b, other);
    a.row[0].uncertainty = b.row[0].uncertainty = 0;
    a.row[0].comparison = b.row[0].comparison = "at most";
    a.row[0].tolerance = b.row[0].tolerance = 0;
    a.row[0].expected = b.row[0].expected = .05;
    expect(&a, &b, CHANGE_SAME, 0);
    b.value[2] = .0671;
    expect(&a, &b, CHANGE_SIGNIFICANT, 1);
}
END_TEST

START_TEST(an_unknown_number_never_compares_as_equal) {
    struct side a, b;
    fill_pair(&a, &b, 1, 0);
    b.row[0].measured = NAN;
    expect(&a, &b, CHANGE_SIGNIFICANT, 1);
    expect(&b, &a, CHANGE_UNDECIDED, 3);
    expect(&b, &b, CHANGE_UNDECIDED, 3);
    fill_pair(&a, &b, 1, .01);
    a.row[0].uncertainty = b.row[0].uncertainty = NAN;
    a.row[0].value_count = b.row[0].value_count = 0;
    expect(&a, &b, CHANGE_UNDECIDED, 3);
}
END_TEST

START_TEST(other_runs_observables_seeds_are_not_comparable) {
    struct side a, b;
    const char *other[SEEDS] = {"fake.a.1a2b3c4e-s11", "fake.a.1a2b3c4e-s12", "fake.a.1a2b3c4e-s13",
                                "fake.a.1a2b3c4e-s14"};
    fill_pair(&a, &b, 1, 0);
    b.row[0].run = other;
    expect(&a, &b, CHANGE_OTHER, 2);
    fill_pair(&a, &b, 1, 0);
    b.row[0].meaning = "deadbee0";
    expect(&a, &b, CHANGE_OTHER, 2);
    fill_pair(&a, &b, 1, 0);
    b.seed[3] = 15;
    expect(&a, &b, CHANGE_OTHER, 2);
    fill_pair(&a, &b, 1, 0);
    b.row[0].unit = "R";
    expect(&a, &b, CHANGE_OTHER, 2);
}
END_TEST

START_TEST(an_ensemble_lends_its_degrees_of_freedom) {
    struct side a, b;
    fill(&a, base);
    fill(&b, base);
    b.row[0].measured = 1.3 + 4 * hypot(.013, .004);
    b.row[0].uncertainty = .013;
    a.row[0] = b.row[0];
    a.row[0].reference = true;
    a.row[0].run_count = a.row[0].value_count = 0;
    a.row[0].measured = 1.3;
    a.row[0].uncertainty = .004;
    a.row[0].freedom = b.row[0].freedom = 35;
    expect(&a, &b, CHANGE_SIGNIFICANT, 1);
    a.row[0].freedom = b.row[0].freedom = 3;
    expect(&a, &b, CHANGE_UNDECIDED, 3);
}
END_TEST

int main(void) {
    const TTest *const tests[] = {equal_bits_are_unchanged,
                                  exchanged_seeds_are_the_same,
                                  a_change_of_five_tolerances_is_seen_on_either_side,
                                  scatter_as_large_as_the_tolerance_decides_nothing,
                                  a_regression_check_must_have_seen_what_it_can_see,
                                  the_bits_of_a_reference_are_unchanged_at_once,
                                  seeds_that_agree_sharpen_the_comparison,
                                  the_interval_is_students,
                                  the_level_is_divided_over_the_rows,
                                  without_scatter_every_seed_counts,
                                  round_off_checks_allow_their_tolerance,
                                  a_bound_on_each_seed_allows_what_it_bounds,
                                  an_unknown_number_never_compares_as_equal,
                                  other_runs_observables_seeds_are_not_comparable,
                                  an_ensemble_lends_its_degrees_of_freedom,
                                  NULL};
    return unit_run("compare", tests);
}
