#include "solver/suspension/drive.h"

#include <math.h>

static const double densest = 0.74; /* close packing */

double drive_gravity(const struct suspension_parameters *v) {
    return v->drive_scale * v->gravity * v->density_contrast;
}

struct drive drive_at(const struct suspension_parameters *v, double phibar) {
    struct drive d = {.law = v->drive,
                      .phibar = phibar,
                      .drag = suspension_parameters_drag(v, phibar),
                      .lone = v->drag,
                      .exponent = v->exponent,
                      .interval = v->kick_rate > 0 ? 1 / v->kick_rate : 0};
    d.per_fraction = v->exponent * drive_gravity(v) / (1 - phibar) * d.interval;
    d.fluid = d.drag > 0 ? drive_gravity(v) / d.drag : 0;
    return d;
}

double drive_kick(const struct drive *d, double phi, double v_z) {
    if (d->law == DRIVE_NONE)
        return 0;
    if (d->law == DRIVE_LINEAR)
        return d->per_fraction * (phi - d->phibar);
    double drag = d->lone * pow(1 - fmin(phi, densest), -d->exponent);
    return fmin((drag - d->drag) * d->interval, 1) * (d->fluid - v_z);
}
