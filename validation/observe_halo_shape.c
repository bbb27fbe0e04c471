/* observe_halo_shape.c -- the halo as a grain draws it that passes a site of the lattice.
 *
 * One grain alone gives a site the solid fraction area_to_volume A s / V, so that
 * the site's field tells the weight s of the place that the grain is at:
 * (1 - |dx|)(1 - |dy|) within one lattice constant both ways, else 0.
 *
 * Source:     MFM, Eqs. 13 and 15, Fig. 2.
 * Leaves out: velocities, which take the same weights (recipe halo).
 * Checked by: graingas/verification-halo-shape; tests/unit/test_observe_gas.c.
 */
#include "validation/observe.h"
#include "validation/recipes.h"

#include <math.h>
#include <stdlib.h>

enum { SITE_X, SITE_Y };
enum { ERROR, LARGEST, INSIDE };

struct shape {
    struct observe_box box;
    struct observe_physics physics;
    struct observe_grains grains;
    const struct series *rho;
    size_t i, j;                       /* of the site */
    double *place, *measured, *theory; /* [frame]: x - x_site (l), weights */
};

static enum status load(struct run_view *v, const double *settings, struct shape *s,
                        struct fault *fault) {
    enum status status = observe_box(v, &s->box, fault);
    if (!status)
        status = observe_physics(v, &s->physics, fault);
    if (!status)
        status = observe_grains(v, false, &s->grains, fault);
    if (!status)
        status = observe_field(v, "fields/solid_fraction", &s->box, 1, &s->rho, fault);
    if (status)
        return status;
    s->i = (size_t)settings[SITE_X];
    s->j = (size_t)settings[SITE_Y];
    if (s->grains.count != 1 || s->i >= s->box.nx || s->j >= s->box.ny)
        return fault_set(fault, STATUS_BAD_INPUT,
                         "%s: one grain and a site of the %zu by %zu lattice are needed, not %zu "
                         "grains and site (%zu, %zu)",
                         run_view_path(v), s->box.nx, s->box.ny, s->grains.count, s->i, s->j);
    s->place = malloc(3 * s->grains.frames * sizeof *s->place);
    if (!s->place)
        return fault_set(fault, STATUS_NO_MEMORY, "no memory for %zu places", s->grains.frames);
    s->measured = s->place + s->grains.frames;
    s->theory = s->measured + s->grains.frames;
    return STATUS_OK;
}

static double theory_weight(const struct shape *s, const double x[2]) {
    struct closure_halo h = closure_halo_at(x[0], x[1], s->box.nx, s->box.ny);
    double weight = 0;
    for (size_t n = 0; n < 4; n++)
        weight += h.site[n] == s->j * s->box.nx + s->i ? h.weight[n] : 0;
    return weight;
}

/* What the site has of the grain at one sample, and what it should have. */
static enum status weigh(struct run_view *v, struct shape *s, size_t frame, struct fault *fault) {
    size_t rho_frame;
    enum status status =
        observe_frame(v, "fields/solid_fraction", s->rho, s->grains.time[frame], &rho_frame, fault);
    if (status)
        return status;
    const double *x = observe_vector(s->grains.position, &s->grains, frame, 0);
    double rho = s->rho->value[rho_frame * s->rho->size + s->j * s->box.nx + s->i];
    double volume = closure_site_volume(s->i, s->j, s->box.nx, s->box.ny);
    s->place[frame] = x[0] - (double)s->i;
    s->measured[frame] = rho * volume / (s->physics.area_to_volume * observe_area(&s->grains, 0));
    s->theory[frame] = theory_weight(s, x);
    return STATUS_OK;
}

static enum status measure(struct run_view *v, const double *settings, struct measurement *out,
                           struct fault *fault) {
    struct shape s = {0};
    enum status status = load(v, settings, &s, fault);
    for (size_t f = 0; !status && f < s.grains.frames; f++) {
        status = weigh(v, &s, f, fault);
        if (status)
            break;
        out->value[ERROR] = fmax(out->value[ERROR], fabs(s.measured[f] - s.theory[f]));
        out->value[LARGEST] = fmax(out->value[LARGEST], s.measured[f]);
        out->value[INSIDE] += s.measured[f] > 0;
    }
    if (!status)
        status = measurement_add_curve(out, "weight", "measured", s.place, s.measured,
                                       s.grains.frames, fault);
    if (!status)
        status = measurement_add_curve(out, "weight", "Eq. 13", s.place, s.theory, s.grains.frames,
                                       fault);
    free(s.place);
    return status;
}

static const char *const DATASETS[] = {"particles/grains/position", "particles/grains/radius",
                                       "fields/solid_fraction", NULL};
static const char *const CURVES[] = {"weight", NULL};

const struct recipe recipe_halo_shape = {
    .name = "halo-shape",
    .title = "The weight that a site gives a passing grain",
    .source = "MFM, Eq. 13, Fig. 2",
    .datasets = DATASETS,
    .setting = {{"site_x", "l", "place of the site along x", 0, 0, 1e4},
                {"site_y", "l", "place of the site along y", 0, 0, 1e4}},
    .output = {{"error", "1", "largest difference from Eq. 13 at any sample"},
               {"largest", "1", "largest weight"},
               {"inside", "1", "samples with the site inside the halo"}},
    .curves = CURVES,
    .measure = measure,
};
