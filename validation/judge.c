#include "validation/judge.h"

#include "validation/power.h"

#include <gsl/gsl_cdf.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>

static const double confidence = 0.95;
/* A declared scatter is refuted by seeds that scatter as much with this probability, where no
 * alarm rate is given. */
static const double refutation = 1e-5;
/* Part of a check's alarm rate that goes to the scatter of its seeds. */
static const double spread_part = 0.1;

struct judge_range judge_passing(enum comparison c, double h, double tolerance) {
    switch (c) {
    case COMPARE_WITHIN:
        return (struct judge_range){-tolerance + h, tolerance - h, false};
    case COMPARE_OUTSIDE:
        return (struct judge_range){-tolerance - h, tolerance + h, true};
    case COMPARE_AT_MOST:
        return (struct judge_range){-INFINITY, tolerance - h, false};
    case COMPARE_AT_LEAST:
        return (struct judge_range){-tolerance + h, INFINITY, false};
    }
    return (struct judge_range){NAN, NAN, false};
}

/* What fails one comparison passes the opposite one. */
struct judge_range judge_failing(enum comparison c, double h, double tolerance) {
    switch (c) {
    case COMPARE_WITHIN:
        return judge_passing(COMPARE_OUTSIDE, h, tolerance);
    case COMPARE_OUTSIDE:
        return judge_passing(COMPARE_WITHIN, h, tolerance);
    case COMPARE_AT_MOST:
        return judge_passing(COMPARE_AT_LEAST, h, -tolerance);
    case COMPARE_AT_LEAST:
        return judge_passing(COMPARE_AT_MOST, h, -tolerance);
    }
    return (struct judge_range){NAN, NAN, false};
}

static bool lies_in(const struct judge_range *r, double d) {
    return r->outside ? d < r->low || d > r->high : d >= r->low && d <= r->high;
}

enum verdict judge_interval(enum comparison c, double d, double h, double tolerance) {
    struct judge_range pass = judge_passing(c, h, tolerance);
    struct judge_range fail = judge_failing(c, h, tolerance);
    if (!isfinite(d) || !isfinite(h) || !isfinite(tolerance))
        return VERDICT_INCONCLUSIVE;
    if (lies_in(&pass, d))
        return VERDICT_PASS;
    return lies_in(&fail, d) ? VERDICT_FAIL : VERDICT_INCONCLUSIVE;
}

double judge_half_width(double uncertainty, double expected_uncertainty, double freedom) {
    double p = (1 + confidence) / 2;
    double quantile = isinf(freedom) ? gsl_cdf_ugaussian_Pinv(p) : gsl_cdf_tdist_Pinv(p, freedom);
    return quantile * hypot(uncertainty, expected_uncertainty);
}

double judge_refuting_ratio(size_t seeds, double alarm_rate) {
    double freedom = (double)seeds - 1;
    double p = alarm_rate > 0 ? spread_part * alarm_rate : refutation;
    return seeds < 2 ? INFINITY : sqrt(gsl_cdf_chisq_Qinv(p, freedom) / freedom);
}

double judge_amount(const struct case_amount *a, double expected) {
    return a->percent ? a->value / 100 * fabs(expected) : a->value;
}

static double mean_of(const double *x, size_t count) {
    double sum = 0;
    for (size_t i = 0; i < count; i++)
        sum += x[i];
    return sum / (double)count;
}

static void say(struct judge_answer *out, enum verdict v, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

static void say(struct judge_answer *out, enum verdict v, const char *format, ...) {
    va_list list;
    va_start(list, format);
    vsnprintf(out->reason, sizeof out->reason, format, list);
    va_end(list);
    out->verdict = v;
}

/* "1.285 (95 %: 1.262 to 1.308) lies within 1.29 +- 0.0387" */
static void say_interval(const struct judge_question *q, struct judge_answer *out, enum verdict v) {
    static const char *const lies[] = {"lies", "does not lie", "may lie"};
    char value[96], accepted[96];
    double m = out->measured, h = out->interval, e = out->expected, t = out->tolerance;
    if (h > 0)
        snprintf(value, sizeof value, "%.6g (95 %%: %.6g to %.6g)", m, m - h, m + h);
    else
        snprintf(value, sizeof value, "%.6g", m);
    switch (q->comparison) {
    case COMPARE_WITHIN:
    case COMPARE_OUTSIDE:
        snprintf(accepted, sizeof accepted, "%s %.6g +- %.3g", case_comparison_name(q->comparison),
                 e, t);
        break;
    case COMPARE_AT_MOST:
        snprintf(accepted, sizeof accepted, "at or below %.6g", e + t);
        break;
    case COMPARE_AT_LEAST:
        snprintf(accepted, sizeof accepted, "at or above %.6g", e - t);
        break;
    }
    say(out, v, "%s %s %s", value, lies[v], accepted);
}

/* How far a sample is from being accepted; positive: it is not. */
static double excess(enum comparison c, double d, double tolerance) {
    switch (c) {
    case COMPARE_WITHIN:
        return fabs(d) - tolerance;
    case COMPARE_OUTSIDE:
        return tolerance - fabs(d);
    case COMPARE_AT_MOST:
        return d - tolerance;
    case COMPARE_AT_LEAST:
        return -d - tolerance;
    }
    return NAN;
}

/* Every sample by itself; the worst one is shown. */
static void judge_each(const struct judge_question *q, struct judge_answer *out) {
    double worst = -INFINITY;
    double h = judge_half_width(0, q->expected_uncertainty, INFINITY);
    enum verdict v = VERDICT_PASS;
    for (size_t i = 0; i < q->count; i++) {
        double d = q->measured[i] - q->expected[i];
        double tolerance = judge_amount(&q->margin, q->expected[i]);
        double beyond = excess(q->comparison, d, tolerance);
        enum verdict one = judge_interval(q->comparison, d, h, tolerance);
        if (one == VERDICT_FAIL || v == VERDICT_PASS)
            v = one;
        if (beyond > worst || i == 0) {
            worst = beyond;
            out->measured = q->measured[i];
            out->expected = q->expected[i];
            out->tolerance = tolerance;
        }
    }
    out->uncertainty = 0;
    out->interval = h;
    say_interval(q, out, v);
}

/* Standard deviation of measured - expected. */
static double deviation(const struct judge_question *q) {
    double mean = 0, squares = 0;
    for (size_t i = 0; i < q->count; i++)
        mean += (q->measured[i] - q->expected[i]) / (double)q->count;
    for (size_t i = 0; i < q->count; i++) {
        double d = q->measured[i] - q->expected[i] - mean;
        squares += d * d;
    }
    return q->count < 2 ? NAN : sqrt(squares / (double)(q->count - 1));
}

/* Standard uncertainty of the mean and its degrees of freedom; false: there is none, and why. */
static bool find_uncertainty(const struct judge_question *q, struct judge_answer *out,
                             double *freedom) {
    double n = (double)q->count, sd = deviation(q);
    *freedom = INFINITY;
    if (q->fitted) {
        out->uncertainty = q->fit_uncertainty;
        if (!isfinite(out->uncertainty) || out->uncertainty < 0)
            say(out, VERDICT_INCONCLUSIVE, "the fit gives %.6g without an uncertainty",
                out->measured);
        return isfinite(out->uncertainty) && out->uncertainty >= 0;
    }
    if (q->scatter.given) {
        double s = judge_amount(&q->scatter, out->expected);
        out->uncertainty = s / sqrt(n);
        if (q->count < 2 || sd <= judge_refuting_ratio(q->count, q->alarm_rate) * s)
            return true;
        say(out, VERDICT_INCONCLUSIVE,
            "the seeds scatter by %.3g, far more than the %.3g that the check declares", sd, s);
        return false;
    }
    out->uncertainty = sd / sqrt(n);
    if (q->count < 2) {
        say(out, VERDICT_INCONCLUSIVE,
            "%.6g from one seed: its scatter is not known (give more seeds or `scatter`)",
            out->measured);
        return false;
    }
    if (!(sd > 0)) {
        say(out, VERDICT_INCONCLUSIVE,
            "%zu seeds agree to the last bit on %.6g: not independent, or without scatter "
            "(then say `scatter: 0`)",
            q->count, out->measured);
        return false;
    }
    *freedom = n - 1;
    return true;
}

static void judge_mean(const struct judge_question *q, struct judge_answer *out) {
    double freedom;
    out->measured = mean_of(q->measured, q->count);
    out->expected = mean_of(q->expected, q->count);
    out->tolerance = judge_amount(&q->margin, out->expected);
    if (!find_uncertainty(q, out, &freedom))
        return;
    out->interval = judge_half_width(out->uncertainty, out->expected_uncertainty, freedom);
    enum verdict v =
        judge_interval(q->comparison, out->measured - out->expected, out->interval, out->tolerance);
    say_interval(q, out, v);
}

/* -- against a stored ensemble ---------------------------------------------------- */

double judge_share_of_spread(double alarm_rate, size_t seeds) {
    return seeds < 2 ? 0 : spread_part * alarm_rate;
}

double judge_share_of_mean(double alarm_rate, size_t seeds) {
    return alarm_rate - judge_share_of_spread(alarm_rate, seeds);
}

/* Why there is nothing to compare with, or NULL. */
static const char *lack_of_ensemble(const struct judge_question *q) {
    const struct judge_ensemble *e = &q->ensemble;
    if (e->seeds < 2)
        return "no stored ensemble";
    if (!(isfinite(e->mean) && isfinite(e->deviation) && e->deviation > 0))
        return "the stored ensemble has no scatter";
    if (!(q->alarm_rate > 0 && q->alarm_rate < 1))
        return "no share of the false alarms was given";
    if (q->fitted && q->seeds < 1)
        return "the seeds of the fit are not known";
    return NULL;
}

static const char *lack_of_pairs(const struct judge_question *q) {
    for (size_t i = 0; i < q->count; i++) {
        if (!isfinite(q->expected[i]))
            return "no stored value of this seed";
    }
    return q->margin.given ? NULL : "no margin was given";
}

static bool has_reference(const struct judge_question *q, struct judge_answer *out) {
    const char *why = q->no_reference;
    if (why == NULL)
        why = q->paired ? lack_of_pairs(q) : lack_of_ensemble(q);
    if (why != NULL)
        say(out, VERDICT_INCONCLUSIVE, "not compared: %s", why);
    return why == NULL;
}

/* Standard deviation of the measured values; NaN of one. */
static double spread_of(const double *x, size_t count) {
    double mean = mean_of(x, count), squares = 0;
    for (size_t i = 0; i < count; i++)
        squares += (x[i] - mean) * (x[i] - mean);
    return count < 2 ? NAN : sqrt(squares / (double)(count - 1));
}

/* Seeds that scatter too much, or not at all; true: nothing is wrong with them. */
static bool spread_is_fair(const struct judge_question *q, struct judge_answer *out) {
    const struct judge_ensemble *e = &q->ensemble;
    double sd = spread_of(q->measured, q->count);
    double share = judge_share_of_spread(q->alarm_rate, q->count);
    if (q->count < 2)
        return true;
    double most =
        e->deviation * sqrt(gsl_cdf_fdist_Qinv(share, (double)q->count - 1, (double)e->seeds - 1));
    if (!(sd > 0))
        say(out, VERDICT_INCONCLUSIVE, "%zu seeds agree to the last bit on %.6g: not independent",
            q->count, out->measured);
    else if (!(sd <= most))
        say(out, VERDICT_FAIL,
            "the seeds scatter by %.3g, more than %.3g; those of the reference by %.3g", sd, most,
            e->deviation);
    return sd > 0 && sd <= most;
}

/* Seeds that the judged number is made of, and of those whose scatter is seen. */
static size_t seeds_behind(const struct judge_question *q) {
    return q->fitted ? q->seeds : q->count;
}

static size_t seeds_seen(const struct judge_question *q) {
    return q->fitted ? 1 : q->count;
}

static void judge_regression(const struct judge_question *q, struct judge_answer *out) {
    const struct judge_ensemble *e = &q->ensemble;
    size_t n = seeds_behind(q);
    double level = judge_share_of_mean(q->alarm_rate, seeds_seen(q));
    double scale = power_scale(e->deviation, n, e->seeds);
    double quantile = power_quantile(level, (double)e->seeds - 1);
    out->measured = mean_of(q->measured, q->count);
    out->uncertainty = e->deviation / sqrt((double)n);
    out->expected = e->mean;
    out->expected_uncertainty = e->deviation / sqrt((double)e->seeds);
    out->tolerance = quantile * scale;
    out->interval = 0;
    if (!spread_is_fair(q, out))
        return;
    double z = (out->measured - e->mean) / scale;
    bool fair = fabs(z) <= quantile;
    say(out, fair ? VERDICT_PASS : VERDICT_FAIL,
        "%.6g %s within %.6g +- %.3g of %zu seeds (z = %.2f, limit %.2f)", out->measured,
        fair ? "lies" : "does not lie", e->mean, out->tolerance, e->seeds, z, quantile);
}

double judge_detectable(const struct judge_question *q) {
    const struct judge_ensemble *e = &q->ensemble;
    if (q->kind != KIND_REGRESSION || (!q->paired && lack_of_ensemble(q) != NULL))
        return NAN;
    if (!q->paired)
        return power_detectable(e->deviation, seeds_behind(q), e->seeds,
                                judge_share_of_mean(q->alarm_rate, seeds_seen(q)));
    double widest = 0;
    for (size_t i = 0; i < q->count; i++)
        widest = fmax(widest, 2 * judge_amount(&q->margin, q->expected[i]));
    return lack_of_pairs(q) == NULL ? widest : NAN;
}

/* -- known disagreements ----------------------------------------------------------- */

/* The verdict on finite values turned round. */
static void turn_known(const struct judge_question *q, struct judge_answer *out) {
    char reason[JUDGE_REASON_SIZE];
    if (q->known_since == NULL || out->verdict == VERDICT_INCONCLUSIVE)
        return;
    snprintf(reason, sizeof reason, "%s", out->reason);
    if (out->verdict == VERDICT_PASS)
        say(out, VERDICT_FAIL, "agrees now, remove `known`: %s", reason);
    else
        say(out, VERDICT_KNOWN, "known since %s: %s", q->known_since, reason);
}

/* Values that cannot be judged: shown, never passed. */
static bool is_complete(const struct judge_question *q, struct judge_answer *out) {
    size_t missing = 0, infinite = 0;
    for (size_t i = 0; i < q->count; i++) {
        double expected = q->kind == KIND_REGRESSION ? 0 : q->expected[i]; /* see has_reference */
        missing += isnan(q->measured[i]) || isnan(expected);
        infinite += isinf(q->measured[i]) || isinf(expected);
    }
    if (infinite > 0)
        say(out, VERDICT_FAIL, "an infinite value in %zu of %zu runs", infinite, q->count);
    else if (q->count == 0)
        say(out, VERDICT_INCONCLUSIVE, "no run gave a value");
    else if (missing > 0)
        say(out, VERDICT_INCONCLUSIVE, "no value from %zu of %zu %s: %s", missing, q->count,
            q->fitted ? "fits" : "runs", q->missing == NULL ? "not a number" : q->missing);
    return infinite + missing == 0 && q->count > 0;
}

/* What can be shown of an incomplete set: the mean of what is there. */
static void show_rest(const struct judge_question *q, struct judge_answer *out) {
    double m = 0, e = 0;
    size_t count = 0;
    for (size_t i = 0; i < q->count; i++) {
        if (!isfinite(q->measured[i]) || !isfinite(q->expected[i]))
            continue;
        m += q->measured[i];
        e += q->expected[i];
        count++;
    }
    if (count == 0)
        return;
    out->measured = m / (double)count;
    out->expected = e / (double)count;
    out->tolerance = judge_amount(&q->margin, out->expected);
}

void judge_check(const struct judge_question *q, struct judge_answer *out) {
    *out = (struct judge_answer){.measured = NAN,
                                 .uncertainty = NAN,
                                 .expected = NAN,
                                 .expected_uncertainty = q->expected_uncertainty,
                                 .tolerance = NAN,
                                 .interval = NAN,
                                 .verdict = VERDICT_INCONCLUSIVE};
    bool declared_exact = q->scatter.given && !(q->scatter.value > 0);
    bool regression = q->kind == KIND_REGRESSION;
    if (!is_complete(q, out)) {
        if (!regression || q->paired)
            show_rest(q, out);
        return;
    }
    if (regression && !has_reference(q, out))
        out->measured = mean_of(q->measured, q->count);
    else if (regression && !q->paired)
        judge_regression(q, out);
    else if (regression || q->kind == KIND_ROUND_OFF || (declared_exact && !q->fitted))
        judge_each(q, out);
    else
        judge_mean(q, out);
    turn_known(q, out);
}
