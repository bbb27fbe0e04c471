/* observe_contacts.c -- how deep grains overlap and how hard collisions were to resolve.
 *
 * Largest values over all samples of what the solver counts in each step.
 *
 * Source:     MFM, Section II B; the overlap must stay far below a radius.
 * Leaves out: steps between samples.
 * Checked by: graingas/sedimentation; tests/unit/test_observe_settling.c.
 */
#include "validation/observe.h"
#include "validation/recipes.h"

#include <math.h>

static enum status largest(struct run_view *v, const char *name, double *out, struct fault *fault) {
    const struct series *s;
    enum status status = observe_values(v, name, 1, &s, fault);
    if (status)
        return status;
    *out = s->value[0];
    for (size_t f = 1; f < s->frames; f++)
        *out = fmax(*out, s->value[f]);
    return STATUS_OK;
}

static enum status measure(struct run_view *v, const double *settings, struct measurement *out,
                           struct fault *fault) {
    (void)settings;
    enum status status = largest(v, "observables/largest_overlap", &out->value[0], fault);
    if (!status)
        status = largest(v, "observables/sweeps_max", &out->value[1], fault);
    if (!status)
        status = largest(v, "observables/solid_fraction_max", &out->value[2], fault);
    return status;
}

static const char *const DATASETS[] = {"observables/largest_overlap", "observables/sweeps_max",
                                       "observables/solid_fraction_max", NULL};

const struct recipe recipe_contacts = {
    .name = "contacts",
    .title = "Overlap and sweeps of the collision rule",
    .source = "MFM, Section II B",
    .datasets = DATASETS,
    .output = {{"largest_overlap", "l", "largest overlap of two grains, or of one with a wall"},
               {"sweeps_max", "1", "most sweeps over the contacts in one step"},
               {"solid_fraction_max", "1", "largest solid fraction of any site"}},
    .measure = measure,
};
