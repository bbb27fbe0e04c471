/* h5_read.c -- the reader of h5.h; the writer is in h5.c.
 *
 * A file may come from anywhere.  It is walked once when it is opened: links
 * first (an external link is never followed), then every object's creation
 * list.  What remains is plain datasets in this one file.
 */
#include "common/file.h"
#include "common/h5.h"
#include "common/h5_common.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_OBJECTS = 10000, MAX_CHUNK_VALUES = 1 << 20 };

struct h5_reader {
    hid_t file;
    char *path;
};

/* What the walk found wrong, if anything. */
struct walk {
    struct fault *fault;
    const char *path;
    int links, objects;
};

static herr_t refuse(const struct walk *walk, const char *name, const char *why) {
    fault_set(walk->fault, STATUS_BAD_INPUT, "%s: %.200s: %s", walk->path, name, why);
    return 1; /* ends the walk */
}

static herr_t look_at_link(hid_t group, const char *name, const H5L_info_t *info, void *data) {
    struct walk *walk = data;
    (void)group;
    if (++walk->links > MAX_OBJECTS)
        return refuse(walk, name, "more than 10000 links in a file are refused");
    if (info->type == H5L_TYPE_SOFT)
        return refuse(walk, name, "soft links are refused");
    if (info->type != H5L_TYPE_HARD)
        return refuse(walk, name, "external and user-defined links are refused");
    return 0;
}

/* Why a dataset with this creation list is refused, or NULL. */
static const char *layout_fault(hid_t creation) {
    H5D_layout_t layout = H5Pget_layout(creation);
    if (layout == H5D_VIRTUAL)
        return "virtual datasets are refused";
    if (layout != H5D_COMPACT && layout != H5D_CONTIGUOUS && layout != H5D_CHUNKED)
        return "an unknown layout is refused";
    if (layout == H5D_CONTIGUOUS && H5Pget_external_count(creation) != 0)
        return "external storage is refused";
    int filters = layout == H5D_CHUNKED ? H5Pget_nfilters(creation) : 0;
    if (filters < 0)
        return "its filters cannot be read";
    for (int i = 0; i < filters; i++) {
        unsigned flags, config;
        size_t values = 0;
        H5Z_filter_t id =
            H5Pget_filter2(creation, (unsigned)i, &flags, &values, NULL, 0, NULL, &config);
        if (id != H5Z_FILTER_DEFLATE && id != H5Z_FILTER_SHUFFLE && id != H5Z_FILTER_FLETCHER32)
            return "filters other than deflate, shuffle and fletcher32 are refused";
    }
    return NULL;
}

static herr_t look_at_object(hid_t root, const char *name, const H5O_info_t *info, void *data) {
    struct walk *walk = data;
    if (++walk->objects > MAX_OBJECTS)
        return refuse(walk, name, "more than 10000 objects in a file are refused");
    if (info->type == H5O_TYPE_GROUP)
        return 0;
    if (info->type != H5O_TYPE_DATASET)
        return refuse(walk, name, "only groups and datasets are accepted");
    hid_t dataset = H5Dopen2(root, name, H5P_DEFAULT);
    if (dataset < 0)
        return refuse(walk, name, "cannot be opened");
    hid_t creation = H5Dget_create_plist(dataset);
    const char *why = creation < 0 ? "its layout cannot be read" : layout_fault(creation);
    H5Pclose(creation);
    H5Dclose(dataset);
    return why == NULL ? 0 : refuse(walk, name, why);
}

/* Both walks.  Their own failure (a damaged file) is told as HDF5 tells it. */
static enum status inspect(const struct h5_reader *r, struct fault *fault) {
    struct walk walk = {.fault = fault, .path = r->path};
    herr_t found = H5Lvisit(r->file, H5_INDEX_NAME, H5_ITER_INC, look_at_link, &walk);
    if (found == 0)
        found =
            H5Ovisit2(r->file, H5_INDEX_NAME, H5_ITER_INC, look_at_object, &walk, H5O_INFO_BASIC);
    if (found > 0)
        return STATUS_BAD_INPUT;
    return found == 0 ? STATUS_OK : h5_common_fault(fault, r->path, "damaged");
}

enum status h5_open(const char *path, struct h5_reader **out, struct fault *fault) {
    *out = NULL;
    h5_common_start();
    if (!file_exists(path))
        return fault_set(fault, STATUS_NOT_FOUND, "%s: no such file", path);
    struct h5_reader *r = calloc(1, sizeof *r);
    if (r == NULL || (r->path = strdup(path)) == NULL) {
        free(r);
        return fault_set(fault, STATUS_NO_MEMORY, "%s: no memory", path);
    }
    enum status status = STATUS_OK;
    r->file = H5Fopen(path, H5F_ACC_RDONLY, H5P_DEFAULT);
    if (r->file < 0)
        status = h5_common_fault(fault, path, "not an HDF5 file that can be read");
    else
        status = inspect(r, fault);
    if (status != STATUS_OK) {
        h5_close(r);
        return status;
    }
    *out = r;
    return STATUS_OK;
}

void h5_close(struct h5_reader *r) {
    if (r == NULL)
        return;
    if (r->file >= 0)
        H5Fclose(r->file);
    free(r->path);
    free(r);
}

const char *h5_path(const struct h5_reader *r) {
    return r->path;
}

bool h5_has(const struct h5_reader *r, const char *name) {
    char part[512];
    size_t length = strlen(name);
    if (length == 0 || length >= sizeof part)
        return false;
    /* H5Lexists fails where a group on the way is missing: ask part by part. */
    for (size_t i = 1; i <= length; i++) {
        if (name[i] != '/' && name[i] != '\0')
            continue;
        memcpy(part, name, i);
        part[i] = '\0';
        if (H5Lexists(r->file, part, H5P_DEFAULT) <= 0)
            return false;
    }
    return true;
}

/* An open dataset of numbers with its shape. */
struct array {
    hid_t dataset, space;
    int rank;
    hsize_t dims[H5_MAX_RANK + 1];
    size_t count;
};

static void close_array(struct array *a) {
    if (a->space >= 0)
        H5Sclose(a->space);
    if (a->dataset >= 0)
        H5Dclose(a->dataset);
}

static bool holds_numbers(hid_t dataset) {
    hid_t type = H5Dget_type(dataset);
    H5T_class_t kind = H5Tget_class(type);
    bool fits = (kind == H5T_FLOAT || kind == H5T_INTEGER) && H5Tget_size(type) <= 8;
    H5Tclose(type);
    return fits;
}

/* A chunk is taken into memory whole: it must not be much larger than the data. */
static bool chunk_is_modest(const struct array *a) {
    hsize_t chunk[H5_MAX_RANK + 1], values = 1;
    hid_t creation = H5Dget_create_plist(a->dataset);
    bool modest = true;
    if (H5Pget_layout(creation) == H5D_CHUNKED) {
        modest = H5Pget_chunk(creation, H5_MAX_RANK + 1, chunk) == a->rank;
        for (int i = 0; modest && i < a->rank; i++)
            values *= chunk[i]; /* HDF5 itself keeps a chunk below 4 GB */
        modest = modest && (values <= MAX_CHUNK_VALUES || values / 2 <= a->count);
    }
    H5Pclose(creation);
    return modest;
}

static enum status array_fault(const struct h5_reader *r, const char *name, struct fault *fault,
                               const char *why) {
    return fault_set(fault, STATUS_BAD_INPUT, "%s: %s: %s", r->path, name, why);
}

static enum status open_array(struct h5_reader *r, const char *name, struct array *a,
                              struct fault *fault) {
    *a = (struct array){.dataset = -1, .space = -1, .count = 1};
    if (!h5_has(r, name))
        return fault_set(fault, STATUS_NOT_FOUND, "%s: %s: no such dataset", r->path, name);
    const char *why = NULL;
    a->dataset = H5Dopen2(r->file, name, H5P_DEFAULT);
    if (a->dataset < 0)
        return array_fault(r, name, fault, "not a dataset");
    a->space = H5Dget_space(a->dataset);
    a->rank = H5Sget_simple_extent_ndims(a->space);
    if (a->rank < 0 || a->rank > H5_MAX_RANK)
        why = "has no simple shape of at most four dimensions";
    else if (H5Sget_simple_extent_type(a->space) == H5S_NULL)
        why = "is empty";
    else if (!holds_numbers(a->dataset))
        why = "does not hold numbers of at most 64 bits";
    for (int i = 0; why == NULL && i < a->rank; i++) {
        if (i == 0)
            H5Sget_simple_extent_dims(a->space, a->dims, NULL);
        if (__builtin_mul_overflow(a->count, a->dims[i], &a->count))
            why = "is too large";
    }
    if (why == NULL && !chunk_is_modest(a))
        why = "has chunks much larger than itself";
    if (why == NULL)
        return STATUS_OK;
    close_array(a);
    return array_fault(r, name, fault, why);
}

enum status h5_dims(struct h5_reader *r, const char *name, int *rank, size_t *dims,
                    struct fault *fault) {
    struct array a;
    enum status status = open_array(r, name, &a, fault);
    if (status != STATUS_OK)
        return status;
    *rank = a.rank;
    for (int i = 0; i < H5_MAX_RANK; i++)
        dims[i] = i < a.rank ? a.dims[i] : 0;
    close_array(&a);
    return STATUS_OK;
}

static enum status read_fault(const struct h5_reader *r, const char *name, struct fault *fault) {
    h5_common_fault(fault, name, "cannot be read");
    return fault_within(fault, "%s", r->path);
}

enum status h5_read(struct h5_reader *r, const char *name, size_t max_count, double **out,
                    size_t *count, struct fault *fault) {
    struct array a;
    double *values = NULL;
    *out = NULL;
    enum status status = open_array(r, name, &a, fault);
    if (status != STATUS_OK)
        return status;
    if (a.count > max_count) {
        status = fault_set(fault, STATUS_BAD_INPUT, "%s: %s: %zu values, at most %zu expected",
                           r->path, name, a.count, max_count);
        goto end;
    }
    values = calloc(a.count + 1, sizeof *values);
    if (values == NULL) {
        status = fault_set(fault, STATUS_NO_MEMORY, "%s: %s: no memory for %zu values", r->path,
                           name, a.count);
        goto end;
    }
    if (a.count > 0 &&
        H5Dread(a.dataset, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values) < 0) {
        status = read_fault(r, name, fault);
        goto end;
    }
    *out = values;
    *count = a.count;
    values = NULL;
end:
    free(values);
    close_array(&a);
    return status;
}

enum status h5_read_exactly(struct h5_reader *r, const char *name, size_t count, double *out,
                            struct fault *fault) {
    double *value = NULL;
    size_t found = 0;
    enum status status = h5_read(r, name, count, &value, &found, fault);
    if (status == STATUS_OK && found != count)
        status = fault_set(fault, STATUS_BAD_INPUT, "%s: %s has %zu values, this run needs %zu",
                           r->path, name, found, count);
    if (status == STATUS_OK)
        memcpy(out, value, count * sizeof *out);
    free(value);
    return status;
}

enum status h5_read_slab(struct h5_reader *r, const char *name, size_t index, size_t count,
                         double *out, struct fault *fault) {
    struct array a;
    enum status status = open_array(r, name, &a, fault);
    if (status != STATUS_OK)
        return status;
    size_t slab = 1;
    hsize_t start[H5_MAX_RANK + 1] = {index}, extent[H5_MAX_RANK + 1] = {1};
    for (int i = 1; i < a.rank; i++)
        slab *= extent[i] = a.dims[i];
    if (a.rank < 1 || index >= a.dims[0])
        status = fault_set(fault, STATUS_BAD_INPUT, "%s: %s: no frame %zu", r->path, name, index);
    else if (slab != count)
        status = fault_set(fault, STATUS_BAD_INPUT, "%s: %s: %zu values a frame, %zu expected",
                           r->path, name, slab, count);
    else if (count > 0) {
        hsize_t size = count;
        hid_t memory = H5Screate_simple(1, &size, NULL);
        H5Sselect_hyperslab(a.space, H5S_SELECT_SET, start, NULL, extent, NULL);
        if (H5Dread(a.dataset, H5T_NATIVE_DOUBLE, memory, a.space, H5P_DEFAULT, out) < 0)
            status = read_fault(r, name, fault);
        H5Sclose(memory);
    }
    close_array(&a);
    return status;
}

/* -- attributes ------------------------------------------------------------- */

/* The text of an open attribute, fixed or variable length; NULL if it is none. */
static char *attribute_text(hid_t attribute, hid_t type) {
    hid_t space = H5Aget_space(attribute);
    bool one = H5Sget_simple_extent_type(space) == H5S_SCALAR ||
               (H5Sget_simple_extent_type(space) == H5S_SIMPLE &&
                H5Sget_simple_extent_npoints(space) == 1);
    H5Sclose(space);
    if (!one || H5Tget_class(type) != H5T_STRING)
        return NULL;
    char *text = NULL;
    if (H5Tis_variable_str(type) > 0) {
        char *there = NULL;
        if (H5Aread(attribute, type, &there) >= 0 && there != NULL)
            text = strdup(there);
        H5free_memory(there);
        return text;
    }
    size_t size = H5Tget_size(type);
    text = size < (1 << 16) ? calloc(size + 1, 1) : NULL;
    if (text != NULL && H5Aread(attribute, type, text) < 0) {
        free(text);
        return NULL;
    }
    for (size_t i = size; text != NULL && H5Tget_strpad(type) == H5T_STR_SPACEPAD && i > 0; i--) {
        if (text[i - 1] != ' ')
            break;
        text[i - 1] = '\0';
    }
    return text;
}

/* Open `attribute` of `object`; *found is -1 unless the status is STATUS_OK. */
static enum status open_attribute(struct h5_reader *r, const char *object, const char *attribute,
                                  hid_t *found, struct fault *fault) {
    *found = -1;
    if (strcmp(object, "/") != 0 && !h5_has(r, object))
        return fault_set(fault, STATUS_NOT_FOUND, "%s: %s: no such object", r->path, object);
    hid_t open = H5Oopen(r->file, object, H5P_DEFAULT);
    if (open < 0)
        return read_fault(r, object, fault);
    enum status status = STATUS_OK;
    if (H5Aexists(open, attribute) <= 0)
        status = fault_set(fault, STATUS_NOT_FOUND, "%s: %s: no attribute '%s'", r->path, object,
                           attribute);
    else if ((*found = H5Aopen(open, attribute, H5P_DEFAULT)) < 0)
        status = read_fault(r, object, fault);
    H5Oclose(open);
    return status;
}

enum status h5_read_text(struct h5_reader *r, const char *object, const char *attribute, char *out,
                         size_t size, struct fault *fault) {
    hid_t a;
    enum status status = open_attribute(r, object, attribute, &a, fault);
    if (status != STATUS_OK)
        return status;
    hid_t type = H5Aget_type(a);
    char *text = attribute_text(a, type);
    H5Tclose(type);
    H5Aclose(a);
    if (text == NULL || strlen(text) >= size)
        status = fault_set(fault, STATUS_BAD_INPUT, "%s: %s: attribute '%s' is not a short text",
                           r->path, object, attribute);
    else
        memcpy(out, text, strlen(text) + 1);
    free(text);
    return status;
}

enum status h5_read_reals(struct h5_reader *r, const char *object, const char *attribute,
                          size_t max_count, double **out, size_t *count, struct fault *fault) {
    hid_t a;
    *out = NULL;
    enum status status = open_attribute(r, object, attribute, &a, fault);
    if (status != STATUS_OK)
        return status;
    hid_t type = H5Aget_type(a), space = H5Aget_space(a);
    H5T_class_t kind = H5Tget_class(type);
    hssize_t there = H5Sget_simple_extent_npoints(space);
    bool numbers = (kind == H5T_FLOAT || kind == H5T_INTEGER) && there >= 0;
    H5Tclose(type);
    H5Sclose(space);
    double *values = NULL;
    if (!numbers)
        status = fault_set(fault, STATUS_BAD_INPUT, "%s: %s: attribute '%s' does not hold numbers",
                           r->path, object, attribute);
    else if ((size_t)there > max_count)
        status = fault_set(fault, STATUS_BAD_INPUT,
                           "%s: %s: attribute '%s' has %lld values, at most %zu expected", r->path,
                           object, attribute, (long long)there, max_count);
    else if ((values = calloc((size_t)there + 1, sizeof *values)) == NULL)
        status = fault_set(fault, STATUS_NO_MEMORY, "%s: no memory", r->path);
    else if (there > 0 && H5Aread(a, H5T_NATIVE_DOUBLE, values) < 0)
        status = read_fault(r, attribute, fault);
    H5Aclose(a);
    if (status != STATUS_OK) {
        free(values);
        return status;
    }
    *out = values;
    *count = (size_t)there;
    return STATUS_OK;
}

enum status h5_unit(struct h5_reader *r, const char *name, char *out, size_t size,
                    struct fault *fault) {
    return h5_read_text(r, name, "unit", out, size, fault);
}
