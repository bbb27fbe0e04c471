/* compare_json.c -- a comparison for programs; see compare_write.h. */
#include "validation/compare_words.h"

#include "common/json.h"

#include <ctype.h>
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

static void put_side(struct json *j, const char *key, const struct results *r) {
    json_key(j, key);
    json_begin_object(j);
    put_text(j, "folder", r->folder);
    put_text(j, "tier", r->tier);
    put_text(j, "commit", r->commit);
    put_text(j, "dirty", r->dirty);
    put_text(j, "solver_key", r->solver_key);
    put_text(j, "started", r->started);
    put_text(j, "modification", r->modification);
    json_end_object(j);
}

static void put_names(struct json *j, const struct results_row *row) {
    put_text(j, "case", row->case_name);
    put_text(j, "check", row->check);
    put_text(j, "point", row->point);
}

static void put_row(struct json *j, const struct compare_row *r) {
    const struct results_row *a = r->old, *b = r->new;
    json_begin_object(j);
    put_names(j, compare_words_row(r));
    put_text(j, "unit", compare_words_row(r)->unit);
    put_text(j, "change", compare_change_name(r->change));
    put_real(j, "old", a == NULL ? NAN : a->measured);
    put_real(j, "old_uncertainty", a == NULL ? NAN : a->uncertainty);
    put_real(j, "new", b == NULL ? NAN : b->measured);
    put_real(j, "new_uncertainty", b == NULL ? NAN : b->uncertainty);
    put_real(j, "difference", r->difference);
    put_real(j, "uncertainty", r->uncertainty);
    put_real(j, "half_width", r->half_width);
    put_real(j, "tolerance", r->unit);
    put_real(j, "difference_in_tolerances", r->unit > 0 ? r->difference / r->unit : NAN);
    put_text(j, "how", r->how);
    put_text(j, "note", r->note);
    put_real(j, "old_expected", a == NULL ? NAN : a->expected);
    put_real(j, "new_expected", b == NULL ? NAN : b->expected);
    put_text(j, "old_verdict", a == NULL ? NULL : a->verdict);
    put_text(j, "new_verdict", b == NULL ? NULL : b->verdict);
    json_end_object(j);
}

static void put_list(struct json *j, const char *key, const struct results_row *const *row,
                     size_t count) {
    json_key(j, key);
    json_begin_array(j);
    for (size_t i = 0; i < count; i++) {
        json_begin_object(j);
        put_names(j, row[i]);
        json_end_object(j);
    }
    json_end_array(j);
}

static void put_skipped(struct json *j, const char *side, const struct results *r) {
    for (size_t i = 0; i < r->skipped_count; i++) {
        json_begin_object(j);
        put_text(j, "side", side);
        put_text(j, "case", r->skipped[i].case_name);
        put_text(j, "reason", r->skipped[i].reason);
        json_end_object(j);
    }
}

static void put_run(struct json *j, const struct compare_run *run) {
    static const char *const bits[] = {"unchanged", "differ", "unknown"};
    json_begin_object(j);
    put_text(j, "name", run->name);
    put_text(j, "bits", bits[run->bits]);
    put_real(j, "first_time", run->first.found ? run->first.time : NAN);
    put_real(j, "first_step", run->first.found ? run->first.step : NAN);
    put_real(j, "first_size", run->first.found ? run->first.size : NAN);
    put_text(j, "first_dataset", run->first.dataset);
    put_real(j, "parted_time", run->parted.found ? run->parted.time : NAN);
    put_real(j, "parted_step", run->parted.found ? run->parted.step : NAN);
    put_text(j, "reason", run->why);
    json_end_object(j);
}

static void put_cost(struct json *j, const struct compare_cost *c) {
    json_begin_object(j);
    put_text(j, "part", c->part);
    put_count(j, "runs", c->runs);
    put_real(j, "old_s", c->old_s);
    put_real(j, "new_s", c->new_s);
    put_real(j, "ratio", c->ratio);
    put_real(j, "uncertainty", c->uncertainty);
    put_text(j, "told", compare_words_speed(c));
    json_end_object(j);
}

static void put_head(struct json *j, const struct compared *c) {
    put_text(j, "schema", "bedcheck-comparison 1");
    put_text(j, "conclusion", compare_words_conclusion(c));
    put_count(j, "exit_code", (size_t)compare_exit_code(c));
    put_text(j, "refusal", c->refusal);
    put_real(j, "level", c->level);
    put_count(j, "tests", c->tests);
    put_side(j, "old", c->old);
    put_side(j, "new", c->new);
    json_key(j, "counts");
    json_begin_object(j);
    for (int i = 0; i < CHANGE_COUNT; i++)
        put_count(j, compare_change_name((enum change)i), c->count[i]);
    put_count(j, "added", c->added_count);
    put_count(j, "removed", c->removed_count);
    json_end_object(j);
}

void compare_write_json(const struct compare_view *v, FILE *out) {
    const struct compared *c = v->rows;
    struct json j = json_to(out);
    json_begin_object(&j);
    put_head(&j, c);
    json_key(&j, "rows");
    json_begin_array(&j);
    for (size_t i = 0; i < c->row_count; i++)
        put_row(&j, &c->row[i]);
    json_end_array(&j);
    put_list(&j, "added", c->added, c->added_count);
    put_list(&j, "removed", c->removed, c->removed_count);
    json_key(&j, "not_run");
    json_begin_array(&j);
    put_skipped(&j, "old", c->old);
    put_skipped(&j, "new", c->new);
    json_end_array(&j);
    json_key(&j, "runs");
    json_begin_array(&j);
    for (size_t i = 0; v->runs != NULL && i < v->runs->run_count; i++)
        put_run(&j, &v->runs->run[i]);
    json_end_array(&j);
    json_key(&j, "cost");
    json_begin_array(&j);
    for (size_t i = 0; v->runs != NULL && i < v->runs->cost_count; i++)
        put_cost(&j, &v->runs->cost[i]);
    json_end_array(&j);
    json_end_object(&j);
}
