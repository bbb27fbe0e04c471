/* test_execute.c -- validation/execute.h: order, reuse, failures and what they leave behind. */
#include "common/file.h"
#include "tests/unit/unit.h"
#include "validation/execute.h"

#include <math.h>
#include <sys/stat.h>

static char *environment[] = {(char[]){"PATH=/usr/bin:/bin"}, NULL};

/* A folder, a solver made of shell, and three runs: `late` starts from `early`. */
struct stage {
    const char *parent;
    char solver[256];
    struct digest key;
    struct folder *folder;
    struct plan_run early, late, other;
    struct plan_run *run[3];
    struct plan plan;
    struct outcome outcome[3];
    struct execute_options o;
    size_t told;
};

static bool count_told(void *context, size_t run) {
    (void)run;
    ++*(size_t *)context;
    return true;
}

static void build(struct stage *s, const char *script) {
    struct fault fault = FAULT_NONE;
    char text[1024];
    snprintf(text, sizeof text, "#!/bin/sh\n# run RUN --seed N --out FILE\nname=${2##*/}\n%s\n",
             script);
    unit_write(s->solver, text);
    ck_assert_int_eq(chmod(s->solver, 0755), 0);
    unit_ok(digest_file(s->solver, &s->key, &fault), &fault);
}

static void set_up(struct stage *s, const char *script) {
    struct fault fault = FAULT_NONE;
    *s = (struct stage){.parent = unit_folder()};
    snprintf(s->solver, sizeof s->solver, "%s", unit_path(s->parent, "solver"));
    build(s, script);
    unit_ok(folder_open(unit_path(s->parent, "out"), true, &s->folder, &fault), &fault);
    s->early = (struct plan_run){.id = "early",
                                 .name = "early-s3",
                                 .run_file = "early.yaml",
                                 .text = "e # line 1\n",
                                 .meaning = "e\n",
                                 .seed = 3,
                                 .limit_s = 20};
    s->late = (struct plan_run){.id = "late",
                                .name = "late-s3",
                                .run_file = "late-s3.yaml",
                                .text = "l\n",
                                .meaning = "l\n",
                                .seed = 3,
                                .index = 1,
                                .start = &s->early,
                                .limit_s = 20};
    s->other = (struct plan_run){.id = "other",
                                 .name = "other-s4",
                                 .run_file = "other.yaml",
                                 .text = "o\n",
                                 .meaning = "o\n",
                                 .seed = 4,
                                 .index = 2,
                                 .limit_s = 20};
    s->run[0] = &s->early;
    s->run[1] = &s->late;
    s->run[2] = &s->other;
    s->plan = (struct plan){.run_count = 3, .run = s->run};
    s->o = (struct execute_options){.folder = s->folder,
                                    .solver = s->solver,
                                    .solver_key = s->key.hex,
                                    .jobs = 2,
                                    .environment = environment,
                                    .finished = count_told,
                                    .context = &s->told};
}

static void tear_down(struct stage *s) {
    folder_close(s->folder);
    unit_remove(s->parent);
}

static enum status execute(struct stage *s, struct fault *fault) {
    *fault = FAULT_NONE;
    memset(s->outcome, 0, sizeof s->outcome);
    s->told = 0;
    return execute_plan(&s->plan, &s->o, s->outcome, fault);
}

static bool has_result(const struct stage *s, const char *file) {
    char path[256];
    snprintf(path, sizeof path, "%s/h5/%s", folder_path(s->folder), file);
    return file_exists(path);
}

static const char copies[] = "echo \"$name $4\" > \"$6\"";

START_TEST(runs_are_made_once_and_then_reused) {
    struct stage s;
    struct fault fault;
    set_up(&s, copies);
    unit_ok(execute(&s, &fault), &fault);
    for (int i = 0; i < 3; i++)
        ck_assert_int_eq(s.outcome[i].state, RUN_DONE);
    ck_assert_uint_eq(s.told, 3);
    ck_assert(has_result(&s, "late-s3.h5") && has_result(&s, "late-s3.key"));
    unit_ok(execute(&s, &fault), &fault);
    for (int i = 0; i < 3; i++) {
        ck_assert_int_eq(s.outcome[i].state, RUN_REUSED);
        ck_assert(isfinite(s.outcome[i].seconds));
    }
    s.early.text = "e # line 2\n"; /* a comment is no meaning */
    unit_ok(execute(&s, &fault), &fault);
    ck_assert_int_eq(s.outcome[0].state, RUN_REUSED);
    s.early.meaning = "e2\n"; /* its result stays the same: the heir may stay */
    unit_ok(execute(&s, &fault), &fault);
    ck_assert_int_eq(s.outcome[0].state, RUN_DONE);
    ck_assert_int_eq(s.outcome[1].state, RUN_REUSED);
    const char *setting[] = {"a=1"};
    s.o.setting = setting;
    s.o.setting_count = 1;
    unit_ok(execute(&s, &fault), &fault);
    for (int i = 0; i < 3; i++)
        ck_assert_int_eq(s.outcome[i].state, RUN_DONE);
    tear_down(&s);
}
END_TEST

START_TEST(another_start_file_makes_the_heir_stale) {
    struct stage s;
    struct fault fault;
    char path[256];
    set_up(&s, copies);
    unit_ok(execute(&s, &fault), &fault);
    snprintf(path, sizeof path, "%s/h5/early-s3.h5", folder_path(s.folder));
    unit_write(path, "early.yaml 4\n"); /* as long as before */
    unit_ok(execute(&s, &fault), &fault);
    ck_assert_int_eq(s.outcome[1].state, RUN_DONE);
    ck_assert_int_eq(s.outcome[2].state, RUN_REUSED);
    tear_down(&s);
}
END_TEST

START_TEST(failures_are_told_and_leave_no_result) {
    static const struct {
        const char *script, *says;
    } way[] = {
        {"[ $name = early.yaml ] && { echo half > \"$6\"; exit 1; }; echo x > \"$6\"",
         "numerical fault (exit code 1)"},
        {"[ $name = early.yaml ] && { echo half > \"$6\"; kill -ABRT $$; }; echo x > \"$6\"",
         "SIGABRT"},
        {"[ $name = early.yaml ] && exit 77; echo x > \"$6\"", "exit code 77"},
        {"[ $name = early.yaml ] && exit 0; echo x > \"$6\"", "wrote no result file"},
        {"[ $name = early.yaml ] && ln -s /etc/passwd \"$6\" && exit 0; echo x > \"$6\"",
         "wrote no result file"},
    };
    for (size_t i = 0; i < sizeof way / sizeof *way; i++) {
        struct stage s;
        struct fault fault;
        set_up(&s, way[i].script);
        unit_ok(execute(&s, &fault), &fault);
        ck_assert_int_eq(s.outcome[0].state, RUN_FAILED);
        ck_assert_msg(strstr(s.outcome[0].failure, way[i].says) != NULL, "%s",
                      s.outcome[0].failure);
        ck_assert_int_eq(s.outcome[1].state, RUN_FAILED);
        ck_assert_ptr_nonnull(strstr(s.outcome[1].failure, "starts from, early-s3, failed"));
        ck_assert_int_eq(s.outcome[2].state, RUN_DONE);
        ck_assert(!has_result(&s, "early-s3.h5") && has_result(&s, "other-s4.h5"));
        build(&s, copies); /* mended: all is run again */
        unit_ok(execute(&s, &fault), &fault);
        ck_assert_int_eq(s.outcome[1].state, RUN_DONE);
        tear_down(&s);
    }
}
END_TEST

START_TEST(a_refusal_stops_everything) {
    struct stage s;
    struct fault fault;
    set_up(&s, "[ $name = other.yaml ] && { echo 'why not' >&2; exit 2; }; sleep 20");
    ck_assert_int_eq(execute(&s, &fault), STATUS_BAD_INPUT);
    unit_says(&fault, "other-s4: the solver refuses its input");
    unit_says(&fault, "why not");
    unit_says(&fault, "repeat with: ");
    ck_assert_int_eq(s.outcome[0].state, RUN_WAITING);
    ck_assert(!has_result(&s, "early-s3.key"));
    tear_down(&s);
}
END_TEST

START_TEST(the_limit_of_the_call_goes_before_the_case_s) {
    struct stage s;
    struct fault fault;
    set_up(&s, "[ $name = other.yaml ] && sleep 20; echo x > \"$6\"");
    s.o.limit_s = 0.4;
    unit_ok(execute(&s, &fault), &fault);
    ck_assert_int_eq(s.outcome[2].state, RUN_FAILED);
    ck_assert_ptr_nonnull(strstr(s.outcome[2].failure, "timed out"));
    ck_assert_ptr_nonnull(strstr(s.outcome[2].failure, "limit 0.4 s"));
    tear_down(&s);
}
END_TEST

START_TEST(a_log_s_end_is_its_last_lines_without_control_characters) {
    struct arena a = {0};
    const char *folder = unit_folder(), *path = unit_path(folder, "a.log");
    unit_write(path, "one\ntwo\nthree \033[31m\nfour\n\n");
    ck_assert_str_eq(execute_log_end(path, 2, &a), "three  [31m\nfour");
    ck_assert_str_eq(execute_log_end(path, 99, &a), "one\ntwo\nthree  [31m\nfour");
    ck_assert_str_eq(execute_log_end(unit_path(folder, "none"), 2, &a), "");
    arena_free(&a);
    unit_remove(folder);
}
END_TEST

START_TEST(the_command_can_be_given_to_a_shell) {
    struct stage s;
    struct arena a = {0};
    const char *setting[] = {"label=it's a 'b'"};
    set_up(&s, copies);
    s.o.setting = setting;
    s.o.setting_count = 1;
    const char *line = execute_command_line(&s.early, &s.o, "my result.h5", &a);
    ck_assert_ptr_nonnull(strstr(line, " --seed 3 --out 'my result.h5' --set 'label=it'\\''s a "
                                       "'\\''b'\\'''"));
    char **word = execute_command(&s.early, &s.o, &a);
    ck_assert_str_eq(word[1], "run");
    ck_assert_str_eq(word[8], setting[0]);
    ck_assert_ptr_null(word[9]);
    arena_free(&a);
    tear_down(&s);
}
END_TEST

int main(void) {
    const TTest *const tests[] = {runs_are_made_once_and_then_reused,
                                  another_start_file_makes_the_heir_stale,
                                  failures_are_told_and_leave_no_result,
                                  a_refusal_stops_everything,
                                  the_limit_of_the_call_goes_before_the_case_s,
                                  a_log_s_end_is_its_last_lines_without_control_characters,
                                  the_command_can_be_given_to_a_shell,
                                  NULL};
    return unit_run("execute", tests);
}
