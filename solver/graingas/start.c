#include "solver/graingas/start.h"

#include "common/random.h"
#include "solver/graingas/contacts.h"
#include "solver/graingas/push.h"

#include <gsl/gsl_randist.h>
#include <math.h>
#include <stdlib.h>

enum { MAX_PUSH_SWEEPS = 20000 };
static const double gap = 1e-7; /* pushed this far beyond touching, relative */

static void draw_places(struct grains *g, const struct graingas_parameters *p, double width,
                        gsl_rng *rng) {
    double d = p->diameter_max_l;
    for (size_t i = 0; i < g->count; i++) {
        double r = 0.5 * d * gsl_ran_flat(rng, p->diameter_ratio_min, 1);
        g->radius[i] = r;
        g->x[i] = gsl_ran_flat(rng, r, width - r);
        g->y[i] = gsl_ran_flat(rng, r, p->height_l - r);
    }
}

static double inside(double x, double radius, double length) {
    return fmin(fmax(x, radius), length - radius);
}

/* Push every overlapping pair apart once; returns how many there were. */
static size_t push_pairs_apart(struct grains *g, const struct neighbours *n) {
    size_t overlapping = 0;
    for (size_t i = 0; i < g->count; i++)
        for (size_t k = n->first[i]; k < n->first[i + 1]; k++) {
            size_t j = (size_t)n->other[k];
            double dx = g->x[i] - g->x[j], dy = g->y[i] - g->y[j];
            double reach = g->radius[i] + g->radius[j], square = dx * dx + dy * dy;
            if (square >= reach * reach)
                continue;
            double d = sqrt(square), half = 0.5 * (reach * (1 + gap) - d);
            double nx = d > 0 ? dx / d : 1, ny = d > 0 ? dy / d : 0;
            g->x[i] = inside(g->x[i] + half * nx, g->radius[i], n->width);
            g->y[i] = inside(g->y[i] + half * ny, g->radius[i], n->height);
            g->x[j] = inside(g->x[j] - half * nx, g->radius[j], n->width);
            g->y[j] = inside(g->y[j] - half * ny, g->radius[j], n->height);
            overlapping++;
        }
    return overlapping;
}

static enum status push_apart(struct grains *g, const struct graingas_parameters *p, double width,
                              struct fault *fault) {
    struct neighbours n;
    if (neighbours_create(&n, g->count, width, p->height_l, p->diameter_max_l, fault) != STATUS_OK)
        return fault->status;
    size_t overlapping = 1;
    int sweeps = 0;
    while (overlapping > 0 && sweeps++ < MAX_PUSH_SWEEPS) {
        if (neighbours_update(&n, g, fault) != STATUS_OK)
            break;
        overlapping = push_pairs_apart(g, &n);
    }
    neighbours_free(&n);
    if (fault->status == STATUS_OK && overlapping > 0)
        fault_set(fault, STATUS_BAD_INPUT,
                  "grains: %zu of %zu grains still overlap after %d sweeps: too many for the box",
                  overlapping, g->count, MAX_PUSH_SWEEPS);
    return fault->status;
}

static enum status start_random(struct grains *g, const struct graingas_parameters *p,
                                uint64_t seed, struct fault *fault) {
    gsl_rng *rng;
    if (random_stream(seed, "graingas places", &rng, fault) != STATUS_OK)
        return fault->status;
    draw_places(g, p, p->width_l, rng);
    gsl_rng_free(rng);
    return push_apart(g, p, p->width_l, fault);
}

/* Half the grains in the left half of the box, the others mirrored: grain i and
 * grain i + count/2 are images of each other. */
static enum status start_mirrored(struct grains *g, const struct graingas_parameters *p,
                                  uint64_t seed, struct fault *fault) {
    gsl_rng *rng;
    struct grains half;
    size_t count = g->count / 2;
    if (grains_create(&half, count, fault) != STATUS_OK)
        return fault->status;
    if (random_stream(seed, "graingas places", &rng, fault) != STATUS_OK)
        goto done;
    draw_places(&half, p, 0.5 * p->width_l, rng);
    gsl_rng_free(rng);
    if (push_apart(&half, p, 0.5 * p->width_l, fault) != STATUS_OK)
        goto done;
    for (size_t i = 0; i < count; i++) {
        /* An x that p->width_l - x gives back exactly, so that images are exact. */
        double image = p->width_l - half.x[i];
        g->x[i] = p->width_l - image;
        g->x[i + count] = image;
        g->y[i] = g->y[i + count] = half.y[i];
        g->radius[i] = g->radius[i + count] = half.radius[i];
    }
done:
    grains_free(&half);
    return fault->status;
}

static enum status draw_velocities(struct grains *g, double speed, uint64_t seed,
                                   const char *purpose, struct fault *fault) {
    gsl_rng *rng;
    if (random_stream(seed, purpose, &rng, fault) != STATUS_OK)
        return fault->status;
    for (size_t i = 0; i < g->count; i++) {
        g->vx[i] = gsl_ran_gaussian_ziggurat(rng, speed);
        g->vy[i] = gsl_ran_gaussian_ziggurat(rng, speed);
    }
    gsl_rng_free(rng);
    return STATUS_OK;
}

static enum status check_inside(const struct grains *g, const struct graingas_parameters *p,
                                struct fault *fault) {
    for (size_t i = 0; i < g->count; i++)
        if (!(g->x[i] >= 0 && g->x[i] <= p->width_l && g->y[i] >= 0 && g->y[i] <= p->height_l &&
              isfinite(g->vx[i]) && isfinite(g->vy[i])))
            return fault_set(fault, STATUS_BAD_INPUT,
                             "start: grain %zu is at (%g, %g) l, outside the box of %d x %d l", i,
                             g->x[i], g->y[i], p->width_l, p->height_l);
    return STATUS_OK;
}

/* Elastic discs in a closed box for equilibrate_tau; velocities zero afterwards. */
static enum status equilibrate(struct grains *g, const struct graingas_parameters *p, uint64_t seed,
                               double *collisions_per_grain, struct fault *fault) {
    struct contacts c;
    if (draw_velocities(g, p->equilibrate_speed, seed, "graingas equilibration", fault) !=
        STATUS_OK)
        return fault->status;
    if (contacts_create(&c, g->count, p->width_l, p->height_l, p->diameter_max_l, fault) !=
        STATUS_OK)
        return fault->status;
    struct contact_rule rule = {.restitution = 1, .threshold = 0};
    long long steps = llround(p->equilibrate_tau / p->dt_tau);
    for (rule.step = 1; rule.step <= steps && fault->status == STATUS_OK; rule.step++) {
        push_free(g, p->dt_tau);
        if (check_inside(g, p, fault) != STATUS_OK) {
            fault_within(fault, "equilibrate_speed %g is too fast for steps of %g tau",
                         p->equilibrate_speed, p->dt_tau);
            break;
        }
        if (contacts_find(&c, g, &rule, fault) == STATUS_OK)
            contacts_resolve(&c, g, &rule, fault);
    }
    if (g->count > 0)
        *collisions_per_grain = 2.0 * (double)c.tally.collisions / (double)g->count;
    contacts_free(&c);
    for (size_t i = 0; i < g->count; i++) {
        g->vx[i] = g->vy[i] = 0;
        g->last_hit[i] = GRAINS_NEVER_HIT;
    }
    return fault->status;
}

static void start_list(struct grains *g, const struct graingas_parameters *p) {
    for (size_t i = 0; i < g->count; i++) {
        g->x[i] = p->grain_x.value[i];
        g->y[i] = p->grain_y.value[i];
        g->radius[i] = 0.5 * p->grain_diameter.value[i];
        g->vx[i] = p->grain_velocity_x.value[i];
        g->vy[i] = p->grain_velocity_y.value[i];
    }
}

/* -- from an earlier result --------------------------------------------------- */

static enum status read_last_frame(struct h5_reader *r, const char *name, size_t count, double *x,
                                   double *y, struct fault *fault) {
    int rank;
    size_t dims[H5_MAX_RANK];
    if (h5_dims(r, name, &rank, dims, fault) != STATUS_OK)
        return fault->status;
    if (rank != 3 || dims[0] < 1 || dims[1] != count || dims[2] != 2)
        return fault_set(fault, STATUS_BAD_INPUT, "%s: %s is not [samples][%zu grains][2]",
                         h5_path(r), name, count);
    double *value = malloc((2 * count + 1) * sizeof *value);
    if (!value)
        return fault_set(fault, STATUS_NO_MEMORY, "no memory for %zu grains", count);
    if (h5_read_slab(r, name, dims[0] - 1, 2 * count, value, fault) == STATUS_OK)
        for (size_t i = 0; i < count; i++) {
            x[i] = value[2 * i];
            y[i] = value[2 * i + 1];
        }
    free(value);
    return fault->status;
}

static enum status start_from_file(struct grains *g, const struct graingas_parameters *p,
                                   struct h5_reader *r, struct fault *fault) {
    if (!r)
        return fault_set(fault, STATUS_BAD_INPUT,
                         "start: from-file needs a start_file in the run file");
    if (read_last_frame(r, "particles/grains/position/value", g->count, g->x, g->y, fault) ||
        read_last_frame(r, "particles/grains/velocity/value", g->count, g->vx, g->vy, fault) ||
        h5_read_exactly(r, "particles/grains/radius", g->count, g->radius, fault))
        return fault->status;
    for (size_t i = 0; i < g->count; i++)
        if (!(g->radius[i] > 0 && 2 * g->radius[i] <= p->diameter_max_l * (1 + 1e-12)))
            return fault_set(fault, STATUS_BAD_INPUT,
                             "%s: grain %zu has diameter %g l; diameter_max_l is %g", h5_path(r), i,
                             2 * g->radius[i], p->diameter_max_l);
    return STATUS_OK;
}

/* -- all of them ----------------------------------------------------------------- */

/* Horizontal layers of alternating species between the floor and the bed's top. */
static void colour_layers(struct grains *g, int layers) {
    double top = 0;
    for (size_t i = 0; i < g->count; i++)
        top = fmax(top, g->y[i]);
    for (size_t i = 0; i < g->count && layers > 0; i++)
        g->species[i] = (int32_t)fmin(g->y[i] / top * layers, layers - 1) % 2;
}

enum status start_make(struct grains *g, const struct graingas_parameters *p,
                       struct h5_reader *start, uint64_t seed, double *collisions_per_grain,
                       struct fault *fault) {
    *collisions_per_grain = 0;
    if (start && p->start != START_FROM_FILE)
        return fault_set(fault, STATUS_BAD_INPUT,
                         "a start_file is given, but start is not from-file");
    if (p->start == START_FROM_FILE)
        start_from_file(g, p, start, fault);
    else if (p->start == START_LIST)
        start_list(g, p);
    else if (p->mirror)
        start_mirrored(g, p, seed, fault);
    else
        start_random(g, p, seed, fault);
    if (fault->status != STATUS_OK || check_inside(g, p, fault) != STATUS_OK)
        return fault->status;
    grains_weigh(g);
    if (p->start == START_EQUILIBRATED)
        equilibrate(g, p, seed, collisions_per_grain, fault);
    if (fault->status == STATUS_OK && p->start_speed > 0)
        draw_velocities(g, p->start_speed, seed, "graingas velocities", fault);
    colour_layers(g, p->layers);
    return fault->status;
}
