/* json_claims.c -- "claims" of results.json: [{id, paper, where, says, reading, verdict, reason,
 * stored, because, proof, tests: [{case, check, points, wants, result, missing, measured:
 * [number]}]}].
 *
 * `measured` has one number for each row of the check that decides the claim; `missing` says why
 * there is none.
 */
#include "report/json_claims.h"

#include "report/ledger.h"

static void put_text(struct json *j, const char *key, const char *text) {
    json_key(j, key);
    json_text(j, text);
}

static void put_test(struct json *j, const struct report_claim_test *t) {
    static const char *const result[] = {[CLAIM_AS_SAID] = "as said",
                                         [CLAIM_CONTRARY] = "contrary",
                                         [CLAIM_OPEN] = "inconclusive",
                                         [CLAIM_MISSING] = "missing"};
    json_begin_object(j);
    put_text(j, "case", t->case_name);
    put_text(j, "check", t->check);
    put_text(j, "points", t->points);
    put_text(j, "wants", t->wants_pass ? "pass" : "fail");
    put_text(j, "result", result[t->result]);
    put_text(j, "missing", t->missing);
    json_key(j, "measured");
    json_begin_array(j);
    for (size_t i = 0; i < t->row_count; i++)
        json_real(j, t->in->row[t->row[i]].measured);
    json_end_array(j);
    json_end_object(j);
}

static void put_claim(struct json *j, const struct report_claim *c) {
    json_begin_object(j);
    put_text(j, "id", c->id);
    put_text(j, "paper", c->paper);
    put_text(j, "where", c->where);
    put_text(j, "says", c->says);
    put_text(j, "reading", c->reading);
    put_text(j, "verdict", claim_verdict_name(c->verdict));
    put_text(j, "reason", c->reason);
    put_text(j, "stored", c->stored);
    put_text(j, "because", c->because);
    put_text(j, "proof", c->proof);
    json_key(j, "tests");
    json_begin_array(j);
    for (size_t i = 0; i < c->test_count; i++)
        put_test(j, &c->test[i]);
    json_end_array(j);
    json_end_object(j);
}

void json_claims(struct json *j, const struct report *r) {
    json_key(j, "claims");
    json_begin_array(j);
    for (size_t i = 0; r->ledger != NULL && i < r->ledger->count; i++)
        put_claim(j, &r->ledger->claim[i]);
    json_end_array(j);
}
