/* predict_spheres.c -- the hard-sphere gas: equation of state and Enskog's theory.
 *
 * Formulae in sphere_laws.h.  Haff's law for constant restitution eps:
 *
 *     T(t) = T(0)/(1 + t/tau)^2,   1/tau = (1 - eps^2) f/6,
 *
 * f Enskog's rate at T(0): each of the N f/2 collisions a second takes the share
 * (1-eps^2) of the normal relative energy, T on average, of the 3 N T/2 there is; hence
 * dT/dt = -(1/3)(1-eps^2) f T, and f goes as sqrt(T).
 *
 * Source:     sphere_laws.h; Haff, J. Fluid Mech. 134, 401 (1983).
 * Leaves out: packing fractions above .5; velocity correlations of inelastic spheres.
 * Checked by: tests/unit/test_predict_spheres.c.
 */
#include "validation/predictions.h"
#include "validation/sphere_laws.h"

static struct spheres_gas gas_of(const double *in) {
    return (struct spheres_gas){in[0], in[1], in[2], in[3]};
}

static double compressibility(const double *in) {
    return spheres_compressibility(in[0]);
}

static double virial(const double *in) {
    return spheres_virial(in[0]);
}

static double collision_rate(const double *in) {
    struct spheres_gas g = gas_of(in);
    return spheres_collision_rate(&g);
}

static double cooling_rate(const double *in) {
    struct spheres_gas g = gas_of(in);
    return (1 - in[4] * in[4]) * spheres_collision_rate(&g) / 6;
}

static double diffusion(const double *in) {
    struct spheres_gas g = gas_of(in);
    return spheres_diffusion(&g);
}

static double longitudinal(const double *in) {
    struct spheres_gas g = gas_of(in);
    return spheres_longitudinal(&g);
}

static double sound_square(const double *in) {
    return spheres_stiffness(in[0]) * in[1] / in[2];
}

#define GAS "packing_fraction", "thermal_energy_J", "radius_m", "mass_kg"

const struct prediction PREDICT_SPHERES[PREDICT_SPHERES_COUNT] = {
    {.name = "sphere-compressibility",
     .title = "Hard spheres, Carnahan and Starling",
     .unit = "1",
     .source = "Carnahan & Starling, J. Chem. Phys. 51, 635 (1969)",
     .input = {"packing_fraction", NULL},
     .at = compressibility},
    {.name = "sphere-compressibility-virial",
     .title = "Hard spheres, virial series to B10",
     .unit = "1",
     .source = "Clisby & McCoy, J. Stat. Phys. 122, 15 (2006)",
     .input = {"packing_fraction", NULL},
     .at = virial},
    {.name = "sphere-collision-rate",
     .title = "Enskog's collision rate 2 N_coll/(N t)",
     .unit = "1/s",
     .source = "Chapman & Cowling, ch. 16; Carnahan & Starling (1969)",
     .input = {GAS, NULL},
     .at = collision_rate},
    {.name = "sphere-cooling-rate",
     .title = "Haff's 1/tau",
     .unit = "1/s",
     .source = "Haff, J. Fluid Mech. 134, 401 (1983)",
     .input = {GAS, "restitution", NULL},
     .at = cooling_rate},
    {.name = "sphere-diffusion",
     .title = "Self-diffusion, Enskog times Erpenbeck and Wood's correction",
     .unit = "m^2/s",
     .source = "Erpenbeck & Wood, Phys. Rev. A 43, 4254 (1991)",
     .input = {GAS, NULL},
     .at = diffusion},
    {.name = "sphere-longitudinal-viscosity",
     .title = "Enskog's (4 eta/3 + zeta)/(n m)",
     .unit = "m^2/s",
     .source = "Chapman & Cowling, ch. 16",
     .input = {GAS, NULL},
     .at = longitudinal},
    {.name = "sphere-sound-square",
     .title = "Square of the isothermal speed of sound",
     .unit = "m^2/s^2",
     .source = "Carnahan & Starling, J. Chem. Phys. 51, 635 (1969)",
     .input = {"packing_fraction", "thermal_energy_J", "mass_kg", NULL},
     .at = sound_square},
};
