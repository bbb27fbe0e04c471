#include "solver/graingas/graingas.h"

#include "solver/graingas/darcy.h"
#include "solver/graingas/push.h"
#include "solver/graingas/start.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

static void graingas_free(void *state) {
    struct graingas *s = state;
    if (!s)
        return;
    lattice_free(&s->lattice);
    grains_free(&s->grains);
    gas_free(&s->gas);
    contacts_free(&s->contacts);
    sleep_free(&s->sleep);
    free(s->flux_schedule);
    free(s->ax);
    free(s->ay);
    free(s->scratch);
    free(s);
}

static void notice_step(struct graingas *s) {
    const struct graingas_parameters *p = &s->parameters;
    double bound = graingas_parameters_dt_bound(p);
    if (p->gas != GAS_NONE && p->grains > 0 && p->dt_tau > 0.5 * bound)
        snprintf(s->notice, sizeof s->notice,
                 "dt_tau = %g is above half the drag's stability bound %.4g", p->dt_tau, bound);
}

/* The grains are made last: their start may need the box and its parameters. */
static enum status graingas_create(void **state, const struct parameter_set *p,
                                   struct h5_reader *start, uint64_t seed, struct fault *fault) {
    *state = NULL;
    struct graingas *s = calloc(1, sizeof *s);
    if (!s)
        return fault_set(fault, STATUS_NO_MEMORY, "no memory for the grain-gas state");
    const struct graingas_parameters *v = &s->parameters;
    if (graingas_parameters_read(p, &s->parameters, fault) != STATUS_OK ||
        lattice_create(&s->lattice, v->width_l, v->height_l, fault) != STATUS_OK ||
        grains_create(&s->grains, v->grains, fault) != STATUS_OK ||
        gas_create(&s->gas, &s->lattice, v, fault) != STATUS_OK ||
        contacts_create(&s->contacts, v->grains, v->width_l, v->height_l, v->diameter_max_l,
                        fault) != STATUS_OK ||
        sleep_create(&s->sleep, &s->grains, fault) != STATUS_OK)
        goto failed;
    size_t fluxes = v->flux_schedule.count;
    s->flux_schedule = calloc(fluxes + 1, sizeof *s->flux_schedule);
    s->ax = calloc(v->grains + 1, sizeof *s->ax);
    s->ay = calloc(v->grains + 1, sizeof *s->ay);
    s->scratch = calloc(4 * v->grains + 4, sizeof *s->scratch);
    if (!s->flux_schedule || !s->ax || !s->ay || !s->scratch) {
        fault_set(fault, STATUS_NO_MEMORY, "no memory for %zu grains", v->grains);
        goto failed;
    }
    if (fluxes > 0)
        memcpy(s->flux_schedule, v->flux_schedule.value, fluxes * sizeof *s->flux_schedule);
    s->parameters.flux_schedule.value = s->flux_schedule;
    if (start_make(&s->grains, v, start, seed, &s->start_collisions, fault) != STATUS_OK)
        goto failed;
    notice_step(s);
    *state = s;
    return STATUS_OK;
failed:
    graingas_free(s);
    return fault->status;
}

double graingas_time(const void *state) {
    const struct graingas *s = state;
    return (double)s->step * s->parameters.dt_tau;
}

static long long graingas_steps(const void *state) {
    return ((const struct graingas *)state)->step;
}

/* Steps are whole: the nearest step to `time` counts. */
static bool graingas_reached(const void *state, double time) {
    const struct graingas *s = state;
    return (double)s->step + 0.5 > time / s->parameters.dt_tau;
}

static double now(void) {
    struct timespec t;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/* Charge the time since *since to a part. */
static void charge(struct graingas *s, enum part part, double *since) {
    double t = now();
    s->seconds[part] += t - *since;
    *since = t;
}

/* Flux during the step that begins at `time`; its middle decides. */
static double flux_at(const struct graingas_parameters *p, double time) {
    double since = time + 0.5 * p->dt_tau - p->flux_on_tau;
    if (since < 0 || time + 0.5 * p->dt_tau > p->flux_off_tau)
        return 0;
    if (p->flux_schedule.count == 0)
        return p->flux_l_per_tau;
    double turn = floor(since / p->flux_schedule_every);
    return turn < (double)p->flux_schedule.count ? p->flux_schedule.value[(size_t)turn] : 0;
}

/* Grains -> lattice -> pressure -> force on grains. */
static enum status move_gas(struct graingas *s, double *clock, struct fault *fault) {
    const struct graingas_parameters *p = &s->parameters;
    gas_take_grains(&s->gas, p, &s->grains);
    charge(s, PART_HALO, clock);
    if (gas_step(&s->gas, p, flux_at(p, graingas_time(s)), fault) != STATUS_OK)
        return fault_within(fault, "step %lld", s->step + 1);
    s->pressure_cycles += s->gas.outcome.iterations;
    charge(s, PART_PRESSURE, clock);
    gas_find_pull(&s->gas, p);
    halo_gather(&s->lattice, &s->grains, s->gas.pull, s->ax, s->ay);
    charge(s, PART_HALO, clock);
    return STATUS_OK;
}

static struct sleep_rule sleep_rule_of(const struct graingas *s, double fall) {
    const struct graingas_parameters *p = &s->parameters;
    long long stride = llround(p->sleep_after / (SLEEP_LOOKS * p->dt_tau));
    stride = stride > 1 ? stride : 1;
    return (struct sleep_rule){.displacement = p->sleep_displacement,
                               .after = p->sleep_after,
                               .fall = fall,
                               .elapsed = s->step % stride ? 0 : (double)stride * p->dt_tau};
}

static enum status move_grains(struct graingas *s, double *clock, struct fault *fault) {
    const struct graingas_parameters *p = &s->parameters;
    double fall = p->gravity / p->froude;
    struct sleep_rule sleep = sleep_rule_of(s, fall);
    if (p->gas == GAS_NONE) {
        memset(s->ax, 0, p->grains * sizeof *s->ax);
        memset(s->ay, 0, p->grains * sizeof *s->ay);
    }
    sleep_hold(&s->sleep, &s->grains, &sleep, s->ax, s->ay);
    push_forced(&s->grains, s->ax, s->ay, fall, p->dt_tau);
    long lost = halo_first_outside(&s->lattice, &s->grains);
    if (lost >= 0)
        return fault_set(fault, STATUS_NUMERICAL,
                         "step %lld: grain %d is at (%g, %g) l, outside the box", s->step + 1,
                         s->grains.id[lost], s->grains.x[lost], s->grains.y[lost]);
    charge(s, PART_PUSH, clock);
    struct contact_rule rule = {.restitution = p->restitution,
                                .threshold = p->approach_threshold * fall * p->dt_tau,
                                .step = s->step + 1};
    if (neighbours_update(&s->contacts.neighbours, &s->grains, fault) != STATUS_OK)
        return fault->status;
    sleep_disturb(&s->sleep, &s->grains, &sleep, &s->contacts.neighbours);
    if (contacts_find(&s->contacts, &s->grains, &rule, fault) != STATUS_OK)
        return fault->status;
    charge(s, PART_SEARCH, clock);
    contacts_resolve(&s->contacts, &s->grains, &rule, fault);
    s->contacts.tally.dissipated += sleep_settle(&s->sleep, &s->grains, &sleep, &s->contacts);
    charge(s, PART_COLLISIONS, clock);
    return fault->status;
}

static enum status graingas_step(void *state, struct fault *fault) {
    struct graingas *s = state;
    double clock = now();
    if (s->parameters.gas != GAS_NONE && move_gas(s, &clock, fault) != STATUS_OK)
        return fault->status;
    bool held = graingas_time(s) + 0.5 * s->parameters.dt_tau < s->parameters.hold_tau;
    if (!held && move_grains(s, &clock, fault) != STATUS_OK)
        return fault->status;
    s->step++;
    return STATUS_OK;
}

static void report_cost(const void *state, struct json *j) {
    const struct graingas *s = state;
    static const char *const name[PART_COUNT] = {"halo_s", "pressure_s", "push_s", "search_s",
                                                 "collisions_s"};
    for (int k = 0; k < PART_COUNT; k++) {
        json_key(j, name[k]);
        json_real(j, s->seconds[k]);
    }
    json_key(j, "steps");
    json_integer(j, s->step);
    json_key(j, "collisions");
    json_integer(j, s->contacts.tally.collisions);
    json_key(j, "sweeps");
    json_integer(j, s->contacts.tally.sweeps);
    json_key(j, "pressure_cycles");
    json_integer(j, s->pressure_cycles);
    json_key(j, "neighbour_rebuilds");
    json_integer(j, s->contacts.neighbours.rebuilds);
    json_key(j, "start_collisions_per_grain");
    json_real(j, s->start_collisions);
}

static const char *notice(const void *state) {
    const struct graingas *s = state;
    return s->notice[0] ? s->notice : NULL;
}

const struct model graingas_model = {
    .name = "graingas",
    .title = "Smooth discs in a Darcy gas, two dimensions",
    .source = "McNamara, Flekkoey & Maaloey, Phys. Rev. E 61, 4054 (2000)",
    .time_unit = "tau",
    .length_unit = "l",
    .parameters = graingas_parameter_table,
    .parameter_count = GRAINGAS_PARAMETER_COUNT,
    .datasets = graingas_datasets,
    .create = graingas_create,
    .step = graingas_step,
    .steps = graingas_steps,
    .time = graingas_time,
    .reached = graingas_reached,
    .observe = graingas_observe,
    .report_cost = report_cost,
    .notice = notice,
    .save = graingas_save,
    .load = graingas_load,
    .free = graingas_free,
};
