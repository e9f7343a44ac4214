/* The force evaluation and the commit of a step, compiled once per instruction set.
 *
 * An evaluation is a sequence of passes over blocks of lanes: rotations, couplers, anti-climbers,
 * side buffers, crush zones, running gear, and the division by the masses. Each pass gathers rows,
 * calls laws and scatters forces; between the passes there are only rows. No allocation, no library
 * call, no branch on data: every lane does the same arithmetic, and a lane's bits do not depend on
 * what the others hold or on how many a register takes.
 */
#include "dynamics/dynamics.h"

#include <string.h>

#include "dynamics/kernel_budget.h"
#include "dynamics/kernel_car.h"
#include "dynamics/kernel_coupler.h"
#include "dynamics/kernel_drag.h"
#include "dynamics/kernel_face.h"
#include "dynamics/kernel_neighbours.h"
#include "dynamics/kernel_rows.h"
#include "dynamics/kernel_snap.h"
#include "dynamics/kernel_superstructure.h"
#include "dynamics/kernel_track.h"
#include "dynamics/kernel_wheel.h"
#include "integrate/two_step.h"

#ifndef CZ_ISA
#define CZ_ISA baseline
#endif
#define PASTE(a, b) a##b
#define KERNEL_NAME(isa) PASTE(cz_kernel_, isa)
#define TEXT(a) #a
#define ISA_TEXT(isa) TEXT(isa)

extern const CzKernel KERNEL_NAME(CZ_ISA);

static void zero(CzRow *row, int n_row) {
    const size_t n = (size_t)n_row * CZ_LANE_BLOCK;
    double *restrict value = row[0];
    CZ_LANES (i, n) {
        value[i] = 0.0;
    }
}

/* Sets to zero what the passes add to. */
static void clear(CzBlock *d) {
    zero(d->force, CZ_N_DOF);
    zero(d->power, CZ_N_LEDGER);
    zero(&d->scratch[CZ_S_INTERFACE_FORCE], CZ_N_SCRATCH - CZ_S_INTERFACE_FORCE);
}

static void rotations(CzBlock *d, int has_full_cars) {
    rotate(X(BODY_PITCH), S(BODY_COS), S(BODY_SIN));
    rotate(X(END_PITCH_REAR), S(END_COS_REAR), S(END_SIN_REAR));
    rotate(X(END_PITCH_FRONT), S(END_COS_FRONT), S(END_SIN_FRONT));
    if (has_full_cars)
        for (int bogie = 0; bogie < 2; ++bogie)
            rotate(X_AT(BOGIE_PITCH_REAR, 3 * bogie), S_AT(BOGIE_COS_REAR, 2 * bogie),
                   S_AT(BOGIE_SIN_REAR, 2 * bogie));
}

/* Row = force * inverse mass. */
static void divide(CzBlock *d, int dof, const double *restrict inverse) {
    const size_t n = CZ_LANE_BLOCK;
    const double *restrict force = d->force[dof];
    double *restrict acceleration = d->acceleration[dof];
    CZ_LANES (i, n) {
        acceleration[i] = force[i] * inverse[i];
    }
}

/* Body and end masses along x: ends without mass move with the body and hand their force to it.
 * What acts on a vehicle that cannot move, and what acts at the wheels, is the external force. */
static void divide_longitudinal(CzBlock *d) {
    const size_t n = CZ_LANE_BLOCK;
    const double *restrict slaved = P(SLAVED_ENDS), *restrict inverse = P(INVERSE_BODY_MASS);
    const double *restrict inverse_rear = P(INVERSE_END_MASS_REAR), *restrict inverse_front =
                                                                        P(INVERSE_END_MASS_FRONT);
    const double *restrict body = G(BODY_X), *restrict rear = G(END_X_REAR),
                           *restrict front = G(END_X_FRONT);
    const double *restrict adhesion = S(ADHESION);
    double *restrict a_body = d->acceleration[CZ_DOF_BODY_X];
    double *restrict a_rear = d->acceleration[CZ_DOF_END_X_REAR];
    double *restrict a_front = d->acceleration[CZ_DOF_END_X_FRONT];
    double *restrict external = d->acceleration[CZ_ROW_IMPULSE];
    CZ_LANES (i, n) {
        const double handed = slaved[i] * (rear[i] + front[i]);
        const double total = body[i] + handed;
        const double a = total * inverse[i];
        a_body[i] = a;
        a_rear[i] = slaved[i] * a + (1.0 - slaved[i]) * rear[i] * inverse_rear[i];
        a_front[i] = slaved[i] * a + (1.0 - slaved[i]) * front[i] * inverse_front[i];
        external[i] = adhesion[i] - (inverse[i] > 0.0 ? 0.0 : total);
    }
}

/* Bodies up and down: those whose ends are slaved have their one co-ordinate along the track. */
static void divide_vertical(CzBlock *d) {
    const size_t n = CZ_LANE_BLOCK;
    const double *restrict slaved = P(SLAVED_ENDS), *restrict inverse = P(INVERSE_BODY_MASS);
    const double *restrict force = G(BODY_Z);
    double *restrict acceleration = d->acceleration[CZ_DOF_BODY_Z];
    CZ_LANES (i, n) {
        acceleration[i] = (1.0 - slaved[i]) * force[i] * inverse[i];
    }
}

static void divide_by_masses(CzBlock *d) {
    divide_longitudinal(d);
    divide_vertical(d);
    divide(d, CZ_DOF_BODY_PITCH, P(INVERSE_BODY_INERTIA));
    for (int end = 0; end < 2; ++end) {
        divide(d, CZ_DOF_END_Z_REAR + 3 * end, P_AT(INVERSE_END_MASS_REAR, end));
        divide(d, CZ_DOF_END_PITCH_REAR + 3 * end, P_AT(INVERSE_END_INERTIA_REAR, end));
    }
    for (int bogie = 0; bogie < 2; ++bogie) {
        divide(d, CZ_DOF_BOGIE_X_REAR + 3 * bogie, P(INVERSE_BOGIE_MASS));
        divide(d, CZ_DOF_BOGIE_Z_REAR + 3 * bogie, P(INVERSE_BOGIE_MASS));
        divide(d, CZ_DOF_BOGIE_PITCH_REAR + 3 * bogie, P(INVERSE_BOGIE_INERTIA));
    }
    for (int axle = 0; axle < 4; ++axle) {
        divide(d, CZ_DOF_WHEEL_X_0 + 3 * axle, P(INVERSE_WHEELSET_MASS));
        divide(d, CZ_DOF_WHEEL_Z_0 + 3 * axle, P(INVERSE_WHEELSET_MASS));
        divide(d, CZ_DOF_WHEEL_SPIN_0 + 3 * axle, P(INVERSE_WHEELSET_INERTIA));
    }
}

/* Interfaces of a block. */
static void evaluate_interfaces(const CzDynamics *dynamics, int index, double step) {
    const CzLanes *lanes = dynamics->lanes;
    CzBlock *d = &dynamics->block[index];
    const int notes = d->budget != NULL;
    if (lanes->has_couplers && couplers(d, step) && notes)
        note_couplers(d);
    if (faces(d, step)) {
        settle_snaps(dynamics, index);
        if (notes)
            note_faces(d);
    }
    if (lanes->has_side_buffers)
        side_buffers(d, step);
    if (lanes->has_superstructures)
        superstructures(d);
}

/* Cars of a block. */
static void evaluate_cars(const CzDynamics *dynamics, int index, double step) {
    CzBlock *d = &dynamics->block[index];
    for (int end = 0; end < 2; ++end) {
        vehicle_end(d, end);
        if (d->budget != NULL)
            note_end(d, end);
    }
    for (int bogie = 0; bogie < 2; ++bogie) {
        CzRow before[2];
        if (d->budget != NULL)
            memcpy(before[0], G(BODY_Z), 2 * sizeof(CzRow));
        bogie_to_body(d, bogie);
        if (d->budget != NULL)
            note_bogie(d, bogie, before[0], before[1]);
    }
    for (int axle = 0; axle < 4; ++axle)
        axle_to_bogie(d, axle);
    const bool elastic = is_elastic(dynamics);
    look_at_rails(dynamics, index);
    for (int axle = 0; axle < 4; ++axle) {
        if (elastic)
            press_on_elastic(d, axle);
        else
            press_on_rigid(d, axle);
        wheel(d, axle, step);
        if (dynamics->lanes->has_rolling)
            roll(d, axle);
    }
}

/* Everything of a block before the interfaces. */
static void begin_block(const CzLanes *lanes, CzBlock *d) {
    clear(d);
    if (d->budget != NULL)
        zero((CzRow *)d->budget, (int)(sizeof *d->budget / sizeof(CzRow)));
    rotations(d, lanes->has_full_cars);
}

/* Everything of a block after the interfaces. */
static void end_block(const CzDynamics *dynamics, int index, double step) {
    CzBlock *d = &dynamics->block[index];
    take_over(dynamics, index);
    if (dynamics->lanes->has_full_cars)
        evaluate_cars(dynamics, index, step);
    push_bodies(d);
    if (dynamics->lanes->has_drag)
        drag(d);
    divide_by_masses(d);
}

static void all_interfaces(const CzDynamics *dynamics, double step) {
    for (int i = 0; i < dynamics->n_block; ++i) {
        look_ahead(dynamics, i);
        evaluate_interfaces(dynamics, i, step);
    }
}

static void evaluate(CzDynamics *dynamics, double step) {
    for (int i = 0; i < dynamics->n_block; ++i)
        begin_block(dynamics->lanes, &dynamics->block[i]);
    all_interfaces(dynamics, step);
    for (int i = 0; i < dynamics->n_block; ++i)
        end_block(dynamics, i, step);
}

/* Extremes: larger of what was and what is. */
static void keep_larger(CzBlock *d, int extreme, const double *restrict value) {
    const size_t n = CZ_LANE_BLOCK;
    double *restrict kept = d->extreme[extreme];
    CZ_LANES (i, n) {
        kept[i] = cz_larger(kept[i], value[i]);
    }
}

static void add_to(CzBlock *d, int extreme, const double *restrict value) {
    const size_t n = CZ_LANE_BLOCK;
    double *restrict kept = d->extreme[extreme];
    CZ_LANES (i, n) {
        kept[i] += value[i];
    }
}

static void keep_larger_size(CzBlock *d, int extreme, const double *restrict value) {
    const size_t n = CZ_LANE_BLOCK;
    double *restrict kept = d->extreme[extreme];
    CZ_LANES (i, n) {
        kept[i] = cz_larger(kept[i], fabs(value[i]));
    }
}

#define E(name) d->extreme[CZ_E_##name]

static void interface_extremes(CzBlock *d, double time) {
    const size_t n = CZ_LANE_BLOCK;
    const double *restrict total = S(INTERFACE_FORCE), *restrict x = X(BODY_X),
                           *restrict x_ahead = S(BODY_AHEAD_X);
    double *restrict peak = E(INTERFACE_FORCE), *restrict when = E(INTERFACE_TIME);
    double *restrict shortening = E(INTERFACE_SHORTENING);
    const double *restrict drop = S(STEP_DROP);
    CZ_LANES (i, n) {
        const double size = cz_larger(fabs(total[i]), fabs(total[i] + drop[i]));
        when[i] = size > peak[i] ? time : when[i];
        peak[i] = cz_larger(size, peak[i]);
        shortening[i] = cz_larger(shortening[i], x[i] - x_ahead[i]);
    }
    const double *restrict normal = S(FACE_FORCE), *restrict remaining = S(FACE_REMAINING);
    const double *restrict demand = S(FACE_DEMAND), *restrict ready = S(FACE_READY),
                           *restrict chain = M(FACE_FORCE);
    const double *restrict stiffness = P(FACE_VERTICAL_STIFFNESS), *restrict slipped =
                                                                       M(FACE_SLIPPED);
    double *restrict lost_overlap = E(FACE_LOST_OVERLAP), *restrict lost_margin =
                                                              E(FACE_LOST_MARGIN);
    double *restrict overlap_time = E(FACE_OVERLAP_TIME), *restrict margin_time =
                                                              E(FACE_MARGIN_TIME);
    const double *restrict ramp = S(FACE_RAMP);
    double *restrict steepest = E(FACE_RAMP);
    double *restrict climbed = E(FACE_CLIMBED), *restrict climb_time = E(CLIMB_TIME);
    CZ_LANES (i, n) {
        const double pushing =
            chain[i] > 1e4
                ? 1.0
                : 0.0; /* the chain's own force: it is still there once the faces passed */
        const double gone = remaining[i] <= 0.0 ? pushing : 0.0;
        const double engaged = normal[i] > 1e4 ? 1.0 : 0.0;
        const double excess = fabs(demand[i]) - ready[i] + stiffness[i] * slipped[i];
        const double used = pushing > 0.0 ? -remaining[i] : -1e300;
        const double asked = normal[i] > 0.0 ? excess : -1e300;
        overlap_time[i] = used > lost_overlap[i] ? time : overlap_time[i];
        margin_time[i] = asked > lost_margin[i] ? time : margin_time[i];
        lost_overlap[i] = cz_larger(lost_overlap[i], used);
        lost_margin[i] = cz_larger(lost_margin[i], asked);
        steepest[i] = cz_larger(steepest[i], engaged * ramp[i]);
        climbed[i] = cz_larger(climbed[i], gone);
        climb_time[i] = cz_larger(climb_time[i], gone > 0.0 ? -time : -1e300);
    }
}

/* How the bodies of an interface stand to each other where their pivots are. */
static void coupler_extremes(CzBlock *d) {
    const size_t n = CZ_LANE_BLOCK;
    const double *restrict z = X(BODY_Z), *restrict s = S(BODY_SIN);
    const double *restrict z_ahead = S(BODY_AHEAD_Z), *restrict s_ahead = S(BODY_AHEAD_SIN);
    const double *restrict at = P(PIVOT_X_A), *restrict at_ahead = P(PIVOT_X_B);
    const double *restrict tilts = P(TILTS);
    double *restrict rise = E(UNDERFRAME_RISE);
    CZ_LANES (i, n) {
        const double own = z[i] + at[i] * s[i];
        const double ahead = z_ahead[i] + at_ahead[i] * s_ahead[i];
        rise[i] = cz_larger(rise[i], tilts[i] * fabs(ahead - own));
    }
    for (int side = 0; side < 2; ++side) {
        keep_larger_size(d, CZ_E_SWING_A + side, S_AT(SWING_A, side));
        keep_larger(d, CZ_E_BUFFER_A + side, M_AT(BUFFER_A, side));
    }
    keep_larger_size(d, CZ_E_COUPLER_FORCE, S(COUPLER_FORCE));
}

static void car_extremes(CzBlock *d, double time) {
    const size_t n = CZ_LANE_BLOCK;
    for (int axle = 0; axle < 4; ++axle) {
        const double *restrict approach = S_AT(WHEEL_APPROACH_0, axle);
        double *restrict lift = d->extreme[CZ_E_LIFT_0 + axle];
        double *restrict when = d->extreme[CZ_E_LIFT_TIME_0 + axle];
        CZ_LANES (i, n) {
            const double now = -approach[i];
            when[i] = now > lift[i] ? time : when[i];
            lift[i] = cz_larger(lift[i], now);
        }
    }
    for (int bogie = 0; bogie < 2; ++bogie) {
        const double *restrict first = S_AT(WHEEL_APPROACH_0, 2 * bogie), *restrict second =
                                                                              S_AT(WHEEL_APPROACH_0,
                                                                                   2 * bogie + 1);
        double *restrict lift = d->extreme[CZ_E_BOGIE_LIFT_REAR + bogie];
        double *restrict when = d->extreme[CZ_E_BOGIE_LIFT_TIME_REAR + bogie];
        CZ_LANES (i, n) {
            const double lower = cz_smaller(-first[i], -second[i]);
            when[i] = lower > lift[i] ? time : when[i];
            lift[i] = cz_larger(lift[i], lower);
        }
        keep_larger_size(d, CZ_E_LINK_FORCE, S_AT(LINK_REAR, bogie));
        keep_larger_size(d, CZ_E_LINK_TRAVEL, S_AT(LINK_TRAVEL_REAR, bogie));
    }
    keep_larger_size(d, CZ_E_BODY_PITCH, X(BODY_PITCH));
    keep_larger(d, CZ_E_END_FORCE_REAR, S(END_REAR));
    keep_larger(d, CZ_E_END_FORCE_FRONT, S(END_FRONT));
}

/* Work over the step by the mean of the powers at its ends. */
static void add_work(CzBlock *d, double step) {
    const size_t n = (size_t)CZ_N_LEDGER * CZ_LANE_BLOCK;
    const double *restrict last = d->last_power[0], *restrict power = d->power[0];
    double *restrict work = d->work[0];
    CZ_LANES (i, n) {
        work[i] += 0.5 * step * (last[i] + power[i]);
    }
}

static void swap(CzRow **a, CzRow **b) {
    CzRow *c = *a;
    *a = *b;
    *b = c;
}

static void commit_block(const CzLanes *lanes, CzBlock *d, double step, double time) {
    add_work(d, step);
    swap(&d->power, &d->last_power);
    swap(&d->memory, &d->next_memory);
    interface_extremes(d, time);
    if (lanes->has_couplers) {
        coupler_extremes(d);
        keep_larger(d, CZ_E_COUPLER_FORCE, S(COUPLER_TOP));
        keep_larger(d, CZ_E_COUPLER_CLOSURE, S(COUPLER_CLOSURE));
    }
    keep_larger(d, CZ_E_FACE_FORCE, S(FACE_FORCE));
    keep_larger(d, CZ_E_FACE_FORCE, S(FACE_TOP));
    keep_larger(d, CZ_E_FACE_CLOSURE, S(FACE_CLOSURE));
    keep_larger_size(d, CZ_E_FACE_DEMAND, S(FACE_DEMAND));
    if (lanes->has_side_buffers) {
        keep_larger(d, CZ_E_SIDE_BUFFER_A, M(SIDE_BUFFER_A));
        keep_larger(d, CZ_E_SIDE_BUFFER_B, M(SIDE_BUFFER_B));
        keep_larger(d, CZ_E_SIDE_FORCE, S(SIDE_FORCE));
        keep_larger(d, CZ_E_SIDE_FORCE, S(SIDE_TOP));
        keep_larger(d, CZ_E_SIDE_CLOSURE, S(SIDE_CLOSURE));
    }
    if (lanes->has_superstructures)
        keep_larger(d, CZ_E_SUPERSTRUCTURE_FORCE, S(SUPERSTRUCTURE_FORCE));
    keep_larger(d, CZ_E_SECTION_REAR, S(SECTION_REAR));
    keep_larger(d, CZ_E_SECTION_FRONT, S(SECTION_FRONT));
    keep_larger_size(d, CZ_E_BODY_ACCELERATION, d->acceleration[CZ_DOF_BODY_X]);
    keep_larger(d, CZ_E_CHAIN_RESIDUAL, S(RESIDUAL));
    keep_larger(d, CZ_E_CHAIN_DISTANCE, S(CHAIN_DISTANCE));
    add_to(d, CZ_E_SEARCHED, S(SEARCHED));
    if (lanes->has_full_cars)
        car_extremes(d, time);
    if (lanes->has_drag) {
        keep_larger_size(d, CZ_E_SLIDE_TRAVEL, X(BODY_X));
        keep_larger(d, CZ_E_SLIDE_FORCE, S(SLIDE_FORCE));
    }
}

static void commit(CzDynamics *dynamics, double step, double time) {
    for (int i = 0; i < dynamics->n_block; ++i)
        commit_block(dynamics->lanes, &dynamics->block[i], step, time);
}

static void advance_block(const CzDynamics *dynamics, int index, double step, int first) {
    CzBlock *d = &dynamics->block[index];
    advance_rails(dynamics, index);
    const size_t n = (size_t)CZ_N_ROW * CZ_LANE_BLOCK;
    cz_two_step_advance(n, step, first, d->position[0], d->velocity[0], d->acceleration[0],
                        d->last_acceleration[0]);
}

static void advance(CzDynamics *dynamics, double step, int first) {
    for (int i = 0; i < dynamics->n_block; ++i)
        advance_block(dynamics, i, step, first);
}

/* Advance, evaluate and commit while a block is at hand. */
static void whole_step(CzDynamics *dynamics, double step, int first, double time) {
    for (int i = 0; i < dynamics->n_block; ++i) {
        advance_block(dynamics, i, step, first);
        begin_block(dynamics->lanes, &dynamics->block[i]);
    }
    all_interfaces(dynamics, step);
    for (int i = 0; i < dynamics->n_block; ++i) {
        end_block(dynamics, i, step);
        commit_block(dynamics->lanes, &dynamics->block[i], step, time);
    }
}

const CzKernel KERNEL_NAME(CZ_ISA) = {ISA_TEXT(CZ_ISA), advance, evaluate, commit, whole_step};
