/* sphere_laws.c -- see sphere_laws.h. */
#include "validation/sphere_laws.h"

#include <math.h>

/* -- equation of state -------------------------------------------------------- */

double spheres_contact(double packing_fraction) {
    double space = 1 - packing_fraction;
    return (1 - packing_fraction / 2) / (space * space * space);
}

double spheres_compressibility(double packing_fraction) {
    return 1 + 4 * packing_fraction * spheres_contact(packing_fraction);
}

double spheres_stiffness(double packing_fraction) {
    double p = packing_fraction, space = 1 - p;
    double numerator = 1 + p * (4 + p * (4 + p * (-4 + p)));
    return numerator / (space * space * space * space);
}

enum { VIRIAL_TERMS = 10 };

/* B_n/B_2^(n-1), n = 1 .. 10, B_2 = 4 in units of the spheres' volume. */
static const double VIRIAL[VIRIAL_TERMS] = {
    1, 1, 0.625, 0.2869495, 0.110252, 0.03888198, 0.01302354, 0.0041832, 0.0013094, 0.0004035};

double spheres_virial(double packing_fraction) {
    double sum = 0;
    for (int n = VIRIAL_TERMS; n-- > 0;)
        sum = sum * (4 * packing_fraction) + VIRIAL[n];
    return sum;
}

/* -- Enskog ------------------------------------------------------------------- */

double spheres_thermal_speed(const struct spheres_gas *g) {
    return sqrt(g->temperature_J / g->mass_kg);
}

double spheres_collision_rate(const struct spheres_gas *g) {
    double p = g->packing_fraction;
    return 12 * p * spheres_contact(p) * spheres_thermal_speed(g) / (sqrt(M_PI) * g->radius_m);
}

static double number_density(const struct spheres_gas *g) {
    return g->packing_fraction / (4 * M_PI / 3 * pow(g->radius_m, 3));
}

double spheres_diffusion(const struct spheres_gas *g) {
    double p = g->packing_fraction, x = p / (M_PI * M_SQRT2 / 6);
    double enskog = 1.01896 * sqrt(M_PI) * 2 * g->radius_m * spheres_thermal_speed(g) /
                    (16 * p * spheres_contact(p));
    return enskog * (1 + x * (0.054034 + x * (6.3656 - 10.9425 * x)));
}

double spheres_viscosity(const struct spheres_gas *g) {
    double d = 2 * g->radius_m, covolume = 4 * g->packing_fraction;
    double dense = covolume * spheres_contact(g->packing_fraction);
    double dilute = 1.016 * 5 / 16 * sqrt(g->mass_kg * g->temperature_J / M_PI) / (d * d);
    return dilute * covolume * (1 / dense + 0.8 + 0.7614 * dense);
}

double spheres_longitudinal(const struct spheres_gas *g) {
    double n = number_density(g), d = 2 * g->radius_m;
    double bulk = 4.0 / 9 * n * n * pow(d, 4) * spheres_contact(g->packing_fraction) *
                  sqrt(M_PI * g->mass_kg * g->temperature_J);
    return (4 * spheres_viscosity(g) / 3 + bulk) / (n * g->mass_kg);
}

double spheres_box_correction(const struct spheres_gas *g, double side_m) {
    return 2.837297 * g->temperature_J / (6 * M_PI * spheres_viscosity(g) * side_m);
}

/* -- the model's laws ----------------------------------------------------------- */

double spheres_drag(double drag_per_s, double phibar, double exponent) {
    return drag_per_s * pow(1 - phibar, -exponent);
}

double spheres_push(double exponent, double gravity_m_per_s2, double density_contrast,
                    double drive_scale, double phibar) {
    return exponent * gravity_m_per_s2 * density_contrast * drive_scale / (1 - phibar);
}

double complex spheres_wave_root(const struct spheres_wave *w) {
    double k = 2 * M_PI / w->wavelength_m, half = k * w->layer_m / 2;
    double window = half > 0 ? sin(half) / half : 1;
    double damping = w->drag_per_s + w->viscosity_m2_per_s * k * k;
    double complex rest =
        w->sound2_m2_per_s2 * k * k + I * w->packing_fraction * w->push_m_per_s2 * window * k;
    /* csqrt has a real part that is not negative. */
    return (-damping + csqrt(damping * damping - 4 * rest)) / 2;
}
