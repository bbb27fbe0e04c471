/* observe.c -- see observe.h. */
#include "validation/observe.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

/* Index of a choice among NULL-terminated texts. */
static enum status choice(struct run_view *v, const char *name, const char *const *texts,
                          size_t *out, struct fault *fault) {
    const char *text;
    enum status status = run_view_parameter_text(v, name, &text, fault);
    if (status)
        return status;
    for (size_t i = 0; texts[i]; i++)
        if (!strcmp(texts[i], text)) {
            *out = i;
            return STATUS_OK;
        }
    return fault_set(fault, STATUS_BAD_INPUT, "%s: parameter %s: unknown choice \"%s\"",
                     run_view_path(v), name, text);
}

enum status observe_physics(struct run_view *v, struct observe_physics *out, struct fault *fault) {
    static const char *const laws[] = {"published", "corrected", NULL};
    static const char *const faces[] = {"arithmetic", "harmonic", "of-mean", NULL};
    const struct {
        const char *name;
        double *value;
    } number[] = {{"solid_fraction_min", &out->solid_fraction_min},
                  {"area_to_volume", &out->area_to_volume},
                  {"peclet", &out->peclet},
                  {"froude", &out->froude},
                  {"gravity", &out->gravity},
                  {"dt_tau", &out->dt_tau}};
    size_t law = 0, face = 0;
    enum status status = choice(v, "darcy", laws, &law, fault);
    if (!status)
        status = choice(v, "face", faces, &face, fault);
    for (size_t i = 0; !status && i < sizeof number / sizeof *number; i++)
        status = run_view_parameter(v, number[i].name, number[i].value, fault);
    out->law = law == 0 ? CLOSURE_PUBLISHED : CLOSURE_CORRECTED;
    out->face = (enum closure_face)face;
    return status;
}

enum status observe_box(struct run_view *v, struct observe_box *out, struct fault *fault) {
    enum status status = run_view_parameter(v, "width_l", &out->width_l, fault);
    if (!status)
        status = run_view_parameter(v, "height_l", &out->height_l, fault);
    if (status)
        return status;
    if (!(out->width_l >= 2 && out->width_l < 1e5 && out->height_l >= 2 && out->height_l < 1e5))
        return fault_set(fault, STATUS_BAD_INPUT, "%s: a box of %g x %g l cannot be judged",
                         run_view_path(v), out->width_l, out->height_l);
    out->nx = (size_t)lround(out->width_l) + 1;
    out->ny = (size_t)lround(out->height_l) + 1;
    out->sites = out->nx * out->ny;
    return STATUS_OK;
}

static enum status check_vectors(struct run_view *v, const char *name, const struct series *s,
                                 const struct observe_grains *g, struct fault *fault) {
    if (s->rank != 2 || s->dims[0] != g->count || s->dims[1] != 2)
        return fault_set(fault, STATUS_BAD_INPUT, "%s: %s is not [frame][%zu grains][2]",
                         run_view_path(v), name, g->count);
    return STATUS_OK;
}

enum status observe_grains(struct run_view *v, bool velocity, struct observe_grains *out,
                           struct fault *fault) {
    static const char position_name[] = "particles/grains/position";
    static const char velocity_name[] = "particles/grains/velocity";
    const struct series *s;
    out->velocity = NULL;
    enum status status =
        run_view_array(v, "particles/grains/radius", &out->radius, &out->count, fault);
    if (!status)
        status = run_view_series(v, position_name, &out->series, fault);
    if (!status)
        status = check_vectors(v, position_name, out->series, out, fault);
    if (status)
        return status;
    out->frames = out->series->frames;
    out->time = out->series->time;
    out->position = out->series->value;
    if (!velocity)
        return STATUS_OK;
    status = run_view_series(v, velocity_name, &s, fault);
    if (!status)
        status = check_vectors(v, velocity_name, s, out, fault);
    if (!status && s->frames != out->frames)
        status = fault_set(fault, STATUS_BAD_INPUT, "%s: %s has %zu frames, the positions %zu",
                           run_view_path(v), velocity_name, s->frames, out->frames);
    if (!status)
        out->velocity = s->value;
    return status;
}

double observe_area(const struct observe_grains *g, size_t grain) {
    return M_PI * g->radius[grain] * g->radius[grain];
}

const double *observe_vector(const double *values, const struct observe_grains *g, size_t frame,
                             size_t grain) {
    return values + (frame * g->count + grain) * 2;
}

enum status observe_field(struct run_view *v, const char *name, const struct observe_box *box,
                          size_t components, const struct series **out, struct fault *fault) {
    enum status status = run_view_series(v, name, out, fault);
    if (status)
        return status;
    const struct series *s = *out;
    int rank = components > 1 ? 3 : 2;
    if (s->rank != rank || s->dims[0] != box->ny || s->dims[1] != box->nx ||
        (components > 1 && s->dims[2] != components))
        return fault_set(fault, STATUS_BAD_INPUT,
                         "%s: %s is not [frame][%zu rows][%zu columns] with %zu values a site",
                         run_view_path(v), name, box->ny, box->nx, components);
    return STATUS_OK;
}

enum status observe_values(struct run_view *v, const char *name, size_t size,
                           const struct series **out, struct fault *fault) {
    enum status status = run_view_series(v, name, out, fault);
    if (!status && (*out)->size != size)
        status = fault_set(fault, STATUS_BAD_INPUT, "%s: %s has %zu values a frame, not %zu",
                           run_view_path(v), name, (*out)->size, size);
    return status;
}

enum status observe_frame(struct run_view *v, const char *name, const struct series *s,
                          double time_tau, size_t *frame, struct fault *fault) {
    double dt;
    enum status status = run_view_parameter(v, "dt_tau", &dt, fault);
    if (status)
        return status;
    for (size_t f = 0; f < s->frames; f++)
        if (fabs(s->time[f] - time_tau) <= 0.5001 * dt) {
            *frame = f;
            return STATUS_OK;
        }
    return fault_set(fault, STATUS_NOT_FOUND, "%s: %s has no frame at %g tau", run_view_path(v),
                     name, time_tau);
}

bool observe_reaches(const struct series *s, double time_tau) {
    return time_tau <= s->time[s->frames - 1] * (1 + 1e-9);
}

void observe_none(struct measurement *m, size_t output, const char *format, ...) {
    m->value[output] = NAN;
    if (m->reason[0])
        return;
    va_list list;
    va_start(list, format);
    vsnprintf(m->reason, sizeof m->reason, format, list);
    va_end(list);
}
