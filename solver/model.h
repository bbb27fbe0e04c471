/* model.h -- the plug: what a model must offer to be run by bedsim.
 *
 * A model is one constant struct of functions and a table of parameters.  The
 * program reads the run file, fills a parameter set, creates the state, and
 * alternates `step` and `observe` until the last sample.  `save` and `load`
 * carry the complete state (random streams included), so that a run that is
 * saved, loaded and continued gives the same bits as one that was not.
 */
#ifndef SOLVER_MODEL_H
#define SOLVER_MODEL_H

#include "common/h5.h"
#include "common/json.h"
#include "common/runfile.h"

#include <stdint.h>

enum parameter_type {
    PARAMETER_REAL,
    PARAMETER_INTEGER,
    PARAMETER_BOOLEAN,
    PARAMETER_CHOICE,
    PARAMETER_REAL_LIST
};

struct parameter {
    const char *name;
    enum parameter_type type;
    const char *unit;           /* "l", "tau", "1" */
    const char *standard;       /* documented default, as text: "60", "published", "[]" */
    double min, max;            /* closed range; elements of lists too */
    const char *const *choices; /* PARAMETER_CHOICE: NULL-terminated */
    const char *source;         /* paper and equation, or why it exists */
    const char *doc;            /* one line */
};

/* Values of one run, in the order of the model's table. */
struct parameter_set {
    const struct parameter *table;
    size_t count;
    double *real;  /* real[0 .. count-1]: numbers, booleans (0/1), index of choice */
    double **list; /* list[i][0 .. length[i]-1] for PARAMETER_REAL_LIST, else NULL */
    size_t *length;
    const char **place; /* "file:line:column" or "--set" or "default", for messages */
};

enum dataset_when {
    DATASET_ONCE,      /* at the first particle sample: ids, radii */
    DATASET_PARTICLES, /* at the particle samples */
    DATASET_SAMPLES    /* at the samples: fields, observables */
};

struct dataset {
    const char *name; /* path in the result file: "fields/pressure" */
    enum dataset_when when;
    const char *doc; /* one line: shape and unit */
};

struct model {
    const char *name, *title, *source;
    const char *time_unit, *length_unit;
    const struct parameter *parameters;
    size_t parameter_count;
    const struct dataset *datasets; /* every dataset it can write; ends at name == NULL */

    /* All faults of the input are found here, before the first step.
     * start: a result file to start from, or NULL. On error *state is NULL. */
    enum status (*create)(void **state, const struct parameter_set *p, struct h5_reader *start,
                          uint64_t seed, struct fault *fault);
    /* The next sample's time: a step must not pass it.  NULL where steps are whole and
     * the nearest one counts. */
    void (*aim)(void *state, double time);
    /* One time step, or one batch of events; STATUS_NUMERICAL names step and cause. */
    enum status (*step)(void *state, struct fault *fault);
    /* Steps done and time reached, in time_unit. */
    long long (*steps)(const void *state);
    double (*time)(const void *state);
    /* Has `time` been reached (to half a step)? */
    bool (*reached)(const void *state, double time);
    /* Append one dataset's present value to the result. */
    enum status (*observe)(void *state, const char *dataset, struct h5_writer *w,
                           struct fault *fault);
    /* Members of an open JSON object: seconds by part, counters worth a look. */
    void (*report_cost)(const void *state, struct json *j);
    /* What a user should know before the run starts, or NULL: "dt_tau is above half ...". */
    const char *(*notice)(const void *state);
    enum status (*save)(const void *state, const char *path, struct fault *fault);
    enum status (*load)(void *state, const char *path, struct fault *fault);
    void (*free)(void *state);
};

/* parameters.c: the table made useful. */

/* Defaults, then the run file's map, then --set texts "name=value"; every fault
 * is found (unknown name with the nearest, wrong type, out of range). */
enum status parameters_read(const struct model *m, const struct yaml_node *map,
                            const char *const *settings, size_t setting_count,
                            struct parameter_set *out, struct fault *fault);
void parameters_free(struct parameter_set *p);
/* A name that is not in the table, or of another type, is a mistake of the program: asserted. */
double parameters_real(const struct parameter_set *p, const char *name);
const char *parameters_choice(const struct parameter_set *p, const char *name);
const double *parameters_list(const struct parameter_set *p, const char *name, size_t *length);
/* Add "place: name: message" to fault, for faults that only the model can see. */
enum status parameters_fault(const struct parameter_set *p, const char *name, struct fault *fault,
                             const char *format, ...) __attribute__((format(printf, 4, 5)));

/* models.c */
const struct model *models_find(const char *name);
const struct model *const *models_all(size_t *count);

#endif
