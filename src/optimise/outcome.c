/* Memory of an outcome, its bounds and its verification. */
#include "optimise/outcome.h"
#include "base/error.h"
#include "evaluate/deciding_run.h"
#include "evaluate/listed.h"

#include <float.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* The outcome is the first member, so that its address is that of the struct. */
typedef struct Owned {
    CzOutcome outcome;
    CzArena arena;
} Owned;

double *cz_outcome_numbers(CzOutcome *outcome, size_t n) {
    return cz_arena_numbers(&((Owned *)outcome)->arena, n);
}

CzOrderedMargin *cz_outcome_margins(CzOutcome *outcome, size_t n) {
    return cz_arena_allocate(&((Owned *)outcome)->arena, n + 1, sizeof(CzOrderedMargin));
}

CzMultiplier *cz_outcome_multipliers(CzOutcome *outcome, size_t n) {
    return cz_arena_allocate(&((Owned *)outcome)->arena, n + 1, sizeof(CzMultiplier));
}

CzRejected *cz_outcome_rejected(CzOutcome *outcome, size_t n) {
    return cz_arena_allocate(&((Owned *)outcome)->arena, n, sizeof(CzRejected));
}

CzStatus cz_outcome_create(const CzEvaluator *evaluator, long n_trial, CzOutcome **outcome,
                           CzError *error) {
    Owned *made = calloc(1, sizeof *made);
    const int n = cz_evaluator_n_variable(evaluator);
    *outcome = NULL;
    if (made == NULL)
        return cz_no_memory(error, "the outcome");
    *outcome = &made->outcome;
    **outcome =
        (CzOutcome){.n_variable = n,
                    .n_evaluation = n_trial,
                    .n_trial = n_trial,
                    .start = cz_outcome_numbers(*outcome, (size_t)n),
                    .best = cz_outcome_numbers(*outcome, (size_t)n),
                    .at_bound = cz_arena_allocate(&made->arena, (size_t)n, sizeof(bool)),
                    .trial = cz_arena_allocate(&made->arena, (size_t)n_trial, sizeof(CzTrial)),
                    .trial_x = cz_outcome_numbers(*outcome, (size_t)n_trial * (size_t)n)};
    if (made->arena.out_of_memory)
        return cz_outcome_pass_on(*outcome, cz_no_memory(error, "the outcome"), outcome);
    for (int i = 0; i < n; i++)
        (*outcome)->start[i] = (*outcome)->best[i] = cz_evaluator_variable(evaluator, i)->start;
    return CZ_OK;
}

CzStatus cz_outcome_pass_on(CzOutcome *made, CzStatus status, CzOutcome **outcome) {
    if (status != CZ_OK)
        cz_outcome_free(made);
    *outcome = status == CZ_OK ? made : NULL;
    return status;
}

void cz_outcome_free(CzOutcome *outcome) {
    if (outcome == NULL)
        return;
    cz_evaluation_free(&outcome->start_evaluation);
    cz_evaluation_free(&outcome->best_evaluation);
    cz_verification_free(outcome->verification);
    cz_arena_free(&((Owned *)outcome)->arena);
    free(outcome);
}

void cz_outcome_mark_bounds(const CzEvaluator *evaluator, CzOutcome *outcome) {
    for (int i = 0; i < outcome->n_variable; i++) {
        const CzVariableInfo *info = cz_evaluator_variable(evaluator, i);
        const double nearness = 1e-6 * (info->max - info->min);
        outcome->at_bound[i] =
            info->n_choice == 0 && !info->is_fixed &&
            (outcome->best[i] <= info->min + nearness || outcome->best[i] >= info->max - nearness);
    }
}

CzStatus cz_outcome_take_history(CzOutcome *outcome, const CzCombinations *combinations,
                                 CzError *error) {
    CzArena *arena = &((Owned *)outcome)->arena;
    const CzSelection *selection = &combinations->replay.selection;
    const size_t n = (size_t)cz_combinations_n_record(combinations);
    const size_t n_scenario = selection->is_on ? (size_t)selection->n_scenario : 0;
    outcome->n_trial = outcome->n_evaluation = (long)n;
    outcome->trial = cz_arena_allocate(arena, n + 1, sizeof *outcome->trial);
    outcome->trial_x = cz_arena_numbers(arena, n * (size_t)outcome->n_variable);
    outcome->scenario = cz_arena_allocate(arena, n_scenario + 1, sizeof *outcome->scenario);
    if (arena->out_of_memory)
        return cz_no_memory(error, "the outcome");
    cz_combinations_history(combinations, outcome->n_variable, outcome->trial, outcome->trial_x);
    outcome->n_whole = selection->n_whole;
    outcome->n_scenario = 0;
    for (size_t s = 0; s < n_scenario; s++)
        if (selection->has_run[s])
            outcome->scenario[outcome->n_scenario++] =
                (CzScenarioUse){.name = cz_evaluator_scenario_name(selection->evaluator, (int)s),
                                .n_run = selection->n_run[s],
                                .is_in_set = selection->works[s]};
    return CZ_OK;
}

bool cz_is_on_increments(const CzEvaluator *evaluator, const double *x) {
    for (int i = 0; i < cz_evaluator_n_variable(evaluator); i++)
        if (!cz_variable_has(cz_evaluator_variable(evaluator, i), x[i]))
            return false;
    return true;
}

CzStatus cz_outcome_verify_design(CzEvaluator *evaluator, const CzOptimiseOptions *options,
                                  const double *x, const CzEvaluation *whole,
                                  CzVerification **verification, CzError *error) {
    CzVerifyOptions chosen = cz_verify_options_default();
    chosen.methods = options->verify_methods;
    chosen.solver_step = 2.0;
    chosen.until_settled = true;
    chosen.stop = options->stop;
    return cz_verify(evaluator, x, whole, &chosen, verification, error);
}

CzStatus cz_outcome_verify(CzEvaluator *evaluator, const CzOptimiseOptions *options,
                           CzOutcome *outcome, CzError *error) {
    const bool passes =
        outcome->status == CZ_OUTCOME_FEASIBLE || outcome->status == CZ_OUTCOME_UNVERIFIED;
    if (!passes || options->verify_methods == 0)
        return CZ_OK;
    const CzStatus status =
        cz_outcome_verify_design(evaluator, options, outcome->best, &outcome->best_evaluation,
                                 &outcome->verification, error);
    if (status == CZ_OK) /* parameters of a fit are judged by the measurement alone */
        outcome->status =
            outcome->verification->verdict == CZ_VERDICT_PASS || cz_evaluator_is_fit(evaluator)
                ? CZ_OUTCOME_FEASIBLE
                : CZ_OUTCOME_UNVERIFIED;
    if (status != CZ_STATUS_INTERRUPTED)
        return status;
    outcome->status = CZ_OUTCOME_INTERRUPTED;
    snprintf(outcome->why_stopped, sizeof outcome->why_stopped,
             "interrupted during the verification");
    return CZ_OK;
}

/* ---- after an interruption ---- */

enum {
    MAX_FINISHED = 8, /* scenarios that are all run after an interruption */
    N_FINISHED = 2    /* of more scenarios */
};

/* Largest violations of the scenarios, below all others where none is known, and below these where
 * the scenario is not run. */
static void fill_violations(const CzEvaluator *evaluator, int n_detail, const double *detail,
                            double *violation) {
    for (int s = 0; s < cz_evaluator_n_scenario(evaluator); s++)
        violation[s] = cz_evaluator_has_run_of(evaluator, s) ? -DBL_MAX : -INFINITY;
    for (int j = 0, at = 0; detail != NULL && j < cz_evaluator_n_constraint(evaluator); j++) {
        const int s = cz_evaluator_constraint_scenario(evaluator, j);
        for (int k = 0; k < cz_evaluator_n_detail_of(evaluator, j) && at < n_detail; k++, at++)
            if (s >= 0 && detail[at] > violation[s]) /* not NaN */
                violation[s] = detail[at];
    }
}

CzStatus cz_outcome_leave_out(CzEvaluator *evaluator, int n_detail, const double *detail,
                              CzError *error) {
    const int n = cz_evaluator_n_scenario(evaluator);
    const char *name[N_FINISHED];
    int n_run = 0;
    for (int s = 0; s < n; s++)
        n_run += cz_evaluator_has_run_of(evaluator, s);
    if (n_run <= MAX_FINISHED || !cz_evaluator_can_select(evaluator))
        return CZ_OK;
    double *violation = malloc((size_t)n * sizeof *violation);
    if (violation == NULL)
        return cz_no_memory(error, "the outcome");
    fill_violations(evaluator, n_detail, detail, violation);
    for (int k = 0; k < N_FINISHED; k++) {
        int worst = 0;
        for (int s = 1; s < n; s++)
            if (violation[s] > violation[worst])
                worst = s;
        name[k] = cz_evaluator_scenario_name(evaluator, worst);
        violation[worst] = -INFINITY;
    }
    free(violation);
    return cz_evaluator_set_scenarios(evaluator, N_FINISHED, name, error);
}

void cz_outcome_cut_short(CzOutcome *outcome, const char *part) {
    const size_t n = strlen(outcome->why_stopped);
    if (outcome->status == CZ_OUTCOME_INTERRUPTED || outcome->is_cut_short)
        return;
    outcome->is_cut_short = true;
    snprintf(outcome->why_stopped + n, sizeof outcome->why_stopped - n, "; interrupted, without %s",
             part);
}

/* ---- the record of an earlier search ------------------------------------------------
 *
 * There is no search; start and best design are evaluated again. */

CzStatus cz_outcome_evaluate_start(CzEvaluator *evaluator, CzOutcome *outcome, CzError *error) {
    return cz_evaluate(evaluator, 1, outcome->start, !cz_evaluator_can_select(evaluator),
                       &outcome->start_evaluation, error);
}

CzStatus cz_outcome_record_start(const CzEvaluator *evaluator, CzOutcome *outcome, CzError *error) {
    const int run = cz_deciding_run(&outcome->best_evaluation);
    if (run < 0 || outcome->start_evaluation.n_run > 0)
        return CZ_OK;
    return cz_evaluator_record_run(evaluator, outcome->start, run, &outcome->start_evaluation,
                                   error);
}

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
    CZ_TRY(cz_outcome_evaluate_start(evaluator, outcome, error));
    CZ_TRY(cz_evaluate(evaluator, 1, outcome->best, true, &outcome->best_evaluation, error));
    CZ_TRY(cz_outcome_verify(evaluator, &options, outcome, error));
    CZ_TRY(cz_relaxation_find(evaluator, &options, outcome, error));
    CZ_TRY(cz_outcome_record_start(evaluator, outcome, error));
    if (outcome->status == CZ_OUTCOME_INTERRUPTED)
        return CZ_OK;
    CZ_TRY(cz_sensitivity_take(evaluator, NULL, outcome, error));
    CZ_TRY(cz_margins_order(evaluator, outcome, error));
    return cz_stationarity_find(evaluator, outcome, error);
}

CzStatus cz_outcome_recall(CzEvaluator *evaluator, const CzRecall *recall, CzOutcome **outcome,
                           CzError *error) {
    CZ_TRY(cz_outcome_create(evaluator, recall->n_trial, outcome, error));
    return cz_outcome_pass_on(*outcome, fill(evaluator, recall, *outcome, error), outcome);
}
