#include "solver/suspension/noise.h"

#include <math.h>

static const double averaged_kicks = 10; /* of a sphere: memory of the measured rate */

double noise_enskog(double packing, double temperature, double diameter) {
    double contact = (1 - 0.5 * packing) / ((1 - packing) * (1 - packing) * (1 - packing));
    return 24 * packing * contact / diameter * sqrt(temperature / M_PI);
}

/* 1/s: the right side of (1) over T. */
static double loss_rate(const struct noise *n) {
    return n->inelasticity * n->collision_rate + 2 * n->drag;
}

static void set_variance(struct noise *n) {
    if (n->rule == NOISE_FIXED_KICK)
        n->variance = 2 * n->lone_drag * n->temperature / n->kick_rate;
    else if (n->rule != NOISE_GIVEN && n->rule != NOISE_NONE)
        n->variance = loss_rate(n) * n->temperature / n->kick_rate;
    if (n->rule == NOISE_FEEDBACK)
        n->variance *= fmax(0, 1 + n->error + n->integral);
}

static void follow_enskog(struct noise *n, double packing) {
    n->packing = packing;
    if (n->rule != NOISE_MEASURED)
        n->collision_rate = noise_enskog(packing, n->temperature, n->diameter);
}

void noise_start(struct noise *n, const struct suspension_parameters *v, double packing,
                 double drag) {
    *n = (struct noise){.rule = v->noise_rate,
                        .keep = v->keep_noise,
                        .temperature = v->temperature / v->mass,
                        .diameter = 2 * v->radius,
                        .inelasticity = (1 - v->restitution * v->restitution) / 3,
                        .kick_rate = v->kick_rate,
                        .lone_drag = v->drag,
                        .drag = drag,
                        .packing = packing,
                        .variance = v->kick_variance};
    n->collision_rate = noise_enskog(n->packing, n->temperature, n->diameter);
    set_variance(n);
}

void noise_look(struct noise *n, const struct noise_reading *r) {
    if (n->frozen)
        return;
    follow_enskog(n, r->packing);
    double weight = -expm1(-r->elapsed * n->kick_rate / averaged_kicks);
    if (n->rule == NOISE_MEASURED)
        n->collision_rate += weight * (r->collision_rate - n->collision_rate);
    if (n->rule == NOISE_FEEDBACK) {
        n->error = 1 - r->temperature / n->temperature;
        n->integral += n->error * loss_rate(n) * r->elapsed;
    }
    set_variance(n);
}

void noise_change(struct noise *n, double drag) {
    n->frozen = n->frozen || n->keep;
    if (n->frozen)
        return;
    n->drag = drag;
    set_variance(n);
}
