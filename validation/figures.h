/* figures.h -- pictures of a case beside its rows.
 *
 * A figure recipe is one constant struct and one line in figures.c.  It sees
 * all points, the measurements and curves of every seed, the judged rows and,
 * through run_view_open(run_path, result_path), the particles and fields of
 * every usable run.  A curve of theory is drawn with prediction->at, the same
 * function that the checks used.  Whatever it builds is taken from out->arena
 * and lives as long as the report.
 *
 * A case asks for one with `figures: [{recipe: settling-curve, of: [settling]}]`;
 * every case has the default figure (figure_default.c) besides.
 */
#ifndef VALIDATION_FIGURES_H
#define VALIDATION_FIGURES_H

#include "report/report.h"
#include "validation/measure.h"

enum { FIGURES_MAX = 16 };

struct figure_input {
    const struct measured_case *data; /* data->point[i].run[k].observable[j].value, .curve */
    const struct case_file *file;     /* = data->plan->file: observable[j].name, .recipe */
    const struct case_figure *wanted; /* title, caption, observables; NULL for the default */
    size_t observable_count;
    const size_t *observable; /* what `of:` names, as indices of file->observable */
    size_t row_count;
    const struct report_row *row;                  /* the case's judged rows */
    const struct measured_point *const *row_point; /* row_point[i]: NULL for across and run rows */
    const struct case_check *const *row_check;     /* row_check[i]: NULL for run rows */
};

struct figure_output {
    struct arena *arena; /* for every array and text below */
    size_t figure_count, picture_count, table_count;
    struct report_figure figure[FIGURES_MAX];
    struct report_picture picture[FIGURES_MAX];
    struct report_table table[FIGURES_MAX];
};

struct figure_recipe {
    const char *name, *title;
    size_t observables; /* how many names `of:` must have; 0: none needed */
    /* Adds figures, pictures and tables to *out.  STATUS_BAD_INPUT when the data
     * do not suit; the report then says so in place of the figure. */
    enum status (*build)(const struct figure_input *in, struct figure_output *out,
                         struct fault *fault);
};

/* figures.c */
const struct figure_recipe *figure_find(const char *name);
const struct figure_recipe *const *figure_all(size_t *count);

/* figure_default.c: measured against expected over the swept parameter, with
 * error bars and a residual panel, for each check that is judged point by point. */
enum status figure_default_build(const struct figure_input *in, struct figure_output *out,
                                 struct fault *fault);

/* Append by value; STATUS_BAD_INPUT beyond FIGURES_MAX. */
enum status figure_add(struct figure_output *out, const struct report_figure *f,
                       struct fault *fault);
enum status figure_add_picture(struct figure_output *out, const struct report_picture *p,
                               struct fault *fault);
enum status figure_add_table(struct figure_output *out, const struct report_table *t,
                             struct fault *fault);

#endif
