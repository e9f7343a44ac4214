/* The next best design where the best one is not verified.
 *
 *   best design --verify--> refused --> required margins --> further search, next best design -->
 * ...
 *
 * A design is refused when another method changes a result too much or a verdict. Which designs
 * these are is not known before: the response of long trains may be chaotic.
 */
#include "optimise/verified.h"
#include "base/error.h"
#include "evaluate/evaluator.h"
#include "optimise/combinations.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum {
    MAX_VERIFIED = 4, /* designs that are verified in all scenarios after the best one (ours) */
    MAX_TRIED = 24    /* designs that are tried for it (ours) */
};

typedef struct Candidate {
    const CzSubspace *subspace;
    long record;
} Candidate;

typedef struct Trial {
    CzEvaluator *evaluator;
    CzCombinations *combinations;
    const CzOptimiseOptions *options;
    CzOutcome *outcome;
    CzRequired required;
    bool on_grid;     /* only designs on the catalogue increments count */
    double *x;        /* scratch (n_variable) */
    double objective; /* of the design in the search */
    int n_verified, n_tried;
    int n_listed; /* candidates in the list */
    Candidate *list;
} Trial;

/* ---- what a verification found --------------------------------------------------------------- */

/* The method and the result by which a design is refused: a changed verdict before a large change.
 */
static void find_reason(const CzVerification *verification, CzRejected *rejected) {
    double worst = -1;
    for (int method = 0; method < CZ_N_VERIFY_METHOD; method++)
        for (int i = 0; i < verification->n_value && verification->is_done[method]; i++) {
            const CzVerifiedValue *value = &verification->value[i];
            const double change = isnan(value->change[method]) ? 0 : value->change[method];
            const double weight = change + (value->flips[method] ? 1e3 : 0);
            if (weight <= worst)
                continue;
            worst = weight;
            rejected->method = (CzVerifyMethod)method;
            rejected->value = *value;
        }
}

/* The graded constraint that a verified result is of, -1 for none. */
static int constraint_of(const CzEvaluator *evaluator, const CzVerifiedValue *value) {
    for (int j = 0; j < cz_evaluator_n_constraint(evaluator); j++) {
        const int scenario = cz_evaluator_constraint_scenario(evaluator, j);
        const char *name = scenario < 0 ? "" : cz_evaluator_scenario_name(evaluator, scenario);
        if (cz_evaluator_constraint_kind(evaluator, j) == CZ_CONSTRAINT_GRADED &&
            strcmp(cz_evaluator_constraint_check(evaluator, j), value->name) == 0 &&
            strcmp(name, value->scenario) == 0)
            return j;
    }
    return -1;
}

/* Requires the change of a margin as a margin where it changes the verdict. */
static void require(Trial *trial, const CzVerification *verification) {
    for (int i = 0; i < verification->n_value && !cz_evaluator_is_fit(trial->evaluator); i++) {
        const CzVerifiedValue *value = &verification->value[i];
        for (int method = 0; method < CZ_N_VERIFY_METHOD; method++) {
            const int j = value->flips[method] ? constraint_of(trial->evaluator, value) : -1;
            if (j >= 0) /* not for NaN */
                trial->required.margin[j] = fmax(trial->required.margin[j], value->change[method]);
        }
    }
}

CzStatus cz_outcome_reject(CzOutcome *outcome, const double *x, double objective,
                           const CzVerification *verification, CzError *error) {
    const size_t n = (size_t)outcome->n_variable;
    double *copy = cz_outcome_numbers(outcome, n);
    if (copy == NULL)
        return cz_no_memory(error, "the outcome");
    memcpy(copy, x, n * sizeof *x);
    CzRejected *rejected = &outcome->rejected[outcome->n_rejected++];
    *rejected = (CzRejected){.x = copy, .objective = objective};
    memcpy(rejected->failure, verification->failure, sizeof rejected->failure);
    find_reason(verification, rejected);
    return CZ_OK;
}

void cz_outcome_note_rejected(CzOutcome *outcome) {
    const size_t n = strlen(outcome->why_stopped);
    const bool is_found = outcome->status == CZ_OUTCOME_FEASIBLE;
    char designs[60];
    if (outcome->n_rejected == 0 || outcome->status == CZ_OUTCOME_INTERRUPTED)
        return;
    snprintf(designs, sizeof designs, outcome->n_rejected == 1 ? "1 design" : "%d designs",
             outcome->n_rejected);
    snprintf(outcome->why_stopped + n, sizeof outcome->why_stopped - n,
             is_found ? "; %s with a better objective not verified" : "; %s not verified", designs);
}

/* Notes a design that is not verified, and what is required of the next ones. */
static CzStatus refuse(Trial *trial, const double *x, double objective,
                       const CzVerification *verification, CzError *error) {
    CzOutcome *outcome = trial->outcome;
    CzRequired *required = &trial->required;
    CZ_TRY(cz_outcome_reject(outcome, x, objective, verification, error));
    required->x[required->n++] = outcome->rejected[outcome->n_rejected - 1].x;
    require(trial, verification);
    return CZ_OK;
}

/* ---- the next designs ------------------------------------------------------------------------ */

/* Distance between the increments within which a design is like a refused one, as a share of the
 * ranges (ours). */
static const double alike = 0.02;

/* Largest difference of a variable between two designs, as a share of its range. */
static double distance(const CzEvaluator *evaluator, const double *x, const double *other) {
    double largest = 0;
    for (int i = 0; i < cz_evaluator_n_variable(evaluator); i++) {
        const CzVariableInfo *info = cz_evaluator_variable(evaluator, i);
        if (x[i] != other[i])
            largest = fmax(largest, fabs(x[i] - other[i]) / (info->max - info->min));
    }
    return largest;
}

bool cz_is_alike(const CzEvaluator *evaluator, const double *x, const double *refused,
                 bool on_grid) {
    return distance(evaluator, x, refused) <= (on_grid ? 0 : alike);
}

static bool is_refused(const Trial *trial, const double *x) {
    for (int i = 0; i < trial->required.n; i++)
        if (cz_is_alike(trial->evaluator, x, trial->required.x[i], trial->on_grid))
            return true;
    return false;
}

static const CzRecord *record_of(const Candidate *candidate) {
    return &candidate->subspace->search.record[candidate->record];
}

/* Sorts the better one first, of equal ones the earlier. */
static int compare(const void *one, const void *other) {
    const Candidate *a = one, *b = other;
    if (cz_record_is_better(record_of(a), record_of(b)))
        return -1;
    if (cz_record_is_better(record_of(b), record_of(a)))
        return 1;
    if (a->subspace != b->subspace)
        return a->subspace > b->subspace ? 1 : -1;
    return (a->record > b->record) - (a->record < b->record);
}

/* Lists the designs of all searches that pass, best first. */
static CzStatus list_candidates(Trial *trial, CzError *error) {
    const CzCombinations *combinations = trial->combinations;
    const size_t n = (size_t)cz_combinations_n_record(combinations) + 1;
    Candidate *list = realloc(trial->list, n * sizeof *list);
    if (list == NULL)
        return cz_no_memory(error, "the designs");
    trial->list = list;
    trial->n_listed = 0;
    for (int k = 0; k < combinations->n; k++) {
        const CzSearch *search = &combinations->subspace[k].search;
        for (long record = 0; record < search->n_record; record++)
            if (search->record[record].violation <= 0 &&
                (search->record[record].on_grid || !trial->on_grid))
                list[trial->n_listed++] = (Candidate){&combinations->subspace[k], record};
    }
    qsort(list, (size_t)trial->n_listed, sizeof *list, compare);
    return CZ_OK;
}

/* Whether a design keeps the required margins. */
static bool keeps_margins(const Trial *trial, const CzEvaluation *evaluation) {
    bool is_kept = evaluation->status == CZ_OK && evaluation->violation <= 0;
    for (int j = 0; j < evaluation->n_constraint && is_kept; j++)
        is_kept = evaluation->constraint[j] + trial->required.margin[j] <= 0;
    return is_kept;
}

/* Verifies a design; one that is not verified is refused. */
static CzStatus verify(Trial *trial, const CzEvaluation *whole, CzVerification **verification,
                       CzError *error) {
    *verification = NULL;
    CZ_TRY(cz_outcome_verify_design(trial->evaluator, trial->options, trial->x, whole, verification,
                                    error));
    if ((*verification)->verdict == CZ_VERDICT_PASS)
        return CZ_OK;
    const CzStatus status = refuse(trial, trial->x, trial->objective, *verification, error);
    cz_verification_free(*verification);
    *verification = NULL;
    return status;
}

/* Takes a design with its whole runs as the result when it is verified. */
static CzStatus take_verified(Trial *trial, bool *is_verified, CzError *error) {
    CzOutcome *outcome = trial->outcome;
    CzEvaluation whole;
    CzVerification *verification = NULL;
    CZ_TRY(cz_evaluate(trial->evaluator, 1, trial->x, true, &whole, error));
    trial->objective = whole.objective;
    const CzStatus status = verify(trial, &whole, &verification, error);
    *is_verified = status == CZ_OK && verification != NULL;
    if (!*is_verified) {
        cz_evaluation_free(&whole);
        return status;
    }
    cz_evaluation_free(&outcome->best_evaluation);
    cz_verification_free(outcome->verification);
    outcome->best_evaluation = whole;
    outcome->verification = verification;
    memcpy(outcome->best, trial->x, (size_t)outcome->n_variable * sizeof *outcome->best);
    outcome->status = CZ_OUTCOME_FEASIBLE;
    cz_outcome_mark_bounds(trial->evaluator, outcome);
    return CZ_OK;
}

/* Whether a design is verified in the scenarios in which others were refused: the response of most
 * scenarios is not chaotic. */
static CzStatus screen(Trial *trial, bool *passes, CzError *error) {
    const CzOutcome *outcome = trial->outcome;
    const char *name[MAX_TRIED + 1];
    int n = 0;
    CzVerification *verification = NULL;
    for (int i = 0; i < outcome->n_rejected; i++)
        if (outcome->rejected[i].value.scenario[0] != '\0')
            name[n++] = outcome->rejected[i].value.scenario;
    for (int s = 0; s < cz_evaluator_n_scenario(trial->evaluator); s++)
        if (!cz_evaluator_has_run_of(trial->evaluator, s))
            n = 0; /* the caller selects the scenarios */
    *passes = true;
    if (n == 0)
        return CZ_OK;
    CzStatus status = cz_evaluator_set_scenarios(trial->evaluator, n, name, error);
    if (status == CZ_OK)
        status = verify(trial, NULL, &verification, error);
    *passes = status == CZ_OK && verification != NULL;
    cz_verification_free(verification);
    const CzStatus restored = cz_evaluator_set_scenarios(trial->evaluator, 0, NULL, error);
    return status != CZ_OK ? status : restored;
}

/* Tries the design of trial->x: by one evaluation, in the scenarios in which others were refused,
 * then in all. */
static CzStatus try_design(Trial *trial, bool *is_verified, CzError *error) {
    CzEvaluation evaluation;
    bool passes;
    trial->n_tried++;
    CZ_TRY(screen(trial, &passes, error));
    if (!passes)
        return CZ_OK;
    CZ_TRY(cz_evaluate(trial->evaluator, 1, trial->x, false, &evaluation, error));
    passes = keeps_margins(trial, &evaluation);
    cz_evaluation_free(&evaluation);
    if (!passes)
        return CZ_OK;
    trial->n_verified++;
    return take_verified(trial, is_verified, error);
}

/* Tries the designs of the list in order. */
static CzStatus try_list(Trial *trial, bool *is_verified, CzError *error) {
    for (int i = 0; i < trial->n_listed && !*is_verified && trial->n_verified < MAX_VERIFIED &&
                    trial->n_tried < MAX_TRIED;
         i++) {
        const Candidate *candidate = &trial->list[i];
        cz_subspace_expand(candidate->subspace,
                           cz_search_x(&candidate->subspace->search, candidate->record), trial->x);
        if (is_refused(trial, trial->x))
            continue;
        trial->objective = record_of(candidate)->objective;
        CZ_TRY(try_design(trial, is_verified, error));
        if (*is_verified)
            trial->combinations->chosen =
                (int)(candidate->subspace - trial->combinations->subspace);
    }
    return CZ_OK;
}

/* Searches with the evaluations that are left, from the best design that is not refused. */
static CzStatus search_on(Trial *trial, CzError *error) {
    CzCombinations *combinations = trial->combinations;
    const long left = trial->options->evaluations - cz_combinations_n_record(combinations);
    if (left < CZ_FEWEST_EVALUATIONS || cz_evaluator_is_fit(trial->evaluator))
        return CZ_OK;
    for (int i = 0; i < trial->n_listed; i++) {
        const Candidate *candidate = &trial->list[i];
        cz_subspace_expand(candidate->subspace,
                           cz_search_x(&candidate->subspace->search, candidate->record), trial->x);
        if (!is_refused(trial, trial->x))
            break;
    }
    if (trial->n_listed == 0 || is_refused(trial, trial->x))
        memcpy(trial->x, trial->outcome->best, (size_t)trial->outcome->n_variable * sizeof(double));
    cz_evaluator_set_stop(trial->evaluator, trial->options->stop);
    const CzStatus status = cz_combinations_go_on(combinations, trial->x, left, &trial->required,
                                                  trial->options, error);
    cz_evaluator_set_stop(trial->evaluator, NULL);
    return status == CZ_OK ? list_candidates(trial, error) : status;
}

static CzStatus find(Trial *trial, CzError *error) {
    CzOutcome *outcome = trial->outcome;
    const size_t room = MAX_TRIED + 1, m = (size_t)cz_evaluator_n_constraint(trial->evaluator);
    CzArena *arena = &trial->required.arena;
    trial->x = cz_arena_numbers(arena, (size_t)outcome->n_variable);
    trial->required.margin = cz_arena_numbers(arena, m);
    trial->required.x = cz_arena_allocate(arena, room, sizeof *trial->required.x);
    outcome->rejected = cz_outcome_rejected(outcome, room);
    if (arena->out_of_memory || outcome->rejected == NULL)
        return cz_no_memory(error, "the outcome");
    bool is_verified = false;
    trial->on_grid = cz_is_on_increments(trial->evaluator, outcome->best);
    CZ_TRY(refuse(trial, outcome->best, outcome->best_evaluation.objective, outcome->verification,
                  error));
    CZ_TRY(list_candidates(trial, error));
    CZ_TRY(search_on(trial, error));
    CZ_TRY(try_list(trial, &is_verified, error));
    if (is_verified || !trial->on_grid)
        return CZ_OK;
    trial->on_grid = false; /* as where designs pass only between the increments */
    CZ_TRY(list_candidates(trial, error));
    return try_list(trial, &is_verified, error);
}

CzStatus cz_verified_find(CzEvaluator *evaluator, CzCombinations *combinations,
                          const CzOptimiseOptions *options, CzOutcome *outcome, CzError *error) {
    if (outcome->status != CZ_OUTCOME_UNVERIFIED)
        return CZ_OK;
    Trial trial = {.evaluator = evaluator,
                   .combinations = combinations,
                   .options = options,
                   .outcome = outcome};
    const int chosen = combinations->chosen;
    const CzStatus status = find(&trial, error);
    combinations->replay.required = NULL;
    if (outcome->status != CZ_OUTCOME_FEASIBLE)
        combinations->chosen = chosen;
    free(trial.list);
    cz_arena_free(&trial.required.arena);
    if (status != CZ_STATUS_INTERRUPTED)
        return status;
    outcome->status = CZ_OUTCOME_INTERRUPTED;
    return CZ_OK;
}
