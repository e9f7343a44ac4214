/* The modal track under each car: setting it up and its deflections.
 *
 * Positions are those of the wheels along the track from the middle of the car at t = 0, where a
 * seat is; deflections are upwards and zero for the unloaded track.
 */
#ifndef CZ_DYNAMICS_TRACK_H
#define CZ_DYNAMICS_TRACK_H

#include <stdbool.h>
#include <stddef.h>

#include "base/arena.h"
#include "dynamics/track_motion.h"

/* Constants for a step of h seconds and n_under cars without state; NULL when there is no memory.
 * The arena owns them. */
CzTrackMotion *cz_track_motion_create(const CzTrackModes *modes, double step, size_t n_under,
                                      CzArena *arena);

/* Lays the track of a car, or replaces it, at rest under the forces of its wheels [N] at their
 * places [m]; false when there is no memory. */
bool cz_track_lay(CzTrackMotion *track, size_t index, const double place[4], const double load[4],
                  CzArena *arena);

/* Deflection of the modes under each wheel at the places of the last look or step [m], and the
 * additional flexibility [m/N]. */
void cz_track_deflection(const CzTrackMotion *track, size_t index, const double place[4],
                         double deflection[4], double flexibility[4]);

/* ---- the same track for a solver of ordinary differential equations ----
 *
 * A track that is laid for a step of 0 is at rest until its state is set, the real and imaginary
 * parts of its modes; its flexibility is that of continuous time. A solver that integrates these
 * states with the vehicles' co-ordinates calls in its right-hand side
 *
 *   1. cz_track_set_state for each car,
 *   2. the kernel's evaluation, which finds the forces of the wheels,
 *   3. cz_track_rate for each car: the rates of its states under those
 * forces, and the track's part of the powers.
 *
 * At t = 0 cz_track_get_state gives the state at rest. Under usual axle loads a state is of the
 * order of 0.01 to 1 sqrt(J s), and 1e-3 of that moves a wheel by about 1 um.
 */

/* Numbers of one car's state. */
size_t cz_track_n_state(const CzTrackModes *modes);
void cz_track_get_state(const CzTrackMotion *track, size_t index, double *state);
void cz_track_set_state(CzTrackMotion *track, size_t index, const double *state);

/* Rates of the state under forces at the places of the last look, upwards on the rail [N], and the
 * rate of the rail there [m/s]. */
void cz_track_rate(CzTrackMotion *track, size_t index, const double force[4], double *rate,
                   double rail_rate[4]);

#endif
