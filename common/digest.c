/* digest.c -- see digest.h. */
#include "common/digest.h"

#include <errno.h>
#include <sha2.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>

static void finish(SHA2_CTX *context, struct digest *out) {
    uint8_t bytes[SHA256_DIGEST_LENGTH];
    SHA256Final(bytes, context);
    for (size_t i = 0; i < sizeof bytes; i++)
        snprintf(out->hex + 2 * i, 3, "%02x", bytes[i]);
}

void digest_bytes(const void *bytes, size_t length, struct digest *out) {
    SHA2_CTX context;
    SHA256Init(&context);
    SHA256Update(&context, bytes, length);
    finish(&context, out);
}

enum status digest_file(const char *path, struct digest *out, struct fault *fault) {
    FILE *file = fopen(path, "rb");
    if (file == NULL)
        return fault_set(fault, errno == ENOENT ? STATUS_NOT_FOUND : STATUS_IO, "%s: %s", path,
                         strerror(errno));
    unsigned char block[1 << 14];
    SHA2_CTX context;
    SHA256Init(&context);
    size_t got;
    while ((got = fread(block, 1, sizeof block, file)) > 0)
        SHA256Update(&context, block, got);
    bool failed = ferror(file) != 0;
    int cause = errno;
    fclose(file);
    if (failed)
        return fault_set(fault, STATUS_IO, "%s: %s", path, strerror(cause));
    finish(&context, out);
    return STATUS_OK;
}

void digest_texts(const char *const *texts, size_t count, struct digest *out) {
    SHA2_CTX context;
    SHA256Init(&context);
    for (size_t i = 0; i < count; i++) {
        /* The length in front keeps ("ab", "c") apart from ("a", "bc"). */
        char length[32];
        int digits = snprintf(length, sizeof length, "%zu:", strlen(texts[i]));
        SHA256Update(&context, (const uint8_t *)length, (size_t)digits);
        SHA256Update(&context, (const uint8_t *)texts[i], strlen(texts[i]));
    }
    finish(&context, out);
}
