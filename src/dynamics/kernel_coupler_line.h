/* Geometry and forces of couplers: a massless strut between two pivots. Part of kernel.c only.
 *
 *   closure = free length - |r_B - r_A|,   force along the current line;
 *   where neither car can tilt, or one is a wall, closure and force are those along the track;
 *   where it has sheared off, those along the mean normal of the cars
 */
#ifndef CZ_DYNAMICS_KERNEL_COUPLER_LINE_H
#define CZ_DYNAMICS_KERNEL_COUPLER_LINE_H

#include "dynamics/kernel_carrier.h"

/* Geometry of a coupler. */
typedef struct {
    _Alignas(64) CzRow closure;
    CzRow rate;
    CzRow direction_x, direction_z; /* from side A to side B */
    CzRow turn;                     /* rate of the line's angle [rad/s] */
    CzRow inverse_length;           /* of the strut [1/m] */
    CzRow arm_x[2], arm_z[2];       /* points of action from the carriers' centres of gravity */
} CouplerLine;

/* Forces of a coupler, and the moments of its hinges on their carriers. */
typedef struct {
    _Alignas(64) CzRow x; /* on side B [N] */
    CzRow z;
    CzRow push;             /* largest longitudinal force of the step [N] */
    CzRow hinge_x, hinge_z; /* part of x and z that reacts the moments */
    CzRow moment[2];        /* [N m] */
    CzRow mating[2]; /* force along the line that presses the faces flat against the hinge of a side
                        [N] */
} CouplerForces;

/* ---- geometry ---- */

/* One row of the pivot's carrier: the end mass's where the pivot is fixed to it, else the body's.
 */
static inline double chosen(double on_end, double end, double body) {
    return on_end > 0.5 ? end : body;
}

/* The carrier of the coupler at one side, its rows in `motion`. */
static CzCarrier coupler_carrier(const CzBlock *d, int side, CzMotion *restrict motion) {
    const double *restrict on_end = d->parameter.coupler.side[side].on_end;
    const CzCarrier e = end_at(d, side), b = body_at(d, side);
    CZ_LANES (i) {
        const double w = on_end[i];
        motion->displacement.x[i] = chosen(w, e.displacement->x[i], b.displacement->x[i]);
        motion->displacement.z[i] = chosen(w, e.displacement->z[i], b.displacement->z[i]);
        motion->displacement.pitch[i] =
            chosen(w, e.displacement->pitch[i], b.displacement->pitch[i]);
        motion->rate.x[i] = chosen(w, e.rate->x[i], b.rate->x[i]);
        motion->rate.z[i] = chosen(w, e.rate->z[i], b.rate->z[i]);
        motion->rate.pitch[i] = chosen(w, e.rate->pitch[i], b.rate->pitch[i]);
        motion->turned.cosine[i] = chosen(w, e.turned->cosine[i], b.turned->cosine[i]);
        motion->turned.sine[i] = chosen(w, e.turned->sine[i], b.turned->sine[i]);
    }
    return carrier_of(motion);
}

/* Where neither car can pitch, the line is along the track at any closure. */
static void line_up_coupler(CzCarrier a, CzCarrier b, const CzCouplerRows *restrict rows,
                            const double *restrict tilting, CouplerLine *restrict line) {
    CZ_LANES (i) {
        const double tilts = tilting[i];
        CzPair pair = cz_pair_of(a, b, &rows->pivot, i);
        pair.z = tilts * pair.z;
        const double vx = pair.b.velocity_x - pair.a.velocity_x;
        const double vz = tilts * (pair.b.velocity_z - pair.a.velocity_z);
        const double apart = sqrt(pair.x * pair.x + pair.z * pair.z);
        const double strut =
            pair.x < 0.0 ? -apart : apart; /* the run of a strut fails where its pivots pass */
        const double l = tilts > 0.0 ? strut : pair.x;
        const double inverse = 1.0 / (tilts > 0.0 ? strut : 1.0);
        const double nx = tilts > 0.0 ? pair.x * inverse : 1.0, nz = pair.z * inverse;
        line->closure[i] = rows->length[i] - l;
        line->rate[i] = -(nx * vx + nz * vz);
        line->turn[i] = (nx * vz - nz * vx) * inverse;
        line->direction_x[i] = nx;
        line->direction_z[i] = nz;
        line->inverse_length[i] = inverse;
        line->arm_x[0][i] = pair.a.arm_x;
        line->arm_z[0][i] = pair.a.arm_z;
        line->arm_x[1][i] = pair.b.arm_x;
        line->arm_z[1][i] = pair.b.arm_z;
    }
}

/* The line of a coupler that has sheared off no longer rotates about two pivots: the coupler pushes
 * like a face, midway between them and along the mean normal of the cars, also after the pivots
 * have passed each other. */
static void line_up_released(CzCarrier a, CzCarrier b, const CzBlock *d,
                             CouplerLine *restrict line) {
    const CzCouplerRows *restrict rows = &d->parameter.coupler;
    const CzCouplerMemory *restrict memory = &d->memory->coupler;
    const double *restrict tilts = d->parameter.tilts;
    CZ_LANES (i) {
        const double sheared_a =
            memory->side[0].shear[i] >= rows->side[0].shear.softening[i] ? tilts[i] : 0.0;
        const double sheared =
            memory->side[1].shear[i] >= rows->side[1].shear.softening[i] ? tilts[i] : sheared_a;
        const CzPair pair = cz_pair_of(a, b, &rows->pivot, i);
        const double tilt = 0.5 * (a.displacement->pitch[i] + b.displacement->pitch[i]);
        const double nx = 1.0 / sqrt(1.0 + tilt * tilt), nz = tilt * nx;
        const CzPair met = cz_met_midway(a, b, pair, i);
        const double vx = met.a.velocity_x - met.b.velocity_x;
        const double vz = met.a.velocity_z - met.b.velocity_z;
        line->closure[i] =
            sheared > 0.0 ? rows->along[i] - (nx * pair.x + nz * pair.z) : line->closure[i];
        line->rate[i] = sheared > 0.0 ? nx * vx + nz * vz : line->rate[i];
        line->turn[i] = sheared > 0.0 ? 0.0 : line->turn[i];
        line->direction_x[i] = sheared > 0.0 ? nx : line->direction_x[i];
        line->direction_z[i] = sheared > 0.0 ? nz : line->direction_z[i];
        line->inverse_length[i] = sheared > 0.0 ? 1.0 : line->inverse_length[i];
        line->arm_x[0][i] = sheared > 0.0 ? met.a.arm_x : line->arm_x[0][i];
        line->arm_z[0][i] = sheared > 0.0 ? met.a.arm_z : line->arm_z[0][i];
        line->arm_x[1][i] = sheared > 0.0 ? met.b.arm_x : line->arm_x[1][i];
        line->arm_z[1][i] = sheared > 0.0 ? met.b.arm_z : line->arm_z[1][i];
    }
}

/* Angle of the line against the car of one side, less that at rest; the rate at which the hinge of
 * that side turns. */
static void line_up_swing(CzCarrier car, const CouplerLine *restrict line,
                          const double *restrict rest, double *restrict swing,
                          double *restrict turning) {
    CZ_LANES (i) {
        const double nz = line->direction_z[i];
        const double angle = nz * (1.0 + nz * nz * (1.0 / 6.0));
        swing[i] = angle - rest[i] - car.displacement->pitch[i];
        turning[i] = line->turn[i] - car.rate->pitch[i];
    }
}

/* Whether a coupler may be within reach, judged by the distance of its pivots along the track,
 * which never exceeds that along the coupler. */
static int pivots_are_near(const CzBlock *d) {
    const CzCouplerRows *restrict rows = &d->parameter.coupler;
    const CzCarrier ea = end_at(d, 0), ba = body_at(d, 0);
    const CzCarrier eb = end_at(d, 1), bb = body_at(d, 1);
    const double *restrict reach = d->coupler_reach;
    double near = 0.0;
    CZ_LANES_MAX(i, near) {
        const double on_a = rows->side[0].on_end[i], on_b = rows->side[1].on_end[i];
        const double x_a = rows->pivot.x[0][i], x_b = rows->pivot.x[1][i];
        const double z_a = rows->pivot.z[0][i], z_b = rows->pivot.z[1][i];
        const double ax =
            chosen(on_a, cz_point_of(ea, i, x_a, z_a).arm_x, cz_point_of(ba, i, x_a, z_a).arm_x);
        const double bx =
            chosen(on_b, cz_point_of(eb, i, x_b, z_b).arm_x, cz_point_of(bb, i, x_b, z_b).arm_x);
        const double moved = chosen(on_b, eb.displacement->x[i], bb.displacement->x[i]) -
                             chosen(on_a, ea.displacement->x[i], ba.displacement->x[i]);
        const double along = rows->pivot.distance[i] + moved + (bx - x_b) - (ax - x_a);
        const double closure = rows->length[i] - along;
        near = cz_larger(near, closure <= reach[i] ? 0.0 : 1.0); /* a NaN counts as near */
    }
    return near > 0.0;
}

/* Change of the height of one underframe over the other. */
static void underframe_extremes(CzBlock *d) {
    const CzCarrier own = own_body(d), ahead = body_at(d, 1);
    const double *restrict x_own = d->parameter.underframe_x[0], *restrict x_ahead =
                                                                     d->parameter.underframe_x[1];
    const double *restrict tilts = d->parameter.tilts;
    double *restrict rise = d->extreme.underframe_rise;
    CZ_LANES (i) {
        const double here = own.displacement->z[i] + x_own[i] * own.turned->sine[i];
        const double there = ahead.displacement->z[i] + x_ahead[i] * ahead.turned->sine[i];
        rise[i] = cz_larger(rise[i], tilts[i] * fabs(there - here));
    }
}

/* ---- forces on the carriers ---- */

/* Sums the strut force with the part that a release adds, the force that presses the faces flat,
 * and the reaction to the hinges.
 */
static void sum_coupler_forces(CzBlock *d, const CouplerLine *restrict line,
                               const double *restrict force, const double *restrict more,
                               CouplerForces *restrict forces) {
    const double *restrict tilts = d->parameter.tilts, *restrict top = d->published.coupler.top;
    double *restrict total = d->published.interface.force, *restrict drop =
                                                               d->published.interface.drop;
    double *restrict kept = d->published.coupler.force, *restrict power = d->power->coupler;
    CZ_LANES (i) { /* on side B */
        const double nx = line->direction_x[i], nz = line->direction_z[i];
        const double transverse =
            tilts[i] * (forces->moment[0][i] + forces->moment[1][i]) * line->inverse_length[i];
        const double mating = forces->mating[0][i] + forces->mating[1][i];
        const double pushing = force[i] + more[i] + mating;
        const double at_end = (force[i] + mating) * nx + transverse * nz;
        const double lost = top[i] > 0.0 ? cz_positive_part(top[i] - force[i]) * nx : 0.0;
        forces->hinge_x[i] = transverse * nz;
        forces->hinge_z[i] = -transverse * nx;
        forces->x[i] = pushing * nx + transverse * nz;
        forces->z[i] = pushing * nz - transverse * nx;
        forces->push[i] = at_end + lost;
        drop[i] += lost;
        total[i] += at_end;
        kept[i] = force[i];
        power[i] += (force[i] + more[i]) * line->rate[i];
    }
}

/* Applies strut force and hinge moments to the carriers of one side, and adds the largest strut
 * force of the step to the section behind. */
static void put_coupler(CzBlock *d, int side, const CouplerLine *restrict line,
                        const CouplerForces *restrict forces) {
    const double *restrict on_end = d->parameter.coupler.side[side].on_end;
    const double sign = side == 0 ? -1.0 : 1.0;
    CzPlane *end = force_on_end(d, side), *body = force_on_body(d, side);
    double *restrict section = section_behind(d, side);
    CZ_LANES (i) {
        const CzPoint at = {.arm_x = line->arm_x[side][i], .arm_z = line->arm_z[side][i]};
        const CzPush push = {sign * forces->x[i], sign * forces->z[i], forces->moment[side][i]};
        cz_put_shared(end, body, i, cz_push_at_centre(at, push), on_end[i]);
        section[i] += forces->push[i] - on_end[i] * forces->push[i];
    }
}

/* Adds to a budget the forces of strut and hinges on the body of one side. */
static void note_coupler(CzBlock *d, int side, const CouplerLine *restrict line,
                         const CouplerForces *restrict forces, double step) {
    const double *restrict on_end = d->parameter.coupler.side[side].on_end;
    const double *restrict own = forces->moment[side];
    const double sign = side == 0 ? -1.0 : 1.0;
    CzBudgetRows *restrict budget = d->budget;
    CZ_LANES (i) {
        const CzPoint at = {.arm_x = line->arm_x[side][i], .arm_z = line->arm_z[side][i]};
        const double on_body = 1.0 - on_end[i];
        const CzPush all =
            cz_push_at_centre(at, (CzPush){sign * forces->x[i], sign * forces->z[i], own[i]});
        const CzPush hinge = cz_push_at_centre(
            at, (CzPush){sign * forces->hinge_x[i], sign * forces->hinge_z[i], own[i]});
        budget->hinge_lift[side][i] += step * (on_body * hinge.z);
        budget->hinge_moment[side][i] += step * (on_body * hinge.pitch);
        budget->coupler_lift[side][i] += step * (on_body * all.z - on_body * hinge.z);
        budget->coupler_moment[side][i] += step * (on_body * all.pitch - on_body * hinge.pitch);
    }
}

#endif
