/* The documents `crushzone.outcome` and that of mistakes. */
#include "crushzone/report.h"

#include "evaluate/evaluator.h"
#include "report/documents.h"

#include <math.h>

static void put_variables(CzJson *json, const CzEvaluator *evaluator, const CzOutcome *outcome) {
    cz_json_open_list(json, "variables");
    for (int i = 0; i < outcome->n_variable; i++) {
        const CzVariableInfo *variable = cz_evaluator_variable(evaluator, i);
        cz_json_open_object(json, NULL);
        cz_json_text(json, "name", variable->name);
        cz_json_text(json, "unit", variable->unit);
        cz_json_exact(json, "min", variable->min);
        cz_json_exact(json, "max", variable->max);
        cz_json_exact(json, "start", outcome->start[i]);
        cz_json_exact(json, "value", outcome->best[i]);
        cz_json_flag(json, "at_bound", outcome->at_bound[i]);
        cz_json_flag(json, "fixed", variable->is_fixed);
        if (variable->n_choice > 0) {
            cz_json_text(json, "start_choice", variable->choice[(int)outcome->start[i]]);
            cz_json_text(json, "choice", variable->choice[(int)outcome->best[i]]);
        }
        cz_json_close(json);
    }
    cz_json_close(json);
}

/* Of a fit: what was matched, and further parameter sets that match about as well. */
static void put_fit(CzJson *json, const CzEvaluator *evaluator, const CzOutcome *outcome) {
    const CzEvaluation *best = &outcome->best_evaluation, *start = &outcome->start_evaluation;
    cz_json_open_list(json, "matches");
    for (int i = 0; i < best->n_match; i++) {
        const CzMatchResult *match = &best->match[i];
        cz_json_open_object(json, NULL);
        cz_json_text(json, "name", match->name);
        cz_json_text(json, "scenario", match->scenario);
        cz_json_text(json, "where", match->where);
        cz_json_text(json, "kind", match->is_history ? "time history" : "value");
        cz_json_text(json, "unit", match->unit);
        cz_json_exact(json, "target", match->target);
        cz_json_exact(json, "start", i < start->n_match ? start->match[i].value : NAN);
        cz_json_exact(json, "value", match->value);
        cz_json_exact(json, "tolerance", match->tolerance);
        cz_json_exact(json, "weight", match->weight);
        cz_json_exact(json, "residual", match->residual);
        cz_json_close(json);
    }
    cz_json_close(json);
    cz_json_open_list(json, "alternatives");
    for (int i = 0; i < outcome->n_alternative; i++) {
        cz_json_open_object(json, NULL);
        cz_json_exact(json, "objective", outcome->alternative_objective[i]);
        cz_json_open_object(json, "values");
        for (int k = 0; k < outcome->n_variable; k++)
            cz_json_exact(json, cz_evaluator_variable(evaluator, k)->name,
                          outcome->alternative[i * outcome->n_variable + k]);
        cz_json_close(json);
        cz_json_close(json);
    }
    cz_json_close(json);
}

static void put_objective(CzJson *json, const CzEvaluator *evaluator, const CzOutcome *outcome) {
    cz_json_open_object(json, "objective");
    cz_json_text(json, "name", cz_evaluator_objective_name(evaluator));
    cz_json_text(json, "unit", cz_evaluator_objective_unit(evaluator));
    cz_json_exact(json, "start", outcome->start_evaluation.objective);
    cz_json_exact(json, "value", outcome->best_evaluation.objective);
    cz_json_close(json);
}

static void put_constraint(CzJson *json, const CzEvaluator *evaluator, const CzOutcome *outcome,
                           int i) {
    const CzEvaluation *start = &outcome->start_evaluation, *best = &outcome->best_evaluation;
    const CzCheckResult *check = best->constraint_check != NULL ? &best->constraint_check[i] : NULL;

    cz_json_open_object(json, NULL);
    cz_json_text(json, "name", cz_evaluator_constraint_name(evaluator, i));
    cz_json_text(json, "scenario", check != NULL ? check->scenario : NULL);
    cz_json_text(json, "where", check != NULL ? check->where : NULL);
    cz_json_text(json, "kind", check != NULL && check->is_minimum ? "min" : "max");
    cz_json_exact(json, "limit", check != NULL ? check->limit : NAN);
    cz_json_exact(json, "start",
                  start->constraint_check != NULL && i < start->n_constraint
                      ? start->constraint_check[i].value
                      : NAN);
    cz_json_exact(json, "value", check != NULL ? check->value : NAN);
    cz_json_text(json, "unit", check != NULL ? check->unit : NULL);
    cz_json_exact(json, "margin", check != NULL ? check->margin : NAN);
    cz_json_flag(json, "beyond_validity", check != NULL && check->beyond_validity);
    cz_json_flag(json, "checked", check == NULL || check->verdict != CZ_VERDICT_NOT_CHECKED);
    cz_json_flag(json, "violated", !(best->constraint[i] <= 0));
    cz_json_close(json);
}

/* Sensitivities: change per increment of each variable at the best design: the objective and each
 * margin. */
static void put_sensitivities(CzJson *json, const CzEvaluator *evaluator,
                              const CzOutcome *outcome) {
    const int n_constraint = outcome->best_evaluation.n_constraint;
    cz_json_open_list(json, "sensitivities");
    for (int i = 0; i < outcome->n_variable; i++) {
        if (outcome->sensitivity_increment[i] == 0)
            continue;
        cz_json_open_object(json, NULL);
        cz_json_text(json, "variable", cz_evaluator_variable(evaluator, i)->name);
        cz_json_exact(json, "increment", outcome->sensitivity_increment[i]);
        cz_json_real(json, "objective_change", outcome->objective_change[i]);
        cz_json_open_object(json, "margin_changes");
        for (int k = 0; k < n_constraint; k++)
            cz_json_real(json, cz_evaluator_constraint_name(evaluator, k),
                         -outcome->constraint_change[i * n_constraint + k]);
        cz_json_close(json);
        cz_json_close(json);
    }
    cz_json_close(json);
}

/* Largest changes of the optimum by independent means; null where none was taken. */
static void put_verification(CzJson *json, const CzVerification *verification) {
    const bool is_made = verification != NULL;
    cz_json_open_object(json, "verification");
    cz_json_exact(json, "half_step_change",
                  is_made ? verification->largest_change[CZ_WAY_HALF_STEP] : NAN);
    cz_json_exact(json, "reference_change",
                  is_made ? verification->largest_change[CZ_WAY_ERK] : NAN);
    cz_json_exact(json, "full_track_change",
                  is_made ? verification->largest_change[CZ_WAY_TRACK] : NAN);
    cz_json_text(json, "verdict",
                 cz_verdict_text(is_made ? verification->verdict : CZ_VERDICT_NOT_CHECKED));
    cz_json_text(json, "failure",
                 is_made && verification->failure[0] != '\0' ? verification->failure : NULL);
    if (is_made)
        cz_document_verified_ways(json, verification);
    cz_json_close(json);
}

CzStatus cz_report_write_outcome(const CzProblem *problem, const CzEvaluator *evaluator,
                                 const CzOutcome *outcome, const CzReportOptions *options,
                                 FILE *stream, CzError *error) {
    const CzReportOptions absent = cz_report_options_default();
    if (options == NULL)
        options = &absent;

    CzJson *json = cz_json_create();
    cz_document_head(json, "crushzone.outcome", problem);
    cz_json_text(json, "status", cz_outcome_text(outcome->status));
    cz_json_text(json, "why_stopped", outcome->why_stopped);
    cz_json_whole(json, "evaluations", outcome->n_evaluation);
    cz_document_run_info(json, outcome->wall_s, options->setup_s, options->n_job);
    cz_document_warnings(json, problem, &outcome->best_evaluation);
    cz_document_verdict(json, outcome->best_evaluation.verdict);
    cz_json_flag(json, "best_is_feasible",
                 outcome->best_evaluation.status == CZ_OK &&
                     outcome->best_evaluation.violation <= 0 &&
                     isfinite(outcome->best_evaluation.objective));
    cz_json_exact(json, "violation", outcome->best_evaluation.violation);
    cz_json_flag(json, "start_beyond_validity", outcome->start_evaluation.beyond_validity);
    cz_json_flag(json, "beyond_validity", outcome->best_evaluation.beyond_validity);
    put_variables(json, evaluator, outcome);
    put_objective(json, evaluator, outcome);
    if (cz_evaluator_is_fit(evaluator))
        put_fit(json, evaluator, outcome);
    cz_json_open_list(json, "constraints");
    for (int i = 0; i < outcome->best_evaluation.n_constraint; i++)
        put_constraint(json, evaluator, outcome, i);
    cz_json_close(json);

    if (outcome->sensitivity_increment != NULL)
        put_sensitivities(json, evaluator, outcome);
    put_verification(json, outcome->verification);
    return cz_json_finish(json, stream, error);
}

CzStatus cz_report_write_mistakes(int n_mistake, const CzError *const *mistake, FILE *stream,
                                  CzError *error) {
    CzJson *json = cz_json_create();
    if (n_mistake > 0)
        cz_document_mistake(json, "error", mistake[0]);
    cz_json_open_list(json, "errors");
    for (int i = 0; i < n_mistake; i++)
        cz_document_mistake(json, NULL, mistake[i]);
    cz_json_close(json);
    return cz_json_finish(json, stream, error);
}
