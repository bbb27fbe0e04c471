#include "validation/compare_runs.h"

#include "common/file.h"
#include "common/runfile.h"
#include "common/yaml.h"
#include "validation/key.h"
#include "validation/run_view.h"

#include <gsl/gsl_cdf.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_RECORD_BYTES = 1 << 20, MAX_PARTS = 256 };

struct tally { /* one part of the cost */
    const char *part;
    size_t runs;
    double *old_s, *new_s;
};

struct reader {
    struct compare_runs *out;
    struct arena *arena;
    const char *old, *new; /* folders */
    size_t room;           /* of each tally: number of runs */
    size_t tally_count;
    struct tally *tally; /* tally[0 .. MAX_PARTS-1] */
    struct fault *fault;
};

static enum status no_memory(struct reader *r) {
    return fault_set(r->fault, STATUS_NO_MEMORY, "compare: out of memory");
}

/* -- bits ------------------------------------------------------------------------- */

/* The run file of NAME = ID-sSEED is NAME.yaml where it has a start, else ID.yaml. */
static const char *run_file(struct reader *r, const char *folder, const char *name) {
    const char *path = arena_text(r->arena, "%s/runs/%s.yaml", folder, name);
    const char *seed = strrchr(name, '-');
    if (path == NULL || file_exists(path) || seed == NULL)
        return path;
    return arena_text(r->arena, "%s/runs/%.*s.yaml", folder, (int)(seed - name), name);
}

static const char *result_file(struct reader *r, const char *folder, const char *name,
                               const char *end) {
    return arena_text(r->arena, "%s/h5/%s%s", folder, name, end);
}

/* Largest difference of two samples in parts of their largest number; 0: equal bits. */
static double difference(const double *a, const double *b, size_t count) {
    double largest = 0, scale = 0;
    if (memcmp(a, b, count * sizeof *a) == 0)
        return 0;
    for (size_t i = 0; i < count; i++) {
        largest = fmax(largest, fabs(a[i] - b[i]));
        scale = fmax(scale, fmax(fabs(a[i]), fabs(b[i])));
    }
    return scale > 0 ? largest / scale : 0; /* +0 and -0 are one number */
}

static void note_sample(struct compare_sample *s, double time, double step, double size,
                        const char *dataset) {
    if (size == 0 || (s->found && s->time <= time))
        return;
    *s = (struct compare_sample){true, time, step, size, dataset};
}

static void note_difference(struct compare_run *run, double time, double step, double size,
                            const char *dataset) {
    note_sample(&run->first, time, step, size, dataset);
    if (size >= COMPARE_RUNS_PARTED)
        note_sample(&run->parted, time, step, size, dataset);
}

/* Two series of one name; false when they have not the same shape and times. */
static bool compare_series(const struct series *a, const struct series *b, const char *dataset,
                           struct compare_run *run) {
    if (a->frames != b->frames || a->size != b->size ||
        memcmp(a->time, b->time, a->frames * sizeof *a->time) != 0)
        return false;
    for (size_t f = 0; f < a->frames; f++)
        note_difference(run, a->time[f], a->step[f],
                        difference(a->value + f * a->size, b->value + f * a->size, a->size),
                        dataset);
    return true;
}

static enum status compare_dataset(struct run_view *a, struct run_view *b, const char *dataset,
                                   struct compare_run *run, struct fault *why) {
    const struct series *sa, *sb;
    const double *va, *vb;
    size_t ca, cb;
    struct fault not_a_series = FAULT_NONE;
    bool same_shape;
    if (run_view_series(a, dataset, &sa, &not_a_series) == STATUS_OK) {
        if (run_view_series(b, dataset, &sb, why) != STATUS_OK)
            return why->status;
        same_shape = compare_series(sa, sb, dataset, run);
    } else {
        if (run_view_array(a, dataset, &va, &ca, why) != STATUS_OK ||
            run_view_array(b, dataset, &vb, &cb, why) != STATUS_OK)
            return why->status;
        same_shape = ca == cb;
        if (same_shape)
            note_difference(run, 0, NAN, difference(va, vb, ca), dataset);
    }
    return same_shape ? STATUS_OK
                      : fault_set(why, STATUS_BAD_INPUT, "%s: other shapes or times", dataset);
}

/* All datasets that the run asks for, sorted into run; a fault says what could not be read. */
static enum status compare_results_of(struct reader *r, struct compare_run *run,
                                      struct fault *why) {
    const char *file[2] = {run_file(r, r->old, run->name), run_file(r, r->new, run->name)};
    const char *result[2] = {result_file(r, r->old, run->name, ".h5"),
                             result_file(r, r->new, run->name, ".h5")};
    struct run_view *view[2] = {NULL, NULL};
    struct runfile asked = {0};
    enum status status = STATUS_OK;
    if (file[0] == NULL || file[1] == NULL || result[0] == NULL || result[1] == NULL)
        return fault_set(why, STATUS_NO_MEMORY, "out of memory");
    status = runfile_load(file[0], &asked, why);
    for (int i = 0; i < 2 && status == STATUS_OK; i++)
        status = run_view_open(file[i], result[i], &view[i], why);
    for (size_t i = 0; i < asked.dataset_count && status == STATUS_OK; i++) {
        const char *dataset = arena_copy(r->arena, asked.datasets[i]);
        status = dataset == NULL ? fault_set(why, STATUS_NO_MEMORY, "out of memory")
                                 : compare_dataset(view[0], view[1], dataset, run, why);
    }
    run_view_close(view[0]);
    run_view_close(view[1]);
    runfile_free(&asked);
    return status;
}

static enum status compare_bits_of(struct reader *r, struct compare_run *run) {
    struct fault why = FAULT_NONE;
    enum status status = compare_results_of(r, run, &why);
    if (status == STATUS_NO_MEMORY)
        return no_memory(r);
    if (status != STATUS_OK) {
        run->bits = BITS_UNKNOWN;
        run->why = arena_copy(r->arena, why.text);
        return run->why == NULL ? no_memory(r) : STATUS_OK;
    }
    run->bits = run->first.found ? BITS_DIFFER : BITS_EQUAL;
    return STATUS_OK;
}

/* -- costs ------------------------------------------------------------------------ */

static struct tally *find_tally(struct reader *r, const char *part) {
    for (size_t i = 0; i < r->tally_count; i++) {
        if (strcmp(r->tally[i].part, part) == 0)
            return &r->tally[i];
    }
    if (r->tally_count == MAX_PARTS)
        return NULL;
    struct tally *t = &r->tally[r->tally_count];
    t->part = arena_copy(r->arena, part);
    t->old_s = arena_take(r->arena, r->room, sizeof *t->old_s);
    t->new_s = arena_take(r->arena, r->room, sizeof *t->new_s);
    if (t->part == NULL || t->old_s == NULL || t->new_s == NULL)
        return NULL;
    r->tally_count++;
    return t;
}

static void add_cost(struct reader *r, const char *part, double old_s, double new_s) {
    struct tally *t = part == NULL ? NULL : find_tally(r, part);
    if (t == NULL || !(old_s >= 0) || !(new_s >= 0))
        return;
    t->old_s[t->runs] = old_s;
    t->new_s[t->runs++] = new_s;
}

static double seconds_of(const struct yaml_node *map, const char *key) {
    struct fault none = FAULT_NONE;
    double value = NAN;
    const struct yaml_node *n = map == NULL || map->kind != YAML_MAP ? NULL : yaml_get(map, key);
    if (n != NULL && n->kind == YAML_SCALAR && !n->quoted)
        yaml_real(n, &value, &none);
    return value;
}

/* The solver's own record: seconds of the whole, and of each part whose name ends in _s. */
static void add_records(struct reader *r, const char *model, const struct yaml_node *a,
                        const struct yaml_node *b) {
    const struct yaml_node *cost = a->kind == YAML_MAP ? yaml_get(a, "cost") : NULL;
    const struct yaml_node *other = b->kind == YAML_MAP ? yaml_get(b, "cost") : NULL;
    add_cost(r, "processor time, all parts", seconds_of(a, "cpu_s"), seconds_of(b, "cpu_s"));
    for (size_t i = 0; cost != NULL && cost->kind == YAML_MAP && i < cost->count; i++) {
        const char *key = cost->child[i].key;
        size_t length = strlen(key);
        if (length > 2 && strcmp(key + length - 2, "_s") == 0)
            add_cost(r, arena_text(r->arena, "%s: %.*s", model, (int)length - 2, key),
                     seconds_of(cost, key), seconds_of(other, key));
    }
}

static void add_wall(struct reader *r, const char *name) {
    struct key_record key[2];
    struct fault none = FAULT_NONE;
    const char *path[2] = {result_file(r, r->old, name, ".key"),
                           result_file(r, r->new, name, ".key")};
    if (path[0] != NULL && path[1] != NULL && key_read(path[0], &key[0], &none) == STATUS_OK &&
        key_read(path[1], &key[1], &none) == STATUS_OK)
        add_cost(r, "wall-clock time", key[0].seconds, key[1].seconds);
}

/* A solver need not tell its cost: what is missing is left out. */
static void add_costs(struct reader *r, const char *name) {
    struct fault none = FAULT_NONE;
    struct yaml_document *a = NULL, *b = NULL;
    const char *path[2] = {result_file(r, r->old, name, ".run.json"),
                           result_file(r, r->new, name, ".run.json")};
    const char *model =
        arena_text(r->arena, "%.*s", (int)strcspn(name, "."), name); /* the case's folder */
    if (path[0] == NULL || path[1] == NULL || model == NULL)
        return;
    if (yaml_load(path[0], MAX_RECORD_BYTES, &a, &none) == STATUS_OK &&
        yaml_load(path[1], MAX_RECORD_BYTES, &b, &none) == STATUS_OK)
        add_records(r, model, yaml_root(a), yaml_root(b));
    yaml_free(a);
    yaml_free(b);
    add_wall(r, name);
}

static struct compare_cost estimate(const struct tally *t, double level) {
    struct compare_cost c = {.part = t->part, .runs = t->runs};
    double n = (double)t->runs, squares = 0;
    for (size_t i = 0; i < t->runs; i++) {
        c.old_s += t->old_s[i];
        c.new_s += t->new_s[i];
    }
    c.ratio = c.old_s > 0 ? c.new_s / c.old_s : NAN;
    for (size_t i = 0; i < t->runs; i++) {
        double d = t->new_s[i] - c.ratio * t->old_s[i];
        squares += d * d;
    }
    c.uncertainty = t->runs < 2 ? NAN : sqrt(n / (n - 1) * squares) / c.old_s;
    c.t_limit = t->runs < 2 ? INFINITY : gsl_cdf_tdist_Qinv(level / 2, n - 1);
    return c;
}

static enum status finish_costs(struct reader *r, double level) {
    struct compare_runs *out = r->out;
    out->cost = arena_take(r->arena, r->tally_count, sizeof *out->cost);
    if (out->cost == NULL)
        return no_memory(r);
    for (size_t i = 0; i < r->tally_count; i++) {
        struct compare_cost c = estimate(&r->tally[i], level / (double)r->tally_count);
        if (isfinite(c.ratio))
            out->cost[out->cost_count++] = c;
    }
    return STATUS_OK;
}

/* -- all runs --------------------------------------------------------------------- */

static bool has_run(const struct results *r, const char *name) {
    for (size_t i = 0; i < r->row_count; i++) {
        for (size_t k = 0; k < r->row[i].run_count; k++) {
            if (strcmp(r->row[i].run[k], name) == 0)
                return true;
        }
    }
    return false;
}

static bool is_known(const struct compare_runs *c, const char *name) {
    for (size_t i = 0; i < c->run_count; i++) {
        if (strcmp(c->run[i].name, name) == 0)
            return true;
    }
    return false;
}

/* Each run once, in the order of the old folder's rows. */
static enum status list_runs(struct reader *r, const struct results *old,
                             const struct results *new) {
    struct compare_runs *c = r->out;
    for (size_t i = 0; i < old->row_count; i++) {
        const struct results_row *row = &old->row[i];
        for (size_t k = 0; k < row->run_count; k++) {
            if (is_known(c, row->run[k]) || !has_run(new, row->run[k]))
                continue;
            c->run = arena_grow(r->arena, c->run, c->run_count, sizeof *c->run);
            if (c->run == NULL)
                return no_memory(r);
            c->run[c->run_count++] =
                (struct compare_run){.name = row->run[k], .case_name = row->case_name};
        }
    }
    return STATUS_OK;
}

enum status compare_runs_read(const struct results *old, const struct results *new, double level,
                              struct compare_runs **out, struct fault *fault) {
    struct compare_runs *c = calloc(1, sizeof *c);
    *out = NULL;
    if (c == NULL)
        return fault_set(fault, STATUS_NO_MEMORY, "compare: out of memory");
    struct reader r = {.out = c,
                       .arena = &c->arena,
                       .old = old->folder,
                       .new = new->folder,
                       .tally = arena_take(&c->arena, MAX_PARTS, sizeof *r.tally),
                       .fault = fault};
    enum status status = r.tally == NULL ? no_memory(&r) : list_runs(&r, old, new);
    r.room = c->run_count;
    for (size_t i = 0; status == STATUS_OK && i < c->run_count; i++) {
        status = compare_bits_of(&r, &c->run[i]);
        c->count[c->run[i].bits]++;
        add_costs(&r, c->run[i].name);
    }
    if (status == STATUS_OK)
        status = finish_costs(&r, level);
    if (status != STATUS_OK)
        compare_runs_free(c);
    else
        *out = c;
    return status;
}

void compare_runs_free(struct compare_runs *c) {
    if (c == NULL)
        return;
    arena_free(&c->arena);
    free(c);
}
