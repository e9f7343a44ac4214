/* Natural frequencies of a car on its springs, wheels held: body z and pitch, both bogies z and
 * pitch. */
#ifndef CZ_MODEL_VERTICAL_MODES_H
#define CZ_MODEL_VERTICAL_MODES_H

#include "model/fill.h"

enum { CZ_N_VERTICAL_MODE = 6 };

typedef struct CzVerticalModes {
    double frequency[CZ_N_VERTICAL_MODE]; /* ascending [Hz] */
    double bounce;                        /* of the mode with the largest bounce of the body [Hz] */
    double pitch;                         /* of the mode with the largest pitch of the body [Hz] */
} CzVerticalModes;

CzVerticalModes cz_vertical_modes(const CzVehicle *vehicle, const CzStatics *statics);

#endif
