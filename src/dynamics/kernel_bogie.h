/* Secondary suspension and traction link of one bogie, in the frame of the body. Part of kernel.c
 * only.
 *
 * Both act at the pin of the link on the bogie, as the body sees it. Strokes and rates are each
 * other's integrals at any pitch, so that the springs give back no more than they took.
 */
#ifndef CZ_DYNAMICS_KERNEL_BOGIE_H
#define CZ_DYNAMICS_KERNEL_BOGIE_H

#include "dynamics/kernel_carrier.h"
#include "laws/suspension.h"

/* A bogie lined up: the pin from the bogie's centre of gravity, and as the body sees it. */
typedef struct {
    CzPoint pin;
    CzSight seen;
} BogieLine;

/* Where a point is at rest, from the carrier that sees it. */
typedef struct {
    double along, up; /* [m] */
} Rest;

/* Strokes and rates of suspension and link. */
typedef struct {
    double compression, rate; /* [m, m/s] */
    double stretch, stretching;
} StrutStrokes;

static inline CzSuspensionLaw suspension_law(const CzSuspensionRows *rows, const double *preload,
                                             size_t i) {
    return (CzSuspensionLaw){rows->stiffness[i],     preload[i],
                             rows->bump_gap[i],      rows->bump_stiffness[i],
                             rows->lift_gap[i],      rows->lift_stiffness[i],
                             rows->damping[i],       rows->blow_off_rate[i],
                             rows->damping_beyond[i]};
}

/* ---- line up ---- */

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
    return (BogieLine){pin, cz_sight_of(body, i, from_body)};
}

static inline StrutStrokes strokes_seen(CzSight seen, Rest rest) {
    return (StrutStrokes){seen.up - rest.up, seen.rate_up, rest.along - seen.along,
                          -seen.rate_along};
}

/* ---- law ---- */

static void bogie_to_body(CzBlock *d, int bogie) {
    const double sign = bogie == 0 ? -1.0 : 1.0;
    const CzParameters *restrict rows = &d->parameter;
    const double *restrict preload = rows->secondary_preload[bogie];
    const CzCarrier body = own_body(d), frame = own_bogie(d, bogie);
    CzPlane *on_body = &d->force.body, *on_bogie = &d->force.bogie[bogie];
    CzPower *restrict power = d->power;
    CzPublished *restrict published = &d->published;
    CZ_LANES (i) {
        const Rest rest = {sign * rows->bogie_x[i], rows->link.body_z[i]};
        const BogieLine line = line_up_bogie(body, frame, rows, rest, i);
        const StrutStrokes at = strokes_seen(line.seen, rest);

        const CzSuspensionLaw law = suspension_law(&rows->secondary, preload, i);
        const double spring = cz_suspension_spring(&law, at.compression);
        const double damper = cz_suspension_damper(&law, at.rate);
        const double lifted = spring + damper;
        const double held = rows->link.strut.stiffness[i] * at.stretch;
        const double resisted = rows->link.strut.damping[i] * at.stretching;
        const double pull = held + resisted; /* forward on the bogie */

        cz_put_force(on_bogie, i, line.pin, cz_put_seen(on_body, body, i, line.seen, pull, lifted));
        published->secondary[bogie].compression[i] = at.compression;
        published->secondary[bogie].force[i] = lifted;
        published->secondary[bogie].stop_vertical[i] = cz_suspension_stops(&law, at.compression);
        published->link[bogie].force[i] = pull;
        published->link[bogie].travel[i] = at.stretch;
        power->secondary[i] += spring * at.rate;
        power->secondary_damping[i] += damper * at.rate;
        power->link[i] += held * at.stretching;
        power->link_damping[i] += resisted * at.stretching;
    }
}

/* ---- put ---- */

/* Notes for a budget what link, suspension and stops put on the body, which had `before` before
 * them. */
static void note_bogie(CzBlock *d, int bogie, const CzPlane *restrict before) {
    const double sign = bogie == 0 ? -1.0 : 1.0;
    const CzParameters *restrict rows = &d->parameter;
    const CzCarrier body = own_body(d), frame = own_bogie(d, bogie);
    const CzPlane *restrict after = &d->force.body;
    CzBudgetRows *restrict budget = d->budget;
    CZ_LANES (i) {
        const BogieLine line = line_up_bogie(
            body, frame, rows, (Rest){sign * rows->bogie_x[i], rows->link.body_z[i]}, i);
        const double stop = d->published.secondary[bogie].stop_vertical[i];
        const double of_link = line.seen.up * d->published.link[bogie].force[i];
        const double lift = body.turned->cosine[i] * stop;
        budget->link_moment[i] += of_link;
        budget->stop_lift[i] += lift;
        budget->stop_moment[i] += line.seen.along * stop;
        budget->suspension_lift[i] += after->z[i] - before->z[i] - lift;
        budget->suspension_moment[i] +=
            after->pitch[i] - before->pitch[i] - of_link - line.seen.along * stop;
    }
}

#endif
