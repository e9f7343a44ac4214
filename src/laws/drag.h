/* Drag on a mass: brakes, rolling resistance, friction jaws. It acts against the motion with its
 * whole capacity, and holds a mass that has come to rest.
 *
 *   F = -clamp(P + m v / tau, -capacity, capacity)
 *
 * P is the sum of all other forces on the mass, so that a held mass does not creep: v decays with
 * tau as long as P is below the capacity. The law has no memory and stores no energy.
 */
#ifndef CZ_LAWS_DRAG_H
#define CZ_LAWS_DRAG_H

#include "laws/law.h"

#define CZ_DRAG_TIME 1e-3 /* tau [s]: the drag grows over a speed of capacity tau / m (ours) */

static inline double cz_drag(double mass, double capacity, double speed, double pushed) {
    return -cz_clamp(pushed + mass * (1.0 / CZ_DRAG_TIME) * speed, -capacity, capacity);
}

/* Brake force of a mass whose wheels may lock: that of the brakes while the wheels roll, that of
 * the friction at a large slip speed; equal where they never lock. */
static inline double cz_brake_capacity(double rolling, double sliding, double fall_speed,
                                       double speed) {
    return sliding + (rolling - sliding) * fall_speed / (fall_speed + fabs(speed));
}

#endif
