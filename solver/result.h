/* result.h -- the result file of one run: H5MD header, parameters, samples.
 *
 * H5MD 1.1 for particles; /fields and /observables beside them; /parameters
 * holds every resolved parameter as an attribute.  Nothing volatile is written:
 * the same run file, seed and build give the same bytes.  What does change from
 * run to run (times, host) goes to the .run.json beside it.
 */
#ifndef SOLVER_RESULT_H
#define SOLVER_RESULT_H

#include "solver/model.h"

/* /h5md, /parameters with every value and the seed. */
enum status result_begin(struct h5_writer *w, const struct model *m, const struct parameter_set *p,
                         uint64_t seed, struct fault *fault);

/* Append the wanted datasets of one kind.  */
enum status result_sample(struct h5_writer *w, const struct model *m, void *state,
                          const struct runfile *run, enum dataset_when when, struct fault *fault);

/* Every dataset of the run file is one of the model's; names the first that is not. */
enum status result_check_datasets(const struct model *m, const struct runfile *run,
                                  const char *path, struct fault *fault);

/* "x/y.h5" -> "x/y.run.json"; free() it. NULL without memory. */
char *result_record_path(const char *result_path);

#endif
