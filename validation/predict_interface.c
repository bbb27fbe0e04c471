/* predict_interface.c -- the bed at rest: height, width and bulk by hydrostatics; diffusion.
 *
 * The profile of hydrostatic.h is solved for the run's parameters and read as the measured one is
 * (interface_fit.h, the same window and plateau).  `...-local`: each height has the
 * temperature that its own powers balance at.
 *
 * A sphere of the bulk diffuses across as one with two frictions, the fluid's and that of
 * collisions:
 *
 *     D = (T/m)/(gamma + nu),  nu = ((1 + eps)/2) (T/m)/D_E
 *
 * D_E that of elastic spheres (sphere_laws.h); a collision turns (1 + eps)/2 of the momentum
 * that an elastic one does.
 *
 * Source:     Fiege & Zippelius, Eqs. 9 and 14; hydrostatic.h; Enskog.
 * Leaves out: see hydrostatic.h; correlated collisions of inelastic spheres (diffusion).
 * Checked by: tests/unit/test_hydrostatic.c, test_predict_interface.c.
 */
#include "validation/bed_rest.h"
#include "validation/predictions.h"
#include "validation/sphere_laws.h"

#include <math.h>

static double bed_height(const double *in) {
    return in[0] * 4 * M_PI / 3 / (in[1] * in[2] * in[3]);
}

/* One of three numbers of the solved profile; NAN where there is no bed. */
static double solved(const double *in, bool local, size_t which) {
    struct fault fault = FAULT_NONE;
    struct hydrostatic_profile profile;
    struct interface_fit fit = {0};
    if (bed_rest_solve(in, local, &profile, &fault))
        return NAN;
    double low, high, sum = 0, n = 0, out = NAN;
    bed_rest_bulk(in, &low, &high);
    for (size_t i = 0; i < profile.count; i++)
        if (profile.height_R[i] >= low && profile.height_R[i] <= high) {
            sum += profile.fraction[i];
            n++;
        }
    if (which == 2)
        out = sum / n;
    else if (!bed_rest_fit(in, &profile, &fit, &fault))
        out = which == 0 ? fit.sigma_R : fit.height_R;
    hydrostatic_free(&profile);
    return out;
}

static double width(const double *in) {
    return solved(in, false, 0);
}

static double height(const double *in) {
    return solved(in, false, 1);
}

static double bulk(const double *in) {
    return solved(in, false, 2);
}

static double width_local(const double *in) {
    return solved(in, true, 0);
}

static double height_local(const double *in) {
    return solved(in, true, 1);
}

static double bulk_local(const double *in) {
    return solved(in, true, 2);
}

static double temperature(const double *in) {
    return bed_rest_temperature(in, in[BED_INPUTS]);
}

/* drag_per_s, phibar, exponent, packing_fraction, thermal_energy_J, radius_m, mass_kg, restitution
 */
static double diffusion(const double *in) {
    struct spheres_gas g = {in[3], in[4], in[5], in[6]};
    double square = in[4] / in[6];
    double friction = (1 + in[7]) / 2 * square / spheres_diffusion(&g);
    return square / (spheres_drag(in[0], in[1], in[2]) + friction);
}

const struct prediction PREDICT_INTERFACE[PREDICT_INTERFACE_COUNT] = {
    {.name = "bed-height",
     .title = "Height of a homogeneous bed with a sharp top",
     .unit = "R",
     .source = "Fiege & Zippelius, Eq. 12",
     .input = {"particles", "width_x_R", "width_y_R", "phibar", NULL},
     .at = bed_height},
    {.name = "hydrostatic-width",
     .title = "Width of the interface, one temperature",
     .unit = "R",
     .source = "docs/theory.md, S6",
     .input = {BED_REST_NAMES, NULL},
     .at = width},
    {.name = "hydrostatic-height",
     .title = "Height of the interface, one temperature",
     .unit = "R",
     .source = "docs/theory.md, S6",
     .input = {BED_REST_NAMES, NULL},
     .at = height},
    {.name = "hydrostatic-bulk",
     .title = "Packing fraction of the bed's middle fifth, one temperature",
     .unit = "1",
     .source = "docs/theory.md, S6",
     .input = {BED_REST_NAMES, NULL},
     .at = bulk},
    {.name = "hydrostatic-width-local",
     .title = "Width of the interface, temperature from the local balance of powers",
     .unit = "R",
     .source = "docs/theory.md, S6",
     .input = {BED_REST_NAMES, NULL},
     .at = width_local},
    {.name = "hydrostatic-height-local",
     .title = "Height of the interface, temperature from the local balance of powers",
     .unit = "R",
     .source = "docs/theory.md, S6",
     .input = {BED_REST_NAMES, NULL},
     .at = height_local},
    {.name = "hydrostatic-bulk-local",
     .title = "Packing fraction of the middle fifth, temperature from the local balance of powers",
     .unit = "1",
     .source = "docs/theory.md, S6",
     .input = {BED_REST_NAMES, NULL},
     .at = bulk_local},
    {.name = "hydrostatic-temperature",
     .title = "Temperature at a packing fraction, from the local balance of powers",
     .unit = "T",
     .source = "docs/theory.md, S6",
     .input = {BED_REST_NAMES, "packing_fraction", NULL},
     .at = temperature},
    {.name = "bed-diffusion",
     .title = "Diffusivity across the bed's bulk, drag and collisions",
     .unit = "m^2/s",
     .source = "Enskog; Erpenbeck & Wood, Phys. Rev. A 43, 4254 (1991)",
     .input = {"drag_per_s", "phibar", "exponent", "packing_fraction", "thermal_energy_J",
               "radius_m", "mass_kg", "restitution", NULL},
     .at = diffusion},
};
