/* Law parameters and geometry of the lanes. [SI]
 *
 * A lane is one car of one design. Parameters of an interface are in the lane of its rear car: side
 * 0 (A) is the front end of that car, side 1 (B) the rear end of the car ahead. Ends and bogies are
 * counted rear first, axles from the rear. Positions of material points are seen from the centre of
 * gravity of the body that carries them: _x forward, _z up. Parameters of missing parts are zero
 * unless another value is given here, such as CZ_NEVER.
 */
#ifndef CZ_MODEL_PARAMETERS_H
#define CZ_MODEL_PARAMETERS_H

#include "model/state.h"

/* Inverse masses and inertias: 0 where a body cannot move in that direction. */
typedef struct CzInverse {
    CzRow mass;          /* [1/kg] */
    CzRow inertia_pitch; /* [1/(kg m2)] */
} CzInverse;

/* Spring and damper side by side. */
typedef struct CzStrutRows {
    CzRow stiffness; /* [N/m] */
    CzRow damping;   /* [N s/m] */
} CzStrutRows;

/* Crush zone; its backbone is a curve (CzCurveNames). */
typedef struct CzCrushRows {
    CzRow unloading;        /* first unloading stage [N/m]; CZ_NEVER if none */
    CzRow share;            /* of the peak force at which the second one begins [-] */
    CzRow second_unloading; /* second unloading stage [N/m]; CZ_NEVER if none */
    CzRow tension;          /* stiffness that holds an end mass on its body in tension [N/m] */
    CzRow damping;          /* [N s/m] */
} CzCrushRows;

/* Connection of an end mass to the body. */
typedef struct CzEndRows {
    CzRow x;      /* end mass from the body's centre of gravity, negative at the rear [m] */
    CzRow body_z; /* crush height less body cg height [m] */
    CzRow mass_z; /* crush height less end mass cg height [m] */
    CzCrushRows crush;
    CzStrutRows guide_vertical; /* guidance; stiff when locked */
    struct {
        CzRow stiffness; /* guidance; stiff when locked [N m/rad] */
        CzRow damping;   /* [N m s/rad] */
        CzRow moment;    /* plastic hinge moment [N m]; CZ_NEVER when locked */
    } fold_pitch;
} CzEndRows;

/* Vertical suspension; the static loads of its springs are separate. */
typedef struct CzSuspensionRows {
    CzRow stiffness;      /* [N/m] */
    CzRow damping;        /* [N s/m] */
    CzRow blow_off_rate;  /* rate at which the relief valve opens [m/s]; CZ_NEVER if none */
    CzRow damping_beyond; /* damper slope beyond that rate [N s/m] */
    CzRow bump_gap;       /* [m]; CZ_NEVER without a stop */
    CzRow bump_stiffness; /* [N/m] */
    CzRow lift_gap;       /* [m]; CZ_NEVER without a stop */
    CzRow lift_stiffness; /* [N/m] */
} CzSuspensionRows;

/* Wheel and rail, per wheelset. */
typedef struct CzWheelRows {
    CzRow radius;          /* 1 for vehicles without wheels [m] */
    CzRow hertz;           /* both wheels of a wheelset: 2 G^-1.5 [N/m^1.5] */
    CzRow indentation[4];  /* at rest: (static wheelset load / hertz)^(2/3) [m] */
    CzRow creep_stiffness; /* tangential contact stiffness: friction * static axle load / (peak
                              creepage * creep_length) [N/m] */
    CzRow creep_length;    /* contact length over which rolling removes tangential deflection; 0.006
                              (ours); 1 without wheels [m] */
    CzRow friction_peak;
    CzRow friction_sliding;
    CzRow friction_fall_speed; /* 1 without wheels [m/s] */
    CzRow brake_moment[4];     /* brake ratio * static axle load * radius on braked axles [N m] */
    CzRow brake_stiffness;     /* torsion stiffness of a held axle, wheelset inertia * (300 rad/s)^2
                                  (ours); 1 without wheels [N m/rad] */
    CzRow rolling_resistance;  /* of a wheelset, over its normal force [-] */
} CzWheelRows;

/* Drag of the track on a car without running gear. */
typedef struct CzDragRows {
    CzRow brake;           /* brake force at rest: the lesser of brakes and peak friction [N] */
    CzRow brake_sliding;   /* the same at large speed: less where the wheels lock [N] */
    CzRow rolling;         /* rolling resistance [N] */
    CzRow slide;           /* friction jaws of a buffer stop [N] */
    CzRow slide_length;    /* travel of the jaws until the buffer stop reaches its end stop [m];
                              CZ_NEVER if none */
    CzRow slide_stiffness; /* beyond it [N/m] */
} CzDragRows;

/* Two opposite points, from the centres of gravity of their carriers. */
typedef struct CzPairRows {
    CzRow x[2], z[2]; /* x of side B is negative [m] */
    CzRow distance;   /* along the track at t = 0 [m]; CZ_NEVER if none */
    CzRow rise;       /* height of B over A at t = 0, offsets included [m] */
} CzPairRows;

/* Buffers of one side, all devices together. */
typedef struct CzBufferRows {
    CzRow transition;     /* [N/m]; CZ_NEVER for a missing buffer */
    CzRow share;          /* unloading force over loading force [-] */
    CzRow damping;        /* [N s/m] */
    CzRow quadratic;      /* [N s2/m2] */
    CzRow draw_stiffness; /* [N/m] */
    CzRow draw_slack;     /* [m] */
} CzBufferRows;

typedef struct CzShearOffRows {
    CzRow force;     /* [N]; CZ_NEVER if none */
    CzRow residual;  /* force after shear-off [N] */
    CzRow softening; /* 1 if none [m] */
    CzRow space;     /* softening length plus retraction space [m]; CZ_NEVER if none */
    CzRow bottom;    /* [N/m] */
} CzShearOffRows;

typedef struct CzHingeRows {
    CzRow stiffness;      /* [N m/rad] */
    CzRow moment;         /* at which it yields [N m] */
    CzRow stop;           /* [rad]; CZ_NEVER if none */
    CzRow stop_stiffness; /* [N m/rad] */
} CzHingeRows;

typedef struct CzCouplerRows {
    CzRow exists;     /* 1 when both sides have a coupler, or one strikes the bare end of the other
                         side, which then has neutral members */
    CzRow coupled;    /* 1 when the couplers carry tension: inner interfaces */
    CzPairRows pivot; /* the lengths of struts are in the distance; 1 without couplers */
    CzRow length; /* distance between the pivots, along their line, at which the faces just touch;
                     1 without couplers [m] */
    CzRow along;  /* the same along the track [m] */
    CzRow compliance; /* sum of 1/stiffness of all tubes of both sides [m/N] */
    struct {
        CzRow on_end;       /* 1 when the pivot, or what a coupler strikes, is on the end mass */
        CzRow strut_length; /* pivot to face, uncompressed, of a coupler whose line can rotate: its
                               largest shortening [m]; CZ_NEVER if none */
        CzBufferRows buffer;
        CzRow tube_rate, second_tube_rate; /* rate factors [s/m] */
        CzShearOffRows shear;
        CzHingeRows hinge_vertical;
    } side[2];
} CzCouplerRows;

/* Anti-climbers, or the bare ends where there are none. */
typedef struct CzFaceRows {
    CzPairRows contact; /* face centres; on the end mass (rigid, fixed: on the body) */
    CzRow compliance;   /* sum of 1/stiffness of the anti-climbers of both sides [m/N] */
    CzRow damping;      /* both sides in series [N s/m] */
    CzRow overlap; /* vertical, of two level faces: half the sum of the face heights [m]; CZ_NEVER
                      where nothing can climb (rigid, fixed) */
    CzRow eccentricity; /* height of side A's face over side B's where their slip is 0; 0 but of an
                           anti-climber on a bare end, which touch at one height [m] */
    CzRow rib_pitch;    /* face height over rib count, the larger of both sides; 1 without
                           ribs [m] */
    CzRow rib_depth;    /* closure over which the ribs engage; 1 without ribs [m] */
    CzRow rib_capacity; /* vertical capacity of all ribs when the faces are level: the weaker
                           side's count * devices * strength [N] */
    CzRow friction;     /* the smaller of both sides [-] */
    CzRow stiffness_vertical; /* both sides in series; 1 if none [N/m] */
    struct {
        CzRow rate;         /* rate factor of the anti-climber [s/m] */
        CzRow speed_factor; /* over reference speed [s/m] */
        CzRow has_massless; /* 1 when the crush zone of the side is in series with the anti-climber
                               (rigid, fixed) */
        CzCrushRows massless; /* that crush zone, without an end mass */
    } side[2];
} CzFaceRows;

typedef struct CzSuperstructureRows {
    CzPairRows contact; /* foremost points, on the end masses */
    CzRow stiffness;    /* both sides in series; 1 if none [N/m] */
    CzRow strength;     /* that of the weaker side; 0 if none [N] */
} CzSuperstructureRows;

typedef struct CzDrawGearRows {
    CzPairRows contact; /* draw hooks, on the bodies */
    CzRow stiffness;    /* both sides in series; 1 if none [N/m] */
    CzRow slack;        /* of both sides; CZ_NEVER if none [m] */
} CzDrawGearRows;

typedef struct CzSideBufferRows {
    CzRow exists; /* 1 when both sides have side buffers, or one strikes the other's bare end */
    CzPairRows contact; /* plates, on the end masses */
    CzRow compliance;   /* sum of 1/stiffness of the crash elements of both sides [m/N] */
    CzRow friction;     /* [-] */
    struct {
        CzBufferRows buffer;
        CzRow tube_rate;    /* rate factor of the crash element [s/m] */
        CzRow speed_factor; /* of an anti-climber in its place, over reference speed [s/m] */
    } side[2];
} CzSideBufferRows;

typedef struct CzParameters {
    struct {
        CzInverse body, end[2], bogie, wheelset;
    } inverse;
    CzRow slaved_ends[2]; /* 1 when an end has no mass of its own and moves with the body */
    CzRow rises;          /* 1 when the body moves vertically */
    CzEndRows end[2];
    CzRow bogie_x; /* half the bogie spacing [m] */
    CzRow axle_x;  /* half the axle spacing [m] */
    CzRow axle_z;  /* wheel radius less bogie cg height [m] */
    struct {
        CzRow body_z;  /* link height less body cg height [m] */
        CzRow bogie_z; /* link height less bogie cg height [m] */
        CzStrutRows strut;
    } link;
    CzStrutRows axle_guidance;
    CzSuspensionRows secondary; /* per bogie */
    CzRow secondary_preload[2]; /* static load [N]; CZ_NEVER when the spring carries tension */
    CzSuspensionRows primary;   /* per axle */
    CzRow primary_preload[4];   /* static load [N]; CZ_NEVER when the spring carries tension */
    CzWheelRows wheel;
    CzDragRows drag;
    CzRow
        tilts; /* of the interface: 1 where one of its cars can move vertically and pitch and the
                  other is not a wall: lines and faces tilt, couplers are struts; 0 elsewhere: every
                  force acts along the track, and a wall is a smooth vertical plane, a mirror */
    CzRow underframe_x[2]; /* of the interface: where heights of the underframes are compared, from
                              the centres of gravity of the bodies [m] */
    CzCouplerRows coupler;
    CzFaceRows face;
    CzSuperstructureRows superstructure;
    CzDrawGearRows draw_gear;
    CzSideBufferRows side_buffers;
} CzParameters;

/* A parameter by its name, such as CZ_PARAMETER(end[0].crush.damping). */
typedef int CzParameter;
#define CZ_PARAMETER(member) CZ_ROW_OF(CzParameters, member)
enum { CZ_N_PARAMETER = CZ_ROWS_IN(CzParameters) };

#endif
