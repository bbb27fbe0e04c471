#include "validation/accept.h"

#include "validation/accept_files.h"
#include "validation/bits.h"
#include "validation/scatter.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

struct clerk {
    const struct accept_source *source;
    const struct measured_case *m;
    struct accept_case *out;
    struct fault *fault;
};

static enum status no_memory(struct fault *fault) {
    return fault_set(fault, STATUS_NO_MEMORY, "accept: out of memory");
}

/* -- old and new lines ----------------------------------------------------------------- */

static bool same_key(const struct reference *a, const struct reference *b) {
    return a->tier == b->tier && a->origin == b->origin && strcmp(a->point, b->point) == 0 &&
           strcmp(a->observable, b->observable) == 0 &&
           (a->build == NULL || b->build == NULL || strcmp(a->build, b->build) == 0);
}

static bool same_number(double a, double b) {
    return (isnan(a) && isnan(b)) || memcmp(&a, &b, sizeof a) == 0;
}

static bool same_content(const struct reference *a, const struct reference *b) {
    return same_number(a->value, b->value) && same_number(a->deviation, b->deviation) &&
           a->seeds == b->seeds && strcmp(a->meaning, b->meaning) == 0 &&
           (a->digest == NULL || b->digest == NULL || strcmp(a->digest, b->digest) == 0);
}

static const struct reference *find_line(const struct reference *item, size_t count,
                                         const struct reference *wanted) {
    for (size_t i = 0; i < count; i++) {
        if (same_key(&item[i], wanted))
            return &item[i];
    }
    return NULL;
}

static enum status keep(struct clerk *k, const struct reference *line) {
    struct accept_case *out = k->out;
    struct reference *wider = arena_grow(&out->arena, out->item, out->count, sizeof *wider);
    if (wider == NULL)
        return no_memory(k->fault);
    out->item = wider;
    out->item[out->count++] = *line;
    return STATUS_OK;
}

static enum status add_change(struct clerk *k, const struct reference *old,
                              const struct reference *new) {
    struct accept_case *out = k->out;
    struct accept_change *wider =
        arena_grow(&out->arena, out->change, out->change_count, sizeof *wider);
    struct reference *kept = arena_take(&out->arena, 1, sizeof *kept);
    if (wider == NULL || kept == NULL)
        return no_memory(k->fault);
    if (new != NULL)
        *kept = *new; /* item[] moves while it grows */
    out->change = wider;
    out->change[out->change_count++] = (struct accept_change){old, new == NULL ? NULL : kept};
    return STATUS_OK;
}

/* A line as the runs give it; the old one stays where nothing changed. */
static enum status add_line(struct clerk *k, struct reference *line) {
    const struct references *before = k->out->old;
    if (find_line(k->out->item, k->out->count, line) != NULL)
        return STATUS_OK; /* two checks of one observable */
    const struct reference *old = find_line(before->item, before->count, line);
    if (old != NULL && same_content(old, line))
        return keep(k, old);
    line->commit = k->source->history.commit;
    line->solver_key = k->source->history.solver_key;
    line->date = k->source->history.date;
    line->reason = k->source->history.reason;
    enum status status = keep(k, line);
    return status == STATUS_OK ? add_change(k, old, line) : status;
}

/* -- ensembles ------------------------------------------------------------------------- */

static enum status omit(struct clerk *k, const struct scatter *s) {
    struct accept_case *out = k->out;
    const char **wider = arena_grow(&out->arena, out->omission, out->omission_count, sizeof *wider);
    const char *text =
        arena_text(&out->arena, "%s [%s]: %s", s->check->name, s->key.point, s->missing);
    if (wider == NULL || text == NULL)
        return no_memory(k->fault);
    out->omission = wider;
    out->omission[out->omission_count++] = text;
    return STATUS_OK;
}

static enum status add_ensemble(struct clerk *k, const struct scatter *s) {
    const char *name = k->m->plan->file->name;
    if (s->missing != NULL && s->check->kind == KIND_REGRESSION)
        return fault_add(k->fault, STATUS_BAD_INPUT, "%s: %s [%s]: no ensemble: %s", name,
                         s->check->name, s->key.point, s->missing);
    if (s->missing != NULL)
        return omit(k, s);
    struct reference line = {.tier = s->key.tier,
                             .origin = ORIGIN_ENSEMBLE,
                             .point = s->key.point,
                             .observable = s->key.observable,
                             .value = s->mean,
                             .deviation = s->deviation,
                             .seeds = s->count,
                             .meaning = s->key.meaning};
    return add_line(k, &line);
}

static enum status add_ensembles(struct clerk *k) {
    struct scatter *list;
    size_t count, poor = 0;
    enum status status = scatter_measure(k->m, &k->out->arena, &list, &count, k->fault);
    for (size_t i = 0; status == STATUS_OK && i < count; i++)
        poor += list[i].count < REFERENCE_MIN_SEEDS;
    if (poor > 0)
        return fault_add(k->fault, STATUS_BAD_INPUT,
                         "%s: %zu of %zu rows have %zu seeds or fewer, an ensemble needs %d: "
                         "`bedcheck calibrate %s --seeds K` makes them",
                         k->m->plan->file->name, poor, count, list[0].count,
                         (int)REFERENCE_MIN_SEEDS, k->m->plan->file->name);
    for (size_t i = 0; status != STATUS_NO_MEMORY && i < count; i++)
        status = add_ensemble(k, &list[i]);
    return k->fault->status;
}

/* -- pairs ----------------------------------------------------------------------------- */

/* Is the seed one that the case's text asks for at that point? */
static bool is_own_seed(const struct clerk *k, const struct plan_point *p, long long seed) {
    const struct case_seeds *own = k->source->own;
    long long count = (long long)case_seed_count(own, p->parameter, p->parameter_count);
    return seed >= own->first && seed < own->first + count;
}

/* The value of each of the case's own seeds. */
static enum status add_pair(struct clerk *k, size_t check, size_t point) {
    const struct measured_point *p = &k->m->point[point];
    const struct case_check *c = &k->m->plan->tier->check[check];
    struct reference_key key;
    enum status status =
        reference_key_make(k->m->plan, check, point, &k->out->arena, &key, k->fault);
    for (size_t i = 0; status == STATUS_OK && i < p->run_count; i++) {
        const struct measured_run *r = &p->run[i];
        if (!is_own_seed(k, p->point, r->run->seed))
            continue;
        double value = r->usable ? r->sample[check].measured : NAN;
        if (!isfinite(value))
            return fault_add(k->fault, STATUS_BAD_INPUT, "%s: %s [%s]: seed %lld has no value",
                             k->m->plan->file->name, c->name, key.point, r->run->seed);
        struct reference line = {
            .tier = key.tier,
            .origin = ORIGIN_SEED,
            .point = key.point,
            .observable = arena_text(&k->out->arena, "%s@%lld", key.observable, r->run->seed),
            .value = value,
            .deviation = NAN,
            .seeds = 1,
            .meaning = key.meaning};
        status = line.observable == NULL ? no_memory(k->fault) : add_line(k, &line);
    }
    return status;
}

static enum status add_pairs(struct clerk *k) {
    enum status status = STATUS_OK;
    for (size_t c = 0; status == STATUS_OK && c < k->m->plan->tier->check_count; c++) {
        for (size_t p = 0; status == STATUS_OK && p < k->m->point_count; p++) {
            if (k->m->plan->tier->check[c].paired && reference_has_row(k->m->plan, c, p))
                status = add_pair(k, c, p);
        }
    }
    return status;
}

/* -- bits ------------------------------------------------------------------------------ */

static const char *point_name(const struct measured_point *p) {
    return strcmp(p->point->name, "single") == 0 ? "-" : p->point->name;
}

static enum status add_bits_of(struct clerk *k, const struct measured_point *p,
                               const struct measured_run *r) {
    const struct case_file *c = case_runs(k->m->plan->file);
    struct arena *a = &k->out->arena;
    struct bits_build build;
    struct digest d;
    const char *record = folder_run_record(k->source->results, a, r->run);
    enum status status =
        record == NULL ? no_memory(k->fault) : bits_read_build(record, &build, k->fault);
    if (status == STATUS_OK)
        status = bits_of_result(r->result_path, c->dataset, c->dataset_count, &d, k->fault);
    if (status != STATUS_OK)
        return status;
    struct reference line = {.tier = TIER_SMOKE,
                             .origin = ORIGIN_BITS,
                             .point = point_name(p),
                             .observable = arena_text(a, "bits@%lld", r->run->seed),
                             .value = NAN,
                             .deviation = NAN,
                             .digest = arena_copy(a, d.hex),
                             .build = arena_copy(a, build.name),
                             .seeds = 1,
                             .meaning = reference_run_meaning(r->run)};
    return line.observable == NULL || line.digest == NULL || line.build == NULL
               ? no_memory(k->fault)
               : add_line(k, &line);
}

static enum status add_bits(struct clerk *k) {
    enum status status = STATUS_OK;
    for (size_t p = 0; status == STATUS_OK && p < k->m->point_count; p++) {
        const struct measured_point *point = &k->m->point[p];
        for (size_t i = 0; status == STATUS_OK && i < point->run_count; i++) {
            const struct measured_run *r = &point->run[i];
            if (r->usable && is_own_seed(k, point->point, r->run->seed))
                status = add_bits_of(k, point, r);
        }
    }
    return status;
}

/* -- lines that stay, lines that go ------------------------------------------------------- */

/* Did the bits of this run and of some class of build change? */
static bool bits_changed(const struct accept_case *c, const struct reference *line) {
    for (size_t i = 0; i < c->change_count; i++) {
        const struct accept_change *change = &c->change[i];
        if (change->old != NULL && change->new != NULL &&
            change->old->origin == ORIGIN_BITS &&strcmp(change->old->point, line->point) == 0 &&
            strcmp(change->old->observable, line->observable) == 0)
            return true;
    }
    return false;
}

/* Bits of another class of build, of a run whose bits are as they were here. */
static bool is_other_build(const struct accept_case *c, const struct reference *line) {
    for (size_t i = 0; line->origin == ORIGIN_BITS && i < c->count; i++) {
        const struct reference *now = &c->item[i];
        if (now->origin == ORIGIN_BITS && strcmp(now->point, line->point) == 0 &&
            strcmp(now->observable, line->observable) == 0 &&
            strcmp(now->meaning, line->meaning) == 0)
            return !bits_changed(c, line);
    }
    return false;
}

static enum status settle_old(struct clerk *k) {
    const struct references *old = k->out->old;
    enum tier tier = (enum tier)(k->m->plan->tier - k->m->plan->file->tier);
    enum status status = STATUS_OK;
    size_t fresh = k->out->count;
    for (size_t i = 0; status == STATUS_OK && i < old->count; i++) {
        const struct reference *line = &old->item[i];
        if (find_line(k->out->item, fresh, line) != NULL)
            continue;
        bool stays =
            line->tier != tier || strcmp(line->meaning, "-") == 0 || is_other_build(k->out, line);
        status = stays ? keep(k, line) : add_change(k, line, NULL);
    }
    return status;
}

enum status accept_gather(const struct accept_source *source, struct accept_case *out,
                          struct fault *fault) {
    const struct measured_case *m = source->measured;
    struct fault found = FAULT_NONE;
    struct clerk k = {source, m, out, &found};
    *out = (struct accept_case){.plan = m->plan};
    enum status status =
        reference_load(source->references_folder, m->plan->file->name, &out->old, &found);
    if (status == STATUS_OK)
        status = add_ensembles(&k);
    if (status == STATUS_OK)
        status = add_pairs(&k);
    if (status == STATUS_OK && m->plan->tier == &m->plan->file->tier[TIER_SMOKE])
        status = add_bits(&k);
    if (status == STATUS_OK)
        status = settle_old(&k);
    if (status != STATUS_OK)
        *fault = found;
    return status;
}

void accept_free(struct accept_case *c) {
    reference_free(c->old);
    arena_free(&c->arena);
    *c = (struct accept_case){0};
}

double accept_difference(const struct accept_change *change) {
    const struct reference *a = change->old, *b = change->new;
    if (a == NULL || b == NULL || a->seeds == 0 || b->seeds == 0)
        return NAN;
    return (b->value - a->value) /
           hypot(a->deviation / sqrt((double)a->seeds), b->deviation / sqrt((double)b->seeds));
}

/* -- writing ------------------------------------------------------------------------------ */

struct pages { /* texts of all files */
    struct arena arena;
    struct accept_file *file; /* file[0 .. count-1] */
    char **text;              /* free() each */
    size_t count;
};

static enum status add_table(const char *folder, const struct accept_case *c, struct pages *p,
                             struct fault *fault) {
    struct accept_file *f = &p->file[p->count];
    f->path = arena_text(&p->arena, "%s/%s.tsv", folder, c->plan->file->name);
    if (f->path == NULL)
        return no_memory(fault);
    enum status status = reference_text(f->path, c->item, c->count, &p->text[p->count], fault);
    if (status == STATUS_OK)
        f->text = p->text[p->count++];
    return status;
}

static enum status add_claims(const struct accept_claims *claims, struct pages *p,
                              struct fault *fault) {
    enum status status =
        claims_stored_text(claims->stored, claims->claims, &p->text[p->count], fault);
    if (status != STATUS_OK)
        return status;
    p->file[p->count] = (struct accept_file){claims->stored->path, p->text[p->count]};
    p->count++;
    return STATUS_OK;
}

enum status accept_write(const char *references_folder, const struct accept_case *list,
                         size_t count, const struct accept_claims *claims, struct fault *fault) {
    struct pages p = {0};
    p.file = arena_take(&p.arena, count + 1, sizeof *p.file);
    p.text = arena_take(&p.arena, count + 1, sizeof *p.text);
    enum status status = p.file == NULL || p.text == NULL ? no_memory(fault) : STATUS_OK;
    for (size_t i = 0; status == STATUS_OK && i < count; i++) {
        if (list[i].change_count > 0)
            status = add_table(references_folder, &list[i], &p, fault);
    }
    if (status == STATUS_OK && claims != NULL && claims->change_count > 0)
        status = add_claims(claims, &p, fault);
    if (status == STATUS_OK)
        status = accept_files_write(p.file, p.count, fault);
    for (size_t i = 0; i < p.count; i++)
        free(p.text[i]);
    arena_free(&p.arena);
    return status;
}
