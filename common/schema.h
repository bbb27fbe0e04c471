/* schema.h -- which keys may stand in a map, of which type and range.
 *
 * A table of fields is compared with a YAML map; every fault is found in one
 * pass and told with its place: unknown key (with the nearest known one), a
 * missing key, a wrong type, a value out of range, a choice that is none.
 */
#ifndef COMMON_SCHEMA_H
#define COMMON_SCHEMA_H

#include "common/yaml.h"

enum schema_type {
    SCHEMA_REAL,
    SCHEMA_INTEGER,
    SCHEMA_BOOLEAN,
    SCHEMA_TEXT,
    SCHEMA_CHOICE,
    SCHEMA_LIST,
    SCHEMA_MAP,
    SCHEMA_REAL_LIST,
    SCHEMA_ANY /* looked at by the caller */
};

struct schema_field {
    const char *key;
    enum schema_type type;
    bool required;
    double min, max;            /* numbers: closed range, checked where min < max */
    const char *const *choices; /* SCHEMA_CHOICE: NULL-terminated */
};

/* Compare a map with its fields; adds every finding to fault.  Returns
 * STATUS_OK or STATUS_BAD_INPUT. `what` names the map: "case", "check". */
enum status schema_check(const struct yaml_node *map, const char *what,
                         const struct schema_field *fields, size_t count, struct fault *fault);

/* Compare one value with one field, as schema_check does for each key. */
enum status schema_check_value(const struct yaml_node *value, const struct schema_field *field,
                               struct fault *fault);

/* The nearest of names[0 .. count-1] to word by edit distance, or NULL when none
 * is near (distance over 2 and over a third of the word). */
const char *schema_nearest(const char *word, const char *const *names, size_t count);

#endif
