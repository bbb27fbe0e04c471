/* sphere_profile.h -- profiles over height of a run of spheres, and their means in time.
 *
 * /profiles/NAME has one value a slab of height; slabs are alike and fill the box, so the middles
 * of the slabs follow from the box's height.  Means are over frames, of equal weight, or, of what
 * belongs to spheres (a temperature), weighted with the spheres' number less one, the
 * degrees of freedom of a slab's spread about its own mean.
 *
 * Source:     Fiege & Zippelius, Eq. 11, with (V/A) for phibar/N; docs/contract.md.
 * Leaves out: slabs of unequal height.
 * Checked by: tests/unit/test_observe_interface.c.
 */
#ifndef VALIDATION_SPHERE_PROFILE_H
#define VALIDATION_SPHERE_PROFILE_H

#include "validation/observe_spheres.h"

struct sphere_profile {
    const struct series *series; /* borrowed from the run */
    size_t bins;
    double bin_R;
    double spheres;   /* that a slab of packing fraction 1 would hold */
    double *height_R; /* [0 .. bins-1], middles; owned */
};

/* A fault where the series is not [frame][bins] with 2 or more bins. */
enum status sphere_profile_open(struct run_view *v, const char *name,
                                const struct observe_spheres *spheres, struct sphere_profile *out,
                                struct fault *fault);
void sphere_profile_close(struct sphere_profile *p);

/* mean[0 .. bins-1] over frames first .. last. */
void sphere_profile_mean(const struct sphere_profile *p, size_t first, size_t last, double *mean);

/* Mean over frames first .. last and heights low_R .. high_R: of the profile itself, or, with
 * `fraction`, of what it says of spheres, weighted as above.  NAN where nothing weighs. */
double sphere_profile_level(const struct sphere_profile *p, const struct sphere_profile *fraction,
                            size_t first, size_t last, double low_R, double high_R);

#endif
