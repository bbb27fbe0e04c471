/* observe_spheres_velocity.c -- distribution and conservation of the spheres' velocities.
 *
 * All components of one sample, divided by their root mean square, are held against
 * the normal distribution: excess kurtosis <c^4>/<c^2>^2 - 3, and the statistic of
 * Kolmogorov and Smirnov with its probability (normality.h).
 *
 * Conservation: largest |E/E0 - 1| and |P - P0|/(N m v), v = sqrt(2 E0/(3 N m)), of all
 * samples; of the components of P only those along periodic axes.
 *
 * Source:     Stephens, J. Am. Stat. Assoc. 69, 730 (1974).
 * Leaves out: correlations of velocities.
 * Checked by: suspension/verification-maxwell, -conservation, -kicks;
 *             tests/unit/test_observe_spheres_velocity.c.
 */
#include "validation/normality.h"
#include "validation/observe_spheres.h"
#include "validation/recipes.h"

#include <math.h>
#include <stdlib.h>

enum { FROM_S };
enum { KURTOSIS, ANISOTROPY, STATISTIC, PROBABILITY, VARIANCE, FRAMES };
enum { ENERGY_DRIFT, MOMENTUM_DRIFT, COLLISIONS };

/* Components about the mean of each axis; moments of all. */
struct sample {
    double *c; /* c[0 .. n-1], owned (m/s) */
    size_t n;
    double variance, fourth, axis_variance[3];
};

static void take(const struct series *u, size_t frame, struct sample *s) {
    size_t count = s->n / 3;
    double mean[3] = {0};
    s->variance = s->fourth = 0;
    for (size_t i = 0; i < s->n; i++)
        mean[i % 3] += u->value[frame * s->n + i] / (double)count;
    for (size_t a = 0; a < 3; a++)
        s->axis_variance[a] = 0;
    for (size_t i = 0; i < s->n; i++) {
        s->c[i] = u->value[frame * s->n + i] - mean[i % 3];
        double square = s->c[i] * s->c[i];
        s->axis_variance[i % 3] += square / (double)count;
        s->variance += square / (double)s->n;
        s->fourth += square * square / (double)s->n;
    }
}

/* Moments are averaged over the frames of the window; the test is of the last frame. */
static enum status measure(struct run_view *v, const double *settings, struct measurement *out,
                           struct fault *fault) {
    struct observe_spheres b;
    const struct series *u;
    size_t first = 0;
    enum status status = observe_spheres(v, &b, fault);
    if (!status)
        status = observe_spheres_vectors(v, "velocity", &b, &u, fault);
    if (status)
        return status;
    while (first + 1 < u->frames && u->time[first] < settings[FROM_S] * (1 - 1e-6))
        first++;
    struct sample s = {.c = malloc(3 * b.count * sizeof *s.c), .n = 3 * b.count};
    if (!s.c)
        return fault_set(fault, STATUS_NO_MEMORY, "no memory for %zu components", 3 * b.count);
    double frames = (double)(u->frames - first), uneven = 0;
    for (size_t f = first; f < u->frames; f++) {
        take(u, f, &s);
        out->value[KURTOSIS] += (s.fourth / (s.variance * s.variance) - 3) / frames;
        out->value[VARIANCE] += s.variance / frames;
        for (size_t a = 0; a < 3; a++)
            uneven = fmax(uneven, fabs(s.axis_variance[a] / s.variance - 1));
    }
    if (s.variance > 0) {
        out->value[STATISTIC] = normality_distance(s.c, s.n, sqrt(s.variance));
        out->value[PROBABILITY] = normality_probability(out->value[STATISTIC], s.n);
        out->value[ANISOTROPY] = uneven;
    } else {
        for (size_t i = KURTOSIS; i <= PROBABILITY; i++)
            observe_none(out, i, "the spheres are at rest");
    }
    out->value[FRAMES] = frames;
    free(s.c);
    return STATUS_OK;
}

static enum status measure_conservation(struct run_view *v, const double *settings,
                                        struct measurement *out, struct fault *fault) {
    (void)settings;
    struct observe_spheres b;
    const struct series *energy, *momentum, *collisions;
    enum status status = observe_spheres(v, &b, fault);
    if (!status)
        status = observe_values(v, "observables/kinetic_energy", 1, &energy, fault);
    if (!status)
        status = observe_values(v, "observables/momentum", 3, &momentum, fault);
    if (!status)
        status = observe_values(v, "observables/collisions", 1, &collisions, fault);
    if (!status)
        status = observe_spheres_together(v, energy, momentum, fault);
    if (!status)
        status = observe_spheres_together(v, energy, collisions, fault);
    if (status)
        return status;
    double count = (double)b.count, start = energy->value[0];
    if (!(start > 0)) {
        observe_none(out, ENERGY_DRIFT, "the spheres have no energy at the start");
        observe_none(out, MOMENTUM_DRIFT, "the spheres have no energy at the start");
        return STATUS_OK;
    }
    double unit = count * b.mass_kg * sqrt(2 * start / (3 * count * b.mass_kg));
    for (size_t f = 1; f < energy->frames; f++) {
        out->value[ENERGY_DRIFT] =
            fmax(out->value[ENERGY_DRIFT], fabs(energy->value[f] / start - 1));
        for (size_t a = 0; a < 3; a++)
            if (b.periodic[a])
                out->value[MOMENTUM_DRIFT] =
                    fmax(out->value[MOMENTUM_DRIFT],
                         fabs(momentum->value[3 * f + a] - momentum->value[a]) / unit);
    }
    out->value[COLLISIONS] = 2 * collisions->value[collisions->frames - 1] / count;
    return STATUS_OK;
}

static const char *const DATASETS[] = {"particles/spheres/velocity", NULL};
static const char *const CONSERVATION_DATASETS[] = {
    "observables/kinetic_energy", "observables/momentum", "observables/collisions", NULL};

const struct recipe recipe_sphere_velocities = {
    .name = "sphere-velocities",
    .title = "Distribution of the spheres' velocities",
    .source = "Stephens, J. Am. Stat. Assoc. 69, 730 (1974)",
    .datasets = DATASETS,
    .setting = {{"from_s", "s", "samples before are left out", 0, 0, 1e9}},
    .output = {{"kurtosis", "1", "excess, of all components, mean over samples"},
               {"anisotropy", "1", "largest |<v_a^2>/mean - 1| of any axis and sample"},
               {"statistic", "1", "Kolmogorov and Smirnov's D of the last sample"},
               {"probability", "1", "of a D as large or larger"},
               {"variance", "m^2/s^2", "of a component, mean over samples"},
               {"samples", "1", "samples used"}},
    .measure = measure,
};

const struct recipe recipe_sphere_conservation = {
    .name = "sphere-conservation",
    .title = "Conservation of energy and momentum",
    .source = "Newton",
    .datasets = CONSERVATION_DATASETS,
    .output = {{"energy_drift", "1", "largest |E/E(first sample) - 1|"},
               {"momentum_drift", "1", "largest change along periodic axes, of N m v"},
               {"collisions", "1", "2 N_coll/N by the last sample"}},
    .measure = measure_conservation,
};
