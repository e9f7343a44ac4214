/* Elastic energy of the elements that store and lose, in a lane [J]; side 0 is A, 1 is B; end 0 is
 * the rear one. */
#ifndef CZ_DYNAMICS_STORED_H
#define CZ_DYNAMICS_STORED_H

#include "dynamics/dynamics.h"

double cz_coupler_stored(const CzDynamics *dynamics, size_t lane, int side);
double cz_face_stored(const CzDynamics *dynamics, size_t lane, int side);
double cz_limp_stored(const CzDynamics *dynamics, size_t lane, int side);
double cz_side_stored(const CzDynamics *dynamics, size_t lane, int side);

/* The part of it that belongs to no member of the chain: half of what its compliance stores. */
double cz_coupler_elastic(const CzDynamics *dynamics, size_t lane);
double cz_side_elastic(const CzDynamics *dynamics, size_t lane);
double cz_end_stored(const CzDynamics *dynamics, size_t lane, int end);

/* In the end stop of a buffer stop that was dragged as far as it goes. */
double cz_slide_stored(const CzDynamics *dynamics, size_t lane);

/* Kinetic and elastic energy of the track under a car above that at t = 0. */
double cz_track_stored(const CzDynamics *dynamics, size_t lane);

/* Value [N] and integral from 0 [J] of a curve in a lane. */
double cz_curve_value(const CzCurveLanes *curve, size_t stride, size_t lane, double x);
double cz_curve_integral(const CzCurveLanes *curve, size_t stride, size_t lane, double x);

#endif
