/* Gradients by differences. */
#include "serve/gradient.h"

#include "base/error.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

double cz_gradient_step(const CzVariableInfo *info, double x, double share) {
    const double step = share * (info->max - info->min);
    if (info->n_choice > 0 || info->is_fixed)
        return 0;
    return x + step <= info->max ? step : -step;
}

/* The value of a slope in the evaluation of a design. */
static double value_of(const CzEvaluation *evaluation, int slope) {
    if (slope == 0)
        return evaluation->objective;
    if (slope <= evaluation->n_value)
        return evaluation->value[slope - 1].value;
    return evaluation->constraint[slope - 1 - evaluation->n_value];
}

static const char *name_of(const CzEvaluator *evaluator, const CzEvaluation *evaluation,
                           int slope) {
    if (slope == 0)
        return "objective";
    if (slope <= evaluation->n_value)
        return evaluation->value[slope - 1].metric;
    return cz_evaluator_constraint_name(evaluator, slope - 1 - evaluation->n_value);
}

/* Fills the slopes from the evaluations of the design and of its neighbours (1 + n_variable). */
static CzStatus fill(const CzEvaluator *evaluator, const double *x, const CzEvaluation *evaluation,
                     bool of_constraints, CzArena *arena, CzGradient *gradient, CzError *error) {
    const int n = cz_evaluator_n_variable(evaluator);
    gradient->n_slope = 1 + evaluation->n_value + (of_constraints ? evaluation->n_constraint : 0);
    gradient->slope = cz_arena_allocate(arena, (size_t)gradient->n_slope, sizeof *gradient->slope);
    if (gradient->slope == NULL)
        return cz_no_memory(error, "a gradient");
    for (int k = 0; k < gradient->n_slope; k++) {
        double *by = cz_arena_numbers(arena, (size_t)n + 1);
        if (by == NULL)
            return cz_no_memory(error, "a gradient");
        for (int i = 0; i < n; i++) {
            const double difference = x[(i + 1) * n + i] - x[i];
            by[i] = difference != 0
                        ? (value_of(&evaluation[i + 1], k) - value_of(evaluation, k)) / difference
                        : NAN;
        }
        gradient->slope[k] = (CzSlope){
            .of = name_of(evaluator, evaluation, k), .value = value_of(evaluation, k), .by = by};
    }
    return CZ_OK;
}

CzStatus cz_gradient(CzEvaluator *evaluator, const double *x, double step, bool of_constraints,
                     CzArena *arena, CzGradient *gradient, CzError *error) {
    const int n = cz_evaluator_n_variable(evaluator);
    *gradient = (CzGradient){0};
    double *points = cz_arena_numbers(arena, (size_t)(n + 1) * (size_t)n + 1);
    CzEvaluation *evaluation = calloc((size_t)n + 1, sizeof *evaluation);
    if (points == NULL || evaluation == NULL) {
        free(evaluation);
        return cz_no_memory(error, "a gradient");
    }
    for (int k = 0; k <= n; k++) {
        memcpy(points + k * n, x, (size_t)n * sizeof *x);
        if (k > 0)
            points[k * n + k - 1] +=
                cz_gradient_step(cz_evaluator_variable(evaluator, k - 1), x[k - 1], step);
    }
    CzStatus status = cz_evaluate(evaluator, n + 1, points, false, evaluation, error);
    if (status == CZ_OK)
        status = fill(evaluator, points, evaluation, of_constraints, arena, gradient, error);
    for (int k = status == CZ_OK ? 1 : 0; k <= n; k++)
        cz_evaluation_free(&evaluation[k]);
    gradient->evaluation = evaluation[0];
    free(evaluation);
    return status;
}
