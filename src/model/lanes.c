/* Memory of the lanes, with neutral numbers everywhere. */
#include "model/lanes.h"

#include "laws/law.h"

static void set_row(double *row, size_t n, double value) {
    for (size_t lane = 0; lane < n; lane++)
        row[lane] = value;
}

static void set(CzRow row, double value) {
    set_row(row, CZ_LANE_BLOCK, value);
}

/* Neutral values that are not zero: of both ends of a car, and of both sides of an interface. */
static void set_neutral_pairs(CzParameters *rows) {
    for (int k = 0; k < 2; k++) {
        set(rows->end[k].fold_pitch.moment, CZ_NEVER);
        set(rows->end[k].crush.unloading, CZ_NEVER);
        set(rows->end[k].crush.second_unloading, CZ_NEVER);
        set(rows->coupler.side[k].strut_length, CZ_NEVER);
        set(rows->coupler.side[k].buffer.transition, CZ_NEVER);
        set(rows->coupler.side[k].shear.force, CZ_NEVER);
        set(rows->coupler.side[k].shear.softening, 1.0);
        set(rows->coupler.side[k].shear.space, CZ_NEVER);
        set(rows->coupler.side[k].hinge_vertical.stop, CZ_NEVER);
        set(rows->face.side[k].massless.unloading, CZ_NEVER);
        set(rows->face.side[k].massless.second_unloading, CZ_NEVER);
        set(rows->side_buffers.side[k].buffer.transition, CZ_NEVER);
    }
}

static void set_neutral_suspension(CzSuspensionRows *rows) {
    set(rows->blow_off_rate, CZ_NEVER);
    set(rows->bump_gap, CZ_NEVER);
    set(rows->lift_gap, CZ_NEVER);
}

static void set_neutral(CzParameters *rows) {
    set_neutral_pairs(rows);
    set_neutral_suspension(&rows->secondary);
    set_neutral_suspension(&rows->primary);
    set(rows->slaved_ends[0], 1.0);
    set(rows->slaved_ends[1], 1.0);
    set(rows->wheel.radius, 1.0);
    set(rows->wheel.creep_length, 1.0);
    set(rows->wheel.friction_fall_speed, 1.0);
    set(rows->wheel.brake_stiffness, 1.0);
    set(rows->drag.slide_length, CZ_NEVER);
    set(rows->coupler.pivot.distance, 1.0);
    set(rows->coupler.length, 1.0);
    set(rows->face.contact.distance, CZ_NEVER);
    set(rows->face.compliance, 1e-9);
    set(rows->face.overlap, CZ_NEVER);
    set(rows->face.rib_pitch, 1.0);
    set(rows->face.rib_depth, 1.0);
    set(rows->face.stiffness_vertical, 1.0);
    set(rows->side_buffers.contact.distance, CZ_NEVER);
    set(rows->superstructure.contact.distance, CZ_NEVER);
    set(rows->superstructure.stiffness, 1.0);
    set(rows->draw_gear.stiffness, 1.0);
    set(rows->draw_gear.slack, CZ_NEVER);
}

/* Springs are rigid where they are missing, plastic members never yield. */
static bool is_spring(CzCurveId id) {
    return id < CZ_CURVE(tube[0]) || (id >= CZ_CURVE(massless[0]) && id < CZ_CURVE(side_tube[0]));
}

static bool create_curve(CzCurveLanes *curve, CzCurveId id, int n_breakpoint, size_t stride,
                         CzArena *arena) {
    curve->n_breakpoint = n_breakpoint;
    curve->stride = stride;
    curve->start = cz_arena_allocate(arena, stride, sizeof(double));
    curve->usable = cz_arena_allocate(arena, stride, sizeof(double));
    curve->at = cz_arena_allocate(arena, (size_t)n_breakpoint * stride, sizeof(double));
    curve->slope_change = cz_arena_allocate(arena, (size_t)n_breakpoint * stride, sizeof(double));
    if (curve->start == NULL || curve->usable == NULL || curve->at == NULL ||
        curve->slope_change == NULL)
        return false;
    set_row(curve->usable, stride, CZ_NEVER);
    if (is_spring(id))
        set_row(curve->slope_change + (size_t)(n_breakpoint - 1) * stride, stride, CZ_NEVER);
    else
        set_row(curve->start, stride, CZ_NEVER);
    return true;
}

/* Rounded up to whole blocks. */
static size_t blocks(size_t n) {
    return (n + CZ_LANE_BLOCK - 1) / CZ_LANE_BLOCK * CZ_LANE_BLOCK;
}

CzLanes *cz_lanes_create(int n_car, int n_design, const int n_breakpoint[CZ_N_CURVE],
                         CzArena *arena) {
    CzLanes *lanes = cz_arena_allocate(arena, 1, sizeof *lanes);
    if (lanes == NULL)
        return NULL;
    lanes->n_car = n_car;
    lanes->n_design = n_design;
    lanes->n_lane = blocks((size_t)n_car * (size_t)n_design);
    lanes->stride = blocks(lanes->n_lane + (size_t)n_design);
    const size_t n_block = lanes->stride / CZ_LANE_BLOCK;
    lanes->block = cz_arena_allocate(arena, n_block, sizeof *lanes->block);
    if (lanes->block == NULL)
        return NULL;
    for (int id = 0; id < CZ_N_CURVE; id++)
        if (!create_curve(&lanes->curve[id], id, n_breakpoint[id], lanes->stride, arena))
            return NULL;
    for (size_t k = 0; k < n_block; k++)
        set_neutral(&lanes->block[k].parameter);
    return lanes;
}

/* ---- copies ---- */

static void copy_curve(CzCurveLanes *curve, size_t lane, const CzCurveLanes *from,
                       size_t from_lane) {
    curve->start[lane] = from->start[from_lane];
    curve->usable[lane] = from->usable[from_lane];
    for (size_t k = 0; k < (size_t)curve->n_breakpoint; k++) {
        curve->at[k * curve->stride + lane] = from->at[k * from->stride + from_lane];
        curve->slope_change[k * curve->stride + lane] =
            from->slope_change[k * from->stride + from_lane];
    }
}

void cz_lanes_copy_design(CzLanes *lanes, int design, const CzLanes *from, int from_design) {
    for (int car = 0; car < lanes->n_car; car++) {
        const size_t lane = (size_t)(car * lanes->n_design + design);
        const size_t from_lane = (size_t)(car * from->n_design + from_design);
        cz_copy_lane(cz_lane_block(lanes, lane), lane % CZ_LANE_BLOCK,
                     cz_lane_block(from, from_lane), from_lane % CZ_LANE_BLOCK,
                     sizeof(CzLaneBlock));
        for (int id = 0; id < CZ_N_CURVE; id++)
            copy_curve(&lanes->curve[id], lane, &from->curve[id], from_lane);
    }
    lanes->has = from->has;
}

/* ---- curves in a lane ---- */

double cz_curve_value(const CzCurveLanes *curve, size_t lane, double x) {
    double value = curve->start[lane];
    for (size_t at = lane; at < (size_t)curve->n_breakpoint * curve->stride; at += curve->stride)
        value += curve->slope_change[at] * cz_positive_part(x - curve->at[at]);
    return value;
}

double cz_curve_slope(const CzCurveLanes *curve, size_t lane, double x) {
    double slope = 0.0;
    for (size_t at = lane; at < (size_t)curve->n_breakpoint * curve->stride; at += curve->stride)
        slope += curve->at[at] <= x ? curve->slope_change[at] : 0.0;
    return slope;
}

double cz_curve_integral(const CzCurveLanes *curve, size_t lane, double x) {
    double integral = curve->start[lane] * x;
    for (size_t at = lane; at < (size_t)curve->n_breakpoint * curve->stride; at += curve->stride) {
        const double beyond = cz_positive_part(x - curve->at[at]);
        integral += 0.5 * curve->slope_change[at] * beyond * beyond;
    }
    return integral;
}
