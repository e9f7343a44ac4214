/* The smallest relaxation of one limit with which a design passes.
 *
 * After a search without a design that passes, the violation of one of the most violated limits at
 * a time is minimised while all others are constraints, with as many evaluations in all as the
 * search had. The least of these violations is confirmed by a full run. A design that turns out to
 * pass without any relaxation becomes the result of the search.
 */
#include "base/arena.h"
#include "base/error.h"
#include "evaluate/evaluator.h"
#include "evaluate/listed.h"
#include "optimise/combinations.h"
#include "optimise/outcome.h"
#include "optimise/strategy.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_LIMITS = 3 }; /* that are relaxed in turn (ours) */

/* The problem with one limit as the objective. */
typedef struct Relaxed {
    CzEvaluator *evaluator;
    const double *best; /* the design with the values that do not vary (n_all) */
    int n_all, n_constraint;
    int *number; /* the variables that vary (function.n_variable) */
    int limit;   /* the constraint that is minimised */
    CzFunction function;
} Relaxed;

/* Added to the violation, by whose size a descent divides it: the price of the other limits is then
 * higher than any gain. */
static const double offset = 10;

static void expand(const Relaxed *relaxed, const double *number, double *x) {
    memcpy(x, relaxed->best, (size_t)relaxed->n_all * sizeof *x);
    for (int i = 0; i < relaxed->function.n_variable; i++)
        x[relaxed->number[i]] = cz_search_value(
            cz_evaluator_variable(relaxed->evaluator, relaxed->number[i]), number[i]);
}

static CzStatus evaluate(void *data, int n_point, const double *numbers, double *objective,
                         double *constraint, double *detail, CzError *error) {
    const Relaxed *relaxed = data;
    const size_t n_all = (size_t)relaxed->n_all;
    const int m = relaxed->n_constraint;
    CzEvaluation *evaluation = calloc((size_t)n_point, sizeof *evaluation);
    double *x = calloc((size_t)n_point, n_all * sizeof *x);
    CzStatus status = CZ_STATUS_NO_MEMORY;
    (void)detail;
    if (evaluation == NULL || x == NULL) {
        status = cz_no_memory(error, "the designs");
    } else {
        for (int i = 0; i < n_point; i++)
            expand(relaxed, numbers + i * relaxed->function.n_variable, x + (size_t)i * n_all);
        status = cz_evaluator_search(relaxed->evaluator, n_point, x, evaluation, NULL, error);
    }
    for (int i = 0; i < n_point && status == CZ_OK; i++) {
        memcpy(constraint + i * m, evaluation[i].constraint, (size_t)m * sizeof *constraint);
        objective[i] = offset + constraint[i * m + relaxed->limit];
        if (!isnan(objective[i]))
            constraint[i * m + relaxed->limit] = -1;
    }
    for (int i = 0; evaluation != NULL && i < n_point; i++)
        cz_evaluation_free(&evaluation[i]);
    free(evaluation);
    free(x);
    return status;
}

static bool create(Relaxed *relaxed, CzArena *arena, CzEvaluator *evaluator,
                   const CzOutcome *outcome) {
    const size_t n_all = (size_t)outcome->n_variable;
    const int m = outcome->best_evaluation.n_constraint;
    double *min = cz_arena_numbers(arena, n_all), *max = cz_arena_numbers(arena, n_all);
    double *start = cz_arena_numbers(arena, n_all), *step = cz_arena_numbers(arena, n_all);
    CzConstraintKind *kind = cz_arena_allocate(arena, (size_t)m + 1, sizeof *kind);
    int *number = cz_arena_allocate(arena, n_all, sizeof *number), n = 0;
    if (arena->out_of_memory)
        return false;
    for (int i = 0; i < outcome->n_variable; i++) {
        const CzVariableInfo *info = cz_evaluator_variable(evaluator, i);
        if (info->is_fixed || info->n_choice > 0)
            continue;
        const CzSearchRange range = cz_search_range(info, outcome->best[i]);
        min[n] = range.min;
        max[n] = range.max;
        start[n] = range.start;
        step[n] = range.step;
        number[n++] = i;
    }
    for (int j = 0; j < m; j++) {
        kind[j] = cz_evaluator_constraint_kind(evaluator, j);
        if (kind[j] == CZ_CONSTRAINT_NAMED_RULE)
            kind[j] = CZ_CONSTRAINT_FLAG;
    }
    *relaxed = (Relaxed){.evaluator = evaluator,
                         .best = outcome->best,
                         .n_all = outcome->n_variable,
                         .n_constraint = m,
                         .number = number,
                         .function = {.n_variable = n,
                                      .n_constraint = m,
                                      .min = min,
                                      .max = max,
                                      .start = start,
                                      .step = step,
                                      .kind = kind,
                                      .evaluate = evaluate,
                                      .data = relaxed}};
    return true;
}

/* Stores a design as the relaxation when a full run confirms that it violates the limit only, and
 * by less than the one so far. */
static CzStatus confirm(const Relaxed *relaxed, const double *number, CzOutcome *outcome,
                        CzError *error) {
    const int limit = relaxed->limit;
    CzRelaxation *relaxation = &outcome->relaxation;
    CzEvaluation evaluation;
    double *x = cz_outcome_numbers(outcome, (size_t)relaxed->n_all);
    if (x == NULL)
        return cz_no_memory(error, "the outcome");
    expand(relaxed, number, x);
    CZ_TRY(cz_evaluate(relaxed->evaluator, 1, x, false, &evaluation, error));
    bool others_pass = evaluation.status == CZ_OK && evaluation.constraint_check != NULL;
    for (int j = 0; j < evaluation.n_constraint && others_pass; j++)
        others_pass = j == limit || evaluation.constraint[j] <= 0;
    if (others_pass &&
        (relaxation->x == NULL || evaluation.constraint[limit] < relaxation->violation)) {
        relaxation->constraint = limit;
        relaxation->violation = evaluation.constraint[limit];
        relaxation->limit = evaluation.constraint_check[limit].value;
        relaxation->x = x;
    }
    cz_evaluation_free(&evaluation);
    return CZ_OK;
}

/* Minimises the violation of one limit. */
static CzStatus relax(Relaxed *relaxed, const CzOptimiseOptions *options, CzOutcome *outcome,
                      CzError *error) {
    CzSearch search;
    cz_search_init(&search, &relaxed->function, options);
    CzStatus status = cz_strategy(&search, NULL, 1, error);
    outcome->relaxation.n_evaluation += search.n_record;
    const long best = cz_combinations_record(&search);
    if (status == CZ_OK && best >= 0 && search.record[best].violation <= 0)
        status = confirm(relaxed, cz_search_x(&search, best), outcome, error);
    cz_search_free(&search);
    return status;
}

/* Makes the design without any violation the result. */
static CzStatus adopt(CzEvaluator *evaluator, CzOutcome *outcome, CzError *error) {
    const CzRelaxation relaxation = outcome->relaxation;
    memcpy(outcome->best, relaxation.x, (size_t)outcome->n_variable * sizeof *outcome->best);
    cz_evaluation_free(&outcome->best_evaluation);
    outcome->relaxation = (CzRelaxation){0};
    outcome->status = CZ_OUTCOME_FEASIBLE;
    CZ_TRY(cz_evaluate(evaluator, 1, outcome->best, true, &outcome->best_evaluation, error));
    cz_outcome_mark_bounds(evaluator, outcome);
    snprintf(outcome->why_stopped, sizeof outcome->why_stopped,
             "the design was found by %ld more, which relaxed one limit", relaxation.n_evaluation);
    return CZ_OK;
}

static bool passes_unrelaxed(const CzRelaxation *relaxation) {
    return relaxation->x != NULL && relaxation->violation <= 0;
}

/* The most violated limit with a margin of those below `below`, -1 when there is none. */
static int next_limit(const CzEvaluator *evaluator, const CzEvaluation *best, double below) {
    int next = -1;
    for (int j = 0; j < best->n_constraint; j++)
        if (best->constraint[j] > 0 && best->constraint[j] < below &&
            !best->constraint_check[j].is_flag &&
            cz_evaluator_constraint_kind(evaluator, j) == CZ_CONSTRAINT_GRADED &&
            (next < 0 || best->constraint[j] > best->constraint[next]))
            next = j;
    return next;
}

CzStatus cz_relaxation_find(CzEvaluator *evaluator, const CzOptimiseOptions *given,
                            CzOutcome *outcome, CzError *error) {
    const CzEvaluation *best = &outcome->best_evaluation;
    const volatile sig_atomic_t *stop = given->stop;
    CzArena arena = {0};
    Relaxed relaxed;
    if (outcome->status != CZ_OUTCOME_INFEASIBLE || best->status != CZ_OK ||
        best->constraint_check == NULL || cz_evaluator_is_fit(evaluator))
        return CZ_OK;
    CzStatus status = CZ_OK;
    if (!create(&relaxed, &arena, evaluator, outcome))
        status = cz_no_memory(error, "the relaxation of a limit");
    int n_limit = 0;
    for (double above = INFINITY; n_limit < MAX_LIMITS; n_limit++) {
        const int limit = next_limit(evaluator, best, above);
        if (limit < 0)
            break;
        above = best->constraint[limit];
    }
    const CzOptimiseOptions options = {.evaluations =
                                           n_limit > 0 ? fmax(1, outcome->n_trial / n_limit) : 0,
                                       .width = given->width,
                                       .stop = stop};
    double below = INFINITY;
    for (int i = 0; i < n_limit && status == CZ_OK; i++) {
        relaxed.limit = next_limit(evaluator, best, below);
        if (relaxed.function.n_variable == 0 || (stop != NULL && *stop != 0) ||
            passes_unrelaxed(&outcome->relaxation))
            break;
        below = best->constraint[relaxed.limit];
        status = relax(&relaxed, &options, outcome, error);
    }
    cz_arena_free(&arena);
    if (status == CZ_OK && passes_unrelaxed(&outcome->relaxation))
        status = adopt(evaluator, outcome, error);
    else if (stop != NULL && *stop != 0)
        cz_outcome_cut_short(outcome, "the relaxation of a limit");
    return status;
}
