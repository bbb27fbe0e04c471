/* digest.h -- SHA-256 (libmd) of text, files and lists of both, as 64 hex digits. */
#ifndef COMMON_DIGEST_H
#define COMMON_DIGEST_H

#include "common/fault.h"

#include <stddef.h>

enum { DIGEST_SIZE = 65 };

struct digest {
    char hex[DIGEST_SIZE];
};

void digest_bytes(const void *bytes, size_t length, struct digest *out);
enum status digest_file(const char *path, struct digest *out, struct fault *fault);

/* Digest of several texts, order and lengths taken into account. */
void digest_texts(const char *const *texts, size_t count, struct digest *out);

#endif
