#include "solver/graingas/halo.h"

#include <stdlib.h>
#include <string.h>

enum status lattice_create(struct lattice *l, int width_l, int height_l, struct fault *fault) {
    *l = (struct lattice){.nx = width_l + 1, .ny = height_l + 1};
    l->sites = (size_t)l->nx * (size_t)l->ny;
    l->volume = malloc(l->sites * sizeof *l->volume);
    if (!l->volume)
        return fault_set(fault, STATUS_NO_MEMORY, "no memory for a lattice of %d x %d", l->nx,
                         l->ny);
    for (int j = 0; j < l->ny; j++)
        for (int i = 0; i < l->nx; i++) {
            double wx = i == 0 || i == l->nx - 1 ? 0.5 : 1;
            double wy = j == 0 || j == l->ny - 1 ? 0.5 : 1;
            l->volume[(size_t)j * (size_t)l->nx + (size_t)i] = wx * wy;
        }
    return STATUS_OK;
}

void lattice_free(struct lattice *l) {
    free(l->volume);
    *l = (struct lattice){0};
}

long halo_first_outside(const struct lattice *l, const struct grains *g) {
    double width = l->nx - 1, height = l->ny - 1;
    for (size_t n = 0; n < g->count; n++)
        if (!(g->x[n] >= 0 && g->x[n] <= width && g->y[n] >= 0 && g->y[n] <= height))
            return (long)n;
    return -1;
}

/* Lower left site of the cell that holds (x, y), and the place within the cell;
 * a grain exactly on the far wall belongs to the last cell. */
static inline size_t cell_of(const struct lattice *l, double x, double y, double *fx, double *fy) {
    int i = (int)x, j = (int)y;
    if (i > l->nx - 2)
        i = l->nx - 2;
    if (j > l->ny - 2)
        j = l->ny - 2;
    *fx = x - i;
    *fy = y - j;
    return (size_t)j * (size_t)l->nx + (size_t)i;
}

static inline void add_load(struct site_load *s, double area, double vx, double vy) {
    s->area += area;
    s->flux_x += area * vx;
    s->flux_y += area * vy;
}

void halo_deposit(const struct lattice *l, const struct grains *g, struct site_load *load) {
    memset(load, 0, l->sites * sizeof *load);
    size_t nx = (size_t)l->nx;
    for (size_t n = 0; n < g->count; n++) {
        double fx, fy, area = g->area[n], vx = g->vx[n], vy = g->vy[n];
        struct site_load *s = load + cell_of(l, g->x[n], g->y[n], &fx, &fy);
        add_load(s, area * (1 - fx) * (1 - fy), vx, vy);
        add_load(s + 1, area * fx * (1 - fy), vx, vy);
        add_load(s + nx, area * (1 - fx) * fy, vx, vy);
        add_load(s + nx + 1, area * fx * fy, vx, vy);
    }
}

void halo_gather(const struct lattice *l, const struct grains *g, const struct site_pull *pull,
                 double *ax, double *ay) {
    size_t nx = (size_t)l->nx;
    for (size_t n = 0; n < g->count; n++) {
        double fx, fy;
        const struct site_pull *s = pull + cell_of(l, g->x[n], g->y[n], &fx, &fy);
        double w0 = (1 - fx) * (1 - fy), w1 = fx * (1 - fy), w2 = (1 - fx) * fy, w3 = fx * fy;
        ax[n] = w0 * s[0].x + w1 * s[1].x + w2 * s[nx].x + w3 * s[nx + 1].x;
        ay[n] = w0 * s[0].y + w1 * s[1].y + w2 * s[nx].y + w3 * s[nx + 1].y;
    }
}
