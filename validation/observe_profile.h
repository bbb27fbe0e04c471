/* observe_profile.h -- density and speed over height, and the plateau that settles.
 *
 * Rows of equal height, each grain counted in the row of its centre: solid
 * fraction of the row, and area-weighted mean speed of its grains.  The
 * plateau is found as in MFM, Section III: rows slower than half the maximum
 * are settled, rows below two thirds of the remaining maximum of density are
 * clear fluid.  A few stray grains can spoil both maxima, so rows far below the
 * mean density of the box are dropped first.
 *
 * Source:     MFM, Section III.
 * Leaves out: grains that straddle two rows.
 * Checked by: tests/unit/test_observe_settling.c.
 */
#ifndef VALIDATION_OBSERVE_PROFILE_H
#define VALIDATION_OBSERVE_PROFILE_H

#include "validation/observe.h"

struct profile {
    size_t rows;
    double row_l;           /* height of a row (l) */
    double mean_fraction;   /* all grains in the box (1) */
    double *height;         /* of each row's middle (l) */
    double *solid_fraction; /* (1) */
    double *speed;          /* area-weighted mean, positive downwards (U0); 0 in empty rows */
};

struct plateau {
    size_t rows;            /* how many rows belong to it; 0: none */
    size_t lowest, highest; /* first and last of them */
    double solid_fraction;  /* mean over its rows (1) */
    double speed;           /* the same, positive downwards (U0) */
};

/* Which rows count: see above. */
struct plateau_rule {
    double sparse; /* rows below this share of the mean density are dropped */
    double slow;   /* rows below this share of the largest speed: settled */
    double thin;   /* rows below this share of the largest density left: clear */
};
extern const struct plateau_rule PLATEAU_RULE; /* 1/2, 1/2, 2/3 */

enum status profile_create(struct profile *p, const struct observe_box *box, double row_l,
                           struct fault *fault);
void profile_free(struct profile *p);
/* Overwrites.  A grain outside the box is a fault.  g->velocity may be NULL: speed 0. */
enum status profile_measure(struct profile *p, struct run_view *v, const struct observe_box *box,
                            const struct observe_grains *g, double area_to_volume, size_t frame,
                            struct fault *fault);
struct plateau profile_plateau(const struct profile *p, const struct plateau_rule *rule);

#endif
