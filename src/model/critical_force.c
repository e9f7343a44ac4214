/* F_crit of every interface of a design: the lanes as a chain of cars and struts. */
#include "base/error.h"
#include "model/fill.h"
#include "model/own_design.h"
#include "model/strut_chain.h"

typedef struct Design {
    const CzModel *model;
    const CzLanes *lanes;
    int number;
} Design;

static CzLane lane_of(const Design *design, int car) {
    return cz_lane_at(design->lanes, (size_t)(car * design->lanes->n_design + design->number));
}

/* A bogie's secondary suspension in series with its two primaries. */
static CzChainCar chain_car(const Design *design, int car) {
    const CzLane at = lane_of(design, car);
    if (design->model->car[car].model != CZ_MODEL_FULL)
        return (CzChainCar){0};
    const double secondary = at.rows->secondary.stiffness[at.i];
    const double primaries = 2.0 * at.rows->primary.stiffness[at.i];
    return (CzChainCar){.spring = secondary * primaries / (secondary + primaries),
                        .half_spacing = at.rows->bogie_x[at.i]};
}

static CzChainPivot chain_pivot(const Design *design, int interface, int side) {
    const CzLane at = lane_of(design, interface), car = lane_of(design, interface + side);
    const CzCouplerRows *rows = &at.rows->coupler;
    const CzEndRows *end = &car.rows->end[side == CZ_SIDE_A ? CZ_FRONT : CZ_REAR];
    const double outwards = side == CZ_SIDE_A ? 1.0 : -1.0;
    const double arm = outwards * rows->pivot.x[side][at.i];
    const double hinge = rows->side[side].hinge_vertical.stiffness[at.i];
    if (!(rows->side[side].on_end[at.i] > 0.0))
        return (CzChainPivot){.hinge = hinge, .body_arm = arm};
    return (CzChainPivot){.hinge = hinge,
                          .body_arm = outwards * end->x[car.i],
                          .end_arm = arm,
                          .end_guide = end->guide_vertical.stiffness[car.i],
                          .end_fold = end->fold_pitch.stiffness[car.i]};
}

static CzChainStrut chain_strut(const Design *design, int interface) {
    const CzLane at = lane_of(design, interface);
    if (!(at.rows->coupler.exists[at.i] > 0.0))
        return (CzChainStrut){0};
    return (CzChainStrut){.length = at.rows->coupler.length[at.i],
                          .tilts = at.rows->tilts[at.i] > 0.0,
                          .pivot = {chain_pivot(design, interface, CZ_SIDE_A),
                                    chain_pivot(design, interface, CZ_SIDE_B)}};
}

static CzStatus find_forces(const Design *design, CzArena *scratch, double *force) {
    const int n_car = design->model->n_car;
    CzChainCar *car = cz_arena_allocate(scratch, (size_t)n_car, sizeof *car);
    CzChainStrut *strut = cz_arena_allocate(scratch, (size_t)n_car, sizeof *strut);
    if (car == NULL || strut == NULL)
        return CZ_STATUS_NO_MEMORY;
    for (int i = 0; i < n_car; i++)
        car[i] = chain_car(design, i);
    for (int i = 0; i < n_car - 1; i++)
        strut[i] = chain_strut(design, i);
    return cz_strut_chain_fold(n_car, car, strut, scratch, force);
}

CzStatus cz_critical_forces(const CzModel *model, const CzLanes *lanes, int design, double *force,
                            CzError *error) {
    CzArena scratch = {0};
    const Design found = {model, lanes, design};
    const CzStatus status = find_forces(&found, &scratch, force);
    cz_arena_free(&scratch);
    if (status != CZ_OK)
        return cz_fail(error, status, "no memory for %d cars", model->n_car);
    return CZ_OK;
}
