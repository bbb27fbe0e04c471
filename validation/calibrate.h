/* calibrate.h -- what many seeds say about a row: its alarm rate, a margin that keeps to its
 * share of the budget, the change that it can see, and whether all that holds on other seeds.
 *
 * A row's seeds (scatter.h) are split: the first half calibrates; the others, in groups of as
 * many as the case's own run has, are judged as runs would be.
 *
 *     under the present margin             how many do not pass, beside the predicted rate
 *     compared with the first half         how many part from it by more than one in ten runs
 *     (judge.h, regression)                should: a level at which some can be expected
 *
 * Proposed are a scatter, the deviation found or as much more as keeps the judge from refuting it
 * by chance, and with it the least margin whose predicted alarm rate (alarm.h) keeps to the
 * share.  A proposal is no reason: `because` has to give one.
 *
 * Leaves out: comparisons `outside`, for which a margin is to be lowered; and pairs.
 * Checked by: tests/unit/test_calibrate.c.
 */
#ifndef VALIDATION_CALIBRATE_H
#define VALIDATION_CALIBRATE_H

#include "validation/scatter.h"

/* Alarm rate of the comparison of halves. */
#define CALIBRATE_LEVEL 0.1

struct calibrate_row { /* NaN where there is none */
    double tolerance;  /* present, in the row's unit */
    double rate;       /* predicted alarm rate under it */
    double scatter;    /* proposed to be declared */
    double margin;     /* proposed with it */
    double detectable; /* smallest change that a regression check would see with 95 % */
};

/* s of all seeds, runs of n seeds; `share` of the budget of false alarms. */
void calibrate_row(const struct scatter *s, size_t n, double share, struct calibrate_row *out);

struct calibrate_count {
    size_t calibrating, groups; /* seeds of the first half; runs that the others make */
    size_t not_pass;            /* under the present margin */
    double expected;            /* of them, from the first half; NaN: not to be had */
    size_t beyond;              /* compared with the first half at CALIBRATE_LEVEL */
};

/* All 0 where the seeds do not suffice: 2 and a group. */
void calibrate_hold_out(const struct scatter *s, size_t n, double share,
                        struct calibrate_count *out);

#endif
