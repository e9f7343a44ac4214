/* Gradients by differences: n further designs in lanes beside the first one. */
#ifndef CZ_SERVE_GRADIENT_H
#define CZ_SERVE_GRADIENT_H

#include "base/arena.h"
#include "crushzone/report.h"

/* Step of a difference, as a share of the range of a variable, as in a search. */
#define CZ_GRADIENT_STEP 1e-3

typedef struct CzGradient {
    CzEvaluation evaluation; /* of the design itself; the caller frees it */
    int n_slope;
    CzSlope *slope; /* objective, values, then constraints (n_slope) */
} CzGradient;

/* Differentiates the objective, the values of cz_evaluator_set_values, and the constraints if
 * requested, at a design x (n_variable), by secants of a share of the range of each variable,
 * towards the inside at a bound. Memory of the slopes comes from the arena. Statuses of
 * cz_evaluate. */
CZ_MUST_CHECK CzStatus cz_gradient(CzEvaluator *evaluator, const double *x, double step,
                                   bool of_constraints, CzArena *arena, CzGradient *gradient,
                                   CzError *error);

/* That step of a variable in its unit, towards the inside at a bound; 0 for one that chooses or is
 * fixed. */
double cz_gradient_step(const CzVariableInfo *info, double x, double share);

#endif
