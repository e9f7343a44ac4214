/* An outcome from the record of a search that was done before: nothing is searched, but start and
 * best design are evaluated anew. */
#include "crushzone/optimise.h"

#include "base/error.h"
#include "optimise/outcome.h"

#include <stdio.h>
#include <string.h>

static CzStatus fill(CzEvaluator *evaluator, const CzRecall *recall, CzOutcome *outcome,
                     CzError *error) {
    const CzOptimiseOptions options = cz_optimise_options_default();
    const size_t n = (size_t)outcome->n_variable, n_trial = (size_t)recall->n_trial;
    outcome->status = recall->status;
    snprintf(outcome->why_stopped, sizeof outcome->why_stopped, "%s", recall->why_stopped);
    memcpy(outcome->start, recall->start, n * sizeof *outcome->start);
    memcpy(outcome->trial, recall->trial, n_trial * sizeof *outcome->trial);
    memcpy(outcome->trial_x, recall->trial_x, n_trial * n * sizeof *outcome->trial_x);
    cz_outcome_mark_bounds(evaluator, outcome);
    CZ_TRY(cz_evaluate(evaluator, 1, outcome->start, true, &outcome->start_evaluation, error));
    CZ_TRY(cz_evaluate(evaluator, 1, outcome->best, true, &outcome->best_evaluation, error));
    CZ_TRY(cz_outcome_verify(evaluator, &options, outcome, error));
    return outcome->status == CZ_OUTCOME_INTERRUPTED
               ? CZ_OK
               : cz_sensitivity_take(evaluator, NULL, outcome, error);
}

CzStatus cz_outcome_recall(CzEvaluator *evaluator, const CzRecall *recall, CzOutcome **outcome,
                           CzError *error) {
    CZ_TRY(cz_outcome_create(evaluator, recall->n_trial, outcome, error));
    return cz_outcome_pass_on(*outcome, fill(evaluator, recall, *outcome, error), outcome);
}
