#include "validation/plan.h"

#include "common/digest.h"
#include "validation/plan_text.h"

#include <stdlib.h>
#include <string.h>

enum { MAX_CHAIN = 8, MAX_RUNS = 100000 };

struct planner {
    struct plan *plan;
    const struct case_file *const *all;
    size_t all_count;
    long long seed_offset;
    struct fault *fault;
};

/* One point of one case, on the way to its runs. */
struct place {
    const struct case_file *file;
    const struct case_tier *tier;
    const char *point;
    const struct case_parameter *parameter;
    size_t count;
};

static enum status no_memory(struct planner *pl) {
    return fault_set(pl->fault, STATUS_NO_MEMORY, "plan: out of memory");
}

static enum status fill_place(struct planner *pl, const struct case_file *file, size_t point,
                              struct place *out) {
    const struct case_tier *t = &file->tier[pl->plan->tier];
    struct case_parameter *p = arena_take(&pl->plan->arena, t->room, sizeof *p);
    if (p == NULL)
        return no_memory(pl);
    size_t count = case_point(t, point, p);
    const char *name = case_point_text(&pl->plan->arena, t, p, count, t->axis_count);
    *out = (struct place){case_runs(file), t, name, p, count};
    return out->point == NULL ? no_memory(pl) : STATUS_OK;
}

static const struct case_file *find_case(const struct planner *pl, const char *name) {
    for (size_t i = 0; i < pl->all_count; i++) {
        if (strcmp(pl->all[i]->name, name) == 0)
            return pl->all[i];
    }
    return NULL;
}

/* What the case says of a parameter of the run that it starts from; NULL: nothing. */
static const struct yaml_node *said_of(const struct place *from, const char *name) {
    return yaml_get(from->tier->start.point, name);
}

static bool is_same(const struct yaml_node *said) {
    return !said->quoted && strcmp(said->text, "same") == 0;
}

/* The one value that a run has of a parameter, or NULL. */
static const char *own_value(const struct place *at, const char *name) {
    const struct yaml_node *own = case_parameter_find(at->parameter, at->count, name);
    return own != NULL && own->kind == YAML_SCALAR ? own->text : NULL;
}

/* Must agree: what the case says; where it says nothing, what is swept there, and
 * readings, which are no business of a start to change unsaid. */
static bool is_wanted(const struct place *from, const struct place *candidate) {
    size_t fixed = candidate->tier->parameter_count;
    for (size_t i = 0; i < candidate->count; i++) {
        const struct case_parameter *p = &candidate->parameter[i];
        const struct yaml_node *said = said_of(from, p->name);
        bool swept = i >= fixed && i < fixed + candidate->tier->axis_count;
        const char *wanted = said != NULL && !is_same(said) ? said->text : own_value(from, p->name);
        if (said == NULL && !swept && (!p->label || wanted == NULL))
            continue;
        if (wanted == NULL || p->value->kind != YAML_SCALAR ||
            !case_value_equal(wanted, p->value->text))
            return false;
    }
    return true;
}

/* Every name stands for a parameter there and, where it is to be the same, here. */
static enum status check_start_names(struct planner *pl, const struct place *from,
                                     const struct place *candidate) {
    const struct case_start *start = &from->tier->start;
    for (size_t i = 0; start->point != NULL && i < start->point->count; i++) {
        const struct yaml_node *n = &start->point->child[i];
        if (case_parameter_find(candidate->parameter, candidate->count, n->key) == NULL)
            return yaml_fault(n, pl->fault, "start: %s has no parameter %s", start->case_name,
                              n->key);
        if (is_same(n) && own_value(from, n->key) == NULL)
            return yaml_fault(n, pl->fault, "start: %s: same, but %s has no one value of it",
                              n->key, from->point);
    }
    return STATUS_OK;
}

/* The point of another case that `from` starts from. */
static enum status find_start(struct planner *pl, const struct place *from, struct place *out) {
    const struct case_start *start = &from->tier->start;
    const struct case_file *file = find_case(pl, start->case_name);
    const char *tier = case_tier_name(pl->plan->tier);
    if (file == NULL)
        return yaml_fault(start->node, pl->fault, "start: no case %s", start->case_name);
    const struct case_tier *t = &file->tier[pl->plan->tier];
    if (!t->present)
        return yaml_fault(start->node, pl->fault, "start: case %s has no tier %s", start->case_name,
                          tier);
    enum status status = STATUS_OK;
    for (size_t i = 0; status == STATUS_OK && i < t->point_count; i++) {
        status = fill_place(pl, file, i, out);
        if (status == STATUS_OK)
            status = check_start_names(pl, from, out);
        if (status == STATUS_OK && is_wanted(from, out))
            return STATUS_OK;
    }
    if (status != STATUS_OK)
        return status;
    return yaml_fault(start->node, pl->fault, "start: no point of %s in tier %s is meant by %s",
                      start->case_name, tier, from->point);
}

static enum status name_run(struct planner *pl, const struct place *at, struct plan_run *run) {
    struct arena *a = &pl->plan->arena;
    char *id = arena_text(a, "%s.", at->file->name);
    if (id == NULL)
        return no_memory(pl);
    for (char *p = id; *p != '\0'; p++)
        *p = *p == '/' ? '.' : *p;
    const char *identity = plan_text_identity(a, at->file, at->tier, at->parameter, at->count,
                                              run->start == NULL ? NULL : run->start->id);
    if (identity == NULL)
        return no_memory(pl);
    struct digest d;
    digest_bytes(identity, strlen(identity), &d);
    run->id = arena_text(a, "%s%.8s", id, d.hex);
    run->name = arena_text(a, "%s-s%lld", run->id, run->seed);
    run->run_file = arena_text(a, "%s.yaml", run->start == NULL ? run->id : run->name);
    return run->id == NULL || run->name == NULL || run->run_file == NULL ? no_memory(pl)
                                                                         : STATUS_OK;
}

static enum status describe_run(struct planner *pl, const struct place *at, struct plan_run *run) {
    struct arena *a = &pl->plan->arena;
    const char *start = run->start == NULL ? NULL : arena_text(a, "../h5/%s.h5", run->start->name);
    struct plan_text_input in = {at->file, at->tier, at->point, at->parameter, at->count, start};
    run->case_name = at->file->name;
    run->point = at->point;
    run->text = plan_text(a, &in, true);
    run->meaning = plan_text(a, &in, false);
    run->expect_s = case_rule_value(&at->tier->expect_s, at->parameter, at->count);
    run->limit_s = at->tier->limit_s;
    run->bytes = plan_text_bytes(&in);
    return run->text == NULL || run->meaning == NULL ? no_memory(pl) : STATUS_OK;
}

static struct plan_run *find_run(const struct plan *p, const char *name) {
    for (size_t i = 0; i < p->run_count; i++) {
        if (strcmp(p->run[i]->name, name) == 0)
            return p->run[i];
    }
    return NULL;
}

static enum status add_run(struct planner *pl, struct plan_run *run) {
    struct plan *p = pl->plan;
    if (p->run_count >= MAX_RUNS)
        return fault_set(pl->fault, STATUS_BAD_INPUT, "plan: more than %d runs", (int)MAX_RUNS);
    struct plan_run **wider = arena_grow(&p->arena, p->run, p->run_count, sizeof *wider);
    if (wider == NULL)
        return no_memory(pl);
    p->run = wider;
    run->index = p->run_count;
    p->run[p->run_count++] = run;
    return STATUS_OK;
}

/* The run of a place and a seed, with all that it starts from: each once. */
static enum status get_run(struct planner *pl, const struct place *at, long long seed, int chain,
                           struct plan_run **out) {
    struct plan_run *run = arena_take(&pl->plan->arena, 1, sizeof *run);
    if (run == NULL)
        return no_memory(pl);
    if (chain > MAX_CHAIN)
        return yaml_fault(at->tier->start.node, pl->fault,
                          "start: more than %d cases start from each other", (int)MAX_CHAIN);
    run->seed = seed;
    enum status status = STATUS_OK;
    if (at->tier->start.case_name != NULL) {
        struct place start;
        status = find_start(pl, at, &start);
        if (status == STATUS_OK)
            status = get_run(pl, &start, seed, chain + 1, &run->start);
    }
    if (status == STATUS_OK)
        status = name_run(pl, at, run);
    if (status != STATUS_OK)
        return status;
    *out = find_run(pl->plan, run->name);
    if (*out != NULL)
        return STATUS_OK;
    *out = run;
    status = describe_run(pl, at, run);
    return status == STATUS_OK ? add_run(pl, run) : status;
}

static enum status plan_point(struct planner *pl, const struct case_file *file, size_t index,
                              struct plan_point *out) {
    struct place at;
    enum status status = fill_place(pl, file, index, &at);
    if (status != STATUS_OK)
        return status;
    const struct case_seeds *seeds = &at.tier->seeds;
    size_t count = case_seed_count(seeds, at.parameter, at.count);
    struct plan_run **run = arena_take(&pl->plan->arena, count, sizeof *run);
    if (run == NULL)
        return no_memory(pl);
    *out = (struct plan_point){at.point, at.count, count, at.parameter, run};
    for (size_t i = 0; status == STATUS_OK && i < count; i++)
        status = get_run(pl, &at, seeds->first + pl->seed_offset + (long long)i, 0, &run[i]);
    return status;
}

static enum status plan_case(struct planner *pl, const struct plan_order *order,
                             struct plan_case *out) {
    const struct case_tier *t = &order->file->tier[pl->plan->tier];
    *out = (struct plan_case){.file = order->file, .tier = t, .skip_reason = order->skip_reason};
    if (order->skip_reason != NULL)
        return STATUS_OK;
    if (!t->present)
        return fault_set(pl->fault, STATUS_BAD_INPUT, "case %s: has no tier %s", order->file->name,
                         case_tier_name(pl->plan->tier));
    struct plan_point *point = arena_take(&pl->plan->arena, t->point_count, sizeof *point);
    if (point == NULL)
        return no_memory(pl);
    out->point = point;
    out->point_count = t->point_count;
    enum status status = STATUS_OK;
    for (size_t i = 0; status == STATUS_OK && i < t->point_count; i++)
        status = plan_point(pl, order->file, i, &point[i]);
    return status;
}

enum status plan_make(const struct plan_order *order, size_t count,
                      const struct case_file *const *all, size_t all_count, enum tier tier,
                      long long seed_offset, struct plan **out, struct fault *fault) {
    *out = NULL;
    struct plan *p = calloc(1, sizeof *p);
    if (p == NULL)
        return fault_set(fault, STATUS_NO_MEMORY, "plan: out of memory");
    p->tier = tier;
    p->cases = arena_take(&p->arena, count, sizeof *p->cases);
    struct planner pl = {p, all, all_count, seed_offset, fault};
    enum status status = p->cases == NULL ? no_memory(&pl) : STATUS_OK;
    for (; status == STATUS_OK && p->case_count < count; p->case_count++)
        status = plan_case(&pl, &order[p->case_count], &p->cases[p->case_count]);
    if (status != STATUS_OK) {
        plan_free(p);
        return status;
    }
    *out = p;
    return STATUS_OK;
}

void plan_free(struct plan *p) {
    if (p == NULL)
        return;
    arena_free(&p->arena);
    free(p);
}
