/* compare.h -- two judged folders, row by row: what has changed, and is it more than scatter?
 *
 * For each check and point that both have, with values a_i (old) and b_i (new) of the same
 * seeds i = 1 .. n, the change d = mean(b_i - a_i) gets an interval d +- h at the level L:
 *
 *     paired      h = t(n-1) sd(b_i - a_i) / sqrt(n)         seeds that still agree cancel
 *     separate    h = t(f) hypot(u_a, u_b)                   u: uncertainties as judged
 *
 * with f the degrees of freedom behind u (the seeds' own, an ensemble's, or none to count
 * where the check declares its scatter: normal).  Both are formed, each at half of the
 * level, and the shorter one counts (with stored references there is only the second); L is the
 * whole comparison's level, two-sided, divided by the number of rows whose value scatters
 * (Bonferroni).  Then the row is
 *
 *     unchanged     every a_i = b_i to the last bit; or all bits of its runs are the references'
 *     same          d +- h lies within one tolerance T of the check: no change of that size; of a
 *                   regression check, whose T is itself of chance: with uncertainty u of d,
 *                   h + 1.645 u is at most the change that the check sees with 95 %
 *     significant   |d| > h, and d is more than rounding
 *     undecided     else: too few data to see a change that large
 *     other         not comparable: other runs, other observables, other seeds
 *
 * Values without scatter (uncertainty 0) are compared seed by seed, the largest change is
 * shown, and it is significant beyond rounding: beyond the tolerance itself for round-off
 * checks, whose tolerance bounds just that, and for bounds (at most, at least, outside) that
 * each seed keeps for itself; else beyond 1.5e-8 (half of the digits of a double) of the
 * largest of |a|, |b| and T.  T of a one-sided check without margin is
 * |expected|.  A number that is lost, and a run that fails on one side only, are significant.
 *
 * Source:     Student, Biometrika 6, 1 (1908).
 * Leaves out: correlation between rows (Bonferroni allows for any); fits over a sweep are
 *             never paired, though their runs share seeds: their h is too wide.
 * Checked by: tests/unit/test_compare.c.
 */
#ifndef VALIDATION_COMPARE_H
#define VALIDATION_COMPARE_H

#include "validation/results.h"

enum change {
    CHANGE_UNCHANGED,
    CHANGE_SAME,
    CHANGE_SIGNIFICANT,
    CHANGE_UNDECIDED,
    CHANGE_OTHER,
    CHANGE_COUNT
};

struct compare_row {
    const struct results_row *old, *new; /* one is NULL for a run that failed on one side */
    enum change change;
    double difference;  /* d; of values without scatter the largest; NaN: there is none */
    double uncertainty; /* standard uncertainty of d; NaN where not known */
    double half_width;  /* h */
    double unit;        /* T */
    const char *how;    /* "paired, 4 seeds", "separate", "without scatter", "" */
    const char *note;   /* why not comparable, what is missing; "" for nothing to say */
};

struct compared {
    struct arena arena;
    const struct results *old, *new; /* borrowed */
    double level;                    /* of the whole comparison */
    size_t tests;                    /* rows over which it is divided */
    const char *refusal;             /* why nothing at all can be compared, or NULL */
    size_t row_count, added_count, removed_count;
    struct compare_row *row;
    const struct results_row **added, **removed; /* checks of one side only */
    size_t count[CHANGE_COUNT];
};

/* 0 < level < 1. */
enum status compare_results(const struct results *old, const struct results *new, double level,
                            struct compared **out, struct fault *fault);
void compare_free(struct compared *c); /* NULL is allowed */

/* 2 not comparable before 1 significant before 3 undecided before 0. */
int compare_exit_code(const struct compared *c);

const char *compare_change_name(enum change c); /* "unchanged", ... as above */

#endif
