/* Builds an evaluator, and returns its properties that are known before a run. */
#include "evaluate/evaluator_parts.h"
#include "base/error.h"
#include "evaluate/tasks.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

CzEvaluatorOptions cz_evaluator_options_default(void) {
    return (CzEvaluatorOptions){
        .n_job = 0, .step_factor = 1, .integrator = CZ_INTEGRATOR_ZHAI, .scenario = NULL};
}

/* ---- building -------------------------------------------------------------------------------- */

/* Adds the names of the choices and their place to a failure of a combination. */
static CzStatus place_combination(const CzEvaluator *evaluator, const CzVariantSettings *settings,
                                  CzStatus status, CzError *error) {
    const CzOptimise *optimise = &cz_problem_input(evaluator->problem)->optimise;
    if (status != CZ_STATUS_INPUT || error == NULL)
        return status;
    char names[160] = "", message[sizeof error->message];
    for (int i = 0; i < settings->n; i++) {
        const size_t n = strlen(names);
        snprintf(names + n, sizeof names - n, "%s%s", n > 0 ? ", " : "", settings->value[i]);
    }
    snprintf(message, sizeof message, "with the choices %s: %.300s", names, error->message);
    cz_fail(error, CZ_STATUS_INPUT, "%s", message);
    for (int i = 0; i < optimise->n_variables; i++)
        if (optimise->variables[i].choices.n_text > 0)
            cz_problem_place(evaluator->problem, &optimise->variables[i].choices, error);
    return status;
}

/* Builds one variant for each combination of choices. */
static CzStatus build_variants(CzEvaluator *evaluator, CzError *error) {
    const CzDesign *design = &evaluator->design;
    CzArena *arena = &evaluator->arena;
    const int n = cz_design_n_combination(design);
    double *start = cz_arena_allocate(arena, (size_t)design->n_variable + 1, sizeof *start);
    evaluator->variant = cz_arena_allocate(arena, (size_t)n, sizeof *evaluator->variant);
    if (start == NULL || evaluator->variant == NULL)
        return cz_no_memory(error, "the models");
    for (int i = 0; i < design->n_variable; i++)
        start[i] = design->variable[i].info.start;
    evaluator->own = cz_design_combination(design, start);
    for (; evaluator->n_variant < n; evaluator->n_variant++) {
        CzVariantSettings settings;
        const bool is_own = evaluator->n_variant == evaluator->own;
        if (!cz_design_settings(design, evaluator->n_variant, NULL, arena, &settings))
            return cz_no_memory(error, "the choices");
        const CzVariantScenes scenes = cz_evaluator_scenes(evaluator);
        const CzStatus status = cz_variant_build(&scenes, is_own ? NULL : &settings,
                                                 &evaluator->variant[evaluator->n_variant], error);
        if (status != CZ_OK)
            return is_own ? status : place_combination(evaluator, &settings, status, error);
    }
    evaluator->model = evaluator->variant[evaluator->own].model;
    evaluator->vehicles = evaluator->variant[evaluator->own].vehicles;
    return CZ_OK;
}

/* The rates of variations do not depend on one another, so that further scenarios change no result.
 */
static CzStatus set_rates(CzEvaluator *evaluator, CzError *error) {
    const size_t n = (size_t)evaluator->n_variation;
    evaluator->rate = cz_arena_allocate(&evaluator->arena, n, sizeof *evaluator->rate);
    if (evaluator->rate == NULL)
        return cz_no_memory(error, "the evaluator");
    for (int v = 0; v < evaluator->n_variation; v++)
        for (int s = 0; s < evaluator->n_scene; s++) {
            const CzScene *scene = &evaluator->scene[s];
            if (scene->variation == 0 || scene->variation == v)
                evaluator->rate[v] = fmax(evaluator->rate[v], scene->closing_speed / 2);
        }
    return CZ_OK;
}

static CzStatus build_models(CzEvaluator *evaluator, const char *only, CzError *error) {
    CZ_TRY(set_rates(evaluator, error));
    if (only != NULL) {
        int first;
        CZ_TRY(cz_problem_find_scenario(evaluator->problem, only, &first, error));
        const CzScene *scene = &evaluator->scene[first];
        evaluator->only = strcmp(only, scene->name) == 0 ? scene->name : scene->family;
    }
    return build_variants(evaluator, error);
}

/* Names the constraints: check and scenario. */
static CzStatus list_constraints(CzEvaluator *evaluator, CzError *error) {
    const size_t n = (size_t)(evaluator->list.n_constraint + evaluator->matches.n_item);
    CzArena *arena = &evaluator->arena;
    evaluator->constraint_check = cz_arena_allocate(arena, n + 1, sizeof(int));
    evaluator->constraint_name = cz_arena_allocate(arena, n + 1, sizeof(char *));
    if (evaluator->constraint_check == NULL || evaluator->constraint_name == NULL)
        return cz_no_memory(error, "the constraints");
    int j = 0;
    for (int i = 0; i < evaluator->list.n_check; i++) {
        const CzCheck *check = &evaluator->list.check[i];
        if (!check->is_constraint)
            continue;
        char name[256];
        snprintf(name, sizeof name, "%s, %s", check->name,
                 cz_check_scenario(check, evaluator->scene));
        evaluator->constraint_check[j] = i;
        evaluator->constraint_name[j] = cz_arena_copy_text(arena, name, strlen(name));
        if (evaluator->constraint_name[j++] == NULL)
            return cz_no_memory(error, "the constraints");
    }
    for (int i = 0; i < evaluator->matches.n_item; i++)
        evaluator->constraint_name[j++] = evaluator->matches.item[i].written->name;
    return CZ_OK;
}

static const CzCheck *constraint_at(const CzEvaluator *evaluator, int constraint) {
    return &evaluator->list.check[evaluator->constraint_check[constraint]];
}

int cz_evaluator_n_detail_of(const CzEvaluator *evaluator, int constraint) {
    const CzCheck *check = constraint_at(evaluator, constraint);
    return cz_check_n_detail(
        check, check->scenario == CZ_NO_SCENARIO ? NULL : &evaluator->scene[check->scenario]);
}

/* Counts one detail per place of a constraint whose worst place counts, one for every other
 * constraint. */
static void count_details(CzEvaluator *evaluator) {
    for (int i = 0; i < evaluator->matches.n_item; i++)
        evaluator->n_detail += cz_match_n_detail(&evaluator->matches.item[i]);
    if (evaluator->matches.n_item > 0)
        return; /* the details of a fit are its residuals */
    for (int j = 0; j < evaluator->list.n_constraint; j++)
        evaluator->n_detail += cz_evaluator_n_detail_of(evaluator, j);
}

static CzStatus build_objective(CzEvaluator *evaluator, const CzAim *aim, CzError *error) {
    const CzOptimise *optimise = &cz_problem_input(evaluator->problem)->optimise;
    evaluator->objective_name = "smallest margin, negative";
    evaluator->objective_unit = "";
    if (evaluator->matches.n_item > 0)
        evaluator->objective_name = "weighted sum of squared residuals";
    const char *written = optimise->given ? optimise->minimise : NULL;
    const char *minimise = aim != NULL ? aim->minimise : written;
    if (minimise == NULL)
        return CZ_OK;
    const CzStatus status = cz_metric_parse(minimise, &evaluator->objective, error);
    if (status != CZ_OK && aim == NULL)
        return cz_problem_place_failure(evaluator->problem, &optimise->minimise, status, error);
    CZ_TRY(status);
    evaluator->objective_name = cz_arena_copy_text(&evaluator->arena, minimise, strlen(minimise));
    if (evaluator->objective_name == NULL)
        return cz_no_memory(error, "the objective");
    evaluator->objective_unit = evaluator->objective.kind->unit->text;
    return CZ_OK;
}

static const char *copy_text(CzArena *arena, const char *text) {
    return text != NULL ? cz_arena_copy_text(arena, text, strlen(text)) : NULL;
}

/* Keeps what workers need to make the evaluator. */
static CzStatus begin_study(CzEvaluator *evaluator, const CzAim *aim, CzError *error) {
    CzArena *arena = &evaluator->arena;
    CzAim *kept = cz_arena_allocate(arena, 1, sizeof *kept);
    evaluator->study = cz_arena_allocate(arena, 1, sizeof *evaluator->study);
    if (kept == NULL || evaluator->study == NULL)
        return cz_no_memory(error, "the evaluator");
    *evaluator->study = (CzStudy){.executor = evaluator->executor,
                                  .kind = CZ_STUDY_OF_RUNS,
                                  .describe = cz_evaluator_describe,
                                  .data = evaluator};
    if (aim == NULL)
        return CZ_OK;
    *kept = *aim;
    kept->minimise = copy_text(arena, aim->minimise);
    kept->bounded = copy_text(arena, aim->bounded);
    evaluator->aim = kept;
    return arena->out_of_memory ? cz_no_memory(error, "the evaluator") : CZ_OK;
}

static CzStatus build(CzEvaluator *evaluator, const CzEvaluatorOptions *options, CzError *error) {
    const CzProblem *problem = evaluator->problem;
    CzArena *arena = &evaluator->arena;
    CZ_TRY(begin_study(evaluator, options->aim, error));
    cz_problem_vehicles(problem, &evaluator->n_vehicle);
    CZ_TRY(cz_scenes_build(problem, arena, &evaluator->n_scene, &evaluator->scene, error));
    evaluator->n_variation = (int)cz_scenes_n_variation(evaluator->n_scene, evaluator->scene);
    evaluator->length = cz_arena_numbers(arena, (size_t)evaluator->n_scene);
    evaluator->is_left_out = cz_arena_allocate(arena, (size_t)evaluator->n_scene, sizeof(bool));
    if (evaluator->length == NULL || evaluator->is_left_out == NULL)
        return cz_no_memory(error, "the scenarios");
    CZ_TRY(cz_obstacles_find(problem, evaluator->n_scene, evaluator->scene, arena,
                             &evaluator->obstacles, error));
    CZ_TRY(cz_design_build(problem, evaluator->n_scene, evaluator->scene, arena, &evaluator->design,
                           error));
    CZ_TRY(cz_variations_build(problem, evaluator->n_scene, evaluator->scene, arena,
                               &evaluator->design, error));
    CZ_TRY(cz_checklist_build(problem, evaluator->n_scene, evaluator->scene, arena,
                              &evaluator->list, error));
    if (options->aim != NULL)
        CZ_TRY(cz_checklist_aim(problem, options->aim, evaluator->n_scene, evaluator->scene, arena,
                                &evaluator->list, error));
    CZ_TRY(cz_matches_build(problem, evaluator->n_scene, evaluator->scene, arena,
                            &evaluator->matches, error));
    CZ_TRY(list_constraints(evaluator, error));
    CZ_TRY(build_objective(evaluator, options->aim, error));
    count_details(evaluator);
    return build_models(evaluator, options->scenario, error);
}

CzStatus cz_evaluator_build(const CzProblem *problem, const CzEvaluatorOptions *options,
                            CzEvaluator **evaluator, CzError *error) {
    const CzEvaluatorOptions given = options != NULL ? *options : cz_evaluator_options_default();
    *evaluator = NULL;
    if (!(given.step_factor > 0) || given.n_job < 0)
        return cz_fail(error, CZ_STATUS_INPUT,
                       "the factor on the step must be above 0 and the number of jobs not below 0");
    CzEvaluator *built = calloc(1, sizeof *built);
    if (built == NULL)
        return cz_no_memory(error, "the evaluator");
    built->problem = problem;
    built->executor = cz_executor_choose(given.executor, given.n_job);
    built->first_scenario = given.first_scenario;
    built->beside = given.beside;
    built->manner = (CzManner){.step_factor = given.step_factor, .integrator = given.integrator};
    const CzStatus status = build(built, &given, error);
    if (status != CZ_OK) {
        cz_evaluator_free(built);
        return status;
    }
    *evaluator = built;
    return CZ_OK;
}

void cz_evaluator_free(CzEvaluator *evaluator) {
    if (evaluator == NULL)
        return;
    if (evaluator->study != NULL)
        cz_study_end(evaluator->study);
    for (int i = 0; i < evaluator->n_variant; i++)
        cz_variant_free(&evaluator->variant[i]);
    cz_arena_free(&evaluator->arena);
    free(evaluator->wanted);
    free(evaluator);
}

int cz_evaluator_n_variable(const CzEvaluator *evaluator) {
    return evaluator->design.n_variable;
}

const CzVariableInfo *cz_evaluator_variable(const CzEvaluator *evaluator, int variable) {
    return &evaluator->design.variable[variable].info;
}

int cz_evaluator_n_constraint(const CzEvaluator *evaluator) {
    return evaluator->list.n_constraint + evaluator->matches.n_item;
}

const char *cz_evaluator_constraint_name(const CzEvaluator *evaluator, int constraint) {
    return evaluator->constraint_name[constraint];
}

bool cz_evaluator_can_select(const CzEvaluator *evaluator) {
    return evaluator->matches.n_item == 0 && evaluator->own_objective == NULL;
}

int cz_evaluator_n_scenario(const CzEvaluator *evaluator) {
    return evaluator->n_scene;
}

const char *cz_evaluator_scenario_name(const CzEvaluator *evaluator, int scenario) {
    return evaluator->scene[scenario].name;
}

bool cz_evaluator_has_run_of(const CzEvaluator *evaluator, int scenario) {
    return evaluator->model[scenario] != NULL && !evaluator->is_left_out[scenario];
}

int cz_evaluator_constraint_scenario(const CzEvaluator *evaluator, int constraint) {
    return constraint_at(evaluator, constraint)->scenario;
}

const char *cz_evaluator_constraint_check(const CzEvaluator *evaluator, int constraint) {
    return constraint_at(evaluator, constraint)->name;
}

const char *cz_evaluator_objective_name(const CzEvaluator *evaluator) {
    return evaluator->objective_name;
}

const char *cz_evaluator_objective_unit(const CzEvaluator *evaluator) {
    return evaluator->objective_unit;
}

const CzProblem *cz_evaluator_problem(const CzEvaluator *evaluator) {
    return evaluator->problem;
}

int cz_evaluator_n_check(const CzEvaluator *evaluator) {
    int n = evaluator->matches.n_item;
    for (int i = 0; i < evaluator->list.n_check; i++)
        n += !evaluator->list.check[i].is_target;
    return n;
}

void cz_evaluator_name_checks(const CzEvaluator *evaluator, const char **name,
                              const char **scenario) {
    int n = 0;
    for (int i = 0; i < evaluator->list.n_check; i++) {
        const CzCheck *check = &evaluator->list.check[i];
        if (check->is_target)
            continue;
        name[n] = check->name;
        scenario[n++] =
            check->scenario == CZ_NO_SCENARIO ? NULL : evaluator->scene[check->scenario].name;
    }
    for (int i = 0; i < evaluator->matches.n_item; i++) {
        name[n] = evaluator->matches.item[i].written->name;
        scenario[n++] = evaluator->scene[evaluator->matches.item[i].scenario].name;
    }
}

int cz_evaluator_n_detail(const CzEvaluator *evaluator) {
    return evaluator->n_detail;
}

static CzDetailKind detail_kind_of(const CzCheck *check) {
    if (check->scenario == CZ_NO_SCENARIO)
        return CZ_DETAIL_OF_DESIGN;
    return cz_check_is_activation(check) ? CZ_DETAIL_ACTIVATION : CZ_DETAIL_OF_RUN;
}

void cz_evaluator_detail_kinds(const CzEvaluator *evaluator, CzDetailKind *kind) {
    int n = 0;
    while (evaluator->matches.n_item > 0 && n < evaluator->n_detail)
        kind[n++] = CZ_DETAIL_OF_RUN;
    for (int j = 0; n < evaluator->n_detail; j++) {
        const CzDetailKind kind_of_all = detail_kind_of(constraint_at(evaluator, j));
        for (int k = cz_evaluator_n_detail_of(evaluator, j); k > 0; k--)
            kind[n++] = kind_of_all;
    }
}

CzConstraintKind cz_evaluator_constraint_kind(const CzEvaluator *evaluator, int constraint) {
    if (constraint >= evaluator->list.n_constraint)
        return CZ_CONSTRAINT_FLAG; /* the objective is the sum of the matches */
    const CzCheck *check = &evaluator->list.check[evaluator->constraint_check[constraint]];
    if (check->is_rule)
        return check->scale == CZ_FLAG_SCALE ? CZ_CONSTRAINT_RULES : CZ_CONSTRAINT_NAMED_RULE;
    return check->scale == CZ_FLAG_SCALE ? CZ_CONSTRAINT_FLAG : CZ_CONSTRAINT_GRADED;
}

void cz_evaluator_set_stop(CzEvaluator *evaluator, const volatile sig_atomic_t *stop) {
    evaluator->stop = stop;
}

/* Checks the vehicles at the start, with fixed variables at their value. Vehicles of a fit are
 * checked when its designs are reread. */
static CzStatus check_start_vehicles(const CzEvaluator *evaluator, CzError *error) {
    const CzDesign *design = &evaluator->design;
    const size_t n_vehicle = (size_t)evaluator->n_vehicle;
    if (design->is_fit)
        return CZ_OK;
    double *x = calloc((size_t)design->n_variable + 1, sizeof *x);
    CzVehicle *vehicles = malloc(n_vehicle * sizeof *vehicles);
    CzStatus status;
    if (x == NULL || vehicles == NULL) {
        status = cz_no_memory(error, "the start of a search");
    } else {
        for (int i = 0; i < design->n_variable; i++) {
            const CzVariableInfo *info = &design->variable[i].info;
            x[i] = info->is_fixed ? info->fixed_at : info->start;
        }
        memcpy(vehicles, evaluator->vehicles, n_vehicle * sizeof *vehicles);
        cz_design_apply(design, 0, x, vehicles);
        CzError broken = {0};
        status = cz_problem_check_vehicles(evaluator->problem, vehicles, &broken);
        if (status != CZ_OK) {
            cz_fail(error, status, "the start of the search breaks a rule: %.400s", broken.message);
            if (error != NULL && design->n_variable > 0)
                cz_problem_place(evaluator->problem, design->variable[0].start_field, error);
        }
    }
    free(vehicles);
    free(x);
    return status;
}

CzStatus cz_evaluator_check_start(const CzEvaluator *evaluator, CzError *error) {
    CZ_TRY(cz_design_check_start(evaluator->problem, &evaluator->design, error));
    return check_start_vehicles(evaluator, error);
}

const char *cz_evaluator_fixed_by_change(const CzEvaluator *evaluator) {
    const CzDesign *design = &evaluator->design;
    for (int i = 0; i < design->n_change; i++)
        if (design->change[i].kind == CZ_CASE_VALUE)
            for (int s = 0; s < evaluator->n_scene; s++)
                if (evaluator->scene[s].variation == design->change[i].variation &&
                    !evaluator->scene[s].has_reserves)
                    return design->variable[design->change[i].variable].info.name;
    return NULL;
}

CzStatus cz_evaluator_read_design(const CzEvaluator *evaluator, const double *x,
                                  CzProblem **problem, CzError *error) {
    CzArena arena = {0};
    CzVariantSettings settings;
    CzStatus status;
    if (cz_design_settings(&evaluator->design, cz_design_combination(&evaluator->design, x), x,
                           &arena, &settings))
        status = cz_problem_read_again(evaluator->problem, settings.n, settings.path,
                                       settings.value, problem, error);
    else
        status = cz_no_memory(error, "the settings of a design");
    cz_arena_free(&arena);
    if (status == CZ_OK && !cz_problem_take_targets(*problem, evaluator->problem))
        status = cz_no_memory(error, "the variables of a design");
    return status;
}

int cz_evaluator_n_combination(const CzEvaluator *evaluator) {
    return evaluator->n_variant;
}

void cz_evaluator_set_combination(const CzEvaluator *evaluator, int combination, double *x) {
    for (int i = 0; i < evaluator->design.n_variable; i++)
        if (evaluator->design.variable[i].info.n_choice > 0)
            x[i] = cz_design_choice(&evaluator->design, combination, i);
}

bool cz_evaluator_is_fit(const CzEvaluator *evaluator) {
    return evaluator->matches.n_item > 0;
}

bool cz_evaluator_maximises_margin(const CzEvaluator *evaluator) {
    return evaluator->own_objective == NULL && evaluator->objective.kind == NULL &&
           !cz_evaluator_is_fit(evaluator);
}

void cz_evaluator_set_objective(CzEvaluator *evaluator, const char *name, const char *unit,
                                CzObjective objective, void *data) {
    evaluator->objective_name = name;
    evaluator->objective_unit = unit;
    evaluator->own_objective = objective;
    evaluator->own_data = data;
}
