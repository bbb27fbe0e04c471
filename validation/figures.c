#include "validation/figures.h"

#include "validation/figure_recipes.h"

#include <math.h>
#include <string.h>

/* One line a figure recipe. */
static const struct figure_recipe *const recipes[] = {
    &figure_settling_curve,   &figure_snapshot,
    &figure_sequence_panels,  &figure_sequence_animation,
    &figure_curves,           &figure_fluidization_curve,
    &figure_bubble_rise,      &figure_outputs,
    &figure_profiles,         &figure_sphere_sequence,
    &figure_sphere_animation, &figure_trend_interface,
    &figure_trend_relaxation, NULL, /* ends the list */
};

const struct figure_recipe *const *figure_all(size_t *count) {
    *count = sizeof recipes / sizeof *recipes - 1;
    return recipes;
}

const struct figure_recipe *figure_find(const char *name) {
    for (size_t i = 0; recipes[i] != NULL; i++) {
        if (strcmp(recipes[i]->name, name) == 0)
            return recipes[i];
    }
    return NULL;
}

enum status figure_select(const struct measured_case *data, const struct case_figure *wanted,
                          struct arena *arena, struct measured_case *out, struct fault *fault) {
    struct measured_point *point = arena_take(arena, data->point_count, sizeof *point);
    if (point == NULL)
        return fault_set(fault, STATUS_NO_MEMORY, "figure: out of memory");
    *out = *data;
    out->arena = (struct arena){NULL}; /* the points' contents stay with data */
    out->point = point;
    out->point_count = 0;
    for (size_t i = 0; i < data->point_count; i++) {
        const struct plan_point *p = data->point[i].point;
        if (case_filter_takes(&wanted->points, p->parameter, p->parameter_count))
            point[out->point_count++] = data->point[i];
    }
    return STATUS_OK;
}

const struct curve *figure_curve_find(const struct measurement *m, const char *name, size_t nth) {
    for (size_t i = 0; i < m->curve_count; i++)
        if (strcmp(m->curve[i].name, name) == 0 && nth-- == 0)
            return &m->curve[i];
    return NULL;
}

double figure_mean(const struct figure_input *in, const struct measured_point *p,
                   const char *output, double *error) {
    const struct recipe *r = in->file->observable[in->observable[0]].recipe;
    double mean = NAN;
    *error = 0;
    for (size_t i = 0; i < RECIPE_MAX_OUTPUTS && r->output[i].name != NULL; i++)
        if (strcmp(r->output[i].name, output) == 0)
            measured_mean(p, in->observable[0], i, &mean, error);
    if (!isfinite(*error))
        *error = 0;
    return mean;
}

const struct measured_run *figure_first_run(const struct measured_point *p) {
    for (size_t i = 0; i < p->run_count; i++)
        if (p->run[i].usable)
            return &p->run[i];
    return NULL;
}

enum status figure_needs(const struct figure_input *in, const char *recipe, struct fault *fault) {
    const char *has = in->file->observable[in->observable[0]].recipe->name;
    if (strcmp(has, recipe) == 0)
        return STATUS_OK;
    return fault_set(fault, STATUS_BAD_INPUT, "%s draws an observable of the recipe %s, not %s",
                     in->wanted->recipe, recipe, has);
}

enum status figure_at_most(const struct figure_input *in, size_t points, struct fault *fault) {
    if (in->data->point_count <= points)
        return STATUS_OK;
    return fault_set(fault, STATUS_BAD_INPUT,
                     "%zu points cannot be told apart in one figure, %zu can: choose with `points`",
                     in->data->point_count, points);
}

static enum status too_many(struct fault *fault) {
    return fault_set(fault, STATUS_BAD_INPUT, "more than %d figures of one kind", (int)FIGURES_MAX);
}

enum status figure_add(struct figure_output *out, const struct report_figure *f,
                       struct fault *fault) {
    if (out->figure_count >= FIGURES_MAX)
        return too_many(fault);
    out->figure[out->figure_count++] = *f;
    return STATUS_OK;
}

enum status figure_add_picture(struct figure_output *out, const struct report_picture *p,
                               struct fault *fault) {
    if (out->picture_count >= FIGURES_MAX)
        return too_many(fault);
    out->picture[out->picture_count++] = *p;
    return STATUS_OK;
}

enum status figure_add_table(struct figure_output *out, const struct report_table *t,
                             struct fault *fault) {
    if (out->table_count >= FIGURES_MAX)
        return too_many(fault);
    out->table[out->table_count++] = *t;
    return STATUS_OK;
}

enum status figure_add_sequence(struct figure_output *out, const struct report_sequence *s,
                                struct fault *fault) {
    if (out->sequence_count >= FIGURES_MAX)
        return too_many(fault);
    out->sequence[out->sequence_count++] = *s;
    return STATUS_OK;
}

enum status figure_add_animation(struct figure_output *out, const struct report_sequence *s,
                                 struct fault *fault) {
    if (out->animation_count >= FIGURES_MAX)
        return too_many(fault);
    out->animation[out->animation_count++] = *s;
    return STATUS_OK;
}
