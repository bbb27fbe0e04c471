#include "validation/review.h"

#include <stdlib.h>

static enum status no_memory(struct fault *fault) {
    return fault_set(fault, STATUS_NO_MEMORY, "check: out of memory");
}

/* Results of two builds prove nothing about either. */
static enum status check_builds(struct review *r, struct fault *fault) {
    const char **key;
    size_t count;
    enum status status = folder_solver_keys(r->folder, &r->arena, &key, &count, fault);
    if (status != STATUS_OK || count < 2)
        return status;
    const char *folder = folder_path(r->folder);
    return fault_set(
        fault, STATUS_BAD_INPUT,
        "%s: holds results of %zu different solver builds (%.8s, %.8s, ...): run again "
        "with one solver, or remove the others with `bedcheck clean --stale %s`",
        folder, count, key[0], key[1], folder);
}

enum status review_set_seeds(struct selection *s, size_t count, struct fault *fault) {
    for (size_t i = 0; count > 0 && i < s->count; i++) {
        struct case_rule *rule = arena_take(&s->arena, 1, sizeof *rule);
        if (rule == NULL)
            return no_memory(fault);
        rule->value = (double)count;
        for (size_t k = 0; k < s->all_count; k++) {
            if (s->all[k] != s->order[i].file)
                continue;
            for (enum tier t = 0; t < TIER_COUNT; t++)
                s->all[k]->tier[t].seeds.count = (struct case_rules){1, rule};
        }
    }
    return STATUS_OK;
}

static enum status choose_cases(struct review *v, struct fault *fault) {
    const struct folder_record *r = &v->record;
    const char **skip = arena_take(&v->arena, r->case_count, sizeof *skip);
    struct selection_request request = {.folder = v->cases_folder,
                                        .pattern_count = r->case_count,
                                        .pattern = r->case_name,
                                        .skip = skip};
    if (skip == NULL)
        return no_memory(fault);
    for (size_t i = 0; i < r->case_count; i++) {
        if (r->skip_reason[i][0] == '\0')
            continue;
        skip[request.skip_count] =
            arena_text(&v->arena, "%s=%s", r->case_name[i], r->skip_reason[i]);
        if (skip[request.skip_count++] == NULL)
            return no_memory(fault);
    }
    enum status status = case_tier_find(r->tier, &request.tier, fault);
    if (status == STATUS_OK)
        status = selection_make(&request, &v->selection, fault);
    if (status == STATUS_OK)
        status = review_set_seeds(v->selection, r->seed_count, fault);
    return status != STATUS_OK
               ? status
               : plan_make(v->selection->order, v->selection->count,
                           (const struct case_file *const *)v->selection->all,
                           v->selection->all_count, request.tier, r->seed_offset, &v->plan, fault);
}

/* Every run must be there, made from what the cases say now. */
static enum status inspect(struct review *v, struct fault *fault) {
    size_t missing = 0;
    const char *first = NULL;
    v->outcome = calloc(v->plan->run_count + 1, sizeof *v->outcome);
    if (v->outcome == NULL)
        return no_memory(fault);
    for (size_t i = 0; i < v->plan->run_count; i++) {
        enum status status = execute_inspect(v->plan->run[i], &v->execute, &v->outcome[i], fault);
        if (status != STATUS_OK)
            return status;
        if (v->outcome[i].state != RUN_WAITING)
            continue;
        missing++;
        first = first == NULL ? v->plan->run[i]->name : first;
    }
    if (missing == 0)
        return STATUS_OK;
    return fault_set(fault, STATUS_NOT_FOUND,
                     "%s: %zu of %zu runs are missing or were made otherwise (the first: %s); use "
                     "`bedcheck run`",
                     folder_path(v->folder), missing, v->plan->run_count, first);
}

static enum status open_all(struct review *v, const char *folder, const char *cases_folder,
                            const char *references_folder, struct fault *fault) {
    enum status status = folder_open(folder, false, &v->folder, fault);
    if (status == STATUS_OK)
        status = folder_read_record(v->folder, &v->record, fault);
    if (status == STATUS_OK)
        status = check_builds(v, fault);
    if (status != STATUS_OK)
        return status;
    v->cases_folder = cases_folder != NULL ? cases_folder : v->record.cases_folder;
    v->references_folder =
        references_folder != NULL ? references_folder : v->record.references_folder;
    status = choose_cases(v, fault);
    v->execute = (struct execute_options){.folder = v->folder,
                                          .solver = v->record.solver,
                                          .solver_key = v->record.solver_key,
                                          .setting = v->record.setting,
                                          .setting_count = v->record.setting_count};
    return status == STATUS_OK ? inspect(v, fault) : status;
}

enum status review_open(const char *folder, const char *cases_folder, const char *references_folder,
                        struct review **out, struct fault *fault) {
    struct review *v = calloc(1, sizeof *v);
    *out = NULL;
    if (v == NULL)
        return no_memory(fault);
    enum status status = open_all(v, folder, cases_folder, references_folder, fault);
    if (status == STATUS_OK)
        *out = v;
    else
        review_close(v);
    return status;
}

void review_close(struct review *r) {
    if (r == NULL)
        return;
    free(r->outcome);
    plan_free(r->plan);
    selection_free(r->selection);
    folder_record_free(&r->record);
    folder_close(r->folder);
    arena_free(&r->arena);
    free(r);
}
