/* earlier.h -- the verdicts of an earlier run, for --failed. */
#ifndef VALIDATION_EARLIER_H
#define VALIDATION_EARLIER_H

#include "validation/command.h"

struct earlier {
    struct arena arena;
    enum tier tier; /* of the earlier run */
    size_t count;
    const char **name; /* cases with a check that did not pass, each once */
};

/* From DIR/results.json and DIR/bedcheck.yaml, o->out being DIR.  STATUS_NOT_FOUND
 * when there are none or when every check passed. */
enum status earlier_read(const struct command_options *o, struct earlier *out, struct fault *fault);
void earlier_free(struct earlier *e);

#endif
