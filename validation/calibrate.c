#include "validation/calibrate.h"

#include "validation/alarm.h"
#include "validation/judge.h"
#include "validation/power.h"

#include <gsl/gsl_cdf.h>
#include <gsl/gsl_statistics_double.h>
#include <math.h>

/* Mean expectation of the first `count` seeds; of a difference 0. */
static double expected_of(const struct scatter *s, size_t count) {
    return gsl_stats_mean(s->expected, 1, count);
}

/* A margin or a scatter in the row's unit: percentages are of the expectation, of which a
 * difference holds nothing any more. */
static struct case_amount absolute(const struct scatter *s, const struct case_amount *a) {
    return (struct case_amount){.given = a->given, .value = judge_amount(a, s->scale)};
}

static double tolerance_of(const struct scatter *s) {
    return s->check->kind == KIND_REGRESSION ? NAN : judge_amount(&s->check->margin, s->scale);
}

/* Of measured - expected: the expectation of a row is the same in every run, or subtracted. */
static struct alarm_question ask_alarm(const struct scatter *s, size_t count, double mean,
                                       double deviation, size_t n, double share) {
    double expected = expected_of(s, count);
    return (struct alarm_question){
        .comparison = s->check->comparison,
        .tolerance = tolerance_of(s),
        .ensemble = {.seeds = count, .mean = mean - expected, .deviation = deviation},
        .seeds = n,
        .fitted = s->check->number.across,
        .declared = s->check->scatter.given ? judge_amount(&s->check->scatter, s->scale) : NAN,
        .expected_uncertainty = s->expected_uncertainty,
        .share = share,
        .known = s->check->known_since != NULL};
}

/* A declared scatter that new seeds refute (judge.h) in half of the share at the most. */
static double propose_scatter(const struct alarm_question *q) {
    double s = q->ensemble.deviation;
    if (q->fitted || q->seeds < 2)
        return s;
    double widest =
        gsl_cdf_fdist_Qinv(q->share / 2, (double)q->seeds - 1, (double)q->ensemble.seeds - 1);
    return s * fmax(1, sqrt(widest) / judge_refuting_ratio(q->seeds, q->share));
}

/* The least margin that keeps to the share, by bisection: the rate falls as it grows. */
static double propose_margin(struct alarm_question q, double scatter) {
    double low = 0, high = fabs(q.ensemble.mean) + q.ensemble.deviation;
    q.declared = scatter;
    for (int i = 0; i < 60; i++) {
        q.tolerance = high;
        if (alarm_rate(&q) <= q.share)
            break;
        low = high;
        high *= 2;
    }
    q.tolerance = high;
    if (!(alarm_rate(&q) <= q.share))
        return NAN;
    for (int i = 0; i < 40 && high - low > 1e-4 * high; i++) {
        q.tolerance = (low + high) / 2;
        if (alarm_rate(&q) <= q.share)
            high = q.tolerance;
        else
            low = q.tolerance;
    }
    return high;
}

void calibrate_row(const struct scatter *s, size_t n, double share, struct calibrate_row *out) {
    *out = (struct calibrate_row){NAN, NAN, NAN, NAN, NAN};
    if (s->missing != NULL)
        return;
    out->detectable = power_detectable(s->deviation, n, s->count, judge_share_of_mean(share, n));
    if (s->check->kind == KIND_REGRESSION) {
        out->rate = share;
        return;
    }
    struct alarm_question q = ask_alarm(s, s->count, s->mean, s->deviation, n, share);
    out->tolerance = q.tolerance;
    out->rate = alarm_rate(&q);
    if (q.comparison == COMPARE_OUTSIDE || q.known)
        return;
    out->scatter = propose_scatter(&q);
    out->margin = propose_margin(q, out->scatter);
}

/* -- seeds held out ----------------------------------------------------------------------- */

/* A run of n seeds, judged under the present margin. */
static enum verdict judge_present(const struct scatter *s, const struct judge_ensemble *half,
                                  size_t first, size_t n, double share) {
    struct judge_answer answer;
    double value = gsl_stats_mean(s->value + first, 1, n), expected = s->expected[first];
    struct judge_question q = {.comparison = s->check->comparison,
                               .kind = s->check->kind,
                               .margin = absolute(s, &s->check->margin),
                               .scatter = absolute(s, &s->check->scatter),
                               .count = n,
                               .measured = s->value + first,
                               .expected = s->expected + first,
                               .expected_uncertainty = s->expected_uncertainty,
                               .ensemble = *half,
                               .alarm_rate = share,
                               .known_since = s->check->known_since};
    if (s->check->number.across && s->check->kind != KIND_REGRESSION) {
        q.fitted = true;
        q.count = 1;
        q.measured = &value;
        q.expected = &expected;
        q.fit_uncertainty = half->deviation / sqrt((double)n);
    }
    judge_check(&q, &answer);
    return answer.verdict;
}

static enum verdict compare_halves(const struct scatter *s, const struct judge_ensemble *half,
                                   size_t first, size_t n) {
    struct judge_answer answer;
    struct judge_question q = {.kind = KIND_REGRESSION,
                               .count = n,
                               .measured = s->value + first,
                               .ensemble = *half,
                               .alarm_rate = CALIBRATE_LEVEL};
    judge_check(&q, &answer);
    return answer.verdict;
}

void calibrate_hold_out(const struct scatter *s, size_t n, double share,
                        struct calibrate_count *out) {
    size_t half = s->count / 2;
    *out = (struct calibrate_count){0};
    if (s->missing != NULL || half < 2 || n == 0 || s->count - half < n)
        return;
    struct judge_ensemble e = {.seeds = half, .mean = gsl_stats_mean(s->value, 1, half)};
    e.deviation = gsl_stats_sd_m(s->value, 1, half, e.mean);
    out->calibrating = half;
    out->groups = (s->count - half) / n;
    enum verdict usual = s->check->known_since != NULL ? VERDICT_KNOWN : VERDICT_PASS;
    for (size_t g = 0; g < out->groups; g++) {
        out->not_pass += judge_present(s, &e, half + g * n, n, share) != usual;
        out->beyond += compare_halves(s, &e, half + g * n, n) != VERDICT_PASS;
    }
    struct alarm_question q = ask_alarm(s, half, e.mean, e.deviation, n, share);
    double rate = s->check->kind == KIND_REGRESSION ? share : alarm_rate(&q);
    out->expected = rate * (double)out->groups;
}
