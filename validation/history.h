/* history.h -- what runs of the suite have given over the commits: one line of JSON each.
 *
 *     {"schema": "bedcheck-history 1", "commit", "dirty", "started", "tier", "solver_key",
 *      "modification", "verdict", "counts": {pass, known, fail, inconclusive, skipped},
 *      "worst": {case, check, point, margin_used}, "wall_s", "cpu_s",
 *      "observables": [{case, check, point, unit, measured, uncertainty, expected, tolerance}]}
 *
 * Date and commit are those of the results, never the clock's.  `worst` is the largest
 * share of a tolerance that any check used up; times are sums over all runs; observables
 * are those that a change of the physics moves: every check but round-off ones.  The file
 * is the user's: lines are appended, under a lock and in one piece, never changed, and a
 * line that is there already is not added again.
 *
 * Checked by: tests/cli/test_bedcheck_history.py.
 */
#ifndef VALIDATION_HISTORY_H
#define VALIDATION_HISTORY_H

#include "validation/results.h"

struct history_value { /* of one check in one line */
    const char *case_name, *check, *point, *unit;
    double measured, uncertainty, expected, tolerance; /* NaN: none */
};

struct history_line {
    const char *commit, *dirty, *started, *tier, *solver_key, *modification, *verdict;
    struct results_counts counts;
    const char *worst; /* "CASE: check, point", or NULL */
    double worst_used, wall_s, cpu_s;
    size_t value_count;
    const struct history_value *value;
};

struct history {
    struct arena arena;
    size_t count;
    struct history_line *line; /* in the file's order */
};

/* A damaged line is a fault with file:line. */
enum status history_load(const char *path, struct history **out, struct fault *fault);
void history_free(struct history *h); /* NULL is allowed */

/* Append a line on r.  *added is false where it stands there already. */
enum status history_append(const char *path, const struct results *r, bool *added,
                           struct fault *fault);

/* folder/index.html: trends of each tier, self-contained.  MODIFIED lines are left out. */
enum status history_plot(const struct history *h, const char *folder, struct fault *fault);

#endif
