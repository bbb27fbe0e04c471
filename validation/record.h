/* record.h -- members of a record that bedcheck wrote: results.json, lines of history.jsonl.
 *
 * JSON is a subset of YAML, so the house's reader serves.  A member that is missing or of another
 * kind is a fault that names file, line and key; reading goes on, with nothing in its place, so
 * that a caller may look at the fault once, at the end.
 *
 * Used by:    results.c, history.c.
 * Checked by: tests/unit/test_record.c.
 */
#ifndef VALIDATION_RECORD_H
#define VALIDATION_RECORD_H

#include "common/yaml.h"
#include "validation/arena.h"

struct record {
    struct arena *arena; /* of all texts */
    struct fault *fault;
    const char *hint; /* of a missing member: what its reader may do */
};

/* A member of that kind, or NULL. */
const struct yaml_node *record_member(const struct record *r, const struct yaml_node *map,
                                      const char *key, enum yaml_kind kind);
bool record_is_null(const struct yaml_node *n);

/* A text; of the optional one null gives NULL. */
const char *record_text(const struct record *r, const struct yaml_node *map, const char *key);
const char *record_optional_text(const struct record *r, const struct yaml_node *map,
                                 const char *key);
/* A number; null gives NaN. */
double record_real(const struct record *r, const struct yaml_node *map, const char *key);
double record_real_of(const struct record *r, const struct yaml_node *n);
/* A whole number >= 0. */
size_t record_count(const struct record *r, const struct yaml_node *map, const char *key);

/* Says so in the fault. */
enum status record_no_memory(const struct record *r);

#endif
