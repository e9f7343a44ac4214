/* Memory of the lanes, with neutral numbers everywhere. */
#include "model/kinks.h"
#include "model/model.h"

/* Neutral values that are not zero. */
static const struct {
    CzParameter parameter;
    double value;
} neutral[] = {
    {CZ_PARAMETER(slaved_ends), 1.0},
    {CZ_PARAMETER(end[0].fold_pitch.moment), CZ_NEVER},
    {CZ_PARAMETER(end[1].fold_pitch.moment), CZ_NEVER},
    {CZ_PARAMETER(end[0].crush.unloading), CZ_NEVER},
    {CZ_PARAMETER(end[1].crush.unloading), CZ_NEVER},
    {CZ_PARAMETER(end[0].crush.second_unloading), CZ_NEVER},
    {CZ_PARAMETER(end[1].crush.second_unloading), CZ_NEVER},
    {CZ_PARAMETER(secondary.blow_off_rate), CZ_NEVER},
    {CZ_PARAMETER(secondary.bump_gap), CZ_NEVER},
    {CZ_PARAMETER(secondary.lift_gap), CZ_NEVER},
    {CZ_PARAMETER(primary.blow_off_rate), CZ_NEVER},
    {CZ_PARAMETER(primary.bump_gap), CZ_NEVER},
    {CZ_PARAMETER(primary.lift_gap), CZ_NEVER},
    {CZ_PARAMETER(wheel.radius), 1.0},
    {CZ_PARAMETER(wheel.creep_length), 1.0},
    {CZ_PARAMETER(wheel.friction_fall_speed), 1.0},
    {CZ_PARAMETER(wheel.brake_stiffness), 1.0},
    {CZ_PARAMETER(drag.slide_length), CZ_NEVER},
    {CZ_PARAMETER(coupler.pivot.distance), 1.0},
    {CZ_PARAMETER(coupler.length), 1.0},
    {CZ_PARAMETER(coupler.side[0].strut_length), CZ_NEVER},
    {CZ_PARAMETER(coupler.side[1].strut_length), CZ_NEVER},
    {CZ_PARAMETER(coupler.side[0].buffer.transition), CZ_NEVER},
    {CZ_PARAMETER(coupler.side[1].buffer.transition), CZ_NEVER},
    {CZ_PARAMETER(coupler.side[0].shear.force), CZ_NEVER},
    {CZ_PARAMETER(coupler.side[1].shear.force), CZ_NEVER},
    {CZ_PARAMETER(coupler.side[0].shear.softening), 1.0},
    {CZ_PARAMETER(coupler.side[1].shear.softening), 1.0},
    {CZ_PARAMETER(coupler.side[0].shear.space), CZ_NEVER},
    {CZ_PARAMETER(coupler.side[1].shear.space), CZ_NEVER},
    {CZ_PARAMETER(coupler.side[0].hinge_vertical.stop), CZ_NEVER},
    {CZ_PARAMETER(coupler.side[1].hinge_vertical.stop), CZ_NEVER},
    {CZ_PARAMETER(face.contact.distance), CZ_NEVER},
    {CZ_PARAMETER(face.compliance), 1e-9},
    {CZ_PARAMETER(face.overlap), CZ_NEVER},
    {CZ_PARAMETER(face.rib_pitch), 1.0},
    {CZ_PARAMETER(face.rib_depth), 1.0},
    {CZ_PARAMETER(face.stiffness_vertical), 1.0},
    {CZ_PARAMETER(face.side[0].massless.unloading), CZ_NEVER},
    {CZ_PARAMETER(face.side[1].massless.unloading), CZ_NEVER},
    {CZ_PARAMETER(face.side[0].massless.second_unloading), CZ_NEVER},
    {CZ_PARAMETER(face.side[1].massless.second_unloading), CZ_NEVER},
    {CZ_PARAMETER(side_buffers.contact.distance), CZ_NEVER},
    {CZ_PARAMETER(superstructure.contact.distance), CZ_NEVER},
    {CZ_PARAMETER(superstructure.stiffness), 1.0},
    {CZ_PARAMETER(draw_gear.stiffness), 1.0},
    {CZ_PARAMETER(draw_gear.slack), CZ_NEVER},
    {CZ_PARAMETER(side_buffers.side[0].buffer.transition), CZ_NEVER},
    {CZ_PARAMETER(side_buffers.side[1].buffer.transition), CZ_NEVER},
};

/* Springs are rigid where they are missing, plastic members never yield. */
static bool is_spring(CzCurveId id) {
    return id < CZ_CURVE(tube[0]) || (id >= CZ_CURVE(massless[0]) && id < CZ_CURVE(side_tube[0]));
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
    const size_t n_block = lanes->stride / CZ_LANE_BLOCK;
    lanes->block = cz_arena_allocate(arena, n_block, sizeof *lanes->block);
    if (lanes->block == NULL)
        return NULL;
    for (int id = 0; id < CZ_N_CURVE; id++)
        if (!create_curve(&lanes->curve[id], (CzCurveId)id, model->n_kink[id], lanes->stride,
                          arena))
            return NULL;
    for (size_t i = 0; i < sizeof neutral / sizeof neutral[0]; i++)
        for (size_t k = 0; k < n_block; k++)
            set_row(cz_row_of(&lanes->block[k].parameter, neutral[i].parameter), CZ_LANE_BLOCK,
                    neutral[i].value);
    return lanes;
}
