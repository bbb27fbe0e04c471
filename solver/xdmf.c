/* xdmf.c -- see xdmf.h. */
#include "solver/xdmf.h"

#include "common/file.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_FRAMES = 10000000 };

/* A lattice is one site thick: a mesh of two dimensions would lie in the plane of y and z. */
#define ONE_SITE "1 "

struct sidecar {
    struct h5_reader *result;
    const char *base; /* the result's name without folders */
    FILE *out;
    bool found;
};

/* A time series: frames, and the shape of one sample. */
struct shape {
    char name[96]; /* "fields/pressure" */
    size_t frames, dims[H5_MAX_RANK];
    int rank;
};

/* Is NAME/value there?  Then its shape. */
static enum status find_shape(const struct sidecar *s, const char *name, bool *found,
                              struct shape *out, struct fault *fault) {
    char path[128];
    size_t dims[H5_MAX_RANK];
    *out = (struct shape){0};
    snprintf(out->name, sizeof out->name, "%s", name);
    snprintf(path, sizeof path, "%s/value", name);
    *found = h5_has(s->result, path);
    if (!*found)
        return STATUS_OK;
    enum status status = h5_dims(s->result, path, &out->rank, dims, fault);
    if (!status && out->rank < 2)
        status = fault_set(fault, STATUS_BAD_INPUT, "%s: %s has no samples of several values",
                           h5_path(s->result), path);
    if (status)
        return status;
    out->rank--;
    out->frames = dims[0];
    memcpy(out->dims, dims + 1, (size_t)out->rank * sizeof *dims);
    return STATUS_OK;
}

/* -- XML ---------------------------------------------------------------------------- */

static void put_name(FILE *out, const char *text) {
    for (; *text; text++) {
        if (*text == '&')
            fputs("&amp;", out);
        else if (*text == '<')
            fputs("&lt;", out);
        else if (*text == '>')
            fputs("&gt;", out);
        else if (*text == '"')
            fputs("&quot;", out);
        else
            fputc(*text, out);
    }
}

static void put_source(const struct sidecar *s, const char *path, const char *type) {
    fprintf(s->out, " NumberType=\"%s\" Precision=\"8\" Format=\"HDF\">", type);
    put_name(s->out, s->base);
    fprintf(s->out, ":/%s</DataItem>\n", path);
}

/* One frame of a series: its first `kept` dimensions after those of `before`, of the last one a
 * component (-1: all). */
static void put_slab(const struct sidecar *s, const struct shape *a, size_t frame,
                     const char *before, int kept, int component) {
    char path[128];
    int rank = a->rank + 1;
    fprintf(s->out, "        <DataItem ItemType=\"HyperSlab\" Dimensions=\"%s", before);
    for (int i = 0; i < kept; i++)
        fprintf(s->out, "%s%zu", i ? " " : "", a->dims[i]);
    fprintf(s->out, "\">\n          <DataItem Dimensions=\"3 %d\" Format=\"XML\">%zu", rank, frame);
    for (int i = 0; i < a->rank; i++)
        fprintf(s->out, " %d", i == kept && component >= 0 ? component : 0);
    for (int i = 0; i < rank; i++)
        fputs(" 1", s->out);
    fputs(" 1", s->out);
    for (int i = 0; i < a->rank; i++)
        fprintf(s->out, " %zu", i == kept && component >= 0 ? 1 : a->dims[i]);
    fprintf(s->out, "</DataItem>\n          <DataItem Dimensions=\"%zu", a->frames);
    for (int i = 0; i < a->rank; i++)
        fprintf(s->out, " %zu", a->dims[i]);
    fputc('"', s->out);
    snprintf(path, sizeof path, "%s/value", a->name);
    put_source(s, path, "Float");
    fputs("        </DataItem>\n", s->out);
}

/* An attribute of nodes whose grid has `grid` dimensions: itself, or one a component. */
static void put_attribute(const struct sidecar *s, const struct shape *a, size_t frame, int grid) {
    static const char *const suffix[] = {"_x", "_y", "_z"};
    const char *name = strrchr(a->name, '/') + 1;
    int components = a->rank > grid ? (int)a->dims[grid] : 1;
    for (int c = 0; c < components && c < 3; c++) {
        fprintf(s->out,
                "      <Attribute Name=\"%s%s\" AttributeType=\"Scalar\" Center=\"Node\">\n", name,
                components > 1 ? suffix[c] : "");
        put_slab(s, a, frame, grid == 2 ? ONE_SITE : "", grid, components > 1 ? c : -1);
        fputs("      </Attribute>\n", s->out);
    }
}

/* The times of a series: *out[0 .. frames-1], to be freed. */
static enum status read_times(const struct sidecar *s, const struct shape *a, double **out,
                              struct fault *fault) {
    char path[128];
    size_t count = 0;
    snprintf(path, sizeof path, "%s/time", a->name);
    enum status status = h5_read(s->result, path, MAX_FRAMES, out, &count, fault);
    if (!status && count != a->frames)
        status = fault_set(fault, STATUS_BAD_INPUT, "%s: %s: %zu times for %zu samples",
                           h5_path(s->result), path, count, a->frames);
    return status;
}

static void begin_collection(const struct sidecar *s, const char *name) {
    fprintf(s->out, "  <Grid Name=\"%s\" GridType=\"Collection\" CollectionType=\"Temporal\">\n",
            name);
}

/* -- the lattice ------------------------------------------------------------------------ */

static enum status read_pair(const struct sidecar *s, const char *name, double out[2],
                             struct fault *fault) {
    double *values = NULL;
    size_t count = 0;
    enum status status = h5_read_reals(s->result, "fields", name, 2, &values, &count, fault);
    if (!status && count != 2)
        status = fault_set(fault, STATUS_BAD_INPUT, "%s: fields: %s has %zu values, not 2",
                           h5_path(s->result), name, count);
    if (!status)
        memcpy(out, values, 2 * sizeof *out);
    free(values);
    return status;
}

static enum status write_lattice(const struct sidecar *s, const struct shape *field, size_t count,
                                 struct fault *fault) {
    double spacing[2], origin[2], *time = NULL;
    enum status status = read_pair(s, "spacing", spacing, fault);
    if (!status)
        status = read_pair(s, "origin", origin, fault);
    if (!status)
        status = read_times(s, &field[0], &time, fault);
    for (size_t i = 1; !status && i < count; i++)
        if (field[i].frames != field[0].frames || field[i].dims[0] != field[0].dims[0] ||
            field[i].dims[1] != field[0].dims[1])
            status = fault_set(fault, STATUS_BAD_INPUT, "%s: %s and %s differ in shape",
                               h5_path(s->result), field[0].name, field[i].name);
    if (!status)
        begin_collection(s, "fields");
    for (size_t f = 0; !status && f < field[0].frames; f++) {
        fprintf(s->out,
                "    <Grid Name=\"fields %zu\" GridType=\"Uniform\">\n"
                "      <Time Value=\"%.17g\"/>\n"
                "      <Topology TopologyType=\"3DCoRectMesh\" Dimensions=\"" ONE_SITE
                "%zu %zu\"/>\n"
                "      <Geometry GeometryType=\"ORIGIN_DXDYDZ\">\n"
                "        <DataItem Dimensions=\"3\" Format=\"XML\">0 %.17g %.17g</DataItem>\n"
                "        <DataItem Dimensions=\"3\" Format=\"XML\">1 %.17g %.17g</DataItem>\n"
                "      </Geometry>\n",
                f, time[f], field[0].dims[0], field[0].dims[1], origin[0], origin[1], spacing[0],
                spacing[1]);
        for (size_t i = 0; i < count; i++)
            put_attribute(s, &field[i], f, 2);
        fputs("    </Grid>\n", s->out);
    }
    if (!status)
        fputs("  </Grid>\n", s->out);
    free(time);
    return status;
}

static enum status find_lattice(struct sidecar *s, struct fault *fault) {
    static const char *const name[] = {"fields/solid_fraction", "fields/pressure",
                                       "fields/grain_velocity", "fields/collision_virial"};
    enum { NAMES = sizeof name / sizeof *name };
    struct shape field[NAMES];
    size_t count = 0;
    for (size_t i = 0; i < NAMES; i++) {
        bool found;
        enum status status = find_shape(s, name[i], &found, &field[count], fault);
        if (!status && found && field[count].rank < 2)
            status = fault_set(fault, STATUS_BAD_INPUT, "%s: %s is no lattice", h5_path(s->result),
                               name[i]);
        if (status)
            return status;
        count += found;
    }
    s->found = s->found || count > 0;
    return count > 0 ? write_lattice(s, field, count, fault) : STATUS_OK;
}

/* -- particles ----------------------------------------------------------------------------- */

static void put_fixed(const struct sidecar *s, const char *group, const char *name, size_t count,
                      const char *type) {
    char path[128];
    snprintf(path, sizeof path, "particles/%s/%s", group, name);
    if (!h5_has(s->result, path))
        return;
    fprintf(s->out,
            "      <Attribute Name=\"%s\" AttributeType=\"Scalar\" Center=\"Node\">\n"
            "        <DataItem Dimensions=\"%zu\"",
            name, count);
    put_source(s, path, type);
    fputs("      </Attribute>\n", s->out);
}

static enum status write_particles(struct sidecar *s, const char *group, struct fault *fault) {
    char name[96];
    struct shape place, speed;
    bool found, moves;
    double *time = NULL;
    snprintf(name, sizeof name, "particles/%s/position", group);
    enum status status = find_shape(s, name, &found, &place, fault);
    snprintf(name, sizeof name, "particles/%s/velocity", group);
    if (!status)
        status = find_shape(s, name, &moves, &speed, fault);
    if (status || !found)
        return status;
    if (place.rank != 2 || (place.dims[1] != 2 && place.dims[1] != 3))
        return fault_set(fault, STATUS_BAD_INPUT, "%s: %s is not [frame][particle][2 or 3]",
                         h5_path(s->result), place.name);
    status = read_times(s, &place, &time, fault);
    if (status)
        return status;
    s->found = true;
    moves = moves && speed.frames == place.frames && speed.dims[0] == place.dims[0];
    begin_collection(s, group);
    for (size_t f = 0; f < place.frames; f++) {
        fprintf(s->out,
                "    <Grid Name=\"%s %zu\" GridType=\"Uniform\">\n"
                "      <Time Value=\"%.17g\"/>\n"
                "      <Topology TopologyType=\"Polyvertex\" NumberOfElements=\"%zu\"/>\n"
                "      <Geometry GeometryType=\"%s\">\n",
                group, f, time[f], place.dims[0], place.dims[1] == 2 ? "XY" : "XYZ");
        put_slab(s, &place, f, "", 2, -1);
        fputs("      </Geometry>\n", s->out);
        put_fixed(s, group, "radius", place.dims[0], "Float");
        put_fixed(s, group, "species", place.dims[0], "Int");
        if (moves)
            put_attribute(s, &speed, f, 1);
        fputs("    </Grid>\n", s->out);
    }
    fputs("  </Grid>\n", s->out);
    free(time);
    return STATUS_OK;
}

/* -- all ----------------------------------------------------------------------------------------
 */

static enum status write_all(struct sidecar *s, struct fault *fault) {
    fputs("<?xml version=\"1.0\" encoding=\"utf-8\"?>\n<Xdmf Version=\"3.0\">\n <Domain>\n",
          s->out);
    enum status status = find_lattice(s, fault);
    if (!status)
        status = write_particles(s, "grains", fault);
    if (!status)
        status = write_particles(s, "spheres", fault);
    fputs(" </Domain>\n</Xdmf>\n", s->out);
    if (!status && !s->found)
        status = fault_set(fault, STATUS_NOT_FOUND, "%s: neither fields nor particles",
                           h5_path(s->result));
    return status;
}

enum status xdmf_write(struct h5_reader *result, char **path, struct fault *fault) {
    const char *name = h5_path(result), *slash = strrchr(name, '/');
    size_t length = strlen(name), size = 0;
    struct sidecar s = {.result = result, .base = slash ? slash + 1 : name};
    char *text = NULL;
    if (length > 3 && !strcmp(name + length - 3, ".h5"))
        length -= 3;
    if (asprintf(path, "%.*s.xdmf", (int)length, name) < 0)
        *path = NULL;
    s.out = *path ? open_memstream(&text, &size) : NULL;
    if (!s.out) {
        free(*path);
        *path = NULL;
        return fault_set(fault, STATUS_NO_MEMORY, "no memory for a sidecar");
    }
    enum status status = write_all(&s, fault);
    if (fclose(s.out) != 0 && !status)
        status = fault_set(fault, STATUS_NO_MEMORY, "no memory for a sidecar");
    if (!status)
        status = file_write(*path, text, size, fault);
    if (status) {
        free(*path);
        *path = NULL;
    }
    free(text);
    return status;
}
