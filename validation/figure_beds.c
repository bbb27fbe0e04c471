/* figure_beds.c -- see figure_beds.h. */
#include "validation/figure_beds.h"

#include <math.h>
#include <string.h>

/* -- readings --------------------------------------------------------------- */

const char *figure_bed_reading(const struct measured_point *p) {
    const struct yaml_node *n =
        case_parameter_find(p->point->parameter, p->point->parameter_count, "reading");
    return n ? n->text : NULL;
}

static bool same_reading(const struct measured_point *a, const struct measured_point *b) {
    const char *x = figure_bed_reading(a), *y = figure_bed_reading(b);
    return x && y ? strcmp(x, y) == 0 : x == y;
}

bool figure_bed_of_reading(const struct measured_case *data, size_t nth, struct measured_case *out,
                           struct arena *a) {
    const struct measured_point *wanted = NULL;
    for (size_t i = 0; i < data->point_count && !wanted; i++) {
        size_t k = 0;
        while (k < i && !same_reading(&data->point[k], &data->point[i]))
            k++;
        if (k == i && nth-- == 0)
            wanted = &data->point[i];
    }
    struct measured_point *point = wanted ? arena_take(a, data->point_count, sizeof *point) : NULL;
    if (!point)
        return false;
    *out = *data;
    out->arena = (struct arena){NULL}; /* the points' contents stay with data */
    out->point = point;
    out->point_count = 0;
    for (size_t i = 0; i < data->point_count; i++)
        if (same_reading(&data->point[i], wanted))
            point[out->point_count++] = data->point[i];
    return true;
}

/* -- texts ------------------------------------------------------------------ */

/* The ", "-joined text without one of its parts. */
static const char *without(const char *text, const char *part, struct arena *a) {
    size_t length = strlen(part);
    const char *left = "";
    for (const char *at = text; left && *at;) {
        const char *end = strstr(at, ", ");
        size_t n = end ? (size_t)(end - at) : strlen(at);
        if (n != length || strncmp(at, part, n) != 0)
            left = arena_text(a, "%s%s%.*s", left, *left ? ", " : "", (int)n, at);
        at += end ? n + 2 : n;
    }
    return left;
}

const char *figure_bed_label(const struct measured_case *data, const struct measured_point *p,
                             const char *along, struct arena *a) {
    const char *text = figure_point_text(data, p, along, a), *reading = figure_bed_reading(p);
    const char *part = reading ? figure_value_text("reading", reading, a) : "";
    return text && part && *part ? without(text, part, a) : part ? text : NULL;
}

const char *figure_bed_text(const struct measured_case *data, const struct measured_point *p,
                            const char *along, struct arena *a) {
    const char *label = figure_bed_label(data, p, along, a), *reading = figure_bed_reading(p);
    if (!label || !reading)
        return label;
    return arena_text(a, "reading %s%s%s", reading, *label ? ", " : "", label);
}

const char *figure_bed_title(const char *title, const char *reading, struct arena *a) {
    return reading && *reading ? arena_text(a, "%s (reading %s)", title, reading) : title;
}

/* -- points and runs -------------------------------------------------------- */

double figure_bed_number(const struct measured_point *p, const char *name) {
    const struct yaml_node *n =
        case_parameter_find(p->point->parameter, p->point->parameter_count, name);
    struct fault none = FAULT_NONE;
    double value;
    if (n && n->kind == YAML_LIST)
        n = n->count > 0 ? &n->child[n->count - 1] : NULL;
    return n && n->kind == YAML_SCALAR && !yaml_real(n, &value, &none) ? value : NAN;
}

enum status figure_bed_open(const struct measured_run *run, struct figure_bed *out,
                            struct fault *fault) {
    struct fault absent = FAULT_NONE; /* an empty list has no attribute */
    const double *change;
    size_t changes = 0;
    *out = (struct figure_bed){.view = NULL};
    enum status status = run_view_open(run->run_path, run->result_path, &out->view, fault);
    if (!status)
        status = observe_spheres(out->view, &out->spheres, fault);
    if (status) {
        run_view_close(out->view);
        out->view = NULL;
        return status;
    }
    if (!run_view_parameter_list(out->view, "phibar_times_s", &change, &changes, &absent) &&
        changes > 0) {
        out->changes = true;
        out->from_s = change[0];
    }
    return STATUS_OK;
}

double figure_bed_slack(const struct series *s) {
    return 1e-6 * fabs(s->time[s->frames - 1]);
}

bool figure_bed_reaches(const struct figure_bed *b, const struct series *s, double time_s) {
    return s->frames > 0 && b->from_s + time_s <= s->time[s->frames - 1] + figure_bed_slack(s);
}

enum status figure_bed_frame(const struct figure_bed *b, const char *name, const struct series *s,
                             double time_s, size_t *frame, struct fault *fault) {
    size_t best = 0;
    for (size_t f = 1; f < s->frames; f++)
        if (fabs(s->time[f] - b->from_s - time_s) < fabs(s->time[best] - b->from_s - time_s))
            best = f;
    if (s->frames == 0 || fabs(s->time[best] - b->from_s - time_s) > figure_bed_slack(s))
        return fault_set(fault, STATUS_NOT_FOUND, "%s: %s has no sample at %g s%s",
                         run_view_path(b->view), name, time_s,
                         b->changes ? " after the change" : "");
    *frame = best;
    return STATUS_OK;
}

/* -- curves ----------------------------------------------------------------- */

static bool same_abscissae(const struct curve *a, const struct curve *b) {
    double span = fabs(a->x[a->count - 1] - a->x[0]);
    bool same = a->count == b->count;
    for (size_t k = 0; same && k < a->count; k++)
        same = fabs(a->x[k] - b->x[k]) <= 1e-9 * span;
    return same;
}

size_t figure_bed_curves(const struct figure_input *in, const struct measured_point *p,
                         const char *name, const struct curve **curve, size_t room) {
    size_t count = 0;
    for (size_t i = 0; i < p->run_count && count < room; i++) {
        const struct measurement *m =
            p->run[i].usable ? &p->run[i].observable[in->observable[0]] : NULL;
        const struct curve *c = m ? figure_curve_find(m, name, 0) : NULL;
        if (!c || c->count == 0)
            continue;
        curve[count++] = c;
        if (!same_abscissae(curve[0], c))
            return 1;
    }
    return count;
}

/* -- predictions ------------------------------------------------------------ */

/* What a check of the case binds to an input of the prediction, or, as a second choice, of another
 * one that has an input of that name; NULL: none. */
static const struct case_binding *
find_binding(const struct figure_input *in, const struct prediction *prediction, const char *name) {
    const struct case_tier *t = in->data->plan->tier;
    const struct case_binding *found = NULL;
    for (size_t i = 0; i < t->check_count; i++) {
        const struct case_check *c = &t->check[i];
        const struct case_prediction *own[] = {
            c->expect.kind == EXPECT_PREDICTION ? &c->expect.prediction : &c->per, &c->per};
        for (size_t k = 0; k < 2; k++) {
            const struct prediction *p = own[k]->prediction;
            for (size_t n = 0; p && n < PREDICTION_MAX_INPUTS && p->input[n]; n++)
                if (strcmp(p->input[n], name) == 0 && (!found || p == prediction))
                    found = &own[k]->input[n];
            if (found && p == prediction)
                return found;
        }
    }
    return found;
}

/* Is an input what an output gives: by its name, or by name and unit, window_s and window (s)? */
static bool gives(const struct recipe_output *output, const char *input) {
    size_t length = strlen(output->name);
    if (strncmp(input, output->name, length) != 0)
        return false;
    return input[length] == '\0' ||
           (input[length] == '_' && strcmp(input + length + 1, output->unit) == 0);
}

/* An input that no check binds. */
static enum status take_input(const struct figure_input *in, const struct measured_point *p,
                              struct run_view *v, const char *name, double *out,
                              struct fault *fault) {
    struct fault absent = FAULT_NONE;
    double error;
    enum status status = run_view_parameter(v, name, out, &absent);
    if (!status)
        return STATUS_OK;
    const struct recipe *r =
        in->observable_count ? in->file->observable[in->observable[0]].recipe : NULL;
    for (size_t i = 0; r && i < RECIPE_MAX_OUTPUTS && r->output[i].name; i++)
        if (gives(&r->output[i], name)) {
            *out = figure_mean(in, p, r->output[i].name, &error);
            return STATUS_OK;
        }
    *fault = absent;
    return status;
}

enum status figure_bed_predict(const struct figure_input *in, const struct measured_point *p,
                               const struct prediction *prediction, double *out,
                               struct fault *fault) {
    const struct measured_run *run = figure_first_run(p);
    double input[PREDICTION_MAX_INPUTS] = {0}, error;
    struct run_view *view = NULL;
    if (!run)
        return fault_set(fault, STATUS_BAD_INPUT, "no run can be used");
    enum status status = run_view_open(run->run_path, run->result_path, &view, fault);
    for (size_t i = 0; i < PREDICTION_MAX_INPUTS && prediction->input[i] && !status; i++) {
        const struct case_binding *b = find_binding(in, prediction, prediction->input[i]);
        if (b && b->kind == BINDING_NUMBER)
            input[i] = b->number;
        else if (b && b->kind == BINDING_OBSERVABLE)
            measured_mean(p, b->observable.index, b->observable.output, &input[i], &error);
        else
            status =
                take_input(in, p, view, b ? b->parameter : prediction->input[i], &input[i], fault);
    }
    run_view_close(view);
    if (!status)
        *out = prediction->at(input);
    return status;
}
