/* Static equilibrium of a car on its springs, wheels and track, found by the laws themselves and
 * without the closed forms that the model is built with. */
#ifndef CZ_DYNAMICS_EQUILIBRIUM_H
#define CZ_DYNAMICS_EQUILIBRIUM_H

#include "base/arena.h"
#include "crushzone/status.h"
#include "dynamics/track.h"
#include "model/lanes.h"

/* A car at rest. Displacements are measured from unloaded springs and wheels that just touch. */
typedef struct CzEquilibrium {
    double body_z, body_pitch; /* upwards [m]; nose-up [rad] */
    double secondary[2];       /* compression, rear and front [m] */
    double primary[4];         /* [m] */
    double wheel_load[4];      /* force of a wheelset on the rails [N] */
    double rail[4];            /* deflection of the rails downwards under each wheelset [m] */
    double indentation[4];     /* of the contact [m] */
    double residual;           /* largest force left unbalanced over the car's weight [-] */
} CzEquilibrium;

/* Solves for the full car in a lane. `track` is a track for a step of 0 and four cars, which the
 * search lays again with memory from the arena; NULL on rigid rails. Statuses: CZ_OK,
 * CZ_STATUS_RUN_FAILED, CZ_STATUS_NO_MEMORY. */
CZ_MUST_CHECK CzStatus cz_equilibrium_find(const CzLanes *lanes, size_t lane, CzTrackMotion *track,
                                           CzArena *arena, CzEquilibrium *equilibrium,
                                           CzError *error);

#endif
