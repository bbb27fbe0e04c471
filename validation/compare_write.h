/* compare_write.h -- a comparison told: to a person, to a pull request, to a program.
 *
 * The text has every row; the Markdown first what has changed, and of the rest what fits
 * below the 65 536 characters that GitHub takes as a comment; the JSON everything:
 *
 *     {"schema": "bedcheck-comparison 1", "conclusion", "exit_code", "refusal", "level", "tests",
 *      "old": {folder, tier, commit, dirty, solver_key, started, modification}, "new": {...},
 *      "counts": {unchanged, same, significant, undecided, other, added, removed},
 *      "rows": [{case, check, point, unit, change, old, old_uncertainty, new, new_uncertainty,
 *                difference, uncertainty, half_width, tolerance, difference_in_tolerances, how,
 *                note, old_expected, new_expected, old_verdict, new_verdict}],
 *      "added": [{case, check, point}], "removed": [...],
 *      "not_run": [{side, case, reason}],
 *      "runs": [{name, bits, first_time, first_step, first_size, first_dataset, parted_time,
 *                parted_step, reason}],
 *      "cost": [{part, runs, old_s, new_s, ratio, uncertainty, told}]}
 *
 * Checked by: tests/cli/test_bedcheck_compare.py.
 */
#ifndef VALIDATION_COMPARE_WRITE_H
#define VALIDATION_COMPARE_WRITE_H

#include "validation/compare.h"
#include "validation/compare_runs.h"

#include <stdio.h>

struct compare_view {
    const struct compared *rows;
    const struct compare_runs *runs; /* NULL where nothing can be compared */
};

void compare_write_text(const struct compare_view *v, FILE *out);
void compare_write_json(const struct compare_view *v, FILE *out);
enum status compare_write_markdown(const struct compare_view *v, FILE *out, struct fault *fault);

#endif
