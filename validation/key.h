/* key.h -- when a result counts: the digest of everything that it was made from.
 *
 * key = SHA-256 of (meaning of the run file, seed, content of the start file,
 * bytes of the solver program, --set overrides).  A result is used only when
 * the record beside it has the key that its run would get now; anything else
 * is run again.  A failed run leaves a record too, which is shown and never
 * used again.
 *
 * Leaves out: shared libraries that the solver loads, and the wall-clock limit.
 */
#ifndef VALIDATION_KEY_H
#define VALIDATION_KEY_H

#include "common/digest.h"

#include <stdbool.h>

struct key_parts {
    const char *meaning; /* of the run file: its text without comments */
    long long seed;
    const char *start;           /* digest of the start file, or NULL */
    const char *solver;          /* digest of the solver program */
    const char *const *settings; /* settings[0 .. setting_count-1]: "name=value", as given */
    size_t setting_count;
};

enum status key_make(const struct key_parts *parts, struct digest *out, struct fault *fault);

enum { KEY_FAILURE_SIZE = 400 };

struct key_record {
    char key[DIGEST_SIZE], solver[DIGEST_SIZE];
    double seconds;                 /* wall time of the run */
    double bytes;                   /* size of the result; 0 for a failed run */
    char failure[KEY_FAILURE_SIZE]; /* why the run failed; empty: it did not */
};

enum status key_write(const char *path, const struct key_record *r, struct fault *fault);
/* STATUS_NOT_FOUND where there is none, STATUS_BAD_INPUT where it is damaged. */
enum status key_read(const char *path, struct key_record *out, struct fault *fault);

/* The file of a program as a shell would find it: free() *out.  `path_list` is
 * the value of PATH (NULL: none). */
enum status key_find_program(const char *command, const char *path_list, char **out,
                             struct fault *fault);

#endif
