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
 * scatter that the seeds contradict (chi-square, a tenth of the check's alarm
 * rate) proves nothing and is INCONCLUSIVE; so are seeds that agree to the last bit where scatter
 * is expected, for they are not independent.  An infinite value fails.
 *
 * A regression check asks whether anything has changed since a stored ensemble
 * of K seeds (mean mu, deviation s) was made.  It fails when
 *
 *     |m - mu| > t(K-1) s sqrt(1/n + 1/K)      nine tenths of the alarm rate
 *     sd(m_i) > s sqrt(F(n-1, K-1))            a tenth of it, n >= 2
 *
 * so that seeds that part in both directions cannot cancel either; the run's own
 * scatter never widens what is accepted.  A paired one judges every seed against
 * the same seed of the reference, with its margin.
 *
 * A known disagreement turns FAIL into KNOWN, and PASS into FAIL: what agrees
 * again is no longer known.  Infinite values stay failures.
 *
 * Source:     Student, Biometrika 6, 1 (1908), for t(n-1).
 * Leaves out: correlation between checks, distributions that are not normal.
 * Checked by: tests/unit/test_judge.c, each comparison on both sides;
 *             tests/unit/test_judge_regression.c, the alarm rate by simulation.
 */
#ifndef VALIDATION_JUDGE_H
#define VALIDATION_JUDGE_H

#include "report/report.h"
#include "validation/case.h"

/* What a run is compared with by a regression check. */
struct judge_ensemble {
    size_t seeds;           /* 0: there is none */
    double mean, deviation; /* deviation from seed to seed */
};

struct judge_question {
    enum comparison comparison;
    enum check_kind kind;
    struct case_amount margin, scatter;
    size_t count;                /* samples asked for */
    const double *measured;      /* measured[0 .. count-1]; NaN: missing */
    const double *expected;      /* expected[0 .. count-1]; NULL where an ensemble judges */
    double expected_uncertainty; /* standard uncertainty of the expectation itself */
    bool fitted;                 /* one sample, the result of a fit */
    size_t seeds;                /* that went into the fit; regression only */
    double fit_uncertainty;      /* its standard uncertainty; NaN: unknown */
    const char *missing;         /* why a sample is NaN, or NULL */
    bool paired;                 /* regression, seed by seed: expected[] are the reference's */
    struct judge_ensemble ensemble;
    double alarm_rate;        /* the check's share of the budget; 0: none given */
    const char *no_reference; /* why there is no ensemble or no pair, or NULL */
    const char *known_since;  /* NULL: no disagreement is known */
};

enum { JUDGE_REASON_SIZE = 400 };

struct judge_answer {
    enum verdict verdict;
    double measured, uncertainty, expected, expected_uncertainty;
    double tolerance, interval;     /* T and h; NaN where they do not exist */
    char reason[JUDGE_REASON_SIZE]; /* one sentence with numbers */
};

void judge_check(const struct judge_question *q, struct judge_answer *out);

/* A margin, a scatter or a change to be detected, in the unit of the expectation. */
double judge_amount(const struct case_amount *a, double expected);

/* Smallest change that a regression check sees with 95 %, in the unit of its values (power.h);
 * of pairs, twice the margin: of that round-off may use up one, and a change as large is seen
 * whatever round-off does.  NaN for other kinds and without a usable reference. */
double judge_detectable(const struct judge_question *q);

/* Alarm rate of each of a regression check's two questions; the spread is asked of two seeds. */
double judge_share_of_mean(double alarm_rate, size_t seeds);
double judge_share_of_spread(double alarm_rate, size_t seeds);

/* What d +- h says about the accepted set: the heart of the above. */
enum verdict judge_interval(enum comparison c, double d, double h, double tolerance);

/* Which d pass, and which fail: those from low to high, or all others.  None where low > high. */
struct judge_range {
    double low, high;
    bool outside;
};
struct judge_range judge_passing(enum comparison c, double h, double tolerance);
struct judge_range judge_failing(enum comparison c, double h, double tolerance);

/* h from standard uncertainties; freedom INFINITY: normal. */
double judge_half_width(double uncertainty, double expected_uncertainty, double freedom);

/* Seeds that scatter by more than this times the declared scatter refute it: once in
 * 10/alarm_rate runs by chance (1e5 where the rate is 0: none was given). */
double judge_refuting_ratio(size_t seeds, double alarm_rate);

#endif
