/* Quantities that follow from filled lanes: properties and step bounds of the problem's own design,
 * F_crit of any design. */
#ifndef CZ_MODEL_OWN_DESIGN_H
#define CZ_MODEL_OWN_DESIGN_H

#include "model/model.h"

/* Writes F_crit of the interfaces of one design of filled lanes (n_car - 1), as
 * cz_strut_chain_fold; NaN without couplers or full cars [N]. Statuses: CZ_OK,
 * CZ_STATUS_NO_MEMORY. */
CZ_MUST_CHECK CzStatus cz_critical_forces(const CzModel *model, const CzLanes *lanes, int design,
                                          double *force, CzError *error);

/* Sets model->properties and model->interface_properties. Statuses: CZ_OK, CZ_STATUS_INPUT,
 * CZ_STATUS_NO_MEMORY. */
CZ_MUST_CHECK CzStatus cz_model_find_properties(CzModel *model, CzLanes *lanes, CzError *error);

/* Sets model->bound, smallest first; needs the properties. Statuses: CZ_OK, CZ_STATUS_NO_MEMORY. */
CZ_MUST_CHECK CzStatus cz_model_find_bounds(CzModel *model, const CzLanes *lanes, CzError *error);

#endif
