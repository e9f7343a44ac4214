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

/* Whether some superstructures push, or a closure is not a number. */
static int superstructures_meet(const CzSuperstructureRows *restrict rows,
                                const double *restrict closure, const double *restrict set) {
    double meet = 0.0;
    CZ_LANES_MAX(i, meet) {
        meet = cz_larger(meet, closure[i] <= set[i] ? 0.0 : rows->strength[i]);
    }
    return meet > 0.0;
}

/* Evaluates all superstructures; a lane without any has no strength. Where none meet, which is in
 * nearly all steps, nothing changes. */
static void superstructures(CzBlock *d, const Normal *normal) {
    const CzSuperstructureRows *restrict rows = &d->parameter.superstructure;
    const CzCarrier a = end_at(d, 0), b = end_at(d, 1);
    const double *restrict set = d->memory->superstructure.set;
    double *restrict next = d->next_memory->superstructure.set;
    double *restrict force = d->published.superstructure.force;
    double *restrict power = d->power->superstructure;
    Contact contact;
    line_up_closure(d, a, b, &rows->contact, normal, contact.closure);
    if (!superstructures_meet(rows, contact.closure, set) && !d->leaves_nothing_out) {
        memcpy(next, set, sizeof(CzRow));
        memset(force, 0, sizeof(CzRow));
        return;
    }
    line_up_contact(d, a, b, &rows->contact, normal, &contact);
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
