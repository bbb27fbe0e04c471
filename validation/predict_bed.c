/* predict_bed.c -- when gas carries a bed, how fast a plug rises, how fast a bubble.
 *
 *     minimum fluidization:  q_mf = gravity (1-rho)^m/rho, the own law of settling
 *     plug:                  u = q - q_mf
 *     plane bubble:          u = (1/2) sqrt(g R) = c sqrt(g D_e)
 *
 * A gas flux q - u relative to a bed that moves at u has the drop Pe (q-u)/K a
 * length, the weight is Pe gravity rho: they are equal at q - u = gravity K rho,
 * which is also how fast the same mixture settles (closures.h). On faces whose K is
 * the arithmetic mean of two sites the gas passes more easily: `factor` is measured
 * q_mf over that of the mean fraction, 1 where faces do not matter.
 *
 * A bubble in the plane whose nose has the radius R rises at (1/2) sqrt(g R). If it
 * is a cap of that circle of half angle a, its area is R^2 (a - sin a cos a), so with
 * D_e = sqrt(4 area/pi)
 *
 *     c = (1/2) sqrt(R/D_e),    R/D_e = sqrt(pi/4 / (a - sin a cos a))
 *
 * .354 for the whole circle, .42 for a semicircle, .53 at 60 degrees.
 *
 * Source:     MFM, Eqs. 8 and 11; R. Collins, J. Fluid Mech. 22, 763 (1965), after
 *             Davies & Taylor, Proc. R. Soc. A 200, 375 (1950); docs/theory.md.
 * Leaves out: friction with walls; walls near a bubble; neighbours.
 * Checked by: tests/unit/test_predictions.c.
 */
#include "validation/closures.h"
#include "validation/predictions.h"

#include <math.h>

/* in: solid_fraction, gravity. A bed is denser than the cut-off: none is applied. */
static double q_mf(enum closure_law law, const double *in) {
    return in[1] * closure_settling_speed(law, in[0], 0);
}

static double q_mf_published(const double *in) {
    return q_mf(CLOSURE_PUBLISHED, in);
}

static double q_mf_corrected(const double *in) {
    return q_mf(CLOSURE_CORRECTED, in);
}

/* in: flux_l_per_tau, q_mf. */
static double plug(const double *in) {
    return in[0] - in[1];
}

/* in: flux_l_per_tau, factor, solid_fraction, gravity. */
static double plug_published(const double *in) {
    return plug((const double[]){in[0], in[1] * q_mf_published(in + 2)});
}

static double plug_corrected(const double *in) {
    return plug((const double[]){in[0], in[1] * q_mf_corrected(in + 2)});
}

/* in: half_angle_deg. */
static double bubble_coefficient(const double *in) {
    double a = in[0] * M_PI / 180;
    return sqrt(sqrt(M_PI / 4 / (a - sin(a) * cos(a)))) / 2;
}

/* in: root = sqrt(g D_e), half_angle_deg. */
static double bubble_rise(const double *in) {
    return in[0] * bubble_coefficient(in + 1);
}

static const char CARRIED[] = "MFM, Eqs. 8 and 11; docs/theory.md";
static const char COLLINS[] = "Collins, J. Fluid Mech. 22, 763 (1965)";

const struct prediction PREDICT_BED[PREDICT_BED_COUNT] = {
    {.name = "minimum-fluidization-published",
     .title = "Minimum fluidization, published law: (1-rho)^4/rho",
     .unit = "l/tau",
     .source = CARRIED,
     .input = {"solid_fraction", "gravity", NULL},
     .at = q_mf_published},
    {.name = "minimum-fluidization-corrected",
     .title = "Minimum fluidization, corrected law: (1-rho)^3/rho",
     .unit = "l/tau",
     .source = CARRIED,
     .input = {"solid_fraction", "gravity", NULL},
     .at = q_mf_corrected},
    {.name = "plug-speed",
     .title = "Rise of a plug: q - q_mf",
     .unit = "l/tau",
     .source = CARRIED,
     .input = {"flux_l_per_tau", "q_mf", NULL},
     .at = plug},
    {.name = "plug-speed-published",
     .title = "Rise of a plug: q - factor (1-rho)^4/rho",
     .unit = "l/tau",
     .source = CARRIED,
     .input = {"flux_l_per_tau", "factor", "solid_fraction", "gravity", NULL},
     .at = plug_published},
    {.name = "plug-speed-corrected",
     .title = "Rise of a plug: q - factor (1-rho)^3/rho",
     .unit = "l/tau",
     .source = CARRIED,
     .input = {"flux_l_per_tau", "factor", "solid_fraction", "gravity", NULL},
     .at = plug_corrected},
    {.name = "plane-bubble-coefficient",
     .title = "u/sqrt(g D_e) of a plane bubble whose nose is a cap",
     .unit = "1",
     .source = COLLINS,
     .input = {"half_angle_deg", NULL},
     .at = bubble_coefficient},
    {.name = "plane-bubble-rise",
     .title = "Plane bubble in still surroundings: u = c sqrt(g D_e)",
     .unit = "U0",
     .source = COLLINS,
     .input = {"root", "half_angle_deg", NULL},
     .at = bubble_rise},
};
