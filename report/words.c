/* words.c -- see words.h. */
#include "report/words.h"

#include <math.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

static struct words say(const char *format, ...) __attribute__((format(printf, 1, 2)));

static struct words say(const char *format, ...) {
    struct words w;
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(w.text, sizeof w.text, format, arguments);
    va_end(arguments);
    return w;
}

/* "·10⁻⁵" */
static struct words power_of_ten(int exponent) {
    static const char *const digit[] = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
    char plain[16];
    struct words w = say("·10");
    snprintf(plain, sizeof plain, "%d", exponent);
    for (const char *s = plain; *s; s++)
        strcat(w.text, *s == '-' ? "⁻" : digit[*s - '0']);
    return w;
}

static int decade_of(double magnitude) {
    return (int)floor(log10(magnitude));
}

static bool is_fixed(double magnitude) {
    return magnitude == 0 || (magnitude >= 1e-3 && magnitude < 1e6);
}

static int between(int low, int value, int high) {
    return value < low ? low : value > high ? high : value;
}

/* Digits counted from the first one that is not 0; zeros at the end go. */
static struct words with_digits(double value, int digits) {
    if (isnan(value))
        return say("–");
    if (isinf(value))
        return say(value > 0 ? "∞" : "-∞");
    if (fabs(value) < 1e6 && is_fixed(fabs(value))) {
        int whole = value == 0 ? 1 : decade_of(fabs(value)) + 1;
        return say("%.*g", between(digits, whole, 7), value);
    }
    char plain[40];
    snprintf(plain, sizeof plain, "%.*e", digits - 1, value); /* rounds 9.99996e-6 up to 1.0e-5 */
    int exponent = atoi(strchr(plain, 'e') + 1);
    return say("%.*g%s", digits, strtod(plain, NULL) / pow(10, exponent),
               power_of_ten(exponent).text);
}

struct words words_number(double value) {
    return with_digits(value, 4);
}

struct words words_exact(double value) {
    return with_digits(value, 6);
}

/* The decade of u once it is rounded to two digits: .0999 is .10. */
static int decade_of_rounded(double u) {
    int decade = decade_of(u);
    return round(u / pow(10, decade - 1)) >= 100 ? decade + 1 : decade;
}

struct words words_measured(double value, double uncertainty) {
    if (!isfinite(value) || !isfinite(uncertainty) || uncertainty <= 0)
        return words_exact(value);
    double size = fmax(fabs(value), uncertainty);
    int decade = decade_of_rounded(uncertainty);
    if (is_fixed(size)) {
        double step = decade > 1 ? pow(10, decade - 1) : 1;
        int digits = between(0, 1 - decade, 15);
        if (decade > 1)
            return say("%.0f ± %.0f", round(value / step) * step, round(uncertainty / step) * step);
        return say("%.*f ± %.*f", digits, value, digits, uncertainty);
    }
    int exponent = decade_of(size);
    double scale = pow(10, exponent);
    int digits = between(0, 1 - decade + exponent, 15);
    return say("(%.*f ± %.*f)%s", digits, value / scale, digits, uncertainty / scale,
               power_of_ten(exponent).text);
}

static bool compares(const struct report_row *row, const char *how) {
    return strcmp(row->comparison ? row->comparison : "within", how) == 0;
}

struct words words_tolerance(const struct report_row *row) {
    struct words t = with_digits(row->tolerance, 3);
    if (isnan(row->tolerance))
        return say("–");
    if (compares(row, "at most"))
        return row->tolerance > 0 ? say("+ %s", t.text) : say("none");
    if (compares(row, "at least"))
        return row->tolerance > 0 ? say("- %s", t.text) : say("none");
    return say("± %s", t.text);
}

/* A limit to a hundredth of the tolerance: more digits would pretend. */
static struct words limit(double value, double tolerance) {
    if (tolerance <= 0 || !is_fixed(fabs(value)) || !is_fixed(tolerance))
        return words_exact(value);
    return say("%.*f", between(0, 2 - decade_of(tolerance), 15), value);
}

struct words words_accepted(const struct report_row *row) {
    double e = row->expected, t = row->tolerance;
    if (isnan(e) || isnan(t))
        return say("–");
    struct words low = limit(e - t, t), high = limit(e + t, t);
    if (compares(row, "at most"))
        return say("≤ %s", high.text);
    if (compares(row, "at least"))
        return say("≥ %s", low.text);
    if (compares(row, "outside"))
        return say("below %s or above %s", low.text, high.text);
    return t > 0 ? say("%s to %s", low.text, high.text) : say("%s exactly", low.text);
}

struct words words_margin(double used) {
    if (isnan(used))
        return say("–");
    if (used > 10)
        return say("over 1000 %%");
    if (used > 0 && used < .001)
        return say("under 0.1 %%");
    return say("%.*f %%", used > 0 && used < .0995 ? 1 : 0, 100 * used);
}

struct words words_seconds(double seconds) {
    if (!isfinite(seconds) || seconds < 0)
        return say("–");
    if (seconds < 99.5)
        return say("%.*g s", seconds < 10 ? 2 : 3, seconds);
    double whole = round(seconds);
    if (whole < 6000)
        return say("%.0f min %.0f s", floor(whole / 60), fmod(whole, 60));
    return say("%.0f h %.0f min", floor(whole / 3600), floor(fmod(whole, 3600) / 60));
}

struct words words_unit(const char *unit) {
    if (!unit || !*unit || strcmp(unit, "1") == 0)
        return say("%s", "");
    return say(" %s", unit);
}

const char *words_headline(const struct report *r) {
    struct report_count n = report_tally(r);
    if (n.pass + n.fail + n.inconclusive + n.known == 0)
        return "NOTHING JUDGED";
    switch (report_verdict(r)) {
    case VERDICT_PASS:
        return "PASS";
    case VERDICT_FAIL:
        return "FAIL";
    case VERDICT_KNOWN:
        return "ONLY KNOWN DISAGREEMENTS";
    default:
        return "INCONCLUSIVE";
    }
}

static const char *plural(size_t count) {
    return count == 1 ? "" : "s";
}

/* Cases that hold at least one row of this verdict; all that hold any row for NULL. */
static size_t cases_with(const struct report *r, const enum verdict *verdict) {
    size_t count = 0;
    for (size_t i = 0; i < r->case_count; i++) {
        bool found = false;
        for (size_t k = 0; k < r->cases[i].row_count && !found; k++)
            found = !verdict || r->cases[i].row[k].verdict == *verdict;
        count += found;
    }
    return count;
}

static void failing_sentence(FILE *out, const struct report *r, const struct report_count *n,
                             size_t all) {
    size_t bad = cases_with(r, &(enum verdict){VERDICT_FAIL});
    fprintf(out, "%zu of %zu check%s fail%s", n->fail, all, plural(all), n->fail == 1 ? "s" : "");
    fprintf(out, ", in %zu of %zu case%s", bad, cases_with(r, NULL), plural(cases_with(r, NULL)));
    if (n->inconclusive > 0)
        fprintf(out, "; %zu more cannot be decided", n->inconclusive);
}

void words_sentence(FILE *out, const struct report *r) {
    struct report_count n = report_tally(r);
    size_t all = n.pass + n.fail + n.inconclusive + n.known, cases = cases_with(r, NULL);
    if (all == 0)
        fprintf(out, "No check was made");
    else if (n.fail > 0)
        failing_sentence(out, r, &n, all);
    else if (n.inconclusive > 0)
        fprintf(out, "No check fails, but %zu of %zu cannot be decided", n.inconclusive, all);
    else if (n.known > 0)
        fprintf(out, "%zu of %zu checks pass", n.pass, all);
    else if (all == 1)
        fprintf(out, "The only check passes");
    else
        fprintf(out, "All %zu checks of %zu case%s pass", all, cases, plural(cases));
    if (n.known > 0)
        fprintf(out, "; %zu disagree%s as known", n.known, n.known == 1 ? "s" : "");
    if (n.skipped > 0)
        fprintf(out, "; %zu case%s not run", n.skipped, n.skipped == 1 ? " was" : "s were");
    fprintf(out, ".");
}

void words_budget(FILE *out, const struct report *r) {
    const struct report_budget *b = &r->budget;
    struct report_alarms a = report_alarms(r);
    if (!(b->allowed > 0) || b->statistical == 0)
        return;
    fprintf(out, "Unchanged code may raise a false alarm, fail or inconclusive, in %s of all runs ",
            words_number(b->allowed).text);
    fprintf(out, "of this tier: %s for each of its %zu statistical checks. ",
            words_number(b->share).text, b->statistical);
    if (a.rows == 0)
        fprintf(out, "None of them was judged here.");
    else if (a.unknown == a.rows)
        fprintf(out, "None of the %zu judged here has an ensemble to compute its rate from.",
                a.rows);
    else
        fprintf(out,
                "Of the %zu judged here, the rates of %zu sum to %s; %zu have no ensemble to "
                "compute theirs from.",
                a.rows, a.rows - a.unknown, words_number(a.sum).text, a.unknown);
}

bool words_has_bits(const struct report *r) {
    bool is_smoke = r->tier != NULL && strcmp(r->tier, "smoke") == 0; /* others store none */
    return r->bits.same + r->bits.other + (is_smoke ? r->bits.unknown : 0) > 0;
}

void words_bits(FILE *out, const struct report *r) {
    const struct report_bits *b = &r->bits;
    size_t known = b->same + b->other;
    if (known == 0 && words_has_bits(r))
        fprintf(out,
                "No bits of this class of build are stored for the %zu runs: statistics decide.",
                b->unknown);
    if (known == 0)
        return;
    fprintf(out, "%zu of %zu runs have the bits of their references: unchanged.", b->same, known);
    if (b->other > 0)
        fprintf(out, " %zu ha%s others: there statistics decide.", b->other,
                b->other == 1 ? "s" : "ve");
    if (b->unknown > 0)
        fprintf(out, " For %zu more there are none of this class of build.", b->unknown);
}

void words_changes(FILE *out, const struct report *r) {
    size_t count[VERDICT_KNOWN + 1] = {0}, all = 0;
    for (size_t i = 0; i < r->case_count; i++) {
        for (size_t k = 0; k < r->cases[i].row_count; k++) {
            const struct report_row *row = &r->cases[i].row[k];
            bool is_one = row->kind && strcmp(row->kind, "regression") == 0;
            count[row->verdict] += is_one;
            all += is_one;
        }
    }
    if (all == 0) {
        fprintf(out, "No check here compares with a stored reference.");
        return;
    }
    fprintf(out, "Of %zu comparison%s with stored references %zu find%s no change", all,
            plural(all), count[VERDICT_PASS], count[VERDICT_PASS] == 1 ? "s" : "");
    if (count[VERDICT_FAIL] > 0)
        fprintf(out, ", %zu find%s one", count[VERDICT_FAIL], count[VERDICT_FAIL] == 1 ? "s" : "");
    if (count[VERDICT_KNOWN] > 0)
        fprintf(out, ", %zu find%s one that is known", count[VERDICT_KNOWN],
                count[VERDICT_KNOWN] == 1 ? "s" : "");
    if (count[VERDICT_INCONCLUSIVE] > 0)
        fprintf(out, ", %zu cannot tell", count[VERDICT_INCONCLUSIVE]);
    fprintf(out, ".");
}
