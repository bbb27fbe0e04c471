/* relaxation_theory.h -- L(t) and its rate as theory has them, read as those of runs are.
 *
 * The solved profile in bins of 1 R, from rest, at evenly spaced times to the end of the window; L
 * of FZ Eq. 15 against the profile at the change, and relaxation_fit.h on it. The kinematic wave's
 * changes all spread at constant speeds, so its L is sqrt(t) exactly until the fan is where the
 * top was, and no exponential; the rate is what the fit makes of it.
 *
 * Source:     Fiege & Zippelius, Eq. 15 and Fig. 7; docs/theory.md, S7.
 * Leaves out: noise.
 * Checked by: tests/unit/test_relaxation_fit.c.
 */
#ifndef VALIDATION_RELAXATION_THEORY_H
#define VALIDATION_RELAXATION_THEORY_H

#include "validation/bed_change.h"
#include "validation/relaxation_fit.h"

/* The window of the fit (s) if none is given: twice h1/(c phibar), the end of the kinematic wave.
 */
double relaxation_theory_window(const struct bed_change *change);

/* length[0 .. count-1] (sqrt(R)) at time_s[0 .. count-1] since the change, with or without
 * pressure. */
enum status relaxation_theory_length(const struct bed_change *change, bool pressure,
                                     const double *time_s, size_t count, double *length,
                                     struct fault *fault);
/* The fit of it from 0 to window_s (0: the standard one). */
enum status relaxation_theory_fit(const struct bed_change *change, bool pressure, double window_s,
                                  struct relaxation_fit *out, struct fault *fault);

#endif
