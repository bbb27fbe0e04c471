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
    json_put_real(j, "freedom", row->freedom);
    json_put_text(j, "key", row->key);
    json_put_text(j, "meaning", row->meaning);
    json_key(j, "statistical");
    json_boolean(j, row->statistical);
    json_put_real(j, "detectable", row->detectable);
    json_put_real(j, "alarm_rate", row->alarm_rate);
    json_put_text(j, "since", row->since);
    json_put_text(j, "bits", row->bits);
}

static void put_row(struct json *j, const struct report_row *row) {
    json_begin_object(j);
    json_put_text(j, "case", row->case_name);
    json_put_text(j, "point", row->point);
    json_put_text(j, "check", row->check);
    json_put_text(j, "observable", row->observable);
    json_put_text(j, "unit", row->unit);
    json_put_real(j, "measured", row->measured);
    json_put_real(j, "uncertainty", row->uncertainty);
    json_put_real(j, "expected", row->expected);
    json_put_real(j, "expected_uncertainty", row->expected_uncertainty);
    json_put_real(j, "tolerance", row->tolerance);
    json_put_text(j, "comparison", row->comparison);
    json_put_text(j, "kind", row->kind);
    json_put_text(j, "verdict", verdict_name(row->verdict));
    json_put_text(j, "because", row->because);
    json_put_text(j, "reason", reason_of(row));
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
    json_put_text(j, "schema", "bedcheck-results 1");
    json_put_text(j, "suite", r->suite);
    json_put_text(j, "tier", r->tier);
    json_put_text(j, "solver", r->solver);
    json_put_text(j, "solver_key", r->solver_key);
    json_put_text(j, "started", r->started);
    json_key(j, "modified");
    json_boolean(j, r->modified);
    json_put_text(j, "modification", r->modified ? r->modification : NULL);
    json_put_text(j, "verdict", verdict_name(report_verdict(r)));
    json_key(j, "counts");
    json_begin_object(j);
    json_put_count(j, "pass", count.pass);
    json_put_count(j, "fail", count.fail);
    json_put_count(j, "inconclusive", count.inconclusive);
    json_put_count(j, "known", count.known);
    json_put_count(j, "skipped", count.skipped);
    json_end_object(j);
}

/* What unchanged code may do, and which runs are unchanged to the bit. */
static void put_allowance(struct json *j, const struct report *r) {
    struct report_alarms a = report_alarms(r);
    json_key(j, "budget");
    json_begin_object(j);
    json_put_real(j, "allowed", r->budget.allowed);
    json_put_real(j, "share", r->budget.share);
    json_put_count(j, "statistical", r->budget.statistical);
    json_put_count(j, "judged", a.rows);
    json_put_count(j, "unknown", a.unknown);
    json_put_real(j, "computed", a.sum);
    json_end_object(j);
    json_key(j, "bits");
    json_begin_object(j);
    json_put_count(j, "same", r->bits.same);
    json_put_count(j, "other", r->bits.other);
    json_put_count(j, "unknown", r->bits.unknown);
    json_end_object(j);
}

static void put_skipped(struct json *j, const struct report *r) {
    json_key(j, "skipped");
    json_begin_array(j);
    for (size_t i = 0; i < r->case_count; i++) {
        if (!r->cases[i].skipped)
            continue;
        json_begin_object(j);
        json_put_text(j, "case", r->cases[i].name);
        json_put_text(j, "reason", r->cases[i].skip_reason);
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
        json_put_text(j, r->fact[i].name, r->fact[i].value);
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
