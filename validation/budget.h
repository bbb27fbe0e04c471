/* budget.h -- one allowance of false alarms for the whole suite, and who may draw on it.
 *
 * Unchanged code may raise an alarm, a FAIL or an INCONCLUSIVE, in one of a
 * thousand runs of the suite.  Each check whose verdict hangs on chance, at each
 * of its points, gets an equal share, 1e-3 / N with N counted over every case of
 * the folder that has the tier, selected or not: what is run today does not
 * change what a check may do.  Bonferroni: no independence is assumed.
 *
 * A regression check keeps its share by construction (judge.h).  The rate of a
 * model check follows from its margin and is computed where there is an ensemble
 * (alarm.h); the report says the sum, and how many rates are not known.
 *
 * Opening a budget reads the references too, and refuses, before anything is run,
 * a reference that no check uses and a regression check whose reference cannot
 * show the change that it says it detects.
 *
 * Checked by: tests/unit/test_budget.c, tests/unit/test_judge_regression.c.
 */
#ifndef VALIDATION_BUDGET_H
#define VALIDATION_BUDGET_H

#include "validation/reference.h"
#include "validation/selection.h"

/* Probability of any alarm in one run of a tier by unchanged code. */
#define SUITE_FALSE_ALARMS 1e-3

struct budget {
    struct selection *selection;
    struct plan *plan;              /* of every case of the folder that has the tier */
    struct references **references; /* references[0 .. plan->case_count-1] */
    size_t statistical;             /* rows, over all those cases */
    double share;                   /* of each */
};

/* references_folder NULL: there are none.  With `wanted`, only its cases must be good: others that
 * cannot be read are left out, for they cannot raise alarms either.  Without it all must be.
 * On error *out is NULL and fault has every finding. */
enum status budget_open(const char *cases_folder, const char *references_folder, enum tier tier,
                        const struct plan *wanted, struct budget **out, struct fault *fault);
/* The same for who is to replace references: checks that cannot see what they say and
 * references that no check uses are let be. */
enum status budget_open_unrefused(const char *cases_folder, const char *references_folder,
                                  enum tier tier, const struct plan *wanted, struct budget **out,
                                  struct fault *fault);
void budget_close(struct budget *b); /* NULL is allowed */

/* The stored references of a case; NULL where the budget has no such case. */
const struct references *budget_references(const struct budget *b, const char *case_name);

/* Rows of c's tier whose verdict hangs on chance. */
size_t budget_count(const struct plan_case *c);

/* Adds a finding, with file and line, for each regression check of c that cannot see what it says
 * it detects with this share. */
enum status budget_refuse(const struct plan_case *c, const struct references *r, double share,
                          struct fault *fault);

#endif
