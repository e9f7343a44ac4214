/* What is found out from filled lanes: of the problem's own design facts and step bounds, of any
 * design F_crit. */
#ifndef CZ_MODEL_OWN_DESIGN_H
#define CZ_MODEL_OWN_DESIGN_H

#include "model/model.h"

/* Parameter in a lane; in lanes of one design that is the car's number. */
static inline double cz_lane_value(const CzLanes *lanes, int lane, CzParameter parameter) {
    return lanes->parameter[(size_t)parameter * lanes->stride + (size_t)lane];
}

/* F_crit of the weaker side of an interface in a design, whose lanes of the cars behind and ahead
 * are given; NaN without couplers [N]. */
double cz_critical_force(const CzModel *model, const CzLanes *lanes, int interface,
                         const int lane[2]);

/* Sets model->facts and model->interface_facts. Statuses: CZ_OK, CZ_STATUS_INPUT,
 * CZ_STATUS_NO_MEMORY. */
CZ_MUST_CHECK CzStatus cz_model_find_facts(CzModel *model, CzLanes *lanes, CzError *error);

/* Sets model->bound, smallest first; needs the facts. Statuses: CZ_OK, CZ_STATUS_NO_MEMORY. */
CZ_MUST_CHECK CzStatus cz_model_find_bounds(CzModel *model, const CzLanes *lanes, CzError *error);

#endif
