/* runfile.c -- see runfile.h. */
#include "common/runfile.h"

#include "common/file.h"
#include "common/schema.h"

#include <libgen.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_TIMES = 1000000 };

static const struct schema_field RUN_FIELDS[] = {
    {.key = "format", .type = SCHEMA_TEXT, .required = true},
    {.key = "case", .type = SCHEMA_TEXT, .required = true},
    {.key = "point", .type = SCHEMA_TEXT, .required = true},
    {.key = "model", .type = SCHEMA_TEXT, .required = true},
    {.key = "samples", .type = SCHEMA_ANY, .required = true},
    {.key = "particle_samples", .type = SCHEMA_ANY},
    {.key = "datasets", .type = SCHEMA_LIST, .required = true},
    {.key = "start_file", .type = SCHEMA_TEXT},
    {.key = "parameters", .type = SCHEMA_MAP},
};

/* A case in the eyes of a solver: what is not about running is let by. */
static const struct schema_field CASE_FIELDS[] = {
    {.key = "name", .type = SCHEMA_TEXT, .required = true},
    {.key = "title", .type = SCHEMA_ANY},
    {.key = "source", .type = SCHEMA_ANY},
    {.key = "question", .type = SCHEMA_ANY},
    {.key = "equation", .type = SCHEMA_ANY},
    {.key = "model", .type = SCHEMA_TEXT, .required = true},
    {.key = "large_only", .type = SCHEMA_ANY},
    {.key = "tags", .type = SCHEMA_ANY},
    {.key = "also_write", .type = SCHEMA_ANY},
    {.key = "parameters", .type = SCHEMA_MAP},
    {.key = "sweep", .type = SCHEMA_MAP},
    {.key = "samples", .type = SCHEMA_ANY, .required = true},
    {.key = "particle_samples", .type = SCHEMA_ANY},
    {.key = "start", .type = SCHEMA_ANY},
    {.key = "seeds", .type = SCHEMA_ANY},
    {.key = "limit_s", .type = SCHEMA_ANY},
    {.key = "expect_s", .type = SCHEMA_ANY},
    {.key = "observables", .type = SCHEMA_ANY},
    {.key = "across", .type = SCHEMA_ANY},
    {.key = "checks", .type = SCHEMA_ANY},
    {.key = "figures", .type = SCHEMA_ANY},
    {.key = "tiers", .type = SCHEMA_ANY},
};

static const struct schema_field RANGE_FIELDS[] = {
    {.key = "from", .type = SCHEMA_REAL, .required = true, .min = 0, .max = 1e12},
    {.key = "to", .type = SCHEMA_REAL, .required = true, .min = 0, .max = 1e12},
    {.key = "every", .type = SCHEMA_REAL, .required = true, .min = 1e-12, .max = 1e12},
};

#define LENGTH(array) (sizeof(array) / sizeof *(array))

/* -- times -------------------------------------------------------------------- */

static enum status no_memory(const struct yaml_node *n, struct fault *fault) {
    return fault_set(fault, STATUS_NO_MEMORY, "%s: no memory", n->file);
}

static enum status times_of_range(const struct yaml_node *n, double **times, size_t *count,
                                  struct fault *fault) {
    double from = 0, to = 0, every = 1;
    if (schema_check(n, "range of times", RANGE_FIELDS, LENGTH(RANGE_FIELDS), fault) != STATUS_OK)
        return STATUS_BAD_INPUT;
    yaml_real(yaml_get(n, "from"), &from, fault);
    yaml_real(yaml_get(n, "to"), &to, fault);
    yaml_real(yaml_get(n, "every"), &every, fault);
    double steps = (to - from) / every;
    if (steps < 0 || fabs(steps - round(steps)) > 1e-6)
        return yaml_fault(n, fault, "%s: from %g to %g is not a whole number of steps of %g",
                          n->key ? n->key : "times", from, to, every);
    if (steps >= MAX_TIMES)
        return yaml_fault(n, fault, "%s: more than %d times", n->key ? n->key : "times", MAX_TIMES);
    size_t last = (size_t)lround(steps);
    *times = malloc((last + 1) * sizeof **times);
    if (*times == NULL)
        return no_memory(n, fault);
    for (size_t i = 0; i <= last; i++) {
        char text[32]; /* 3 * 0.1 is meant to be 0.3 */
        snprintf(text, sizeof text, "%.12g", from + (double)i * every);
        (*times)[i] = strtod(text, NULL);
    }
    *count = last + 1;
    return STATUS_OK;
}

static enum status times_of_list(const struct yaml_node *n, double **times, size_t *count,
                                 struct fault *fault) {
    const char *key = n->key ? n->key : "times";
    if (n->count == 0)
        return yaml_fault(n, fault, "%s: no times", key);
    double *t = calloc(n->count, sizeof *t);
    if (t == NULL)
        return no_memory(n, fault);
    enum status status = STATUS_OK;
    for (size_t i = 0; i < n->count && status == STATUS_OK; i++) {
        status = yaml_real(&n->child[i], &t[i], fault);
        if (status == STATUS_OK && t[i] < 0)
            status = yaml_fault(&n->child[i], fault, "%s: %g is before 0", key, t[i]);
        else if (status == STATUS_OK && i > 0 && t[i] <= t[i - 1])
            status = yaml_fault(&n->child[i], fault, "%s: %g is not after %g", key, t[i], t[i - 1]);
    }
    if (status != STATUS_OK) {
        free(t);
        return status;
    }
    *times = t;
    *count = n->count;
    return STATUS_OK;
}

enum status runfile_times(const struct yaml_node *n, double **times, size_t *count,
                          struct fault *fault) {
    *times = NULL;
    *count = 0;
    if (n->kind == YAML_MAP)
        return times_of_range(n, times, count, fault);
    if (n->kind == YAML_LIST)
        return times_of_list(n, times, count, fault);
    return yaml_fault(n, fault, "%s: a list of times, or {from, to, every}, is needed",
                      n->key ? n->key : "times");
}

static enum status read_samples(const struct yaml_node *root, struct runfile *out,
                                struct fault *fault) {
    const struct yaml_node *samples = yaml_get(root, "samples");
    const struct yaml_node *particles = yaml_get(root, "particle_samples");
    enum status status = runfile_times(samples, &out->samples, &out->sample_count, fault);
    enum status other = runfile_times(particles ? particles : samples, &out->particle_samples,
                                      &out->particle_sample_count, fault);
    return status != STATUS_OK ? status : other;
}

/* -- a run file ----------------------------------------------------------------- */

/* Does real path `file` lie below real folder `folder`? */
static bool lies_below(const char *file, const char *folder) {
    size_t length = strlen(folder);
    if (length == 1) /* the root */
        return true;
    return strncmp(file, folder, length) == 0 && file[length] == '/';
}

/* Name -> path to open: in the folder of the run file, below it, or below its
 * parent through one leading "../"; symbolic links must not lead out of there. */
static enum status resolve_start(const char *path, const struct yaml_node *n, struct runfile *out,
                                 struct fault *fault) {
    const char *name = n->text;
    const char *rest = strncmp(name, "../", 3) == 0 ? name + 3 : name;
    if (!file_name_is_inside(rest))
        return yaml_fault(n, fault, "start_file: '%.200s' does not stay inside the run's folders",
                          name);
    char *copy = strdup(path), *real = NULL, *top = NULL, *above = NULL;
    enum status status = STATUS_OK;
    out->start_file = copy ? file_join(dirname(copy), name) : NULL;
    above = out->start_file ? file_join(copy, "..") : NULL;
    if (above == NULL) {
        status = no_memory(n, fault);
        goto end;
    }
    real = realpath(out->start_file, NULL);
    top = realpath(above, NULL);
    if (real == NULL || top == NULL)
        status = fault_add(fault, STATUS_NOT_FOUND, "%s:%zu:%zu: start_file: %s: no such file",
                           n->file, n->line, n->column, out->start_file);
    else if (!lies_below(real, top))
        status = yaml_fault(n, fault, "start_file: '%.200s' leads out of the run's folders", name);
end:
    free(copy);
    free(real);
    free(top);
    free(above);
    return status;
}

static enum status read_datasets(const struct yaml_node *list, struct runfile *out,
                                 struct fault *fault) {
    if (list->count == 0)
        return yaml_fault(list, fault, "datasets: none is asked for");
    out->datasets = calloc(list->count, sizeof *out->datasets);
    if (out->datasets == NULL)
        return no_memory(list, fault);
    enum status status = STATUS_OK;
    for (size_t i = 0; i < list->count; i++) {
        enum status found = yaml_string(&list->child[i], &out->datasets[i], fault);
        if (found == STATUS_OK && !file_name_is_inside(out->datasets[i]))
            found = yaml_fault(&list->child[i], fault, "datasets: '%.80s' is no dataset's name",
                               out->datasets[i]);
        if (found != STATUS_OK)
            status = found;
    }
    out->dataset_count = list->count;
    return status;
}

static enum status read_run(const char *path, const struct yaml_node *root, struct runfile *out,
                            struct fault *fault) {
    const struct yaml_node *format = yaml_get(root, "format");
    if (format->kind != YAML_SCALAR || strcmp(format->text, "bedcheck-run 1") != 0)
        return yaml_fault(format, fault,
                          "format: not 'bedcheck-run 1', which is all that is known");
    if (schema_check(root, "run file", RUN_FIELDS, LENGTH(RUN_FIELDS), fault) != STATUS_OK)
        return STATUS_BAD_INPUT;
    out->case_name = yaml_get(root, "case")->text;
    out->point = yaml_get(root, "point")->text;
    out->model = yaml_get(root, "model")->text;
    out->parameters = yaml_get(root, "parameters");
    enum status status = read_samples(root, out, fault);
    enum status other = read_datasets(yaml_get(root, "datasets"), out, fault);
    if (status == STATUS_OK)
        status = other;
    const struct yaml_node *start = yaml_get(root, "start_file");
    if (start != NULL) {
        other = resolve_start(path, start, out, fault);
        if (status == STATUS_OK)
            status = other;
    }
    return status;
}

/* -- a case file, by hand -------------------------------------------------------- */

/* The value of the swept parameter that is run, and a line about it. */
static enum status choose_first(const struct yaml_node *list, struct yaml_node *chosen,
                                FILE *notice, struct fault *fault) {
    if (list->kind != YAML_LIST || list->count == 0)
        return yaml_fault(list, fault, "%s: a list of values to sweep is needed", list->key);
    *chosen = list->child[0];
    chosen->key = list->key;
    chosen->key_line = list->key_line;
    chosen->key_column = list->key_column;
    bool scalar = chosen->kind == YAML_SCALAR;
    fprintf(notice, "%s%s = %s (first of %zu)", ftell(notice) > 0 ? "\n" : "", list->key,
            scalar ? chosen->text : "[...]", list->count);
    return STATUS_OK;
}

/* The case's parameters, with the first value of everything that is swept. */
static enum status merge_sweep(const struct yaml_node *parameters, const struct yaml_node *sweep,
                               struct runfile *out, struct fault *fault) {
    size_t fixed = parameters ? parameters->count : 0, used = 0, size;
    struct yaml_node *map = calloc(1, sizeof *map);
    out->merged = map;
    FILE *notice = open_memstream(&out->notice, &size);
    if (map != NULL)
        map->child = calloc(fixed + sweep->count + 1, sizeof *map->child);
    enum status status = STATUS_OK;
    if (map == NULL || map->child == NULL || notice == NULL) {
        status = no_memory(sweep, fault);
        goto end;
    }
    for (size_t i = 0; i < fixed; i++)
        if (yaml_get(sweep, parameters->child[i].key) == NULL)
            map->child[used++] = parameters->child[i];
    for (size_t i = 0; i < sweep->count && status == STATUS_OK; i++)
        status = choose_first(&sweep->child[i], &map->child[used++], notice, fault);
    map->kind = YAML_MAP;
    map->file = sweep->file;
    map->key = "parameters";
    map->line = parameters ? parameters->line : sweep->line;
    map->column = parameters ? parameters->column : sweep->column;
    map->count = used;
    out->parameters = map;
end:
    if (notice != NULL)
        fclose(notice);
    return status;
}

static enum status read_case(const struct yaml_node *root, struct runfile *out,
                             struct fault *fault) {
    if (schema_check(root, "case", CASE_FIELDS, LENGTH(CASE_FIELDS), fault) != STATUS_OK)
        return STATUS_BAD_INPUT;
    const struct yaml_node *start = yaml_get(root, "start");
    if (start != NULL)
        return yaml_fault(start, fault,
                          "start: this case starts from the result of another; use bedcheck run");
    out->case_name = yaml_get(root, "name")->text;
    out->model = yaml_get(root, "model")->text;
    out->point = "first";
    out->parameters = yaml_get(root, "parameters");
    const struct yaml_node *sweep = yaml_get(root, "sweep");
    enum status status = read_samples(root, out, fault);
    if (status == STATUS_OK && sweep != NULL && sweep->count > 0)
        status = merge_sweep(out->parameters, sweep, out, fault);
    return status;
}

enum status runfile_load(const char *path, struct runfile *out, struct fault *fault) {
    *out = (struct runfile){0};
    enum status status = yaml_load(path, YAML_CASE_MAX_BYTES, &out->document, fault);
    if (status != STATUS_OK)
        return status;
    const struct yaml_node *root = yaml_root(out->document);
    if (yaml_get(root, "format") != NULL)
        status = read_run(path, root, out, fault);
    else if (yaml_get(root, "name") != NULL && yaml_get(root, "model") != NULL)
        status = read_case(root, out, fault);
    else
        status = yaml_fault(root, fault,
                            "neither a run file (format: bedcheck-run 1) nor a case (name, model)");
    if (status != STATUS_OK)
        runfile_free(out);
    return status;
}

void runfile_free(struct runfile *r) {
    yaml_free(r->document);
    free(r->samples);
    free(r->particle_samples);
    free(r->datasets);
    free(r->start_file);
    free(r->notice);
    if (r->merged != NULL)
        free(r->merged->child);
    free(r->merged);
    *r = (struct runfile){0};
}

bool runfile_wants(const struct runfile *r, const char *dataset) {
    for (size_t i = 0; i < r->dataset_count; i++)
        if (strcmp(r->datasets[i], dataset) == 0)
            return true;
    return r->dataset_count == 0;
}
