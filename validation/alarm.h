/* alarm.h -- how often a model check would not pass though nothing has changed.
 *
 * An ensemble of K seeds gave the mean D and the deviation s of measured minus
 * expected.  What n new seeds of unchanged code will give is predicted by it:
 *
 *     mean d:        (d - D) / (p sqrt(1/n + 1/K)) is Student's t
 *     deviation v:   v^2/s^2 is F(n-1, K-1)
 *
 * p pools both deviations, p^2 = ((K-1) s^2 + (n-1) v^2) / (n+K-2); the t has as
 * many degrees of freedom as stand below the line and is independent of v/s, so that
 * the rate is one integral over v: of the probability that d +- h, with h from v or
 * from the declared scatter, does not lie where the usual verdict needs it, and of 1
 * where v refutes the declared scatter.
 *
 * Of a fit over a sweep the uncertainty is taken for s/sqrt(n).
 *
 * Source:     D. Basu, Sankhya 15, 377 (1955), for the independence; the rest is
 *             the predictive distribution of a normal sample.
 * Leaves out: distributions that are not normal, expectations that scatter on
 *             their own beside the difference.
 * Checked by: tests/unit/test_alarm.c, by simulation with the judge himself.
 */
#ifndef VALIDATION_ALARM_H
#define VALIDATION_ALARM_H

#include "validation/judge.h"

struct alarm_question {
    enum comparison comparison;
    double tolerance;               /* T */
    struct judge_ensemble ensemble; /* of measured - expected */
    size_t seeds;                   /* of a run */
    bool fitted;
    double declared; /* scatter; NaN: none */
    double expected_uncertainty;
    double share; /* of the budget, as the judge is given it */
    bool known;   /* an alarm is then whatever does not fail */
};

/* Probability of another verdict than the usual one; NaN without an ensemble. */
double alarm_rate(const struct alarm_question *q);

#endif
