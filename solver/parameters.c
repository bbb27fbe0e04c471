/* parameters.c -- the table of a model made useful; declared in model.h.
 *
 * Defaults, run file and --set go through the same reader, so that a default
 * out of its own range or misspelt is found as well.
 */
#include "solver/model.h"

#include "common/schema.h"

#include <assert.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* -- looking up --------------------------------------------------------------- */

/* Index of a name in the table, or count when it is not there. */
static size_t find(const struct parameter_set *p, const char *name) {
    size_t i = 0;
    while (i < p->count && strcmp(p->table[i].name, name) != 0)
        i++;
    return i;
}

double parameters_real(const struct parameter_set *p, const char *name) {
    size_t i = find(p, name);
    assert(i < p->count && p->table[i].type != PARAMETER_REAL_LIST);
    return p->real[i];
}

const char *parameters_choice(const struct parameter_set *p, const char *name) {
    size_t i = find(p, name);
    assert(i < p->count && p->table[i].type == PARAMETER_CHOICE);
    return p->table[i].choices[(size_t)p->real[i]];
}

const double *parameters_list(const struct parameter_set *p, const char *name, size_t *length) {
    size_t i = find(p, name);
    assert(i < p->count && p->table[i].type == PARAMETER_REAL_LIST);
    *length = p->length[i];
    return p->list[i];
}

enum status parameters_fault(const struct parameter_set *p, const char *name, struct fault *fault,
                             const char *format, ...) {
    char message[1024];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(message, sizeof message, format, arguments);
    va_end(arguments);
    size_t i = find(p, name);
    const char *place = i < p->count ? p->place[i] : "parameters";
    fault_add(fault, STATUS_BAD_INPUT, "%s: %s: %s", place, name, message);
    return STATUS_BAD_INPUT;
}

/* -- reading ------------------------------------------------------------------ */

static enum schema_type schema_type_of(enum parameter_type type) {
    switch (type) {
    case PARAMETER_REAL:
        return SCHEMA_REAL;
    case PARAMETER_INTEGER:
        return SCHEMA_INTEGER;
    case PARAMETER_BOOLEAN:
        return SCHEMA_BOOLEAN;
    case PARAMETER_CHOICE:
        return SCHEMA_CHOICE;
    case PARAMETER_REAL_LIST:
        break;
    }
    return SCHEMA_REAL_LIST;
}

/* The place of a value, for messages: the node's, unless the caller has a better word. */
static enum status set_place(struct parameter_set *p, size_t i, const struct yaml_node *n,
                             const char *word, struct fault *fault) {
    char *place = NULL;
    int length = word != NULL ? asprintf(&place, "%s", word)
                              : asprintf(&place, "%s:%zu:%zu", n->file, n->line, n->column);
    if (length < 0)
        return fault_set(fault, STATUS_NO_MEMORY, "no memory for parameters");
    free((char *)p->place[i]);
    p->place[i] = place;
    return STATUS_OK;
}

static enum status set_list(struct parameter_set *p, size_t i, const struct yaml_node *n,
                            struct fault *fault) {
    double *list = calloc(n->count + 1, sizeof *list);
    if (list == NULL)
        return fault_set(fault, STATUS_NO_MEMORY, "no memory for parameters");
    for (size_t k = 0; k < n->count; k++)
        yaml_real(&n->child[k], &list[k], fault);
    free(p->list[i]);
    p->list[i] = list;
    p->length[i] = n->count;
    return STATUS_OK;
}

/* Take the value of a node for parameter i, once it is known to fit the table. */
static enum status set_value(struct parameter_set *p, size_t i, const struct yaml_node *n,
                             const char *word, struct fault *fault) {
    const struct parameter *row = &p->table[i];
    struct schema_field field = {.key = row->name,
                                 .type = schema_type_of(row->type),
                                 .min = row->min,
                                 .max = row->max,
                                 .choices = row->choices};
    enum status status = schema_check_value(n, &field, fault);
    if (status != STATUS_OK)
        return status;
    bool truth;
    switch (row->type) {
    case PARAMETER_REAL:
    case PARAMETER_INTEGER:
        yaml_real(n, &p->real[i], fault);
        if (row->type == PARAMETER_INTEGER && fabs(p->real[i]) > 9007199254740992.0)
            return yaml_fault(n, fault, "%s: %s is too large", row->name, n->text);
        break;
    case PARAMETER_BOOLEAN:
        yaml_boolean(n, &truth, fault);
        p->real[i] = truth;
        break;
    case PARAMETER_CHOICE:
        for (size_t k = 0; row->choices[k] != NULL; k++)
            if (strcmp(row->choices[k], n->text) == 0)
                p->real[i] = (double)k;
        break;
    case PARAMETER_REAL_LIST:
        status = set_list(p, i, n, fault);
    }
    return status == STATUS_OK ? set_place(p, i, n, word, fault) : status;
}

/* A value given as text: "60", "[1, 2]".  `place` stands for the file in messages. */
static enum status set_text(struct parameter_set *p, size_t i, const char *text, const char *place,
                            struct fault *fault) {
    struct yaml_document *document;
    enum status status = yaml_parse(place, text, strlen(text), &document, fault);
    if (status != STATUS_OK)
        return status;
    struct yaml_node value = *yaml_root(document);
    value.key = p->table[i].name;
    status = set_value(p, i, &value, place, fault);
    yaml_free(document);
    return status;
}

/* "name: no such parameter of graingas; did you mean 'grains'?" */
static enum status unknown(const struct model *m, const char *place, const char *name,
                           struct fault *fault) {
    const char **names = calloc(m->parameter_count + 1, sizeof *names);
    if (names == NULL)
        return fault_set(fault, STATUS_NO_MEMORY, "no memory for parameters");
    for (size_t i = 0; i < m->parameter_count; i++)
        names[i] = m->parameters[i].name;
    const char *near = schema_nearest(name, names, m->parameter_count);
    fault_add(fault, STATUS_BAD_INPUT, "%s: %.80s: no such parameter of %s%s%s%s", place, name,
              m->name, near ? "; did you mean '" : "", near ? near : "", near ? "'?" : "");
    free(names);
    return STATUS_BAD_INPUT;
}

static enum status read_setting(const struct model *m, const char *setting, struct parameter_set *p,
                                struct fault *fault) {
    const char *equals = strchr(setting, '=');
    char name[128], place[160];
    if (equals == NULL || equals == setting || (size_t)(equals - setting) >= sizeof name)
        return fault_add(fault, STATUS_BAD_INPUT, "--set %.80s: name=value is needed", setting);
    snprintf(name, sizeof name, "%.*s", (int)(equals - setting), setting);
    snprintf(place, sizeof place, "--set %s", name);
    size_t i = find(p, name);
    if (i == p->count)
        return unknown(m, "--set", name, fault);
    return set_text(p, i, equals + 1, place, fault);
}

static enum status read_node(const struct model *m, const struct yaml_node *n,
                             struct parameter_set *p, struct fault *fault) {
    size_t i = find(p, n->key);
    if (i < p->count)
        return set_value(p, i, n, NULL, fault);
    char place[512];
    snprintf(place, sizeof place, "%.400s:%zu:%zu", n->file, n->key_line, n->key_column);
    return unknown(m, place, n->key, fault);
}

static enum status allocate(const struct model *m, struct parameter_set *p, struct fault *fault) {
    size_t room = m->parameter_count + 1;
    *p = (struct parameter_set){.table = m->parameters, .count = m->parameter_count};
    p->real = calloc(room, sizeof *p->real);
    p->list = calloc(room, sizeof *p->list);
    p->length = calloc(room, sizeof *p->length);
    p->place = calloc(room, sizeof *p->place);
    if (p->real == NULL || p->list == NULL || p->length == NULL || p->place == NULL) {
        parameters_free(p);
        return fault_set(fault, STATUS_NO_MEMORY, "no memory for parameters");
    }
    return STATUS_OK;
}

enum status parameters_read(const struct model *m, const struct yaml_node *map,
                            const char *const *settings, size_t setting_count,
                            struct parameter_set *out, struct fault *fault) {
    enum status status = allocate(m, out, fault), found;
    if (status != STATUS_OK)
        return status;
    for (size_t i = 0; i < out->count; i++)
        if ((found = set_text(out, i, m->parameters[i].standard, "default", fault)) != STATUS_OK)
            status = found;
    for (size_t i = 0; map != NULL && i < map->count; i++)
        if ((found = read_node(m, &map->child[i], out, fault)) != STATUS_OK)
            status = found;
    for (size_t i = 0; i < setting_count; i++)
        if ((found = read_setting(m, settings[i], out, fault)) != STATUS_OK)
            status = found;
    if (status != STATUS_OK)
        parameters_free(out);
    return status;
}

void parameters_free(struct parameter_set *p) {
    for (size_t i = 0; i < p->count; i++) {
        if (p->list != NULL)
            free(p->list[i]);
        if (p->place != NULL)
            free((char *)p->place[i]);
    }
    free(p->real);
    free(p->list);
    free(p->length);
    free(p->place);
    *p = (struct parameter_set){0};
}
