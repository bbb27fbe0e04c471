/* compare_references.h -- a folder and the stored references, put so that compare.h takes them.
 *
 * Each row that has an ensemble of K seeds with mean mu and deviation s gets a row of the
 * other side: mu with uncertainty s / sqrt(K).  The row's own uncertainty becomes
 * s / sqrt(n), n its seeds: the scatter is the ensemble's, with K - 1 degrees of freedom,
 * never that of the run's few seeds.  Where the ensemble is one of differences from an
 * expectation that changes from run to run, so is what is compared.  A row without
 * ensemble is listed as one that has no reference.
 *
 * Runs are compared by the digest of their bits, where the references have one of their
 * class of build.
 *
 * Checked by: tests/cli/test_bedcheck_compare.py.
 */
#ifndef VALIDATION_COMPARE_REFERENCES_H
#define VALIDATION_COMPARE_REFERENCES_H

#include "validation/compare_runs.h"
#include "validation/results.h"

struct compare_references {
    struct results *old, *new; /* `new` shares its texts with what it was made of */
    struct compare_runs *runs;
};

/* folder: of the references.  `judged` must outlive the result. */
enum status compare_references_load(const struct results *judged, const char *folder,
                                    struct compare_references *out, struct fault *fault);
void compare_references_free(struct compare_references *c); /* a zeroed one is allowed */

#endif
