#include "validation/history.h"

#include "common/file.h"
#include "common/json.h"
#include "common/yaml.h"
#include "report/sheet.h"
#include "validation/key.h"
#include "validation/record.h"

#include <errno.h>
#include <fcntl.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

enum { MAX_BYTES = 1 << 30, MAX_RECORD_BYTES = 1 << 20 };

/* -- reading ---------------------------------------------------------------------- */

static void read_values(const struct record *r, const struct yaml_node *root,
                        struct history_line *out) {
    const struct yaml_node *list = record_member(r, root, "observables", YAML_LIST);
    if (list == NULL)
        return;
    struct history_value *value = arena_take(r->arena, list->count, sizeof *value);
    if (value == NULL) {
        record_no_memory(r);
        return;
    }
    for (size_t i = 0; i < list->count; i++) {
        const struct yaml_node *n = &list->child[i];
        value[i] = (struct history_value){.case_name = record_text(r, n, "case"),
                                          .check = record_text(r, n, "check"),
                                          .point = record_text(r, n, "point"),
                                          .unit = record_optional_text(r, n, "unit"),
                                          .measured = record_real(r, n, "measured"),
                                          .uncertainty = record_real(r, n, "uncertainty"),
                                          .expected = record_real(r, n, "expected"),
                                          .tolerance = record_real(r, n, "tolerance")};
    }
    out->value = value;
    out->value_count = list->count;
}

static void read_worst(const struct record *r, const struct yaml_node *root,
                       struct history_line *out) {
    const struct yaml_node *n = record_member(r, root, "worst", YAML_MAP);
    if (n == NULL)
        return;
    const char *case_name = record_optional_text(r, n, "case");
    const char *check = record_optional_text(r, n, "check");
    const char *point = record_optional_text(r, n, "point");
    out->worst_used = record_real(r, n, "margin_used");
    if (case_name != NULL && check != NULL && point != NULL)
        out->worst = arena_text(r->arena, "%s: %s, %s", case_name, check, point);
}

static void read_line(const struct record *r, const struct yaml_node *root,
                      struct history_line *out) {
    const char *schema = record_text(r, root, "schema");
    if (schema == NULL)
        return;
    if (strcmp(schema, "bedcheck-history 1") != 0) {
        yaml_fault(root, r->fault, "schema: %s is not bedcheck-history 1", schema);
        return;
    }
    const struct yaml_node *counts = record_member(r, root, "counts", YAML_MAP);
    *out = (struct history_line){.commit = record_text(r, root, "commit"),
                                 .dirty = record_text(r, root, "dirty"),
                                 .started = record_text(r, root, "started"),
                                 .tier = record_text(r, root, "tier"),
                                 .solver_key = record_text(r, root, "solver_key"),
                                 .modification = record_optional_text(r, root, "modification"),
                                 .verdict = record_text(r, root, "verdict"),
                                 .wall_s = record_real(r, root, "wall_s"),
                                 .cpu_s = record_real(r, root, "cpu_s")};
    if (counts != NULL)
        out->counts = (struct results_counts){
            record_count(r, counts, "pass"), record_count(r, counts, "known"),
            record_count(r, counts, "fail"), record_count(r, counts, "inconclusive"),
            record_count(r, counts, "skipped")};
    read_worst(r, root, out);
    read_values(r, root, out);
}

static enum status add_line(struct history *h, const char *path, const char *text, size_t length,
                            struct fault *fault) {
    struct yaml_document *d = NULL;
    const struct record r = {&h->arena, fault, "no line of bedcheck's"};
    struct history_line *list = arena_grow(&h->arena, h->line, h->count, sizeof *list);
    if (list == NULL)
        return fault_set(fault, STATUS_NO_MEMORY, "history: out of memory");
    h->line = list;
    if (yaml_parse(path, text, length, &d, fault) == STATUS_OK)
        read_line(&r, yaml_root(d), &h->line[h->count]);
    yaml_free(d);
    if (fault->status != STATUS_OK)
        return fault_within(fault, "line %zu", h->count + 1);
    h->count++;
    return STATUS_OK;
}

enum status history_load(const char *path, struct history **out, struct fault *fault) {
    char *text = NULL;
    size_t length = 0;
    struct history *h = calloc(1, sizeof *h);
    *out = NULL;
    if (h == NULL)
        return fault_set(fault, STATUS_NO_MEMORY, "history: out of memory");
    enum status status = file_read(path, MAX_BYTES, &text, &length, fault);
    for (size_t at = 0; status == STATUS_OK && at < length;) {
        const char *end = memchr(text + at, '\n', length - at);
        if (end == NULL) {
            status =
                fault_set(fault, STATUS_BAD_INPUT, "%s: line %zu is cut off", path, h->count + 1);
            break;
        }
        status = add_line(h, path, text + at, (size_t)(end - text) - at, fault);
        at = (size_t)(end - text) + 1;
    }
    free(text);
    if (status != STATUS_OK)
        history_free(h);
    else
        *out = h;
    return status;
}

void history_free(struct history *h) {
    if (h == NULL)
        return;
    arena_free(&h->arena);
    free(h);
}

/* -- writing ---------------------------------------------------------------------- */

static void put_names(struct json *j, const struct results_row *row) {
    json_put_text(j, "case", row == NULL ? NULL : row->case_name);
    json_put_text(j, "check", row == NULL ? NULL : row->check);
    json_put_text(j, "point", row == NULL ? NULL : row->point);
}

static void put_worst(struct json *j, const struct results *r) {
    const struct results_row *worst = NULL;
    double largest = NAN;
    for (size_t i = 0; i < r->row_count; i++) {
        double used = results_is_run(&r->row[i]) ? NAN : results_margin_used(&r->row[i]);
        if (isnan(used) || used <= largest)
            continue;
        largest = used;
        worst = &r->row[i];
    }
    json_key(j, "worst");
    json_begin_object(j);
    put_names(j, worst);
    json_put_real(j, "margin_used", largest);
    json_end_object(j);
}

static void put_values(struct json *j, const struct results *r) {
    json_key(j, "observables");
    json_begin_array(j);
    for (size_t i = 0; i < r->row_count; i++) {
        const struct results_row *row = &r->row[i];
        if (results_is_run(row) || strcmp(row->kind, "round-off") == 0)
            continue;
        json_begin_object(j);
        put_names(j, row);
        json_put_text(j, "unit", row->unit);
        json_put_real(j, "measured", row->measured);
        json_put_real(j, "uncertainty", row->uncertainty);
        json_put_real(j, "expected", row->expected);
        json_put_real(j, "tolerance", row->tolerance);
        json_end_object(j);
    }
    json_end_array(j);
}

struct times {
    double wall_s, cpu_s; /* NaN: some run does not tell */
};

static double recorded_cpu(const char *path) {
    struct yaml_document *d = NULL;
    struct fault none = FAULT_NONE;
    double value = NAN;
    if (yaml_load(path, MAX_RECORD_BYTES, &d, &none) == STATUS_OK &&
        yaml_root(d)->kind == YAML_MAP && yaml_get(yaml_root(d), "cpu_s") != NULL)
        yaml_real(yaml_get(yaml_root(d), "cpu_s"), &value, &none);
    yaml_free(d);
    return value;
}

static enum status add_times(const struct results *r, const char *run, struct times *t,
                             struct fault *fault) {
    struct arena a = {0};
    struct key_record key;
    struct fault none = FAULT_NONE;
    const char *key_path = arena_text(&a, "%s/h5/%s.key", r->folder, run);
    const char *record = arena_text(&a, "%s/h5/%s.run.json", r->folder, run);
    if (key_path == NULL || record == NULL) {
        arena_free(&a);
        return fault_set(fault, STATUS_NO_MEMORY, "history: out of memory");
    }
    t->wall_s += key_read(key_path, &key, &none) == STATUS_OK ? key.seconds : NAN;
    t->cpu_s += recorded_cpu(record);
    arena_free(&a);
    return STATUS_OK;
}

static bool is_repeated(const struct results *r, size_t row, size_t run) {
    const char *name = r->row[row].run[run];
    for (size_t i = 0; i <= row; i++) {
        for (size_t k = 0; k < (i == row ? run : r->row[i].run_count); k++) {
            if (strcmp(r->row[i].run[k], name) == 0)
                return true;
        }
    }
    return false;
}

static enum status sum_times(const struct results *r, struct times *t, struct fault *fault) {
    enum status status = STATUS_OK;
    *t = (struct times){0, 0};
    for (size_t i = 0; i < r->row_count; i++) {
        for (size_t k = 0; k < r->row[i].run_count && status == STATUS_OK; k++) {
            if (!is_repeated(r, i, k))
                status = add_times(r, r->row[i].run[k], t, fault);
        }
    }
    return status;
}

static void put_line(struct json *j, const struct results *r, const struct times *t) {
    json_begin_object(j);
    json_put_text(j, "schema", "bedcheck-history 1");
    json_put_text(j, "commit", r->commit);
    json_put_text(j, "dirty", r->dirty);
    json_put_text(j, "started", r->started);
    json_put_text(j, "tier", r->tier);
    json_put_text(j, "solver_key", r->solver_key);
    json_put_text(j, "modification", r->modification);
    json_put_text(j, "verdict", r->verdict);
    json_key(j, "counts");
    json_begin_object(j);
    json_put_count(j, "pass", r->counts.pass);
    json_put_count(j, "known", r->counts.known);
    json_put_count(j, "fail", r->counts.fail);
    json_put_count(j, "inconclusive", r->counts.inconclusive);
    json_put_count(j, "skipped", r->counts.skipped);
    json_end_object(j);
    put_worst(j, r);
    json_put_real(j, "wall_s", t->wall_s);
    json_put_real(j, "cpu_s", t->cpu_s);
    put_values(j, r);
    json_end_object(j);
}

/* Line breaks and indentation are the only raw line breaks in JSON. */
static size_t make_one_line(char *text, size_t length) {
    size_t kept = 0;
    for (size_t i = 0; i < length; i++) {
        if (text[i] != '\n') {
            text[kept++] = text[i];
            continue;
        }
        while (i + 1 < length && text[i + 1] == ' ')
            i++;
    }
    text[kept++] = '\n';
    return kept;
}

static bool is_there(const struct history *h, const struct results *r) {
    for (size_t i = 0; i < h->count; i++) {
        const struct history_line *l = &h->line[i];
        if (strcmp(l->commit, r->commit) == 0 && strcmp(l->started, r->started) == 0 &&
            strcmp(l->tier, r->tier) == 0 && strcmp(l->solver_key, r->solver_key) == 0)
            return true;
    }
    return false;
}

static enum status write_at_end(int file, const char *path, const char *text, size_t length,
                                struct fault *fault) {
    ssize_t written = write(file, text, length);
    if (written == (ssize_t)length && fsync(file) == 0)
        return STATUS_OK;
    return fault_set(fault, STATUS_IO, "%s: %s", path,
                     written < 0 ? strerror(errno) : "the line could not be written whole");
}

/* The file is locked and open. */
static enum status append_line(int file, const char *path, const struct results *r, bool *added,
                               struct fault *fault) {
    struct history *h = NULL;
    struct sheet sheet = {0};
    struct times times;
    enum status status = history_load(path, &h, fault);
    *added = status == STATUS_OK && !is_there(h, r);
    history_free(h);
    if (!*added || (status = sum_times(r, &times, fault)) != STATUS_OK ||
        (status = sheet_open(&sheet, fault)) != STATUS_OK)
        return status;
    struct json j = json_to(sheet.out);
    put_line(&j, r, &times);
    status = sheet_close(&sheet, fault);
    if (status == STATUS_OK)
        status =
            write_at_end(file, path, sheet.text, make_one_line(sheet.text, sheet.length), fault);
    sheet_free(&sheet);
    return status;
}

enum status history_append(const char *path, const struct results *r, bool *added,
                           struct fault *fault) {
    *added = false;
    int file = open(path, O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
    if (file < 0)
        return fault_set(fault, STATUS_IO, "%s: %s", path, strerror(errno));
    enum status status = flock(file, LOCK_EX) == 0
                             ? append_line(file, path, r, added, fault)
                             : fault_set(fault, STATUS_IO, "%s: %s", path, strerror(errno));
    close(file);
    return status;
}
