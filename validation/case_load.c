/* case_load.c -- a case file as a whole, and how its faults are collected. */
#include "validation/case_read.h"

#include "common/file.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const struct schema_field case_fields[] = {
    {"name", SCHEMA_TEXT, true, 0, 0, NULL},
    {"title", SCHEMA_TEXT, true, 0, 0, NULL},
    {"source", SCHEMA_TEXT, true, 0, 0, NULL},
    {"question", SCHEMA_TEXT, true, 0, 0, NULL},
    {"equation", SCHEMA_TEXT, false, 0, 0, NULL},
    {"model", SCHEMA_TEXT, true, 0, 0, NULL},
    {"large_only", SCHEMA_TEXT, false, 0, 0, NULL},
    {"tags", SCHEMA_LIST, false, 0, 0, NULL},
    {"also_write", SCHEMA_LIST, false, 0, 0, NULL},
    {"parameters", SCHEMA_MAP, false, 0, 0, NULL},
    {"sweep", SCHEMA_MAP, false, 0, 0, NULL},
    {"runs_of", SCHEMA_TEXT, false, 0, 0, NULL},
    {"samples", SCHEMA_ANY, false, 0, 0, NULL},
    {"particle_samples", SCHEMA_ANY, false, 0, 0, NULL},
    {"start", SCHEMA_MAP, false, 0, 0, NULL},
    {"seeds", SCHEMA_MAP, false, 0, 0, NULL},
    {"limit_s", SCHEMA_REAL, false, 0.01, 1e7, NULL},
    {"expect_s", SCHEMA_ANY, false, 0, 0, NULL},
    {"observables", SCHEMA_MAP, true, 0, 0, NULL},
    {"across", SCHEMA_MAP, false, 0, 0, NULL},
    {"checks", SCHEMA_LIST, true, 0, 0, NULL},
    {"figures", SCHEMA_LIST, false, 0, 0, NULL},
    {"tiers", SCHEMA_MAP, true, 0, 0, NULL},
};

void *case_read_take(struct case_reader *r, size_t count, size_t size) {
    void *p = arena_take(&r->c->arena, count, size);
    if (p == NULL)
        fault_add(r->fault, STATUS_NO_MEMORY, "%s: out of memory", r->c->path);
    return p;
}

static bool said_already(const struct fault *f, const char *line, size_t length) {
    for (const char *at = f->text; at != NULL && *at != '\0'; at = strchr(at, '\n')) {
        at += *at == '\n';
        if (strncmp(at, line, length) == 0 && (at[length] == '\n' || at[length] == '\0'))
            return true;
    }
    return false;
}

void case_read_merge(struct case_reader *r, const struct fault *from) {
    const char *line = from->text;
    while (from->findings > 0 && *line != '\0') {
        size_t length = strcspn(line, "\n");
        if (!said_already(r->fault, line, length))
            fault_add(r->fault, from->status, "%.*s", (int)length, line);
        line += length + (line[length] == '\n');
    }
}

bool case_read_fields(struct case_reader *r, const struct yaml_node *map, const char *what,
                      const struct schema_field *fields, size_t count) {
    struct fault found = FAULT_NONE;
    schema_check(map, what, fields, count, &found);
    case_read_merge(r, &found);
    return found.status == STATUS_OK;
}

void case_read_fault(struct case_reader *r, const struct yaml_node *n, const char *format, ...) {
    char text[1024];
    va_list list;
    va_start(list, format);
    vsnprintf(text, sizeof text, format, list);
    va_end(list);
    struct fault found = FAULT_NONE;
    yaml_fault(n, &found, "%s", text);
    case_read_merge(r, &found);
}

void case_read_unknown(struct case_reader *r, const struct yaml_node *n, const char *what,
                       const char *name, const char *const *names, size_t count) {
    const char *near = schema_nearest(name, names, count);
    if (near != NULL)
        case_read_fault(r, n, "%s: no such %s; did you mean %s?", name, what, near);
    else
        case_read_fault(r, n, "%s: no such %s", name, what);
}

void case_read_mark(struct case_reader *r, const struct yaml_node *n, bool used) {
    for (size_t i = 0; i < r->mark_count; i++) {
        if (r->mark[i].node == n) {
            r->mark[i].used |= used;
            return;
        }
    }
    struct case_mark *wider = arena_grow(&r->c->arena, r->mark, r->mark_count, sizeof *wider);
    if (wider == NULL) {
        fault_add(r->fault, STATUS_NO_MEMORY, "%s: out of memory", r->c->path);
        return;
    }
    r->mark = wider;
    r->mark[r->mark_count++] = (struct case_mark){n, used};
}

/* Texts of the root: a copy of a pointer each, and a name that fits its file. */
static void read_texts(struct case_reader *r, const char *name) {
    struct case_file *c = r->c;
    const struct {
        const char *key, **out;
    } text[] = {{"name", &c->name},
                {"title", &c->title},
                {"source", &c->source},
                {"question", &c->question},
                {"equation", &c->equation},
                {"model", &c->model},
                {"large_only", &c->large_only}};
    for (size_t i = 0; i < sizeof text / sizeof *text; i++) {
        const struct yaml_node *n = yaml_get(r->root, text[i].key);
        if (n == NULL || n->kind != YAML_SCALAR)
            continue;
        *text[i].out = n->text;
        if (n->text[strspn(n->text, " \n\t")] == '\0')
            case_read_fault(r, n, "%s: must not be empty", text[i].key);
    }
    if (c->name != NULL && strcmp(c->name, name) != 0)
        case_read_fault(r, yaml_get(r->root, "name"), "name: %s, but the file must hold case %s",
                        c->name, name);
    if (c->model != NULL && (strchr(c->model, '/') != NULL || !case_name_is_safe(c->model)))
        case_read_fault(r, yaml_get(r->root, "model"), "model: %s is no name of a model", c->model);
}

/* Each tier that the file names; smoke is there unless the file says why not. */
static void read_tiers(struct case_reader *r) {
    const struct yaml_node *tiers = yaml_get(r->root, "tiers");
    const struct schema_field fields[] = {{"smoke", SCHEMA_MAP, false, 0, 0, NULL},
                                          {"paper", SCHEMA_MAP, false, 0, 0, NULL},
                                          {"large", SCHEMA_MAP, false, 0, 0, NULL}};
    if (tiers == NULL || tiers->kind != YAML_MAP)
        return;
    case_read_fields(r, tiers, "tiers", fields, sizeof fields / sizeof *fields);
    for (enum tier t = 0; t < TIER_COUNT; t++) {
        const struct yaml_node *over = yaml_get(tiers, case_tier_name(t));
        if (over == NULL || over->kind != YAML_MAP)
            continue;
        r->c->tier[t].present = true;
        r->c->tier[t].node = over;
        case_read_tier(r, t, over);
        case_read_checks(r, t, over);
        case_read_points(r, t);
    }
    if (!r->c->tier[TIER_SMOKE].present && r->c->large_only == NULL)
        case_read_fault(r, tiers,
                        "tiers: no smoke tier; a case too large for one says why with "
                        "large_only: REASON");
    if (r->c->tier[TIER_SMOKE].present && r->c->large_only != NULL)
        case_read_fault(r, yaml_get(r->root, "large_only"),
                        "large_only: the case has a smoke tier all the same");
}

static bool is_in_some_tier(const struct case_file *c, const struct yaml_node *check) {
    for (enum tier t = 0; t < TIER_COUNT; t++) {
        for (size_t i = 0; i < c->tier[t].check_count; i++) {
            if (c->tier[t].check[i].node == check)
                return true;
        }
    }
    return false;
}

/* What stands in the file and does nothing is a mistake. */
static void refuse_unused(struct case_reader *r) {
    const struct yaml_node *checks = yaml_get(r->root, "checks");
    for (size_t i = 0; i < checks->count; i++) {
        if (!is_in_some_tier(r->c, &checks->child[i]))
            case_read_fault(r, &checks->child[i], "check %s: is in no tier",
                            yaml_get(&checks->child[i], "name")->text);
    }
    for (size_t i = 0; i < r->c->across_count; i++) {
        if (!r->across_used[i])
            case_read_fault(r, r->c->across[i].node, "across %s: no check uses it",
                            r->c->across[i].name);
    }
    for (size_t i = 0; i < r->c->observable_count; i++) {
        if (!r->observable_used[i])
            case_read_fault(r, r->c->observable[i].node,
                            "observable %s: no check and no figure uses it",
                            r->c->observable[i].name);
    }
    for (size_t i = 0; i < r->mark_count; i++) {
        const struct yaml_node *n = r->mark[i].node;
        if (!r->mark[i].used)
            case_read_fault(r, n, "%s: no point of any tier has this value",
                            n->key != NULL ? n->key : n->text);
    }
}

static int by_text(const void *a, const void *b) {
    return strcmp(*(const char *const *)a, *(const char *const *)b);
}

/* The datasets that a solver is asked to write: sorted, each once. */
static void collect_datasets(struct case_reader *r) {
    struct case_file *c = r->c;
    const struct yaml_node *more = yaml_get(r->root, "also_write");
    size_t count = 0, kept = 0, room = more != NULL && more->kind == YAML_LIST ? more->count : 0;
    for (size_t i = 0; i < c->observable_count; i++) {
        const char *const *d =
            c->observable[i].recipe == NULL ? NULL : c->observable[i].recipe->datasets;
        for (; d != NULL && *d != NULL; d++)
            room++;
    }
    const char **all = case_read_take(r, room, sizeof *all);
    if (all == NULL)
        return;
    for (size_t i = 0; i < c->observable_count; i++) {
        const char *const *d =
            c->observable[i].recipe == NULL ? NULL : c->observable[i].recipe->datasets;
        for (; d != NULL && *d != NULL; d++)
            all[count++] = *d;
    }
    for (size_t i = 0; more != NULL && more->kind == YAML_LIST && i < more->count; i++) {
        const struct yaml_node *n = &more->child[i];
        if (n->kind == YAML_SCALAR && file_name_is_inside(n->text))
            all[count++] = n->text;
        else
            case_read_fault(r, n, "also_write: not the name of a dataset");
    }
    qsort(all, count, sizeof *all, by_text);
    for (size_t i = 0; i < count; i++) {
        if (kept == 0 || strcmp(all[i], all[kept - 1]) != 0)
            all[kept++] = all[i];
    }
    c->dataset = all;
    c->dataset_count = kept;
}

static enum status load(const char *folder, const char *name, bool borrowed, struct case_file **out,
                        struct fault *fault);

/* A case describes its runs, or reads those of another, and then nothing else. */
static void read_runs_of(struct case_reader *r, const char *folder) {
    static const char *const required[] = {"samples", "expect_s"};
    static const char *const own[] = {"parameters",       "sweep",    "samples",
                                      "particle_samples", "start",    "seeds",
                                      "limit_s",          "expect_s", "also_write"};
    const struct yaml_node *of = yaml_get(r->root, "runs_of");
    r->runs = r->root;
    for (size_t i = 0; of == NULL && i < sizeof required / sizeof *required; i++)
        if (yaml_get(r->root, required[i]) == NULL)
            case_read_fault(r, r->root, "%s: missing", required[i]);
    if (of == NULL || of->kind != YAML_SCALAR)
        return;
    if (r->borrowed) {
        case_read_fault(r, of, "runs_of: another case reads its runs, so they must be its own");
        return;
    }
    for (size_t i = 0; i < sizeof own / sizeof *own; i++)
        if (yaml_get(r->root, own[i]) != NULL)
            case_read_fault(r, yaml_get(r->root, own[i]), "%s: the runs are those of %s", own[i],
                            of->text);
    struct fault found = FAULT_NONE;
    if (load(folder, of->text, true, &r->c->runs, &found) != STATUS_OK) {
        case_read_merge(r, &found);
        case_read_fault(r, of, "runs_of: case %s cannot be read", of->text);
    } else if (r->c->model != NULL && strcmp(r->c->model, r->c->runs->model) != 0)
        case_read_fault(r, of, "runs_of: %s is of model %s", of->text, r->c->runs->model);
    if (r->c->runs != NULL)
        r->runs = yaml_root(r->c->runs->document);
}

/* What its observables read must be in the runs that another case describes. */
static void check_runs_hold(struct case_reader *r) {
    const struct case_file *of = r->c->runs;
    for (size_t i = 0; of != NULL && i < r->c->dataset_count; i++)
        if (of->dataset_count == 0 || bsearch(&r->c->dataset[i], of->dataset, of->dataset_count,
                                              sizeof *of->dataset, by_text) == NULL)
            case_read_fault(r, yaml_get(r->root, "runs_of"),
                            "runs_of: the runs of %s do not hold %s; its also_write can ask for it",
                            of->name, r->c->dataset[i]);
}

static void read_case(struct case_reader *r, const char *folder, const char *name) {
    if (r->root->kind != YAML_MAP) {
        case_read_fault(r, r->root, "a case is a map of keys");
        return;
    }
    case_read_fields(r, r->root, "case", case_fields, sizeof case_fields / sizeof *case_fields);
    read_texts(r, name);
    read_runs_of(r, folder);
    case_read_parts(r);
    collect_datasets(r);
    check_runs_hold(r);
    read_tiers(r);
    if (r->fault->status == STATUS_OK)
        refuse_unused(r);
}

static enum status load(const char *folder, const char *name, bool borrowed, struct case_file **out,
                        struct fault *fault) {
    *out = NULL;
    if (!case_name_is_safe(name))
        return fault_set(fault, STATUS_BAD_INPUT, "case %s: not a name of a case", name);
    struct case_file *c = calloc(1, sizeof *c);
    if (c == NULL)
        return fault_set(fault, STATUS_NO_MEMORY, "case %s: out of memory", name);
    struct fault found = FAULT_NONE;
    c->path = arena_text(&c->arena, "%s/%s.yaml", folder, name);
    if (c->path == NULL)
        fault_set(&found, STATUS_NO_MEMORY, "case %s: out of memory", name);
    else if (yaml_load(c->path, YAML_CASE_MAX_BYTES, &c->document, &found) == STATUS_OK) {
        struct case_reader r = {.c = c,
                                .folder = folder,
                                .root = yaml_root(c->document),
                                .fault = &found,
                                .borrowed = borrowed};
        read_case(&r, folder, name);
    }
    if (found.status == STATUS_OK) {
        *out = c;
        return STATUS_OK;
    }
    case_free(c);
    *fault = found;
    return found.status;
}

enum status case_load(const char *folder, const char *name, struct case_file **out,
                      struct fault *fault) {
    return load(folder, name, false, out, fault);
}
