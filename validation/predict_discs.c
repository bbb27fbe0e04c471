/* predict_discs.c -- the pressure of elastic hard discs, and what a finite step does to it.
 *
 * Z from the ten-term virial series, resummed (closures.c).  Collisions found
 * at the end of a step happen when discs overlap by (sqrt(pi)/2) v_th dt on average:
 * relative normal speeds of colliding pairs have the mean sqrt(pi) v_th, and the step
 * that brings them into contact is half over.  So the discs act as if smaller
 * by that much, and
 *
 *     d ln Z / d(v_th dt/d) = -sqrt(pi) d ln Z/d ln eta,
 *
 * the area fraction eta going as d^2.
 *
 * Source:     Clisby & McCoy, J. Stat. Phys. 122, 15 (2006); Henderson, Mol.
 *             Phys. 30, 971 (1975); docs/theory.md for the step.
 * Leaves out: area fractions above .69, where discs freeze.
 * Checked by: tests/unit/test_predictions.c.
 */
#include "validation/closures.h"
#include "validation/predictions.h"

#include <math.h>

static double compressibility(const double *in) {
    return closure_disc_compressibility(in[0]);
}

static double henderson(const double *in) {
    return closure_disc_compressibility_henderson(in[0]);
}

static double step_slope(const double *in) {
    return -sqrt(M_PI) * closure_disc_stiffness(in[0]);
}

const struct prediction PREDICT_DISCS[PREDICT_DISCS_COUNT] = {
    {.name = "disc-compressibility",
     .title = "Hard discs, virial series to B10",
     .unit = "1",
     .source = "Clisby & McCoy, J. Stat. Phys. 122, 15 (2006)",
     .input = {"area_fraction", NULL},
     .at = compressibility},
    {.name = "disc-compressibility-henderson",
     .title = "Hard discs, Henderson",
     .unit = "1",
     .source = "Henderson, Mol. Phys. 30, 971 (1975)",
     .input = {"area_fraction", NULL},
     .at = henderson},
    {.name = "disc-step-slope",
     .title = "d ln Z over d(v_th dt/d)",
     .unit = "1",
     .source = "docs/theory.md",
     .input = {"area_fraction", NULL},
     .at = step_slope},
};
