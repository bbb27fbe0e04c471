#include "solver/suspension/kicks.h"

#include <gsl/gsl_randist.h>

/* Time of kick number `done` of a regular schedule. */
static double regular_time(const struct kicks *k) {
    long long n = k->schedule == KICKS_SYNCHRONOUS ? k->done / (long long)k->count : k->done;
    return ((double)n + 0.5) * k->interval;
}

enum status kicks_create(struct kicks *k, enum kick_schedule schedule, size_t count, double rate,
                         uint64_t seed, struct fault *fault) {
    double together = schedule == KICKS_SYNCHRONOUS ? 1 : (double)count;
    *k = (struct kicks){.schedule = schedule, .count = count, .interval = 1 / (rate * together)};
    if (schedule != KICKS_POISSON) {
        k->time = regular_time(k);
        return STATUS_OK;
    }
    if (random_stream(seed, "suspension kick times", &k->times, fault) != STATUS_OK ||
        random_stream(seed, "suspension kicked spheres", &k->whom, fault) != STATUS_OK)
        return fault->status;
    k->time = gsl_ran_exponential(k->times, k->interval);
    return STATUS_OK;
}

void kicks_free(struct kicks *k) {
    gsl_rng_free(k->times);
    gsl_rng_free(k->whom);
    *k = (struct kicks){0};
}

size_t kicks_take(struct kicks *k) {
    long long number = k->done++;
    if (k->schedule != KICKS_POISSON) {
        k->time = regular_time(k);
        return (size_t)(number % (long long)k->count);
    }
    k->time += gsl_ran_exponential(k->times, k->interval);
    return gsl_rng_uniform_int(k->whom, k->count);
}
