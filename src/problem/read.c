/* Reads a problem: the sequence of steps, and the public functions. */
#include <inttypes.h>
#include <stdio.h>
#include <string.h>

#include "base/error.h"
#include "problem/acts.h"
#include "problem/changes.h"
#include "problem/profile.h"
#include "problem/usual.h"
#include "text/yaml.h"
#include "tree/load.h"

#ifndef CZ_SHARE_FOLDER
#define CZ_SHARE_FOLDER NULL
#endif

CzProblemOptions cz_problem_options_default(void) {
    return (CzProblemOptions){NULL, 0, NULL};
}

/* ---- reading ---- */

/* Keeps the options, so that another process can read the problem; lack of memory is reported at
 * the end of reading. */
static void keep_options(CzProblem *problem, const CzProblemOptions *options) {
    CzArena *arena = &problem->reader.arena;
    const int n = options != NULL ? options->n_set : 0;
    const char **set = cz_arena_allocate(arena, (size_t)n + 1, sizeof *set);
    for (int i = 0; set != NULL && i < n; i++)
        set[i] = cz_arena_copy_text(arena, options->set[i], strlen(options->set[i]));
    problem->given = (CzProblemOptions){set, n, problem->reader.share_folder};
}

/* Begins a problem whose name in messages is `file`; `options` may be NULL. */
static CzStatus begin(const CzProblemOptions *options, const char *file, CzProblem **problem,
                      CzError *error) {
    CzProblem *begun = cz_problem_create(CZ_SHARE_FOLDER);
    *problem = begun;
    if (begun == NULL)
        return cz_no_memory(error, file);
    CzArena *arena = &begun->reader.arena;
    begun->file = cz_arena_copy_text(arena, file, strlen(file));
    if (options != NULL && options->share_folder != NULL)
        begun->reader.share_folder =
            cz_arena_copy_text(arena, options->share_folder, strlen(options->share_folder));
    keep_options(begun, options);
    return CZ_OK;
}

/* Reads the problems of scenarios with changes, which shows what is wrong with the changes. */
static void read_changes(const CzRules *rules, CzProblem *problem) {
    CzError error = {0};
    const void *field = NULL;
    if (rules->mistakes->n_mistake > 0 || rules->reader->has_holes)
        return;
    const CzStatus status = cz_changes_read(problem, &field, &error);
    problem->reader.arena.out_of_memory |= status == CZ_STATUS_NO_MEMORY;
    if (status == CZ_STATUS_INPUT)
        cz_rule_broken(rules, field, "%s" CZ_HELP "%s", error.message, error.help);
}

/* Reads the records of a tree with its settings, and everything that follows from them. */
static void read_records(CzProblem *problem) {
    CzReader *reader = &problem->reader;
    cz_profile_expand(problem);
    cz_problem_bind(problem, &problem->tree);
    if (reader->arena.out_of_memory)
        return;
    cz_measured_read(problem);
    const CzRules rules = cz_rules_of(problem);
    cz_rules_check_collision(&rules);
    problem->targets = cz_arena_allocate(
        &reader->arena, (size_t)problem->input.optimise.n_variables, sizeof *problem->targets);
    if (problem->targets == NULL)
        return;
    cz_rules_check_design(&rules, problem->targets);
    cz_rules_check_fit(&rules);
    cz_rules_check_uncertainty(&rules);
    cz_usual_check(&reader->warnings, &problem->places);
    cz_acts_check(problem);
    read_changes(&rules, problem);
}

static void read_tree(CzProblem *problem, const CzNode *top, const CzProblemOptions *options) {
    CzReader *reader = &problem->reader;
    CzSource *first = reader->sources.first;
    first->is_general = strstr(first->line[0], CZ_RESOLVED_MARK) != NULL;
    problem->written = cz_load_tree(reader, top);
    if (problem->written.root == NULL || reader->arena.out_of_memory)
        return;
    problem->setting =
        cz_settings_gather(reader, problem->written.root, options != NULL ? options->n_set : 0,
                           options != NULL ? options->set : NULL, &problem->n_setting);
    if (problem->setting != NULL)
        read_records(problem);
}

/* Sorts the mistakes and reports the first one. */
static CzStatus finish(CzProblem *problem, CzError *error) {
    CzReader *reader = &problem->reader;
    snprintf(problem->hash, sizeof problem->hash, "%016" PRIx64, reader->sources.hash);
    cz_mistakes_finish(&reader->mistakes);
    cz_mistakes_finish(&reader->warnings);
    return cz_mistakes_status(&reader->mistakes,
                              problem->file != NULL ? problem->file : "the problem", error);
}

CzStatus cz_problem_read(const char *path, const CzProblemOptions *options, CzProblem **problem,
                         CzError *error) {
    CZ_TRY(begin(options, path, problem, error));
    const CzNode *top = cz_load_file(&(*problem)->reader, path, NULL);
    if (top != NULL)
        read_tree(*problem, top, options);
    return finish(*problem, error);
}

CzStatus cz_problem_read_with(const CzProblem *problem, int n_set, const char *const *set,
                              CzProblem **made, CzError *error) {
    CzSetting *more = NULL;
    *made = cz_problem_create_again(problem, CZ_STEP_OTHER, n_set, &more);
    if (*made == NULL)
        return cz_no_memory(error, "the problem with other settings");
    CzReader *reader = &(*made)->reader;
    const char *folder = problem->reader.sources.first->folder;
    (*made)->n_setting =
        problem->n_setting + cz_settings_gather_options(reader, folder, n_set, set, more);
    if (!reader->arena.out_of_memory)
        read_records(*made);
    const CzStatus status = finish(*made, error);
    if (status == CZ_OK)
        return CZ_OK;
    cz_problem_free(*made);
    *made = NULL;
    return status;
}

CzStatus cz_problem_read_text(const char *text, size_t n_byte, const char *name, const char *folder,
                              const CzProblemOptions *options, CzProblem **problem,
                              CzError *error) {
    CZ_TRY(begin(options, name, problem, error));
    CzReader *reader = &(*problem)->reader;
    CzProblemText *problem_text = &(*problem)->text;
    problem_text->byte = cz_arena_copy_text(&reader->arena, text, n_byte);
    problem_text->n = n_byte;
    problem_text->folder = cz_arena_copy_text(&reader->arena, folder, strlen(folder));
    const size_t n_mark = cz_source_mark(text, n_byte);
    text += n_mark;
    n_byte -= n_mark;
    const bool is_small = n_byte <= CZ_MAX_BYTES;
    const CzSource *source =
        cz_sources_add(&reader->sources, name, folder, text, is_small ? n_byte : 0);
    const CzNode *top = NULL;
    if (source != NULL && (!is_small || n_byte == 0))
        cz_mistake_at(&reader->mistakes, source, 0, 0, "cannot read '%s': it is %s", name,
                      is_small ? "empty" : "larger than 16 MiB");
    else if (source != NULL && cz_source_is_text(&reader->mistakes, source, text, n_byte))
        top = cz_yaml_document(&reader->mistakes, source, text, n_byte);
    if (top != NULL)
        read_tree(*problem, top, options);
    return finish(*problem, error);
}

/* ---- mistakes and sources ---- */

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

/* The rest of a path after a folder; NULL when it is not in the folder. */
static const char *path_in(const char *folder, const char *path) {
    const size_t n = folder != NULL ? strlen(folder) : 0;
    return n > 0 && strncmp(path, folder, n) == 0 && path[n] == '/' ? path + n + 1 : NULL;
}

const char *cz_problem_reported_name(const CzProblem *problem, const char *name) {
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

const CzTargets *cz_problem_targets(const CzProblem *problem, int variable) {
    static const CzTargets none = {0};
    return problem->targets != NULL ? &problem->targets[variable] : &none;
}

CzTrack cz_problem_track(const CzProblem *problem) {
    for (int i = 0; i < problem->n_vehicle; i++)
        if (problem->vehicle[i].model == CZ_MODEL_FULL)
            return (CzTrack)problem->input.simulation.track;
    return CZ_TRACK_RIGID;
}

const CzProfile *cz_problem_profile(const CzProblem *problem) {
    return problem->profile.given ? &problem->profile : NULL;
}

const CzAskedScenario *cz_problem_profile_scenarios(const CzProblem *problem, int *n_asked) {
    *n_asked = problem->n_asked;
    return problem->asked;
}
