/* Crush zones without end mass that snap. Part of kernel.c only.
 *
 * Where the strength of a crush zone, or of the anti-climber in series with it, falls faster than
 * the elasticity of the chain can follow, the members jump from one equilibrium to the next within
 * a step, under a force that a chain without mass cannot determine. The work of the bodies is the
 * mean force of the step, (F_last + F) / 2, over the closure, and so is that of the linear members:
 * compliance, anti-climbers. A crush zone receives the energy that its law gives for its state,
 *
 *   released = (F_last + F) / 2 * stroke - damped - (E(x) - E(x_last))     of both sides together,
 *
 * and the rest is the elastic energy released beyond the work on the falling member at its own
 * force. In a vehicle it becomes vibration and heat at that member, so it is dissipated there: in
 * the crush zones that crushed further, or else in the anti-climbers.
 */
#ifndef CZ_DYNAMICS_KERNEL_SNAP_H
#define CZ_DYNAMICS_KERNEL_SNAP_H

#include "dynamics/kernel_massless.h"
#include "dynamics/stored.h"

/* Memory of the faces of a block before and after a step. */
typedef struct {
    const CzFaceMemory *memory;
    CzFaceMemory *next;
} FaceStep;

/* Whether a member of the chain of faces snaps in a lane: it crushed further while the force
 * fell. */
static int snaps(const FaceChain *of, size_t i) {
    return of->chain.now.falls[i] > 0.0 ||
           of->chain.next[i] < (1.0 - LARGE_DROP) * of->chain.last[i];
}

/* Dissipates the released energy of one lane; `lane` is its number among all. */
static void settle_snap(const CzDynamics *dynamics, const FaceChain *of, FaceStep faces, size_t i,
                        size_t lane) {
    const double mean = 0.5 * (of->chain.last[i] + of->chain.next[i]);
    double released = 0.0, zone[2], face[2];
    for (int side = 0; side < 2; ++side) {
        const CzMasslessMemory *before = of->massless[side].memory,
                               *after = of->massless[side].next;
        zone[side] = after->peak[i] - before->peak[i];
        face[side] = faces.next->side[side].stroke[i] - faces.memory->side[side].stroke[i];
        if (of->massless[side].exists[i] < 0.5)
            continue;
        released +=
            mean * (after->stroke[i] - before->stroke[i]) - (after->damped[i] - before->damped[i]) -
            (cz_massless_received_at(dynamics, lane, side, after->stroke[i], after->peak[i]) -
             cz_massless_received_at(dynamics, lane, side, before->stroke[i], before->peak[i]));
    }
    const double zones = zone[0] + zone[1], both_faces = face[0] + face[1];
    for (int side = 0; side < 2; ++side)
        if (zones > 0.0)
            of->massless[side].next->damped[i] += released * zone[side] / zones;
        else if (both_faces > 0.0)
            faces.next->side[side].energy[i] += released * face[side] / both_faces;
}

/* The same for some lane of a block. */
static int some_snap(const FaceChain *of) {
    const double *restrict falls = of->chain.now.falls, *restrict next = of->chain.next,
                           *restrict last = of->chain.last;
    double snapped = 0.0;
    CZ_LANES_MAX(i, snapped) {
        const double drops = next[i] < (1.0 - LARGE_DROP) * last[i] ? 1.0 : 0.0;
        snapped = cz_larger(snapped, falls[i] > 0.0 ? 1.0 : drops);
    }
    return snapped > 0.0;
}

/* Settles all snaps, after the faces of a block were evaluated. Faces that lose their overlap do no
 * work. */
static void settle_snaps(const CzDynamics *dynamics, int index, const FaceChain *of) {
    const CzBlock *d = &dynamics->block[index];
    const FaceStep faces = {&d->memory->face, &d->next_memory->face};
    if ((!d->has_massless[0] && !d->has_massless[1]) || !some_snap(of))
        return;
    for (size_t i = 0; i < CZ_LANE_BLOCK; ++i)
        if (snaps(of, i) && faces.next->lost[i] == 0.0)
            settle_snap(dynamics, of, faces, i, (size_t)index * CZ_LANE_BLOCK + i);
}

#endif
