/* A problem, its evaluator, and the evaluation of the file's design. */
#ifndef CZ_TESTS_JUDGED_PROBLEM_H
#define CZ_TESTS_JUDGED_PROBLEM_H

#include "support/check.h"

#include "crushzone/evaluate.h"

typedef struct Case {
    CzProblem *problem;
    CzEvaluator *evaluator;
    CzEvaluation evaluation;
} Case;

/* Judges a problem, which it takes over. */
static inline Case judged(CzProblem *problem, bool keep_runs) {
    Case made = {.problem = problem};
    CzError error = {0};
    if (cz_evaluator_build(problem, NULL, &made.evaluator, &error) != CZ_OK)
        fail_msg("%s", error.message);
    assert_int_equal(cz_evaluate(made.evaluator, 1, NULL, keep_runs, &made.evaluation, &error),
                     CZ_OK);
    return made;
}

static inline void end(Case *made) {
    cz_evaluation_free(&made->evaluation);
    cz_evaluator_free(made->evaluator);
    cz_problem_free(made->problem);
}

/* A check of a scenario; NULL when there is none. */
static inline const CzCheckResult *find(const Case *made, const char *name, const char *scenario) {
    for (int i = 0; i < made->evaluation.n_check; i++)
        if (strcmp(made->evaluation.check[i].name, name) == 0 &&
            strcmp(made->evaluation.check[i].scenario, scenario) == 0)
            return &made->evaluation.check[i];
    return NULL;
}

#endif
