/* What the optimiser sees of an evaluator beyond its public face. */
#ifndef CZ_EVALUATE_EVALUATOR_H
#define CZ_EVALUATE_EVALUATOR_H

#include "crushzone/evaluate.h"
#include "problem/problem.h"

const CzProblem *cz_evaluator_problem(const CzEvaluator *evaluator);

/* Whether a constraint is a mere yes or no. */
bool cz_evaluator_is_flag(const CzEvaluator *evaluator, int constraint);

/* Whether the objective is the smallest margin, so the largest constraint up to a constant. */
bool cz_evaluator_maximises_margin(const CzEvaluator *evaluator);

#endif
