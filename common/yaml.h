/* yaml.h -- a strict reader of small YAML files, with the place of every node.
 *
 * Built from libyaml's events into one tree.  Refused, each with its place:
 * anchors, aliases, tags, a second document, nesting deeper than 8, duplicate
 * keys, keys that are not plain text, files over the caller's limit, bytes
 * that are not UTF-8.  JSON is a subset, so that run records are read here too.
 *
 * Leaves out: any meaning.  Which keys may stand where is said in schema.h.
 */
#ifndef COMMON_YAML_H
#define COMMON_YAML_H

#include "common/fault.h"

#include <stdbool.h>
#include <stddef.h>

enum { YAML_MAX_DEPTH = 8, YAML_CASE_MAX_BYTES = 1 << 20 };

enum yaml_kind { YAML_SCALAR, YAML_LIST, YAML_MAP };

struct yaml_node {
    enum yaml_kind kind;
    const char *file;    /* path as given to yaml_load; borrowed from the document */
    size_t line, column; /* of the value, from 1 */
    const char *key;     /* the key it stands under, or NULL */
    size_t key_line, key_column;
    const char *text;        /* scalars only */
    bool quoted;             /* a quoted scalar is text, never a number */
    size_t count;            /* lists and maps: number of children */
    struct yaml_node *child; /* child[0 .. count-1] */
};

struct yaml_document; /* opaque: owns the tree */

/* Read a file of at most max_bytes.  STATUS_NOT_FOUND, STATUS_IO, or
 * STATUS_BAD_INPUT with "file:line:column: ..." for each finding. */
enum status yaml_load(const char *path, size_t max_bytes, struct yaml_document **out,
                      struct fault *fault);

/* The same from memory; `name` stands for the file in messages. */
enum status yaml_parse(const char *name, const char *text, size_t length,
                       struct yaml_document **out, struct fault *fault);

const struct yaml_node *yaml_root(const struct yaml_document *d);
/* NULL is allowed.  Hidden, because libyaml exports a yaml_free that it calls itself. */
void yaml_free(struct yaml_document *d) __attribute__((visibility("hidden")));

/* Child of a map under key, or NULL. */
const struct yaml_node *yaml_get(const struct yaml_node *map, const char *key);

/* Readers of one scalar.  On failure they add "file:line:column: key: ..." to
 * fault, return STATUS_BAD_INPUT and leave *out alone.  Numbers: the whole text
 * must be consumed; nan, inf and overflow are refused; "1e3" is no integer. */
enum status yaml_real(const struct yaml_node *n, double *out, struct fault *fault);
enum status yaml_integer(const struct yaml_node *n, long long *out, struct fault *fault);
enum status yaml_boolean(const struct yaml_node *n, bool *out, struct fault *fault);
enum status yaml_string(const struct yaml_node *n, const char **out, struct fault *fault);

/* Add "file:line:column: " and the message; returns STATUS_BAD_INPUT. */
enum status yaml_fault(const struct yaml_node *n, struct fault *fault, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

#endif
