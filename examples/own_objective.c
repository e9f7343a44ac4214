// RUN: crushzone new two-trains -o own.yaml && own_objective own.yaml 150
/* Search with a user-defined objective: the largest force over mass on the body of any car, in g,
 * over all scenarios. The checks of the problem file remain the constraints.
 *
 *   own_objective PROBLEM.yaml EVALUATIONS
 */
#include <stdio.h>
#include <stdlib.h>

#include <crushzone/crushzone.h>

/* Called for each design with the runs of all its scenarios; `data` is the pointer given by main.
 */
static double largest_deceleration(int n_scenario, const CzRunSummary *const *summary, void *data) {
    const double unit = *(const double *)data;
    double largest = 0;
    for (int scenario = 0; scenario < n_scenario; scenario++) {
        for (int car = 0; car < summary[scenario]->n_vehicle; car++) {
            const double value = summary[scenario]->vehicle[car].peak_deceleration / unit;
            largest = value > largest ? value : largest;
        }
    }
    return largest;
}

static void print_outcome(const CzEvaluator *evaluator, const CzOutcome *outcome) {
    printf("%s after %ld evaluations: %s\n", cz_outcome_text(outcome->status),
           outcome->n_evaluation, outcome->why_stopped);
    printf("largest deceleration %.2f g -> %.2f g, largest violation %.3f -> %.3f\n",
           outcome->start_evaluation.objective, outcome->best_evaluation.objective,
           outcome->start_evaluation.violation, outcome->best_evaluation.violation);
    for (int i = 0; i < outcome->n_variable; i++) {
        const CzVariableInfo *variable = cz_evaluator_variable(evaluator, i);
        printf("  %-50s %8.0f -> %8.0f %s\n", variable->name, outcome->start[i], outcome->best[i],
               variable->unit);
    }
}

int main(int n_argument, char **argument) {
    if (n_argument != 3) {
        fprintf(stderr, "usage: own_objective PROBLEM.yaml EVALUATIONS\n");
        return 2;
    }
    CzProblem *problem = NULL;
    CzEvaluator *evaluator = NULL;
    CzOutcome *outcome = NULL;
    CzError error = {0};
    double gravity = 9.80665; /* [m/s2] */

    CzStatus status = cz_problem_read(argument[1], NULL, &problem, &error);
    if (status == CZ_OK)
        status = cz_evaluator_build(problem, NULL, &evaluator, &error);
    if (status == CZ_OK) {
        CzOptimiseOptions options = cz_optimise_options_default();
        options.evaluations = strtol(argument[2], NULL, 10);
        cz_evaluator_set_objective(evaluator, "largest deceleration", "g", largest_deceleration,
                                   &gravity);
        status = cz_optimise(evaluator, &options, &outcome, &error);
    }

    if (status == CZ_OK)
        print_outcome(evaluator, outcome);
    else
        fprintf(stderr, "%s\n", error.message);

    cz_outcome_free(outcome);
    cz_evaluator_free(evaluator);
    cz_problem_free(problem);
    return cz_status_exit_code(status);
}
