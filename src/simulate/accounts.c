/* Energy that every element has received and that it stores.
 *
 *   dissipated = received - stored, of each element
 *
 * Members of series chains receive the mean force of a step times their stroke in it, the
 * compliance of a chain receives what it stores, and crush zones what follows from their state: the
 * work of loading to the largest shortening less what unloading returns. All other elements receive
 * the integral of their power. This is the work of the laws; the work of the bodies is the force of
 * a chain or a crush zone times the closing rate (ledger rows of class BODIES). The two agree to
 * the square of the step.
 */
#include "simulate/run.h"

#include <math.h>

static CzAccount sum_of(CzAccount a, CzAccount b) {
    return (CzAccount){a.received + b.received, a.stored + b.stored};
}

/* Dissipated as a whole. */
static CzAccount lost(double work) {
    return (CzAccount){work, 0.0};
}

static CzAccount share_of(double share, CzAccount a) {
    return (CzAccount){share * a.received, share * a.stored};
}

bool cz_has_element(const CzBatch *batch, size_t lane, int side, CzElementKind kind) {
    const CzInterfaceEquipment *of = &batch->equipment[lane];
    switch (kind) {
    case CZ_ELEMENT_COUPLER:
        return of->side[side].has_coupler;
    case CZ_ELEMENT_ANTI_CLIMBER:
        return of->side[side].has_anti_climber;
    case CZ_ELEMENT_SIDE_BUFFERS:
        return of->side[side].has_side_buffers;
    case CZ_ELEMENT_SUPERSTRUCTURE:
        return of->has_superstructures;
    case CZ_ELEMENT_DRAW_GEAR:
        return of->has_draw_gears;
    default:
        return false;
    }
}

/* Share of one side in an element that both sides of an interface have in common. */
static double half_of(const CzBatch *batch, size_t lane, int side, CzElementKind kind) {
    return cz_has_element(batch, lane, 1 - side, kind) ? 0.5 : 1.0;
}

/* Stored as a whole. */
static CzAccount elastic(double stored) {
    return (CzAccount){stored, stored};
}

CzAccount cz_coupler_account(const CzBatch *batch, size_t lane, int side) {
    const CzDynamics *dynamics = batch->dynamics;
    const CzAccount members = {cz_memory(batch, CZ_MEMORY(coupler.side[side].energy), lane),
                               cz_coupler_stored(dynamics, lane, side)};
    const CzAccount hinge = {cz_work(batch, CZ_LEDGER(hinge[side]), lane),
                             cz_hinge_stored(dynamics, lane, side)};
    const CzAccount tubes = elastic(cz_coupler_tubes_stored(dynamics, lane));
    const double share = half_of(batch, lane, side, CZ_ELEMENT_COUPLER);
    return sum_of(sum_of(members, hinge), share_of(share, tubes));
}

CzAccount cz_side_account(const CzBatch *batch, size_t lane, int side) {
    const CzDynamics *dynamics = batch->dynamics;
    const CzAccount members = {cz_memory(batch, CZ_MEMORY(side_buffers.side[side].energy), lane),
                               cz_side_stored(dynamics, lane, side)};
    const CzAccount sliding = {cz_work(batch, CZ_LEDGER(side_sliding), lane),
                               cz_side_sliding_stored(dynamics, lane)};
    const CzAccount tubes = elastic(cz_side_tubes_stored(dynamics, lane));
    const double share = half_of(batch, lane, side, CZ_ELEMENT_SIDE_BUFFERS);
    return sum_of(members, share_of(share, sum_of(sliding, tubes)));
}

/* What both faces of an interface have in common: compliance, damping, ribs and friction. */
static CzAccount faces_account(const CzBatch *batch, size_t lane) {
    const CzDynamics *dynamics = batch->dynamics;
    const CzAccount strain = {cz_memory(batch, CZ_MEMORY(face.strain), lane),
                              cz_face_stored(dynamics, lane)};
    const CzAccount sliding = {cz_work(batch, CZ_LEDGER(face_sliding), lane),
                               cz_face_sliding_stored(dynamics, lane)};
    return sum_of(sum_of(strain, sliding), lost(cz_work(batch, CZ_LEDGER(face_damping), lane)));
}

CzAccount cz_anti_climber_account(const CzBatch *batch, size_t lane, int side) {
    const double share = half_of(batch, lane, side, CZ_ELEMENT_ANTI_CLIMBER);
    return sum_of(lost(cz_memory(batch, CZ_MEMORY(face.side[side].energy), lane)),
                  share_of(share, faces_account(batch, lane)));
}

CzAccount cz_bare_faces_account(const CzBatch *batch, size_t lane) {
    const bool bare = !cz_has_element(batch, lane, 0, CZ_ELEMENT_ANTI_CLIMBER) &&
                      !cz_has_element(batch, lane, 1, CZ_ELEMENT_ANTI_CLIMBER);
    return bare ? faces_account(batch, lane) : (CzAccount){0.0, 0.0};
}

CzAccount cz_superstructure_account(const CzBatch *batch, size_t lane) {
    return share_of(0.5, (CzAccount){cz_work(batch, CZ_LEDGER(superstructure), lane),
                                     cz_superstructure_stored(batch->dynamics, lane)});
}

CzAccount cz_draw_gear_account(const CzBatch *batch, size_t lane) {
    return share_of(0.5, elastic(cz_draw_gear_stored(batch->dynamics, lane)));
}

CzAccount cz_crush_account(const CzBatch *batch, size_t lane, int end) {
    return (CzAccount){cz_end_received(batch->dynamics, lane, end),
                       cz_end_stored(batch->dynamics, lane, end)};
}

CzAccount cz_guide_account(const CzBatch *batch, size_t lane, int end) {
    return elastic(cz_guide_stored(batch->dynamics, lane, end));
}

/* The end mass in its guidance and its hinge, and the damping of the crush zone. */
CzAccount cz_end_mass_account(const CzBatch *batch, size_t lane, int end) {
    const CzAccount fold = {cz_work(batch, CZ_LEDGER(fold[end]), lane),
                            cz_fold_stored(batch->dynamics, lane, end)};
    const CzAccount springs = sum_of(cz_guide_account(batch, lane, end), fold);
    return sum_of(springs, lost(cz_work(batch, CZ_LEDGER(end_damping[end]), lane) +
                                cz_work(batch, CZ_LEDGER(guide_damping[end]), lane) +
                                cz_work(batch, CZ_LEDGER(fold_damping[end]), lane)));
}

CzAccount cz_massless_account(const CzBatch *batch, size_t lane, int side) {
    return (CzAccount){cz_massless_received(batch->dynamics, lane, side),
                       cz_massless_stored(batch->dynamics, lane, side)};
}

CzAccount cz_chains_account(const CzBatch *batch, size_t lane) {
    const CzDynamics *dynamics = batch->dynamics;
    CzAccount sum = sum_of(elastic(cz_coupler_tubes_stored(dynamics, lane)),
                           elastic(cz_side_tubes_stored(dynamics, lane)));
    sum = sum_of(sum, elastic(cz_draw_gear_stored(dynamics, lane)));
    sum = sum_of(sum, (CzAccount){cz_memory(batch, CZ_MEMORY(face.strain), lane),
                                  cz_face_stored(dynamics, lane)});
    for (int side = 0; side < 2; ++side) {
        const double members = cz_memory(batch, CZ_MEMORY(coupler.side[side].energy), lane) +
                               cz_memory(batch, CZ_MEMORY(side_buffers.side[side].energy), lane);
        const double buffers =
            cz_coupler_stored(dynamics, lane, side) + cz_side_stored(dynamics, lane, side);
        sum = sum_of(sum, (CzAccount){members, buffers});
        sum = sum_of(sum, lost(cz_memory(batch, CZ_MEMORY(face.side[side].energy), lane) +
                               cz_memory(batch, CZ_MEMORY(face.side[side].massless.damped), lane)));
        sum = sum_of(sum, cz_massless_account(batch, lane, side));
    }
    return sum;
}

CzAccount cz_gear_account(const CzBatch *batch, size_t lane) {
    const CzDynamics *dynamics = batch->dynamics;
    const bool is_rigid =
        dynamics->track == NULL && dynamics->elements == NULL && dynamics->receptance == NULL;
    const double contact =
        is_rigid ? cz_wheels_stored(dynamics, lane) : cz_work(batch, CZ_LEDGER(wheel_normal), lane);
    return elastic(cz_secondary_stored(dynamics, lane) + cz_primary_stored(dynamics, lane) +
                   cz_link_stored(dynamics, lane) + cz_axle_guidance_stored(dynamics, lane) +
                   contact);
}

CzAccount cz_springs_account(const CzBatch *batch, size_t lane) {
    const CzDynamics *dynamics = batch->dynamics;
    double stored = cz_face_sliding_stored(dynamics, lane) +
                    cz_side_sliding_stored(dynamics, lane) + cz_slide_stored(dynamics, lane);
    if (cz_has_element(batch, lane, 0, CZ_ELEMENT_SUPERSTRUCTURE))
        stored += 2.0 * cz_superstructure_account(batch, lane).stored;
    for (int side = 0; side < 2; ++side)
        stored += cz_hinge_stored(dynamics, lane, side) + cz_fold_stored(dynamics, lane, side);
    return (CzAccount){0.0, stored};
}
