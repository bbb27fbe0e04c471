/* predictions.h -- every prediction there is, for predictions.c only. */
#ifndef VALIDATION_PREDICTIONS_H
#define VALIDATION_PREDICTIONS_H

#include "validation/prediction.h"

enum {
    PREDICT_SETTLING_COUNT = 5,
    PREDICT_GAS_COUNT = 13,
    PREDICT_DISCS_COUNT = 3,
    PREDICT_BED_COUNT = 7,
    PREDICT_SPHERES_COUNT = 7,
    PREDICT_SUSPENSION_COUNT = 15,
    PREDICT_INTERFACE_COUNT = 9,
    PREDICT_STEP_COUNT = 12
};

extern const struct prediction PREDICT_SETTLING[PREDICT_SETTLING_COUNT]; /* predict_settling.c */
extern const struct prediction PREDICT_GAS[PREDICT_GAS_COUNT];           /* predict_gas.c */
extern const struct prediction PREDICT_DISCS[PREDICT_DISCS_COUNT];       /* predict_discs.c */
extern const struct prediction PREDICT_BED[PREDICT_BED_COUNT];           /* predict_bed.c */
extern const struct prediction PREDICT_SPHERES[PREDICT_SPHERES_COUNT];   /* predict_spheres.c */
extern const struct prediction
    PREDICT_SUSPENSION[PREDICT_SUSPENSION_COUNT]; /* predict_suspension.c */
extern const struct prediction PREDICT_INTERFACE[PREDICT_INTERFACE_COUNT]; /* predict_interface.c */
extern const struct prediction PREDICT_STEP[PREDICT_STEP_COUNT];           /* predict_step.c */

#endif
