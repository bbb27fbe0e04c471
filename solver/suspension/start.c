#include "solver/suspension/start.h"

#include "common/random.h"
#include "solver/suspension/grid.h"
#include "solver/suspension/grow.h"

#include <gsl/gsl_randist.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

struct engine_setup suspension_start_setup(const struct suspension_parameters *v) {
    struct engine_setup s = {.count = v->particles,
                             .radius_m = v->radius,
                             .mass_kg = v->mass,
                             .restitution = v->restitution,
                             .guard = v->guard,
                             .contact_time_s = v->contact_time,
                             .cutoff_speed_m_s = v->cutoff_speed};
    for (int a = 0; a < 3; a++) {
        s.box_m[a] = v->box[a];
        s.boundary[a] = v->boundary[a];
    }
    return s;
}

/* -- velocities ------------------------------------------------------------------ */

/* Take the mean off along periodic axes and set the kinetic energy to 3 N T/2. */
static void adjust(const struct suspension_parameters *v, double square_speed, double *velocity) {
    double sum = 0;
    for (size_t a = 0; a < 3; a++) {
        double mean = 0;
        for (size_t i = 0; i < v->particles; i++)
            mean += velocity[3 * i + a] / (double)v->particles;
        for (size_t i = 0; i < v->particles; i++) {
            velocity[3 * i + a] -= v->boundary[a] == BOUNDARY_PERIODIC ? mean : 0;
            sum += velocity[3 * i + a] * velocity[3 * i + a];
        }
    }
    double factor = sum > 0 ? sqrt(3 * (double)v->particles * square_speed / sum) : 0;
    for (size_t k = 0; k < 3 * v->particles; k++)
        velocity[k] *= factor;
}

static enum status draw_velocities(const struct suspension_parameters *v, uint64_t seed,
                                   double *velocity, struct fault *fault) {
    double square_speed = v->start_temperature * v->temperature / v->mass; /* of a component */
    gsl_rng *rng;
    if (random_stream(seed, "suspension velocities", &rng, fault) != STATUS_OK)
        return fault->status;
    for (size_t k = 0; k < 3 * v->particles; k++)
        velocity[k] = gsl_ran_gaussian_ziggurat(rng, sqrt(square_speed));
    gsl_rng_free(rng);
    adjust(v, square_speed, velocity);
    return STATUS_OK;
}

/* -- a wave of density ------------------------------------------------------------- */

/* Height z at which a share `part` (of 1) of the spheres lies below, for a density
 * 1 + A sin(2 pi k z), z in box heights: z + A (1 - cos(2 pi k z))/(2 pi k) = part. */
static double height_of(double part, double amplitude, double turns) {
    double z = part;
    for (int n = 0; n < 60; n++) {
        double wave = 2 * M_PI * turns * z;
        double miss = z + amplitude * (1 - cos(wave)) / (2 * M_PI * turns) - part;
        z -= miss / (1 + amplitude * sin(wave));
    }
    return z;
}

static void make_wave(const struct suspension_parameters *v, double *position) {
    for (size_t i = 0; i < v->particles; i++) {
        double z = height_of(position[3 * i + 2] / v->box[2], v->wave_amplitude, v->wave_mode);
        z = z < 0 ? z + 1 : z;
        position[3 * i + 2] = (z < 1 ? z : z - 1) * v->box[2];
    }
}

/* -- grown -------------------------------------------------------------------------- */

static enum status start_grown(const struct suspension_parameters *v, uint64_t seed,
                               double *position, double *velocity, double *collisions,
                               struct fault *fault) {
    struct engine_setup s = suspension_start_setup(v);
    s.radius_m *= 1 + v->wave_amplitude;
    s.restitution = 1;
    s.guard = GUARD_NONE;
    if (v->start == SPHERES_SHARP)
        s.box_m[2] =
            suspension_parameters_filled_height(v); /* the lid, lifted when they are grown */
    struct grow_rule rule = {
        .setup = s, .rate = v->growth_rate, .square_speed = v->temperature / v->mass, .seed = seed};
    if (grow_spheres(&rule, position, collisions, fault) != STATUS_OK)
        return fault->status;
    if (v->wave_mode > 0)
        make_wave(v, position);
    return draw_velocities(v, seed, velocity, fault);
}

/* -- from lists and from an earlier result ------------------------------------------- */

static void start_list(const struct suspension_parameters *v, double *position, double *velocity) {
    for (size_t i = 0; i < v->particles; i++)
        for (size_t a = 0; a < 3; a++) {
            position[3 * i + a] = v->place[a].value[i];
            velocity[3 * i + a] = v->velocity[a].value[i];
        }
}

static enum status read_last_frame(struct h5_reader *r, const char *name, size_t count, double *out,
                                   struct fault *fault) {
    int rank;
    size_t dims[H5_MAX_RANK];
    if (h5_dims(r, name, &rank, dims, fault) != STATUS_OK)
        return fault->status;
    if (rank != 3 || dims[0] < 1 || dims[1] != count || dims[2] != 3)
        return fault_set(fault, STATUS_BAD_INPUT, "%s: %s is not [samples][%zu particles][3]",
                         h5_path(r), name, count);
    return h5_read_slab(r, name, dims[0] - 1, 3 * count, out, fault);
}

static enum status check_number(struct h5_reader *r, const char *name, double wanted,
                                struct fault *fault) {
    double *value = NULL;
    size_t count = 0;
    if (h5_read_reals(r, "parameters", name, 1, &value, &count, fault) != STATUS_OK)
        return fault->status;
    if (count != 1 || fabs(value[0] - wanted) > 1e-12 * wanted)
        fault_set(fault, STATUS_BAD_INPUT, "%s: %s is %.10g there and %.10g in this run",
                  h5_path(r), name, count == 1 ? value[0] : NAN, wanted);
    free(value);
    return fault->status;
}

static enum status start_from_file(const struct suspension_parameters *v, struct h5_reader *r,
                                   double *position, double *velocity, struct fault *fault) {
    char model[64];
    if (!r)
        return fault_set(fault, STATUS_BAD_INPUT,
                         "start: from-file needs a start_file in the run file");
    if (h5_read_text(r, "parameters", "model", model, sizeof model, fault) != STATUS_OK)
        return fault->status;
    if (strcmp(model, "suspension") != 0)
        return fault_set(fault, STATUS_BAD_INPUT,
                         "%s: is a result of the model %s; suspension is needed", h5_path(r),
                         model);
    if (check_number(r, "particles", (double)v->particles, fault) ||
        check_number(r, "radius_m", v->radius, fault) ||
        check_number(r, "mass_kg", v->mass, fault) ||
        read_last_frame(r, "particles/spheres/position/value", v->particles, position, fault) ||
        read_last_frame(r, "particles/spheres/velocity/value", v->particles, velocity, fault))
        return fault->status;
    return STATUS_OK;
}

enum status suspension_start(const struct suspension_parameters *v, struct h5_reader *file,
                             uint64_t seed, double *position, double *velocity, double *collisions,
                             struct fault *fault) {
    *collisions = 0;
    if (file && v->start != SPHERES_FROM_FILE)
        return fault_set(fault, STATUS_BAD_INPUT,
                         "a start_file is given, but start is not from-file");
    if (v->start == SPHERES_FROM_FILE)
        return start_from_file(v, file, position, velocity, fault);
    if (v->start == SPHERES_RANDOM || v->start == SPHERES_SHARP)
        return start_grown(v, seed, position, velocity, collisions, fault);
    start_list(v, position, velocity);
    return STATUS_OK;
}
