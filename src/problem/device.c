/* Finds a device by its part or path, with all its places. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "problem/reading.h"
#include "problem/strokes.h"

/* ---- the record of a stage ---- */

/* Whether a number is in an array of stages. */
static bool is_in(const double *field, const CzStage stages[CZ_MAX_STAGES]) {
    const char *at = (const char *)field, *from = (const char *)stages;
    return at >= from && at < from + CZ_MAX_STAGES * sizeof *stages;
}

static CzPlacedDevice collapsing(const char *what, CzDevice device, double trigger_length) {
    return (CzPlacedDevice){.what = what,
                            .count = device.count,
                            .n_stage = device.n_stages,
                            .stage = device.stages,
                            .most_stages = CZ_MAX_STAGES,
                            .peak = *device.trigger,
                            .peak_key = "trigger_N",
                            .trigger_length = trigger_length};
}

static CzPlacedDevice of_buffer(const char *what, const CzBuffer *buffer, int count) {
    return (CzPlacedDevice){.what = what,
                            .is_loading = true,
                            .count = count,
                            .n_stage = buffer->n_stages,
                            .stage = buffer->stages,
                            .most_stages = CZ_MAX_STAGES,
                            .peak = buffer->preload > 0 ? buffer->preload : NAN,
                            .peak_key = "preload_N"};
}

/* The device of an end that a stage's number belongs to; without stages when there is none. */
static CzPlacedDevice device_of(const CzEnd *end, const double *field) {
    const CzTube *tubes[] = {&end->coupler.tube, &end->coupler.second_tube,
                             &end->side_buffers.tube};
    const CzBuffer *buffer = &end->coupler.buffer, *side = &end->side_buffers.buffer;
    for (int i = 0; i < 3; i++)
        if (is_in(field, tubes[i]->stages)) {
            CzPlacedDevice device =
                collapsing("collapse tube", CZ_DEVICE(tubes[i]), tubes[i]->trigger_length);
            device.count *= i == 2 ? end->side_buffers.count : 1;
            return device;
        }
    if (is_in(field, end->anti_climber.stages))
        return collapsing("anti-climber", CZ_DEVICE(&end->anti_climber),
                          end->anti_climber.trigger_length);
    if (is_in(field, buffer->stages))
        return of_buffer("buffer", buffer, 1);
    if (is_in(field, side->stages))
        return of_buffer("side buffer", side, end->side_buffers.count);
    if (is_in(field, end->stages))
        return (CzPlacedDevice){.what = "end",
                                .is_loading = true,
                                .count = 1,
                                .n_stage = end->n_stages,
                                .stage = end->stages,
                                .most_stages = CZ_MAX_END_STAGES,
                                .peak = NAN};
    return (CzPlacedDevice){0};
}

/* ---- its places ---- */

static bool are_same(double a, double b) {
    return a == b || (isnan(a) && isnan(b));
}

/* Whether two places have one curve. */
static bool are_alike(const CzPlacedDevice *a, const CzPlacedDevice *b) {
    bool are = a->n_stage == b->n_stage && a->count == b->count && a->what == b->what &&
               are_same(a->peak, b->peak) && a->trigger_length == b->trigger_length;
    for (int i = 0; are && i < a->n_stage; i++)
        are = a->stage[i].stroke == b->stage[i].stroke && a->stage[i].force == b->stage[i].force &&
              are_same(a->stage[i].end_force, b->stage[i].end_force);
    return are;
}

/* The end of a vehicle that a target belongs to. */
static const CzEnd *end_of(const CzVehicle *vehicle, const double *field) {
    const char *rear = (const char *)&vehicle->rear, *at = (const char *)field;
    const bool is_rear = at >= rear && at < rear + sizeof vehicle->rear;
    return is_rear ? &vehicle->rear : &vehicle->front;
}

/* Describes the device from its targets, the forces of all stages at all places. */
static CzStatus describe(const CzProblem *problem, const CzTargets *targets, CzPlacedDevice *device,
                         CzError *error) {
    const CzEnd **place = calloc((size_t)targets->n, sizeof *place);
    char path[CZ_PATH_SIZE];
    memcpy(path, device->path, sizeof path);
    if (place == NULL)
        return cz_no_memory(error, "the places of a device");
    int n_place = 0;
    bool are_whole = true;
    for (int i = 0; i < targets->n; i++) {
        const double *field = targets->target[i].field;
        const CzEnd *end = end_of(&problem->vehicle[targets->target[i].vehicle], field);
        const CzPlacedDevice here = device_of(end, field);
        if (i == 0)
            *device = here;
        are_whole &= are_alike(device, &here);
        if (field == &here.stage[0].force)
            place[n_place++] = end;
    }
    device->place = place;
    device->n_place = n_place;
    memcpy(device->path, path, sizeof path);
    if (are_whole && targets->n == n_place * device->n_stage)
        return CZ_OK;
    cz_placed_device_free(device);
    return cz_fail(error, CZ_STATUS_INPUT,
                   "the vehicles that have '%.200s' differ in its curve" CZ_HELP
                   "name one place, such as trains.A.vehicles.A1.front.anti_climber",
                   path);
}

void cz_placed_device_free(CzPlacedDevice *device) {
    free((void *)device->place);
    device->place = NULL;
}

/* ---- names ---- */

/* Devices within a part or record, the part itself first. */
static const char *const inside[] = {"",
                                     ".tube",
                                     ".second_tube",
                                     ".buffer",
                                     ".anti_climber",
                                     ".coupler.tube",
                                     ".coupler.second_tube",
                                     ".coupler.buffer",
                                     ".side_buffers.tube",
                                     ".side_buffers.buffer"};
enum { N_INSIDE = sizeof inside / sizeof inside[0] };

/* Finds the forces of a record's stages. Status: CZ_STATUS_INPUT when it has none. */
static CzStatus find_forces(const CzProblem *problem, const char *path, CzTargets *targets,
                            CzError *error) {
    char forces[CZ_PATH_SIZE + 40];
    snprintf(forces, sizeof forces, "%.270s.stages[*].force_N", path);
    return cz_problem_find_changed(problem, 0, forces, targets, error);
}

/* The same where none are no failure. */
static CzStatus find_some(const CzProblem *problem, const char *path, CzTargets *targets,
                          CzError *error) {
    CzError mistake = {0};
    const CzStatus status = find_forces(problem, path, targets, &mistake);
    if (status == CZ_OK && targets->target[0].vehicle >= 0)
        return CZ_OK;
    free(targets->target);
    *targets = (CzTargets){0};
    if (status == CZ_OK || status == CZ_STATUS_INPUT)
        return CZ_OK;
    if (error != NULL)
        *error = mistake;
    return status;
}

/* Fails because a name has no device, or several. */
static CzStatus refuse(const CzProblem *problem, const char *path, int n_found, const char *found,
                       CzError *error) {
    const char *name = path + (strncmp(path, "parts.", 6) == 0 ? 6 : 0);
    CzSuggestion nearest = {0};
    if (n_found > 1)
        return cz_fail(error, CZ_STATUS_INPUT,
                       "'%.200s' has several devices" CZ_HELP "name one: %s", name, found);
    if (name == path) {
        CzTargets none = {0};
        const CzStatus status = find_forces(problem, path, &none, error);
        free(none.target);
        return status;
    }
    const size_t n = strcspn(name, ".[");
    if (cz_tree_part(&problem->tree, name, n) == NULL) {
        for (int i = 0; i < problem->tree.n_part; i++)
            cz_suggest(&nearest, name, problem->tree.part[i].name);
        cz_fail(error, CZ_STATUS_INPUT, "there is no part '%.200s'", name);
        cz_suggest_help(&nearest, error);
        return CZ_STATUS_INPUT;
    }
    return cz_fail(error, CZ_STATUS_INPUT,
                   "no vehicle has a device '%.200s' with stages" CZ_HELP
                   "name the part of a tube, an anti-climber, a buffer or an end that a vehicle "
                   "uses; `crushzone fit` makes stages of a measured curve",
                   name);
}

CzStatus cz_problem_find_device(const CzProblem *problem, const char *name, CzPlacedDevice *device,
                                CzError *error) {
    const bool is_path = strncmp(name, "trains.", 7) == 0 || strncmp(name, "parts.", 6) == 0;
    char path[CZ_PATH_SIZE], at[CZ_PATH_SIZE + 24], list[400] = "";
    CzTargets found = {0};
    int n_found = 0;
    CzStatus status = CZ_OK;
    *device = (CzPlacedDevice){0};
    snprintf(path, sizeof path, "%s%.200s", is_path ? "" : "parts.", name);
    for (int i = 0; i < N_INSIDE && status == CZ_OK; i++) {
        CzTargets here = {0};
        snprintf(at, sizeof at, "%s%s", path, inside[i]);
        status = find_some(problem, at, &here, error);
        if (here.n == 0)
            continue;
        free(found.target);
        found = here;
        snprintf(device->path, sizeof device->path, "%.*s", CZ_PATH_SIZE - 1, at);
        snprintf(list + strlen(list), sizeof list - strlen(list), "%s%.100s%s",
                 n_found > 0 ? ", " : "", is_path ? path : name, inside[i]);
        if (i == 0)
            break;
        n_found++;
    }
    if (status == CZ_OK && (found.n == 0 || n_found > 1))
        status = refuse(problem, path, n_found, list, error);
    if (status == CZ_OK)
        status = describe(problem, &found, device, error);
    free(found.target);
    return status;
}
