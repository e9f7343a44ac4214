/* The data that a step reads: law parameters, curves, masses and start velocities, in lanes.
 *
 * Lane of car c of design d is c * n_design + d. Lanes are in blocks of CZ_LANE_BLOCK, and there
 * are blocks enough for reading one car beyond the last; arrays of curves are [quantity][lane] with
 * a row length `stride` of all their lanes. The interface of a design's last car does not exist:
 * its parameters are neutral.
 */
#ifndef CZ_MODEL_LANES_H
#define CZ_MODEL_LANES_H

#include <stdbool.h>

#include "base/arena.h"
#include "model/parameters.h"

/* Force-stroke curves of a lane, by name, such as CZ_CURVE(tube[0]).
 *
 * A curve is y(x) = start + sum over its breakpoints of slope_change * max(x - at, 0). The last
 * breakpoint is where the element bottoms out and the slope becomes the bottom stiffness. Forces
 * are of all devices of the side together. For a missing member: start CZ_NEVER for plastic members
 * (they never yield) and no breakpoints; start 0 and one breakpoint at 0 of slope CZ_NEVER for
 * springs.
 */
typedef struct CzCurveNames {
    char end[2];         /* backbone of the rear and the front crush zone over its shortening */
    char buffer[2];      /* loading curve of the coupler's buffer over its stroke, side A and B */
    char tube[2];        /* strength of the tube over its plastic stroke, trigger included */
    char second_tube[2]; /* likewise */
    char face[2];        /* strength of the anti-climber; missing: plastic */
    char massless[2];    /* backbone of a crush zone without end mass; missing: spring */
    char side_buffer[2]; /* loading curve of the side buffers of one side */
    char side_tube[2];   /* strength of the crash elements behind them */
} CzCurveNames;
typedef int CzCurveId;
#define CZ_CURVE(member) ((int)offsetof(CzCurveNames, member))
enum { CZ_N_CURVE = sizeof(CzCurveNames) };

/* One curve in all lanes. */
typedef struct CzCurveLanes {
    int n_breakpoint;     /* breakpoints in every lane; spare ones have slope_change 0 */
    size_t stride;        /* row length of every array */
    double *start;        /* value at 0 [N] (stride) */
    double *at;           /* place of a breakpoint [m] (n_breakpoint x stride) */
    double *slope_change; /* [N/m] (n_breakpoint x stride) */
    double *usable;       /* stroke at which it bottoms out [m] (stride) */
} CzCurveLanes;

/* The numbers of CZ_LANE_BLOCK neighbouring lanes. */
typedef struct CzLaneBlock {
    CzParameters parameter;
    CzState mass;     /* mass or inertia of each degree of freedom; 0 where none [kg, kg m2] */
    CzState velocity; /* at t = 0 [m/s, rad/s] */
} CzLaneBlock;

/* What some interface or car has: the kernel leaves out everything else. */
typedef struct CzLanesHave {
    bool side_buffers, superstructures, draw_gears, couplers;
    bool full_cars; /* or rigid ones with masses at their ends */
    bool rolling;   /* wheelsets with rolling resistance */
    bool drag;      /* cars without running gear that the track brakes */
} CzLanesHave;

typedef struct CzLanes {
    int n_car;
    int n_design;
    size_t n_lane;      /* n_car * n_design, rounded up to CZ_LANE_BLOCK */
    size_t stride;      /* n_lane and the lanes of one car more, in whole blocks */
    CzLaneBlock *block; /* (stride / CZ_LANE_BLOCK) */
    CzCurveLanes curve[CZ_N_CURVE];
    CzLanesHave has;
} CzLanes;

/* Memory for the lanes of n_design designs of n_car cars, neutral everywhere, with n_breakpoint
 * breakpoints for each curve; NULL when there is none. */
CzLanes *cz_lanes_create(int n_car, int n_design, const int n_breakpoint[CZ_N_CURVE],
                         CzArena *arena);

/* Copies a design from the lanes of other ones, of as many cars and breakpoints; what these have,
 * the lanes then have too. */
void cz_lanes_copy_design(CzLanes *lanes, int design, const CzLanes *from, int from_design);

/* The block of a lane; its place there is lane % CZ_LANE_BLOCK. */
static inline CzLaneBlock *cz_lane_block(const CzLanes *lanes, size_t lane) {
    return &lanes->block[lane / CZ_LANE_BLOCK];
}

/* The parameters of a lane, such as lane.rows->tilts[lane.i]. */
typedef struct CzLane {
    const CzParameters *rows; /* of its block */
    size_t i;                 /* its place there */
} CzLane;
static inline CzLane cz_lane_at(const CzLanes *lanes, size_t lane) {
    return (CzLane){&cz_lane_block(lanes, lane)->parameter, lane % CZ_LANE_BLOCK};
}

/* The number in a lane by the name of its row: CZ_PARAMETER(...), CZ_DOF(...). */
static inline double *cz_lane_parameter(const CzLanes *lanes, CzParameter row, size_t lane) {
    return cz_row_of(&cz_lane_block(lanes, lane)->parameter, row) + lane % CZ_LANE_BLOCK;
}
static inline double *cz_lane_mass(const CzLanes *lanes, int dof, size_t lane) {
    return cz_row_of(&cz_lane_block(lanes, lane)->mass, dof) + lane % CZ_LANE_BLOCK;
}
static inline double *cz_lane_velocity(const CzLanes *lanes, int dof, size_t lane) {
    return cz_row_of(&cz_lane_block(lanes, lane)->velocity, dof) + lane % CZ_LANE_BLOCK;
}

/* Value [N], slope upwards [N/m] and integral from 0 [J] of a curve in a lane. */
double cz_curve_value(const CzCurveLanes *curve, size_t lane, double x);
double cz_curve_slope(const CzCurveLanes *curve, size_t lane, double x);
double cz_curve_integral(const CzCurveLanes *curve, size_t lane, double x);

#endif
