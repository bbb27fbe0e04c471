/* predictions.c -- the list of predictions.  A new one is one entry in its topic's
 * table and one line here. */
#include "validation/predictions.h"

#include <string.h>

static const struct prediction *const PREDICTIONS[] = {
    &PREDICT_SETTLING[0],    &PREDICT_SETTLING[1],    &PREDICT_SETTLING[2],
    &PREDICT_SETTLING[3],    &PREDICT_SETTLING[4],    &PREDICT_GAS[0],
    &PREDICT_GAS[1],         &PREDICT_GAS[2],         &PREDICT_GAS[3],
    &PREDICT_GAS[4],         &PREDICT_GAS[5],         &PREDICT_GAS[6],
    &PREDICT_GAS[7],         &PREDICT_GAS[8],         &PREDICT_GAS[9],
    &PREDICT_GAS[10],        &PREDICT_GAS[11],        &PREDICT_GAS[12],
    &PREDICT_DISCS[0],       &PREDICT_DISCS[1],       &PREDICT_DISCS[2],
    &PREDICT_BED[0],         &PREDICT_BED[1],         &PREDICT_BED[2],
    &PREDICT_BED[3],         &PREDICT_BED[4],         &PREDICT_BED[5],
    &PREDICT_BED[6],         &PREDICT_SPHERES[0],     &PREDICT_SPHERES[1],
    &PREDICT_SPHERES[2],     &PREDICT_SPHERES[3],     &PREDICT_SPHERES[4],
    &PREDICT_SPHERES[5],     &PREDICT_SPHERES[6],     &PREDICT_SUSPENSION[0],
    &PREDICT_SUSPENSION[1],  &PREDICT_SUSPENSION[2],  &PREDICT_SUSPENSION[3],
    &PREDICT_SUSPENSION[4],  &PREDICT_SUSPENSION[5],  &PREDICT_SUSPENSION[6],
    &PREDICT_SUSPENSION[7],  &PREDICT_SUSPENSION[8],  &PREDICT_SUSPENSION[9],
    &PREDICT_SUSPENSION[10], &PREDICT_SUSPENSION[11], &PREDICT_SUSPENSION[12],
    &PREDICT_SUSPENSION[13], &PREDICT_SUSPENSION[14], &PREDICT_INTERFACE[0],
    &PREDICT_INTERFACE[1],   &PREDICT_INTERFACE[2],   &PREDICT_INTERFACE[3],
    &PREDICT_INTERFACE[4],   &PREDICT_INTERFACE[5],   &PREDICT_INTERFACE[6],
    &PREDICT_INTERFACE[7],   &PREDICT_INTERFACE[8],   &PREDICT_STEP[0],
    &PREDICT_STEP[1],        &PREDICT_STEP[2],        &PREDICT_STEP[3],
    &PREDICT_STEP[4],        &PREDICT_STEP[5],        &PREDICT_STEP[6],
    &PREDICT_STEP[7],        &PREDICT_STEP[8],        &PREDICT_STEP[9],
    &PREDICT_STEP[10],       &PREDICT_STEP[11],
};
enum { PREDICTION_COUNT = sizeof PREDICTIONS / sizeof *PREDICTIONS };
_Static_assert(PREDICTION_COUNT == PREDICT_SETTLING_COUNT + PREDICT_GAS_COUNT +
                                       PREDICT_DISCS_COUNT + PREDICT_BED_COUNT +
                                       PREDICT_SPHERES_COUNT + PREDICT_SUSPENSION_COUNT +
                                       PREDICT_INTERFACE_COUNT + PREDICT_STEP_COUNT,
               "every prediction of every table stands in the list");

const struct prediction *prediction_find(const char *name) {
    for (size_t i = 0; i < PREDICTION_COUNT; i++)
        if (!strcmp(PREDICTIONS[i]->name, name))
            return PREDICTIONS[i];
    return NULL;
}

const struct prediction *const *prediction_all(size_t *count) {
    *count = PREDICTION_COUNT;
    return PREDICTIONS;
}
