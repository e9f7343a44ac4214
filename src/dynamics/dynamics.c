/* Memory of a run's moving part, and the choice of the kernel. */
#include "dynamics/dynamics.h"

#include <math.h>
#include <string.h>

#include "laws/wheel_rail.h"
#include "model/kinks.h"

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
    int (*runs)(void); /* whether this processor can */
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

/* Extremes start below anything that a run can reach. */
static void start_extremes(CzBlock *block) {
    static const double start[CZ_N_EXTREME] = {
#define CZ_EXTREME(name, start, doc) start,
#include "dynamics/extremes.def"
#undef CZ_EXTREME
    };
    for (int row = 0; row < CZ_N_EXTREME; ++row)
        for (int i = 0; i < CZ_LANE_BLOCK; ++i)
            block->extreme[row][i] = start[row];
}

/* One over a row of parameters, 0 where the parameter is 0. */
static void invert(CzBlock *block, int parameter, int constant) {
    for (int i = 0; i < CZ_LANE_BLOCK; ++i) {
        const double value = block->parameter[parameter][i];
        block->constant[constant][i] = value > 0.0 ? 1.0 / value : 0.0;
    }
}

static void derive_constants(CzBlock *block) {
    static const int inverses[][2] = {{CZ_P_INVERSE_BODY_MASS, CZ_C_BODY_MASS},
                                      {CZ_P_INVERSE_WHEELSET_INERTIA, CZ_C_WHEELSET_INERTIA},
                                      {CZ_P_CREEP_STIFFNESS, CZ_C_CREEP_COMPLIANCE},
                                      {CZ_P_BRAKE_STIFFNESS, CZ_C_BRAKE_COMPLIANCE},
                                      {CZ_P_HINGE_STIFFNESS_A, CZ_C_HINGE_COMPLIANCE_A},
                                      {CZ_P_HINGE_STIFFNESS_B, CZ_C_HINGE_COMPLIANCE_B},
                                      {CZ_P_FOLD_STIFFNESS_REAR, CZ_C_FOLD_COMPLIANCE_REAR},
                                      {CZ_P_FOLD_STIFFNESS_FRONT, CZ_C_FOLD_COMPLIANCE_FRONT},
                                      {CZ_P_FACE_VERTICAL_STIFFNESS, CZ_C_GRIP_COMPLIANCE}};
    /* Laws take these from 1 N/m on. */
    static const int compliances[][2] = {
        {CZ_P_BUFFER_TRANSITION_A, CZ_C_BUFFER_COMPLIANCE_A},
        {CZ_P_BUFFER_TRANSITION_B, CZ_C_BUFFER_COMPLIANCE_B},
        {CZ_P_SIDE_TRANSITION_A, CZ_C_SIDE_COMPLIANCE_A},
        {CZ_P_SIDE_TRANSITION_B, CZ_C_SIDE_COMPLIANCE_B},
        {CZ_P_END_UNLOADING_REAR, CZ_C_END_COMPLIANCE_REAR},
        {CZ_P_END_UNLOADING_FRONT, CZ_C_END_COMPLIANCE_FRONT},
        {CZ_P_END_SECOND_UNLOADING_REAR, CZ_C_END_SECOND_COMPLIANCE_REAR},
        {CZ_P_END_SECOND_UNLOADING_FRONT, CZ_C_END_SECOND_COMPLIANCE_FRONT}};
    for (size_t k = 0; k < sizeof inverses / sizeof inverses[0]; ++k)
        invert(block, inverses[k][0], inverses[k][1]);
    for (size_t k = 0; k < sizeof compliances / sizeof compliances[0]; ++k)
        for (int i = 0; i < CZ_LANE_BLOCK; ++i)
            block->constant[compliances[k][1]][i] =
                1.0 / fmax(block->parameter[compliances[k][0]][i], 1.0);
    for (int i = 0; i < CZ_LANE_BLOCK; ++i) {
        const double distance = block->parameter[CZ_P_PIVOT_DISTANCE][i];
        const double rise =
            block->parameter[CZ_P_COUPLED][i] * block->parameter[CZ_P_PIVOT_RISE][i];
        block->constant[CZ_C_HINGE_REST][i] = distance > 0.0 ? rise / distance : 0.0;
    }
    for (int axle = 0; axle < 4; ++axle)
        memcpy(block->constant[CZ_C_WHEEL_REST_0 + axle],
               block->parameter[CZ_P_INDENTATION_0 + axle], sizeof(CzRow));
    for (int axle = 0; axle < 4; ++axle)
        for (int i = 0; i < CZ_LANE_BLOCK; ++i)
            block->constant[CZ_C_STATIC_LOAD_0 + axle][i] = cz_wheel_normal_force(
                block->parameter[CZ_P_HERTZ][i], block->parameter[CZ_P_INDENTATION_0 + axle][i]);
}

/* Constants that follow from the car of a lane and the one ahead. */
static void derive_pairs(const CzLanes *lanes, CzBlock *block, size_t base) {
    const double *slaved = cz_row(lanes->parameter, lanes->stride, CZ_P_SLAVED_ENDS);
    for (size_t i = 0; i < CZ_LANE_BLOCK; ++i) {
        const size_t ahead = base + i + (size_t)lanes->n_design;
        block->constant[CZ_C_SLAVED_ENDS_AHEAD][i] = slaved[ahead];
    }
}

/* Rows of a block out of rows of the lanes. */
static void copy_rows(CzRow *row, int n_row, const double *array, size_t stride, size_t base) {
    for (int k = 0; k < n_row; ++k)
        memcpy(row[k], cz_row((double *)array, stride, k) + base, sizeof(CzRow));
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

/* Notes whether a curve falls in some lane. */
static void note_falling(CzBlockCurve *curve) {
    CzRow slope = {0.0};
    curve->falls = 0;
    for (int k = 0; k < curve->n_kink; ++k) {
        for (int i = 0; i < CZ_LANE_BLOCK; ++i)
            slope[i] += curve->kink[2 * k + 1][i];
        curve->falls |= falls_below(slope, CZ_FALLING);
    }
}

static int copy_curve(CzBlockCurve *to, const CzCurveLanes *from, size_t stride, size_t base,
                      CzArena *arena) {
    memcpy(to->start, from->start + base, sizeof(CzRow));
    memcpy(to->usable, from->usable + base, sizeof(CzRow));
    CzRow *kink = cz_arena_allocate(arena, 2 * (size_t)from->n_kink, sizeof *kink);
    if (kink == NULL)
        return 0;
    to->is_there = falls_below(to->start, CZ_NEVER);
    to->n_kink = 0;
    to->kink = (const CzRow *)kink;
    for (int k = 0; k < from->n_kink; ++k) {
        const double *change = cz_row(from->slope_change, stride, k) + base;
        if (!changes_a_lane(change))
            continue;
        memcpy(kink[2 * to->n_kink], cz_row(from->at, stride, k) + base, sizeof(CzRow));
        memcpy(kink[2 * to->n_kink + 1], change, sizeof(CzRow));
        ++to->n_kink;
    }
    note_falling(to);
    return 1;
}

/* A block at t = 0; 0 when there is no memory. */
static int start_block(CzBlock *block, const CzLanes *lanes, size_t base, CzArena *arena) {
    copy_rows(block->parameter, CZ_N_PARAMETER, lanes->parameter, lanes->stride, base);
    copy_rows(block->velocity, CZ_N_DOF, lanes->velocity, lanes->stride, base);
    for (int id = 0; id < CZ_N_CURVE; ++id)
        if (!copy_curve(&block->curve[id], &lanes->curve[id], lanes->stride, base, arena))
            return 0;
    for (int side = 0; side < 2; ++side)
        for (int i = 0; i < CZ_LANE_BLOCK; ++i)
            block->has_limp_end[side] |= block->parameter[CZ_P_LIMP_END_A + side][i] > 0.5;
    for (int end = 0; end < 2; ++end)
        for (int i = 0; i < CZ_LANE_BLOCK; ++i)
            block->end_peak_at[end][i] = NAN;
    derive_constants(block);
    derive_pairs(lanes, block, base);
    start_extremes(block);
    block->memory = block->memories[0];
    block->next_memory = block->memories[1];
    block->power = block->powers[0];
    block->last_power = block->powers[1];
    return 1;
}

CzDynamics *cz_dynamics_create(const CzLanes *lanes, CzArena *arena) {
    CzDynamics *dynamics = cz_arena_allocate(arena, 1, sizeof *dynamics);
    if (dynamics == NULL)
        return NULL;
    dynamics->lanes = lanes;
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
