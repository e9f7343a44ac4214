/* An outcome once more, from what a search wrote down: nothing is searched again, and what is
 * reported the start and the best design is computed anew. */
#include "crushzone/optimise.h"

#include "base/error.h"
#include "optimise/outcome.h"
#include "optimise/sensitivity.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static CzStatus copy(const CzEvaluator *evaluator, const CzRecall *recall, CzOutcome *outcome,
                     CzError *error) {
    const size_t n = (size_t)cz_evaluator_n_variable(evaluator);
    const size_t n_trial = (size_t)recall->n_trial;
    outcome->n_variable = (int)n;
    outcome->n_evaluation = outcome->n_trial = recall->n_trial;
    outcome->status = recall->status;
    snprintf(outcome->why_stopped, sizeof outcome->why_stopped, "%s", recall->why_stopped);
    outcome->start = calloc(n + 1, sizeof *outcome->start);
    outcome->best = calloc(n + 1, sizeof *outcome->best);
    outcome->at_bound = calloc(n + 1, sizeof *outcome->at_bound);
    outcome->trial = calloc(n_trial + 1, sizeof *outcome->trial);
    outcome->trial_x = calloc(n_trial * n + 1, sizeof *outcome->trial_x);
    if (outcome->start == NULL || outcome->best == NULL || outcome->at_bound == NULL ||
        outcome->trial == NULL || outcome->trial_x == NULL)
        return cz_fail(error, CZ_STATUS_NO_MEMORY, "no memory for the outcome");
    memcpy(outcome->start, recall->start, n * sizeof *outcome->start);
    memcpy(outcome->trial, recall->trial, n_trial * sizeof *outcome->trial);
    memcpy(outcome->trial_x, recall->trial_x, n_trial * n * sizeof *outcome->trial_x);
    for (size_t i = 0; i < n; i++)
        outcome->best[i] = cz_evaluator_variable(evaluator, (int)i)->start;
    cz_outcome_mark_bounds(evaluator, outcome);
    return CZ_OK;
}

CzStatus cz_outcome_recall(CzEvaluator *evaluator, const CzRecall *recall, CzOutcome **outcome,
                           CzError *error) {
    *outcome = NULL;
    const CzOptimiseOptions options = cz_optimise_options_default();
    CzOutcome *made = calloc(1, sizeof *made);
    if (made == NULL)
        return cz_fail(error, CZ_STATUS_NO_MEMORY, "no memory for the outcome");
    CzStatus status = copy(evaluator, recall, made, error);
    if (status == CZ_OK)
        status = cz_evaluate(evaluator, 1, made->start, true, &made->start_evaluation, error);
    if (status == CZ_OK)
        status = cz_evaluate(evaluator, 1, made->best, true, &made->best_evaluation, error);
    if (status == CZ_OK)
        status = cz_outcome_verify(evaluator, &options, made, error);
    if (status == CZ_OK && made->status != CZ_OUTCOME_INTERRUPTED)
        status = cz_sensitivity_take(evaluator, NULL, made, error);
    if (status != CZ_OK) {
        cz_outcome_free(made);
        return status;
    }
    *outcome = made;
    return CZ_OK;
}
