/* A problem, its evaluator, and an explanation of its results. */
#ifndef CZ_TESTS_EXPLAINED_PROBLEM_H
#define CZ_TESTS_EXPLAINED_PROBLEM_H

#include "crushzone/explain.h"

typedef struct Case {
    CzProblem *problem;
    CzEvaluator *evaluator;
    CzExplanation *explanation;
} Case;

static inline void end(Case *made) {
    cz_explanation_free(made->explanation);
    cz_evaluator_free(made->evaluator);
    cz_problem_free(made->problem);
}

#endif
