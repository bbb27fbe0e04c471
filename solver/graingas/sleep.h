/* sleep.h -- grains that lie still under load become part of the ground.
 *
 * By the time-of-contact rule a quiet bed hands its weight down in quanta of a
 * few g dt, some hundred thousand collisions a step in which nothing moves.  So a
 * grain that has stayed within `displacement` of one place for `after` and that
 * its weight, less the gas's lift, presses down by more than a tenth of g, is put to
 * sleep: its velocity is zero and its mass infinite, and pairs of sleepers make no
 * contacts.  What it would hand down is taken by the ground.  It wakes, at zero
 * velocity, when
 *   - a grain hits it faster than gravity would move a grain in a tenth of `after`,
 *   - a grain next to it moves away from its place, by `displacement`,
 *   - the force on it, gas and hits from waking grains, no longer presses it down
 *     (less than g/20, averaged over a tenth of `after`).
 * So beds at or above minimum fluidization, where the gas carries the weight, never
 * sleep, and a change of the flux that matters wakes what it lifts.
 *
 * A grain that is squeezed for good between sleepers gets them back their masses
 * (contacts.c), which counts as waking.
 *
 * Leaves out: rearrangements slower than displacement/after; the load of the bed above
 * on a sleeper.  docs/theory.md, section 4, has what it changes in the physics.
 * Checked by: graingas/packed-bed, tests/unit/test_sleep.c.
 */
#ifndef GRAINGAS_SLEEP_H
#define GRAINGAS_SLEEP_H

#include "solver/graingas/contacts.h"

struct sleep_rule {
    double displacement; /* (l); 0: nothing sleeps */
    double after;        /* (tau) */
    double fall;         /* gravity (l/tau^2) */
    double elapsed;      /* since the last look (tau); 0: not in this step */
};

/* Places, loads and who is quiet are looked at so often in the time `after`. */
enum { SLEEP_LOOKS = 20 };

struct sleep {
    size_t count;    /* grains */
    double *anchor;  /* place last left, anchor[2 id], anchor[2 id + 1] (l) */
    double *load;    /* running mean of the net acceleration upwards, [id] (l/tau^2) */
    double *quiet;   /* time since the anchor was set, [id] (tau) */
    double *hits;    /* impulse upwards on a sleeper since the last look, [id] (l^2 U0) */
    bool *asleep;    /* [id] */
    size_t sleeping; /* how many */
};

/* Room for the grains of g, all awake. */
enum status sleep_create(struct sleep *s, const struct grains *g, struct fault *fault);
void sleep_free(struct sleep *s);

/* Before the push: mean loads from the gas's accelerations ax, ay[0 .. count-1]; wakes what is no
 * longer pressed down; gives the others accelerations at which they stay in place. */
void sleep_hold(struct sleep *s, struct grains *g, const struct sleep_rule *rule, double *ax,
                double *ay);

/* After the push: wakes sleepers that are hit hard or whose neighbours have moved.  n is current.
 */
void sleep_disturb(struct sleep *s, struct grains *g, const struct sleep_rule *rule,
                   const struct neighbours *n);

/* After the collisions: notes hits on sleepers and puts to sleep what has been quiet long enough.
 * Returns the kinetic energy that this takes away (l^2 U0^2). */
double sleep_settle(struct sleep *s, struct grains *g, const struct sleep_rule *rule,
                    const struct contacts *c);

/* After loading `asleep`: counts the sleepers and makes them immovable again. */
void sleep_restore(struct sleep *s, struct grains *g);

#endif
