/* record.c -- see record.h. */
#include "validation/record.h"

#include <math.h>
#include <string.h>

enum status record_no_memory(const struct record *r) {
    return fault_set(r->fault, STATUS_NO_MEMORY, "record: out of memory");
}

bool record_is_null(const struct yaml_node *n) {
    return n->kind == YAML_SCALAR && !n->quoted && strcmp(n->text, "null") == 0;
}

const struct yaml_node *record_member(const struct record *r, const struct yaml_node *map,
                                      const char *key, enum yaml_kind kind) {
    static const char *const word[] = {
        [YAML_MAP] = "map", [YAML_LIST] = "list", [YAML_SCALAR] = "single value"};
    const struct yaml_node *n = map->kind == YAML_MAP ? yaml_get(map, key) : NULL;
    if (n != NULL && n->kind == kind)
        return n;
    if (n != NULL)
        yaml_fault(n, r->fault, "%s: must be a %s", key, word[kind]);
    else
        yaml_fault(map, r->fault, "%s is missing: %s", key, r->hint);
    return NULL;
}

static const char *copy(const struct record *r, const struct yaml_node *n, const char *key) {
    const char *text = n->quoted ? arena_copy(r->arena, n->text) : NULL;
    if (!n->quoted)
        yaml_fault(n, r->fault, "%s: must be a text", key);
    else if (text == NULL)
        record_no_memory(r);
    return text;
}

const char *record_text(const struct record *r, const struct yaml_node *map, const char *key) {
    const struct yaml_node *n = record_member(r, map, key, YAML_SCALAR);
    return n == NULL ? NULL : copy(r, n, key);
}

const char *record_optional_text(const struct record *r, const struct yaml_node *map,
                                 const char *key) {
    const struct yaml_node *n = record_member(r, map, key, YAML_SCALAR);
    return n == NULL || record_is_null(n) ? NULL : copy(r, n, key);
}

double record_real_of(const struct record *r, const struct yaml_node *n) {
    double value = NAN;
    if (!record_is_null(n))
        yaml_real(n, &value, r->fault);
    return value;
}

double record_real(const struct record *r, const struct yaml_node *map, const char *key) {
    const struct yaml_node *n = record_member(r, map, key, YAML_SCALAR);
    return n == NULL ? NAN : record_real_of(r, n);
}

size_t record_count(const struct record *r, const struct yaml_node *map, const char *key) {
    long long value = 0;
    const struct yaml_node *n = record_member(r, map, key, YAML_SCALAR);
    if (n != NULL && yaml_integer(n, &value, r->fault) == STATUS_OK && value < 0)
        yaml_fault(n, r->fault, "%s: must not be negative", key);
    return value < 0 ? 0 : (size_t)value;
}
