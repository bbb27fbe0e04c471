/* contacts.h -- collisions of overlapping discs: the time-of-contact rule.
 *
 * After a step every overlapping pair (wall contacts included) that approaches
 * is made to collide, again and again, until no pair approaches any more (MFM,
 * Section II B).  A collision reverses the normal approach speed, times the
 * restitution r, unless one of the two has collided in this or the preceding
 * step: then it conserves energy.  Approach speeds up to a threshold (by
 * default g dt/Fr, what gravity adds in one step) count as rest: in a quiet bed
 * every grain touches three or four others, so all collisions would be elastic
 * and would never end.  Two amendments keep contacts from creeping together:
 * the threshold fades with overlap and is gone at CONTACTS_REST_OVERLAP, and
 * walls know no threshold, the floor sending a grain back at half of what
 * gravity adds in a step at the least (docs/theory.md, section 4).
 *
 * The list is swept up and down in turn.  A pair is looked at again only when
 * one of its grains has changed its velocity since: a pair that did not
 * approach then cannot do so now, so this skips work and changes no bit of what
 * plain sweeps over the whole list would give.
 *
 * Leaves out: friction and rotation.  No cap on sweeps: more than 100 000 in
 * one step stop the run.
 * Checked by: graingas/verification-collision, graingas/verification-energy,
 *             graingas/verification-hard-discs.
 */
#ifndef GRAINGAS_CONTACTS_H
#define GRAINGAS_CONTACTS_H

#include "solver/graingas/neighbours.h"

enum { WALL_LEFT, WALL_RIGHT, WALL_BOTTOM, WALL_TOP, WALL_COUNT };
enum { CONTACTS_MAX_SWEEPS = 100000, CONTACTS_PATIENCE = 1000 };
#define CONTACTS_REST_OVERLAP 0.04 /* of the largest diameter */

struct contact {          /* one cache line */
    int32_t i, j;         /* grains; j == grain count: a wall */
    double nx, ny;        /* unit normal, from j to i */
    double rest, support; /* approach that needs no collision; least speed of leaving (U0) */
    double reduced_mass;  /* of the two (l^2) */
    double impulse;       /* exchanged in this step (l^2 U0) */
    int32_t wall, held;   /* which, or -1; one of the two is held in place (sleep.h) */
};

/* What a collision reads and writes of a grain, side by side. */
struct body {
    double vx, vy, inverse_mass;
    int64_t last_hit;
};

/* Sums since the start of the run. */
struct contact_tally {
    long long collisions, elastic, sweeps;
    double dissipated;               /* energy (l^2 U0^2) */
    double virial;                   /* sum of impulse times distance over pairs (l^3 U0) */
    double wall_impulse[WALL_COUNT]; /* normal impulse taken by each wall (l^2 U0) */
    double wall_virial[WALL_COUNT];  /* impulse times distance from the wall (l^3 U0) */
    double largest_overlap;          /* of the last step (l) */
    int last_sweeps, most_sweeps;    /* of the last step, of any step */
};

struct contacts {
    struct neighbours neighbours;
    struct contact *contact; /* contact[0 .. count-1] of this step */
    size_t count, capacity;
    uint64_t *todo;    /* one bit a contact */
    struct body *body; /* body[0 .. grains]: while contacts are resolved */
    /* Contacts of grain n: own[n] .. own[n+1]-1, in which it is i, and
     * other[other_first[n] .. other_first[n+1]-1], in which it is j. */
    int32_t *own, *other_first, *other;
    double deepest;       /* overlap of any pair or wall in this step (l) */
    double rest_overlap;  /* overlap at which no approach counts as rest (l) */
    double *virial_field; /* virial by nearest lattice site of the pair's middle;
                           * [0 .. sites-1], row by row from the floor (l^3 U0) */
    int sites_x;          /* sites a row */
    struct contact_tally tally;
};

struct contact_rule {
    double restitution;
    double threshold; /* approach speed that counts as rest (U0) */
    long long step;   /* number of this step, for the rule's memory */
};

enum status contacts_create(struct contacts *c, size_t grains, double width, double height,
                            double diameter_max, struct fault *fault);
void contacts_free(struct contacts *c);

/* List all contacts at the present positions.  Grains may be reordered. */
enum status contacts_find(struct contacts *c, struct grains *g, const struct contact_rule *rule,
                          struct fault *fault);

/* Collide what contacts_find listed until nothing approaches.  STATUS_NUMERICAL
 * after CONTACTS_MAX_SWEEPS names the worst pairs. */
enum status contacts_resolve(struct contacts *c, struct grains *g, const struct contact_rule *rule,
                             struct fault *fault);

#endif
