#include "validation/judge.h"

#include <gsl/gsl_cdf.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>

static const double confidence = 0.95;
/* A declared scatter is refuted when seeds scatter so much with this probability. */
static const double refutation = 1e-5;

enum verdict judge_interval(enum comparison c, double d, double h, double tolerance) {
    double low = d - h, high = d + h;
    bool pass = false, fail = true;
    switch (c) {
    case COMPARE_WITHIN:
        pass = low >= -tolerance && high <= tolerance;
        fail = high < -tolerance || low > tolerance;
        break;
    case COMPARE_OUTSIDE:
        pass = low > tolerance || high < -tolerance;
        fail = low >= -tolerance && high <= tolerance;
        break;
    case COMPARE_AT_MOST:
        pass = high <= tolerance;
        fail = low > tolerance;
        break;
    case COMPARE_AT_LEAST:
        pass = low >= -tolerance;
        fail = high < -tolerance;
        break;
    }
    if (!isfinite(d) || !isfinite(h) || !isfinite(tolerance))
        return VERDICT_INCONCLUSIVE;
    return pass ? VERDICT_PASS : fail ? VERDICT_FAIL : VERDICT_INCONCLUSIVE;
}

static double amount_of(const struct case_amount *a, double expected) {
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
    double h = gsl_cdf_ugaussian_Pinv((1 + confidence) / 2) * q->expected_uncertainty;
    enum verdict v = VERDICT_PASS;
    for (size_t i = 0; i < q->count; i++) {
        double d = q->measured[i] - q->expected[i];
        double tolerance = amount_of(&q->margin, q->expected[i]);
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

/* Standard uncertainty of the mean and its quantile; false: there is none, and why. */
static bool find_uncertainty(const struct judge_question *q, struct judge_answer *out,
                             double *quantile) {
    double n = (double)q->count, sd = deviation(q);
    *quantile = gsl_cdf_ugaussian_Pinv((1 + confidence) / 2);
    if (q->fitted) {
        out->uncertainty = q->fit_uncertainty;
        if (!isfinite(out->uncertainty) || out->uncertainty < 0)
            say(out, VERDICT_INCONCLUSIVE, "the fit gives %.6g without an uncertainty",
                out->measured);
        return isfinite(out->uncertainty) && out->uncertainty >= 0;
    }
    if (q->scatter.given) {
        double s = amount_of(&q->scatter, out->expected);
        out->uncertainty = s / sqrt(n);
        double limit = q->count < 2 ? INFINITY : gsl_cdf_chisq_Qinv(refutation, n - 1);
        if (q->count < 2 || (n - 1) * sd * sd <= limit * s * s)
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
    *quantile = gsl_cdf_tdist_Pinv((1 + confidence) / 2, n - 1);
    return true;
}

static void judge_mean(const struct judge_question *q, struct judge_answer *out) {
    double quantile;
    out->measured = mean_of(q->measured, q->count);
    out->expected = mean_of(q->expected, q->count);
    out->tolerance = amount_of(&q->margin, out->expected);
    if (!find_uncertainty(q, out, &quantile))
        return;
    out->interval = quantile * hypot(out->uncertainty, out->expected_uncertainty);
    enum verdict v =
        judge_interval(q->comparison, out->measured - out->expected, out->interval, out->tolerance);
    say_interval(q, out, v);
}

/* Values that cannot be judged: shown, never passed. */
static bool is_complete(const struct judge_question *q, struct judge_answer *out) {
    size_t missing = 0, infinite = 0;
    for (size_t i = 0; i < q->count; i++) {
        missing += isnan(q->measured[i]) || isnan(q->expected[i]);
        infinite += isinf(q->measured[i]) || isinf(q->expected[i]);
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
    out->tolerance = amount_of(&q->margin, out->expected);
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
    if (!is_complete(q, out))
        show_rest(q, out);
    else if (q->kind == KIND_ROUND_OFF || (declared_exact && !q->fitted))
        judge_each(q, out);
    else
        judge_mean(q, out);
}
