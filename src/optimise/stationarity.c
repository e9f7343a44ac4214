/* The condition of an optimum (Karush, Kuhn, Tucker) at the best design:
 *
 *   slope of f + sum_j l_j slope of c_j + sum_i m_i (+-e_i) = 0,   l_j >= 0, m_i >= 0
 *
 * over the active constraints c_j <= 0 and bounds, with the sensitivities as slopes over the ranges
 * of the variables. Where the smallest margin is maximised, or the design violates a constraint, f
 * is the largest c_j, so that its slope is 0 and the l_j of the largest ones add up to 1. The
 * multipliers are those of the smallest square of the left side, by descent along one of them at a
 * time.
 */
#include "base/error.h"
#include "evaluate/evaluator.h"
#include "optimise/outcome.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Constraints within this of being the largest, or violated, are active (ours); with catalogue
 * increments, those that one sensitivity increment can make active. */
static const double near = 0.01;

enum { SWEEPS = 3000 };

/* Slopes of active constraints and bounds, a column each. */
typedef struct Columns {
    CzArena arena;
    int n_row;                  /* variables, and one more for the sum of multipliers */
    int n;                      /* columns */
    double *column;             /* (n x n_row) */
    int *constraint, *variable; /* of each, -1 for the other kind (n) */
    double *multiplier;         /* (n) */
    double *rest;               /* left side (n_row) */
} Columns;

static bool create(Columns *columns, int n_variable, int n_constraint) {
    const size_t most = (size_t)(n_constraint + n_variable);
    columns->n_row = n_variable + 1;
    columns->column = cz_arena_numbers(&columns->arena, most * (size_t)columns->n_row);
    columns->constraint = cz_arena_allocate(&columns->arena, most, sizeof(int));
    columns->variable = cz_arena_allocate(&columns->arena, most, sizeof(int));
    columns->multiplier = cz_arena_numbers(&columns->arena, most);
    columns->rest = cz_arena_numbers(&columns->arena, (size_t)columns->n_row);
    return !columns->arena.out_of_memory;
}

/* A change by the increment of a variable as a slope over its range; 0 when it is not known. */
static double slope_of(const CzEvaluator *evaluator, const CzOutcome *outcome, int variable,
                       double change) {
    const CzVariableInfo *info = cz_evaluator_variable(evaluator, variable);
    const double increment = outcome->sensitivity_increment[variable];
    return increment != 0 && isfinite(change) ? change / increment * (info->max - info->min) : 0;
}

/* Largest change of a constraint by an increment of a variable that has catalogue increments. */
static double reach_of(const CzEvaluator *evaluator, const CzOutcome *outcome, int constraint) {
    const int m = outcome->best_evaluation.n_constraint;
    double reach = 0;
    for (int i = 0; i < outcome->n_variable; i++) {
        const double change = fabs(outcome->constraint_change[i * m + constraint]);
        const CzVariableInfo *info = cz_evaluator_variable(evaluator, i);
        if ((info->increment > 0 || info->n_value > 0) && isfinite(change))
            reach = fmax(reach, change);
    }
    return reach;
}

static void add_constraints(Columns *columns, const CzEvaluator *evaluator,
                            const CzOutcome *outcome, double largest) {
    const CzEvaluation *best = &outcome->best_evaluation;
    for (int j = 0; j < best->n_constraint; j++) {
        const double reach = fmax(near, reach_of(evaluator, outcome, j));
        if (!isfinite(best->constraint[j]) || best->constraint[j] < largest - reach ||
            cz_evaluator_constraint_kind(evaluator, j) != CZ_CONSTRAINT_GRADED)
            continue;
        double *column = columns->column + columns->n * columns->n_row;
        double square = 0;
        for (int i = 0; i < outcome->n_variable; i++) {
            column[i] = slope_of(evaluator, outcome, i,
                                 outcome->constraint_change[i * best->n_constraint + j]);
            square += column[i] * column[i];
        }
        if (!(square > 0))
            continue; /* nothing that varies changes it */
        columns->constraint[columns->n] = j;
        columns->variable[columns->n++] = -1;
    }
}

static void add_bounds(Columns *columns, const CzEvaluator *evaluator, const CzOutcome *outcome,
                       double size) {
    for (int i = 0; i < outcome->n_variable; i++) {
        const CzVariableInfo *info = cz_evaluator_variable(evaluator, i);
        if (!outcome->at_bound[i])
            continue;
        const bool is_upper = info->max - outcome->best[i] < outcome->best[i] - info->min;
        columns->column[columns->n * columns->n_row + i] = is_upper ? size : -size;
        columns->constraint[columns->n] = -1;
        columns->variable[columns->n++] = i;
    }
}

static double length_of(const double *column, int n) {
    double square = 0;
    for (int i = 0; i < n; i++)
        square += column[i] * column[i];
    return sqrt(square);
}

/* Smallest length of the left side over the multipliers; `rest` is its value without any. */
static void solve(Columns *columns) {
    const int n_row = columns->n_row;
    for (int sweep = 0; sweep < SWEEPS; sweep++)
        for (int k = 0; k < columns->n; k++) {
            const double *column = columns->column + k * n_row;
            double along = 0, square = 0;
            for (int i = 0; i < n_row; i++) {
                along += column[i] * columns->rest[i];
                square += column[i] * column[i];
            }
            const double better = fmax(columns->multiplier[k] - along / square, 0);
            for (int i = 0; i < n_row; i++)
                columns->rest[i] += (better - columns->multiplier[k]) * column[i];
            columns->multiplier[k] = better;
        }
}

/* Limits before bounds, each with the largest first. */
static int compare_multipliers(const void *one, const void *other) {
    const CzMultiplier *a = one, *b = other;
    if ((a->constraint >= 0) != (b->constraint >= 0))
        return a->constraint >= 0 ? -1 : 1;
    if (a->worth != b->worth)
        return a->worth > b->worth ? -1 : 1;
    return (a->constraint > b->constraint) - (a->constraint < b->constraint) +
           (a->variable > b->variable) - (a->variable < b->variable);
}

/* Stores the multipliers that are more than a thousandth of the largest of their kind. */
static bool keep(const Columns *columns, const CzEvaluator *evaluator, CzOutcome *outcome,
                 double bound_size) {
    outcome->multiplier = cz_outcome_multipliers(outcome, (size_t)columns->n);
    double largest[2] = {0};
    for (int k = 0; k < columns->n; k++) {
        const int kind = columns->constraint[k] < 0;
        largest[kind] = fmax(largest[kind], columns->multiplier[k]);
    }
    for (int k = 0; k < columns->n && outcome->multiplier != NULL; k++) {
        const bool is_bound = columns->constraint[k] < 0;
        if (!(columns->multiplier[k] > 1e-3 * largest[is_bound]))
            continue;
        double worth = 0.01 * columns->multiplier[k];
        if (is_bound) {
            const CzVariableInfo *info = cz_evaluator_variable(evaluator, columns->variable[k]);
            worth = columns->multiplier[k] * bound_size / (info->max - info->min);
        }
        outcome->multiplier[outcome->n_multiplier++] = (CzMultiplier){
            .constraint = columns->constraint[k], .variable = columns->variable[k], .worth = worth};
    }
    if (outcome->multiplier != NULL)
        qsort(outcome->multiplier, (size_t)outcome->n_multiplier, sizeof *outcome->multiplier,
              compare_multipliers);
    return outcome->multiplier != NULL;
}

/* Divides the multipliers and the left side by the sum of those of constraints. */
static void normalise(Columns *columns) {
    double sum = 0;
    for (int k = 0; k < columns->n; k++)
        sum += columns->constraint[k] >= 0 ? columns->multiplier[k] : 0;
    for (int k = 0; k < columns->n && sum > 0; k++)
        columns->multiplier[k] /= sum;
    for (int i = 0; i < columns->n_row && sum > 0; i++)
        columns->rest[i] /= sum;
    columns->rest[columns->n_row - 1] = 0;
}

CzStatus cz_stationarity_find(const CzEvaluator *evaluator, CzOutcome *outcome, CzError *error) {
    const CzEvaluation *best = &outcome->best_evaluation;
    const int n = outcome->n_variable;
    if (outcome->sensitivity_increment == NULL || best->status != CZ_OK ||
        cz_evaluator_is_fit(evaluator))
        return CZ_OK;
    const bool is_largest = best->violation > 0 || cz_evaluator_maximises_margin(evaluator);
    double largest = is_largest ? -INFINITY : 0;
    for (int j = 0; j < best->n_constraint && is_largest; j++)
        if (cz_evaluator_constraint_kind(evaluator, j) == CZ_CONSTRAINT_GRADED)
            largest = fmax(largest, best->constraint[j]);
    Columns columns = {.n = 0};
    if (!create(&columns, n, best->n_constraint)) {
        cz_arena_free(&columns.arena);
        return cz_no_memory(error, "the condition of an optimum");
    }
    add_constraints(&columns, evaluator, outcome, largest);
    double size = 0;
    for (int k = 0; k < columns.n; k++)
        size = fmax(size, length_of(columns.column + k * columns.n_row, n));
    for (int i = 0; i < n && !is_largest; i++)
        columns.rest[i] = slope_of(evaluator, outcome, i, outcome->objective_change[i]);
    const double slope = is_largest ? size : length_of(columns.rest, n);
    for (int k = 0; k < columns.n && is_largest; k++)
        columns.column[k * columns.n_row + n] = size; /* the sum of multipliers is 1 */
    columns.rest[n] = is_largest ? -size : 0;
    const double bound_size = slope > 0 ? slope : 1;
    add_bounds(&columns, evaluator, outcome, bound_size);
    solve(&columns);
    if (is_largest)
        normalise(&columns);
    bool has_memory = true;
    if (slope > 0 && isfinite(slope)) {
        outcome->stationarity = fmin(length_of(columns.rest, n) / slope, 1);
        has_memory = keep(&columns, evaluator, outcome, bound_size);
    }
    cz_arena_free(&columns.arena);
    return has_memory ? CZ_OK : cz_no_memory(error, "the condition of an optimum");
}
