/* desk.h -- from finished runs to verdicts, files and the last line.
 *
 * Both `run` and `check` keep one desk: cases are measured and judged as soon as
 * their runs are complete, told on the console, and filed at the end.
 */
#ifndef VALIDATION_DESK_H
#define VALIDATION_DESK_H

#include "validation/assemble.h"
#include "validation/command.h"

struct desk; /* opaque */

/* console NULL: nothing is told, and nothing may be filed.
 * All borrowed; outcome[0 .. plan->run_count-1] may change until a case is judged. */
enum status desk_create(const struct plan *plan, const struct outcome *outcome,
                        const struct execute_options *execute, const struct console *console,
                        struct desk **out, struct fault *fault);
void desk_free(struct desk *d); /* NULL is allowed */

/* The references and the share of false alarms to judge by; borrowed.  Without it, what needs a
 * reference is inconclusive. */
void desk_set_budget(struct desk *d, const struct budget *b);

/* Judge every case whose runs are all settled and that is not judged yet.
 * *worst is the worst verdict so far. */
enum status desk_judge(struct desk *d, enum verdict *worst, struct fault *fault);

/* Of case i of the plan: NULL where it is not judged (yet).  The desk's, until it is freed. */
const struct measured_case *desk_measured(const struct desk *d, size_t i);
const struct rows *desk_rows(const struct desk *d, size_t i);

/* Write results.json, junit.xml, summary.md and, with `page`, report/index.html;
 * print the last line; *exit_code says 0, 1 or 3. */
enum status desk_file(struct desk *d, const struct folder_record *record, bool page, int *exit_code,
                      struct fault *fault);

#endif
