/* test_recipes.c -- the lists of recipes and fits are complete and well formed. */
#include "tests/unit/unit.h"
#include "validation/across.h"
#include "validation/recipe.h"

START_TEST(every_recipe_is_complete) {
    size_t count;
    const struct recipe *const *all = recipe_all(&count);
    ck_assert_uint_ge(count, 17);
    for (size_t i = 0; i < count; i++) {
        const struct recipe *r = all[i];
        ck_assert_ptr_eq(recipe_find(r->name), r);
        ck_assert_ptr_nonnull(r->measure);
        ck_assert_ptr_nonnull(r->datasets[0]);
        ck_assert_ptr_nonnull(r->output[0].name);
        for (size_t k = 0; k < RECIPE_MAX_SETTINGS && r->setting[k].name; k++) {
            ck_assert_double_le(r->setting[k].min, r->setting[k].standard);
            ck_assert_double_ge(r->setting[k].max, r->setting[k].standard);
        }
        for (size_t k = 0; k < RECIPE_MAX_OUTPUTS && r->output[k].name; k++) {
            ck_assert_ptr_nonnull(r->output[k].unit);
            ck_assert_ptr_nonnull(r->output[k].doc);
        }
    }
    ck_assert_ptr_null(recipe_find("settlin"));
}
END_TEST

START_TEST(every_fit_can_be_found) {
    size_t count;
    const struct across *const *all = across_all(&count);
    for (size_t i = 0; i < count; i++)
        ck_assert_ptr_eq(across_find(all[i]->name), all[i]);
    ck_assert_ptr_null(across_find("no-such-fit"));
}
END_TEST

START_TEST(curves_are_copied_counted_and_freed) {
    struct measurement m = {0};
    struct fault fault = FAULT_NONE;
    double x[] = {1.37e-6, 2}, y[] = {3, 4.5};
    for (int i = 0; i < RECIPE_MAX_CURVES; i++)
        unit_ok(measurement_add_curve(&m, "curve", "label", x, y, 2, &fault), &fault);
    x[0] = 0;
    ck_assert_double_eq(m.curve[RECIPE_MAX_CURVES - 1].x[0], 1.37e-6);
    ck_assert_int_ne(measurement_add_curve(&m, "one too many", "", x, y, 2, &fault), STATUS_OK);
    unit_says(&fault, "one too many");
    measurement_free(&m);
    ck_assert_uint_eq(m.curve_count, 0);
    measurement_free(NULL);
}
END_TEST

int main(void) {
    const TTest *const tests[] = {every_recipe_is_complete, every_fit_can_be_found,
                                  curves_are_copied_counted_and_freed, NULL};
    return unit_run("recipes", tests);
}
