/* observe_spheres_power.c -- cooling, and the balance of powers.
 *
 * sphere-cooling: Haff's T(t) = T(0)/(1 + t/tau)^2 as a straight line through the
 * origin: sqrt(T(0)/T) - 1 = t/tau (least squares).
 *
 * sphere-power: energies since time 0 over a window.  Exact for any run:
 *
 *     dE = noise + drive - dissipated - drag
 *
 * and, in a steady state, noise + drive = dissipated + drag.  The model of the noise
 * writes the dissipated power as (3/2) N C f (1 - eps^2) T with f = 2 N_coll/(N t);
 * C = 1/3 for Maxwell's velocities (each collision takes (1-eps^2) T on average: sphere_laws.h,
 * Haff), and is measured here.  Of T the drag gives a mean over all the time:
 * drag power = 3 N gamma T.
 *
 * Source:     Haff, J. Fluid Mech. 134, 401 (1983); Fiege & Zippelius, Section III.
 * Leaves out: a phibar that changes in the window.
 * Checked by: suspension/verification-haff, -power-balance, -coefficient,
 *             -temperature-target; tests/unit/test_observe_spheres_power.c.
 */
#include "validation/observe_spheres.h"
#include "validation/recipes.h"

#include <gsl/gsl_fit.h>
#include <math.h>
#include <stdlib.h>

enum { COOL_END };
enum { FROM_S, TO_S };
enum { COOLING_RATE, START_TEMPERATURE, DEVIATION, COOL_COLLISIONS, COOL_FRACTION, FALL };
enum {
    CLOSURE,
    BOOKKEEPING,
    COEFFICIENT,
    TEMPERATURE,
    TEMPERATURE_RATIO,
    SAMPLED_RATIO,
    RATE,
    KICK_RATE,
    DISSIPATED_SHARE
};

/* -- cooling -------------------------------------------------------------------------- */

static enum status fit_cooling(const struct series *energy, size_t last, struct measurement *out,
                               struct fault *fault) {
    double *t = malloc(2 * (last + 1) * sizeof *t), variance, sum;
    if (!t)
        return fault_set(fault, STATUS_NO_MEMORY, "no memory for %zu samples", last + 1);
    double *y = t + last + 1;
    for (size_t f = 0; f <= last; f++) {
        t[f] = energy->time[f] - energy->time[0];
        y[f] = sqrt(energy->value[0] / energy->value[f]) - 1;
    }
    gsl_fit_mul(t, 1, y, 1, last + 1, &out->value[COOLING_RATE], &variance, &sum);
    for (size_t f = 0; f <= last; f++)
        out->value[DEVIATION] = fmax(out->value[DEVIATION],
                                     fabs((1 + y[f]) / (1 + out->value[COOLING_RATE] * t[f]) - 1));
    free(t);
    return STATUS_OK;
}

static enum status measure_cooling(struct run_view *v, const double *settings,
                                   struct measurement *out, struct fault *fault) {
    struct observe_spheres b;
    const struct series *energy, *collisions;
    size_t first, last;
    enum status status = observe_spheres(v, &b, fault);
    if (!status)
        status = observe_values(v, "observables/kinetic_energy", 1, &energy, fault);
    if (!status)
        status = observe_values(v, "observables/collisions", 1, &collisions, fault);
    if (!status)
        status = observe_spheres_together(v, energy, collisions, fault);
    if (!status)
        status = observe_spheres_window(v, energy, 0, settings[COOL_END], &first, &last, fault);
    if (status)
        return status;
    for (size_t f = 0; f <= last; f++)
        if (!(energy->value[f] > 0))
            return fault_set(fault, STATUS_BAD_INPUT, "%s: no energy at %g s", run_view_path(v),
                             energy->time[f]);
    out->value[START_TEMPERATURE] = 2 * energy->value[0] / (3 * (double)b.count);
    out->value[COOL_COLLISIONS] = 2 * collisions->value[last] / (double)b.count;
    out->value[COOL_FRACTION] = b.packing_fraction;
    out->value[FALL] = energy->value[0] / energy->value[last];
    return fit_cooling(energy, last, out, fault);
}

/* -- powers --------------------------------------------------------------------------- */

enum { ENERGY, NOISE, DRIVE, DISSIPATED, DRAG, COLLISIONS, KICKS, SERIES };
static const char *const COUNTERS[SERIES + 1] = {
    "observables/kinetic_energy", "observables/noise_energy",
    "observables/drive_energy",   "observables/dissipated_energy",
    "observables/drag_energy",    "observables/collisions",
    "observables/kicks",          NULL};

struct balance {
    struct observe_spheres spheres;
    double gamma, restitution;
    double gain[SERIES]; /* growth of each counter in the window */
    double sampled;      /* mean temperature of the samples (J) */
    double time;
};

static enum status read_counters(struct run_view *v, const double *settings, struct balance *k,
                                 struct fault *fault) {
    const struct series *s[SERIES];
    size_t first = 0, last = 0;
    enum status status = STATUS_OK;
    for (size_t i = 0; !status && i < SERIES; i++) {
        status = observe_values(v, COUNTERS[i], 1, &s[i], fault);
        if (!status)
            status = observe_spheres_together(v, s[0], s[i], fault);
    }
    if (!status)
        status =
            observe_spheres_window(v, s[0], settings[FROM_S], settings[TO_S], &first, &last, fault);
    if (status)
        return status;
    for (size_t i = 0; i < SERIES; i++)
        k->gain[i] = s[i]->value[last] - s[i]->value[first];
    for (size_t f = first; f <= last; f++)
        k->sampled +=
            2 * s[ENERGY]->value[f] / (3 * (double)k->spheres.count * (double)(last - first + 1));
    k->time = s[0]->time[last] - s[0]->time[first];
    return STATUS_OK;
}

static void find_coefficient(const struct balance *k, struct measurement *out) {
    double loss = 1 - k->restitution * k->restitution;
    double unit = 3 * k->gain[COLLISIONS] * loss * out->value[TEMPERATURE]; /* (3/2) N f t ... */
    if (unit > 0)
        out->value[COEFFICIENT] = k->gain[DISSIPATED] / unit;
    else
        observe_none(out, COEFFICIENT, "no collision loses energy");
}

static enum status measure_power(struct run_view *v, const double *settings,
                                 struct measurement *out, struct fault *fault) {
    struct balance k = {0};
    double scale = 1;
    enum status status = observe_spheres(v, &k.spheres, fault);
    if (!status)
        status = observe_spheres_drag(v, &k.gamma, fault);
    if (!status)
        status = run_view_parameter(v, "restitution", &k.restitution, fault);
    if (!status)
        status = run_view_parameter(v, "temperature_scale", &scale, fault);
    if (!status)
        status = read_counters(v, settings, &k, fault);
    if (status)
        return status;
    double count = (double)k.spheres.count, given = k.gain[NOISE] + k.gain[DRIVE];
    double taken = k.gain[DISSIPATED] + k.gain[DRAG];
    if (!(taken > 0) || !(k.gamma > 0))
        return fault_set(fault, STATUS_BAD_INPUT, "%s: nothing is lost, or there is no drag",
                         run_view_path(v));
    out->value[CLOSURE] = given / taken - 1;
    out->value[BOOKKEEPING] = fabs(k.gain[ENERGY] - given + taken) / taken;
    out->value[TEMPERATURE] = k.gain[DRAG] / (3 * count * k.gamma * k.time);
    out->value[TEMPERATURE_RATIO] = out->value[TEMPERATURE] / (k.spheres.thermal_energy_J * scale);
    out->value[SAMPLED_RATIO] = k.sampled / out->value[TEMPERATURE];
    out->value[RATE] = 2 * k.gain[COLLISIONS] / (count * k.time);
    out->value[KICK_RATE] = k.gain[KICKS] / (count * k.time);
    out->value[DISSIPATED_SHARE] = k.gain[DISSIPATED] / taken;
    find_coefficient(&k, out);
    return STATUS_OK;
}

static const char *const COOLING_DATASETS[] = {"observables/kinetic_energy",
                                               "observables/collisions", NULL};

const struct recipe recipe_sphere_cooling = {
    .name = "sphere-cooling",
    .title = "Cooling of inelastic spheres",
    .source = "Haff, J. Fluid Mech. 134, 401 (1983)",
    .datasets = COOLING_DATASETS,
    .setting = {{"to_s", "s", "end of the window; 0: the last sample", 0, 0, 1e9}},
    .output = {{"rate", "1/s", "1/tau of T(0)/(1 + t/tau)^2"},
               {"temperature", "J", "T(0)"},
               {"deviation", "1", "largest deviation of sqrt(T) from the fit"},
               {"collisions", "1", "2 N_coll/N by the window's end"},
               {"packing_fraction", "1", "of the whole box"},
               {"fall", "1", "T(0)/T at the window's end"}},
    .measure = measure_cooling,
};

const struct recipe recipe_sphere_power = {
    .name = "sphere-power",
    .title = "Balance of the powers",
    .source = "Fiege & Zippelius, Section III",
    .datasets = COUNTERS,
    .setting = {{"from_s", "s", "start of the window", 0, 0, 1e9},
                {"to_s", "s", "end of the window; 0: the last sample", 0, 0, 1e9}},
    .output = {{"closure", "1", "(noise + drive)/(collisions + drag) - 1"},
               {"bookkeeping", "1", "|dE - noise - drive + collisions + drag| over the last two"},
               {"coefficient", "1", "of the collisions' term in the equation for T"},
               {"temperature", "J", "mean over the window, from the drag"},
               {"temperature_ratio", "1", "that over thermal_energy_J temperature_scale"},
               {"sampled_ratio", "1", "mean temperature of the samples over that"},
               {"collision_rate", "1/s", "2 N_coll/(N t)"},
               {"kick_rate", "1/s", "kicks per sphere and time"},
               {"dissipated_share", "1", "of the losses, in collisions"}},
    .measure = measure_power,
};
