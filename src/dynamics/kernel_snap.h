/* Crush zones without end mass that snap. Part of kernel.c only.
 *
 * Where the strength of a crush zone, or of the anti-climber in series with it, falls faster than
 * the elasticity of the chain can follow, the members jump from one equilibrium to the next within
 * a step, under a force that a chain without mass cannot tell. Bodies give the mean force of the
 * step over the closure, (F_last + F) / 2, and so do all members that are straight lines:
 * compliance, anti-climbers. A crush zone takes what its law says of its state,
 *
 *   released = (F_last + F) / 2 * stroke - damped - (E(x) - E(x_last))     of both sides together,
 *
 * and what is left over is what the elasticity released beyond what the falling member takes at its
 * own force. In a vehicle it goes into vibration and heat at that member; so it is dissipated
 * there: in the crush zones that went on, or else by the anti-climbers.
 */
#ifndef CZ_DYNAMICS_KERNEL_SNAP_H
#define CZ_DYNAMICS_KERNEL_SNAP_H

#include "dynamics/kernel_face.h"

/* Whether a member of the chain of faces snaps in a lane: it went on while the force fell. */
static int snaps(const CzBlock *d, size_t i) {
    const double last = M(FACE_FORCE)[i], force = NEXT(FACE_FORCE)[i];
    return S(LAW_FALLS)[i] > 0.0 || force < (1.0 - LARGE_DROP) * last;
}

/* Of one lane, whose number among all is `lane`. */
static void settle_snap(const CzDynamics *dynamics, CzBlock *d, size_t i, size_t lane) {
    const double mean = 0.5 * (M(FACE_FORCE)[i] + NEXT(FACE_FORCE)[i]);
    double released = 0.0, zone[2], face[2];
    for (int side = 0; side < 2; ++side) {
        const double stroke = M_AT(LIMP_A, side)[i], next = NEXT_AT(LIMP_A, side)[i];
        const double peak = M_AT(LIMP_PEAK_A, side)[i], next_peak = NEXT_AT(LIMP_PEAK_A, side)[i];
        zone[side] = next_peak - peak;
        face[side] = NEXT_AT(FACE_A, side)[i] - M_AT(FACE_A, side)[i];
        if (P_AT(LIMP_END_A, side)[i] < 0.5)
            continue;
        released += mean * (next - stroke) -
                    (NEXT_AT(LIMP_DAMPED_A, side)[i] - M_AT(LIMP_DAMPED_A, side)[i]) -
                    (cz_limp_received_at(dynamics, lane, side, next, next_peak) -
                     cz_limp_received_at(dynamics, lane, side, stroke, peak));
    }
    const double zones = zone[0] + zone[1], faces_went = face[0] + face[1];
    for (int side = 0; side < 2; ++side)
        if (zones > 0.0)
            NEXT_AT(LIMP_DAMPED_A, side)[i] += released * zone[side] / zones;
        else if (faces_went > 0.0)
            NEXT_AT(FACE_ENERGY_A, side)[i] += released * face[side] / faces_went;
}

/* After the faces of a block were evaluated. Faces that lose their overlap have no work at all. */
static void settle_snaps(const CzDynamics *dynamics, int index) {
    CzBlock *d = &dynamics->block[index];
    if (!d->has_limp_end[0] && !d->has_limp_end[1])
        return;
    for (size_t i = 0; i < CZ_LANE_BLOCK; ++i)
        if (snaps(d, i) && NEXT(FACE_LOST)[i] == 0.0)
            settle_snap(dynamics, d, i, (size_t)index * CZ_LANE_BLOCK + i);
}

#endif
