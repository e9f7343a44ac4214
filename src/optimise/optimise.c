/* Search for a design that passes: from an evaluator to an outcome. */
#include "crushzone/optimise.h"
#include "base/error.h"
#include "evaluate/evaluator.h"
#include "optimise/alternatives.h"
#include "optimise/combinations.h"
#include "optimise/nlopt_adapter.h"
#include "optimise/outcome.h"
#include "optimise/sensitivity.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

const char *cz_outcome_text(CzOutcomeStatus status) {
    static const char *const texts[] = {[CZ_OUTCOME_FEASIBLE] = "feasible",
                                        [CZ_OUTCOME_INFEASIBLE] = "infeasible",
                                        [CZ_OUTCOME_INTERRUPTED] = "interrupted"};
    return texts[status];
}

CzOptimiseOptions cz_optimise_options_default(void) {
    return (CzOptimiseOptions){.seed = -1,
                               .verify_methods = 1u << CZ_METHOD_HALF_STEP | 1u << CZ_METHOD_TRACK |
                                                 1u << CZ_METHOD_ERK};
}

/* ---- the outcome ----------------------------------------------------------------------------- */

static CzStatus copy_history(const CzCombinations *combinations, int n_variable, CzOutcome *outcome,
                             CzError *error) {
    for (int k = 0; k < combinations->n; k++)
        outcome->n_trial += combinations->search[k].n_record;
    outcome->n_evaluation = outcome->n_trial;
    outcome->trial = calloc((size_t)outcome->n_trial + 1, sizeof *outcome->trial);
    outcome->trial_x =
        calloc((size_t)outcome->n_trial * (size_t)n_variable + 1, sizeof *outcome->trial_x);
    if (outcome->trial == NULL || outcome->trial_x == NULL)
        return cz_fail(error, CZ_STATUS_NO_MEMORY, "no memory for the history");
    CzTrial *trial = outcome->trial;
    double *x = outcome->trial_x;
    for (int k = 0; k < combinations->n; k++)
        for (long i = 0; i < combinations->search[k].n_record; i++) {
            const CzRecord *record = &combinations->search[k].record[i];
            cz_subspace_expand(&combinations->subspace[k], cz_search_x(&combinations->search[k], i),
                               x);
            x += n_variable;
            *trial++ = (CzTrial){.objective = record->objective,
                                 .violation = record->violation,
                                 .feasible = record->violation <= 0,
                                 .phase = record->phase};
        }
    return CZ_OK;
}

/* Whether a record has the design of a listed one. */
static bool is_listed(const CzSearch *search, long record, long n, const long *list) {
    const size_t size = (size_t)search->function->n_variable * sizeof(double);
    for (long i = 0; i < n; i++)
        if (memcmp(cz_search_x(search, record), cz_search_x(search, list[i]), size) == 0)
            return true;
    return false;
}

/* Lists the designs that passed in the search, best first, from a record on; those on the catalogue
 * steps alone when that one is. `list` has room for all records. Returns how many. */
static long rank_passing(const CzSearch *search, long from, long *list) {
    const bool on_grid = search->record[from].on_grid;
    long n = 0;
    list[n++] = from;
    for (long record = 0; record < search->n_record; record++) {
        const CzRecord *found = &search->record[record];
        if (found->violation > 0 || (on_grid && !found->on_grid) ||
            is_listed(search, record, n, list))
            continue;
        long at = n++;
        for (; at > 1 && cz_search_is_better(search, record, list[at - 1]); at--)
            list[at] = list[at - 1];
        list[at] = record;
    }
    return n;
}

/* Evaluates the design of a record in full. */
static CzStatus evaluate_record(CzEvaluator *evaluator, const CzSubspace *subspace,
                                const double *number, double *x, CzEvaluation *evaluation,
                                CzError *error) {
    cz_subspace_expand(subspace, number, x);
    return cz_evaluate(evaluator, 1, x, true, evaluation, error);
}

/* Whether one evaluation in full is worth more than another one. */
static bool is_worth_more(const CzEvaluation *one, const CzEvaluation *other) {
    if (one->violation > 0 || other->violation > 0)
        return one->violation < other->violation;
    return one->objective < other->objective;
}

/* The designs that passed in the search, best first. */
typedef struct Ranking {
    CzEvaluator *evaluator;
    const CzSearch *search;
    const CzSubspace *subspace;
    long n;
    long *record; /* (n) */
    double *x;    /* scratch (n_variable) */
} Ranking;

/* Evaluates a design in full and takes it for the best one when it is worth more; says whether it
 * passes. */
static CzStatus try_in_full(const Ranking *ranking, const double *number, CzOutcome *outcome,
                            bool *passes, CzError *error) {
    CzEvaluation next;
    CZ_TRY(
        evaluate_record(ranking->evaluator, ranking->subspace, number, ranking->x, &next, error));
    *passes = next.violation <= 0;
    if (!is_worth_more(&next, &outcome->best_evaluation)) {
        cz_evaluation_free(&next);
        return CZ_OK;
    }
    cz_evaluation_free(&outcome->best_evaluation);
    outcome->best_evaluation = next;
    memcpy(outcome->best, ranking->x, (size_t)outcome->n_variable * sizeof *ranking->x);
    return CZ_OK;
}

/* The first design of the ranking does not pass in full. Alike designs fail alike, so that the next
 * ones are tried in leaps that double, and what was leapt over is halved until the best one that
 * passes has a neighbour that does not. Last comes the start, which the search may have left. */
static CzStatus find_passing(const Ranking *ranking, CzOutcome *outcome, CzError *error) {
    const CzSearch *search = ranking->search;
    long failed = 0, passed = ranking->n;
    bool passes;
    for (long leap = 1; failed + leap < passed && passed == ranking->n; leap *= 2) {
        const long at = failed + leap;
        CZ_TRY(try_in_full(ranking, cz_search_x(search, ranking->record[at]), outcome, &passes,
                           error));
        *(passes ? &passed : &failed) = at;
    }
    while (passed - failed > 1) {
        const long at = failed + (passed - failed) / 2;
        CZ_TRY(try_in_full(ranking, cz_search_x(search, ranking->record[at]), outcome, &passes,
                           error));
        *(passes ? &passed : &failed) = at;
    }
    return try_in_full(ranking, search->function->start, outcome, &passes, error);
}

/* Evaluates the chosen record in full. Runs of a search end once they have settled; when the full
 * run finds a violation that this left out, the next best designs take their turn. */
static CzStatus confirm_best(Ranking *ranking, CzOutcome *outcome, CzError *error) {
    const CzSearch *search = ranking->search;
    const long record = cz_combinations_record(search);
    /* Without a record the start is known to be readable, the nearest increments are not. */
    CZ_TRY(evaluate_record(ranking->evaluator, ranking->subspace,
                           record < 0 ? search->function->start : cz_search_x(search, record),
                           outcome->best, &outcome->best_evaluation, error));
    if (record < 0 || search->record[record].violation > 0 ||
        outcome->best_evaluation.violation <= 0)
        return CZ_OK;
    ranking->record = calloc((size_t)search->n_record + 1, sizeof *ranking->record);
    if (ranking->record == NULL)
        return cz_fail(error, CZ_STATUS_NO_MEMORY, "no memory for the outcome");
    ranking->n = rank_passing(search, record, ranking->record);
    const CzStatus status = find_passing(ranking, outcome, error);
    free(ranking->record);
    return status;
}

void cz_outcome_mark_bounds(const CzEvaluator *evaluator, CzOutcome *outcome) {
    for (int i = 0; i < outcome->n_variable; i++) {
        const CzVariableInfo *info = cz_evaluator_variable(evaluator, i);
        const double nearness = 1e-6 * (info->max - info->min);
        outcome->at_bound[i] =
            info->n_choice == 0 && !info->is_fixed &&
            (outcome->best[i] <= info->min + nearness || outcome->best[i] >= info->max - nearness);
    }
}

/* Evaluates start and best once more, from the file's numbers, with everything recorded. */
static CzStatus confirm(CzEvaluator *evaluator, const CzCombinations *combinations,
                        CzOutcome *outcome, CzError *error) {
    outcome->n_variable = cz_evaluator_n_variable(evaluator);
    const size_t n = (size_t)outcome->n_variable;
    outcome->start = calloc(n, sizeof *outcome->start);
    outcome->best = calloc(n, sizeof *outcome->best);
    outcome->at_bound = calloc(n, sizeof *outcome->at_bound);
    double *x = calloc(n, sizeof *x);
    CzStatus status = CZ_STATUS_NO_MEMORY;
    if (outcome->start == NULL || outcome->best == NULL || outcome->at_bound == NULL || x == NULL) {
        cz_fail(error, status, "no memory for the outcome");
    } else {
        for (int i = 0; i < outcome->n_variable; i++)
            outcome->start[i] = cz_evaluator_variable(evaluator, i)->start;
        status = cz_evaluate(evaluator, 1, outcome->start, true, &outcome->start_evaluation, error);
        if (status == CZ_OK)
            status =
                confirm_best(&(Ranking){.evaluator = evaluator,
                                        .search = &combinations->search[combinations->chosen],
                                        .subspace = &combinations->subspace[combinations->chosen],
                                        .x = x},
                             outcome, error);
    }
    if (status == CZ_OK)
        cz_outcome_mark_bounds(evaluator, outcome);
    free(x);
    return status;
}

/* Whether the best design misses a catalogue increment. */
static bool is_between_steps(const CzCombinations *combinations, const CzOutcome *outcome) {
    const CzSubspace *subspace = &combinations->subspace[combinations->chosen];
    const CzSearch *search = &combinations->search[combinations->chosen];
    for (long record = 0; record < search->n_record; record++) {
        bool is_best = true;
        for (int i = 0; i < subspace->function.n_variable && is_best; i++)
            is_best = cz_search_x(search, record)[i] == outcome->best[subspace->number[i]];
        if (is_best)
            return !search->record[record].on_grid;
    }
    return false;
}

/* Why the last search ended, to the digit. */
static void tell_end(const CzCombinations *combinations, long limit, const CzOutcome *outcome,
                     size_t room, char *text) {
    const CzSearch *search = &combinations->search[combinations->n - 1];
    const long left = limit - outcome->n_evaluation;
    const CzEvaluation *start = &outcome->start_evaluation;
    if (start->status == CZ_OK && isnan(start->objective) && search->best < 0)
        snprintf(text, room, "the objective has no value in any design");
    else if (search->why[0] != '\0')
        snprintf(text, room, "%s", search->why);
    else if (search->function->n_variable == 0 && combinations->n == 1)
        snprintf(text, room, "no variable can vary: each has one value within its bounds");
    else if (search->is_spent && left <= 0)
        snprintf(text, room, "the limit of %ld evaluations is reached", limit);
    else if (search->is_spent)
        snprintf(text, room, "%ld of %ld evaluations left, %s", left, limit,
                 cz_search_has_steps(search) ? "all reserved for the increments"
                                             : "too few to continue the search");
    else
        snprintf(text, room, "no further improvement");
}

static void conclude(const CzCombinations *combinations, long limit, CzOutcome *outcome) {
    const CzSearch *search = &combinations->search[combinations->n - 1];
    char end[sizeof outcome->why_stopped];
    const bool feasible = outcome->best_evaluation.status == CZ_OK &&
                          outcome->best_evaluation.violation <= 0 &&
                          isfinite(outcome->best_evaluation.objective);
    outcome->status = feasible ? CZ_OUTCOME_FEASIBLE : CZ_OUTCOME_INFEASIBLE;
    if (search->status == CZ_STATUS_INTERRUPTED)
        outcome->status = CZ_OUTCOME_INTERRUPTED;
    tell_end(combinations, limit, outcome, sizeof end, end);
    snprintf(outcome->why_stopped, sizeof outcome->why_stopped, "%.100s%s", end,
             is_between_steps(combinations, outcome)
                 ? "; the best design is between catalogue increments"
                 : "");
}

CzStatus cz_outcome_verify(CzEvaluator *evaluator, const CzOptimiseOptions *options,
                           CzOutcome *outcome, CzError *error) {
    if (outcome->status != CZ_OUTCOME_FEASIBLE || options->verify_methods == 0)
        return CZ_OK;
    CzVerifyOptions chosen = cz_verify_options_default();
    chosen.methods = options->verify_methods;
    chosen.solver_step = 2.0;
    chosen.stop = options->stop;
    const CzStatus status = cz_verify(evaluator, outcome->best, &outcome->best_evaluation, &chosen,
                                      &outcome->verification, error);
    return status == CZ_STATUS_INTERRUPTED ? CZ_OK : status;
}

/* ---- the search ------------------------------------------------------------------------------ */

static CzStatus settle_options(const CzEvaluator *evaluator, const CzOptimiseOptions *given,
                               CzOptimiseOptions *options, CzError *error) {
    const CzOptimise *written = &cz_problem_input(cz_evaluator_problem(evaluator))->optimise;
    *options = given != NULL ? *given : cz_optimise_options_default();
    if (cz_evaluator_n_variable(evaluator) == 0)
        return cz_fail(
            error, CZ_STATUS_INPUT,
            "the problem names no design variables: write 'optimise:' with 'variables:'");
    if (options->algorithm == NULL)
        options->algorithm = written->algorithm != NULL ? written->algorithm : "auto";
    if (options->evaluations == 0)
        options->evaluations = written->evaluations;
    if (options->seed < 0)
        options->seed = written->seed;
    if (options->evaluations < 1)
        return cz_fail(error, CZ_STATUS_INPUT, "the limit of %ld evaluations is below 1",
                       options->evaluations);
    CZ_TRY(cz_evaluator_check_start(evaluator, error));
    if (strcmp(options->algorithm, "auto") == 0)
        return CZ_OK;
    const CzStatus status = cz_nlopt_check(options->algorithm, error);
    if (status != CZ_OK && error != NULL && options->algorithm == written->algorithm)
        cz_problem_place(cz_evaluator_problem(evaluator), &written->algorithm, error);
    return status;
}

CzStatus cz_optimise_check(const CzEvaluator *evaluator, const CzOptimiseOptions *options,
                           CzError *error) {
    CzOptimiseOptions settled;
    return settle_options(evaluator, options, &settled, error);
}

static double now_s(void) {
    struct timespec time;
    clock_gettime(CLOCK_MONOTONIC, &time);
    return (double)time.tv_sec + 1e-9 * (double)time.tv_nsec;
}

CzStatus cz_optimise(CzEvaluator *evaluator, const CzOptimiseOptions *given, CzOutcome **outcome,
                     CzError *error) {
    *outcome = NULL;
    CzOptimiseOptions options;
    CZ_TRY(settle_options(evaluator, given, &options, error));
    const double began = now_s();
    CzCombinations combinations = {0};
    CzOutcome *made = calloc(1, sizeof *made);
    if (made == NULL)
        return cz_fail(error, CZ_STATUS_NO_MEMORY, "no memory for the search");
    cz_evaluator_set_stop(evaluator, options.stop);
    CzStatus status = cz_combinations(evaluator, &options, &combinations, error);
    cz_evaluator_set_stop(evaluator, NULL); /* what was found is evaluated in any case */
    if (status == CZ_OK)
        status = copy_history(&combinations, cz_evaluator_n_variable(evaluator), made, error);
    if (status == CZ_OK)
        status = confirm(evaluator, &combinations, made, error);
    if (status == CZ_OK && cz_evaluator_is_fit(evaluator))
        status = cz_alternatives_find(
            &combinations.subspace[combinations.chosen], &combinations.search[combinations.chosen],
            cz_combinations_record(&combinations.search[combinations.chosen]), made, error);
    if (status == CZ_OK)
        conclude(&combinations, options.evaluations, made);
    if (status == CZ_OK)
        status = cz_outcome_verify(evaluator, &options, made, error);
    if (status == CZ_OK)
        status = cz_sensitivity_take(evaluator, options.stop, made, error);
    made->wall_s = now_s() - began;
    cz_combinations_free(&combinations);
    if (status != CZ_OK) {
        cz_outcome_free(made);
        return status;
    }
    *outcome = made;
    return CZ_OK;
}

void cz_outcome_free(CzOutcome *outcome) {
    if (outcome == NULL)
        return;
    free(outcome->start);
    free(outcome->best);
    free(outcome->at_bound);
    cz_evaluation_free(&outcome->start_evaluation);
    cz_evaluation_free(&outcome->best_evaluation);
    free(outcome->alternative);
    free(outcome->alternative_objective);
    cz_verification_free(outcome->verification);
    free(outcome->sensitivity_increment);
    free(outcome->objective_change);
    free(outcome->constraint_change);
    free(outcome->trial_x);
    free(outcome->trial);
    free(outcome);
}
