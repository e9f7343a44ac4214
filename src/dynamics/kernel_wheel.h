/* Wheel and rail, and the brake, of each axle. Part of kernel.c only. */
#ifndef CZ_DYNAMICS_KERNEL_WHEEL_H
#define CZ_DYNAMICS_KERNEL_WHEEL_H

#include "dynamics/kernel_rows.h"
#include "laws/drag.h"
#include "laws/slider.h"
#include "laws/wheel_rail.h"

/* Normal force of one axle on a rail that does not give way. */
static void press_on_rigid(CzBlock *d, int axle) {
    const size_t n = CZ_LANE_BLOCK;
    const double *restrict hertz = P(HERTZ), *restrict rest = C_AT(WHEEL_REST_0, axle);
    const double *restrict z = X_AT(WHEEL_Z_0, 3 * axle);
    double *restrict approach = S_AT(WHEEL_APPROACH_0, axle), *restrict force =
                                                                  S_AT(WHEEL_FORCE_0, axle);
    CZ_LANES (i, n) {
        approach[i] = rest[i] - z[i];
        force[i] = cz_wheel_normal_force(hertz[i], approach[i]);
    }
}

/* Normal force of one axle on a rail that does. The wheels are kept on their way along the track,
 * and the force is vertical: what the slope of the rail would push is the moving load's power. */
static void press_on_elastic(CzBlock *d, int axle) {
    const size_t n = CZ_LANE_BLOCK;
    const double *restrict hertz = P(HERTZ), *restrict rest = C_AT(WHEEL_REST_0, axle);
    const double *restrict z = X_AT(WHEEL_Z_0, 3 * axle), *restrict speed =
                                                              V_AT(WHEEL_X_0, 3 * axle);
    const double *restrict rail = S_AT(RAIL_Z_0, axle), *restrict slope = S_AT(RAIL_SLOPE_0, axle);
    const double *restrict flexibility = S_AT(RAIL_FLEXIBILITY_0, axle),
                           *restrict change = S_AT(RAIL_FLEXIBILITY_SLOPE_0, axle);
    double *restrict approach = S_AT(WHEEL_APPROACH_0, axle), *restrict force =
                                                                  S_AT(WHEEL_FORCE_0, axle);
    double *restrict normal_power = POWER(WHEEL_NORMAL), *restrict moving = POWER(MOVING_LOAD);
    CZ_LANES (i, n) {
        const double now = rest[i] + rail[i] - z[i];
        const double normal = cz_wheel_force_on_spring(hertz[i], flexibility[i], now);
        const double pushed = normal * speed[i] * (0.5 * normal * change[i] - slope[i]);
        approach[i] = now;
        force[i] = normal;
        moving[i] += pushed;
        normal_power[i] -= pushed;
    }
}

/* Creepage and the brake of one axle. */
static void wheel(CzBlock *d, int axle, double step) {
    const size_t n = CZ_LANE_BLOCK;
    const double *restrict rest = C_AT(STATIC_LOAD_0, axle), *restrict creep_c =
                                                                 C(CREEP_COMPLIANCE);
    const double *restrict brake_c = C(BRAKE_COMPLIANCE);
    const double *restrict pressing = S_AT(WHEEL_FORCE_0, axle);
    const double *restrict radius = P(WHEEL_RADIUS), *restrict k = P(CREEP_STIFFNESS),
                           *restrict length = P(CREEP_LENGTH);
    const double *restrict peak = P(FRICTION_PEAK), *restrict sliding = P(FRICTION_SLIDING);
    const double *restrict fall = P(FRICTION_FALL_SPEED);
    const double *restrict brake_k = P(BRAKE_STIFFNESS), *restrict brake =
                                                             P_AT(BRAKE_MOMENT_0, axle);
    const double *restrict vzw = V_AT(WHEEL_Z_0, 3 * axle);
    const double *restrict vxw = V_AT(WHEEL_X_0, 3 * axle);
    const double *restrict angle = X_AT(WHEEL_SPIN_0, 3 * axle), *restrict spin =
                                                                     V_AT(WHEEL_SPIN_0, 3 * axle);
    /* The brake holds the wheelset against the bogie frame, which turns the other way round. */
    const double *restrict pitch_t = X_AT(BOGIE_PITCH_REAR, 3 * (axle / 2)),
                           *restrict turn_t = V_AT(BOGIE_PITCH_REAR, 3 * (axle / 2));
    const double *restrict deflection = M_AT(CREEP_0, axle), *restrict slipped =
                                                                 M_AT(BRAKE_0, axle);
    double *restrict next_deflection = NEXT_AT(CREEP_0, axle), *restrict next_slipped =
                                                                   NEXT_AT(BRAKE_0, axle);
    double *restrict gxw = G_AT(WHEEL_X_0, 3 * axle), *restrict gzw = G_AT(WHEEL_Z_0, 3 * axle);
    double *restrict torque = G_AT(WHEEL_SPIN_0, 3 * axle), *restrict gmt = G_AT(BOGIE_PITCH_REAR,
                                                                                 3 * (axle / 2));
    double *restrict adhesion = S(ADHESION);
    double *restrict normal_power = POWER(WHEEL_NORMAL), *restrict creep_power = POWER(WHEEL_CREEP);
    double *restrict brake_power = POWER(BRAKE);
    CZ_LANES (i, n) {
        const double normal = pressing[i];
        const double more = normal - rest[i];
        const CzCreepLaw law = {k[i], cz_larger(length[i], 1e-6), peak[i], sliding[i],
                                cz_larger(fall[i], 1e-6)};
        const double slip = vxw[i] - radius[i] * spin[i];
        next_deflection[i] =
            cz_creep_deflection(&law, creep_c[i], deflection[i], slip, vxw[i], normal, step);
        const double tangential = -k[i] * next_deflection[i];
        const CzSliderResponse held =
            cz_slider_of(brake_k[i], brake_c[i], brake[i], angle[i] + pitch_t[i], slipped[i]);
        next_slipped[i] = held.offset;
        gxw[i] += tangential;
        gzw[i] += more;
        torque[i] -= radius[i] * tangential + held.force;
        gmt[i] -= held.force;
        adhesion[i] += tangential;
        normal_power[i] -= more * vzw[i];
        creep_power[i] -= tangential * slip;
        brake_power[i] += held.force * (spin[i] + turn_t[i]);
    }
}

/* Rolling resistance of one axle: a moment of the rail against the turning, after all others on the
 * wheelset; what it costs the car comes through the creepage. */
static void roll(CzBlock *d, int axle) {
    const size_t n = CZ_LANE_BLOCK;
    const double *restrict inertia = C(WHEELSET_INERTIA), *restrict radius = P(WHEEL_RADIUS);
    const double *restrict resistance = P(ROLLING_RESISTANCE), *restrict normal =
                                                                   S_AT(WHEEL_FORCE_0, axle);
    const double *restrict spin = V_AT(WHEEL_SPIN_0, 3 * axle);
    double *restrict torque = G_AT(WHEEL_SPIN_0, 3 * axle), *restrict power = POWER(ROLLING);
    CZ_LANES (i, n) {
        const double capacity = resistance[i] * normal[i] * radius[i];
        const double moment = cz_drag(inertia[i], capacity, spin[i], torque[i]);
        torque[i] += moment;
        power[i] -= moment * spin[i];
    }
}

#endif
