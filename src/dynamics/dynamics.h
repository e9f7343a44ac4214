/* Dynamics of a run: state, memory, work and extremes of all lanes, and the force evaluation.
 *
 * Lanes are in blocks of CZ_LANE_BLOCK, and a block holds all of its rows. One step is: the
 * integrator advances position and velocity, the evaluation turns them into accelerations and the
 * next memory, the commit accepts them.
 */
#ifndef CZ_DYNAMICS_DYNAMICS_H
#define CZ_DYNAMICS_DYNAMICS_H

#include <stdbool.h>

#include "base/arena.h"
#include "dynamics/budget.h"
#include "dynamics/ledger.h"
#include "dynamics/memory.h"
#include "dynamics/published.h"
#include "dynamics/receptance.h"
#include "dynamics/track.h"
#include "dynamics/track_elements.h"
#include "model/lanes.h"

/* Constants derived from the parameters once, because their divisions and roots cost as much as a
 * law.
 */
typedef struct CzConstants {
    CzRow static_load[4];   /* normal force of the wheelset at rest, by the law itself [N] */
    CzRow wheel_rest[4];    /* approach of wheel and rail at rest less the deflection of the rail's
                               modes there [m] */
    CzRow creep_compliance; /* 1 / tangential contact stiffness; 0 without wheels [m/N] */
    CzRow brake_compliance; /* 1 / stiffness of a held axle [rad/(N m)] */
    CzRow hinge_compliance[2];  /* 1 / hinge stiffness; 0 for a free pivot [rad/(N m)] */
    CzRow rest_angle_vertical;  /* of the line between the pivots of coupled couplers; 0 for others
                                   [rad] */
    CzRow buffer_compliance[2]; /* 1 / stiffness of the buffer between its curves [m/N] */
    CzRow side_compliance[2];   /* likewise for the side buffers */
    CzRow end_compliance[2];    /* 1 / first unloading stiffness of the crush zone [m/N] */
    CzRow end_second_compliance[2]; /* 1 / its second one */
    CzRow massless_compliance[2];   /* the same of a crush zone without end mass */
    CzRow massless_second_compliance[2];
    CzRow fold_compliance[2]; /* 1 / pitch guidance stiffness [rad/(N m)] */
    CzRow grip_compliance;    /* 1 / vertical stiffness of engaged faces [m/N] */
    CzRow body_mass;          /* 0 of a vehicle that cannot move [kg] */
    CzRow wheelset_inertia;   /* about its axle; 0 without wheels [kg m2] */
    CzRow slaved_end_ahead;   /* 1 where the rear end of the car ahead has no mass of its own */
} CzConstants;
#define CZ_CONSTANT(member) CZ_ROW_OF(CzConstants, member)

/* Cosine and sine of a pitch. */
typedef struct CzTurned {
    CzRow cosine, sine;
} CzTurned;

/* Position and velocity of a body. */
typedef struct CzMotion {
    CzPlane displacement, rate;
    CzTurned turned;
} CzMotion;

/* Motion of the car ahead as an interface reads it, and the forces of the interface on that car. */
typedef struct CzSeen {
    CzMotion body, end; /* its rear end */
} CzSeen;
typedef struct CzPushed {
    CzPlane body, end; /* force and moment */
    CzRow section;     /* force through the section behind the end [N] */
} CzPushed;

/* Impulse of external forces, advanced with the state. */
typedef struct CzImpulse {
    CzRow position, velocity, force, last_force; /* [N s2, N s, N, N] */
} CzImpulse;

/* The rail under a wheelset; all 0 on a rigid track. */
typedef struct CzRailRows {
    CzRow z;    /* deflection of its modes, upwards [m] */
    CzRow past; /* the same half a step ago at the same place, for the work of the wheels; unused on
                   the modal track [m] */
    CzRow slope;             /* change of the deflection along the track [-] */
    CzRow flexibility;       /* immediate deflection per force [m/N] */
    CzRow flexibility_slope; /* its change along the track [1/N] */
} CzRailRows;

#define CZ_FALLING (-1.0) /* below this slope a curve falls, else it is level [N/m] (ours) */

typedef struct CzBreakpoint {
    CzRow at, change; /* stroke [m], change of the slope [N/m] */
} CzBreakpoint;

/* A curve in the lanes of a block, without breakpoints that change the slope in no lane. */
typedef struct CzBlockCurve {
    _Alignas(64) CzRow start; /* value at 0 [N] */
    CzRow usable;             /* stroke at which it bottoms out [m] */
    int n_breakpoint;
    int falls;    /* some lane has a falling part */
    int is_there; /* some lane's value is below CZ_NEVER: a plastic member can crush */
    const CzBreakpoint *breakpoint; /* (n_breakpoint) */
} CzBlockCurve;

/* The curves of a block, named as in CzCurveNames. */
typedef struct CzBlockCurves {
    CzBlockCurve end[2], buffer[2], tube[2], second_tube[2], face[2], massless[2], side_buffer[2],
        side_tube[2];
} CzBlockCurves;
_Static_assert(sizeof(CzBlockCurves) == CZ_N_CURVE * sizeof(CzBlockCurve), "one for each name");

/* Backbone force of a crush zone at its largest shortening, kept while that does not grow. */
typedef struct CzPeak {
    CzRow at;    /* NaN at the start [m] */
    CzRow force; /* [N] */
} CzPeak;

/* Everything that a step reads and writes in CZ_LANE_BLOCK neighbouring lanes. One piece of memory,
 * so that a row's address is the block's plus a constant and a block stays in the first cache. */
typedef struct CzBlock {
    _Alignas(64) CzState position; /* displacement from rest [m, rad]; the integrator's */
    CzState velocity;              /* [m/s, rad/s]; the integrator's */
    CzState acceleration;          /* [m/s2, rad/s2]; of the last evaluation */
    CzState last_acceleration;     /* of the evaluation before; the integrator's */
    CzImpulse impulse;             /* of external forces */
    CzState force;                 /* generalised forces of the last evaluation */
    CzPublished published;         /* by the last evaluation */
    struct {
        CzTurned body, end[2], bogie[2];
    } turned;
    CzSeen ahead;           /* the car ahead */
    CzPushed pushed;        /* forces of the interface on it */
    CzPlane from_behind;    /* forces of the interface behind on the body */
    CzRailRows rail[4];     /* under each wheelset */
    CzPower work;           /* committed [J] */
    CzExtremes extreme;     /* committed */
    CzParameters parameter; /* the lanes' own */
    CzConstants constant;   /* numbers derived from the parameters once */
    CzRow rail_rest_energy; /* of the track under each car at t = 0 [J] */
    CzMemory memories[2];   /* `memory` and `next_memory` point to them in turn */
    CzPower powers[2];      /* `power` and `last_power` point to them in turn */
    CzBlockCurves curve;
    int has_tilts;        /* lines and faces tilt in some lane */
    int can_climb;        /* some lane's faces have ribs, friction or a limited overlap, or tilt */
    int has_shear_off[2]; /* some lane's coupler of side A, B shears off */
    int has_massless[2];  /* some lane's side A, B has a crush zone without end mass */
    CzPeak end_peak[2];   /* of the rear and front crush zone */
    CzRow coupler_reach;  /* closure up to which resting couplers do nothing [m] */
    CzRow face_reach;     /* likewise for the faces */
    int couplers_rest;    /* the last evaluation of the couplers changed nothing */
    int faces_rest;       /* likewise for the faces */
    int has_looked;       /* rows of the cars ahead have been read */
    int leaves_nothing_out; /* evaluates couplers and faces even where that changes nothing, for
                               comparison in tests */
    CzBudgetRows *budget;   /* impulses by the sources of forces; NULL when not requested */
    CzMemory *memory;       /* committed */
    CzMemory *next_memory;  /* of the last evaluation */
    CzPower *power;         /* of the last evaluation [W] */
    CzPower *last_power;    /* committed */
} CzBlock;

typedef struct CzDynamics {
    const CzLanes *lanes;    /* borrowed */
    size_t n_state, n_power; /* numbers of a block's state and powers in use: those of running gear
                                come last and are left out where no car has any */
    int n_block;
    CzBlock *block; /* (n_block), and one more of zeros that represents all lanes beyond them */
    /* Track under each lane; at most one of these is not NULL. */
    CzTrackMotion *track;
    CzElements *elements;
    CzReceptanceMotion *receptance;
} CzDynamics;

/* Evaluates accelerations, next memory and power at the current position and velocity. `step` is
 * the time since the memory was committed [s]. */
typedef void CzEvaluate(CzDynamics *dynamics, double step);

/* Accepts the evaluation: memory, work over the step, extremes at `time`. */
typedef void CzCommit(CzDynamics *dynamics, double step, double time);

/* Advances position and velocity by one step of the two-step scheme; `first` marks the first step.
 */
typedef void CzAdvance(CzDynamics *dynamics, double step, int first);

/* All three in turn, in one pass through the memory; the results are the same to the last bit. */
typedef void CzStep(CzDynamics *dynamics, double step, int first, double time);

/* Sets the states of the tracks of all blocks, one after the other. */
typedef void CzTrackSet(CzDynamics *dynamics, const double *state);

/* After an evaluation, the rates of these states; adds the track's part of the powers. */
typedef void CzTrackRate(CzDynamics *dynamics, double *rate);

/* One compiled copy of the kernel. */
/* Kinetic and elastic energy of the track under each car of a block, half a step ago [J]. */
typedef void CzTrackEnergy(const CzDynamics *dynamics, int block, CzRow energy);

typedef struct CzKernel {
    const char *isa;
    CzAdvance *advance;
    CzEvaluate *evaluate;
    CzCommit *commit;
    CzStep *step;
    CzTrackSet *track_set;
    CzTrackRate *track_rate;
    CzTrackEnergy *track_energy;
} CzKernel;

/* The kernel for this processor ("auto" or NULL), or the copy of that name; NULL when the build or
 * the processor has none. */
const CzKernel *cz_kernel(const char *isa);

/* State at rest with the lanes' start velocities; NULL when there is no memory. */
CzDynamics *cz_dynamics_create(const CzLanes *lanes, CzArena *arena);

/* Lays a track under every car with wheels, at rest under its static loads, for steps of `step`
 * seconds; before the first evaluation. Each design has its own modes (n_design); those of tracks
 * other than `receptance` must be the same for all. False when there is no memory. */
bool cz_dynamics_lay_track(CzDynamics *dynamics, const CzTrackModes *const *modes, CzTrack kind,
                           double step, CzArena *arena);

/* Copies all that a lane has reached to a lane with the same parameters, on a rigid or a receptance
 * track. */
void cz_dynamics_move(CzDynamics *dynamics, size_t lane, const CzDynamics *from, size_t from_lane);

/* For a solver that integrates the track's states itself (track.h), on a `modal` or `receptance`
 * track laid for a step of 0: the number of states under the cars of a block, and the states. The
 * kernel sets them, and finds their rates. */
size_t cz_dynamics_track_n_state(const CzDynamics *dynamics, int block);
void cz_dynamics_track_get_state(const CzDynamics *dynamics, int block, double *state);

/* The block of a lane; its place there is lane % CZ_LANE_BLOCK. */
static inline CzBlock *cz_block_of(const CzDynamics *dynamics, size_t lane) {
    return &dynamics->block[lane / CZ_LANE_BLOCK];
}

#endif
