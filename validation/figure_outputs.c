/* figure_outputs.c -- a table of all that an observable gives, point by point.
 *
 * Rows are outputs, columns points: means over seeds with their standard errors, judged or not.
 * An output that no point has is left out.
 *
 * Leaves out: single seeds (their values are in results.json where a check judges them).
 * Checked by: tests/unit/test_figure_recipes.c.
 */
#include "report/words.h"
#include "validation/figure_recipes.h"

#include <math.h>

static enum status no_memory(struct fault *fault) {
    return fault_set(fault, STATUS_NO_MEMORY, "table of outputs: out of memory");
}

static const char *value_text(struct arena *a, double value, double error) {
    if (!isfinite(value))
        return "-";
    return arena_copy(a, error > 0 ? words_measured(value, error).text : words_number(value).text);
}

static const char *const *head(const struct figure_input *in, struct arena *a) {
    size_t points = in->data->point_count;
    const char **heading = arena_take(a, points + 1, sizeof *heading);
    if (!heading)
        return NULL;
    heading[0] = "output";
    for (size_t i = 0; i < points; i++) {
        const char *text = figure_point_text(in->data, &in->data->point[i], NULL, a);
        if (!text)
            return NULL;
        heading[i + 1] = *text ? text : "value";
    }
    return heading;
}

/* One row; *found: some point has the output. */
static enum status fill_row(const struct figure_input *in, size_t output, const char **cell,
                            bool *found, struct arena *a, struct fault *fault) {
    size_t observable = in->observable[0];
    const struct recipe_output *o = &in->file->observable[observable].recipe->output[output];
    *found = false;
    cell[0] = arena_text(a, "%s (%s)", o->name, o->unit);
    bool complete = cell[0] != NULL;
    for (size_t i = 0; i < in->data->point_count; i++) {
        double mean, error;
        *found |= measured_mean(&in->data->point[i], observable, output, &mean, &error) > 0;
        cell[i + 1] = value_text(a, mean, error);
        complete &= cell[i + 1] != NULL;
    }
    return complete ? STATUS_OK : no_memory(fault);
}

static enum status build(const struct figure_input *in, struct figure_output *out,
                         struct fault *fault) {
    const struct case_observable *o = &in->file->observable[in->observable[0]];
    size_t columns = in->data->point_count + 1;
    const char **cell = arena_take(out->arena, columns * RECIPE_MAX_OUTPUTS, sizeof *cell);
    struct report_table t = {.title = in->wanted->title,
                             .caption = in->wanted->caption,
                             .columns = columns,
                             .heading = head(in, out->arena),
                             .cell = cell};
    if (!t.title)
        t.title = arena_text(out->arena, "What %s gives", o->name);
    if (!t.caption)
        t.caption = arena_text(out->arena,
                               "%s. Means over seeds with their standard errors; \"-\" where no "
                               "seed has a value. Judged is only what stands under the checks.",
                               o->recipe->title);
    if (!cell || !t.heading || !t.title || !t.caption)
        return no_memory(fault);
    for (size_t i = 0; i < RECIPE_MAX_OUTPUTS && o->recipe->output[i].name; i++) {
        bool found;
        if (fill_row(in, i, cell + t.rows * columns, &found, out->arena, fault))
            return fault->status;
        t.rows += found;
    }
    if (t.rows == 0)
        return fault_set(fault, STATUS_BAD_INPUT, "%s gives nothing at any point", o->name);
    return figure_add_table(out, &t, fault);
}

const struct figure_recipe figure_outputs = {
    .name = "outputs",
    .title = "All outputs of an observable, point by point",
    .observables = 1,
    .build = build,
};
