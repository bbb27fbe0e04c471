#include "validation/compare.h"

#include <float.h>
#include <gsl/gsl_cdf.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

struct clerk {
    struct compared *c;
    struct arena *arena;
    struct fault *fault;
    double level; /* of one interval, both sides together */
};

static enum status no_memory(struct clerk *k) {
    return fault_set(k->fault, STATUS_NO_MEMORY, "compare: out of memory");
}

const char *compare_change_name(enum change c) {
    static const char *const name[CHANGE_COUNT] = {"unchanged", "same", "significant", "undecided",
                                                   "other"};
    return name[c];
}

/* -- comparable? ----------------------------------------------------------------- */

static bool same_text(const char *a, const char *b) {
    return a == NULL || b == NULL ? a == b : strcmp(a, b) == 0;
}

/* A run's name without its seed tells what was run. */
static size_t id_length(const char *run) {
    const char *seed = strrchr(run, '-');
    return seed == NULL ? strlen(run) : (size_t)(seed - run);
}

static bool same_id(const char *a, const char *b) {
    size_t length = id_length(a);
    return length == id_length(b) && strncmp(a, b, length) == 0;
}

static bool runs_hold(const struct results_row *row, const char *run) {
    for (size_t i = 0; i < row->run_count; i++) {
        if (same_id(row->run[i], run))
            return true;
    }
    return false;
}

static bool same_questions(const struct results_row *a, const struct results_row *b) {
    for (size_t i = 0; i < a->run_count; i++) {
        if (!runs_hold(b, a->run[i]))
            return false;
    }
    for (size_t i = 0; i < b->run_count; i++) {
        if (!runs_hold(a, b->run[i]))
            return false;
    }
    return true;
}

static bool runs_equal(const struct results_row *a, const struct results_row *b) {
    bool equal = a->run_count == b->run_count;
    for (size_t i = 0; equal && i < a->run_count; i++)
        equal = strcmp(a->run[i], b->run[i]) == 0;
    return equal;
}

/* Why the two cannot be compared, or NULL. */
static const char *obstacle(const struct results_row *a, const struct results_row *b) {
    if (a->reference)
        return same_text(a->meaning, b->meaning) ? NULL : "the reference is of another case text";
    if (!same_questions(a, b))
        return "other case text: its runs are other ones";
    if (!same_text(a->meaning, b->meaning) || strcmp(a->observable, b->observable) != 0)
        return "other case text: the observable is another one";
    if (!same_text(a->unit, b->unit) || strcmp(a->kind, b->kind) != 0 ||
        !same_text(a->comparison, b->comparison))
        return "other case text: unit or kind of check differ";
    if (!runs_equal(a, b) || a->value_count != b->value_count)
        return "other seeds";
    for (size_t i = 0; i < a->value_count; i++) {
        if (a->seed[i] != b->seed[i])
            return "other seeds";
    }
    return NULL;
}

/* -- one row --------------------------------------------------------------------- */

static double unit_of(const struct results_row *a) {
    return a->tolerance > 0 ? a->tolerance : fabs(a->expected);
}

static bool same_values(const struct results_row *a, const struct results_row *b) {
    if (a->value_count == 0)
        return a->measured == b->measured &&
               (a->uncertainty == b->uncertainty || isnan(a->uncertainty + b->uncertainty));
    for (size_t i = 0; i < a->value_count; i++) {
        if (!(a->value[i] == b->value[i]))
            return false;
    }
    return true;
}

static bool is_missing(const struct results_row *row) {
    bool missing = isnan(row->measured);
    for (size_t i = 0; i < row->value_count; i++)
        missing |= isnan(row->value[i]);
    return missing;
}

static bool scatters(const struct results_row *a, const struct results_row *b) {
    return !(a->uncertainty == 0 && b->uncertainty == 0);
}

/* A bound that each seed must keep says nothing of the scatter below it: a change counts when it
 * is as large as what the check allows. */
static double rounding(const struct compare_row *r) {
    if (strcmp(r->old->kind, "round-off") == 0 || !same_text(r->old->comparison, "within"))
        return r->unit;
    double largest = fmax(fabs(r->old->measured), fabs(r->new->measured));
    return sqrt(DBL_EPSILON) * fmax(largest, r->unit);
}

/* Each seed by itself, so that +1 and -1 do not cancel. */
static void compare_exact(struct compare_row *r) {
    const struct results_row *a = r->old, *b = r->new;
    r->difference = b->measured - a->measured;
    for (size_t i = 0; i < a->value_count; i++) {
        double d = b->value[i] - a->value[i];
        if (i == 0 || fabs(d) > fabs(r->difference))
            r->difference = d;
    }
    r->uncertainty = 0;
    r->half_width = rounding(r);
    r->how = "without scatter";
    r->change = fabs(r->difference) > r->half_width ? CHANGE_SIGNIFICANT : CHANGE_SAME;
}

static double quantile(double level, double freedom) {
    if (freedom < 1)
        return INFINITY;
    return isfinite(freedom) ? gsl_cdf_tdist_Qinv(level / 2, freedom)
                             : gsl_cdf_ugaussian_Qinv(level / 2);
}

struct interval {
    double uncertainty, half_width;
};

static struct interval paired(const struct results_row *a, const struct results_row *b,
                              double level) {
    double n = (double)a->value_count, mean = 0, squares = 0;
    if (a->value_count < 2)
        return (struct interval){NAN, INFINITY};
    for (size_t i = 0; i < a->value_count; i++)
        mean += (b->value[i] - a->value[i]) / n;
    for (size_t i = 0; i < a->value_count; i++) {
        double d = b->value[i] - a->value[i] - mean;
        squares += d * d;
    }
    double u = sqrt(squares / (n - 1) / n);
    return (struct interval){u, quantile(level, n - 1) * u};
}

/* An uncertainty from the seeds of each side has the degrees of freedom of both (equal code
 * has equal scatter); one from an ensemble or declared is one and the same on both sides. */
static struct interval separate(const struct results_row *a, const struct results_row *b,
                                double level) {
    double u = hypot(a->uncertainty, b->uncertainty);
    double from_seeds = (double)a->value_count - 1;
    bool own = a->freedom == from_seeds && b->freedom == from_seeds;
    double freedom = own ? 2 * from_seeds : fmin(a->freedom, b->freedom);
    if (isnan(u))
        return (struct interval){NAN, INFINITY};
    return (struct interval){u, quantile(level, freedom) * u};
}

/* Would a change that matters have been seen? */
static bool is_enough(const struct compare_row *r) {
    const double seen = 1.645; /* uncertainties: with 95 % */
    if (strcmp(r->old->kind, "regression") != 0)
        return fabs(r->difference) + r->half_width <= r->unit;
    return r->half_width + seen * r->uncertainty <= r->old->detectable;
}

static enum status compare_scattered(struct clerk *k, struct compare_row *r) {
    const struct results_row *a = r->old, *b = r->new;
    double least = sqrt(DBL_EPSILON) * fmax(fmax(fabs(a->measured), fabs(b->measured)), r->unit);
    struct interval p = paired(a, b, k->level), s = separate(a, b, k->level);
    bool is_paired = p.half_width <= s.half_width && a->value_count >= 2;
    struct interval i = is_paired ? p : s;
    r->difference = 0;
    for (size_t n = 0; n < a->value_count; n++)
        r->difference += (b->value[n] - a->value[n]) / (double)a->value_count;
    if (a->value_count == 0)
        r->difference = b->measured - a->measured;
    r->uncertainty = i.uncertainty;
    r->half_width = fmax(i.half_width, least);
    r->how = is_paired ? arena_text(k->arena, "paired, %zu seeds", a->value_count) : "separate";
    if (fabs(r->difference) > r->half_width)
        r->change = CHANGE_SIGNIFICANT;
    else
        r->change = is_enough(r) ? CHANGE_SAME : CHANGE_UNDECIDED;
    if (r->change == CHANGE_UNDECIDED)
        r->note = "too few data to see a change as large as the tolerance";
    return r->how == NULL ? no_memory(k) : STATUS_OK;
}

static enum status compare_pair(struct clerk *k, struct compare_row *r) {
    r->unit = unit_of(r->old);
    if (is_missing(r->old) || is_missing(r->new)) {
        bool lost = !is_missing(r->old);
        r->change = lost ? CHANGE_SIGNIFICANT : CHANGE_UNDECIDED;
        r->note = lost                 ? "there is no number any more"
                  : is_missing(r->new) ? "no number on either side"
                                       : "there was no number before";
        return STATUS_OK;
    }
    if (r->old->same_bits || same_values(r->old, r->new)) {
        r->change = CHANGE_UNCHANGED;
        r->difference = r->uncertainty = r->half_width = 0;
        if (r->old->same_bits)
            r->note = "the bits of its runs are the reference's";
        return STATUS_OK;
    }
    if (scatters(r->old, r->new))
        return compare_scattered(k, r);
    compare_exact(r);
    return STATUS_OK;
}

/* -- all rows -------------------------------------------------------------------- */

static enum status add_row(struct clerk *k, const struct results_row *old,
                           const struct results_row *new, enum change change, const char *note) {
    struct compared *c = k->c;
    c->row = arena_grow(k->arena, c->row, c->row_count, sizeof *c->row);
    if (c->row == NULL)
        return no_memory(k);
    c->row[c->row_count++] = (struct compare_row){.old = old,
                                                  .new = new,
                                                  .change = change,
                                                  .difference = NAN,
                                                  .uncertainty = NAN,
                                                  .half_width = NAN,
                                                  .unit = NAN,
                                                  .how = "",
                                                  .note = note};
    return STATUS_OK;
}

static enum status add_single(struct clerk *k, const struct results_row *row,
                              const struct results_row ***list, size_t *count) {
    *list = arena_grow(k->arena, *list, *count, sizeof **list);
    if (*list == NULL)
        return no_memory(k);
    (*list)[(*count)++] = row;
    return STATUS_OK;
}

/* Rows of runs exist only where a run failed. */
static enum status pair_old(struct clerk *k, const struct results_row *old) {
    const struct results_row *new = results_find(k->c->new, old);
    if (results_is_run(old))
        return add_row(k, old, new, new == NULL ? CHANGE_SIGNIFICANT : CHANGE_UNDECIDED,
                       new == NULL ? "failed before, and does not any more"
                                   : "failed on both sides");
    if (new == NULL)
        return add_single(k, old, &k->c->removed, &k->c->removed_count);
    const char *why = obstacle(old, new);
    return add_row(k, old, new, why == NULL ? CHANGE_SAME : CHANGE_OTHER, why == NULL ? "" : why);
}

static enum status pair_new(struct clerk *k, const struct results_row *new) {
    if (results_find(k->c->old, new) != NULL)
        return STATUS_OK;
    if (results_is_run(new))
        return add_row(k, NULL, new, CHANGE_SIGNIFICANT, "fails now, and did not before");
    return add_single(k, new, &k->c->added, &k->c->added_count);
}

static enum status pair_all(struct clerk *k) {
    const struct results *old = k->c->old, *new = k->c->new;
    enum status status = STATUS_OK;
    for (size_t i = 0; status == STATUS_OK && i < old->row_count; i++)
        status = pair_old(k, &old->row[i]);
    for (size_t i = 0; status == STATUS_OK && i < new->row_count; i++)
        status = pair_new(k, &new->row[i]);
    return status;
}

static bool is_open(const struct compare_row *r) {
    return r->change == CHANGE_SAME && r->old != NULL && !results_is_run(r->old);
}

static enum status compare_all(struct clerk *k) {
    struct compared *c = k->c;
    enum status status = pair_all(k);
    for (size_t i = 0; i < c->row_count; i++)
        c->tests += is_open(&c->row[i]) && scatters(c->row[i].old, c->row[i].new);
    k->level = c->level / (c->old->references ? 1 : 2) / (double)(c->tests > 0 ? c->tests : 1);
    for (size_t i = 0; status == STATUS_OK && i < c->row_count; i++) {
        if (is_open(&c->row[i]))
            status = compare_pair(k, &c->row[i]);
        c->count[c->row[i].change]++;
    }
    if (status == STATUS_OK && c->row_count == 0)
        c->refusal = "they have no check in common";
    return status;
}

enum status compare_results(const struct results *old, const struct results *new, double level,
                            struct compared **out, struct fault *fault) {
    struct compared *c = calloc(1, sizeof *c);
    *out = NULL;
    if (c == NULL)
        return fault_set(fault, STATUS_NO_MEMORY, "compare: out of memory");
    struct clerk k = {.c = c, .arena = &c->arena, .fault = fault};
    enum status status = STATUS_OK;
    c->old = old;
    c->new = new;
    c->level = level;
    if (old->references && old->row_count == 0) {
        c->refusal = "there is no ensemble among the references of these cases at this tier";
    } else if (strcmp(old->tier, new->tier) != 0) {
        c->refusal = arena_text(&c->arena, "the tiers differ: %s and %s", old->tier, new->tier);
        status = c->refusal == NULL ? no_memory(&k) : STATUS_OK;
    } else {
        status = compare_all(&k);
    }
    if (status != STATUS_OK)
        compare_free(c);
    else
        *out = c;
    return status;
}

void compare_free(struct compared *c) {
    if (c == NULL)
        return;
    arena_free(&c->arena);
    free(c);
}

int compare_exit_code(const struct compared *c) {
    if (c->refusal != NULL || c->count[CHANGE_OTHER] > 0)
        return 2;
    if (c->count[CHANGE_SIGNIFICANT] > 0)
        return 1;
    return c->count[CHANGE_UNDECIDED] > 0 ? 3 : 0;
}
