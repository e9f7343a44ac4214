/* Superstructures: contact above the underframes once the anti-climbers have lost contact. Part of
 * kernel.c only.
 *
 * They act in parallel with the anti-climbers, each at its own height and stroke, so nothing has to
 * be switched. Their contact is frictionless and vertical.
 */
#ifndef CZ_DYNAMICS_KERNEL_SUPERSTRUCTURE_H
#define CZ_DYNAMICS_KERNEL_SUPERSTRUCTURE_H

#include "dynamics/kernel_contact_line.h"
#include "laws/superstructure.h"

/* Evaluates all superstructures; a lane without any has no strength. */
static void superstructures(CzBlock *d) {
    const CzSuperstructureRows *restrict rows = &d->parameter.superstructure;
    const double *restrict set = d->memory->superstructure.set;
    double *restrict next = d->next_memory->superstructure.set;
    double *restrict force = d->published.superstructure.force;
    double *restrict power = d->power->superstructure;
    Contact contact;
    line_up_contact(d, end_at(d, 0), end_at(d, 1), &rows->contact, &contact);
    CZ_LANES (i) {
        const double strength = rows->strength[i];
        const CzSuperstructureResponse response =
            cz_superstructure(rows->stiffness[i], strength, contact.closure[i], set[i]);
        next[i] = strength > 0.0 ? response.set : set[i];
        force[i] = response.force;
        power[i] += response.force * contact.rate[i];
    }
    put_contact(force_on_end(d, 0), force_on_end(d, 1), &contact, force, zeros,
                d->published.interface.force);
}

#endif
