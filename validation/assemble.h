/* assemble.h -- judged cases put together into the report's structs.
 *
 * Adds to the rows what a reader needs beside them: figures, provenance taken
 * from the run records (commit, compiler, machine), times, and the mark
 * MODIFIED where --set was used.
 */
#ifndef VALIDATION_ASSEMBLE_H
#define VALIDATION_ASSEMBLE_H

#include "validation/rows.h"

struct papers;

struct assemble_case {
    const struct plan_case *plan;
    const struct measured_case *measured; /* NULL: not judged, see plan->skip_reason or not_run */
    const struct rows *rows;
    const char *not_run; /* why a case that was not skipped has no rows, or NULL */
};

struct assemble_input {
    const struct folder_record *record;
    const struct assemble_case *cases; /* cases[0 .. case_count-1] */
    size_t case_count;
    const struct plan *plan;
    const struct outcome *outcome; /* outcome[0 .. plan->run_count-1] */
    const struct folder *folder;
    const struct budget *budget; /* or NULL */
    const char *program;         /* path of bedcheck, for commands to copy; NULL: its name */
    const struct papers *papers; /* or NULL; outlive the result */
};

struct assembled {
    struct arena arena;
    struct report report;
};

/* Everything but figures must live as long as the result. */
enum status assemble_report(const struct assemble_input *in, struct assembled **out,
                            struct fault *fault);
void assemble_free(struct assembled *a); /* NULL is allowed */

#endif
