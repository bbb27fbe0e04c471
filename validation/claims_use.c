/* claims_use.c -- the cases, checks and points that claims name, looked up; see claims.h. */
#include "validation/claims.h"

#include "common/schema.h"
#include "validation/selection.h"

#include <stdlib.h>
#include <string.h>

enum { MAX_NAMES = 512 };

struct user {
    struct claims *c;
    const char *folder; /* of the case files */
    size_t count;
    struct case_file **file; /* every case that is named, each once; NULL: it cannot be read */
    const char **name;
    struct arena arena;
    struct fault *fault;
};

static void unknown(struct user *u, const struct yaml_node *n, const char *what, const char *name,
                    const char *const *names, size_t count) {
    const char *near = schema_nearest(name, names, count);
    yaml_fault(n, u->fault, "%s: no such %s%s%s%s", name, what,
               near == NULL ? "" : "; did you mean '", near == NULL ? "" : near,
               near == NULL ? "" : "'?");
}

/* -- cases ------------------------------------------------------------------------------- */

/* Names of all cases, for the nearest one. */
static void say_no_case(struct user *u, const struct claim_test *t, const struct fault *why) {
    const struct yaml_node *n = yaml_get(t->node, "case");
    const struct selection_request all = {.folder = u->folder, .any_tier = true};
    struct selection *s = NULL;
    struct fault ignored = FAULT_NONE; /* cases that are bad are told where they are used */
    if (why->status != STATUS_NOT_FOUND || selection_make(&all, &s, &ignored) != STATUS_OK) {
        fault_add(u->fault, why->status, "%s", why->text);
        return;
    }
    const char **name = arena_take(&u->arena, s->count, sizeof *name);
    for (size_t i = 0; name != NULL && i < s->count; i++)
        name[i] = s->order[i].file->name;
    unknown(u, n, "case", t->case_name, name, name == NULL ? 0 : s->count);
    selection_free(s);
}

static const struct case_file *find_case(struct user *u, const struct claim_test *t) {
    for (size_t i = 0; i < u->count; i++) {
        if (strcmp(u->name[i], t->case_name) == 0)
            return u->file[i];
    }
    struct fault why = FAULT_NONE;
    struct case_file **files = arena_grow(&u->arena, u->file, u->count, sizeof *files);
    const char **names = arena_grow(&u->arena, u->name, u->count, sizeof *names);
    if (files == NULL || names == NULL) {
        fault_set(u->fault, STATUS_NO_MEMORY, "claims: out of memory");
        return NULL;
    }
    u->file = files;
    u->name = names;
    u->name[u->count] = t->case_name;
    u->file[u->count] = NULL;
    if (!case_name_is_safe(t->case_name))
        why.status = STATUS_NOT_FOUND;
    else
        case_load(u->folder, t->case_name, &u->file[u->count], &why);
    if (why.status != STATUS_OK)
        say_no_case(u, t, &why);
    return u->file[u->count++];
}

/* -- checks ------------------------------------------------------------------------------ */

static const struct case_check *find_check(const struct case_tier *t, const char *name) {
    for (size_t i = 0; t->present && i < t->check_count; i++) {
        if (strcmp(t->check[i].name, name) == 0)
            return &t->check[i];
    }
    return NULL;
}

static void say_no_check(struct user *u, const struct claim_test *t, const struct case_file *c) {
    const char *name[MAX_NAMES];
    size_t count = 0;
    for (enum tier k = 0; k < TIER_COUNT; k++) {
        for (size_t i = 0; c->tier[k].present && i < c->tier[k].check_count && count < MAX_NAMES;
             i++)
            name[count++] = c->tier[k].check[i].name;
    }
    unknown(u, yaml_get(t->node, "check"), "check", t->check, name, count);
}

/* -- points ------------------------------------------------------------------------------- */

/* What a filter's names and values have met in the tiers looked at so far. */
struct sight {
    bool *name, *value; /* name[i] of filter entry i; value[]: all values, entry after entry */
    bool parameter_set; /* names[] is filled */
    const char *names[MAX_NAMES];
    size_t names_count;
};

static size_t values_of(const struct yaml_node *n) {
    return n->kind == YAML_LIST ? n->count : 1;
}

static const struct yaml_node *value_at(const struct yaml_node *n, size_t k) {
    return n->kind == YAML_LIST ? &n->child[k] : n;
}

static void look_at_point(const struct claim_test *t, const struct case_parameter *p, size_t count,
                          struct sight *s) {
    for (size_t i = 0, v = 0; i < t->points.count; i++) {
        const struct yaml_node *wanted = &t->points.map->child[i];
        const struct yaml_node *has = case_parameter_find(p, count, wanted->key);
        s->name[i] |= has != NULL;
        for (size_t k = 0; k < values_of(wanted); k++, v++)
            s->value[v] |= has != NULL && has->kind == YAML_SCALAR &&
                           case_value_equal(has->text, value_at(wanted, k)->text);
    }
    for (size_t i = 0; !s->parameter_set && i < count && i < MAX_NAMES; i++)
        s->names[s->names_count++] = p[i].name;
    s->parameter_set = true;
}

/* A fit over a sweep has no point along it. */
static void refuse_along(struct user *u, const struct claim_test *t, const struct case_file *c,
                         const struct case_tier *tier, const struct case_check *check) {
    const struct case_across *a = check->number.across ? &c->across[check->number.index] : NULL;
    for (size_t i = 0; a != NULL && a->fit != NULL && i < t->points.count; i++) {
        const struct yaml_node *n = &t->points.map->child[i];
        size_t axis = case_axis_of(tier, n->key);
        if (axis < tier->axis_count && axis == case_axis_of(tier, a->along))
            yaml_fault(n, u->fault, "%s: the check is a fit along it, with no points of it",
                       n->key);
    }
}

static void look_at_tier(struct user *u, struct claim_test *t, const struct case_file *c,
                         enum tier k, struct sight *s) {
    const struct case_tier *tier = &c->tier[k];
    const struct case_check *check = find_check(tier, t->check);
    struct case_parameter *p = check == NULL ? NULL : arena_take(&u->arena, tier->room, sizeof *p);
    if (p == NULL)
        return;
    refuse_along(u, t, c, tier, check);
    for (size_t i = 0; i < tier->point_count; i++) {
        size_t count = case_point(tier, i, p);
        if (!case_filter_takes(&check->points, p, count))
            continue;
        look_at_point(t, p, count, s);
        t->in_tier[k] |= case_filter_takes(&t->points, p, count);
    }
}

static void say_no_points(struct user *u, const struct claim_test *t, const struct sight *s) {
    bool told = false;
    for (size_t i = 0, v = 0; i < t->points.count; i++) {
        const struct yaml_node *n = &t->points.map->child[i];
        if (!s->name[i]) {
            unknown(u, n, "parameter of this case", n->key, s->names, s->names_count);
            told = true;
        }
        for (size_t k = 0; k < values_of(n); k++, v++) {
            if (!s->name[i] || s->value[v])
                continue;
            yaml_fault(value_at(n, k), u->fault, "%s %s: no point of check '%s' of %s has it",
                       n->key, value_at(n, k)->text, t->check, t->case_name);
            told = true;
        }
    }
    for (enum tier k = 0; k < TIER_COUNT; k++)
        told |= t->in_tier[k];
    if (!told)
        yaml_fault(t->node, u->fault, "no point of check '%s' of %s is one of these", t->check,
                   t->case_name);
}

static void use_test(struct user *u, struct claim_test *t) {
    const struct case_file *c = find_case(u, t);
    bool known = false;
    for (enum tier k = 0; c != NULL && k < TIER_COUNT; k++)
        known |= find_check(&c->tier[k], t->check) != NULL;
    if (c == NULL)
        return;
    if (!known) {
        say_no_check(u, t, c);
        return;
    }
    size_t values = 0;
    for (size_t i = 0; i < t->points.count; i++)
        values += values_of(&t->points.map->child[i]);
    struct sight *s = arena_take(&u->arena, 1, sizeof *s);
    bool *flag = arena_take(&u->arena, t->points.count + values, sizeof *flag);
    if (s == NULL || flag == NULL) {
        fault_set(u->fault, STATUS_NO_MEMORY, "claims: out of memory");
        return;
    }
    s->name = flag;
    s->value = flag + t->points.count;
    for (enum tier k = 0; k < TIER_COUNT; k++)
        look_at_tier(u, t, c, k, s);
    say_no_points(u, t, s);
}

enum status claims_use(struct claims *c, const char *cases_folder, struct fault *fault) {
    struct user u = {.c = c, .folder = cases_folder, .fault = fault};
    for (size_t i = 0; i < c->count; i++) {
        for (size_t k = 0; k < c->claim[i].test_count; k++)
            use_test(&u, &c->claim[i].test[k]);
    }
    for (size_t i = 0; i < u.count; i++)
        case_free(u.file[i]);
    arena_free(&u.arena);
    return fault->status;
}
