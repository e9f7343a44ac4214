/* Energy and momentum of a design: kinetic energy, work, residuals of both balances. */
#include "simulate/run.h"

#include <math.h>

#define SMALLEST_FORCE                                                                             \
    1e4 /* smallest reference force for errors of the chains of an interface [N] (ours) */

/* Velocity consistent with the accelerations at both ends of the step. The two-step scheme has v =
 * (trapezoidal v) - h/2 (a - a_last): where a force jumps, as at a shear-off, the velocity follows
 * one step later. Work is summed by the trapezoidal rule and is compared with the trapezoidal
 * velocity. The reference solvers have no such lag. */
static double settled_velocity(const CzBatch *batch, int dof, size_t lane) {
    const double v = cz_velocity(batch, dof, lane);
    if (batch->n_step == 0 || batch->reference != NULL)
        return v;
    const CzBlock *block = cz_block_of(batch->dynamics, lane);
    const double now = cz_const_row_of(&block->acceleration, dof)[lane % CZ_LANE_BLOCK];
    const double last = cz_const_row_of(&block->last_acceleration, dof)[lane % CZ_LANE_BLOCK];
    return v + 0.5 * batch->step * (now - last);
}

double cz_kinetic_energy(const CzBatch *batch, int design) {
    const int n_dof = (int)(batch->dynamics->n_state / CZ_LANE_BLOCK);
    double energy = 0.0;
    for (int car = 0; car < batch->n_car; ++car) {
        const size_t lane = cz_lane(batch, car, design);
        for (int dof = 0; dof < n_dof; ++dof) {
            const double v = settled_velocity(batch, dof, lane);
            energy += 0.5 * *cz_lane_mass(batch->lanes, dof, lane) * v * v;
        }
    }
    return energy;
}

/* Class of a row of the ledger, as in ledger.def. */
typedef enum LedgerClass { LOST, MIXED, OUTSIDE, BODIES } LedgerClass;

static LedgerClass ledger_class(int row) {
    static const LedgerClass of_row[CZ_N_LEDGER] = {
#define CZ_LEDGER_ENTRY(row, class, dimension, doc) [CZ_LEDGER(row)] = class,
#include "dynamics/ledger.def"
#undef CZ_LEDGER_ENTRY
    };
    return of_row[row];
}

double cz_total_work(const CzBatch *batch, int design) {
    const int n_row = (int)(batch->dynamics->n_power / CZ_LANE_BLOCK);
    double work = 0.0;
    for (int car = 0; car < batch->n_car; ++car) {
        const size_t lane = cz_lane(batch, car, design);
        for (int row = 0; row < n_row; ++row)
            if (ledger_class(row) != BODIES)
                work += cz_work(batch, row, lane);
        work += cz_chains_account(batch, lane).received + cz_gear_account(batch, lane).received;
        for (int end = 0; end < 2; ++end)
            work += cz_crush_account(batch, lane, end).received +
                    cz_guide_account(batch, lane, end).received;
    }
    return work;
}

double cz_balance_residual(const CzBatch *batch, int design) {
    const CzProgressOfDesign *progress = &batch->design[design];
    return progress->kinetic + progress->work - progress->initial_energy;
}

double cz_momentum_error(const CzBatch *batch, int design) {
    double change = 0.0, scale = 0.0;
    for (int car = 0; car < batch->n_car; ++car) {
        const size_t lane = cz_lane(batch, car, design);
        for (int dof = 0; dof < CZ_N_DOF; ++dof) {
            if (cz_axis_of(dof) != CZ_AXIS_ALONG)
                continue;
            const double mass = *cz_lane_mass(batch->lanes, dof, lane);
            const double before = *cz_lane_velocity(batch->lanes, dof, lane);
            change += mass * (cz_velocity(batch, dof, lane) - before);
            scale += mass * fabs(before);
        }
        change -= cz_block_of(batch->dynamics, lane)->impulse.velocity[lane % CZ_LANE_BLOCK];
    }
    return scale > 0.0 ? fabs(change) / scale : 0.0;
}

double cz_wheel_rail_work(const CzBatch *batch, int design) {
    double work = 0.0;
    for (int car = 0; car < batch->n_car; ++car) {
        const size_t lane = cz_lane(batch, car, design);
        work += cz_work(batch, CZ_LEDGER(wheel_creep), lane) +
                cz_work(batch, CZ_LEDGER(brake), lane) + cz_work(batch, CZ_LEDGER(rolling), lane);
    }
    return work;
}

double cz_train_speed(const CzBatch *batch, int train, int design) {
    double mass = 0.0, momentum = 0.0;
    for (int car = 0; car < batch->n_car; ++car) {
        if (cz_car(batch, car, design)->train != train)
            continue;
        const size_t lane = cz_lane(batch, car, design);
        const double m = *cz_lane_mass(batch->lanes, CZ_DOF(body.x), lane);
        mass += m;
        momentum += m * cz_velocity(batch, CZ_DOF(body.x), lane);
    }
    return mass > 0.0 ? momentum / mass : 0.0;
}

double cz_largest_closing_speed(const CzBatch *batch, int design) {
    double largest = 0.0;
    for (int car = 0; car + 1 < batch->n_car; ++car)
        largest = fmax(largest, cz_closing_speed(batch, car, design));
    return largest;
}

double cz_law_error(const CzBatch *batch, size_t lane) {
    return cz_extreme(batch, CZ_EXTREME(chain_distance), lane) /
           fmax(cz_extreme(batch, CZ_EXTREME(interface_force), lane), SMALLEST_FORCE);
}
