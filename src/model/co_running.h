/* A piece of track that runs along under each wheelset: one mass on one spring and one damper.
 * Cheap, for searching; its three numbers come from the modal track.
 *
 *   1 / k = G(0)     m = k / w^2     c = 1 / (w |G(i w)|)
 *
 * G is the deflection under a wheel per force, averaged over a bay, and w the first frequency at
 * which it lags by a quarter of a period: there the mass and the spring cancel, and the damper has
 * the whole force. Static deflection, first resonance and its height are those of the track.
 */
#ifndef CZ_MODEL_CO_RUNNING_H
#define CZ_MODEL_CO_RUNNING_H

#include "model/track.h"

typedef struct CzCoRunning {
    double stiffness; /* [N/m] */
    double damping;   /* [N s/m] */
    double mass;      /* [kg] */
} CzCoRunning;

/* For two rails. Damping ends just below the critical one, so that the mass always swings. */
CzCoRunning cz_co_running(const CzTrackModes *modes);

/* Deflection under a wheel per force at a frequency w [rad/s], the mean over a bay [m/N]. */
CzComplex cz_track_receptance(const CzTrackModes *modes, double w);

#endif
