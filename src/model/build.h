/* Builds models that share a track. */
#ifndef CZ_MODEL_BUILD_H
#define CZ_MODEL_BUILD_H

#include "crushzone/model.h"
#include "problem/problem.h"

/* cz_model_build beside n other models, some of which may be NULL: where one of them has the same
 * track, with its receptances, the model uses it, and that one must live as long. */
CZ_MUST_CHECK CzStatus cz_model_build_beside(const CzProblem *problem, int scenario, int n,
                                             CzModel *const *made, CzModel **model, CzError *error);

/* Whether the model would be the same if it was built of a problem with these vehicles: time step,
 * end criterion and equipment, so that a run of this model with them has the same bits. False also
 * when it cannot be built. */
bool cz_model_is_same_with(CzModel *model, const CzVehicle *vehicles);

#endif
