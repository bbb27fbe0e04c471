/* file.c -- see file.h. */
#include "common/file.h"

#include <errno.h>
#include <fcntl.h>
#include <libgen.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/statvfs.h>
#include <unistd.h>

static enum status system_fault(struct fault *fault, const char *path, const char *what) {
    enum status status = errno == ENOENT ? STATUS_NOT_FOUND : STATUS_IO;
    return fault_set(fault, status, "%s: %s: %s", path, what, strerror(errno));
}

/* Read until the end or until `room` bytes are there; -1 on error. */
static ssize_t read_fully(int descriptor, char *out, size_t room) {
    size_t used = 0;
    while (used < room) {
        ssize_t got = read(descriptor, out + used, room - used);
        if (got < 0 && errno == EINTR)
            continue;
        if (got < 0)
            return -1;
        if (got == 0)
            break;
        used += (size_t)got;
    }
    return (ssize_t)used;
}

enum status file_read(const char *path, size_t max_bytes, char **out, size_t *length,
                      struct fault *fault) {
    enum status status = STATUS_OK;
    char *text = NULL;
    *out = NULL;
    /* O_NONBLOCK: a pipe without a writer must not hold us up. */
    int descriptor = open(path, O_RDONLY | O_CLOEXEC | O_NONBLOCK);
    struct stat about;
    if (descriptor < 0 || fstat(descriptor, &about) != 0) {
        status = system_fault(fault, path, "cannot be read");
        goto end;
    }
    if (!S_ISREG(about.st_mode)) {
        status = fault_set(fault, STATUS_BAD_INPUT, "%s: not a regular file", path);
        goto end;
    }
    if ((size_t)about.st_size > max_bytes) {
        status = fault_set(fault, STATUS_BAD_INPUT, "%s: %lld bytes, more than the %zu allowed",
                           path, (long long)about.st_size, max_bytes);
        goto end;
    }
    size_t size = (size_t)about.st_size;
    text = malloc(size + 1);
    if (text == NULL) {
        status = fault_set(fault, STATUS_NO_MEMORY, "%s: no memory for %zu bytes", path, size);
        goto end;
    }
    ssize_t got = read_fully(descriptor, text, size);
    if (got < 0) {
        status = system_fault(fault, path, "cannot be read");
        goto end;
    }
    text[got] = '\0';
    *length = (size_t)got;
    *out = text;
    text = NULL;
end:
    free(text);
    if (descriptor >= 0)
        close(descriptor);
    return status;
}

char *file_temporary(const char *path) {
    char *temporary;
    return asprintf(&temporary, "%s.tmp.%ld", path, (long)getpid()) < 0 ? NULL : temporary;
}

/* fsync a file or a folder. */
static bool sync_path(const char *path, int flags) {
    int descriptor = open(path, flags | O_CLOEXEC);
    if (descriptor < 0)
        return false;
    bool done = fsync(descriptor) == 0;
    int cause = errno;
    close(descriptor);
    errno = cause;
    /* Some file systems cannot sync a folder: the rename is then as safe as it can be. */
    return done || ((flags & O_DIRECTORY) != 0 && errno == EINVAL);
}

enum status file_replace(const char *temporary, const char *path, struct fault *fault) {
    char *copy = strdup(path);
    enum status status = STATUS_OK;
    if (copy == NULL)
        status = fault_set(fault, STATUS_NO_MEMORY, "%s: no memory", path);
    else if (!sync_path(temporary, O_RDONLY) || rename(temporary, path) != 0)
        status = system_fault(fault, path, "cannot be written");
    else if (!sync_path(dirname(copy), O_RDONLY | O_DIRECTORY))
        status = system_fault(fault, path, "its folder cannot be synced");
    if (status != STATUS_OK)
        unlink(temporary);
    free(copy);
    return status;
}

static bool write_fully(int descriptor, const char *text, size_t length) {
    while (length > 0) {
        ssize_t put = write(descriptor, text, length);
        if (put < 0 && errno == EINTR)
            continue;
        if (put < 0)
            return false;
        text += put;
        length -= (size_t)put;
    }
    return true;
}

enum status file_write(const char *path, const char *text, size_t length, struct fault *fault) {
    char *temporary = file_temporary(path);
    if (temporary == NULL)
        return fault_set(fault, STATUS_NO_MEMORY, "%s: no memory", path);
    enum status status = STATUS_OK;
    int descriptor = open(temporary, O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
    bool written = descriptor >= 0 && write_fully(descriptor, text, length);
    if (!written)
        status = system_fault(fault, path, "cannot be written");
    if (descriptor >= 0 && close(descriptor) != 0 && written)
        status = system_fault(fault, path, "cannot be written");
    if (status == STATUS_OK)
        status = file_replace(temporary, path, fault);
    else if (descriptor >= 0)
        unlink(temporary);
    free(temporary);
    return status;
}

enum status file_make_folder(const char *path, struct fault *fault) {
    char *copy = strdup(path);
    if (copy == NULL)
        return fault_set(fault, STATUS_NO_MEMORY, "%s: no memory", path);
    enum status status = STATUS_OK;
    for (char *end = copy + 1; status == STATUS_OK && *copy != '\0'; end++) {
        if (*end != '/' && *end != '\0')
            continue;
        char kept = *end;
        *end = '\0';
        struct stat about;
        if (mkdir(copy, 0777) != 0 && errno != EEXIST)
            status = fault_set(fault, STATUS_IO, "%s: cannot be made: %s", copy, strerror(errno));
        else if (stat(copy, &about) != 0 || !S_ISDIR(about.st_mode))
            status = fault_set(fault, STATUS_IO, "%s: is not a folder", copy);
        *end = kept;
        if (kept == '\0')
            break;
    }
    if (status == STATUS_OK && access(path, W_OK | X_OK) != 0)
        status = fault_set(fault, STATUS_IO, "%s: cannot be written to: %s", path, strerror(errno));
    free(copy);
    return status;
}

enum status file_check_room(const char *folder, double bytes, struct fault *fault) {
    char *place = strdup(*folder == '\0' ? "." : folder);
    if (place == NULL)
        return fault_set(fault, STATUS_NO_MEMORY, "%s: no memory", folder);
    /* The nearest ancestor that exists is where the folder would be made. */
    struct stat about;
    while (stat(place, &about) != 0 && errno == ENOENT) {
        char *parent = strdup(dirname(place));
        free(place);
        place = parent;
        if (place == NULL)
            return fault_set(fault, STATUS_NO_MEMORY, "%s: no memory", folder);
    }
    enum status status = STATUS_OK;
    struct statvfs system;
    if (access(place, W_OK | X_OK) != 0)
        status =
            fault_set(fault, STATUS_IO, "%s: cannot be written to: %s", place, strerror(errno));
    else if (!S_ISDIR(about.st_mode))
        status = fault_set(fault, STATUS_IO, "%s: is not a folder", place);
    else if (statvfs(place, &system) != 0)
        status = fault_set(fault, STATUS_IO, "%s: %s", place, strerror(errno));
    else {
        double room = (double)system.f_bavail * (double)system.f_frsize;
        if (room < bytes)
            status = fault_set(fault, STATUS_IO, "%s: %.3g MB free, %.3g MB needed", place,
                               room / 1e6, bytes / 1e6);
    }
    free(place);
    return status;
}

bool file_exists(const char *path) {
    return access(path, F_OK) == 0;
}

bool file_name_is_inside(const char *path) {
    if (*path == '\0' || *path == '/')
        return false;
    for (const char *c = path; *c != '\0'; c++)
        if ((unsigned char)*c < 0x20 || *c == 0x7f)
            return false;
    for (const char *part = path; part != NULL; part = strchr(part, '/')) {
        part += *part == '/';
        if (strncmp(part, "..", 2) == 0 && (part[2] == '/' || part[2] == '\0'))
            return false;
    }
    return true;
}

char *file_join(const char *folder, const char *name) {
    char *path;
    bool slash = *folder != '\0' && folder[strlen(folder) - 1] != '/';
    return asprintf(&path, "%s%s%s", folder, slash ? "/" : "", name) < 0 ? NULL : path;
}
