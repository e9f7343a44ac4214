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

void cz_accounts_take(const CzBatch *batch, int design) {
    CzProgressOfDesign *progress = &batch->design[design];
    if (progress->accounts_taken == batch->n_step + 1)
        return;
    progress->accounts_taken = batch->n_step + 1;
    for (int car = 0; car < batch->n_car; ++car) {
        const size_t lane = cz_lane(batch, car, design);
        cz_stored_fill(batch->dynamics, lane, &batch->stored[lane]);
    }
    progress->kinetic = cz_kinetic_energy(batch, design);
    progress->work = cz_total_work(batch, design);
}

double cz_track_account(const CzBatch *batch, size_t lane) {
    CzTrackAccount *account = &batch->in_track[lane / CZ_LANE_BLOCK];
    if (account->taken != batch->n_step + 1)
        cz_track_stored(batch->kernel, batch->dynamics, (int)(lane / CZ_LANE_BLOCK),
                        account->stored);
    account->taken = batch->n_step + 1;
    return account->stored[lane % CZ_LANE_BLOCK];
}

static CzAccount sum_of(CzAccount a, CzAccount b) {
    return (CzAccount){a.received + b.received, a.stored + b.stored};
}

/* An account of which all is dissipated. */
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
        return of->side[side].has_anti_climber || of->side[side].presses_plates;
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

/* Share of one side in an element that both sides of an interface share. */
static double half_of(const CzBatch *batch, size_t lane, int side, CzElementKind kind) {
    return cz_has_element(batch, lane, 1 - side, kind) ? 0.5 : 1.0;
}

/* The same for side buffers, on which an anti-climber may press. */
static double half_of_plates(const CzBatch *batch, size_t lane, int side) {
    return batch->equipment[lane].side[1 - side].presses_plates
               ? 0.5
               : half_of(batch, lane, side, CZ_ELEMENT_SIDE_BUFFERS);
}

/* An account of which all is stored. */
static CzAccount elastic(double stored) {
    return (CzAccount){stored, stored};
}

CzAccount cz_coupler_account(const CzBatch *batch, size_t lane, int side) {
    const CzStored *stored = &batch->stored[lane];
    const CzAccount members = {cz_memory(batch, CZ_MEMORY(coupler.side[side].energy), lane),
                               stored->coupler[side]};
    const CzAccount hinge = {cz_work(batch, CZ_LEDGER(hinge[side]), lane), stored->hinge[side]};
    const CzAccount tubes = elastic(stored->coupler_tubes);
    const double share = half_of(batch, lane, side, CZ_ELEMENT_COUPLER);
    return sum_of(sum_of(members, hinge), share_of(share, tubes));
}

CzAccount cz_side_account(const CzBatch *batch, size_t lane, int side) {
    const CzStored *stored = &batch->stored[lane];
    const CzAccount members = {cz_memory(batch, CZ_MEMORY(side_buffers.side[side].energy), lane),
                               stored->side_buffers[side]};
    const CzAccount sliding = {cz_work(batch, CZ_LEDGER(side_sliding), lane), stored->side_sliding};
    const CzAccount tubes = elastic(stored->side_tubes);
    const double share = half_of_plates(batch, lane, side);
    return sum_of(members, share_of(share, sum_of(sliding, tubes)));
}

/* What both faces of an interface have in common: compliance, damping, ribs and friction. */
static CzAccount faces_account(const CzBatch *batch, size_t lane) {
    const CzStored *stored = &batch->stored[lane];
    const CzAccount strain = {cz_memory(batch, CZ_MEMORY(face.strain), lane), stored->face};
    const CzAccount sliding = {cz_work(batch, CZ_LEDGER(face_sliding), lane), stored->face_sliding};
    return sum_of(sum_of(strain, sliding), lost(cz_work(batch, CZ_LEDGER(face_damping), lane)));
}

CzAccount cz_anti_climber_account(const CzBatch *batch, size_t lane, int side) {
    const double share = half_of(batch, lane, side, CZ_ELEMENT_ANTI_CLIMBER);
    return sum_of(lost(cz_memory(batch, CZ_MEMORY(face.side[side].energy), lane)),
                  share_of(share, faces_account(batch, lane)));
}

CzAccount cz_bare_faces_account(const CzBatch *batch, size_t lane) {
    const CzInterfaceEquipment *of = &batch->equipment[lane];
    const bool bare = !of->side[0].has_anti_climber && !of->side[1].has_anti_climber;
    return bare ? faces_account(batch, lane) : (CzAccount){0.0, 0.0};
}

CzAccount cz_superstructure_account(const CzBatch *batch, size_t lane) {
    return share_of(0.5, (CzAccount){cz_work(batch, CZ_LEDGER(superstructure), lane),
                                     batch->stored[lane].superstructure});
}

CzAccount cz_draw_gear_account(const CzBatch *batch, size_t lane) {
    return share_of(0.5, elastic(batch->stored[lane].draw_gear));
}

CzAccount cz_crush_account(const CzBatch *batch, size_t lane, int end) {
    const CzCrushEnergy *crush = &batch->stored[lane].end[end];
    return (CzAccount){crush->received, crush->stored};
}

CzAccount cz_guide_account(const CzBatch *batch, size_t lane, int end) {
    return elastic(batch->stored[lane].guide[end]);
}

/* The end mass in its guidance and its hinge, and the damping of the crush zone. */
CzAccount cz_end_mass_account(const CzBatch *batch, size_t lane, int end) {
    const CzAccount fold = {cz_work(batch, CZ_LEDGER(fold[end]), lane),
                            batch->stored[lane].fold[end]};
    const CzAccount springs = sum_of(cz_guide_account(batch, lane, end), fold);
    return sum_of(springs, lost(cz_work(batch, CZ_LEDGER(end_damping[end]), lane) +
                                cz_work(batch, CZ_LEDGER(guide_damping[end]), lane) +
                                cz_work(batch, CZ_LEDGER(fold_damping[end]), lane)));
}

CzAccount cz_massless_account(const CzBatch *batch, size_t lane, int side) {
    const CzCrushEnergy *crush = &batch->stored[lane].massless[side];
    return (CzAccount){crush->received, crush->stored};
}

CzAccount cz_chains_account(const CzBatch *batch, size_t lane) {
    const CzStored *stored = &batch->stored[lane];
    CzAccount sum = sum_of(elastic(stored->coupler_tubes), elastic(stored->side_tubes));
    sum = sum_of(sum, elastic(stored->draw_gear));
    sum = sum_of(sum, (CzAccount){cz_memory(batch, CZ_MEMORY(face.strain), lane), stored->face});
    for (int side = 0; side < 2; ++side) {
        const double members = cz_memory(batch, CZ_MEMORY(coupler.side[side].energy), lane) +
                               cz_memory(batch, CZ_MEMORY(side_buffers.side[side].energy), lane);
        const double buffers = stored->coupler[side] + stored->side_buffers[side];
        sum = sum_of(sum, (CzAccount){members, buffers});
        sum = sum_of(sum, lost(cz_memory(batch, CZ_MEMORY(face.side[side].energy), lane) +
                               cz_memory(batch, CZ_MEMORY(face.side[side].massless.damped), lane)));
        sum = sum_of(sum, cz_massless_account(batch, lane, side));
    }
    return sum;
}

/* Energy stored in an end with mass and in the end stop of a buffer stop. */
static double stored_in_end(const CzStored *of, int end) {
    return of->end[end].stored + of->guide[end] + of->fold[end] + of->slide;
}

double cz_interface_stored(const CzBatch *batch, int interface, int design) {
    const size_t lane = cz_lane(batch, interface, design);
    const CzStored *of = &batch->stored[lane];
    const CzStored *ahead = &batch->stored[cz_lane(batch, interface + 1, design)];
    return cz_chains_account(batch, lane).stored + of->hinge[0] + of->hinge[1] + of->face_sliding +
           of->side_sliding + of->superstructure + stored_in_end(of, 1) + stored_in_end(ahead, 0);
}

CzAccount cz_gear_account(const CzBatch *batch, size_t lane) {
    const CzDynamics *dynamics = batch->dynamics;
    const CzStored *stored = &batch->stored[lane];
    const bool is_rigid =
        dynamics->track == NULL && dynamics->elements == NULL && dynamics->receptance == NULL;
    const double contact =
        is_rigid ? stored->wheels : cz_work(batch, CZ_LEDGER(wheel_normal), lane);
    return elastic(stored->secondary + stored->primary + stored->link + stored->axle_guidance +
                   contact);
}

CzAccount cz_springs_account(const CzBatch *batch, size_t lane) {
    const CzStored *of = &batch->stored[lane];
    double stored = of->face_sliding + of->side_sliding + of->slide;
    if (cz_has_element(batch, lane, 0, CZ_ELEMENT_SUPERSTRUCTURE))
        stored += 2.0 * cz_superstructure_account(batch, lane).stored;
    for (int side = 0; side < 2; ++side)
        stored += of->hinge[side] + of->fold[side];
    return (CzAccount){0.0, stored};
}
