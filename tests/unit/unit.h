/* unit.h -- the few lines that every unit test shares: a main and a folder to write in. */
#ifndef UNIT_H
#define UNIT_H

#include "common/fault.h"

#include <check.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* A new temporary folder; removed with all in it by unit_remove. */
static inline const char *unit_folder(void) {
    static char folder[64];
    snprintf(folder, sizeof folder, "/tmp/bedcheck-unit-XXXXXX");
    ck_assert_ptr_nonnull(mkdtemp(folder));
    return folder;
}

static inline void unit_remove(const char *folder) {
    char command[128];
    ck_assert(strncmp(folder, "/tmp/bedcheck-unit-", 19) == 0);
    snprintf(command, sizeof command, "rm -rf '%s'", folder);
    ck_assert_int_eq(system(command), 0);
}

/* "folder/name" in a ring of static buffers. */
static inline const char *unit_path(const char *folder, const char *name) {
    static char path[8][256];
    static unsigned next;
    char *out = path[next++ % 8];
    snprintf(out, sizeof path[0], "%s/%s", folder, name);
    return out;
}

static inline void unit_write(const char *path, const char *text) {
    FILE *file = fopen(path, "w");
    ck_assert_ptr_nonnull(file);
    ck_assert_int_ge(fputs(text, file), 0);
    ck_assert_int_eq(fclose(file), 0);
}

/* The fault says `words`; on failure both are printed. */
static inline void unit_says(const struct fault *fault, const char *words) {
    ck_assert_msg(strstr(fault->text, words) != NULL, "expected '%s' in: %s", words, fault->text);
}

static inline void unit_ok(enum status status, const struct fault *fault) {
    ck_assert_msg(status == STATUS_OK, "status %d: %s", (int)status, fault->text);
}

/* Run a suite; the program's exit code. */
static inline int unit_finish(Suite *suite) {
    SRunner *runner = srunner_create(suite);
    srunner_run_all(runner, CK_NORMAL);
    int failed = srunner_ntests_failed(runner);
    srunner_free(runner);
    return failed == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}

/* A suite of one group of tests without loops. */
static inline int unit_run(const char *name, const TTest *const *tests) {
    Suite *suite = suite_create(name);
    TCase *group = tcase_create(name);
    tcase_set_timeout(group, 120);
    for (; *tests != NULL; tests++)
        tcase_add_test(group, *tests);
    suite_add_tcase(suite, group);
    return unit_finish(suite);
}

#endif
