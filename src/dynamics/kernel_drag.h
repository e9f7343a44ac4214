/* What the track holds back a car without running gear with: brakes, rolling resistance, and the
 * friction jaws of a buffer stop with the end stop behind their way. Part of kernel.c only. */
#ifndef CZ_DYNAMICS_KERNEL_DRAG_H
#define CZ_DYNAMICS_KERNEL_DRAG_H

#include "dynamics/kernel_rows.h"
#include "laws/drag.h"
#include "laws/slider.h"

/* After all other forces: a car at rest is held against their sum. */
static void drag(CzBlock *d) {
    const size_t n = CZ_LANE_BLOCK;
    const double *restrict mass = C(BODY_MASS), *restrict slaved = P(SLAVED_ENDS);
    const double *restrict rolling_brake = P(DRAG_BRAKE), *restrict sliding_brake =
                                                              P(DRAG_BRAKE_SLIDING);
    const double *restrict fall = P(FRICTION_FALL_SPEED), *restrict rolls = P(DRAG_ROLLING);
    const double *restrict slides = P(DRAG_SLIDE), *restrict length = P(SLIDE_LENGTH);
    const double *restrict stiffness = P(SLIDE_STIFFNESS);
    const double *restrict x = X(BODY_X), *restrict v = V(BODY_X);
    const double *restrict rear = G(END_X_REAR), *restrict front = G(END_X_FRONT);
    double *restrict body = G(BODY_X), *restrict adhesion = S(ADHESION);
    double *restrict kept = S(SLIDE_FORCE);
    double *restrict brake_power = POWER(BRAKE), *restrict rolling_power = POWER(ROLLING);
    double *restrict slide_power = POWER(SLIDE);
    CZ_LANES (i, n) {
        const double stop = cz_stop(stiffness[i], length[i], x[i]);
        const double pushed = body[i] + slaved[i] * (rear[i] + front[i]) - stop;
        const double brakes = cz_brake_capacity(rolling_brake[i], sliding_brake[i], fall[i], v[i]);
        const double capacity = brakes + rolls[i] + slides[i];
        const double force = cz_drag(mass[i], capacity, v[i], pushed);
        const double per_newton = 1.0 / cz_larger(capacity, 1e-9);
        const double power = -force * v[i] * per_newton;
        body[i] += force - stop;
        adhesion[i] += force - stop;
        brake_power[i] += power * brakes;
        rolling_power[i] += power * rolls[i];
        slide_power[i] += power * slides[i] + stop * v[i];
        kept[i] = fabs(force) * per_newton * slides[i] + fabs(stop);
    }
}

#endif
