/* bits.h -- has a run given the same bits as before?
 *
 * The digest covers the values of the datasets that the run was asked for:
 * names in order, shapes, numbers as 8 bytes each, low byte first; of a time series
 * steps and times too.  Attributes and whatever else the solver writes are no
 * part of it.
 *
 * The class of build says whose bits are worth comparing: compiler and major
 * version, flags that change arithmetic, machine, C library and the code that it
 * chose for this processor, as the solver's record (.run.json) tells them:
 * "gcc-12/-O2,-ffp-contract=off/x86_64/glibc-2.36-1a2b3c4d".  Other bits of the same
 * class are a change, but no failure: statistics decide.
 *
 * Checked by: tests/unit/test_bits.c.
 */
#ifndef VALIDATION_BITS_H
#define VALIDATION_BITS_H

#include "common/digest.h"

/* dataset[0 .. count-1]: names as in the run file, in any order. */
enum status bits_of_result(const char *result_path, const char *const *dataset, size_t count,
                           struct digest *out, struct fault *fault);

enum { BITS_CLASS_SIZE = 256, BITS_WORD_SIZE = 128 };

struct bits_build { /* what a record says of the build; "unknown" where it does not */
    char commit[BITS_WORD_SIZE], dirty[BITS_WORD_SIZE];
    char name[BITS_CLASS_SIZE]; /* of the class; without tab, colon or blank */
};

/* From a run's record beside its result, NAME.run.json.  No record: everything is "unknown". */
enum status bits_read_build(const char *record_path, struct bits_build *out, struct fault *fault);

#endif
