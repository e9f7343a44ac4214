/* Wheel and rail, and the brake, of each axle. Part of kernel.c only. */
#ifndef CZ_DYNAMICS_KERNEL_WHEEL_H
#define CZ_DYNAMICS_KERNEL_WHEEL_H

#include "dynamics/kernel_wheel_line.h"
#include "laws/drag.h"
#include "laws/slider.h"
#include "laws/wheel_rail.h"

/* Normal force of one axle on a rigid rail. */
static void press_on_rigid(CzBlock *d, int axle) {
    const double *restrict hertz = d->parameter.wheel.hertz;
    const double *restrict rest = d->constant.wheel_rest[axle];
    const double *restrict z = d->position.wheelset[axle].z;
    double *restrict approach = d->published.wheel[axle].approach;
    double *restrict force = d->published.wheel[axle].force;
    CZ_LANES (i) {
        approach[i] = rest[i] - z[i];
        force[i] = cz_wheel_normal_force(hertz[i], approach[i]);
    }
}

/* Normal force of one axle on an elastic rail. The force on the wheels is vertical. The
 * longitudinal force of the sloping rail is not applied; its power is that of the moving load. */
static void press_on_elastic(CzBlock *d, int axle) {
    const double *restrict hertz = d->parameter.wheel.hertz;
    const double *restrict rest = d->constant.wheel_rest[axle];
    const double *restrict z = d->position.wheelset[axle].z;
    const double *restrict speed = d->velocity.wheelset[axle].x;
    const CzRailRows *restrict rail = &d->rail[axle];
    double *restrict approach = d->published.wheel[axle].approach;
    double *restrict force = d->published.wheel[axle].force;
    double *restrict normal_power = d->power->wheel_normal, *restrict moving =
                                                                d->power->moving_load;
    CZ_LANES (i) {
        const double now = rest[i] + rail->z[i] - z[i];
        const double normal = cz_wheel_force_on_spring(hertz[i], rail->flexibility[i], now);
        const double pushed =
            normal * speed[i] * (0.5 * normal * rail->flexibility_slope[i] - rail->slope[i]);
        approach[i] = now;
        force[i] = normal;
        moving[i] += pushed;
        normal_power[i] -= pushed;
    }
}

/* Creepage and the brake of one axle. The brake acts between wheelset and bogie frame, whose angles
 * have opposite signs. */
static void wheel(CzBlock *d, int axle, double step) {
    const int bogie = axle / 2;
    const CzWheelRows *restrict rows = &d->parameter.wheel;
    const CzConstants *restrict constant = &d->constant;
    const double *restrict rest = constant->static_load[axle];
    const double *restrict brake = rows->brake_moment[axle];
    const double *restrict pressing = d->published.wheel[axle].force;
    const CzWheelset *at = &d->position.wheelset[axle], *rate = &d->velocity.wheelset[axle];
    const CzCarrier frame = own_bogie(d, bogie);
    const CzWheelMemory *restrict memory = &d->memory->wheel[axle];
    CzWheelMemory *restrict next = &d->next_memory->wheel[axle];
    CzWheelset *on = &d->force.wheelset[axle];
    CzPlane *on_bogie = &d->force.bogie[bogie];
    double *restrict adhesion = d->published.adhesion;
    CzPower *restrict power = d->power;
    CZ_LANES (i) {
        const double normal = pressing[i];
        const double more = normal - rest[i];
        const double radius = rows->radius[i];
        const CzCreepLaw law = {rows->creep_stiffness[i], cz_larger(rows->creep_length[i], 1e-6),
                                rows->friction_peak[i], rows->friction_sliding[i],
                                cz_larger(rows->friction_fall_speed[i], 1e-6)};
        const WheelLine line = line_up_wheel(frame, at, rate, radius, i);
        const double deflection =
            cz_creep_deflection(&law, constant->creep_compliance[i], memory->creep[i], line.slip,
                                line.speed, normal, step);
        const double tangential = -law.stiffness * deflection;
        const CzSliderResponse held =
            cz_slider_of(rows->brake_stiffness[i], constant->brake_compliance[i], brake[i],
                         line.angle, memory->brake[i]);
        next->creep[i] = deflection;
        next->brake[i] = held.offset;
        put_wheel(on, on_bogie, i, (WheelForces){tangential, more, held.force}, radius);
        adhesion[i] += tangential;
        power->wheel_normal[i] -= more * line.rate_up;
        power->wheel_creep[i] -= tangential * line.slip;
        power->brake[i] += held.force * line.turning;
    }
}

/* Rolling resistance of one axle: a moment of the rail against the rotation, after all others on
 * the wheelset; through the creepage it slows the car. */
static void roll(CzBlock *d, int axle) {
    const double *restrict inertia = d->constant.wheelset_inertia;
    const CzWheelRows *restrict rows = &d->parameter.wheel;
    const double *restrict normal = d->published.wheel[axle].force;
    const double *restrict spin = d->velocity.wheelset[axle].spin;
    double *restrict torque = d->force.wheelset[axle].spin, *restrict power = d->power->rolling;
    CZ_LANES (i) {
        const double capacity = rows->rolling_resistance[i] * normal[i] * rows->radius[i];
        const double moment = cz_drag(inertia[i], capacity, spin[i], torque[i]);
        cz_put_moment(torque, i, moment);
        power[i] -= moment * spin[i];
    }
}

#endif
