#include "validation/execute.h"

#include "common/file.h"
#include "validation/launch.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

struct executor {
    const struct plan *plan;
    const struct execute_options *o;
    struct outcome *outcome;
    struct digest *key; /* key[0 .. run_count-1] of runs that were started */
    struct launcher *launcher;
    bool stopped;
};

/* -- keys --------------------------------------------------------------------- */

static enum status key_of(const struct plan_run *run, const struct execute_options *o,
                          struct digest *out, struct fault *fault) {
    struct arena a = {0};
    struct digest start = {""};
    struct key_parts parts = {.meaning = run->meaning,
                              .seed = run->seed,
                              .solver = o->solver_key,
                              .settings = o->setting,
                              .setting_count = o->setting_count};
    enum status status = STATUS_OK;
    if (run->start != NULL) {
        const char *path = folder_result(o->folder, &a, run->start);
        status = path == NULL ? fault_set(fault, STATUS_NO_MEMORY, "%s: out of memory", run->name)
                              : digest_file(path, &start, fault);
        parts.start = start.hex;
    }
    if (status == STATUS_OK)
        status = key_make(&parts, out, fault);
    arena_free(&a);
    return status;
}

/* Size in bytes of a plain file; -1 where there is none. */
static double size_of(const char *path) {
    struct stat about;
    return lstat(path, &about) == 0 && S_ISREG(about.st_mode) ? (double)about.st_size : -1;
}

static enum status compare_record(const char *key_path, const char *result_path,
                                  const struct digest *key, struct outcome *out,
                                  struct fault *fault) {
    struct key_record record;
    struct fault damaged = FAULT_NONE;
    enum status status = key_read(key_path, &record, &damaged);
    if (status == STATUS_NO_MEMORY) {
        *fault = damaged;
        return status;
    }
    if (status != STATUS_OK || strcmp(record.key, key->hex) != 0)
        return STATUS_OK; /* no record, or of another run: run again */
    out->seconds = record.seconds;
    if (record.failure[0] != '\0') {
        out->state = RUN_FAILED;
        memcpy(out->failure, record.failure, sizeof out->failure);
    } else if (record.bytes > 0 && size_of(result_path) == record.bytes) {
        out->state = RUN_REUSED;
    }
    return STATUS_OK;
}

enum status execute_inspect(const struct plan_run *run, const struct execute_options *o,
                            struct outcome *out, struct fault *fault) {
    *out = (struct outcome){.state = RUN_WAITING, .seconds = NAN};
    if (run->start != NULL) {
        struct outcome start;
        enum status status = execute_inspect(run->start, o, &start, fault);
        if (status != STATUS_OK || start.state == RUN_WAITING)
            return status;
        if (start.state == RUN_FAILED) {
            out->state = RUN_FAILED;
            snprintf(out->failure, sizeof out->failure, "the run that it starts from, %s, failed",
                     run->start->name);
            return STATUS_OK;
        }
    }
    struct arena a = {0};
    struct digest key;
    const char *key_path = folder_key(o->folder, &a, run);
    const char *result_path = folder_result(o->folder, &a, run);
    enum status status = key_path == NULL || result_path == NULL
                             ? fault_set(fault, STATUS_NO_MEMORY, "%s: out of memory", run->name)
                             : key_of(run, o, &key, fault);
    if (status == STATUS_OK)
        status = compare_record(key_path, result_path, &key, out, fault);
    arena_free(&a);
    return status;
}

/* -- commands and logs ---------------------------------------------------------- */

static char **command(const struct plan_run *run, const struct execute_options *o,
                      const char *result, struct arena *a) {
    char **word = arena_take(a, 8 + 2 * o->setting_count, sizeof *word);
    char *const fixed[] = {arena_copy(a, o->solver),
                           arena_copy(a, "run"),
                           (char *)folder_run_file(o->folder, a, run),
                           arena_copy(a, "--seed"),
                           arena_text(a, "%lld", run->seed),
                           arena_copy(a, "--out"),
                           (char *)result};
    size_t count = 0;
    for (size_t i = 0; word != NULL && i < sizeof fixed / sizeof *fixed; i++) {
        if (fixed[i] == NULL)
            return NULL;
        word[count++] = fixed[i];
    }
    for (size_t i = 0; word != NULL && i < o->setting_count; i++) {
        word[count++] = arena_copy(a, "--set");
        word[count++] = arena_copy(a, o->setting[i]);
        if (word[count - 2] == NULL || word[count - 1] == NULL)
            return NULL;
    }
    return word;
}

char **execute_command(const struct plan_run *run, const struct execute_options *o,
                       struct arena *a) {
    return command(run, o, folder_result(o->folder, a, run), a);
}

const char *execute_shell_word(struct arena *a, const char *word) {
    static const char safe[] =
        "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_.,:=+-/@%";
    if (*word != '\0' && strspn(word, safe) == strlen(word))
        return word;
    const char *quoted = "'";
    for (const char *p = word; *p != '\0' && quoted != NULL; p++)
        quoted = *p == '\'' ? arena_text(a, "%s'\\''", quoted) : arena_text(a, "%s%c", quoted, *p);
    return quoted == NULL ? NULL : arena_text(a, "%s'", quoted);
}

const char *execute_command_line(const struct plan_run *run, const struct execute_options *o,
                                 const char *result, struct arena *a) {
    char **word = command(run, o, result, a);
    const char *line = word == NULL ? NULL : "";
    for (size_t i = 0; line != NULL && word[i] != NULL; i++) {
        const char *safe = execute_shell_word(a, word[i]);
        line = safe == NULL ? NULL : arena_text(a, "%s%s%s", line, i == 0 ? "" : " ", safe);
    }
    return line;
}

const char *execute_log_end(const char *path, int lines, struct arena *a) {
    enum { WINDOW = 4000 };
    char text[WINDOW + 1];
    FILE *in = fopen(path, "re");
    if (in == NULL)
        return arena_copy(a, "");
    if (fseek(in, -WINDOW, SEEK_END) != 0)
        rewind(in);
    size_t length = fread(text, 1, WINDOW, in);
    fclose(in);
    while (length > 0 && text[length - 1] == '\n')
        length--;
    size_t begin = length;
    for (int line = 0; begin > 0; begin--) {
        if (text[begin - 1] == '\n' && ++line == lines)
            break;
    }
    for (size_t i = begin; i < length; i++) {
        if ((unsigned char)text[i] < ' ' && text[i] != '\n' && text[i] != '\t')
            text[i] = ' '; /* no escape sequences on the reader's terminal */
    }
    return arena_text(a, "%.*s", (int)(length - begin), text + begin);
}

/* -- running -------------------------------------------------------------------- */

static enum status write_run_file(const struct plan_run *run, const struct execute_options *o,
                                  struct arena *a, struct fault *fault) {
    const char *path = folder_run_file(o->folder, a, run);
    if (path == NULL)
        return fault_set(fault, STATUS_NO_MEMORY, "%s: out of memory", run->name);
    return file_write(path, run->text, strlen(run->text), fault);
}

static enum status start_run(struct executor *x, size_t index, struct fault *fault) {
    const struct plan_run *run = x->plan->run[index];
    struct arena a = {0};
    enum status status = key_of(run, x->o, &x->key[index], fault);
    if (status == STATUS_OK)
        status = write_run_file(run, x->o, &a, fault);
    if (status == STATUS_OK)
        status = folder_drop_result(x->o->folder, run->name, fault);
    char **word = execute_command(run, x->o, &a);
    const char *log = folder_log(x->o->folder, &a, run);
    if (status == STATUS_OK && (word == NULL || log == NULL))
        status = fault_set(fault, STATUS_NO_MEMORY, "%s: out of memory", run->name);
    if (status == STATUS_OK)
        status = launch_start(x->launcher, word, log,
                              x->o->limit_s > 0 ? x->o->limit_s : run->limit_s, index, fault);
    if (status == STATUS_OK)
        x->outcome[index].state = RUN_RUNNING;
    arena_free(&a);
    return status;
}

static void settle(struct executor *x, size_t index) {
    if (x->o->finished != NULL && !x->o->finished(x->o->context, index))
        x->stopped = true;
}

/* Reuse, start, or leave one waiting run. */
static enum status consider(struct executor *x, size_t index, struct fault *fault) {
    const struct plan_run *run = x->plan->run[index];
    struct outcome *out = &x->outcome[index];
    if (run->start != NULL) {
        enum run_state s = x->outcome[run->start->index].state;
        if (s == RUN_WAITING || s == RUN_RUNNING)
            return STATUS_OK;
    }
    enum status status = execute_inspect(run, x->o, out, fault);
    if (status != STATUS_OK)
        return status;
    bool blocked = run->start != NULL && x->outcome[run->start->index].state == RUN_FAILED;
    if (out->state == RUN_REUSED || blocked) {
        struct arena a = {0};
        status = write_run_file(run, x->o, &a, fault);
        arena_free(&a);
        settle(x, index);
        return status;
    }
    *out = (struct outcome){.state = RUN_WAITING, .seconds = NAN};
    return launch_has_room(x->launcher) ? start_run(x, index, fault) : STATUS_OK;
}

static enum status consider_all(struct executor *x, struct fault *fault) {
    enum status status = STATUS_OK;
    for (size_t i = 0; i < x->plan->run_count && status == STATUS_OK && !x->stopped; i++) {
        if (!launch_has_room(x->launcher))
            break;
        if (x->outcome[i].state == RUN_WAITING)
            status = consider(x, i, fault);
    }
    return status;
}

/* Why a process that has ended did not do its work; "" when it did. */
static void say_failure(const struct launch_result *r, double limit_s, bool has_result,
                        struct outcome *out) {
    char *text = out->failure;
    size_t size = sizeof out->failure;
    text[0] = '\0';
    if (r->end == LAUNCH_TIMED_OUT)
        snprintf(text, size, "timed out after %.3g s (limit %.3g s)", r->seconds, limit_s);
    else if (r->end == LAUNCH_KILLED)
        snprintf(text, size, "the solver crashed: signal %d (SIG%s)", r->code,
                 sigabbrev_np(r->code) == NULL ? "?" : sigabbrev_np(r->code));
    else if (r->code == 1)
        snprintf(text, size, "the solver reports a numerical fault (exit code 1)");
    else if (r->code != 0)
        snprintf(text, size, "the solver ended with exit code %d", r->code);
    else if (!has_result)
        snprintf(text, size, "the solver ended without an error but wrote no result file");
}

static enum status refused(const struct executor *x, const struct plan_run *run,
                           struct fault *fault) {
    struct arena a = {0};
    const char *log = folder_log(x->o->folder, &a, run);
    const char *end = log == NULL ? NULL : execute_log_end(log, 20, &a);
    const char *line = execute_command_line(run, x->o, folder_result(x->o->folder, &a, run), &a);
    fault_set(fault, STATUS_BAD_INPUT, "%s: the solver refuses its input:\n%s\nrepeat with: %s",
              run->name, end == NULL ? "" : end, line == NULL ? "" : line);
    arena_free(&a);
    return STATUS_BAD_INPUT;
}

static enum status write_key(const struct executor *x, size_t index, struct arena *a,
                             struct fault *fault) {
    const struct plan_run *run = x->plan->run[index];
    const struct outcome *out = &x->outcome[index];
    const char *path = folder_key(x->o->folder, a, run);
    const char *result = folder_result(x->o->folder, a, run);
    if (path == NULL || result == NULL)
        return fault_set(fault, STATUS_NO_MEMORY, "%s: out of memory", run->name);
    struct key_record record = {.seconds = out->seconds,
                                .bytes = out->state == RUN_DONE ? size_of(result) : 0};
    memcpy(record.key, x->key[index].hex, sizeof record.key);
    snprintf(record.solver, sizeof record.solver, "%s", x->o->solver_key);
    memcpy(record.failure, out->failure, sizeof record.failure);
    return key_write(path, &record, fault);
}

/* A solver that was rebuilt meanwhile made results that have no one key. */
static enum status check_solver(const struct executor *x, struct fault *fault) {
    struct digest now;
    enum status status = digest_file(x->o->solver, &now, fault);
    if (status == STATUS_OK && strcmp(now.hex, x->o->solver_key) != 0)
        return fault_set(fault, STATUS_BAD_INPUT, "%s: the program changed during the runs",
                         x->o->solver);
    return status;
}

static enum status take_result(struct executor *x, const struct launch_result *r,
                               struct fault *fault) {
    const struct plan_run *run = x->plan->run[r->tag];
    struct outcome *out = &x->outcome[r->tag];
    if (r->end == LAUNCH_EXITED && r->code == 2)
        return refused(x, run, fault);
    struct arena a = {0};
    const char *result = folder_result(x->o->folder, &a, run);
    out->seconds = r->seconds;
    say_failure(r, x->o->limit_s > 0 ? x->o->limit_s : run->limit_s,
                result != NULL && size_of(result) > 0, out);
    out->state = out->failure[0] == '\0' ? RUN_DONE : RUN_FAILED;
    enum status status = check_solver(x, fault);
    if (status == STATUS_OK && out->state == RUN_FAILED)
        status = folder_drop_result(x->o->folder, run->name, fault);
    if (status == STATUS_OK)
        status = write_key(x, r->tag, &a, fault);
    arena_free(&a);
    if (status == STATUS_OK)
        settle(x, r->tag);
    return status;
}

static enum status run_all(struct executor *x, struct fault *fault) {
    for (;;) {
        enum status status = consider_all(x, fault);
        if (status != STATUS_OK || launch_running(x->launcher) == 0)
            return status;
        struct launch_result r;
        bool got;
        status = launch_wait(x->launcher, 0.5, &r, &got, fault);
        if (status == STATUS_OK && got)
            status = take_result(x, &r, fault);
        if (status != STATUS_OK)
            return status;
        if (x->o->tick != NULL)
            x->o->tick(x->o->context);
    }
}

enum status execute_plan(const struct plan *plan, const struct execute_options *o,
                         struct outcome *outcome, struct fault *fault) {
    struct executor x = {.plan = plan, .o = o, .outcome = outcome};
    x.key = calloc(plan->run_count + 1, sizeof *x.key);
    if (x.key == NULL)
        return fault_set(fault, STATUS_NO_MEMORY, "runs: out of memory");
    enum status status = launch_create(o->jobs, o->environment, &x.launcher, fault);
    if (status == STATUS_OK)
        status = run_all(&x, fault);
    launch_free(x.launcher);
    for (size_t i = 0; i < plan->run_count; i++) {
        if (outcome[i].state == RUN_RUNNING) { /* ended by us: leaves nothing behind */
            struct fault ignored = FAULT_NONE;
            folder_drop_result(o->folder, plan->run[i]->name, &ignored);
            outcome[i].state = RUN_WAITING;
        }
    }
    free(x.key);
    return status;
}
