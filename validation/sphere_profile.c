/* sphere_profile.c -- see sphere_profile.h. */
#include "validation/sphere_profile.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum status sphere_profile_open(struct run_view *v, const char *name,
                                const struct observe_spheres *spheres, struct sphere_profile *out,
                                struct fault *fault) {
    char path[64];
    *out = (struct sphere_profile){0};
    snprintf(path, sizeof path, "profiles/%s", name);
    enum status status = run_view_series(v, path, &out->series, fault);
    if (status)
        return status;
    if (out->series->rank != 1 || out->series->dims[0] < 2)
        return fault_set(fault, STATUS_BAD_INPUT, "%s: %s is not [frame][bins]", run_view_path(v),
                         path);
    const double *box = spheres->box_m, r = spheres->radius_m;
    out->bins = out->series->dims[0];
    out->bin_R = box[2] / r / (double)out->bins;
    out->spheres = box[0] * box[1] * box[2] / (double)out->bins / (4 * M_PI / 3 * r * r * r);
    out->height_R = malloc(out->bins * sizeof *out->height_R);
    if (!out->height_R)
        return fault_set(fault, STATUS_NO_MEMORY, "no memory for %zu slabs", out->bins);
    for (size_t k = 0; k < out->bins; k++)
        out->height_R[k] = ((double)k + 0.5) * out->bin_R;
    return STATUS_OK;
}

void sphere_profile_close(struct sphere_profile *p) {
    free(p->height_R);
    *p = (struct sphere_profile){0};
}

void sphere_profile_mean(const struct sphere_profile *p, size_t first, size_t last, double *mean) {
    for (size_t k = 0; k < p->bins; k++) {
        double sum = 0;
        for (size_t f = first; f <= last; f++)
            sum += p->series->value[f * p->bins + k];
        mean[k] = sum / (double)(last - first + 1);
    }
}

double sphere_profile_level(const struct sphere_profile *p, const struct sphere_profile *fraction,
                            size_t first, size_t last, double low_R, double high_R) {
    double sum = 0, weights = 0;
    for (size_t f = first; f <= last; f++)
        for (size_t k = 0; k < p->bins; k++) {
            if (p->height_R[k] < low_R || p->height_R[k] > high_R)
                continue;
            double weight = 1;
            if (fraction)
                weight = fmax(fraction->series->value[f * p->bins + k] * p->spheres - 1, 0);
            sum += weight * p->series->value[f * p->bins + k];
            weights += weight;
        }
    return weights > 0 ? sum / weights : NAN;
}
