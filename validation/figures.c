#include "validation/figures.h"

#include "validation/figure_recipes.h"

#include <string.h>

/* One line a figure recipe. */
static const struct figure_recipe *const recipes[] = {
    &figure_settling_curve, &figure_snapshot, NULL, /* ends the list */
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
