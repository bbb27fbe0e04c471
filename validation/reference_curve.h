/* reference_curve.h -- stored curves: reference/curves/HEX.h5.
 *
 * One file a curve, with the datasets x, mean, deviation (from seed to seed) and
 * seeds.  Its name is the SHA-256 of its bytes and is checked on every reading;
 * the same curve gives the same bytes.  Only tables (reference.h) name curves.
 *
 * Checked by: tests/unit/test_reference_curve.c.
 */
#ifndef VALIDATION_REFERENCE_CURVE_H
#define VALIDATION_REFERENCE_CURVE_H

#include "common/digest.h"
#include "validation/arena.h"

#include <stdbool.h>

struct reference_curve {
    size_t count, seeds;
    const double *x, *mean, *deviation; /* [0 .. count-1]; x increases */
};

/* Write path, then say the digest that it is to be named by. */
enum status reference_curve_write(const char *path, const struct reference_curve *c,
                                  struct digest *out, struct fault *fault);

/* folder/curves/HEX.h5, in the arena.  STATUS_BAD_INPUT when its bytes do not fit its name. */
enum status reference_curve_read(const char *folder, const char *hex, struct arena *a,
                                 struct reference_curve *out, struct fault *fault);

#endif
