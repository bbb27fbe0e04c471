#include "validation/bits.h"

#include "common/file.h"
#include "common/h5.h"
#include "common/yaml.h"
#include "validation/arena.h"

#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_RECORD_BYTES = 1 << 20 };
static const size_t MAX_VALUES = (size_t)1 << 28; /* 2 GiB of doubles: more than any case writes */

static int by_text(const void *a, const void *b) {
    return strcmp(*(const char *const *)a, *(const char *const *)b);
}

/* Doubles as 8 bytes each, the low one first, in place. */
static void order_bytes(double *value, size_t count) {
    for (size_t i = 0; i < count; i++) {
        uint64_t word;
        unsigned char byte[sizeof word];
        memcpy(&word, &value[i], sizeof word);
        for (size_t k = 0; k < sizeof word; k++)
            byte[k] = (unsigned char)(word >> (8 * k) & 0xff);
        memcpy(&value[i], byte, sizeof word);
    }
}

/* "fields/porosity/value 3x7x9 HEX" */
static enum status digest_dataset(struct h5_reader *r, const char *name, struct arena *a,
                                  const char **out, struct fault *fault) {
    int rank = 0;
    size_t dims[H5_MAX_RANK] = {0}, count = 0;
    double *value = NULL;
    struct digest d;
    enum status status = h5_dims(r, name, &rank, dims, fault);
    if (status == STATUS_OK)
        status = h5_read(r, name, MAX_VALUES, &value, &count, fault);
    if (status != STATUS_OK)
        return status;
    order_bytes(value, count);
    digest_bytes(value, count * sizeof *value, &d);
    free(value);
    const char *text = arena_text(a, "%s ", name);
    for (int i = 0; i < rank && text != NULL; i++)
        text = arena_text(a, "%s%s%zu", text, i == 0 ? "" : "x", dims[i]);
    *out = text == NULL ? NULL : arena_text(a, "%s %s", text, d.hex);
    return *out == NULL ? fault_set(fault, STATUS_NO_MEMORY, "bits: out of memory") : STATUS_OK;
}

/* A time series gives three texts, a fixed dataset one. */
static enum status digest_name(struct h5_reader *r, const char *name, struct arena *a,
                               const char **text, size_t *count, struct fault *fault) {
    static const char *const part[] = {"step", "time", "value"};
    const char *value = arena_text(a, "%s/value", name);
    if (value == NULL)
        return fault_set(fault, STATUS_NO_MEMORY, "bits: out of memory");
    if (!h5_has(r, value))
        return digest_dataset(r, name, a, &text[(*count)++], fault);
    enum status status = STATUS_OK;
    for (size_t i = 0; status == STATUS_OK && i < 3; i++) {
        const char *path = arena_text(a, "%s/%s", name, part[i]);
        status = path == NULL ? fault_set(fault, STATUS_NO_MEMORY, "bits: out of memory")
                              : digest_dataset(r, path, a, &text[(*count)++], fault);
    }
    return status;
}

enum status bits_of_result(const char *result_path, const char *const *dataset, size_t count,
                           struct digest *out, struct fault *fault) {
    struct arena a = {0};
    struct h5_reader *r = NULL;
    const char **name = arena_take(&a, count, sizeof *name);
    const char **text = arena_take(&a, 3 * count, sizeof *text);
    size_t texts = 0;
    enum status status = name == NULL || text == NULL
                             ? fault_set(fault, STATUS_NO_MEMORY, "bits: out of memory")
                             : h5_open(result_path, &r, fault);
    if (status == STATUS_OK && count > 0) {
        memcpy(name, dataset, count * sizeof *name);
        qsort(name, count, sizeof *name, by_text);
    }
    for (size_t i = 0; status == STATUS_OK && i < count; i++)
        status = digest_name(r, name[i], &a, text, &texts, fault);
    if (status == STATUS_OK)
        digest_texts(text, texts, out);
    h5_close(r);
    arena_free(&a);
    return status;
}

/* -- class of build ------------------------------------------------------------------ */

static void copy_word(const struct yaml_node *build, const char *key, char *out, size_t size) {
    const struct yaml_node *n = build == NULL ? NULL : yaml_get(build, key);
    bool good = n != NULL && n->kind == YAML_SCALAR && *n->text != '\0';
    snprintf(out, size, "%s", good ? n->text : "unknown");
    for (char *p = out; *p != '\0'; p++)
        *p = (unsigned char)*p <= ' ' || *p == 127 || *p == ':' || *p == '/' ? '-' : *p;
}

/* "gcc 12.2.0" -> "gcc-12" */
static void name_compiler(const struct yaml_node *build, char *out, size_t size) {
    copy_word(build, "compiler", out, size);
    out[strcspn(out, ".")] = '\0';
}

/* Flags that change arithmetic or say for which machine: not paths, warnings, or debugging. */
static void name_flags(const struct yaml_node *build, char *out, size_t size) {
    const struct yaml_node *n = build == NULL ? NULL : yaml_get(build, "flags");
    size_t length = 0;
    snprintf(out, size, "unknown");
    if (n == NULL || n->kind != YAML_SCALAR)
        return;
    snprintf(out, size, "plain");
    for (const char *p = n->text + strspn(n->text, " "); *p != '\0'; p += strspn(p, " ")) {
        size_t word = strcspn(p, " ");
        bool counts = strncmp(p, "-O", 2) == 0 || strncmp(p, "-m", 2) == 0 ||
                      (strncmp(p, "-f", 2) == 0 && memchr(p, '/', word) == NULL &&
                       strncmp(p, "-fno-omit-frame-pointer", word) != 0);
        if (counts && length + word + 2 < size)
            length += (size_t)snprintf(out + length, size - length, "%s%.*s",
                                       length == 0 ? "" : ",", (int)word, p);
        p += word;
    }
}

static void describe(const struct yaml_node *build, struct bits_build *out) {
    char compiler[32], flags[96], machine[24], library[64];
    copy_word(build, "commit", out->commit, sizeof out->commit);
    copy_word(build, "dirty", out->dirty, sizeof out->dirty);
    name_compiler(build, compiler, sizeof compiler);
    name_flags(build, flags, sizeof flags);
    copy_word(build, "machine", machine, sizeof machine);
    copy_word(build, "libc", library, sizeof library);
    snprintf(out->name, sizeof out->name, "%s/%s/%s/%s", compiler, flags, machine, library);
    for (char *p = out->name; *p != '\0'; p++)
        *p = (unsigned char)*p <= ' ' || *p == 127 || *p == ':' ? '-' : *p;
}

enum status bits_read_build(const char *record_path, struct bits_build *out, struct fault *fault) {
    struct yaml_document *d = NULL;
    const struct yaml_node *build = NULL;
    enum status status = STATUS_OK;
    if (file_exists(record_path))
        status = yaml_load(record_path, MAX_RECORD_BYTES, &d, fault);
    if (d != NULL && yaml_root(d)->kind == YAML_MAP)
        build = yaml_get(yaml_root(d), "build");
    describe(build != NULL && build->kind == YAML_MAP ? build : NULL, out);
    yaml_free(d);
    return status;
}
