/* observe_spheres.c -- see observe_spheres.h. */
#include "validation/observe_spheres.h"

#include "validation/sphere_laws.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static enum status read_numbers(struct run_view *v, struct observe_spheres *out, double *count,
                                double *fraction, struct fault *fault) {
    const struct {
        const char *name;
        double *value;
    } number[] = {{"particles", count},
                  {"packing_fraction", fraction},
                  {"radius_m", &out->radius_m},
                  {"mass_kg", &out->mass_kg},
                  {"thermal_energy_J", &out->thermal_energy_J},
                  {"width_x_R", &out->box_m[0]},
                  {"width_y_R", &out->box_m[1]},
                  {"height_R", &out->box_m[2]}};
    enum status status = STATUS_OK;
    for (size_t i = 0; !status && i < sizeof number / sizeof *number; i++)
        status = run_view_parameter(v, number[i].name, number[i].value, fault);
    return status;
}

static enum status read_boundaries(struct run_view *v, bool periodic[3], struct fault *fault) {
    static const char *const name[3] = {"boundary_x", "boundary_y", "boundary_z"};
    for (size_t a = 0; a < 3; a++) {
        const char *text;
        enum status status = run_view_parameter_text(v, name[a], &text, fault);
        if (status)
            return status;
        periodic[a] = !strcmp(text, "periodic");
        if (!periodic[a] && strcmp(text, "hard") != 0)
            return fault_set(fault, STATUS_BAD_INPUT, "%s: parameter %s: unknown choice \"%s\"",
                             run_view_path(v), name[a], text);
    }
    return STATUS_OK;
}

enum status observe_spheres(struct run_view *v, struct observe_spheres *out, struct fault *fault) {
    double count = 0, fraction = 0;
    enum status status = read_numbers(v, out, &count, &fraction, fault);
    if (!status)
        status = read_boundaries(v, out->periodic, fault);
    if (status)
        return status;
    double *box = out->box_m, r = out->radius_m;
    if (!(count >= 1 && count < 1e9 && r > 0 && out->mass_kg > 0 && fraction > 0 && box[0] >= 0 &&
          box[1] >= 0 && box[2] >= 0 && (box[0] > 0) == (box[1] > 0) &&
          (box[0] > 0 || !(box[2] > 0))))
        return fault_set(fault, STATUS_BAD_INPUT,
                         "%s: %g spheres of radius %g m in a box of %g x %g x %g R "
                         "cannot be judged",
                         run_view_path(v), count, r, box[0], box[1], box[2]);
    out->count = (size_t)count;
    double solid = count * 4 * M_PI / 3 * r * r * r;
    if (!(box[0] > 0))
        box[0] = box[1] = box[2] = cbrt(solid / fraction) / r;
    else if (!(box[2] > 0))
        box[2] = solid / (fraction * box[0] * box[1]) / (r * r * r);
    for (size_t a = 0; a < 3; a++)
        box[a] *= r;
    out->packing_fraction = solid / (box[0] * box[1] * box[2]);
    return STATUS_OK;
}

enum status observe_spheres_vectors(struct run_view *v, const char *name,
                                    const struct observe_spheres *spheres,
                                    const struct series **out, struct fault *fault) {
    char path[64];
    snprintf(path, sizeof path, "particles/spheres/%s", name);
    enum status status = run_view_series(v, path, out, fault);
    if (status)
        return status;
    const struct series *s = *out;
    if (s->rank != 2 || s->dims[0] != spheres->count || s->dims[1] != 3)
        return fault_set(fault, STATUS_BAD_INPUT, "%s: %s is not [frame][%zu spheres][3]",
                         run_view_path(v), path, spheres->count);
    return STATUS_OK;
}

const double *observe_spheres_at(const struct series *s, size_t frame, size_t sphere) {
    return s->value + frame * s->size + 3 * sphere;
}

enum status observe_spheres_window(struct run_view *v, const struct series *s, double from_s,
                                   double to_s, size_t *first, size_t *last, struct fault *fault) {
    double end = s->time[s->frames - 1], slack = 1e-6 * end;
    if (!(to_s > 0))
        to_s = end;
    *first = 0;
    while (*first + 1 < s->frames && s->time[*first] < from_s - slack)
        ++*first;
    *last = s->frames - 1;
    while (*last > 0 && s->time[*last] > to_s + slack)
        --*last;
    if (*first >= *last)
        return fault_set(fault, STATUS_BAD_INPUT, "%s: fewer than two samples from %g to %g s",
                         run_view_path(v), from_s, to_s);
    return STATUS_OK;
}

enum status observe_spheres_together(struct run_view *v, const struct series *a,
                                     const struct series *b, struct fault *fault) {
    bool same = a->frames == b->frames;
    for (size_t f = 0; same && f < a->frames; f++)
        same = fabs(a->time[f] - b->time[f]) <= 1e-9 * a->time[a->frames - 1];
    if (!same)
        return fault_set(fault, STATUS_BAD_INPUT,
                         "%s: particles and counters are needed at the same times",
                         run_view_path(v));
    return STATUS_OK;
}

enum status observe_spheres_drag(struct run_view *v, double *gamma, struct fault *fault) {
    double drag, phibar, exponent;
    const double *change;
    size_t changes = 0;
    enum status status = run_view_parameter(v, "drag_per_s", &drag, fault);
    if (!status)
        status = run_view_parameter(v, "phibar", &phibar, fault);
    if (!status)
        status = run_view_parameter(v, "exponent", &exponent, fault);
    struct fault absent = FAULT_NONE; /* an empty list has no attribute */
    if (!status && run_view_parameter_list(v, "phibar_times_s", &change, &changes, &absent) ==
                       STATUS_NO_MEMORY)
        status = fault_set(fault, STATUS_NO_MEMORY, "no memory for a list");
    if (!status && changes)
        status = fault_set(fault, STATUS_BAD_INPUT, "%s: phibar changes: there is no one drag",
                           run_view_path(v));
    if (!status)
        *gamma = spheres_drag(drag, phibar, exponent);
    return status;
}
