/* recipes.c -- the list of recipes.  A new one is one file and one line here. */
#include "validation/recipes.h"

#include <stdlib.h>
#include <string.h>

static const struct recipe *const RECIPES[] = {
    &recipe_settling,
    &recipe_front,
    &recipe_fluctuations,
    &recipe_contacts,
    &recipe_mode_decay,
    &recipe_column,
    &recipe_gas_invariant,
    &recipe_halo,
    &recipe_halo_shape,
    &recipe_uniform_fraction,
    &recipe_gas_work,
    &recipe_acceleration,
    &recipe_free_fall,
    &recipe_energy,
    &recipe_mirror,
    &recipe_pair,
    &recipe_corner_hits,
    &recipe_disc_pressure,
    &recipe_packed_bed,
    &recipe_bed_motion,
    &recipe_pressure_drop,
    &recipe_bubbles,
    &recipe_sphere_collisions,
    &recipe_sphere_virial,
    &recipe_sphere_walls,
    &recipe_sphere_velocities,
    &recipe_sphere_conservation,
    &recipe_sphere_diffusion,
    &recipe_sphere_displacement,
    &recipe_sphere_decay,
    &recipe_sphere_pair,
    &recipe_sphere_cooling,
    &recipe_sphere_power,
    &recipe_sphere_wave,
    &recipe_sphere_slab,
    &recipe_sphere_overlap,
    &recipe_sphere_order,
    &recipe_sphere_mirror,
    &recipe_sphere_fingerprint,
    &recipe_bed_stripes,
    &recipe_bed_interface,
    &recipe_bed_formation,
    &recipe_bed_temperature,
    &recipe_bed_velocities,
    &recipe_bed_diffusion,
    &recipe_bed_step,
    &recipe_bed_wave,
    &recipe_bed_relaxation,
};

const struct recipe *recipe_find(const char *name) {
    for (size_t i = 0; i < sizeof RECIPES / sizeof *RECIPES; i++)
        if (!strcmp(RECIPES[i]->name, name))
            return RECIPES[i];
    return NULL;
}

const struct recipe *const *recipe_all(size_t *count) {
    *count = sizeof RECIPES / sizeof *RECIPES;
    return RECIPES;
}

void measurement_free(struct measurement *m) {
    if (!m)
        return;
    for (size_t i = 0; i < m->curve_count; i++) {
        free(m->curve[i].x);
        free(m->curve[i].y);
    }
    m->curve_count = 0;
}

enum status measurement_add_curve(struct measurement *m, const char *name, const char *label,
                                  const double *x, const double *y, size_t count,
                                  struct fault *fault) {
    if (m->curve_count == RECIPE_MAX_CURVES)
        return fault_set(fault, STATUS_BAD_INPUT, "more than %d curves: \"%s\" has no room",
                         (int)RECIPE_MAX_CURVES, name);
    struct curve *c = &m->curve[m->curve_count];
    size_t bytes = (count ? count : 1) * sizeof *c->x;
    c->x = malloc(bytes);
    c->y = malloc(bytes);
    if (!c->x || !c->y) {
        free(c->x);
        free(c->y);
        return fault_set(fault, STATUS_NO_MEMORY, "no memory for a curve of %zu points", count);
    }
    memcpy(c->x, x, count * sizeof *x);
    memcpy(c->y, y, count * sizeof *y);
    c->name = name;
    c->count = count;
    strncpy(c->label, label, sizeof c->label - 1);
    c->label[sizeof c->label - 1] = 0;
    m->curve_count++;
    return STATUS_OK;
}
