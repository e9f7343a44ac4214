/* Evaluates designs: as written, as in a search, and by other settings of their runs. */
#include "base/error.h"
#include "evaluate/run_blocks.h"

#include <stdlib.h>
#include <string.h>

/* Evaluates all designs, block after block. */
static CzStatus evaluate_all(const CzRunBlock *settings, int n_point, const double *x,
                             CzEvaluation *evaluation, double *detail, CzError *error) {
    const CzEvaluator *evaluator = settings->evaluator;
    memset(evaluation, 0, (size_t)n_point * sizeof *evaluation);
    CzStatus status = CZ_OK;
    for (int first = 0; first < n_point && status == CZ_OK; first += CZ_BLOCK_DESIGNS) {
        CzRunBlock block = *settings;
        block.n_point = n_point - first < CZ_BLOCK_DESIGNS ? n_point - first : CZ_BLOCK_DESIGNS;
        block.x = x != NULL ? x + first * evaluator->design.n_variable : NULL;
        block.evaluation = evaluation + first;
        block.detail = detail != NULL ? detail + first * evaluator->n_detail : NULL;
        status = cz_run_blocks_evaluate(&(CzRunBlocks){1, &block}, error);
    }
    for (int i = 0; status != CZ_OK && i < n_point; i++)
        cz_evaluation_free(&evaluation[i]);
    return status;
}

CzStatus cz_evaluate(CzEvaluator *evaluator, int n_point, const double *x, bool keep_runs,
                     CzEvaluation *evaluation, CzError *error) {
    const CzRunBlock settings = {.evaluator = evaluator,
                                 .record = keep_runs,
                                 .keep = keep_runs,
                                 .manner = evaluator->manner};
    return evaluate_all(&settings, n_point, x, evaluation, NULL, error);
}

/* Settings of the runs of a search. */
static CzRunBlock search_settings(const CzEvaluator *evaluator) {
    const bool is_fit = evaluator->matches.n_item > 0; /* matches the whole run on its own track */
    return (CzRunBlock){.evaluator = evaluator,
                        .manner = {.step_factor = evaluator->manner.step_factor,
                                   .integrator = CZ_INTEGRATOR_ZHAI,
                                   .track = is_fit ? CZ_TRACK_USE_OWN : CZ_TRACK_USE_SEARCH,
                                   .brief = true}};
}

CzStatus cz_evaluator_search(const CzEvaluator *evaluator, int n_point, const double *x,
                             CzEvaluation *evaluation, double *detail, CzError *error) {
    const CzRunBlock settings = search_settings(evaluator);
    return evaluate_all(&settings, n_point, x, evaluation, detail, error);
}

CzStatus cz_evaluator_search_some(const CzEvaluator *evaluator, const bool *some, int n_point,
                                  const double *x, CzEvaluation *evaluation, double *detail,
                                  CzError *error) {
    CzRunBlock settings = search_settings(evaluator);
    settings.some = some;
    settings.keep = true;
    return evaluate_all(&settings, n_point, x, evaluation, detail, error);
}

CzStatus cz_evaluator_search_remaining(const CzEvaluator *evaluator, const bool *some,
                                       const double *x, CzEvaluation *evaluation, double *detail,
                                       CzError *error) {
    CzRunBlock settings = search_settings(evaluator);
    CzEvaluation begun = *evaluation;
    settings.some = some;
    settings.begun = &begun;
    const CzStatus status = evaluate_all(&settings, 1, x, evaluation, detail, error);
    cz_evaluation_free(&begun);
    return status;
}

CzStatus cz_evaluator_repeat(const CzEvaluator *evaluator, int n, const CzManner *manner,
                             const double *x, CzEvaluation *evaluation, CzError *error) {
    const CzRunBlocks blocks = {n, calloc((size_t)n + 1, sizeof *blocks.block)};
    memset(evaluation, 0, (size_t)n * sizeof *evaluation);
    if (blocks.block == NULL)
        return cz_no_memory(error, "the runs");
    for (int i = 0; i < n; i++)
        blocks.block[i] = (CzRunBlock){.evaluator = evaluator,
                                       .n_point = 1,
                                       .x = x,
                                       .keep = true,
                                       .manner = manner[i],
                                       .evaluation = &evaluation[i]};
    const CzStatus status = cz_run_blocks_evaluate(&blocks, error);
    for (int i = 0; status != CZ_OK && i < n; i++)
        cz_evaluation_free(&evaluation[i]);
    free(blocks.block);
    return status;
}

/* Marks the scenario of the kept run of a number. */
static void mark_scenario(const CzEvaluator *evaluator, int run, bool *some) {
    for (int s = 0; s < evaluator->n_scene; s++)
        some[s] = cz_evaluator_has_run_of(evaluator, s) && run-- == 0;
}

CzStatus cz_evaluator_record_run(const CzEvaluator *evaluator, const double *x, int run,
                                 CzEvaluation *evaluation, CzError *error) {
    bool *some = calloc((size_t)evaluator->n_scene, sizeof *some);
    evaluation->run = calloc((size_t)run + 1, sizeof *evaluation->run);
    CzEvaluation alone = {0};
    CzStatus status = CZ_OK;
    if (some == NULL || evaluation->run == NULL)
        status = cz_no_memory(error, "the runs");
    if (status == CZ_OK) {
        mark_scenario(evaluator, run, some);
        const CzRunBlock settings = {.evaluator = evaluator,
                                     .some = some,
                                     .record = true,
                                     .keep = true,
                                     .manner = evaluator->manner};
        status = evaluate_all(&settings, 1, x, &alone, NULL, error);
    }
    if (status == CZ_OK && alone.n_run == 1) {
        evaluation->run[run] = alone.run[0];
        evaluation->n_run = run + 1;
        alone.n_run = 0;
    }
    cz_evaluation_free(&alone);
    free(some);
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
    free(evaluation->match);
    free(evaluation->value);
    memset(evaluation, 0, sizeof *evaluation);
}
