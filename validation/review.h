/* review.h -- a folder of results taken up again: what was asked for, and what is there.
 *
 * The folder's record, the cases as they read now, the plan that both make, and
 * every run inspected: each must be there and made from what the cases say now,
 * by one build of the solver.  Nothing is run or changed.
 *
 * Shared by check, report, accept, calibrate and compare.
 */
#ifndef VALIDATION_REVIEW_H
#define VALIDATION_REVIEW_H

#include "validation/execute.h"
#include "validation/selection.h"

struct review {
    struct arena arena;
    struct folder *folder; /* locked until the review is closed */
    struct folder_record record;
    const char *cases_folder, *references_folder; /* as given, else as recorded */
    struct selection *selection;
    struct plan *plan;
    struct outcome *outcome; /* outcome[0 .. plan->run_count-1]: reused or failed */
    struct execute_options execute;
};

/* The folders may be NULL: those of the record, which must have them then. */
enum status review_open(const char *folder, const char *cases_folder, const char *references_folder,
                        struct review **out, struct fault *fault);
void review_close(struct review *r); /* NULL is allowed */

/* Every point of the selected cases gets `count` seeds instead of its case's number; 0: as it is.
 */
enum status review_set_seeds(struct selection *s, size_t count, struct fault *fault);

#endif
