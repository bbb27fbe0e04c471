/* bed_rest.c -- see bed_rest.h. */
#include "validation/bed_rest.h"

#include "validation/sphere_laws.h"

#include <math.h>

double bed_rest_column_R(const double in[BED_INPUTS]) {
    return in[BED_PARTICLES] * 4 * M_PI / 3 / (in[BED_WIDTH_X_R] * in[BED_WIDTH_Y_R]);
}

double bed_rest_height_R(const double in[BED_INPUTS]) {
    return bed_rest_column_R(in) / in[BED_PHIBAR];
}

void bed_rest_bulk(const double in[BED_INPUTS], double *low_R, double *high_R) {
    *low_R = 0.4 * bed_rest_height_R(in);
    *high_R = 0.6 * bed_rest_height_R(in);
}

/* What collisions take over what drag takes, in the bulk. */
static double heat_ratio(const double in[BED_INPUTS], double bulk, double temperature_J) {
    struct spheres_gas g = {bulk, temperature_J, in[BED_RADIUS_M], in[BED_MASS_KG]};
    double eps = in[BED_RESTITUTION];
    double drag = spheres_drag(in[BED_DRAG], in[BED_PHIBAR], in[BED_EXPONENT]);
    return (1 - eps * eps) / 3 * spheres_collision_rate(&g) / (2 * drag);
}

enum status bed_rest_solve(const double in[BED_INPUTS], bool local, struct hydrostatic_profile *out,
                           struct fault *fault) {
    double temperature_J = in[BED_THERMAL_J] * in[BED_TEMPERATURE_SCALE];
    double push = spheres_push(in[BED_EXPONENT], in[BED_GRAVITY], in[BED_CONTRAST],
                               in[BED_DRIVE_SCALE], in[BED_PHIBAR]);
    bool walls = in[BED_WALLS] > 0.5;
    struct hydrostatic_bed bed = {.phibar = in[BED_PHIBAR],
                                  .a_R =
                                      temperature_J / (in[BED_MASS_KG] * push) / in[BED_RADIUS_M],
                                  .layer_R = in[BED_LAYER_R],
                                  .column_R = bed_rest_column_R(in),
                                  .width_R = {in[BED_WIDTH_X_R], in[BED_WIDTH_Y_R]},
                                  .walls = {walls, walls},
                                  .floor = true,
                                  .local_temperature = local};
    if (local) {
        bed.restitution = in[BED_RESTITUTION];
        bed.heat_ratio = heat_ratio(in, hydrostatic_bulk_of(&bed, bed.phibar), temperature_J);
    }
    return hydrostatic_solve(&bed, out, fault);
}

enum status bed_rest_fit(const double in[BED_INPUTS], const struct hydrostatic_profile *profile,
                         struct interface_fit *out, struct fault *fault) {
    struct interface_window window = {.above_R = in[BED_ABOVE_R],
                                      .phibar = in[BED_PHIBAR],
                                      .plateau_free = in[BED_PLATEAU_FREE] > 0.5};
    return interface_fit(profile->height_R, profile->fraction, profile->count, &window, out, fault);
}
