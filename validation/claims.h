/* claims.h -- what the papers say, and which checks decide whether it holds.
 *
 * The folder `claims` beside the folder of cases holds one YAML file a paper; docs/claims.md
 * gives the format.  A claim names the checks whose rows decide it, and what it is if they
 * come out as they should, or otherwise:
 *
 *     paper: MFM
 *     title: McNamara, Flekkoy and Maloy, Phys. Rev. E 61, 4054 (2000)
 *     claims:
 *       - id: mfm-front
 *         where: Section III, Fig. 3
 *         says: A sharp front forms between mixture and clear gas.
 *         reading: both Darcy laws       # optional: how the paper is read
 *         tests:
 *           - {case: graingas/sedimentation, check: front is sharp, points: {start: random}}
 *         verdict: reproduced            # where every test passes (or, with `result: fail`, fails)
 *         otherwise: not reproduced
 *         because: why these tests decide it
 *         proof: S2                      # section of docs/theory.md; needed where it is wrong
 *
 * Loading reads the named cases too and refuses, each with file:line:column: cases, checks and
 * points that do not exist (with the nearest name), an id that is used twice, a claim without
 * tests that does not say why (`untested:`), a claim that is wrong without proof.
 *
 * Leaves out: judging (claims_judge.h), stored verdicts (claims_stored.h).
 * Checked by: tests/unit/test_claims.c.
 */
#ifndef VALIDATION_CLAIMS_H
#define VALIDATION_CLAIMS_H

#include "report/ledger.h"
#include "validation/case.h"

struct claim_test {
    const char *case_name, *check;
    struct case_filter points;
    bool wants_pass;          /* the result that speaks for `verdict`; else fail */
    bool in_tier[TIER_COUNT]; /* there the check has a point that passes the filter */
    const struct yaml_node *node;
};

struct claim {
    const char *id, *paper, *where, *says, *because;
    const char *reading, *proof, *untested; /* or NULL */
    enum claim_verdict verdict, otherwise;  /* without tests: the same */
    size_t test_count;
    struct claim_test *test;
    const struct yaml_node *node;
};

struct claims {
    struct arena arena;
    size_t count, document_count;
    struct claim *claim; /* in the order of files by name, and of each file */
    struct yaml_document **document;
};

/* The claims beside cases_folder; no such folder is no claim and no fault.  On error *out is
 * NULL and fault has every finding. */
enum status claims_load(const char *cases_folder, struct claims **out, struct fault *fault);
void claims_free(struct claims *c); /* NULL is allowed */

/* Path of `name` in the folder that holds cases_folder; NULL: no memory. */
const char *claims_beside(const char *cases_folder, const char *name, struct arena *a);

/* claims_use.c: every test's case, check and points are looked up and in_tier[] is filled. */
enum status claims_use(struct claims *c, const char *cases_folder, struct fault *fault);

#endif
