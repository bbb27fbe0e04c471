/* multigrid.h -- conjugate gradients with a multigrid preconditioner, for the
 * symmetric five-point equations of the gas on a box of any size.
 *
 *     mass_k x_k + sum over the faces f of k of c_f (x_k - x_neighbour) = b_k
 *
 * with face coefficients c_f >= 0 and masses >= 0, at least one of them > 0.
 * One V-cycle preconditions: two red-black Gauss-Seidel sweeps down, the same
 * in reverse order up, so that the preconditioner is symmetric; aggregates of
 * 2 x 2 sites (narrower at a far edge of odd length), a constant carried back
 * to each.  A coarse face is the sum of the fine faces it covers over the
 * distance of the two aggregates' centres, which is what halves it when both
 * are two sites wide: with the plain sum a constant interpolation would be
 * too stiff by that factor.  The coarsest level is one site, solved exactly.
 *
 * Cost: O(sites) memory and work a cycle; 6 to 9 cycles for 1e-8 on beds,
 * 17 where neighbouring faces differ by up to 70 times without order.
 * Source:     the method is textbook (Trottenberg, Oosterlee & Schueller,
 *             Multigrid, 2001; Braess, Computing 55, 379 (1995) for the scaling).
 * Checked by: tests/unit/test_pressure.c against CHOLMOD.
 */
#ifndef GRAINGAS_MULTIGRID_H
#define GRAINGAS_MULTIGRID_H

#include "common/fault.h"

#include <stddef.h>

struct multigrid; /* opaque */

/* nx, ny >= 1 sites.  STATUS_NO_MEMORY. */
enum status multigrid_create(struct multigrid **out, int nx, int ny, struct fault *fault);
void multigrid_free(struct multigrid *m); /* NULL is allowed */

/* Set the equations.  east[k], north[k]: coefficient of the face from site k =
 * j nx + i to (i+1, j), (i, j+1); those that would leave the box are not read. */
void multigrid_set(struct multigrid *m, const double *east, const double *north,
                   const double *mass);

struct multigrid_outcome {
    int iterations;
    double residual; /* |b - A x| / |b| */
};

/* Solve to |b - A x| <= tolerance |b|; x[0 .. nx*ny-1] holds the first guess and
 * the answer.  STATUS_NUMERICAL when 100 cycles do not suffice or the residual
 * is not a number; *outcome is set in every case. */
enum status multigrid_solve(struct multigrid *m, const double *b, double tolerance, double *x,
                            struct multigrid_outcome *outcome, struct fault *fault);

#endif
