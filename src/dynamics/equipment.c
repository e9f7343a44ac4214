/* What interfaces and cars are equipped with. */
#include "dynamics/equipment.h"

#include <math.h>

#include "laws/wheel_rail.h"

CzInterfaceEquipment cz_interface_equipment(const CzLanes *lanes, size_t lane) {
    const CzLane at = cz_lane_at(lanes, lane);
    const CzCouplerRows *coupler = &at.rows->coupler;
    const CzSideBufferRows *side_buffers = &at.rows->side_buffers;
    const CzFaceRows *face = &at.rows->face;
    const size_t i = at.i;
    CzInterfaceEquipment of = {
        .has_couplers = coupler->exists[i] > 0.5,
        .is_coupled = coupler->coupled[i] > 0.5 ||
                      at.rows->draw_gear
                          .slack[i]<CZ_MISSING, .has_side_buffers = side_buffers->exists[i]> 0.5,
        .has_superstructures = at.rows->superstructure.strength[i] > 0.0,
        .has_draw_gears = at.rows->draw_gear.slack[i]<CZ_MISSING, .tilts = at.rows->tilts[i]> 0.0,
        .can_climb = face->overlap[i] < CZ_MISSING,
        .friction = face->friction[i],
    };
    for (int side = 0; side < 2; ++side) {
        const double stop = coupler->side[side].hinge_vertical.stop[i];
        of.couplers_on_ends |= coupler->side[side].on_end[i] > 0.5;
        of.side[side].has_coupler =
            of.has_couplers && coupler->side[side].buffer.transition[i] <= CZ_MISSING;
        of.side[side].has_side_buffers =
            of.has_side_buffers && side_buffers->side[side].buffer.transition[i] <= CZ_MISSING;
        of.side[side].presses_plates =
            of.has_side_buffers && !of.side[side].has_side_buffers &&
            lanes->curve[CZ_CURVE(side_tube[side])].start[lane] <= CZ_MISSING;
        of.side[side].has_anti_climber =
            lanes->curve[CZ_CURVE(face[side])].start[lane] <= CZ_MISSING;
        of.side[side].shears_off = of.has_couplers && coupler->side[side].shear.force[i] < CZ_NEVER;
        of.side[side].has_massless_end = face->side[side].has_massless[i] > 0.5;
        of.side[side].retraction_space = coupler->side[side].shear.space[i];
        of.side[side].swing_stop = stop < CZ_MISSING ? stop : INFINITY;
        of.side[side].strut_length = coupler->side[side].strut_length[i];
    }
    of.has_ribs = of.side[0].has_anti_climber && of.side[1].has_anti_climber;
    return of;
}

/* Brakes and rolling resistance at the static loads of the wheels, over the mass. */
static double slowing_of(const CzLanes *lanes, size_t lane) {
    const CzLane at = cz_lane_at(lanes, lane);
    const CzWheelRows *wheel = &at.rows->wheel;
    const size_t i = at.i;
    double force = at.rows->drag.brake[i] + at.rows->drag.rolling[i], mass = 0.0;
    if (at.rows->drag.slide[i] > 0.0)
        return INFINITY;
    for (int axle = 0; axle < 4; ++axle)
        force += wheel->brake_moment[axle][i] / wheel->radius[i] +
                 wheel->rolling_resistance[i] *
                     cz_wheel_normal_force(wheel->hertz[i], wheel->indentation[axle][i]);
    for (int dof = 0; dof < CZ_N_DOF; ++dof)
        mass += cz_axis_of(dof) == CZ_AXIS_ALONG ? *cz_lane_mass(lanes, dof, lane) : 0.0;
    return mass > 0.0 ? force / mass : 0.0;
}

CzCarEquipment cz_car_equipment(const CzLanes *lanes, size_t lane) {
    const CzLane at = cz_lane_at(lanes, lane);
    const CzWheelRows *wheel = &at.rows->wheel;
    const CzDragRows *drag = &at.rows->drag;
    const size_t i = at.i;
    return (CzCarEquipment){
        .has_slaved_end = {at.rows->slaved_ends[0][i] > 0.5, at.rows->slaved_ends[1][i] > 0.5},
        .is_held = wheel->brake_moment[0][i] > 0.0 || wheel->brake_moment[3][i] > 0.0 ||
                   drag->brake[i] > 0.0 || drag->slide[i] > 0.0,
        .slowing = slowing_of(lanes, lane),
        .lift_stop = at.rows->secondary.lift_gap[i],
        .bump_stop = at.rows->secondary.bump_gap[i],
        .slide_length = drag->slide_length[i],
        .inverse_mass = at.rows->inverse.body.mass[i],
    };
}

bool cz_coupler_is_sheared(const CzDynamics *dynamics, size_t lane, int side) {
    const CzBlock *block = cz_block_of(dynamics, lane);
    const size_t i = lane % CZ_LANE_BLOCK;
    return block->memory->coupler.side[side].shear[i] >=
           block->parameter.coupler.side[side].shear.softening[i];
}
