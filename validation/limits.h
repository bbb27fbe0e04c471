/* limits.h -- what no check can see: a file of sentences beside the folder of cases.
 *
 *     limits:
 *       - {model: suspension, what: rotation of spheres, because: collisions are smooth}
 *
 * A model of `any` is for all.  The report's first screen names them, of the
 * models that its cases have.
 *
 * Checked by: tests/unit/test_limits.c.
 */
#ifndef VALIDATION_LIMITS_H
#define VALIDATION_LIMITS_H

#include "report/report.h"
#include "validation/arena.h"

/* Those of r's models, "any" last, in r->limit; no file is no limit and no fault.  Unknown keys and
 * blank texts are refused with their place. */
enum status limits_add(const char *cases_folder, struct report *r, struct arena *a,
                       struct fault *fault);

#endif
