/* figure_recipes.h -- every figure recipe there is, for figures.c only. */
#ifndef VALIDATION_FIGURE_RECIPES_H
#define VALIDATION_FIGURE_RECIPES_H

#include "validation/figures.h"

extern const struct figure_recipe figure_settling_curve; /* figure_settling.c */
extern const struct figure_recipe figure_snapshot;       /* figure_snapshot.c */

#endif
