#include "validation/scatter.h"

#include "validation/rows_across.h"

#include <gsl/gsl_statistics_double.h>
#include <math.h>
#include <string.h>

static enum status no_memory(struct fault *fault) {
    return fault_set(fault, STATUS_NO_MEMORY, "ensembles: out of memory");
}

bool scatter_is_statistical(const struct case_file *file, const struct case_check *check) {
    if (check->kind == KIND_ROUND_OFF || check->paired)
        return false;
    if (check->number.across && file->across[check->number.index].exact)
        return false;
    return check->kind == KIND_REGRESSION || check->number.across || !check->scatter.given ||
           check->scatter.value > 0;
}

/* -- values of single seeds ---------------------------------------------------------- */

static void note(struct scatter *s, const char *reason) {
    if (s->missing == NULL)
        s->missing = reason == NULL ? "not a number" : reason;
}

static void take_point(const struct measured_point *p, size_t check, bool differs,
                       struct scatter *s, double *value, double *expected) {
    for (size_t i = 0; i < p->run_count; i++) {
        const struct measured_run *r = &p->run[i];
        const struct measured_sample *sample = r->usable ? &r->sample[check] : NULL;
        value[i] = expected[i] = NAN;
        if (sample != NULL) {
            value[i] = differs ? sample->measured - sample->expected : sample->measured;
            expected[i] = differs ? 0 : sample->expected;
            s->scale += sample->expected / (double)p->run_count;
            s->expected_uncertainty = sample->expected_uncertainty;
        }
        if (!isfinite(value[i]))
            note(s, sample == NULL ? r->failure : sample->reason);
    }
}

/* -- pseudo-values of fits ----------------------------------------------------------- */

/* p without its run `left_out`, and what is fitted to the seeds of the rest. */
static enum status leave_out_of_point(const struct plan_case *plan, const struct measured_point *p,
                                      size_t left_out, struct arena *a, struct measured_point *out,
                                      struct fault *fault) {
    *out = (struct measured_point){.point = p->point,
                                   .run = arena_take(a, p->run_count, sizeof *out->run)};
    if (out->run == NULL)
        return no_memory(fault);
    for (size_t i = 0; i < p->run_count; i++) {
        if (i != left_out)
            out->run[out->run_count++] = p->run[i];
    }
    return measured_fit_ensembles(plan, a, out, fault);
}

/* m with the runs of one seed left out at the points of one group. */
static enum status leave_out(const struct measured_case *m, const struct scatter *s,
                             size_t left_out, struct arena *a, struct measured_case *out,
                             struct fault *fault) {
    const struct case_across *across = &m->plan->file->across[s->check->number.index];
    enum status status = STATUS_OK;
    *out = *m;
    out->point = arena_take(a, m->point_count, sizeof *out->point);
    if (out->point == NULL)
        return no_memory(fault);
    for (size_t p = 0; status == STATUS_OK && p < m->point_count; p++) {
        out->point[p] = m->point[p];
        if (rows_group_has(m, across, s->point, p))
            status = leave_out_of_point(m->plan, &m->point[p], left_out, a, &out->point[p], fault);
    }
    return status;
}

static bool seeds_agree(const struct measured_case *m, const struct case_across *across,
                        size_t first, size_t count) {
    for (size_t p = first; p < m->point_count; p++) {
        if (rows_group_has(m, across, first, p) && m->point[p].run_count != count)
            return false;
    }
    return true;
}

static enum status take_fit(const struct measured_case *m, struct arena *a, struct scatter *s,
                            double *value, double *expected, struct fault *fault) {
    struct arena scratch = {0};
    struct rows_group whole, part;
    struct measured_case rest;
    double n = (double)s->count;
    enum status status = rows_group_fit(m, s->check_index, s->point, a, &whole, fault);
    if (status == STATUS_OK && !isfinite(whole.value))
        note(s, whole.reason);
    s->expected_uncertainty = status == STATUS_OK ? whole.expected_uncertainty : NAN;
    s->scale = status == STATUS_OK ? whole.expected : NAN;
    for (size_t i = 0; status == STATUS_OK && i < s->count; i++) {
        value[i] = NAN;
        expected[i] = whole.expected;
        if (s->missing != NULL)
            continue;
        status = leave_out(m, s, i, &scratch, &rest, fault);
        if (status == STATUS_OK)
            status = rows_group_fit(&rest, s->check_index, s->point, a, &part, fault);
        if (status != STATUS_OK)
            break;
        value[i] = n * whole.value - (n - 1) * part.value;
        if (!isfinite(value[i]))
            note(s, part.reason == NULL ? NULL : arena_copy(a, part.reason));
    }
    arena_free(&scratch);
    return status;
}

/* -- rows ---------------------------------------------------------------------------- */

static void summarise(struct scatter *s) {
    s->mean = s->deviation = NAN;
    if (s->missing == NULL && s->count < 2)
        s->missing = "one seed has no scatter";
    if (s->missing != NULL)
        return;
    s->mean = gsl_stats_mean(s->value, 1, s->count);
    s->deviation = gsl_stats_sd_m(s->value, 1, s->count, s->mean);
    bool same = true;
    for (size_t i = 1; i < s->count; i++)
        same &= memcmp(&s->value[i], &s->value[0], sizeof *s->value) == 0;
    if (!same && s->deviation > 0)
        return;
    s->deviation = NAN;
    s->missing = "the seeds agree to the last bit: they are not independent, or without scatter "
                 "(then say `scatter: 0`)";
}

static enum status measure_row(const struct measured_case *m, size_t check, size_t point,
                               struct arena *a, struct scatter *s, struct fault *fault) {
    const struct case_check *k = &m->plan->tier->check[check];
    const struct measured_point *p = &m->point[point];
    double *value = arena_take(a, p->run_count, sizeof *value);
    double *expected = arena_take(a, p->run_count, sizeof *expected);
    long long *seed = arena_take(a, p->run_count, sizeof *seed);
    *s = (struct scatter){.check = k,
                          .check_index = check,
                          .point = point,
                          .count = p->run_count,
                          .seed = seed,
                          .value = value,
                          .expected = expected};
    if (value == NULL || expected == NULL || seed == NULL)
        return no_memory(fault);
    for (size_t i = 0; i < p->run_count; i++)
        seed[i] = p->run[i].run->seed;
    enum status status = reference_key_make(m->plan, check, point, a, &s->key, fault);
    if (status != STATUS_OK)
        return status;
    if (!k->number.across)
        take_point(p, check, s->key.difference, s, value, expected);
    else if (!seeds_agree(m, &m->plan->file->across[k->number.index], point, p->run_count))
        note(s, "points of one fit have different numbers of seeds");
    else
        status = take_fit(m, a, s, value, expected, fault);
    summarise(s);
    return status;
}

enum status scatter_measure(const struct measured_case *m, struct arena *a, struct scatter **out,
                            size_t *count, struct fault *fault) {
    enum status status = STATUS_OK;
    *out = NULL;
    *count = 0;
    for (size_t c = 0; c < m->plan->tier->check_count; c++) {
        if (!scatter_is_statistical(m->plan->file, &m->plan->tier->check[c]))
            continue;
        for (size_t p = 0; status == STATUS_OK && p < m->point_count; p++) {
            if (!reference_has_row(m->plan, c, p))
                continue;
            struct scatter *wider = arena_grow(a, *out, *count, sizeof *wider);
            if (wider == NULL)
                return no_memory(fault);
            *out = wider;
            status = measure_row(m, c, p, a, &wider[(*count)++], fault);
        }
    }
    return status;
}
