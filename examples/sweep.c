// RUN: crushzone new two-trains -o swept.yaml && sweep swept.yaml 4 4
/* Sweep: one variable of a problem is varied from its lower to its upper bound, the others keep
 * their starting values. All designs run side by side in one call.
 *
 *   sweep PROBLEM.yaml VARIABLE POINTS      variables are counted from 0
 */
#include <stdio.h>
#include <stdlib.h>

#include <crushzone/crushzone.h>

/* Points of the sweep, (n_point x n_variable); NULL when there is no memory. */
static double *sweep_points(const CzEvaluator *evaluator, int swept, int n_point) {
    const int n_variable = cz_evaluator_n_variable(evaluator);
    double *x = malloc(sizeof *x * (size_t)n_point * (size_t)n_variable);
    if (x == NULL)
        return NULL;
    for (int point = 0; point < n_point; point++) {
        for (int i = 0; i < n_variable; i++) {
            const CzVariableInfo *variable = cz_evaluator_variable(evaluator, i);
            const double share = n_point > 1 ? (double)point / (n_point - 1) : 0;
            x[point * n_variable + i] =
                i == swept ? variable->min + share * (variable->max - variable->min)
                           : variable->start;
        }
    }
    return x;
}

static CzStatus sweep(CzEvaluator *evaluator, int swept, int n_point, CzError *error) {
    const int n_variable = cz_evaluator_n_variable(evaluator);
    if (swept < 0 || swept >= n_variable || n_point < 1) {
        fprintf(stderr, "the problem has %d variables, counted from 0\n", n_variable);
        return CZ_STATUS_INPUT;
    }
    double *x = sweep_points(evaluator, swept, n_point);
    CzEvaluation *evaluation = calloc((size_t)n_point, sizeof *evaluation);
    CzStatus status = CZ_STATUS_NO_MEMORY;
    if (x != NULL && evaluation != NULL)
        status = cz_evaluate(evaluator, n_point, x, false, evaluation, error);

    if (status == CZ_OK) {
        const CzVariableInfo *variable = cz_evaluator_variable(evaluator, swept);
        printf("%s [%s]\n%12s %14s %12s\n", variable->name, variable->unit, "value",
               cz_evaluator_objective_unit(evaluator), "violation");
        for (int point = 0; point < n_point; point++)
            printf("%12.1f %14.4g %12.4f%s\n", x[point * n_variable + swept],
                   evaluation[point].objective, evaluation[point].violation,
                   evaluation[point].violation > 0 ? "" : "  keeps every constraint");
        for (int point = 0; point < n_point; point++)
            cz_evaluation_free(&evaluation[point]);
    }
    free(evaluation);
    free(x);
    return status;
}

int main(int n_argument, char **argument) {
    if (n_argument != 4) {
        fprintf(stderr, "usage: sweep PROBLEM.yaml VARIABLE POINTS\n");
        return 2;
    }
    CzProblem *problem = NULL;
    CzEvaluator *evaluator = NULL;
    CzError error = {0};

    CzStatus status = cz_problem_read(argument[1], NULL, &problem, &error);
    if (status == CZ_OK)
        status = cz_evaluator_build(problem, NULL, &evaluator, &error);
    if (status == CZ_OK)
        status = sweep(evaluator, atoi(argument[2]), atoi(argument[3]), &error);
    if (status != CZ_OK)
        fprintf(stderr, "%s\n", error.message);

    cz_evaluator_free(evaluator);
    cz_problem_free(problem);
    return cz_status_exit_code(status);
}
