/* predict_gas.c -- what the gas does alone, and to a single grain.
 *
 *     Darcy column:    dp = Pe q H/K(rho)
 *     full Eq. 6:      d(1+p)^2/dz = -2 Pe q/K(rho)
 *     mode decay:      s = D k^2, D = K/(phi Pe); on the lattice k^2 -> 4 sin^2(..)
 *     single grain:    a = (q/(K rho_min) - gravity)/Fr, at K = K(rho_min)
 *     neutral flux:    q = gravity K rho_min = (1-rho_min)^m/rho_min
 *
 * Source:     MFM, Eqs. 6, 8, 11 and Section II C.
 * Leaves out: moving grains.
 * Checked by: tests/unit/test_predictions.c.
 */
#include "validation/closures.h"
#include "validation/predictions.h"

/* in: flux_l_per_tau, peclet, height_l, solid_fraction, solid_fraction_min. */
static double drop(enum closure_law law, const double *in) {
    return in[1] * in[0] * in[2] / closure_conductivity(law, in[3], in[4]);
}

static double drop_published(const double *in) {
    return drop(CLOSURE_PUBLISHED, in);
}

static double drop_corrected(const double *in) {
    return drop(CLOSURE_CORRECTED, in);
}

/* in: flux_l_per_tau, peclet, solid_fraction, solid_fraction_min. */
static double square_slope(enum closure_law law, const double *in) {
    return -2 * in[1] * in[0] / closure_conductivity(law, in[2], in[3]);
}

static double square_slope_published(const double *in) {
    return square_slope(CLOSURE_PUBLISHED, in);
}

static double square_slope_corrected(const double *in) {
    return square_slope(CLOSURE_CORRECTED, in);
}

/* A straight line between (1+p)^2 at both ends lies above p's own curve by most
 * in the middle.  in: drop (P0), mean of both ends' p (P0).  Over the drop. */
static double full_bend(const double *in) {
    double bottom = 1 + in[1] + in[0] / 2, top = 1 + in[1] - in[0] / 2;
    /* p(z) = sqrt(b^2 + (t^2 - b^2) z) - 1 is farthest from its chord where its
     * slope is the chord's: sqrt(..) = (b + t)/2. */
    double z =
        (bottom * bottom - (bottom + top) * (bottom + top) / 4) / (bottom * bottom - top * top);
    return ((bottom + top) / 2 - (bottom + (top - bottom) * z)) / in[0];
}

/* in: pressure_mode_x, pressure_mode_y, width_l, height_l, peclet, solid_fraction,
 * solid_fraction_min. */
static double decay(enum closure_law law, const double *in) {
    return closure_diffusivity(law, in[5], in[6], in[4]) *
           closure_mode_square(in[0], in[1], in[2], in[3]);
}

static double decay_published(const double *in) {
    return decay(CLOSURE_PUBLISHED, in);
}

static double decay_corrected(const double *in) {
    return decay(CLOSURE_CORRECTED, in);
}

static double decay_lattice(enum closure_law law, const double *in) {
    return closure_diffusivity(law, in[5], in[6], in[4]) *
           closure_mode_square_lattice(in[0], in[1], in[2], in[3]);
}

static double decay_lattice_published(const double *in) {
    return decay_lattice(CLOSURE_PUBLISHED, in);
}

static double decay_lattice_corrected(const double *in) {
    return decay_lattice(CLOSURE_CORRECTED, in);
}

/* in: flux_l_per_tau, solid_fraction_min, froude, gravity. */
static double acceleration(enum closure_law law, const double *in) {
    double pull = in[0] / (closure_conductivity(law, in[1], in[1]) * in[1]);
    return (pull - in[3]) / in[2];
}

static double acceleration_published(const double *in) {
    return acceleration(CLOSURE_PUBLISHED, in);
}

static double acceleration_corrected(const double *in) {
    return acceleration(CLOSURE_CORRECTED, in);
}

/* in: solid_fraction_min, gravity. */
static double neutral_flux_published(const double *in) {
    return in[1] * closure_conductivity(CLOSURE_PUBLISHED, in[0], in[0]) * in[0];
}

static double neutral_flux_corrected(const double *in) {
    return in[1] * closure_conductivity(CLOSURE_CORRECTED, in[0], in[0]) * in[0];
}

#define BOTH(NAME, TITLE, UNIT, SOURCE, FUNCTION, ...)                                             \
    {.name = NAME "-published",                                                                    \
     .title = TITLE ", published law",                                                             \
     .unit = UNIT,                                                                                 \
     .source = SOURCE,                                                                             \
     .input = {__VA_ARGS__, NULL},                                                                 \
     .at = FUNCTION##_published},                                                                  \
    {                                                                                              \
        .name = NAME "-corrected", .title = TITLE ", corrected law", .unit = UNIT,                 \
        .source = SOURCE, .input = {__VA_ARGS__, NULL}, .at = FUNCTION##_corrected                 \
    }

const struct prediction PREDICT_GAS[PREDICT_GAS_COUNT] = {
    BOTH("darcy-drop", "Pressure drop of a uniform column", "P0", "MFM, Eq. 8", drop,
         "flux_l_per_tau", "peclet", "height_l", "solid_fraction", "solid_fraction_min"),
    BOTH("full-square-slope", "Slope of (1+p)^2 in a uniform column", "1/l", "MFM, Eq. 6",
         square_slope, "flux_l_per_tau", "peclet", "solid_fraction", "solid_fraction_min"),
    {.name = "full-bend",
     .title = "Deviation of p from its chord where (1+p)^2 is linear, over the drop",
     .unit = "1",
     .source = "MFM, Eq. 6",
     .input = {"drop", "mean", NULL},
     .at = full_bend},
    BOTH("mode-decay", "Decay rate of a cosine mode of the pressure", "1/tau", "MFM, Eq. 8", decay,
         "pressure_mode_x", "pressure_mode_y", "width_l", "height_l", "peclet", "solid_fraction",
         "solid_fraction_min"),
    BOTH("mode-decay-lattice", "Its decay rate on a lattice of mesh 1 l", "1/tau",
         "five-point Laplacian", decay_lattice, "pressure_mode_x", "pressure_mode_y", "width_l",
         "height_l", "peclet", "solid_fraction", "solid_fraction_min"),
    BOTH("grain-acceleration", "Acceleration of a grain at rest in a through-flow", "U0/tau",
         "MFM, Eq. 11 and Section II C", acceleration, "flux_l_per_tau", "solid_fraction_min",
         "froude", "gravity"),
    BOTH("neutral-flux", "Flux that carries a single grain", "l/tau",
         "MFM, Eq. 11 and Section II C", neutral_flux, "solid_fraction_min", "gravity"),
};
