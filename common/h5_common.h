/* h5_common.h -- what the writer (h5.c) and the reader (h5_read.c) share. */
#ifndef COMMON_H5_COMMON_H
#define COMMON_H5_COMMON_H

#include "common/h5.h"

#include <hdf5.h>

/* Plug-ins off and HDF5's own printing of errors off; to be called before any
 * file is opened, as often as one likes. */
void h5_common_start(void);

/* "path: what: HDF5's innermost message".  To be called right after the call
 * that failed: the next HDF5 call forgets the message. */
enum status h5_common_fault(struct fault *fault, const char *path, const char *what);

#endif
