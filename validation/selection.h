/* selection.h -- which cases of a folder are meant: patterns, tags, tiers, skips.
 *
 * Patterns are matched with whole names, '*' passing over '/' as well.  Every
 * pattern and every skip must match something, and something must be left to run.
 * A case without the tier is left out, unless it was named in full.
 */
#ifndef VALIDATION_SELECTION_H
#define VALIDATION_SELECTION_H

#include "validation/plan.h"

struct selection_request {
    const char *folder; /* of case files */
    size_t pattern_count, tag_count, skip_count;
    const char *const *pattern; /* none: every case */
    const char *const *tag;     /* a case has one of them; none: no matter */
    const char *const *skip;    /* "CASE=reason" */
    bool any_tier;              /* `list`: leave none out for its tier, check all readings */
    enum tier tier;
    bool lenient; /* leave out what cannot be read, and what starts from it */
};

struct selection {
    struct arena arena;
    size_t count, all_count;
    struct plan_order *order; /* order[0 .. count-1], sorted by name */
    struct case_file **all;   /* owned: those selected and those they start from */
};

enum status selection_make(const struct selection_request *r, struct selection **out,
                           struct fault *fault);
void selection_free(struct selection *s); /* NULL is allowed */

#endif
