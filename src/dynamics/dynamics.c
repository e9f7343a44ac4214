/* Creates the state and memory of a run, and chooses the kernel. */
#include "dynamics/dynamics.h"

#include <math.h>
#include <string.h>

#include "laws/wheel_rail.h"

extern const CzKernel cz_kernel_baseline;
#ifdef CZ_HAS_KERNEL_V3
extern const CzKernel cz_kernel_v3;
#endif
#ifdef CZ_HAS_KERNEL_V4
extern const CzKernel cz_kernel_v4;
#endif

static int runs_always(void) {
    return 1;
}

#ifdef CZ_HAS_KERNEL_V3
static int runs_v3(void) {
    return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") &&
           __builtin_cpu_supports("bmi2");
}
#endif

#ifdef CZ_HAS_KERNEL_V4
static int runs_v4(void) {
    return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
           __builtin_cpu_supports("avx512cd") && __builtin_cpu_supports("avx512dq") &&
           __builtin_cpu_supports("avx512vl");
}
#endif

/* Copies of the kernel, the fastest first. */
static const struct {
    const CzKernel *kernel;
    int (*runs)(void); /* whether this processor supports it */
} kernels[] = {
#ifdef CZ_HAS_KERNEL_V4
    {&cz_kernel_v4, runs_v4},
#endif
#ifdef CZ_HAS_KERNEL_V3
    {&cz_kernel_v3, runs_v3},
#endif
    {&cz_kernel_baseline, runs_always},
};

const CzKernel *cz_kernel(const char *isa) {
    const int any = isa == NULL || strcmp(isa, "auto") == 0;
    for (size_t i = 0; i < sizeof kernels / sizeof kernels[0]; ++i)
        if ((any || strcmp(isa, kernels[i].kernel->isa) == 0) && kernels[i].runs())
            return kernels[i].kernel;
    return NULL;
}

static void start_extremes(CzExtremes *extreme) {
    for (int i = 0; i < CZ_LANE_BLOCK; ++i)
        extreme->face_lost_margin[i] = extreme->face_lost_overlap[i] = extreme->climb_time[i] =
            CZ_NOT_YET;
}

/* Each list names every row of its struct. All dimensions are those of plane motion. */
enum {
    PLANE = 1,
#define CZ_LEDGER_ENTRY(row, class, dimension, doc) +dimension
    N_LEDGER_LISTED = 0
#include "dynamics/ledger.def"
#undef CZ_LEDGER_ENTRY
    ,
#define CZ_DOF_ENTRY(row, axis, dimension, what) +dimension
    N_DOF_LISTED = 0
#include "model/dof.def"
#undef CZ_DOF_ENTRY
};
_Static_assert((int)N_LEDGER_LISTED == (int)CZ_N_LEDGER, "ledger.def lists CzPower");
_Static_assert((int)N_DOF_LISTED == (int)CZ_N_DOF, "dof.def lists CzState");

/* Reciprocals of a row of parameters, 0 where the parameter is 0. */
static void invert(const double *parameter, double *inverse) {
    for (int i = 0; i < CZ_LANE_BLOCK; ++i)
        inverse[i] = parameter[i] > 0.0 ? 1.0 / parameter[i] : 0.0;
}

/* Reciprocals of a stiffness, which is at least 1 N/m in the laws. */
static void invert_stiffness(const double *stiffness, double *compliance) {
    for (int i = 0; i < CZ_LANE_BLOCK; ++i)
        compliance[i] = 1.0 / fmax(stiffness[i], 1.0);
}

/* Constants of both ends of a car, and of both sides of an interface. */
static void derive_pairs(const CzParameters *parameter, CzConstants *constant) {
    for (int k = 0; k < 2; ++k) {
        invert(parameter->coupler.side[k].hinge_vertical.stiffness, constant->hinge_compliance[k]);
        invert(parameter->end[k].fold_pitch.stiffness, constant->fold_compliance[k]);
        invert_stiffness(parameter->coupler.side[k].buffer.transition,
                         constant->buffer_compliance[k]);
        invert_stiffness(parameter->side_buffers.side[k].buffer.transition,
                         constant->side_compliance[k]);
        invert_stiffness(parameter->end[k].crush.unloading, constant->end_compliance[k]);
        invert_stiffness(parameter->end[k].crush.second_unloading,
                         constant->end_second_compliance[k]);
        invert_stiffness(parameter->face.side[k].massless.unloading,
                         constant->massless_compliance[k]);
        invert_stiffness(parameter->face.side[k].massless.second_unloading,
                         constant->massless_second_compliance[k]);
    }
}

static void derive_constants(const CzParameters *parameter, CzConstants *constant) {
    derive_pairs(parameter, constant);
    invert(parameter->inverse.body.mass, constant->body_mass);
    invert(parameter->inverse.wheelset.inertia_pitch, constant->wheelset_inertia);
    invert(parameter->wheel.creep_stiffness, constant->creep_compliance);
    invert(parameter->wheel.brake_stiffness, constant->brake_compliance);
    invert(parameter->face.stiffness_vertical, constant->grip_compliance);
    for (int i = 0; i < CZ_LANE_BLOCK; ++i) {
        const double distance = parameter->coupler.pivot.distance[i];
        const double rise = parameter->coupler.coupled[i] * parameter->coupler.pivot.rise[i];
        constant->rest_angle_vertical[i] = distance > 0.0 ? rise / distance : 0.0;
    }
    memcpy(constant->wheel_rest, parameter->wheel.indentation, sizeof constant->wheel_rest);
    for (int axle = 0; axle < 4; ++axle)
        for (int i = 0; i < CZ_LANE_BLOCK; ++i)
            constant->static_load[axle][i] = cz_wheel_normal_force(
                parameter->wheel.hertz[i], parameter->wheel.indentation[axle][i]);
}

/* Constants that depend on the car ahead of each lane. */
static void derive_ahead(const CzLanes *lanes, CzConstants *constant, size_t base) {
    for (size_t i = 0; i < CZ_LANE_BLOCK; ++i)
        constant->slaved_end_ahead[i] = *cz_lane_parameter(lanes, CZ_PARAMETER(slaved_ends[0]),
                                                           base + i + (size_t)lanes->n_design);
}

static int changes_a_lane(const double *slope_change) {
    for (int i = 0; i < CZ_LANE_BLOCK; ++i)
        if (slope_change[i] != 0.0)
            return 1;
    return 0;
}

/* Whether some lane has less than a value. */
static int falls_below(const double *row, double value) {
    for (int i = 0; i < CZ_LANE_BLOCK; ++i)
        if (row[i] < value)
            return 1;
    return 0;
}

/* Records whether a curve has a falling part in some lane. */
static void note_falling(CzBlockCurve *curve) {
    CzRow slope = {0.0};
    curve->falls = 0;
    for (int k = 0; k < curve->n_breakpoint; ++k) {
        for (int i = 0; i < CZ_LANE_BLOCK; ++i)
            slope[i] += curve->breakpoint[k].change[i];
        curve->falls |= falls_below(slope, CZ_FALLING);
    }
}

static int copy_curve(CzBlockCurve *to, const CzCurveLanes *from, size_t base, CzArena *arena) {
    CzBreakpoint *breakpoint =
        cz_arena_allocate(arena, (size_t)from->n_breakpoint, sizeof *breakpoint);
    if (breakpoint == NULL)
        return 0;
    memcpy(to->start, from->start + base, sizeof(CzRow));
    memcpy(to->usable, from->usable + base, sizeof(CzRow));
    to->is_there = falls_below(to->start, CZ_NEVER);
    to->n_breakpoint = 0;
    to->breakpoint = breakpoint;
    for (int k = 0; k < from->n_breakpoint; ++k) {
        const size_t slot = (size_t)k * from->stride + base;
        if (!changes_a_lane(from->slope_change + slot))
            continue;
        memcpy(breakpoint[to->n_breakpoint].at, from->at + slot, sizeof(CzRow));
        memcpy(breakpoint[to->n_breakpoint].change, from->slope_change + slot, sizeof(CzRow));
        ++to->n_breakpoint;
    }
    note_falling(to);
    return 1;
}

/* Curves of a block; 0 when there is no memory. */
static int copy_curves(CzBlockCurves *to, const CzLanes *lanes, size_t base, CzArena *arena) {
    CzBlockCurve *curve = to->end; /* one after the other, in the order of CzCurveNames */
    for (int id = 0; id < CZ_N_CURVE; ++id)
        if (!copy_curve(&curve[id], &lanes->curve[id], base, arena))
            return 0;
    return 1;
}

/* No body is rotated at t = 0; bodies that cannot pitch keep these values. */
static void start_turned(CzBlock *block) {
    for (int i = 0; i < CZ_LANE_BLOCK; ++i) {
        block->turned.body.cosine[i] = 1.0;
        for (int k = 0; k < 2; ++k)
            block->turned.end[k].cosine[i] = block->turned.bogie[k].cosine[i] = 1.0;
    }
}

/* Finds what some lane of a block has: the kernel leaves out the rest. */
static void find_parts(CzBlock *block) {
    const CzFaceRows *face = &block->parameter.face;
    for (int i = 0; i < CZ_LANE_BLOCK; ++i) {
        block->has_tilts |= block->parameter.tilts[i] != 0.0;
        block->can_climb |= face->rib_capacity[i] != 0.0 || face->friction[i] != 0.0 ||
                            face->overlap[i] < CZ_MISSING;
        for (int side = 0; side < 2; ++side) {
            block->has_shear_off[side] |=
                block->parameter.coupler.side[side].shear.force[i] < CZ_NEVER;
            block->has_massless[side] |= face->side[side].has_massless[i] > 0.5;
        }
    }
    block->can_climb |= block->has_tilts;
}

/* A block at t = 0; 0 when there is no memory. */
static int start_block(CzBlock *block, const CzLanes *lanes, size_t base, CzArena *arena) {
    block->parameter = lanes->block[base / CZ_LANE_BLOCK].parameter;
    block->velocity = lanes->block[base / CZ_LANE_BLOCK].velocity;
    if (!copy_curves(&block->curve, lanes, base, arena))
        return 0;
    find_parts(block);
    for (int side = 0; side < 2; ++side)
        for (int i = 0; i < CZ_LANE_BLOCK; ++i)
            block->end_peak[side].at[i] = NAN;
    derive_constants(&block->parameter, &block->constant);
    derive_ahead(lanes, &block->constant, base);
    start_extremes(&block->extreme);
    start_turned(block);
    block->memory = &block->memories[0];
    block->next_memory = &block->memories[1];
    block->power = &block->powers[0];
    block->last_power = &block->powers[1];
    return 1;
}

CzDynamics *cz_dynamics_create(const CzLanes *lanes, CzArena *arena) {
    CzDynamics *dynamics = cz_arena_allocate(arena, 1, sizeof *dynamics);
    if (dynamics == NULL)
        return NULL;
    const int has_gear = lanes->has.full_cars, has_drag = has_gear || lanes->has.drag;
    dynamics->lanes = lanes;
    dynamics->n_state = CZ_LANE_BLOCK * (size_t)(has_gear ? CZ_N_DOF : CZ_DOF(bogie[0]));
    dynamics->n_power = CZ_LANE_BLOCK * (size_t)(has_drag ? CZ_N_LEDGER : CZ_LEDGER(end[0]));
    dynamics->n_block = (int)(lanes->n_lane / CZ_LANE_BLOCK);
    dynamics->block =
        cz_arena_allocate(arena, (size_t)dynamics->n_block + 1, sizeof *dynamics->block);
    if (dynamics->block == NULL)
        return NULL;
    for (int i = 0; i < dynamics->n_block; ++i)
        if (!start_block(&dynamics->block[i], lanes, (size_t)i * CZ_LANE_BLOCK, arena))
            return NULL;
    return dynamics;
}

/* The rows of a block are one piece of memory up to its memories. What rests is found out again. */
void cz_dynamics_move(CzDynamics *dynamics, size_t lane, const CzDynamics *from, size_t from_lane) {
    CzBlock *to = cz_block_of(dynamics, lane);
    const CzBlock *old = cz_block_of(from, from_lane);
    const size_t i = lane % CZ_LANE_BLOCK, k = from_lane % CZ_LANE_BLOCK;
    cz_copy_lane(to, i, old, k, offsetof(CzBlock, memories));
    cz_copy_lane(to->memory, i, old->memory, k, sizeof *to->memory);
    cz_copy_lane(to->next_memory, i, old->next_memory, k, sizeof *to->next_memory);
    cz_copy_lane(to->power, i, old->power, k, sizeof *to->power);
    cz_copy_lane(to->last_power, i, old->last_power, k, sizeof *to->last_power);
    cz_copy_lane(to->end_peak, i, old->end_peak, k, sizeof to->end_peak);
    if (dynamics->receptance != NULL)
        cz_receptance_move(dynamics->receptance, lane, from->receptance, from_lane);
}
