/* observe.c -- what a suspension run can write, one function a dataset.
 *
 * Spheres come in the caller's order, which is that of their ids.  Observing
 * changes nothing that the run reads.  All counters and sums run since time 0: the
 * growth at the start is not in them. */
#include "solver/suspension/bonds.h"
#include "solver/suspension/groups.h"
#include "solver/suspension/start.h"
#include "solver/suspension/suspension.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define SPHERES "particles/spheres/"

const struct dataset suspension_datasets[] = {
    {SPHERES "id", DATASET_ONCE, "[particles], from 0 (1)"},
    {SPHERES "radius", DATASET_ONCE, "[particles] (m)"},
    {SPHERES "mass", DATASET_ONCE, "[particles] (kg)"},
    {SPHERES "position", DATASET_PARTICLES, "[particles][3]: centres, inside the box (m)"},
    {SPHERES "velocity", DATASET_PARTICLES, "[particles][3] (m/s)"},
    {SPHERES "image", DATASET_PARTICLES, "[particles][3]: periodic sides crossed, upwards + (1)"},
    {"profiles/packing_fraction", DATASET_SAMPLES, "[bins]: V/A sum of delta(z - z_i) (1)"},
    {"profiles/temperature_xy", DATASET_SAMPLES, "[bins]: about the slab's mean velocity (J)"},
    {"profiles/temperature_zz", DATASET_SAMPLES, "[bins]: about the slab's mean velocity (J)"},
    {"observables/collisions", DATASET_SAMPLES, "of pairs (1)"},
    {"observables/elastic_collisions", DATASET_SAMPLES, "of them, made elastic by the guard (1)"},
    {"observables/wall_collisions", DATASET_SAMPLES, "with hard sides (1)"},
    {"observables/kicks", DATASET_SAMPLES, "of single spheres (1)"},
    {"observables/events", DATASET_SAMPLES,
     "collisions, wall collisions, cell crossings and kicks (1)"},
    {"observables/stale_events", DATASET_SAMPLES, "found outdated, predicted anew (1)"},
    {"observables/cell_crossings", DATASET_SAMPLES, "passages between the engine's cells (1)"},
    {"observables/kinetic_energy", DATASET_SAMPLES, "of all velocities, mean motion too (J)"},
    {"observables/momentum", DATASET_SAMPLES, "[3] (kg m/s)"},
    {"observables/dissipated_energy", DATASET_SAMPLES, "taken by collisions (J)"},
    {"observables/noise_energy", DATASET_SAMPLES, "given by random kicks (J)"},
    {"observables/drive_energy", DATASET_SAMPLES, "given by the drive's kicks (J)"},
    {"observables/drag_energy", DATASET_SAMPLES, "taken by the common drag (J)"},
    {"observables/collision_virial", DATASET_SAMPLES, "pairs' impulse times distance (J)"},
    {"observables/wall_impulse", DATASET_SAMPLES, "[6]: on -x +x -y +y -z +z (kg m/s)"},
    {"observables/wall_virial", DATASET_SAMPLES, "impulse times (half the side - R) (J)"},
    {"observables/temperature", DATASET_SAMPLES, "m <v^2>/3, mean motion too (J)"},
    {"observables/temperature_xy", DATASET_SAMPLES,
     "horizontal, about the mean velocity of each profile slab (J)"},
    {"observables/temperature_zz", DATASET_SAMPLES, "vertical, about the same (J)"},
    {"observables/centre_of_mass", DATASET_SAMPLES,
     "[3]: of positions inside the box; images do not count (m)"},
    {"observables/largest_overlap", DATASET_SAMPLES, "found by a search of its own (diameters)"},
    {"observables/q6", DATASET_SAMPLES, "global bond-orientational order (1)"},
    {"observables/layer_fraction_error", DATASET_SAMPLES,
     "[2]: rms and largest difference of histogram and exact count (1)"},
    {"observables/noise_variance", DATASET_SAMPLES, "of a random kick's component (m^2/s^2)"},
    {"observables/phibar", DATASET_SAMPLES, "packing fraction that the flow supports (1)"},
    {NULL, DATASET_SAMPLES, NULL}};

static enum status append(const struct suspension *s, struct h5_writer *w, const char *name,
                          int rank, const size_t *dims, const double *data, const char *unit,
                          struct fault *fault) {
    return h5_append(w, name, H5_REAL, rank, dims, data, unit, s->step, s->now, "s", fault);
}

/* -- derived groups ----------------------------------------------------------------- */

static enum status describe(struct suspension *s, struct h5_writer *w, struct fault *fault) {
    const struct suspension_parameters *p = &s->parameters;
    struct groups g = groups_of(p, p->phibar);
    const struct {
        const char *name;
        double value;
    } number[] = {{"Z", g.lift},
                  {"drag_group", g.drag},
                  {"drive_group", g.drive},
                  {"kick_group", g.kick},
                  {"stability_ratio", g.stability},
                  {"thermal_speed_m_per_s", g.thermal_speed},
                  {"packing_fraction_in_box", g.packing_in_box},
                  {"length_x_m", p->box[0]},
                  {"length_y_m", p->box[1]},
                  {"length_z_m", p->box[2]}};
    for (size_t k = 0; k < sizeof number / sizeof *number; k++)
        if (isfinite(number[k].value) &&
            h5_attribute_reals(w, "derived", number[k].name, &number[k].value, 1, fault))
            return fault->status;
    s->described = true;
    return STATUS_OK;
}

/* -- spheres ------------------------------------------------------------------------ */

static enum status write_same(const struct suspension *s, struct h5_writer *w, const char *name,
                              double value, const char *unit, struct fault *fault) {
    size_t count = s->parameters.particles;
    for (size_t i = 0; i < count; i++)
        s->position[i] = value;
    return h5_write(w, name, H5_REAL, 1, &count, s->position, unit, fault);
}

static enum status write_ids(const struct suspension *s, struct h5_writer *w, const char *name,
                             struct fault *fault) {
    size_t count = s->parameters.particles;
    int64_t *id = (int64_t *)(void *)s->position;
    for (size_t i = 0; i < count; i++)
        id[i] = (int64_t)i;
    return h5_write(w, name, H5_INTEGER, 1, &count, id, "1", fault);
}

/* The H5MD box, its edges beside every particle sample. */
static enum status append_box(const struct suspension *s, struct h5_writer *w,
                              struct fault *fault) {
    const struct suspension_parameters *p = &s->parameters;
    const char *kind[3];
    double edges[9] = {p->box[0], 0, 0, 0, p->box[1], 0, 0, 0, p->box[2]};
    for (int a = 0; a < 3; a++)
        kind[a] = p->boundary[a] == BOUNDARY_PERIODIC ? "periodic" : "none";
    if (h5_link(w, SPHERES "position/step", SPHERES "box/edges/step", fault) ||
        h5_link(w, SPHERES "position/time", SPHERES "box/edges/time", fault) ||
        append(s, w, SPHERES "box/edges", 2, (size_t[]){3, 3}, edges, "m", fault) ||
        h5_attribute_integers(w, SPHERES "box", "dimension", (int[]){3}, 1, fault) ||
        h5_attribute_texts(w, SPHERES "box", "boundary", kind, 3, fault))
        return fault->status;
    return STATUS_OK;
}

static enum status append_images(const struct suspension *s, struct h5_writer *w, const char *name,
                                 struct fault *fault) {
    int64_t *image = (int64_t *)(void *)s->position;
    engine_snapshot(s->engine, NULL, NULL, image);
    return h5_append(w, name, H5_INTEGER, 2, (size_t[]){s->parameters.particles, 3}, image, "1",
                     s->step, s->now, "s", fault);
}

static enum status observe_spheres(const struct suspension *s, const char *name,
                                   struct h5_writer *w, struct fault *fault) {
    const char *what = strrchr(name, '/') + 1;
    size_t dims[2] = {s->parameters.particles, 3};
    if (!strcmp(what, "id"))
        return write_ids(s, w, name, fault);
    if (!strcmp(what, "radius"))
        return write_same(s, w, name, s->parameters.radius, "m", fault);
    if (!strcmp(what, "mass"))
        return write_same(s, w, name, s->parameters.mass, "kg", fault);
    if (!strcmp(what, "image"))
        return append_images(s, w, name, fault);
    engine_snapshot(s->engine, s->position, s->velocity, NULL);
    if (!strcmp(what, "velocity"))
        return append(s, w, name, 2, dims, s->velocity, "m/s", fault);
    if (append(s, w, name, 2, dims, s->position, "m", fault) != STATUS_OK)
        return fault->status;
    return append_box(s, w, fault);
}

/* -- profiles ----------------------------------------------------------------------- */

static void make_profiles(struct suspension *s) {
    engine_snapshot(s->engine, s->position, s->velocity, NULL);
    profiles_make(&s->profiles, &s->parameters, s->position, s->velocity);
}

static enum status observe_profiles(struct suspension *s, const char *name, struct h5_writer *w,
                                    struct fault *fault) {
    const struct profiles *f = &s->profiles;
    const char *what = strrchr(name, '/') + 1;
    double spacing = s->parameters.box[2] / (double)f->bins;
    make_profiles(s);
    if (h5_attribute_reals(w, "profiles", "spacing", &spacing, 1, fault) != STATUS_OK)
        return fault->status;
    if (!strcmp(what, "packing_fraction"))
        return append(s, w, name, 1, &f->bins, f->packing, "1", fault);
    return append(s, w, name, 1, &f->bins, !strcmp(what, "temperature_xy") ? f->xy : f->zz, "J",
                  fault);
}

/* -- observables -------------------------------------------------------------------- */

static enum status append_scalar(const struct suspension *s, struct h5_writer *w, const char *name,
                                 double value, const char *unit, struct fault *fault) {
    return append(s, w, name, 0, NULL, &value, unit, fault);
}

/* Sums of the engine and of the kicks; true when `what` is one of them. */
static bool find_counter(const struct suspension *s, const char *what, double *value,
                         const char **unit) {
    const struct engine_tally *t = engine_tally(s->engine);
    const struct energies e = suspension_energies(s);
    const long long events = t->collisions + t->wall_collisions + t->cell_crossings + s->kicks.done;
    const struct {
        const char *what, *unit;
        double value;
    } row[] = {{"collisions", "1", (double)t->collisions},
               {"elastic_collisions", "1", (double)t->elastic},
               {"wall_collisions", "1", (double)t->wall_collisions},
               {"kicks", "1", (double)s->kicks.done},
               {"events", "1", (double)events},
               {"stale_events", "1", (double)t->stale},
               {"cell_crossings", "1", (double)t->cell_crossings},
               {"dissipated_energy", "J", t->dissipated_J},
               {"noise_energy", "J", e.noise},
               {"drive_energy", "J", e.drive},
               {"drag_energy", "J", e.drag},
               {"collision_virial", "J", t->virial_J},
               {"wall_virial", "J", t->wall_virial_J},
               {"noise_variance", "m^2/s^2", s->noise.variance},
               {"phibar", "1", s->phibar}};
    for (size_t k = 0; k < sizeof row / sizeof *row; k++)
        if (!strcmp(what, row[k].what)) {
            *value = row[k].value;
            *unit = row[k].unit;
            return true;
        }
    return false;
}

/* Mean over the spheres of value[3*i+axis], times factor. */
static void find_mean(const struct suspension *s, const double *value, double factor,
                      double mean[3]) {
    const size_t count = s->parameters.particles;
    for (size_t a = 0; a < 3; a++) {
        mean[a] = 0;
        for (size_t i = 0; i < count; i++)
            mean[a] += value[3 * i + a];
        mean[a] *= factor / (double)count;
    }
}

static double kinetic_energy(const struct suspension *s) {
    double sum = 0;
    for (size_t k = 0; k < 3 * s->parameters.particles; k++)
        sum += s->velocity[k] * s->velocity[k];
    return 0.5 * s->parameters.mass * sum;
}

/* What needs the spheres' places and velocities. */
static enum status observe_state(struct suspension *s, const char *name, struct h5_writer *w,
                                 struct fault *fault) {
    const struct suspension_parameters *p = &s->parameters;
    const char *what = strrchr(name, '/') + 1;
    const double count = (double)p->particles;
    double three[3];
    make_profiles(s);
    if (!strcmp(what, "kinetic_energy"))
        return append_scalar(s, w, name, kinetic_energy(s), "J", fault);
    if (!strcmp(what, "temperature"))
        return append_scalar(s, w, name, 2 * kinetic_energy(s) / (3 * count), "J", fault);
    if (!strcmp(what, "temperature_xy"))
        return append_scalar(s, w, name, s->profiles.whole_xy, "J", fault);
    if (!strcmp(what, "temperature_zz"))
        return append_scalar(s, w, name, s->profiles.whole_zz, "J", fault);
    bool momentum = !strcmp(what, "momentum");
    find_mean(s, momentum ? s->velocity : s->position, momentum ? p->mass * count : 1, three);
    return append(s, w, name, 1, (size_t[]){3}, three, momentum ? "kg m/s" : "m", fault);
}

/* The histogram as it would be made now where no drive keeps one. */
static enum status append_layer_error(struct suspension *s, struct h5_writer *w, const char *name,
                                      struct fault *fault) {
    double error[2];
    engine_snapshot(s->engine, s->position, NULL, NULL);
    if (s->parameters.drive == DRIVE_NONE)
        layers_refresh(&s->layers, s->position);
    if (layers_error(&s->layers, s->position, &error[0], &error[1], fault) != STATUS_OK)
        return fault->status;
    return append(s, w, name, 1, (size_t[]){2}, error, "1", fault);
}

static enum status append_order(const struct suspension *s, struct h5_writer *w, const char *name,
                                struct fault *fault) {
    struct engine_setup setup = suspension_start_setup(&s->parameters);
    double q6 = 0;
    engine_snapshot(s->engine, s->position, NULL, NULL);
    if (bonds_order(&setup, s->position, &q6, fault) != STATUS_OK)
        return fault->status;
    return append_scalar(s, w, name, q6, "1", fault);
}

static enum status append_overlap(const struct suspension *s, struct h5_writer *w, const char *name,
                                  struct fault *fault) {
    double overlap = engine_deepest_overlap(s->engine);
    if (overlap < 0)
        return fault_set(fault, STATUS_NO_MEMORY, "no memory to look for overlaps");
    return append_scalar(s, w, name, overlap, "diameters", fault);
}

static enum status observe_observables(struct suspension *s, const char *name, struct h5_writer *w,
                                       struct fault *fault) {
    const char *what = strrchr(name, '/') + 1, *unit;
    double value;
    if (find_counter(s, what, &value, &unit))
        return append_scalar(s, w, name, value, unit, fault);
    if (!strcmp(what, "wall_impulse"))
        return append(s, w, name, 1, (size_t[]){6}, engine_tally(s->engine)->wall_impulse, "kg m/s",
                      fault);
    if (!strcmp(what, "layer_fraction_error"))
        return append_layer_error(s, w, name, fault);
    if (!strcmp(what, "q6"))
        return append_order(s, w, name, fault);
    if (!strcmp(what, "largest_overlap"))
        return append_overlap(s, w, name, fault);
    return observe_state(s, name, w, fault);
}

enum status suspension_observe(void *state, const char *dataset, struct h5_writer *w,
                               struct fault *fault) {
    struct suspension *s = state;
    double clock = suspension_clock();
    if (!s->described && describe(s, w, fault) != STATUS_OK)
        return fault->status;
    if (!strncmp(dataset, "particles/", 10))
        observe_spheres(s, dataset, w, fault);
    else if (!strncmp(dataset, "profiles/", 9))
        observe_profiles(s, dataset, w, fault);
    else
        observe_observables(s, dataset, w, fault);
    s->observe_seconds += suspension_clock() - clock;
    return fault->status;
}
