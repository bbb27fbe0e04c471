/* file.h -- files and folders: read whole, written whole or not at all. */
#ifndef COMMON_FILE_H
#define COMMON_FILE_H

#include "common/fault.h"

#include <stdbool.h>
#include <stddef.h>

/* Whole file, NUL-terminated; free() it. */
enum status file_read(const char *path, size_t max_bytes, char **out, size_t *length,
                      struct fault *fault);

/* Written to PATH.tmp.PID, synced, renamed: a reader sees the old or the new. */
enum status file_write(const char *path, const char *text, size_t length, struct fault *fault);

/* Sync the finished file `temporary`, rename it to path, sync the folder.  On
 * error the temporary file is removed and path is as it was. */
enum status file_replace(const char *temporary, const char *path, struct fault *fault);

/* PATH.tmp.PID; free() it, NULL for lack of memory. */
char *file_temporary(const char *path);

/* mkdir -p; STATUS_IO names the folder that could not be made or written to. */
enum status file_make_folder(const char *path, struct fault *fault);

/* A folder that exists (or can be made) is writable and has `bytes` free. */
enum status file_check_room(const char *folder, double bytes, struct fault *fault);

bool file_exists(const char *path);

/* A relative path without "..", control characters or a leading '/': safe to
 * join to a folder of ours. */
bool file_name_is_inside(const char *path);

/* asprintf that never returns NULL but for lack of memory; free() it. */
char *file_join(const char *folder, const char *name);

#endif
