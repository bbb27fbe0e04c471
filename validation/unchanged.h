/* unchanged.h -- which runs have the bits of their reference.
 *
 * A run whose stored bits (bits.h) were made by the same class of build, from
 * the same text of the case, either has them still, and then nothing has changed
 * in it, or has others, and then statistics decide.  Which of the two happened is
 * told with each row and counted for the report.  The numbers of a run with
 * unchanged bits are judged all the same: it costs nothing, and shows a recipe
 * that has changed.
 *
 * Checked by: tests/unit/test_unchanged.c.
 */
#ifndef VALIDATION_UNCHANGED_H
#define VALIDATION_UNCHANGED_H

#include "validation/folder.h"
#include "validation/measure.h"
#include "validation/reference.h"

enum unchanged { UNCHANGED_UNKNOWN, UNCHANGED_SAME, UNCHANGED_OTHER };

struct unchanged_count {
    size_t same, other, unknown; /* runs */
};

/* One run; unknown where there is no reference that it could be compared with. */
enum status unchanged_look(const struct plan_case *c, const struct references *references,
                           const struct folder *results, const struct measured_point *p,
                           const struct measured_run *r, enum unchanged *out, struct fault *fault);

void unchanged_add(struct unchanged_count *n, enum unchanged u);

/* "same bits as the reference", "other bits than the reference in 1 of 2 runs"; NULL where
 * nothing is known (or no memory). */
const char *unchanged_text(const struct unchanged_count *n, struct arena *a);

#endif
