/* graingas_fixture.h -- a grain-gas state from a few lines of YAML. */
#ifndef GRAINGAS_FIXTURE_H
#define GRAINGAS_FIXTURE_H

#include "solver/graingas/graingas.h"
#include "tests/unit/unit.h"

static inline struct graingas *fixture_state(const char *yaml, uint64_t seed) {
    struct fault fault = FAULT_NONE;
    struct yaml_document *document;
    struct parameter_set set;
    void *state = NULL;
    unit_ok(yaml_parse("fixture", yaml, strlen(yaml), &document, &fault), &fault);
    unit_ok(parameters_read(&graingas_model, yaml_root(document), NULL, 0, &set, &fault), &fault);
    unit_ok(graingas_model.create(&state, &set, NULL, seed, &fault), &fault);
    parameters_free(&set);
    yaml_free(document);
    return state;
}

/* The faults of parameters that must be refused. */
static inline struct fault fixture_refused(const char *yaml) {
    struct fault fault = FAULT_NONE;
    struct yaml_document *document;
    struct parameter_set set;
    void *state = NULL;
    unit_ok(yaml_parse("fixture", yaml, strlen(yaml), &document, &fault), &fault);
    unit_ok(parameters_read(&graingas_model, yaml_root(document), NULL, 0, &set, &fault), &fault);
    ck_assert_int_ne(graingas_model.create(&state, &set, NULL, 1, &fault), STATUS_OK);
    ck_assert_ptr_null(state);
    parameters_free(&set);
    yaml_free(document);
    return fault;
}

static inline void fixture_steps(struct graingas *s, int steps) {
    struct fault fault = FAULT_NONE;
    for (int n = 0; n < steps; n++)
        unit_ok(graingas_model.step(s, &fault), &fault);
}

#endif
