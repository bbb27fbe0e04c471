/* sphere_laws.h -- hard spheres, drag, kicks and drive, written down once for the judge.
 *
 * The solver has its own in solver/suspension; these were written without
 * looking at it.  phi is the packing fraction, d = 2R, v = sqrt(T/m), chi the
 * contact value of the pair distribution, x = n d^3/sqrt(2) the density over that of
 * close packing:
 *
 *     Z = 1 + 4 phi chi = (1 + phi + phi^2 - phi^3)/(1-phi)^3    Carnahan & Starling
 *     f = 24 phi chi v/(sqrt(pi) d)                              Enskog, 2 N_coll/(N t)
 *     D = 1.01896 sqrt(pi) d v/(16 phi chi) (1 + .054034 x + 6.3656 x^2 - 10.9425 x^3)
 *     eta = (4 phi)(1/(4 phi chi) + .8 + .7614 (4 phi chi)) eta_B
 *     lambda = (4 phi)(1/(4 phi chi) + 1.2 + .7574 (4 phi chi)) lambda_B
 *     zeta = (4/9) n^2 d^4 chi sqrt(pi m T)
 *
 * eta_B = 1.016 (5/16) sqrt(mT/pi)/d^2, lambda_B = 1.025 (75/64) sqrt(T/(pi m))/d^2,
 *
 * and for the model's own laws ("FZ"):
 *
 *     gamma = gamma0 (1-phibar)^-n                               FZ Eq. 6
 *     b' = n g (rho_s-rho_f)/rho_s drive_scale/(1-phibar)        FZ Eq. 9
 *     s^2 + (gamma + nu_l k^2) s + i phi b' W k + c_T^2 k^2 = 0  linear waves exp(st + ikz)
 *     phi b' W/((gamma + nu_l k^2) c_T)                          above 1: the wave grows
 *
 *     c_T^2 + (T/m) ((2/3) Z^2 s - Z L q)/(s + 2 gamma + (3/2) L + D_T k^2)  for c_T^2: see below
 *
 * with W = sin(k Delta/2)/(k Delta/2), c_T^2 = (T/m) d(phi Z)/d phi and
 * nu_l = (4 eta/3 + zeta)/(n m).  The last line is for a gas whose temperature is local: kicks give
 * each sphere the same, drag takes 2 gamma T, collisions L T with L = (1-eps^2) f/3, which
 * grows with density as phi^q, q = d ln(phi chi)/d ln phi; pressure heats, and Enskog's
 * conductivity evens out, D_T = 2 lambda/(3 n).  Denser places are colder, which takes away from
 * the pressure's resistance.  Inelastic spheres press less: Z = 1 + 2 (1+eps) phi chi.
 *
 * Source:     Carnahan & Starling, J. Chem. Phys. 51, 635 (1969); Chapman & Cowling,
 *             Mathematical Theory of Non-uniform Gases, ch. 16; Erpenbeck & Wood,
 *             Phys. Rev. A 43, 4254 (1991) for D; Clisby & McCoy, J. Stat. Phys. 122, 15
 *             (2006) for the virial coefficients; Fiege & Zippelius for the model.
 * Leaves out: packing fractions above .5, where spheres freeze; inelasticity but for the last line.
 * Checked by: tests/unit/test_sphere_laws.c.
 */
#ifndef VALIDATION_SPHERE_LAWS_H
#define VALIDATION_SPHERE_LAWS_H

#include <complex.h>

/* A state of the gas. */
struct spheres_gas {
    double packing_fraction; /* (1) */
    double temperature_J;    /* m <v^2>/3 */
    double radius_m, mass_kg;
};

/* p/(n T), the contact value, and d(phi Z)/d phi, Carnahan and Starling (1). */
double spheres_compressibility(double packing_fraction);
double spheres_contact(double packing_fraction);
double spheres_stiffness(double packing_fraction);
/* Ten virial coefficients (1). */
double spheres_virial(double packing_fraction);

double spheres_thermal_speed(const struct spheres_gas *g); /* sqrt(T/m) (m/s) */
double
spheres_collision_rate(const struct spheres_gas *g); /* collisions a particle takes part in (1/s) */
double spheres_diffusion(const struct spheres_gas *g);    /* of an unbounded fluid (m^2/s) */
double spheres_viscosity(const struct spheres_gas *g);    /* shear (Pa s) */
double spheres_longitudinal(const struct spheres_gas *g); /* (4 eta/3 + zeta)/(n m) (m^2/s) */
double spheres_conductivity(const struct spheres_gas *g); /* heat, Enskog: of T in J (1/(m s)) */
/* What a periodic cube of this side takes off the diffusivity: 2.837 T/(6 pi eta L) (m^2/s);
 * Duenweg & Kremer, J. Chem. Phys. 99, 6983 (1993); Yeh & Hummer, J. Phys. Chem. B 108,
 * 15873 (2004). */
double spheres_box_correction(const struct spheres_gas *g, double side_m);

/* gamma (1/s) and b' (m/s^2): what a sphere is accelerated by for each unit of phi - phibar. */
double spheres_drag(double drag_per_s, double phibar, double exponent);
double spheres_push(double exponent, double gravity_m_per_s2, double density_contrast,
                    double drive_scale, double phibar);

/* A wave of density along z. */
struct spheres_wave {
    double packing_fraction, push_m_per_s2, drag_per_s;
    double layer_m, wavelength_m;
    double sound2_m2_per_s2, viscosity_m2_per_s; /* c_T^2, nu_l */
};
/* The root s (1/s) that grows fastest. */
double complex spheres_wave_root(const struct spheres_wave *w);
/* phi b' W/((gamma + nu_l k^2) c_T): the wave grows where it is above 1.  Long waves: the
 * speed of kinematic waves over that of sound. */
double spheres_wave_ratio(const struct spheres_wave *w);
/* Root and long-wave ratio of a gas with a local temperature; w->sound2_m2_per_s2 is not read. */
double complex spheres_heated_root(const struct spheres_wave *w, const struct spheres_gas *g,
                                   double restitution);
double spheres_heated_ratio(const struct spheres_wave *w, const struct spheres_gas *g,
                            double restitution);
/* The wavelength (m), between one and 1000 layers' thickness, that grows fastest, whatever
 * w->wavelength_m is; NAN where none grows. */
double spheres_fastest_wave(const struct spheres_wave *w);

#endif
