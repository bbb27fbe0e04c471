/* bed_change.h -- a fluidized bed whose packing fraction phibar is changed: the numbers theory
 * needs.
 *
 * Before the change the bed rests at the packing fraction `before`; afterwards the flow supports
 * `after`.  `load_m` is the height of solid, N V/A, so a sharp bed is load/before high.  Overdamped
 * and without pressure, spheres in a region of packing fraction phi rise at
 *
 *     v = b'(phi - phibar)/gamma(phibar)              linear: FZ Eq. 9
 *     v = v_ex (1 - gamma(phibar)/gamma(phi))         full: FZ Eq. 1 at fixed v_ex (Eq. 7)
 *
 * with b' = b/(1 - phibar), v_ex = g'/gamma(phibar) and gamma(phi) = gamma0 (1 - phi)^-n.  Both
 * vanish at phibar, with the same slope c = b'/gamma(phibar): the first is the second, linearised.
 *
 * Source:     Fiege & Zippelius, "FZ", Eqs. 1, 6-9; docs/theory.md, S7.
 * Leaves out: more than one change in a run.
 * Checked by: tests/unit/test_kinematic_wave.c.
 */
#ifndef VALIDATION_BED_CHANGE_H
#define VALIDATION_BED_CHANGE_H

#include "validation/run_view.h"

struct bed_change {
    double before, after;        /* phibar (1) */
    double load_m;               /* height of solid */
    double radius_m, layer_m;    /* R, Delta; layer_m = 0: the local packing fraction counts */
    double drag_per_s, exponent; /* gamma0, n */
    double pull_m_per_s2;        /* reduced gravity g' */
    double heat_m2_per_s2;       /* T/m */
    double restitution;          /* of the wave with pressure */
    bool full;                   /* FZ Eq. 1 in place of Eq. 9 */
    bool inertia;                /* of the wave with pressure */
    bool sharp;                  /* starts as a sharp slab, not at rest */
};

/* From a run's parameters, with the time of the change (s).  A run that changes phibar never or
 * more than once is a fault. */
enum status bed_change_read(struct run_view *v, struct bed_change *out, double *change_s,
                            struct fault *fault);

double bed_change_slope(const struct bed_change *c);  /* dv/dphi at `after`: c (m/s) */
double bed_change_stream(const struct bed_change *c); /* v_ex (m/s) */
/* Speed upwards (m/s) of a region of this packing fraction, when the flow supports phibar. */
double bed_change_speed(const struct bed_change *c, double packing_fraction, double phibar);
/* Speed (m/s) for a force of 1 m/s^2: 1/gamma (s). */
double bed_change_mobility(const struct bed_change *c, double packing_fraction, double phibar);

#endif
