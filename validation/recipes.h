/* recipes.h -- every recipe there is, for recipes.c only. */
#ifndef VALIDATION_RECIPES_H
#define VALIDATION_RECIPES_H

#include "validation/recipe.h"

extern const struct recipe recipe_settling;            /* observe_settling.c */
extern const struct recipe recipe_front;               /* observe_front.c */
extern const struct recipe recipe_fluctuations;        /* observe_fluctuations.c */
extern const struct recipe recipe_contacts;            /* observe_contacts.c */
extern const struct recipe recipe_mode_decay;          /* observe_mode.c */
extern const struct recipe recipe_column;              /* observe_column.c */
extern const struct recipe recipe_gas_invariant;       /* observe_invariant.c */
extern const struct recipe recipe_halo;                /* observe_halo.c */
extern const struct recipe recipe_halo_shape;          /* observe_halo_shape.c */
extern const struct recipe recipe_uniform_fraction;    /* observe_halo.c */
extern const struct recipe recipe_gas_work;            /* observe_work.c */
extern const struct recipe recipe_acceleration;        /* observe_flight.c */
extern const struct recipe recipe_free_fall;           /* observe_flight.c */
extern const struct recipe recipe_energy;              /* observe_energy.c */
extern const struct recipe recipe_mirror;              /* observe_mirror.c */
extern const struct recipe recipe_pair;                /* observe_collision.c */
extern const struct recipe recipe_corner_hits;         /* observe_collision.c */
extern const struct recipe recipe_disc_pressure;       /* observe_discs.c */
extern const struct recipe recipe_packed_bed;          /* observe_packed.c */
extern const struct recipe recipe_bed_motion;          /* observe_bed.c */
extern const struct recipe recipe_pressure_drop;       /* observe_drop.c */
extern const struct recipe recipe_bubbles;             /* observe_bubbles.c */
extern const struct recipe recipe_sphere_collisions;   /* observe_spheres_gas.c */
extern const struct recipe recipe_sphere_virial;       /* observe_spheres_gas.c */
extern const struct recipe recipe_sphere_walls;        /* observe_spheres_gas.c */
extern const struct recipe recipe_sphere_velocities;   /* observe_spheres_velocity.c */
extern const struct recipe recipe_sphere_conservation; /* observe_spheres_velocity.c */
extern const struct recipe recipe_sphere_diffusion;    /* observe_spheres_motion.c */
extern const struct recipe recipe_sphere_displacement; /* observe_spheres_motion.c */
extern const struct recipe recipe_sphere_decay;        /* observe_spheres_single.c */
extern const struct recipe recipe_sphere_pair;         /* observe_spheres_single.c */
extern const struct recipe recipe_sphere_cooling;      /* observe_spheres_power.c */
extern const struct recipe recipe_sphere_power;        /* observe_spheres_power.c */
extern const struct recipe recipe_sphere_wave;         /* observe_spheres_wave.c */
extern const struct recipe recipe_sphere_slab;         /* observe_spheres_wave.c */
extern const struct recipe recipe_sphere_overlap;      /* observe_spheres_places.c */
extern const struct recipe recipe_sphere_order;        /* observe_spheres_places.c */
extern const struct recipe recipe_sphere_mirror;       /* observe_spheres_places.c */
extern const struct recipe recipe_sphere_fingerprint;  /* observe_spheres_places.c */
extern const struct recipe recipe_bed_stripes;         /* observe_bed_stripes.c */
extern const struct recipe recipe_bed_interface;       /* observe_interface.c */
extern const struct recipe recipe_bed_formation;       /* observe_interface.c */
extern const struct recipe recipe_bed_temperature;     /* observe_rest.c */
extern const struct recipe recipe_bed_velocities;      /* observe_rest.c */
extern const struct recipe recipe_bed_diffusion;       /* observe_rest.c */
extern const struct recipe recipe_bed_step;            /* observe_bed_step.c */
extern const struct recipe recipe_bed_wave;            /* observe_bed_wave.c */
extern const struct recipe recipe_bed_relaxation;      /* observe_bed_relaxation.c */

#endif
