/* fake_run.h -- a run file and a result of known content, for tests of what reads them. */
#ifndef FAKE_RUN_H
#define FAKE_RUN_H

#include "common/h5.h"
#include "tests/unit/unit.h"
#include "validation/recipe.h"

#include <math.h>

enum { FAKE_MAX_GRAINS = 4000 };

struct fake_run {
    char run[256], result[256];
    const char *folder;
    struct h5_writer *writer;
    struct fault fault;
};

/* `parameters`: lines of the run file's map, each with its newline. */
static inline struct fake_run fake_start(const char *parameters) {
    static const char common[] =
        "format: bedcheck-run 1\ncase: graingas/fake\npoint: single\n"
        "model: graingas\nsamples: [0, 1]\ndatasets: [fields/pressure]\nparameters:\n";
    static const char *const standard[][2] = {{"darcy", "published"},
                                              {"face", "arithmetic"},
                                              {"solid_fraction_min", "0.25"},
                                              {"peclet", "0.0002"},
                                              {"area_to_volume", "0.66666666666666663"},
                                              {"froude", "1"},
                                              {"gravity", "1"},
                                              {"dt_tau", "0.0125"}};
    struct fake_run f = {.folder = unit_folder(), .fault = FAULT_NONE};
    snprintf(f.run, sizeof f.run, "%s/run.yaml", f.folder);
    snprintf(f.result, sizeof f.result, "%s/result.h5", f.folder);
    char text[32768], key[64];
    int n = snprintf(text, sizeof text, "%s%s", common, parameters);
    for (size_t i = 0; i < sizeof standard / sizeof *standard; i++) {
        snprintf(key, sizeof key, "  %s:", standard[i][0]);
        if (!strstr(parameters, key))
            n += snprintf(text + n, sizeof text - (size_t)n, "%s %s\n", key, standard[i][1]);
    }
    ck_assert_int_lt(n, (int)sizeof text);
    unit_write(f.run, text);
    unit_ok(h5_create(f.result, &f.writer, &f.fault), &f.fault);
    return f;
}

static inline void fake_array(struct fake_run *f, const char *name, const double *data,
                              size_t count) {
    unit_ok(h5_write(f->writer, name, H5_REAL, 1, &count, data, "1", &f->fault), &f->fault);
}

static inline void fake_append(struct fake_run *f, const char *name, int rank, const size_t *dims,
                               const double *data, double time, double dt) {
    unit_ok(h5_append(f->writer, name, H5_REAL, rank, dims, data, "1", (long long)lround(time / dt),
                      time, "tau", &f->fault),
            &f->fault);
}

/* One value a site and frame. */
static inline void fake_field(struct fake_run *f, const char *name, size_t nx, size_t ny,
                              const double *data, double time, double dt) {
    fake_append(f, name, 2, (const size_t[]){ny, nx}, data, time, dt);
}

/* Vectors of grains or sites: data[count][2]. */
static inline void fake_vectors(struct fake_run *f, const char *name, size_t count,
                                const double *data, double time, double dt) {
    fake_append(f, name, 2, (const size_t[]){count, 2}, data, time, dt);
}

static inline void fake_site_vectors(struct fake_run *f, const char *name, size_t nx, size_t ny,
                                     const double *data, double time, double dt) {
    fake_append(f, name, 3, (const size_t[]){ny, nx, 2}, data, time, dt);
}

static inline void fake_scalar(struct fake_run *f, const char *name, double value, double time,
                               double dt) {
    fake_append(f, name, 0, NULL, &value, time, dt);
}

static inline struct run_view *fake_open(struct fake_run *f) {
    struct run_view *v = NULL;
    unit_ok(h5_commit(f->writer, &f->fault), &f->fault);
    unit_ok(run_view_open(f->run, f->result, &v, &f->fault), &f->fault);
    return v;
}

static inline size_t fake_setting_index(const struct recipe *r, const char *name) {
    for (size_t i = 0; i < RECIPE_MAX_SETTINGS && r->setting[i].name; i++)
        if (!strcmp(r->setting[i].name, name))
            return i;
    ck_abort_msg("no setting %s", name);
    return 0;
}

/* Commits the result, measures it with the recipe's standard settings but for
 * the one named (or NULL), removes the folder. */
static inline enum status fake_measure(struct fake_run *f, const char *recipe, const char *setting,
                                       double value, struct measurement *out) {
    const struct recipe *r = recipe_find(recipe);
    ck_assert_ptr_nonnull(r);
    double settings[RECIPE_MAX_SETTINGS] = {0};
    for (size_t i = 0; i < RECIPE_MAX_SETTINGS && r->setting[i].name; i++)
        settings[i] = r->setting[i].standard;
    if (setting)
        settings[fake_setting_index(r, setting)] = value;
    struct run_view *v = fake_open(f);
    memset(out, 0, sizeof *out);
    enum status status = r->measure(v, settings, out, &f->fault);
    run_view_close(v);
    unit_remove(f->folder);
    return status;
}

/* Value of an output by name. */
static inline double fake_value(const struct measurement *m, const char *recipe,
                                const char *output) {
    const struct recipe *r = recipe_find(recipe);
    for (size_t i = 0; i < RECIPE_MAX_OUTPUTS && r->output[i].name; i++)
        if (!strcmp(r->output[i].name, output))
            return m->value[i];
    ck_abort_msg("no output %s", output);
    return 0;
}

#endif
