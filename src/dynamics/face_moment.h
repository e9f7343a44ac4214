/* Force and moment of an interface's faces on the bodies behind them, from the records of a
 * budget. */
#ifndef CZ_DYNAMICS_FACE_MOMENT_H
#define CZ_DYNAMICS_FACE_MOMENT_H

#include "dynamics/dynamics.h"

typedef struct CzFacePush {
    double lift, moment; /* vertical force [N] and moment [N m] on the body */
} CzFacePush;

/* `lane` is the interface's, `own` that of the car whose front (side 0) or rear end (1) meets it.
 * The point of action is recorded relative to the end mass. Its place on the body depends on the
 * lane of that body, so that the kernel cannot record it. */
CzFacePush cz_face_push(const CzDynamics *dynamics, size_t lane, size_t own, int side);

#endif
