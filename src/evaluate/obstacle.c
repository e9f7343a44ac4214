/* Trains that are obstacles. They carry no passengers, so limits do not apply to them.
 *
 * A train with `role: obstacle` is an obstacle. Without a role a partner counts as an obstacle when
 * it is one rigid vehicle of at most 20 t (the reference obstacles at level crossings have 3 t and
 * 15 t, EN 15227 from memory; the bound is ours) without coupler, side buffers, anti-climber or
 * survival space, and never the train behind. Where the train behind is also such a vehicle, both
 * are judged; so is the partner of a train that is fixed or an obstacle by its role, since
 * otherwise no train would be judged.
 */
#include "base/error.h"
#include "evaluate/scene.h"

static const double heaviest = 20e3; /* [kg] */

/* Whether an end has coupling devices or survival space, as that of a train. */
static bool is_of_train(const CzEnd *end) {
    bool is_train = end->coupler.given || end->side_buffers.given || end->anti_climber.given;
    for (int i = 0; i < end->n_stages; i++)
        is_train |= end->stages[i].zone == CZ_ZONE_SURVIVAL;
    return is_train;
}

static bool looks_like_obstacle(const CzTrain *train) {
    const CzVehicle *vehicle = &train->vehicles[0];
    return train->n_vehicles == 1 && vehicle->model == CZ_MODEL_RIGID &&
           vehicle->mass <= heaviest && !is_of_train(&vehicle->rear) &&
           !is_of_train(&vehicle->front);
}

static bool is_fixed(const CzTrain *train) {
    for (int i = 0; i < train->n_vehicles; i++)
        if (train->vehicles[i].model != CZ_MODEL_FIXED)
            return false;
    return true;
}

/* Whether the train behind is clearly a train, so that its partner need not be judged. */
static bool is_plainly_train(const CzTrain *behind) {
    return behind->role != CZ_ROLE_OBSTACLE && !is_fixed(behind) && !looks_like_obstacle(behind);
}

/* Whether a train without a role counts as an obstacle. */
static bool is_taken_for_obstacle(const CzInput *input, int train, int n_scene,
                                  const CzScene *scene) {
    if (!looks_like_obstacle(&input->trains[train]))
        return false;
    bool is_partner = false;
    for (int s = 0; s < n_scene; s++) {
        if (scene[s].train[0] == train)
            return false;
        if (scene[s].train[1] != train)
            continue;
        if (!is_plainly_train(&input->trains[scene[s].train[0]]))
            return false;
        is_partner = true;
    }
    return is_partner;
}

static const char *why_not_judged(const CzInput *input, int train, int n_scene,
                                  const CzScene *scene) {
    switch (input->trains[train].role) {
    case CZ_ROLE_TRAIN:
        return NULL;
    case CZ_ROLE_OBSTACLE:
        return "its role is obstacle";
    case CZ_ROLE_AUTO:
        break;
    }
    return is_taken_for_obstacle(input, train, n_scene, scene)
               ? "regarded as an obstacle: one rigid vehicle of at most 20 t without coupler, "
                 "buffers, anti-climber and survival space; set 'role: train' to judge it, or "
                 "'role: obstacle' to confirm"
               : NULL;
}

CzStatus cz_obstacles_find(const CzProblem *problem, int n_scene, CzScene *scene, CzArena *arena,
                           CzObstacles *obstacles, CzError *error) {
    const CzInput *input = cz_problem_input(problem);
    int n_vehicle = 0;
    const CzVehicle *first = cz_problem_vehicles(problem, &n_vehicle);
    CzNotJudged *found = cz_arena_allocate(arena, (size_t)input->n_trains + 1, sizeof *found);
    bool *has_vehicle = cz_arena_allocate(arena, (size_t)n_vehicle + 1, sizeof *has_vehicle);
    *obstacles = (CzObstacles){.train = found, .has_vehicle = has_vehicle};
    if (found == NULL || has_vehicle == NULL)
        return cz_no_memory(error, "the trains");
    for (int train = 0; train < input->n_trains; train++) {
        const char *why = why_not_judged(input, train, n_scene, scene);
        bool collides = false;
        for (int i = 0; i < input->trains[train].n_vehicles && why != NULL; i++)
            has_vehicle[input->trains[train].vehicles + i - first] = true;
        for (int s = 0; s < n_scene && why != NULL; s++)
            for (int side = 0; side < 2; side++)
                if (scene[s].train[side] == train)
                    collides = scene[s].is_obstacle[side] = true;
        if (collides)
            found[obstacles->n++] =
                (CzNotJudged){.train = input->trains[train].name,
                              .why = why,
                              .is_inferred = input->trains[train].role == CZ_ROLE_AUTO};
    }
    return CZ_OK;
}
