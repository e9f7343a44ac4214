/* A model stepped by the test, which may change the lanes before the start and read every force.
 */
#ifndef CZ_TESTS_PHYSICS_MOTION_H
#define CZ_TESTS_PHYSICS_MOTION_H

#include "physics/collision.h"

#include "dynamics/dynamics.h"
#include "model/model.h"

typedef struct {
    Collision collision; /* problem and model only */
    CzArena arena;
    CzLanes *lanes;
    CzDynamics *dynamics;
    const CzKernel *kernel;
    double step; /* [s] */
    long n_step;
} Motion;

/* The lanes of one design, filled from the file. */
static inline Motion motion_open(const char *file, const char *const *set) {
    Motion motion = {.collision = collision_model(file, set, 0)};
    int n_vehicle = 0;
    const CzVehicle *vehicles = cz_problem_vehicles(motion.collision.problem, &n_vehicle);
    CzError error = {0};
    motion.step = motion.collision.model->time_step;
    motion.kernel = cz_kernel("auto");
    motion.lanes = cz_model_lanes(motion.collision.model, 1, &motion.arena);
    assert_non_null(motion.lanes);
    if (cz_model_fill(motion.collision.model, vehicles, 0, motion.lanes, &error) != CZ_OK)
        fail_msg("%s", error.message);
    return motion;
}

/* The state on its track, not evaluated yet. */
static inline void motion_lay(Motion *motion) {
    motion->dynamics = cz_dynamics_create(motion->lanes, &motion->arena);
    assert_non_null(motion->dynamics);
    const CzTrackModes *track = motion->collision.model->track;
    if (track != NULL)
        assert_true(cz_dynamics_lay_track(motion->dynamics, &track,
                                          (CzTrack)motion->collision.model->simulation->track,
                                          motion->step, &motion->arena));
}

static inline void motion_start(Motion *motion) {
    motion_lay(motion);
    motion->kernel->evaluate(motion->dynamics, motion->step);
    motion->kernel->commit(motion->dynamics, 0.0, 0.0);
}

static inline void motion_advance(Motion *motion) {
    motion->kernel->advance(motion->dynamics, motion->step, motion->n_step == 0);
    motion->n_step++;
}

static inline void motion_evaluate(Motion *motion) {
    motion->kernel->evaluate(motion->dynamics, motion->step);
    motion->kernel->commit(motion->dynamics, motion->step, (double)motion->n_step * motion->step);
}

static inline void motion_close(Motion *motion) {
    cz_arena_free(&motion->arena);
    collision_free(&motion->collision);
}

static inline double *parameter(const Motion *motion, CzParameter which, int car) {
    return cz_lane_parameter(motion->lanes, which, (size_t)car);
}

static inline double *position(const Motion *motion, int dof, int car) {
    return cz_row_of(&cz_block_of(motion->dynamics, (size_t)car)->position, dof) +
           car % CZ_LANE_BLOCK;
}

static inline double *velocity(const Motion *motion, int dof, int car) {
    return cz_row_of(&cz_block_of(motion->dynamics, (size_t)car)->velocity, dof) +
           car % CZ_LANE_BLOCK;
}

static inline double force(const Motion *motion, int dof, int car) {
    return cz_row_of(&cz_block_of(motion->dynamics, (size_t)car)->force, dof)[car % CZ_LANE_BLOCK];
}

static inline double mass(const Motion *motion, int dof, int car) {
    return *cz_lane_mass(motion->lanes, dof, (size_t)car);
}

/* Work that a kind of element has received in the lane of a car [J]. */
static inline double work_at(const Motion *motion, int row, int car) {
    return cz_row_of(&cz_block_of(motion->dynamics, (size_t)car)->work, row)[car % CZ_LANE_BLOCK];
}

static inline double motion_kinetic_energy(const Motion *motion) {
    double energy = 0.0;
    for (int car = 0; car < motion->collision.model->n_car; car++)
        for (int dof = 0; dof < CZ_N_DOF; dof++) {
            const double v = *velocity(motion, dof, car);
            energy += 0.5 * mass(motion, dof, car) * v * v;
        }
    return energy;
}

#endif
