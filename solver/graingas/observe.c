/* observe.c -- what a grain-gas run can write, one function a dataset.
 *
 * Grains are written in the order of their ids, fields row by row from the
 * floor.  Observing changes nothing that the next step reads. */
#include "solver/graingas/darcy.h"
#include "solver/graingas/graingas.h"

#include <assert.h>
#include <math.h>
#include <string.h>

const struct dataset graingas_datasets[] = {
    {"particles/grains/id", DATASET_ONCE, "[grains], from 0 (1)"},
    {"particles/grains/radius", DATASET_ONCE, "[grains] (l)"},
    {"particles/grains/mass", DATASET_ONCE, "[grains]: pi radius^2 (l^2)"},
    {"particles/grains/species", DATASET_ONCE, "[grains]: layer colour, 0 or 1"},
    {"particles/grains/position", DATASET_PARTICLES, "[grains][2]: centres (l)"},
    {"particles/grains/velocity", DATASET_PARTICLES, "[grains][2] (U0)"},
    {"particles/grains/force", DATASET_PARTICLES,
     "[grains][2]: of the gas, mass Fr a (l^2 rho_g g)"},
    {"fields/solid_fraction", DATASET_SAMPLES, "[ny][nx]: volume fraction, not clipped (1)"},
    {"fields/pressure", DATASET_SAMPLES, "[ny][nx]: P/P0 - 1 (P0)"},
    {"fields/grain_velocity", DATASET_SAMPLES, "[ny][nx][2]: flux over clipped fraction (U0)"},
    {"fields/collision_virial", DATASET_SAMPLES,
     "[ny][nx]: since the start, at pair centres (l^3 U0)"},
    {"observables/collisions", DATASET_SAMPLES, "since the start, walls included (1)"},
    {"observables/elastic_collisions", DATASET_SAMPLES, "those that conserved energy (1)"},
    {"observables/dissipated_energy", DATASET_SAMPLES, "in collisions, since the start (l^2 U0^2)"},
    {"observables/sweeps_max", DATASET_SAMPLES, "most sweeps of any step so far (1)"},
    {"observables/pressure_iterations", DATASET_SAMPLES, "of the last step (1)"},
    {"observables/largest_overlap", DATASET_SAMPLES, "of the last step (l)"},
    {"observables/wall_impulse", DATASET_SAMPLES,
     "[4]: left, right, bottom, top, since the start (l^2 U0)"},
    {"observables/wall_virial", DATASET_SAMPLES,
     "[4]: impulse times distance from the wall (l^3 U0)"},
    {"observables/collision_virial", DATASET_SAMPLES,
     "pairs' impulse times distance, since the start (l^3 U0)"},
    {"observables/solid_fraction_max", DATASET_SAMPLES, "of any site (1)"},
    {"observables/drag_rate_max", DATASET_SAMPLES, "largest drag rate of any site (1/tau)"},
    {"observables/kinetic_energy", DATASET_SAMPLES, "(l^2 U0^2)"},
    {"observables/potential_energy", DATASET_SAMPLES, "mass gravity height/Fr (l^2 U0^2)"},
    {"observables/sleeping", DATASET_SAMPLES, "grains asleep (1)"},
    {"observables/unabsorbed_force", DATASET_SAMPLES,
     "[2]: of the gas where rho < rho_min (l^2 rho_g g)"},
    {NULL, DATASET_SAMPLES, NULL}};

/* One sample with the state's step and time. */
static enum status append(const struct graingas *s, struct h5_writer *w, const char *name, int rank,
                          const size_t *dims, const double *data, const char *unit,
                          struct fault *fault) {
    return h5_append(w, name, H5_REAL, rank, dims, data, unit, s->step, graingas_time(s), "tau",
                     fault);
}

static enum status append_scalar(const struct graingas *s, struct h5_writer *w, const char *name,
                                 double value, const char *unit, struct fault *fault) {
    return append(s, w, name, 0, NULL, &value, unit, fault);
}

/* -- particles ------------------------------------------------------------------ */

static enum status write_once(struct graingas *s, struct h5_writer *w, const char *name,
                              const double *value, const char *unit, struct fault *fault) {
    const struct grains *g = &s->grains;
    for (size_t i = 0; i < g->count; i++)
        s->scratch[g->id[i]] = value[i];
    return h5_write(w, name, H5_REAL, 1, &g->count, s->scratch, unit, fault);
}

static enum status write_integers(struct graingas *s, struct h5_writer *w, const char *name,
                                  const int32_t *value, struct fault *fault) {
    const struct grains *g = &s->grains;
    int64_t *out = (int64_t *)(void *)s->scratch;
    for (size_t i = 0; i < g->count; i++)
        out[g->id[i]] = value[i];
    return h5_write(w, name, H5_INTEGER, 1, &g->count, out, "1", fault);
}

static enum status append_vectors(struct graingas *s, struct h5_writer *w, const char *name,
                                  const double *x, const double *y, const double *scale,
                                  const char *unit, struct fault *fault) {
    const struct grains *g = &s->grains;
    double *out = s->scratch;
    for (size_t i = 0; i < g->count; i++) {
        double factor = scale ? scale[i] * s->parameters.froude : 1;
        out[2 * g->id[i]] = factor * x[i];
        out[2 * g->id[i] + 1] = factor * y[i];
    }
    return append(s, w, name, 2, (size_t[]){g->count, 2}, out, unit, fault);
}

/* The H5MD box: closed on all sides; edges at every particle sample, sharing
 * step and time with the positions. */
static enum status append_box(struct graingas *s, struct h5_writer *w, struct fault *fault) {
    const char *const box = "particles/grains/box";
    double edges[4] = {s->parameters.width_l, 0, 0, s->parameters.height_l};
    if (h5_link(w, "particles/grains/position/step", "particles/grains/box/edges/step", fault) ||
        h5_link(w, "particles/grains/position/time", "particles/grains/box/edges/time", fault) ||
        append(s, w, "particles/grains/box/edges", 2, (size_t[]){2, 2}, edges, "l", fault) ||
        h5_attribute_integers(w, box, "dimension", (int[]){2}, 1, fault) ||
        h5_attribute_texts(w, box, "boundary", (const char *[]){"none", "none"}, 2, fault))
        return fault->status;
    return STATUS_OK;
}

static enum status observe_particles(struct graingas *s, const char *name, struct h5_writer *w,
                                     struct fault *fault) {
    struct grains *g = &s->grains;
    const char *what = strrchr(name, '/') + 1;
    if (!strcmp(what, "id"))
        return write_integers(s, w, name, g->id, fault);
    if (!strcmp(what, "species"))
        return write_integers(s, w, name, g->species, fault);
    if (!strcmp(what, "radius"))
        return write_once(s, w, name, g->radius, "l", fault);
    if (!strcmp(what, "mass"))
        return write_once(s, w, name, g->area, "l^2", fault);
    if (!strcmp(what, "velocity"))
        return append_vectors(s, w, name, g->vx, g->vy, NULL, "U0", fault);
    if (!strcmp(what, "position")) {
        if (append_vectors(s, w, name, g->x, g->y, NULL, "l", fault) != STATUS_OK)
            return fault->status;
        return append_box(s, w, fault);
    }
    gas_take_grains(&s->gas, &s->parameters, g);
    gas_find_pull(&s->gas, &s->parameters);
    halo_gather(&s->lattice, g, s->gas.pull, s->ax, s->ay);
    return append_vectors(s, w, name, s->ax, s->ay, g->area, "l^2 rho_g g", fault);
}

/* -- fields --------------------------------------------------------------------- */

static enum status append_velocity_field(struct graingas *s, struct h5_writer *w, const char *name,
                                         struct fault *fault) {
    const struct lattice *l = &s->lattice;
    double *out = (double *)(void *)s->gas.load; /* scratch of 4 values a site */
    for (size_t k = 0; k < l->sites; k++) {
        out[2 * k] = s->gas.ux[k];
        out[2 * k + 1] = s->gas.uy[k];
    }
    return append(s, w, name, 3, (size_t[]){(size_t)l->ny, (size_t)l->nx, 2}, out, "U0", fault);
}

static enum status observe_fields(struct graingas *s, const char *name, struct h5_writer *w,
                                  struct fault *fault) {
    const struct lattice *l = &s->lattice;
    const size_t dims[2] = {(size_t)l->ny, (size_t)l->nx};
    const char *what = strrchr(name, '/') + 1;
    if (h5_attribute_reals(w, "fields", "spacing", (double[]){1, 1}, 2, fault) ||
        h5_attribute_reals(w, "fields", "origin", (double[]){0, 0}, 2, fault))
        return fault->status;
    if (!strcmp(what, "pressure"))
        return append(s, w, name, 2, dims, s->gas.pressure, "P0", fault);
    if (!strcmp(what, "collision_virial"))
        return append(s, w, name, 2, dims, s->contacts.virial_field, "l^3 U0", fault);
    gas_take_grains(&s->gas, &s->parameters, &s->grains);
    if (!strcmp(what, "solid_fraction"))
        return append(s, w, name, 2, dims, s->gas.solid_fraction, "1", fault);
    return append_velocity_field(s, w, name, fault);
}

/* -- observables ----------------------------------------------------------------- */

static double potential_energy(const struct graingas *s) {
    double sum = 0;
    for (size_t i = 0; i < s->grains.count; i++)
        sum += s->grains.area[i] * s->grains.y[i];
    return sum * s->parameters.gravity / s->parameters.froude;
}

static enum status append_unabsorbed(struct graingas *s, struct h5_writer *w, const char *name,
                                     struct fault *fault) {
    double force[2];
    gas_take_grains(&s->gas, &s->parameters, &s->grains);
    gas_find_pull(&s->gas, &s->parameters);
    gas_unabsorbed(&s->gas, &s->parameters, force);
    return append(s, w, name, 1, (size_t[]){2}, force, "l^2 rho_g g", fault);
}

static enum status observe_densest(struct graingas *s, const char *name, struct h5_writer *w,
                                   struct fault *fault) {
    gas_take_grains(&s->gas, &s->parameters, &s->grains);
    double rho = gas_densest(&s->gas);
    if (!strcmp(name, "observables/solid_fraction_max"))
        return append_scalar(s, w, name, rho, "1", fault);
    double clipped = fmax(rho, s->parameters.solid_fraction_min);
    double rate = darcy_drag_rate(s->parameters.darcy, clipped, s->parameters.froude);
    return append_scalar(s, w, name, rate, "1/tau", fault);
}

static enum status observe_observables(struct graingas *s, const char *name, struct h5_writer *w,
                                       struct fault *fault) {
    const struct contact_tally *t = &s->contacts.tally;
    const struct {
        const char *what, *unit;
        double value;
    } scalar[] = {{"collisions", "1", (double)t->collisions},
                  {"elastic_collisions", "1", (double)t->elastic},
                  {"dissipated_energy", "l^2 U0^2", t->dissipated},
                  {"sweeps_max", "1", t->most_sweeps},
                  {"pressure_iterations", "1", s->gas.outcome.iterations},
                  {"largest_overlap", "l", t->largest_overlap},
                  {"collision_virial", "l^3 U0", t->virial},
                  {"sleeping", "1", (double)s->sleep.sleeping},
                  {"kinetic_energy", "l^2 U0^2", grains_kinetic_energy(&s->grains)},
                  {"potential_energy", "l^2 U0^2", potential_energy(s)}};
    const char *what = strrchr(name, '/') + 1;
    for (size_t i = 0; i < sizeof scalar / sizeof *scalar; i++)
        if (!strcmp(what, scalar[i].what))
            return append_scalar(s, w, name, scalar[i].value, scalar[i].unit, fault);
    if (!strcmp(what, "wall_impulse"))
        return append(s, w, name, 1, (size_t[]){WALL_COUNT}, t->wall_impulse, "l^2 U0", fault);
    if (!strcmp(what, "wall_virial"))
        return append(s, w, name, 1, (size_t[]){WALL_COUNT}, t->wall_virial, "l^3 U0", fault);
    if (!strcmp(what, "unabsorbed_force"))
        return append_unabsorbed(s, w, name, fault);
    return observe_densest(s, name, w, fault);
}

enum status graingas_observe(void *state, const char *dataset, struct h5_writer *w,
                             struct fault *fault) {
    struct graingas *s = state;
    if (!strncmp(dataset, "particles/", 10))
        return observe_particles(s, dataset, w, fault);
    if (!strncmp(dataset, "fields/", 7))
        return observe_fields(s, dataset, w, fault);
    return observe_observables(s, dataset, w, fault);
}
