/* The moving part of a run: state, memory, work and extremes of all lanes, and the force
 * evaluation.
 *
 * Everything is [quantity][lane] with the row length of the model's lanes. One step is: the
 * integrator advances position and velocity, cz_dynamics_evaluate turns them into accelerations and
 * the next memory, cz_dynamics_commit accepts them.
 */
#ifndef CZ_DYNAMICS_DYNAMICS_H
#define CZ_DYNAMICS_DYNAMICS_H

#include "base/arena.h"
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

typedef struct CzDynamics CzDynamics;
struct CzDynamics {
    const CzLanes *lanes; /* borrowed */
    size_t stride;
    double *position;     /* displacement from rest [m, rad] (CZ_N_ROW x stride); written by the
                             integrator */
    double *velocity;     /* [m/s, rad/s] (CZ_N_ROW x stride); written by the integrator */
    double *acceleration; /* [m/s2, rad/s2] (CZ_N_ROW x stride); of the last evaluation */
    double *last_acceleration; /* of the evaluation before; the integrator's (CZ_N_ROW x stride) */
    double *memory;            /* committed (CZ_N_MEMORY x stride) */
    double *next_memory;       /* of the last evaluation (CZ_N_MEMORY x stride) */
    double *power;             /* of the last evaluation [W] (CZ_N_LEDGER x stride) */
    double *last_power;        /* committed (CZ_N_LEDGER x stride) */
    double *work;              /* committed [J] (CZ_N_LEDGER x stride) */
    double *extreme;           /* committed (CZ_N_EXTREME x stride) */
    double *force;             /* generalised forces of the last evaluation (CZ_N_DOF x stride) */
    double *scratch;   /* values between the passes of an evaluation (CZ_N_SCRATCH x stride) */
    double *constant;  /* numbers derived from the parameters once (CZ_N_CONSTANT x stride) */
    int n_block;       /* blocks of CZ_LANE_BLOCK lanes */
    CzDynamics *block; /* the same arrays seen from the first lane of each block (n_block) */
};

/* Values between the passes that others may look at after an evaluation. */
typedef enum CzScratch {
#define CZ_SCRATCH(name, doc) CZ_S_##name,
#include "dynamics/scratch.def"
#undef CZ_SCRATCH
    CZ_N_SCRATCH
} CzScratch;

/* Evaluates accelerations, next memory and power at the current position and velocity. `step` is
 * the time since the memory was committed [s]. */
typedef void CzEvaluate(CzDynamics *dynamics, double step);

/* Accepts the evaluation: memory, work over the step, extremes at `time`. */
typedef void CzCommit(CzDynamics *dynamics, double step, double time);

/* Advances position and velocity by one step of the two-step scheme; `first` marks the first step.
 */
typedef void CzAdvance(CzDynamics *dynamics, double step, int first);

/* One compiled copy of the kernel. */
typedef struct CzKernel {
    const char *isa;
    CzAdvance *advance;
    CzEvaluate *evaluate;
    CzCommit *commit;
} CzKernel;

/* The kernel for this processor ("auto" or NULL), or the copy of that name; NULL when the build or
 * the processor has none. */
const CzKernel *cz_kernel(const char *isa);

/* State at rest with the lanes' start velocities; NULL when there is no memory. */
CzDynamics *cz_dynamics_create(const CzLanes *lanes, CzArena *arena);

/* The arrays seen from a block's first lane, those that a commit swaps included. */
static inline CzDynamics *cz_block(const CzDynamics *dynamics, int index) {
    CzDynamics *block = &dynamics->block[index];
    const size_t base = (size_t)index * CZ_LANE_BLOCK;
    block->memory = dynamics->memory + base;
    block->next_memory = dynamics->next_memory + base;
    block->power = dynamics->power + base;
    return block;
}

/* A row of an array. */
static inline double *cz_row(double *array, size_t stride, int row) {
    return array + (size_t)row * stride;
}

#endif
