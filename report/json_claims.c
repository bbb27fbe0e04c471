/* json_claims.c -- "claims" of results.json: [{id, paper, where, says, reading, verdict, reason,
 * stored, because, proof, tests: [{case, check, points, wants, result, missing, measured:
 * [number]}]}].
 *
 * `measured` has one number for each row of the check that decides the claim; `missing` says why
 * there is none.
 */
#include "report/json_claims.h"

#include "report/ledger.h"

static void put_test(struct json *j, const struct report_claim_test *t) {
    static const char *const result[] = {[CLAIM_AS_SAID] = "as said",
                                         [CLAIM_CONTRARY] = "contrary",
                                         [CLAIM_OPEN] = "inconclusive",
                                         [CLAIM_MISSING] = "missing"};
    json_begin_object(j);
    json_put_text(j, "case", t->case_name);
    json_put_text(j, "check", t->check);
    json_put_text(j, "points", t->points);
    json_put_text(j, "wants", t->wants_pass ? "pass" : "fail");
    json_put_text(j, "result", result[t->result]);
    json_put_text(j, "missing", t->missing);
    json_key(j, "measured");
    json_begin_array(j);
    for (size_t i = 0; i < t->row_count; i++)
        json_real(j, t->in->row[t->row[i]].measured);
    json_end_array(j);
    json_end_object(j);
}

static void put_claim(struct json *j, const struct report_claim *c) {
    json_begin_object(j);
    json_put_text(j, "id", c->id);
    json_put_text(j, "paper", c->paper);
    json_put_text(j, "where", c->where);
    json_put_text(j, "says", c->says);
    json_put_text(j, "reading", c->reading);
    json_put_text(j, "verdict", claim_verdict_name(c->verdict));
    json_put_text(j, "reason", c->reason);
    json_put_text(j, "stored", c->stored);
    json_put_text(j, "because", c->because);
    json_put_text(j, "proof", c->proof);
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
