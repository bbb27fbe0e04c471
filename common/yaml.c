/* yaml.c -- see yaml.h.  A recursive reader of libyaml's events; the depth limit bounds it. */
#include "common/yaml.h"

#include "common/file.h"

#include <assert.h>
#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <yaml.h>

/* The tree and its texts live in blocks that are freed together. */
struct block {
    struct block *next;
    max_align_t bytes[];
};

struct yaml_document {
    struct block *blocks;
    struct yaml_node root;
};

struct reader {
    yaml_parser_t parser;
    struct yaml_document *document;
    const char *file;
    struct fault *fault;
};

static void *take(struct yaml_document *d, size_t size) {
    struct block *b = malloc(sizeof *b + size);
    if (b == NULL)
        return NULL;
    b->next = d->blocks;
    d->blocks = b;
    return b->bytes;
}

static const char *keep(struct yaml_document *d, const void *text, size_t length) {
    char *copy = take(d, length + 1);
    if (copy != NULL) {
        memcpy(copy, text, length);
        copy[length] = '\0';
    }
    return copy;
}

static enum status fault_at(struct reader *r, yaml_mark_t mark, const char *message) {
    return fault_add(r->fault, STATUS_BAD_INPUT, "%s:%zu:%zu: %s", r->file, mark.line + 1,
                     mark.column + 1, message);
}

static enum status no_memory(struct reader *r) {
    return fault_set(r->fault, STATUS_NO_MEMORY, "%s: no memory", r->file);
}

/* Next event, to be deleted.  A fault of libyaml's ends the reading. */
static enum status next(struct reader *r, yaml_event_t *event) {
    if (yaml_parser_parse(&r->parser, event))
        return STATUS_OK;
    const yaml_parser_t *p = &r->parser;
    if (p->error == YAML_MEMORY_ERROR)
        return no_memory(r);
    if (p->error == YAML_READER_ERROR)
        return fault_add(r->fault, STATUS_BAD_INPUT, "%s:%zu:%zu: byte %zu: %s", r->file,
                         p->mark.line + 1, p->mark.column + 1, p->problem_offset, p->problem);
    return fault_add(r->fault, STATUS_BAD_INPUT, "%s:%zu:%zu: %s%s%s", r->file,
                     p->problem_mark.line + 1, p->problem_mark.column + 1,
                     p->context ? p->context : "", p->context ? ": " : "",
                     p->problem ? p->problem : "malformed");
}

static enum status read_scalar(struct reader *r, const yaml_event_t *event, struct yaml_node *n) {
    size_t length = event->data.scalar.length;
    const yaml_char_t *value = event->data.scalar.value;
    n->kind = YAML_SCALAR;
    n->quoted = event->data.scalar.style != YAML_PLAIN_SCALAR_STYLE;
    n->text = keep(r->document, value, length);
    if (n->text == NULL)
        return no_memory(r);
    if (memchr(value, '\0', length) != NULL)
        fault_at(r, event->start_mark, "a text must not hold a NUL");
    return STATUS_OK;
}

/* Children found so far; moved to the document when the container ends. */
struct children {
    struct yaml_node *child;
    size_t count, room;
};

static struct yaml_node *children_add(struct children *c) {
    if (c->count == c->room) {
        size_t room = c->room ? 2 * c->room : 8;
        struct yaml_node *grown = realloc(c->child, room * sizeof *grown);
        if (grown == NULL)
            return NULL;
        c->child = grown;
        c->room = room;
    }
    c->child[c->count] = (struct yaml_node){0};
    return &c->child[c->count++];
}

static enum status children_settle(struct reader *r, struct children *c, struct yaml_node *n) {
    n->child = take(r->document, (c->count + 1) * sizeof *n->child);
    if (n->child == NULL)
        return no_memory(r);
    if (c->count > 0)
        memcpy(n->child, c->child, c->count * sizeof *n->child);
    n->count = c->count;
    return STATUS_OK;
}

/* The event is a key: keep it in n, complain of one that is there already. */
static enum status read_key(struct reader *r, const yaml_event_t *event, const struct children *c,
                            struct yaml_node *n) {
    if (event->type != YAML_SCALAR_EVENT)
        return fault_at(r, event->start_mark, "a key must be plain text");
    if (event->data.scalar.anchor != NULL || event->data.scalar.tag != NULL)
        fault_at(r, event->start_mark, "anchors and tags are refused");
    const char *key = (const char *)event->data.scalar.value;
    if (*key == '\0' || strlen(key) != event->data.scalar.length)
        fault_at(r, event->start_mark, "a key must be plain text");
    n->key = keep(r->document, key, strlen(key));
    n->key_line = event->start_mark.line + 1;
    n->key_column = event->start_mark.column + 1;
    if (n->key == NULL)
        return no_memory(r);
    for (size_t i = 0; i + 1 < c->count; i++)
        if (strcmp(c->child[i].key, key) == 0) {
            fault_add(r->fault, STATUS_BAD_INPUT, "%s:%zu:%zu: %s: already given in line %zu",
                      r->file, n->key_line, n->key_column, key, c->child[i].key_line);
            break;
        }
    return STATUS_OK;
}

static enum status read_node(struct reader *r, const yaml_event_t *event, int depth,
                             struct yaml_node *n);

static enum status read_container(struct reader *r, bool map, int depth, struct yaml_node *n) {
    struct children c = {0};
    enum status status;
    n->kind = map ? YAML_MAP : YAML_LIST;
    for (;;) {
        yaml_event_t event;
        status = next(r, &event);
        if (status != STATUS_OK)
            break;
        if (event.type == YAML_MAPPING_END_EVENT || event.type == YAML_SEQUENCE_END_EVENT) {
            yaml_event_delete(&event);
            status = children_settle(r, &c, n);
            break;
        }
        struct yaml_node *child = children_add(&c);
        if (child == NULL)
            status = no_memory(r);
        if (status == STATUS_OK && map) {
            status = read_key(r, &event, &c, child);
            yaml_event_delete(&event);
            event = (yaml_event_t){0};
            if (status == STATUS_OK)
                status = next(r, &event);
        }
        if (status == STATUS_OK)
            status = read_node(r, &event, depth + 1, child);
        yaml_event_delete(&event);
        if (status != STATUS_OK)
            break;
    }
    free(c.child);
    return status;
}

/* A value that starts with this event.  `depth` counts the containers around it. */
static enum status read_node(struct reader *r, const yaml_event_t *event, int depth,
                             struct yaml_node *n) {
    n->file = r->file;
    n->line = event->start_mark.line + 1;
    n->column = event->start_mark.column + 1;
    const yaml_char_t *anchor = NULL, *tag = NULL;
    bool container = false, map = false;
    switch (event->type) {
    case YAML_SCALAR_EVENT:
        anchor = event->data.scalar.anchor;
        tag = event->data.scalar.tag;
        break;
    case YAML_SEQUENCE_START_EVENT:
        anchor = event->data.sequence_start.anchor;
        tag = event->data.sequence_start.tag;
        container = true;
        break;
    case YAML_MAPPING_START_EVENT:
        anchor = event->data.mapping_start.anchor;
        tag = event->data.mapping_start.tag;
        container = map = true;
        break;
    default: /* an alias: nothing is left to read of it */
        n->text = "";
        fault_at(r, event->start_mark, "aliases are refused");
        return STATUS_OK;
    }
    if (anchor != NULL)
        fault_at(r, event->start_mark, "anchors are refused");
    if (tag != NULL)
        fault_at(r, event->start_mark, "tags are refused");
    if (!container)
        return read_scalar(r, event, n);
    if (depth >= YAML_MAX_DEPTH)
        return fault_at(r, event->start_mark, "nested deeper than 8");
    return read_container(r, map, depth, n);
}

/* Stream start, one document, stream end. */
static enum status read_stream(struct reader *r) {
    yaml_event_t event;
    enum status status;
    bool seen = false;
    for (bool end = false; !end;) {
        status = next(r, &event);
        if (status != STATUS_OK)
            return status;
        switch (event.type) {
        case YAML_STREAM_END_EVENT:
            end = true;
            break;
        case YAML_STREAM_START_EVENT:
        case YAML_DOCUMENT_END_EVENT:
            break;
        case YAML_DOCUMENT_START_EVENT:
            if (seen) {
                status = fault_at(r, event.start_mark, "a second document is refused");
                end = true;
            }
            if (event.data.document_start.tag_directives.start !=
                event.data.document_start.tag_directives.end)
                fault_at(r, event.start_mark, "tags are refused");
            seen = true;
            break;
        default:
            status = read_node(r, &event, 0, &r->document->root);
            end = status != STATUS_OK;
        }
        yaml_event_delete(&event);
    }
    if (status == STATUS_OK && !seen)
        status = fault_add(r->fault, STATUS_BAD_INPUT, "%s:1:1: nothing in it", r->file);
    return status;
}

enum status yaml_parse(const char *name, const char *text, size_t length,
                       struct yaml_document **out, struct fault *fault) {
    *out = NULL;
    int before = fault->findings;
    struct yaml_document *d = calloc(1, sizeof *d);
    if (d == NULL)
        return fault_set(fault, STATUS_NO_MEMORY, "%s: no memory", name);
    struct reader r = {.document = d, .fault = fault, .file = keep(d, name, strlen(name))};
    enum status status;
    if (r.file == NULL || !yaml_parser_initialize(&r.parser)) {
        yaml_free(d);
        return fault_set(fault, STATUS_NO_MEMORY, "%s: no memory", name);
    }
    yaml_parser_set_encoding(&r.parser, YAML_UTF8_ENCODING);
    yaml_parser_set_input_string(&r.parser, (const unsigned char *)text, length);
    status = read_stream(&r);
    yaml_parser_delete(&r.parser);
    if (status == STATUS_OK && fault->findings > before)
        status = STATUS_BAD_INPUT;
    if (status != STATUS_OK) {
        yaml_free(d);
        return status;
    }
    *out = d;
    return STATUS_OK;
}

enum status yaml_load(const char *path, size_t max_bytes, struct yaml_document **out,
                      struct fault *fault) {
    char *text;
    size_t length;
    *out = NULL;
    enum status status = file_read(path, max_bytes, &text, &length, fault);
    if (status != STATUS_OK)
        return status;
    status = yaml_parse(path, text, length, out, fault);
    free(text);
    return status;
}

const struct yaml_node *yaml_root(const struct yaml_document *d) {
    return &d->root;
}

void yaml_free(struct yaml_document *d) {
    if (d == NULL)
        return;
    while (d->blocks != NULL) {
        struct block *b = d->blocks;
        d->blocks = b->next;
        free(b);
    }
    free(d);
}

const struct yaml_node *yaml_get(const struct yaml_node *map, const char *key) {
    if (map == NULL || map->kind != YAML_MAP)
        return NULL;
    for (size_t i = 0; i < map->count; i++)
        if (strcmp(map->child[i].key, key) == 0)
            return &map->child[i];
    return NULL;
}

enum status yaml_fault(const struct yaml_node *n, struct fault *fault, const char *format, ...) {
    char message[1024];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(message, sizeof message, format, arguments);
    va_end(arguments);
    fault_add(fault, STATUS_BAD_INPUT, "%s:%zu:%zu: %s", n->file, n->line, n->column, message);
    return STATUS_BAD_INPUT;
}

/* Complaint of a reader: "key: 'text' is not a number". */
static enum status value_fault(const struct yaml_node *n, struct fault *fault, const char *wanted) {
    const char *key = n->key ? n->key : "", *colon = n->key ? ": " : "";
    if (n->kind != YAML_SCALAR)
        return yaml_fault(n, fault, "%s%sa %s is not %s", key, colon,
                          n->kind == YAML_MAP ? "map" : "list", wanted);
    if (*n->text == '\0' && !n->quoted)
        return yaml_fault(n, fault, "%s%sno value: %s is needed", key, colon, wanted);
    return yaml_fault(n, fault, "%s%s%s'%.80s' is not %s", key, colon, n->quoted ? "quoted " : "",
                      n->text, wanted);
}

/* A plain scalar made of these characters only, and not empty. */
static bool made_of(const struct yaml_node *n, const char *characters) {
    return n->kind == YAML_SCALAR && !n->quoted && *n->text != '\0' &&
           n->text[strspn(n->text, characters)] == '\0';
}

enum status yaml_real(const struct yaml_node *n, double *out, struct fault *fault) {
    /* Only the characters of a decimal number: strtod would take "nan" and "0x1p3". */
    if (!made_of(n, "0123456789+-.eE"))
        return value_fault(n, fault, "a number");
    char *end;
    errno = 0;
    double value = strtod(n->text, &end);
    if (end == n->text || *end != '\0')
        return value_fault(n, fault, "a number");
    if (!isfinite(value) || (errno == ERANGE && value == 0))
        return value_fault(n, fault, "a number that a double can hold");
    *out = value;
    return STATUS_OK;
}

enum status yaml_integer(const struct yaml_node *n, long long *out, struct fault *fault) {
    if (!made_of(n, "0123456789+-"))
        return value_fault(n, fault, "an integer");
    char *end;
    errno = 0;
    long long value = strtoll(n->text, &end, 10);
    if (end == n->text || *end != '\0')
        return value_fault(n, fault, "an integer");
    if (errno == ERANGE)
        return value_fault(n, fault, "an integer that 64 bits can hold");
    *out = value;
    return STATUS_OK;
}

enum status yaml_boolean(const struct yaml_node *n, bool *out, struct fault *fault) {
    bool yes = n->kind == YAML_SCALAR && !n->quoted && strcmp(n->text, "true") == 0;
    bool no = n->kind == YAML_SCALAR && !n->quoted && strcmp(n->text, "false") == 0;
    if (!yes && !no)
        return value_fault(n, fault, "true or false");
    *out = yes;
    return STATUS_OK;
}

enum status yaml_string(const struct yaml_node *n, const char **out, struct fault *fault) {
    if (n->kind != YAML_SCALAR || (*n->text == '\0' && !n->quoted))
        return value_fault(n, fault, "a text");
    *out = n->text;
    return STATUS_OK;
}
