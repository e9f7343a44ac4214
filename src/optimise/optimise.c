/* Search for a design that passes: from an evaluator to an outcome. */
#include "crushzone/optimise.h"
#include "base/error.h"
#include "evaluate/evaluator.h"
#include "optimise/nlopt_adapter.h"
#include "optimise/strategy.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

/* Designs that are run in full until one keeps what it kept in the search. */
enum { MOST_CONFIRMED = 8 };

const char *cz_outcome_text(CzOutcomeStatus status) {
    static const char *const texts[] = {[CZ_OUTCOME_FEASIBLE] = "feasible",
                                        [CZ_OUTCOME_INFEASIBLE] = "infeasible",
                                        [CZ_OUTCOME_INTERRUPTED] = "interrupted"};
    return texts[status];
}

CzOptimiseOptions cz_optimise_options_default(void) {
    return (CzOptimiseOptions){.seed = -1};
}

/* ---- the evaluator as a function of numbers -------------------------------------------------- */

static CzStatus evaluate_designs(void *data, int n_point, const double *x, double *objective,
                                 double *constraint, double *detail, CzError *error) {
    const CzEvaluator *evaluator = data;
    CzEvaluation *evaluation = calloc((size_t)n_point, sizeof *evaluation);
    if (evaluation == NULL)
        return cz_fail(error, CZ_STATUS_NO_MEMORY, "no memory for %d designs", n_point);
    const CzStatus status = cz_evaluator_search(evaluator, n_point, x, evaluation, detail, error);
    for (int i = 0; i < n_point && status == CZ_OK; i++) {
        const size_t m = (size_t)evaluation[i].n_constraint;
        objective[i] = evaluation[i].objective;
        memcpy(constraint + (size_t)i * m, evaluation[i].constraint, m * sizeof *constraint);
        cz_evaluation_free(&evaluation[i]);
    }
    free(evaluation);
    return status;
}

/* Fills a function from an evaluator; `numbers` is (4 x n_variable), `flags` (n_constraint). */
static CzFunction function_of(CzEvaluator *evaluator, double *numbers, bool *flags) {
    const int n = cz_evaluator_n_variable(evaluator);
    for (int i = 0; i < n; i++) {
        const CzVariableInfo *info = cz_evaluator_variable(evaluator, i);
        numbers[i] = info->min;
        numbers[n + i] = info->max;
        numbers[2 * n + i] = info->start;
        numbers[3 * n + i] = info->step;
    }
    for (int j = 0; j < cz_evaluator_n_constraint(evaluator); j++)
        flags[j] = cz_evaluator_is_flag(evaluator, j);
    return (CzFunction){.n_variable = n,
                        .n_constraint = cz_evaluator_n_constraint(evaluator),
                        .min = numbers,
                        .max = numbers + n,
                        .start = numbers + 2 * n,
                        .step = numbers + 3 * n,
                        .n_detail = cz_evaluator_n_detail(evaluator),
                        .is_flag = flags,
                        .is_minimax = cz_evaluator_maximises_margin(evaluator),
                        .evaluate = evaluate_designs,
                        .data = evaluator};
}

/* ---- the outcome ----------------------------------------------------------------------------- */

/* The record that counts: the best on the catalogue steps when there are any. A search that ended
 * before it came to them gives the best it has seen, and so does one that was interrupted before it
 * found steps that pass. */
static long chosen_record(const CzSearch *search) {
    const long best = search->best, on_grid = search->best_on_grid;
    if (!cz_search_has_steps(search) || !search->is_snapped || on_grid < 0)
        return best;
    const bool passes_only_between =
        search->record[best].violation <= 0 && search->record[on_grid].violation > 0;
    return search->status == CZ_STATUS_INTERRUPTED && passes_only_between ? best : on_grid;
}

static CzStatus copy_history(const CzSearch *search, CzOutcome *outcome, CzError *error) {
    outcome->n_evaluation = outcome->n_trial = search->n_record;
    outcome->trial = calloc((size_t)search->n_record + 1, sizeof *outcome->trial);
    if (outcome->trial == NULL)
        return cz_fail(error, CZ_STATUS_NO_MEMORY, "no memory for the history");
    for (long i = 0; i < search->n_record; i++)
        outcome->trial[i] = (CzTrial){.objective = search->record[i].objective,
                                      .violation = search->record[i].violation,
                                      .feasible = search->record[i].violation <= 0,
                                      .phase = search->record[i].phase};
    return CZ_OK;
}

/* The best record that passed in the search and is none of those whose full run did not, -1 when
 * there is none; on the catalogue steps when the first of them is. */
static long next_passing(const CzSearch *search, int n_refuted, const long *refuted) {
    const bool on_grid = search->record[refuted[0]].on_grid;
    long best = -1;
    for (long record = 0; record < search->n_record; record++) {
        bool is_open =
            search->record[record].violation <= 0 && (search->record[record].on_grid || !on_grid);
        for (int i = 0; i < n_refuted && is_open; i++)
            is_open = memcmp(cz_search_x(search, record), cz_search_x(search, refuted[i]),
                             (size_t)search->function->n_variable * sizeof(double)) != 0;
        if (is_open && cz_search_is_better(search, record, best))
            best = record;
    }
    return best;
}

/* Evaluates the chosen record in full. Runs of a search end once they have settled; when the full
 * run finds a violation that this left out, the next best designs take their turn. */
static CzStatus confirm_best(CzEvaluator *evaluator, const CzSearch *search, CzOutcome *outcome,
                             CzError *error) {
    const size_t size = (size_t)search->function->n_variable * sizeof *outcome->best;
    long tried[MOST_CONFIRMED];
    int n_tried = 0;
    long record = chosen_record(search);
    if (record < 0)
        cz_search_round(search, search->function->start, outcome->best);
    else
        memcpy(outcome->best, cz_search_x(search, record), size);
    CZ_TRY(cz_evaluate(evaluator, 1, outcome->best, true, &outcome->best_evaluation, error));
    if (record < 0 || search->record[record].violation > 0)
        return CZ_OK;
    while (outcome->best_evaluation.violation > 0 && n_tried < MOST_CONFIRMED) {
        tried[n_tried++] = record;
        record = next_passing(search, n_tried, tried);
        if (record < 0)
            return CZ_OK;
        CzEvaluation next;
        CZ_TRY(cz_evaluate(evaluator, 1, cz_search_x(search, record), true, &next, error));
        if (next.violation >= outcome->best_evaluation.violation) {
            cz_evaluation_free(&next);
            continue;
        }
        cz_evaluation_free(&outcome->best_evaluation);
        outcome->best_evaluation = next;
        memcpy(outcome->best, cz_search_x(search, record), size);
    }
    return CZ_OK;
}

/* Evaluates start and best once more, from the file's numbers, with everything recorded. */
static CzStatus confirm(CzEvaluator *evaluator, const CzSearch *search, CzOutcome *outcome,
                        CzError *error) {
    const CzFunction *function = search->function;
    const size_t n = (size_t)function->n_variable;
    outcome->n_variable = function->n_variable;
    outcome->start = calloc(n, sizeof *outcome->start);
    outcome->best = calloc(n, sizeof *outcome->best);
    outcome->at_bound = calloc(n, sizeof *outcome->at_bound);
    if (outcome->start == NULL || outcome->best == NULL || outcome->at_bound == NULL)
        return cz_fail(error, CZ_STATUS_NO_MEMORY, "no memory for the outcome");
    memcpy(outcome->start, function->start, n * sizeof *outcome->start);
    CZ_TRY(cz_evaluate(evaluator, 1, outcome->start, true, &outcome->start_evaluation, error));
    CZ_TRY(confirm_best(evaluator, search, outcome, error));
    for (size_t i = 0; i < n; i++) {
        const double nearness = 1e-6 * (function->max[i] - function->min[i]);
        outcome->at_bound[i] = outcome->best[i] <= function->min[i] + nearness ||
                               outcome->best[i] >= function->max[i] - nearness;
    }
    return CZ_OK;
}

static void conclude(const CzSearch *search, CzOutcome *outcome) {
    const bool feasible =
        outcome->best_evaluation.status == CZ_OK && outcome->best_evaluation.violation <= 0;
    outcome->status = feasible ? CZ_OUTCOME_FEASIBLE : CZ_OUTCOME_INFEASIBLE;
    if (search->status == CZ_STATUS_INTERRUPTED)
        outcome->status = CZ_OUTCOME_INTERRUPTED;
    const long best = cz_search_find(search, outcome->best);
    const bool is_between = best >= 0 && !search->record[best].on_grid;
    snprintf(outcome->why_stopped, sizeof outcome->why_stopped, "%.80s%s",
             search->why[0] != '\0' ? search->why
             : search->is_spent     ? "the limit of evaluations is reached"
                                    : "nothing was left to gain",
             is_between ? "; best not on catalogue steps yet" : "");
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

static CzStatus lead(CzSearch *search, const CzOptimiseOptions *options, CzError *error) {
    const unsigned long seed = (unsigned long)options->seed;
    const CzStatus status = strcmp(options->algorithm, "auto") == 0
                                ? cz_strategy_auto(search, seed, error)
                                : cz_strategy_named(search, options->algorithm, seed, error);
    if (status != CZ_OK || search->status == CZ_OK || search->status == CZ_STATUS_INTERRUPTED)
        return status;
    if (search->status == CZ_STATUS_RUN_FAILED)
        return cz_fail(error, search->status, "%s: the bounds of the variables may be too wide",
                       search->why);
    if (error != NULL)
        *error = search->error;
    return search->status;
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
    double *numbers = calloc(4 * (size_t)cz_evaluator_n_variable(evaluator), sizeof *numbers);
    bool *flags = calloc((size_t)cz_evaluator_n_constraint(evaluator) + 1, sizeof *flags);
    CzOutcome *made = calloc(1, sizeof *made);
    CzStatus status = CZ_OK;
    if (numbers == NULL || flags == NULL || made == NULL) {
        status = cz_fail(error, CZ_STATUS_NO_MEMORY, "no memory for the search");
    } else {
        const CzFunction function = function_of(evaluator, numbers, flags);
        CzSearch search;
        cz_search_init(&search, &function, &options);
        cz_evaluator_set_stop(evaluator, options.stop);
        status = lead(&search, &options, error);
        cz_evaluator_set_stop(evaluator, NULL); /* what was found is evaluated in any case */
        if (status == CZ_OK)
            status = copy_history(&search, made, error);
        if (status == CZ_OK)
            status = confirm(evaluator, &search, made, error);
        if (status == CZ_OK)
            conclude(&search, made);
        made->wall_s = now_s() - began;
        cz_search_free(&search);
    }
    free(numbers);
    free(flags);
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
    free(outcome->trial);
    free(outcome);
}
