/* observe_energy.c -- energy and momentum of all grains, from their own positions.
 *
 * E = sum of m (v^2/2 + gravity y/Fr), m the grain's area.  Without gas and
 * with restitution 1 it is conserved: the free flights are exact parabolas and
 * a collision changes velocities only.
 *
 * Source:     MFM, Section II B.
 * Leaves out: the gas's work.
 * Checked by: graingas/verification-energy; tests/unit/test_observe_grains.c.
 */
#include "validation/observe.h"
#include "validation/recipes.h"

#include <math.h>

enum { DRIFT, COLLISIONS };

static double energy(const struct observe_grains *g, size_t frame, double fall) {
    double sum = 0;
    for (size_t i = 0; i < g->count; i++) {
        const double *x = observe_vector(g->position, g, frame, i);
        const double *u = observe_vector(g->velocity, g, frame, i);
        sum += observe_area(g, i) * ((u[0] * u[0] + u[1] * u[1]) / 2 + fall * x[1]);
    }
    return sum;
}

static enum status measure(struct run_view *v, const double *settings, struct measurement *out,
                           struct fault *fault) {
    (void)settings;
    struct observe_grains g;
    const struct series *collisions;
    double gravity, froude;
    enum status status = observe_grains(v, true, &g, fault);
    if (!status)
        status = run_view_parameter(v, "gravity", &gravity, fault);
    if (!status)
        status = run_view_parameter(v, "froude", &froude, fault);
    if (!status)
        status = observe_values(v, "observables/collisions", 1, &collisions, fault);
    if (status)
        return status;
    double start = energy(&g, 0, gravity / froude);
    if (!(start > 0)) {
        observe_none(out, DRIFT, "the grains have no energy at the start");
        return STATUS_OK;
    }
    for (size_t f = 1; f < g.frames; f++)
        out->value[DRIFT] =
            fmax(out->value[DRIFT], fabs(energy(&g, f, gravity / froude) / start - 1));
    out->value[COLLISIONS] = collisions->value[collisions->frames - 1] / (double)g.count;
    return STATUS_OK;
}

static const char *const DATASETS[] = {"particles/grains/position", "particles/grains/velocity",
                                       "particles/grains/radius", "observables/collisions", NULL};

const struct recipe recipe_energy = {
    .name = "energy",
    .title = "Conservation of the grains' energy",
    .source = "MFM, Section II B",
    .datasets = DATASETS,
    .output = {{"drift", "1", "largest |E/E(first frame) - 1|"},
               {"collisions", "1", "collisions per grain by the last frame"}},
    .measure = measure,
};
