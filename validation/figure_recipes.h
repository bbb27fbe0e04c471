/* figure_recipes.h -- every figure recipe there is, for figures.c only. */
#ifndef VALIDATION_FIGURE_RECIPES_H
#define VALIDATION_FIGURE_RECIPES_H

#include "validation/figures.h"

extern const struct figure_recipe figure_settling_curve;     /* figure_settling.c */
extern const struct figure_recipe figure_snapshot;           /* figure_snapshot.c */
extern const struct figure_recipe figure_sequence_panels;    /* figure_sequence.c */
extern const struct figure_recipe figure_sequence_animation; /* figure_sequence.c */
extern const struct figure_recipe figure_curves;             /* figure_curves.c */
extern const struct figure_recipe figure_fluidization_curve; /* figure_fluidization.c */
extern const struct figure_recipe figure_bubble_rise;        /* figure_bubbles.c */
extern const struct figure_recipe figure_outputs;            /* figure_outputs.c */
extern const struct figure_recipe figure_profiles;           /* figure_profiles.c */
extern const struct figure_recipe figure_trend_interface;    /* figure_trend.c */
extern const struct figure_recipe figure_trend_relaxation;   /* figure_trend.c */
extern const struct figure_recipe figure_sphere_sequence;    /* figure_spheres.c */
extern const struct figure_recipe figure_sphere_animation;   /* figure_spheres.c */

#endif
