#include "validation/reference_curve.h"

#include "common/file.h"
#include "common/h5.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const size_t MAX_VALUES = 1 << 20;

static enum status check_curve(const char *path, const struct reference_curve *c,
                               struct fault *fault) {
    for (size_t i = 0; i < c->count; i++) {
        if (!isfinite(c->x[i]) || !isfinite(c->mean[i]) || !isfinite(c->deviation[i]) ||
            c->deviation[i] < 0)
            return fault_set(fault, STATUS_BAD_INPUT, "%s: entry %zu is no number", path, i);
        if (i > 0 && !(c->x[i] > c->x[i - 1]))
            return fault_set(fault, STATUS_BAD_INPUT, "%s: x does not increase at entry %zu", path,
                             i);
    }
    return c->count == 0 ? fault_set(fault, STATUS_BAD_INPUT, "%s: an empty curve", path)
                         : STATUS_OK;
}

enum status reference_curve_write(const char *path, const struct reference_curve *c,
                                  struct digest *out, struct fault *fault) {
    const int64_t seeds = (int64_t)c->seeds;
    const size_t one = 1;
    struct h5_writer *w = NULL;
    enum status status = check_curve(path, c, fault);
    if (status == STATUS_OK)
        status = h5_create(path, &w, fault);
    if (status == STATUS_OK)
        status = h5_write(w, "x", H5_REAL, 1, &c->count, c->x, "1", fault);
    if (status == STATUS_OK)
        status = h5_write(w, "mean", H5_REAL, 1, &c->count, c->mean, "1", fault);
    if (status == STATUS_OK)
        status = h5_write(w, "deviation", H5_REAL, 1, &c->count, c->deviation, "1", fault);
    if (status == STATUS_OK)
        status = h5_write(w, "seeds", H5_INTEGER, 1, &one, &seeds, "1", fault);
    if (status != STATUS_OK) {
        h5_discard(w);
        return status;
    }
    status = h5_commit(w, fault);
    return status == STATUS_OK ? digest_file(path, out, fault) : status;
}

static enum status read_column(struct h5_reader *r, const char *name, struct arena *a,
                               const double **out, size_t *count, struct fault *fault) {
    double *value = NULL;
    enum status status = h5_read(r, name, MAX_VALUES, &value, count, fault);
    double *kept = status == STATUS_OK ? arena_take(a, *count, sizeof *kept) : NULL;
    if (status == STATUS_OK && kept == NULL)
        status = fault_set(fault, STATUS_NO_MEMORY, "%s: out of memory", name);
    if (status == STATUS_OK && *count > 0)
        memcpy(kept, value, *count * sizeof *kept);
    free(value);
    *out = kept;
    return status;
}

static enum status read_all(struct h5_reader *r, const char *path, struct arena *a,
                            struct reference_curve *out, struct fault *fault) {
    size_t x = 0, mean = 0, deviation = 0;
    double seeds = 0;
    enum status status = read_column(r, "x", a, &out->x, &x, fault);
    if (status == STATUS_OK)
        status = read_column(r, "mean", a, &out->mean, &mean, fault);
    if (status == STATUS_OK)
        status = read_column(r, "deviation", a, &out->deviation, &deviation, fault);
    if (status == STATUS_OK)
        status = h5_read_exactly(r, "seeds", 1, &seeds, fault);
    if (status != STATUS_OK)
        return status;
    if (x != mean || x != deviation || !(seeds >= 2) || seeds > 1e9)
        return fault_set(fault, STATUS_BAD_INPUT, "%s: not a curve of references", path);
    out->count = x;
    out->seeds = (size_t)seeds;
    return check_curve(path, out, fault);
}

enum status reference_curve_read(const char *folder, const char *hex, struct arena *a,
                                 struct reference_curve *out, struct fault *fault) {
    const char *path = arena_text(a, "%s/curves/%s.h5", folder, hex);
    struct h5_reader *r = NULL;
    struct digest found;
    *out = (struct reference_curve){0};
    if (path == NULL)
        return fault_set(fault, STATUS_NO_MEMORY, "%s: out of memory", folder);
    enum status status = digest_file(path, &found, fault);
    if (status == STATUS_OK && strcmp(found.hex, hex) != 0)
        status =
            fault_set(fault, STATUS_BAD_INPUT,
                      "%s: its content does not fit its name: its digest is %s", path, found.hex);
    if (status == STATUS_OK)
        status = h5_open(path, &r, fault);
    if (status == STATUS_OK)
        status = read_all(r, path, a, out, fault);
    h5_close(r);
    return status;
}
