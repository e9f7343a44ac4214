/* Which runs of an evaluation are computed side by side in one batch. */
#ifndef CZ_EVALUATE_RUN_PLAN_H
#define CZ_EVALUATE_RUN_PLAN_H

#include "simulate/batch.h"

/* One design in one scenario. */
typedef struct CzRunItem {
    int design, scene;
    const CzModel *model;
    double length; /* expected duration of the run [s]; 0 when not known */
    int group;     /* of models that fit into one batch; set by the plan */
} CzRunItem;

/* Neighbouring items of a plan that run side by side. */
typedef struct CzRunChunk {
    int first, n;
} CzRunChunk;

typedef struct CzRunPlan {
    int n_item;
    CzRunItem *item; /* (n_item) */
    int n_chunk;
    CzRunChunk *chunk; /* (n_item at most) */
} CzRunPlan;

/* Memory for n items, to be filled; freed also after a failure. */
CZ_MUST_CHECK CzStatus cz_run_plan_begin(CzRunPlan *plan, int n, CzError *error);
void cz_run_plan_free(CzRunPlan *plan);

/* Sorts the items, long runs first, and cuts them into chunks for n_place tasks side by side:
 * batches that fill the lanes and take about as long as one another; single runs where `is_single`
 * is set. Status: CZ_STATUS_NO_MEMORY. */
CZ_MUST_CHECK CzStatus cz_run_plan_cut(CzRunPlan *plan, const CzSimulateOptions *options,
                                       bool is_single, int n_place, CzError *error);

#endif
