/* Largest stable step of a wheel on the modal track. */
#ifndef CZ_MODEL_TRACK_BOUND_H
#define CZ_MODEL_TRACK_BOUND_H

#include "model/track.h"

/* For a wheelset of an inverse mass [1/kg] between a contact of a flexibility [m/N] and a spring
 * [N/m] [s]. */
double cz_track_longest_step(const CzTrackModes *modes, double contact, double inverse_mass,
                             double spring);

#endif
