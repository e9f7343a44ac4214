/* Geometry and forces of bogies and axles: a bogie in the frame of the body, axles in that of a
 * bogie. Part of kernel.c only. */
#ifndef CZ_DYNAMICS_KERNEL_GEAR_LINE_H
#define CZ_DYNAMICS_KERNEL_GEAR_LINE_H

#include "dynamics/kernel_carrier.h"

/* Geometry of a bogie: its pin, from its centre of gravity and in the frame of the body. */
typedef struct {
    CzPoint pin;
    CzInFrame at;
} BogieLine;

/* Place of a point at rest, in the frame of its carrier. */
typedef struct {
    double along, up; /* [m] */
} Rest;

/* Strokes and rates of suspension and link. */
typedef struct {
    double compression, rate; /* [m, m/s] */
    double stretch, stretching;
} StrutStrokes;

/* ---- geometry ---- */

static inline BogieLine line_up_bogie(CzCarrier body, CzCarrier bogie, const CzParameters *rows,
                                      Rest rest, size_t i) {
    const double link_bogie = rows->link.bogie_z[i];
    const CzPoint pin = cz_point_of(bogie, i, 0.0, link_bogie);
    const double turn = bogie.rate->pitch[i];
    const CzPoint from_body = {
        rest.along + (bogie.displacement->x[i] - body.displacement->x[i]) + pin.arm_x,
        rest.up - link_bogie + (bogie.displacement->z[i] - body.displacement->z[i]) + pin.arm_z,
        bogie.rate->x[i] - body.rate->x[i] - pin.arm_z * turn,
        bogie.rate->z[i] - body.rate->z[i] + pin.arm_x * turn};
    return (BogieLine){pin, cz_in_frame(body, i, from_body)};
}

static inline StrutStrokes strokes_in_frame(CzInFrame at, Rest rest) {
    return (StrutStrokes){at.up - rest.up, at.rate_up, rest.along - at.along, -at.rate_along};
}

/* The axle in the frame of the bogie. */
static inline CzInFrame line_up_axle(CzCarrier bogie, const CzWheelset *at, const CzWheelset *rate,
                                     Rest rest, size_t i) {
    const CzPoint from_bogie = {rest.along + (at->x[i] - bogie.displacement->x[i]),
                                rest.up + (at->z[i] - bogie.displacement->z[i]),
                                rate->x[i] - bogie.rate->x[i], rate->z[i] - bogie.rate->z[i]};
    return cz_in_frame(bogie, i, from_bogie);
}

/* ---- forces on the carriers ---- */

/* Applies the load of an axle to it. */
static inline void put_on_axle(CzWheelset *on, size_t i, CzPush push) {
    on->x[i] += push.x;
    on->z[i] += push.z;
}

/* Forces of links, suspensions and stops on the body. */
typedef struct {
    _Alignas(64) CzRow link_moment;
    CzRow suspension_lift, suspension_moment;
    CzRow stop_lift, stop_moment;
} OfBogies;

/* Adds those of a bogie: the present sum on the body less that `before`. */
static void note_bogie(const CzBlock *d, int bogie, const CzPlane *restrict before,
                       OfBogies *restrict of) {
    const double sign = bogie == 0 ? -1.0 : 1.0;
    const CzParameters *restrict rows = &d->parameter;
    const CzCarrier body = own_body(d), frame = own_bogie(d, bogie);
    const CzPlane *restrict after = &d->force.body;
    CZ_LANES (i) {
        const BogieLine line = line_up_bogie(
            body, frame, rows, (Rest){sign * rows->bogie_x[i], rows->link.body_z[i]}, i);
        const double stop = d->published.secondary[bogie].stop_vertical[i];
        const double of_link = line.at.up * d->published.link[bogie].force[i];
        const double lift = body.turned->cosine[i] * stop;
        of->link_moment[i] += of_link;
        of->stop_lift[i] += lift;
        of->stop_moment[i] += line.at.along * stop;
        of->suspension_lift[i] += after->z[i] - before->z[i] - lift;
        of->suspension_moment[i] +=
            after->pitch[i] - before->pitch[i] - of_link - line.at.along * stop;
    }
}

/* Adds the forces of both bogies to a budget. */
static void add_bogies(CzBudgetRows *restrict budget, const OfBogies *restrict of, double step) {
    CZ_LANES (i) {
        budget->link_moment[i] += step * of->link_moment[i];
        budget->suspension_lift[i] += step * of->suspension_lift[i];
        budget->suspension_moment[i] += step * of->suspension_moment[i];
        budget->stop_lift[i] += step * of->stop_lift[i];
        budget->stop_moment[i] += step * of->stop_moment[i];
    }
}

#endif
