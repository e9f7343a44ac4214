/* What interfaces and cars are equipped with. */
#include "dynamics/equipment.h"

#include <math.h>

#include "model/kinks.h"

static double parameter(const CzLanes *lanes, CzParameter row, size_t lane) {
    return *cz_lane_parameter(lanes, row, lane);
}

CzInterfaceEquipment cz_interface_equipment(const CzLanes *lanes, size_t lane) {
    CzInterfaceEquipment of = {
        .has_couplers = parameter(lanes, CZ_PARAMETER(coupler.exists), lane) > 0.5,
        .is_coupled = parameter(lanes, CZ_PARAMETER(coupler.coupled), lane) > 0.5 ||
                      parameter(lanes, CZ_PARAMETER(draw_gear.slack), lane) < CZ_MISSING,
        .has_side_buffers = parameter(lanes, CZ_PARAMETER(side_buffers.exists), lane) > 0.5,
        .has_superstructures = parameter(lanes, CZ_PARAMETER(superstructure.strength), lane) > 0.0,
        .has_draw_gears = parameter(lanes, CZ_PARAMETER(draw_gear.slack), lane) < CZ_MISSING,
        .can_climb = parameter(lanes, CZ_PARAMETER(face.overlap), lane) < CZ_MISSING,
        .friction = parameter(lanes, CZ_PARAMETER(face.friction), lane),
    };
    for (int side = 0; side < 2; ++side) {
        const double stop =
            parameter(lanes, CZ_PARAMETER(coupler.side[side].hinge_vertical.stop), lane);
        of.couplers_on_ends |=
            parameter(lanes, CZ_PARAMETER(coupler.side[side].on_end), lane) > 0.5;
        of.side[side].has_coupler =
            of.has_couplers && parameter(lanes, CZ_PARAMETER(coupler.side[side].buffer.transition),
                                         lane) <= CZ_MISSING;
        of.side[side].has_side_buffers =
            of.has_side_buffers &&
            parameter(lanes, CZ_PARAMETER(side_buffers.side[side].buffer.transition), lane) <=
                CZ_MISSING;
        of.side[side].has_anti_climber =
            lanes->curve[CZ_CURVE(face[side])].start[lane] <= CZ_MISSING;
        of.side[side].shears_off =
            of.has_couplers &&
            parameter(lanes, CZ_PARAMETER(coupler.side[side].shear.force), lane) < CZ_NEVER;
        of.side[side].has_massless_end =
            parameter(lanes, CZ_PARAMETER(face.side[side].has_massless), lane) > 0.5;
        of.side[side].retraction_space =
            parameter(lanes, CZ_PARAMETER(coupler.side[side].shear.space), lane);
        of.side[side].swing_stop = stop < CZ_MISSING ? stop : INFINITY;
        of.side[side].strut_length =
            parameter(lanes, CZ_PARAMETER(coupler.side[side].strut_length), lane);
    }
    return of;
}

CzCarEquipment cz_car_equipment(const CzLanes *lanes, size_t lane) {
    return (CzCarEquipment){
        .has_slaved_ends = parameter(lanes, CZ_PARAMETER(slaved_ends), lane) > 0.5,
        .is_held = parameter(lanes, CZ_PARAMETER(wheel.brake_moment[0]), lane) > 0.0 ||
                   parameter(lanes, CZ_PARAMETER(wheel.brake_moment[3]), lane) > 0.0 ||
                   parameter(lanes, CZ_PARAMETER(drag.brake), lane) > 0.0 ||
                   parameter(lanes, CZ_PARAMETER(drag.slide), lane) > 0.0,
        .lift_stop = parameter(lanes, CZ_PARAMETER(secondary.lift_gap), lane),
        .bump_stop = parameter(lanes, CZ_PARAMETER(secondary.bump_gap), lane),
        .slide_length = parameter(lanes, CZ_PARAMETER(drag.slide_length), lane),
        .inverse_mass = parameter(lanes, CZ_PARAMETER(inverse.body.mass), lane),
    };
}

bool cz_coupler_is_sheared(const CzDynamics *dynamics, size_t lane, int side) {
    const CzBlock *block = cz_block_of(dynamics, lane);
    return block->memory->coupler.side[side].shear[lane % CZ_LANE_BLOCK] >=
           parameter(dynamics->lanes, CZ_PARAMETER(coupler.side[side].shear.softening), lane);
}
