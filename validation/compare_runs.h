/* compare_runs.h -- the same runs in two folders: their bits, where they part, what they cost.
 *
 * A run that both folders have (same name: same meaning, same seed) is read dataset by
 * dataset, sample by sample, as far as its run file asks for data.  Equal numbers
 * throughout: the run is unchanged.  Else two samples are told: the first that differs in
 * any bit, and the first that differs by PARTED of the sample's largest number: between
 * them runs drift apart from rounding, and after the second one they share their
 * statistics only.  The horizon is measured on what was written: samples are its grain.
 *
 * Costs are compared run by run, for machines differ from minute to minute: with seconds
 * a_i (old) and b_i (new) of n runs, the ratio is R = sum b / sum a, and its standard
 * uncertainty that of a ratio estimator,
 *
 *     sqrt(n / (n-1) sum (b_i - R a_i)^2) / sum a
 *
 * Source:     Cochran, Sampling Techniques (1977), Eq. 6.13, for the ratio.
 * Leaves out: what made a machine slow for all runs of one folder and not of the other;
 *             runs made in turn (ci/compare-commits) suffer least from it.
 * Checked by: tests/cli/test_bedcheck_compare.py.
 */
#ifndef VALIDATION_COMPARE_RUNS_H
#define VALIDATION_COMPARE_RUNS_H

#include "validation/results.h"

static const double COMPARE_RUNS_PARTED = 1e-3;

enum compare_bits { BITS_EQUAL, BITS_DIFFER, BITS_UNKNOWN };

struct compare_sample {
    bool found;
    double time; /* of the sample, in the model's unit; 0 for what has no time */
    double step; /* the solver's own count, NaN where there is none */
    double size; /* largest difference, in parts of the sample's largest number */
    const char *dataset;
};

struct compare_run {
    const char *name, *case_name;
    enum compare_bits bits;
    const char *why; /* of BITS_UNKNOWN */
    struct compare_sample first, parted;
};

/* One part of the cost, over all runs that tell it on both sides. */
struct compare_cost {
    const char *part; /* "graingas: pressure", "cpu", "wall" */
    size_t runs;
    double old_s, new_s;       /* sums */
    double ratio, uncertainty; /* R and its standard uncertainty; NaN with one run */
    double t_limit;            /* how many uncertainties a change must have to be told */
};

struct compare_runs {
    struct arena arena;
    size_t run_count, cost_count;
    struct compare_run *run;
    struct compare_cost *cost;
    size_t count[3]; /* by enum compare_bits */
};

/* All runs of `old` that `new` has too.  Results that are gone are BITS_UNKNOWN, no fault.
 * `level` of the whole table of costs. */
enum status compare_runs_read(const struct results *old, const struct results *new, double level,
                              struct compare_runs **out, struct fault *fault);
void compare_runs_free(struct compare_runs *c); /* NULL is allowed */

#endif
