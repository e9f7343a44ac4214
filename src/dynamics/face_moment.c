/* Moments of the faces about the bodies. */
#include "dynamics/face_moment.h"

static double parameter(const CzDynamics *dynamics, CzParameter row, size_t lane) {
    return *cz_lane_parameter(dynamics->lanes, row, lane);
}

CzFacePush cz_face_push(const CzDynamics *dynamics, size_t lane, size_t own, int side) {
    const CzBudgetRows *rows = cz_block_of(dynamics, lane)->budget;
    const CzState *position = &cz_block_of(dynamics, own)->position;
    const size_t i = lane % CZ_LANE_BLOCK, k = own % CZ_LANE_BLOCK;
    const int end = side == 0 ? 1 : 0;
    if (rows->face_x[i] == 0.0 && rows->face_z[i] == 0.0)
        return (CzFacePush){0.0, 0.0}; /* most of the time; both are zero as they came */
    const double sign = side == 0 ? -1.0 : 1.0;
    const double x = parameter(dynamics, CZ_PARAMETER(end[end].x), own);
    const double z = parameter(dynamics, CZ_PARAMETER(end[end].body_z), own) -
                     parameter(dynamics, CZ_PARAMETER(end[end].mass_z), own);
    const double moved_x = position->end[end].x[k] - position->body.x[k];
    const double moved_z = position->end[end].z[k] - position->body.z[k];
    const double arm_x = x + moved_x + rows->face_arm_x[side][i];
    const double arm_z = z + moved_z + rows->face_arm_z[side][i];
    return (CzFacePush){sign * rows->face_z[i],
                        sign * (arm_x * rows->face_z[i] - arm_z * rows->face_x[i])};
}
