/* report.c -- counting rows and finding the worst; see report.h. */
#include "report/report.h"

#include <math.h>
#include <string.h>

const char *verdict_name(enum verdict v) {
    switch (v) {
    case VERDICT_PASS:
        return "pass";
    case VERDICT_FAIL:
        return "fail";
    case VERDICT_KNOWN:
        return "known";
    default:
        return "inconclusive";
    }
}

struct report_count report_tally(const struct report *r) {
    struct report_count count = {0};
    for (size_t i = 0; i < r->case_count; i++) {
        const struct report_case *c = &r->cases[i];
        count.skipped += c->skipped;
        for (size_t k = 0; k < c->row_count; k++) {
            count.pass += c->row[k].verdict == VERDICT_PASS;
            count.fail += c->row[k].verdict == VERDICT_FAIL;
            count.inconclusive += c->row[k].verdict == VERDICT_INCONCLUSIVE;
            count.known += c->row[k].verdict == VERDICT_KNOWN;
        }
    }
    return count;
}

struct report_alarms report_alarms(const struct report *r) {
    struct report_alarms a = {0};
    for (size_t i = 0; i < r->case_count; i++) {
        for (size_t k = 0; k < r->cases[i].row_count; k++) {
            const struct report_row *row = &r->cases[i].row[k];
            a.rows += row->statistical;
            a.unknown += row->statistical && isnan(row->alarm_rate);
            a.sum += row->statistical && !isnan(row->alarm_rate) ? row->alarm_rate : 0;
        }
    }
    return a;
}

enum verdict report_verdict(const struct report *r) {
    struct report_count count = report_tally(r);
    if (count.fail > 0)
        return VERDICT_FAIL;
    if (count.inconclusive == 0 && count.pass > 0)
        return VERDICT_PASS;
    return count.inconclusive == 0 && count.known > 0 ? VERDICT_KNOWN : VERDICT_INCONCLUSIVE;
}

/* a/b where b may be 0: nothing of nothing is nothing, something of nothing too much. */
static double share(double a, double b) {
    if (b > 0)
        return a / b;
    return a > 0 ? (double)INFINITY : 0;
}

/* What is left of the way from the best value, 1, down to a limit below it: a share asleep of
 * .9998 that must be at least .99 has used 2 % of what it may lack, not 99 % of the limit. */
static bool is_share(const struct report_row *row) {
    bool is_number = !row->unit || !*row->unit || strcmp(row->unit, "1") == 0;
    return is_number && row->expected >= .5 && row->expected < 1;
}

/* "At most e + t" without a tolerance (t = 0) and of one sign has the share m/e of its limit:
 * an overlap of .03 under a limit of .05 uses 60 % of it.  With one, only what lies beyond e
 * counts, as it does for "within". */
static double one_sided(double excess, double part, double whole, double tolerance) {
    if (tolerance > 0 || part < 0 || whole <= 0)
        return share(fmax(excess, 0), tolerance);
    return part / whole;
}

double report_margin_used(const struct report_row *row) {
    double m = row->measured, e = row->expected, t = row->tolerance;
    const char *how = row->comparison ? row->comparison : "within";
    if (isnan(m) || isnan(e) || isnan(t))
        return (double)NAN;
    if (strcmp(how, "at most") == 0)
        return one_sided(m - e, m, e, t);
    if (strcmp(how, "at least") == 0 && t == 0 && is_share(row))
        return fmax(1 - m, 0) / (1 - e);
    if (strcmp(how, "at least") == 0)
        return one_sided(e - m, e, m, t);
    if (strcmp(how, "outside") == 0)
        return share(t, fabs(m - e));
    return share(fabs(m - e), t);
}

/* "At least 1000 collisions" asks for enough, and has no best value to measure the way from. */
static bool is_open(const struct report_row *row) {
    return row->comparison && strcmp(row->comparison, "at least") == 0 && row->tolerance == 0 &&
           !is_share(row);
}

/* Failed rows come before all others; a failed row without a number is the worst. What is known
 * to disagree tells nothing about the margins of the rest; what is enough stands last. */
static double badness(const struct report_row *row) {
    double used = report_margin_used(row);
    if (row->verdict == VERDICT_KNOWN)
        return -2;
    if (isnan(used))
        return row->verdict == VERDICT_FAIL ? (double)INFINITY : -1.5;
    return row->verdict == VERDICT_PASS && is_open(row) ? used - 1 : used;
}

static bool is_worse(const struct report_row *a, const struct report_row *b) {
    bool a_failed = a->verdict == VERDICT_FAIL, b_failed = b->verdict == VERDICT_FAIL;
    if (a_failed != b_failed)
        return a_failed;
    return badness(a) > badness(b);
}

const struct report_row *report_worst(const struct report *r) {
    const struct report_row *worst = NULL;
    for (size_t i = 0; i < r->case_count; i++) {
        for (size_t k = 0; k < r->cases[i].row_count; k++) {
            const struct report_row *row = &r->cases[i].row[k];
            if (!worst || is_worse(row, worst))
                worst = row;
        }
    }
    return worst;
}
