/* Builds models that share a track. */
#ifndef CZ_MODEL_BUILD_H
#define CZ_MODEL_BUILD_H

#include "crushzone/model.h"

/* cz_model_build beside n other models, some of which may be NULL: where one of them has the same
 * track, with its receptances, the model uses it, and that one must live as long. */
CZ_MUST_CHECK CzStatus cz_model_build_beside(const CzProblem *problem, int scenario, int n,
                                             CzModel *const *made, CzModel **model, CzError *error);

#endif
