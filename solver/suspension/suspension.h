/* suspension.h -- driven hard spheres in a fluid: the state of one run, shared by
 * the modules that step it (suspension.c), write it (observe.c) and store it
 * (checkpoint.c).
 *
 * The engine carries spheres from event to event under the common drag
 * gamma(phibar); this module says when the next sphere is kicked (kicks.h), by how
 * much (drive.h for the fluid's force, noise.h for the random part), when the layers'
 * packing fractions are counted anew (a "look"), and when phibar changes.  A step
 * is a slice of time, 1/f_dr or a sphere's radius at thermal speed, cut short at
 * the next sample, so that samples hold the state at exactly their times.  What
 * falls on the same instant comes in the order change, look, kick, sample.  The
 * bits of a run do not depend on its samples.
 *
 * Energies: kinetic = that at the start + noise + drive - drag - dissipated.  All
 * five are found apart.  The drag's share follows from the kinetic energy E, which
 * between two kicks decays as exp(-2 gamma t) and loses what the engine's collisions
 * dissipate, taken as half at the beginning and half at the end.
 *
 * Source:     Fiege & Zippelius, "Dynamics of driven granular suspensions" (2014).
 * Leaves out: what docs/theory.md, "Suspension", lists.
 * Checked by: tests/unit/test_suspension*.c, suspension/verification-*.
 */
#ifndef SUSPENSION_SUSPENSION_H
#define SUSPENSION_SUSPENSION_H

#include "solver/suspension/drive.h"
#include "solver/suspension/engine.h"
#include "solver/suspension/kicks.h"
#include "solver/suspension/layers.h"
#include "solver/suspension/noise.h"
#include "solver/suspension/parameters.h"
#include "solver/suspension/profiles.h"

struct energies { /* J */
    double kinetic, noise, drive, drag;
    double time, dissipated; /* when that was (s), and what collisions had taken by then */
};

struct suspension {
    struct suspension_parameters parameters; /* the schedule is a copy; other lists are gone */
    struct engine *engine;
    struct kicks kicks;
    struct drive drive;
    struct noise noise;
    struct layers layers;
    struct profiles profiles;
    gsl_rng *noise_rng;
    struct energies energies;
    double now, aim;      /* time reached, next sample (s) */
    double phibar, gamma; /* in force: (1), (1/s) */
    size_t changes;       /* of phibar so far */
    bool looks;           /* are there any? */
    long long look;       /* number of looks so far; the next is at look * look_every */
    double look_time;     /* of the last (s) */
    long long look_collisions;
    double slice; /* longest step (s) */
    long long slices, step;
    double *position, *velocity; /* scratch [3 particles] (m, m/s) */
    bool described;              /* the derived groups are written */
    double start_collisions;     /* of the growth, per sphere */
    double start_seconds, step_seconds, look_seconds, observe_seconds; /* CPU time */
    char notice[320];
};

extern const struct model suspension_model;
extern const struct dataset suspension_datasets[];

/* observe.c: append the present value of one dataset. */
enum status suspension_observe(void *state, const char *dataset, struct h5_writer *w,
                               struct fault *fault);

/* checkpoint.c: the complete state; loading continues to the same bits. */
enum status suspension_save(const void *state, const char *path, struct fault *fault);
enum status suspension_load(void *state, const char *path, struct fault *fault);

/* The energies as of now; the state is left as it is. */
struct energies suspension_energies(const struct suspension *s);

/* CPU time of the process (s). */
double suspension_clock(void);

#endif
