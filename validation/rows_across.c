#include "validation/rows_across.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static bool takes(const struct measured_case *m, const struct case_across *a, size_t p) {
    const struct plan_point *point = m->point[p].point;
    return case_filter_takes(&a->points, point->parameter, point->parameter_count);
}

bool rows_group_has(const struct measured_case *m, const struct case_across *a, size_t p,
                    size_t q) {
    const struct case_tier *t = m->plan->tier;
    if (a->ensemble != NULL)
        return p == q && takes(m, a, p);
    return takes(m, a, p) && takes(m, a, q) &&
           case_points_agree(t, m->point[p].point->parameter, m->point[q].point->parameter,
                             case_axis_of(t, a->along));
}

bool rows_group_first(const struct measured_case *m, const struct case_across *a, size_t p) {
    for (size_t q = 0; q < p; q++) {
        if (rows_group_has(m, a, q, p))
            return false;
    }
    return takes(m, a, p);
}

static const char *name_group(const struct measured_case *m, const struct case_across *a,
                              size_t first, struct arena *arena) {
    const struct case_tier *t = m->plan->tier;
    const struct plan_point *p = m->point[first].point;
    return case_point_text(arena, t, p->parameter, p->parameter_count, case_axis_of(t, a->along));
}

static int by_x(const void *a, const void *b) {
    double x = ((const struct across_point *)a)->x, y = ((const struct across_point *)b)->x;
    return (x > y) - (x < y);
}

/* The same of a fit over its seeds. */
static bool take_fitted(const struct measured_point *p, const struct case_across *a,
                        struct across_point *out, const char **reason) {
    const struct measured_ensemble *e = &p->ensemble[a->of.index];
    *out = (struct across_point){.x = measured_parameter(p, a->along),
                                 .y = e->value[a->of.output],
                                 .uncertainty = e->uncertainty[a->of.output]};
    if (!isfinite(out->y) && *reason == NULL)
        *reason = e->reason != NULL ? e->reason : "a fit over seeds gave no number";
    return isfinite(out->y);
}

/* One point of the fit; false when a run has no value. */
static bool take_point(const struct measured_point *p, const struct case_across *a,
                       struct across_point *out, const char **reason) {
    if (a->of.across)
        return take_fitted(p, a, out, reason);
    size_t count = measured_mean(p, a->of.index, a->of.output, &out->y, &out->uncertainty);
    out->x = measured_parameter(p, a->along);
    if (a->exact)
        out->uncertainty = 0;
    for (size_t i = 0; i < p->run_count && *reason == NULL; i++) {
        const struct measured_run *r = &p->run[i];
        if (!r->usable)
            *reason = r->failure;
        else if (!isfinite(r->observable[a->of.index].value[a->of.output]))
            *reason = r->observable[a->of.index].reason[0] != '\0'
                          ? r->observable[a->of.index].reason
                          : "the observable is not a number";
    }
    return count == p->run_count && count > 0;
}

/* The expectation, from the first usable run of the group. */
static void take_expected(const struct measured_point *p, size_t check, struct rows_group *out) {
    out->expected = NAN;
    for (size_t i = 0; i < p->run_count && isnan(out->expected); i++) {
        if (!p->run[i].usable)
            continue;
        out->expected = p->run[i].sample[check].expected;
        out->expected_uncertainty = p->run[i].sample[check].expected_uncertainty;
        if (isnan(out->expected) && out->reason == NULL)
            out->reason = p->run[i].sample[check].reason;
    }
}

/* The fit over the seeds of one point was made when it was measured; expected is the
 * mean of what its runs expect. */
static void take_ensemble(const struct measured_point *p, size_t check, const struct case_number *n,
                          struct rows_group *out) {
    const struct measured_ensemble *e = &p->ensemble[n->index];
    double sum = 0, count = 0;
    out->value = e->value[n->output];
    out->uncertainty = e->uncertainty[n->output];
    if (isnan(out->value) && out->reason == NULL)
        out->reason = e->reason != NULL ? e->reason : "a fit over seeds gave no number";
    take_expected(p, check, out);
    for (size_t i = 0; i < p->run_count; i++) {
        if (p->run[i].usable) {
            sum += p->run[i].sample[check].expected;
            count++;
        }
    }
    if (count > 0)
        out->expected = sum / count;
}

enum status rows_group_fit(const struct measured_case *m, size_t check, size_t first,
                           struct arena *arena, struct rows_group *out, struct fault *fault) {
    const struct case_check *k = &m->plan->tier->check[check];
    const struct case_across *a = &m->plan->file->across[k->number.index];
    struct across_point *point = arena_take(arena, m->point_count, sizeof *point);
    double value[ACROSS_MAX_OUTPUTS], uncertainty[ACROSS_MAX_OUTPUTS];
    size_t count = 0;
    bool complete = true;
    *out = (struct rows_group){
        .name = name_group(m, a, first, arena), .value = NAN, .uncertainty = NAN};
    if (point == NULL || out->name == NULL)
        return fault_set(fault, STATUS_NO_MEMORY, "fit: out of memory");
    if (a->ensemble != NULL) {
        take_ensemble(&m->point[first], check, &k->number, out);
        return STATUS_OK;
    }
    for (size_t p = first; p < m->point_count; p++) {
        if (rows_group_has(m, a, first, p))
            complete &= take_point(&m->point[p], a, &point[count++], &out->reason);
    }
    take_expected(&m->point[first], check, out);
    if (!complete)
        return STATUS_OK;
    qsort(point, count, sizeof *point, by_x);
    struct fault poor = FAULT_NONE;
    enum status status = a->fit->fit(point, count, value, uncertainty, &poor);
    if (status == STATUS_NO_MEMORY) {
        *fault = poor;
        return status;
    }
    if (status == STATUS_OK) {
        out->value = value[k->number.output];
        out->uncertainty = uncertainty[k->number.output];
    } else if (out->reason == NULL) {
        out->reason = arena_copy(arena, poor.text);
    }
    return STATUS_OK;
}
