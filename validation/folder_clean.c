/* folder_clean.c -- removing what bedcheck wrote, and nothing else. */
#include "validation/folder.h"

#include "validation/key.h"

#include <dirent.h>
#include <errno.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static const char *inside(struct arena *a, const char *folder, const char *name) {
    return arena_text(a, "%s/%s", folder, name);
}

static bool ends_with(const char *name, const char *end) {
    size_t a = strlen(name), b = strlen(end);
    return a > b && strcmp(name + a - b, end) == 0;
}

static enum status remove_file(const char *path, struct fault *fault) {
    if (unlink(path) != 0 && errno != ENOENT)
        return fault_set(fault, STATUS_IO, "%s: cannot be removed: %s", path, strerror(errno));
    return STATUS_OK;
}

/* -- clean ------------------------------------------------------------------ */

/* "CASE.1a2b3c4d" and, with seed, "-s1101", before `rest`. */
static bool is_run_name(const char *file, const char *rest) {
    size_t length = rest == NULL ? strlen(file) : (size_t)(rest - file);
    const char *dot = memrchr(file, '.', length);
    if (dot == NULL || dot == file || strspn(dot + 1, "0123456789abcdef") != 8)
        return false;
    const char *seed = dot + 9;
    if (seed == file + length)
        return true;
    return seed[0] == '-' && seed[1] == 's' &&
           seed + 2 + strspn(seed + 2, "0123456789") == file + length;
}

static bool is_ours(const char *part, const char *name) {
    static const char *const end[] = {".run.json", ".h5", ".key", ".yaml", ".log"};
    char stem[512];
    snprintf(stem, sizeof stem, "%s", name);
    char *unfinished = strstr(stem, ".tmp.");
    if (unfinished != NULL)
        *unfinished = '\0';
    if (strcmp(part, "report") == 0)
        return strcmp(stem, "index.html") == 0 || ends_with(stem, ".png") ||
               ends_with(stem, ".svg");
    if (*part == '\0')
        return strcmp(stem, "results.json") == 0 || strcmp(stem, "junit.xml") == 0 ||
               strcmp(stem, "summary.md") == 0 || strcmp(stem, "bedcheck.lock") == 0;
    for (size_t i = 0; i < sizeof end / sizeof *end; i++) {
        if (ends_with(stem, end[i]) && is_run_name(stem, stem + strlen(stem) - strlen(end[i])))
            return true;
    }
    return false;
}

struct sweep {
    size_t *removed, *left;
};

static enum status clean_part(const struct folder *f, const char *part, struct sweep *s,
                              struct fault *fault) {
    struct arena a = {0};
    enum status status = STATUS_OK;
    const char *path = *part == '\0' ? folder_path(f) : inside(&a, folder_path(f), part);
    struct stat about;
    if (path == NULL || lstat(path, &about) != 0 || !S_ISDIR(about.st_mode))
        goto end; /* not there, or a link that leads elsewhere */
    DIR *d = opendir(path);
    for (struct dirent *e; d != NULL && status == STATUS_OK && (e = readdir(d)) != NULL;) {
        const char *file = inside(&a, path, e->d_name);
        bool known = strcmp(e->d_name, "bedcheck.yaml") == 0 && *part == '\0';
        if (file == NULL || lstat(file, &about) != 0 || S_ISDIR(about.st_mode) || known)
            continue;
        if (!S_ISREG(about.st_mode) || !is_ours(part, e->d_name)) {
            ++*s->left;
            continue;
        }
        status = remove_file(file, fault);
        ++*s->removed;
    }
    if (d != NULL)
        closedir(d);
    if (status == STATUS_OK && *part != '\0')
        rmdir(path); /* stays where something foreign is in it */
end:
    arena_free(&a);
    return status;
}

enum status folder_clean(struct folder *f, size_t *removed, size_t *left, struct fault *fault) {
    static const char *const part[] = {"h5", "runs", "logs", "report", ""};
    struct sweep s = {removed, left};
    struct arena a = {0};
    enum status status = STATUS_OK;
    *removed = *left = 0;
    for (size_t i = 0; status == STATUS_OK && i < sizeof part / sizeof *part; i++)
        status = clean_part(f, part[i], &s, fault);
    const char *record = inside(&a, folder_path(f), "bedcheck.yaml");
    if (status == STATUS_OK && record != NULL)
        status = remove_file(record, fault); /* last: until then the folder is ours */
    if (status == STATUS_OK) {
        ++*removed;
        rmdir(folder_path(f));
    }
    arena_free(&a);
    return status;
}

/* -- stale results ---------------------------------------------------------- */

static enum status clean_one(const struct folder *f, const char *file, const char *solver,
                             struct arena *a, size_t *removed, struct fault *fault) {
    struct key_record record;
    struct fault damaged = FAULT_NONE;
    const char *path = arena_text(a, "%s/h5/%s", folder_path(f), file);
    const char *name = arena_text(a, "%.*s", (int)(strlen(file) - strlen(".key")), file);
    if (path == NULL || name == NULL)
        return fault_set(fault, STATUS_NO_MEMORY, "clean: out of memory");
    if (key_read(path, &record, &damaged) == STATUS_OK && strcmp(record.solver, solver) == 0)
        return STATUS_OK;
    ++*removed;
    return folder_drop_result(f, name, fault);
}

enum status folder_clean_stale(const struct folder *f, size_t *removed, struct fault *fault) {
    struct arena a = {0};
    struct folder_record record;
    *removed = 0;
    enum status status = folder_read_record(f, &record, fault);
    const char *h5 = inside(&a, folder_path(f), "h5");
    DIR *d = status != STATUS_OK || h5 == NULL ? NULL : opendir(h5);
    if (status == STATUS_OK && d == NULL)
        status = fault_set(fault, STATUS_IO, "%s/h5: %s", folder_path(f), strerror(errno));
    for (struct dirent *e; status == STATUS_OK && (e = readdir(d)) != NULL;) {
        if (ends_with(e->d_name, ".key"))
            status = clean_one(f, e->d_name, record.solver_key, &a, removed, fault);
    }
    if (d != NULL)
        closedir(d);
    folder_record_free(&record);
    arena_free(&a);
    return status;
}
