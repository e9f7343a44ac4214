/* Suspensions, traction links and axle guidance: each bogie in the frame of the body, each axle in
 * the frame of its bogie. Part of kernel.c only.
 *
 * A bogie is connected to the body at the pin of its link, an axle to the bogie at its centre; both
 * may rotate by any angle, as a bogie with lifted wheels does. At any angle strokes are the
 * integrals of their rates, so that springs return no more energy than they received.
 */
#ifndef CZ_DYNAMICS_KERNEL_GEAR_H
#define CZ_DYNAMICS_KERNEL_GEAR_H

#include "dynamics/kernel_gear_line.h"
#include "dynamics/law_rows.h"
#include "laws/link.h"

/* Forces of springs and dampers. */
typedef struct {
    double spring, damper;   /* of the suspension, with its stops [N] */
    double guides, resisted; /* along the frame: link, or axle guidance, forward on bogie or axle */
} GearForces;

static inline GearForces gear_forces(const CzSuspensionLaw *law, const CzStrutRows *strut,
                                     StrutStrokes at, size_t i) {
    return (GearForces){cz_suspension_spring(law, at.compression),
                        cz_suspension_damper(law, at.rate),
                        cz_link_spring(strut->stiffness[i], at.stretch),
                        cz_link_damper(strut->damping[i], at.stretching)};
}

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
        const StrutStrokes at = strokes_in_frame(line.at, rest);
        const CzSuspensionLaw law = cz_suspension_at(&rows->secondary, preload, i);
        const GearForces of = gear_forces(&law, &rows->link.strut, at, i);
        const double lifted = of.spring + of.damper, pull = of.guides + of.resisted;
        cz_put_force(on_bogie, i, line.pin,
                     cz_put_in_frame(on_body, body, i, line.at, pull, lifted));
        published->secondary[bogie].compression[i] = at.compression;
        published->secondary[bogie].force[i] = lifted;
        published->secondary[bogie].stop_vertical[i] = cz_suspension_stops(&law, at.compression);
        published->link[bogie].force[i] = pull;
        published->link[bogie].travel[i] = at.stretch;
        power->secondary[i] += of.spring * at.rate;
        power->secondary_damping[i] += of.damper * at.rate;
        power->link[i] += of.guides * at.stretching;
        power->link_damping[i] += of.resisted * at.stretching;
    }
}

/* Evaluates one axle, counted from the rear of the car. */
static void axle_to_bogie(CzBlock *d, int axle) {
    const int bogie = axle / 2;
    const double sign = axle % 2 == 0 ? -1.0 : 1.0;
    const CzParameters *restrict rows = &d->parameter;
    const double *restrict preload = rows->primary_preload[axle];
    const CzCarrier frame = own_bogie(d, bogie);
    const CzWheelset *at_axle = &d->position.wheelset[axle], *rate = &d->velocity.wheelset[axle];
    CzPlane *on_bogie = &d->force.bogie[bogie];
    CzWheelset *on_axle = &d->force.wheelset[axle];
    CzPower *restrict power = d->power;
    double *restrict compressed = d->published.primary[axle].compression;
    double *restrict stretched = d->published.axle_guidance[axle].travel;
    CZ_LANES (i) {
        const Rest rest = {sign * rows->axle_x[i], rows->axle_z[i]};
        const CzInFrame seat = line_up_axle(frame, at_axle, rate, rest, i);
        const StrutStrokes at = strokes_in_frame(seat, rest);
        const CzSuspensionLaw law = cz_suspension_at(&rows->primary, preload, i);
        const GearForces of = gear_forces(&law, &rows->axle_guidance, at, i);
        put_on_axle(on_axle, i,
                    cz_put_in_frame(on_bogie, frame, i, seat, of.guides + of.resisted,
                                    of.spring + of.damper));
        compressed[i] = at.compression;
        stretched[i] = at.stretch;
        power->primary[i] += of.spring * at.rate;
        power->primary_damping[i] += of.damper * at.rate;
        power->axle_guidance[i] += of.guides * at.stretching;
        power->axle_guidance_damping[i] += of.resisted * at.stretching;
    }
}

#endif
