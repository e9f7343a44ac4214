/* Largest stable step of a wheel on the modal track. */
#ifndef CZ_MODEL_TRACK_BOUND_H
#define CZ_MODEL_TRACK_BOUND_H

#include "model/track.h"

/* The bound [s] for a wheelset of a given inverse mass [1/kg] between contact flexibility [m/N] and
 * spring [N/m]. */
double cz_track_longest_step(const CzTrackModes *modes, double contact, double inverse_mass,
                             double spring);

#endif
