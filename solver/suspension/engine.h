/* engine.h -- equal hard spheres from event to event: no time step, no overlap.
 *
 * Spheres of one radius and mass in a box whose sides are periodic or hard fly
 * freely between instantaneous events.  Drag is dv/dt = -gamma v with one rate
 * for all, so that in the common clock
 *     s = (1 - exp(-gamma (t - t0)))/gamma,      dx/ds = v exp(gamma (t - t0)) = const
 * every flight is a straight line and the true velocity is the stored one times
 * 1 - gamma s: drag costs nothing and is exact.  The clock is rebased after
 * every few events a sphere (s' = (s - S)/(1 - gamma S), velocities times
 * 1 - gamma S): stored event times stay valid, and no time ever grows large
 * against the time between collisions, so that long runs keep their precision.
 *
 * Collision of a pair: the normal relative velocity is reversed and multiplied
 * by the restitution; hard sides reflect elastically, by sign.  A guard against
 * inelastic collapse makes a collision elastic when one of the two collided
 * less than a contact time ago (real time; Luding & McNamara, Granular Matter 1,
 * 113 (1998)), or when the normal relative speed is below a cut-off.
 *
 * Algorithm.  Space is cut into cells no smaller than a diameter; a sphere's
 * partners are in the 27 cells around it.  Each sphere has its own local time,
 * and one event in the queue: its earliest of pair collision, wall, and passage
 * to the next cell (Lubachevsky, J. Comput. Phys. 94, 255 (1991)).  A pair is
 * entered by the sphere that was predicted last, unless the partner has a pair
 * event before; counters tell at the time of an event whether the partner has
 * since changed (then the sphere is predicted anew: a stale event).  The queue
 * is a calendar of one cache line a bucket with a heap for the present bucket
 * (queue.h).  Spheres are sorted by cell in memory at each rebuild; in a system too
 * large for the cache, memory of coming events and of their partners' surroundings is
 * asked for some buckets before they are due.
 *
 * Cost a collision: two predictions over 27 cells (15 spheres at packing .3,
 * 23 at .45), about one more for stale events, and passages of cells (.5 a
 * collision at .3, .17 at .45) over 9 new cells each; a queue move is O(1).  All
 * is flat in N but for the cache.  ci/bench prints it.
 *
 * Order.  Events come by (time, place of the sphere in memory), a total order
 * that depends on the state alone, not on the queue's layout; of two equal
 * partners the one at the lower place counts.  The same start and calls give
 * the same bits, also when all units are rescaled by powers of two, and also
 * after save and load.  Every call of engine_kick, engine_set_drag and
 * engine_set_growth is part of that history; engine_advance is not: in two
 * steps it gives the same bits as in one when gamma does not change.
 *
 * Units: SI.  No absolute constant but those of the set-up.
 * Leaves out: rotation, friction, unequal spheres, gravity (a drive is made of
 *             kicks by the caller).
 * Checked by: tests/unit/test_engine*.c, suspension/verification-*.
 */
#ifndef SUSPENSION_ENGINE_H
#define SUSPENSION_ENGINE_H

#include "common/h5.h"

enum boundary { BOUNDARY_PERIODIC, BOUNDARY_HARD };
enum guard { GUARD_NONE, GUARD_CONTACT_TIME, GUARD_CUTOFF_SPEED };

struct engine_setup {
    size_t count; /* 0 is allowed */
    double radius_m, mass_kg;
    double box_m[3];           /* inner sides */
    enum boundary boundary[3]; /* a periodic side is longer than 2 diameters, a hard one than 1 */
    double restitution;        /* (0, 1] */
    enum guard guard;
    double contact_time_s, cutoff_speed_m_s; /* of the guard chosen; >= 0 */
};

/* Counts and sums since the last engine_set_state or engine_reset_tally. */
struct engine_tally {
    long long collisions;      /* pairs */
    long long elastic;         /* of them: made elastic by the guard */
    long long wall_collisions; /* with hard sides */
    long long cell_crossings, stale, kicks, rebases, rebuilds;
    double dissipated_J;    /* by inelastic collisions; negative during growth */
    double virial_J;        /* sum over pair collisions of impulse times distance of centres */
    double wall_impulse[6]; /* on the sides -x +x -y +y -z +z, outwards (kg m/s) */
    double wall_virial_J;   /* sum over wall collisions of impulse times (half the side - R) */
};

struct engine; /* opaque */

/* Room for the set-up's spheres.  STATUS_BAD_INPUT names every number that cannot
 * be; STATUS_NO_MEMORY.  On error *out is NULL.  Time 0, drag 0, no spheres placed. */
enum status engine_create(struct engine **out, const struct engine_setup *s, struct fault *fault);
void engine_free(struct engine *e); /* NULL is allowed */

/* position[3*i+axis] (m): centres, in [R, L-R] between hard sides, [0, L) in periodic
 * ones; velocity[3*i+axis] (m/s).  Refuses what is outside, not finite, or overlaps
 * by more than 1e-10 diameters (names the worst pair).  Time and drag become 0, images,
 * tally and memory of collisions are forgotten; a growth in force stays. */
enum status engine_set_state(struct engine *e, const double *position, const double *velocity,
                             struct fault *fault);

/* Drag rate from now on, exactly.  STATUS_BAD_INPUT unless finite and >= 0, and 0
 * while diameters grow. */
enum status engine_set_drag(struct engine *e, double gamma_per_s, struct fault *fault);

/* All events up to time_s (real time), then the clock stands at time_s; a time_s
 * before now changes nothing.  STATUS_NUMERICAL with sphere, time and numbers when
 * something is wrong: events that make no headway (a collapse without guard), NaN. */
enum status engine_advance(struct engine *e, double time_s, struct fault *fault);
double engine_time(const struct engine *e); /* s */

/* Add dv (m/s) to the velocity of sphere i, now.  O(1): one prediction. */
void engine_kick(struct engine *e, size_t i, const double dv[3]);

/* One sphere now: position (m, inside the box), velocity (m/s).  O(1). */
void engine_place(const struct engine *e, size_t i, double position[3], double velocity[3]);

/* All spheres now, in the caller's order: position[3*i+axis] (m, inside the box),
 * velocity[3*i+axis] (m/s), image[3*i+axis]: how often sphere i left the box upwards
 * less downwards along a periodic axis.  Each may be NULL. */
void engine_snapshot(const struct engine *e, double *position, double *velocity, int64_t *image);

const struct engine_tally *engine_tally(const struct engine *e);
void engine_reset_tally(struct engine *e);

/* Growth (Lubachevsky & Stillinger, J. Stat. Phys. 60, 561 (1990)): from now on pairs
 * touch at diameter_m + rate_m_per_s times the time from now; hard sides stay at R.
 * A collision reverses the speed relative to the growing surfaces.  Rate 0 stops.
 * STATUS_BAD_INPUT for a diameter above 2R or below 0, a negative rate, with drag, or
 * when spheres of that diameter overlap by more than 1e-10.  engine_advance stops with
 * STATUS_NUMERICAL rather than pass the diameter 2R of the set-up by more than 1e-10. */
enum status engine_set_growth(struct engine *e, double diameter_m, double rate_m_per_s,
                              struct fault *fault);
double engine_diameter(const struct engine *e); /* of pairs, now (m) */

/* The deepest overlap of any pair or wall now, in diameters (0: none), found from
 * positions by a cell search of its own.  O(N).  -1 when there is no memory for it. */
double engine_deepest_overlap(const struct engine *e);

/* The complete state as datasets group/..., continued to the same bits; the set-up of
 * the engine that loads must be that of the one that saved (checked). */
enum status engine_save(const struct engine *e, struct h5_writer *w, const char *group,
                        struct fault *fault);
enum status engine_load(struct engine *e, struct h5_reader *r, const char *group,
                        struct fault *fault);

size_t engine_bytes(const struct engine *e); /* memory held */

#endif
