/* table.c -- see table.h. */
#include "validation/table.h"

#include "common/file.h"
#include "common/schema.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

struct reader {
    const struct table_form *form;
    struct table_place at;
    table_take *take;
    void *owner;
    const char *before; /* the line above, or NULL */
};

static enum status no_memory(const struct table_place *at) {
    return fault_set(at->fault, STATUS_NO_MEMORY, "%s: out of memory", at->path);
}

/* -- refusing ------------------------------------------------------------------------- */

bool table_refuse(const struct table_place *at, const char *column, const char *text,
                  const char *why) {
    fault_add(at->fault, STATUS_BAD_INPUT, "%s:%zu: %s: \"%s\" %s", at->path, at->line, column,
              text, why);
    return false;
}

bool table_refuse_name(const struct table_place *at, const char *column, const char *text,
                       const char *const *name, size_t count) {
    const char *near = schema_nearest(text, name, count);
    char why[256];
    snprintf(why, sizeof why, "is no such %s%s%s%s", column, near == NULL ? "" : "; did you mean '",
             near == NULL ? "" : near, near == NULL ? "" : "'?");
    return table_refuse(at, column, text, why);
}

bool table_is_hex(const char *text, size_t digits) {
    return strlen(text) == digits && strspn(text, "0123456789abcdef") == digits;
}

/* -- one line ------------------------------------------------------------------------- */

/* Cut at tabs; how many fields there are, at most TABLE_COLUMNS_MAX of them in field[]. */
static size_t split(char *line, char **field) {
    size_t count = 0;
    for (char *next = line; next != NULL; count++) {
        char *here = next;
        next = strchr(here, '\t');
        if (next != NULL)
            *next++ = '\0';
        if (count < TABLE_COLUMNS_MAX)
            field[count] = here;
    }
    return count;
}

static bool is_clean(const char *line) {
    for (const char *p = line; *p != '\0'; p++) {
        if (((unsigned char)*p < ' ' && *p != '\t') || *p == 127)
            return false;
    }
    return true;
}

static bool is_of_a_merge(const char *line) {
    return strncmp(line, "<<<<<<<", 7) == 0 || strncmp(line, ">>>>>>>", 7) == 0 ||
           strcmp(line, "=======") == 0;
}

static void check_order(struct reader *r, const char *line) {
    int order = r->before == NULL ? -1 : strcmp(r->before, line);
    if (order >= 0)
        fault_add(r->at.fault, STATUS_BAD_INPUT, "%s:%zu: %s line %zu: sort with LC_ALL=C",
                  r->at.path, r->at.line, order == 0 ? "the same as" : "belongs before",
                  r->at.line - 1);
    r->before = line;
}

static enum status read_line(struct reader *r, char *line) {
    char *field[TABLE_COLUMNS_MAX];
    const struct table_place *at = &r->at;
    const char *whole = arena_copy(at->arena, line);
    if (whole == NULL)
        return no_memory(at);
    check_order(r, whole);
    if (is_of_a_merge(line))
        return fault_add(at->fault, STATUS_BAD_INPUT, "%s:%zu: a merge conflict is not solved",
                         at->path, at->line);
    if (!is_clean(line))
        return fault_add(at->fault, STATUS_BAD_INPUT, "%s:%zu: a control character", at->path,
                         at->line);
    size_t columns = split(line, field);
    if (columns != r->form->columns)
        return fault_add(at->fault, STATUS_BAD_INPUT, "%s:%zu: %zu columns, must be %zu", at->path,
                         at->line, columns, r->form->columns);
    return r->take(r->owner, at, field, whole);
}

/* -- the table ------------------------------------------------------------------------ */

static void write_header(const struct table_form *form, FILE *out) {
    for (size_t i = 0; i < form->columns; i++)
        fprintf(out, "%s%c", form->column[i], i + 1 == form->columns ? '\n' : '\t');
}

static bool is_header(const struct table_form *form, const char *line) {
    for (size_t i = 0; i < form->columns; i++) {
        size_t length = strlen(form->column[i]);
        if (strncmp(line, form->column[i], length) != 0 ||
            line[length] != (i + 1 == form->columns ? '\0' : '\t'))
            return false;
        line += length + 1;
    }
    return true;
}

static enum status read_lines(struct reader *r, char *text) {
    bool headed = false;
    for (char *line = text, *next; *line != '\0'; line = next) {
        next = strchr(line, '\n');
        *next++ = '\0';
        r->at.line++;
        if (!headed && *line == '#')
            continue;
        if (headed) {
            if (read_line(r, line) == STATUS_NO_MEMORY)
                return STATUS_NO_MEMORY;
        } else if (!is_header(r->form, line)) {
            return fault_set(r->at.fault, STATUS_BAD_INPUT,
                             "%s:%zu: not the header of a table of %s", r->at.path, r->at.line,
                             r->form->what);
        }
        headed = true;
    }
    if (!headed)
        fault_add(r->at.fault, STATUS_BAD_INPUT, "%s: no header", r->at.path);
    return r->at.fault->status;
}

enum status table_read(const struct table_form *form, const struct table_place *from,
                       const char *text, table_take *take, void *owner) {
    struct fault found = FAULT_NONE;
    struct reader r = {form, *from, take, owner, NULL};
    char *own = arena_copy(from->arena, text);
    enum status status = STATUS_OK;
    r.at.fault = &found;
    if (own == NULL)
        status = no_memory(&r.at);
    else if (*own == '\0' || own[strlen(own) - 1] != '\n')
        status =
            fault_set(&found, STATUS_BAD_INPUT, "%s: does not end in a whole line", from->path);
    else
        status = read_lines(&r, own);
    if (status != STATUS_OK)
        *from->fault = found;
    return status;
}

enum status table_load(const struct table_form *form, const struct table_place *from,
                       table_take *take, void *owner) {
    char *text = NULL;
    size_t length = 0;
    enum status status = file_read(from->path, form->max_bytes, &text, &length, from->fault);
    if (status == STATUS_OK && strlen(text) != length)
        status = fault_set(from->fault, STATUS_BAD_INPUT, "%s: is not a text", from->path);
    if (status == STATUS_OK)
        status = table_read(form, from, text, take, owner);
    free(text);
    return status;
}

/* -- writing -------------------------------------------------------------------------- */

static int by_text(const void *a, const void *b) {
    return strcmp(*(const char *const *)a, *(const char *const *)b);
}

static bool are_whole(const char *const *line, size_t count) {
    for (size_t i = 0; i < count; i++)
        if (line[i] == NULL)
            return false;
    return true;
}

enum status table_write(const struct table_form *form, const char *path, const char **line,
                        size_t count, char **out, struct fault *fault) {
    size_t length = 0;
    FILE *stream = NULL;
    *out = NULL;
    if (line != NULL && are_whole(line, count))
        stream = open_memstream(out, &length);
    if (stream != NULL) {
        if (count > 0)
            qsort(line, count, sizeof *line, by_text);
        fputs(form->comment, stream);
        write_header(form, stream);
        for (size_t i = 0; i < count; i++)
            fprintf(stream, "%s\n", line[i]);
        if (fclose(stream) == 0)
            return STATUS_OK;
        free(*out);
        *out = NULL;
    }
    return fault_set(fault, STATUS_NO_MEMORY, "%s: out of memory", path);
}
