/* test_reference_curve.c -- validation/reference_curve.h: a curve is what its name says, or none.
 */
#include "common/h5.h"
#include "tests/unit/unit.h"
#include "validation/reference_curve.h"

#include <math.h>
#include <sys/stat.h>

static const double x[] = {0.37, 1.41, 2.59}, mean[] = {0.611, 0.587, 1.37e-6},
                    deviation[] = {0.0031, 0.0047, 2.2e-7};
static const struct reference_curve sample = {3, 37, x, mean, deviation};

/* Written as folder/curves/HEX.h5; says HEX. */
static struct digest store(const char *folder, const struct reference_curve *c) {
    struct fault fault = FAULT_NONE;
    struct digest d;
    char name[128];
    mkdir(unit_path(folder, "curves"), 0755);
    unit_ok(reference_curve_write(unit_path(folder, "new.h5"), c, &d, &fault), &fault);
    snprintf(name, sizeof name, "curves/%s.h5", d.hex);
    ck_assert_int_eq(rename(unit_path(folder, "new.h5"), unit_path(folder, name)), 0);
    return d;
}

START_TEST(a_curve_comes_back_and_the_same_gives_the_same_bytes) {
    struct fault fault = FAULT_NONE;
    struct arena a = {0};
    struct reference_curve c;
    const char *folder = unit_folder();
    struct digest first = store(folder, &sample), second = store(folder, &sample);
    ck_assert_str_eq(first.hex, second.hex);
    unit_ok(reference_curve_read(folder, first.hex, &a, &c, &fault), &fault);
    ck_assert_uint_eq(c.count, 3);
    ck_assert_uint_eq(c.seeds, 37);
    for (size_t i = 0; i < 3; i++) {
        ck_assert_double_eq(c.x[i], x[i]);
        ck_assert_double_eq(c.mean[i], mean[i]);
        ck_assert_double_eq(c.deviation[i], deviation[i]);
    }
    arena_free(&a);
    unit_remove(folder);
}
END_TEST

START_TEST(a_curve_under_the_name_of_another_is_refused) {
    struct fault fault = FAULT_NONE;
    struct arena a = {0};
    struct reference_curve c, other = sample;
    char one[128], two[128];
    const char *folder = unit_folder();
    struct digest d = store(folder, &sample);
    other.seeds = 38;
    struct digest e = store(folder, &other);
    ck_assert_str_ne(d.hex, e.hex);
    snprintf(one, sizeof one, "curves/%s.h5", d.hex);
    snprintf(two, sizeof two, "curves/%s.h5", e.hex);
    ck_assert_int_eq(rename(unit_path(folder, two), unit_path(folder, one)), 0);
    ck_assert_int_eq(reference_curve_read(folder, d.hex, &a, &c, &fault), STATUS_BAD_INPUT);
    unit_says(&fault, "does not fit its name");
    unit_says(&fault, e.hex);
    fault = FAULT_NONE;
    ck_assert_int_eq(reference_curve_read(folder, e.hex, &a, &c, &fault), STATUS_NOT_FOUND);
    arena_free(&a);
    unit_remove(folder);
}
END_TEST

START_TEST(what_is_no_curve_is_not_written) {
    struct fault fault = FAULT_NONE;
    struct digest d;
    const char *folder = unit_folder(), *path = unit_path(folder, "bad.h5");
    const double backward[] = {0.37, 1.41, 1.41}, hole[] = {0.611, NAN, 0.587};
    struct reference_curve bad[] = {sample, sample, sample};
    bad[0].x = backward;
    bad[1].mean = hole;
    bad[2].count = 0;
    for (size_t i = 0; i < 3; i++) {
        fault = FAULT_NONE;
        ck_assert_int_eq(reference_curve_write(path, &bad[i], &d, &fault), STATUS_BAD_INPUT);
        ck_assert_int_ne(access(path, F_OK), 0);
    }
    unit_remove(folder);
}
END_TEST

int main(void) {
    const TTest *tests[] = {a_curve_comes_back_and_the_same_gives_the_same_bytes,
                            a_curve_under_the_name_of_another_is_refused,
                            what_is_no_curve_is_not_written, NULL};
    return unit_run("reference_curve", tests);
}
