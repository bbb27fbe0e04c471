#include "validation/folder.h"

#include "common/file.h"
#include "common/schema.h"
#include "validation/key.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

struct folder {
    struct arena arena;
    char *path;
    int lock; /* of DIR/bedcheck.lock; -1: none */
};

static const char *inside(struct arena *a, const char *folder, const char *name) {
    return arena_text(a, "%s/%s", folder, name);
}

/* Nothing in it but what folder_open makes itself, before there is a record. */
static bool is_fresh(const char *path) {
    static const char *const known[] = {".", "..", "runs", "h5", "logs", "report", "bedcheck.lock"};
    DIR *d = opendir(path);
    bool fresh = d != NULL;
    for (struct dirent *e; fresh && (e = readdir(d)) != NULL;) {
        fresh = false;
        for (size_t i = 0; i < sizeof known / sizeof *known; i++)
            fresh |= strcmp(e->d_name, known[i]) == 0;
    }
    if (d != NULL)
        closedir(d);
    return fresh;
}

static enum status take_lock(struct folder *f, struct fault *fault) {
    const char *path = inside(&f->arena, f->path, "bedcheck.lock");
    if (path == NULL)
        return fault_set(fault, STATUS_NO_MEMORY, "%s: out of memory", f->path);
    f->lock = open(path, O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0644);
    if (f->lock < 0)
        return fault_set(fault, STATUS_IO, "%s: %s", path, strerror(errno));
    if (flock(f->lock, LOCK_EX | LOCK_NB) != 0)
        return fault_set(fault, STATUS_IO, "%s: another bedcheck works in this folder", f->path);
    return STATUS_OK;
}

static enum status make_parts(struct folder *f, struct fault *fault) {
    static const char *const part[] = {"", "runs", "h5", "logs", "report"};
    enum status status = STATUS_OK;
    for (size_t i = 0; status == STATUS_OK && i < sizeof part / sizeof *part; i++) {
        const char *path = inside(&f->arena, f->path, part[i]);
        status = path == NULL ? fault_set(fault, STATUS_NO_MEMORY, "%s: out of memory", f->path)
                              : file_make_folder(i == 0 ? f->path : path, fault);
    }
    return status;
}

static enum status check_owner(struct folder *f, bool make, struct fault *fault) {
    const char *record = inside(&f->arena, f->path, "bedcheck.yaml");
    if (record == NULL)
        return fault_set(fault, STATUS_NO_MEMORY, "%s: out of memory", f->path);
    struct stat about;
    bool there = lstat(f->path, &about) == 0;
    if (there && stat(f->path, &about) == 0 && !S_ISDIR(about.st_mode))
        return fault_set(fault, STATUS_BAD_INPUT, "%s: is not a folder", f->path);
    if (file_exists(record))
        return STATUS_OK;
    if (make && (!there || is_fresh(f->path)))
        return STATUS_OK;
    if (!there)
        return fault_set(fault, STATUS_NOT_FOUND, "%s: no such folder", f->path);
    return fault_set(fault, STATUS_BAD_INPUT,
                     "%s: is no folder of bedcheck's results (no bedcheck.yaml in it)", f->path);
}

enum status folder_check(const char *path, struct fault *fault) {
    struct folder f = {.lock = -1};
    f.path = arena_copy(&f.arena, path);
    enum status status = f.path == NULL
                             ? fault_set(fault, STATUS_NO_MEMORY, "%s: out of memory", path)
                             : check_owner(&f, true, fault);
    arena_free(&f.arena);
    return status;
}

enum status folder_open(const char *path, bool make, struct folder **out, struct fault *fault) {
    *out = NULL;
    struct folder *f = calloc(1, sizeof *f);
    if (f == NULL)
        return fault_set(fault, STATUS_NO_MEMORY, "%s: out of memory", path);
    f->lock = -1;
    f->path = arena_copy(&f->arena, path);
    enum status status = f->path == NULL
                             ? fault_set(fault, STATUS_NO_MEMORY, "%s: out of memory", path)
                             : check_owner(f, make, fault);
    size_t length = f->path == NULL ? 0 : strlen(f->path);
    while (length > 1 && f->path[length - 1] == '/')
        f->path[--length] = '\0';
    if (status == STATUS_OK && make)
        status = make_parts(f, fault);
    if (status == STATUS_OK)
        status = take_lock(f, fault);
    if (status != STATUS_OK) {
        folder_close(f);
        return status;
    }
    *out = f;
    return STATUS_OK;
}

void folder_close(struct folder *f) {
    if (f == NULL)
        return;
    if (f->lock >= 0)
        close(f->lock);
    arena_free(&f->arena);
    free(f);
}

const char *folder_path(const struct folder *f) {
    return f->path;
}

const char *folder_run_file(const struct folder *f, struct arena *a, const struct plan_run *run) {
    return arena_text(a, "%s/runs/%s", f->path, run->run_file);
}

const char *folder_result(const struct folder *f, struct arena *a, const struct plan_run *run) {
    return arena_text(a, "%s/h5/%s.h5", f->path, run->name);
}

const char *folder_key(const struct folder *f, struct arena *a, const struct plan_run *run) {
    return arena_text(a, "%s/h5/%s.key", f->path, run->name);
}

const char *folder_run_record(const struct folder *f, struct arena *a, const struct plan_run *run) {
    return arena_text(a, "%s/h5/%s.run.json", f->path, run->name);
}

const char *folder_log(const struct folder *f, struct arena *a, const struct plan_run *run) {
    return arena_text(a, "%s/logs/%s.log", f->path, run->name);
}

static bool ends_with(const char *name, const char *end) {
    size_t a = strlen(name), b = strlen(end);
    return a > b && strcmp(name + a - b, end) == 0;
}

/* NAME.h5, NAME.key, NAME.run.json, or such a file unfinished (.tmp.PID). */
static bool is_result_of(const char *file, const char *run_name) {
    size_t length = strlen(run_name);
    if (strncmp(file, run_name, length) != 0 || file[length] != '.')
        return false;
    char rest[64];
    snprintf(rest, sizeof rest, "%s", file + length);
    char *unfinished = strstr(rest, ".tmp.");
    if (unfinished != NULL)
        *unfinished = '\0';
    static const char *const kind[] = {".h5", ".key", ".run.json", ".h5.run.json"};
    for (size_t i = 0; i < sizeof kind / sizeof *kind; i++) {
        if (strcmp(rest, kind[i]) == 0)
            return true;
    }
    return false;
}

static enum status remove_file(const char *path, struct fault *fault) {
    if (unlink(path) != 0 && errno != ENOENT)
        return fault_set(fault, STATUS_IO, "%s: cannot be removed: %s", path, strerror(errno));
    return STATUS_OK;
}

enum status folder_drop_reports(const struct folder *f, struct fault *fault) {
    static const char *const name[] = {"results.json", "junit.xml", "summary.md",
                                       "report/index.html"};
    struct arena a = {0};
    enum status status = STATUS_OK;
    for (size_t i = 0; status == STATUS_OK && i < sizeof name / sizeof *name; i++) {
        const char *path = inside(&a, f->path, name[i]);
        status = path == NULL ? fault_set(fault, STATUS_NO_MEMORY, "%s: out of memory", f->path)
                              : remove_file(path, fault);
    }
    arena_free(&a);
    return status;
}

enum status folder_drop_result(const struct folder *f, const char *run_name, struct fault *fault) {
    struct arena a = {0};
    enum status status = STATUS_OK;
    const char *key = arena_text(&a, "%s/h5/%s.key", f->path, run_name);
    const char *h5 = inside(&a, f->path, "h5");
    DIR *d = h5 == NULL ? NULL : opendir(h5);
    if (key == NULL || d == NULL) {
        status = fault_set(fault, STATUS_IO, "%s: h5: cannot be read", f->path);
        goto end;
    }
    status = remove_file(key, fault); /* first: without it nothing counts */
    for (struct dirent *e; status == STATUS_OK && (e = readdir(d)) != NULL;) {
        if (!is_result_of(e->d_name, run_name))
            continue;
        const char *path = inside(&a, h5, e->d_name);
        status = path == NULL ? fault_set(fault, STATUS_NO_MEMORY, "%s: out of memory", f->path)
                              : remove_file(path, fault);
    }
end:
    if (d != NULL)
        closedir(d);
    arena_free(&a);
    return status;
}

static enum status add_key(struct arena *a, const char *solver, const char ***list, size_t *count,
                           struct fault *fault) {
    for (size_t i = 0; i < *count; i++) {
        if (strcmp((*list)[i], solver) == 0)
            return STATUS_OK;
    }
    const char **wider = arena_grow(a, *list, *count, sizeof *wider);
    const char *copy = arena_copy(a, solver);
    if (wider == NULL || copy == NULL)
        return fault_set(fault, STATUS_NO_MEMORY, "keys: out of memory");
    *list = wider;
    (*list)[(*count)++] = copy;
    return STATUS_OK;
}

enum status folder_solver_keys(const struct folder *f, struct arena *a, const char ***out,
                               size_t *count, struct fault *fault) {
    *out = NULL;
    *count = 0;
    const char *h5 = inside(a, f->path, "h5");
    DIR *d = h5 == NULL ? NULL : opendir(h5);
    if (d == NULL)
        return fault_set(fault, STATUS_IO, "%s/h5: %s", f->path, strerror(errno));
    enum status status = STATUS_OK;
    for (struct dirent *e; status == STATUS_OK && (e = readdir(d)) != NULL;) {
        if (!ends_with(e->d_name, ".key"))
            continue;
        const char *path = inside(a, h5, e->d_name);
        struct key_record record;
        status = path == NULL ? fault_set(fault, STATUS_NO_MEMORY, "%s: out of memory", f->path)
                              : key_read(path, &record, fault);
        if (status == STATUS_OK)
            status = add_key(a, record.solver, out, count, fault);
    }
    closedir(d);
    return status;
}
