/* json.h -- strict JSON, written in order.
 *
 * Doubles are written with 17 significant digits; NaN and infinities become
 * null.  Text is escaped.  Commas and indentation are kept here, so that the
 * output is always well formed when begins and ends match (asserted).
 */
#ifndef COMMON_JSON_H
#define COMMON_JSON_H

#include <stdbool.h>
#include <stdio.h>

struct json {
    FILE *out; /* borrowed */
    int depth;
    bool filled[32]; /* has the container at this depth an item yet */
    bool after_key;
};

struct json json_to(FILE *out);
void json_begin_object(struct json *j);
void json_end_object(struct json *j);
void json_begin_array(struct json *j);
void json_end_array(struct json *j);
void json_key(struct json *j, const char *key);
void json_text(struct json *j, const char *text); /* NULL becomes null */
void json_real(struct json *j, double value);
void json_integer(struct json *j, long long value);
void json_boolean(struct json *j, bool value);

/* A member of an object: its key and its value. */
void json_put_text(struct json *j, const char *key, const char *text);
void json_put_real(struct json *j, const char *key, double value);
void json_put_count(struct json *j, const char *key, size_t count);

#endif
