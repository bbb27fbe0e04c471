#include "validation/accept_claims.h"

#include <string.h>

struct clerk {
    const struct accept_claims_source *source;
    struct accept_claims *out;
    struct fault *fault;
};

static enum status no_memory(struct fault *fault) {
    return fault_set(fault, STATUS_NO_MEMORY, "accept: out of memory");
}

/* -- which claims --------------------------------------------------------------------- */

static bool is_ready(const struct accept_claims_source *s, const char *case_name) {
    for (size_t i = 0; i < s->case_count; i++) {
        if (strcmp(s->cases[i].plan->file->name, case_name) == 0)
            return s->chosen[i] && s->cases[i].rows != NULL;
    }
    return false;
}

static bool takes_part(const struct accept_claims_source *s, const struct claim *c) {
    for (size_t i = 0; i < c->test_count; i++) {
        if (!is_ready(s, c->test[i].case_name))
            return false;
    }
    return c->test_count > 0;
}

bool accept_claims_rest_on(const struct accept_claims *c, const struct accept_claims_source *source,
                           size_t i) {
    const char *name = source->cases[i].plan->file->name;
    for (size_t k = 0; k < c->claims->count; k++) {
        const struct claim *one = &c->claims->claim[k];
        for (size_t t = 0; t < one->test_count; t++) {
            if (strcmp(one->test[t].case_name, name) == 0 && takes_part(source, one))
                return true;
        }
    }
    return false;
}

/* -- one claim ------------------------------------------------------------------------ */

static enum status note(struct clerk *k, struct accept_verdict **list, size_t *count,
                        const struct accept_verdict *one) {
    struct accept_verdict *wider = arena_grow(&k->out->arena, *list, *count, sizeof *wider);
    if (wider == NULL)
        return no_memory(k->fault);
    wider[(*count)++] = *one;
    *list = wider;
    return STATUS_OK;
}

static enum status change_to(struct clerk *k, const struct report_claim *now,
                             const struct accept_verdict *v) {
    const struct accept_claims_source *s = k->source;
    struct claim_stored line = {.id = now->id,
                                .tier = s->tier,
                                .verdict = now->verdict,
                                .commit = s->commit,
                                .date = s->date,
                                .reason = s->reason};
    enum status status = claims_stored_put(k->out->stored, &line, k->fault);
    return status == STATUS_OK ? note(k, &k->out->change, &k->out->change_count, v) : status;
}

static enum status take(struct clerk *k, const struct report_claim *now) {
    const struct claim_stored *old = claims_stored_find(k->out->stored, now->id, k->source->tier);
    struct accept_verdict v = {.id = now->id,
                               .old = old == NULL ? NULL : claim_verdict_name(old->verdict),
                               .new = claim_verdict_name(now->verdict),
                               .why = arena_copy(&k->out->arena, now->reason)};
    if (v.why == NULL)
        return no_memory(k->fault);
    if (now->verdict == CLAIM_UNDECIDED)
        return note(k, &k->out->open, &k->out->open_count, &v);
    if (now->verdict != CLAIM_NOT_TESTED)
        return old != NULL && old->verdict == now->verdict ? STATUS_OK : change_to(k, now, &v);
    if (old == NULL)
        return STATUS_OK;
    claims_stored_remove(k->out->stored, now->id, k->source->tier);
    v.new = NULL;
    return note(k, &k->out->change, &k->out->change_count, &v);
}

/* -- all ------------------------------------------------------------------------------ */

static enum status judge(struct clerk *k, struct arena *a, struct report_ledger *ledger) {
    const struct accept_claims_source *s = k->source;
    struct report_case *report = arena_take(a, s->case_count, sizeof *report);
    if (report == NULL)
        return no_memory(k->fault);
    for (size_t i = 0; i < s->case_count; i++) {
        const struct rows *rows = s->cases[i].rows;
        report[i] = (struct report_case){.name = s->cases[i].plan->file->name,
                                         .row = rows == NULL ? NULL : rows->row,
                                         .row_count = rows == NULL ? 0 : rows->count};
    }
    const struct claims_input in = {.claims = k->out->claims,
                                    .tier = s->tier,
                                    .cases = s->cases,
                                    .report = report,
                                    .case_count = s->case_count};
    return claims_judge(&in, a, ledger, k->fault);
}

enum status accept_claims_gather(const struct accept_claims_source *source,
                                 struct accept_claims *out, struct fault *fault) {
    struct clerk k = {source, out, fault};
    struct report_ledger ledger = {0};
    struct arena a = {0};
    *out = (struct accept_claims){0};
    enum status status = claims_load(source->cases_folder, &out->claims, fault);
    if (status == STATUS_OK)
        status = claims_stored_load(source->references_folder, out->claims, &out->stored, fault);
    if (status == STATUS_OK)
        status = judge(&k, &a, &ledger);
    for (size_t i = 0; status == STATUS_OK && i < ledger.count; i++) {
        if (takes_part(source, &out->claims->claim[i]))
            status = take(&k, &ledger.claim[i]);
    }
    arena_free(&a);
    if (status != STATUS_OK)
        accept_claims_free(out);
    return status;
}

void accept_claims_free(struct accept_claims *c) {
    claims_stored_free(c->stored);
    claims_free(c->claims);
    arena_free(&c->arena);
    *c = (struct accept_claims){0};
}
