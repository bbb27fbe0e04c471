/* ensembles.h -- ensemble fits of other files, for ensemble.c only. */
#ifndef VALIDATION_ENSEMBLES_H
#define VALIDATION_ENSEMBLES_H

#include "validation/ensemble.h"

extern const struct ensemble ensemble_relaxation; /* ensemble_relaxation.c */

#endif
