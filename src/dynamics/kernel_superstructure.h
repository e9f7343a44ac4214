/* Superstructures: what meets above the underframes once anti-climbers have lost each other. Part
 * of kernel.c only.
 *
 * They stand beside the anti-climbers, each with a height and a way of its own, so nothing has to
 * be switched: whichever is reached pushes. Their contact is smooth and upright.
 */
#ifndef CZ_DYNAMICS_KERNEL_SUPERSTRUCTURE_H
#define CZ_DYNAMICS_KERNEL_SUPERSTRUCTURE_H

#include "dynamics/kernel_contact.h"
#include "laws/superstructure.h"

static const ContactRows superstructure_contact = {
    CZ_P_SUPERSTRUCTURE_X_A, CZ_P_SUPERSTRUCTURE_Z_A, CZ_P_SUPERSTRUCTURE_X_B,
    CZ_P_SUPERSTRUCTURE_Z_B, CZ_P_SUPERSTRUCTURE_GAP, CZ_P_SUPERSTRUCTURE_RISE};

/* All superstructures; a lane without any has no strength. */
static void superstructures(CzBlock *d) {
    const size_t n = CZ_LANE_BLOCK;
    const Carrier a = end_carrier(d, 0), b = end_carrier(d, 1);
    contact_geometry(d, &a, &b, &superstructure_contact);
    const double *restrict closure = S(CLOSURE), *restrict rate = S(RATE);
    const double *restrict stiffness = P(SUPERSTRUCTURE_STIFFNESS);
    const double *restrict strength = P(SUPERSTRUCTURE_STRENGTH);
    const double *restrict set = M(SUPERSTRUCTURE_SET);
    double *restrict next = NEXT(SUPERSTRUCTURE_SET), *restrict force = S(SUPERSTRUCTURE_FORCE);
    double *restrict power = POWER(SUPERSTRUCTURE);
    CZ_LANES (i, n) {
        const CzSuperstructureResponse response =
            cz_superstructure(stiffness[i], strength[i], closure[i], set[i]);
        next[i] = strength[i] > 0.0 ? response.set : set[i];
        force[i] = response.force;
        power[i] += response.force * rate[i];
    }
    const CarrierForce on_a = end_force(d, 0), on_b = end_force(d, 1);
    contact_forces(d, &on_a, &on_b, S(SUPERSTRUCTURE_FORCE), S(ZERO));
}

#endif
