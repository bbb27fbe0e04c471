/* test_key.c -- validation/key.h: everything that a result depends on changes its key. */
#include "common/file.h"
#include "tests/unit/unit.h"
#include "validation/key.h"

#include <sys/stat.h>

static struct digest key_of(const struct key_parts *p) {
    struct fault fault = FAULT_NONE;
    struct digest d;
    unit_ok(key_make(p, &d, &fault), &fault);
    return d;
}

START_TEST(each_part_changes_the_key) {
    const char *settings[] = {"restitution=0.5", "darcy=corrected"};
    const char *joined[] = {"restitution=0.5darcy=corrected"};
    const struct key_parts base = {"grains: 7\n", 1101, NULL, "ab12", settings, 0};
    struct key_parts other[] = {base, base, base, base, base, base, base};
    other[0].meaning = "grains: 8\n";
    other[1].seed = 1102;
    other[2].start = "77aa";
    other[3].solver = "ab13";
    other[4].setting_count = 1;
    other[5].setting_count = 2;
    other[6].settings = joined;
    other[6].setting_count = 1;
    struct digest first = key_of(&base), again = key_of(&base);
    ck_assert_str_eq(first.hex, again.hex);
    for (size_t i = 0; i < sizeof other / sizeof *other; i++) {
        struct digest d = key_of(&other[i]);
        ck_assert_str_ne(first.hex, d.hex);
        for (size_t k = 0; k < i; k++)
            ck_assert_str_ne(d.hex, key_of(&other[k]).hex);
    }
}
END_TEST

START_TEST(a_record_comes_back_as_it_was_written) {
    struct fault fault = FAULT_NONE;
    const char *folder = unit_folder(), *path = unit_path(folder, "a.key");
    struct key_record in = {.seconds = 12.375,
                            .bytes = 1234567,
                            .failure = "crashed: \"signal\" 11\nsecond line"},
                      out;
    memset(in.key, 'a', 64);
    memset(in.solver, '7', 64);
    unit_ok(key_write(path, &in, &fault), &fault);
    unit_ok(key_read(path, &out, &fault), &fault);
    ck_assert_str_eq(out.key, in.key);
    ck_assert_str_eq(out.solver, in.solver);
    ck_assert_double_eq(out.seconds, 12.375);
    ck_assert_double_eq(out.bytes, 1234567);
    ck_assert_str_eq(out.failure, "crashed: \"signal\" 11 second line");
    unit_remove(folder);
}
END_TEST

START_TEST(a_damaged_record_is_refused) {
    struct fault fault = FAULT_NONE;
    struct key_record out;
    const char *folder = unit_folder(), *path = unit_path(folder, "a.key");
    ck_assert_int_eq(key_read(path, &out, &fault), STATUS_NOT_FOUND);
    static const char *const text[] = {
        "", "key: 1\n",
        ("format: bedcheck-key 1\nkey: zz\nsolver: zz\nseconds: 1\nbytes: 1\n"
         "failure: \"\"\n")};
    for (size_t i = 0; i < sizeof text / sizeof *text; i++) {
        fault = FAULT_NONE;
        unit_write(path, text[i]);
        ck_assert_int_ne(key_read(path, &out, &fault), STATUS_OK);
    }
    unit_remove(folder);
}
END_TEST

START_TEST(a_program_is_found_as_a_shell_finds_it) {
    struct fault fault = FAULT_NONE;
    const char *folder = unit_folder(), *path = unit_path(folder, "solver-x");
    char list[512], *found;
    snprintf(list, sizeof list, "/nowhere::%s", folder);
    unit_write(path, "#!/bin/sh\n");
    ck_assert_int_eq(key_find_program("solver-x", list, &found, &fault), STATUS_NOT_FOUND);
    ck_assert_int_eq(chmod(path, 0755), 0);
    unit_ok(key_find_program("solver-x", list, &found, &fault), &fault);
    ck_assert_str_eq(found, path);
    free(found);
    unit_ok(key_find_program(path, NULL, &found, &fault), &fault);
    free(found);
    ck_assert_int_eq(key_find_program("solver-x", NULL, &found, &fault), STATUS_NOT_FOUND);
    ck_assert_int_eq(key_find_program(folder, NULL, &found, &fault), STATUS_NOT_FOUND);
    ck_assert_int_eq(key_find_program("python3 x.py", list, &found, &fault), STATUS_NOT_FOUND);
    unit_says(&fault, "one program without arguments");
    unit_remove(folder);
}
END_TEST

int main(void) {
    const TTest *const tests[] = {each_part_changes_the_key, a_record_comes_back_as_it_was_written,
                                  a_damaged_record_is_refused,
                                  a_program_is_found_as_a_shell_finds_it, NULL};
    return unit_run("key", tests);
}
