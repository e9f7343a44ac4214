/* Builds the model of one scenario: its cars along +x, parameters and time step. */
#include "model/build.h"
#include "base/error.h"
#include "model/curve_sizes.h"
#include "model/own_design.h"
#include "model/receptance.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define LONGEST_STEP 1e-4  /* default step [s] (ours) */
#define SHARE_OF_BOUND 0.5 /* default step over the smallest bound (ours) */
#define SHORTEST_HOLD 0.02 /* without full cars [s] (ours) */

static double given_or(double value, double otherwise) {
    return isnan(value) ? otherwise : value;
}

/* ---- what collides ---- */

/* Defaults of an absent scenario and an absent simulation record. */
static const CzScenario default_scenario = {.name = "collision",
                                            .speed = NAN,
                                            .partner_speed = NAN,
                                            .height_offset = NAN,
                                            .brake_ratio = NAN,
                                            .partner_brake_ratio = NAN,
                                            .friction = NAN,
                                            .mass_factor = 1.0,
                                            .reserves = true,
                                            .duration = NAN};
static const CzSimulation default_simulation = {
    .track = CZ_TRACK_RECEPTANCE,
    .time_step = NAN,
    .duration = NAN,
    .longest = 20.0,
    .output_step = 1e-3,
    .adhesion = {.sliding_friction = NAN, .peak_creepage = 0.01, .fall_speed = 3.0}};

static CzStatus choose_scenario(CzModel *model, const CzInput *input, int scenario,
                                CzError *error) {
    const bool has_default = input->n_scenarios == 0 && scenario == 0;
    if (!has_default && (scenario < 0 || scenario >= input->n_scenarios))
        return cz_fail(error, CZ_STATUS_INPUT, "there is no scenario number %d", scenario);
    model->scenario = has_default ? &default_scenario : &input->scenarios[scenario];
    model->simulation = input->simulation.given ? &input->simulation : &default_simulation;
    const CzScenario *chosen = model->scenario;
    model->friction = given_or(chosen->friction, given_or(model->simulation->adhesion.friction, 0));
    model->duration = given_or(chosen->duration, model->simulation->duration);
    model->longest = model->simulation->longest;
    return CZ_OK;
}

static int find_train(const CzInput *input, const char *name) {
    for (int train = 0; train < input->n_trains; train++)
        if (strcmp(input->trains[train].name, name) == 0)
            return train;
    return -1;
}

static CzStatus choose_trains(CzModel *model, const CzInput *input, CzError *error) {
    const CzTexts *names = &model->scenario->trains;
    if (input->n_trains < 2)
        return cz_fail(error, CZ_STATUS_INPUT, "a collision needs two trains; the file has %d",
                       input->n_trains);
    model->train[0] = 0;
    model->train[1] = 1;
    if (names->n_text == 0)
        return CZ_OK;
    for (int i = 0; i < 2 && names->n_text == 2; i++) {
        model->train[i] = find_train(input, names->text[i]);
        if (model->train[i] < 0) {
            cz_fail(error, CZ_STATUS_INPUT,
                    "scenario '%s' names train '%s', which is not in the file",
                    model->scenario->name, names->text[i]);
            cz_problem_place(model->problem, names, error);
            return CZ_STATUS_INPUT;
        }
    }
    if (names->n_text == 2 && model->train[0] != model->train[1])
        return CZ_OK;
    cz_fail(error, CZ_STATUS_INPUT, "scenario '%s' must name two different trains",
            model->scenario->name);
    cz_problem_place(model->problem, names, error);
    return CZ_STATUS_INPUT;
}

/* ---- cars and interfaces ---- */

static bool has_stops(const CzSuspension *suspension) {
    return !isnan(suspension->bump_gap) && !isnan(suspension->lift_gap);
}

/* A train's brake with the brake ratio of the scenario. */
static void set_brake(const CzModel *model, CzCar *car, const CzTrain *train) {
    const double own =
        car->train == 0 ? model->scenario->brake_ratio : model->scenario->partner_brake_ratio;
    if (!train->brake.given)
        return;
    car->brake = &train->brake;
    car->brake_ratio = given_or(own, train->brake.ratio);
}

static void set_car(const CzModel *model, CzCar *car, const CzTrain *train, int index) {
    const CzVehicle *vehicle = &train->vehicles[index];
    const double own = car->train == 0 ? model->scenario->speed : model->scenario->partner_speed;
    int n_vehicle;
    if (vehicle->name != NULL)
        snprintf(car->name, sizeof car->name, "%s", vehicle->name);
    else
        snprintf(car->name, sizeof car->name, "%s%d", train->name, index + 1);
    car->vehicle = (int)(vehicle - cz_problem_vehicles(model->problem, &n_vehicle));
    car->model = (CzVehicleModel)vehicle->model;
    car->speed = given_or(own, train->speed);
    car->has_stops = vehicle->bogie.given && has_stops(&vehicle->bogie.primary) &&
                     has_stops(&vehicle->bogie.secondary);
    set_brake(model, car, train);
}

static CzStatus check_car(const CzModel *model, const CzCar *car, const CzTrain *train,
                          CzError *error) {
    if (car->model != CZ_MODEL_FIXED || car->speed == 0.0)
        return CZ_OK;
    cz_fail(error, CZ_STATUS_INPUT, "car %s is fixed, but its train moves at %g m/s", car->name,
            car->speed);
    cz_problem_place(model->problem, &train->speed, error);
    return CZ_STATUS_INPUT;
}

static CzStatus place_cars(CzModel *model, const CzInput *input, CzError *error) {
    const CzTrain *behind = &input->trains[model->train[0]];
    const CzTrain *ahead = &input->trains[model->train[1]];
    if (behind->n_vehicles < 1 || ahead->n_vehicles < 1)
        return cz_fail(error, CZ_STATUS_INPUT, "train '%s' has no vehicles",
                       behind->n_vehicles < 1 ? behind->name : ahead->name);
    model->n_car = behind->n_vehicles + ahead->n_vehicles;
    model->colliding = behind->n_vehicles - 1;
    const size_t n = (size_t)model->n_car;
    model->car = cz_arena_allocate(&model->arena, n, sizeof *model->car);
    model->interface_name = cz_arena_allocate(&model->arena, n - 1, sizeof *model->interface_name);
    if (model->car == NULL || model->interface_name == NULL)
        return cz_fail(error, CZ_STATUS_NO_MEMORY, "no memory for %d cars", model->n_car);

    for (int i = 0; i < model->n_car; i++) {
        CzCar *car = &model->car[i];
        car->train = i > model->colliding;
        const CzTrain *train = car->train == 0 ? behind : ahead;
        set_car(model, car, train, car->train == 0 ? i : i - behind->n_vehicles);
        CZ_TRY(check_car(model, car, train, error));
        if (i > 0)
            snprintf(model->interface_name[i - 1], sizeof model->interface_name[i - 1], "%s-%s",
                     model->car[i - 1].name, car->name);
    }
    if (model->car[model->colliding].model == CZ_MODEL_FIXED &&
        model->car[model->colliding + 1].model == CZ_MODEL_FIXED)
        return cz_fail(error, CZ_STATUS_INPUT, "interface %s is between two fixed vehicles",
                       model->interface_name[model->colliding]);
    return CZ_OK;
}

static CzStatus find_perturbed(CzModel *model, CzError *error) {
    const char *name = model->scenario->perturbed_interface;
    model->perturbed = -1;
    if (name == NULL)
        return CZ_OK;
    if (strcmp(name, CZ_FIRST_COUPLED) == 0)
        model->perturbed = model->colliding - 1; /* -1: the train has one car */
    for (int i = 0; i < model->n_car - 1; i++)
        if (i != model->colliding && strcmp(model->interface_name[i], name) == 0)
            model->perturbed = i;
    if (model->perturbed >= 0)
        return CZ_OK;
    cz_fail(error, CZ_STATUS_INPUT,
            "scenario '%s' perturbs '%s', which is not an inner interface of its trains",
            model->scenario->name, name);
    cz_problem_place(model->problem, &model->scenario->perturbed_interface, error);
    return CZ_STATUS_INPUT;
}

/* ---- track ---- */

/* First to last wheel of the longest car with wheels [m]; 0 without any. */
static double longest_span(const CzModel *model, const CzVehicle *vehicles) {
    double span = 0.0;
    for (int car = 0; car < model->n_car; car++) {
        const CzVehicle *vehicle = &vehicles[model->car[car].vehicle];
        if (model->car[car].model == CZ_MODEL_FULL)
            span = fmax(span, vehicle->bogie_spacing + vehicle->bogie.axle_spacing);
    }
    return span;
}

static bool is_fitted(const CzTrackModes *modes, double axle_spacing) {
    for (int i = 0; i < modes->n_receptance; i++)
        if (modes->receptance[i].axle_spacing == axle_spacing)
            return true;
    return false;
}

/* The receptance under the bogies of all cars with wheels. */
static CzStatus fit_receptances(CzModel *model, const CzVehicle *vehicles, CzTrackModes *modes,
                                CzError *error) {
    modes->receptance =
        cz_arena_allocate(&model->arena, (size_t)model->n_car, sizeof *modes->receptance);
    if (modes->receptance == NULL)
        return cz_no_memory(error, "the track's receptance");
    for (int car = 0; car < model->n_car; car++) {
        const double axle_spacing = vehicles[model->car[car].vehicle].bogie.axle_spacing;
        if (model->car[car].model != CZ_MODEL_FULL || is_fitted(modes, axle_spacing))
            continue;
        CZ_TRY(cz_receptance_fit(modes, axle_spacing, &model->arena,
                                 &modes->receptance[modes->n_receptance], error));
        modes->n_receptance++;
    }
    return CZ_OK;
}

/* A problem with track `receptance` is rejected when the track cannot be fitted; searches with
 * other tracks then use the track of the file. */
static CzStatus fit_if_possible(CzModel *model, const CzVehicle *vehicles, CzTrackModes *modes,
                                CzError *error) {
    CzError failure = {0};
    const CzStatus status = fit_receptances(model, vehicles, modes, &failure);
    if (status == CZ_STATUS_INPUT && model->simulation->track != CZ_TRACK_RECEPTANCE) {
        modes->n_receptance = 0;
        return CZ_OK;
    }
    if (status == CZ_STATUS_INPUT)
        cz_problem_place(model->problem, &cz_problem_input(model->problem)->track, &failure);
    if (status != CZ_OK && error != NULL)
        *error = failure;
    return status;
}

/* Models whose track may be used, if it is the same. */
typedef struct Beside {
    int n;
    CzModel *const *model;
} Beside;

/* Whether a track with its receptances is the one that the model would build. */
static bool is_same_track(const CzTrackModes *track, const CzModel *model,
                          const CzVehicle *vehicles, double span) {
    const CzRoadbed *roadbed = &cz_problem_input(model->problem)->track;
    const CzTrackOptions options = cz_track_options_default(span);
    const CzSeats seats = cz_seats(roadbed, options.n_rail);
    bool is_same = track->span == span && track->nodes == roadbed->nodes_per_bay &&
                   memcmp(&track->seats, &seats, sizeof seats) == 0;
    for (int car = 0; car < model->n_car; car++)
        is_same &= model->car[car].model != CZ_MODEL_FULL ||
                   is_fitted(track, vehicles[model->car[car].vehicle].bogie.axle_spacing);
    return is_same;
}

static CzStatus build_track(CzModel *model, const CzInput *input, const CzVehicle *vehicles,
                            const Beside *beside, CzError *error) {
    const double span = longest_span(model, vehicles);
    if (model->simulation->track == CZ_TRACK_RIGID || span == 0.0)
        return CZ_OK;
    for (int i = beside->n - 1; i >= 0 && model->track == NULL; i--)
        if (beside->model[i] != NULL && beside->model[i]->track != NULL &&
            is_same_track(beside->model[i]->track, model, vehicles, span))
            model->track = beside->model[i]->track;
    if (model->track != NULL)
        return CZ_OK;
    const CzTrackOptions options = cz_track_options_default(span);
    CzTrackModes *modes = NULL;
    CZ_TRY(cz_track_build(&input->track, &options, &model->arena, &modes, error));
    CZ_TRY(fit_if_possible(model, vehicles, modes, error));
    model->track = modes;
    return CZ_OK;
}

/* ---- step and end of run ---- */

static CzStatus choose_step(CzModel *model, CzError *error) {
    const double own = model->simulation->time_step;
    const double smallest = model->n_bound > 0 ? model->bound[0].bound : LONGEST_STEP;
    model->time_step = given_or(own, fmin(LONGEST_STEP, SHARE_OF_BOUND * smallest));
    if (isnan(own) || own <= smallest || model->n_bound == 0)
        return CZ_OK;
    cz_fail(error, CZ_STATUS_INPUT,
            "the time step of %g ms is too long: the largest stable step of %s is %g ms", own * 1e3,
            model->bound[0].element, smallest * 1e3);
    cz_problem_place(model->problem, &model->simulation->time_step, error);
    return CZ_STATUS_INPUT;
}

static void choose_hold(CzModel *model) {
    model->hold = SHORTEST_HOLD;
    for (int car = 0; car < model->n_car; car++)
        if (model->properties[car].pitch_frequency > 0.0)
            model->hold = fmax(model->hold, 1.0 / model->properties[car].pitch_frequency);
}

/* Computes properties and bounds from the lanes of the problem's own design. */
static CzStatus look_at_own_design(CzModel *model, const CzVehicle *vehicles, CzArena *scratch,
                                   CzError *error) {
    CzLanes *lanes = cz_model_lanes(model, 1, scratch);
    if (lanes == NULL)
        return cz_no_memory(error, "the model");
    CZ_TRY(cz_model_fill(model, vehicles, 0, lanes, error));
    model->has = lanes->has;
    CZ_TRY(cz_model_find_properties(model, lanes, error));
    CZ_TRY(cz_model_find_bounds(model, lanes, error));
    CZ_TRY(choose_step(model, error));
    choose_hold(model);
    return CZ_OK;
}

static CzStatus build(CzModel *model, int scenario, const CzVehicle *vehicles, const Beside *beside,
                      CzError *error) {
    const CzInput *input = cz_problem_input(model->problem);
    CZ_TRY(choose_scenario(model, input, scenario, error));
    CZ_TRY(choose_trains(model, input, error));
    CZ_TRY(place_cars(model, input, error));
    CZ_TRY(find_perturbed(model, error));
    CZ_TRY(build_track(model, input, vehicles, beside, error));
    cz_model_size_curves(model, vehicles);
    CzArena scratch = {0};
    const CzStatus status = look_at_own_design(model, vehicles, &scratch, error);
    cz_arena_free(&scratch);
    return status;
}

CzStatus cz_model_build_beside(const CzProblem *problem, int scenario, int n, CzModel *const *made,
                               CzModel **model, CzError *error) {
    const Beside beside = {n, made};
    *model = calloc(1, sizeof **model);
    if (*model == NULL)
        return cz_no_memory(error, "the model");
    (*model)->problem = cz_problem_in_scenario(problem, scenario);
    int n_vehicle;
    const CzVehicle *vehicles = cz_problem_vehicles((*model)->problem, &n_vehicle);
    const CzStatus status = build(*model, scenario, vehicles, &beside, error);
    if (status != CZ_OK) {
        cz_model_free(*model);
        *model = NULL;
    }
    return status;
}

CzStatus cz_model_build(const CzProblem *problem, int scenario, CzModel **model, CzError *error) {
    return cz_model_build_beside(problem, scenario, 0, NULL, model, error);
}

bool cz_model_is_same_with(CzModel *model, const CzVehicle *vehicles) {
    const CzInput *input = cz_problem_input(model->problem);
    const Beside beside = {1, &model};
    CzModel probe = {.problem = model->problem};
    const int scenario = input->n_scenarios > 0 ? (int)(model->scenario - input->scenarios) : 0;
    CzError error = {0};
    const bool is_built = build(&probe, scenario, vehicles, &beside, &error) == CZ_OK;
    const bool is_same = is_built && probe.time_step == model->time_step &&
                         probe.hold == model->hold &&
                         memcmp(&probe.has, &model->has, sizeof probe.has) == 0;
    cz_arena_free(&probe.arena);
    return is_same;
}

void cz_model_free(CzModel *model) {
    if (model == NULL)
        return;
    cz_arena_free(&model->arena);
    free(model);
}

/* ---- access ---- */

int cz_model_n_vehicle(const CzModel *model) {
    return model->n_car;
}

const char *cz_model_vehicle_name(const CzModel *model, int vehicle) {
    return model->car[vehicle].name;
}

int cz_model_n_interface(const CzModel *model) {
    return model->n_car - 1;
}

const char *cz_model_interface_name(const CzModel *model, int interface) {
    return model->interface_name[interface];
}

int cz_model_colliding_interface(const CzModel *model) {
    return model->colliding;
}

CzVehicleProperties cz_model_vehicle_properties(const CzModel *model, int vehicle) {
    return model->properties[vehicle];
}

CzInterfaceProperties cz_model_interface_properties(const CzModel *model, int interface) {
    return model->interface_properties[interface];
}

double cz_model_time_step(const CzModel *model) {
    return model->time_step;
}

int cz_model_n_step_bound(const CzModel *model) {
    return model->n_bound;
}

const CzStepBound *cz_model_step_bound(const CzModel *model, int index) {
    return &model->bound[index];
}
