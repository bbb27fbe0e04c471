/* judge.h -- a verdict from samples: pass, fail, or too little to say.
 *
 * A check compares measured values m_i, one a seed, with expected values e_i.
 * Judged is the mean d of d_i = m_i - e_i, with its interval d +- h (95 %):
 *
 *     known scatter s            h = 1.96 s / sqrt(n)            (normal)
 *     none given, n >= 2         h = t(n-1) sd(d_i) / sqrt(n)    (Student)
 *     a fit over the sweep       h = 1.96 u, u from the fit
 *
 * PASS when all of d +- h is accepted, FAIL when none of it is, INCONCLUSIVE
 * between, and whenever a value is missing.  Accepted, with margin T:
 *
 *     within   |d| <= T        outside   |d| > T
 *     at most   d  <= T        at least   d  >= -T
 *
 * Round-off checks, and model checks that declare `scatter: 0`, have h = 0 and
 * judge every sample by itself, so that +1 and -1 cannot cancel.  A declared
 * scatter that the seeds contradict (chi-square, 1e-5) proves nothing and is
 * INCONCLUSIVE; so are seeds that agree to the last bit where scatter is
 * expected, for they are not independent.  An infinite value fails.
 *
 * Source:     Student, Biometrika 6, 1 (1908), for t(n-1).
 * Leaves out: budgets of false alarms, correlation between checks.
 * Checked by: tests/unit/test_judge.c, each comparison on both sides.
 */
#ifndef VALIDATION_JUDGE_H
#define VALIDATION_JUDGE_H

#include "report/report.h"
#include "validation/case.h"

struct judge_question {
    enum comparison comparison;
    enum check_kind kind;
    struct case_amount margin, scatter;
    size_t count;                /* samples asked for */
    const double *measured;      /* measured[0 .. count-1]; NaN: missing */
    const double *expected;      /* expected[0 .. count-1] */
    double expected_uncertainty; /* standard uncertainty of the expectation itself */
    bool fitted;                 /* one sample, the result of a fit */
    double fit_uncertainty;      /* its standard uncertainty; NaN: unknown */
    const char *missing;         /* why a sample is NaN, or NULL */
};

enum { JUDGE_REASON_SIZE = 320 };

struct judge_answer {
    enum verdict verdict;
    double measured, uncertainty, expected, expected_uncertainty;
    double tolerance, interval;     /* T and h; NaN where they do not exist */
    char reason[JUDGE_REASON_SIZE]; /* one sentence with numbers */
};

void judge_check(const struct judge_question *q, struct judge_answer *out);

/* What d +- h says about the accepted set: the heart of the above. */
enum verdict judge_interval(enum comparison c, double d, double h, double tolerance);

#endif
