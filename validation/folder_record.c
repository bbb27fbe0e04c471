/* folder_record.c -- DIR/bedcheck.yaml, written and read. */
#include "validation/folder.h"

#include "common/file.h"
#include "common/schema.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_RECORD_BYTES = 1 << 20 };

static const struct schema_field fields[] = {
    {"format", SCHEMA_TEXT, true, 0, 0, NULL},
    {"cases_folder", SCHEMA_TEXT, true, 0, 0, NULL},
    {"references_folder", SCHEMA_TEXT, false, 0, 0, NULL},
    {"tier", SCHEMA_TEXT, true, 0, 0, NULL},
    {"started", SCHEMA_TEXT, true, 0, 0, NULL},
    {"solver", SCHEMA_TEXT, true, 0, 0, NULL},
    {"solver_key", SCHEMA_TEXT, true, 0, 0, NULL},
    {"seed_offset", SCHEMA_INTEGER, true, 0, 1e15, NULL},
    {"seeds", SCHEMA_INTEGER, false, 0, 1e6, NULL},
    {"settings", SCHEMA_LIST, true, 0, 0, NULL},
    {"cases", SCHEMA_LIST, true, 0, 0, NULL},
};

static const struct schema_field case_fields[] = {{"case", SCHEMA_TEXT, true, 0, 0, NULL},
                                                  {"skipped", SCHEMA_TEXT, true, 0, 0, NULL}};

static void write_quoted(FILE *out, const char *text) {
    fputc('"', out);
    for (const char *p = text; *p != '\0'; p++) {
        if ((unsigned char)*p < ' ' || *p == 127)
            fprintf(out, "\\x%02x", (unsigned)(unsigned char)*p);
        else
            fprintf(out, "%s%c", *p == '"' || *p == '\\' ? "\\" : "", *p);
    }
    fputc('"', out);
}

static void write_pair(FILE *out, const char *key, const char *value) {
    fprintf(out, "%s: ", key);
    write_quoted(out, value);
    fputc('\n', out);
}

enum status folder_write_record(const struct folder *f, const struct folder_record *r,
                                struct fault *fault) {
    char *text = NULL, *path = file_join(folder_path(f), "bedcheck.yaml");
    size_t length = 0;
    FILE *out = path == NULL ? NULL : open_memstream(&text, &length);
    enum status status = STATUS_OK;
    if (out == NULL) {
        status = fault_set(fault, STATUS_NO_MEMORY, "%s: out of memory", folder_path(f));
        goto end;
    }
    fputs("# What bedcheck was asked for in this folder.\nformat: bedcheck-results 1\n", out);
    write_pair(out, "cases_folder", r->cases_folder);
    if (r->references_folder != NULL)
        write_pair(out, "references_folder", r->references_folder);
    write_pair(out, "tier", r->tier);
    write_pair(out, "started", r->started);
    write_pair(out, "solver", r->solver);
    write_pair(out, "solver_key", r->solver_key);
    fprintf(out, "seed_offset: %lld\nseeds: %zu\nsettings: [", r->seed_offset, r->seed_count);
    for (size_t i = 0; i < r->setting_count; i++) {
        fputs(i == 0 ? "" : ", ", out);
        write_quoted(out, r->setting[i]);
    }
    fputs("]\ncases:\n", out);
    for (size_t i = 0; i < r->case_count; i++) {
        fprintf(out, "  - {case: %s, skipped: ", r->case_name[i]);
        write_quoted(out, r->skip_reason[i]);
        fputs("}\n", out);
    }
    status = fclose(out) == 0 ? file_write(path, text, length, fault)
                              : fault_set(fault, STATUS_NO_MEMORY, "%s: out of memory", path);
end:
    free(text);
    free(path);
    return status;
}

static const char *text_of(struct arena *a, const struct yaml_node *root, const char *key) {
    return arena_copy(a, yaml_get(root, key)->text);
}

static enum status read_cases(const struct yaml_node *list, struct folder_record *out,
                              struct fault *fault) {
    const char **name = arena_take(&out->arena, list->count, sizeof *name);
    const char **skip = arena_take(&out->arena, list->count, sizeof *skip);
    if (name == NULL || skip == NULL)
        return fault_set(fault, STATUS_NO_MEMORY, "%s: out of memory", list->file);
    out->case_name = name;
    out->skip_reason = skip;
    for (size_t i = 0; i < list->count; i++) {
        const struct yaml_node *n = &list->child[i];
        if (schema_check(n, "case", case_fields, 2, fault) != STATUS_OK)
            return fault->status;
        name[i] = text_of(&out->arena, n, "case");
        skip[i] = text_of(&out->arena, n, "skipped");
        if (name[i] == NULL || skip[i] == NULL)
            return fault_set(fault, STATUS_NO_MEMORY, "%s: out of memory", list->file);
        if (!case_name_is_safe(name[i]))
            return yaml_fault(n, fault, "case: %s is no name of a case", name[i]);
    }
    out->case_count = list->count;
    return STATUS_OK;
}

static enum status read_settings(const struct yaml_node *list, struct folder_record *out,
                                 struct fault *fault) {
    const char **setting = arena_take(&out->arena, list->count, sizeof *setting);
    if (setting == NULL)
        return fault_set(fault, STATUS_NO_MEMORY, "%s: out of memory", list->file);
    out->setting = setting;
    out->setting_count = list->count;
    for (size_t i = 0; i < list->count; i++) {
        if (list->child[i].kind != YAML_SCALAR)
            return yaml_fault(&list->child[i], fault, "settings: not a text");
        setting[i] = arena_copy(&out->arena, list->child[i].text);
        if (setting[i] == NULL)
            return fault_set(fault, STATUS_NO_MEMORY, "%s: out of memory", list->file);
    }
    return STATUS_OK;
}

/* What records of earlier versions do not have. */
static enum status read_additions(const struct yaml_node *root, struct folder_record *out,
                                  struct fault *fault) {
    const struct yaml_node *references = yaml_get(root, "references_folder");
    const struct yaml_node *seeds = yaml_get(root, "seeds");
    long long count = 0;
    if (references != NULL) {
        out->references_folder = arena_copy(&out->arena, references->text);
        if (out->references_folder == NULL)
            return fault_set(fault, STATUS_NO_MEMORY, "%s: out of memory", root->file);
    }
    enum status status = seeds == NULL ? STATUS_OK : yaml_integer(seeds, &count, fault);
    out->seed_count = (size_t)count;
    return status;
}

static enum status read_record(const struct yaml_node *root, struct folder_record *out,
                               struct fault *fault) {
    if (schema_check(root, "record", fields, sizeof fields / sizeof *fields, fault) != STATUS_OK)
        return fault->status;
    if (strcmp(yaml_get(root, "format")->text, "bedcheck-results 1") != 0)
        return yaml_fault(root, fault, "format: not a record of this version");
    out->cases_folder = text_of(&out->arena, root, "cases_folder");
    out->tier = text_of(&out->arena, root, "tier");
    out->started = text_of(&out->arena, root, "started");
    out->solver = text_of(&out->arena, root, "solver");
    out->solver_key = text_of(&out->arena, root, "solver_key");
    if (out->cases_folder == NULL || out->tier == NULL || out->started == NULL ||
        out->solver == NULL || out->solver_key == NULL)
        return fault_set(fault, STATUS_NO_MEMORY, "%s: out of memory", root->file);
    enum status status = yaml_integer(yaml_get(root, "seed_offset"), &out->seed_offset, fault);
    if (status == STATUS_OK)
        status = read_additions(root, out, fault);
    if (status == STATUS_OK)
        status = read_settings(yaml_get(root, "settings"), out, fault);
    return status == STATUS_OK ? read_cases(yaml_get(root, "cases"), out, fault) : status;
}

enum status folder_read_record(const struct folder *f, struct folder_record *out,
                               struct fault *fault) {
    *out = (struct folder_record){0};
    struct yaml_document *d = NULL;
    char *path = file_join(folder_path(f), "bedcheck.yaml");
    if (path == NULL)
        return fault_set(fault, STATUS_NO_MEMORY, "%s: out of memory", folder_path(f));
    enum status status = yaml_load(path, MAX_RECORD_BYTES, &d, fault);
    if (status == STATUS_OK)
        status = read_record(yaml_root(d), out, fault);
    yaml_free(d);
    free(path);
    if (status != STATUS_OK)
        folder_record_free(out);
    return status;
}

void folder_record_free(struct folder_record *r) {
    arena_free(&r->arena);
    *r = (struct folder_record){0};
}
