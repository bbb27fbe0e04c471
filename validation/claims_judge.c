#include "validation/claims_judge.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

struct court {
    const struct claims_input *in;
    struct arena *arena;
    struct fault *fault;
};

static enum status no_memory(struct court *k) {
    return fault_set(k->fault, STATUS_NO_MEMORY, "claims: out of memory");
}

/* -- one test ------------------------------------------------------------------------- */

/* The first point of the group that a row of a fit over a sweep is of, or NULL. */
static const struct plan_point *group_of(struct court *k, const struct assemble_case *c,
                                         const struct case_check *check, const char *name) {
    const struct case_across *a = &c->plan->file->across[check->number.index];
    const struct case_tier *t = c->plan->tier;
    for (size_t i = 0; i < c->plan->point_count; i++) {
        const struct plan_point *p = &c->plan->point[i];
        const char *text = case_point_text(k->arena, t, p->parameter, p->parameter_count,
                                           case_axis_of(t, a->along));
        if (text == NULL)
            no_memory(k);
        else if (strcmp(text, name) == 0 &&
                 case_filter_takes(&a->points, p->parameter, p->parameter_count))
            return p;
    }
    return NULL;
}

static bool takes_row(struct court *k, const struct claim_test *t, const struct assemble_case *c,
                      size_t i) {
    const struct case_check *check = c->rows->check[i];
    if (check == NULL || strcmp(check->name, t->check) != 0)
        return false;
    const struct plan_point *p = c->rows->point[i] != NULL
                                     ? c->rows->point[i]->point
                                     : group_of(k, c, check, c->rows->row[i].point);
    return p != NULL && case_filter_takes(&t->points, p->parameter, p->parameter_count);
}

static enum claim_result result_of(const struct claim_test *t, const struct report_case *c,
                                   const size_t *row, size_t count) {
    bool open = false;
    for (size_t i = 0; i < count; i++) {
        enum verdict v = c->row[row[i]].verdict;
        open |= v == VERDICT_INCONCLUSIVE;
        if (v != VERDICT_INCONCLUSIVE && (v == VERDICT_PASS) != t->wants_pass)
            return CLAIM_CONTRARY;
    }
    return count == 0 ? CLAIM_MISSING : open ? CLAIM_OPEN : CLAIM_AS_SAID;
}

static const char *points_text(struct court *k, const struct claim_test *t) {
    const char *text = "";
    for (size_t i = 0; i < t->points.count && text != NULL; i++) {
        const struct yaml_node *n = &t->points.map->child[i];
        text = arena_text(k->arena, "%s%s%s", text, i == 0 ? "" : ", ", n->key);
        for (size_t v = 0; v < (n->kind == YAML_LIST ? n->count : 1) && text != NULL; v++)
            text = arena_text(k->arena, "%s %s", text,
                              n->kind == YAML_LIST ? n->child[v].text : n->text);
    }
    return text;
}

static const struct assemble_case *case_of(struct court *k, const char *name, size_t *index) {
    for (*index = 0; *index < k->in->case_count; ++*index) {
        if (strcmp(k->in->cases[*index].plan->file->name, name) == 0)
            return &k->in->cases[*index];
    }
    return NULL;
}

static const char *why_missing(struct court *k, const struct claim_test *t,
                               const struct assemble_case *c) {
    if (c != NULL && c->rows == NULL)
        return c->plan->skip_reason != NULL ? c->plan->skip_reason : "not run";
    if (!t->in_tier[k->in->tier])
        return arena_text(k->arena, "not in tier %s", case_tier_name(k->in->tier));
    return c == NULL ? "case not selected" : "no such row";
}

static enum status judge_test(struct court *k, const struct claim_test *t,
                              struct report_claim_test *out) {
    size_t index, count = 0, *row = NULL;
    const struct assemble_case *c = case_of(k, t->case_name, &index);
    *out = (struct report_claim_test){.case_name = t->case_name,
                                      .check = t->check,
                                      .points = points_text(k, t),
                                      .wants_pass = t->wants_pass,
                                      .result = CLAIM_MISSING};
    if (c != NULL && c->rows != NULL) {
        row = arena_take(k->arena, c->rows->count, sizeof *row);
        for (size_t i = 0; row != NULL && i < c->rows->count; i++) {
            if (takes_row(k, t, c, i))
                row[count++] = i;
        }
        if (row == NULL)
            return no_memory(k);
        out->in = &k->in->report[index];
        out->result = result_of(t, out->in, row, count);
    }
    out->row = row;
    out->row_count = count;
    if (out->result == CLAIM_MISSING)
        out->missing = why_missing(k, t, c);
    return out->points == NULL || (out->result == CLAIM_MISSING && out->missing == NULL)
               ? no_memory(k)
               : k->fault->status;
}

/* -- one claim ------------------------------------------------------------------------ */

static const char *reason_of(struct court *k, const struct report_claim_test *t) {
    static const char *const word[] = {
        [CLAIM_CONTRARY] = "comes out the other way", [CLAIM_OPEN] = "is inconclusive"};
    if (t == NULL)
        return "all of its tests come out as they should";
    if (t->result == CLAIM_MISSING)
        return arena_text(k->arena, "%s, %s: %s", t->case_name, t->check, t->missing);
    bool all = *t->points == '\0';
    return arena_text(k->arena, "%s, %s%s%s%s, %s", t->case_name, t->check, all ? "" : " [",
                      t->points, all ? "" : "]", word[t->result]);
}

static const struct report_claim_test *first_of(const struct report_claim *c, enum claim_result r) {
    for (size_t i = 0; i < c->test_count; i++) {
        if (c->test[i].result == r)
            return &c->test[i];
    }
    return NULL;
}

static enum status decide(struct court *k, const struct claim *c, struct report_claim *out) {
    static const enum claim_result order[] = {CLAIM_CONTRARY, CLAIM_MISSING, CLAIM_OPEN};
    static const enum claim_verdict verdict[] = {CLAIM_NOT_TESTED, CLAIM_NOT_TESTED,
                                                 CLAIM_UNDECIDED};
    if (c->test_count == 0) {
        out->verdict = c->verdict;
        out->reason = c->untested;
        return STATUS_OK;
    }
    out->verdict = c->verdict;
    const struct report_claim_test *t = NULL;
    for (size_t i = 0; t == NULL && i < 3; i++) {
        t = first_of(out, order[i]);
        if (t != NULL)
            out->verdict = order[i] == CLAIM_CONTRARY ? c->otherwise : verdict[i];
    }
    out->is_tested = t == NULL || t->result != CLAIM_MISSING;
    out->reason = reason_of(k, t);
    return out->reason == NULL ? no_memory(k) : STATUS_OK;
}

static enum status judge_claim(struct court *k, const struct claim *c, struct report_claim *out) {
    const struct claim_stored *stored = claims_stored_find(k->in->stored, c->id, k->in->tier);
    struct report_claim_test *test = arena_take(k->arena, c->test_count, sizeof *test);
    enum status status = test == NULL ? no_memory(k) : STATUS_OK;
    *out =
        (struct report_claim){.id = c->id,
                              .paper = c->paper,
                              .where = c->where,
                              .says = c->says,
                              .reading = c->reading,
                              .because = c->because,
                              .proof = c->proof,
                              .stored = stored == NULL ? NULL : claim_verdict_name(stored->verdict),
                              .test = test,
                              .test_count = c->test_count};
    for (size_t i = 0; status == STATUS_OK && i < c->test_count; i++)
        status = judge_test(k, &c->test[i], &test[i]);
    return status == STATUS_OK ? decide(k, c, out) : status;
}

/* -- rows of stored verdicts -------------------------------------------------------------- */

static bool was_run(const struct report_claim *c) {
    for (size_t i = 0; i < c->test_count; i++) {
        if (c->test[i].in == NULL)
            return false;
    }
    return c->test_count > 0;
}

static enum status add_row(struct court *k, const struct report_claim *c, const char *date) {
    struct report_case *in = NULL;
    for (size_t i = 0; in == NULL && i < k->in->case_count; i++)
        in = c->test[0].in == &k->in->report[i] ? &k->in->report[i] : NULL;
    struct report_row *row = arena_take(k->arena, in->row_count + 1, sizeof *row);
    const char *now = claim_verdict_name(c->verdict);
    bool same = strcmp(now, c->stored) == 0, open = c->verdict == CLAIM_UNDECIDED;
    if (row == NULL)
        return no_memory(k);
    memcpy(row, in->row, in->row_count * sizeof *row);
    row[in->row_count] = (struct report_row){
        .case_name = in->name,
        .point = "",
        .check = arena_text(k->arena, "claim %s", c->id),
        .observable = "verdict is the stored one",
        .unit = "1",
        .measured = open ? NAN : same, /* 1: as it was */
        .expected = 1,
        .uncertainty = open ? NAN : 0,
        .comparison = "within",
        .kind = "claim",
        .verdict = same   ? VERDICT_PASS
                   : open ? VERDICT_INCONCLUSIVE
                          : VERDICT_FAIL,
        .because = "a verdict about what a paper says stays until somebody says why it changes",
        .reason = arena_text(k->arena, same ? "%s, as on %s" : "%s, but %s on %s: %s", now,
                             same ? date : c->stored, date, c->reason),
        .repeat = arena_text(k->arena, "bedcheck run %s --tier %s", in->name,
                             case_tier_name(k->in->tier)),
        .freedom = INFINITY,
        .detectable = NAN,
        .alarm_rate = NAN};
    const struct report_row *added = &row[in->row_count];
    if (added->check == NULL || added->reason == NULL || added->repeat == NULL)
        return no_memory(k);
    in->row = row;
    in->row_count++;
    return STATUS_OK;
}

enum status claims_judge(const struct claims_input *in, struct arena *a, struct report_ledger *out,
                         struct fault *fault) {
    struct court k = {in, a, fault};
    struct report_claim *claim = arena_take(a, in->claims->count, sizeof *claim);
    enum status status = claim == NULL ? no_memory(&k) : STATUS_OK;
    for (size_t i = 0; status == STATUS_OK && i < in->claims->count; i++)
        status = judge_claim(&k, &in->claims->claim[i], &claim[i]);
    for (size_t i = 0; status == STATUS_OK && i < in->claims->count; i++) {
        const struct claim_stored *stored = claims_stored_find(in->stored, claim[i].id, in->tier);
        if (stored != NULL && was_run(&claim[i]))
            status = add_row(&k, &claim[i], stored->date);
    }
    *out = (struct report_ledger){status == STATUS_OK ? in->claims->count : 0, claim};
    return status;
}
