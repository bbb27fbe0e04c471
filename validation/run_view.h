/* run_view.h -- one finished run as the observables see it.
 *
 * The flat parameters it was run with (as the case asked, not as --set
 * overrode them), its sample times, and its result file behind the contract of
 * docs/contract.md.  Frames are read when asked for and kept until the view is
 * closed.  Every access checks shape and finiteness: a NaN or a missing frame
 * is a fault that names file, dataset and frame.
 */
#ifndef VALIDATION_RUN_VIEW_H
#define VALIDATION_RUN_VIEW_H

#include "common/fault.h"

#include <stdbool.h>
#include <stddef.h>

struct run_view; /* opaque */

/* run file (flat, DIR/runs/ID.yaml) and result file (DIR/h5/ID-sSEED.h5). */
enum status run_view_open(const char *run_path, const char *result_path, struct run_view **out,
                          struct fault *fault);
void run_view_close(struct run_view *v); /* NULL is allowed */

/* Is every dataset there that the run file asks for, and has every series one
 * frame for each of the times asked for?  The fault names the first that has not. */
enum status run_view_check_asked(struct run_view *v, struct fault *fault);

/* A parameter: the run file's, else what the result file says the solver used
 * (attributes of /parameters).  A choice is compared with run_view_parameter_is. */
enum status run_view_parameter(struct run_view *v, const char *name, double *out,
                               struct fault *fault);
enum status run_view_parameter_list(struct run_view *v, const char *name, const double **values,
                                    size_t *count, struct fault *fault);
enum status run_view_parameter_text(struct run_view *v, const char *name, const char **out,
                                    struct fault *fault);

/* A time series: /NAME/{step,time,value}.  value[frame * size .. + size-1]. */
struct series {
    size_t frames, size; /* size = product of dims of one frame */
    int rank;            /* of one frame */
    size_t dims[3];
    const double *time, *value; /* time[0 .. frames-1]; value[0 .. frames*size-1] */
    const double *step;         /* step[0 .. frames-1] */
    char unit[32];
};

/* Borrowed from the view until it is closed. */
enum status run_view_series(struct run_view *v, const char *name, const struct series **out,
                            struct fault *fault);

/* A fixed dataset, e.g. particles/grains/radius. */
enum status run_view_array(struct run_view *v, const char *name, const double **values,
                           size_t *count, struct fault *fault);

const char *run_view_path(const struct run_view *v); /* of the result file, for messages */

#endif
