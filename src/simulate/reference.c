/* Drives the kernel's evaluation and commit from an adaptive solver. */
#include "simulate/reference.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "model/breakpoints.h"

#define LONGEST_STEP 0.5 /* of the model's step, so that peaks are resolved (ours) */
#define SHORTEST_STEP                                                                              \
    1e-9                   /* smallest step of the laws, for states at the time of the commit [s]  \
                            */
#define VELOCITY_SCALE 1.0 /* [m/s, rad/s] (ours) */
#define DISPLACEMENT_SCALE 0.01 /* [m, rad] (ours) */
#define TRACK_SCALE 10.0  /* of a mode's state, that moves a wheel by 10 mm [sqrt(J s)] (ours) */
#define IMPULSE_SCALE 1e3 /* of external forces [N s] (ours) */
#define SHEARED 1e-4      /* travel at which a shear-off counts as released [m] (ours) */

/* A degree of freedom in its block. */
typedef struct Place {
    double *position, *velocity;
    const double *acceleration;
} Place;

/* A shear-off that has not released yet. */
typedef struct Drop {
    const CzBlock *block;
    int side;    /* of the interface */
    size_t lane; /* within the block */
    bool over;   /* it has been released; its function is 1 from then on */
} Drop;

struct CzReference {
    CzOde ode; /* must be first: the solver passes its address back */
    CzBatch *batch;
    CzSolver *solver;
    size_t n_place;
    Place *place;       /* (n_place); the state is each one's position and velocity in turn */
    double *track_rate; /* of the tracks' states, which follow those of the places, at the last
                           evaluation */
    Drop *drop;         /* (ode.n_drop) */
    double committed;   /* time of the last commit [s] */
    double evaluated;   /* time of the last evaluation [s]; NaN: none since the commit */
    double *at;         /* its state (ode.n_unknown) */
    long n_step;
};

/* ---- state ----------------------------------------------------------------------------------- */

static bool moves(const CzBatch *batch, int row, size_t lane) {
    const CzLanes *lanes = batch->lanes;
    const CzCarEquipment of = cz_car_equipment(lanes, lane);
    return *cz_lane_mass(lanes, row, lane) > 0.0 ||
           (row == CZ_DOF(end[0].x) && of.has_slaved_end[0]) ||
           (row == CZ_DOF(end[1].x) && of.has_slaved_end[1]);
}

/* Lists the degrees of freedom that move and the impulse of each car, with their allowed errors. */
static size_t list_places(const CzBatch *batch, Place *place, double *allowed, double tolerance) {
    size_t n = 0;
    for (int car = 0; car < batch->n_car; car++) {
        const size_t lane = cz_lane(batch, car, 0), i = lane % CZ_LANE_BLOCK;
        CzBlock *block = cz_block_of(batch->dynamics, lane);
        for (int row = 0; row < CZ_N_DOF; row++) {
            if (!moves(batch, row, lane))
                continue;
            allowed[2 * n] = tolerance * DISPLACEMENT_SCALE;
            allowed[2 * n + 1] = tolerance * VELOCITY_SCALE;
            place[n++] =
                (Place){cz_row_of(&block->position, row) + i, cz_row_of(&block->velocity, row) + i,
                        cz_row_of(&block->acceleration, row) + i};
        }
        CzImpulse *impulse = &block->impulse;
        allowed[2 * n] = allowed[2 * n + 1] = tolerance * IMPULSE_SCALE;
        place[n++] = (Place){&impulse->position[i], &impulse->velocity[i], &impulse->force[i]};
    }
    return n;
}

static void get_state(const CzReference *reference, double *state) {
    for (size_t i = 0; i < reference->n_place; i++) {
        state[2 * i] = *reference->place[i].position;
        state[2 * i + 1] = *reference->place[i].velocity;
    }
    const CzDynamics *dynamics = reference->batch->dynamics;
    double *track = state + 2 * reference->n_place;
    for (int block = 0; block < dynamics->n_block; block++) {
        cz_dynamics_track_get_state(dynamics, block, track);
        track += cz_dynamics_track_n_state(dynamics, block);
    }
}

static void set_state(const CzReference *reference, const double *state) {
    for (size_t i = 0; i < reference->n_place; i++) {
        *reference->place[i].position = state[2 * i];
        *reference->place[i].velocity = state[2 * i + 1];
    }
    reference->batch->kernel->track_set(reference->batch->dynamics, state + 2 * reference->n_place);
}

/* Evaluates the laws at a state, unless it is the state of the last evaluation. */
static void evaluate(CzReference *reference, double time, const double *state) {
    const size_t size = reference->ode.n_unknown * sizeof *state;
    if (time == reference->evaluated && memcmp(state, reference->at, size) == 0)
        return;
    set_state(reference, state);
    const double step = fmax(time - reference->committed, SHORTEST_STEP);
    CzDynamics *dynamics = reference->batch->dynamics;
    reference->batch->kernel->evaluate(dynamics, step);
    reference->batch->kernel->track_rate(dynamics, reference->track_rate);
    memcpy(reference->at, state, size);
    reference->evaluated = time;
}

/* ---- functions of the solver ----------------------------------------------------------------- */

static bool rates(CzOde *ode, double time, const double *state, double *rate) {
    CzReference *reference = (CzReference *)ode;
    evaluate(reference, time, state);
    bool is_finite = true;
    for (size_t i = 0; i < reference->n_place; i++) {
        rate[2 * i] = state[2 * i + 1];
        rate[2 * i + 1] = *reference->place[i].acceleration;
        is_finite = is_finite && isfinite(rate[2 * i + 1]);
    }
    const size_t n_vehicle = 2 * reference->n_place;
    memcpy(rate + n_vehicle, reference->track_rate, (ode->n_unknown - n_vehicle) * sizeof *rate);
    return is_finite;
}

static double travel(const Drop *drop) {
    return drop->block->next_memory->coupler.side[drop->side].shear[drop->lane];
}

static void drops(CzOde *ode, double time, const double *state, double *value) {
    CzReference *reference = (CzReference *)ode;
    evaluate(reference, time, state);
    for (int i = 0; i < ode->n_drop; i++)
        value[i] = reference->drop[i].over ? 1.0 : travel(&reference->drop[i]) / SHEARED - 1.0;
}

/* Lists the shear-offs of all interfaces. */
static int list_drops(const CzBatch *batch, Drop *drop) {
    int n = 0;
    for (int i = 0; i < 2 * (batch->n_car - 1); i++) {
        const size_t lane = cz_lane(batch, i / 2, 0);
        if (batch->equipment[lane].side[i % 2].shears_off)
            drop[n++] =
                (Drop){cz_block_of(batch->dynamics, lane), i % 2, lane % CZ_LANE_BLOCK, false};
    }
    return n;
}

/* ---- the run --------------------------------------------------------------------------------- */

/* Allowed local errors of the modes. The solvers use the mean of the squares over all unknowns,
 * which the thousand modes of a track, most of them at rest, must not reduce for the vehicles. */
static void set_allowed(const CzReference *reference, double tolerance, double *allowed) {
    const size_t n = reference->ode.n_unknown, n_vehicle = 2 * reference->n_place;
    const double share = sqrt((double)n_vehicle / (double)n);
    for (size_t i = n_vehicle; i < n; i++)
        allowed[i] = tolerance * TRACK_SCALE;
    for (size_t i = 0; i < n; i++)
        allowed[i] *= share;
}

CzStatus cz_reference_create(CzBatch *batch, CzMethod method, double tolerance, CzReference **made,
                             CzError *error) {
    CzArena *arena = &batch->arena;
    const size_t n_car = (size_t)batch->n_car, most = n_car * (CZ_N_DOF + 1);
    size_t n_track = 0;
    *made = NULL;
    if (batch->dynamics->elements != NULL)
        return cz_fail(
            error, CZ_STATUS_INPUT,
            "the second solver supports the track models rigid, receptance and modal only");
    for (int block = 0; block < batch->dynamics->n_block; block++)
        n_track += cz_dynamics_track_n_state(batch->dynamics, block);
    CzReference *reference = cz_arena_allocate(arena, 1, sizeof *reference);
    Place *place = cz_arena_allocate(arena, most, sizeof *place);
    Drop *drop = cz_arena_allocate(arena, 2 * n_car, sizeof *drop);
    double *allowed = cz_arena_numbers(arena, 2 * most + n_track);
    if (arena->out_of_memory)
        return cz_no_memory(error, "the reference run");
    *reference = (CzReference){.batch = batch,
                               .n_place = list_places(batch, place, allowed, tolerance),
                               .place = place,
                               .drop = drop,
                               .evaluated = NAN};
    const size_t n = 2 * reference->n_place + n_track;
    reference->ode = (CzOde){.n_unknown = n,
                             .rates = rates,
                             .n_drop = list_drops(batch, drop),
                             .drops = drops,
                             .allowed = allowed};
    reference->track_rate = cz_arena_numbers(arena, n_track);
    reference->at = cz_arena_numbers(arena, n);
    double *state = cz_arena_numbers(arena, n);
    if (arena->out_of_memory)
        return cz_no_memory(error, "the reference run");
    set_allowed(reference, tolerance, allowed);
    get_state(reference, state);
    CZ_TRY(cz_solver_create(method, &reference->ode, 0.0, state, LONGEST_STEP * batch->step,
                            &reference->solver, error));
    *made = reference;
    return CZ_OK;
}

void cz_reference_free(CzReference *reference) {
    if (reference != NULL)
        cz_solver_free(reference->solver);
}

CzStatus cz_reference_step(CzReference *reference, double until, CzError *error) {
    CzBatch *batch = reference->batch;
    CzSolverStep step;
    CZ_TRY(cz_solver_advance(reference->solver, until, &step, error));
    evaluate(reference, step.time, step.state);
    batch->kernel->commit(batch->dynamics, step.time - reference->committed, step.time);
    reference->committed = batch->time = step.time;
    reference->evaluated = NAN; /* the same state now belongs to another step */
    reference->n_step++;
    if (!step.at_drop)
        return CZ_OK;
    for (int i = 0; i < reference->ode.n_drop; i++) {
        Drop *drop = &reference->drop[i];
        drop->over =
            drop->over || drop->block->memory->coupler.side[drop->side].shear[drop->lane] >=
                              SHEARED * (1.0 - 1e-9);
    }
    return cz_solver_restart(reference->solver, error);
}

long cz_reference_n_step(const CzReference *reference) {
    return reference->n_step;
}
