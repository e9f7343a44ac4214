/* Moments of the faces about the bodies. */
#include "dynamics/face_moment.h"

CzFacePush cz_face_push(const CzDynamics *dynamics, size_t lane, size_t own, int side) {
    const CzBudgetRows *rows = cz_block_of(dynamics, lane)->budget;
    const CzBlock *car = cz_block_of(dynamics, own);
    const size_t i = lane % CZ_LANE_BLOCK, k = own % CZ_LANE_BLOCK;
    const int end = side == 0 ? 1 : 0;
    const CzEndRows *at = &car->parameter.end[end];
    const CzPlane *mass = &car->position.end[end], *body = &car->position.body;
    const double sign = side == 0 ? -1.0 : 1.0;
    const double arm_x = at->x[k] + (mass->x[k] - body->x[k]) + rows->face.arm_x[side][i];
    const double arm_z =
        (at->body_z[k] - at->mass_z[k]) + (mass->z[k] - body->z[k]) + rows->face.arm_z[side][i];
    return (CzFacePush){sign * rows->face.z[i],
                        sign * (arm_x * rows->face.z[i] - arm_z * rows->face.x[i])};
}
