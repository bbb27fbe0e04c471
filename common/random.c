/* random.c -- see random.h. */
#include "common/random.h"

#include "common/digest.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>

enum status random_stream(uint64_t seed, const char *purpose, gsl_rng **out, struct fault *fault) {
    *out = NULL;
    /* The generator takes 32 bits: the first of SHA-256 of both, so that
     * neighbouring seeds and similar names are unrelated streams. */
    char number[32];
    snprintf(number, sizeof number, "%" PRIu64, seed);
    struct digest digest;
    digest_texts((const char *const[]){number, purpose}, 2, &digest);
    digest.hex[8] = '\0';
    gsl_rng *r = gsl_rng_alloc(gsl_rng_mt19937);
    if (r == NULL)
        return fault_set(fault, STATUS_NO_MEMORY, "no memory for the random stream '%s'", purpose);
    gsl_rng_set(r, strtoul(digest.hex, NULL, 16));
    *out = r;
    return STATUS_OK;
}
