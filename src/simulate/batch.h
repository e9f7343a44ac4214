/* Several candidate designs of one model side by side in lanes. */
#ifndef CZ_SIMULATE_BATCH_H
#define CZ_SIMULATE_BATCH_H

#include "crushzone/simulate.h"
#include "problem/input.h"

/* Runs n_design designs of one model. vehicles[i] is the whole vehicle array of the problem with
 * the design's values (NULL takes the problem's own); run[i] is made for each and freed by the
 * caller. The result of a design does not depend on its neighbours, to the last bit. A design whose
 * vehicles make no valid model yields a run with status CZ_STATUS_RUN_FAILED. Statuses: CZ_OK,
 * CZ_STATUS_NO_MEMORY. */
CZ_MUST_CHECK CzStatus cz_simulate_batch(const CzModel *model, int n_design,
                                         const CzVehicle *const *vehicles,
                                         const CzSimulateOptions *options, CzRun **run,
                                         CzError *error);

/* Designs that fill the lanes well for this model, at least 1. */
int cz_simulate_batch_width(const CzModel *model);

#endif
