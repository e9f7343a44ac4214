/* Number of breakpoints of each curve in the lanes. */
#ifndef CZ_MODEL_CURVE_SIZES_H
#define CZ_MODEL_CURVE_SIZES_H

#include "model/model.h"

/* Sets model->n_breakpoint so that every design with the stages and points of the problem's own
 * vehicles fits. */
void cz_model_size_curves(CzModel *model, const CzVehicle *vehicles);

#endif
