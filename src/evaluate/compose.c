/* What one design answers once its scenarios have run. */
#include "evaluate/compose.h"
#include "base/error.h"

#include <stdlib.h>
#include <string.h>

/* Why a scenario gives no values; NULL when it does. */
static const char *failure_of(const CzRunSummary *run) {
    if (run == NULL)
        return "this scenario was not run";
    if (run->status != CZ_OK)
        return "the run of this scenario failed";
    return run->ended == CZ_ENDED_INCOMPLETE ? "the run of this scenario did not come to its end"
                                             : NULL;
}

CzSubject cz_subject_of(const CzEvaluator *evaluator, const CzVehicle *vehicles, int scenario,
                        const CzRunSummary *run) {
    const CzInput *input = cz_problem_input(evaluator->problem);
    CzSubject subject = {.problem = evaluator->problem,
                         .vehicles = vehicles,
                         .n_vehicle = evaluator->n_vehicle,
                         .n_first_train = input->trains[0].n_vehicles,
                         .rate = evaluator->rate};
    if (scenario != CZ_NO_SCENARIO) {
        subject.scene = &evaluator->scene[scenario];
        subject.run = run;
    }
    return subject;
}

static double metric_objective(const CzEvaluator *evaluator, const CzVehicle *vehicles,
                               const CzRunSummary *const *run) {
    const CzLevel level = evaluator->objective.kind->level;
    if (level == CZ_LEVEL_END || level == CZ_LEVEL_DESIGN) {
        const CzSubject subject = cz_subject_of(evaluator, vehicles, CZ_NO_SCENARIO, NULL);
        return cz_metric_value(&evaluator->objective, &subject, true).value;
    }
    double worst = NAN;
    for (int s = 0; s < evaluator->n_scene; s++) {
        if (evaluator->scene[s].is_overload || run[s] == NULL)
            continue;
        const CzSubject subject = cz_subject_of(evaluator, vehicles, s, run[s]);
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
        const CzSubject subject =
            cz_subject_of(evaluator, vehicles, check->scenario,
                          check->scenario == CZ_NO_SCENARIO ? NULL : run[check->scenario]);
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

CzStatus cz_compose(const CzEvaluator *evaluator, const CzVehicle *vehicles,
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

void cz_compose_details(const CzEvaluator *evaluator, const CzVehicle *vehicles,
                        const CzRunSummary *const *run, double *detail) {
    int n = 0;
    for (int j = 0; j < evaluator->list.n_constraint; j++) {
        const CzCheck *check = &evaluator->list.check[evaluator->constraint_check[j]];
        const CzSubject subject =
            cz_subject_of(evaluator, vehicles, check->scenario,
                          check->scenario == CZ_NO_SCENARIO ? NULL : run[check->scenario]);
        n += cz_check_details(check, &subject, evaluator->list.required_margin, detail + n);
    }
}
