/* test_ensemble.c -- validation/ensemble.h: the list, and the peak of a mean curve. */
#include "tests/unit/unit.h"
#include "validation/ensemble.h"

#include <math.h>

enum { SEEDS = 4, POINTS = 5 };

static const double abscissa[POINTS] = {0.1, 0.37, 0.52, 0.9, 1.3};
/* Noise of each seed that cancels in the mean: every seed's own peak is too high. */
static const double noise[SEEDS][POINTS] = {{0.31, 0.02, -0.1, 0, 0.4},
                                            {-0.31, 0.03, 0.1, 0.2, -0.4},
                                            {0.2, -0.02, 0.07, -0.2, 0.1},
                                            {-0.2, -0.03, -0.07, 0, -0.1}};
static const double truth[POINTS] = {1.01, 1.13, 1.21, 1.07, 0.98};

static void fill(struct measurement *m, const struct measurement **list) {
    struct fault fault = FAULT_NONE;
    for (size_t i = 0; i < SEEDS; i++) {
        double y[POINTS];
        for (size_t k = 0; k < POINTS; k++)
            y[k] = truth[k] + noise[i][k];
        m[i] = (struct measurement){.value = {0}};
        unit_ok(measurement_add_curve(&m[i], "height", "", abscissa, y, POINTS, &fault), &fault);
        list[i] = &m[i];
    }
}

static void empty(struct measurement *m) {
    for (size_t i = 0; i < SEEDS; i++)
        measurement_free(&m[i]);
}

START_TEST(the_peak_is_that_of_the_mean_curve) {
    struct measurement m[SEEDS];
    const struct measurement *list[SEEDS];
    struct fault fault = FAULT_NONE;
    double value[ENSEMBLE_MAX_OUTPUTS], error[ENSEMBLE_MAX_OUTPUTS];
    fill(m, list);
    unit_ok(ensemble_find("peak-of-mean")->fit(list, SEEDS, NULL, value, error, &fault), &fault);
    ck_assert_double_eq_tol(value[0], 1.21, 1e-12);
    ck_assert_double_eq_tol(value[1], 0.52, 1e-12);
    /* Without seed i the mean moves by -noise/3; the peak stays where it is. */
    double squares = 0;
    for (size_t i = 0; i < SEEDS; i++)
        squares += pow(noise[i][2] / 3, 2);
    ck_assert_double_eq_tol(error[0], sqrt(squares * 3 / 4), 1e-12);
    ck_assert_double_eq_tol(error[1], 0, 1e-12);
    empty(m);
}
END_TEST

START_TEST(one_seed_has_a_peak_without_an_uncertainty) {
    struct measurement m[SEEDS];
    const struct measurement *list[SEEDS];
    struct fault fault = FAULT_NONE;
    double value[2] = {NAN, NAN}, error[2] = {NAN, NAN};
    fill(m, list);
    unit_ok(ensemble_find("peak-of-mean")->fit(list, 1, NULL, value, error, &fault), &fault);
    ck_assert_double_eq_tol(value[0], 0.98 + 0.4, 1e-12);
    ck_assert_double_eq_tol(value[1], 1.3, 1e-12);
    ck_assert_double_nan(error[0]);
    ck_assert_double_nan(error[1]);
    empty(m);
}
END_TEST

START_TEST(curves_that_cannot_be_averaged_are_refused) {
    struct measurement m[SEEDS];
    const struct measurement *list[SEEDS];
    struct fault fault = FAULT_NONE;
    double value[ENSEMBLE_MAX_OUTPUTS], error[ENSEMBLE_MAX_OUTPUTS];
    const struct ensemble *peak = ensemble_find("peak-of-mean");
    fill(m, list);
    m[2].curve[0].x[1] = 0.371;
    ck_assert_int_eq(peak->fit(list, SEEDS, NULL, value, error, &fault), STATUS_BAD_INPUT);
    unit_says(&fault, "the curves of height have different abscissae");
    fault = FAULT_NONE;
    measurement_free(&m[1]);
    m[1] = (struct measurement){.value = {0}};
    ck_assert_int_eq(peak->fit(list, SEEDS, NULL, value, error, &fault), STATUS_BAD_INPUT);
    unit_says(&fault, "a run has no curve");
    empty(m);
}
END_TEST

START_TEST(a_curve_is_found_by_its_name) {
    struct measurement m = {.curve_count = 2};
    m.curve[0].name = "L2";
    m.curve[1].name = "front";
    ck_assert_ptr_eq(ensemble_curve(&m, "front"), &m.curve[1]);
    ck_assert_ptr_null(ensemble_curve(&m, "fro"));
}
END_TEST

START_TEST(every_ensemble_fit_is_whole) {
    size_t count;
    const struct ensemble *const *all = ensemble_all(&count);
    for (size_t i = 0; i < count; i++) {
        ck_assert_ptr_eq(ensemble_find(all[i]->name), all[i]);
        ck_assert(all[i]->title != NULL && all[i]->source != NULL && all[i]->fit != NULL);
        ck_assert(all[i]->min_seeds >= 2); /* an uncertainty needs two */
        ck_assert(all[i]->output[0].name != NULL && all[i]->output[0].unit != NULL);
        ck_assert(all[i]->recipe == NULL || recipe_find(all[i]->recipe) != NULL);
    }
    ck_assert_ptr_null(ensemble_find("peak-of-means"));
}
END_TEST

int main(void) {
    const TTest *const tests[] = {the_peak_is_that_of_the_mean_curve,
                                  one_seed_has_a_peak_without_an_uncertainty,
                                  curves_that_cannot_be_averaged_are_refused,
                                  a_curve_is_found_by_its_name,
                                  every_ensemble_fit_is_whole,
                                  NULL};
    return unit_run("ensemble", tests);
}
