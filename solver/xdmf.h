/* xdmf.h -- a sidecar that lets viewers (ParaView, VisIt) open a result file.
 *
 * XDMF 3: XML that names the arrays of FILE.h5 and copies none.  The lattice's fields become a
 * temporal collection of 2-D lattices, the particles one of points, each frame with its time.
 * Fields and velocities with components become one scalar a component (viewers want three of a
 * vector). What a viewer needs of the file is told by its shapes, so that any result that keeps
 * docs/contract.md will do.
 *
 * Source:     www.xdmf.org, XDMF Model and Format: Grid, Topology, Geometry, HyperSlab.
 * Leaves out: profiles and observables, which are curves (see docs/opening.md).
 * Checked by: tests/cli/test_xdmf.py.
 */
#ifndef SOLVER_XDMF_H
#define SOLVER_XDMF_H

#include "common/h5.h"

/* Write the sidecar of `result` beside it; *path, to be freed, is its name, x.xdmf of x.h5.
 * STATUS_NOT_FOUND where it has neither fields nor particles. */
enum status xdmf_write(struct h5_reader *result, char **path, struct fault *fault);

#endif
