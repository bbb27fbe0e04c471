/* h5.h -- HDF5 files that repeat byte for byte, and a reader that trusts none.
 *
 * Writing: no time stamps, Fletcher-32 on every chunked dataset, a `unit`
 * attribute on every dataset; the file grows under PATH.tmp.PID and gets its
 * name when it is complete and synced.
 * Reading: plug-ins off; external and soft links, external storage, virtual
 * datasets and filters other than deflate, shuffle and fletcher32 are refused;
 * a dataset's size is compared with what the caller expects before any memory
 * is taken.  Every fault names the file and the dataset.
 */
#ifndef COMMON_H5_H
#define COMMON_H5_H

#include "common/fault.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum h5_type { H5_REAL, H5_INTEGER }; /* IEEE double; signed 64 bit */
enum { H5_MAX_RANK = 4 };

struct h5_writer; /* opaque */
struct h5_reader; /* opaque */

/* -- writing -------------------------------------------------------------- */
enum status h5_create(const char *path, struct h5_writer **out, struct fault *fault);

/* A fixed dataset; groups on the way are made.  data[product of dims]. */
enum status h5_write(struct h5_writer *w, const char *name, enum h5_type type, int rank,
                     const size_t *dims, const void *data, const char *unit, struct fault *fault);

/* Append one sample to the H5MD time series group `name`: group/{step,time,value}
 * with value[T][dims...]; made at the first call.  rank is that of one sample
 * (0 for a scalar).  time_unit goes on `time`. */
enum status h5_append(struct h5_writer *w, const char *name, enum h5_type type, int rank,
                      const size_t *dims, const void *data, const char *unit, long long step,
                      double time, const char *time_unit, struct fault *fault);

/* Make `link` (a path) a hard link to `target`; nothing happens where it is one. */
enum status h5_link(struct h5_writer *w, const char *target, const char *link, struct fault *fault);

/* Attributes of a group or dataset; the group is made when there is none, an
 * attribute of that name is replaced. */
enum status h5_attribute_text(struct h5_writer *w, const char *object, const char *name,
                              const char *text, struct fault *fault);
enum status h5_attribute_texts(struct h5_writer *w, const char *object, const char *name,
                               const char *const *texts, size_t count, struct fault *fault);
enum status h5_attribute_integers(struct h5_writer *w, const char *object, const char *name,
                                  const int *values, size_t count, struct fault *fault);
enum status h5_attribute_reals(struct h5_writer *w, const char *object, const char *name,
                               const double *values, size_t count, struct fault *fault);

/* Flush, close, sync, rename.  Frees w in every case; on error no file is left. */
enum status h5_commit(struct h5_writer *w, struct fault *fault);
void h5_discard(struct h5_writer *w); /* drop the unfinished file; NULL is allowed */

/* -- reading -------------------------------------------------------------- */
enum status h5_open(const char *path, struct h5_reader **out, struct fault *fault);
void h5_close(struct h5_reader *r); /* NULL is allowed */
const char *h5_path(const struct h5_reader *r);
bool h5_has(const struct h5_reader *r, const char *name);

/* Rank and dims[0 .. H5_MAX_RANK-1] of a dataset; STATUS_NOT_FOUND names it. */
enum status h5_dims(struct h5_reader *r, const char *name, int *rank, size_t *dims,
                    struct fault *fault);

/* The whole dataset as doubles (integers are converted), at most max_count of
 * them: *out[product of dims], to be freed. */
enum status h5_read(struct h5_reader *r, const char *name, size_t max_count, double **out,
                    size_t *count, struct fault *fault);

/* The same into out[0 .. count-1]; STATUS_BAD_INPUT where it has not exactly count values. */
enum status h5_read_exactly(struct h5_reader *r, const char *name, size_t count, double *out,
                            struct fault *fault);

/* One slab of the first dimension: value[index][...] into out[count], where
 * count must equal the product of the other dimensions. */
enum status h5_read_slab(struct h5_reader *r, const char *name, size_t index, size_t count,
                         double *out, struct fault *fault);

enum status h5_read_text(struct h5_reader *r, const char *object, const char *attribute, char *out,
                         size_t size, struct fault *fault);

/* An attribute of reals, a number or a list of at most max_count: *out[0 .. count-1],
 * to be freed.  STATUS_NOT_FOUND when there is none; STATUS_BAD_INPUT when it is text. */
enum status h5_read_reals(struct h5_reader *r, const char *object, const char *attribute,
                          size_t max_count, double **out, size_t *count, struct fault *fault);

/* The `unit` attribute of a dataset. */
enum status h5_unit(struct h5_reader *r, const char *name, char *out, size_t size,
                    struct fault *fault);

#endif
