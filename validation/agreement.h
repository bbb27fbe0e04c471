/* agreement.h -- all checks of a report at once: bias and scatter of measured over expected.
 *
 * Each row that compares a measured m with an expected e has x = ln(m/e).  Over
 * n rows with mean <x> and variance s^2 = sum (x - <x>)^2 / (n - 1), as the fire
 * models' validation guide does it (McGrattan & Toman, Metrologia 48, 173
 * (2011); there the experiments' part is taken off, here it is said beside):
 *
 *     bias  = exp <x>
 *     scatter = s,  noise^2 = < (u_m/m)^2 + (u_e/e)^2 >
 *
 * Rows of one case share runs and are not independent: cases are.  The 95 %
 * intervals of <x> and of ln s are Student's with the jackknife's error over
 * C cases, s_J^2 = (C-1)/C sum (theta_(-c) - mean theta_(-c))^2.
 *
 * Takes: rows "within" a tolerance below half of what is expected, of the same
 * sign.  Leaves out, and counts: round-off (its scatter is that of zero),
 * one-sided rows, comparisons with references (the code with itself).
 * Checked by: tests/unit/test_agreement.c.
 */
#ifndef VALIDATION_AGREEMENT_H
#define VALIDATION_AGREEMENT_H

#include "report/report.h"
#include "validation/arena.h"

/* One group a model (what a case's name begins with) and one for all where there are several;
 * r->agreement stays NULL where fewer than two rows qualify. */
enum status agreement_add(struct report *r, struct arena *a, struct fault *fault);

#endif
