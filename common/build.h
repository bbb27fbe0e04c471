/* build.h -- what this program was made from: filled in at every build.
 *
 * The commit and the dirty flag come from git at build time, not at configure
 * time; outside a git checkout both read "unknown".
 */
#ifndef COMMON_BUILD_H
#define COMMON_BUILD_H

#include "common/json.h"

const char *build_version(void);  /* of the suite: "0.1.0" */
const char *build_commit(void);   /* 40 hex digits or "unknown" */
const char *build_dirty(void);    /* "clean", "dirty" or "unknown" */
const char *build_compiler(void); /* "gcc 12.2.0" */
const char *build_flags(void);    /* the C flags of this build type */

/* One line for --version: name, version, commit, dirty flag, compiler. Free() it. */
char *build_line(const char *program);

/* The members of a JSON object that is open in j: commit, dirty, compiler,
 * flags, versions of GSL, HDF5 and libyaml, machine, C library, CPU model, host. */
void build_describe(struct json *j);

#endif
