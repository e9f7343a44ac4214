/* The evaluation of a design from the runs of its scenarios. */
#include "evaluate/compose.h"
#include "base/error.h"

#include <stdlib.h>
#include <string.h>

const char *cz_failure_of(const CzRunSummary *run) {
    if (run == NULL)
        return "this scenario was not run";
    if (run->status != CZ_OK)
        return "the run of this scenario failed";
    return run->ended == CZ_ENDED_INCOMPLETE ? "the run of this scenario did not meet its end "
                                               "criterion within simulation.longest_s"
                                             : NULL;
}

const char *cz_failure_text(const CzRunSummary *run, size_t room, char *text) {
    if (run->failure[0] != '\0')
        snprintf(text, room, "%s", run->failure);
    else
        snprintf(text, room, "%s: %s", cz_failure_of(run), run->awaited);
    return text;
}

CzSubject cz_subject_of(const CzEvaluator *evaluator, const CzVehicle *vehicles, int scenario,
                        const CzRunSummary *run) {
    const CzInput *input = cz_problem_input(evaluator->problem);
    CzSubject subject = {.problem = evaluator->problem,
                         .vehicles = vehicles,
                         .n_vehicle = evaluator->n_vehicle,
                         .n_first_train = input->trains[0].n_vehicles,
                         .rate = evaluator->rate[0],
                         .is_obstacle = evaluator->obstacles.has_vehicle};
    if (scenario != CZ_NO_SCENARIO) {
        subject.scene = &evaluator->scene[scenario];
        subject.rate = evaluator->rate[subject.scene->variation];
        subject.run = run;
    }
    return subject;
}

/* The subject of a scenario with its run. */
static CzSubject subject_in(const CzEvaluator *evaluator, const CzVehicle *vehicles, int scenario,
                            const CzRunSummary *const *run) {
    return cz_subject_of(evaluator, cz_vehicles_in(evaluator, vehicles, scenario), scenario,
                         run[scenario]);
}

/* The subject of a check: its scenario with its run, or the design alone. */
static CzSubject subject_at(const CzEvaluator *evaluator, const CzVehicle *vehicles,
                            const CzCheck *check, const CzRunSummary *const *run) {
    if (check->scenario != CZ_NO_SCENARIO)
        return subject_in(evaluator, vehicles, check->scenario, run);
    const CzVehicle *own = cz_vehicles_in(evaluator, vehicles, check->scene_of_vehicles);
    const int variation = evaluator->scene[check->scene_of_vehicles].variation;
    const bool is_changed = check->scene_of_vehicles > 0;
    CzSubject subject = cz_subject_of(evaluator, is_changed ? own : vehicles, CZ_NO_SCENARIO, NULL);
    subject.rate = evaluator->rate[is_changed ? variation : 0];
    return subject;
}

static double metric_objective(const CzEvaluator *evaluator, const CzVehicle *vehicles,
                               const CzRunSummary *const *run) {
    if (cz_level_is_of_design(evaluator->objective.kind->level)) {
        const CzSubject subject = cz_subject_of(evaluator, vehicles, CZ_NO_SCENARIO, NULL);
        return cz_metric_value(&evaluator->objective, &subject, true).value;
    }
    double worst = NAN;
    for (int s = 0; s < evaluator->n_scene; s++) {
        const CzScene *scene = &evaluator->scene[s];
        if (scene->is_overload || scene->judged_by != NULL || !scene->has_reserves ||
            run[s] == NULL)
            continue;
        const CzSubject subject = subject_in(evaluator, vehicles, s, run);
        worst = fmax(worst, cz_metric_value(&evaluator->objective, &subject, true).value);
    }
    return worst;
}

/* The smallest margin of all constraints, negative: the objective of a problem without `minimise`.
 * A yes or no has no margin, and a rule of files requires none. */
static double margin_objective(const CzEvaluator *evaluator, const CzEvaluation *evaluation) {
    double smallest = INFINITY;
    for (int j = 0; j < evaluation->n_constraint; j++) {
        const CzCheck *check = &evaluator->list.check[evaluator->constraint_check[j]];
        if (check->scale != CZ_FLAG_SCALE && !check->is_rule) /* fmin ignores NaN */
            smallest = fmin(smallest, evaluation->constraint_check[j].margin);
    }
    return isinf(smallest) ? NAN : -smallest;
}

/* The sum of squares that a fit minimises. */
static double match_objective(const CzEvaluation *evaluation) {
    double sum = 0;
    for (int i = 0; i < evaluation->n_match; i++) {
        const CzMatchResult *match = &evaluation->match[i];
        if (!isnan(match->residual)) /* NaN where its scenario was left out */
            sum += match->weight * match->residual * match->residual;
    }
    return sum;
}

static void set_objective(const CzEvaluator *evaluator, const CzVehicle *vehicles,
                          const CzRunSummary *const *run, CzEvaluation *evaluation) {
    if (evaluator->own_objective != NULL)
        evaluation->objective =
            evaluator->own_objective(evaluator->n_scene, run, evaluator->own_data);
    else if (evaluation->n_match > 0)
        evaluation->objective = match_objective(evaluation);
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

static void add_constraint(CzEvaluation *evaluation, const CzCheckResult *check,
                           double constraint) {
    const int j = evaluation->n_constraint++;
    evaluation->constraint_check[j] = *check;
    evaluation->constraint[j] = constraint;
    evaluation->violation = fmax(evaluation->violation, constraint);
}

/* Evaluates and lists the checks, and lists the constraints of the optimiser among them. */
static void judge_checks(const CzEvaluator *evaluator, const CzVehicle *vehicles,
                         const CzRunSummary *const *run, CzEvaluation *evaluation) {
    for (int i = 0; i < evaluator->list.n_check; i++) {
        const CzCheck *check = &evaluator->list.check[i];
        const bool is_of_run = check->scenario != CZ_NO_SCENARIO;
        const CzSubject subject = subject_at(evaluator, vehicles, check, run);
        CzCheckResult result =
            cz_check_judge(check, &subject, is_of_run ? cz_failure_of(subject.run) : NULL);
        /* A search uses the number itself to leave designs that climb. */
        const double required = cz_checklist_required(&evaluator->list, check);
        const double constraint = cz_check_constraint(&result, required);
        result.scenario = cz_check_scenario(check, evaluator->scene);
        result.is_omitted = is_of_run && subject.run == NULL;
        cz_check_blank_total(check, &result);
        if (!check->is_target)
            evaluation->check[evaluation->n_check++] = result;
        if (check->is_constraint)
            add_constraint(evaluation, &result, isnan(constraint) ? 0 : constraint);
    }
}

/* Reason why a match has no value; NULL when it has one. */
static const char *why_no_match(const CzMatchResult *match) {
    if (isnan(match->residual))
        return "this scenario gave no result";
    if (!isnan(match->value))
        return NULL;
    return match->is_history ? "the run ends before the times of the file"
                             : "the run does not record it";
}

/* A match as a constraint: its difference must stay within the tolerance. */
static CzCheckResult check_of(const CzMatchResult *match) {
    const bool is_kept = fabs(match->residual) <= 1;
    const bool is_unknown = isnan(match->residual);
    CzCheckResult check = {.name = match->name,
                           .when = {NAN, NAN},
                           .scenario = match->scenario,
                           .limit = match->target,
                           .value = match->value,
                           .unit = match->unit,
                           .margin = 1 - fabs(match->residual),
                           .verdict = is_kept      ? CZ_VERDICT_PASS
                                      : is_unknown ? CZ_VERDICT_NOT_CHECKED
                                                   : CZ_VERDICT_FAIL,
                           .why = why_no_match(match),
                           .confidence = "user"};
    memcpy(check.where, match->where, sizeof check.where);
    return check;
}

/* Evaluates the matches of a fit; each is a further check and constraint. */
static CzStatus judge_matches(const CzEvaluator *evaluator, const CzVehicle *vehicles,
                              const CzRunSummary *const *run, CzRun *const *whole,
                              CzEvaluation *evaluation, CzError *error) {
    for (int i = 0; i < evaluator->matches.n_item; i++) {
        const CzMatchItem *item = &evaluator->matches.item[i];
        const int s = item->scenario;
        const CzSubject subject = subject_in(evaluator, vehicles, s, run);
        CzMatchResult *match = &evaluation->match[evaluation->n_match++];
        *match = cz_match_begin(item, subject.scene);
        if (run[s] != NULL && cz_failure_of(run[s]) == NULL)
            CZ_TRY(cz_match_judge(item, &subject, whole[s], match, NULL, error));
        CzCheckResult check = check_of(match);
        check.is_omitted = run[s] == NULL;
        check.has_no_run = cz_failure_of(run[s]) != NULL;
        evaluation->check[evaluation->n_check++] = check;
        add_constraint(evaluation, &check, fabs(match->residual) - 1);
    }
    return CZ_OK;
}

/* The worst value of a metric over all scenarios. */
static CzValueResult value_over_runs(const CzEvaluator *evaluator, const CzVehicle *vehicles,
                                     const CzRunSummary *const *run, const CzWanted *wanted,
                                     bool beyond_validity) {
    const CzMetric *metric = &wanted->metric;
    const bool smallest = metric->aggregate == CZ_AGGREGATE_MIN;
    CzValueResult worst = {.metric = wanted->name, .unit = metric->kind->unit->text, .value = NAN};
    for (int s = 0; s < evaluator->n_scene; s++) {
        if (run[s] == NULL || !cz_wanted_in_scenario(wanted, &evaluator->scene[s]) ||
            (beyond_validity && metric->kind->is_total))
            continue;
        const CzSubject subject = subject_in(evaluator, vehicles, s, run);
        const CzMetricValue value = cz_metric_value(metric, &subject, !smallest);
        const bool is_worse = isnan(worst.value) ||
                              (smallest ? value.value < worst.value : value.value > worst.value);
        if (value.known != CZ_KNOWN || !is_worse)
            continue;
        worst.value = value.value;
        worst.scenario = evaluator->scene[s].name;
        memcpy(worst.where, value.where, sizeof worst.where);
    }
    return worst;
}

/* Values that the caller wants; NaN where a run failed. */
static void list_values(const CzEvaluator *evaluator, const CzVehicle *vehicles,
                        const CzRunSummary *const *run, bool failed, CzEvaluation *evaluation) {
    for (; evaluation->n_value < evaluator->n_wanted; evaluation->n_value++) {
        const CzWanted *wanted = &evaluator->wanted[evaluation->n_value];
        evaluation->value[evaluation->n_value] =
            failed ? (CzValueResult){.metric = wanted->name,
                                     .unit = wanted->metric.kind->unit->text,
                                     .value = NAN}
                   : value_over_runs(evaluator, vehicles, run, wanted, evaluation->beyond_validity);
    }
}

static CzStatus allocate(const CzEvaluator *evaluator, CzEvaluation *evaluation, CzError *error) {
    const size_t n_match = (size_t)evaluator->matches.n_item;
    const size_t n_check = (size_t)evaluator->list.n_check + n_match + 1;
    const size_t n_constraint = (size_t)evaluator->list.n_constraint + n_match + 1;
    evaluation->check = malloc(n_check * sizeof *evaluation->check);
    evaluation->constraint = malloc(n_constraint * sizeof(double));
    evaluation->constraint_check = malloc(n_constraint * sizeof *evaluation->constraint_check);
    evaluation->match = malloc((n_match + 1) * sizeof *evaluation->match);
    evaluation->value = malloc(((size_t)evaluator->n_wanted + 1) * sizeof *evaluation->value);
    if (evaluation->check == NULL || evaluation->constraint == NULL ||
        evaluation->constraint_check == NULL || evaluation->match == NULL ||
        evaluation->value == NULL)
        return cz_no_memory(error, "the checks of a design");
    return CZ_OK;
}

static bool any_climbed(const CzEvaluator *evaluator, const CzRunSummary *const *run) {
    for (int s = 0; s < evaluator->n_scene; s++)
        if (run[s] != NULL && run[s]->beyond_validity)
            return true;
    return false;
}

/* The first scenario that failed, else the first incomplete one, with the reason. */
static void note_failure(const CzEvaluator *evaluator, const CzRunSummary *const *run,
                         CzEvaluation *evaluation) {
    const CzRunSummary *first = NULL;
    for (int s = 0; s < evaluator->n_scene; s++) {
        const bool has_failed = run[s] != NULL && run[s]->status != CZ_OK;
        const bool is_worse = first == NULL || (has_failed && first->status == CZ_OK);
        if (run[s] != NULL && cz_failure_of(run[s]) != NULL && is_worse)
            first = run[s];
    }
    char reason[400];
    if (first != NULL)
        snprintf(evaluation->failure, sizeof evaluation->failure, "%.100s: %s", first->scenario,
                 cz_failure_text(first, sizeof reason, reason));
}

CzStatus cz_compose(const CzEvaluator *evaluator, const CzVehicle *vehicles,
                    const CzRunSummary *const *run, CzRun *const *whole, bool is_refused,
                    CzEvaluation *evaluation, CzError *error) {
    CZ_TRY(allocate(evaluator, evaluation, error));
    judge_checks(evaluator, vehicles, run, evaluation);
    evaluation->beyond_validity = any_climbed(evaluator, run);
    evaluation->n_not_covered = evaluator->list.n_not_covered;
    evaluation->not_covered = evaluator->list.not_covered;
    evaluation->n_not_applicable = evaluator->list.n_not_applicable;
    evaluation->not_applicable = evaluator->list.not_applicable;
    evaluation->n_changed_scenario = evaluator->list.n_changed_scenario;
    evaluation->changed_scenario = evaluator->list.changed_scenario;
    evaluation->n_not_judged = evaluator->obstacles.n;
    evaluation->not_judged = evaluator->obstacles.train;
    CZ_TRY(judge_matches(evaluator, vehicles, run, whole, evaluation, error));
    note_failure(evaluator, run, evaluation);
    const bool failed = is_refused || evaluation->failure[0] != '\0';
    if (!failed)
        set_objective(evaluator, vehicles, run, evaluation);
    list_values(evaluator, vehicles, run, failed, evaluation);
    const bool has_objective = evaluator->own_objective != NULL ||
                               evaluator->objective.kind != NULL || evaluation->n_match > 0;
    if (failed)
        set_failed(evaluation);
    else if (!isfinite(evaluation->objective)) /* unknown, which is a failure in a search only */
        evaluation->objective = has_objective ? NAN : 0;
    evaluation->verdict = cz_verdict_over(evaluation, 0, NULL);
    return CZ_OK;
}

/* Computes the residuals of a fit. */
static CzStatus compose_residuals(const CzEvaluator *evaluator, const CzVehicle *vehicles,
                                  const CzRunSummary *const *run, CzRun *const *whole,
                                  double *detail, CzError *error) {
    for (int i = 0; i < evaluator->matches.n_item; i++) {
        const CzMatchItem *item = &evaluator->matches.item[i];
        const CzSubject subject = subject_in(evaluator, vehicles, item->scenario, run);
        CzMatchResult match;
        CZ_TRY(cz_match_judge(item, &subject, whole[item->scenario], &match, detail, error));
        detail += cz_match_n_detail(item);
    }
    return CZ_OK;
}

CzStatus cz_compose_details(const CzEvaluator *evaluator, const CzVehicle *vehicles,
                            const CzRunSummary *const *run, CzRun *const *whole, double *detail,
                            CzError *error) {
    if (evaluator->matches.n_item > 0)
        return compose_residuals(evaluator, vehicles, run, whole, detail, error);
    int n = 0;
    for (int j = 0; j < evaluator->list.n_constraint; j++) {
        const CzCheck *check = &evaluator->list.check[evaluator->constraint_check[j]];
        const CzSubject subject = subject_at(evaluator, vehicles, check, run);
        n += cz_check_details(check, &subject, cz_checklist_required(&evaluator->list, check),
                              detail + n);
    }
    return CZ_OK;
}
