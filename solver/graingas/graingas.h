/* graingas.h -- grains in a Darcy gas: the state of one run, shared by the
 * modules that step it (graingas.c), write it (observe.c) and store it
 * (checkpoint.c).
 *
 * A step reads like the paper: grains -> lattice, pressure, force -> grains,
 * free flight, collisions.
 *
 * Source: McNamara, Flekkoey & Maaloey, PRE 61, 4054 (2000).
 */
#ifndef GRAINGAS_GRAINGAS_H
#define GRAINGAS_GRAINGAS_H

#include "solver/graingas/contacts.h"
#include "solver/graingas/gas.h"
#include "solver/graingas/sleep.h"

enum part { PART_HALO, PART_PRESSURE, PART_PUSH, PART_SEARCH, PART_COLLISIONS, PART_COUNT };

struct graingas {
    struct graingas_parameters parameters;
    struct lattice lattice;
    struct grains grains;
    struct gas gas;
    struct contacts contacts;
    struct sleep sleep;
    double *flux_schedule; /* the parameters' list, kept for the run (l/tau) */
    double *ax, *ay;       /* from the gas, [0 .. grains-1] (U0/tau) */
    long long step;
    double start_collisions;    /* of the equilibration, per grain */
    long long pressure_cycles;  /* since the start */
    double seconds[PART_COUNT]; /* CPU time by part */
    double *scratch;            /* room for 4 values a grain, for observe */
    char notice[160];
};

extern const struct model graingas_model;
extern const struct dataset graingas_datasets[];

/* observe.c: append the present value of one dataset. */
enum status graingas_observe(void *state, const char *dataset, struct h5_writer *w,
                             struct fault *fault);

/* checkpoint.c: the complete state; loading continues to the same bits. */
enum status graingas_save(const void *state, const char *path, struct fault *fault);
enum status graingas_load(void *state, const char *path, struct fault *fault);

double graingas_time(const void *state); /* (tau) */

#endif
