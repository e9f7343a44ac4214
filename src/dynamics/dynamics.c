/* Memory of a run's moving part, and the choice of the kernel. */
#include "dynamics/dynamics.h"

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

/* Rows of doubles, all zero. */
static double *rows(CzArena *arena, int n_row, size_t stride, int *missing) {
    double *array = cz_arena_allocate(arena, (size_t)n_row * stride, sizeof(double));
    *missing |= array == NULL;
    return array;
}

/* Extremes start below anything that a run can reach. */
static void start_extremes(CzDynamics *dynamics) {
    static const double start[CZ_N_EXTREME] = {
#define CZ_EXTREME(name, start, doc) start,
#include "dynamics/extremes.def"
#undef CZ_EXTREME
    };
    for (int row = 0; row < CZ_N_EXTREME; ++row)
        for (size_t lane = 0; lane < dynamics->stride; ++lane)
            cz_row(dynamics->extreme, dynamics->stride, row)[lane] = start[row];
}

/* One over a row of parameters, 0 where the parameter is 0. */
static void invert(CzDynamics *dynamics, int parameter, int constant) {
    const double *value = cz_row(dynamics->lanes->parameter, dynamics->stride, parameter);
    double *inverse = cz_row(dynamics->constant, dynamics->stride, constant);
    for (size_t lane = 0; lane < dynamics->stride; ++lane)
        inverse[lane] = value[lane] > 0.0 ? 1.0 / value[lane] : 0.0;
}

static void derive_constants(CzDynamics *dynamics) {
    static const int inverses[][2] = {{CZ_P_CREEP_STIFFNESS, CZ_C_CREEP_COMPLIANCE},
                                      {CZ_P_BRAKE_STIFFNESS, CZ_C_BRAKE_COMPLIANCE},
                                      {CZ_P_HINGE_STIFFNESS_A, CZ_C_HINGE_COMPLIANCE_A},
                                      {CZ_P_HINGE_STIFFNESS_B, CZ_C_HINGE_COMPLIANCE_B},
                                      {CZ_P_FOLD_STIFFNESS_REAR, CZ_C_FOLD_COMPLIANCE_REAR},
                                      {CZ_P_FOLD_STIFFNESS_FRONT, CZ_C_FOLD_COMPLIANCE_FRONT},
                                      {CZ_P_FACE_VERTICAL_STIFFNESS, CZ_C_GRIP_COMPLIANCE}};
    for (size_t k = 0; k < sizeof inverses / sizeof inverses[0]; ++k)
        invert(dynamics, inverses[k][0], inverses[k][1]);
    const double *hertz = cz_row(dynamics->lanes->parameter, dynamics->stride, CZ_P_HERTZ);
    for (int axle = 0; axle < 4; ++axle) {
        const double *indentation =
            cz_row(dynamics->lanes->parameter, dynamics->stride, CZ_P_INDENTATION_0 + axle);
        double *load = cz_row(dynamics->constant, dynamics->stride, CZ_C_STATIC_LOAD_0 + axle);
        for (size_t lane = 0; lane < dynamics->stride; ++lane)
            load[lane] = cz_wheel_normal_force(hertz[lane], indentation[lane]);
    }
}

/* Interfaces between cars that can both move. */
static void derive_tilts(CzDynamics *dynamics) {
    const size_t ahead = (size_t)dynamics->lanes->n_design;
    const double *inverse =
        cz_row(dynamics->lanes->parameter, dynamics->stride, CZ_P_INVERSE_BODY_MASS);
    double *tilts = cz_row(dynamics->constant, dynamics->stride, CZ_C_TILTS);
    for (size_t lane = 0; lane + ahead < dynamics->stride; ++lane)
        tilts[lane] = inverse[lane] > 0.0 && inverse[lane + ahead] > 0.0 ? 1.0 : 0.0;
}

/* Lanes seen from the first lane of a block. */
static CzLanes *lanes_from(const CzLanes *lanes, size_t base, CzArena *arena) {
    CzLanes *view = cz_arena_allocate(arena, 1, sizeof *view);
    if (view == NULL)
        return NULL;
    *view = *lanes;
    view->n_lane = CZ_LANE_BLOCK;
    view->parameter += base;
    for (int id = 0; id < CZ_N_CURVE; ++id) {
        CzCurveLanes *curve = &view->curve[id];
        curve->start += base;
        curve->usable += base;
        if (curve->n_kink > 0) {
            curve->at += base;
            curve->slope_change += base;
        }
    }
    return view;
}

/* Views of all blocks. */
static int create_blocks(CzDynamics *dynamics, CzArena *arena) {
    dynamics->n_block = (int)(dynamics->lanes->n_lane / CZ_LANE_BLOCK);
    dynamics->block = cz_arena_allocate(arena, (size_t)dynamics->n_block, sizeof *dynamics->block);
    if (dynamics->block == NULL)
        return 0;
    for (int i = 0; i < dynamics->n_block; ++i) {
        const size_t base = (size_t)i * CZ_LANE_BLOCK;
        CzDynamics *block = &dynamics->block[i];
        *block = *dynamics;
        block->lanes = lanes_from(dynamics->lanes, base, arena);
        block->position += base;
        block->velocity += base;
        block->force += base;
        block->scratch += base;
        block->constant += base;
        if (block->lanes == NULL)
            return 0;
    }
    return 1;
}

CzDynamics *cz_dynamics_create(const CzLanes *lanes, CzArena *arena) {
    CzDynamics *dynamics = cz_arena_allocate(arena, 1, sizeof *dynamics);
    if (dynamics == NULL)
        return NULL;
    const size_t stride = lanes->stride;
    int missing = 0;
    dynamics->lanes = lanes;
    dynamics->stride = stride;
    dynamics->position = rows(arena, CZ_N_ROW, stride, &missing);
    dynamics->velocity = rows(arena, CZ_N_ROW, stride, &missing);
    dynamics->acceleration = rows(arena, CZ_N_ROW, stride, &missing);
    dynamics->last_acceleration = rows(arena, CZ_N_ROW, stride, &missing);
    dynamics->memory = rows(arena, CZ_N_MEMORY, stride, &missing);
    dynamics->next_memory = rows(arena, CZ_N_MEMORY, stride, &missing);
    dynamics->power = rows(arena, CZ_N_LEDGER, stride, &missing);
    dynamics->last_power = rows(arena, CZ_N_LEDGER, stride, &missing);
    dynamics->work = rows(arena, CZ_N_LEDGER, stride, &missing);
    dynamics->extreme = rows(arena, CZ_N_EXTREME, stride, &missing);
    dynamics->force = rows(arena, CZ_N_DOF, stride, &missing);
    dynamics->constant = rows(arena, CZ_N_CONSTANT, stride, &missing);
    dynamics->scratch = rows(arena, CZ_N_SCRATCH, stride, &missing);
    if (missing)
        return NULL;
    derive_constants(dynamics);
    derive_tilts(dynamics);
    if (!create_blocks(dynamics, arena))
        return NULL;
    memcpy(dynamics->velocity, lanes->velocity, CZ_N_DOF * stride * sizeof(double));
    start_extremes(dynamics);
    return dynamics;
}
