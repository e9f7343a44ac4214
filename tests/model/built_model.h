/* A model built from a typed problem, with the lanes of its own design. */
#ifndef CZ_TESTS_BUILT_MODEL_H
#define CZ_TESTS_BUILT_MODEL_H

#include "support/check.h"

#include "model/breakpoints.h"
#include "model/own_design.h"
#include "support/typed_problem.h"

typedef struct Built {
    CzModel *model;
    CzArena arena;
    CzLanes *lanes; /* one design */
} Built;

/* Builds scenario 0; the test fails when that fails. */
static inline Built build_model(struct CzProblem *problem) {
    Built built = {0};
    CzError error = {0};
    if (cz_model_build(problem, 0, &built.model, &error) != CZ_OK)
        fail_msg("%s", error.message);
    built.lanes = cz_model_lanes(built.model, 1, &built.arena);
    assert_non_null(built.lanes);
    if (cz_model_fill(built.model, problem->vehicle, 0, built.lanes, &error) != CZ_OK)
        fail_msg("%s", error.message);
    return built;
}

static inline void free_model(Built *built) {
    cz_arena_free(&built->arena);
    cz_model_free(built->model);
}

static inline double parameter(const Built *built, int car, CzParameter which) {
    return *cz_lane_parameter(built->lanes, which, (size_t)car);
}

static inline double mass_of(const Built *built, int car, int dof) {
    return *cz_lane_mass(built->lanes, dof, (size_t)car);
}

static inline double velocity_of(const Built *built, int car, int dof) {
    return *cz_lane_velocity(built->lanes, dof, (size_t)car);
}

static inline double curve_at(const CzLanes *lanes, size_t lane, CzCurveId id, double x) {
    const CzCurveLanes *curve = &lanes->curve[id];
    double value = curve->start[lane];
    for (int i = 0; i < curve->n_breakpoint; i++) {
        const size_t slot = (size_t)i * lanes->stride + lane;
        value += curve->slope_change[slot] * fmax(x - curve->at[slot], 0.0);
    }
    return value;
}

#endif
