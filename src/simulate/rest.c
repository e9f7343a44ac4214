/* Static equilibrium of the vehicles of a model. */
#include "simulate/run.h"

#include "base/error.h"
#include "dynamics/equilibrium.h"
#include "problem/problem.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* All members are NaN. */
static CzRest no_rest(void) {
    CzRest rest;
    for (size_t i = 0; i < sizeof rest / sizeof(double); i++)
        ((double *)&rest)[i] = NAN;
    return rest;
}

static CzRest rest_of(const CzEquilibrium *found) {
    CzRest rest = {
        .body_sag = -found->body_z, .body_pitch = found->body_pitch, .residual = found->residual};
    for (int bogie = 0; bogie < 2; bogie++)
        rest.secondary_deflection[bogie] = found->secondary[bogie];
    for (int axle = 0; axle < 4; axle++) {
        rest.axle_load[axle] = found->wheel_load[axle];
        rest.primary_deflection[axle] = found->primary[axle];
        rest.rail_deflection[axle] = found->rail[axle];
        rest.indentation[axle] = found->indentation[axle];
    }
    return rest;
}

/* Names the vehicle of a failure, and the line of its mass in the file. */
static void place_at_mass(const CzModel *model, int vehicle, CzError *error) {
    int n_vehicle;
    char sentence[sizeof error->message];
    const CzStatus status = error->status;
    const CzVehicle *vehicles = cz_problem_vehicles(model->problem, &n_vehicle);
    const CzVehicle *own = &vehicles[model->car[vehicle].vehicle];
    memcpy(sentence, error->message, sizeof sentence);
    snprintf(error->message, sizeof error->message, "%.48s: %.400s", own->name, sentence);
    cz_problem_place(model->problem, &own->mass, error);
    error->status = status;
}

CzStatus cz_rest_of_cars(const CzModel *model, const CzLanes *lanes, CzRest *rest, CzError *error) {
    CzArena arena = {0};
    CzTrackMotion *track =
        model->track != NULL ? cz_track_motion_create(model->track, 0.0, 4, &arena) : NULL;
    CzStatus status =
        model->track != NULL && track == NULL ? cz_no_memory(error, "the track") : CZ_OK;
    for (int car = 0; car < model->n_car && status == CZ_OK; car++) {
        CzEquilibrium found;
        rest[car] = no_rest();
        if (model->car[car].model != CZ_MODEL_FULL)
            continue;
        status = cz_equilibrium_find(lanes, (size_t)car, track, &arena, &found, error);
        if (status == CZ_OK)
            rest[car] = rest_of(&found);
        else if (status == CZ_STATUS_RUN_FAILED && error != NULL)
            place_at_mass(model, car, error);
    }
    cz_arena_free(&arena);
    return status;
}

CzStatus cz_rest_find(const CzModel *model, CzRest *rest, CzError *error) {
    CzArena arena = {0};
    int n_vehicle;
    const CzVehicle *vehicles = cz_problem_vehicles(model->problem, &n_vehicle);
    CzLanes *lanes = cz_model_lanes(model, 1, &arena);
    CzStatus status = lanes != NULL ? cz_model_fill(model, vehicles, 0, lanes, error)
                                    : cz_no_memory(error, "the vehicles");
    if (status == CZ_OK)
        status = cz_rest_of_cars(model, lanes, rest, error);
    cz_arena_free(&arena);
    return status;
}
