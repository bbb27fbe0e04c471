#include "solver/graingas/grains.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum status grains_create(struct grains *g, size_t count, struct fault *fault) {
    *g = (struct grains){.count = count};
    double **real[] = {&g->x,      &g->y,    &g->vx,           &g->vy,
                       &g->radius, &g->area, &g->inverse_mass, &g->scratch};
    for (size_t i = 0; i < sizeof real / sizeof *real; i++)
        if (!(*real[i] = calloc(count + 1, sizeof(double))))
            goto no_memory;
    g->last_hit = calloc(count + 1, sizeof *g->last_hit);
    g->id = calloc(count + 1, sizeof *g->id);
    g->species = calloc(count + 1, sizeof *g->species);
    if (!g->last_hit || !g->id || !g->species)
        goto no_memory;
    for (size_t i = 0; i <= count; i++) {
        g->id[i] = (int32_t)i;
        g->last_hit[i] = GRAINS_NEVER_HIT;
    }
    return STATUS_OK;
no_memory:
    grains_free(g);
    return fault_set(fault, STATUS_NO_MEMORY, "no memory for %zu grains", count);
}

void grains_free(struct grains *g) {
    free(g->x);
    free(g->y);
    free(g->vx);
    free(g->vy);
    free(g->radius);
    free(g->area);
    free(g->inverse_mass);
    free(g->scratch);
    free(g->last_hit);
    free(g->id);
    free(g->species);
    *g = (struct grains){0};
}

void grains_weigh(struct grains *g) {
    for (size_t i = 0; i < g->count; i++) {
        g->area[i] = M_PI * g->radius[i] * g->radius[i];
        g->inverse_mass[i] = 1 / g->area[i];
    }
    g->inverse_mass[g->count] = 0;
}

static void permute_bytes(void *array, size_t size, size_t count, const int32_t *order,
                          void *scratch) {
    const char *from = array;
    char *to = scratch;
    for (size_t k = 0; k < count; k++)
        memcpy(to + k * size, from + (size_t)order[k] * size, size);
    memcpy(array, scratch, count * size);
}

void grains_permute(struct grains *g, const int32_t *order) {
    double *real[] = {g->x, g->y, g->vx, g->vy, g->radius, g->area, g->inverse_mass};
    for (size_t i = 0; i < sizeof real / sizeof *real; i++)
        permute_bytes(real[i], sizeof(double), g->count, order, g->scratch);
    permute_bytes(g->last_hit, sizeof *g->last_hit, g->count, order, g->scratch);
    permute_bytes(g->id, sizeof *g->id, g->count, order, g->scratch);
    permute_bytes(g->species, sizeof *g->species, g->count, order, g->scratch);
}

double grains_kinetic_energy(const struct grains *g) {
    double sum = 0;
    for (size_t i = 0; i < g->count; i++)
        sum += 0.5 * g->area[i] * (g->vx[i] * g->vx[i] + g->vy[i] * g->vy[i]);
    return sum;
}
