/* h5.c -- the writer of h5.h; the reader is in h5_read.c. */
#include "common/h5.h"

#include "common/file.h"
#include "common/h5_common.h"

#include <assert.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

struct h5_writer {
    hid_t file;
    char *path, *temporary;
};

/* Samples of a small quantity share a chunk of about this many values. */
enum { CHUNK_VALUES = 64 };

static hid_t file_type(enum h5_type type) {
    return type == H5_REAL ? H5T_IEEE_F64LE : H5T_STD_I64LE;
}

static hid_t memory_type(enum h5_type type) {
    return type == H5_REAL ? H5T_NATIVE_DOUBLE : H5T_NATIVE_INT64;
}

/* HDF5 1.8's format whatever the library, no dates, no object left open at the end. */
static hid_t create_file(const char *path) {
    hid_t access = H5Pcreate(H5P_FILE_ACCESS), creation = H5Pcreate(H5P_FILE_CREATE);
    hid_t file = -1;
    if (access >= 0 && creation >= 0 && H5Pset_obj_track_times(creation, 0) >= 0 &&
        H5Pset_libver_bounds(access, H5F_LIBVER_V18, H5F_LIBVER_V18) >= 0 &&
        H5Pset_fclose_degree(access, H5F_CLOSE_STRONG) >= 0)
        file = H5Fcreate(path, H5F_ACC_EXCL, creation, access);
    if (file >= 0) { /* closing forgets the message of a failure: leave it for the caller */
        H5Pclose(access);
        H5Pclose(creation);
    }
    return file;
}

enum status h5_create(const char *path, struct h5_writer **out, struct fault *fault) {
    *out = NULL;
    h5_common_start();
    struct h5_writer *w = calloc(1, sizeof *w);
    if (w != NULL) {
        w->file = -1;
        w->path = strdup(path);
        w->temporary = file_temporary(path);
    }
    if (w == NULL || w->path == NULL || w->temporary == NULL) {
        h5_discard(w);
        return fault_set(fault, STATUS_NO_MEMORY, "%s: no memory", path);
    }
    unlink(w->temporary); /* left by a process of the same number that was killed */
    w->file = create_file(w->temporary);
    if (w->file < 0) {
        h5_common_fault(fault, path, "cannot be made");
        h5_discard(w);
        return fault->status;
    }
    *out = w;
    return STATUS_OK;
}

static enum status write_fault(const struct h5_writer *w, const char *name, struct fault *fault) {
    h5_common_fault(fault, name, "cannot be written");
    return fault_within(fault, "%s", w->path);
}

/* Make the groups that lead to `name`; with `all`, the last part is a group as well. */
static enum status make_groups(struct h5_writer *w, const char *name, bool all,
                               struct fault *fault) {
    char part[512];
    for (size_t i = 1; i <= strlen(name); i++) {
        if (name[i] != '/' && (name[i] != '\0' || !all))
            continue;
        if (i >= sizeof part)
            return fault_set(fault, STATUS_BAD_INPUT, "%s: %s: name too long", w->path, name);
        memcpy(part, name, i);
        part[i] = '\0';
        htri_t there = H5Lexists(w->file, part, H5P_DEFAULT);
        if (there > 0)
            continue;
        hid_t creation = H5Pcreate(H5P_GROUP_CREATE);
        H5Pset_obj_track_times(creation, 0);
        hid_t group = H5Gcreate2(w->file, part, H5P_DEFAULT, creation, H5P_DEFAULT);
        if (group < 0)
            return write_fault(w, part, fault);
        H5Gclose(group);
        H5Pclose(creation);
    }
    return STATUS_OK;
}

/* Attribute `name` of an open object: `count` values, or one scalar where count is 1. */
static bool set_attribute(hid_t object, const char *name, hid_t stored, hid_t given,
                          const void *values, size_t count) {
    hsize_t size = count;
    if (H5Aexists(object, name) > 0 && H5Adelete(object, name) < 0)
        return false;
    hid_t space = count == 1 ? H5Screate(H5S_SCALAR) : H5Screate_simple(1, &size, NULL);
    hid_t attribute = H5Acreate2(object, name, stored, space, H5P_DEFAULT, H5P_DEFAULT);
    bool done = attribute >= 0 && (count == 0 || H5Awrite(attribute, given, values) >= 0);
    if (done) {
        H5Aclose(attribute);
        H5Sclose(space);
    }
    return done;
}

/* A fixed-length string type with room for `length` bytes. */
static hid_t text_type(size_t length, bool plain) {
    hid_t type = H5Tcopy(H5T_C_S1);
    H5Tset_size(type, length > 0 ? length : 1);
    H5Tset_strpad(type, H5T_STR_NULLPAD);
    H5Tset_cset(type, plain ? H5T_CSET_ASCII : H5T_CSET_UTF8);
    return type;
}

static bool is_ascii(const char *text) {
    for (; *text != '\0'; text++)
        if ((unsigned char)*text >= 0x80)
            return false;
    return true;
}

static bool set_text(hid_t object, const char *name, const char *text) {
    hid_t type = text_type(strlen(text), is_ascii(text));
    bool done = set_attribute(object, name, type, type, text, 1);
    if (done)
        H5Tclose(type);
    return done;
}

/* A dataset with its unit.  max_dims NULL: fixed.  chunk NULL: contiguous. */
static hid_t make_dataset(struct h5_writer *w, const char *name, enum h5_type type, int rank,
                          const hsize_t *dims, const hsize_t *max_dims, const hsize_t *chunk,
                          const char *unit) {
    hid_t creation = H5Pcreate(H5P_DATASET_CREATE);
    H5Pset_obj_track_times(creation, 0);
    H5Pset_fill_time(creation, H5D_FILL_TIME_ALLOC); /* no stray bytes in half-filled chunks */
    if (chunk != NULL) {
        H5Pset_chunk(creation, rank, chunk);
        H5Pset_fletcher32(creation);
    }
    hid_t space = H5Screate_simple(rank, dims, max_dims);
    hid_t dataset =
        H5Dcreate2(w->file, name, file_type(type), space, H5P_DEFAULT, creation, H5P_DEFAULT);
    if (dataset < 0 || !set_text(dataset, "unit", unit))
        return -1;
    H5Sclose(space);
    H5Pclose(creation);
    return dataset;
}

enum status h5_write(struct h5_writer *w, const char *name, enum h5_type type, int rank,
                     const size_t *dims, const void *data, const char *unit, struct fault *fault) {
    assert(rank >= 0 && rank <= H5_MAX_RANK);
    hsize_t size[H5_MAX_RANK] = {0}, total = 1;
    for (int i = 0; i < rank; i++)
        total *= size[i] = dims[i];
    enum status status = make_groups(w, name, false, fault);
    if (status != STATUS_OK)
        return status;
    /* One chunk, for the sake of its checksum; HDF5 allows chunks below 4 GB. */
    bool chunked = rank > 0 && total > 0 && total < ((hsize_t)1 << 28);
    hid_t dataset = make_dataset(w, name, type, rank, size, NULL, chunked ? size : NULL, unit);
    if (dataset < 0 || (total > 0 && H5Dwrite(dataset, memory_type(type), H5S_ALL, H5S_ALL,
                                              H5P_DEFAULT, data) < 0))
        return write_fault(w, name, fault);
    H5Dclose(dataset);
    return STATUS_OK;
}

/* -- time series ------------------------------------------------------------ */

/* Samples in GROUP/part, or 0 when there is no such dataset; *dataset is open or -1. */
static hsize_t open_series(struct h5_writer *w, const char *path, hid_t *dataset) {
    hsize_t dims[H5_MAX_RANK + 1] = {0};
    *dataset = -1;
    if (H5Lexists(w->file, path, H5P_DEFAULT) <= 0)
        return 0;
    *dataset = H5Dopen2(w->file, path, H5P_DEFAULT);
    hid_t space = H5Dget_space(*dataset);
    H5Sget_simple_extent_dims(space, dims, NULL);
    H5Sclose(space);
    return dims[0];
}

static hid_t make_series(struct h5_writer *w, const char *path, enum h5_type type, int rank,
                         const size_t *dims, const char *unit) {
    hsize_t size[H5_MAX_RANK + 1] = {0}, limit[H5_MAX_RANK + 1] = {H5S_UNLIMITED};
    hsize_t chunk[H5_MAX_RANK + 1] = {0}, values = 1;
    for (int i = 0; i < rank; i++) {
        size[i + 1] = limit[i + 1] = dims[i];
        chunk[i + 1] = dims[i] > 0 ? dims[i] : 1; /* a run may have no grains at all */
        values *= chunk[i + 1];
    }
    chunk[0] = values < CHUNK_VALUES ? CHUNK_VALUES / values : 1;
    return make_dataset(w, path, type, rank + 1, size, limit, chunk, unit);
}

/* Write one sample at `index`, one past the last of the dataset. */
static bool extend(hid_t dataset, enum h5_type type, hsize_t index, const void *data) {
    hsize_t dims[H5_MAX_RANK + 1] = {0}, start[H5_MAX_RANK + 1] = {index};
    hid_t space = H5Dget_space(dataset);
    int rank = H5Sget_simple_extent_dims(space, dims, NULL);
    H5Sclose(space);
    dims[0] = index + 1;
    if (rank < 1 || H5Dset_extent(dataset, dims) < 0)
        return false;
    dims[0] = 1;
    space = H5Dget_space(dataset);
    hid_t memory = H5Screate_simple(rank, dims, NULL);
    bool done = H5Sselect_hyperslab(space, H5S_SELECT_SET, start, NULL, dims, NULL) >= 0 &&
                H5Dwrite(dataset, memory_type(type), memory, space, H5P_DEFAULT, data) >= 0;
    if (done) {
        H5Sclose(memory);
        H5Sclose(space);
    }
    return done;
}

/* Is the value that `dataset` holds at `index` this one? */
static bool holds(hid_t dataset, enum h5_type type, hsize_t index, const void *value) {
    hsize_t one = 1;
    union {
        double real;
        int64_t integer;
    } there;
    hid_t space = H5Dget_space(dataset), memory = H5Screate_simple(1, &one, NULL);
    bool same = H5Sselect_hyperslab(space, H5S_SELECT_SET, &index, NULL, &one, NULL) >= 0 &&
                H5Dread(dataset, memory_type(type), memory, space, H5P_DEFAULT, &there) >= 0 &&
                memcmp(&there, value, sizeof there) == 0;
    H5Sclose(memory);
    H5Sclose(space);
    return same;
}

/* `step` or `time` of a series whose value has `count` samples.  It may be a
 * hard link to that of another series, which has then written this sample already. */
static enum status append_clock(struct h5_writer *w, const char *path, enum h5_type type,
                                hsize_t count, const void *value, const char *unit,
                                struct fault *fault) {
    hid_t dataset;
    hsize_t there = open_series(w, path, &dataset);
    bool done;
    if (dataset < 0)
        dataset = make_series(w, path, type, 0, NULL, unit);
    if (there == count + 1 && !holds(dataset, type, count, value))
        return fault_set(fault, STATUS_BAD_INPUT,
                         "%s: %s: sample %llu has another value in the series it is linked to",
                         w->path, path, (unsigned long long)count);
    done = dataset >= 0 && (there == count + 1 || extend(dataset, type, count, value));
    if (!done)
        return write_fault(w, path, fault);
    H5Dclose(dataset);
    return STATUS_OK;
}

/* Does the open series take samples of this shape? */
static bool same_shape(hid_t dataset, int rank, const size_t *dims) {
    hsize_t size[H5_MAX_RANK + 1] = {0};
    hid_t space = H5Dget_space(dataset);
    int there = H5Sget_simple_extent_dims(space, size, NULL);
    H5Sclose(space);
    bool same = there == rank + 1;
    for (int i = 0; same && i < rank; i++)
        same = size[i + 1] == dims[i];
    return same;
}

enum status h5_append(struct h5_writer *w, const char *name, enum h5_type type, int rank,
                      const size_t *dims, const void *data, const char *unit, long long step,
                      double time, const char *time_unit, struct fault *fault) {
    assert(rank >= 0 && rank <= H5_MAX_RANK);
    char path[512];
    int64_t number = step;
    if (strlen(name) + sizeof "/value" > sizeof path)
        return fault_set(fault, STATUS_BAD_INPUT, "%s: %s: name too long", w->path, name);
    enum status status = make_groups(w, name, true, fault);
    if (status != STATUS_OK)
        return status;
    hid_t value;
    snprintf(path, sizeof path, "%s/value", name);
    hsize_t count = open_series(w, path, &value);
    if (value < 0)
        value = make_series(w, path, type, rank, dims, unit);
    else if (!same_shape(value, rank, dims))
        return fault_set(fault, STATUS_BAD_INPUT, "%s: %s: a sample of another shape", w->path,
                         name);
    if (value < 0 || !extend(value, type, count, data))
        return write_fault(w, name, fault);
    H5Dclose(value);
    snprintf(path, sizeof path, "%s/step", name);
    status = append_clock(w, path, H5_INTEGER, count, &number, "1", fault);
    if (status != STATUS_OK)
        return status;
    snprintf(path, sizeof path, "%s/time", name);
    return append_clock(w, path, H5_REAL, count, &time, time_unit, fault);
}

static bool is_same_object(hid_t file, const char *a, const char *b) {
    H5O_info_t first, second;
    return H5Lexists(file, b, H5P_DEFAULT) > 0 &&
           H5Oget_info_by_name2(file, a, &first, H5O_INFO_BASIC, H5P_DEFAULT) >= 0 &&
           H5Oget_info_by_name2(file, b, &second, H5O_INFO_BASIC, H5P_DEFAULT) >= 0 &&
           first.addr == second.addr;
}

enum status h5_link(struct h5_writer *w, const char *target, const char *link,
                    struct fault *fault) {
    enum status status = make_groups(w, link, false, fault);
    if (status != STATUS_OK)
        return status;
    if (is_same_object(w->file, target, link))
        return STATUS_OK;
    if (H5Lcreate_hard(w->file, target, w->file, link, H5P_DEFAULT, H5P_DEFAULT) < 0)
        return write_fault(w, link, fault);
    return STATUS_OK;
}

/* -- attributes ------------------------------------------------------------- */

static enum status write_attribute(struct h5_writer *w, const char *object, const char *name,
                                   hid_t stored, hid_t given, const void *values, size_t count,
                                   struct fault *fault) {
    enum status status = strcmp(object, "/") == 0 ? STATUS_OK : make_groups(w, object, true, fault);
    if (status != STATUS_OK)
        return status;
    hid_t open = H5Oopen(w->file, object, H5P_DEFAULT);
    if (open < 0 || !set_attribute(open, name, stored, given, values, count)) {
        write_fault(w, object, fault);
        return fault_within(fault, "attribute %s", name);
    }
    H5Oclose(open);
    return STATUS_OK;
}

enum status h5_attribute_text(struct h5_writer *w, const char *object, const char *name,
                              const char *text, struct fault *fault) {
    hid_t type = text_type(strlen(text), is_ascii(text));
    enum status status = write_attribute(w, object, name, type, type, text, 1, fault);
    H5Tclose(type);
    return status;
}

enum status h5_attribute_texts(struct h5_writer *w, const char *object, const char *name,
                               const char *const *texts, size_t count, struct fault *fault) {
    size_t longest = 1;
    bool plain = true;
    for (size_t i = 0; i < count; i++) {
        longest = strlen(texts[i]) > longest ? strlen(texts[i]) : longest;
        plain = plain && is_ascii(texts[i]);
    }
    char *joined = calloc(count + 1, longest);
    if (joined == NULL)
        return fault_set(fault, STATUS_NO_MEMORY, "%s: no memory", w->path);
    for (size_t i = 0; i < count; i++)
        memcpy(joined + i * longest, texts[i], strlen(texts[i]));
    hid_t type = text_type(longest, plain);
    enum status status = write_attribute(w, object, name, type, type, joined, count, fault);
    H5Tclose(type);
    free(joined);
    return status;
}

enum status h5_attribute_integers(struct h5_writer *w, const char *object, const char *name,
                                  const int *values, size_t count, struct fault *fault) {
    return write_attribute(w, object, name, H5T_STD_I32LE, H5T_NATIVE_INT, values, count, fault);
}

enum status h5_attribute_reals(struct h5_writer *w, const char *object, const char *name,
                               const double *values, size_t count, struct fault *fault) {
    return write_attribute(w, object, name, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, values, count,
                           fault);
}

/* -- the end ---------------------------------------------------------------- */

enum status h5_commit(struct h5_writer *w, struct fault *fault) {
    enum status status = STATUS_OK;
    if (H5Fflush(w->file, H5F_SCOPE_GLOBAL) < 0)
        status = h5_common_fault(fault, w->path, "cannot be written");
    else if (H5Fclose(w->file) < 0)
        status = h5_common_fault(fault, w->path, "cannot be closed");
    else {
        w->file = -1;
        status = file_replace(w->temporary, w->path, fault);
    }
    h5_discard(w);
    return status;
}

void h5_discard(struct h5_writer *w) {
    if (w == NULL)
        return;
    if (w->file >= 0)
        H5Fclose(w->file);
    if (w->temporary != NULL)
        unlink(w->temporary);
    free(w->path);
    free(w->temporary);
    free(w);
}
