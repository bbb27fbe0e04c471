/* run_view.c -- see run_view.h.
 *
 * The result file is not trusted: h5.h refuses what is foreign to the format,
 * and here every series must have {step, time, value} of equal length, time
 * that does not fall, and finite numbers only.
 */
#include "validation/run_view.h"

#include "common/h5.h"
#include "common/runfile.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* 2 GiB of doubles in one dataset: more than any case writes. */
static const size_t MAX_VALUES = (size_t)1 << 28;
static const size_t MAX_LIST = 100000;

struct kept_series {
    char *name;
    struct series series;
    double *step, *time, *value; /* owned */
};

struct kept_array { /* a fixed dataset, or a list of reals that is a parameter */
    char *name;
    double *value;
    size_t count;
};

struct kept_text {
    char *name;
    char text[256];
};

struct run_view {
    char *result_path;
    struct runfile run;
    struct h5_reader *result;
    struct kept_series **series; /* each allocated alone: callers keep pointers */
    size_t series_count;
    struct kept_array **array;
    size_t array_count;
    struct kept_text **text;
    size_t text_count;
};

/* Room for one more pointer at the end of list; NULL when there is no memory. */
static void *grow(void *list, size_t count) {
    return realloc(list, (count + 1) * sizeof(void *));
}

static enum status no_memory(struct fault *fault) {
    return fault_set(fault, STATUS_NO_MEMORY, "no memory for the data of a run");
}

/* -- opening ---------------------------------------------------------------- */

enum status run_view_open(const char *run_path, const char *result_path, struct run_view **out,
                          struct fault *fault) {
    *out = NULL;
    struct run_view *v = calloc(1, sizeof *v);
    if (!v)
        return no_memory(fault);
    enum status status = STATUS_OK;
    v->result_path = strdup(result_path);
    if (!v->result_path) {
        status = no_memory(fault);
        goto done;
    }
    status = runfile_load(run_path, &v->run, fault);
    if (status)
        goto done;
    status = h5_open(result_path, &v->result, fault);
done:
    if (status)
        run_view_close(v);
    else
        *out = v;
    return status;
}

void run_view_close(struct run_view *v) {
    if (!v)
        return;
    for (size_t i = 0; i < v->series_count; i++) {
        free(v->series[i]->name);
        free(v->series[i]->step);
        free(v->series[i]->time);
        free(v->series[i]->value);
        free(v->series[i]);
    }
    for (size_t i = 0; i < v->array_count; i++) {
        free(v->array[i]->name);
        free(v->array[i]->value);
        free(v->array[i]);
    }
    for (size_t i = 0; i < v->text_count; i++) {
        free(v->text[i]->name);
        free(v->text[i]);
    }
    free(v->series);
    free(v->array);
    free(v->text);
    h5_close(v->result);
    runfile_free(&v->run);
    free(v->result_path);
    free(v);
}

const char *run_view_path(const struct run_view *v) {
    return v->result_path;
}

/* -- keeping ---------------------------------------------------------------- */

static const struct kept_array *find_array(const struct run_view *v, const char *name) {
    for (size_t i = 0; i < v->array_count; i++)
        if (!strcmp(v->array[i]->name, name))
            return v->array[i];
    return NULL;
}

/* Takes value over, also on error. */
static enum status keep_array(struct run_view *v, const char *name, double *value, size_t count,
                              const struct kept_array **out, struct fault *fault) {
    struct kept_array *k = calloc(1, sizeof *k);
    struct kept_array **list = grow(v->array, v->array_count);
    if (list)
        v->array = list;
    if (!k || !list || !(k->name = strdup(name))) {
        free(k);
        free(value);
        return no_memory(fault);
    }
    k->value = value;
    k->count = count;
    v->array[v->array_count++] = k;
    *out = k;
    return STATUS_OK;
}

static enum status keep_text(struct run_view *v, const char *name, const char *text,
                             const char **out, struct fault *fault) {
    struct kept_text *k = calloc(1, sizeof *k);
    struct kept_text **list = grow(v->text, v->text_count);
    if (list)
        v->text = list;
    if (!k || !list || !(k->name = strdup(name))) {
        free(k);
        return no_memory(fault);
    }
    snprintf(k->text, sizeof k->text, "%s", text);
    v->text[v->text_count++] = k;
    *out = k->text;
    return STATUS_OK;
}

/* -- parameters ------------------------------------------------------------- */

static const struct yaml_node *find_parameter(const struct run_view *v, const char *name) {
    return v->run.parameters ? yaml_get(v->run.parameters, name) : NULL;
}

/* A list of reals from the run file's node. */
static enum status list_of_node(const struct yaml_node *node, double **values, size_t *count,
                                struct fault *fault) {
    size_t n = node->kind == YAML_LIST ? node->count : 1;
    double *list = calloc(n ? n : 1, sizeof *list);
    if (!list)
        return no_memory(fault);
    enum status status = STATUS_OK;
    for (size_t i = 0; i < n && !status; i++) {
        const struct yaml_node *item = node->kind == YAML_LIST ? &node->child[i] : node;
        if (item->kind == YAML_SCALAR && item->text && !strcmp(item->text, "true"))
            list[i] = 1;
        else if (item->kind == YAML_SCALAR && item->text && !strcmp(item->text, "false"))
            list[i] = 0;
        else
            status = yaml_real(item, &list[i], fault);
    }
    if (status) {
        free(list);
        return status;
    }
    *values = list;
    *count = n;
    return STATUS_OK;
}

static enum status parameter_values(struct run_view *v, const char *name,
                                    const struct kept_array **out, struct fault *fault) {
    char kept_name[128];
    snprintf(kept_name, sizeof kept_name, "parameters.%s", name);
    *out = find_array(v, kept_name);
    if (*out)
        return STATUS_OK;
    double *values = NULL;
    size_t count = 0;
    const struct yaml_node *node = find_parameter(v, name);
    enum status status;
    if (node)
        status = list_of_node(node, &values, &count, fault);
    else
        status = h5_read_reals(v->result, "parameters", name, MAX_LIST, &values, &count, fault);
    for (size_t i = 0; !status && i < count; i++)
        if (!isfinite(values[i]))
            status = fault_set(fault, STATUS_BAD_INPUT, "%s: parameter %s is not a finite number",
                               v->result_path, name);
    if (status) {
        free(values);
        return status;
    }
    return keep_array(v, kept_name, values, count, out, fault);
}

enum status run_view_parameter(struct run_view *v, const char *name, double *out,
                               struct fault *fault) {
    const struct kept_array *k;
    enum status status = parameter_values(v, name, &k, fault);
    if (status)
        return status;
    if (k->count != 1)
        return fault_set(fault, STATUS_BAD_INPUT, "%s: parameter %s is a list of %zu, not a number",
                         v->result_path, name, k->count);
    *out = k->value[0];
    return STATUS_OK;
}

enum status run_view_parameter_list(struct run_view *v, const char *name, const double **values,
                                    size_t *count, struct fault *fault) {
    const struct kept_array *k;
    enum status status = parameter_values(v, name, &k, fault);
    if (status)
        return status;
    *values = k->value;
    *count = k->count;
    return STATUS_OK;
}

enum status run_view_parameter_text(struct run_view *v, const char *name, const char **out,
                                    struct fault *fault) {
    const struct yaml_node *node = find_parameter(v, name);
    if (node)
        return yaml_string(node, out, fault);
    for (size_t i = 0; i < v->text_count; i++)
        if (!strcmp(v->text[i]->name, name)) {
            *out = v->text[i]->text;
            return STATUS_OK;
        }
    char text[256];
    enum status status = h5_read_text(v->result, "parameters", name, text, sizeof text, fault);
    return status ? status : keep_text(v, name, text, out, fault);
}

/* -- time series and arrays ------------------------------------------------- */

static enum status check_series(const struct run_view *v, const char *name, const struct series *s,
                                struct fault *fault) {
    for (size_t f = 0; f < s->frames; f++) {
        if (!isfinite(s->time[f]) || !isfinite(s->step[f]))
            return fault_set(fault, STATUS_BAD_INPUT, "%s: %s: time of frame %zu is not finite",
                             v->result_path, name, f);
        if (f && s->time[f] <= s->time[f - 1])
            return fault_set(fault, STATUS_BAD_INPUT,
                             "%s: %s: time does not increase at frame %zu (%.9g after %.9g)",
                             v->result_path, name, f, s->time[f], s->time[f - 1]);
        for (size_t k = 0; k < s->size; k++)
            if (!isfinite(s->value[f * s->size + k]))
                return fault_set(fault, STATUS_BAD_INPUT,
                                 "%s: %s: entry %zu of frame %zu (time %.9g) is not finite",
                                 v->result_path, name, k, f, s->time[f]);
    }
    return STATUS_OK;
}

/* Reads NAME/part, which must have `rank` dimensions (any where rank < 0). */
static enum status read_part(struct run_view *v, const char *name, const char *part, double **out,
                             int *rank, size_t dims[H5_MAX_RANK], struct fault *fault) {
    char path[256];
    size_t count;
    snprintf(path, sizeof path, "%s/%s", name, part);
    enum status status = h5_dims(v->result, path, rank, dims, fault);
    if (!status)
        status = h5_read(v->result, path, MAX_VALUES, out, &count, fault);
    return status;
}

static enum status read_series(struct run_view *v, const char *name, struct kept_series *k,
                               struct fault *fault) {
    int rank_value, rank_time, rank_step;
    size_t dims[H5_MAX_RANK], time_dims[H5_MAX_RANK], step_dims[H5_MAX_RANK];
    enum status status = read_part(v, name, "value", &k->value, &rank_value, dims, fault);
    if (!status)
        status = read_part(v, name, "time", &k->time, &rank_time, time_dims, fault);
    if (!status)
        status = read_part(v, name, "step", &k->step, &rank_step, step_dims, fault);
    if (status)
        return status;
    if (rank_value < 1 || rank_time != 1 || rank_step != 1 || time_dims[0] != dims[0] ||
        step_dims[0] != dims[0])
        return fault_set(fault, STATUS_BAD_INPUT,
                         "%s: %s: step, time and value do not have one entry a frame each",
                         v->result_path, name);
    if (!dims[0])
        return fault_set(fault, STATUS_BAD_INPUT, "%s: %s: no frames", v->result_path, name);
    struct series *s = &k->series;
    s->frames = dims[0];
    s->rank = rank_value - 1;
    s->size = 1;
    for (int i = 0; i < s->rank; i++) {
        s->dims[i] = dims[i + 1];
        s->size *= dims[i + 1];
    }
    s->time = k->time;
    s->step = k->step;
    s->value = k->value;
    char path[256];
    snprintf(path, sizeof path, "%s/value", name);
    status = h5_unit(v->result, path, s->unit, sizeof s->unit, fault);
    return status ? status : check_series(v, name, s, fault);
}

enum status run_view_series(struct run_view *v, const char *name, const struct series **out,
                            struct fault *fault) {
    for (size_t i = 0; i < v->series_count; i++)
        if (!strcmp(v->series[i]->name, name)) {
            *out = &v->series[i]->series;
            return STATUS_OK;
        }
    struct kept_series *k = calloc(1, sizeof *k);
    struct kept_series **list = grow(v->series, v->series_count);
    if (list)
        v->series = list;
    if (!k || !list || !(k->name = strdup(name))) {
        free(k);
        return no_memory(fault);
    }
    enum status status = read_series(v, name, k, fault);
    if (status) {
        free(k->name);
        free(k->step);
        free(k->time);
        free(k->value);
        free(k);
        return status;
    }
    v->series[v->series_count++] = k;
    *out = &k->series;
    return STATUS_OK;
}

enum status run_view_array(struct run_view *v, const char *name, const double **values,
                           size_t *count, struct fault *fault) {
    const struct kept_array *k = find_array(v, name);
    if (!k) {
        double *value = NULL;
        size_t n = 0;
        enum status status = h5_read(v->result, name, MAX_VALUES, &value, &n, fault);
        if (status)
            return status;
        for (size_t i = 0; i < n; i++)
            if (!isfinite(value[i])) {
                free(value);
                return fault_set(fault, STATUS_BAD_INPUT, "%s: %s: entry %zu is not finite",
                                 v->result_path, name, i);
            }
        status = keep_array(v, name, value, n, &k, fault);
        if (status)
            return status;
    }
    *values = k->value;
    *count = k->count;
    return STATUS_OK;
}

/* -- what was asked for ----------------------------------------------------- */

/* A solver hits a time to half a step; nearer to another sample it is not that frame. */
static enum status check_times(const struct run_view *v, const char *name, const double *time,
                               const double *asked, size_t count, struct fault *fault) {
    for (size_t f = 0; f < count; f++) {
        double before = f > 0 ? asked[f] - asked[f - 1] : INFINITY;
        double after = f + 1 < count ? asked[f + 1] - asked[f] : INFINITY;
        double gap = count > 1 ? fmin(before, after) : asked[0] > 0 ? asked[0] : INFINITY;
        if (!(fabs(time[f] - asked[f]) < gap / 2))
            return fault_set(fault, STATUS_BAD_INPUT,
                             "%s: %s: frame %zu is of time %.9g, not of %.9g as asked for",
                             v->result_path, name, f, time[f], asked[f]);
    }
    return STATUS_OK;
}

static enum status check_asked_series(struct run_view *v, const char *name, const char *time_path,
                                      struct fault *fault) {
    bool particles = !strncmp(name, "particles/", 10);
    size_t asked = particles ? v->run.particle_sample_count : v->run.sample_count, count;
    size_t dims[H5_MAX_RANK];
    double *time = NULL;
    int rank;
    enum status status = h5_dims(v->result, time_path, &rank, dims, fault);
    if (status)
        return status;
    if (rank != 1 || dims[0] != asked)
        return fault_set(fault, STATUS_BAD_INPUT, "%s: %s: %zu frames, but %zu were asked for",
                         v->result_path, name, rank == 1 ? dims[0] : 0, asked);
    status = h5_read(v->result, time_path, asked, &time, &count, fault);
    if (!status)
        status = check_times(v, name, time, particles ? v->run.particle_samples : v->run.samples,
                             asked, fault);
    free(time);
    return status;
}

enum status run_view_check_asked(struct run_view *v, struct fault *fault) {
    enum status status = STATUS_OK;
    for (size_t i = 0; !status && i < v->run.dataset_count; i++) {
        const char *name = v->run.datasets[i];
        char time[256];
        snprintf(time, sizeof time, "%s/time", name);
        if (!h5_has(v->result, name))
            status = fault_set(fault, STATUS_BAD_INPUT, "%s: %s: was asked for and is missing",
                               v->result_path, name);
        else if (h5_has(v->result, time))
            status = check_asked_series(v, name, time, fault);
    }
    return status;
}
