/* test_bits.c -- validation/bits.h: any other bit shows, and nothing else does. */
#include "common/h5.h"
#include "tests/unit/unit.h"
#include "validation/bits.h"

#include <math.h>

/* A result of one series of two samples, one array, and a note. */
static struct digest bits_of(const char *folder, const double *value, double time, double extra,
                             const char *note, bool reversed) {
    struct fault fault = FAULT_NONE;
    struct h5_writer *w;
    struct digest d;
    const size_t three = 3, two = 2;
    const double radius[] = {0.37, 0.41};
    const char *path = unit_path(folder, "run.h5");
    const char *names[] = {"observables/speed", "particles/grains/radius"};
    const char *turned[] = {names[1], names[0]};
    unit_ok(h5_create(path, &w, &fault), &fault);
    for (int i = 0; i < 2; i++)
        unit_ok(h5_append(w, "observables/speed", H5_REAL, 1, &three, value + 3 * i, "U0", 7 + i,
                          time * (i + 1), "tau", &fault),
                &fault);
    unit_ok(h5_write(w, "particles/grains/radius", H5_REAL, 1, &two, radius, "l", &fault), &fault);
    unit_ok(h5_write(w, "observables/unasked", H5_REAL, 0, NULL, &extra, "1", &fault), &fault);
    unit_ok(h5_attribute_text(w, "parameters", "note", note, &fault), &fault);
    unit_ok(h5_commit(w, &fault), &fault);
    unit_ok(bits_of_result(path, reversed ? turned : names, 2, &d, &fault), &fault);
    return d;
}

START_TEST(only_values_asked_for_count) {
    const char *folder = unit_folder();
    double value[] = {1.37e-6, 0.611, -3.3, 2.9e5, 0, 0.07}, other[6];
    struct digest d = bits_of(folder, value, 0.31, 1.7, "a", false);
    ck_assert_str_eq(d.hex, bits_of(folder, value, 0.31, 1.7, "a", false).hex);
    ck_assert_str_eq(d.hex, bits_of(folder, value, 0.31, 1.7, "another note", false).hex);
    ck_assert_str_eq(d.hex, bits_of(folder, value, 0.31, 1.8, "a", false).hex);
    ck_assert_str_eq(d.hex, bits_of(folder, value, 0.31, 1.7, "a", true).hex);
    ck_assert_str_ne(d.hex, bits_of(folder, value, 0.32, 1.7, "a", false).hex);
    for (int i = 0; i < 6; i++) { /* the last bit of each value; -0 is not 0 */
        memcpy(other, value, sizeof other);
        other[i] = i == 4 ? -0.0 : nextafter(value[i], 1e9);
        ck_assert_str_ne(d.hex, bits_of(folder, other, 0.31, 1.7, "a", false).hex);
    }
    unit_remove(folder);
}
END_TEST

START_TEST(a_missing_dataset_is_a_fault) {
    struct fault fault = FAULT_NONE;
    struct digest d;
    const double value[] = {1, 2, 3, 4, 5, 6};
    const char *folder = unit_folder(), *name = "observables/sped";
    bits_of(folder, value, 0.31, 1.7, "a", false);
    ck_assert_int_ne(bits_of_result(unit_path(folder, "run.h5"), &name, 1, &d, &fault), STATUS_OK);
    unit_says(&fault, "observables/sped");
    unit_remove(folder);
}
END_TEST

static struct bits_build build_of(const char *folder, const char *text) {
    struct fault fault = FAULT_NONE;
    struct bits_build b;
    const char *path = unit_path(folder, "run.run.json");
    unit_write(path, text);
    unit_ok(bits_read_build(path, &b, &fault), &fault);
    return b;
}

START_TEST(the_class_of_build_leaves_out_what_does_not_matter) {
    const char *folder = unit_folder();
    struct bits_build b = build_of(
        folder, "{\"format\": \"bedsim-record 1\", \"build\": {\"commit\": \"ab12\", \"dirty\": "
                "\"clean\", \"compiler\": \"gcc 12.2.0\", \"flags\": \"-g -Wall  -O2 -std=c11 "
                "-ffp-contract=off -ffile-prefix-map=/home/x/=\", \"machine\": \"x86_64\", "
                "\"libc\": \"glibc 2.36 1a2b3c4d\", \"host\": \"a:b\"}}");
    ck_assert_str_eq(b.name, "gcc-12/-O2,-ffp-contract=off/x86_64/glibc-2.36-1a2b3c4d");
    ck_assert_str_eq(b.commit, "ab12");
    ck_assert_str_eq(b.dirty, "clean");
    b = build_of(folder, "{\"build\": {\"compiler\": \"clang 14.0.6\", \"flags\": \"-O3\"}}");
    ck_assert_str_eq(b.name, "clang-14/-O3/unknown/unknown");
    ck_assert_str_eq(b.commit, "unknown");
    b = build_of(folder, "{\"started\": \"today\"}");
    ck_assert_str_eq(b.name, "unknown/unknown/unknown/unknown");
    ck_assert_str_eq(b.dirty, "unknown");
    unit_remove(folder);
}
END_TEST

START_TEST(no_record_is_an_unknown_build) {
    struct fault fault = FAULT_NONE;
    struct bits_build b;
    unit_ok(bits_read_build("/tmp/no-such-folder/x.run.json", &b, &fault), &fault);
    ck_assert_str_eq(b.commit, "unknown");
    ck_assert_str_eq(b.name, "unknown/unknown/unknown/unknown");
}
END_TEST

int main(void) {
    const TTest *tests[] = {only_values_asked_for_count, a_missing_dataset_is_a_fault,
                            the_class_of_build_leaves_out_what_does_not_matter,
                            no_record_is_an_unknown_build, NULL};
    return unit_run("bits", tests);
}
