/* results.c -- see results.h. */
#include "validation/results.h"

#include "common/file.h"
#include "common/yaml.h"
#include "report/report.h"
#include "validation/record.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_BYTES = 1 << 28 };

static const char hint[] =
    "if an earlier bedcheck wrote this, judge the folder again with `bedcheck check`";

/* -- rows ------------------------------------------------------------------------ */

static void read_runs(const struct record *r, const struct yaml_node *map,
                      struct results_row *row) {
    const struct yaml_node *list = record_member(r, map, "runs", YAML_LIST);
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
        record_no_memory(r);
}

static void read_values(const struct record *r, const struct yaml_node *map,
                        struct results_row *row) {
    const struct yaml_node *values = record_member(r, map, "values", YAML_LIST);
    const struct yaml_node *seeds = record_member(r, map, "seeds", YAML_LIST);
    if (values == NULL || seeds == NULL)
        return;
    if (values->count != seeds->count) {
        yaml_fault(values, r->fault, "%zu values of %zu seeds", values->count, seeds->count);
        return;
    }
    double *value = arena_take(r->arena, values->count, sizeof *value);
    long long *seed = arena_take(r->arena, values->count, sizeof *seed);
    if (value == NULL || seed == NULL) {
        record_no_memory(r);
        return;
    }
    for (size_t i = 0; i < values->count; i++) {
        value[i] = record_real_of(r, &values->child[i]);
        yaml_integer(&seeds->child[i], &seed[i], r->fault);
    }
    row->value = value;
    row->seed = seed;
    row->value_count = values->count;
}

static void read_row(const struct record *r, const struct yaml_node *n, struct results_row *row) {
    if (n->kind != YAML_MAP) {
        yaml_fault(n, r->fault, "checks: each must be a map");
        return;
    }
    *row = (struct results_row){.case_name = record_text(r, n, "case"),
                                .point = record_text(r, n, "point"),
                                .check = record_text(r, n, "check"),
                                .observable = record_text(r, n, "observable"),
                                .unit = record_optional_text(r, n, "unit"),
                                .comparison = record_optional_text(r, n, "comparison"),
                                .kind = record_text(r, n, "kind"),
                                .verdict = record_text(r, n, "verdict"),
                                .reason = record_optional_text(r, n, "reason"),
                                .key = record_optional_text(r, n, "key"),
                                .meaning = record_optional_text(r, n, "meaning"),
                                .measured = record_real(r, n, "measured"),
                                .uncertainty = record_real(r, n, "uncertainty"),
                                .expected = record_real(r, n, "expected"),
                                .expected_uncertainty = record_real(r, n, "expected_uncertainty"),
                                .tolerance = record_real(r, n, "tolerance"),
                                .detectable = record_real(r, n, "detectable"),
                                .freedom = record_real(r, n, "freedom")};
    if (isnan(row->freedom))
        row->freedom = INFINITY;
    read_runs(r, n, row);
    read_values(r, n, row);
}

static bool is_twin(const struct results_row *a, const struct results_row *b) {
    return strcmp(a->case_name, b->case_name) == 0 && strcmp(a->check, b->check) == 0 &&
           strcmp(a->point, b->point) == 0;
}

static enum status read_rows(const struct record *r, const struct yaml_node *root,
                             struct results *out) {
    const struct yaml_node *list = record_member(r, root, "checks", YAML_LIST);
    if (list == NULL)
        return r->fault->status;
    struct results_row *row = arena_take(r->arena, list->count, sizeof *row);
    if (row == NULL)
        return record_no_memory(r);
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

static void read_skipped(const struct record *r, const struct yaml_node *root,
                         struct results *out) {
    const struct yaml_node *list = record_member(r, root, "skipped", YAML_LIST);
    if (list == NULL)
        return;
    struct results_skipped *skipped = arena_take(r->arena, list->count, sizeof *skipped);
    if (skipped == NULL) {
        record_no_memory(r);
        return;
    }
    for (size_t i = 0; i < list->count; i++) {
        if (list->child[i].kind != YAML_MAP) {
            yaml_fault(&list->child[i], r->fault, "skipped: each must be a map");
            return;
        }
        skipped[i].case_name = record_text(r, &list->child[i], "case");
        skipped[i].reason = record_optional_text(r, &list->child[i], "reason");
    }
    out->skipped = skipped;
    out->skipped_count = list->count;
}

static void read_counts(const struct record *r, const struct yaml_node *root, struct results *out) {
    const struct yaml_node *counts = record_member(r, root, "counts", YAML_MAP);
    if (counts == NULL)
        return;
    out->counts.pass = record_count(r, counts, "pass");
    out->counts.fail = record_count(r, counts, "fail");
    out->counts.inconclusive = record_count(r, counts, "inconclusive");
    out->counts.skipped = record_count(r, counts, "skipped");
    if (yaml_get(counts, "known") != NULL)
        out->counts.known = record_count(r, counts, "known");
}

/* What the solver says of its build; a solver need not say anything. */
static const char *fact_of(const struct record *r, const struct yaml_node *root, const char *name) {
    const struct yaml_node *facts = record_member(r, root, "provenance", YAML_MAP);
    const struct yaml_node *n = facts == NULL ? NULL : yaml_get(facts, name);
    const char *text = arena_copy(
        r->arena, n == NULL || n->kind != YAML_SCALAR || record_is_null(n) ? "unknown" : n->text);
    if (text == NULL)
        record_no_memory(r);
    return text;
}

static enum status read_head(const struct record *r, const struct yaml_node *root,
                             struct results *out) {
    if (root->kind != YAML_MAP)
        return yaml_fault(root, r->fault, "not results of bedcheck");
    const char *schema = record_text(r, root, "schema");
    if (schema != NULL && strcmp(schema, "bedcheck-results 1") != 0)
        return yaml_fault(root, r->fault, "schema: %s is not bedcheck-results 1", schema);
    const struct yaml_node *modified = record_member(r, root, "modified", YAML_SCALAR);
    bool is_modified = false;
    out->tier = record_text(r, root, "tier");
    out->solver = record_text(r, root, "solver");
    out->solver_key = record_text(r, root, "solver_key");
    out->started = record_text(r, root, "started");
    out->verdict = record_text(r, root, "verdict");
    const char *modification = record_optional_text(r, root, "modification");
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
    const struct record r = {&results->arena, fault, hint};
    results->folder = arena_copy(r.arena, folder);
    if ((status = yaml_load(path, MAX_BYTES, &d, fault)) != STATUS_OK)
        goto end;
    if (results->folder == NULL)
        status = record_no_memory(&r);
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
