/* The colliding trains of a scenario. */
#include "evaluate/scene.h"
#include "base/error.h"
#include "base/text.h"

#include <string.h>

/* The value of the scenario, or the train's where it has none. */
static double value_or(double value, double fallback) {
    return isnan(value) ? fallback : value;
}

/* `problem` is that of the scenario. */
static CzStatus list_vehicles(const CzProblem *problem, CzArena *arena, CzScene *scene,
                              CzError *error) {
    const CzInput *input = cz_problem_input(problem);
    int n_record = 0;
    const CzVehicle *first = cz_problem_vehicles(problem, &n_record);
    const CzTrain *behind = &input->trains[scene->train[0]];
    const CzTrain *ahead = &input->trains[scene->train[1]];
    scene->n_vehicle = behind->n_vehicles + ahead->n_vehicles;
    scene->colliding = behind->n_vehicles - 1;
    const size_t n = (size_t)scene->n_vehicle;
    const CzVehicle **vehicle = cz_arena_allocate(arena, n, sizeof *vehicle);
    int *record = cz_arena_allocate(arena, n, sizeof *record);
    if (vehicle == NULL || record == NULL)
        return cz_no_memory(error, "the vehicles");
    for (int i = 0; i < scene->n_vehicle; i++) {
        vehicle[i] = i < behind->n_vehicles ? &behind->vehicles[i]
                                            : &ahead->vehicles[i - behind->n_vehicles];
        record[i] = (int)(vehicle[i] - first);
    }
    scene->vehicle = vehicle;
    scene->record = record;
    return CZ_OK;
}

/* The scene before that a scenario is like; NULL for none. */
static const CzScene *find_like(const CzScenario *scenario, int index, const CzScene *scene) {
    for (int i = 0; i < index && scenario->like != NULL; i++)
        if (strcmp(scene[i].name, scenario->like) == 0)
            return &scene[i];
    return NULL;
}

/* Counts the problems that scenarios change: scenarios with equal changes that follow one another
 * share one. */
static int count_variation(const CzProblem *problem, int index, const CzScene *scene) {
    const CzProblem *own = cz_problem_in_scenario(problem, index);
    int last = 0;
    if (own == problem)
        return 0;
    for (int i = 0; i < index; i++) {
        if (cz_problem_in_scenario(problem, i) == own)
            return scene[i].variation;
        last = scene[i].variation > last ? scene[i].variation : last;
    }
    return last + 1;
}

static CzStatus build_scene(const CzProblem *problem, int index, CzArena *arena, CzScene *all,
                            CzError *error) {
    CzScene *scene = &all[index];
    scene->variation = count_variation(problem, index, all);
    problem = cz_problem_in_scenario(problem, index);
    const CzInput *input = cz_problem_input(problem);
    const CzScenario *scenario = &input->scenarios[index];
    scene->like = find_like(scenario, index, all);
    scene->has_reserves = scenario->reserves;
    scene->name = scenario->name;
    scene->family = scenario->family;
    for (int side = 0; side < 2; side++)
        scene->train[side] = (int)(cz_input_train(input, scenario, side) - input->trains);
    CZ_TRY(list_vehicles(problem, arena, scene, error));
    scene->judged_by = scenario->judged_by.n_text > 0 ? &scenario->judged_by : NULL;
    scene->is_overload = scenario->mass_factor >= CZ_OVERLOAD_FACTOR * (1 - 1e-9);
    scene->closing_speed = value_or(scenario->speed, input->trains[scene->train[0]].speed) -
                           value_or(scenario->partner_speed, input->trains[scene->train[1]].speed);
    scene->rise = value_or(scenario->height_offset, input->trains[scene->train[1]].height_offset) -
                  input->trains[scene->train[0]].height_offset;
    return CZ_OK;
}

bool cz_scene_is(const CzScene *scene, const char *name) {
    return strcmp(scene->name, name) == 0 ||
           (scene->family != NULL && strcmp(scene->family, name) == 0);
}

bool cz_scene_is_like(const CzScene *scene, const char *name) {
    for (; scene != NULL; scene = scene->like)
        if (cz_scene_is(scene, name))
            return true;
    return false;
}

size_t cz_scenes_n_variation(int n_scene, const CzScene *scene) {
    int last = 0;
    for (int s = 0; s < n_scene; s++)
        last = scene[s].variation > last ? scene[s].variation : last;
    return (size_t)last + 1;
}

bool cz_scene_is_judged_by(const CzScene *scene, const char *check) {
    const CzTexts *judges = scene->judged_by;
    return judges == NULL || cz_text_is_among(check, judges->n_text, judges->text);
}

CzStatus cz_scenes_build(const CzProblem *problem, CzArena *arena, int *n_scene, CzScene **scene,
                         CzError *error) {
    *n_scene = cz_problem_n_scenario(problem);
    *scene = cz_arena_allocate(arena, (size_t)*n_scene, sizeof **scene);
    if (*scene == NULL)
        return cz_no_memory(error, "the scenarios");
    for (int index = 0; index < *n_scene; index++)
        CZ_TRY(build_scene(problem, index, arena, *scene, error));
    return CZ_OK;
}
