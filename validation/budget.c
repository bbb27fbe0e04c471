#include "validation/budget.h"

#include "validation/judge.h"
#include "validation/scatter.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static enum status no_memory(struct fault *fault) {
    return fault_set(fault, STATUS_NO_MEMORY, "budget: out of memory");
}

size_t budget_count(const struct plan_case *c) {
    size_t count = 0;
    for (size_t k = 0; k < c->tier->check_count; k++) {
        for (size_t p = 0; p < c->point_count; p++)
            count +=
                scatter_is_statistical(c->file, &c->tier->check[k]) && reference_has_row(c, k, p);
    }
    return count;
}

const struct references *budget_references(const struct budget *b, const char *case_name) {
    for (size_t i = 0; b != NULL && i < b->plan->case_count; i++) {
        if (strcmp(b->plan->cases[i].file->name, case_name) == 0)
            return b->references[i];
    }
    return NULL;
}

/* -- what a check cannot see ----------------------------------------------------------- */

struct eye { /* one row of a regression check */
    const struct case_check *check;
    const struct plan_point *point;
    struct reference_key key;
    const struct references *references;
    double share;
};

static void refuse(const struct eye *e, double seen, double mean, size_t stored,
                   struct fault *fault) {
    const struct case_amount *d = &e->check->detects;
    char part[64] = "", against[64] = "";
    if (mean != 0)
        snprintf(part, sizeof part, " (%.3g %%)", 100 * seen / fabs(mean));
    if (stored > 0)
        snprintf(against, sizeof against, " with %zu seeds against %zu", e->point->run_count,
                 stored);
    yaml_fault(e->check->detects_node, fault,
               "check %s at %s: says that it detects %g%s, but%s no change below %.3g%s is seen "
               "with 95 %%",
               e->check->name, e->key.point, d->value, d->percent ? " %" : "", against, seen, part);
}

static void look_at_ensemble(const struct eye *e, struct fault *fault) {
    const struct reference *line = reference_find(e->references, &e->key, ORIGIN_ENSEMBLE);
    if (line == NULL || !reference_is_meant(line, e->key.meaning))
        return; /* inconclusive when judged */
    struct judge_question q = {.kind = KIND_REGRESSION,
                               .ensemble = {line->seeds, line->value, line->deviation},
                               .fitted = e->check->number.across,
                               .count = e->point->run_count,
                               .seeds = e->point->run_count,
                               .alarm_rate = e->share};
    double seen = judge_detectable(&q);
    if (!(seen <= judge_amount(&e->check->detects, line->value)))
        refuse(e, seen, line->value, line->seeds, fault);
}

static void look_at_pairs(const struct eye *e, struct fault *fault) {
    for (size_t i = 0; i < e->point->run_count; i++) {
        const struct reference *line =
            reference_find_seed(e->references, &e->key, e->point->run[i]->seed);
        if (line == NULL || !reference_is_meant(line, e->key.meaning))
            continue;
        double seen = 2 * judge_amount(&e->check->margin, line->value);
        if (seen <= judge_amount(&e->check->detects, line->value))
            continue;
        refuse(e, seen, line->value, 0, fault);
        return;
    }
}

enum status budget_refuse(const struct plan_case *c, const struct references *r, double share,
                          struct fault *fault) {
    struct arena a = {0};
    for (size_t k = 0; k < c->tier->check_count; k++) {
        const struct case_check *check = &c->tier->check[k];
        for (size_t p = 0; check->kind == KIND_REGRESSION && p < c->point_count; p++) {
            struct eye e = {check, &c->point[p], {0}, r, share};
            if (!reference_has_row(c, k, p))
                continue;
            if (reference_key_make(c, k, p, &a, &e.key, fault) != STATUS_OK)
                break;
            if (check->paired)
                look_at_pairs(&e, fault);
            else
                look_at_ensemble(&e, fault);
        }
    }
    arena_free(&a);
    return fault->status;
}

/* -- opening ---------------------------------------------------------------------------- */

static bool is_wanted(const struct plan *wanted, const char *name) {
    for (size_t i = 0; wanted != NULL && i < wanted->case_count; i++) {
        if (strcmp(wanted->cases[i].file->name, name) == 0)
            return true;
    }
    return wanted == NULL;
}

static enum status load_references(struct budget *b, const char *folder, const struct plan *wanted,
                                   struct fault *fault) {
    b->references = calloc(b->plan->case_count + 1, sizeof *b->references);
    if (b->references == NULL)
        return no_memory(fault);
    for (size_t i = 0; i < b->plan->case_count; i++) {
        const char *name = b->plan->cases[i].file->name;
        struct fault found = FAULT_NONE;
        if (is_wanted(wanted, name) &&
            reference_load(folder, name, &b->references[i], &found) != STATUS_OK)
            fault_add(fault, found.status, "%s", found.text);
    }
    return fault->status;
}

struct opening {
    const char *cases_folder, *references_folder;
    enum tier tier;
    const struct plan *wanted;
    bool refuse;
};

static enum status fill(struct budget *b, const struct opening *o, struct fault *fault) {
    struct selection_request all = {
        .folder = o->cases_folder, .tier = o->tier, .lenient = o->wanted != NULL};
    enum status status = selection_make(&all, &b->selection, fault);
    if (status == STATUS_OK)
        status = plan_make(b->selection->order, b->selection->count,
                           (const struct case_file *const *)b->selection->all,
                           b->selection->all_count, o->tier, 0, &b->plan, fault);
    if (status == STATUS_OK)
        status = load_references(b, o->references_folder, o->wanted, fault);
    for (size_t i = 0; status == STATUS_OK && i < b->plan->case_count; i++)
        b->statistical += budget_count(&b->plan->cases[i]);
    b->share = SUITE_FALSE_ALARMS / (double)(b->statistical > 0 ? b->statistical : 1);
    for (size_t i = 0; status == STATUS_OK && o->refuse && i < b->plan->case_count; i++) {
        if (b->references[i] != NULL)
            reference_check_tier(b->references[i], &b->plan->cases[i], fault);
        if (is_wanted(o->wanted, b->plan->cases[i].file->name))
            budget_refuse(&b->plan->cases[i], b->references[i], b->share, fault);
    }
    return status == STATUS_OK ? fault->status : status;
}

static enum status open_budget(const struct opening *o, struct budget **out, struct fault *fault) {
    struct budget *b = calloc(1, sizeof *b);
    struct fault found = FAULT_NONE;
    *out = NULL;
    if (b == NULL)
        return no_memory(fault);
    enum status status = fill(b, o, &found);
    if (status == STATUS_OK) {
        *out = b;
        return STATUS_OK;
    }
    *fault = found;
    budget_close(b);
    return status;
}

enum status budget_open(const char *cases_folder, const char *references_folder, enum tier tier,
                        const struct plan *wanted, struct budget **out, struct fault *fault) {
    const struct opening o = {cases_folder, references_folder, tier, wanted, true};
    return open_budget(&o, out, fault);
}

enum status budget_open_unrefused(const char *cases_folder, const char *references_folder,
                                  enum tier tier, const struct plan *wanted, struct budget **out,
                                  struct fault *fault) {
    const struct opening o = {cases_folder, references_folder, tier, wanted, false};
    return open_budget(&o, out, fault);
}

void budget_close(struct budget *b) {
    if (b == NULL)
        return;
    for (size_t i = 0; b->references != NULL && i < b->plan->case_count; i++)
        reference_free(b->references[i]);
    free(b->references);
    plan_free(b->plan);
    selection_free(b->selection);
    free(b);
}
