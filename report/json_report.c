/* json_report.c -- results.json: every row as judged, for programs.
 *
 *     {"schema": "bedcheck-results 1", "suite", "tier", "solver", "solver_key", "started",
 *      "modified", "modification", "verdict", "counts": {pass, fail, inconclusive, known, skipped},
 *      "budget": {allowed, share, statistical, judged, unknown, computed},
 *      "bits": {same, other, unknown},
 *      "checks": [{case, point, check, observable, unit, measured, uncertainty, expected,
 *                  expected_uncertainty, tolerance, comparison, kind, verdict, because, reason,
 *                  runs: [id], values: [number], seeds: [integer], freedom, key,
 *                  meaning, detectable, alarm_rate, since, bits}],
 *      "agreement": {groups: [{group, rows, cases, bias, scatter: {value, low, high}, noise}],
 *                    left_out: {round_off, one_sided, other}},
 *      "claims": [see json_claims.c],
 *      "skipped": [{case, reason}],
 *      "limits": [{model, what, because}], "unselected": [case],
 *      "provenance": {name: value}}
 *
 * Strict JSON: a number that is none is null, and `reason` then says why.
 */
#include "report/json_claims.h"
#include "report/json_cover.h"
#include "report/report.h"
#include "report/sheet.h"

#include "common/json.h"

#include <math.h>

static void put_text(struct json *j, const char *key, const char *text) {
    json_key(j, key);
    json_text(j, text);
}

static void put_real(struct json *j, const char *key, double value) {
    json_key(j, key);
    json_real(j, value);
}

static void put_count(struct json *j, const char *key, size_t count) {
    json_key(j, key);
    json_integer(j, (long long)count);
}

/* A null must not stand there unexplained, whatever the judge has said. */
static const char *reason_of(const struct report_row *row) {
    if (row->reason && *row->reason)
        return row->reason;
    if (!isfinite(row->measured))
        return "nothing finite was measured";
    if (!isfinite(row->expected))
        return "there is no finite expectation";
    if (!isfinite(row->uncertainty) || !isfinite(row->expected_uncertainty))
        return "an uncertainty is not known";
    return isfinite(row->tolerance) ? "" : "there is no finite tolerance";
}

/* What each seed gave, and what the check can and cannot tell. */
static void put_values(struct json *j, const struct report_row *row) {
    json_key(j, "values");
    json_begin_array(j);
    for (size_t i = 0; i < row->value_count; i++)
        json_real(j, row->values[i]);
    json_end_array(j);
    json_key(j, "seeds");
    json_begin_array(j);
    for (size_t i = 0; i < row->value_count; i++)
        json_integer(j, row->seeds[i]);
    json_end_array(j);
    put_real(j, "freedom", row->freedom);
    put_text(j, "key", row->key);
    put_text(j, "meaning", row->meaning);
    json_key(j, "statistical");
    json_boolean(j, row->statistical);
    put_real(j, "detectable", row->detectable);
    put_real(j, "alarm_rate", row->alarm_rate);
    put_text(j, "since", row->since);
    put_text(j, "bits", row->bits);
}

static void put_row(struct json *j, const struct report_row *row) {
    json_begin_object(j);
    put_text(j, "case", row->case_name);
    put_text(j, "point", row->point);
    put_text(j, "check", row->check);
    put_text(j, "observable", row->observable);
    put_text(j, "unit", row->unit);
    put_real(j, "measured", row->measured);
    put_real(j, "uncertainty", row->uncertainty);
    put_real(j, "expected", row->expected);
    put_real(j, "expected_uncertainty", row->expected_uncertainty);
    put_real(j, "tolerance", row->tolerance);
    put_text(j, "comparison", row->comparison);
    put_text(j, "kind", row->kind);
    put_text(j, "verdict", verdict_name(row->verdict));
    put_text(j, "because", row->because);
    put_text(j, "reason", reason_of(row));
    json_key(j, "runs");
    json_begin_array(j);
    for (size_t i = 0; i < row->run_count; i++)
        json_text(j, row->runs[i]);
    json_end_array(j);
    put_values(j, row);
    json_end_object(j);
}

static void put_head(struct json *j, const struct report *r) {
    struct report_count count = report_tally(r);
    put_text(j, "schema", "bedcheck-results 1");
    put_text(j, "suite", r->suite);
    put_text(j, "tier", r->tier);
    put_text(j, "solver", r->solver);
    put_text(j, "solver_key", r->solver_key);
    put_text(j, "started", r->started);
    json_key(j, "modified");
    json_boolean(j, r->modified);
    put_text(j, "modification", r->modified ? r->modification : NULL);
    put_text(j, "verdict", verdict_name(report_verdict(r)));
    json_key(j, "counts");
    json_begin_object(j);
    put_count(j, "pass", count.pass);
    put_count(j, "fail", count.fail);
    put_count(j, "inconclusive", count.inconclusive);
    put_count(j, "known", count.known);
    put_count(j, "skipped", count.skipped);
    json_end_object(j);
}

/* What unchanged code may do, and which runs are unchanged to the bit. */
static void put_allowance(struct json *j, const struct report *r) {
    struct report_alarms a = report_alarms(r);
    json_key(j, "budget");
    json_begin_object(j);
    put_real(j, "allowed", r->budget.allowed);
    put_real(j, "share", r->budget.share);
    put_count(j, "statistical", r->budget.statistical);
    put_count(j, "judged", a.rows);
    put_count(j, "unknown", a.unknown);
    put_real(j, "computed", a.sum);
    json_end_object(j);
    json_key(j, "bits");
    json_begin_object(j);
    put_count(j, "same", r->bits.same);
    put_count(j, "other", r->bits.other);
    put_count(j, "unknown", r->bits.unknown);
    json_end_object(j);
}

static void put_skipped(struct json *j, const struct report *r) {
    json_key(j, "skipped");
    json_begin_array(j);
    for (size_t i = 0; i < r->case_count; i++) {
        if (!r->cases[i].skipped)
            continue;
        json_begin_object(j);
        put_text(j, "case", r->cases[i].name);
        put_text(j, "reason", r->cases[i].skip_reason);
        json_end_object(j);
    }
    json_end_array(j);
}

static void put_report(struct json *j, const struct report *r) {
    json_begin_object(j);
    put_head(j, r);
    put_allowance(j, r);
    json_key(j, "checks");
    json_begin_array(j);
    for (size_t i = 0; i < r->case_count; i++) {
        for (size_t k = 0; k < r->cases[i].row_count; k++)
            put_row(j, &r->cases[i].row[k]);
    }
    json_end_array(j);
    json_cover_agreement(j, r);
    json_claims(j, r);
    put_skipped(j, r);
    json_cover_limits(j, r);
    json_key(j, "provenance");
    json_begin_object(j);
    for (size_t i = 0; i < r->fact_count; i++)
        put_text(j, r->fact[i].name, r->fact[i].value);
    json_end_object(j);
    json_end_object(j);
}

enum status report_write_json(const struct report *r, const char *path, struct fault *fault) {
    struct sheet sheet;
    enum status status = sheet_open(&sheet, fault);
    if (status)
        return status;
    struct json j = json_to(sheet.out);
    put_report(&j, r);
    status = sheet_save(&sheet, path, fault);
    sheet_free(&sheet);
    return status;
}
