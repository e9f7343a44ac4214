/* The moving part of a run: state, memory, work and extremes of all lanes, and the force
 * evaluation.
 *
 * Lanes stand in blocks of CZ_LANE_BLOCK, and a block holds all of its rows. One step is: the
 * integrator advances position and velocity, the evaluation turns them into accelerations and the
 * next memory, the commit accepts them.
 */
#ifndef CZ_DYNAMICS_DYNAMICS_H
#define CZ_DYNAMICS_DYNAMICS_H

#include <stdbool.h>

#include "base/arena.h"
#include "dynamics/budget.h"
#include "dynamics/track.h"
#include "dynamics/track_elements.h"
#include "model/co_running.h"
#include "model/lanes.h"

typedef enum CzMemory {
#define CZ_MEMORY(name, unit, doc) CZ_M_##name,
#include "dynamics/memory.def"
#undef CZ_MEMORY
    CZ_N_MEMORY
} CzMemory;

typedef enum CzLedger {
#define CZ_LEDGER(name, class, doc) CZ_L_##name,
#include "dynamics/ledger.def"
#undef CZ_LEDGER
    CZ_N_LEDGER
} CzLedger;

typedef enum CzExtreme {
#define CZ_EXTREME(name, start, doc) CZ_E_##name,
#include "dynamics/extremes.def"
#undef CZ_EXTREME
    CZ_N_EXTREME
} CzExtreme;

/* Numbers derived from the parameters once: divisions and roots that would cost as much as a law.
 */
typedef enum CzConstant {
#define CZ_CONSTANT(name, doc) CZ_C_##name,
#include "dynamics/constants.def"
#undef CZ_CONSTANT
    CZ_N_CONSTANT
} CzConstant;

/* Rows of the state: the degrees of freedom, and one row whose velocity is the impulse of external
 * forces [N s]. */
enum { CZ_ROW_IMPULSE = CZ_N_DOF, CZ_N_ROW };

/* Values between the passes that others may look at after an evaluation. */
typedef enum CzScratch {
#define CZ_SCRATCH(name, doc) CZ_S_##name,
#include "dynamics/scratch.def"
#undef CZ_SCRATCH
    CZ_N_SCRATCH
} CzScratch;

/* One quantity in the lanes of a block. */
typedef double CzRow[CZ_LANE_BLOCK];

#define CZ_FALLING (-1.0) /* slope below which a curve falls, others are level [N/m] (ours) */

/* A curve in the lanes of a block, without the kinks that change no lane. */
typedef struct CzBlockCurve {
    _Alignas(64) CzRow start; /* value at 0 [N] */
    CzRow usable;             /* stroke at which it bottoms out [m] */
    int n_kink;
    int falls;         /* some lane has a falling part */
    int is_there;      /* some lane's value is below CZ_NEVER: a plastic member can flow */
    const CzRow *kink; /* place [m] and change of slope [N/m], in turn (2 n_kink) */
} CzBlockCurve;

/* Everything that a step reads and writes in CZ_LANE_BLOCK neighbouring lanes. One piece of memory,
 * so that a row's address is the block's plus a constant and a block stays in the first cache. */
typedef struct CzBlock {
    _Alignas(64) CzRow position[CZ_N_ROW]; /* displacement from rest [m, rad]; the integrator's */
    CzRow velocity[CZ_N_ROW];              /* [m/s, rad/s]; the integrator's */
    CzRow acceleration[CZ_N_ROW];          /* [m/s2, rad/s2]; of the last evaluation */
    CzRow last_acceleration[CZ_N_ROW];     /* of the evaluation before; the integrator's */
    CzRow force[CZ_N_DOF];                 /* generalised forces of the last evaluation */
    CzRow scratch[CZ_N_SCRATCH];           /* values between the passes of an evaluation */
    CzRow work[CZ_N_LEDGER];               /* committed [J] */
    CzRow extreme[CZ_N_EXTREME];           /* committed */
    CzRow parameter[CZ_N_PARAMETER];       /* the lanes' own */
    CzRow constant[CZ_N_CONSTANT];         /* numbers derived from the parameters once */
    CzRow rail[8];                         /* co-running track: its mode under each axle */
    CzRow rail_rest_energy;                /* of the track under each car at t = 0 [J] */
    CzRow memories[2][CZ_N_MEMORY];        /* for `memory` and `next_memory` to swap */
    CzRow powers[2][CZ_N_LEDGER];          /* for `power` and `last_power` to swap */
    CzBlockCurve curve[CZ_N_CURVE];
    int has_limp_end[2];    /* some lane's side A, B has a crush zone without end mass */
    CzRow end_peak_at[2];   /* shortening at which `end_peak` was taken, NaN at the start */
    CzRow end_peak[2];      /* backbone force of the rear and front crush zone there [N] */
    CzRow coupler_reach;    /* closure up to which resting couplers do nothing [m] */
    CzRow face_reach;       /* the same of the faces */
    int releases;           /* a shear-off let go in the last evaluation */
    int falls;              /* a strength fell in the step of the chain at hand */
    int couplers_rest;      /* the last evaluation of the couplers changed nothing */
    int faces_rest;         /* so did that of the faces */
    int leaves_nothing_out; /* evaluates couplers and faces even where that changes nothing: tests
                               compare with it */
    CzBudgetRows *budget;   /* notes of where forces come from; NULL when nobody asks */
    CzRow *memory;          /* committed (CZ_N_MEMORY) */
    CzRow *next_memory;     /* of the last evaluation (CZ_N_MEMORY) */
    CzRow *power;           /* of the last evaluation [W] (CZ_N_LEDGER) */
    CzRow *last_power;      /* committed (CZ_N_LEDGER) */
} CzBlock;

/* The co-running track's one mode for a step size; the forces of steps as in track_motion.h. */
typedef struct CzCoRunningStep {
    CzComplex flight, kick; /* exp(lambda h); state per force */
    CzComplex rest;         /* state per force at rest */
    CzComplex now, past;    /* deflection per state, now and half a step ago */
    CzComplex past_rate;    /* rate half a step ago */
    double flexibility;     /* beside the mode [m/N] */
    CzCoRunning part;
} CzCoRunningStep;

typedef struct CzDynamics {
    const CzLanes *lanes; /* borrowed */
    int n_block;
    CzBlock *block; /* (n_block), and one more of zeros that stands for all lanes beyond them */
    /* What lies under each lane; at most one of them is there. */
    CzTrackMotion *track;
    CzElements *elements;
    const CzCoRunningStep *co_running;
} CzDynamics;

/* Evaluates accelerations, next memory and power at the current position and velocity. `step` is
 * the time since the memory was committed [s]. */
typedef void CzEvaluate(CzDynamics *dynamics, double step);

/* Accepts the evaluation: memory, work over the step, extremes at `time`. */
typedef void CzCommit(CzDynamics *dynamics, double step, double time);

/* Advances position and velocity by one step of the two-step scheme; `first` marks the first step.
 */
typedef void CzAdvance(CzDynamics *dynamics, double step, int first);

/* All three in turn: the same bits in one way through the memory. */
typedef void CzStep(CzDynamics *dynamics, double step, int first, double time);

/* One compiled copy of the kernel. */
typedef struct CzKernel {
    const char *isa;
    CzAdvance *advance;
    CzEvaluate *evaluate;
    CzCommit *commit;
    CzStep *step;
} CzKernel;

/* The kernel for this processor ("auto" or NULL), or the copy of that name; NULL when the build or
 * the processor has none. */
const CzKernel *cz_kernel(const char *isa);

/* State at rest with the lanes' start velocities; NULL when there is no memory. */
CzDynamics *cz_dynamics_create(const CzLanes *lanes, CzArena *arena);

/* Lays a track under every car with wheels, at rest under its static loads, for steps of `step`
 * seconds; before the first evaluation. False when there is no memory. */
bool cz_dynamics_lay_track(CzDynamics *dynamics, const CzTrackModes *modes, CzTrack kind,
                           double step, CzArena *arena);

/* Kinetic and elastic energy of the track under a car, half a step ago [J]. */
double cz_dynamics_track_energy(const CzDynamics *dynamics, size_t lane);

/* For a solver that carries the track's states itself (track.h): after an evaluation, the rates of
 * the states under one car, and the track's part of the powers. The track is `modal`, laid for a
 * step of 0.
 */
void cz_dynamics_track_rate(CzDynamics *dynamics, size_t lane, double *rate);

/* The block of a lane; its place there is lane % CZ_LANE_BLOCK. */
static inline CzBlock *cz_block_of(const CzDynamics *dynamics, size_t lane) {
    return &dynamics->block[lane / CZ_LANE_BLOCK];
}

/* A row of the model's lanes. */
static inline double *cz_row(double *array, size_t stride, int row) {
    return array + (size_t)row * stride;
}

#endif
