/* claims_stored.h -- the stored verdicts of the claims: reference/claims.tsv.
 *
 * A claim's verdict decides nothing by itself: what a paper says may be wrong.  But a verdict
 * that changes from one build to the next is a finding, so verdicts are stored, a table.h with one
 * line a claim and tier:
 *
 *     id tier verdict commit date reason
 *
 * Reading refuses, besides what table.h refuses, unknown claims, tiers and verdicts (with the
 * nearest), what is no commit, date or reason, a claim and tier that stand twice, and a claim
 * without tests (nothing of it can change).
 *
 * Checked by: tests/unit/test_claims_stored.c.
 */
#ifndef VALIDATION_CLAIMS_STORED_H
#define VALIDATION_CLAIMS_STORED_H

#include "validation/claims.h"

struct claim_stored {
    const char *id;
    enum tier tier;
    enum claim_verdict verdict;
    const char *commit, *date, *reason; /* 40 hex digits; YYYY-MM-DD; one line */
};

struct claims_stored {
    struct arena arena;
    const char *path;
    size_t count; /* 0 where there is no file */
    struct claim_stored *item;
};

/* folder/claims.tsv; no file, or folder NULL, is no verdict and no fault.  On error *out is NULL
 * and fault has every finding. */
enum status claims_stored_load(const char *folder, const struct claims *claims,
                               struct claims_stored **out, struct fault *fault);
void claims_stored_free(struct claims_stored *s); /* NULL is allowed */

/* The verdict of a claim in a tier, or NULL.  s NULL: none. */
const struct claim_stored *claims_stored_find(const struct claims_stored *s, const char *id,
                                              enum tier tier);

/* s with `item` in the place of its claim and tier's line, or beside the others.  Borrows texts. */
enum status claims_stored_put(struct claims_stored *s, const struct claim_stored *item,
                              struct fault *fault);

/* s without the line of a claim and tier; none is no fault. */
void claims_stored_remove(struct claims_stored *s, const char *id, enum tier tier);

/* The file's text; STATUS_BAD_INPUT where reading it would refuse it.  free() it. */
enum status claims_stored_text(const struct claims_stored *s, const struct claims *claims,
                               char **out, struct fault *fault);

#endif
