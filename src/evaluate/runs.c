/* Runs many designs in all scenarios on a few threads.
 *
 *   designs x scenarios --batches (run_plan.c)--> runs --compose--> evaluation
 *
 * Runs are stored by design and scenario and composed in that order, so that neither the number of
 * threads nor the neighbours of a design change a bit of its results.
 */
#include "base/error.h"
#include "evaluate/compose.h"
#include "evaluate/run_plan.h"
#include "evaluate/tasks.h"

#include <stdlib.h>
#include <string.h>

/* Number of designs whose vehicle records are in memory at a time. */
enum { BLOCK = 64 };

/* One block of designs in all scenarios. */
typedef struct Block {
    const CzEvaluator *evaluator;
    int n_point;
    const double *x;                 /* (n_point x n_variable); NULL: the file's own values */
    int combination[BLOCK];          /* of each design (n_point) */
    const CzVehicle *vehicle[BLOCK]; /* the vehicles of each design in all variations (n_point) */
    CzVariant own[BLOCK];            /* variants of designs that are read again (n_point) */
    bool is_refused[BLOCK];          /* designs that break a rule of files (n_point) */
    CzRun **run;                     /* (n_point x n_scene) */
    const bool *some;                /* the only scenarios that are run; NULL for all (n_scene) */
    CzEvaluation *begun; /* evaluation of the only design in these scenarios, whose runs are taken
                            over; NULL for none */
    bool record, keep;   /* channels are recorded, runs are kept */
    CzManner manner;
    CzRunPlan plan;
} Block;

/* ---- designs that are reread ------------------------------------------------------------------
 */

/* Builds the variant of one design. A design that violates a rule is rejected, which is a result
 * and not an error. */
static CzStatus reread(int index, void *data, CzError *error) {
    Block *block = data;
    const CzEvaluator *evaluator = block->evaluator;
    CzVariant *variant = &block->own[index];
    CzArena arena = {0};
    const CzVariantScenes scenes = cz_evaluator_scenes(evaluator);
    CzVariantSettings settings;
    CzStatus status;
    const double *x = block->x + index * evaluator->design.n_variable;
    if (cz_design_settings(&evaluator->design, 0, x, &arena, &settings))
        status = cz_variant_build(&scenes, &settings, variant, error);
    else
        status = cz_no_memory(error, "the settings of a design");
    block->is_refused[index] = status == CZ_STATUS_INPUT;
    if (status == CZ_OK)
        block->vehicle[index] = variant->vehicles;
    cz_arena_free(&arena);
    return block->is_refused[index] ? CZ_OK : status;
}

/* ---- runs ------------------------------------------------------------------------------------ */

static CzSimulateOptions options_of(const Block *block) {
    CzSimulateOptions options = cz_simulate_options_default();
    options.record = block->record;
    options.brief = block->manner.brief;
    options.integrator = block->manner.integrator;
    options.track = block->manner.track;
    return options;
}

/* Runs the items of a chunk side by side. */
static CzStatus run_chunk(int index, void *data, CzError *error) {
    const Block *block = data;
    const CzEvaluator *evaluator = block->evaluator;
    const CzRunChunk *chunk = &block->plan.chunk[index];
    const CzRunItem *item = &block->plan.item[chunk->first];
    if (evaluator->stop != NULL && *evaluator->stop != 0)
        return cz_fail(error, CZ_STATUS_INTERRUPTED, "the evaluation was interrupted");
    CzSimulateOptions options = options_of(block);
    if (block->manner.step_factor != 1)
        options.time_step = cz_model_time_step(item->model) * block->manner.step_factor;
    CzPlannedRun *planned = calloc((size_t)chunk->n, sizeof *planned);
    CzRun **run = calloc((size_t)chunk->n, sizeof(CzRun *));
    CzStatus status = CZ_OK;
    if (planned == NULL || run == NULL)
        status = cz_no_memory(error, "the runs");
    for (int i = 0; status == CZ_OK && i < chunk->n; i++)
        planned[i] =
            (CzPlannedRun){item[i].model, cz_vehicles_in(evaluator, block->vehicle[item[i].design],
                                                         item[i].scene)};
    if (status == CZ_OK)
        status = cz_simulate_batch(chunk->n, planned, &options, run, error);
    for (int i = 0; run != NULL && i < chunk->n; i++)
        block->run[item[i].design * evaluator->n_scene + item[i].scene] = run[i];
    free(run);
    free(planned);
    return status;
}

/* Whether a scenario is to be run: one of some, or the rest. */
static bool is_wanted(const Block *block, int design, int scene) {
    if (block->begun != NULL)
        return block->run[design * block->evaluator->n_scene + scene] == NULL;
    return block->some == NULL || block->some[scene];
}

/* Takes over the runs of a design that was evaluated in some scenarios. */
static void take_begun(const Block *block) {
    const CzEvaluator *evaluator = block->evaluator;
    for (int s = 0, k = 0; s < evaluator->n_scene && k < block->begun->n_run; s++)
        if (block->some[s] && cz_evaluator_has_run_of(evaluator, s))
            block->run[s] = block->begun->run[k++];
    block->begun->n_run = 0;
    cz_evaluation_free(block->begun);
}

/* Lists the runs of all designs that are not refused. */
static void list_runs(Block *block) {
    const CzEvaluator *evaluator = block->evaluator;
    for (int i = 0; i < block->n_point; i++) {
        const bool is_reread = block->own[i].model != NULL;
        const CzVariant *variant =
            is_reread ? &block->own[i] : &evaluator->variant[block->combination[i]];
        for (int s = 0; s < evaluator->n_scene && !block->is_refused[i]; s++)
            if (variant->model[s] != NULL && !evaluator->is_left_out[s] && is_wanted(block, i, s))
                block->plan.item[block->plan.n_item++] =
                    (CzRunItem){.design = i,
                                .scene = s,
                                .model = variant->model[s],
                                .length = evaluator->length[s]};
    }
}

/* Records how long the runs of a scenario take, for the order of the next ones. */
static void note_lengths(const Block *block) {
    const CzEvaluator *evaluator = block->evaluator;
    for (int i = 0; i < block->n_point * evaluator->n_scene; i++)
        if (block->run[i] != NULL)
            evaluator->length[i % evaluator->n_scene] = cz_run_summary(block->run[i])->simulated;
}

static CzStatus run_block(Block *block, CzError *error) {
    const CzEvaluator *evaluator = block->evaluator;
    if (evaluator->design.is_fit && block->x != NULL)
        CZ_TRY(cz_tasks_run(&evaluator->executor, block->n_point, reread, block, error));
    const CzSimulateOptions options = options_of(block);
    const bool is_single = block->record || options.integrator != CZ_INTEGRATOR_ZHAI;
    CZ_TRY(cz_run_plan_begin(&block->plan, block->n_point * evaluator->n_scene, error));
    list_runs(block);
    CZ_TRY(cz_run_plan_cut(&block->plan, &options, is_single, evaluator->executor.n_place, error));
    CZ_TRY(cz_tasks_run(&evaluator->executor, block->plan.n_chunk, run_chunk, block, error));
    note_lengths(block);
    return CZ_OK;
}

/* ---- a block --------------------------------------------------------------------------------- */

/* Evaluates each design of a finished block; keeps its runs if requested; fills the details, NaN
 * for designs that failed, unless `detail` is NULL. */
static CzStatus compose_block(Block *block, CzEvaluation *evaluation, double *detail,
                              CzError *error) {
    const int n_scene = block->evaluator->n_scene;
    const CzRunSummary **summary = calloc((size_t)n_scene, sizeof *summary);
    if (summary == NULL)
        return cz_no_memory(error, "the scenarios");
    CzStatus status = CZ_OK;
    for (int i = 0; i < block->n_point && status == CZ_OK; i++) {
        CzRun **run = &block->run[i * n_scene];
        for (int s = 0; s < n_scene; s++)
            summary[s] = run[s] != NULL ? cz_run_summary(run[s]) : NULL;
        status = cz_compose(block->evaluator, block->vehicle[i], summary, run, block->is_refused[i],
                            &evaluation[i], error);
        for (int k = 0; detail != NULL && k < block->evaluator->n_detail; k++)
            detail[i * block->evaluator->n_detail + k] = NAN;
        if (detail != NULL && status == CZ_OK && evaluation[i].status == CZ_OK)
            status = cz_compose_details(block->evaluator, block->vehicle[i], summary, run,
                                        detail + i * block->evaluator->n_detail, error);
        if (status != CZ_OK || !block->keep)
            continue;
        evaluation[i].run = calloc((size_t)n_scene, sizeof(CzRun *));
        if (evaluation[i].run == NULL)
            status = cz_no_memory(error, "the runs");
        for (int s = 0; s < n_scene && status == CZ_OK; s++)
            if (run[s] != NULL) {
                evaluation[i].run[evaluation[i].n_run++] = run[s];
                run[s] = NULL;
            }
    }
    free(summary);
    return status;
}

/* `settings` contains the settings of the runs and the results to keep. */
static CzStatus evaluate_block(const Block *settings, int n_point, const double *x,
                               CzEvaluation *evaluation, double *detail, CzError *error) {
    Block block = *settings;
    const CzEvaluator *evaluator = block.evaluator;
    block.n_point = n_point;
    block.x = x;
    block.record |= evaluator->matches.needs_record;
    block.manner.brief &= evaluator->matches.n_item == 0;
    const size_t n_vehicle = (size_t)(evaluator->n_variation * evaluator->n_vehicle);
    CzVehicle *copies = malloc((size_t)n_point * n_vehicle * sizeof *copies);
    block.run = calloc((size_t)n_point * (size_t)evaluator->n_scene, sizeof(CzRun *));
    CzStatus status = CZ_OK;
    if (copies == NULL || block.run == NULL)
        status = cz_no_memory(error, "the designs");
    for (int i = 0; i < n_point && status == CZ_OK; i++) {
        block.combination[i] =
            x != NULL
                ? cz_design_combination(&evaluator->design, x + i * evaluator->design.n_variable)
                : evaluator->own;
        CzVehicle *vehicles = copies + (size_t)i * n_vehicle;
        memcpy(vehicles, evaluator->variant[block.combination[i]].vehicles,
               n_vehicle * sizeof *vehicles);
        for (int v = 0; x != NULL && v < evaluator->n_variation; v++)
            cz_design_apply(&evaluator->design, v, x + i * evaluator->design.n_variable,
                            vehicles + v * evaluator->n_vehicle);
        block.vehicle[i] = vehicles;
    }
    if (status == CZ_OK && block.begun != NULL)
        take_begun(&block);
    if (status == CZ_OK)
        status = run_block(&block, error);
    if (status == CZ_OK)
        status = compose_block(&block, evaluation, detail, error);
    for (int i = 0; block.run != NULL && i < n_point * evaluator->n_scene; i++)
        cz_run_free(block.run[i]);
    for (int i = 0; i < n_point; i++)
        cz_variant_free(&block.own[i]);
    cz_run_plan_free(&block.plan);
    free(block.run);
    free(copies);
    return status;
}

/* Evaluates all designs, block after block. */
static CzStatus evaluate_all(const Block *settings, int n_point, const double *x,
                             CzEvaluation *evaluation, double *detail, CzError *error) {
    const CzEvaluator *evaluator = settings->evaluator;
    memset(evaluation, 0, (size_t)n_point * sizeof *evaluation);
    CzStatus status = CZ_OK;
    for (int first = 0; first < n_point && status == CZ_OK; first += BLOCK) {
        const int n = n_point - first < BLOCK ? n_point - first : BLOCK;
        status =
            evaluate_block(settings, n, x != NULL ? x + first * evaluator->design.n_variable : NULL,
                           evaluation + first,
                           detail != NULL ? detail + first * evaluator->n_detail : NULL, error);
    }
    for (int i = 0; status != CZ_OK && i < n_point; i++)
        cz_evaluation_free(&evaluation[i]);
    return status;
}

CzStatus cz_evaluate(CzEvaluator *evaluator, int n_point, const double *x, bool keep_runs,
                     CzEvaluation *evaluation, CzError *error) {
    const Block settings = {.evaluator = evaluator,
                            .record = keep_runs,
                            .keep = keep_runs,
                            .manner = evaluator->manner};
    return evaluate_all(&settings, n_point, x, evaluation, NULL, error);
}

/* Settings of the runs of a search. */
static Block search_settings(const CzEvaluator *evaluator) {
    const bool is_fit = evaluator->matches.n_item > 0; /* matches the whole run on its own track */
    return (Block){.evaluator = evaluator,
                   .manner = {.step_factor = evaluator->manner.step_factor,
                              .integrator = CZ_INTEGRATOR_ZHAI,
                              .track = is_fit ? CZ_TRACK_USE_OWN : CZ_TRACK_USE_SEARCH,
                              .brief = true}};
}

CzStatus cz_evaluator_search(const CzEvaluator *evaluator, int n_point, const double *x,
                             CzEvaluation *evaluation, double *detail, CzError *error) {
    const Block settings = search_settings(evaluator);
    return evaluate_all(&settings, n_point, x, evaluation, detail, error);
}

CzStatus cz_evaluator_search_some(const CzEvaluator *evaluator, const bool *some, int n_point,
                                  const double *x, CzEvaluation *evaluation, double *detail,
                                  CzError *error) {
    Block settings = search_settings(evaluator);
    settings.some = some;
    settings.keep = true;
    return evaluate_all(&settings, n_point, x, evaluation, detail, error);
}

CzStatus cz_evaluator_search_rest(const CzEvaluator *evaluator, const bool *some, const double *x,
                                  CzEvaluation *evaluation, double *detail, CzError *error) {
    Block settings = search_settings(evaluator);
    CzEvaluation begun = *evaluation;
    settings.some = some;
    settings.begun = &begun;
    const CzStatus status = evaluate_all(&settings, 1, x, evaluation, detail, error);
    cz_evaluation_free(&begun);
    return status;
}

CzStatus cz_evaluator_again(const CzEvaluator *evaluator, const CzManner *manner, const double *x,
                            CzEvaluation *evaluation, CzError *error) {
    const Block settings = {.evaluator = evaluator, .keep = true, .manner = *manner};
    return evaluate_all(&settings, 1, x, evaluation, NULL, error);
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
    free(evaluation->match);
    free(evaluation->value);
    memset(evaluation, 0, sizeof *evaluation);
}
