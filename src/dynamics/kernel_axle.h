/* Primary suspension and axle guidance of one axle, in the frame of the bogie: one whose wheels are
 * off the rail may turn by any angle. Part of kernel.c only.
 *
 * Strokes and rates are each other's integrals at any, so that the springs give back no more than
 * they took.
 */
#ifndef CZ_DYNAMICS_KERNEL_AXLE_H
#define CZ_DYNAMICS_KERNEL_AXLE_H

#include "dynamics/kernel_bogie.h"

/* One axle, counted from the rear of the car. */
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
        const CzSight seen = line_up_axle(frame, at_axle, rate, rest, i);
        const StrutStrokes at = strokes_seen(seen, rest);

        const CzSuspensionLaw law = cz_suspension_at(&rows->primary, preload, i);
        const double spring = cz_suspension_spring(&law, at.compression);
        const double damper = cz_suspension_damper(&law, at.rate);
        const double lifted = spring + damper;
        const double held = rows->axle_guidance.stiffness[i] * at.stretch;
        const double resisted = rows->axle_guidance.damping[i] * at.stretching;
        const double pull = held + resisted; /* forward on the wheelset */

        put_on_axle(on_axle, i, cz_put_seen(on_bogie, frame, i, seen, pull, lifted));
        compressed[i] = at.compression;
        stretched[i] = at.stretch;
        power->primary[i] += spring * at.rate;
        power->primary_damping[i] += damper * at.rate;
        power->axle_guidance[i] += held * at.stretching;
        power->axle_guidance_damping[i] += resisted * at.stretching;
    }
}

#endif
