/* sphere_laws.c -- see sphere_laws.h. */
#include "validation/sphere_laws.h"

#include <gsl/gsl_errno.h>
#include <gsl/gsl_min.h>
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

double spheres_conductivity(const struct spheres_gas *g) {
    double d = 2 * g->radius_m, covolume = 4 * g->packing_fraction;
    double dense = covolume * spheres_contact(g->packing_fraction);
    double dilute = 1.025 * 75 / 64 * sqrt(g->temperature_J / (M_PI * g->mass_kg)) / (d * d);
    return dilute * covolume * (1 / dense + 1.2 + 0.7574 * dense);
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

/* phi b' W(k) of the wave (m/s^2). */
static double layered_push(const struct spheres_wave *w) {
    double half = M_PI * w->layer_m / w->wavelength_m; /* k Delta/2 */
    return w->packing_fraction * w->push_m_per_s2 * (half > 0 ? sin(half) / half : 1);
}

/* gamma + nu_l k^2 (1/s). */
static double damping(const struct spheres_wave *w) {
    double k = 2 * M_PI / w->wavelength_m;
    return w->drag_per_s + w->viscosity_m2_per_s * k * k;
}

double complex spheres_wave_root(const struct spheres_wave *w) {
    double k = 2 * M_PI / w->wavelength_m, rate = damping(w);
    double complex rest = w->sound2_m2_per_s2 * k * k + I * layered_push(w) * k;
    /* csqrt has a real part that is not negative. */
    return (-rate + csqrt(rate * rate - 4 * rest)) / 2;
}

double spheres_wave_ratio(const struct spheres_wave *w) {
    return layered_push(w) / (damping(w) * sqrt(w->sound2_m2_per_s2));
}

/* What heats and cools, and the pressure, of inelastic spheres that kicks keep at T. */
struct heat {
    double thermal2_m2_per_s2;  /* T/m */
    double pressure, stiffness; /* Z and d(phi Z)/d phi (1) */
    double loss_per_s, steepness, relaxation_per_s;
};

static struct heat heat_of(const struct spheres_wave *w, const struct spheres_gas *g, double eps) {
    double p = g->packing_fraction, k = 2 * M_PI / w->wavelength_m, share = (1 + eps) / 2;
    struct heat h = {
        .thermal2_m2_per_s2 = g->temperature_J / g->mass_kg,
        .pressure = 1 + share * (spheres_compressibility(p) - 1),
        .stiffness = 1 + share * (spheres_stiffness(p) - 1),
        .loss_per_s = (1 - eps * eps) / 3 * spheres_collision_rate(g),
        .steepness = 1 + p * (3 / (1 - p) - 1 / (2 - p)),
    };
    h.relaxation_per_s = 2 * w->drag_per_s + 1.5 * h.loss_per_s +
                         2 * spheres_conductivity(g) / (3 * number_density(g)) * k * k;
    return h;
}

/* What takes the place of c_T^2 (m^2/s^2) in a wave exp(st). */
static double complex heated_sound(const struct heat *h, double complex s) {
    double z = h->pressure;
    double complex heating = 2.0 / 3 * z * z * s - z * h->loss_per_s * h->steepness;
    return h->thermal2_m2_per_s2 * (h->stiffness + heating / (s + h->relaxation_per_s));
}

/* s by iteration: heat is faster than waves, so c^2 hardly depends on s. */
double complex spheres_heated_root(const struct spheres_wave *w, const struct spheres_gas *g,
                                   double restitution) {
    enum { ITERATIONS = 200 };
    const struct heat h = heat_of(w, g, restitution);
    double k = 2 * M_PI / w->wavelength_m, rate = damping(w);
    double complex s = 0, last = 1;
    for (int i = 0; i < ITERATIONS && cabs(s - last) > 1e-12 * cabs(s); i++) {
        double complex rest = heated_sound(&h, s) * k * k + I * layered_push(w) * k;
        last = s;
        s = (-rate + csqrt(rate * rate - 4 * rest)) / 2;
    }
    return cabs(s - last) <= 1e-9 * cabs(s) ? s : NAN;
}

double spheres_heated_ratio(const struct spheres_wave *w, const struct spheres_gas *g,
                            double restitution) {
    struct spheres_wave slow = *w;
    slow.wavelength_m = INFINITY;
    const struct heat h = heat_of(&slow, g, restitution);
    return w->packing_fraction * w->push_m_per_s2 /
           (w->drag_per_s * sqrt(creal(heated_sound(&h, 0))));
}

/* Minus the growth rate (1/s) of a wave of exp(x) layers. */
static double decay_at(double x, void *wave) {
    struct spheres_wave w = *(const struct spheres_wave *)wave;
    w.wavelength_m = exp(x) * w.layer_m;
    return -creal(spheres_wave_root(&w));
}

double spheres_fastest_wave(const struct spheres_wave *w) {
    enum { STEPS = 300, REFINEMENTS = 60 };
    struct spheres_wave wave = *w;
    const double step = log(1000) / STEPS;
    gsl_function f = {decay_at, &wave};
    int best = 0;
    for (int i = 1; i <= STEPS; i++)
        if (decay_at(i * step, &wave) < decay_at(best * step, &wave))
            best = i;
    double x = best * step, least = decay_at(x, &wave);
    /* A minimum within the range, of growing waves, strictly below its neighbours. */
    if (best == 0 || best == STEPS || !(least < 0) || !(least < decay_at(x - step, &wave)) ||
        !(least < decay_at(x + step, &wave)))
        return NAN;
    gsl_min_fminimizer *m = gsl_min_fminimizer_alloc(gsl_min_fminimizer_brent);
    if (!m)
        return NAN;
    int error = gsl_min_fminimizer_set(m, &f, x, x - step, x + step);
    for (int i = 0; error == GSL_SUCCESS && i < REFINEMENTS; i++)
        error = gsl_min_fminimizer_iterate(m);
    x = gsl_min_fminimizer_x_minimum(m);
    gsl_min_fminimizer_free(m);
    return exp(x) * w->layer_m;
}
