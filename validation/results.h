/* results.h -- results.json read again: what a folder's judging has said, row by row.
 *
 * A file that another program may have touched is not trusted: every member that is
 * needed must be there and of its type, and every fault names file and line.  Members
 * that nobody here needs are left alone, so that later versions may add some.
 *
 * A row is known by case, check and point; where a case repeats those, by its place
 * among its twins.
 *
 * Leaves out: verdicts, which are the judge's (judge.h), and runs (compare_runs.h).
 * Checked by: tests/cli/test_bedcheck_compare.py.
 */
#ifndef VALIDATION_RESULTS_H
#define VALIDATION_RESULTS_H

#include "common/fault.h"
#include "validation/arena.h"

#include <stdbool.h>
#include <stddef.h>

struct results_row {
    const char *case_name, *point, *check, *observable, *unit;
    const char *comparison, *kind, *verdict, *reason;
    const char *key, *meaning; /* as reference_key has them: observable, digest; NULL: none */
    bool reference;            /* not a row of results, but what is stored as its reference */
    bool same_bits;            /* of a reference: all runs compared with it have its bits */
    size_t twin;               /* how many rows before it have its case, check and point */
    double measured, uncertainty, expected, expected_uncertainty, tolerance; /* NaN: null */
    double detectable; /* change that the check sees with 95 %; NaN: not known */
    double freedom;    /* degrees of freedom of the uncertainty; INFINITY where it is declared */
    size_t run_count, value_count;
    const char *const *run; /* run[0 .. run_count-1], names with their seeds */
    const double *value;    /* value[0 .. value_count-1], one a seed; NaN: missing */
    const long long *seed;  /* seed[i] gave value[i] */
};

struct results_skipped {
    const char *case_name, *reason;
};

struct results_counts {
    size_t pass, known, fail, inconclusive, skipped;
};

struct results {
    struct arena arena;
    const char *folder; /* as given */
    const char *tier, *solver, *solver_key, *started, *verdict;
    const char *commit, *dirty; /* of the solver's build; "unknown" where it does not say */
    const char *modification;   /* NULL: not MODIFIED */
    struct results_counts counts;
    bool references; /* the stored references in the place of results */
    size_t row_count, skipped_count;
    const struct results_row *row;
    const struct results_skipped *skipped;
};

/* folder/results.json.  On error *out is NULL. */
enum status results_load(const char *folder, struct results **out, struct fault *fault);
void results_free(struct results *r); /* NULL is allowed */

/* The row of that case, check, point and place among its twins, or NULL. */
const struct results_row *results_find(const struct results *r, const struct results_row *like);

/* Is it the row of a run that failed, rather than of a check? */
bool results_is_run(const struct results_row *row);

/* Share of the tolerance that a row uses up, as report_margin_used has it. */
double results_margin_used(const struct results_row *row);

#endif
