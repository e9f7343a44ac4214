/* Elastic energy of the elements that store and lose, in a lane [J]; side 0 is A, 1 is B; end 0 is
 * the rear one. */
#ifndef CZ_DYNAMICS_STORED_H
#define CZ_DYNAMICS_STORED_H

#include "dynamics/dynamics.h"

#define CZ_PLATE_STIFFNESS 2e7 /* vertical stiffness of buffer plates that stick [N/m] (ours) */

/* Buffers of one side. */
double cz_coupler_stored(const CzDynamics *dynamics, size_t lane, int side);
double cz_side_stored(const CzDynamics *dynamics, size_t lane, int side);

/* Tubes of both sides, in their elasticity; superstructures of both sides, where there are. */
double cz_coupler_tubes_stored(const CzDynamics *dynamics, size_t lane);
double cz_side_tubes_stored(const CzDynamics *dynamics, size_t lane);
double cz_superstructure_stored(const CzDynamics *dynamics, size_t lane);

/* Draw gears of both sides; 0 without. */
double cz_draw_gear_stored(const CzDynamics *dynamics, size_t lane);

/* What a step of a stroke that touches the buffer of one side may be off by: the force that it
 * rises by, preload and transition, times the stroke. */
double cz_coupler_touch(const CzDynamics *dynamics, size_t lane, int side, double stroke);
double cz_side_touch(const CzDynamics *dynamics, size_t lane, int side, double stroke);

/* Hinge and swing stop of one side. */
double cz_hinge_stored(const CzDynamics *dynamics, size_t lane, int side);

/* Both sides of the faces: along the normal, and across it; plates of side buffers across it. */
double cz_face_stored(const CzDynamics *dynamics, size_t lane);
double cz_face_sliding_stored(const CzDynamics *dynamics, size_t lane);
double cz_side_sliding_stored(const CzDynamics *dynamics, size_t lane);

/* Crush zones with and without an end mass: what they store, and what they have received so far:
 * the work of loading to their largest shortening less what unloading from there gave back. */
double cz_end_stored(const CzDynamics *dynamics, size_t lane, int end);
double cz_end_received(const CzDynamics *dynamics, size_t lane, int end);
double cz_massless_stored(const CzDynamics *dynamics, size_t lane, int side);
double cz_massless_received(const CzDynamics *dynamics, size_t lane, int side);
/* The latter of a state that is none yet: shortened by x, at most by `largest` so far. */
double cz_massless_received_at(const CzDynamics *dynamics, size_t lane, int side, double x,
                               double largest);

/* Springs of the running gear, all of a car. */
double cz_secondary_stored(const CzDynamics *dynamics, size_t lane);
double cz_primary_stored(const CzDynamics *dynamics, size_t lane);
double cz_link_stored(const CzDynamics *dynamics, size_t lane);
double cz_axle_guidance_stored(const CzDynamics *dynamics, size_t lane);

/* Contact of the wheels with a rail that does not deflect, and their weight. */
double cz_wheels_stored(const CzDynamics *dynamics, size_t lane);

/* Guidance of an end mass across the axis, and its hinge. */
double cz_guide_stored(const CzDynamics *dynamics, size_t lane, int end);
double cz_fold_stored(const CzDynamics *dynamics, size_t lane, int end);

/* In the end stop of a buffer stop that was dragged as far as it goes. */
double cz_slide_stored(const CzDynamics *dynamics, size_t lane);

/* Kinetic and elastic energy of the track under a car above that at t = 0. */
double cz_track_stored(const CzDynamics *dynamics, size_t lane);

#endif
