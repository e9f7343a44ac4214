/* Memory of the lanes, with neutral numbers everywhere. */
#include "model/kinks.h"
#include "model/model.h"

/* Neutral values that are not zero. */
static const struct {
    CzParameter parameter;
    double value;
} neutral[] = {
    {CZ_P_SLAVED_ENDS, 1.0},
    {CZ_P_FOLD_MOMENT_REAR, CZ_NEVER},
    {CZ_P_FOLD_MOMENT_FRONT, CZ_NEVER},
    {CZ_P_END_UNLOADING_REAR, CZ_NEVER},
    {CZ_P_END_UNLOADING_FRONT, CZ_NEVER},
    {CZ_P_END_SECOND_UNLOADING_REAR, CZ_NEVER},
    {CZ_P_END_SECOND_UNLOADING_FRONT, CZ_NEVER},
    {CZ_P_SECONDARY_BLOW_OFF_RATE, CZ_NEVER},
    {CZ_P_SECONDARY_BUMP_GAP, CZ_NEVER},
    {CZ_P_SECONDARY_LIFT_GAP, CZ_NEVER},
    {CZ_P_PRIMARY_BLOW_OFF_RATE, CZ_NEVER},
    {CZ_P_PRIMARY_BUMP_GAP, CZ_NEVER},
    {CZ_P_PRIMARY_LIFT_GAP, CZ_NEVER},
    {CZ_P_WHEEL_RADIUS, 1.0},
    {CZ_P_CREEP_LENGTH, 1.0},
    {CZ_P_FRICTION_FALL_SPEED, 1.0},
    {CZ_P_BRAKE_STIFFNESS, 1.0},
    {CZ_P_SLIDE_LENGTH, CZ_NEVER},
    {CZ_P_PIVOT_DISTANCE, 1.0},
    {CZ_P_COUPLER_LENGTH, 1.0},
    {CZ_P_STRUT_LENGTH_A, CZ_NEVER},
    {CZ_P_STRUT_LENGTH_B, CZ_NEVER},
    {CZ_P_BUFFER_TRANSITION_A, CZ_NEVER},
    {CZ_P_BUFFER_TRANSITION_B, CZ_NEVER},
    {CZ_P_SHEAR_FORCE_A, CZ_NEVER},
    {CZ_P_SHEAR_FORCE_B, CZ_NEVER},
    {CZ_P_SHEAR_SOFTENING_A, 1.0},
    {CZ_P_SHEAR_SOFTENING_B, 1.0},
    {CZ_P_SHEAR_SPACE_A, CZ_NEVER},
    {CZ_P_SHEAR_SPACE_B, CZ_NEVER},
    {CZ_P_SWING_STOP_A, CZ_NEVER},
    {CZ_P_SWING_STOP_B, CZ_NEVER},
    {CZ_P_FACE_GAP, CZ_NEVER},
    {CZ_P_FACE_COMPLIANCE, 1e-9},
    {CZ_P_FACE_OVERLAP, CZ_NEVER},
    {CZ_P_RIB_PITCH, 1.0},
    {CZ_P_RIB_DEPTH, 1.0},
    {CZ_P_FACE_VERTICAL_STIFFNESS, 1.0},
    {CZ_P_LIMP_UNLOADING_A, CZ_NEVER},
    {CZ_P_LIMP_UNLOADING_B, CZ_NEVER},
    {CZ_P_LIMP_SECOND_UNLOADING_A, CZ_NEVER},
    {CZ_P_LIMP_SECOND_UNLOADING_B, CZ_NEVER},
    {CZ_P_SIDE_GAP, CZ_NEVER},
    {CZ_P_SUPERSTRUCTURE_GAP, CZ_NEVER},
    {CZ_P_SUPERSTRUCTURE_STIFFNESS, 1.0},
    {CZ_P_SIDE_TRANSITION_A, CZ_NEVER},
    {CZ_P_SIDE_TRANSITION_B, CZ_NEVER},
};

static bool is_spring(CzCurveId id) {
    switch (id) {
    case CZ_CURVE_TUBE_A:
    case CZ_CURVE_TUBE_B:
    case CZ_CURVE_SECOND_TUBE_A:
    case CZ_CURVE_SECOND_TUBE_B:
    case CZ_CURVE_FACE_A:
    case CZ_CURVE_FACE_B:
    case CZ_CURVE_SIDE_TUBE_A:
    case CZ_CURVE_SIDE_TUBE_B:
        return false;
    default:
        return true;
    }
}

static void set_row(double *row, size_t n, double value) {
    for (size_t lane = 0; lane < n; lane++)
        row[lane] = value;
}

static bool create_curve(CzCurveLanes *curve, CzCurveId id, int n_kink, size_t stride,
                         CzArena *arena) {
    curve->n_kink = n_kink;
    curve->start = cz_arena_allocate(arena, stride, sizeof(double));
    curve->usable = cz_arena_allocate(arena, stride, sizeof(double));
    curve->at = cz_arena_allocate(arena, (size_t)n_kink * stride, sizeof(double));
    curve->slope_change = cz_arena_allocate(arena, (size_t)n_kink * stride, sizeof(double));
    if (curve->start == NULL || curve->usable == NULL || curve->at == NULL ||
        curve->slope_change == NULL)
        return false;
    set_row(curve->usable, stride, CZ_NEVER);
    if (is_spring(id))
        set_row(curve->slope_change + (size_t)(n_kink - 1) * stride, stride, CZ_NEVER);
    else
        set_row(curve->start, stride, CZ_NEVER);
    return true;
}

/* Rounded up to whole blocks. */
static size_t blocks(size_t n) {
    return (n + CZ_LANE_BLOCK - 1) / CZ_LANE_BLOCK * CZ_LANE_BLOCK;
}

CzLanes *cz_lanes_create(const CzModel *model, int n_design, CzArena *arena) {
    CzLanes *lanes = cz_arena_allocate(arena, 1, sizeof *lanes);
    if (lanes == NULL)
        return NULL;
    lanes->n_car = model->n_car;
    lanes->n_design = n_design;
    lanes->n_lane = blocks((size_t)model->n_car * (size_t)n_design);
    lanes->stride = blocks(lanes->n_lane + (size_t)n_design);
    lanes->parameter = cz_arena_allocate(arena, CZ_N_PARAMETER * lanes->stride, sizeof(double));
    lanes->mass = cz_arena_allocate(arena, CZ_N_DOF * lanes->stride, sizeof(double));
    lanes->velocity = cz_arena_allocate(arena, CZ_N_DOF * lanes->stride, sizeof(double));
    if (lanes->parameter == NULL || lanes->mass == NULL || lanes->velocity == NULL)
        return NULL;
    for (int id = 0; id < CZ_N_CURVE; id++)
        if (!create_curve(&lanes->curve[id], (CzCurveId)id, model->n_kink[id], lanes->stride,
                          arena))
            return NULL;
    for (size_t i = 0; i < sizeof neutral / sizeof neutral[0]; i++)
        set_row(lanes->parameter + (size_t)neutral[i].parameter * lanes->stride, lanes->stride,
                neutral[i].value);
    return lanes;
}
