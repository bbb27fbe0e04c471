/* observe_invariant.c -- what the linear gas equation conserves in a closed box.
 *
 * Summed over the sites, backward Euler of Eq. 8 is
 *
 *     sum V phi[n] (p[n+1] - p[n]) = 0,    phi[n] = 1 - max(rho[n], rho_min),
 *
 * for the Darcy flux and div u both cancel face by face.  (The true mass of gas,
 * sum V phi (1+p), drifts: Eq. 8 has dropped p u.)  What is left is the solver's
 * residual: if the 2-norm of the residual is below e times that of the right-hand
 * side b = V phi p[n]/dt - div u, the sum is below sqrt(sites) e |b| dt.  The imbalance is the
 * sum over sqrt(sites) |b| dt, so that e itself is its bound.
 *
 * Source:     MFM, Eq. 8; docs/theory.md.
 * Leaves out: injection (it cancels), the full Eq. 6.
 * Checked by: graingas/verification-gas-invariant; tests/unit/test_observe_gas.c.
 */
#include "validation/observe.h"
#include "validation/recipes.h"

#include <math.h>

enum { IMBALANCE, DRIFT, MOTION };

struct task {
    struct observe_box box;
    struct observe_physics physics;
    const struct series *p, *rho, *u;
};

static enum status load(struct run_view *v, struct task *k, struct fault *fault) {
    enum status status = observe_box(v, &k->box, fault);
    if (!status)
        status = observe_physics(v, &k->physics, fault);
    if (!status)
        status = observe_field(v, "fields/pressure", &k->box, 1, &k->p, fault);
    if (!status)
        status = observe_field(v, "fields/solid_fraction", &k->box, 1, &k->rho, fault);
    if (!status)
        status = observe_field(v, "fields/grain_velocity", &k->box, 2, &k->u, fault);
    if (status)
        return status;
    if (k->p->frames < 2 || k->rho->frames != k->p->frames || k->u->frames != k->p->frames)
        return fault_set(fault, STATUS_BAD_INPUT,
                         "%s: the gas invariant needs two frames of three fields each",
                         run_view_path(v));
    for (size_t f = 1; f < k->p->frames; f++)
        if (k->p->step[f] != k->p->step[f - 1] + 1)
            return fault_set(fault, STATUS_BAD_INPUT,
                             "%s: the gas invariant needs a sample every step; step %g follows %g",
                             run_view_path(v), k->p->step[f], k->p->step[f - 1]);
    return STATUS_OK;
}

struct sums {
    double change, size; /* sum V phi (p' - p), sum V phi |p' - p| (l^2 P0) */
    double right;        /* squares of V phi p - dt div u (l^2 P0) */
    double flow;         /* squares of dt div u */
};

/* Over the step from frame f to f + 1. */
static struct sums sum_step(const struct task *k, size_t f) {
    struct sums s = {0};
    double dt = k->physics.dt_tau;
    const double *p = k->p->value + f * k->box.sites, *next = p + k->box.sites;
    const double *rho = k->rho->value + f * k->box.sites;
    const double *u = k->u->value + f * k->u->size;
    for (size_t j = 0; j < k->box.ny; j++)
        for (size_t i = 0; i < k->box.nx; i++) {
            size_t site = j * k->box.nx + i;
            double phi = 1 - closure_clip(rho[site], k->physics.solid_fraction_min);
            double gas = closure_site_volume(i, j, k->box.nx, k->box.ny) * phi;
            double out = dt * closure_outflow(u, i, j, k->box.nx, k->box.ny);
            double right = gas * p[site] - out;
            s.change += gas * (next[site] - p[site]);
            s.size += gas * fabs(next[site] - p[site]);
            s.right += right * right;
            s.flow += out * out;
        }
    return s;
}

static enum status measure(struct run_view *v, const double *settings, struct measurement *out,
                           struct fault *fault) {
    (void)settings;
    struct task k;
    enum status status = load(v, &k, fault);
    if (status)
        return status;
    double imbalance = 0, drift = 0, size = 0, motion = 0;
    for (size_t f = 0; f + 1 < k.p->frames; f++) {
        struct sums s = sum_step(&k, f);
        if (s.right > 0)
            imbalance = fmax(imbalance, fabs(s.change) / sqrt((double)k.box.sites * s.right));
        drift += s.change;
        size += s.size;
        motion = fmax(motion, sqrt(s.flow));
    }
    out->value[IMBALANCE] = imbalance;
    out->value[DRIFT] = fabs(drift) / size;
    out->value[MOTION] = motion;
    if (!(size > 0))
        for (size_t i = IMBALANCE; i <= DRIFT; i++)
            observe_none(out, i, "the pressure never changes");
    return STATUS_OK;
}

static const char *const DATASETS[] = {"fields/pressure", "fields/solid_fraction",
                                       "fields/grain_velocity", NULL};

const struct recipe recipe_gas_invariant = {
    .name = "gas-invariant",
    .title = "Conserved sum of the linear gas equation",
    .source = "MFM, Eq. 8",
    .datasets = DATASETS,
    .output = {{"imbalance", "1", "largest |sum V phi dp| of a step over sqrt(sites) dt |b|"},
               {"drift", "1", "|sum of all steps| over sum V phi |dp|"},
               {"motion", "l^2", "largest 2-norm of dt div u: that the grains do move"}},
    .measure = measure,
};
