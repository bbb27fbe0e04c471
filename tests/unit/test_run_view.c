/* test_run_view.c -- validation/run_view.h: what it gives and what it refuses. */
#include "tests/unit/fake_run.h"

START_TEST(parameters_come_from_the_run_file_then_from_the_result) {
    struct fake_run f = fake_start("  width_l: 7\n  fixed_bed: [0.3, 0.55]\n  mirror: true\n");
    double real[] = {1.37e-6}, list[] = {0.1, 0.2, 0.4};
    unit_ok(h5_attribute_reals(f.writer, "parameters", "start_speed", real, 1, &f.fault), &f.fault);
    unit_ok(h5_attribute_reals(f.writer, "parameters", "grain_x", list, 3, &f.fault), &f.fault);
    unit_ok(h5_attribute_reals(f.writer, "parameters", "width_l", real, 1, &f.fault), &f.fault);
    unit_ok(h5_attribute_text(f.writer, "parameters", "start", "equilibrated", &f.fault), &f.fault);
    struct run_view *v = fake_open(&f);
    double value;
    const double *values;
    size_t count;
    const char *text;
    unit_ok(run_view_parameter(v, "width_l", &value, &f.fault), &f.fault);
    ck_assert_double_eq(value, 7); /* as the case asked, not as --set overrode */
    unit_ok(run_view_parameter(v, "start_speed", &value, &f.fault), &f.fault);
    ck_assert_double_eq(value, 1.37e-6);
    unit_ok(run_view_parameter(v, "mirror", &value, &f.fault), &f.fault);
    ck_assert_double_eq(value, 1);
    unit_ok(run_view_parameter_list(v, "fixed_bed", &values, &count, &f.fault), &f.fault);
    ck_assert_uint_eq(count, 2);
    ck_assert_double_eq(values[1], 0.55);
    unit_ok(run_view_parameter_list(v, "grain_x", &values, &count, &f.fault), &f.fault);
    ck_assert_uint_eq(count, 3);
    unit_ok(run_view_parameter_text(v, "start", &text, &f.fault), &f.fault);
    ck_assert_str_eq(text, "equilibrated");
    unit_ok(run_view_parameter_text(v, "darcy", &text, &f.fault), &f.fault);
    ck_assert_str_eq(text, "published");
    ck_assert_int_eq(run_view_parameter(v, "fixed_bed", &value, &f.fault), STATUS_BAD_INPUT);
    unit_says(&f.fault, "fixed_bed");
    f.fault = FAULT_NONE;
    ck_assert_int_eq(run_view_parameter(v, "no_such", &value, &f.fault), STATUS_NOT_FOUND);
    unit_says(&f.fault, "no_such");
    run_view_close(v);
    unit_remove(f.folder);
}
END_TEST

START_TEST(series_have_their_shape_and_stay_until_closed) {
    struct fake_run f = fake_start("  width_l: 7\n");
    double data[2][6] = {{1, 2, 3, 4, 5, 6.5}, {-1, -2, -3, -4, -5, -6}};
    fake_field(&f, "fields/pressure", 3, 2, data[0], 0.5, 0.0125);
    fake_field(&f, "fields/pressure", 3, 2, data[1], 1, 0.0125);
    fake_scalar(&f, "observables/collisions", 17, 1, 0.0125);
    struct run_view *v = fake_open(&f);
    const struct series *a, *b, *c;
    unit_ok(run_view_series(v, "fields/pressure", &a, &f.fault), &f.fault);
    unit_ok(run_view_series(v, "observables/collisions", &b, &f.fault), &f.fault);
    unit_ok(run_view_series(v, "fields/pressure", &c, &f.fault), &f.fault);
    ck_assert_ptr_eq(a, c);
    ck_assert_uint_eq(a->frames, 2);
    ck_assert_uint_eq(a->size, 6);
    ck_assert_int_eq(a->rank, 2);
    ck_assert_uint_eq(a->dims[0], 2);
    ck_assert_double_eq(a->value[6 + 5], -6);
    ck_assert_double_eq(a->time[0], 0.5);
    ck_assert_double_eq(a->step[1], 80);
    ck_assert_int_eq(b->rank, 0);
    ck_assert_double_eq(b->value[0], 17);
    run_view_close(v);
    unit_remove(f.folder);
}
END_TEST

START_TEST(what_is_not_finite_or_not_there_is_named) {
    struct fake_run f = fake_start("  width_l: 7\n");
    double data[] = {1, NAN, 3}, infinite[] = {1, INFINITY};
    fake_append(&f, "observables/wall", 1, (const size_t[]){3}, (double[]){1, 2, 3}, 0.5, 0.0125);
    fake_append(&f, "observables/wall", 1, (const size_t[]){3}, data, 1.5, 0.0125);
    fake_array(&f, "particles/grains/radius", infinite, 2);
    struct run_view *v = fake_open(&f);
    const struct series *s;
    const double *values;
    size_t count;
    ck_assert_int_eq(run_view_series(v, "observables/wall", &s, &f.fault), STATUS_BAD_INPUT);
    unit_says(&f.fault, "result.h5");
    unit_says(&f.fault, "observables/wall");
    unit_says(&f.fault, "frame 1 (time 1.5)");
    f.fault = FAULT_NONE;
    ck_assert_int_eq(run_view_array(v, "particles/grains/radius", &values, &count, &f.fault),
                     STATUS_BAD_INPUT);
    unit_says(&f.fault, "entry 1 is not finite");
    f.fault = FAULT_NONE;
    ck_assert_int_eq(run_view_series(v, "fields/none", &s, &f.fault), STATUS_NOT_FOUND);
    unit_says(&f.fault, "fields/none");
    run_view_close(v);
    unit_remove(f.folder);
}
END_TEST

START_TEST(time_must_increase) {
    struct fake_run f = fake_start("  width_l: 7\n");
    size_t count = 3;
    double time[] = {0, 1, 1}, step[] = {0, 1, 2};
    fake_array(&f, "observables/x/value", step, count);
    fake_array(&f, "observables/x/step", step, count);
    fake_array(&f, "observables/x/time", time, count);
    fake_array(&f, "observables/y/value", step, count);
    fake_array(&f, "observables/y/step", step, 2);
    fake_array(&f, "observables/y/time", time, count);
    struct run_view *v = fake_open(&f);
    const struct series *s;
    ck_assert_int_eq(run_view_series(v, "observables/x", &s, &f.fault), STATUS_BAD_INPUT);
    unit_says(&f.fault, "does not increase at frame 2");
    f.fault = FAULT_NONE;
    ck_assert_int_eq(run_view_series(v, "observables/y", &s, &f.fault), STATUS_BAD_INPUT);
    unit_says(&f.fault, "one entry a frame");
    run_view_close(v);
    unit_remove(f.folder);
}
END_TEST

int main(void) {
    const TTest *const tests[] = {parameters_come_from_the_run_file_then_from_the_result,
                                  series_have_their_shape_and_stay_until_closed,
                                  what_is_not_finite_or_not_there_is_named, time_must_increase,
                                  NULL};
    return unit_run("run_view", tests);
}
