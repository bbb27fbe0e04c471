/* test_readings.c -- validation/readings.h: a file of readings, and every way to spoil one. */
#include "tests/unit/unit.h"
#include "validation/readings.h"

#include <sys/stat.h>

static const char good[] =
    "model: fake\n"
    "readings:\n"
    "  literal: {title: As stated, because: the paper says so, parameters: {scale: 1}}\n"
    "  fitted-2: {title: Fitted, because: it fits, parameters: {scale: 0.284, width_R: 30, "
    "bands: [0.31, 0.2]}}\n"
    "  bare: {title: Nothing set, because: a reading may be the absence of one, parameters: {}}\n";

/* `good` with one text replaced by another, as readings/FILE of a new folder. */
static const char *write_file(const char *file, const char *from, const char *to) {
    const char *folder = unit_folder(), *at = strstr(good, from);
    char text[2048], path[256];
    ck_assert_msg(at != NULL, "no '%s' in the readings", from);
    snprintf(text, sizeof text, "%.*s%s%s", (int)(at - good), good, to, at + strlen(from));
    ck_assert_int_eq(mkdir(unit_path(folder, "readings"), 0755), 0);
    snprintf(path, sizeof path, "%s/readings/%s", folder, file);
    unit_write(path, text);
    return folder;
}

START_TEST(a_good_file_is_read) {
    struct fault fault = FAULT_NONE;
    struct readings *r;
    const char *folder = write_file("fake.yaml", "fake", "fake");
    unit_ok(readings_load(folder, "fake", &r, &fault), &fault);
    ck_assert_uint_eq(readings_all(r)->count, 3);
    const struct yaml_node *p = readings_parameters(r, "fitted-2");
    ck_assert_str_eq(yaml_get(p, "scale")->text, "0.284");
    ck_assert_uint_eq(yaml_get(p, "bands")->count, 2);
    ck_assert_uint_eq(readings_parameters(r, "bare")->count, 0);
    ck_assert_ptr_null(readings_parameters(r, "fitted"));
    readings_free(r);
    unit_ok(readings_check_folder(folder, &fault), &fault);
    unit_remove(folder);
}
END_TEST

START_TEST(what_is_not_there_is_said) {
    struct fault fault = FAULT_NONE;
    struct readings *r;
    const char *folder = unit_folder();
    unit_ok(readings_check_folder(folder, &fault), &fault);
    ck_assert_int_eq(readings_load(folder, "fake", &r, &fault), STATUS_NOT_FOUND);
    ck_assert_ptr_null(r);
    unit_says(&fault, "readings/fake.yaml");
    unit_remove(folder);
}
END_TEST

static const struct {
    const char *from, *to, *says;
} bad[] = {
    {"model: fake", "model: other", "fake.yaml:1:8: model: other, but the file must hold the"},
    {"model: fake\n", "", "model: missing"},
    {"model: fake", "model: fake\nmodels: fake", "did you mean 'model'?"},
    {"title: As stated", "titel: As stated", "did you mean 'title'?"},
    {"title: As stated", "title: ' '", "title: must not be empty"},
    {"because: it fits, ", "", "because: missing"},
    {"parameters: {scale: 1}", "parameters: 1", "parameters"},
    {"literal:", "Literal:", "reading Literal: a name has lower-case letters"},
    {"scale: 1}", "scale: {a: 1}}", "scale: must be a value or a list of values"},
    {"scale: 1}", "sc/ale: 1}", "sc/ale: not a name of a parameter"},
    {"scale: 1}", "reading: bare}", "a reading cannot name another"},
    {"  bare: {", "  naked: 3\n  bare: {", "reading naked: must be {title: "},
};

START_TEST(every_fault_is_told) {
    struct fault fault = FAULT_NONE;
    struct readings *r;
    const char *folder = write_file("fake.yaml", bad[_i].from, bad[_i].to);
    ck_assert_int_eq(readings_load(folder, "fake", &r, &fault), STATUS_BAD_INPUT);
    ck_assert_ptr_null(r);
    unit_says(&fault, bad[_i].says);
    fault = FAULT_NONE;
    ck_assert_int_eq(readings_check_folder(folder, &fault), STATUS_BAD_INPUT);
    unit_says(&fault, bad[_i].says);
    unit_remove(folder);
}
END_TEST

START_TEST(the_folder_holds_nothing_else) {
    static const char *const file[] = {"fake.yml", "Fake.yaml", ".yaml.yaml~"};
    for (size_t i = 0; i < 2; i++) {
        struct fault fault = FAULT_NONE;
        const char *folder = write_file(file[i], "fake", "fake");
        ck_assert_int_eq(readings_check_folder(folder, &fault), STATUS_BAD_INPUT);
        unit_says(&fault, "not MODEL.yaml");
        unit_remove(folder);
    }
    struct fault fault = FAULT_NONE; /* an editor's file is hidden and no matter */
    const char *folder = write_file(file[2], "fake", "fake");
    unit_ok(readings_check_folder(folder, &fault), &fault);
    unit_remove(folder);
}
END_TEST

START_TEST(the_readings_of_the_suite_are_whole) {
    struct fault fault = FAULT_NONE;
    unit_ok(readings_check_folder("validation/cases", &fault), &fault);
}
END_TEST

int main(void) {
    Suite *suite = suite_create("readings");
    TCase *group = tcase_create("readings");
    tcase_add_test(group, a_good_file_is_read);
    tcase_add_test(group, what_is_not_there_is_said);
    tcase_add_loop_test(group, every_fault_is_told, 0, sizeof bad / sizeof *bad);
    tcase_add_test(group, the_folder_holds_nothing_else);
    tcase_add_test(group, the_readings_of_the_suite_are_whole);
    suite_add_tcase(suite, group);
    return unit_finish(suite);
}
