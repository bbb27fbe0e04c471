/* results.c -- see results.h.  JSON is a subset of YAML, so the house's reader serves. */
#include "validation/results.h"

#include "common/file.h"
#include "common/yaml.h"
#include "report/report.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_BYTES = 1 << 28 };

struct reader {
    struct arena *arena;
    struct fault *fault;
};

static enum status no_memory(struct reader *r) {
    return fault_set(r->fault, STATUS_NO_MEMORY, "results: out of memory");
}

static bool is_null(const struct yaml_node *n) {
    return n->kind == YAML_SCALAR && !n->quoted && strcmp(n->text, "null") == 0;
}

/* A member that must be there, of that kind. */
static const struct yaml_node *member(struct reader *r, const struct yaml_node *map,
                                      const char *key, enum yaml_kind kind) {
    const struct yaml_node *n = yaml_get(map, key);
    if (n == NULL)
        yaml_fault(map, r->fault,
                   "%s is missing: if an earlier bedcheck wrote this, judge the folder again with "
                   "`bedcheck check`",
                   key);
    else if (n->kind != kind)
        yaml_fault(n, r->fault, "%s: must be a %s", key,
                   kind == YAML_MAP    ? "map"
                   : kind == YAML_LIST ? "list"
                                       : "single value");
    return n == NULL || n->kind != kind ? NULL : n;
}

/* NULL for null, where that is allowed. */
static const char *text_of(struct reader *r, const struct yaml_node *map, const char *key,
                           bool optional) {
    const struct yaml_node *n = member(r, map, key, YAML_SCALAR);
    if (n == NULL || (optional && is_null(n)))
        return NULL;
    if (!n->quoted) {
        yaml_fault(n, r->fault, "%s: must be a text", key);
        return NULL;
    }
    const char *text = arena_copy(r->arena, n->text);
    if (text == NULL)
        no_memory(r);
    return text;
}

static void read_real(struct reader *r, const struct yaml_node *n, double *out) {
    *out = NAN;
    if (!is_null(n))
        yaml_real(n, out, r->fault);
}

static double real_of(struct reader *r, const struct yaml_node *map, const char *key) {
    double value = NAN;
    const struct yaml_node *n = member(r, map, key, YAML_SCALAR);
    if (n != NULL)
        read_real(r, n, &value);
    return value;
}

static size_t count_of(struct reader *r, const struct yaml_node *map, const char *key) {
    long long value = 0;
    const struct yaml_node *n = member(r, map, key, YAML_SCALAR);
    if (n != NULL && yaml_integer(n, &value, r->fault) == STATUS_OK && value < 0)
        yaml_fault(n, r->fault, "%s: must not be negative", key);
    return value < 0 ? 0 : (size_t)value;
}

/* -- rows ------------------------------------------------------------------------ */

static void read_runs(struct reader *r, const struct yaml_node *map, struct results_row *row) {
    const struct yaml_node *list = member(r, map, "runs", YAML_LIST);
    if (list == NULL)
        return;
    const char **run = arena_take(r->arena, list->count, sizeof *run);
    for (size_t i = 0; run != NULL && i < list->count; i++) {
        const struct yaml_node *n = &list->child[i];
        if (n->kind != YAML_SCALAR || !n->quoted || !file_name_is_inside(n->text) ||
            strchr(n->text, '/') != NULL)
            yaml_fault(n, r->fault, "runs: not the name of a run");
        else if ((run[row->run_count++] = arena_copy(r->arena, n->text)) == NULL)
            run = NULL;
    }
    row->run = run;
    if (run == NULL)
        no_memory(r);
}

static void read_values(struct reader *r, const struct yaml_node *map, struct results_row *row) {
    const struct yaml_node *values = member(r, map, "values", YAML_LIST);
    const struct yaml_node *seeds = member(r, map, "seeds", YAML_LIST);
    if (values == NULL || seeds == NULL)
        return;
    if (values->count != seeds->count) {
        yaml_fault(values, r->fault, "%zu values of %zu seeds", values->count, seeds->count);
        return;
    }
    double *value = arena_take(r->arena, values->count, sizeof *value);
    long long *seed = arena_take(r->arena, values->count, sizeof *seed);
    if (value == NULL || seed == NULL) {
        no_memory(r);
        return;
    }
    for (size_t i = 0; i < values->count; i++) {
        read_real(r, &values->child[i], &value[i]);
        yaml_integer(&seeds->child[i], &seed[i], r->fault);
    }
    row->value = value;
    row->seed = seed;
    row->value_count = values->count;
}

static void read_row(struct reader *r, const struct yaml_node *n, struct results_row *row) {
    if (n->kind != YAML_MAP) {
        yaml_fault(n, r->fault, "checks: each must be a map");
        return;
    }
    *row = (struct results_row){.case_name = text_of(r, n, "case", false),
                                .point = text_of(r, n, "point", false),
                                .check = text_of(r, n, "check", false),
                                .observable = text_of(r, n, "observable", false),
                                .unit = text_of(r, n, "unit", true),
                                .comparison = text_of(r, n, "comparison", true),
                                .kind = text_of(r, n, "kind", false),
                                .verdict = text_of(r, n, "verdict", false),
                                .reason = text_of(r, n, "reason", true),
                                .key = text_of(r, n, "key", true),
                                .meaning = text_of(r, n, "meaning", true),
                                .measured = real_of(r, n, "measured"),
                                .uncertainty = real_of(r, n, "uncertainty"),
                                .expected = real_of(r, n, "expected"),
                                .expected_uncertainty = real_of(r, n, "expected_uncertainty"),
                                .tolerance = real_of(r, n, "tolerance"),
                                .detectable = real_of(r, n, "detectable"),
                                .freedom = real_of(r, n, "freedom")};
    if (isnan(row->freedom))
        row->freedom = INFINITY;
    read_runs(r, n, row);
    read_values(r, n, row);
}

static bool is_twin(const struct results_row *a, const struct results_row *b) {
    return strcmp(a->case_name, b->case_name) == 0 && strcmp(a->check, b->check) == 0 &&
           strcmp(a->point, b->point) == 0;
}

static enum status read_rows(struct reader *r, const struct yaml_node *root, struct results *out) {
    const struct yaml_node *list = member(r, root, "checks", YAML_LIST);
    if (list == NULL)
        return r->fault->status;
    struct results_row *row = arena_take(r->arena, list->count, sizeof *row);
    if (row == NULL)
        return no_memory(r);
    for (size_t i = 0; i < list->count && r->fault->status == STATUS_OK; i++)
        read_row(r, &list->child[i], &row[i]);
    if (r->fault->status != STATUS_OK)
        return r->fault->status;
    for (size_t i = 0; i < list->count; i++) {
        for (size_t k = 0; k < i; k++)
            row[i].twin += is_twin(&row[i], &row[k]);
    }
    out->row = row;
    out->row_count = list->count;
    return STATUS_OK;
}

/* -- head ------------------------------------------------------------------------ */

static void read_skipped(struct reader *r, const struct yaml_node *root, struct results *out) {
    const struct yaml_node *list = member(r, root, "skipped", YAML_LIST);
    if (list == NULL)
        return;
    struct results_skipped *skipped = arena_take(r->arena, list->count, sizeof *skipped);
    if (skipped == NULL) {
        no_memory(r);
        return;
    }
    for (size_t i = 0; i < list->count; i++) {
        if (list->child[i].kind != YAML_MAP) {
            yaml_fault(&list->child[i], r->fault, "skipped: each must be a map");
            return;
        }
        skipped[i].case_name = text_of(r, &list->child[i], "case", false);
        skipped[i].reason = text_of(r, &list->child[i], "reason", true);
    }
    out->skipped = skipped;
    out->skipped_count = list->count;
}

static void read_counts(struct reader *r, const struct yaml_node *root, struct results *out) {
    const struct yaml_node *counts = member(r, root, "counts", YAML_MAP);
    if (counts == NULL)
        return;
    out->counts.pass = count_of(r, counts, "pass");
    out->counts.fail = count_of(r, counts, "fail");
    out->counts.inconclusive = count_of(r, counts, "inconclusive");
    out->counts.skipped = count_of(r, counts, "skipped");
    if (yaml_get(counts, "known") != NULL)
        out->counts.known = count_of(r, counts, "known");
}

/* What the solver says of its build; a solver need not say anything. */
static const char *fact_of(struct reader *r, const struct yaml_node *root, const char *name) {
    const struct yaml_node *facts = member(r, root, "provenance", YAML_MAP);
    const struct yaml_node *n = facts == NULL ? NULL : yaml_get(facts, name);
    const char *text = arena_copy(
        r->arena, n == NULL || n->kind != YAML_SCALAR || is_null(n) ? "unknown" : n->text);
    if (text == NULL)
        no_memory(r);
    return text;
}

static enum status read_head(struct reader *r, const struct yaml_node *root, struct results *out) {
    if (root->kind != YAML_MAP)
        return yaml_fault(root, r->fault, "not results of bedcheck");
    const char *schema = text_of(r, root, "schema", false);
    if (schema != NULL && strcmp(schema, "bedcheck-results 1") != 0)
        return yaml_fault(root, r->fault, "schema: %s is not bedcheck-results 1", schema);
    const struct yaml_node *modified = member(r, root, "modified", YAML_SCALAR);
    bool is_modified = false;
    out->tier = text_of(r, root, "tier", false);
    out->solver = text_of(r, root, "solver", false);
    out->solver_key = text_of(r, root, "solver_key", false);
    out->started = text_of(r, root, "started", false);
    out->verdict = text_of(r, root, "verdict", false);
    const char *modification = text_of(r, root, "modification", true);
    if (modified != NULL && yaml_boolean(modified, &is_modified, r->fault) == STATUS_OK &&
        is_modified)
        out->modification = modification == NULL ? "unknown" : modification;
    read_counts(r, root, out);
    read_skipped(r, root, out);
    out->commit = fact_of(r, root, "solver: commit");
    out->dirty = fact_of(r, root, "solver: dirty");
    return r->fault->status;
}

enum status results_load(const char *folder, struct results **out, struct fault *fault) {
    struct yaml_document *d = NULL;
    char *path = file_join(folder, "results.json");
    struct results *results = calloc(1, sizeof *results);
    *out = NULL;
    enum status status = STATUS_OK;
    if (path == NULL || results == NULL) {
        status = fault_set(fault, STATUS_NO_MEMORY, "results: out of memory");
        goto end;
    }
    struct reader r = {&results->arena, fault};
    results->folder = arena_copy(r.arena, folder);
    if ((status = yaml_load(path, MAX_BYTES, &d, fault)) != STATUS_OK)
        goto end;
    if (results->folder == NULL)
        status = no_memory(&r);
    else if ((status = read_head(&r, yaml_root(d), results)) == STATUS_OK)
        status = read_rows(&r, yaml_root(d), results);
end:
    if (status == STATUS_OK)
        *out = results;
    else
        results_free(results);
    yaml_free(d);
    free(path);
    return status;
}

void results_free(struct results *r) {
    if (r == NULL)
        return;
    arena_free(&r->arena);
    free(r);
}

/* -- asking ---------------------------------------------------------------------- */

const struct results_row *results_find(const struct results *r, const struct results_row *like) {
    for (size_t i = 0; i < r->row_count; i++) {
        if (r->row[i].twin == like->twin && is_twin(&r->row[i], like))
            return &r->row[i];
    }
    return NULL;
}

bool results_is_run(const struct results_row *row) {
    return strcmp(row->kind, "run") == 0;
}

double results_margin_used(const struct results_row *row) {
    const struct report_row like = {.measured = row->measured,
                                    .expected = row->expected,
                                    .tolerance = row->tolerance,
                                    .comparison = row->comparison};
    return report_margin_used(&like);
}
