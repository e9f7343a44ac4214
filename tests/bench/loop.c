/* bench_loop FILE N: the time of each of N evaluations, one after the other on one thread of this
 * process, and its objective, one a line. loop.py compares with them.
 */
#include <stdio.h>
#include <stdlib.h>

#include "base/clock.h"
#include "crushzone/evaluate.h"

/* The n-th design: every variable somewhere in the middle half of its range. */
static void choose(const CzEvaluator *evaluator, int n, double *x) {
    for (int i = 0; i < cz_evaluator_n_variable(evaluator); i++) {
        const CzVariableInfo *info = cz_evaluator_variable(evaluator, i);
        x[i] = info->min + (info->max - info->min) * (0.25 + 0.5 * ((n * 7 + i * 3) % 100) / 100);
    }
}

int main(int argc, char **argv) {
    CzProblem *problem = NULL;
    CzEvaluator *evaluator = NULL;
    CzError error = {0};
    CzProblemOptions reading = cz_problem_options_default();
    CzEvaluatorOptions options = cz_evaluator_options_default();
    static double x[1000];
    if (argc != 3)
        return 2;
    reading.share_folder = CZ_SOURCE_FOLDER "/problems";
    options.n_job = 1;
    if (cz_problem_read(argv[1], &reading, &problem, &error) != CZ_OK ||
        cz_evaluator_build(problem, &options, &evaluator, &error) != CZ_OK) {
        fprintf(stderr, "%s\n", error.message);
        return 1;
    }
    for (int n = 0; n < atoi(argv[2]); n++) {
        CzEvaluation evaluation;
        const double started = cz_clock();
        choose(evaluator, n, x);
        if (cz_evaluate(evaluator, 1, x, false, &evaluation, &error) != CZ_OK)
            return 1;
        printf("%.9f %.17g\n", cz_clock() - started, evaluation.objective);
        cz_evaluation_free(&evaluation);
    }
    cz_evaluator_free(evaluator);
    cz_problem_free(problem);
    return 0;
}
