/* observe_work.c -- what the gas does to the grains and the grains to the gas.
 *
 * With g_k the gradient of p at site k and u_k the grain velocity field,
 *
 *     (2/3) sum_i F_i . v_i  =  -(1/Pe) sum_k V_k g_k . u_k  =  (1/Pe) sum_k p_k (div u)_k
 *
 * (the first because deposit and gather use the same weights, the second
 * because the gradient is the adjoint of the divergence), and
 *
 *     (2/3) sum_i F_i + (force that sites below rho_min keep)  =  pressure difference on walls,
 *
 * where F_i is the gas's force on grain i (rho_g g l^2, per area: hence 2/3) and
 * a site below rho_min keeps -(1/Pe) V g (1 - rho/rho_min).  All of it is formed
 * here from positions, velocities, forces and the pressure field.  It holds at
 * one instant: grains are held in place while the samples are taken, so that
 * force, pressure and positions belong together.
 *
 * Source:     MFM, Eqs. 11, 14 and 17; docs/theory.md.
 * Leaves out: moving grains, an immobile packing.
 * Checked by: graingas/verification-force-balance; tests/unit/test_observe_gas.c.
 */
#include "validation/observe.h"
#include "validation/recipes.h"

#include <math.h>

enum {
    GATHER_ERROR,
    ADJOINT_ERROR,
    BALANCE_X,
    BALANCE_Y,
    UNABSORBED_ERROR,
    UNABSORBED_SHARE,
    WORK_SHARE
};

struct task {
    struct run_view *view;
    struct observe_box box;
    struct observe_physics physics;
    struct observe_grains grains;
    const struct series *force, *p, *rho, *u, *unabsorbed;
};

/* All in rho_g g l^2, or that times U0. */
struct sums {
    double grain_work, site_work, gas_work; /* the three sides above */
    double work_size;                       /* sum of |F_i . v_i| */
    double force[2], kept[2], wall[2];
    double force_size[2]; /* sum of |F_i|, and of the walls' pressures */
};

static enum status load(struct task *k, struct fault *fault) {
    enum status status = observe_box(k->view, &k->box, fault);
    if (!status)
        status = observe_physics(k->view, &k->physics, fault);
    if (!status)
        status = observe_grains(k->view, true, &k->grains, fault);
    if (!status)
        status = observe_values(k->view, "particles/grains/force", 2 * k->grains.count, &k->force,
                                fault);
    if (!status)
        status = observe_field(k->view, "fields/pressure", &k->box, 1, &k->p, fault);
    if (!status)
        status = observe_field(k->view, "fields/solid_fraction", &k->box, 1, &k->rho, fault);
    if (!status)
        status = observe_field(k->view, "fields/grain_velocity", &k->box, 2, &k->u, fault);
    if (!status)
        status = observe_values(k->view, "observables/unabsorbed_force", 2, &k->unabsorbed, fault);
    if (status)
        return status;
    size_t frames = k->grains.frames;
    if (k->force->frames != frames || k->p->frames != frames || k->rho->frames != frames ||
        k->u->frames != frames || k->unabsorbed->frames != frames)
        return fault_set(fault, STATUS_BAD_INPUT,
                         "%s: force balance needs particles and fields at the same times",
                         run_view_path(k->view));
    return STATUS_OK;
}

static void add_grains(const struct task *k, size_t frame, struct sums *s) {
    double to_volume = k->physics.area_to_volume;
    for (size_t i = 0; i < k->grains.count; i++) {
        const double *f = observe_vector(k->force->value, &k->grains, frame, i);
        const double *velocity = observe_vector(k->grains.velocity, &k->grains, frame, i);
        double work = to_volume * (f[0] * velocity[0] + f[1] * velocity[1]);
        s->grain_work += work;
        s->work_size += fabs(work);
        for (size_t a = 0; a < 2; a++) {
            s->force[a] += to_volume * f[a];
            s->force_size[a] += to_volume * fabs(f[a]);
        }
    }
}

static void add_sites(const struct task *k, size_t frame, struct sums *s) {
    const double *p = k->p->value + frame * k->p->size, *u = k->u->value + frame * k->u->size;
    const double *rho = k->rho->value + frame * k->rho->size;
    double per_peclet = 1 / k->physics.peclet;
    for (size_t j = 0; j < k->box.ny; j++)
        for (size_t i = 0; i < k->box.nx; i++) {
            size_t site = j * k->box.nx + i;
            double gradient[2];
            closure_gradient(p, i, j, k->box.nx, k->box.ny, gradient);
            double pull = -per_peclet * closure_site_volume(i, j, k->box.nx, k->box.ny);
            double clipped = closure_clip(rho[site], k->physics.solid_fraction_min);
            for (size_t a = 0; a < 2; a++) {
                s->site_work += pull * gradient[a] * u[2 * site + a];
                s->kept[a] += pull * gradient[a] * (1 - rho[site] / clipped);
            }
            s->gas_work += per_peclet * p[site] * closure_outflow(u, i, j, k->box.nx, k->box.ny);
        }
}

/* Pressure on the low walls less that on the high ones, sites weighted with wall length. */
static void add_walls(const struct task *k, size_t frame, struct sums *s) {
    const double *p = k->p->value + frame * k->p->size;
    size_t nx = k->box.nx, ny = k->box.ny;
    double per_peclet = 1 / k->physics.peclet;
    for (size_t j = 0; j < ny; j++) {
        double length = per_peclet * (j == 0 || j == ny - 1 ? 0.5 : 1);
        s->wall[0] += length * (p[j * nx] - p[j * nx + nx - 1]);
        s->force_size[0] += length * fabs(p[j * nx] - p[j * nx + nx - 1]);
    }
    for (size_t i = 0; i < nx; i++) {
        double length = per_peclet * (i == 0 || i == nx - 1 ? 0.5 : 1);
        s->wall[1] += length * (p[i] - p[(ny - 1) * nx + i]);
        s->force_size[1] += length * fabs(p[i] - p[(ny - 1) * nx + i]);
    }
}

static void compare(const struct task *k, size_t frame, const struct sums *s, double *worst) {
    const double *told = k->unabsorbed->value + 2 * frame;
    double work = fabs(s->grain_work - s->site_work) / s->work_size;
    double adjoint = fabs(s->site_work - s->gas_work) / s->work_size;
    worst[GATHER_ERROR] = fmax(worst[GATHER_ERROR], work);
    worst[ADJOINT_ERROR] = fmax(worst[ADJOINT_ERROR], adjoint);
    for (size_t a = 0; a < 2; a++) {
        double balance = fabs(s->force[a] + s->kept[a] - s->wall[a]) / s->force_size[a];
        double unabsorbed = fabs(told[a] - s->kept[a]) / s->force_size[a];
        worst[BALANCE_X + a] = fmax(worst[BALANCE_X + a], balance);
        worst[UNABSORBED_ERROR] = fmax(worst[UNABSORBED_ERROR], unabsorbed);
    }
    worst[UNABSORBED_SHARE] = fmax(worst[UNABSORBED_SHARE], fabs(s->kept[1]) / s->force_size[1]);
    worst[WORK_SHARE] = fmax(worst[WORK_SHARE], fabs(s->grain_work) / s->work_size);
}

static enum status measure(struct run_view *v, const double *settings, struct measurement *out,
                           struct fault *fault) {
    (void)settings;
    struct task k = {.view = v};
    enum status status = load(&k, fault);
    if (status)
        return status;
    size_t used = 0;
    for (size_t f = 0; f < k.grains.frames; f++) {
        struct sums s = {0};
        if (k.grains.time[f] <= 0)
            continue; /* no pressure yet */
        add_grains(&k, f, &s);
        add_sites(&k, f, &s);
        add_walls(&k, f, &s);
        if (!(s.work_size > 0 && s.force_size[0] > 0 && s.force_size[1] > 0))
            continue;
        compare(&k, f, &s, out->value);
        used++;
    }
    for (size_t i = 0; !used && i <= WORK_SHARE; i++)
        observe_none(out, i, "the gas exerts no force, or nothing moves");
    return STATUS_OK;
}

static const char *const DATASETS[] = {"particles/grains/position",
                                       "particles/grains/velocity",
                                       "particles/grains/force",
                                       "particles/grains/radius",
                                       "fields/pressure",
                                       "fields/solid_fraction",
                                       "fields/grain_velocity",
                                       "observables/unabsorbed_force",
                                       NULL};

const struct recipe recipe_gas_work = {
    .name = "gas-work",
    .title = "Force and work between gas and grains",
    .source = "MFM, Eqs. 11, 14 and 17",
    .datasets = DATASETS,
    .output = {{"gather_error", "1", "work on grains against that of the fields, over sum |F.v|"},
               {"adjoint_error", "1", "sum V g.u against -sum p div u, over the same"},
               {"balance_x", "1", "force on grains and kept by sites against the walls', across"},
               {"balance_y", "1", "the same, up"},
               {"unabsorbed_error", "1", "the solver's unabsorbed force against this recipe's"},
               {"unabsorbed_share", "1", "how much of the force it is: that the cut-off acts"},
               {"work_share", "1", "|work| over sum |F.v|: that it is no sum of zeros"}},
    .measure = measure,
};
