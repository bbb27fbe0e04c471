/* accept.h -- from measured cases to stored references: what changes, and writing it whole.
 *
 * Of a case and tier it gathers the ensemble of every row that chance may decide
 * (scatter.h), the value of each of the case's own seeds where a check is paired, and in
 * the smoke tier the bits of the runs with the case's own seeds.  A line whose numbers are
 * as before stays as it is, with its commit, date and reason.  Lines of other tiers and from
 * outside (published, independent, analytic) stay.  Bits of other classes of build stay only
 * where those of this class are as they were: else they are of code that is no more.
 *
 * Leaves out: who may accept, and when: command_accept.c.
 * Checked by: tests/unit/test_accept.c, tests/cli/test_bedcheck_accept.py.
 */
#ifndef VALIDATION_ACCEPT_H
#define VALIDATION_ACCEPT_H

#include "validation/accept_claims.h"
#include "validation/folder.h"
#include "validation/measure.h"
#include "validation/reference.h"

struct accept_change { /* one of them may be NULL: a new line, a line that goes */
    const struct reference *old, *new;
};

struct accept_case {
    struct arena arena;
    const struct plan_case *plan;
    struct references *old;
    size_t count, change_count;
    struct reference *item;       /* all lines of the new table */
    struct accept_change *change; /* in the order of new lines, then those that go */
    size_t omission_count;
    const char **omission; /* rows that give no ensemble, and why */
};

struct accept_history { /* of new lines */
    const char *commit, *solver_key, *date, *reason;
};

struct accept_source {
    const struct measured_case *measured;
    const struct case_seeds *own; /* the seeds that the case's text asks for */
    const struct folder *results;
    const char *references_folder;
    struct accept_history history;
};

/* STATUS_BAD_INPUT, with all findings, when rows have too few seeds or a regression check no
 * ensemble.  Borrows from the source. */
enum status accept_gather(const struct accept_source *source, struct accept_case *out,
                          struct fault *fault);
void accept_free(struct accept_case *c);

/* Difference of two lines in units of its standard uncertainty; NaN where there is none. */
double accept_difference(const struct accept_change *change);

/* The tables of all cases that changed, and that of the claims (NULL: none): all, or none. */
enum status accept_write(const char *references_folder, const struct accept_case *list,
                         size_t count, const struct accept_claims *claims, struct fault *fault);

#endif
