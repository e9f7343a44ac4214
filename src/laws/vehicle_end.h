/* Crush zone of a vehicle end: loading backbone, two unloading stages, tension of the deformed
 * structure.
 *
 *   x >= x_m:  F = backbone(x)                 loading
 *   x <  x_m:  F = F_m - Ku1 (x_m - x)         unloading, down to r F_m at x_1
 *              F = r F_m - Ku2 (x_1 - x)       down to zero at x_res
 *              F = -K_t (x_res - x)            below, where the end is still attached
 *
 * Reloading follows the unloading path. F_m = backbone(x_m); x_m is the largest shortening so far,
 * but at most the end of the last stage, beyond which an elastic stop acts. The unloading path is
 * never above backbone(x), and x_res never below zero, so that the elastic part of the backbone
 * returns no more energy than it received. For the same reason no stage may rise faster than
 * cz_vehicle_end_steepest.
 *
 * A damper acts in parallel, scaled in over the shortening: c fade(x) x'.
 */
#ifndef CZ_LAWS_VEHICLE_END_H
#define CZ_LAWS_VEHICLE_END_H

#include "laws/law.h"

typedef struct {
    double unloading;        /* Ku1 [N/m] */
    double share;            /* r [-] */
    double second_unloading; /* Ku2 [N/m] */
    double tension;          /* K_t [N/m]; 0 where nothing can pull */
} CzVehicleEndLaw;

typedef struct {
    double force;    /* [N] */
    double slope;    /* of the unloading path here [N/m] */
    double residual; /* x_res [m] */
} CzVehicleEndResponse;

/* `backbone` is at the shortening x, `peak` at x_m; the compliances are 1/Ku1 and 1/Ku2, which
 * saves divisions where they are constant. */
static inline CzVehicleEndResponse cz_vehicle_end_of(const CzVehicleEndLaw *law, double compliance,
                                                     double second_compliance, double backbone,
                                                     double peak, double shortening,
                                                     double largest) {
    const double turn = largest - (1.0 - law->share) * peak * compliance;
    const double set = turn - law->share * peak * second_compliance;
    const double residual = cz_positive_part(set);
    const double first = peak - law->unloading * (largest - shortening);
    const double second = law->share * peak - law->second_unloading * (turn - shortening);
    const double pushed = shortening >= turn ? first : second;
    const double pulled = -law->tension * (residual - shortening);
    const double below = cz_smaller(pulled, 0.0);
    const double path = cz_smaller(cz_positive_part(pushed), cz_positive_part(backbone));
    const double above = shortening < largest ? path : cz_positive_part(backbone);

    CzVehicleEndResponse response;
    response.force = shortening < residual ? below : above;
    response.slope = shortening >= turn ? law->unloading : law->second_unloading;
    response.residual = residual;
    return response;
}

static inline CzVehicleEndResponse cz_vehicle_end(const CzVehicleEndLaw *law, double backbone,
                                                  double peak, double shortening, double largest) {
    return cz_vehicle_end_of(law, 1.0 / law->unloading, 1.0 / law->second_unloading, backbone, peak,
                             shortening, largest);
}

/* Force of the parallel damper [N]. */
static inline double cz_vehicle_end_damping(double damping, double shortening, double rate) {
    return damping * rate * cz_fade_in(shortening, CZ_FADE_LENGTH);
}

/* The same inside a series chain: force per travel of a step, scaled in over the shortening before
 * the step [N/m]. */
static inline double cz_vehicle_end_damper(double damping, double committed, double step) {
    return damping * cz_fade_in(committed, CZ_FADE_LENGTH) / step;
}

/* Energy returned by unloading to zero [J]: (1 - r^2) F^2 / (2 Ku1) + (r F)^2 / (2 Ku2), for a
 * force F on the path. */
static inline double cz_vehicle_end_stored(const CzVehicleEndLaw *law, double peak, double force) {
    const double turn_force = law->share * peak;
    const double low = cz_clamp(force, 0.0, turn_force);
    const double high = cz_larger(force, turn_force);
    return low * low / (2.0 * law->second_unloading) +
           (high * high - turn_force * turn_force) / (2.0 * law->unloading);
}

/* Slope [N/m] above which a stage after the first would store more on its unloading path than the
 * work done on it: 1 / ((1 - r^2) / Ku1 + r^2 / Ku2). */
static inline double cz_vehicle_end_steepest(const CzVehicleEndLaw *law) {
    const double square = law->share * law->share;
    return 1.0 / ((1.0 - square) / law->unloading + square / law->second_unloading);
}

#endif
