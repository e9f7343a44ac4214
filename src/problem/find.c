/* Finds the places that a path names by setting stand-in values at the path and reading again, so
 * that a path names exactly the values that setting it changes. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "problem/changes.h"

/* First mistake caused by the path itself, or NULL. */
static const CzError *first_mistake(const CzReader *reader, const CzNode *place) {
    for (int i = 0; i < reader->mistakes.n_mistake; i++)
        if (strcmp(reader->mistakes.mistake[i]->error.file, place->source->name) == 0)
            return &reader->mistakes.mistake[i]->error;
    return NULL;
}

/* The same field of the problem as at an address of the trial, which was read from the same tree;
 * NULL when the address is not in an array of numbers that a path may name. */
static const void *same_field(const CzProblem *problem, const CzProblem *trial,
                              const void *address) {
    const CzInput *from = &trial->input, *to = &problem->input;
    const struct {
        const void *from, *to;
        size_t size;
    } regions[] = {
        {trial->vehicle, problem->vehicle, (size_t)trial->n_vehicle * sizeof(CzVehicle)},
        {from->trains, to->trains, (size_t)from->n_trains * sizeof(CzTrain)},
        {from->scenarios, to->scenarios, (size_t)from->n_scenarios * sizeof(CzScenario)},
        {&from->simulation, &to->simulation, sizeof(CzSimulation)},
    };
    for (size_t i = 0; i < sizeof regions / sizeof regions[0]; i++) {
        const uintptr_t at = (uintptr_t)address - (uintptr_t)regions[i].from;
        if (at < regions[i].size)
            return (const char *)regions[i].to + at;
    }
    return NULL;
}

/* Whether a place is a stand-in for a number. */
static bool is_target(const CzProblem *problem, const CzProblem *trial, const CzPlace *place) {
    return place->key != NULL && place->key->kind == CZ_KEY_NUMBER && place->value->match > 0 &&
           same_field(problem, trial, place->address) != NULL;
}

static CzTarget make_target(const CzProblem *problem, const CzProblem *trial, const CzPlace *place,
                            const CzMatches *matches) {
    CzTarget target = {.vehicle = -1};
    target.field = same_field(problem, trial, place->address);
    const size_t at = (size_t)((uintptr_t)target.field - (uintptr_t)problem->vehicle);
    if (at < (size_t)problem->n_vehicle * sizeof(CzVehicle)) {
        target.vehicle = (int)(at / sizeof(CzVehicle));
        target.offset = at % sizeof(CzVehicle);
    }
    target.value = *target.field;
    target.unit = place->unit->si;
    target.suffix = place->unit->suffix;
    target.match = place->value->match - 1;
    target.may_vary = place->key->variation == CZ_VARIATION_VARIES;
    target.may_fit = place->key->variation != CZ_VARIATION_DATA;
    memcpy(target.place, matches->place[target.match], sizeof target.place);
    return target;
}

bool cz_targets_copy(const CzProblem *to, const CzProblem *from, const CzTargets *targets,
                     CzTargets *copy) {
    copy->target = malloc(((size_t)targets->n + 1) * sizeof *copy->target);
    for (; copy->target != NULL && copy->n < targets->n; copy->n++) {
        copy->target[copy->n] = targets->target[copy->n];
        copy->target[copy->n].field = same_field(to, from, targets->target[copy->n].field);
    }
    return copy->target != NULL;
}

static int compare_targets(const void *a, const void *b) {
    const CzTarget *first = a, *second = b;
    if (first->match != second->match)
        return first->match - second->match;
    return (first->field > second->field) - (first->field < second->field);
}

static CzStatus collect(const CzProblem *problem, const CzProblem *trial, const CzMatches *matches,
                        CzTargets *found, CzError *error) {
    const CzPlaces *places = &trial->places;
    const size_t room = (size_t)(found->n + places->n_place) + 1;
    CzTarget *target = realloc(found->target, room * sizeof *target);
    if (target == NULL)
        return cz_no_memory(error, "the places of a path");
    const int first = found->n;
    found->target = target;
    for (int i = 0; i < places->n_place; i++)
        if (is_target(problem, trial, &places->place[i]))
            target[found->n++] = make_target(problem, trial, &places->place[i], matches);
    qsort(target + first, (size_t)(found->n - first), sizeof *target, compare_targets);
    return CZ_OK;
}

/* Reads the problem with stand-ins as its last settings, applied in the usual order. */
static CzStatus find(const CzProblem *problem, CzProblem *trial, CzSetting *stand_ins,
                     const char *path, bool is_late, CzTargets *found, CzError *error) {
    CzReader *reader = &trial->reader;
    CzMatches matches = {0};
    const CzSource *source = cz_sources_add(&reader->sources, "(path)", ".", path, strlen(path));
    const CzNode place = {.source = source, .line = 1, .column = 1};
    *stand_ins = (CzSetting){.path = path,
                             .place = &place,
                             .put = {.kind = CZ_PUT_MARKER, .matches = &matches},
                             .is_late = is_late};
    if (source != NULL)
        cz_problem_bind(trial, &trial->tree);
    if (reader->arena.out_of_memory)
        return cz_no_memory(error, "the places of a path");
    const CzError *mistake = first_mistake(reader, &place);
    if (mistake != NULL) {
        cz_fail(error, CZ_STATUS_INPUT, "path '%s': %s", path, mistake->message);
        if (error != NULL)
            memcpy(error->help, mistake->help, sizeof error->help);
        return CZ_STATUS_INPUT;
    }
    const int n_before = found->n;
    CZ_TRY(collect(problem, trial, &matches, found, error));
    if (found->n > n_before)
        return CZ_OK;
    cz_fail(error, CZ_STATUS_INPUT, "path '%s' names no number", path);
    if (error != NULL)
        snprintf(error->help, sizeof error->help,
                 "design variables are numbers of vehicles and parts");
    return CZ_STATUS_INPUT;
}

static CzStatus find_on_trial(const CzProblem *problem, const char *path, bool is_late,
                              CzTargets *targets, CzError *error) {
    CzSetting *stand_ins = NULL;
    CzProblem *trial = cz_problem_create_again(problem, CZ_STEP_OTHER, 1, &stand_ins);
    if (trial == NULL)
        return cz_no_memory(error, "the places of a path");
    const CzStatus status = find(problem, trial, stand_ins, path, is_late, targets, error);
    cz_problem_free(trial);
    return status;
}

CzStatus cz_problem_find(const CzProblem *problem, const char *path, CzTargets *targets,
                         CzError *error) {
    return find_on_trial(problem, path, false, targets, error);
}

CzStatus cz_problem_find_changed(const CzProblem *problem, int scenario, const char *path,
                                 CzTargets *targets, CzError *error) {
    char text[CZ_PATH_SIZE];
    const bool is_of_scenario = cz_change_path(path, scenario, text) == text;
    if (is_of_scenario && cz_node_find(problem->tree.root, "scenarios") == NULL)
        return CZ_OK; /* the trains as written have no key to be found */
    return find_on_trial(problem, is_of_scenario ? text : path, cz_change_is_late(path), targets,
                         error);
}
