/* Impulses on the bodies by source, added up by the evaluations of a run when a budget is
 * requested: each evaluation is then that of one step. */
#ifndef CZ_DYNAMICS_BUDGET_H
#define CZ_DYNAMICS_BUDGET_H

#include "model/lanes.h"

/* Rows of a block. Those of an interface are in the lane of the car behind it: side A is the
 * front end of that car, side B the rear end of the car ahead. */
typedef struct CzBudgetRows {
    CzRow coupler_lift[2]; /* vertical impulse on the body, side A, side B [N s] */
    CzRow coupler_moment[2];
    CzRow hinge_lift[2];
    CzRow hinge_moment[2];
    CzRow end_lift[2]; /* along the crush zone, rear and front */
    CzRow end_moment[2];
    CzRow guide_lift[2]; /* across it */
    CzRow guide_moment[2];
    CzRow link_moment; /* both links [N m s] */
    CzRow suspension_lift;
    CzRow suspension_moment;
    CzRow stop_lift;
    CzRow stop_moment;
    struct {
        CzRow x, z;     /* force as it acts on side B [N] */
        CzRow arm_x[2]; /* its point of action, measured from the end mass [m] */
        CzRow arm_z[2];
    } face; /* of the last evaluation, not added up */
} CzBudgetRows;

#endif
