/* observe_halo.c -- the grains as the lattice sees them, deposited once more.
 *
 * From positions, radii and velocities, with the weights of MFM Eq. 13, each
 * site's solid fraction and velocity are formed again and compared with the
 * solver's fields.  Because the weights sum to 1 (Eq. 14), so do volumes: the
 * sum of V rho over sites is area_to_volume times the area of all grains.
 *
 * Source:     MFM, Eqs. 13-16, weighted by grain area (docs/theory.md).
 * Leaves out: an immobile packing.
 * Checked by: graingas/verification-halo; tests/unit/test_observe_gas.c.
 */
#include "validation/observe.h"
#include "validation/recipes.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { TOTAL_ERROR, FRACTION_ERROR, VELOCITY_ERROR };

struct task {
    struct run_view *view;
    struct observe_box box;
    struct observe_physics physics;
    struct observe_grains grains;
    const struct series *rho, *u;
    double *own; /* own[3*site]: area, then area times velocity, deposited (l^2, l^2 U0) */
};

static enum status load(struct task *k, struct fault *fault) {
    enum status status = observe_box(k->view, &k->box, fault);
    if (!status)
        status = observe_physics(k->view, &k->physics, fault);
    if (!status)
        status = observe_grains(k->view, true, &k->grains, fault);
    if (!status)
        status = observe_field(k->view, "fields/solid_fraction", &k->box, 1, &k->rho, fault);
    if (!status)
        status = observe_field(k->view, "fields/grain_velocity", &k->box, 2, &k->u, fault);
    if (status)
        return status;
    k->own = calloc(3 * k->box.sites, sizeof *k->own);
    return k->own ? STATUS_OK : fault_set(fault, STATUS_NO_MEMORY, "no memory for a lattice");
}

static void deposit(struct task *k, size_t frame) {
    memset(k->own, 0, 3 * k->box.sites * sizeof *k->own);
    for (size_t i = 0; i < k->grains.count; i++) {
        const double *x = observe_vector(k->grains.position, &k->grains, frame, i);
        const double *velocity = observe_vector(k->grains.velocity, &k->grains, frame, i);
        struct closure_halo h = closure_halo_at(x[0], x[1], k->box.nx, k->box.ny);
        for (size_t n = 0; n < 4; n++) {
            double share = h.weight[n] * observe_area(&k->grains, i);
            double *site = k->own + 3 * h.site[n];
            site[0] += share;
            site[1] += share * velocity[0];
            site[2] += share * velocity[1];
        }
    }
}

/* Errors of one frame: of the total, relative; of rho; of u. */
static void compare(const struct task *k, const double *rho, const double *u, double worst[3]) {
    double total = 0, field = 0;
    for (size_t i = 0; i < k->grains.count; i++)
        total += k->physics.area_to_volume * observe_area(&k->grains, i);
    for (size_t j = 0; j < k->box.ny; j++)
        for (size_t i = 0; i < k->box.nx; i++) {
            size_t site = j * k->box.nx + i;
            double volume = closure_site_volume(i, j, k->box.nx, k->box.ny);
            double scale = k->physics.area_to_volume / volume;
            double own_rho = scale * k->own[3 * site];
            double clipped = closure_clip(own_rho, k->physics.solid_fraction_min);
            field += volume * rho[site];
            worst[FRACTION_ERROR] = fmax(worst[FRACTION_ERROR], fabs(rho[site] - own_rho));
            for (size_t a = 0; a < 2; a++) {
                double own_u = scale * k->own[3 * site + 1 + a] / clipped;
                worst[VELOCITY_ERROR] = fmax(worst[VELOCITY_ERROR], fabs(u[2 * site + a] - own_u));
            }
        }
    worst[TOTAL_ERROR] = fmax(worst[TOTAL_ERROR], fabs(field / total - 1));
}

static enum status measure(struct run_view *v, const double *settings, struct measurement *out,
                           struct fault *fault) {
    (void)settings;
    struct task k = {.view = v};
    enum status status = load(&k, fault);
    for (size_t f = 0; !status && f < k.grains.frames; f++) {
        size_t rho_frame, u_frame;
        double time = k.grains.time[f];
        status = observe_frame(v, "fields/solid_fraction", k.rho, time, &rho_frame, fault);
        if (!status)
            status = observe_frame(v, "fields/grain_velocity", k.u, time, &u_frame, fault);
        if (status)
            break;
        deposit(&k, f);
        compare(&k, k.rho->value + rho_frame * k.rho->size, k.u->value + u_frame * k.u->size,
                out->value);
    }
    free(k.own);
    return status;
}

static enum status measure_uniform(struct run_view *v, const double *settings,
                                   struct measurement *out, struct fault *fault) {
    (void)settings;
    struct observe_box box;
    const struct series *s;
    enum status status = observe_box(v, &box, fault);
    if (!status)
        status = observe_field(v, "fields/solid_fraction", &box, 1, &s, fault);
    if (status)
        return status;
    double low = s->value[0], high = s->value[0], sum = 0;
    for (size_t j = 0; j < box.ny; j++)
        for (size_t i = 0; i < box.nx; i++) {
            double rho = s->value[j * box.nx + i];
            low = fmin(low, rho);
            high = fmax(high, rho);
            sum += rho * closure_site_volume(i, j, box.nx, box.ny);
        }
    out->value[0] = sum / (box.width_l * box.height_l);
    out->value[1] = high - low;
    return STATUS_OK;
}

static const char *const FRACTION_ONLY[] = {"fields/solid_fraction", NULL};

const struct recipe recipe_uniform_fraction = {
    .name = "uniform-fraction",
    .title = "Mean solid fraction of the lattice, and how uneven it is",
    .source = "MFM, Eq. 15",
    .datasets = FRACTION_ONLY,
    .output = {{"solid_fraction", "1", "mean over the box at the first sample"},
               {"unevenness", "1", "largest less smallest of any site"}},
    .measure = measure_uniform,
};

static const char *const DATASETS[] = {"particles/grains/position", "particles/grains/velocity",
                                       "particles/grains/radius",   "fields/solid_fraction",
                                       "fields/grain_velocity",     NULL};

const struct recipe recipe_halo = {
    .name = "halo",
    .title = "Grains deposited on the lattice, independently",
    .source = "MFM, Eqs. 13-16",
    .datasets = DATASETS,
    .output = {{"total_error", "1", "|sum V rho over that of all grains - 1|"},
               {"fraction_error", "1", "largest difference of rho on a site"},
               {"velocity_error", "U0", "largest difference of the grain velocity on a site"}},
    .measure = measure,
};
