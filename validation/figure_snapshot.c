/* figure_snapshot.c -- all grains at one time, shaded by the solid fraction around them.
 *
 * MFM's Fig. 3 shows a box of 62 x 92 l at 30 tau.  Drawn is the run whose box
 * is nearest to 92 l high (the first usable seed of the first such point), at
 * the sample nearest to 30 tau.  The shade is the lattice's solid fraction,
 * interpolated to each grain with the weights of the halo.
 *
 * Source:     MFM, Fig. 3.
 * Leaves out: the gas.
 */
#include "validation/figure_recipes.h"
#include "validation/observe.h"

#include <math.h>

static const double HEIGHT_L = 92, TIME_TAU = 30, SHADE_MAX = 0.6;

static const struct measured_run *choose_run(const struct figure_input *in) {
    const struct measured_run *best = NULL;
    double nearest = INFINITY;
    for (size_t i = 0; i < in->data->point_count; i++) {
        const struct measured_point *p = &in->data->point[i];
        double away = fabs(measured_parameter(p, "height_l") - HEIGHT_L);
        if (isnan(away))
            away = 1e9; /* not a parameter of the case: any run will do */
        for (size_t k = 0; k < p->run_count && away < nearest; k++)
            if (p->run[k].usable) {
                best = &p->run[k];
                nearest = away;
            }
    }
    return best;
}

static size_t nearest_frame(const double *time, size_t frames) {
    size_t best = 0;
    for (size_t f = 1; f < frames; f++)
        if (fabs(time[f] - TIME_TAU) < fabs(time[best] - TIME_TAU))
            best = f;
    return best;
}

/* x, y, radius, shade[0 .. count-1] of the picture, copied out of the view. */
static enum status copy_grains(struct run_view *v, const struct observe_box *box,
                               const struct observe_grains *g, const struct series *rho,
                               size_t frame, struct report_picture *p, struct arena *arena,
                               struct fault *fault) {
    size_t rho_frame;
    enum status status =
        observe_frame(v, "fields/solid_fraction", rho, g->time[frame], &rho_frame, fault);
    double *x = arena_take(arena, 4 * g->count, sizeof *x);
    if (status)
        return status;
    if (!x)
        return fault_set(fault, STATUS_NO_MEMORY, "snapshot: out of memory");
    double *y = x + g->count, *radius = y + g->count, *shade = radius + g->count;
    const double *field = rho->value + rho_frame * rho->size;
    for (size_t i = 0; i < g->count; i++) {
        const double *at = observe_vector(g->position, g, frame, i);
        struct closure_halo h = closure_halo_at(at[0], at[1], box->nx, box->ny);
        double sum = 0;
        for (size_t k = 0; k < 4; k++)
            sum += h.weight[k] * field[h.site[k]];
        x[i] = at[0];
        y[i] = at[1];
        radius[i] = g->radius[i];
        shade[i] = fmin(fmax(sum / SHADE_MAX, 0), 1);
    }
    p->count = g->count;
    p->x = x;
    p->y = y;
    p->radius = radius;
    p->shade = shade;
    return STATUS_OK;
}

static enum status draw(const struct figure_input *in, const struct measured_run *run,
                        struct run_view *v, struct figure_output *out, struct fault *fault) {
    struct observe_box box;
    struct observe_grains g;
    const struct series *rho;
    struct report_picture p = {.name = "snapshot",
                               .title = in->wanted->title,
                               .caption = in->wanted->caption,
                               .alt = "All grains, shaded by the local solid fraction",
                               .shade_label = "solid fraction",
                               .shade_min = 0,
                               .shade_max = SHADE_MAX};
    enum status status = observe_box(v, &box, fault);
    if (!status)
        status = observe_grains(v, false, &g, fault);
    if (!status)
        status = observe_field(v, "fields/solid_fraction", &box, 1, &rho, fault);
    if (status)
        return status;
    size_t frame = nearest_frame(g.time, g.frames);
    status = copy_grains(v, &box, &g, rho, frame, &p, out->arena, fault);
    if (status)
        return status;
    p.width = box.width_l;
    p.height = box.height_l;
    if (!p.title)
        p.title = arena_text(out->arena, "%zu grains at %g tau", g.count, g.time[frame]);
    if (!p.caption)
        p.caption = arena_text(out->arena,
                               "Run %s, box %g x %g l. To be compared with MFM, Fig. 3: a sharp "
                               "front above, variations of density below it, the settled bed.",
                               run->run->name, box.width_l, box.height_l);
    if (!p.title || !p.caption)
        return fault_set(fault, STATUS_NO_MEMORY, "snapshot: out of memory");
    return figure_add_picture(out, &p, fault);
}

static enum status build(const struct figure_input *in, struct figure_output *out,
                         struct fault *fault) {
    const struct measured_run *run = choose_run(in);
    struct run_view *v = NULL;
    if (!run)
        return fault_set(fault, STATUS_BAD_INPUT, "no run can be used");
    enum status status = run_view_open(run->run_path, run->result_path, &v, fault);
    if (!status)
        status = draw(in, run, v, out, fault);
    run_view_close(v);
    return status;
}

const struct figure_recipe figure_snapshot = {
    .name = "snapshot",
    .title = "All grains at about 30 tau, shaded by the local solid fraction",
    .observables = 0,
    .build = build,
};
