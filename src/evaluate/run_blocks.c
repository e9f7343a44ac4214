/* Runs blocks of designs in all scenarios as one batch of tasks.
 *
 *   designs x scenarios --batches (run_plan.c)--> runs --compose--> evaluation
 *
 * Runs are stored by design and scenario and composed in that order, so that neither the number of
 * threads nor the neighbours of a design change a bit of its results.
 */
#include "evaluate/run_blocks.h"

#include "base/error.h"
#include "evaluate/compose.h"
#include "evaluate/tasks.h"
#include "simulate/run_bytes.h"

#include <stdlib.h>
#include <string.h>

/* ---- designs that are reread ------------------------------------------------------------------
 */

/* Builds the variant of one design. A design that violates a rule is rejected, which is a result
 * and not an error. */
static CzStatus reread(int index, void *data, CzError *error) {
    CzRunBlock *block = data;
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

/* ---- designs of a block ---------------------------------------------------------------------- */

/* Applies the designs to copies of the vehicles, and rereads those of a fit; ended also after a
 * failure. */
static CzStatus begin_block(CzRunBlock *block, CzError *error) {
    const CzEvaluator *evaluator = block->evaluator;
    const double *x = block->x;
    const size_t n_point = (size_t)block->n_point;
    const size_t n_vehicle = (size_t)(evaluator->n_variation * evaluator->n_vehicle);
    block->copies = malloc(n_point * n_vehicle * sizeof *block->copies);
    block->run = calloc(n_point * (size_t)evaluator->n_scene, sizeof(CzRun *));
    if (block->copies == NULL || block->run == NULL)
        return cz_no_memory(error, "the designs");
    for (int i = 0; i < block->n_point; i++) {
        block->combination[i] =
            x != NULL
                ? cz_design_combination(&evaluator->design, x + i * evaluator->design.n_variable)
                : evaluator->own;
        CzVehicle *vehicles = block->copies + (size_t)i * n_vehicle;
        memcpy(vehicles, evaluator->variant[block->combination[i]].vehicles,
               n_vehicle * sizeof *vehicles);
        for (int v = 0; x != NULL && v < evaluator->n_variation; v++)
            cz_design_apply(&evaluator->design, v, x + i * evaluator->design.n_variable,
                            vehicles + v * evaluator->n_vehicle);
        block->vehicle[i] = vehicles;
    }
    return evaluator->design.is_fit && x != NULL
               ? cz_tasks_run(&evaluator->executor, block->n_point, reread, block, error)
               : CZ_OK;
}

static void end_block(CzRunBlock *block) {
    for (int i = 0; block->run != NULL && i < block->n_point * block->evaluator->n_scene; i++)
        cz_run_free(block->run[i]);
    for (int i = 0; i < block->n_point; i++)
        cz_variant_free(&block->own[i]);
    cz_run_plan_free(&block->plan);
    free(block->run);
    free(block->copies);
}

/* ---- runs ------------------------------------------------------------------------------------ */

static bool is_stopped(const CzEvaluator *evaluator) {
    return evaluator->stop != NULL && *evaluator->stop != 0;
}

static CzSimulateOptions options_of(const CzRunBlock *block) {
    CzSimulateOptions options = cz_simulate_options_default();
    options.record = block->record;
    options.keep_pulses = block->keep_pulses;
    options.brief = block->manner.brief;
    options.integrator = block->manner.integrator;
    options.track = block->manner.track;
    return options;
}

/* Runs the items of a chunk side by side. */
static CzStatus run_chunk(const CzRunBlock *block, int index, CzError *error) {
    const CzEvaluator *evaluator = block->evaluator;
    const CzRunChunk *chunk = &block->plan.chunk[index];
    const CzRunItem *item = &block->plan.item[chunk->first];
    if (is_stopped(evaluator))
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
static bool is_wanted(const CzRunBlock *block, int design, int scene) {
    if (block->begun != NULL)
        return block->run[design * block->evaluator->n_scene + scene] == NULL;
    return block->some == NULL || block->some[scene];
}

/* Takes over the runs of a design that was evaluated in some scenarios. */
static void take_begun(const CzRunBlock *block) {
    const CzEvaluator *evaluator = block->evaluator;
    for (int s = 0, k = 0; s < evaluator->n_scene && k < block->begun->n_run; s++)
        if (block->some[s] && cz_evaluator_has_run_of(evaluator, s))
            block->run[s] = block->begun->run[k++];
    block->begun->n_run = 0;
    cz_evaluation_free(block->begun);
}

/* Model of a design in a scenario; NULL for one that is left out, and for a design that is refused.
 */
static const CzModel *model_of(const CzRunBlock *block, int design, int scene) {
    const CzVariant *own = &block->own[design];
    const CzVariant *variant =
        own->model != NULL ? own : &block->evaluator->variant[block->combination[design]];
    return block->is_refused[design] ? NULL : variant->model[scene];
}

static void list_run(CzRunBlock *block, int design, int scene) {
    const CzModel *model = model_of(block, design, scene);
    if (model != NULL && !block->evaluator->is_left_out[scene])
        block->plan.item[block->plan.n_item++] =
            (CzRunItem){.design = design,
                        .scene = scene,
                        .model = model,
                        .length = block->evaluator->length[scene]};
}

static void list_runs(CzRunBlock *block) {
    for (int i = 0; i < block->n_point; i++)
        for (int s = 0; s < block->evaluator->n_scene; s++)
            if (is_wanted(block, i, s))
                list_run(block, i, s);
}

/* Records how long the runs of a scenario take, for the order of the next ones. */
static void note_lengths(const CzRunBlock *block) {
    const CzEvaluator *evaluator = block->evaluator;
    for (int i = 0; i < block->n_point * evaluator->n_scene; i++)
        if (block->run[i] != NULL)
            evaluator->length[i % evaluator->n_scene] = cz_run_summary(block->run[i])->simulated;
}

/* ---- chunks in workers ----------------------------------------------------------------------- */

/* Designs of a chunk, each once. */
typedef struct ChunkDesigns {
    int n, design[CZ_BLOCK_DESIGNS];
} ChunkDesigns;

/* Number of a design among those of the chunk, which it joins unless it is one of them. */
static int number_of(ChunkDesigns *designs, int design) {
    int i = 0;
    while (i < designs->n && designs->design[i] != design)
        i++;
    if (i == designs->n)
        designs->design[designs->n++] = design;
    return i;
}

static bool request_chunk(const CzRunBlock *block, int index, CzMemoryText *request) {
    const CzEvaluator *evaluator = block->evaluator;
    const CzRunChunk *chunk = &block->plan.chunk[index];
    ChunkDesigns designs = {0};
    if (is_stopped(evaluator))
        return false;
    cz_put_int(request, block->record);
    cz_put_int(request, block->keep_pulses);
    cz_put(request, &block->manner, 1, sizeof block->manner);
    cz_put_int(request, chunk->n);
    for (int i = 0; i < chunk->n; i++) {
        const CzRunItem *item = &block->plan.item[chunk->first + i];
        cz_put_int(request, number_of(&designs, item->design));
        cz_put_int(request, item->scene);
    }
    cz_put_int(request, designs.n);
    cz_put_int(request, block->x != NULL);
    for (int i = 0; block->x != NULL && i < designs.n; i++)
        cz_put_numbers(request, block->x + designs.design[i] * evaluator->design.n_variable,
                       (size_t)evaluator->design.n_variable);
    return true;
}

static CzStatus take_chunk(CzRunBlock *block, int index, CzReading *answer, CzError *error) {
    const CzRunChunk *chunk = &block->plan.chunk[index];
    const CzRunItem *item = &block->plan.item[chunk->first];
    for (int i = 0; i < chunk->n; i++)
        CZ_TRY(cz_run_get(answer,
                          &block->run[item[i].design * block->evaluator->n_scene + item[i].scene],
                          error));
    return CZ_OK;
}

/* Runs a chunk whose designs are those of the block, and appends its runs. */
static CzStatus answer_chunk(CzRunBlock *block, int n, const int *place, CzMemoryText *answer,
                             CzError *error) {
    CZ_TRY(begin_block(block, error));
    CZ_TRY(cz_run_plan_begin(&block->plan, n, error));
    for (int i = 0; i < n; i++)
        list_run(block, place[2 * i], place[2 * i + 1]);
    if (block->plan.n_item < n) /* a design that only this process refuses */
        return cz_fail(error, CZ_STATUS_INPUT, "a design breaks a rule");
    block->plan.chunk[0] = (CzRunChunk){0, n};
    CZ_TRY(run_chunk(block, 0, error));
    for (int i = 0; i < n; i++)
        cz_run_put(answer, block->run[place[2 * i] * block->evaluator->n_scene + place[2 * i + 1]]);
    return CZ_OK;
}

static CzStatus answer_runs(void *study, CzReading *request, CzMemoryText *answer, CzError *error) {
    const CzEvaluator *evaluator = cz_evaluator_opened(study);
    const size_t n_variable = (size_t)evaluator->design.n_variable;
    CzArena arena = {0};
    CzRunBlock block = {.evaluator = evaluator};
    block.record = cz_get_int(request) != 0;
    block.keep_pulses = cz_get_int(request) != 0;
    cz_get(request, &block.manner, 1, sizeof block.manner);
    const int n = cz_get_int(request);
    const int *place = cz_get_items(request, &arena, 2 * n, sizeof *place);
    block.n_point = cz_get_int(request);
    if (cz_get_int(request) != 0)
        block.x = cz_get_items(request, &arena, block.n_point, n_variable * sizeof(double));
    CzStatus status = place == NULL || request->has_ended || arena.out_of_memory
                          ? cz_no_memory(error, "a task")
                          : answer_chunk(&block, n, place, answer, error);
    end_block(&block);
    cz_arena_free(&arena);
    return status;
}

const CzStudyKind cz_study_of_runs = {cz_evaluator_open, answer_runs, cz_evaluator_close};

/* ---- a block --------------------------------------------------------------------------------- */

/* Evaluates each design of a finished block; keeps its runs if requested; fills the details, NaN
 * for designs that failed, unless `detail` is NULL. */
static CzStatus compose_block(CzRunBlock *block, CzError *error) {
    CzEvaluation *evaluation = block->evaluation;
    double *detail = block->detail;
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

/* Whether a check, a match, the objective or a further metric reads the pulses of a run. */
static bool needs_pulses(const CzEvaluator *evaluator) {
    bool needs = cz_metric_needs_pulse(&evaluator->objective);
    for (int i = 0; i < evaluator->list.n_check && !needs; i++)
        needs = cz_metric_needs_pulse(&evaluator->list.check[i].metric);
    for (int i = 0; i < evaluator->n_wanted && !needs; i++)
        needs = cz_metric_needs_pulse(&evaluator->wanted[i].metric);
    for (int i = 0; i < evaluator->matches.n_item && !needs; i++)
        needs = cz_metric_needs_pulse(&evaluator->matches.item[i].metric);
    return needs;
}

/* Reads the designs of a block and plans its runs; ended also after a failure. */
static CzStatus plan_block(CzRunBlock *block, CzError *error) {
    const CzEvaluator *evaluator = block->evaluator;
    block->record |= evaluator->matches.needs_record;
    block->keep_pulses = needs_pulses(evaluator);
    block->manner.brief &= evaluator->matches.n_item == 0;
    CZ_TRY(begin_block(block, error));
    if (block->begun != NULL)
        take_begun(block);
    const CzSimulateOptions options = options_of(block);
    const bool is_single = block->record || options.integrator != CZ_INTEGRATOR_ZHAI;
    CZ_TRY(cz_run_plan_begin(&block->plan, block->n_point * evaluator->n_scene, error));
    list_runs(block);
    return cz_run_plan_cut(&block->plan, &options, is_single, evaluator->executor.n_place, error);
}

/* ---- blocks side by side --------------------------------------------------------------------- */

/* The block of a task, whose number becomes that of the chunk in the block. */
static CzRunBlock *block_of(const CzRunBlocks *blocks, int *index) {
    CzRunBlock *block = blocks->block;
    for (; *index >= block->plan.n_chunk; block++)
        *index -= block->plan.n_chunk;
    return block;
}

static CzStatus run_task(int index, void *data, CzError *error) {
    const CzRunBlock *block = block_of(data, &index);
    return run_chunk(block, index, error);
}

static bool request_task(int index, void *data, CzMemoryText *request) {
    const CzRunBlock *block = block_of(data, &index);
    return request_chunk(block, index, request);
}

static CzStatus take_task(int index, void *data, CzReading *answer, CzError *error) {
    CzRunBlock *block = block_of(data, &index);
    return take_chunk(block, index, answer, error);
}

CzStatus cz_run_blocks_evaluate(const CzRunBlocks *blocks, CzError *error) {
    const CzTaskData plain = {
        .study = blocks->block->evaluator->study, .request = request_task, .take = take_task};
    CzStatus status = CZ_OK;
    int n_chunk = 0;
    for (int i = 0; i < blocks->n && status == CZ_OK; i++) {
        status = plan_block(&blocks->block[i], error);
        n_chunk += blocks->block[i].plan.n_chunk;
    }
    if (status == CZ_OK)
        status = cz_tasks_share(&plain, n_chunk, run_task, (void *)blocks, error);
    for (int i = 0; i < blocks->n; i++) {
        CzRunBlock *block = &blocks->block[i];
        if (status == CZ_OK) {
            note_lengths(block);
            status = compose_block(block, error);
        }
        end_block(block);
    }
    return status;
}
