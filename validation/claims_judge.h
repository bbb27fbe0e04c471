/* claims_judge.h -- what the judged rows of a report say about the papers' claims.
 *
 * A test of a claim comes out
 *     as said     every row of its check at its points passes (or, where the claim needs them to
 *                 fail, none does: what is known to disagree fails)
 *     contrary    some row comes out the other way
 *     open        some row is inconclusive, and none is contrary
 *     missing     there is no row: the tier has no such point, or the case was not run
 * and the claim is, with its tests together,
 *     otherwise   where one is contrary      verdict     where all are as said
 *     undecided   where one is open          not tested  where one is missing
 * in this order, but that a claim of which a test is missing is not tested unless a row of it is
 * contrary.
 *
 * A verdict decides no exit code by itself.  Where one is stored (claims_stored.h) and every case
 * of the claim was run, the claim gets a row of kind "claim" in the case of its first test: it
 * fails if the verdict is another now, and is inconclusive where it is undecided.
 *
 * Checked by: tests/unit/test_claims_judge.c.
 */
#ifndef VALIDATION_CLAIMS_JUDGE_H
#define VALIDATION_CLAIMS_JUDGE_H

#include "validation/assemble.h"
#include "validation/claims_stored.h"

struct claims_input {
    const struct claims *claims;
    const struct claims_stored *stored; /* NULL: none */
    enum tier tier;
    const struct assemble_case *cases; /* cases[0 .. case_count-1] */
    struct report_case *report;        /* report[i] shows cases[i]; gets the rows of kind "claim" */
    size_t case_count;
};

/* Texts and arrays are the arena's; the ledger points into report[]. */
enum status claims_judge(const struct claims_input *in, struct arena *a, struct report_ledger *out,
                         struct fault *fault);

#endif
