/* Devices of a vehicle end as written: strokes, forces, installed lengths. */
#ifndef CZ_EVALUATE_DEVICES_H
#define CZ_EVALUATE_DEVICES_H

#include "crushzone/simulate.h"
#include "problem/input.h"

/* Largest force of an element before anything bottoms out, all devices of an end together, plastic
 * parts crushing at `rate` [m/s]; 0 when it is absent [N]. */
double cz_plastic_force(const CzEnd *end, CzElementKind kind, double rate);

/* Force at which the tubes of a coupler, an anti-climber or an end begin to crush, likewise; 0 when
 * they do not [N]. */
double cz_crushing_force(const CzEnd *end, CzElementKind kind, double rate);

/* Each of these is a ratio of at most 1, NaN when an end does not declare the values for it. */
double cz_stroke_fit(const CzEnd *end);
double cz_length_used(const CzEnd *end);
double cz_coupler_length_used(const CzEnd *end);
double cz_retraction_used(const CzEnd *end);

/* Length of an end in front of its survival space: as declared, else to the end of its crush zone
 * [m]. */
double cz_length_before(const CzEnd *end);

/* The force ladder. `rate` is the crush rate for the tube's force [m/s]. */
double cz_tube_over_shear_off(const CzEnd *end, double rate);
double cz_shear_off_over_strength(const CzEnd *end);
/* Further steps of the force ladder: NaN where an end does not have both. That of the crush zone is
 * 0 without one, NaN without a strength. */
double cz_buffer_over_tube(const CzEnd *end);
double cz_anti_climber_over_end(const CzEnd *end, double rate);
double cz_end_over_strength(const CzEnd *end);
/* The largest of all steps; NaN when the strength that one needs is not declared. */
double cz_force_ladder(const CzEnd *end, double rate);

/* Sums over the vehicles of a train; part_count counts devices that differ. NaN without devices. */
double cz_train_installed_length(int n_vehicle, const CzVehicle *vehicle);
double cz_train_absorber_mass(int n_vehicle, const CzVehicle *vehicle);
double cz_train_part_count(int n_vehicle, const CzVehicle *vehicle);

#endif
