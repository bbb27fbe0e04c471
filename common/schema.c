/* schema.c -- see schema.h. */
#include "common/schema.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { LONGEST_WORD = 64 };

/* Levenshtein distance of two words, at most LONGEST_WORD long. */
static size_t distance(const char *a, const char *b) {
    size_t row[LONGEST_WORD + 1], m = strlen(a), n = strlen(b);
    for (size_t j = 0; j <= n; j++)
        row[j] = j;
    for (size_t i = 1; i <= m; i++) {
        size_t diagonal = row[0];
        row[0] = i;
        for (size_t j = 1; j <= n; j++) {
            size_t best = diagonal + (a[i - 1] != b[j - 1]);
            diagonal = row[j];
            if (row[j] + 1 < best)
                best = row[j] + 1;
            if (row[j - 1] + 1 < best)
                best = row[j - 1] + 1;
            row[j] = best;
        }
    }
    return row[n];
}

const char *schema_nearest(const char *word, const char *const *names, size_t count) {
    const char *nearest = NULL;
    size_t length = strlen(word), least = length / 3 > 2 ? length / 3 : 2;
    if (length > LONGEST_WORD)
        return NULL;
    for (size_t i = 0; i < count; i++) {
        if (strlen(names[i]) > LONGEST_WORD)
            continue;
        size_t d = distance(word, names[i]);
        /* Nothing of a short word would be left: "ab" is not a slip of "cd". */
        if (d < length && (d < least || (d == least && nearest == NULL))) {
            least = d;
            nearest = names[i];
        }
    }
    return nearest;
}

static enum status check_range(const struct yaml_node *n, const struct schema_field *field,
                               double value, struct fault *fault) {
    if (field->min >= field->max || (value >= field->min && value <= field->max))
        return STATUS_OK;
    return yaml_fault(n, fault, "%s: %s is outside %.10g .. %.10g", field->key, n->text, field->min,
                      field->max);
}

static enum status check_number(const struct yaml_node *n, const struct schema_field *field,
                                bool integer, struct fault *fault) {
    double value;
    long long whole;
    enum status status = integer ? yaml_integer(n, &whole, fault) : yaml_real(n, &value, fault);
    if (status != STATUS_OK)
        return status;
    return check_range(n, field, integer ? (double)whole : value, fault);
}

static enum status check_choice(const struct yaml_node *n, const struct schema_field *field,
                                struct fault *fault) {
    const char *text;
    if (yaml_string(n, &text, fault) != STATUS_OK)
        return STATUS_BAD_INPUT;
    char known[512] = "";
    size_t count = 0;
    for (; field->choices[count] != NULL; count++) {
        if (strcmp(text, field->choices[count]) == 0)
            return STATUS_OK;
        size_t used = strlen(known);
        snprintf(known + used, sizeof known - used, "%s%s", used ? ", " : "",
                 field->choices[count]);
    }
    const char *near = schema_nearest(text, field->choices, count);
    if (near != NULL)
        return yaml_fault(n, fault, "%s: '%.80s' is none of %s; did you mean '%s'?", field->key,
                          text, known, near);
    return yaml_fault(n, fault, "%s: '%.80s' is none of %s", field->key, text, known);
}

static enum status check_kind(const struct yaml_node *n, const struct schema_field *field,
                              enum yaml_kind kind, struct fault *fault) {
    if (n->kind == kind)
        return STATUS_OK;
    return yaml_fault(n, fault, "%s: a %s is needed", field->key,
                      kind == YAML_LIST ? "list" : "map");
}

static enum status check_real_list(const struct yaml_node *n, const struct schema_field *field,
                                   struct fault *fault) {
    enum status status = check_kind(n, field, YAML_LIST, fault);
    for (size_t i = 0; status == STATUS_OK && i < n->count; i++)
        status = check_number(&n->child[i], field, false, fault);
    return status;
}

enum status schema_check_value(const struct yaml_node *value, const struct schema_field *field,
                               struct fault *fault) {
    bool truth;
    const char *text;
    switch (field->type) {
    case SCHEMA_REAL:
        return check_number(value, field, false, fault);
    case SCHEMA_INTEGER:
        return check_number(value, field, true, fault);
    case SCHEMA_BOOLEAN:
        return yaml_boolean(value, &truth, fault);
    case SCHEMA_TEXT:
        return yaml_string(value, &text, fault);
    case SCHEMA_CHOICE:
        return check_choice(value, field, fault);
    case SCHEMA_LIST:
        return check_kind(value, field, YAML_LIST, fault);
    case SCHEMA_MAP:
        return check_kind(value, field, YAML_MAP, fault);
    case SCHEMA_REAL_LIST:
        return check_real_list(value, field, fault);
    case SCHEMA_ANY:
        break;
    }
    return STATUS_OK;
}

static const struct schema_field *find_field(const char *key, const struct schema_field *fields,
                                             size_t count) {
    for (size_t i = 0; i < count; i++)
        if (strcmp(fields[i].key, key) == 0)
            return &fields[i];
    return NULL;
}

static enum status unknown_key(const struct yaml_node *n, const char *what,
                               const struct schema_field *fields, size_t count,
                               struct fault *fault) {
    const char **names = malloc((count + 1) * sizeof *names);
    if (names == NULL)
        return fault_add(fault, STATUS_NO_MEMORY, "%s: no memory", n->file);
    for (size_t i = 0; i < count; i++)
        names[i] = fields[i].key;
    const char *near = schema_nearest(n->key, names, count);
    free(names);
    fault_add(fault, STATUS_BAD_INPUT, "%s:%zu:%zu: %.80s: no such key in a %s%s%s%s", n->file,
              n->key_line, n->key_column, n->key, what, near ? "; did you mean '" : "",
              near ? near : "", near ? "'?" : "");
    return STATUS_BAD_INPUT;
}

enum status schema_check(const struct yaml_node *map, const char *what,
                         const struct schema_field *fields, size_t count, struct fault *fault) {
    if (map->kind != YAML_MAP)
        return yaml_fault(map, fault, "%s%sa %s is a map of keys and values",
                          map->key ? map->key : "", map->key ? ": " : "", what);
    enum status status = STATUS_OK;
    for (size_t i = 0; i < map->count; i++) {
        const struct yaml_node *n = &map->child[i];
        const struct schema_field *field = find_field(n->key, fields, count);
        enum status found = field != NULL ? schema_check_value(n, field, fault)
                                          : unknown_key(n, what, fields, count, fault);
        if (found != STATUS_OK)
            status = found;
    }
    for (size_t i = 0; i < count; i++)
        if (fields[i].required && yaml_get(map, fields[i].key) == NULL)
            status = yaml_fault(map, fault, "%s: missing in this %s", fields[i].key, what);
    return status;
}
