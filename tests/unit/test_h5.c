/* test_h5.c -- common/h5.h: files repeat, and a foreign file cannot lead us anywhere. */
#include "common/digest.h"
#include "common/file.h"
#include "common/h5.h"
#include "tests/unit/unit.h"

#include <hdf5.h>

/* -- what is written ----------------------------------------------------------- */

static const double RADIUS[3] = {0.2371, 0.1937, 1.37e-6};

static void write_result(const char *path) {
    struct fault fault = FAULT_NONE;
    struct h5_writer *w;
    unit_ok(h5_create(path, &w, &fault), &fault);
    unit_ok(h5_attribute_integers(w, "h5md", "version", (const int[]){1, 1}, 2, &fault), &fault);
    unit_ok(h5_attribute_text(w, "h5md/author", "name", "n\xc3\xa9", &fault), &fault);
    unit_ok(h5_attribute_texts(w, "particles/grains/box", "boundary",
                               (const char *const[]){"none", "periodic"}, 2, &fault),
            &fault);
    unit_ok(h5_attribute_reals(w, "parameters", "peclet", (const double[]){1.37e-6}, 1, &fault),
            &fault);
    unit_ok(h5_attribute_reals(w, "parameters", "bed", RADIUS, 3, &fault), &fault);
    unit_ok(h5_attribute_reals(w, "parameters", "none", NULL, 0, &fault), &fault);
    unit_ok(h5_write(w, "particles/grains/radius", H5_REAL, 1, (const size_t[]){3}, RADIUS, "l",
                     &fault),
            &fault);
    for (int t = 0; t < 5; t++) {
        double position[3][2], time = 0.1 * t;
        int64_t hits = 1000000000007LL * t;
        for (int i = 0; i < 6; i++)
            position[i / 2][i % 2] = 100.0 * t + i + 1.37e-6;
        unit_ok(h5_append(w, "particles/grains/position", H5_REAL, 2, (const size_t[]){3, 2},
                          position, "l", 80 * t, time, "tau", &fault),
                &fault);
        unit_ok(h5_append(w, "observables/collisions", H5_INTEGER, 0, NULL, &hits, "1", 80 * t,
                          time, "tau", &fault),
                &fault);
    }
    unit_ok(h5_commit(w, &fault), &fault);
}

static struct h5_reader *open_result(const char *path) {
    struct fault fault = FAULT_NONE;
    struct h5_reader *r;
    unit_ok(h5_open(path, &r, &fault), &fault);
    return r;
}

START_TEST(what_is_written_is_read) {
    struct fault fault = FAULT_NONE;
    const char *folder = unit_folder(), *path = unit_path(folder, "a.h5");
    write_result(path);
    struct h5_reader *r = open_result(path);
    int rank;
    size_t dims[H5_MAX_RANK], count;
    double slab[6], *values;
    char text[32];
    ck_assert_str_eq(h5_path(r), path);
    unit_ok(h5_dims(r, "particles/grains/position/value", &rank, dims, &fault), &fault);
    ck_assert_int_eq(rank, 3);
    ck_assert_uint_eq(dims[0] * 100 + dims[1] * 10 + dims[2], 532);
    unit_ok(h5_read_slab(r, "particles/grains/position/value", 3, 6, slab, &fault), &fault);
    ck_assert_double_eq(slab[5], 305 + 1.37e-6);
    unit_ok(h5_read(r, "observables/collisions/value", 5, &values, &count, &fault), &fault);
    ck_assert_uint_eq(count, 5);
    ck_assert_double_eq(values[4], 4000000000028.0);
    free(values);
    unit_ok(h5_read(r, "/particles/grains/radius", 3, &values, &count, &fault), &fault);
    ck_assert_mem_eq(values, RADIUS, sizeof RADIUS);
    free(values);
    unit_ok(h5_unit(r, "observables/collisions/time", text, sizeof text, &fault), &fault);
    ck_assert_str_eq(text, "tau");
    unit_ok(h5_read_text(r, "h5md/author", "name", text, sizeof text, &fault), &fault);
    ck_assert_str_eq(text, "n\xc3\xa9");
    h5_close(r);
    h5_close(NULL);
    unit_remove(folder);
}
END_TEST

START_TEST(real_attributes_are_read) {
    struct fault fault = FAULT_NONE;
    const char *folder = unit_folder(), *path = unit_path(folder, "a.h5");
    write_result(path);
    struct h5_reader *r = open_result(path);
    double *values;
    size_t count;
    unit_ok(h5_read_reals(r, "parameters", "peclet", 1, &values, &count, &fault), &fault);
    ck_assert_double_eq(values[0], 1.37e-6);
    free(values);
    unit_ok(h5_read_reals(r, "parameters", "bed", 3, &values, &count, &fault), &fault);
    ck_assert_mem_eq(values, RADIUS, sizeof RADIUS);
    free(values);
    unit_ok(h5_read_reals(r, "parameters", "none", 3, &values, &count, &fault), &fault);
    ck_assert_uint_eq(count, 0);
    free(values);
    ck_assert_int_eq(h5_read_reals(r, "parameters", "bed", 2, &values, &count, &fault),
                     STATUS_BAD_INPUT);
    unit_says(&fault, "a.h5: parameters: attribute 'bed' has 3 values, at most 2 expected");
    ck_assert_int_eq(h5_read_reals(r, "parameters", "froude", 2, &values, &count, &fault),
                     STATUS_NOT_FOUND);
    ck_assert_int_eq(h5_read_reals(r, "h5md/author", "name", 2, &values, &count, &fault),
                     STATUS_BAD_INPUT);
    h5_close(r);
    unit_remove(folder);
}
END_TEST

START_TEST(the_same_data_are_the_same_bytes) {
    struct fault fault = FAULT_NONE;
    struct digest a, b;
    const char *folder = unit_folder();
    write_result(unit_path(folder, "a.h5"));
    sleep(1); /* dates, were there any, would differ */
    write_result(unit_path(folder, "b.h5"));
    unit_ok(digest_file(unit_path(folder, "a.h5"), &a, &fault), &fault);
    unit_ok(digest_file(unit_path(folder, "b.h5"), &b, &fault), &fault);
    ck_assert_str_eq(a.hex, b.hex);
    unit_remove(folder);
}
END_TEST

START_TEST(linked_clocks_advance_once) {
    struct fault fault = FAULT_NONE;
    const char *folder = unit_folder(), *path = unit_path(folder, "a.h5");
    struct h5_writer *w;
    double x = 1.5;
    unit_ok(h5_create(path, &w, &fault), &fault);
    for (int t = 0; t < 3; t++) {
        unit_ok(h5_append(w, "g/position", H5_REAL, 0, NULL, &x, "l", t, 0.7 * t, "tau", &fault),
                &fault);
        if (t == 0) {
            unit_ok(h5_link(w, "g/position/step", "g/box/edges/step", &fault), &fault);
            unit_ok(h5_link(w, "g/position/time", "g/box/edges/time", &fault), &fault);
        }
        unit_ok(h5_append(w, "g/box/edges", H5_REAL, 0, NULL, &x, "l", t, 0.7 * t, "tau", &fault),
                &fault);
    }
    unit_ok(h5_append(w, "g/position", H5_REAL, 0, NULL, &x, "l", 3, 2.1, "tau", &fault), &fault);
    ck_assert_int_eq(h5_append(w, "g/box/edges", H5_REAL, 0, NULL, &x, "l", 4, 2.8, "tau", &fault),
                     STATUS_BAD_INPUT);
    unit_says(&fault, "another value in the series it is linked to");
    unit_ok(h5_commit(w, &fault), &fault);
    struct h5_reader *r = open_result(path);
    double *values;
    size_t count;
    unit_ok(h5_read(r, "g/box/edges/time", 9, &values, &count, &fault), &fault);
    ck_assert_uint_eq(count, 4);
    ck_assert_double_eq(values[2], 1.4);
    free(values);
    h5_close(r);
    unit_remove(folder);
}
END_TEST

START_TEST(a_run_without_grains_and_a_long_list_are_written) {
    struct fault fault = FAULT_NONE;
    const char *folder = unit_folder(), *path = unit_path(folder, "a.h5");
    struct h5_writer *w;
    enum { MANY = 18104 };
    double *list = calloc(MANY, sizeof *list);
    ck_assert_ptr_nonnull(list);
    list[MANY - 1] = 1.37e-6;
    unit_ok(h5_create(path, &w, &fault), &fault);
    unit_ok(h5_write(w, "p/id", H5_INTEGER, 1, (const size_t[]){0}, list, "1", &fault), &fault);
    for (int t = 0; t < 2; t++)
        unit_ok(h5_append(w, "p/position", H5_REAL, 2, (const size_t[]){0, 2}, list, "l", t, t,
                          "tau", &fault),
                &fault);
    unit_ok(h5_attribute_reals(w, "parameters", "grain_x", list, MANY, &fault), &fault);
    unit_ok(h5_commit(w, &fault), &fault);
    struct h5_reader *r = open_result(path);
    double *values, none;
    size_t count;
    unit_ok(h5_read(r, "p/id", 0, &values, &count, &fault), &fault);
    ck_assert_uint_eq(count, 0);
    free(values);
    unit_ok(h5_read_slab(r, "p/position/value", 1, 0, &none, &fault), &fault);
    unit_ok(h5_read_reals(r, "parameters", "grain_x", MANY, &values, &count, &fault), &fault);
    ck_assert_double_eq(values[MANY - 1], 1.37e-6);
    free(values);
    free(list);
    h5_close(r);
    unit_remove(folder);
}
END_TEST

static bool folder_is_empty(const char *folder) {
    char command[128];
    snprintf(command, sizeof command, "test -z \"$(ls -A '%s')\"", folder);
    return system(command) == 0;
}

START_TEST(nothing_is_left_of_a_file_that_is_not_finished) {
    struct fault fault = FAULT_NONE;
    const char *folder = unit_folder(), *path = unit_path(folder, "a.h5");
    struct h5_writer *w;
    unit_ok(h5_create(path, &w, &fault), &fault);
    unit_ok(h5_write(w, "x", H5_REAL, 1, (const size_t[]){3}, RADIUS, "l", &fault), &fault);
    ck_assert_int_eq(h5_write(w, "x", H5_REAL, 1, (const size_t[]){3}, RADIUS, "l", &fault),
                     STATUS_IO);
    unit_says(&fault, "a.h5: x: cannot be written");
    ck_assert(!file_exists(path));
    h5_discard(w);
    ck_assert(folder_is_empty(folder));
    h5_discard(NULL);
    ck_assert_int_eq(h5_create(unit_path(folder, "no/a.h5"), &w, &fault), STATUS_IO);
    unit_says(&fault, "No such file");
    unit_remove(folder);
}
END_TEST

START_TEST(a_sample_of_another_shape_is_refused) {
    struct fault fault = FAULT_NONE;
    const char *folder = unit_folder();
    struct h5_writer *w;
    unit_ok(h5_create(unit_path(folder, "a.h5"), &w, &fault), &fault);
    unit_ok(h5_append(w, "x", H5_REAL, 1, (const size_t[]){3}, RADIUS, "l", 0, 0, "tau", &fault),
            &fault);
    ck_assert_int_eq(
        h5_append(w, "x", H5_REAL, 1, (const size_t[]){2}, RADIUS, "l", 1, 1, "tau", &fault),
        STATUS_BAD_INPUT);
    h5_discard(w);
    unit_remove(folder);
}
END_TEST

/* -- what is refused ------------------------------------------------------------- */

START_TEST(sizes_are_checked_before_memory_is_taken) {
    struct fault fault = FAULT_NONE;
    const char *folder = unit_folder(), *path = unit_path(folder, "a.h5");
    write_result(path);
    struct h5_reader *r = open_result(path);
    double *values, slab[6];
    size_t count;
    ck_assert_int_eq(h5_read(r, "particles/grains/radius", 2, &values, &count, &fault),
                     STATUS_BAD_INPUT);
    unit_says(&fault, "a.h5: particles/grains/radius: 3 values, at most 2 expected");
    ck_assert_ptr_null(values);
    ck_assert_int_eq(h5_read_slab(r, "particles/grains/position/value", 5, 6, slab, &fault),
                     STATUS_BAD_INPUT);
    ck_assert_int_eq(h5_read_slab(r, "particles/grains/position/value", 0, 5, slab, &fault),
                     STATUS_BAD_INPUT);
    ck_assert_int_eq(h5_read(r, "no/such/thing", 2, &values, &count, &fault), STATUS_NOT_FOUND);
    ck_assert_int_eq(h5_read(r, "particles", 2, &values, &count, &fault), STATUS_BAD_INPUT);
    ck_assert(!h5_has(r, "no/such/thing") && h5_has(r, "particles/grains") && !h5_has(r, ""));
    h5_close(r);
    unit_remove(folder);
}
END_TEST

/* A foreign file made by raw HDF5 calls. */
enum trick { SOFT, EXTERNAL_LINK, EXTERNAL_STORAGE, VIRTUAL, FILTER, NAMED_TYPE, HUGE_CHUNK };

static void make_foreign(const char *path, enum trick trick) {
    hsize_t dims[1] = {8}, chunk[1] = {trick == HUGE_CHUNK ? 1 << 26 : 8};
    hsize_t limit[1] = {H5S_UNLIMITED};
    hid_t file = H5Fcreate(path, H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
    hid_t space = H5Screate_simple(1, dims, trick == HUGE_CHUNK ? limit : NULL);
    hid_t creation = H5Pcreate(H5P_DATASET_CREATE);
    if (trick == SOFT)
        ck_assert_int_ge(H5Lcreate_soft("/x", file, "y", H5P_DEFAULT, H5P_DEFAULT), 0);
    if (trick == EXTERNAL_LINK)
        ck_assert_int_ge(
            H5Lcreate_external("/etc/passwd", "/x", file, "y", H5P_DEFAULT, H5P_DEFAULT), 0);
    if (trick == EXTERNAL_STORAGE)
        ck_assert_int_ge(H5Pset_external(creation, "/etc/passwd", 0, 64), 0);
    if (trick == VIRTUAL)
        ck_assert_int_ge(H5Pset_virtual(creation, space, "/tmp/other.h5", "x", space), 0);
    if (trick == FILTER || trick == HUGE_CHUNK)
        ck_assert_int_ge(H5Pset_chunk(creation, 1, chunk), 0);
    if (trick == FILTER)
        ck_assert_int_ge(H5Pset_nbit(creation), 0);
    if (trick == NAMED_TYPE) {
        hid_t type = H5Tcopy(H5T_NATIVE_INT);
        ck_assert_int_ge(H5Tcommit2(file, "t", type, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), 0);
        H5Tclose(type); /* an open object would keep the file open */
    }
    hid_t data =
        H5Dcreate2(file, "x", H5T_NATIVE_DOUBLE, space, H5P_DEFAULT, creation, H5P_DEFAULT);
    ck_assert_int_ge(data, 0);
    H5Dclose(data);
    H5Fclose(file);
}

START_TEST(foreign_tricks_are_refused) {
    static const char *const words[] = {
        [SOFT] = "y: soft links are refused",
        [EXTERNAL_LINK] = "y: external and user-defined links are refused",
        [EXTERNAL_STORAGE] = "x: external storage is refused",
        [VIRTUAL] = "x: virtual datasets are refused",
        [FILTER] = "x: filters other than",
        [NAMED_TYPE] = "t: only groups and datasets",
    };
    struct fault fault = FAULT_NONE;
    struct h5_reader *r;
    const char *folder = unit_folder(), *path = unit_path(folder, "f.h5");
    for (enum trick trick = SOFT; trick <= NAMED_TYPE; trick++) {
        make_foreign(path, trick);
        ck_assert_int_eq(h5_open(path, &r, &fault), STATUS_BAD_INPUT);
        unit_says(&fault, words[trick]);
        ck_assert_ptr_null(r);
    }
    double *values;
    size_t count;
    make_foreign(path, HUGE_CHUNK);
    r = open_result(path);
    ck_assert_int_eq(h5_read(r, "x", 8, &values, &count, &fault), STATUS_BAD_INPUT);
    unit_says(&fault, "chunks much larger");
    h5_close(r);
    unit_remove(folder);
}
END_TEST

START_TEST(damage_is_found) {
    struct fault fault = FAULT_NONE;
    struct h5_reader *r;
    const char *folder = unit_folder(), *path = unit_path(folder, "a.h5");
    ck_assert_int_eq(h5_open(path, &r, &fault), STATUS_NOT_FOUND);
    unit_write(path, "this is not HDF5\n");
    ck_assert_int_eq(h5_open(path, &r, &fault), STATUS_IO);
    unit_says(&fault, "a.h5: not an HDF5 file that can be read");
    write_result(path);
    char *bytes;
    size_t length;
    unit_ok(file_read(path, 1 << 20, &bytes, &length, &fault), &fault);
    unit_ok(file_write(unit_path(folder, "cut.h5"), bytes, length / 2, &fault), &fault);
    ck_assert_int_ne(h5_open(unit_path(folder, "cut.h5"), &r, &fault), STATUS_OK);
    /* One flipped bit in the data: Fletcher-32 turns it into an error. */
    char *at = memmem(bytes, length, RADIUS, sizeof RADIUS);
    ck_assert_ptr_nonnull(at);
    at = memmem(at + 1, length - (size_t)(at + 1 - bytes), RADIUS, sizeof RADIUS)
             ? memmem(at + 1, length - (size_t)(at + 1 - bytes), RADIUS, sizeof RADIUS)
             : at;
    at[3] ^= 0x10;
    unit_ok(file_write(path, bytes, length, &fault), &fault);
    free(bytes);
    r = open_result(path);
    double *values;
    size_t count;
    ck_assert_int_eq(h5_read(r, "particles/grains/radius", 3, &values, &count, &fault), STATUS_IO);
    unit_says(&fault, "a.h5: particles/grains/radius: cannot be read");
    h5_close(r);
    unit_remove(folder);
}
END_TEST

int main(void) {
    const TTest *const tests[] = {what_is_written_is_read,
                                  real_attributes_are_read,
                                  the_same_data_are_the_same_bytes,
                                  linked_clocks_advance_once,
                                  a_run_without_grains_and_a_long_list_are_written,
                                  nothing_is_left_of_a_file_that_is_not_finished,
                                  a_sample_of_another_shape_is_refused,
                                  sizes_are_checked_before_memory_is_taken,
                                  foreign_tricks_are_refused,
                                  damage_is_found,
                                  NULL};
    return unit_run("h5", tests);
}
