/* observe_spheres_wave.c -- waves of density and uniform motion along z.
 *
 * sphere-wave: the Fourier mode rho = (2/N) sum exp(-i k z), k = 2 pi mode/height, is
 * the relative amplitude of a wave a cos(k z - theta): |rho| = a, arg rho = -theta.
 * Over the window ln |rho| is a straight line of slope sigma, the growth rate, and the
 * phase, unwound, falls by k c t: exp(st + ikz) with s = sigma - i k c.  Samples weigh as
 * |rho|^2, the inverse variance of both under noise of constant size.
 *
 * sphere-slab: mean velocity along z, from the momentum, at one sample.
 *
 * Source:     Fiege & Zippelius, Eq. 9, linearised (sphere_laws.h).
 * Leaves out: waves across; samples so far apart that the phase turns by half a turn.
 * Checked by: suspension/verification-density-wave, -terminal-velocity;
 *             tests/unit/test_observe_spheres_wave.c.
 */
#include "validation/observe_spheres.h"
#include "validation/recipes.h"

#include <gsl/gsl_fit.h>
#include <math.h>
#include <stdlib.h>

enum { FROM_S, TO_S, MODE };
enum { GROWTH, SPEED, WAVELENGTH, FIRST_AMPLITUDE, LAST_AMPLITUDE, FRACTION, MISFIT, TEMPERATURE };
enum { AT_S };
enum { SLAB_SPEED, SLAB_TIME, SLAB_FRACTION, SLAB_TEMPERATURE };

struct mode {
    size_t count;                                          /* samples */
    double *time, *amplitude, *phase, *logarithm, *weight; /* [0 .. count-1]; one block */
};

static void find_mode(const struct observe_spheres *b, const struct series *x, size_t frame,
                      double k, double *amplitude, double *phase) {
    double even = 0, odd = 0;
    for (size_t i = 0; i < b->count; i++) {
        double z = observe_spheres_at(x, frame, i)[2];
        even += cos(k * z);
        odd -= sin(k * z);
    }
    *amplitude = 2 * hypot(even, odd) / (double)b->count;
    *phase = atan2(odd, even);
}

/* Each phase within half a turn of the one before. */
static void unwind(double *phase, size_t count) {
    for (size_t i = 1; i < count; i++)
        phase[i] += 2 * M_PI * round((phase[i - 1] - phase[i]) / (2 * M_PI));
}

static void fit(const struct mode *m, double k, struct measurement *out) {
    double start, growth, turn, c00, c01, c11, sum, weights = 0;
    for (size_t i = 0; i < m->count; i++)
        weights += m->weight[i];
    gsl_fit_wlinear(m->time, 1, m->weight, 1, m->phase, 1, m->count, &start, &turn, &c00, &c01,
                    &c11, &sum);
    out->value[SPEED] = -turn / k;
    gsl_fit_wlinear(m->time, 1, m->weight, 1, m->logarithm, 1, m->count, &start, &growth, &c00,
                    &c01, &c11, &sum);
    out->value[GROWTH] = growth;
    out->value[MISFIT] = sqrt(sum / weights);
    out->value[FIRST_AMPLITUDE] = m->amplitude[0];
    out->value[LAST_AMPLITUDE] = m->amplitude[m->count - 1];
}

static enum status add_curves(const struct mode *m, struct measurement *out, struct fault *fault) {
    enum status status = measurement_add_curve(out, "amplitude", "amplitude", m->time, m->amplitude,
                                               m->count, fault);
    return status
               ? status
               : measurement_add_curve(out, "phase", "phase", m->time, m->phase, m->count, fault);
}

/* Of the samples first .. last, which are those of the places. */
static double mean_of(const struct series *s, size_t first, size_t last) {
    double sum = 0;
    for (size_t f = first; f <= last; f++)
        sum += s->value[f];
    return sum / (double)(last - first + 1);
}

static enum status measure(struct run_view *v, const double *settings, struct measurement *out,
                           struct fault *fault) {
    struct observe_spheres b;
    const struct series *x, *heat;
    size_t first = 0, last = 0;
    enum status status = observe_spheres(v, &b, fault);
    if (!status)
        status = observe_spheres_vectors(v, "position", &b, &x, fault);
    if (!status)
        status = observe_values(v, "observables/temperature_xy", 1, &heat, fault);
    if (!status)
        status = observe_spheres_together(v, x, heat, fault);
    if (!status)
        status =
            observe_spheres_window(v, x, settings[FROM_S], settings[TO_S], &first, &last, fault);
    if (!status && (!b.periodic[2] || last < first + 4))
        status =
            fault_set(fault, STATUS_BAD_INPUT,
                      "%s: a wave needs a box periodic along z and five samples", run_view_path(v));
    if (status)
        return status;
    double k = 2 * M_PI * settings[MODE] / b.box_m[2];
    struct mode m = {.count = last - first + 1};
    m.time = malloc(5 * m.count * sizeof *m.time);
    if (!m.time)
        return fault_set(fault, STATUS_NO_MEMORY, "no memory for %zu samples", m.count);
    m.amplitude = m.time + m.count;
    m.phase = m.amplitude + m.count;
    m.logarithm = m.phase + m.count;
    m.weight = m.logarithm + m.count;
    for (size_t i = 0; i < m.count; i++) {
        m.time[i] = x->time[first + i];
        find_mode(&b, x, first + i, k, &m.amplitude[i], &m.phase[i]);
        m.logarithm[i] = log(m.amplitude[i]);
        m.weight[i] = m.amplitude[i] * m.amplitude[i];
    }
    unwind(m.phase, m.count);
    fit(&m, k, out);
    out->value[WAVELENGTH] = b.box_m[2] / settings[MODE];
    out->value[FRACTION] = b.packing_fraction;
    out->value[TEMPERATURE] = mean_of(heat, first, last);
    status = add_curves(&m, out, fault);
    free(m.time);
    return status;
}

static enum status measure_slab(struct run_view *v, const double *settings, struct measurement *out,
                                struct fault *fault) {
    struct observe_spheres b;
    const struct series *momentum, *energy;
    enum status status = observe_spheres(v, &b, fault);
    if (!status)
        status = observe_values(v, "observables/momentum", 3, &momentum, fault);
    if (!status)
        status = observe_values(v, "observables/kinetic_energy", 1, &energy, fault);
    if (!status)
        status = observe_spheres_together(v, momentum, energy, fault);
    if (status)
        return status;
    size_t frame = 0;
    while (frame + 1 < momentum->frames && momentum->time[frame] < settings[AT_S] * (1 - 1e-6))
        frame++;
    if (fabs(momentum->time[frame] - settings[AT_S]) > 1e-5 * settings[AT_S])
        return fault_set(fault, STATUS_NOT_FOUND, "%s: no sample at %g s", run_view_path(v),
                         settings[AT_S]);
    double mass = (double)b.count * b.mass_kg;
    double speed = (momentum->value[3 * frame + 2] - momentum->value[2]) / mass;
    out->value[SLAB_SPEED] = speed;
    out->value[SLAB_TIME] = momentum->time[frame] - momentum->time[0];
    out->value[SLAB_FRACTION] = b.packing_fraction;
    out->value[SLAB_TEMPERATURE] =
        (2 * energy->value[frame] - mass * speed * speed) / (3 * (double)b.count);
    return STATUS_OK;
}

static const char *const DATASETS[] = {"particles/spheres/position", "observables/temperature_xy",
                                       NULL};
static const char *const SLAB_DATASETS[] = {"observables/momentum", "observables/kinetic_energy",
                                            NULL};
static const char *const CURVES[] = {"amplitude", "phase", NULL};

const struct recipe recipe_sphere_wave = {
    .name = "sphere-wave",
    .title = "Wave of density along z",
    .source = "Fiege & Zippelius, Eq. 9, linearised",
    .datasets = DATASETS,
    .setting = {{"from_s", "s", "start of the window", 0, 0, 1e9},
                {"to_s", "s", "end of the window; 0: the last sample", 0, 0, 1e9},
                {"mode", "1", "wavelengths in the height", 1, 1, 100}},
    .output = {{"growth", "1/s", "growth rate of the amplitude"},
               {"speed", "m/s", "phase speed, upwards"},
               {"wavelength", "m", "height over mode"},
               {"first_amplitude", "1", "relative, at the window's start"},
               {"last_amplitude", "1", "relative, at the window's end"},
               {"packing_fraction", "1", "of the whole box"},
               {"misfit", "1", "weighted root mean square of ln amplitude about the line"},
               {"temperature", "J", "horizontal, mean over the window"}},
    .curves = CURVES,
    .measure = measure,
};

const struct recipe recipe_sphere_slab = {
    .name = "sphere-slab",
    .title = "Mean velocity along z",
    .source = "Fiege & Zippelius, Eq. 9",
    .datasets = SLAB_DATASETS,
    .setting = {{"at_s", "s", "time of the sample", 1, 0, 1e9}},
    .output = {{"speed", "m/s", "mean velocity along z gained since the first sample"},
               {"time", "s", "from the first sample"},
               {"packing_fraction", "1", "of the whole box"},
               {"temperature", "J", "about the mean velocity along z"}},
    .measure = measure_slab,
};
