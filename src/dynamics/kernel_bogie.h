/* Secondary suspension and traction link of one bogie, in the frame of the body. Part of kernel.c
 * only.
 *
 * Both act at the pin of the link on the bogie, as the body sees it. Strokes and rates are each
 * other's integrals at any pitch, so that the springs give back no more than they took.
 */
#ifndef CZ_DYNAMICS_KERNEL_BOGIE_H
#define CZ_DYNAMICS_KERNEL_BOGIE_H

#include "dynamics/kernel_bogie_line.h"
#include "dynamics/law_rows.h"

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

        const CzSuspensionLaw law = cz_suspension_at(&rows->secondary, preload, i);
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

#endif
