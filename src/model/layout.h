/* Positions of the cars of a scenario at t = 0, for figures. */
#ifndef CZ_MODEL_LAYOUT_H
#define CZ_MODEL_LAYOUT_H

#include "model/model.h"

typedef struct CzLayout {
    double x;        /* of the body's centre of gravity along the track, 0 for the first car [m] */
    double plane[2]; /* distances from there to the foremost planes, rear and front, outwards;
                        assumed for a vehicle without a length [m] */
    double rise;     /* height offset of this car's parts at the interface behind it [m]; 0 for the
                        first */
} CzLayout;

/* Fills stand[n_car] for the problem's own design. Statuses: CZ_STATUS_INPUT, CZ_STATUS_NO_MEMORY.
 */
CZ_MUST_CHECK CzStatus cz_model_layout(const CzModel *model, CzLayout *stand, CzError *error);

#endif
