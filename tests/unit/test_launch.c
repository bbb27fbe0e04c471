/* test_launch.c -- validation/launch.h: ends, limits, groups and signals. */
#include "tests/unit/unit.h"
#include "validation/launch.h"

#include <errno.h>
#include <signal.h>
#include <time.h>

static char *environment[] = {(char[]){"PATH=/usr/bin:/bin"}, NULL};

static double now_s(void) {
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static struct launcher *make(size_t jobs) {
    struct fault fault = FAULT_NONE;
    struct launcher *l;
    unit_ok(launch_create(jobs, environment, &l, &fault), &fault);
    return l;
}

static void start(struct launcher *l, const char *script, const char *log, double limit_s,
                  size_t tag) {
    struct fault fault = FAULT_NONE;
    char shell[] = "/bin/sh", option[] = "-c", text[512];
    snprintf(text, sizeof text, "%s", script);
    char *argv[] = {shell, option, text, NULL};
    unit_ok(launch_start(l, argv, log, limit_s, tag, &fault), &fault);
}

static struct launch_result await(struct launcher *l) {
    struct fault fault = FAULT_NONE;
    struct launch_result r = {0};
    bool got = false;
    for (int i = 0; i < 100 && !got; i++)
        unit_ok(launch_wait(l, 0.5, &r, &got, &fault), &fault);
    ck_assert(got);
    return r;
}

static char *read_text(const char *path) {
    static char text[256];
    FILE *in = fopen(path, "r");
    ck_assert_ptr_nonnull(in);
    text[fread(text, 1, sizeof text - 1, in)] = '\0';
    fclose(in);
    return text;
}

/* Gone, or a zombie that init has yet to take. */
static bool has_ended(pid_t pid) {
    char path[64], line[256];
    snprintf(path, sizeof path, "/proc/%d/stat", (int)pid);
    for (int i = 0; i < 100; i++) {
        FILE *in = fopen(path, "r");
        bool alive =
            in != NULL && fgets(line, sizeof line, in) != NULL && strstr(line, ") Z") == NULL;
        if (in != NULL)
            fclose(in);
        if (!alive)
            return true;
        usleep(20000);
    }
    return false;
}

START_TEST(exit_codes_signals_and_output_are_told) {
    const char *folder = unit_folder(), *log = unit_path(folder, "a.log");
    struct launcher *l = make(2);
    start(l, "echo to out; echo to err >&2; read x || echo no input; exit 7", log, 20, 41);
    struct launch_result r = await(l);
    ck_assert_int_eq(r.end, LAUNCH_EXITED);
    ck_assert_int_eq(r.code, 7);
    ck_assert_uint_eq(r.tag, 41);
    ck_assert_str_eq(read_text(log), "to out\nto err\nno input\n");
    start(l, "kill -SEGV $$", log, 20, 42);
    r = await(l);
    ck_assert_int_eq(r.end, LAUNCH_KILLED);
    ck_assert_int_eq(r.code, SIGSEGV);
    ck_assert_uint_eq(launch_running(l), 0);
    launch_free(l);
    unit_remove(folder);
}
END_TEST

START_TEST(beyond_its_limit_the_whole_group_is_ended) {
    const char *folder = unit_folder(), *log = unit_path(folder, "a.log");
    char script[256];
    snprintf(script, sizeof script, "sleep 60 & echo $! > %s; wait", unit_path(folder, "pid"));
    struct launcher *l = make(1);
    double begun = now_s();
    start(l, script, log, 0.4, 0);
    struct launch_result r = await(l);
    ck_assert_int_eq(r.end, LAUNCH_TIMED_OUT);
    ck_assert_double_lt(now_s() - begun, 3);
    pid_t grandchild = (pid_t)atoi(read_text(unit_path(folder, "pid")));
    ck_assert(has_ended(grandchild));
    launch_free(l);
    unit_remove(folder);
}
END_TEST

START_TEST(one_that_will_not_listen_is_killed) {
    const char *folder = unit_folder(), *log = unit_path(folder, "a.log");
    struct launcher *l = make(1);
    double begun = now_s();
    start(l, "trap '' TERM; while :; do sleep 1; done", log, 0.2, 0);
    struct launch_result r = await(l);
    ck_assert_int_eq(r.end, LAUNCH_TIMED_OUT);
    ck_assert_double_lt(now_s() - begun, LAUNCH_GRACE_S + 3);
    launch_free(l);
    unit_remove(folder);
}
END_TEST

START_TEST(several_run_at_a_time_and_no_more) {
    const char *folder = unit_folder();
    struct launcher *l = make(2);
    double begun = now_s();
    start(l, "sleep 0.7", unit_path(folder, "a.log"), 20, 0);
    start(l, "sleep 0.7", unit_path(folder, "b.log"), 20, 1);
    ck_assert(!launch_has_room(l));
    struct fault fault = FAULT_NONE;
    char program[] = "/bin/true";
    char *argv[] = {program, NULL};
    ck_assert_int_ne(launch_start(l, argv, unit_path(folder, "c.log"), 1, 2, &fault), STATUS_OK);
    await(l);
    await(l);
    ck_assert_double_lt(now_s() - begun, 1.3);
    launch_free(l);
    unit_remove(folder);
}
END_TEST

START_TEST(an_interrupt_is_told_and_children_do_not_outlive_the_launcher) {
    const char *folder = unit_folder(), *log = unit_path(folder, "a.log");
    struct fault fault = FAULT_NONE;
    struct launch_result r;
    bool got;
    char script[256];
    snprintf(script, sizeof script, "echo $$ > %s; exec sleep 60", unit_path(folder, "pid"));
    struct launcher *l = make(1);
    start(l, script, log, 100, 0);
    unit_ok(launch_wait(l, 0.3, &r, &got, &fault), &fault);
    ck_assert(!got);
    pid_t child = (pid_t)atoi(read_text(unit_path(folder, "pid")));
    kill(getpid(), SIGINT);
    ck_assert_int_eq(launch_wait(l, 5, &r, &got, &fault), STATUS_INTERRUPTED);
    unit_says(&fault, "SIGINT");
    kill(getpid(), SIGINT); /* an impatient second one */
    launch_free(l);
    ck_assert_int_ne(kill(child, 0), 0);
    ck_assert_int_eq(errno, ESRCH);
    unit_remove(folder);
}
END_TEST

START_TEST(what_cannot_be_started_is_a_fault) {
    const char *folder = unit_folder();
    struct fault fault = FAULT_NONE;
    struct launcher *l = make(1);
    char program[] = "/nowhere/solver", good[] = "/bin/true";
    char *argv[] = {program, NULL}, *fine[] = {good, NULL};
    ck_assert_int_eq(launch_start(l, argv, unit_path(folder, "a.log"), 1, 0, &fault), STATUS_IO);
    unit_says(&fault, "/nowhere/solver");
    ck_assert_int_eq(launch_start(l, fine, unit_path(folder, "no/a.log"), 1, 0, &fault), STATUS_IO);
    ck_assert_uint_eq(launch_running(l), 0);
    launch_free(l);
    launch_free(NULL);
    unit_remove(folder);
}
END_TEST

int main(void) {
    const TTest *const tests[] = {exit_codes_signals_and_output_are_told,
                                  beyond_its_limit_the_whole_group_is_ended,
                                  one_that_will_not_listen_is_killed,
                                  several_run_at_a_time_and_no_more,
                                  an_interrupt_is_told_and_children_do_not_outlive_the_launcher,
                                  what_cannot_be_started_is_a_fault,
                                  NULL};
    return unit_run("launch", tests);
}
