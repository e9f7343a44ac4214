/* What the faces of an interface do to the bodies behind them, of what was noted for a budget. */
#ifndef CZ_DYNAMICS_FACE_MOMENT_H
#define CZ_DYNAMICS_FACE_MOMENT_H

#include "dynamics/dynamics.h"

typedef struct CzFacePush {
    double lift, moment; /* vertical force [N] and moment [N m] on the body */
} CzFacePush;

/* `lane` is the interface's, `own` that of the car whose front (side 0) or rear end (1) meets it.
 * The faces know their point of action from the end mass, and how that is on its body is known
 * in the lane of the body alone, so that the kernel cannot note it. */
CzFacePush cz_face_push(const CzDynamics *dynamics, size_t lane, size_t own, int side);

#endif
