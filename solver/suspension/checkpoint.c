/* checkpoint.c -- the complete state in one file; a run that is loaded goes on to
 * the same bits.
 *
 * The engine stores itself; here are the kicks' schedule and random streams, the
 * noise, the histogram of the last look, the energies and the counters.  The state
 * that loads must have been made from the same parameters and seed. */
#include "solver/suspension/suspension.h"

#include <assert.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_NUMBERS = 40, MAX_STREAMS = 3 };

/* Pointers to all numbers of the state, reals and counters apart. */
struct numbers {
    double *real[MAX_NUMBERS];
    long long *counter[MAX_NUMBERS];
    size_t reals, counters;
};

static void list_numbers(struct suspension *s, struct numbers *n) {
    struct noise *z = &s->noise;
    struct energies *e = &s->energies;
    double *real[] = {&s->now,        &s->phibar,   &s->gamma,           &s->look_time,
                      &s->kicks.time, &e->kinetic,  &e->noise,           &e->drive,
                      &e->drag,       &e->time,     &e->dissipated,      &z->drag,
                      &z->packing,    &z->variance, &z->collision_rate,  &z->error,
                      &z->integral,   &s->slice,    &s->start_collisions};
    long long *counter[] = {&s->kicks.done, &s->look, &s->look_collisions, &s->slices, &s->step};
    n->reals = sizeof real / sizeof *real;
    n->counters = sizeof counter / sizeof *counter;
    memcpy(n->real, real, sizeof real);
    memcpy(n->counter, counter, sizeof counter);
}

/* The streams in use; their number. */
static size_t list_streams(const struct suspension *s, gsl_rng **stream) {
    gsl_rng *all[MAX_STREAMS] = {s->noise_rng, s->kicks.times, s->kicks.whom};
    size_t count = 0;
    for (size_t k = 0; k < MAX_STREAMS; k++)
        if (all[k])
            stream[count++] = all[k];
    return count;
}

static enum status save_reals(struct h5_writer *w, const struct suspension *s,
                              const struct numbers *n, struct fault *fault) {
    double real[MAX_NUMBERS];
    size_t edges = s->layers.bins + 1;
    for (size_t k = 0; k < n->reals; k++)
        real[k] = *n->real[k];
    if (h5_write(w, "state/reals", H5_REAL, 1, &n->reals, real, "1", fault) ||
        h5_write(w, "state/below", H5_REAL, 1, &edges, s->layers.below, "1", fault))
        return fault->status;
    return STATUS_OK;
}

static enum status save_counters(struct h5_writer *w, const struct suspension *s,
                                 const struct numbers *n, struct fault *fault) {
    int64_t counter[MAX_NUMBERS];
    size_t count = n->counters + 2;
    for (size_t k = 0; k < n->counters; k++)
        counter[k] = *n->counter[k];
    counter[n->counters] = (int64_t)s->changes;
    counter[n->counters + 1] = s->noise.frozen;
    return h5_write(w, "state/counters", H5_INTEGER, 1, &count, counter, "1", fault);
}

static enum status save_streams(struct h5_writer *w, const struct suspension *s,
                                struct fault *fault) {
    gsl_rng *stream[MAX_STREAMS];
    size_t count = list_streams(s, stream), bytes = gsl_rng_size(s->noise_rng);
    int64_t *byte = malloc((count * bytes + 1) * sizeof *byte);
    if (!byte)
        return fault_set(fault, STATUS_NO_MEMORY, "no memory for a checkpoint");
    for (size_t k = 0; k < count; k++)
        for (size_t b = 0; b < bytes; b++)
            byte[k * bytes + b] = ((const unsigned char *)gsl_rng_state(stream[k]))[b];
    size_t all = count * bytes;
    h5_write(w, "state/streams", H5_INTEGER, 1, &all, byte, "1", fault);
    free(byte);
    return fault->status;
}

enum status suspension_save(const void *state, const char *path, struct fault *fault) {
    struct suspension *s = (struct suspension *)state; /* only read */
    struct numbers n;
    struct h5_writer *w = NULL;
    list_numbers(s, &n);
    if (h5_create(path, &w, fault) != STATUS_OK)
        return fault->status;
    if (save_reals(w, s, &n, fault) || save_counters(w, s, &n, fault) ||
        save_streams(w, s, fault) || engine_save(s->engine, w, "engine", fault)) {
        h5_discard(w);
        return fault->status;
    }
    return h5_commit(w, fault);
}

static enum status load_reals(struct h5_reader *r, struct suspension *s, const struct numbers *n,
                              struct fault *fault) {
    double real[MAX_NUMBERS];
    if (h5_read_exactly(r, "state/reals", n->reals, real, fault) == STATUS_OK &&
        h5_read_exactly(r, "state/below", s->layers.bins + 1, s->layers.below, fault) == STATUS_OK)
        for (size_t k = 0; k < n->reals; k++)
            *n->real[k] = real[k];
    return fault->status;
}

static enum status load_counters(struct h5_reader *r, struct suspension *s, const struct numbers *n,
                                 struct fault *fault) {
    double counter[MAX_NUMBERS + 2];
    if (h5_read_exactly(r, "state/counters", n->counters + 2, counter, fault) != STATUS_OK)
        return fault->status;
    for (size_t k = 0; k < n->counters; k++)
        *n->counter[k] = (long long)counter[k];
    s->changes = (size_t)counter[n->counters];
    s->noise.frozen = counter[n->counters + 1] != 0;
    if (s->changes > s->parameters.phibar_times.count)
        fault_set(fault, STATUS_BAD_INPUT, "%s: %zu changes of phibar; this run has %zu",
                  h5_path(r), s->changes, s->parameters.phibar_times.count);
    return fault->status;
}

static enum status load_streams(struct h5_reader *r, struct suspension *s, struct fault *fault) {
    gsl_rng *stream[MAX_STREAMS];
    size_t count = list_streams(s, stream), bytes = gsl_rng_size(s->noise_rng);
    double *byte = malloc((count * bytes + 1) * sizeof *byte);
    if (!byte)
        return fault_set(fault, STATUS_NO_MEMORY, "no memory for a checkpoint");
    if (h5_read_exactly(r, "state/streams", count * bytes, byte, fault) == STATUS_OK)
        for (size_t k = 0; k < count; k++)
            for (size_t b = 0; b < bytes; b++)
                ((unsigned char *)gsl_rng_state(stream[k]))[b] = (unsigned char)byte[k * bytes + b];
    free(byte);
    return fault->status;
}

enum status suspension_load(void *state, const char *path, struct fault *fault) {
    struct suspension *s = state;
    struct numbers n;
    struct h5_reader *r = NULL;
    list_numbers(s, &n);
    if (h5_open(path, &r, fault) != STATUS_OK)
        return fault->status;
    if (load_reals(r, s, &n, fault) == STATUS_OK && load_counters(r, s, &n, fault) == STATUS_OK &&
        load_streams(r, s, fault) == STATUS_OK &&
        engine_load(s->engine, r, "engine", fault) == STATUS_OK)
        s->drive = drive_at(&s->parameters, s->phibar);
    h5_close(r);
    return fault->status;
}
