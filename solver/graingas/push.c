#include "solver/graingas/push.h"

void push_free(struct grains *g, double dt) {
    for (size_t i = 0; i < g->count; i++) {
        g->x[i] += g->vx[i] * dt;
        g->y[i] += g->vy[i] * dt;
    }
}

void push_forced(struct grains *g, const double *restrict ax, const double *restrict ay,
                 double fall, double dt) {
    for (size_t i = 0; i < g->count; i++) {
        double dvx = ax[i] * dt, dvy = (ay[i] - fall) * dt;
        g->x[i] += (g->vx[i] + 0.5 * dvx) * dt;
        g->y[i] += (g->vy[i] + 0.5 * dvy) * dt;
        g->vx[i] += dvx;
        g->vy[i] += dvy;
    }
}
