/* Searches for a design that passes, and fills the outcome. */
#include "crushzone/optimise.h"
#include "base/clock.h"
#include "base/error.h"
#include "base/index.h"
#include "evaluate/evaluator.h"
#include "evaluate/listed.h"
#include "optimise/combinations.h"
#include "optimise/nlopt_adapter.h"
#include "optimise/outcome.h"
#include "optimise/verified.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

const char *cz_outcome_text(CzOutcomeStatus status) {
    static const char *const texts[] = {[CZ_OUTCOME_FEASIBLE] = "feasible",
                                        [CZ_OUTCOME_UNVERIFIED] = "unverified",
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

/* A design that passed in a search. */
typedef struct Passed {
    const CzSearch *search;
    long record;
} Passed;

/* Sorts the better one first, of equal ones the earlier. */
static int compare_passed(const void *one, const void *other) {
    const Passed *a = one, *b = other;
    if (cz_search_is_better(a->search, a->record, b->record))
        return -1;
    if (cz_search_is_better(a->search, b->record, a->record))
        return 1;
    return (a->record > b->record) - (a->record < b->record);
}

/* Lists the designs that passed in the search, each once: first that of a given record, then the
 * best first; only designs on the catalogue increments when that record is. `list` has room for all
 * records. Returns how many, -1 without memory. */
static long rank_passed(const CzSearch *search, long first, Passed *list) {
    const size_t size = (size_t)search->function->n_variable * sizeof(double);
    const bool on_grid = search->record[first].on_grid;
    CzArena arena = {0};
    CzIndex listed = {.arena = &arena};
    long n = 0;
    list[n++] = (Passed){search, first};
    bool has_memory = cz_index_add(&listed, (const char *)cz_search_x(search, first), size, 0);
    for (long record = 0; record < search->n_record && has_memory; record++) {
        const CzRecord *found = &search->record[record];
        const char *design = (const char *)cz_search_x(search, record);
        if (found->violation > 0 || (on_grid && !found->on_grid) ||
            cz_index_find(&listed, design, size) >= 0)
            continue;
        list[n++] = (Passed){search, record};
        has_memory = cz_index_add(&listed, design, size, 0);
    }
    cz_arena_free(&arena);
    qsort(list + 1, (size_t)n - 1, sizeof *list, compare_passed);
    return has_memory ? n : -1;
}

/* Whether one full evaluation is preferred to another one. */
static bool is_preferred(const CzEvaluation *one, const CzEvaluation *other) {
    if (one->violation > 0 || other->violation > 0)
        return one->violation < other->violation;
    return one->objective < other->objective;
}

/* Confirmation of the best design of a search. */
typedef struct Confirmation {
    CzEvaluator *evaluator;
    const CzSubspace *subspace;
    CzOutcome *outcome;
    double *x; /* scratch (n_variable) */
    bool is_interrupted;
} Confirmation;

/* Evaluates a design in full and stores it as the best one when it is preferred; returns whether it
 * passes. */
static CzStatus try_in_full(const Confirmation *confirmation, const double *number, bool *passes,
                            CzError *error) {
    CzOutcome *outcome = confirmation->outcome;
    CzEvaluation next;
    cz_subspace_expand(confirmation->subspace, number, confirmation->x);
    CZ_TRY(cz_evaluate(confirmation->evaluator, 1, confirmation->x, true, &next, error));
    *passes = next.violation <= 0;
    if (!is_preferred(&next, &outcome->best_evaluation)) {
        cz_evaluation_free(&next);
        return CZ_OK;
    }
    cz_evaluation_free(&outcome->best_evaluation);
    outcome->best_evaluation = next;
    memcpy(outcome->best, confirmation->x, (size_t)outcome->n_variable * sizeof *outcome->best);
    return CZ_OK;
}

/* The first of n ranked designs does not pass in full. Similar designs fail in the same way, so the
 * next ones are tried at doubling distances in the list, and the last distance is halved until the
 * best design that passes follows one that does not. The start is tried last, because the search
 * may have left it. */
static CzStatus find_passing(const Confirmation *confirmation, long n, const Passed *list,
                             CzError *error) {
    const CzSearch *search = &confirmation->subspace->search;
    long failed = 0, passed = n;
    bool passes;
    for (long step = 1; passed - failed > 1; step *= 2) {
        const bool is_open = passed == n && failed + step < n;
        const long at = is_open ? failed + step : failed + (passed - failed) / 2;
        CZ_TRY(try_in_full(confirmation, cz_search_x(search, list[at].record), &passes, error));
        *(passes ? &passed : &failed) = at;
    }
    return try_in_full(confirmation, search->function->start, &passes, error);
}

/* Evaluates the chosen record in full. Runs of a search end as soon as their results are final; if
 * the full run finds a later violation, the next best designs are tried. */
static CzStatus confirm_best(const Confirmation *confirmation, CzError *error) {
    CzOutcome *outcome = confirmation->outcome;
    const CzSearch *search = &confirmation->subspace->search;
    const long record = cz_combinations_record(search);
    /* Without a record the start is known to be valid; the nearest increments may not be. */
    cz_subspace_expand(confirmation->subspace,
                       record < 0 ? search->function->start : cz_search_x(search, record),
                       outcome->best);
    CZ_TRY(cz_evaluate(confirmation->evaluator, 1, outcome->best, true, &outcome->best_evaluation,
                       error));
    if (confirmation->is_interrupted && record >= 0 && isnan(outcome->best_evaluation.objective))
        outcome->best_evaluation.objective = search->record[record].objective;
    if (record < 0 || search->record[record].violation > 0 ||
        outcome->best_evaluation.violation <= 0 || confirmation->is_interrupted)
        return CZ_OK;
    Passed *list = calloc((size_t)search->n_record + 1, sizeof *list);
    const long n = list != NULL ? rank_passed(search, record, list) : -1;
    const CzStatus status =
        n < 0 ? cz_no_memory(error, "the outcome") : find_passing(confirmation, n, list, error);
    free(list);
    return status;
}

/* Leaves scenarios out by the margins of the best design in an interrupted search. */
static CzStatus leave_out(CzEvaluator *evaluator, const CzSearch *search, CzError *error) {
    const long record = cz_combinations_record(search);
    return cz_outcome_leave_out(evaluator, cz_search_n_detail(search),
                                record >= 0 ? cz_search_detail(search, record) : NULL, error);
}

static bool is_interrupted(const CzCombinations *combinations) {
    return combinations->subspace[combinations->n - 1].search.status == CZ_STATUS_INTERRUPTED;
}

/* Evaluates start and best design again, from the file's numbers; the best one with all channels
 * recorded. */
static CzStatus confirm(CzEvaluator *evaluator, const CzCombinations *combinations,
                        CzOutcome *outcome, CzError *error) {
    const CzSubspace *subspace = &combinations->subspace[combinations->chosen];
    const Confirmation confirmation = {.evaluator = evaluator,
                                       .subspace = subspace,
                                       .outcome = outcome,
                                       .x =
                                           cz_outcome_numbers(outcome, (size_t)outcome->n_variable),
                                       .is_interrupted = is_interrupted(combinations)};
    if (confirmation.x == NULL)
        return cz_no_memory(error, "the outcome");
    CZ_TRY(cz_outcome_evaluate_start(evaluator, outcome, error));
    CZ_TRY(confirm_best(&confirmation, error));
    cz_outcome_mark_bounds(evaluator, outcome);
    return CZ_OK;
}

/* Whether the best design is off a catalogue increment. */
static bool is_between_steps(const CzSubspace *subspace, const CzOutcome *outcome) {
    for (int i = 0; i < subspace->function.n_variable; i++) {
        const int number = subspace->number[i];
        if (!cz_variable_has(cz_evaluator_variable(subspace->evaluator, number),
                             outcome->best[number]))
            return true;
    }
    return false;
}

/* Writes the reason why the last search ended. */
static void write_end(const CzCombinations *combinations, long limit, const CzOutcome *outcome,
                      size_t room, char *text) {
    const CzSearch *search = &combinations->subspace[combinations->n - 1].search;
    const long left = limit - outcome->n_evaluation;
    const bool is_kept = combinations->n == 1 && combinations->n_reserved > 0;
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
                 is_kept                       ? "reserved for designs that are not verified"
                 : cz_search_has_steps(search) ? "all reserved for the increments"
                                               : "too few to continue the search");
    else
        snprintf(text, room, "no further improvement");
}

/* Writes the reason why the searches ended, and what is to be known about the best design. */
static void write_why(const CzCombinations *combinations, long limit, CzOutcome *outcome) {
    const CzSubspace *chosen = &combinations->subspace[combinations->chosen];
    char end[sizeof outcome->why_stopped];
    write_end(combinations, limit, outcome, sizeof end, end);
    snprintf(outcome->why_stopped, sizeof outcome->why_stopped, "%.100s%s", end,
             is_between_steps(chosen, outcome) ? "; the best design is between catalogue increments"
                                               : "");
}

static void conclude(const CzCombinations *combinations, long limit, CzOutcome *outcome) {
    const bool feasible = outcome->best_evaluation.status == CZ_OK &&
                          outcome->best_evaluation.violation <= 0 &&
                          isfinite(outcome->best_evaluation.objective);
    outcome->status = is_interrupted(combinations) ? CZ_OUTCOME_INTERRUPTED
                      : feasible                   ? CZ_OUTCOME_FEASIBLE
                                                   : CZ_OUTCOME_INFEASIBLE;
    write_why(combinations, limit, outcome);
}

/* Writes the reason again, with the designs that were not verified. */
static void conclude_verification(const CzCombinations *combinations, long limit,
                                  CzOutcome *outcome) {
    if (outcome->status == CZ_OUTCOME_INTERRUPTED) {
        snprintf(outcome->why_stopped, sizeof outcome->why_stopped,
                 "interrupted during the verification");
        return;
    }
    write_why(combinations, limit, outcome);
    cz_outcome_note_rejected(outcome);
}

/* Looks for the relaxation of a limit; a design that it finds to pass without one is verified. */
static CzStatus relax(CzEvaluator *evaluator, const CzOptimiseOptions *options, CzOutcome *outcome,
                      CzError *error) {
    const bool was_infeasible = outcome->status == CZ_OUTCOME_INFEASIBLE;
    CZ_TRY(cz_relaxation_find(evaluator, options, outcome, error));
    return was_infeasible ? cz_outcome_verify(evaluator, options, outcome, error) : CZ_OK;
}

static CzStatus fill_outcome(CzEvaluator *evaluator, CzCombinations *combinations,
                             const CzOptimiseOptions *options, CzOutcome *outcome, CzError *error) {
    const CzSubspace *chosen = &combinations->subspace[combinations->chosen];
    outcome->width = options->width;
    if (options->start != NULL)
        memcpy(outcome->start, options->start, (size_t)outcome->n_variable * sizeof(double));
    CZ_TRY(cz_outcome_take_history(outcome, combinations, error));
    if (is_interrupted(combinations))
        CZ_TRY(leave_out(evaluator, &chosen->search, error));
    CZ_TRY(confirm(evaluator, combinations, outcome, error));
    if (cz_evaluator_is_fit(evaluator))
        CZ_TRY(
            cz_alternatives_find(chosen, cz_combinations_record(&chosen->search), outcome, error));
    conclude(combinations, options->evaluations, outcome);
    CZ_TRY(cz_outcome_verify(evaluator, options, outcome, error));
    CZ_TRY(cz_verified_find(evaluator, combinations, options, outcome, error));
    if (outcome->n_rejected > 0) {
        CZ_TRY(cz_outcome_take_history(outcome, combinations, error));
        conclude_verification(combinations, options->evaluations, outcome);
    }
    CZ_TRY(relax(evaluator, options, outcome, error));
    CZ_TRY(cz_outcome_record_start(evaluator, outcome, error));
    if (options->no_sensitivities)
        return CZ_OK;
    CZ_TRY(cz_sensitivity_take(evaluator, options->stop, outcome, error));
    CZ_TRY(cz_margins_order(evaluator, outcome, error));
    return cz_stationarity_find(evaluator, outcome, error);
}

/* ---- the search ------------------------------------------------------------------------------ */

CzStatus cz_optimise_fill_defaults(const CzEvaluator *evaluator, CzOptimiseOptions *options,
                                   CzError *error) {
    const CzOptimise *written = &cz_problem_input(cz_evaluator_problem(evaluator))->optimise;
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
    if (options->width == 0)
        options->width = CZ_USUAL_WIDTH;
    if (options->width < CZ_USUAL_WIDTH || options->width > CZ_MAX_WIDTH)
        return cz_fail(error, CZ_STATUS_INPUT, "the width of %d designs is not from %d to %d",
                       options->width, CZ_USUAL_WIDTH, CZ_MAX_WIDTH);
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
    CzOptimiseOptions settled = options != NULL ? *options : cz_optimise_options_default();
    return cz_optimise_fill_defaults(evaluator, &settled, error);
}

CzStatus cz_optimise(CzEvaluator *evaluator, const CzOptimiseOptions *given, CzOutcome **outcome,
                     CzError *error) {
    const double began = cz_clock();
    CzOptimiseOptions options = given != NULL ? *given : cz_optimise_options_default();
    CzCombinations combinations;
    *outcome = NULL;
    CZ_TRY(cz_optimise_fill_defaults(evaluator, &options, error));
    cz_evaluator_set_stop(evaluator, options.stop);
    CzStatus status = cz_combinations(evaluator, &options, &combinations, error);
    cz_evaluator_set_stop(evaluator, NULL); /* the best design is evaluated in any case */
    if (status == CZ_OK)
        status = cz_outcome_create(evaluator, 0, outcome, error);
    if (status == CZ_OK)
        status = fill_outcome(evaluator, &combinations, &options, *outcome, error);
    if (status == CZ_OK)
        (*outcome)->wall_s = cz_clock() - began;
    cz_combinations_free(&combinations);
    return cz_outcome_pass_on(*outcome, status, outcome);
}
