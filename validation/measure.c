#include "validation/measure.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* One run under measurement. */
struct bench {
    const struct plan_case *plan;
    const struct plan_point *point;
    struct measured_run *run;
    struct arena *arena;
    struct run_view *view;
};

static enum status spoil(struct bench *b, const struct fault *why, struct fault *fault) {
    if (why->status == STATUS_NO_MEMORY) {
        *fault = *why;
        return why->status;
    }
    b->run->usable = false;
    b->run->failure = arena_text(b->arena, "the result cannot be used: %s", why->text);
    return b->run->failure == NULL ? fault_set(fault, STATUS_NO_MEMORY, "measure: out of memory")
                                   : STATUS_OK;
}

/* -- one check in one run ------------------------------------------------------ */

static double value_of(const struct measured_run *r, const struct case_number *n,
                       const char **reason) {
    const struct measurement *m = &r->observable[n->index];
    double value = m->value[n->output];
    if (isnan(value) && *reason == NULL)
        *reason = m->reason[0] != '\0' ? m->reason : "the observable is not a number";
    return value;
}

/* The prediction with this run's inputs; a missing parameter is a fault. */
static enum status predict(const struct bench *b, const struct case_prediction *p, double *out,
                           const char **reason, struct fault *fault) {
    double input[PREDICTION_MAX_INPUTS] = {0};
    for (size_t i = 0; i < PREDICTION_MAX_INPUTS && p->prediction->input[i] != NULL; i++) {
        const struct case_binding *in = &p->input[i];
        enum status status = STATUS_OK;
        if (in->kind == BINDING_NUMBER)
            input[i] = in->number;
        else if (in->kind == BINDING_OBSERVABLE)
            input[i] = value_of(b->run, &in->observable, reason);
        else
            status = run_view_parameter(b->view, in->parameter, &input[i], fault);
        if (status != STATUS_OK)
            return status;
    }
    *out = p->prediction->at(input);
    if (isnan(*out) && *reason == NULL)
        *reason = "the prediction is not a number";
    return STATUS_OK;
}

static double expect_along(const struct bench *b, const struct case_expect *e,
                           const char **reason) {
    double expected = case_curve_at(e, value_of(b->run, &e->along, reason));
    if (isnan(expected) && *reason == NULL)
        *reason = "beyond the ends of the expected curve";
    return expected;
}

static enum status sample_check(const struct bench *b, const struct case_check *k,
                                struct measured_sample *s, struct fault *fault) {
    const struct case_expect *e =
        case_expect_find(&k->expect, b->point->parameter, b->point->parameter_count);
    enum status status = STATUS_OK;
    *s = (struct measured_sample){.measured = NAN, .expected = NAN};
    if (e == NULL)
        return fault_set(fault, STATUS_BAD_INPUT, "check %s: no expectation for %s", k->name,
                         b->point->name);
    if (!k->number.across)
        s->measured = value_of(b->run, &k->number, &s->reason);
    if (k->per.prediction != NULL) {
        double unit;
        status = predict(b, &k->per, &unit, &s->reason, fault);
        if (status == STATUS_OK)
            s->measured /= unit;
    }
    if (status == STATUS_OK && e->kind == EXPECT_PREDICTION)
        status = predict(b, &e->prediction, &s->expected, &s->reason, fault);
    else if (status == STATUS_OK && e->kind == EXPECT_CURVE)
        s->expected = expect_along(b, e, &s->reason);
    else if (e->kind == EXPECT_NUMBER)
        s->expected = e->value;
    s->expected_uncertainty = e->uncertainty; /* a stored reference is looked up by rows.c */
    return status;
}

static enum status sample_checks(const struct bench *b, struct fault *fault) {
    const struct case_tier *t = b->plan->tier;
    enum status status = STATUS_OK;
    for (size_t i = 0; status == STATUS_OK && i < t->check_count; i++) {
        const struct case_check *k = &t->check[i];
        if (case_filter_takes(&k->points, b->point->parameter, b->point->parameter_count))
            status = sample_check(b, k, &b->run->sample[i], fault);
    }
    return status;
}

/* -- one run -------------------------------------------------------------------- */

static enum status measure_view(struct bench *b, struct fault *fault) {
    const struct case_file *c = b->plan->file;
    enum status status = run_view_check_asked(b->view, fault);
    for (size_t i = 0; status == STATUS_OK && i < c->observable_count; i++) {
        const struct case_observable *o = &c->observable[i];
        status = o->recipe->measure(b->view, o->setting, &b->run->observable[i], fault);
        if (status != STATUS_OK)
            fault_within(fault, "observable %s", o->name);
    }
    return status == STATUS_OK ? sample_checks(b, fault) : status;
}

static enum status measure_run(struct bench *b, const struct measure_source *source,
                               struct fault *fault) {
    const struct plan_run *run = b->run->run;
    b->run->observable =
        arena_take(b->arena, b->plan->file->observable_count, sizeof *b->run->observable);
    b->run->sample = arena_take(b->arena, b->plan->tier->check_count, sizeof *b->run->sample);
    if (b->run->observable == NULL || b->run->sample == NULL)
        return fault_set(fault, STATUS_NO_MEMORY, "measure: out of memory");
    enum status status = source->describe(source->context, run, b->arena, b->run, fault);
    if (status != STATUS_OK || !b->run->usable)
        return status;
    struct fault bad = FAULT_NONE;
    if (run_view_open(b->run->run_path, b->run->result_path, &b->view, &bad) == STATUS_OK)
        measure_view(b, &bad);
    run_view_close(b->view);
    return bad.status == STATUS_OK ? STATUS_OK : spoil(b, &bad, fault);
}

/* -- all seeds of a point ----------------------------------------------------------- */

/* Why the seeds of a point cannot be fitted together, or NULL.  m[i]: of seed i. */
static const char *gather(const struct measured_point *p, const struct case_across *a,
                          const struct measurement **m, struct arena *arena) {
    for (size_t i = 0; i < p->run_count; i++) {
        if (!p->run[i].usable)
            return p->run[i].failure;
        m[i] = &p->run[i].observable[a->of.index];
        const char *const *curve = a->ensemble->curves;
        for (; curve != NULL && *curve != NULL; curve++) {
            if (ensemble_curve(m[i], *curve) == NULL)
                return m[i]->reason[0] != '\0' ? m[i]->reason
                                               : arena_text(arena, "no curve %s", *curve);
        }
    }
    return NULL;
}

static enum status fit_ensemble(const struct case_file *c, const struct case_across *a,
                                const struct measured_point *p, struct arena *arena,
                                struct measured_ensemble *out, struct fault *fault) {
    const struct measurement **m = arena_take(arena, p->run_count, sizeof *m);
    if (m == NULL)
        return fault_set(fault, STATUS_NO_MEMORY, "measure: out of memory");
    for (size_t i = 0; i < ENSEMBLE_MAX_OUTPUTS; i++)
        out->value[i] = out->uncertainty[i] = NAN;
    out->reason = gather(p, a, m, arena);
    if (out->reason != NULL)
        return STATUS_OK;
    struct fault poor = FAULT_NONE;
    enum status status = a->ensemble->fit(m, p->run_count, c->observable[a->of.index].setting,
                                          out->value, out->uncertainty, &poor);
    if (status == STATUS_NO_MEMORY) {
        *fault = poor;
        return status;
    }
    if (status == STATUS_OK)
        return STATUS_OK;
    for (size_t i = 0; i < ENSEMBLE_MAX_OUTPUTS; i++)
        out->value[i] = out->uncertainty[i] = NAN;
    out->reason = arena_copy(arena, poor.text);
    return out->reason == NULL ? fault_set(fault, STATUS_NO_MEMORY, "measure: out of memory")
                               : STATUS_OK;
}

enum status measured_fit_ensembles(const struct plan_case *plan, struct arena *arena,
                                   struct measured_point *p, struct fault *fault) {
    const struct case_file *c = plan->file;
    enum status status = STATUS_OK;
    p->ensemble = arena_take(arena, c->across_count, sizeof *p->ensemble);
    if (p->ensemble == NULL)
        return fault_set(fault, STATUS_NO_MEMORY, "measure: out of memory");
    for (size_t i = 0; status == STATUS_OK && i < c->across_count; i++) {
        const struct case_across *a = &c->across[i];
        if (a->ensemble != NULL &&
            case_filter_takes(&a->points, p->point->parameter, p->point->parameter_count))
            status = fit_ensemble(c, a, p, arena, &p->ensemble[i], fault);
    }
    return status;
}

static enum status measure_point(const struct plan_case *plan, const struct plan_point *point,
                                 const struct measure_source *source, struct measured_case *m,
                                 struct measured_point *out, struct fault *fault) {
    enum status status = STATUS_OK;
    out->point = point;
    out->run = arena_take(&m->arena, point->run_count, sizeof *out->run);
    if (out->run == NULL)
        return fault_set(fault, STATUS_NO_MEMORY, "measure: out of memory");
    out->run_count = point->run_count;
    for (size_t i = 0; status == STATUS_OK && i < point->run_count; i++) {
        out->run[i] = (struct measured_run){.run = point->run[i], .seconds = NAN};
        struct bench b = {plan, point, &out->run[i], &m->arena, NULL};
        status = measure_run(&b, source, fault);
    }
    return status == STATUS_OK ? measured_fit_ensembles(plan, &m->arena, out, fault) : status;
}

enum status measure_case(const struct plan_case *plan, const struct measure_source *source,
                         struct measured_case **out, struct fault *fault) {
    *out = NULL;
    struct measured_case *m = calloc(1, sizeof *m);
    if (m == NULL)
        return fault_set(fault, STATUS_NO_MEMORY, "measure: out of memory");
    m->plan = plan;
    m->point = arena_take(&m->arena, plan->point_count, sizeof *m->point);
    enum status status =
        m->point == NULL ? fault_set(fault, STATUS_NO_MEMORY, "measure: out of memory") : STATUS_OK;
    for (; status == STATUS_OK && m->point_count < plan->point_count; m->point_count++)
        status = measure_point(plan, &plan->point[m->point_count], source, m,
                               &m->point[m->point_count], fault);
    if (status != STATUS_OK) {
        measured_case_free(m);
        return status;
    }
    *out = m;
    return STATUS_OK;
}

void measured_case_free(struct measured_case *m) {
    if (m == NULL)
        return;
    for (size_t p = 0; p < m->point_count; p++) {
        for (size_t r = 0; r < m->point[p].run_count; r++) {
            struct measurement *list = m->point[p].run[r].observable;
            for (size_t i = 0; list != NULL && i < m->plan->file->observable_count; i++)
                measurement_free(&list[i]);
        }
    }
    arena_free(&m->arena);
    free(m);
}

/* -- for figures and fits --------------------------------------------------------- */

size_t measured_mean(const struct measured_point *p, size_t observable, size_t output, double *mean,
                     double *error) {
    size_t count = 0;
    double sum = 0, squares = 0;
    for (size_t i = 0; i < p->run_count; i++) {
        double v = p->run[i].usable ? p->run[i].observable[observable].value[output] : NAN;
        if (!isfinite(v))
            continue;
        sum += v;
        count++;
    }
    *mean = count == 0 ? NAN : sum / (double)count;
    for (size_t i = 0; i < p->run_count; i++) {
        double v = p->run[i].usable ? p->run[i].observable[observable].value[output] : NAN;
        if (isfinite(v))
            squares += (v - *mean) * (v - *mean);
    }
    *error = count < 2 ? NAN : sqrt(squares / (double)(count - 1) / (double)count);
    return count;
}

double measured_parameter(const struct measured_point *p, const char *name) {
    const struct yaml_node *n =
        case_parameter_find(p->point->parameter, p->point->parameter_count, name);
    double value = NAN;
    struct fault ignored = FAULT_NONE; /* no number: NaN says so */
    if (n != NULL)
        case_value_real(n, &value, &ignored);
    return value;
}

bool measured_parameter_is(const struct measured_point *p, const char *name, const char *value) {
    const struct yaml_node *n =
        case_parameter_find(p->point->parameter, p->point->parameter_count, name);
    return n != NULL && n->kind == YAML_SCALAR && case_value_equal(n->text, value);
}
