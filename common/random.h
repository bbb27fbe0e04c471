/* random.h -- one named stream of random numbers a purpose.
 *
 * A stream is GSL's mt19937 seeded from the run's seed and the name of its
 * purpose ("positions", "kicks"), so that adding a stream never shifts another.
 */
#ifndef COMMON_RANDOM_H
#define COMMON_RANDOM_H

#include "common/fault.h"

#include <gsl/gsl_rng.h>
#include <stdint.h>

/* On error *out is NULL.  Free with gsl_rng_free. */
enum status random_stream(uint64_t seed, const char *purpose, gsl_rng **out, struct fault *fault);

#endif
