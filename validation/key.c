#include "validation/key.h"

#include "common/file.h"
#include "common/schema.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

enum { FIXED_TEXTS = 5, MAX_RECORD_BYTES = 1 << 16 };

enum status key_make(const struct key_parts *parts, struct digest *out, struct fault *fault) {
    const char **text = malloc((FIXED_TEXTS + parts->setting_count) * sizeof *text);
    if (text == NULL)
        return fault_set(fault, STATUS_NO_MEMORY, "key: out of memory");
    char seed[32];
    snprintf(seed, sizeof seed, "%lld", parts->seed);
    text[0] = "bedcheck-key 1";
    text[1] = parts->meaning;
    text[2] = seed;
    text[3] = parts->start == NULL ? "none" : parts->start;
    text[4] = parts->solver;
    for (size_t i = 0; i < parts->setting_count; i++)
        text[FIXED_TEXTS + i] = parts->settings[i];
    digest_texts(text, FIXED_TEXTS + parts->setting_count, out);
    free(text);
    return STATUS_OK;
}

/* Quoted, on one line. */
static void write_quoted(FILE *out, const char *text) {
    fputc('"', out);
    for (const char *p = text; *p != '\0'; p++) {
        if (*p == '"' || *p == '\\')
            fputc('\\', out);
        fputc((unsigned char)*p < ' ' || *p == 127 ? ' ' : *p, out);
    }
    fputc('"', out);
}

enum status key_write(const char *path, const struct key_record *r, struct fault *fault) {
    char *text = NULL;
    size_t length = 0;
    FILE *out = open_memstream(&text, &length);
    if (out == NULL)
        return fault_set(fault, STATUS_NO_MEMORY, "%s: out of memory", path);
    fprintf(out, "format: bedcheck-key 1\nkey: %s\nsolver: %s\nseconds: %.6g\nbytes: %.15g\n",
            r->key, r->solver, r->seconds, r->bytes);
    fputs("failure: ", out);
    write_quoted(out, r->failure);
    fputc('\n', out);
    enum status status = fclose(out) == 0
                             ? file_write(path, text, length, fault)
                             : fault_set(fault, STATUS_NO_MEMORY, "%s: out of memory", path);
    free(text);
    return status;
}

static bool is_digest(const char *text) {
    return strlen(text) == DIGEST_SIZE - 1 && strspn(text, "0123456789abcdef") == DIGEST_SIZE - 1;
}

enum status key_read(const char *path, struct key_record *out, struct fault *fault) {
    static const struct schema_field field[] = {
        {"format", SCHEMA_TEXT, true, 0, 0, NULL},   {"key", SCHEMA_TEXT, true, 0, 0, NULL},
        {"solver", SCHEMA_TEXT, true, 0, 0, NULL},   {"seconds", SCHEMA_REAL, true, 0, 1e12, NULL},
        {"bytes", SCHEMA_REAL, true, 0, 1e18, NULL}, {"failure", SCHEMA_TEXT, true, 0, 0, NULL}};
    struct yaml_document *d = NULL;
    enum status status = yaml_load(path, MAX_RECORD_BYTES, &d, fault);
    if (status != STATUS_OK)
        return status;
    const struct yaml_node *root = yaml_root(d);
    status = schema_check(root, "key", field, sizeof field / sizeof *field, fault);
    if (status == STATUS_OK && strcmp(yaml_get(root, "format")->text, "bedcheck-key 1") != 0)
        status = yaml_fault(root, fault, "format: not a key of this version");
    if (status == STATUS_OK &&
        (!is_digest(yaml_get(root, "key")->text) || !is_digest(yaml_get(root, "solver")->text)))
        status = yaml_fault(root, fault, "key, solver: not 64 hex digits");
    if (status == STATUS_OK) {
        memcpy(out->key, yaml_get(root, "key")->text, DIGEST_SIZE);
        memcpy(out->solver, yaml_get(root, "solver")->text, DIGEST_SIZE);
        yaml_real(yaml_get(root, "seconds"), &out->seconds, fault);
        yaml_real(yaml_get(root, "bytes"), &out->bytes, fault);
        snprintf(out->failure, sizeof out->failure, "%s", yaml_get(root, "failure")->text);
    }
    yaml_free(d);
    return status;
}

static bool is_program(const char *path) {
    struct stat about;
    return stat(path, &about) == 0 && S_ISREG(about.st_mode) && access(path, X_OK) == 0;
}

enum status key_find_program(const char *command, const char *path_list, char **out,
                             struct fault *fault) {
    *out = NULL;
    if (strchr(command, '/') != NULL) {
        if (is_program(command) && (*out = strdup(command)) == NULL)
            return fault_set(fault, STATUS_NO_MEMORY, "%s: out of memory", command);
    } else {
        for (const char *at = path_list; at != NULL && *out == NULL;) {
            size_t length = strcspn(at, ":");
            char *path = NULL;
            if (asprintf(&path, "%.*s/%s", length == 0 ? 1 : (int)length, length == 0 ? "." : at,
                         command) < 0)
                return fault_set(fault, STATUS_NO_MEMORY, "%s: out of memory", command);
            if (is_program(path))
                *out = path;
            else
                free(path);
            at = at[length] == ':' ? at + length + 1 : NULL;
        }
    }
    if (*out != NULL)
        return STATUS_OK;
    if (strchr(command, ' ') != NULL)
        return fault_set(fault, STATUS_NOT_FOUND,
                         "solver '%s': no such program; it must be one program without arguments: "
                         "put a longer command into a script",
                         command);
    return fault_set(fault, STATUS_NOT_FOUND, "solver '%s': no such program", command);
}
