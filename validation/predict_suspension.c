/* predict_suspension.c -- drag, kicks, drive and waves of the suspension model.
 *
 * A free sphere under drag gamma and kicks of variance q a component at rate f:
 *
 *     <v^2> = f q/(2 gamma),  <(x(t)-x(0))^2> = 2 <v^2> (gamma t - 1 + exp(-gamma t))/gamma^2
 *
 * a component, for Poisson kicks, and for periodic ones averaged over their phase
 * (the covariance of v at two times is <v^2> exp(-gamma t) in both).  The fourth
 * cumulant tells them apart: kicks that are normal make shot noise of excess kurtosis
 *
 *     3 gamma/f                        Poisson: cumulants f <kick^n>/(n gamma)
 *     3 (u coth u - 1), u = gamma/f    periodic: normal of a variance that swings
 *
 * A uniform state of packing fraction phi is pushed by b'(phi - phibar):
 * v(t) = b'(phi - phibar)(1 - exp(-gamma t))/gamma from rest.
 *
 * Source:     Fiege & Zippelius, Eqs. 6-9; Campbell's theorem of shot noise; Ornstein &
 *             Uhlenbeck, Phys. Rev. 36, 823 (1930); sphere_laws.h for waves.
 * Leaves out: collisions (kicks); waves of temperature and large amplitudes (waves).
 * Checked by: tests/unit/test_predict_spheres.c.
 */
#include "validation/predictions.h"
#include "validation/sphere_laws.h"

#include <math.h>

static double drag(const double *in) {
    return spheres_drag(in[0], in[1], in[2]);
}

/* drag_per_s, phibar, exponent, kick_rate_per_s, kick_variance_m2_per_s2 */
static double kicked_variance(const double *in) {
    return in[3] * in[4] / (2 * drag(in));
}

static double kicked_displacement(const double *in) {
    double gamma = drag(in), way = gamma * in[5];
    return 2 * kicked_variance(in) * (way + expm1(-way)) / (gamma * gamma);
}

static double kicked_kurtosis(const double *in) {
    return 3 * drag(in) / in[3];
}

static double kicked_kurtosis_periodic(const double *in) {
    double u = drag(in) / in[3];
    return 3 * (u / tanh(u) - 1);
}

/* drag_per_s, phibar, exponent, gravity, contrast, scale, packing_fraction, time_s */
static double slab_speed(const double *in) {
    double gamma = drag(in);
    double push = spheres_push(in[2], in[3], in[4], in[5], in[1]);
    return push * (in[6] - in[1]) * -expm1(-gamma * in[7]) / gamma;
}

/* As slab_speed up to the packing fraction; then thermal_energy_J, radius_m, mass_kg,
 * layer_R, wavelength_m. */
static struct spheres_wave wave_of(const double *in, double wavelength_m) {
    struct spheres_gas g = {in[6], in[7], in[8], in[9]};
    return (struct spheres_wave){.packing_fraction = in[6],
                                 .push_m_per_s2 = spheres_push(in[2], in[3], in[4], in[5], in[1]),
                                 .drag_per_s = drag(in),
                                 .layer_m = in[10] * in[8],
                                 .wavelength_m = wavelength_m,
                                 .sound2_m2_per_s2 = spheres_stiffness(in[6]) * in[7] / in[9],
                                 .viscosity_m2_per_s = spheres_longitudinal(&g)};
}

static double wave_growth(const double *in) {
    struct spheres_wave w = wave_of(in, in[11]);
    return creal(spheres_wave_root(&w));
}

static double wave_speed(const double *in) {
    struct spheres_wave w = wave_of(in, in[11]);
    return -cimag(spheres_wave_root(&w)) * in[11] / (2 * M_PI);
}

static double wave_ratio(const double *in) {
    struct spheres_wave w = wave_of(in, in[11]);
    return spheres_wave_ratio(&w);
}

/* As wave_of with the wavelength, then restitution. */
static double complex heated_root(const double *in) {
    struct spheres_gas g = {in[6], in[7], in[8], in[9]};
    struct spheres_wave w = wave_of(in, in[11]);
    return spheres_heated_root(&w, &g, in[12]);
}

static double heated_growth(const double *in) {
    return creal(heated_root(in));
}

static double heated_speed(const double *in) {
    return -cimag(heated_root(in)) * in[11] / (2 * M_PI);
}

static double heated_ratio(const double *in) {
    struct spheres_gas g = {in[6], in[7], in[8], in[9]};
    struct spheres_wave w = wave_of(in, NAN);
    return spheres_heated_ratio(&w, &g, in[11]);
}

/* In radii. */
static double fastest_wavelength(const double *in) {
    struct spheres_wave w = wave_of(in, NAN);
    return spheres_fastest_wave(&w) / in[8];
}

/* Phase speed of the wave that grows fastest. */
static double fastest_speed(const double *in) {
    struct spheres_wave w = wave_of(in, NAN);
    w.wavelength_m = spheres_fastest_wave(&w);
    return -cimag(spheres_wave_root(&w)) * w.wavelength_m / (2 * M_PI);
}

/* Growth per height (1/R) of a train of waves that a floor lets in: growth over phase speed of
 * the wave that grows fastest (Gaster, J. Fluid Mech. 14, 222 (1962)). */
static double growth_with_height(const double *in) {
    struct spheres_wave w = wave_of(in, NAN);
    w.wavelength_m = spheres_fastest_wave(&w);
    double complex s = spheres_wave_root(&w);
    return -creal(s) / cimag(s) * 2 * M_PI / w.wavelength_m * in[8];
}

#define DRAG  "drag_per_s", "phibar", "exponent"
#define KICKS DRAG, "kick_rate_per_s", "kick_variance_m2_per_s2"
#define DRIVE DRAG, "gravity_m_per_s2", "density_contrast", "drive_scale", "packing_fraction"
#define STATE DRIVE, "thermal_energy_J", "radius_m", "mass_kg", "layer_R"
#define WAVE  STATE, "wavelength_m"

const struct prediction PREDICT_SUSPENSION[PREDICT_SUSPENSION_COUNT] = {
    {.name = "suspension-drag",
     .title = "Drag rate of Richardson and Zaki",
     .unit = "1/s",
     .source = "Fiege & Zippelius, Eq. 6",
     .input = {DRAG, NULL},
     .at = drag},
    {.name = "kicked-velocity-variance",
     .title = "Variance of a free sphere's velocity, a component",
     .unit = "m^2/s^2",
     .source = "Campbell's theorem",
     .input = {KICKS, NULL},
     .at = kicked_variance},
    {.name = "kicked-displacement",
     .title = "Mean-square displacement of a free sphere, a component",
     .unit = "m^2",
     .source = "Ornstein & Uhlenbeck, Phys. Rev. 36, 823 (1930)",
     .input = {KICKS, "time_s", NULL},
     .at = kicked_displacement},
    {.name = "kicked-kurtosis-poisson",
     .title = "Excess kurtosis, Poisson kicks",
     .unit = "1",
     .source = "Campbell's theorem",
     .input = {DRAG, "kick_rate_per_s", NULL},
     .at = kicked_kurtosis},
    {.name = "kicked-kurtosis-periodic",
     .title = "Excess kurtosis, periodic kicks of random phase",
     .unit = "1",
     .source = "docs/theory.md",
     .input = {DRAG, "kick_rate_per_s", NULL},
     .at = kicked_kurtosis_periodic},
    {.name = "slab-speed",
     .title = "Speed of a uniform state, from rest",
     .unit = "m/s",
     .source = "Fiege & Zippelius, Eq. 9",
     .input = {DRIVE, "time_s", NULL},
     .at = slab_speed},
    {.name = "density-wave-growth",
     .title = "Growth rate of a wave of density",
     .unit = "1/s",
     .source = "Fiege & Zippelius, Eq. 9, linearised; Enskog's viscosity",
     .input = {WAVE, NULL},
     .at = wave_growth},
    {.name = "density-wave-speed",
     .title = "Phase speed of a wave of density, upwards",
     .unit = "m/s",
     .source = "Fiege & Zippelius, Eq. 9, linearised; Enskog's viscosity",
     .input = {WAVE, NULL},
     .at = wave_speed},
    {.name = "stability-ratio",
     .title = "Kinematic over sound speed, with layers and viscosity: above 1 the wave grows",
     .unit = "1",
     .source = "Fiege & Zippelius, Eq. 9, linearised; Enskog's viscosity",
     .input = {WAVE, NULL},
     .at = wave_ratio},
    {.name = "fastest-wavelength",
     .title = "Wavelength of the wave of density that grows fastest, in radii",
     .unit = "R",
     .source = "Fiege & Zippelius, Eq. 9, linearised; Enskog's viscosity",
     .input = {STATE, NULL},
     .at = fastest_wavelength},
    {.name = "fastest-wave-speed",
     .title = "Phase speed of the wave of density that grows fastest, upwards",
     .unit = "m/s",
     .source = "Fiege & Zippelius, Eq. 9, linearised; Enskog's viscosity",
     .input = {STATE, NULL},
     .at = fastest_speed},
    {.name = "growth-with-height",
     .title = "Growth per height of the waves of density that grow fastest",
     .unit = "1/R",
     .source = "Gaster, J. Fluid Mech. 14, 222 (1962); docs/theory.md S8",
     .input = {STATE, NULL},
     .at = growth_with_height},
    {.name = "heated-wave-growth",
     .title = "Growth rate of a wave of density in inelastic spheres with a local temperature",
     .unit = "1/s",
     .source = "docs/theory.md S8",
     .input = {WAVE, "restitution", NULL},
     .at = heated_growth},
    {.name = "heated-wave-speed",
     .title = "Phase speed of a wave of density in inelastic spheres with a local temperature",
     .unit = "m/s",
     .source = "docs/theory.md S8",
     .input = {WAVE, "restitution", NULL},
     .at = heated_speed},
    {.name = "heated-stability-ratio",
     .title = "Kinematic over sound speed, long waves, inelastic spheres, local temperature",
     .unit = "1",
     .source = "docs/theory.md S8",
     .input = {STATE, "restitution", NULL},
     .at = heated_ratio},
};
