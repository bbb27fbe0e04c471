/* predict_settling.c -- how fast a homogeneous suspension settles in a closed box.
 *
 * The model's own law, (1-rho')^m/rho with rho' = max(rho, rho_min), m = 4
 * published and 3 corrected, follows from Eqs. 8 and 11 (docs/theory.md).
 * MFM's Eq. 20 follows from Eq. 18, which does not agree with Eq. 3: it is the
 * published law over 1 - rho^2.
 *
 * Source:     MFM, Eqs. 3, 8, 11, 18-20.
 * Leaves out: density fluctuations, which speed settling up.
 * Checked by: tests/unit/test_predictions.c, against an integration of Eq. 8.
 */
#include "validation/closures.h"
#include "validation/predictions.h"

static double own_law_published(const double *in) {
    return closure_settling_speed(CLOSURE_PUBLISHED, in[0], in[1]);
}

static double own_law_corrected(const double *in) {
    return closure_settling_speed(CLOSURE_CORRECTED, in[0], in[1]);
}

/* in: speed downwards, solid_fraction, solid_fraction_min, froude, gravity.  Drag is
 * linear in the speed and carries the weight at the own law's speed; upwards. */
static double drag(enum closure_law law, const double *in) {
    return (in[0] / closure_settling_speed(law, in[1], in[2]) - in[4]) / in[3];
}

static double drag_published(const double *in) {
    return drag(CLOSURE_PUBLISHED, in);
}

static double drag_corrected(const double *in) {
    return drag(CLOSURE_CORRECTED, in);
}

static double eq20(const double *in) {
    return closure_settling_speed_eq20(in[0]);
}

const struct prediction PREDICT_SETTLING[PREDICT_SETTLING_COUNT] = {
    {.name = "settling-own-law-published",
     .title = "Own law, published: (1-rho)^4/rho",
     .unit = "U0",
     .source = "MFM, Eqs. 8 and 11; docs/theory.md",
     .input = {"solid_fraction", "solid_fraction_min", NULL},
     .at = own_law_published},
    {.name = "settling-own-law-corrected",
     .title = "Own law, corrected: (1-rho)^3/rho",
     .unit = "U0",
     .source = "MFM, Eqs. 8 and 11 with Darcy's law proper; docs/theory.md",
     .input = {"solid_fraction", "solid_fraction_min", NULL},
     .at = own_law_corrected},
    {.name = "settling-eq20",
     .title = "MFM, Eq. 20: (1-rho)^3/(rho (1+rho))",
     .unit = "U0",
     .source = "MFM, Eq. 20",
     .input = {"solid_fraction", NULL},
     .at = eq20},
    {.name = "settling-acceleration-published",
     .title = "Acceleration of a homogeneous suspension, published law",
     .unit = "U0/tau",
     .source = "MFM, Eqs. 8 and 11; docs/theory.md",
     .input = {"speed", "solid_fraction", "solid_fraction_min", "froude", "gravity", NULL},
     .at = drag_published},
    {.name = "settling-acceleration-corrected",
     .title = "Acceleration of a homogeneous suspension, corrected law",
     .unit = "U0/tau",
     .source = "MFM, Eqs. 8 and 11; docs/theory.md",
     .input = {"speed", "solid_fraction", "solid_fraction_min", "froude", "gravity", NULL},
     .at = drag_corrected},
};
