/* execute.h -- a plan's runs, made or reused.
 *
 * Runs are taken in the plan's order, `jobs` at a time, each after the one that
 * it starts from.  A result whose key matches is reused; any other is dropped
 * and run again.  A solver that crashes, times out or reports a numerical fault
 * (exit code 1) fails its run and the others go on; one that refuses its input
 * (exit code 2) stops everything, for then no other run would fare better.
 *
 * Leaves out: judging.  What became of each run is told to `finished` at once.
 */
#ifndef VALIDATION_EXECUTE_H
#define VALIDATION_EXECUTE_H

#include "validation/folder.h"
#include "validation/key.h"

enum run_state { RUN_WAITING, RUN_RUNNING, RUN_DONE, RUN_REUSED, RUN_FAILED };

struct outcome {
    enum run_state state;
    char failure[KEY_FAILURE_SIZE]; /* RUN_FAILED: one sentence */
    double seconds;                 /* wall time of the run, whenever it was made; NaN: none */
};

struct execute_options {
    const struct folder *folder;
    const char *solver, *solver_key; /* path of the program, digest of its bytes */
    const char *const *setting;      /* "name=value", setting[0 .. setting_count-1] */
    size_t setting_count;
    size_t jobs;
    double limit_s; /* of every run; 0: as its case says */
    char *const *environment;
    /* After each change; run is an index of plan->run.  False: start no more. */
    bool (*finished)(void *context, size_t run);
    void (*tick)(void *context); /* now and then, for a progress line */
    void *context;
};

/* Is there a result for this run, made from the same things?  Sets *out to
 * RUN_REUSED, RUN_FAILED (a failure on record) or RUN_WAITING. */
enum status execute_inspect(const struct plan_run *run, const struct execute_options *o,
                            struct outcome *out, struct fault *fault);

/* outcome[0 .. plan->run_count-1], in the plan's order, zeroed by the caller. */
enum status execute_plan(const struct plan *plan, const struct execute_options *o,
                         struct outcome *outcome, struct fault *fault);

/* A word as a POSIX shell reads it back; NULL: no memory. */
const char *execute_shell_word(struct arena *a, const char *word);

/* The command line that a run is made with, one word each, NULL-terminated, and
 * as one line for a shell.  NULL: no memory. */
char **execute_command(const struct plan_run *run, const struct execute_options *o,
                       struct arena *a);
const char *execute_command_line(const struct plan_run *run, const struct execute_options *o,
                                 const char *result, struct arena *a);

/* The last lines of a text file, at most `lines` of them and 4000 bytes; "" where there
 * is none.  NULL: no memory. */
const char *execute_log_end(const char *path, int lines, struct arena *a);

#endif
