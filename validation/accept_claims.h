/* accept_claims.h -- verdicts of the papers' claims on their way into reference/claims.tsv.
 *
 * Of each claim whose cases were all run and are all chosen, the verdict as the rows have it
 * (claims_judge.h) takes the place of the stored one.  A verdict that is as it was keeps its
 * commit, date and reason; a claim that is undecided keeps what is stored, and is told; the
 * line of one that this tier does not test any more goes.
 *
 * Checked by: tests/cli/test_bedcheck_accept_claims.py.
 */
#ifndef VALIDATION_ACCEPT_CLAIMS_H
#define VALIDATION_ACCEPT_CLAIMS_H

#include "validation/claims_judge.h"

struct accept_claims_source {
    const char *cases_folder, *references_folder;
    enum tier tier;
    const struct assemble_case *cases; /* cases[0 .. case_count-1], judged or not */
    const bool *chosen;                /* chosen[0 .. case_count-1] */
    size_t case_count;
    const char *commit, *date, *reason; /* of new lines; outlive the result */
};

struct accept_verdict {
    const char *id;
    const char *old, *new; /* names of verdicts; NULL: none */
    const char *why;       /* of the new one, or of none; one sentence */
};

struct accept_claims {
    struct arena arena;
    struct claims *claims;
    struct claims_stored *stored; /* as it is to be written */
    size_t change_count, open_count;
    struct accept_verdict *change; /* change[0 .. change_count-1] */
    struct accept_verdict *open;   /* undecided; `old` is what stays stored, if anything */
};

/* On error *out is empty. */
enum status accept_claims_gather(const struct accept_claims_source *source,
                                 struct accept_claims *out, struct fault *fault);
void accept_claims_free(struct accept_claims *c); /* a zeroed one is allowed */

/* Is case i one that a claim of the source's rests on, all of whose cases are chosen and run? */
bool accept_claims_rest_on(const struct accept_claims *c, const struct accept_claims_source *source,
                           size_t i);

#endif
