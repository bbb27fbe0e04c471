/* bed_change.c -- see bed_change.h. */
#include "validation/bed_change.h"

#include "validation/sphere_laws.h"

#include <math.h>
#include <string.h>

static double drag(const struct bed_change *c, double packing_fraction) {
    return spheres_drag(c->drag_per_s, packing_fraction, c->exponent);
}

double bed_change_slope(const struct bed_change *c) {
    return spheres_push(c->exponent, c->pull_m_per_s2, 1, 1, c->after) / drag(c, c->after);
}

double bed_change_stream(const struct bed_change *c) {
    return c->pull_m_per_s2 / drag(c, c->after);
}

double bed_change_mobility(const struct bed_change *c, double packing_fraction, double phibar) {
    return 1 / drag(c, c->full ? packing_fraction : phibar);
}

double bed_change_speed(const struct bed_change *c, double packing_fraction, double phibar) {
    if (c->full)
        return c->pull_m_per_s2 * (1 / drag(c, phibar) - 1 / drag(c, packing_fraction));
    return spheres_push(c->exponent, c->pull_m_per_s2, 1, 1, phibar) * (packing_fraction - phibar) /
           drag(c, phibar);
}

/* -- from a run ------------------------------------------------------------------ */

static enum status read_numbers(struct run_view *v, struct bed_change *out, double *count,
                                double width_R[2], struct fault *fault) {
    double gravity = 0, contrast = 0, scale = 0, energy = 0, hotter = 0, mass = 0;
    const struct {
        const char *name;
        double *value;
    } number[] = {{"phibar", &out->before},
                  {"drag_per_s", &out->drag_per_s},
                  {"exponent", &out->exponent},
                  {"radius_m", &out->radius_m},
                  {"layer_R", &out->layer_m},
                  {"gravity_m_per_s2", &gravity},
                  {"density_contrast", &contrast},
                  {"drive_scale", &scale},
                  {"thermal_energy_J", &energy},
                  {"temperature_scale", &hotter},
                  {"mass_kg", &mass},
                  {"restitution", &out->restitution},
                  {"particles", count},
                  {"width_x_R", &width_R[0]},
                  {"width_y_R", &width_R[1]}};
    for (size_t i = 0; i < sizeof number / sizeof *number; i++) {
        enum status status = run_view_parameter(v, number[i].name, number[i].value, fault);
        if (status)
            return status;
    }
    out->layer_m *= out->radius_m;
    out->pull_m_per_s2 = gravity * contrast * scale;
    out->heat_m2_per_s2 = energy * hotter / mass;
    return STATUS_OK;
}

static enum status read_change(struct run_view *v, double *after, double *change_s,
                               struct fault *fault) {
    const double *time, *value;
    size_t times, values;
    enum status status = run_view_parameter_list(v, "phibar_times_s", &time, &times, fault);
    if (!status)
        status = run_view_parameter_list(v, "phibar_values", &value, &values, fault);
    if (!status && (times != 1 || values != 1))
        status = fault_set(fault, STATUS_BAD_INPUT, "%s: phibar changes %zu times, not once",
                           run_view_path(v), times);
    if (!status) {
        *change_s = time[0];
        *after = value[0];
    }
    return status;
}

enum status bed_change_read(struct run_view *v, struct bed_change *out, double *change_s,
                            struct fault *fault) {
    double count = 0, width[2] = {0, 0};
    const char *drive = NULL, *start = NULL;
    *out = (struct bed_change){0};
    enum status status = read_numbers(v, out, &count, width, fault);
    if (!status)
        status = read_change(v, &out->after, change_s, fault);
    if (!status)
        status = run_view_parameter_text(v, "drive", &drive, fault);
    if (!status)
        status = run_view_parameter_text(v, "start", &start, fault);
    if (status)
        return status;
    out->full = !strcmp(drive, "full");
    out->sharp = !strcmp(start, "sharp") && !(*change_s > 0);
    out->load_m = count * 4 * M_PI / 3 * out->radius_m / (width[0] * width[1]);
    if (!(out->before > 0 && out->after > 0 && out->after < 1 && out->before != out->after &&
          out->load_m > 0 && isfinite(out->load_m) && out->pull_m_per_s2 > 0 &&
          out->drag_per_s > 0 && out->heat_m2_per_s2 >= 0) ||
        !strcmp(drive, "none"))
        return fault_set(fault, STATUS_BAD_INPUT,
                         "%s: no driven bed between two packing fractions: phibar %g to %g, "
                         "%g m of solid, drive %s",
                         run_view_path(v), out->before, out->after, out->load_m, drive);
    return STATUS_OK;
}
