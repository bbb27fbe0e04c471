/* test_agreement.c -- validation/agreement.h: bias and scatter of all rows, and their intervals. */
#include "tests/unit/report_sample.h"
#include "tests/unit/unit.h"
#include "validation/agreement.h"

#include <gsl/gsl_randist.h>
#include <gsl/gsl_rng.h>

enum { CASES = 12, ROWS = 5 };

struct many {
    struct report report;
    struct report_case cases[CASES];
    struct report_row row[CASES][ROWS];
};

/* Rows of different sizes and signs, measured = expected * ratio(case, row). */
static void fill(struct many *m, const char *const *name, double (*ratio)(int, int)) {
    *m = (struct many){.report = {.case_count = CASES, .cases = m->cases}};
    for (int c = 0; c < CASES; c++) {
        m->cases[c] =
            (struct report_case){.name = name[c % 2], .row_count = ROWS, .row = m->row[c]};
        for (int k = 0; k < ROWS; k++) {
            double expected = (k % 2 == 0 ? 1.37 : -2.6e3) * (1 + .7 * c);
            m->row[c][k] = sample_row(name[c % 2], "", "check", expected * ratio(c, k));
            m->row[c][k].expected = expected;
            m->row[c][k].expected_uncertainty = 0;
            m->row[c][k].uncertainty = .013 * fabs(m->row[c][k].measured);
            m->row[c][k].tolerance = .2 * fabs(expected);
        }
    }
}

static const char *const one[] = {"graingas/a", "graingas/b"};
static const char *const two[] = {"graingas/a", "suspension/b"};

static double seven_percent(int c, int k) {
    (void)c;
    return 1.07 * exp((k % 2 == 0 ? .03 : -.03));
}

START_TEST(bias_and_scatter_are_those_of_the_logarithms) {
    static struct many m;
    struct arena a = {0};
    struct fault fault = FAULT_NONE;
    fill(&m, one, seven_percent);
    unit_ok(agreement_add(&m.report, &a, &fault), &fault);
    const struct report_agreement *g = m.report.agreement;
    ck_assert_uint_eq(g->group_count, 1);
    ck_assert_uint_eq(g->group[0].rows, CASES * ROWS);
    ck_assert_uint_eq(g->group[0].cases, CASES);
    ck_assert_double_eq_tol(log(g->group[0].bias), log(1.07) + .03 / 5, 1e-12);
    ck_assert_double_eq_tol(g->group[0].scatter,
                            .03 * sqrt((1 - 1. / 25) * (CASES * ROWS) / (CASES * ROWS - 1.)),
                            1e-12);
    ck_assert_double_eq_tol(g->group[0].noise, .013, 1e-12);
    arena_free(&a);
}
END_TEST

static double by_model(int c, int k) {
    return (c % 2 == 0 ? 1.02 : .97) * (1 + 1e-3 * k);
}

START_TEST(each_model_is_a_group_and_all_are_one) {
    static struct many m;
    struct arena a = {0};
    struct fault fault = FAULT_NONE;
    fill(&m, two, by_model);
    unit_ok(agreement_add(&m.report, &a, &fault), &fault);
    const struct report_group *g = m.report.agreement->group;
    ck_assert_uint_eq(m.report.agreement->group_count, 3);
    ck_assert_str_eq(g[1].name, "suspension");
    ck_assert_str_eq(g[2].name, "all");
    ck_assert_double_eq_tol(g[0].bias / g[1].bias, 1.02 / .97, 1e-9);
    ck_assert_uint_eq(g[2].rows, g[0].rows + g[1].rows);
    ck_assert_double_gt(g[2].scatter, 5 * g[0].scatter);
    ck_assert_uint_eq(m.report.agreement->figure.panel_count, 3);
    arena_free(&a);
}
END_TEST

static gsl_rng *stream;
static double of_case[CASES];

/* Rows of a case lie together: 2 % from case to case, 1 % within one. */
static double clustered(int c, int k) {
    if (k == 0)
        of_case[c] = gsl_ran_gaussian(stream, .02);
    return .98 * exp(of_case[c] + gsl_ran_gaussian(stream, .01));
}

/* 400 surveys: the truth lies within the interval in about 95 % of them, and would in far fewer
 * if rows counted as independent (then the interval is too narrow by 2.0). */
START_TEST(the_interval_of_the_bias_holds_for_rows_that_share_runs) {
    static struct many m;
    size_t held = 0, all = 400;
    stream = gsl_rng_alloc(gsl_rng_mt19937);
    gsl_rng_set(stream, 71993);
    for (size_t i = 0; i < all; i++) {
        struct arena a = {0};
        struct fault fault = FAULT_NONE;
        fill(&m, one, clustered);
        unit_ok(agreement_add(&m.report, &a, &fault), &fault);
        const struct report_group *g = m.report.agreement->group;
        held += g->bias_low < .98 && .98 < g->bias_high;
        ck_assert(g->scatter_low < g->scatter && g->scatter < g->scatter_high);
        arena_free(&a);
    }
    gsl_rng_free(stream);
    ck_assert_uint_ge(held, 367); /* 380 expected, standard deviation 4.4: three of it */
    ck_assert_uint_le(held, 393);
}
END_TEST

START_TEST(what_has_no_ratio_is_counted_and_left_out) {
    static struct many m;
    struct arena a = {0};
    struct fault fault = FAULT_NONE;
    fill(&m, one, seven_percent);
    m.row[0][0].kind = "round-off";
    m.row[0][1].comparison = "at most";
    m.row[0][2].comparison = "at least";
    m.row[1][0].kind = "regression";
    m.row[1][1].measured = (double)NAN;
    m.row[1][2].measured *= -1;
    m.row[1][3].tolerance = .6 * fabs(m.row[1][3].expected);
    m.row[1][4].comparison = "outside";
    unit_ok(agreement_add(&m.report, &a, &fault), &fault);
    const struct report_agreement *g = m.report.agreement;
    ck_assert_uint_eq(g->round_off, 1);
    ck_assert_uint_eq(g->one_sided, 2);
    ck_assert_uint_eq(g->other, 5);
    ck_assert_uint_eq(g->group[0].rows, CASES * ROWS - 8);
    arena_free(&a);
}
END_TEST

START_TEST(two_cases_have_no_interval_and_one_row_no_plot) {
    static struct many m;
    struct arena a = {0};
    struct fault fault = FAULT_NONE;
    fill(&m, one, seven_percent);
    m.report.case_count = 2;
    unit_ok(agreement_add(&m.report, &a, &fault), &fault);
    ck_assert(isnan(m.report.agreement->group[0].bias_low));
    m.report.agreement = NULL;
    m.report.case_count = m.cases[0].row_count = 1;
    unit_ok(agreement_add(&m.report, &a, &fault), &fault);
    ck_assert_ptr_null(m.report.agreement);
    arena_free(&a);
}
END_TEST

int main(void) {
    const TTest *const tests[] = {bias_and_scatter_are_those_of_the_logarithms,
                                  each_model_is_a_group_and_all_are_one,
                                  the_interval_of_the_bias_holds_for_rows_that_share_runs,
                                  what_has_no_ratio_is_counted_and_left_out,
                                  two_cases_have_no_interval_and_one_row_no_plot,
                                  NULL};
    return unit_run("agreement", tests);
}
