/* h5_common.c -- see h5_common.h. */
#include "common/h5_common.h"

#include <stdio.h>

void h5_common_start(void) {
    H5open();
    H5Eset_auto2(H5E_DEFAULT, NULL, NULL);
    H5PLset_loading_state(0);
}

static herr_t innermost(unsigned n, const H5E_error2_t *error, void *data) {
    char *text = data;
    if (n == 0 && error->desc != NULL)
        snprintf(text, 512, "%s", error->desc);
    return 0;
}

enum status h5_common_fault(struct fault *fault, const char *path, const char *what) {
    char text[512] = "HDF5 does not say why";
    H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, innermost, text);
    return fault_set(fault, STATUS_IO, "%s: %s: %s", path, what, text);
}
