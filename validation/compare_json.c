/* compare_json.c -- a comparison for programs; see compare_write.h. */
#include "validation/compare_words.h"

#include "common/json.h"

#include <ctype.h>
#include <math.h>

static void put_side(struct json *j, const char *key, const struct results *r) {
    json_key(j, key);
    json_begin_object(j);
    json_put_text(j, "folder", r->folder);
    json_put_text(j, "tier", r->tier);
    json_put_text(j, "commit", r->commit);
    json_put_text(j, "dirty", r->dirty);
    json_put_text(j, "solver_key", r->solver_key);
    json_put_text(j, "started", r->started);
    json_put_text(j, "modification", r->modification);
    json_end_object(j);
}

static void put_names(struct json *j, const struct results_row *row) {
    json_put_text(j, "case", row->case_name);
    json_put_text(j, "check", row->check);
    json_put_text(j, "point", row->point);
}

static void put_row(struct json *j, const struct compare_row *r) {
    const struct results_row *a = r->old, *b = r->new;
    json_begin_object(j);
    put_names(j, compare_words_row(r));
    json_put_text(j, "unit", compare_words_row(r)->unit);
    json_put_text(j, "change", compare_change_name(r->change));
    json_put_real(j, "old", a == NULL ? NAN : a->measured);
    json_put_real(j, "old_uncertainty", a == NULL ? NAN : a->uncertainty);
    json_put_real(j, "new", b == NULL ? NAN : b->measured);
    json_put_real(j, "new_uncertainty", b == NULL ? NAN : b->uncertainty);
    json_put_real(j, "difference", r->difference);
    json_put_real(j, "uncertainty", r->uncertainty);
    json_put_real(j, "half_width", r->half_width);
    json_put_real(j, "tolerance", r->unit);
    json_put_real(j, "difference_in_tolerances", r->unit > 0 ? r->difference / r->unit : NAN);
    json_put_text(j, "how", r->how);
    json_put_text(j, "note", r->note);
    json_put_real(j, "old_expected", a == NULL ? NAN : a->expected);
    json_put_real(j, "new_expected", b == NULL ? NAN : b->expected);
    json_put_text(j, "old_verdict", a == NULL ? NULL : a->verdict);
    json_put_text(j, "new_verdict", b == NULL ? NULL : b->verdict);
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
        json_put_text(j, "side", side);
        json_put_text(j, "case", r->skipped[i].case_name);
        json_put_text(j, "reason", r->skipped[i].reason);
        json_end_object(j);
    }
}

static void put_run(struct json *j, const struct compare_run *run) {
    static const char *const bits[] = {"unchanged", "differ", "unknown"};
    json_begin_object(j);
    json_put_text(j, "name", run->name);
    json_put_text(j, "bits", bits[run->bits]);
    json_put_real(j, "first_time", run->first.found ? run->first.time : NAN);
    json_put_real(j, "first_step", run->first.found ? run->first.step : NAN);
    json_put_real(j, "first_size", run->first.found ? run->first.size : NAN);
    json_put_text(j, "first_dataset", run->first.dataset);
    json_put_real(j, "parted_time", run->parted.found ? run->parted.time : NAN);
    json_put_real(j, "parted_step", run->parted.found ? run->parted.step : NAN);
    json_put_text(j, "reason", run->why);
    json_end_object(j);
}

static void put_cost(struct json *j, const struct compare_cost *c) {
    json_begin_object(j);
    json_put_text(j, "part", c->part);
    json_put_count(j, "runs", c->runs);
    json_put_real(j, "old_s", c->old_s);
    json_put_real(j, "new_s", c->new_s);
    json_put_real(j, "ratio", c->ratio);
    json_put_real(j, "uncertainty", c->uncertainty);
    json_put_text(j, "told", compare_words_speed(c));
    json_end_object(j);
}

static void put_head(struct json *j, const struct compared *c) {
    json_put_text(j, "schema", "bedcheck-comparison 1");
    json_put_text(j, "conclusion", compare_words_conclusion(c));
    json_put_count(j, "exit_code", (size_t)compare_exit_code(c));
    json_put_text(j, "refusal", c->refusal);
    json_put_real(j, "level", c->level);
    json_put_count(j, "tests", c->tests);
    put_side(j, "old", c->old);
    put_side(j, "new", c->new);
    json_key(j, "counts");
    json_begin_object(j);
    for (int i = 0; i < CHANGE_COUNT; i++)
        json_put_count(j, compare_change_name((enum change)i), c->count[i]);
    json_put_count(j, "added", c->added_count);
    json_put_count(j, "removed", c->removed_count);
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
