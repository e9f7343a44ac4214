/* Several runs side by side in lanes: candidate designs, each in its own scenario. */
#ifndef CZ_SIMULATE_BATCH_H
#define CZ_SIMULATE_BATCH_H

#include "crushzone/simulate.h"
#include "problem/input.h"

/* A design in the scenario of a model: the whole vehicle array of the model's problem with the
 * design's values; NULL for the problem's own. */
typedef struct CzPlannedRun {
    const CzModel *model;
    const CzVehicle *vehicles;
} CzPlannedRun;

/* Simulates n > 0 designs; run[i] is made for each and freed by the caller. All models must fit
 * together. The result of a run does not depend on its neighbours, to the last bit. A design whose
 * vehicles make no valid model yields a run with status CZ_STATUS_RUN_FAILED. Channels are recorded
 * for a single design only. Statuses: CZ_OK, CZ_STATUS_NO_MEMORY. */
CZ_MUST_CHECK CzStatus cz_simulate_batch(int n, const CzPlannedRun *planned,
                                         const CzSimulateOptions *options, CzRun **run,
                                         CzError *error);

/* Whether runs of two models can be in one batch: as many cars with the same kinds of parts, the
 * same time step, and the same method for the track. */
bool cz_simulate_fits(const CzModel *a, const CzModel *b, const CzSimulateOptions *options);

/* Runs that fill the lanes well for this model, at least 1; blocks of lanes that n runs need. */
int cz_simulate_batch_width(const CzModel *model);
int cz_simulate_n_block(const CzModel *model, int n);

#endif
