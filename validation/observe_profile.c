/* observe_profile.c -- see observe_profile.h. */
#include "validation/observe_profile.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

const struct plateau_rule PLATEAU_RULE = {.sparse = 0.5, .slow = 0.5, .thin = 2.0 / 3};

enum status profile_create(struct profile *p, const struct observe_box *box, double row_l,
                           struct fault *fault) {
    memset(p, 0, sizeof *p);
    p->rows = (size_t)ceil(box->height_l / row_l - 1e-9);
    p->row_l = row_l;
    p->height = calloc(3 * p->rows, sizeof *p->height);
    if (!p->height)
        return fault_set(fault, STATUS_NO_MEMORY, "no memory for a profile of %zu rows", p->rows);
    p->solid_fraction = p->height + p->rows;
    p->speed = p->solid_fraction + p->rows;
    for (size_t r = 0; r < p->rows; r++)
        p->height[r] = ((double)r + 0.5) * row_l;
    return STATUS_OK;
}

void profile_free(struct profile *p) {
    free(p->height);
    memset(p, 0, sizeof *p);
}

enum status profile_measure(struct profile *p, struct run_view *v, const struct observe_box *box,
                            const struct observe_grains *g, double area_to_volume, size_t frame,
                            struct fault *fault) {
    double total = 0;
    memset(p->solid_fraction, 0, 2 * p->rows * sizeof *p->solid_fraction);
    for (size_t i = 0; i < g->count; i++) {
        const double *x = observe_vector(g->position, g, frame, i);
        if (!(x[0] >= 0 && x[0] <= box->width_l && x[1] >= 0 && x[1] <= box->height_l))
            return fault_set(fault, STATUS_BAD_INPUT,
                             "%s: grain %zu is at (%g, %g) l at %g tau: outside the box",
                             run_view_path(v), i, x[0], x[1], g->time[frame]);
        size_t row = (size_t)(x[1] / p->row_l);
        if (row >= p->rows)
            row = p->rows - 1;
        double area = observe_area(g, i);
        p->solid_fraction[row] += area;
        if (g->velocity)
            p->speed[row] -= area * observe_vector(g->velocity, g, frame, i)[1];
        total += area;
    }
    for (size_t r = 0; r < p->rows; r++) {
        double height = fmin(p->row_l, box->height_l - (double)r * p->row_l);
        if (p->solid_fraction[r] > 0)
            p->speed[r] /= p->solid_fraction[r];
        p->solid_fraction[r] *= area_to_volume / (box->width_l * height);
    }
    p->mean_fraction = area_to_volume * total / (box->width_l * box->height_l);
    return STATUS_OK;
}

struct plateau profile_plateau(const struct profile *p, const struct plateau_rule *rule) {
    struct plateau out = {0};
    double fastest = -INFINITY, densest = 0, filled = rule->sparse * p->mean_fraction;
    for (size_t r = 0; r < p->rows; r++)
        if (p->solid_fraction[r] >= filled)
            fastest = fmax(fastest, p->speed[r]);
    if (!(fastest > 0))
        return out;
    for (size_t r = 0; r < p->rows; r++)
        if (p->solid_fraction[r] >= filled && p->speed[r] >= rule->slow * fastest)
            densest = fmax(densest, p->solid_fraction[r]);
    for (size_t r = 0; r < p->rows; r++) {
        if (p->solid_fraction[r] < filled || p->speed[r] < rule->slow * fastest ||
            p->solid_fraction[r] < rule->thin * densest)
            continue;
        if (!out.rows)
            out.lowest = r;
        out.highest = r;
        out.rows++;
        out.solid_fraction += p->solid_fraction[r];
        out.speed += p->speed[r];
    }
    out.solid_fraction /= (double)out.rows;
    out.speed /= (double)out.rows;
    return out;
}
