/* Converts a tree to records: settings, trains, families, binding. */
#include "problem/reading.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "tree/families.h"
#include "tree/merge.h"
#include "tree/trains.h"

CzProblem *cz_problem_create(const char *share_folder) {
    CzProblem *problem = calloc(1, sizeof *problem);
    if (problem == NULL)
        return NULL;
    CzReader *reader = &problem->reader;
    reader->top = &cz_records[CZ_RECORD_CzInput];
    reader->share_folder = share_folder;
    reader->sources.hash = CZ_HASH_START;
    reader->mistakes.arena = reader->warnings.arena = reader->sources.arena =
        problem->places.arena = &reader->arena;
    return problem;
}

CzProblem *cz_problem_create_again(const CzProblem *problem, CzReadStep step, int n_more,
                                   CzSetting **more) {
    CzProblem *again = cz_problem_create(problem->reader.share_folder);
    const int n = problem->n_setting;
    CzSetting *setting = again != NULL ? cz_arena_allocate(&again->reader.arena,
                                                           (size_t)(n + n_more), sizeof *setting)
                                       : NULL;
    if (setting == NULL) {
        cz_problem_free(again);
        return NULL;
    }
    if (n > 0)
        memcpy(setting, problem->setting, (size_t)n * sizeof *setting);
    *more = setting + n;
    again->setting = setting;
    again->n_setting = n + n_more;
    again->file = problem->file;
    again->origin = problem;
    again->step = step;
    again->n_added = n_more;
    again->written = problem->written;
    again->tree = problem->tree;
    again->curves = problem->curves;
    return again;
}

void cz_problem_take_files(CzProblem *again, const CzProblem *problem) {
    memcpy(again->hash, problem->hash, sizeof again->hash);
    again->profile = problem->profile;
    again->whole_profile = problem->whole_profile;
    again->n_asked = problem->n_asked;
    again->asked = problem->asked;
    again->measured = problem->measured;
    again->reader.sources.first = problem->reader.sources.first;
}

CzBinder cz_problem_binder(CzProblem *problem, const CzTree *tree) {
    return (CzBinder){.reader = &problem->reader,
                      .places = &problem->places,
                      .curves = &problem->curves,
                      .tree = tree};
}

/* Several scenarios one behind the other may share a changed problem. */
static void free_changed(CzProblem *problem) {
    CzProblem *last = NULL;
    for (int s = 0; problem->changed != NULL && s < problem->input.n_scenarios; s++)
        if (problem->changed[s] != NULL && problem->changed[s] != last) {
            last = problem->changed[s];
            cz_problem_free(last);
        }
    free(problem->changed);
}

void cz_problem_free(CzProblem *problem) {
    if (problem == NULL)
        return;
    for (int i = 0; problem->targets != NULL && i < problem->input.optimise.n_variables; i++)
        free(problem->targets[i].target);
    free_changed(problem);
    cz_places_free(&problem->places);
    cz_arena_free(&problem->reader.arena);
    free(problem);
}

/* Counts the vehicles of all trains and assigns to each train its part of one array. */
static bool allocate_vehicles(CzProblem *problem, const CzNode *root) {
    CzArena *arena = &problem->reader.arena;
    const CzEntry *trains = cz_node_find_list(root, "trains");
    const int n_train = trains != NULL ? trains->value->n_entry : 0;
    int *first = cz_arena_allocate(arena, (size_t)n_train + 1, sizeof *first);
    problem->input.trains = cz_arena_allocate(arena, (size_t)n_train, sizeof(CzTrain));
    if (first == NULL || problem->input.trains == NULL)
        return false;
    for (int i = 0; i < n_train; i++) {
        const CzEntry *list = cz_node_find_list(trains->value->entry[i].value, "vehicles");
        first[i + 1] = first[i] + (list != NULL ? list->value->n_entry : 0);
    }
    problem->n_vehicle = first[n_train];
    problem->vehicle = cz_arena_allocate(arena, (size_t)problem->n_vehicle, sizeof(CzVehicle));
    for (int i = 0; problem->vehicle != NULL && i < n_train; i++)
        problem->input.trains[i].vehicles = &problem->vehicle[first[i]];
    return problem->vehicle != NULL;
}

/* A problem without scenarios has one: the trains as written. */
static void add_scenario(CzProblem *problem, const CzNode *root) {
    CzScenario *scenario = cz_arena_allocate(&problem->reader.arena, 1, sizeof *scenario);
    if (scenario == NULL)
        return;
    cz_bind_absent(&cz_records[CZ_RECORD_CzScenario], scenario);
    scenario->given = true;
    scenario->name = "collision";
    problem->input.scenarios = scenario;
    problem->input.n_scenarios = 1;
    cz_places_add(&problem->places,
                  (CzPlace){.address = scenario, .size = sizeof *scenario, .node = root});
    cz_places_sort(&problem->places);
}

void cz_problem_bind(CzProblem *problem, const CzTree *tree) {
    CzReader *reader = &problem->reader;
    CzTree set = cz_settings_apply(reader, tree, problem->setting, problem->n_setting);
    set.root = cz_trains_write_out(reader, &set);
    if (set.root != NULL)
        set.root = cz_families_write_out(reader, &set);
    if (set.root != NULL)
        cz_settings_apply_late(reader, &set, problem->setting, problem->n_setting);
    if (set.root == NULL || reader->arena.out_of_memory || !allocate_vehicles(problem, set.root))
        return;
    cz_bind_record(cz_problem_binder(problem, &set), reader->top, set.root, &cz_no_trail,
                   &problem->input);
    if (problem->input.n_scenarios == 0 && cz_node_find(set.root, "scenarios") == NULL)
        add_scenario(problem, set.root);
}

/* Whether a scenario has a name, or its family has; else both are suggested. */
static bool has_name(const char *own, const char *family, const char *name, CzSuggestion *nearest) {
    const char *const known[2] = {own, family};
    for (int k = 0; k < 2; k++) {
        if (known[k] != NULL && strcmp(known[k], name) == 0)
            return true;
        if (known[k] != NULL)
            cz_suggest(nearest, name, known[k]);
    }
    return false;
}

int cz_input_find_scenario(const CzInput *input, const char *name, CzSuggestion *nearest) {
    for (int i = 0; i < input->n_scenarios; i++)
        if (has_name(input->scenarios[i].name, input->scenarios[i].family, name, nearest))
            return i;
    return -1;
}

bool cz_profile_has_scenario(const CzProfile *profile, const char *name, CzSuggestion *nearest) {
    for (int i = 0; i < profile->n_scenarios; i++)
        if (has_name(profile->scenarios[i].name, profile->scenarios[i].family, name, nearest))
            return true;
    return false;
}

void cz_problem_place(const CzProblem *problem, const void *field, CzError *error) {
    const CzPlace *place = cz_places_find(&problem->places, field);
    error->status = CZ_STATUS_INPUT;
    if (place != NULL)
        cz_error_place(error, place->node);
    else
        snprintf(error->file, sizeof error->file, "%.255s", problem->file);
}

CzStatus cz_problem_place_failure(const CzProblem *problem, const void *field, CzStatus status,
                                  CzError *error) {
    if (status == CZ_STATUS_INPUT && error != NULL)
        cz_problem_place(problem, field, error);
    return status;
}

CzStatus cz_problem_fail(const CzProblem *problem, const void *field, CzError *error,
                         const char *format, ...) {
    char text[sizeof error->message];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    return cz_problem_place_failure(problem, field, cz_fail(error, CZ_STATUS_INPUT, "%s", text),
                                    error);
}
