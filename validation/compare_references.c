#include "validation/compare_references.h"

#include "common/runfile.h"
#include "validation/bits.h"
#include "validation/reference.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

struct kept { /* references of one case */
    const char *case_name;
    struct references *references;
};

struct reader {
    const struct results *judged;
    const char *folder;
    enum tier tier;
    struct kept *kept; /* kept[0 .. kept_count-1] */
    size_t kept_count;
    struct results *old, *new;
    struct results_row *old_row, *new_row;
    struct compare_runs *runs;
    struct fault *fault;
};

static enum status no_memory(struct reader *r) {
    return fault_set(r->fault, STATUS_NO_MEMORY, "references: out of memory");
}

/* -- references of all cases ------------------------------------------------------ */

static struct references *find_kept(const struct reader *r, const char *case_name) {
    for (size_t i = 0; i < r->kept_count; i++) {
        if (strcmp(r->kept[i].case_name, case_name) == 0)
            return r->kept[i].references;
    }
    return NULL;
}

static enum status load_all(struct reader *r) {
    r->kept = calloc(r->judged->row_count + 1, sizeof *r->kept);
    enum status status = r->kept == NULL ? no_memory(r) : STATUS_OK;
    for (size_t i = 0; status == STATUS_OK && i < r->judged->row_count; i++) {
        const char *name = r->judged->row[i].case_name;
        if (find_kept(r, name) != NULL)
            continue;
        struct references *references;
        status = reference_load(r->folder, name, &references, r->fault);
        if (status == STATUS_OK)
            r->kept[r->kept_count++] = (struct kept){name, references};
    }
    return status;
}

/* -- rows ------------------------------------------------------------------------- */

static const struct reference *ensemble_of(const struct reader *r, const struct results_row *row) {
    if (row->key == NULL || row->meaning == NULL)
        return NULL;
    const struct reference_key key = {r->tier, strcmp(row->point, "single") == 0 ? "-" : row->point,
                                      row->key, row->meaning, false};
    return reference_find(find_kept(r, row->case_name), &key, ORIGIN_ENSEMBLE);
}

static void pair_row(struct reader *r, const struct results_row *row, const struct reference *e) {
    double n = row->value_count > 0 ? (double)row->value_count : 1;
    bool of_differences = strstr(row->key, " - ") != NULL;
    struct results_row *a = &r->old_row[r->old->row_count++];
    struct results_row *b = &r->new_row[r->new->row_count++];
    *b = *row;
    b->uncertainty = e->deviation / sqrt(n);
    b->freedom = (double)e->seeds - 1;
    if (of_differences)
        b->measured -= row->expected;
    *a = *b;
    a->reference = true;
    a->measured = e->value;
    a->uncertainty = e->deviation / sqrt((double)e->seeds);
    a->meaning = e->meaning;
    a->run_count = a->value_count = 0;
}

/* After pair_rows and compare_all_bits: the rows all of whose runs have their references' bits. */
static void mark_same_bits(struct reader *r) {
    for (size_t i = 0; i < r->old->row_count; i++) {
        struct results_row *a = &r->old_row[i];
        const struct results_row *b = results_find(r->new, a);
        size_t equal = 0;
        for (size_t k = 0; b != NULL && k < b->run_count; k++) {
            for (size_t n = 0; n < r->runs->run_count; n++)
                equal += r->runs->run[n].bits == BITS_EQUAL &&
                         strcmp(r->runs->run[n].name, b->run[k]) == 0;
        }
        a->same_bits = b != NULL && equal > 0 && equal == b->run_count;
    }
}

/* The references' own history is one of many commits. */
static void date_references(struct reader *r, const struct reference *e) {
    if (*r->old->started == '\0' || strcmp(r->old->started, e->date) < 0)
        r->old->started = e->date;
    if (*r->old->commit == '\0')
        r->old->commit = e->commit;
    else if (strcmp(r->old->commit, e->commit) != 0)
        r->old->commit = "several";
}

static enum status pair_rows(struct reader *r) {
    struct results *old = r->old, *new = r->new;
    size_t count = r->judged->row_count;
    r->old_row = arena_take(&old->arena, count, sizeof *r->old_row);
    r->new_row = arena_take(&new->arena, count, sizeof *r->new_row);
    if (r->old_row == NULL || r->new_row == NULL)
        return no_memory(r);
    for (size_t i = 0; i < count; i++) {
        const struct results_row *row = &r->judged->row[i];
        const struct reference *e = ensemble_of(r, row);
        if (e != NULL) {
            pair_row(r, row, e);
            date_references(r, e);
        } else {
            r->new_row[new->row_count++] = *row;
        }
    }
    old->row = r->old_row;
    new->row = r->new_row;
    return STATUS_OK;
}

/* -- bits ------------------------------------------------------------------------- */

static const struct reference *find_bits(const struct reader *r, const struct results_row *row,
                                         const char *run, const char *build) {
    const struct references *all = find_kept(r, row->case_name);
    const char *seed = strrchr(run, '-'), *meaning = seed == NULL ? NULL : seed;
    char observable[64];
    if (seed == NULL || seed - run < 8 || seed[1] != 's')
        return NULL;
    meaning = seed - 8;
    snprintf(observable, sizeof observable, "bits@%.40s", seed + 2);
    for (size_t i = 0; i < all->count; i++) {
        const struct reference *e = &all->item[i];
        if (e->origin == ORIGIN_BITS && e->tier == r->tier &&
            strcmp(e->observable, observable) == 0 && strncmp(e->meaning, meaning, 8) == 0 &&
            strcmp(e->build, build) == 0)
            return e;
    }
    return NULL;
}

static enum status digest_run(struct reader *r, const char *run, struct digest *digest,
                              struct fault *why) {
    struct arena *a = &r->runs->arena;
    struct runfile asked = {0};
    const char *seed = strrchr(run, '-');
    const char *result = arena_text(a, "%s/h5/%s.h5", r->judged->folder, run);
    const char *file = arena_text(a, "%s/runs/%s.yaml", r->judged->folder, run);
    struct fault not_there = FAULT_NONE;
    if (result == NULL || file == NULL)
        return no_memory(r);
    enum status status = runfile_load(file, &asked, &not_there);
    if (status != STATUS_OK) { /* a run without a start shares its file with the other seeds */
        file = arena_text(a, "%s/runs/%.*s.yaml", r->judged->folder, (int)(seed - run), run);
        status = file == NULL ? no_memory(r) : runfile_load(file, &asked, why);
    }
    if (status == STATUS_OK)
        status = bits_of_result(result, asked.datasets, asked.dataset_count, digest, why);
    runfile_free(&asked);
    return status;
}

static enum status compare_bits(struct reader *r, const struct results_row *row,
                                struct compare_run *run) {
    struct arena *a = &r->runs->arena;
    struct fault why = FAULT_NONE;
    struct bits_build build;
    struct digest digest;
    const char *record = arena_text(a, "%s/h5/%s.run.json", r->judged->folder, run->name);
    if (record == NULL)
        return no_memory(r);
    run->bits = BITS_UNKNOWN;
    run->why = "no reference of its class of build";
    if (bits_read_build(record, &build, &why) != STATUS_OK)
        return STATUS_OK;
    const struct reference *e = find_bits(r, row, run->name, build.name);
    if (e == NULL)
        return STATUS_OK;
    if (digest_run(r, run->name, &digest, &why) != STATUS_OK) {
        run->why = arena_copy(a, why.text);
        return run->why == NULL ? no_memory(r) : STATUS_OK;
    }
    run->bits = strcmp(digest.hex, e->digest) == 0 ? BITS_EQUAL : BITS_DIFFER;
    return STATUS_OK;
}

static bool is_known(const struct compare_runs *c, const char *name) {
    for (size_t i = 0; i < c->run_count; i++) {
        if (strcmp(c->run[i].name, name) == 0)
            return true;
    }
    return false;
}

static enum status compare_all_bits(struct reader *r) {
    struct compare_runs *c = r->runs;
    enum status status = STATUS_OK;
    for (size_t i = 0; i < r->judged->row_count; i++) {
        const struct results_row *row = &r->judged->row[i];
        for (size_t k = 0; k < row->run_count && status == STATUS_OK; k++) {
            if (is_known(c, row->run[k]))
                continue;
            c->run = arena_grow(&c->arena, c->run, c->run_count, sizeof *c->run);
            if (c->run == NULL)
                return no_memory(r);
            struct compare_run *run = &c->run[c->run_count++];
            *run = (struct compare_run){.name = row->run[k], .case_name = row->case_name};
            status = compare_bits(r, row, run);
            c->count[run->bits]++;
        }
    }
    return status;
}

/* -- all -------------------------------------------------------------------------- */

/* Texts stay with whom they were borrowed from; rows and skipped cases are filled in after. */
static struct results *like(const struct results *r) {
    struct results *copy = calloc(1, sizeof *copy);
    if (copy == NULL)
        return NULL;
    *copy = *r;
    copy->arena = (struct arena){NULL};
    copy->row = NULL;
    copy->row_count = 0;
    return copy;
}

static enum status take_names(struct reader *r) {
    r->old = like(r->judged);
    r->new = like(r->judged);
    r->runs = calloc(1, sizeof *r->runs);
    if (r->old == NULL || r->new == NULL || r->runs == NULL)
        return no_memory(r);
    r->old->skipped_count = 0;
    r->old->references = true;
    r->old->modification = NULL;
    r->old->started = r->old->commit = "";
    r->old->dirty = "accepted";
    r->old->folder = arena_copy(&r->old->arena, r->folder);
    return r->old->folder == NULL ? no_memory(r) : STATUS_OK;
}

/* The lines are freed below: keep what the rows borrow from them. */
static enum status own_texts(struct reader *r) {
    struct arena *a = &r->old->arena;
    r->old->started = arena_copy(a, r->old->started);
    r->old->commit = arena_copy(a, r->old->commit);
    bool ok = r->old->started != NULL && r->old->commit != NULL;
    for (size_t i = 0; ok && i < r->old->row_count; i++) {
        r->old_row[i].meaning = arena_copy(a, r->old_row[i].meaning);
        ok = r->old_row[i].meaning != NULL;
    }
    return ok ? STATUS_OK : no_memory(r);
}

enum status compare_references_load(const struct results *judged, const char *folder,
                                    struct compare_references *out, struct fault *fault) {
    struct reader r = {.judged = judged, .folder = folder, .fault = fault};
    enum status status = case_tier_find(judged->tier, &r.tier, fault);
    if (status == STATUS_OK && (status = take_names(&r)) == STATUS_OK &&
        (status = load_all(&r)) == STATUS_OK && (status = pair_rows(&r)) == STATUS_OK &&
        (status = own_texts(&r)) == STATUS_OK)
        status = compare_all_bits(&r);
    if (status == STATUS_OK)
        mark_same_bits(&r);
    for (size_t i = 0; i < r.kept_count; i++)
        reference_free(r.kept[i].references);
    free(r.kept);
    *out = (struct compare_references){r.old, r.new, r.runs};
    if (status != STATUS_OK)
        compare_references_free(out);
    return status;
}

void compare_references_free(struct compare_references *c) {
    results_free(c->old);
    results_free(c->new);
    compare_runs_free(c->runs);
    *c = (struct compare_references){NULL, NULL, NULL};
}
