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

static double value(const Design *design, int car, CzParameter parameter) {
    return cz_lane_value(design->lanes, car * design->lanes->n_design + design->number, parameter);
}

/* A bogie's secondary suspension in series with its two primaries. */
static CzChainCar chain_car(const Design *design, int car) {
    if (design->model->car[car].model != CZ_MODEL_FULL)
        return (CzChainCar){0};
    const double secondary = value(design, car, CZ_PARAMETER(secondary.stiffness));
    const double primaries = 2.0 * value(design, car, CZ_PARAMETER(primary.stiffness));
    return (CzChainCar){.spring = secondary * primaries / (secondary + primaries),
                        .half_spacing = value(design, car, CZ_PARAMETER(bogie_x))};
}

static CzChainPivot chain_pivot(const Design *design, int interface, int side) {
    const bool is_front = side == CZ_SIDE_A; /* of its car */
    const int car = interface + side, end = is_front ? CZ_FRONT : CZ_REAR;
    const double outwards = is_front ? 1.0 : -1.0;
    const double arm = outwards * value(design, interface,
                                        is_front ? CZ_PARAMETER(coupler.pivot.x[0])
                                                 : CZ_PARAMETER(coupler.pivot.x[1]));
    CzChainPivot pivot = {.hinge = value(design, interface,
                                         CZ_PARAMETER(coupler.side[side].hinge_vertical.stiffness)),
                          .body_arm = arm};
    if (value(design, interface, CZ_PARAMETER(coupler.side[side].on_end)) > 0.0) {
        pivot.body_arm = outwards * value(design, car, CZ_PARAMETER(end[end].x));
        pivot.end_arm = arm;
        pivot.end_guide = value(design, car, CZ_PARAMETER(end[end].guide_vertical.stiffness));
        pivot.end_fold = value(design, car, CZ_PARAMETER(end[end].fold_pitch.stiffness));
    }
    return pivot;
}

static CzChainStrut chain_strut(const Design *design, int interface) {
    if (!(value(design, interface, CZ_PARAMETER(coupler.exists)) > 0.0))
        return (CzChainStrut){0};
    return (CzChainStrut){.length = value(design, interface, CZ_PARAMETER(coupler.length)),
                          .tilts = value(design, interface, CZ_PARAMETER(tilts)) > 0.0,
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
