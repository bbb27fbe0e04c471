#include "solver/result.h"

#include "common/build.h"
#include "common/schema.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static enum status write_header(struct h5_writer *w, struct fault *fault) {
    if (h5_attribute_integers(w, "h5md", "version", (int[]){1, 1}, 2, fault) ||
        h5_attribute_text(w, "h5md/author", "name", "bedcheck", fault) ||
        h5_attribute_text(w, "h5md/creator", "name", "bedsim", fault) ||
        h5_attribute_text(w, "h5md/creator", "version", build_version(), fault))
        return fault->status;
    return STATUS_OK;
}

static enum status write_parameter(struct h5_writer *w, const struct parameter_set *p, size_t i,
                                   struct fault *fault) {
    const struct parameter *row = &p->table[i];
    if (row->type == PARAMETER_CHOICE)
        return h5_attribute_text(w, "parameters", row->name, row->choices[(size_t)p->real[i]],
                                 fault);
    if (row->type == PARAMETER_REAL_LIST && p->length[i] == 0)
        return STATUS_OK;
    if (row->type == PARAMETER_REAL_LIST)
        return h5_attribute_reals(w, "parameters", row->name, p->list[i], p->length[i], fault);
    return h5_attribute_reals(w, "parameters", row->name, &p->real[i], 1, fault);
}

enum status result_begin(struct h5_writer *w, const struct model *m, const struct parameter_set *p,
                         uint64_t seed, struct fault *fault) {
    double seed_value = (double)seed;
    if (write_header(w, fault) || h5_attribute_text(w, "parameters", "model", m->name, fault) ||
        h5_attribute_reals(w, "parameters", "seed", &seed_value, 1, fault))
        return fault->status;
    for (size_t i = 0; i < p->count; i++)
        if (write_parameter(w, p, i, fault) != STATUS_OK)
            return fault->status;
    return STATUS_OK;
}

enum status result_sample(struct h5_writer *w, const struct model *m, void *state,
                          const struct runfile *run, enum dataset_when when, struct fault *fault) {
    for (const struct dataset *d = m->datasets; d->name; d++)
        if (d->when == when && runfile_wants(run, d->name) &&
            m->observe(state, d->name, w, fault) != STATUS_OK)
            return fault->status;
    return STATUS_OK;
}

static bool offers(const struct model *m, const char *name) {
    for (const struct dataset *d = m->datasets; d->name; d++)
        if (strcmp(d->name, name) == 0)
            return true;
    return false;
}

enum status result_check_datasets(const struct model *m, const struct runfile *run,
                                  const char *path, struct fault *fault) {
    for (size_t i = 0; i < run->dataset_count; i++)
        if (!offers(m, run->datasets[i]))
            fault_add(fault, STATUS_BAD_INPUT,
                      "%s: datasets: '%s' is none that %s can write (see: bedsim datasets %s)",
                      path, run->datasets[i], m->name, m->name);
    return fault->status;
}

char *result_record_path(const char *result_path) {
    size_t length = strlen(result_path);
    if (length > 3 && strcmp(result_path + length - 3, ".h5") == 0)
        length -= 3;
    char *out = NULL;
    return asprintf(&out, "%.*s.run.json", (int)length, result_path) < 0 ? NULL : out;
}
