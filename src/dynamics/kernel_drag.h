/* Resistance of the track to a car without running gear: brakes, rolling resistance, and the
 * friction jaws of a buffer stop with the end stop after their travel. Part of kernel.c only. */
#ifndef CZ_DYNAMICS_KERNEL_DRAG_H
#define CZ_DYNAMICS_KERNEL_DRAG_H

#include "dynamics/kernel_lanes.h"
#include "laws/drag.h"
#include "laws/slider.h"

/* Comes after all other forces, because a car at rest is held against their sum. */
static void drag(CzBlock *d) {
    const CzDragRows *restrict rows = &d->parameter.drag;
    const double *restrict mass = d->constant.body_mass;
    const double *restrict slaved_rear = d->parameter.slaved_ends[0], *restrict slaved_front =
                                                                          d->parameter
                                                                              .slaved_ends[1];
    const double *restrict fall = d->parameter.wheel.friction_fall_speed;
    const double *restrict x = d->position.body.x, *restrict v = d->velocity.body.x;
    const double *restrict rear = d->force.end[0].x, *restrict front = d->force.end[1].x;
    double *restrict body = d->force.body.x, *restrict adhesion = d->published.adhesion;
    double *restrict kept = d->published.slide_force;
    CzPower *restrict power = d->power;
    CZ_LANES (i) {
        const double stop = cz_stop(rows->slide_stiffness[i], rows->slide_length[i], x[i]);
        const double handed = slaved_rear[i] * rear[i] + slaved_front[i] * front[i];
        const double pushed = body[i] + handed - stop;
        const double brakes =
            cz_brake_capacity(rows->brake[i], rows->brake_sliding[i], fall[i], v[i]);
        const double capacity = brakes + rows->rolling[i] + rows->slide[i];
        const double force = cz_drag(mass[i], capacity, v[i], pushed);
        const double per_newton = 1.0 / cz_larger(capacity, 1e-9);
        const double lost = -force * v[i] * per_newton;
        body[i] += force - stop;
        adhesion[i] += force - stop;
        power->brake[i] += lost * brakes;
        power->rolling[i] += lost * rows->rolling[i];
        power->slide[i] += lost * rows->slide[i] + stop * v[i];
        kept[i] = fabs(force) * per_newton * rows->slide[i] + fabs(stop);
    }
}

#endif
