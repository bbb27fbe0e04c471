/* ledger.h -- the claims of the papers and what became of them, ready to be shown.
 *
 * validation/claims_judge.c fills these structs from the judged rows; html_ledger.c,
 * markdown.c and json_report.c show them.  No judging here.
 */
#ifndef REPORT_LEDGER_H
#define REPORT_LEDGER_H

#include "report/report.h"

enum claim_verdict {
    CLAIM_REPRODUCED,
    CLAIM_NOT_REPRODUCED,
    CLAIM_UNDERDETERMINED, /* the paper leaves open what it depends on */
    CLAIM_WRONG,           /* wrong in the paper, and proved so */
    CLAIM_UNDECIDED,       /* a check that decides it is inconclusive */
    CLAIM_NOT_TESTED,      /* not in this tier or selection, or by no check at all */
    CLAIM_VERDICTS
};

/* How a check that decides a claim came out. */
enum claim_result { CLAIM_AS_SAID, CLAIM_CONTRARY, CLAIM_OPEN, CLAIM_MISSING };

struct report_claim_test {
    const char *case_name, *check;
    const char *points; /* "darcy published", or "" for all of the check's points */
    bool wants_pass;    /* the result that speaks for the claim's verdict; else fail */
    enum claim_result result;
    const char *missing;          /* CLAIM_MISSING: why there is no row */
    const struct report_case *in; /* NULL: not in this report */
    size_t row_count;
    const size_t *row; /* in->row[row[0 .. row_count-1]] */
};

struct report_claim {
    const char *id, *paper, *where, *says, *reading;
    const char *because; /* why these checks decide it, and what follows */
    const char *proof;   /* section of docs/theory.md, or NULL */
    enum claim_verdict verdict;
    const char *reason; /* one sentence */
    const char *stored; /* name of the verdict that is stored for this tier, or NULL */
    bool is_tested;     /* some row of this report decides it */
    size_t test_count;
    const struct report_claim_test *test;
};

struct report_ledger {
    size_t count;
    const struct report_claim *claim;
};

/* "reproduced", "not reproduced", "underdetermined", "wrong in the paper", "undecided",
 * "not tested" */
const char *claim_verdict_name(enum claim_verdict v);
bool claim_verdict_find(const char *name, enum claim_verdict *out);

/* How many claims have each verdict: count[0 .. CLAIM_VERDICTS-1]. */
void claim_tally(const struct report_ledger *l, size_t *count);

#endif
