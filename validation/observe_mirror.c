/* observe_mirror.c -- does a mirror-symmetric start stay so, and how long.
 *
 * Grain i and grain i + N/2 (by id) start as mirror images about x = W/2.  The
 * asymmetry is the largest |x_i + x_j - W| or |y_i - y_j| of any pair.  Exact
 * arithmetic would keep it 0 but for one thing: of several contacts of one
 * grain in one step, the one that comes first in the list is resolved first,
 * and the list is not mirrored.  So the symmetry holds to round-off until a
 * grain meets two others in one step; the time of the last sample that keeps it
 * is the horizon.
 *
 * Source:     MFM, Section II B, step 3.
 * Leaves out: symmetry of the velocities, which follows.
 * Checked by: graingas/verification-mirror; tests/unit/test_observe_grains.c.
 */
#include "validation/observe.h"
#include "validation/recipes.h"

#include <math.h>
#include <stdlib.h>

enum { UNTIL_TAU, LIMIT_L };
enum { ASYMMETRY, HORIZON, COLLISIONS };

/* row_of[id] (0 .. count-1) from the ids as written. */
static enum status find_rows(struct run_view *v, size_t count, size_t **row_of,
                             struct fault *fault) {
    const double *id;
    size_t ids;
    enum status status = run_view_array(v, "particles/grains/id", &id, &ids, fault);
    if (status)
        return status;
    if (ids != count || count % 2)
        return fault_set(fault, STATUS_BAD_INPUT,
                         "%s: %zu ids for %zu grains; an even number "
                         "of both is needed",
                         run_view_path(v), ids, count);
    *row_of = calloc(count, sizeof **row_of);
    if (!*row_of)
        return fault_set(fault, STATUS_NO_MEMORY, "no memory for %zu grains", count);
    for (size_t i = 0; i < count; i++) {
        if (!(id[i] >= 0 && id[i] < (double)count))
            return fault_set(fault, STATUS_BAD_INPUT, "%s: grain %zu has id %g of %zu",
                             run_view_path(v), i, id[i], count);
        (*row_of)[(size_t)id[i]] = i;
    }
    return STATUS_OK;
}

static double asymmetry(const struct observe_grains *g, const size_t *row_of, double width,
                        size_t frame) {
    double worst = 0;
    for (size_t i = 0; i < g->count / 2; i++) {
        const double *a = observe_vector(g->position, g, frame, row_of[i]);
        const double *b = observe_vector(g->position, g, frame, row_of[i + g->count / 2]);
        worst = fmax(worst, fmax(fabs(a[0] + b[0] - width), fabs(a[1] - b[1])));
    }
    return worst;
}

static enum status measure(struct run_view *v, const double *settings, struct measurement *out,
                           struct fault *fault) {
    struct observe_grains g;
    const struct series *collisions;
    double width;
    size_t *row_of = NULL, used = 0;
    enum status status = observe_grains(v, false, &g, fault);
    if (!status)
        status = run_view_parameter(v, "width_l", &width, fault);
    if (!status)
        status = observe_values(v, "observables/collisions", 1, &collisions, fault);
    if (!status)
        status = find_rows(v, g.count, &row_of, fault);
    bool lost = false;
    for (size_t f = 0; !status && f < g.frames; f++) {
        double worst = asymmetry(&g, row_of, width, f);
        if (g.time[f] <= settings[UNTIL_TAU] + 1e-9) {
            out->value[ASYMMETRY] = fmax(out->value[ASYMMETRY], worst);
            used++;
        }
        lost = lost || worst > settings[LIMIT_L];
        if (!lost)
            out->value[HORIZON] = g.time[f];
    }
    free(row_of);
    if (status)
        return status;
    size_t frame;
    status =
        observe_frame(v, "observables/collisions", collisions, settings[UNTIL_TAU], &frame, fault);
    if (!status)
        out->value[COLLISIONS] = collisions->value[frame] / (double)g.count;
    if (!used)
        observe_none(out, ASYMMETRY, "no sample up to %g tau", settings[UNTIL_TAU]);
    return status;
}

static const char *const DATASETS[] = {"particles/grains/position", "particles/grains/radius",
                                       "particles/grains/id", "observables/collisions", NULL};

const struct recipe recipe_mirror = {
    .name = "mirror",
    .title = "Mirror symmetry of the grains",
    .source = "MFM, Section II B",
    .datasets = DATASETS,
    .setting = {{"until_tau", "tau", "the asymmetry's largest value up to here", 1, 0, 1e6},
                {"limit_l", "l", "asymmetry that ends the horizon", 1e-9, 0, 1}},
    .output = {{"asymmetry", "l", "largest until until_tau"},
               {"horizon", "tau", "last sample before the asymmetry passes limit_l"},
               {"collisions", "1", "collisions per grain by until_tau"}},
    .measure = measure,
};
