/* command_check.c -- bedcheck check, report and clean: a folder of results taken up again. */
#include "validation/command.h"

#include "validation/desk.h"
#include "validation/selection.h"

#include <stdlib.h>
#include <string.h>

struct review {
    const struct command_options *o;
    const struct console *console;
    struct folder *folder;
    struct folder_record record;
    struct arena arena;
    struct selection *selection;
    struct plan *plan;
    struct outcome *outcome;
    struct execute_options execute;
    struct desk *desk;
    struct fault *fault;
};

static enum status no_memory(struct review *v) {
    return fault_set(v->fault, STATUS_NO_MEMORY, "check: out of memory");
}

/* Results of two builds prove nothing about either. */
static enum status check_builds(struct review *v) {
    const char **key;
    size_t count;
    enum status status = folder_solver_keys(v->folder, &v->arena, &key, &count, v->fault);
    if (status != STATUS_OK || count < 2)
        return status;
    return fault_set(
        v->fault, STATUS_BAD_INPUT,
        "%s: holds results of %zu different solver builds (%.8s, %.8s, ...): run again "
        "with one solver, or remove the others with `bedcheck clean --stale %s`",
        v->o->out, count, key[0], key[1], v->o->out);
}

static enum status choose_cases(struct review *v) {
    const struct folder_record *r = &v->record;
    const char **skip = arena_take(&v->arena, r->case_count, sizeof *skip);
    struct selection_request request = {.folder = v->o->cases_folder != NULL ? v->o->cases_folder
                                                                             : r->cases_folder,
                                        .pattern_count = r->case_count,
                                        .pattern = r->case_name,
                                        .skip = skip};
    if (skip == NULL)
        return no_memory(v);
    for (size_t i = 0; i < r->case_count; i++) {
        if (r->skip_reason[i][0] == '\0')
            continue;
        skip[request.skip_count] =
            arena_text(&v->arena, "%s=%s", r->case_name[i], r->skip_reason[i]);
        if (skip[request.skip_count++] == NULL)
            return no_memory(v);
    }
    enum status status = case_tier_find(r->tier, &request.tier, v->fault);
    if (status == STATUS_OK)
        status = selection_make(&request, &v->selection, v->fault);
    return status != STATUS_OK ? status
                               : plan_make(v->selection->order, v->selection->count,
                                           (const struct case_file *const *)v->selection->all,
                                           v->selection->all_count, request.tier, r->seed_offset,
                                           &v->plan, v->fault);
}

/* Every run must be there, made from what the cases say now. */
static enum status inspect(struct review *v) {
    size_t missing = 0;
    const char *first = NULL;
    v->outcome = calloc(v->plan->run_count + 1, sizeof *v->outcome);
    if (v->outcome == NULL)
        return no_memory(v);
    for (size_t i = 0; i < v->plan->run_count; i++) {
        enum status status =
            execute_inspect(v->plan->run[i], &v->execute, &v->outcome[i], v->fault);
        if (status != STATUS_OK)
            return status;
        if (v->outcome[i].state != RUN_WAITING)
            continue;
        missing++;
        first = first == NULL ? v->plan->run[i]->name : first;
    }
    if (missing == 0)
        return STATUS_OK;
    return fault_set(v->fault, STATUS_NOT_FOUND,
                     "%s: %zu of %zu runs are missing or were made otherwise (the first: %s); use "
                     "`bedcheck run`",
                     v->o->out, missing, v->plan->run_count, first);
}

static enum status review(struct review *v, bool page, int *code) {
    enum verdict worst = VERDICT_PASS;
    if (folder_open(v->o->out, false, &v->folder, v->fault) != STATUS_OK ||
        folder_read_record(v->folder, &v->record, v->fault) != STATUS_OK ||
        check_builds(v) != STATUS_OK || choose_cases(v) != STATUS_OK)
        return v->fault->status;
    v->execute = (struct execute_options){.folder = v->folder,
                                          .solver = v->record.solver,
                                          .solver_key = v->record.solver_key,
                                          .setting = v->record.setting,
                                          .setting_count = v->record.setting_count};
    if (inspect(v) != STATUS_OK ||
        desk_create(v->plan, v->outcome, &v->execute, v->console, &v->desk, v->fault) !=
            STATUS_OK ||
        desk_judge(v->desk, &worst, v->fault) != STATUS_OK)
        return v->fault->status;
    return desk_file(v->desk, &v->record, page, code, v->fault);
}

int command_check(const struct command_options *o, bool page, const struct console *c) {
    struct fault fault = FAULT_NONE;
    struct review v = {.o = o, .console = c, .fault = &fault};
    int code = 2;
    if (review(&v, page, &code) != STATUS_OK) {
        fprintf(c->errors, "bedcheck: %s\n", fault.text);
        code = 2;
    }
    desk_free(v.desk);
    free(v.outcome);
    plan_free(v.plan);
    selection_free(v.selection);
    folder_record_free(&v.record);
    folder_close(v.folder);
    arena_free(&v.arena);
    return code;
}

int command_clean(const struct command_options *o, const struct console *c) {
    struct fault fault = FAULT_NONE;
    struct folder *f = NULL;
    size_t removed = 0, left = 0;
    enum status status = folder_open(o->out, false, &f, &fault);
    if (status == STATUS_OK)
        status = o->stale ? folder_clean_stale(f, &removed, &fault)
                          : folder_clean(f, &removed, &left, &fault);
    if (status == STATUS_OK) {
        fprintf(c->out, "%s: %zu %s removed", o->out, removed, o->stale ? "results" : "files");
        if (left > 0)
            fprintf(c->out, ", %zu that are not bedcheck's left", left);
        fputc('\n', c->out);
    } else {
        fprintf(c->errors, "bedcheck: %s\n", fault.text);
    }
    folder_close(f);
    return status == STATUS_OK ? 0 : 2;
}
