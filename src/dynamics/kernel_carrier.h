/* Motion of bodies and application of forces, in the plane. Part of kernel.c only.
 *
 * Elements act between carriers. A point of a carrier has an arm from the centre of gravity and a
 * velocity; a force applied at that point has the same arm. So every stroke is the integral of its
 * rate at any pitch, and power and moment balance to rounding.
 */
#ifndef CZ_DYNAMICS_KERNEL_CARRIER_H
#define CZ_DYNAMICS_KERNEL_CARRIER_H

#include "base/complex.h"
#include "dynamics/kernel_lanes.h"

/* A body that carries an element: its position and velocity. */
typedef struct {
    const CzPlane *displacement, *rate;
    const CzTurned *turned;
} CzCarrier;

/* A material point of a carrier, or one that two carriers share. */
typedef struct {
    double arm_x, arm_z; /* from the carrier's centre of gravity [m] */
    double velocity_x, velocity_z;
} CzPoint;

/* A force and a moment at a point. */
typedef struct {
    double x, z, pitch; /* [N, N m] */
} CzPush;

static inline CzCarrier carrier_of(const CzMotion *motion) {
    return (CzCarrier){&motion->displacement, &motion->rate, &motion->turned};
}

/* The point at an arm. */
static inline CzPoint cz_point_at(CzCarrier carrier, size_t i, double arm_x, double arm_z) {
    const double turn = carrier.rate->pitch[i];
    return (CzPoint){arm_x, arm_z, carrier.rate->x[i] - arm_z * turn,
                     carrier.rate->z[i] + arm_x * turn};
}

/* The material point at a place (x, z) of the carrier at rest. */
static inline CzPoint cz_point_of(CzCarrier carrier, size_t i, double x, double z) {
    const double cosine = carrier.turned->cosine[i], sine = carrier.turned->sine[i];
    return cz_point_at(carrier, i, x * cosine - z * sine, x * sine + z * cosine);
}

/* Applies a force at a point of a body. */
static inline void cz_put_force(CzPlane *on, size_t i, CzPoint at, CzPush push) {
    on->x[i] += push.x;
    on->z[i] += push.z;
    on->pitch[i] += at.arm_x * push.z - at.arm_z * push.x + push.pitch;
}

/* The same with a share of the force on the end mass and the rest on the body; one of them is 0. */
static inline void cz_put_shared(CzPlane *end, CzPlane *body, size_t i, CzPush at_centre,
                                 double on_end) {
    const double x = on_end * at_centre.x, z = on_end * at_centre.z,
                 pitch = on_end * at_centre.pitch;
    end->x[i] += x;
    end->z[i] += z;
    end->pitch[i] += pitch;
    body->x[i] += at_centre.x - x;
    body->z[i] += at_centre.z - z;
    body->pitch[i] += at_centre.pitch - pitch;
}

/* A force at a point as force and moment at the carrier's centre of gravity. */
static inline CzPush cz_push_at_centre(CzPoint at, CzPush push) {
    return (CzPush){push.x, push.z, at.arm_x * push.z - at.arm_z * push.x + push.pitch};
}

/* Applies a moment to a body or a wheelset. */
static inline void cz_put_moment(double *restrict pitch, size_t i, double moment) {
    pitch[i] += moment;
}

/* Two points that face each other: the vector from A to B, and both as points of their carriers. */
typedef struct {
    double x, z; /* [m] */
    CzPoint a, b;
} CzPair;

static inline CzPair cz_pair_of(CzCarrier a, CzCarrier b, const CzPairRows *at, size_t i) {
    CzPair pair;
    pair.a = cz_point_of(a, i, at->x[0][i], at->z[0][i]);
    pair.b = cz_point_of(b, i, at->x[1][i], at->z[1][i]);
    pair.x = at->distance[i] + (b.displacement->x[i] - a.displacement->x[i]) +
             (pair.b.arm_x - at->x[1][i]) - (pair.a.arm_x - at->x[0][i]);
    pair.z = at->rise[i] + (b.displacement->z[i] - a.displacement->z[i]) +
             (pair.b.arm_z - at->z[1][i]) - (pair.a.arm_z - at->z[0][i]);
    return pair;
}

/* Both points moved to midway between them, where a contact acts. */
static inline CzPair cz_met_midway(CzCarrier a, CzCarrier b, CzPair pair, size_t i) {
    pair.a = cz_point_at(a, i, pair.a.arm_x + 0.5 * pair.x, pair.a.arm_z + 0.5 * pair.z);
    pair.b = cz_point_at(b, i, pair.b.arm_x - 0.5 * pair.x, pair.b.arm_z - 0.5 * pair.z);
    return pair;
}

/* A point in the frame of a carrier: along and across its axis, and the rates there. */
typedef struct {
    double along, up;           /* [m] */
    double rate_along, rate_up; /* [m/s] */
} CzInFrame;

/* The arm is from the carrier's centre of gravity to the point, the velocity relative to that of
 * the centre. */
static inline CzInFrame cz_in_frame(CzCarrier frame, size_t i, CzPoint point) {
    const double c = frame.turned->cosine[i], s = frame.turned->sine[i];
    const double turn = frame.rate->pitch[i];
    CzInFrame at;
    at.along = c * point.arm_x + s * point.arm_z;
    at.up = c * point.arm_z - s * point.arm_x;
    at.rate_along = c * point.velocity_x + s * point.velocity_z + turn * at.up;
    at.rate_up = c * point.velocity_z - s * point.velocity_x - turn * at.along;
    return at;
}

/* Applies a force to a carrier at a point in its frame, and returns the force on the other body:
 * `pull` along the carrier's axis, forward on the other, `lifted` across it, downward on the
 * other. */
static inline CzPush cz_put_in_frame(CzPlane *on, CzCarrier frame, size_t i, CzInFrame at,
                                     double pull, double lifted) {
    const double c = frame.turned->cosine[i], s = frame.turned->sine[i];
    const CzPush other = {c * pull + s * lifted, s * pull - c * lifted, 0.0};
    on->x[i] -= other.x;
    on->z[i] -= other.z;
    on->pitch[i] += at.along * lifted + at.up * pull;
    return other;
}

/* Cosine and sine of an angle: exact at any angle, so that strokes remain the integrals of their
 * rates however far a body rotates. */
static inline void rotate(const double *restrict pitch, CzTurned *restrict turned) {
    CZ_LANES (i) {
        const CzComplex both = cz_turned(pitch[i] * (0.5 / CZ_PI));
        turned->cosine[i] = both.re;
        turned->sine[i] = both.im;
    }
}

static void rotations(CzBlock *d) {
    rotate(d->position.body.pitch, &d->turned.body);
    for (int end = 0; end < 2; ++end)
        rotate(d->position.end[end].pitch, &d->turned.end[end]);
    for (int bogie = 0; bogie < 2; ++bogie)
        rotate(d->position.bogie[bogie].pitch, &d->turned.bogie[bogie]);
}

/* ---- the bodies of a block ---- */

static inline CzCarrier own_body(const CzBlock *d) {
    return (CzCarrier){&d->position.body, &d->velocity.body, &d->turned.body};
}

static inline CzCarrier own_end(const CzBlock *d, int end) {
    return (CzCarrier){&d->position.end[end], &d->velocity.end[end], &d->turned.end[end]};
}

static inline CzCarrier own_bogie(const CzBlock *d, int bogie) {
    return (CzCarrier){&d->position.bogie[bogie], &d->velocity.bogie[bogie],
                       &d->turned.bogie[bogie]};
}

/* Side A of an interface is this car's body or front end, side B that of the car ahead: its body or
 * rear end. */
static inline CzCarrier body_at(const CzBlock *d, int side) {
    return side == 0 ? own_body(d) : carrier_of(&d->ahead.body);
}

static inline CzCarrier end_at(const CzBlock *d, int side) {
    return side == 0 ? own_end(d, 1) : carrier_of(&d->ahead.end);
}

/* Forces on them. The forces of an interface on the car ahead have separate rows, which are added
 * to that car once all interfaces are evaluated. */
static inline CzPlane *force_on_body(CzBlock *d, int side) {
    return side == 0 ? &d->force.body : &d->pushed.body;
}

static inline CzPlane *force_on_end(CzBlock *d, int side) {
    return side == 0 ? &d->force.end[1] : &d->pushed.end;
}

static inline double *section_behind(CzBlock *d, int side) {
    return side == 0 ? d->published.section[1] : d->pushed.section;
}

#endif
