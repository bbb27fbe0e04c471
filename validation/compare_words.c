#include "validation/compare_words.h"

#include <math.h>
#include <string.h>

const char *compare_words_conclusion(const struct compared *c) {
    static const char *const name[] = {"NOTHING SIGNIFICANT", "SIGNIFICANT DIFFERENCE",
                                       "NOT COMPARABLE", "TOO LITTLE DATA"};
    return name[compare_exit_code(c)];
}

void compare_words_counts(FILE *out, const struct compared *c) {
    if (c->refusal != NULL) {
        fprintf(out, "%s", c->refusal);
        return;
    }
    fprintf(out, "%zu checks in both:", c->row_count);
    for (int i = 0; i < CHANGE_COUNT; i++)
        fprintf(out, "%s %zu %s", i == 0 ? "" : ",", c->count[i],
                i == CHANGE_OTHER ? "not comparable" : compare_change_name((enum change)i));
    fprintf(out, "; %zu added, %zu removed; level %g over %zu rows that scatter", c->added_count,
            c->removed_count, c->level, c->tests);
}

const struct results_row *compare_words_row(const struct compare_row *r) {
    return r->old != NULL ? r->old : r->new;
}

void compare_words_values(FILE *out, const struct compare_row *r) {
    const struct results_row *a = r->old, *b = r->new;
    if (a == NULL || b == NULL) {
        fprintf(out, "%s -> %s", a == NULL ? "no fault" : "failed",
                b == NULL ? "no fault" : "failed");
        return;
    }
    fprintf(out, "%s", words_measured(a->measured, a->uncertainty).text);
    if (r->change != CHANGE_UNCHANGED || a->same_bits)
        fprintf(out, " -> %s", words_measured(b->measured, b->uncertainty).text);
    fprintf(out, "%s", words_unit(a->unit).text);
}

struct words compare_words_difference(const struct compare_row *r) {
    struct words out = {""};
    if (r->change == CHANGE_UNCHANGED || !isfinite(r->difference))
        return out;
    struct words value = words_measured(r->difference, r->uncertainty);
    snprintf(out.text, sizeof out.text, "%s%.150s", r->difference > 0 ? "+" : "", value.text);
    return out;
}

struct words compare_words_share(const struct compare_row *r) {
    struct words out = {""};
    if (r->change != CHANGE_UNCHANGED && isfinite(r->difference) && r->unit > 0)
        snprintf(out.text, sizeof out.text, "%+.2g", r->difference / r->unit);
    return out;
}

static void remark(FILE *out, const char **separator, const char *text) {
    fprintf(out, "%s%s", *separator, text);
    *separator = "; ";
}

/* A judge with another mind is no change of what was measured, but of what is said of it. */
void compare_words_remarks(FILE *out, const struct compare_row *r) {
    const char *separator = "";
    const struct results_row *a = r->old, *b = r->new;
    char text[256];
    if (*r->note != '\0')
        remark(out, &separator, r->note);
    if (a == NULL || b == NULL)
        return;
    if (strcmp(a->verdict, b->verdict) != 0) {
        snprintf(text, sizeof text, "%.60s -> %.60s", a->verdict, b->verdict);
        remark(out, &separator, text);
    }
    if (isfinite(a->expected) && isfinite(b->expected) && a->expected != b->expected) {
        snprintf(text, sizeof text, "expected %.6g -> %.6g", a->expected, b->expected);
        remark(out, &separator, text);
    }
    if (isfinite(a->tolerance) && isfinite(b->tolerance) &&
        fabs(a->tolerance - b->tolerance) > 1e-6 * a->tolerance) {
        snprintf(text, sizeof text, "tolerance %.3g -> %.3g", a->tolerance, b->tolerance);
        remark(out, &separator, text);
    }
}

/* -- costs ------------------------------------------------------------------------ */

struct words compare_words_ratio(const struct compare_cost *c) {
    struct words out;
    if (isfinite(c->uncertainty))
        snprintf(out.text, sizeof out.text, "%+.1f %% ± %.1f %%", 100 * (c->ratio - 1),
                 100 * c->uncertainty);
    else
        snprintf(out.text, sizeof out.text, "%+.1f %%, noise not known", 100 * (c->ratio - 1));
    return out;
}

const char *compare_words_speed(const struct compare_cost *c) {
    if (!(fabs(c->ratio - 1) > c->t_limit * c->uncertainty))
        return "no difference seen";
    return c->ratio < 1 ? "faster" : "slower";
}

/* -- bits ------------------------------------------------------------------------- */

static void keep_earliest(struct compare_sample *s, const struct compare_sample *other) {
    if (other->found && (!s->found || other->time < s->time))
        *s = *other;
}

static void count_run(struct compare_case_bits *b, const struct compare_run *run) {
    b->runs++;
    b->differ += run->bits == BITS_DIFFER;
    b->unknown += run->bits == BITS_UNKNOWN;
    if (b->why == NULL && run->bits == BITS_UNKNOWN)
        b->why = run->why;
    keep_earliest(&b->first, &run->first);
    keep_earliest(&b->parted, &run->parted);
}

static bool is_new_case(const struct compare_runs *c, size_t index) {
    for (size_t i = 0; i < index; i++) {
        if (strcmp(c->run[i].case_name, c->run[index].case_name) == 0)
            return false;
    }
    return true;
}

bool compare_words_next_case(const struct compare_runs *c, size_t *index,
                             struct compare_case_bits *out) {
    while (*index < c->run_count && !is_new_case(c, *index))
        ++*index;
    if (*index == c->run_count)
        return false;
    *out = (struct compare_case_bits){.case_name = c->run[*index].case_name};
    for (size_t i = *index; i < c->run_count; i++) {
        if (strcmp(c->run[i].case_name, out->case_name) == 0)
            count_run(out, &c->run[i]);
    }
    ++*index;
    return true;
}

static void put_sample(FILE *out, const char *what, const struct compare_sample *s) {
    fprintf(out, "%s at %.6g (", what, s->time);
    if (isfinite(s->step))
        fprintf(out, "step %.0f, ", s->step);
    fprintf(out, "%s, by %.1e)", s->dataset, s->size);
}

void compare_words_bits(FILE *out, const struct compare_case_bits *b) {
    if (b->unknown > 0)
        fprintf(out, "%zu of %zu runs cannot be read (%s)%s", b->unknown, b->runs, b->why,
                b->unknown < b->runs ? "; " : "");
    if (b->unknown == b->runs)
        return;
    if (b->differ == 0) {
        fprintf(out, "%zu runs unchanged", b->runs - b->unknown);
        return;
    }
    fprintf(out, "%zu of %zu runs differ", b->differ, b->runs);
    if (!b->first.found)
        return;
    put_sample(out, ": first", &b->first);
    if (b->parted.found)
        put_sample(out, "; parted", &b->parted);
    else
        fprintf(out, "; never by more than %g", COMPARE_RUNS_PARTED);
}
