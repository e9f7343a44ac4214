/* Evaluator: many designs through all scenarios, each answered by objective, constraints, checks.
 *
 *   designs x scenarios --tasks of a few lanes--> runs --checks--> results --compose--> evaluation
 *
 * Runs are stored by design and scenario and composed in that order, so that neither the number of
 * threads nor the neighbours of a design change a bit of its answer.
 */
#include "evaluate/evaluator.h"
#include "base/error.h"
#include "evaluate/checks.h"
#include "evaluate/design.h"
#include "evaluate/tasks.h"
#include "simulate/batch.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Designs whose vehicle records are held at a time. */
enum { BLOCK = 64 };

struct CzEvaluator {
    CzArena arena;
    const CzProblem *problem;
    int n_job;
    double step_factor;
    bool brief;
    int n_scene;
    CzScene *scene;            /* (n_scene) */
    CzModel **model;           /* (n_scene); NULL for scenarios left out */
    const CzVehicle *vehicles; /* as written (n_vehicle) */
    int n_vehicle;
    double rate; /* rate of flow that tube forces are judged at: half the largest closing speed
                    [m/s] */
    CzDesign design;
    CzChecklist list;
    int *constraint_check;        /* check behind each constraint (n_constraint) */
    const char **constraint_name; /* (n_constraint) */
    CzMetric objective;           /* kind NULL: the smallest margin */
    const char *objective_name, *objective_unit;
    CzObjective own_objective; /* the caller's; NULL when none */
    void *own_data;
};

CzEvaluatorOptions cz_evaluator_options_default(void) {
    return (CzEvaluatorOptions){.n_job = 0, .step_factor = 1, .scenario = NULL};
}

/* ---- building
 * ------------------------------------------------------------------------------------------ */

static CzStatus build_models(CzEvaluator *evaluator, const char *only, CzError *error) {
    evaluator->model =
        cz_arena_allocate(&evaluator->arena, (size_t)evaluator->n_scene, sizeof(CzModel *));
    if (evaluator->model == NULL)
        return cz_fail(error, CZ_STATUS_NO_MEMORY, "no memory for the models");
    bool any = false;
    for (int s = 0; s < evaluator->n_scene; s++) {
        evaluator->rate = fmax(evaluator->rate, evaluator->scene[s].closing_speed / 2);
        if (only != NULL && strcmp(only, evaluator->scene[s].name) != 0)
            continue;
        any = true;
        CZ_TRY(cz_model_build(evaluator->problem, s, &evaluator->model[s], error));
    }
    return any ? CZ_OK : cz_fail(error, CZ_STATUS_INPUT, "there is no scenario '%s'", only);
}

/* Names the constraints: check and scenario. */
static CzStatus list_constraints(CzEvaluator *evaluator, CzError *error) {
    const size_t n = (size_t)evaluator->list.n_constraint;
    CzArena *arena = &evaluator->arena;
    evaluator->constraint_check = cz_arena_allocate(arena, n + 1, sizeof(int));
    evaluator->constraint_name = cz_arena_allocate(arena, n + 1, sizeof(char *));
    if (evaluator->constraint_check == NULL || evaluator->constraint_name == NULL)
        return cz_fail(error, CZ_STATUS_NO_MEMORY, "no memory for the constraints");
    int j = 0;
    for (int i = 0; i < evaluator->list.n_check; i++) {
        const CzCheck *check = &evaluator->list.check[i];
        if (!check->is_constraint)
            continue;
        char name[256];
        snprintf(name, sizeof name, "%s, %s", check->name,
                 check->scenario == CZ_NO_SCENARIO ? "design"
                                                   : evaluator->scene[check->scenario].name);
        evaluator->constraint_check[j] = i;
        evaluator->constraint_name[j] = cz_arena_copy_text(arena, name, strlen(name));
        if (evaluator->constraint_name[j++] == NULL)
            return cz_fail(error, CZ_STATUS_NO_MEMORY, "no memory for the constraints");
    }
    return CZ_OK;
}

static CzStatus build_objective(CzEvaluator *evaluator, CzError *error) {
    const CzOptimise *optimise = &cz_problem_input(evaluator->problem)->optimise;
    evaluator->objective_name = "smallest margin, negative";
    evaluator->objective_unit = "";
    if (!optimise->given || optimise->minimise == NULL)
        return CZ_OK;
    const CzStatus status = cz_metric_parse(optimise->minimise, &evaluator->objective, error);
    if (status != CZ_OK) {
        if (error != NULL)
            cz_problem_place(evaluator->problem, &optimise->minimise, error);
        return status;
    }
    evaluator->objective_name = optimise->minimise;
    evaluator->objective_unit = evaluator->objective.kind->unit;
    return CZ_OK;
}

static CzStatus build(CzEvaluator *evaluator, const char *only, CzError *error) {
    const CzProblem *problem = evaluator->problem;
    CzArena *arena = &evaluator->arena;
    evaluator->vehicles = cz_problem_vehicles(problem, &evaluator->n_vehicle);
    CZ_TRY(cz_scenes_build(problem, arena, &evaluator->n_scene, &evaluator->scene, error));
    CZ_TRY(cz_design_build(problem, evaluator->n_scene, evaluator->scene, arena, &evaluator->design,
                           error));
    CZ_TRY(cz_checklist_build(problem, evaluator->n_scene, evaluator->scene, arena,
                              &evaluator->list, error));
    CZ_TRY(list_constraints(evaluator, error));
    CZ_TRY(build_objective(evaluator, error));
    return build_models(evaluator, only, error);
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
        return cz_fail(error, CZ_STATUS_NO_MEMORY, "no memory for the evaluator");
    built->problem = problem;
    built->n_job = given.n_job > 0 ? given.n_job : cz_processor_count();
    built->step_factor = given.step_factor;
    built->brief = given.brief;
    const CzStatus status = build(built, given.scenario, error);
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
    for (int s = 0; evaluator->model != NULL && s < evaluator->n_scene; s++)
        cz_model_free(evaluator->model[s]);
    cz_arena_free(&evaluator->arena);
    free(evaluator);
}

int cz_evaluator_n_variable(const CzEvaluator *evaluator) {
    return evaluator->design.n_variable;
}

const CzVariableInfo *cz_evaluator_variable(const CzEvaluator *evaluator, int variable) {
    return &evaluator->design.variable[variable].info;
}

int cz_evaluator_n_place(const CzEvaluator *evaluator, int variable) {
    return evaluator->design.variable[variable].n_shown;
}

CzVariablePlace cz_evaluator_place(const CzEvaluator *evaluator, int variable, int place) {
    return evaluator->design.variable[variable].shown[place];
}

int cz_evaluator_n_constraint(const CzEvaluator *evaluator) {
    return evaluator->list.n_constraint;
}

const char *cz_evaluator_constraint_name(const CzEvaluator *evaluator, int constraint) {
    return evaluator->constraint_name[constraint];
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

bool cz_evaluator_is_flag(const CzEvaluator *evaluator, int constraint) {
    return evaluator->list.check[evaluator->constraint_check[constraint]].scale == CZ_FLAG_SCALE;
}

bool cz_evaluator_maximises_margin(const CzEvaluator *evaluator) {
    return evaluator->own_objective == NULL && evaluator->objective.kind == NULL;
}

void cz_evaluator_set_objective(CzEvaluator *evaluator, const char *name, const char *unit,
                                CzObjective objective, void *data) {
    evaluator->objective_name = name;
    evaluator->objective_unit = unit;
    evaluator->own_objective = objective;
    evaluator->own_data = data;
}

/* ---- composing one design's answer
 * ---------------------------------------------------------------------- */

/* Why a scenario gives no values; NULL when it does. */
static const char *failure_of(const CzRunSummary *run) {
    if (run == NULL)
        return "this scenario was not run";
    if (run->status != CZ_OK)
        return "the run of this scenario failed";
    return run->ended == CZ_ENDED_INCOMPLETE ? "the run of this scenario did not come to its end"
                                             : NULL;
}

static CzSubject subject_of(const CzEvaluator *evaluator, const CzVehicle *vehicles, int scenario,
                            const CzRunSummary *const *run) {
    const CzInput *input = cz_problem_input(evaluator->problem);
    CzSubject subject = {.vehicles = vehicles,
                         .n_vehicle = evaluator->n_vehicle,
                         .n_first_train = input->trains[0].n_vehicles,
                         .rate = evaluator->rate};
    if (scenario != CZ_NO_SCENARIO) {
        subject.scene = &evaluator->scene[scenario];
        subject.run = run[scenario];
    }
    return subject;
}

static double metric_objective(const CzEvaluator *evaluator, const CzVehicle *vehicles,
                               const CzRunSummary *const *run) {
    const CzLevel level = evaluator->objective.kind->level;
    if (level == CZ_LEVEL_END || level == CZ_LEVEL_DESIGN) {
        const CzSubject subject = subject_of(evaluator, vehicles, CZ_NO_SCENARIO, run);
        return cz_metric_value(&evaluator->objective, &subject, true).value;
    }
    double worst = NAN;
    for (int s = 0; s < evaluator->n_scene; s++) {
        if (evaluator->scene[s].is_overload || run[s] == NULL)
            continue;
        const CzSubject subject = subject_of(evaluator, vehicles, s, run);
        worst = fmax(worst, cz_metric_value(&evaluator->objective, &subject, true).value);
    }
    return worst;
}

/* The smallest margin of all constraints, negative: what is maximised when nothing is minimised.
 * A yes or no has no margin to enlarge. */
static double margin_objective(const CzEvaluator *evaluator, const CzEvaluation *evaluation) {
    double smallest = INFINITY;
    for (int j = 0; j < evaluation->n_constraint; j++) {
        const CzCheck *check = &evaluator->list.check[evaluator->constraint_check[j]];
        if (check->scale != CZ_FLAG_SCALE) /* fmin passes over NaN */
            smallest = fmin(smallest, evaluation->constraint_check[j].margin);
    }
    return isinf(smallest) ? NAN : -smallest;
}

static void set_objective(const CzEvaluator *evaluator, const CzVehicle *vehicles,
                          const CzRunSummary *const *run, CzEvaluation *evaluation) {
    if (evaluator->own_objective != NULL)
        evaluation->objective =
            evaluator->own_objective(evaluator->n_scene, run, evaluator->own_data);
    else if (evaluator->objective.kind != NULL)
        evaluation->objective = metric_objective(evaluator, vehicles, run);
    else
        evaluation->objective = margin_objective(evaluator, evaluation);
}

static void set_failed(CzEvaluation *evaluation) {
    evaluation->status = CZ_STATUS_RUN_FAILED;
    evaluation->objective = NAN;
    evaluation->violation = INFINITY;
    for (int j = 0; j < evaluation->n_constraint; j++)
        evaluation->constraint[j] = NAN;
}

static void judge_all(const CzEvaluator *evaluator, const CzVehicle *vehicles,
                      const CzRunSummary *const *run, CzCheckResult *all) {
    for (int i = 0; i < evaluator->list.n_check; i++) {
        const CzCheck *check = &evaluator->list.check[i];
        const CzSubject subject = subject_of(evaluator, vehicles, check->scenario, run);
        const char *failure =
            check->scenario == CZ_NO_SCENARIO ? NULL : failure_of(run[check->scenario]);
        all[i] = cz_check_judge(check, &subject, failure);
    }
}

/* Sorts the judged checks into what is listed and what binds the optimiser. */
static void sort_results(const CzEvaluator *evaluator, const CzCheckResult *all,
                         CzEvaluation *evaluation) {
    for (int i = 0; i < evaluator->list.n_check; i++) {
        const CzCheck *check = &evaluator->list.check[i];
        if (!check->is_target)
            evaluation->check[evaluation->n_check++] = all[i];
        if (!check->is_constraint)
            continue;
        const int j = evaluation->n_constraint++;
        evaluation->constraint_check[j] = all[i];
        const double constraint = cz_check_constraint(&all[i], evaluator->list.required_margin);
        evaluation->constraint[j] = isnan(constraint) ? 0 : constraint;
        evaluation->violation = fmax(evaluation->violation, evaluation->constraint[j]);
    }
}

static CzStatus compose(const CzEvaluator *evaluator, const CzVehicle *vehicles,
                        const CzRunSummary *const *run, CzEvaluation *evaluation, CzError *error) {
    const size_t n_check = (size_t)evaluator->list.n_check + 1;
    const size_t n_constraint = (size_t)evaluator->list.n_constraint + 1;
    CzCheckResult *all = malloc(n_check * sizeof *all);
    evaluation->check = malloc(n_check * sizeof *evaluation->check);
    evaluation->constraint = malloc(n_constraint * sizeof(double));
    evaluation->constraint_check = malloc(n_constraint * sizeof *evaluation->constraint_check);
    if (all == NULL || evaluation->check == NULL || evaluation->constraint == NULL ||
        evaluation->constraint_check == NULL) {
        free(all);
        return cz_fail(error, CZ_STATUS_NO_MEMORY, "no memory for the checks of a design");
    }
    judge_all(evaluator, vehicles, run, all);
    sort_results(evaluator, all, evaluation);
    evaluation->verdict = cz_verdict_over(evaluator->list.n_check, evaluator->list.check, all);
    free(all);
    bool failed = false;
    for (int s = 0; s < evaluator->n_scene; s++)
        failed |= run[s] != NULL && failure_of(run[s]) != NULL;
    if (!failed)
        set_objective(evaluator, vehicles, run, evaluation);
    if (failed || !isfinite(evaluation->objective)) {
        const bool nothing_to_minimise =
            !failed && evaluator->own_objective == NULL && evaluator->objective.kind == NULL;
        if (nothing_to_minimise)
            evaluation->objective = 0;
        else
            set_failed(evaluation);
    }
    return CZ_OK;
}

/* ---- running a block of designs
 * --------------------------------------------------------------------------- */

/* One block of designs on its way through all scenarios. */
typedef struct Block {
    const CzEvaluator *evaluator;
    int n_point;
    const CzVehicle *vehicle[BLOCK]; /* the whole vehicle array of each design (n_point) */
    CzRun **run;                     /* (n_point x n_scene) */
    bool record;
    int n_task;
    struct {
        int scene, first, n;
    } * task;         /* (n_task) */
    CzStatus *status; /* (n_task) */
    CzError *error;   /* (n_task) */
} Block;

static void run_task(int index, void *data) {
    const Block *block = data;
    const CzEvaluator *evaluator = block->evaluator;
    const int s = block->task[index].scene, first = block->task[index].first;
    const CzModel *model = evaluator->model[s];
    CzSimulateOptions options = cz_simulate_options_default();
    options.record = block->record;
    options.brief = evaluator->brief;
    if (evaluator->step_factor != 1)
        options.time_step = cz_model_time_step(model) * evaluator->step_factor;
    CzRun *run[BLOCK] = {NULL};
    block->status[index] = cz_simulate_batch(model, block->task[index].n, &block->vehicle[first],
                                             &options, run, &block->error[index]);
    for (int i = 0; i < block->task[index].n; i++)
        block->run[(first + i) * evaluator->n_scene + s] = run[i];
}

/* Cuts designs and scenarios into tasks that fill the lanes, and at least one task per thread where
 * there are designs enough. */
static void cut_tasks(Block *block) {
    const CzEvaluator *evaluator = block->evaluator;
    block->n_task = 0;
    for (int s = 0; s < evaluator->n_scene; s++) {
        if (evaluator->model[s] == NULL)
            continue;
        const int width = cz_simulate_batch_width(evaluator->model[s]);
        const int n_chunk = (block->n_point + width - 1) / width;
        for (int chunk = 0, first = 0; chunk < n_chunk; chunk++) {
            const int n = (block->n_point - first) / (n_chunk - chunk); /* even chunks */
            block->task[block->n_task].scene = s;
            block->task[block->n_task].first = first;
            block->task[block->n_task++].n = n;
            first += n;
        }
    }
}

static CzStatus run_block(Block *block, CzError *error) {
    const CzEvaluator *evaluator = block->evaluator;
    const size_t most = (size_t)evaluator->n_scene * (size_t)block->n_point;
    block->task = calloc(most, sizeof *block->task);
    block->status = calloc(most, sizeof *block->status);
    block->error = calloc(most, sizeof *block->error);
    CzStatus status = CZ_OK;
    if (block->task == NULL || block->status == NULL || block->error == NULL) {
        status = cz_fail(error, CZ_STATUS_NO_MEMORY, "no memory for %d designs", block->n_point);
    } else {
        cut_tasks(block);
        cz_tasks_run(block->n_task, evaluator->n_job, run_task, block);
    }
    for (int i = 0; status == CZ_OK && i < block->n_task; i++)
        if (block->status[i] != CZ_OK) {
            status = block->status[i];
            if (error != NULL)
                *error = block->error[i];
        }
    free(block->task);
    free(block->status);
    free(block->error);
    return status;
}

/* Judges each design of a finished block and keeps or frees its runs. */
static CzStatus compose_block(Block *block, bool keep_runs, CzEvaluation *evaluation,
                              CzError *error) {
    const int n_scene = block->evaluator->n_scene;
    const CzRunSummary **summary = calloc((size_t)n_scene, sizeof *summary);
    if (summary == NULL)
        return cz_fail(error, CZ_STATUS_NO_MEMORY, "no memory for %d scenarios", n_scene);
    CzStatus status = CZ_OK;
    for (int i = 0; i < block->n_point && status == CZ_OK; i++) {
        CzRun **run = &block->run[i * n_scene];
        for (int s = 0; s < n_scene; s++)
            summary[s] = run[s] != NULL ? cz_run_summary(run[s]) : NULL;
        status = compose(block->evaluator, block->vehicle[i], summary, &evaluation[i], error);
        if (status != CZ_OK || !keep_runs)
            continue;
        evaluation[i].run = calloc((size_t)n_scene, sizeof(CzRun *));
        if (evaluation[i].run == NULL)
            status = cz_fail(error, CZ_STATUS_NO_MEMORY, "no memory for %d runs", n_scene);
        for (int s = 0; s < n_scene && status == CZ_OK; s++)
            if (run[s] != NULL) {
                evaluation[i].run[evaluation[i].n_run++] = run[s];
                run[s] = NULL;
            }
    }
    free(summary);
    return status;
}

static CzStatus evaluate_block(const CzEvaluator *evaluator, int n_point, const double *x,
                               bool keep_runs, CzEvaluation *evaluation, CzError *error) {
    const size_t n_vehicle = (size_t)evaluator->n_vehicle;
    Block block = {.evaluator = evaluator, .n_point = n_point, .record = keep_runs};
    CzVehicle *copies = malloc((size_t)n_point * n_vehicle * sizeof *copies);
    block.run = calloc((size_t)n_point * (size_t)evaluator->n_scene, sizeof(CzRun *));
    CzStatus status = CZ_OK;
    if (copies == NULL || block.run == NULL)
        status = cz_fail(error, CZ_STATUS_NO_MEMORY, "no memory for %d designs", n_point);
    for (int i = 0; i < n_point && status == CZ_OK; i++) {
        CzVehicle *vehicles = copies + (size_t)i * n_vehicle;
        memcpy(vehicles, evaluator->vehicles, n_vehicle * sizeof *vehicles);
        if (x != NULL)
            cz_design_apply(&evaluator->design, x + i * evaluator->design.n_variable, vehicles);
        block.vehicle[i] = vehicles;
    }
    if (status == CZ_OK)
        status = run_block(&block, error);
    if (status == CZ_OK)
        status = compose_block(&block, keep_runs, evaluation, error);
    for (int i = 0; block.run != NULL && i < n_point * evaluator->n_scene; i++)
        cz_run_free(block.run[i]);
    free(block.run);
    free(copies);
    return status;
}

CzStatus cz_evaluate(CzEvaluator *evaluator, int n_point, const double *x, bool keep_runs,
                     CzEvaluation *evaluation, CzError *error) {
    memset(evaluation, 0, (size_t)n_point * sizeof *evaluation);
    CzStatus status = CZ_OK;
    for (int first = 0; first < n_point && status == CZ_OK; first += BLOCK) {
        const int n = n_point - first < BLOCK ? n_point - first : BLOCK;
        const double *block_x = x != NULL ? x + first * evaluator->design.n_variable : NULL;
        status = evaluate_block(evaluator, n, block_x, keep_runs, evaluation + first, error);
    }
    for (int i = 0; status != CZ_OK && i < n_point; i++)
        cz_evaluation_free(&evaluation[i]);
    return status;
}

void cz_evaluation_free(CzEvaluation *evaluation) {
    if (evaluation == NULL)
        return;
    for (int i = 0; i < evaluation->n_run; i++)
        cz_run_free(evaluation->run[i]);
    free(evaluation->run);
    free(evaluation->check);
    free(evaluation->constraint);
    free(evaluation->constraint_check);
    memset(evaluation, 0, sizeof *evaluation);
}
