#include "solver/suspension/groups.h"

#include "solver/suspension/drive.h"

#include <math.h>

/* d(phi Z_CS)/dphi. */
static double stiffness(double phi) {
    double p2 = phi * phi, free = (1 - phi) * (1 - phi);
    return (1 + 4 * phi + 4 * p2 - 4 * p2 * phi + p2 * p2) / (free * free);
}

struct groups groups_of(const struct suspension_parameters *v, double phibar) {
    double speed = sqrt(v->temperature / v->mass), drag = suspension_parameters_drag(v, phibar);
    double b = v->exponent * drive_gravity(v);
    double wave = phibar * b / (1 - phibar) / drag;
    return (struct groups){.lift = 4 * v->density_contrast * v->mass * v->gravity * v->radius /
                                   v->temperature,
                           .drag = drag * v->radius / speed,
                           .drive = b * v->radius / (speed * speed),
                           .kick = v->kick_rate * v->radius / speed,
                           .stability = wave / (speed * sqrt(stiffness(phibar))),
                           .thermal_speed = speed,
                           .packing_in_box = suspension_parameters_packing(v)};
}
