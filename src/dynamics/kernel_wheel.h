/* Wheel and rail, and the brake, of each axle. Part of kernel.c only. */
#ifndef CZ_DYNAMICS_KERNEL_WHEEL_H
#define CZ_DYNAMICS_KERNEL_WHEEL_H

#include "dynamics/kernel_rows.h"
#include "laws/slider.h"
#include "laws/wheel_rail.h"

/* Wheel and rail, and the brake, of one axle. */
static void wheel(CzBlock *d, int axle, double step) {
    const size_t n = CZ_LANE_BLOCK;
    const double *restrict rest = C_AT(STATIC_LOAD_0, axle), *restrict creep_c =
                                                                 C(CREEP_COMPLIANCE);
    const double *restrict brake_c = C(BRAKE_COMPLIANCE);
    const double *restrict hertz = P(HERTZ), *restrict indentation = P_AT(INDENTATION_0, axle);
    const double *restrict radius = P(WHEEL_RADIUS), *restrict k = P(CREEP_STIFFNESS),
                           *restrict length = P(CREEP_LENGTH);
    const double *restrict peak = P(FRICTION_PEAK), *restrict sliding = P(FRICTION_SLIDING);
    const double *restrict fall = P(FRICTION_FALL_SPEED);
    const double *restrict brake_k = P(BRAKE_STIFFNESS), *restrict brake =
                                                             P_AT(BRAKE_MOMENT_0, axle);
    const double *restrict zw = X_AT(WHEEL_Z_0, 3 * axle), *restrict vzw =
                                                               V_AT(WHEEL_Z_0, 3 * axle);
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
        const double normal = cz_wheel_normal_force(hertz[i], indentation[i] - zw[i]);
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

#endif
