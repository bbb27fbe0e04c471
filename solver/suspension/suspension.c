#include "solver/suspension/suspension.h"

#include "solver/suspension/groups.h"
#include "solver/suspension/start.h"

#include <gsl/gsl_randist.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

double suspension_clock(void) {
    struct timespec t;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/* -- energies --------------------------------------------------------------------- */

struct energies suspension_energies(const struct suspension *s) {
    struct energies e = s->energies;
    double dissipated = engine_tally(s->engine)->dissipated_J;
    double half = 0.5 * (dissipated - e.dissipated);
    double lost = -(e.kinetic - half) * expm1(-2 * s->gamma * (s->now - e.time));
    e.kinetic -= half + lost + half;
    e.drag += lost;
    e.time = s->now;
    e.dissipated = dissipated;
    return e;
}

static double kinetic_energy(const struct suspension *s) {
    double sum = 0;
    for (size_t k = 0; k < 3 * s->parameters.particles; k++)
        sum += s->velocity[k] * s->velocity[k];
    return 0.5 * s->parameters.mass * sum;
}

/* -- what happens between events ------------------------------------------------------ */

/* Packing fraction around height z (m). */
static double fraction_at(struct suspension *s, double z) {
    if (!s->parameters.exact_layers)
        return layers_fraction(&s->layers, z);
    engine_snapshot(s->engine, s->position, NULL, NULL);
    return layers_exact(&s->layers, s->position, z);
}

static void kick(struct suspension *s) {
    const double mass = s->parameters.mass;
    double x[3], v[3], dv[3] = {0, 0, 0};
    size_t i = kicks_take(&s->kicks);
    engine_place(s->engine, i, x, v);
    if (s->drive.law != DRIVE_NONE) {
        dv[2] = drive_kick(&s->drive, fraction_at(s, x[2]), v[2]);
        double given = mass * dv[2] * (v[2] + 0.5 * dv[2]);
        s->energies.drive += given;
        s->energies.kinetic += given;
        v[2] += dv[2];
    }
    if (s->noise.variance > 0) {
        double given = 0, deviation = sqrt(s->noise.variance);
        for (int a = 0; a < 3; a++) {
            double random = gsl_ran_gaussian_ziggurat(s->noise_rng, deviation);
            given += mass * random * (v[a] + 0.5 * random);
            dv[a] += random;
        }
        s->energies.noise += given;
        s->energies.kinetic += given;
    }
    engine_kick(s->engine, i, dv);
}

/* T over m about the mean velocity of each profile slab (m^2/s^2). */
static double granular_temperature(struct suspension *s) {
    profiles_make(&s->profiles, &s->parameters, s->position, s->velocity);
    return (2 * s->profiles.whole_xy + s->profiles.whole_zz) / (3 * s->parameters.mass);
}

static void look(struct suspension *s) {
    const struct suspension_parameters *p = &s->parameters;
    double clock = suspension_clock();
    bool feedback = p->noise_rate == NOISE_FEEDBACK;
    long long collisions = engine_tally(s->engine)->collisions;
    struct noise_reading r = {.elapsed = s->now - s->look_time, .packing = s->noise.packing};
    engine_snapshot(s->engine, s->position, feedback ? s->velocity : NULL, NULL);
    if (p->drive != DRIVE_NONE) {
        layers_refresh(&s->layers, s->position);
        r.packing = layers_mean(&s->layers);
    }
    if (r.elapsed > 0)
        r.collision_rate =
            2 * (double)(collisions - s->look_collisions) / ((double)p->particles * r.elapsed);
    if (feedback)
        r.temperature = granular_temperature(s);
    if (r.elapsed > 0)
        noise_look(&s->noise, &r);
    s->look++;
    s->look_time = s->now;
    s->look_collisions = collisions;
    s->look_seconds += suspension_clock() - clock;
}

static enum status change(struct suspension *s, struct fault *fault) {
    s->phibar = s->parameters.phibar_values.value[s->changes++];
    s->gamma = suspension_parameters_drag(&s->parameters, s->phibar);
    s->drive = drive_at(&s->parameters, s->phibar);
    noise_change(&s->noise, s->gamma);
    return engine_set_drag(s->engine, s->gamma, fault);
}

/* -- stepping ----------------------------------------------------------------------- */

enum next { NEXT_END, NEXT_KICK, NEXT_LOOK, NEXT_CHANGE };

/* What comes first, and when; `end` when nothing does before or at it. */
static enum next next_of(const struct suspension *s, double end, double *time) {
    const struct suspension_parameters *p = &s->parameters;
    enum next next = NEXT_END;
    *time = end;
    if (suspension_parameters_kicks(p) && s->kicks.time <= *time) {
        *time = s->kicks.time;
        next = NEXT_KICK;
    }
    if (s->looks && (double)s->look * p->look_every <= *time) {
        *time = (double)s->look * p->look_every;
        next = NEXT_LOOK;
    }
    if (s->changes < p->phibar_times.count && p->phibar_times.value[s->changes] <= *time) {
        *time = p->phibar_times.value[s->changes];
        next = NEXT_CHANGE;
    }
    return next;
}

static enum status run_to(struct suspension *s, double end, struct fault *fault) {
    for (;;) {
        double time;
        enum next next = next_of(s, end, &time);
        if (engine_advance(s->engine, time, fault) != STATUS_OK)
            return fault->status;
        s->now = time;
        if (next == NEXT_END)
            return STATUS_OK;
        s->energies = suspension_energies(s);
        if (next == NEXT_KICK)
            kick(s);
        else if (next == NEXT_LOOK)
            look(s);
        else if (change(s, fault) != STATUS_OK)
            return fault->status;
    }
}

static enum status suspension_step(void *state, struct fault *fault) {
    struct suspension *s = state;
    double clock = suspension_clock(), boundary = (double)(s->slices + 1) * s->slice;
    double end = s->aim > s->now ? fmin(boundary, s->aim) : boundary;
    if (run_to(s, end, fault) != STATUS_OK)
        return fault_within(fault, "step %lld", s->step + 1);
    if (end == boundary) {
        s->energies = suspension_energies(s);
        s->slices++;
    }
    s->step++;
    s->step_seconds += suspension_clock() - clock;
    return STATUS_OK;
}

static void suspension_aim(void *state, double time) {
    ((struct suspension *)state)->aim = time;
}

static long long suspension_steps(const void *state) {
    return ((const struct suspension *)state)->step;
}

static double suspension_time(const void *state) {
    return ((const struct suspension *)state)->now;
}

static bool suspension_reached(const void *state, double time) {
    return ((const struct suspension *)state)->now >= time;
}

/* -- making and unmaking --------------------------------------------------------------- */

static void suspension_free(void *state) {
    struct suspension *s = state;
    if (!s)
        return;
    engine_free(s->engine);
    kicks_free(&s->kicks);
    layers_free(&s->layers);
    profiles_free(&s->profiles);
    gsl_rng_free(s->noise_rng);
    free((double *)s->parameters.phibar_times.value);
    free((double *)s->parameters.phibar_values.value);
    free(s->position);
    free(s->velocity);
    free(s);
}

/* The parameter set goes: the schedule is kept as a copy, other lists are only for the start. */
static enum status keep_schedule(struct suspension_parameters *p, const struct real_list *times,
                                 const struct real_list *values, struct fault *fault) {
    double *copy[2] = {calloc(times->count + 1, sizeof(double)),
                       calloc(values->count + 1, sizeof(double))};
    p->phibar_times = (struct real_list){copy[0], times->count};
    p->phibar_values = (struct real_list){copy[1], values->count};
    if (!copy[0] || !copy[1])
        return fault_set(fault, STATUS_NO_MEMORY, "no memory for the schedule of phibar");
    for (size_t k = 0; k < times->count; k++) {
        copy[0][k] = times->value[k];
        copy[1][k] = values->value[k];
    }
    return STATUS_OK;
}

static enum status make_spheres(struct suspension *s, struct h5_reader *file, uint64_t seed,
                                struct fault *fault) {
    struct suspension_parameters *p = &s->parameters;
    struct engine_setup setup = suspension_start_setup(p);
    s->position = malloc(3 * p->particles * sizeof *s->position);
    s->velocity = malloc(3 * p->particles * sizeof *s->velocity);
    if (!s->position || !s->velocity)
        return fault_set(fault, STATUS_NO_MEMORY, "no memory for %zu spheres", p->particles);
    double clock = suspension_clock();
    if (suspension_start(p, file, seed, s->position, s->velocity, &s->start_collisions, fault) ||
        engine_create(&s->engine, &setup, fault))
        return fault->status;
    if (engine_set_state(s->engine, s->position, s->velocity, fault) != STATUS_OK)
        return fault_within(fault, "start");
    s->start_seconds = suspension_clock() - clock;
    s->energies.kinetic = kinetic_energy(s);
    memset(p->place, 0, sizeof p->place);
    memset(p->velocity, 0, sizeof p->velocity);
    return STATUS_OK;
}

/* Without a drive nothing counts layers but the observable of their error, so a box
 * lower than Delta is no fault: it is one layer. */
static enum status make_layers(struct suspension *s, struct fault *fault) {
    const struct suspension_parameters *p = &s->parameters;
    struct layers_setup l = {.thickness_m = fmin(p->layer, p->box[2]),
                             .height_m = p->box[2],
                             .rise_m = suspension_parameters_volume(p) / (p->box[0] * p->box[1]),
                             .bin_m = p->bin,
                             .periodic = p->boundary[2] == BOUNDARY_PERIODIC,
                             .count = p->particles};
    if (layers_create(&s->layers, &l, fault) == STATUS_OK)
        layers_refresh(&s->layers, s->position);
    return fault->status;
}

/* 1/f_dr; without kicks the time in which a sphere flies its radius, and short against
 * the drag for the energies' sake (s). */
static double longest_step(const struct suspension *s) {
    const struct suspension_parameters *p = &s->parameters;
    double square = 2 * s->energies.kinetic / (3 * p->mass * (double)p->particles);
    double flight = square > 0 ? p->radius / sqrt(square) : 1;
    if (suspension_parameters_kicks(p))
        return 1 / p->kick_rate;
    return s->gamma > 0 ? fmin(flight, 1 / (64 * s->gamma)) : flight;
}

static enum status make_fluid(struct suspension *s, uint64_t seed, struct fault *fault) {
    const struct suspension_parameters *p = &s->parameters;
    bool driven = p->drive != DRIVE_NONE;
    s->phibar = p->phibar;
    s->gamma = suspension_parameters_drag(p, s->phibar);
    s->drive = drive_at(p, s->phibar);
    noise_start(&s->noise, p, driven ? layers_mean(&s->layers) : suspension_parameters_packing(p),
                s->gamma);
    s->looks = driven || p->noise_rate == NOISE_MEASURED || p->noise_rate == NOISE_FEEDBACK;
    s->slice = longest_step(s);
    if (suspension_parameters_kicks(p) &&
        kicks_create(&s->kicks, p->schedule, p->particles, p->kick_rate, seed, fault) != STATUS_OK)
        return fault->status;
    if (random_stream(seed, "suspension kicks", &s->noise_rng, fault) != STATUS_OK)
        return fault->status;
    return engine_set_drag(s->engine, s->gamma, fault);
}

static void notice_stability(struct suspension *s) {
    const struct suspension_parameters *p = &s->parameters;
    double ratio = groups_of(p, s->phibar).stability;
    if (p->drive != DRIVE_NONE && ratio > 1)
        snprintf(s->notice, sizeof s->notice,
                 "a homogeneous bed of packing fraction %g is linearly unstable here "
                 "(stability ratio %.3g, above 1; docs/theory.md)",
                 s->phibar, ratio);
}

static enum status suspension_create(void **state, const struct parameter_set *p,
                                     struct h5_reader *start, uint64_t seed, struct fault *fault) {
    *state = NULL;
    struct suspension_parameters v;
    if (suspension_parameters_read(p, &v, fault) != STATUS_OK)
        return fault->status;
    struct suspension *s = calloc(1, sizeof *s);
    if (!s)
        return fault_set(fault, STATUS_NO_MEMORY, "no memory for the suspension");
    s->parameters = v;
    s->aim = INFINITY;
    if (keep_schedule(&s->parameters, &v.phibar_times, &v.phibar_values, fault) != STATUS_OK ||
        make_spheres(s, start, seed, fault) != STATUS_OK ||
        profiles_create(&s->profiles, &s->parameters, fault) != STATUS_OK ||
        make_layers(s, fault) != STATUS_OK || make_fluid(s, seed, fault) != STATUS_OK) {
        suspension_free(s);
        return fault->status;
    }
    notice_stability(s);
    *state = s;
    return STATUS_OK;
}

static void report_cost(const void *state, struct json *j) {
    const struct suspension *s = state;
    const struct engine_tally *t = engine_tally(s->engine);
    const struct {
        const char *key;
        long long count;
    } event[] = {{"steps", s->step},
                 {"collisions", t->collisions},
                 {"wall_collisions", t->wall_collisions},
                 {"cell_crossings", t->cell_crossings},
                 {"stale_events", t->stale},
                 {"kicks", s->kicks.done},
                 {"looks", s->look},
                 {"clock_rebases", t->rebases},
                 {"rebuilds", t->rebuilds}};
    json_put_real(j, "start_s", s->start_seconds);
    json_put_real(j, "events_and_kicks_s", s->step_seconds - s->look_seconds);
    json_put_real(j, "looks_s", s->look_seconds);
    json_put_real(j, "observe_s", s->observe_seconds);
    for (size_t k = 0; k < sizeof event / sizeof *event; k++) {
        json_key(j, event[k].key);
        json_integer(j, event[k].count);
    }
    json_put_real(j, "start_collisions_per_sphere", s->start_collisions);
    json_put_real(j, "engine_bytes_per_sphere",
                  (double)engine_bytes(s->engine) / (double)s->parameters.particles);
}

static const char *notice(const void *state) {
    const struct suspension *s = state;
    return s->notice[0] ? s->notice : NULL;
}

const struct model suspension_model = {
    .name = "suspension",
    .title = "Driven hard spheres in a fluid, from event to event, three dimensions",
    .source = "Fiege & Zippelius, Dynamics of driven granular suspensions (2014)",
    .time_unit = "s",
    .length_unit = "m",
    .parameters = suspension_parameter_table,
    .parameter_count = SUSPENSION_PARAMETER_COUNT,
    .datasets = suspension_datasets,
    .create = suspension_create,
    .aim = suspension_aim,
    .step = suspension_step,
    .steps = suspension_steps,
    .time = suspension_time,
    .reached = suspension_reached,
    .observe = suspension_observe,
    .report_cost = report_cost,
    .notice = notice,
    .save = suspension_save,
    .load = suspension_load,
    .free = suspension_free,
};
