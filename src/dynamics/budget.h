/* Forces and moments on the bodies by source, recorded in an evaluation when a budget is
 * requested. */
#ifndef CZ_DYNAMICS_BUDGET_H
#define CZ_DYNAMICS_BUDGET_H

#include "model/lanes.h"

/* Rows of a block. Those of an interface are in the lane of the car behind it: side A is the
 * front end of that car, side B the rear end of the car ahead. */
typedef struct CzBudgetRows {
    double coupler_lift[2][CZ_LANE_BLOCK]; /* vertical force on the body, side A, side B [N] */
    double coupler_moment[2][CZ_LANE_BLOCK];
    double hinge_lift[2][CZ_LANE_BLOCK];
    double hinge_moment[2][CZ_LANE_BLOCK];
    double face_x[CZ_LANE_BLOCK]; /* force of the faces as it acts on side B [N] */
    double face_z[CZ_LANE_BLOCK];
    double face_arm_x[2][CZ_LANE_BLOCK]; /* its point of action, measured from the end mass [m] */
    double face_arm_z[2][CZ_LANE_BLOCK];
    double end_lift[2][CZ_LANE_BLOCK]; /* along the crush zone, rear and front */
    double end_moment[2][CZ_LANE_BLOCK];
    double guide_lift[2][CZ_LANE_BLOCK]; /* across it */
    double guide_moment[2][CZ_LANE_BLOCK];
    double link_moment[CZ_LANE_BLOCK]; /* both links [N m] */
    double suspension_lift[CZ_LANE_BLOCK];
    double suspension_moment[CZ_LANE_BLOCK];
    double stop_lift[CZ_LANE_BLOCK];
    double stop_moment[CZ_LANE_BLOCK];
} CzBudgetRows;

#endif
