/* bench.h -- what the benchmarks share: the clock, and what ends them. */
#ifndef BENCH_H
#define BENCH_H

#include "common/fault.h"

#include <stdio.h>
#include <stdlib.h>
#include <time.h>

static inline double cpu_seconds(void) {
    struct timespec t;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static inline void stop_on(const struct fault *fault) {
    if (fault->status == STATUS_OK)
        return;
    fprintf(stderr, "bench: %s\n", fault->text);
    exit(fault_exit_code(fault->status));
}

#endif
