/* suspension_fixture.h -- a suspension's state from a few lines of YAML. */
#ifndef SUSPENSION_FIXTURE_H
#define SUSPENSION_FIXTURE_H

#include "solver/suspension/suspension.h"
#include "tests/unit/unit.h"

/* Make a state; the fault, and NULL in *out when it is refused. */
static inline struct fault fixture_make(struct suspension **out, const char *yaml, uint64_t seed,
                                        struct h5_reader *start) {
    struct fault fault = FAULT_NONE;
    struct yaml_document *document;
    struct parameter_set set;
    void *state = NULL;
    unit_ok(yaml_parse("fixture", yaml, strlen(yaml), &document, &fault), &fault);
    if (parameters_read(&suspension_model, yaml_root(document), NULL, 0, &set, &fault) ==
        STATUS_OK) {
        suspension_model.create(&state, &set, start, seed, &fault);
        parameters_free(&set);
    }
    yaml_free(document);
    ck_assert_int_eq(state == NULL, fault.status != STATUS_OK);
    *out = state;
    return fault;
}

static inline struct suspension *fixture_state(const char *yaml, uint64_t seed) {
    struct suspension *s;
    struct fault fault = fixture_make(&s, yaml, seed, NULL);
    unit_ok(fault.status, &fault);
    return s;
}

/* Parameters that must be refused, in these words. */
static inline void fixture_refused(const char *yaml, const char *words) {
    struct suspension *s;
    struct fault fault = fixture_make(&s, yaml, 1, NULL);
    ck_assert_msg(s == NULL, "accepted: %s", yaml);
    unit_says(&fault, words);
}

static inline void fixture_run(struct suspension *s, double time) {
    struct fault fault = FAULT_NONE;
    suspension_model.aim(s, time);
    while (!suspension_model.reached(s, time))
        unit_ok(suspension_model.step(s, &fault), &fault);
    ck_assert_double_eq(s->now, time);
}

/* Present positions and velocities in the state's scratch. */
static inline void fixture_look(struct suspension *s) {
    engine_snapshot(s->engine, s->position, s->velocity, NULL);
}

/* m <v^2>/3 (J). */
static inline double fixture_temperature(struct suspension *s) {
    double sum = 0;
    fixture_look(s);
    for (size_t k = 0; k < 3 * s->parameters.particles; k++)
        sum += s->velocity[k] * s->velocity[k];
    return s->parameters.mass * sum / (3 * (double)s->parameters.particles);
}

#endif
