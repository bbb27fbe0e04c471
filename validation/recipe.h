/* recipe.h -- observables: a named recipe turns one run into numbers and curves.
 *
 * A recipe is one constant struct in one file observe_TOPIC.c and one line in
 * recipes.c.  It says which datasets it needs (the union over a case's
 * observables is what a solver is asked to write), which settings it takes,
 * and which numbers it gives.  An observable of a case is a recipe with its
 * settings under a name of its own; `settling.speed` is the output `speed` of
 * the observable `settling`.
 *
 * Recipes never call solver code: closures stand in closures.h, written
 * independently (style.md, house rule 10).
 */
#ifndef VALIDATION_RECIPE_H
#define VALIDATION_RECIPE_H

#include "validation/run_view.h"

enum { RECIPE_MAX_OUTPUTS = 24, RECIPE_MAX_SETTINGS = 8, RECIPE_MAX_CURVES = 8 };

struct recipe_output {
    const char *name, *unit, *doc;
};

struct recipe_setting {
    const char *name, *unit, *doc;
    double standard, min, max;
};

/* A curve is for figures: x[0 .. count-1], y[0 .. count-1], owned by the measurement. */
struct curve {
    const char *name; /* static text: "profile at 30 tau" is built in label */
    char label[64];
    size_t count;
    double *x, *y;
};

struct measurement {
    double value[RECIPE_MAX_OUTPUTS]; /* in the order of outputs; NaN: see reason */
    char reason[160];                 /* why a value is NaN; empty otherwise */
    struct curve curve[RECIPE_MAX_CURVES];
    size_t curve_count;
};

struct recipe {
    const char *name, *title;
    const char *source;                                 /* paper and equation */
    const char *const *datasets;                        /* NULL-terminated */
    struct recipe_setting setting[RECIPE_MAX_SETTINGS]; /* ends at name == NULL */
    struct recipe_output output[RECIPE_MAX_OUTPUTS];    /* ends at name == NULL */
    const char *const *curves; /* names of curves it gives; NULL-terminated, may be NULL */
    /* settings[0 .. n-1] in the order of `setting`.  *out is zeroed by the caller.
     * A fault (missing frame, NaN in the data) makes the run unusable; a value
     * that cannot be had from good data (too few rows) is NaN with a reason. */
    enum status (*measure)(struct run_view *v, const double *settings, struct measurement *out,
                           struct fault *fault);
};

const struct recipe *recipe_find(const char *name);
const struct recipe *const *recipe_all(size_t *count);
void measurement_free(struct measurement *m);
/* Append a curve: copies x and y[0 .. count-1]. */
enum status measurement_add_curve(struct measurement *m, const char *name, const char *label,
                                  const double *x, const double *y, size_t count,
                                  struct fault *fault);

#endif
