/* command_run.c -- bedcheck run: select, plan, run, judge, report. */
#include "validation/command.h"

#include "common/file.h"
#include "validation/desk.h"
#include "validation/earlier.h"
#include "validation/papers.h"
#include "validation/review.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

/* What one call of `run` makes and frees. */
struct work {
    const struct command_options *o;
    const struct console *console;
    struct selection *selection;
    struct plan *plan;
    struct budget *budget;
    char *solver;
    struct digest solver_key;
    struct folder *folder;
    struct outcome *outcome; /* outcome[0 .. plan->run_count-1] */
    struct execute_options execute;
    struct desk *desk;
    struct earlier earlier; /* cases to run again, with --failed */
    double begun_s;
    enum status judging; /* trouble while judging between runs */
    struct fault *fault;
};

static double now_s(void) {
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/* -- before the first run ----------------------------------------------------------- */

static enum status check_settings(const struct command_options *o, struct fault *fault) {
    for (size_t i = 0; i < o->setting_count; i++) {
        const char *equals = strchr(o->setting[i], '=');
        if (equals == NULL || equals == o->setting[i])
            fault_add(fault, STATUS_BAD_INPUT, "--set %s: must be parameter=value", o->setting[i]);
    }
    return fault->status;
}

static enum status choose_cases(struct work *w) {
    const struct command_options *o = w->o;
    struct selection_request request = {.folder = o->cases_folder,
                                        .pattern_count = o->pattern_count,
                                        .tag_count = o->tag_count,
                                        .skip_count = o->skip_count,
                                        .pattern = o->pattern,
                                        .tag = o->tag,
                                        .skip = o->skip,
                                        .tier = o->tier};
    if (o->failed) {
        if (earlier_read(o, &w->earlier, w->fault) != STATUS_OK)
            return w->fault->status;
        request.pattern = w->earlier.name;
        request.pattern_count = w->earlier.count;
        request.tier = w->earlier.tier;
    }
    if (selection_make(&request, &w->selection, w->fault) != STATUS_OK ||
        review_set_seeds(w->selection, o->seed_count, w->fault) != STATUS_OK)
        return w->fault->status;
    enum status status =
        plan_make(w->selection->order, w->selection->count,
                  (const struct case_file *const *)w->selection->all, w->selection->all_count,
                  request.tier, o->seed_offset, &w->plan, w->fault);
    return status == STATUS_OK ? budget_open(o->cases_folder, o->references_folder, request.tier,
                                             w->plan, &w->budget, w->fault)
                               : status;
}

/* What is wrong with the claims is told now, not after the last run. */
static enum status check_papers(struct work *w) {
    struct papers papers;
    enum status status =
        papers_open(w->o->cases_folder, w->o->references_folder, &papers, w->fault);
    papers_close(&papers);
    return status;
}

static enum status find_solver(struct work *w) {
    enum status status = key_find_program(w->o->solver, w->o->path_list, &w->solver, w->fault);
    return status == STATUS_OK ? digest_file(w->solver, &w->solver_key, w->fault) : status;
}

static void fill_execute(struct work *w) {
    w->execute = (struct execute_options){.folder = w->folder,
                                          .solver = w->solver,
                                          .solver_key = w->solver_key.hex,
                                          .setting = w->o->setting,
                                          .setting_count = w->o->setting_count,
                                          .jobs = w->o->jobs,
                                          .limit_s = w->o->limit_s,
                                          .environment = w->o->environment};
}

/* What is there already: outcome[] becomes RUN_REUSED or stays RUN_WAITING. */
static enum status look_before(struct work *w) {
    w->outcome = calloc(w->plan->run_count + 1, sizeof *w->outcome);
    if (w->outcome == NULL)
        return fault_set(w->fault, STATUS_NO_MEMORY, "runs: out of memory");
    enum status status = folder_check(w->o->out, w->fault);
    char *record = file_join(w->o->out, "bedcheck.yaml");
    bool there = record != NULL && file_exists(record);
    free(record);
    if (status == STATUS_OK && there)
        status = folder_open(w->o->out, false, &w->folder, w->fault);
    if (status != STATUS_OK || !there)
        return status;
    fill_execute(w);
    for (size_t i = 0; status == STATUS_OK && i < w->plan->run_count; i++)
        status = execute_inspect(w->plan->run[i], &w->execute, &w->outcome[i], w->fault);
    folder_close(w->folder);
    w->folder = NULL;
    return status;
}

struct estimate {
    size_t runs, reused;
    double seconds, bytes; /* of runs to be made: wall time of one core */
};

static struct estimate estimate(const struct work *w) {
    struct estimate e = {.runs = w->plan->run_count};
    for (size_t i = 0; i < w->plan->run_count; i++) {
        if (w->outcome[i].state == RUN_REUSED) {
            e.reused++;
            continue;
        }
        e.seconds += w->plan->run[i]->expect_s;
        e.bytes += w->plan->run[i]->bytes;
    }
    return e;
}

static int tell_plan(const struct work *w) {
    FILE *out = w->console->out;
    for (size_t i = 0; i < w->plan->case_count; i++) {
        if (w->plan->cases[i].skip_reason != NULL)
            fprintf(out, "skip   %s: %s\n", w->plan->cases[i].file->name,
                    w->plan->cases[i].skip_reason);
    }
    for (size_t i = 0; i < w->plan->run_count; i++) {
        const struct plan_run *r = w->plan->run[i];
        fprintf(out, "%s  %s  [%s]  %.5g s, %.3g MB%s%s\n",
                w->outcome[i].state == RUN_REUSED ? "reuse" : "run  ", r->name, r->point,
                r->expect_s, r->bytes / 1e6, r->start == NULL ? "" : ", starts from ",
                r->start == NULL ? "" : r->start->name);
    }
    struct estimate e = estimate(w);
    double jobs = (double)(w->o->jobs < e.runs ? w->o->jobs : e.runs);
    fprintf(out, "%zu runs: %zu reused, %zu to make; about %.1f min with %zu jobs, %.1f MB\n",
            e.runs, e.reused, e.runs - e.reused, e.seconds / 60 / (jobs > 0 ? jobs : 1), w->o->jobs,
            e.bytes / 1e6);
    return 0;
}

/* -- running ------------------------------------------------------------------------ */

static void show_progress(void *context) {
    const struct work *w = context;
    size_t done = 0, running = 0;
    double expected_done = 0, expected_left = 0, taken = 0;
    if (!w->console->live)
        return;
    for (size_t i = 0; i < w->plan->run_count; i++) {
        const struct outcome *o = &w->outcome[i];
        running += o->state == RUN_RUNNING;
        if (o->state == RUN_WAITING || o->state == RUN_RUNNING) {
            expected_left += w->plan->run[i]->expect_s;
            continue;
        }
        done++;
        if (o->state == RUN_DONE) {
            expected_done += w->plan->run[i]->expect_s;
            taken += o->seconds;
        }
    }
    double pace = expected_done > 0 ? taken / expected_done : 1;
    fprintf(w->console->errors, "\r\033[K%zu/%zu runs, %zu running, about %.1f min left, %.0f s",
            done, w->plan->run_count, running, pace * expected_left / (double)w->o->jobs / 60,
            now_s() - w->begun_s);
    fflush(w->console->errors);
}

static bool run_finished(void *context, size_t run) {
    struct work *w = context;
    (void)run;
    enum verdict worst = VERDICT_PASS;
    w->judging = desk_judge(w->desk, &worst, w->fault);
    show_progress(w);
    return w->judging == STATUS_OK && !(w->o->stop_at_failure && worst == VERDICT_FAIL);
}

static enum status write_record(struct work *w, struct folder_record *record) {
    const struct plan *p = w->plan;
    const char **name = arena_take(&record->arena, p->case_count, sizeof *name);
    const char **skip = arena_take(&record->arena, p->case_count, sizeof *skip);
    char *started = arena_take(&record->arena, 32, 1);
    time_t now = time(NULL);
    struct tm calendar;
    if (name == NULL || skip == NULL || started == NULL || gmtime_r(&now, &calendar) == NULL)
        return fault_set(w->fault, STATUS_NO_MEMORY, "record: out of memory");
    strftime(started, 32, "%Y-%m-%dT%H:%M:%SZ", &calendar);
    for (size_t i = 0; i < p->case_count; i++) {
        name[i] = p->cases[i].file->name;
        skip[i] = p->cases[i].skip_reason == NULL ? "" : p->cases[i].skip_reason;
    }
    record->cases_folder = w->o->cases_folder;
    record->references_folder = w->o->references_folder;
    record->tier = case_tier_name(p->tier);
    record->started = started;
    record->solver = w->solver;
    record->solver_key = w->solver_key.hex;
    record->seed_offset = w->o->seed_offset;
    record->seed_count = w->o->seed_count;
    record->case_count = p->case_count;
    record->case_name = name;
    record->skip_reason = skip;
    record->setting = w->o->setting;
    record->setting_count = w->o->setting_count;
    return folder_write_record(w->folder, record, w->fault);
}

static enum status open_folder(struct work *w, struct folder_record *record) {
    struct estimate e = estimate(w);
    enum status status = file_check_room(w->o->out, e.bytes + 1e7, w->fault);
    if (status == STATUS_OK)
        status = folder_open(w->o->out, true, &w->folder, w->fault);
    if (status == STATUS_OK)
        status = folder_drop_reports(w->folder, w->fault);
    return status == STATUS_OK ? write_record(w, record) : status;
}

static enum status run_all(struct work *w) {
    memset(w->outcome, 0, w->plan->run_count * sizeof *w->outcome);
    fill_execute(w);
    w->execute.finished = run_finished;
    w->execute.tick = show_progress;
    w->execute.context = w;
    w->begun_s = now_s();
    enum status status =
        desk_create(w->plan, w->outcome, &w->execute, w->console, &w->desk, w->fault);
    if (status == STATUS_OK)
        desk_set_budget(w->desk, w->budget);
    if (status == STATUS_OK)
        status = execute_plan(w->plan, &w->execute, w->outcome, w->fault);
    if (w->console->live)
        fputs("\r\033[K", w->console->errors);
    return status == STATUS_OK ? w->judging : status;
}

static void tell_interrupted(const struct work *w) {
    size_t complete = 0;
    for (size_t i = 0; i < w->plan->run_count; i++)
        complete += w->outcome[i].state == RUN_DONE || w->outcome[i].state == RUN_REUSED;
    fprintf(w->console->errors,
            "bedcheck: %zu of %zu runs are complete and kept in %s; the same command goes on from "
            "there\n",
            complete, w->plan->run_count, w->o->out);
}

static int run_plan(struct work *w) {
    struct folder_record record = {0};
    int code = 2;
    enum status status = open_folder(w, &record);
    if (status == STATUS_OK)
        status = run_all(w);
    if (status == STATUS_OK)
        status = desk_file(w->desk, &record, true, &code, w->fault);
    if (status == STATUS_INTERRUPTED)
        tell_interrupted(w);
    folder_record_free(&record);
    return status == STATUS_OK ? code : status == STATUS_INTERRUPTED ? 130 : 2;
}

int command_run(const struct command_options *o, const struct console *c) {
    struct fault fault = FAULT_NONE;
    struct work w = {.o = o, .console = c, .fault = &fault};
    int code = 2;
    if (check_settings(o, &fault) == STATUS_OK && choose_cases(&w) == STATUS_OK &&
        check_papers(&w) == STATUS_OK && find_solver(&w) == STATUS_OK &&
        look_before(&w) == STATUS_OK)
        code = o->dry_run ? tell_plan(&w) : run_plan(&w);
    if (fault.status != STATUS_OK)
        fprintf(c->errors, "bedcheck: %s\n", fault.text);
    desk_free(w.desk);
    folder_close(w.folder);
    free(w.outcome);
    free(w.solver);
    budget_close(w.budget);
    plan_free(w.plan);
    selection_free(w.selection);
    earlier_free(&w.earlier);
    return code;
}
