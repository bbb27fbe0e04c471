/* test_file.c -- common/file.h: whole or not at all, and nothing outside. */
#include "common/file.h"
#include "tests/unit/unit.h"

#include <sys/stat.h>

START_TEST(what_is_written_is_read_and_nothing_is_left_beside_it) {
    struct fault fault = FAULT_NONE;
    char *text;
    size_t length;
    const char *folder = unit_folder(), *path = unit_path(folder, "a.json");
    unit_ok(file_write(path, "first", 5, &fault), &fault);
    unit_ok(file_write(path, "second\n\0x", 9, &fault), &fault);
    unit_ok(file_read(path, 9, &text, &length, &fault), &fault);
    ck_assert_uint_eq(length, 9);
    ck_assert_mem_eq(text, "second\n\0x", 10);
    free(text);
    char command[256];
    snprintf(command, sizeof command, "test \"$(ls '%s')\" = a.json", folder);
    ck_assert_int_eq(system(command), 0);
    unit_remove(folder);
}
END_TEST

START_TEST(a_file_that_cannot_be_written_leaves_the_old_one) {
    struct fault fault = FAULT_NONE;
    const char *folder = unit_folder();
    ck_assert_int_ne(file_write(unit_path(folder, "no/such/x"), "x", 1, &fault), STATUS_OK);
    unit_says(&fault, "no/such/x: cannot be written");
    const char *taken = unit_path(folder, "taken");
    unit_ok(file_make_folder(taken, &fault), &fault);
    ck_assert_int_ne(file_write(taken, "x", 1, &fault), STATUS_OK); /* rename fails */
    char command[256];
    snprintf(command, sizeof command, "test \"$(ls '%s')\" = taken", folder);
    ck_assert_int_eq(system(command), 0);
    unit_remove(folder);
}
END_TEST

START_TEST(folders_are_made_on_the_way_unless_a_file_stands_there) {
    struct fault fault = FAULT_NONE;
    const char *folder = unit_folder();
    unit_ok(file_make_folder(unit_path(folder, "a/b//c/"), &fault), &fault);
    unit_ok(file_make_folder(unit_path(folder, "a/b/c"), &fault), &fault);
    ck_assert(file_exists(unit_path(folder, "a/b/c")));
    unit_write(unit_path(folder, "a/file"), "");
    ck_assert_int_eq(file_make_folder(unit_path(folder, "a/file/d"), &fault), STATUS_IO);
    unit_says(&fault, "a/file: is not a folder");
    ck_assert_int_eq(file_make_folder(unit_path(folder, "a/file"), &fault), STATUS_IO);
    unit_remove(folder);
}
END_TEST

START_TEST(room_is_asked_for_where_the_folder_would_be) {
    struct fault fault = FAULT_NONE;
    const char *folder = unit_folder();
    unit_ok(file_check_room(unit_path(folder, "not/yet/there"), 4711, &fault), &fault);
    ck_assert(!file_exists(unit_path(folder, "not")));
    ck_assert_int_eq(file_check_room(folder, 1e18, &fault), STATUS_IO);
    unit_says(&fault, "needed");
    ck_assert_int_eq(file_check_room("/proc/none", 1, &fault), STATUS_IO);
    unit_remove(folder);
}
END_TEST

START_TEST(names_stay_inside) {
    ck_assert(file_name_is_inside("x.h5"));
    ck_assert(file_name_is_inside("a/b..c/x.h5"));
    ck_assert(file_name_is_inside("..a"));
    ck_assert(!file_name_is_inside(""));
    ck_assert(!file_name_is_inside("/x"));
    ck_assert(!file_name_is_inside(".."));
    ck_assert(!file_name_is_inside("a/../x"));
    ck_assert(!file_name_is_inside("a/.."));
    ck_assert(!file_name_is_inside("a\nb"));
}
END_TEST

START_TEST(pipes_and_folders_are_no_files) {
    struct fault fault = FAULT_NONE;
    char *text;
    size_t length;
    const char *folder = unit_folder(), *pipe = unit_path(folder, "pipe");
    ck_assert_int_eq(mkfifo(pipe, 0600), 0);
    ck_assert_int_eq(file_read(pipe, 10, &text, &length, &fault), STATUS_BAD_INPUT);
    ck_assert_ptr_null(text);
    ck_assert_int_eq(file_read(folder, 10, &text, &length, &fault), STATUS_BAD_INPUT);
    unit_remove(folder);
}
END_TEST

START_TEST(join_puts_one_slash) {
    char *a = file_join("x", "y"), *b = file_join("x/", "y"), *c = file_join("", "y");
    ck_assert_str_eq(a, "x/y");
    ck_assert_str_eq(b, "x/y");
    ck_assert_str_eq(c, "y");
    free(a);
    free(b);
    free(c);
}
END_TEST

int main(void) {
    const TTest *const tests[] = {what_is_written_is_read_and_nothing_is_left_beside_it,
                                  a_file_that_cannot_be_written_leaves_the_old_one,
                                  folders_are_made_on_the_way_unless_a_file_stands_there,
                                  room_is_asked_for_where_the_folder_would_be,
                                  names_stay_inside,
                                  pipes_and_folders_are_no_files,
                                  join_puts_one_slash,
                                  NULL};
    return unit_run("file", tests);
}
