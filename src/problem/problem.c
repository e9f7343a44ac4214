/* Reading a problem: the steps one after another, and what the public functions give back. */
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "problem/reader.h"
#include "text/yaml.h"

#ifndef CZ_SHARE_FOLDER
#define CZ_SHARE_FOLDER NULL
#endif

void *cz_reader_allocate(CzReader *reader, size_t n, size_t size) {
    return cz_arena_allocate(&reader->arena, n, size);
}

CzProblemOptions cz_problem_options_default(void) {
    return (CzProblemOptions){NULL, 0, NULL};
}

/* ---- the input ---- */

/* Counts the vehicles of all trains and gives each train its part of one array. */
static bool allocate_vehicles(CzProblem *problem, const CzNode *root) {
    CzInput *input = &problem->input;
    const CzEntry *trains = cz_node_find(root, "trains");
    int n_train =
        trains != NULL && trains->value->kind == CZ_NODE_LIST ? trains->value->n_entry : 0;
    problem->n_vehicle = 0;
    for (int i = 0; i < n_train; i++) {
        const CzEntry *list = cz_node_find(trains->value->entry[i].value, "vehicles");
        if (list != NULL && list->value->kind == CZ_NODE_LIST)
            problem->n_vehicle += list->value->n_entry;
    }
    input->trains = cz_reader_allocate(&problem->reader, (size_t)n_train, sizeof(CzTrain));
    problem->vehicle =
        cz_reader_allocate(&problem->reader, (size_t)problem->n_vehicle, sizeof(CzVehicle));
    if (input->trains == NULL || problem->vehicle == NULL)
        return false;
    int n_vehicle = 0;
    for (int i = 0; i < n_train; i++) {
        const CzEntry *list = cz_node_find(trains->value->entry[i].value, "vehicles");
        if (list == NULL || list->value->kind != CZ_NODE_LIST)
            continue;
        input->trains[i].vehicles = &problem->vehicle[n_vehicle];
        n_vehicle += list->value->n_entry;
    }
    return true;
}

/* A problem without scenarios has one: the trains as written. */
static void add_scenario(CzProblem *problem, const CzNode *root) {
    CzScenario *scenario = cz_reader_allocate(&problem->reader, 1, sizeof *scenario);
    if (scenario == NULL)
        return;
    cz_bind_absent(CZ_RECORD_CzScenario, scenario);
    scenario->given = true;
    scenario->name = "collision";
    problem->input.scenarios = scenario;
    problem->input.n_scenarios = 1;
    cz_places_add(&problem->reader,
                  (CzPlace){.address = scenario, .size = sizeof *scenario, .node = root});
    cz_places_sort(&problem->reader);
}

void cz_problem_bind(CzProblem *problem, const CzTree *tree) {
    CzReader *reader = &problem->reader;
    CzTree set = cz_settings_apply(reader, tree, problem->setting, problem->n_setting);
    set.root = cz_trains_write_out(reader, &set);
    if (set.root != NULL)
        set.root = cz_families_write_out(reader, &set);
    if (set.root == NULL || reader->arena.out_of_memory || !allocate_vehicles(problem, set.root))
        return;
    cz_bind_record(reader, &set, CZ_RECORD_CzInput, set.root, &cz_no_trail, &problem->input);
    if (problem->input.n_scenarios == 0 && cz_node_find(set.root, "scenarios") == NULL)
        add_scenario(problem, set.root);
}

/* ---- reading ---- */

static CzProblem *problem_create(const CzProblemOptions *options) {
    CzProblem *problem = calloc(1, sizeof *problem);
    if (problem == NULL)
        return NULL;
    CzReader *reader = &problem->reader;
    reader->mistakes.arena = reader->warnings.arena = reader->sources.arena = &reader->arena;
    reader->sources.hash = CZ_HASH_START;
    reader->share_folder = CZ_SHARE_FOLDER;
    if (options->share_folder != NULL)
        reader->share_folder = cz_arena_copy_text(&reader->arena, options->share_folder,
                                                  strlen(options->share_folder));
    return problem;
}

static void read_tree(CzProblem *problem, const CzNode *top, const CzProblemOptions *options) {
    CzReader *reader = &problem->reader;
    problem->tree = cz_load_tree(reader, top);
    if (problem->tree.root == NULL || reader->arena.out_of_memory)
        return;
    problem->setting = cz_settings_gather(reader, problem->tree.root, options, &problem->n_setting);
    if (problem->setting == NULL)
        return;
    cz_problem_bind(problem, &problem->tree);
    if (reader->arena.out_of_memory)
        return;
    cz_profile_read(problem);
    cz_measured_read(problem);
    cz_rules_check(problem);
    cz_usual_check(reader);
    cz_acts_on_check(problem);
}

/* Sorts what was found and tells the first mistake. */
static CzStatus finish(CzProblem *problem, CzError *error) {
    CzReader *reader = &problem->reader;
    snprintf(problem->hash, sizeof problem->hash, "%016" PRIx64, reader->sources.hash);
    cz_mistakes_finish(&reader->mistakes);
    cz_mistakes_finish(&reader->warnings);
    if (reader->arena.out_of_memory)
        return cz_fail(error, CZ_STATUS_NO_MEMORY, "there is no memory to read '%s'",
                       problem->file != NULL ? problem->file : "the problem");
    if (reader->mistakes.n_mistake == 0)
        return CZ_OK;
    if (error != NULL)
        *error = reader->mistakes.mistake[0]->error;
    return CZ_STATUS_INPUT;
}

CzStatus cz_problem_read(const char *path, const CzProblemOptions *options, CzProblem **problem,
                         CzError *error) {
    const CzProblemOptions none = cz_problem_options_default();
    const CzProblemOptions *chosen = options != NULL ? options : &none;
    *problem = problem_create(chosen);
    if (*problem == NULL)
        return cz_fail(error, CZ_STATUS_NO_MEMORY, "there is no memory to read '%s'", path);
    CzReader *reader = &(*problem)->reader;
    (*problem)->file = cz_arena_copy_text(&reader->arena, path, strlen(path));
    const CzNode *top = cz_load_file(reader, path, NULL);
    if (top != NULL)
        read_tree(*problem, top, chosen);
    return finish(*problem, error);
}

CzStatus cz_problem_read_text(const char *text, size_t n_byte, const char *name, const char *folder,
                              const CzProblemOptions *options, CzProblem **problem,
                              CzError *error) {
    const CzProblemOptions none = cz_problem_options_default();
    const CzProblemOptions *chosen = options != NULL ? options : &none;
    *problem = problem_create(chosen);
    if (*problem == NULL)
        return cz_fail(error, CZ_STATUS_NO_MEMORY, "there is no memory to read '%s'", name);
    CzReader *reader = &(*problem)->reader;
    (*problem)->file = cz_arena_copy_text(&reader->arena, name, strlen(name));
    const size_t n_mark = cz_source_mark(text, n_byte);
    text += n_mark;
    n_byte -= n_mark;
    const bool is_small = n_byte <= CZ_MOST_BYTES;
    const CzSource *source =
        cz_sources_add(&reader->sources, name, folder, text, is_small ? n_byte : 0);
    const CzNode *top = NULL;
    if (source != NULL && (!is_small || n_byte == 0))
        cz_mistake_at(&reader->mistakes, source, 0, 0, "cannot read '%s': it is %s", name,
                      is_small ? "empty" : "larger than 16 MiB");
    else if (source != NULL && cz_source_is_text(&reader->mistakes, source, text, n_byte))
        top = cz_yaml_document(&reader->mistakes, source, text, n_byte);
    if (top != NULL)
        read_tree(*problem, top, chosen);
    return finish(*problem, error);
}

void cz_problem_free(CzProblem *problem) {
    if (problem == NULL)
        return;
    cz_places_free(&problem->reader.places);
    cz_arena_free(&problem->reader.arena);
    free(problem);
}

/* ---- what was found ---- */

int cz_problem_n_mistake(const CzProblem *problem) {
    return problem->reader.mistakes.n_mistake;
}

const CzError *cz_problem_mistake(const CzProblem *problem, int index) {
    return &problem->reader.mistakes.mistake[index]->error;
}

int cz_problem_n_warning(const CzProblem *problem) {
    return problem->reader.warnings.n_mistake;
}

const CzError *cz_problem_warning(const CzProblem *problem, int index) {
    return &problem->reader.warnings.mistake[index]->error;
}

const char *cz_problem_source_line(const CzProblem *problem, const CzError *error) {
    for (const CzSource *source = problem->reader.sources.first; source != NULL;
         source = source->next) {
        const size_t n = sizeof error->file - 1;
        if (strncmp(source->name, error->file, n) == 0 && error->line >= 1 &&
            error->line <= source->n_line)
            return source->line[error->line - 1];
    }
    return NULL;
}

const char *cz_problem_title(const CzProblem *problem) {
    return problem->input.title;
}

const char *cz_problem_file(const CzProblem *problem) {
    return problem->file;
}

const char *cz_problem_hash(const CzProblem *problem) {
    return problem->hash;
}

int cz_problem_n_scenario(const CzProblem *problem) {
    return problem->input.n_scenarios;
}

const char *cz_problem_scenario_name(const CzProblem *problem, int scenario) {
    return problem->input.scenarios[scenario].name;
}

int cz_input_find_scenario(const CzInput *input, const char *name, CzSuggestion *nearest) {
    for (int i = 0; i < input->n_scenarios; i++) {
        const char *const known[2] = {input->scenarios[i].name, input->scenarios[i].family};
        for (int k = 0; k < 2; k++) {
            if (known[k] != NULL && strcmp(known[k], name) == 0)
                return i;
            if (known[k] != NULL)
                cz_suggest(nearest, name, known[k]);
        }
    }
    return -1;
}

CzStatus cz_problem_find_scenario(const CzProblem *problem, const char *name, int *scenario,
                                  CzError *error) {
    CzSuggestion nearest = {0};
    const int found = cz_input_find_scenario(&problem->input, name, &nearest);
    if (found >= 0) {
        *scenario = found;
        return CZ_OK;
    }
    const CzStatus status = cz_fail(error, CZ_STATUS_INPUT, "there is no scenario '%s'", name);
    cz_suggest_help(&nearest, error);
    return status;
}

/* The rest of a path behind a folder; NULL when it is not in it. */
static const char *path_in(const char *folder, const char *path) {
    const size_t n = folder != NULL ? strlen(folder) : 0;
    return n > 0 && strncmp(path, folder, n) == 0 && path[n] == '/' ? path + n + 1 : NULL;
}

const char *cz_problem_told_name(const CzProblem *problem, const char *name) {
    const CzSource *first = problem->reader.sources.first;
    if (name[0] != '/')
        return name;
    const char *beside = path_in(first != NULL ? first->folder : NULL, name);
    const char *shared = path_in(problem->reader.share_folder, name);
    return beside != NULL ? beside : shared != NULL ? shared : name;
}

const char *cz_problem_share_folder(const CzProblem *problem) {
    return problem->reader.share_folder;
}

const CzSource *cz_problem_first_source(const CzProblem *problem) {
    return problem->reader.sources.first;
}

const CzInput *cz_problem_input(const CzProblem *problem) {
    return &problem->input;
}

const CzVehicle *cz_problem_vehicles(const CzProblem *problem, int *n_vehicle) {
    *n_vehicle = problem->n_vehicle;
    return problem->vehicle;
}

CzTrack cz_problem_track(const CzProblem *problem) {
    int n_vehicle;
    const CzVehicle *vehicle = cz_problem_vehicles(problem, &n_vehicle);
    for (int i = 0; i < n_vehicle; ++i)
        if (vehicle[i].model == CZ_MODEL_FULL)
            return (CzTrack)cz_problem_input(problem)->simulation.track;
    return CZ_TRACK_RIGID;
}

const CzProfile *cz_problem_profile(const CzProblem *problem) {
    return problem->profile.given ? &problem->profile : NULL;
}

void cz_problem_place(const CzProblem *problem, const void *field, CzError *error) {
    const CzPlace *place = cz_places_find(&problem->reader.places, field);
    error->status = CZ_STATUS_INPUT;
    if (place != NULL)
        cz_error_place(error, place->node);
    else
        snprintf(error->file, sizeof error->file, "%.255s", problem->file);
}
