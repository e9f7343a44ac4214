/* What is found out once, from the filled lanes of the problem's own design: facts, step bounds. */
#ifndef CZ_MODEL_OWN_DESIGN_H
#define CZ_MODEL_OWN_DESIGN_H

#include "model/model.h"

/* Parameter of a car in lanes of one design. */
static inline double cz_lane_value(const CzLanes *lanes, int car, CzParameter parameter) {
    return lanes->parameter[(size_t)parameter * lanes->stride + (size_t)car];
}

/* Sets model->facts and model->interface_facts. Statuses: CZ_OK, CZ_STATUS_INPUT,
 * CZ_STATUS_NO_MEMORY. */
CZ_MUST_CHECK CzStatus cz_model_find_facts(CzModel *model, CzLanes *lanes, CzError *error);

/* Sets model->bound, smallest first; needs the facts. Statuses: CZ_OK, CZ_STATUS_NO_MEMORY. */
CZ_MUST_CHECK CzStatus cz_model_find_bounds(CzModel *model, const CzLanes *lanes, CzError *error);

#endif
