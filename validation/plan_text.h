/* plan_text.h -- the text of a run file (common/runfile.h), for plan.c. */
#ifndef VALIDATION_PLAN_TEXT_H
#define VALIDATION_PLAN_TEXT_H

#include "validation/case.h"

struct plan_text_input {
    const struct case_file *file;
    const struct case_tier *tier;
    const char *point;
    const struct case_parameter *parameter; /* parameter[0 .. count-1] */
    size_t count;
    const char *start_file; /* relative to DIR/runs, or NULL */
};

/* The run file; with the origin of each parameter as a comment, or without any
 * comment, so that moving a line in a case file makes no run stale.  NULL: no memory. */
const char *plan_text(struct arena *a, const struct plan_text_input *in, bool origins);

/* What makes a run different from others: everything but the point's name and
 * the seed, with the id of the run that it starts from.  NULL: no memory. */
const char *plan_text_identity(struct arena *a, const struct case_file *file,
                               const struct case_tier *tier, const struct case_parameter *parameter,
                               size_t count, const char *start_id);

/* Size of the result file in bytes: sizes from the parameters grains, width_l, height_l,
 * particles, height_R and profile_bin_R where the case has them, else those of the
 * largest published run. */
double plan_text_bytes(const struct plan_text_input *in);

#endif
