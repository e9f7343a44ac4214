/* Geometry and forces of wheelsets: on the rail, and in the brake on the bogie frame. Part of
 * kernel.c only. */
#ifndef CZ_DYNAMICS_KERNEL_WHEEL_LINE_H
#define CZ_DYNAMICS_KERNEL_WHEEL_LINE_H

#include "dynamics/kernel_carrier.h"

/* Motion of a wheelset. */
typedef struct {
    double slip, speed;    /* of the contact point over the rail, and along it [m/s] */
    double rate_up;        /* [m/s] */
    double angle, turning; /* of the brake: the frame has the opposite sign [rad, rad/s] */
} WheelLine;

/* Forces on it. */
typedef struct {
    double tangential, more; /* of the rail, `more` beyond the static load [N] */
    double brake;            /* [N m] */
} WheelForces;

/* ---- geometry ---- */

static inline WheelLine line_up_wheel(CzCarrier frame, const CzWheelset *at, const CzWheelset *rate,
                                      double radius, size_t i) {
    return (WheelLine){rate->x[i] - radius * rate->spin[i], rate->x[i], rate->z[i],
                       at->spin[i] + frame.displacement->pitch[i],
                       rate->spin[i] + frame.rate->pitch[i]};
}

/* ---- forces on the carriers ---- */

static inline void put_wheel(CzWheelset *on, CzPlane *on_bogie, size_t i, WheelForces forces,
                             double radius) {
    on->x[i] += forces.tangential;
    on->z[i] += forces.more;
    cz_put_moment(on->spin, i, -(radius * forces.tangential + forces.brake));
    cz_put_moment(on_bogie->pitch, i, -forces.brake);
}

#endif
