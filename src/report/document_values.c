/* Values of the documents of searches, sweeps, verifications and explanations. */
#include "report/result_values.h"

#include "evaluate/evaluator.h"

#include <math.h>

/* ---- searches ---- */

bool cz_value_best_is_feasible(CzResultContext *context, const void *record) {
    const CzEvaluation *best = &((const CzOutcome *)record)->best_evaluation;
    (void)context;
    return best->status == CZ_OK && best->violation <= 0 && isfinite(best->objective);
}

const void *cz_value_outcome_variable(CzResultContext *context, const void *record, int index) {
    const CzOutcome *outcome = record;
    if (index >= outcome->n_variable)
        return NULL;
    const CzVariableInfo *variable = cz_evaluator_variable(context->evaluator, index);
    const bool chooses = variable->n_choice > 0;
    context->variable = (CzVariableRow){
        .name = variable->name,
        .unit = variable->unit,
        .min = variable->min,
        .max = variable->max,
        .start = outcome->start[index],
        .value = outcome->best[index],
        .at_bound = outcome->at_bound[index],
        .is_fixed = variable->is_fixed,
        .start_choice = chooses ? variable->choice[(int)outcome->start[index]] : NULL,
        .choice = chooses ? variable->choice[(int)outcome->best[index]] : NULL};
    return &context->variable;
}

const void *cz_value_outcome_objective(CzResultContext *context, const void *record) {
    (void)context;
    return record;
}

const char *cz_value_objective_name(CzResultContext *context, const void *record) {
    (void)record;
    return cz_evaluator_objective_name(context->evaluator);
}

const char *cz_value_objective_unit(CzResultContext *context, const void *record) {
    (void)record;
    return cz_evaluator_objective_unit(context->evaluator);
}

bool cz_value_is_fit(CzResultContext *context, const void *record) {
    (void)record;
    return cz_evaluator_is_fit(context->evaluator);
}

const void *cz_value_outcome_match(CzResultContext *context, const void *record, int index) {
    const CzEvaluation *best = &((const CzOutcome *)record)->best_evaluation;
    (void)context;
    return index < best->n_match ? &best->match[index] : NULL;
}

const char *cz_value_match_kind(CzResultContext *context, const void *record) {
    (void)context;
    return ((const CzMatchResult *)record)->is_history ? "time history" : "value";
}

double cz_value_match_start(CzResultContext *context, const void *record) {
    const CzEvaluation *start = &context->outcome->start_evaluation;
    const ptrdiff_t index = (const CzMatchResult *)record - context->outcome->best_evaluation.match;
    return index < start->n_match ? start->match[index].value : NAN;
}

const void *cz_value_outcome_alternative(CzResultContext *context, const void *record, int index) {
    const CzOutcome *outcome = record;
    (void)context;
    return index < outcome->n_alternative ? &outcome->alternative_objective[index] : NULL;
}

double cz_value_alternative_objective(CzResultContext *context, const void *record) {
    (void)context;
    return *(const double *)record;
}

bool cz_value_alternative_value(CzResultContext *context, const void *record, int index,
                                CzNamedNumber *number) {
    const CzOutcome *outcome = context->outcome;
    const ptrdiff_t set = (const double *)record - outcome->alternative_objective;
    if (index >= outcome->n_variable)
        return false;
    *number = (CzNamedNumber){cz_evaluator_variable(context->evaluator, index)->name,
                              outcome->alternative[set * outcome->n_variable + index]};
    return true;
}

const void *cz_value_outcome_constraint(CzResultContext *context, const void *record, int index) {
    const CzOutcome *outcome = record;
    const CzEvaluation *start = &outcome->start_evaluation, *best = &outcome->best_evaluation;
    if (index >= best->n_constraint)
        return NULL;
    const bool is_judged = best->constraint_check != NULL;
    const bool was_judged = start->constraint_check != NULL && index < start->n_constraint;
    CzConstraintRow *row = &context->constraint;
    *row = (CzConstraintRow){.name = cz_evaluator_constraint_name(context->evaluator, index),
                             .kind = "max",
                             .limit = NAN,
                             .start = was_judged ? start->constraint_check[index].value : NAN,
                             .value = NAN,
                             .margin = NAN,
                             .is_checked = true,
                             .is_violated = !(best->constraint[index] <= 0)};
    if (is_judged) {
        const CzCheckResult *check = &best->constraint_check[index];
        row->scenario = check->scenario;
        row->where = check->where;
        row->kind = check->is_minimum ? "min" : "max";
        row->unit = check->unit;
        row->limit = check->limit;
        row->value = check->value;
        row->margin = check->margin;
        row->beyond_validity = check->beyond_validity;
        row->is_checked = check->verdict != CZ_VERDICT_NOT_CHECKED;
    }
    return row;
}

bool cz_value_has_sensitivities(CzResultContext *context, const void *record) {
    (void)context;
    return ((const CzOutcome *)record)->sensitivity_increment != NULL;
}

/* Of the variables that were varied. */
const void *cz_value_outcome_sensitivity(CzResultContext *context, const void *record, int index) {
    const CzOutcome *outcome = record;
    for (int i = 0; i < outcome->n_variable; i++) {
        if (outcome->sensitivity_increment[i] == 0 || index-- > 0)
            continue;
        context->sensitivity =
            (CzSensitivityRow){.variable = i,
                               .name = cz_evaluator_variable(context->evaluator, i)->name,
                               .increment = outcome->sensitivity_increment[i],
                               .objective_change = outcome->objective_change[i]};
        return &context->sensitivity;
    }
    return NULL;
}

bool cz_value_margin_change(CzResultContext *context, const void *record, int index,
                            CzNamedNumber *number) {
    const int variable = ((const CzSensitivityRow *)record)->variable;
    const int n_constraint = context->outcome->best_evaluation.n_constraint;
    if (index >= n_constraint)
        return false;
    *number =
        (CzNamedNumber){cz_evaluator_constraint_name(context->evaluator, index),
                        -context->outcome->constraint_change[variable * n_constraint + index]};
    return true;
}

long cz_value_trial_number(CzResultContext *context, const void *record) {
    return (long)((const CzTrial *)record - context->outcome->trial) + 1;
}

/* ---- verifications ---- */

static const char *or_null(const char *text) {
    return text[0] != '\0' ? text : NULL;
}

const void *cz_value_outcome_verification(CzResultContext *context, const void *record) {
    const CzVerification *made = ((const CzOutcome *)record)->verification;
    const double *change = made != NULL ? made->largest_change : NULL;
    context->verification = made;
    context->optimum = (CzOptimumVerification){
        .half_step = made != NULL ? change[CZ_METHOD_HALF_STEP] : NAN,
        .reference = made != NULL ? change[CZ_METHOD_ERK] : NAN,
        .full_track = made != NULL ? change[CZ_METHOD_TRACK] : NAN,
        .verdict = cz_verdict_text(made != NULL ? made->verdict : CZ_VERDICT_NOT_CHECKED),
        .failure = made != NULL ? or_null(made->failure) : NULL};
    return &context->optimum;
}

const void *cz_value_verified_method(CzResultContext *context, const void *record, int index,
                                     const char **name) {
    const CzVerification *verification = context->verification;
    (void)record;
    if (verification == NULL || index >= CZ_N_VERIFY_METHOD)
        return NULL;
    const int worst = verification->worst[index];
    const CzVerifiedValue *value = worst >= 0 ? &verification->value[worst] : NULL;
    *name = cz_verify_method_key((CzVerifyMethod)index);
    context->method = (CzMethodRow){.is_done = verification->is_done[index],
                                    .largest_change = verification->largest_change[index],
                                    .of = value != NULL ? value->name : NULL,
                                    .where = value != NULL ? or_null(value->where) : NULL,
                                    .scenario = value != NULL ? or_null(value->scenario) : NULL,
                                    .n_flip = verification->n_flip[index]};
    return &context->method;
}

const void *cz_value_value_by_method(CzResultContext *context, const void *record, int index,
                                     const char **name) {
    const CzVerifiedValue *value = record;
    if (index >= CZ_N_VERIFY_METHOD)
        return NULL;
    *name = cz_verify_method_key((CzVerifyMethod)index);
    context->change = (CzChangeRow){value->value[index], value->change[index], value->flips[index]};
    return &context->change;
}

/* ---- sweeps ---- */

const char *cz_value_sweep_status(CzResultContext *context, const void *record) {
    (void)context;
    return ((const CzSweep *)record)->is_interrupted ? "interrupted" : "completed";
}

const void *cz_value_sweep_metric(CzResultContext *context, const void *record, int index) {
    const CzSweep *sweep = record;
    if (index >= sweep->n_metric)
        return NULL;
    context->swept = (CzSweptMetric){sweep->metric[index], sweep->metric_unit[index]};
    return &context->swept;
}

long cz_value_sweep_worst(CzResultContext *context, const void *record) {
    (void)context;
    return ((const CzSweep *)record)->worst;
}

bool cz_value_point_value(CzResultContext *context, const void *record, int index,
                          CzNamedNumber *number) {
    if (index >= context->sweep->n_axis)
        return false;
    number->value = ((const CzSweepPoint *)record)->value[index];
    return true;
}

const char *cz_value_point_verdict(CzResultContext *context, const void *record) {
    const CzSweepPoint *point = record;
    (void)context;
    return point->state == CZ_SWEEP_DONE ? cz_closed_verdict(point->verdict) : NULL;
}

long cz_value_point_is_provisional(CzResultContext *context, const void *record) {
    const CzSweepPoint *point = record;
    (void)context;
    return point->state == CZ_SWEEP_DONE ? point->verdict == CZ_VERDICT_PROVISIONAL : -1;
}

const void *cz_value_point_metric(CzResultContext *context, const void *record, int index) {
    const CzSweepPoint *point = record;
    if (index >= context->sweep->n_metric)
        return NULL;
    context->point = (CzPointMetric){point->metric[index], point->metric_where[index]};
    return &context->point;
}

/* ---- explanations ---- */

const void *cz_value_explained_check(CzResultContext *context, const void *record) {
    (void)context;
    return &((const CzExplanation *)record)->worst;
}

const char *cz_value_first_cause(CzResultContext *context, const void *record) {
    const CzExplanation *explanation = record;
    (void)context;
    return explanation->has_cause ? cz_cause_text(explanation->cause) : NULL;
}

const void *cz_value_explained_budget(CzResultContext *context, const void *record) {
    const CzRunSummary *run = context->run;
    return run->budget != NULL ? &run->budget[((const CzExplanation *)record)->vehicle] : NULL;
}

const char *cz_value_budget_vehicle(CzResultContext *context, const void *record) {
    (void)record;
    return context->explanation != NULL ? context->run->vehicle[context->explanation->vehicle].name
                                        : NULL;
}

/* ---- fits of curves ---- */

const char *cz_value_fit_basis(CzResultContext *context, const void *record) {
    (void)context;
    return ((const CzFitSummary *)record)->is_dynamic ? "dynamic" : "static";
}

double cz_value_fit_energy_error(CzResultContext *context, const void *record) {
    const CzFitSummary *summary = record;
    (void)context;
    return summary->law_energy / summary->energy - 1.0;
}

bool cz_value_fit_value(CzResultContext *context, const void *record, int index,
                        CzNamedNumber *number) {
    (void)record;
    if (index >= cz_fit_n_value(context->fit))
        return false;
    *number =
        (CzNamedNumber){cz_fit_value_path(context->fit, index), cz_fit_value(context->fit, index)};
    return true;
}

const char *cz_value_fit_doubt(CzResultContext *context, const void *record, int index) {
    (void)record;
    return index < cz_fit_n_doubt(context->fit) ? cz_fit_doubt(context->fit, index) : NULL;
}

const char *cz_value_fit_note(CzResultContext *context, const void *record, int index) {
    (void)record;
    return index < cz_fit_n_note(context->fit) ? cz_fit_note(context->fit, index) : NULL;
}

const char *cz_value_fit_yaml(CzResultContext *context, const void *record) {
    (void)record;
    return context->yaml;
}

/* ---- mistakes ---- */

const void *cz_value_first_mistake(CzResultContext *context, const void *record) {
    (void)record;
    return context->n_mistake > 0 ? context->mistake[0] : NULL;
}

const void *cz_value_nth_mistake(CzResultContext *context, const void *record, int index) {
    (void)record;
    return index < context->n_mistake ? context->mistake[index] : NULL;
}
