/* The next best design of a search against scatter where the best one is not verified.
 *
 *   designs that passed, best first --> all scenarios --> verification --> samples, adversary
 *
 * Each step is dearer than the one before. There is no further search: what breaks a design is
 * known from the rounds.
 */
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "optimise/outcome.h"
#include "optimise/robust_judge.h"
#include "optimise/verified.h"

enum {
    MAX_VERIFIED = 4, /* further designs that are verified (ours) */
    MAX_TRIED = 24    /* and that are run in all scenarios for it (ours) */
};

/* What is tried, and what for; borrowed. */
typedef struct Attempt {
    const CzRobustJudge *judge;
    CzEvaluator *evaluator; /* of all scenarios */
    const CzOptimiseOptions *options;
    CzOutcome *outcome;
    CzRobustJudged *judged; /* of the design that was found */
    const double *tried[MAX_TRIED];
    int n_tried, n_verified;
} Attempt;

/* Sorts the designs with the better objective first, of equal ones the earlier. */
static int compare(const void *one, const void *other) {
    const CzTrial *a = *(const CzTrial *const *)one, *b = *(const CzTrial *const *)other;
    if (a->objective != b->objective)
        return a->objective < b->objective ? -1 : 1;
    return (a > b) - (a < b);
}

/* Whether a design was tried, or is like a refused one. */
static bool is_tried(const Attempt *attempt, const double *x) {
    const CzOutcome *outcome = attempt->outcome;
    const bool on_grid = cz_is_on_increments(attempt->evaluator, x);
    for (int i = 0; i < attempt->n_tried; i++)
        if (memcmp(x, attempt->tried[i], (size_t)outcome->n_variable * sizeof *x) == 0)
            return true;
    for (int i = 0; i < outcome->n_rejected; i++)
        if (cz_is_alike(attempt->evaluator, x, outcome->rejected[i].x, on_grid))
            return true;
    return false;
}

static CzStatus passes_in_all(const Attempt *attempt, const double *x, bool *passes,
                              CzError *error) {
    CzEvaluation evaluation;
    CZ_TRY(cz_evaluate(attempt->evaluator, 1, x, false, &evaluation, error));
    *passes = evaluation.status == CZ_OK && evaluation.violation <= 0;
    cz_evaluation_free(&evaluation);
    return CZ_OK;
}

/* Makes a design the result. */
static CzStatus take(const Attempt *attempt, const double *x, CzVerification *verification,
                     CzError *error) {
    CzOutcome *outcome = attempt->outcome;
    cz_verification_free(outcome->verification);
    outcome->verification = verification;
    cz_evaluation_free(&outcome->best_evaluation);
    memcpy(outcome->best, x, (size_t)outcome->n_variable * sizeof *x);
    outcome->status = CZ_OUTCOME_FEASIBLE;
    cz_outcome_mark_bounds(attempt->evaluator, outcome);
    return cz_evaluate(attempt->evaluator, 1, outcome->best, true, &outcome->best_evaluation,
                       error);
}

/* Judges a verified design against scatter; an interrupted judgement says nothing. */
static CzStatus judge_verified(const Attempt *attempt, const double *x, bool *holds,
                               CzError *error) {
    CzRobustJudged *judged = attempt->judged;
    const volatile sig_atomic_t *stop = attempt->judge->stop;
    CZ_TRY(cz_robust_judge(attempt->judge, x, judged, error));
    *holds = cz_robust_passes(judged);
    return stop != NULL && *stop != 0 ? CZ_STATUS_INTERRUPTED : CZ_OK;
}

/* Verifies a design that passes in all scenarios, and judges it; *is_found when it holds. */
static CzStatus try_design(Attempt *attempt, const CzTrial *trial, const double *x, bool *is_found,
                           CzError *error) {
    CzVerification *verification = NULL;
    attempt->n_verified++;
    CZ_TRY(cz_outcome_verify_design(attempt->evaluator, attempt->options, x, NULL, &verification,
                                    error));
    CzStatus status =
        verification->verdict != CZ_VERDICT_PASS
            ? cz_outcome_reject(attempt->outcome, x, trial->objective, verification, error)
            : judge_verified(attempt, x, is_found, error);
    if (status == CZ_OK && *is_found)
        return take(attempt, x, verification, error);
    cz_verification_free(verification);
    cz_robust_judged_free(attempt->judged);
    return status;
}

/* Tries the designs of a list in order. */
static CzStatus try_list(Attempt *attempt, long n, const CzTrial *const *list, CzError *error) {
    const CzOutcome *outcome = attempt->outcome;
    bool is_found = false;
    for (long i = 0;
         i < n && !is_found && attempt->n_tried < MAX_TRIED && attempt->n_verified < MAX_VERIFIED;
         i++) {
        const double *x = outcome->trial_x + (list[i] - outcome->trial) * outcome->n_variable;
        bool passes;
        if (is_tried(attempt, x))
            continue;
        attempt->tried[attempt->n_tried++] = x;
        CZ_TRY(passes_in_all(attempt, x, &passes, error));
        if (passes)
            CZ_TRY(try_design(attempt, list[i], x, &is_found, error));
    }
    return CZ_OK;
}

/* Lists the designs that passed in the scenarios of their round, best first; returns how many. */
static long list_passed(const CzOutcome *outcome, const CzTrial **list) {
    long n = 0;
    for (long i = 0; i < outcome->n_trial; i++)
        if (outcome->trial[i].feasible)
            list[n++] = &outcome->trial[i];
    qsort(list, (size_t)n, sizeof(const CzTrial *), compare);
    return n;
}

CzStatus cz_robust_find_verified(const CzRobustJudge *judge, CzEvaluator *evaluator,
                                 const CzOptimiseOptions *options, CzOutcome *outcome,
                                 CzRobustJudged *judged, CzError *error) {
    Attempt attempt = {.judge = judge,
                       .evaluator = evaluator,
                       .options = options,
                       .outcome = outcome,
                       .judged = judged};
    if (outcome->status != CZ_OUTCOME_UNVERIFIED)
        return CZ_OK;
    outcome->rejected = cz_outcome_rejected(outcome, MAX_VERIFIED + 1);
    if (outcome->rejected == NULL)
        return cz_no_memory(error, "the outcome");
    CZ_TRY(cz_outcome_reject(outcome, outcome->best, outcome->best_evaluation.objective,
                             outcome->verification, error));
    const CzTrial **list = malloc(((size_t)outcome->n_trial + 1) * sizeof *list);
    if (list == NULL)
        return cz_no_memory(error, "the designs");
    const long n = list_passed(outcome, list);
    cz_evaluator_set_stop(evaluator, options->stop);
    const CzStatus status = try_list(&attempt, n, list, error);
    cz_evaluator_set_stop(evaluator, NULL);
    free(list);
    return status;
}
