/* Draw gears: tension between the bodies of two coupled cars, parallel to side buffers, which act
 * in compression only. Part of kernel.c only. */
#ifndef CZ_DYNAMICS_KERNEL_DRAW_GEAR_H
#define CZ_DYNAMICS_KERNEL_DRAW_GEAR_H

#include "dynamics/kernel_contact_line.h"
#include "laws/draw_gear.h"

/* Evaluates all draw gears; a lane without any has an infinite slack. */
static void draw_gears(CzBlock *d) {
    const CzDrawGearRows *restrict rows = &d->parameter.draw_gear;
    double *restrict force = d->published.draw_gear.force;
    double *restrict power = d->power->draw_gear;
    Normal normal;
    Contact contact;
    line_up_normal(d, body_at(d, 0), body_at(d, 1), &normal);
    line_up_contact(d, body_at(d, 0), body_at(d, 1), &rows->contact, &normal, &contact);
    CZ_LANES (i) {
        force[i] = cz_draw_gear(rows->stiffness[i], rows->slack[i], contact.closure[i]);
        power[i] += force[i] * contact.rate[i];
    }
    put_contact(force_on_body(d, 0), force_on_body(d, 1), &contact, force, zeros,
                d->published.interface.force);
    for (int side = 0; side < 2; ++side) {
        double *restrict section = section_behind(d, side);
        CZ_LANES (i) {
            section[i] += contact.force_x[i];
        }
    }
}

#endif
