/* bed_rest.h -- a run's bed at rest as hydrostatics wants it, from parameters by name.
 *
 * Predictions and recipes read the same inputs and solve the same profile through this file;
 * the profile's width is then read as a measured one's is (interface_fit.h).
 *
 * Source:     hydrostatic.h, interface_fit.h.
 * Leaves out: sides of two kinds: `walls` is 1 with hard sides, 0 with periodic ones.
 * Checked by: tests/unit/test_hydrostatic.c.
 */
#ifndef VALIDATION_BED_REST_H
#define VALIDATION_BED_REST_H

#include "validation/hydrostatic.h"
#include "validation/interface_fit.h"

enum bed_rest_input {
    BED_PHIBAR,
    BED_EXPONENT,
    BED_GRAVITY,
    BED_CONTRAST,
    BED_DRIVE_SCALE,
    BED_THERMAL_J,
    BED_TEMPERATURE_SCALE,
    BED_RADIUS_M,
    BED_MASS_KG,
    BED_LAYER_R,
    BED_PARTICLES,
    BED_WIDTH_X_R,
    BED_WIDTH_Y_R,
    BED_DRAG,
    BED_RESTITUTION,
    BED_PARAMETERS, /* the run's parameters end here */
    BED_WALLS = BED_PARAMETERS,
    BED_ABOVE_R,
    BED_PLATEAU_FREE,
    BED_INPUTS
};

/* Names of the inputs, as a case binds them; [0 .. BED_INPUTS-1]. */
#define BED_REST_NAMES                                                                             \
    "phibar", "exponent", "gravity_m_per_s2", "density_contrast", "drive_scale",                   \
        "thermal_energy_J", "temperature_scale", "radius_m", "mass_kg", "layer_R", "particles",    \
        "width_x_R", "width_y_R", "drag_per_s", "restitution", "walls", "above_R", "plateau_free"

/* N V/(Wx Wy) and N V/(Wx Wy phibar) over R (R). */
double bed_rest_column_R(const double input[BED_INPUTS]);
double bed_rest_height_R(const double input[BED_INPUTS]);

/* local: the temperature of each height from its own balance of powers, and the pressure of
 * inelastic collisions; else one temperature for all, and the pressure of elastic spheres. */
enum status bed_rest_solve(const double input[BED_INPUTS], bool local,
                           struct hydrostatic_profile *out, struct fault *fault);
/* The same for temperatures (over T of the inputs) measured at packing fractions, with weights: ln
 * t is a cubic in phi through them, by least squares.  Eight or more, [0 .. count-1]. */
struct bed_rest_measured {
    const double *fraction, *temperature, *weight;
    size_t count;
};
enum status bed_rest_balance(const double input[BED_INPUTS], const struct bed_rest_measured *m,
                             struct hydrostatic_profile *out, struct fault *fault);
/* Height and width of the solved profile, read with above_R and plateau_free. */
enum status bed_rest_fit(const double input[BED_INPUTS], const struct hydrostatic_profile *profile,
                         struct interface_fit *out, struct fault *fault);

/* The temperature over T where the packing fraction is this, from the local balance of powers (1).
 */
double bed_rest_temperature(const double input[BED_INPUTS], double fraction);

/* Heights (R) between which the bulk is measured: the middle fifth of bed_rest_height_R. */
void bed_rest_bulk(const double input[BED_INPUTS], double *low_R, double *high_R);

#endif
