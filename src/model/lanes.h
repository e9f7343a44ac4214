/* The numbers that a step reads: law parameters, curves, masses and start velocities, in lanes.
 *
 * Lane of car c of design d is c * n_design + d. Arrays are [quantity][lane] with a row length
 * `stride` that is a multiple of CZ_LANE_BLOCK and leaves room for reading one car beyond the last.
 * The interface of a design's last car does not exist: its parameters are neutral.
 */
#ifndef CZ_MODEL_LANES_H
#define CZ_MODEL_LANES_H

#include <stddef.h>

enum { CZ_LANE_BLOCK = 8 };

typedef enum CzParameter {
#define CZ_PARAMETER(name, unit, doc) CZ_P_##name,
#include "model/parameters.def"
#undef CZ_PARAMETER
    CZ_N_PARAMETER
} CzParameter;

typedef enum CzCurveId {
#define CZ_CURVE(name, doc) CZ_CURVE_##name,
#include "model/curves.def"
#undef CZ_CURVE
    CZ_N_CURVE
} CzCurveId;

typedef enum CzDof {
#define CZ_DOF(name, what) CZ_DOF_##name,
#include "model/dof.def"
#undef CZ_DOF
    CZ_N_DOF
} CzDof;

/* One curve in all lanes. */
typedef struct CzCurveLanes {
    int n_kink;           /* kinks in every lane; spare ones have slope_change 0 */
    double *start;        /* value at 0 [N] (stride) */
    double *at;           /* place of a kink [m] (n_kink x stride) */
    double *slope_change; /* [N/m] (n_kink x stride) */
    double *usable;       /* stroke at which it bottoms out [m] (stride) */
} CzCurveLanes;

typedef struct CzLanes {
    int n_car;
    int n_design;
    size_t n_lane;     /* n_car * n_design, rounded up to CZ_LANE_BLOCK */
    size_t stride;     /* row length of every array */
    double *parameter; /* (CZ_N_PARAMETER x stride) */
    CzCurveLanes curve[CZ_N_CURVE];
    double *mass; /* mass or inertia of each degree of freedom; 0 where none [kg, kg m2] (CZ_N_DOF x
                     stride) */
    double *velocity;        /* at t = 0 [m/s, rad/s] (CZ_N_DOF x stride) */
    int has_side_buffers;    /* any interface has them */
    int has_superstructures; /* likewise */
    int has_couplers;        /* any interface has them */
    int has_full_cars;       /* any car is a full one */
    int has_rolling;         /* any wheelset has rolling resistance */
    int has_drag;            /* the track holds back some car without running gear */
} CzLanes;

#endif
