/* test_folder.c -- validation/folder.h: whose folder it is, its record, and what clean removes. */
#include "common/file.h"
#include "tests/unit/unit.h"
#include "validation/folder.h"
#include "validation/key.h"

#include <sys/stat.h>

static struct folder *make(const char *path) {
    struct fault fault = FAULT_NONE;
    struct folder *f;
    unit_ok(folder_open(path, true, &f, &fault), &fault);
    return f;
}

static const char *const names[] = {"fake/a", "fake/b"};
static const char *const skips[] = {"", "its \"paper\"\nis \\ lost: [x]"};
static const char *const settings[] = {"restitution=0.5", "label='a, b' # c"};

static struct folder_record record(void) {
    char *key = calloc(1, 65);
    ck_assert_ptr_nonnull(key);
    memset(key, 'b', 64);
    return (struct folder_record){.cases_folder = "/odd folder/c: \"d\"",
                                  .tier = "smoke",
                                  .started = "2026-01-02T03:04:05Z",
                                  .solver = "./sol ver",
                                  .solver_key = key,
                                  .seed_offset = 5000,
                                  .case_count = 2,
                                  .case_name = names,
                                  .skip_reason = skips,
                                  .setting_count = 2,
                                  .setting = settings};
}

START_TEST(a_record_comes_back_as_it_was_written) {
    struct fault fault = FAULT_NONE;
    const char *parent = unit_folder();
    struct folder *f = make(unit_path(parent, "out"));
    struct folder_record in = record(), out;
    unit_ok(folder_write_record(f, &in, &fault), &fault);
    unit_ok(folder_read_record(f, &out, &fault), &fault);
    ck_assert_str_eq(out.cases_folder, in.cases_folder);
    ck_assert_str_eq(out.solver, in.solver);
    ck_assert_str_eq(out.solver_key, in.solver_key);
    ck_assert_int_eq((int)out.seed_offset, 5000);
    ck_assert_uint_eq(out.case_count, 2);
    ck_assert_str_eq(out.case_name[1], "fake/b");
    ck_assert_str_eq(out.skip_reason[1], skips[1]);
    ck_assert_str_eq(out.setting[1], settings[1]);
    folder_record_free(&out);
    folder_close(f);
    free((char *)in.solver_key);
    unit_remove(parent);
}
END_TEST

START_TEST(a_folder_of_others_is_refused_and_ours_is_locked) {
    struct fault fault = FAULT_NONE;
    const char *parent = unit_folder();
    struct folder *f, *g;
    unit_write(unit_path(parent, "thesis.txt"), "mine");
    ck_assert_int_eq(folder_open(parent, true, &f, &fault), STATUS_BAD_INPUT);
    ck_assert_int_eq(folder_check(parent, &fault), STATUS_BAD_INPUT);
    ck_assert_int_eq(folder_open(unit_path(parent, "none"), false, &f, &fault), STATUS_NOT_FOUND);
    unit_ok(folder_check(unit_path(parent, "none"), &fault), &fault);
    f = make(unit_path(parent, "out/"));
    ck_assert_str_eq(folder_path(f), unit_path(parent, "out"));
    ck_assert_int_eq(folder_open(unit_path(parent, "out"), true, &g, &fault), STATUS_IO);
    unit_says(&fault, "another bedcheck works in this folder");
    folder_close(f);
    f = make(unit_path(parent, "out")); /* without a record, but with nothing foreign */
    folder_close(f);
    unit_remove(parent);
}
END_TEST

START_TEST(a_result_is_dropped_whole_and_alone) {
    struct fault fault = FAULT_NONE;
    const char *parent = unit_folder();
    struct folder *f = make(unit_path(parent, "out"));
    static const char *const gone[] = {"a.1-s7.h5", "a.1-s7.key", "a.1-s7.run.json",
                                       "a.1-s7.h5.tmp.123"};
    static const char *const stay[] = {"a.1-s71.h5", "a.1-s7.txt", "b.1-s7.h5"};
    char path[256];
    for (size_t i = 0; i < 7; i++) {
        snprintf(path, sizeof path, "%s/h5/%s", folder_path(f), i < 4 ? gone[i] : stay[i - 4]);
        unit_write(path, "x");
    }
    unit_ok(folder_drop_result(f, "a.1-s7", &fault), &fault);
    for (size_t i = 0; i < 7; i++) {
        snprintf(path, sizeof path, "%s/h5/%s", folder_path(f), i < 4 ? gone[i] : stay[i - 4]);
        ck_assert_msg(file_exists(path) == (i >= 4), "%s", path);
    }
    folder_close(f);
    unit_remove(parent);
}
END_TEST

START_TEST(clean_knows_its_own_by_name) {
    struct fault fault = FAULT_NONE;
    const char *parent = unit_folder();
    struct folder *f = make(unit_path(parent, "out"));
    static const struct {
        const char *name;
        bool stays;
    } file[] = {{"h5/fake.a.0123abcd-s7.h5", false},
                {"h5/fake.a.0123abcd-s7.key", false},
                {"h5/fake.a.0123abcd-s7.h5.tmp.9", false},
                {"h5/fake.a.h5", true},
                {"h5/fake.a.0123abcd-s7x.h5", true},
                {"runs/fake.a.0123abcd.yaml", false},
                {"runs/notes.yaml", true},
                {"logs/fake.a.0123abcd-s7.log", false},
                {"logs/0123abcd.log", true},
                {"report/index.html", false},
                {"report/figure.png", false},
                {"report/notes.html", true},
                {"results.json", false},
                {"junit.xml", false},
                {"summary.md", false},
                {"letter.md", true}};
    char path[256];
    for (size_t i = 0; i < sizeof file / sizeof *file; i++) {
        snprintf(path, sizeof path, "%s/%s", folder_path(f), file[i].name);
        unit_write(path, "x");
    }
    size_t removed, left;
    unit_ok(folder_clean(f, &removed, &left, &fault), &fault);
    ck_assert_uint_eq(left, 6);
    for (size_t i = 0; i < sizeof file / sizeof *file; i++) {
        snprintf(path, sizeof path, "%s/%s", folder_path(f), file[i].name);
        ck_assert_msg(file_exists(path) == file[i].stays, "%s", path);
    }
    folder_close(f);
    unit_remove(parent);
}
END_TEST

int main(void) {
    const TTest *const tests[] = {
        a_record_comes_back_as_it_was_written, a_folder_of_others_is_refused_and_ours_is_locked,
        a_result_is_dropped_whole_and_alone, clean_knows_its_own_by_name, NULL};
    return unit_run("folder", tests);
}
