/* accept_files.h -- several text files replaced in one step: all of them, or none.
 *
 * New texts are staged beside the files, what is there is kept aside by a hard link,
 * and then each staged file is renamed.  Where one cannot be, those before it get
 * back what was kept.  A power cut between two renames is not undone: git is.
 *
 * Checked by: tests/unit/test_accept.c.
 */
#ifndef VALIDATION_ACCEPT_FILES_H
#define VALIDATION_ACCEPT_FILES_H

#include "common/fault.h"

#include <stddef.h>

struct accept_file {
    const char *path, *text;
};

enum status accept_files_write(const struct accept_file *file, size_t count, struct fault *fault);

#endif
