/* figures.h -- pictures of a case beside its rows.
 *
 * A figure recipe is one constant struct and one line in figures.c.  It sees
 * all points, the measurements and curves of every seed, the judged rows and,
 * through run_view_open(run_path, result_path), the particles and fields of
 * every usable run.  A curve of theory is drawn with prediction->at, the same
 * function that the checks used.  Whatever it builds is taken from out->arena
 * and lives as long as the report.
 *
 * A case asks for one with `figures: [{recipe: settling-curve, of: [settling]}]`, chooses the runs
 * with `points:` (then `data` has only these) and sets what the recipe's table of settings allows;
 * every case has the default figure (figure_default.c) besides.
 */
#ifndef VALIDATION_FIGURES_H
#define VALIDATION_FIGURES_H

#include "report/report.h"
#include "validation/measure.h"

enum { FIGURES_MAX = 32 };

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
    size_t figure_count, picture_count, table_count, sequence_count, animation_count;
    struct report_figure figure[FIGURES_MAX];
    struct report_picture picture[FIGURES_MAX];
    struct report_table table[FIGURES_MAX];
    struct report_sequence sequence[FIGURES_MAX], animation[FIGURES_MAX];
};

/* FIGURE_CURVE is a text that names a curve of the first observable of `of:`. */
enum figure_kind { FIGURE_NUMBER, FIGURE_NUMBERS, FIGURE_TEXT, FIGURE_CURVE };

struct figure_setting {
    const char *name, *doc;
    enum figure_kind kind;
    bool required;
    double standard, min, max; /* numbers: closed range, checked where min < max */
};

struct figure_recipe {
    const char *name, *title;
    size_t observables; /* how many names `of:` must have; 0: none needed */
    bool optional;      /* or none at all */
    struct figure_setting setting[CASE_FIGURE_SETTINGS]; /* ends at name == NULL */
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

/* Those points of a measured case that pass the figure's filter, in *out (taken from the arena). */
enum status figure_select(const struct measured_case *data, const struct case_figure *wanted,
                          struct arena *arena, struct measured_case *out, struct fault *fault);

/* Append by value; STATUS_BAD_INPUT beyond FIGURES_MAX. */
enum status figure_add(struct figure_output *out, const struct report_figure *f,
                       struct fault *fault);
enum status figure_add_picture(struct figure_output *out, const struct report_picture *p,
                               struct fault *fault);
enum status figure_add_table(struct figure_output *out, const struct report_table *t,
                             struct fault *fault);
enum status figure_add_sequence(struct figure_output *out, const struct report_sequence *s,
                                struct fault *fault);
enum status figure_add_animation(struct figure_output *out, const struct report_sequence *s,
                                 struct fault *fault);

/* The nth (from 0) curve of a name in one run's measurement, or NULL. */
const struct curve *figure_curve_find(const struct measurement *m, const char *name, size_t nth);
/* Mean over a point's seeds of an output by name, and its standard error (0: one seed); NaN where
 * no seed has it. */
double figure_mean(const struct figure_input *in, const struct measured_point *p,
                   const char *output, double *error);
/* The first usable run of a point, or NULL. */
const struct measured_run *figure_first_run(const struct measured_point *p);
/* Is the first observable of `of:` one of this recipe?  The fault says so if not. */
enum status figure_needs(const struct figure_input *in, const char *recipe, struct fault *fault);
/* Are there no more points than can be told apart? */
enum status figure_at_most(const struct figure_input *in, size_t points, struct fault *fault);

/* figure_text.c: names of parameters as a reader wants them.  "flux_l_per_tau" is the quantity
 * "flux" in l/tau: "flux (l/tau)" on an axis, "flux 0.2 l/tau" of a point.  NULL: no memory. */
const char *figure_axis_text(const char *parameter, struct arena *a);
const char *figure_value_text(const char *parameter, const char *value, struct arena *a);
/* What tells this point from the others of `data`: "reading literal, flux 0.2 l/tau".  Its reading,
 * if it has one, always stands first; else the text of a single point is empty.  The parameter
 * `along` (or NULL), or the axis whose labels set it, is left out. */
const char *figure_point_text(const struct measured_case *data, const struct measured_point *p,
                              const char *along, struct arena *a);

#endif
