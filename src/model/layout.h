/* Where the cars of a scenario are at t = 0, for pictures. */
#ifndef CZ_MODEL_LAYOUT_H
#define CZ_MODEL_LAYOUT_H

#include "model/model.h"

typedef struct CzLayout {
    double x;        /* of the body's centre of gravity along the track, 0 for the first car [m] */
    double plane[2]; /* foremost planes from there, rear and front, outwards; a vehicle
                        that states no length gets one to draw [m] */
    double rise; /* how much higher this car's parts are at the interface behind it [m]; 0 for the
                    first */
} CzLayout;

/* Fills stand[n_car] for the problem's own design. Statuses: CZ_STATUS_INPUT, CZ_STATUS_NO_MEMORY.
 */
CZ_MUST_CHECK CzStatus cz_model_layout(const CzModel *model, CzLayout *stand, CzError *error);

#endif
