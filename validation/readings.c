#include "validation/readings.h"

#include "common/schema.h"
#include "validation/case.h"

#include <dirent.h>
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

struct readings {
    struct yaml_document *document;
    const struct yaml_node *map;
};

static const struct schema_field file_fields[] = {{"model", SCHEMA_TEXT, true, 0, 0, NULL},
                                                  {"readings", SCHEMA_MAP, true, 0, 0, NULL}};
static const struct schema_field reading_fields[] = {{"title", SCHEMA_TEXT, true, 0, 0, NULL},
                                                     {"because", SCHEMA_TEXT, true, 0, 0, NULL},
                                                     {"parameters", SCHEMA_MAP, true, 0, 0, NULL}};

static bool is_blank(const char *text) {
    return text[strspn(text, " \t\n")] == '\0';
}

static void check_parameters(const struct yaml_node *map, struct fault *fault) {
    for (size_t i = 0; i < map->count; i++) {
        const struct yaml_node *n = &map->child[i];
        if (strcmp(n->key, "reading") == 0)
            yaml_fault(n, fault, "reading: a reading cannot name another");
        else if (!case_parameter_name_is_good(n->key))
            yaml_fault(n, fault, "%s: not a name of a parameter", n->key);
        if (!case_value_is_good(n))
            yaml_fault(n, fault, "%s: must be a value or a list of values", n->key);
    }
}

static void check_reading(const struct yaml_node *n, struct fault *fault) {
    static const char *const text[] = {"title", "because"};
    if (strchr(n->key, '/') != NULL || !case_name_is_safe(n->key))
        yaml_fault(n, fault, "reading %s: a name has lower-case letters, digits, - and _", n->key);
    if (n->kind != YAML_MAP) {
        yaml_fault(n, fault, "reading %s: must be {title: , because: , parameters: }", n->key);
        return;
    }
    if (schema_check(n, "reading", reading_fields, 3, fault) != STATUS_OK)
        return;
    for (size_t i = 0; i < 2; i++) {
        if (is_blank(yaml_get(n, text[i])->text))
            yaml_fault(yaml_get(n, text[i]), fault, "%s: must not be empty", text[i]);
    }
    check_parameters(yaml_get(n, "parameters"), fault);
}

static void check_file(const struct yaml_node *root, const char *model, struct fault *fault) {
    if (root->kind != YAML_MAP) {
        yaml_fault(root, fault, "readings: must be {model: NAME, readings: {...}}");
        return;
    }
    if (schema_check(root, "file of readings", file_fields, 2, fault) != STATUS_OK)
        return;
    const struct yaml_node *said = yaml_get(root, "model"), *map = yaml_get(root, "readings");
    if (strcmp(said->text, model) != 0)
        yaml_fault(said, fault, "model: %s, but the file must hold the readings of %s", said->text,
                   model);
    if (map->count == 0)
        yaml_fault(map, fault, "readings: none");
    for (size_t i = 0; i < map->count; i++)
        check_reading(&map->child[i], fault);
}

enum status readings_load(const char *folder, const char *model, struct readings **out,
                          struct fault *fault) {
    char *path = NULL;
    struct fault found = FAULT_NONE;
    *out = NULL;
    struct readings *r = calloc(1, sizeof *r);
    if (r == NULL || asprintf(&path, "%s/readings/%s.yaml", folder, model) < 0) {
        free(r);
        return fault_set(fault, STATUS_NO_MEMORY, "readings: out of memory");
    }
    if (yaml_load(path, YAML_CASE_MAX_BYTES, &r->document, &found) == STATUS_OK) {
        check_file(yaml_root(r->document), model, &found);
        r->map = yaml_get(yaml_root(r->document), "readings");
    }
    free(path);
    if (found.status == STATUS_OK) {
        *out = r;
        return STATUS_OK;
    }
    readings_free(r);
    *fault = found;
    return found.status;
}

void readings_free(struct readings *r) {
    if (r == NULL)
        return;
    yaml_free(r->document);
    free(r);
}

/* One file of the folder; findings are added to fault. */
static void check_one(const char *folder, const char *file, struct fault *fault) {
    char model[256];
    struct readings *r = NULL;
    struct fault found = FAULT_NONE;
    size_t length = strlen(file), stem = length < 5 ? 0 : length - 5;
    snprintf(model, sizeof model, "%.*s", (int)stem, file);
    if (strcmp(file + stem, ".yaml") != 0 || strchr(model, '/') != NULL ||
        !case_name_is_safe(model))
        fault_add(&found, STATUS_BAD_INPUT,
                  "%s/readings/%s: not MODEL.yaml; this folder is for readings alone", folder,
                  file);
    else
        readings_load(folder, model, &r, &found);
    readings_free(r);
    for (const char *line = found.text; found.status != STATUS_OK && *line != '\0';) {
        size_t end = strcspn(line, "\n");
        fault_add(fault, found.status, "%.*s", (int)end, line);
        line += end + (line[end] == '\n');
    }
}

enum status readings_check_folder(const char *folder, struct fault *fault) {
    char *path = NULL;
    if (asprintf(&path, "%s/readings", folder) < 0)
        return fault_set(fault, STATUS_NO_MEMORY, "readings: out of memory");
    DIR *d = opendir(path);
    if (d == NULL && errno != ENOENT)
        fault_add(fault, STATUS_IO, "%s: cannot be read: %s", path, strerror(errno));
    for (struct dirent *e; d != NULL && (e = readdir(d)) != NULL;) {
        if (e->d_name[0] != '.')
            check_one(folder, e->d_name, fault);
    }
    if (d != NULL)
        closedir(d);
    free(path);
    return fault->status;
}

const struct yaml_node *readings_all(const struct readings *r) {
    return r->map;
}

const struct yaml_node *readings_parameters(const struct readings *r, const char *name) {
    const struct yaml_node *n = yaml_get(r->map, name);
    return n == NULL ? NULL : yaml_get(n, "parameters");
}
