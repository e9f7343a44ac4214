/* Searches round by round, each with the samples and weak points that broke the design before. */
#include "crushzone/robust.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/clock.h"
#include "base/error.h"
#include "evaluate/evaluator.h"
#include "evaluate/sampling.h"
#include "optimise/combinations.h"
#include "optimise/outcome.h"
#include "optimise/robust_cases.h"
#include "optimise/robust_judge.h"
#include "optimise/verified.h"

enum {
    MAX_ROUNDS = 24,
    MIN_EVALUATIONS = 12, /* of a round (ours) */
    MAX_IDLE = 3          /* rounds without progress at the end (ours) */
};

/* What designs are ranked by. */
enum { NOMINAL, SAMPLES, RUNS, VIOLATION, OBJECTIVE, N_KEY };

/* The search, while it runs. */
typedef struct Robust {
    const CzProblem *problem;
    const CzEvaluatorOptions *evaluator_options;
    CzOptimiseOptions options; /* settled */
    CzEvaluator *plain;        /* of the problem as written */
    int n_variable;
    long n_trial;
    CzTrial *trial;    /* of all rounds (n_trial) */
    double *trial_x;   /* (n_trial x n_variable) */
    double *x, *best;  /* design of the round, best of all rounds (n_variable) */
    double key[N_KEY]; /* rank of the best design */
    long n_answered;   /* answers of the journal that were used */
    double seen; /* smallest margin that the last search saw; 0 when it minimises something else */
    bool has_improved; /* the last round found the best design */
    int n_idle; /* rounds without a new scenario and without a better design, up to the last */
    CzRobust *result;
} Robust;

bool cz_robust_is_asked(const CzProblem *problem) {
    const CzInput *input = cz_problem_input(problem);
    const CzUncertainty *uncertainty = &input->uncertainty;
    return input->optimise.given && input->optimise.n_variables > 0 &&
           input->optimise.n_match == 0 && uncertainty->given &&
           uncertainty->n_parameters + uncertainty->n_envelope > 0;
}

static bool is_stopped(const Robust *robust) {
    return robust->options.stop != NULL && *robust->options.stop != 0;
}

/* ---- progress -------------------------------------------------------------------------------- */

/* Passes the progress of a round on as that of the whole search. */
static void show_search(const CzProgress *progress, void *data) {
    const Robust *robust = data;
    CzProgress whole = *progress;
    whole.n_evaluation += robust->n_trial;
    whole.most_evaluations = robust->options.evaluations;
    robust->options.progress(&whole, robust->options.progress_data);
}

/* Shows that samples or the adversary run. */
static void show_phase(const char *phase, void *data) {
    const Robust *robust = data;
    const CzProgress progress = {.n_evaluation = robust->n_trial,
                                 .most_evaluations = robust->options.evaluations,
                                 .feasible =
                                     robust->result->sampling != NULL && robust->key[NOMINAL] <= 0,
                                 .best_objective = robust->key[OBJECTIVE],
                                 .best_violation = robust->key[NOMINAL],
                                 .phase = phase};
    if (robust->options.progress != NULL)
        robust->options.progress(&progress, robust->options.progress_data);
}

/* ---- the search of a round ------------------------------------------------------------------- */

/* The problem with all cases, and its evaluator, in the result. */
static CzStatus build(Robust *robust, CzError *error) {
    CzRobust *result = robust->result;
    cz_evaluator_free(result->evaluator);
    cz_problem_free(result->problem);
    result->evaluator = NULL;
    result->problem = NULL;
    CZ_TRY(cz_problem_read_cases(robust->problem, result->added->n, result->added->list,
                                 &result->problem, error));
    CZ_TRY(
        cz_evaluator_build(result->problem, robust->evaluator_options, &result->evaluator, error));
    const char *fixed = cz_evaluator_fixed_by_change(result->evaluator);
    return fixed == NULL
               ? CZ_OK
               : cz_fail(error, CZ_STATUS_INPUT,
                         "the scatter of '%s' replaces the value of a design variable: give "
                         "it a tolerance instead of a range or values",
                         fixed);
}

/* Appends the history of a round. */
static CzStatus keep_history(Robust *robust, const CzCombinations *combinations, CzError *error) {
    const long n = robust->n_trial + cz_combinations_n_record(combinations);
    const size_t size = (size_t)robust->n_variable * sizeof(double);
    CzTrial *trial = realloc(robust->trial, ((size_t)n + 1) * sizeof *trial);
    robust->trial = trial != NULL ? trial : robust->trial;
    double *x = realloc(robust->trial_x, ((size_t)n + 1) * size);
    robust->trial_x = x != NULL ? x : robust->trial_x;
    if (trial == NULL || x == NULL)
        return cz_no_memory(error, "the history");
    cz_combinations_history(combinations, robust->n_variable, trial + robust->n_trial,
                            x + robust->n_trial * robust->n_variable);
    robust->n_trial = n;
    return CZ_OK;
}

/* Evaluations of the next round: a third of all for the first, then an eighth, and half of what is
 * left after a round without progress (ours). */
static long evaluations_of(const Robust *robust) {
    const long all = robust->options.evaluations, left = all - robust->n_trial;
    const bool is_first = robust->n_trial == 0;
    const long share = is_first ? all / 3 : robust->n_idle > 0 ? left / 2 : all / 8;
    const long wanted = share > MIN_EVALUATIONS ? share : MIN_EVALUATIONS;
    return wanted < left ? wanted : left;
}

/* Searches with all cases, from the best design; the result is in robust->x. */
static CzStatus search(Robust *robust, CzRobustRound *round, CzError *error) {
    CzEvaluator *evaluator = robust->result->evaluator;
    CzOptimiseOptions options = robust->options;
    CzCombinations combinations;
    CzJournal journal;
    if (options.journal != NULL) {
        journal = cz_journal_remaining(options.journal, robust->n_answered);
        journal.n_earlier = robust->n_trial == 0 ? journal.n_earlier : 0;
        options.journal = &journal;
    }
    options.evaluations = evaluations_of(robust);
    options.progress = options.progress != NULL ? show_search : NULL;
    options.progress_data = robust;
    options.start = robust->best;
    cz_evaluator_set_stop(evaluator, options.stop);
    CzStatus status = cz_combinations(evaluator, &options, &combinations, error);
    cz_evaluator_set_stop(evaluator, NULL);
    robust->n_answered += combinations.replay.next;
    if (status == CZ_OK) {
        const CzSubspace *chosen = &combinations.subspace[combinations.chosen];
        const long record = cz_combinations_record(&chosen->search);
        const long before = robust->n_trial;
        robust->seen = record >= 0 && cz_evaluator_maximises_margin(evaluator)
                           ? -chosen->search.record[record].objective
                           : 0;
        if (record >= 0)
            cz_subspace_expand(chosen, cz_search_x(&chosen->search, record), robust->x);
        else
            memcpy(robust->x, robust->best, (size_t)robust->n_variable * sizeof *robust->x);
        status = keep_history(robust, &combinations, error);
        round->n_evaluation = robust->n_trial - before;
    }
    cz_combinations_free(&combinations);
    return status;
}

/* ---- the judgement of a round ---------------------------------------------------------------- */

static CzRobustJudge judge_of(Robust *robust) {
    return (CzRobustJudge){.plain = robust->plain,
                           .evaluator_options = robust->evaluator_options,
                           .stop = robust->options.stop,
                           .show = show_phase,
                           .data = robust};
}

/* Ranks a design: the first difference decides, the smaller value is better. Nominal constraints
 * come first, then the samples that fail, the runs of the adversary that break it, the violation of
 * the samples' statistics, the objective. */
static void rank(const Robust *robust, const CzRobustRound *round, const CzRobustJudged *found,
                 double key[N_KEY]) {
    const CzEvaluation *nominal = &found->sampling->nominal;
    const CzChallenge *challenge = found->challenge;
    key[NOMINAL] = fmax(nominal->violation, 0);
    key[SAMPLES] =
        cz_robust_violation_in(found->sampling) > 0 ? round->n_sample - round->n_pass : 0;
    key[RUNS] = challenge != NULL && challenge->is_broken ? fmax(challenge->n_fail, 1) : 0;
    key[VIOLATION] = cz_robust_violation_in(found->sampling);
    key[OBJECTIVE] = nominal->objective;
    if (cz_evaluator_maximises_margin(robust->plain))
        key[OBJECTIVE] = -fmin(-nominal->objective, round->required_margin);
}

/* Makes the design of the last round the result; `found` gets the former one. */
static void take_judged(CzRobust *result, CzRobustJudged *found) {
    const CzRobustJudged former = {result->designed, result->sampling, result->challenge};
    result->designed = found->designed;
    result->sampling = found->sampling;
    result->challenge = found->challenge;
    *found = former;
    for (int i = 0; i < result->n_round; i++)
        result->round[i].is_best = i == result->n_round - 1;
}

/* Takes the design of a round as the best one when it is better. */
static void compare(Robust *robust, CzRobustJudged *found) {
    CzRobust *result = robust->result;
    const CzRobustRound *round = &result->round[result->n_round - 1];
    double key[N_KEY];
    rank(robust, round, found, key);
    int k = 0;
    while (k + 1 < N_KEY && key[k] == robust->key[k])
        k++;
    robust->has_improved = result->sampling == NULL || key[k] < robust->key[k];
    if (!robust->has_improved)
        return;
    take_judged(result, found);
    memcpy(robust->key, key, sizeof key);
    memcpy(robust->best, robust->x, (size_t)robust->n_variable * sizeof *robust->best);
}

/* Whether the best design holds in all samples, and the adversary did not break it. */
static bool holds(const Robust *robust) {
    return robust->key[NOMINAL] <= 0 && robust->key[SAMPLES] <= 0 && robust->key[RUNS] <= 0 &&
           robust->key[VIOLATION] <= 0;
}

/* Judges the design of the round and takes further scenarios from what breaks it; *n_new is their
 * number. */
static CzStatus judge(Robust *robust, CzRobustRound *round, CzRobustJudged *found, int *n_new,
                      CzError *error) {
    CzRobustCases *added = robust->result->added;
    const CzRobustJudge by = judge_of(robust);
    CZ_TRY(cz_robust_judge(&by, robust->x, found, error));
    const CzSampling *sampling = found->sampling;
    cz_robust_fill_round(round, found);
    const double limit = robust->seen > CZ_ROBUST_NEAR ? robust->seen - CZ_ROBUST_NEAR : 0;
    const bool is_held = cz_robust_violation_in(sampling) <= 0 && sampling->nominal.violation <= 0;
    if (!is_held || round->required_margin < limit)
        *n_new = cz_robust_add_samples(added, sampling, limit);
    if (found->challenge != NULL)
        *n_new += cz_robust_add_weak_points(added, found->challenge);
    if (added->arena.out_of_memory)
        return cz_no_memory(error, "further scenarios");
    if (!is_stopped(robust) || robust->result->sampling == NULL)
        compare(robust, found); /* a judgement that was cut short is no better one */
    return CZ_OK;
}

/* A further round. */
static CzStatus add_round(CzRobust *result, CzRobustRound **round, CzError *error) {
    CzRobustRound *rounds = realloc(result->round, (size_t)(result->n_round + 1) * sizeof *rounds);
    if (rounds == NULL)
        return cz_no_memory(error, "the rounds");
    result->round = rounds;
    *round = &rounds[result->n_round];
    **round = (CzRobustRound){.n_weak = -1, .n_scenario = cz_problem_n_scenario(result->problem)};
    return CZ_OK;
}

/* Begins a round with its scenarios; it is counted once it has a design. */
static CzStatus begin_round(Robust *robust, CzRobustRound **round, CzError *error) {
    CZ_TRY(build(robust, error));
    return add_round(robust->result, round, error);
}

/* Judges the design of a round. */
static CzStatus end_round(Robust *robust, CzRobustRound *round, int *n_new, CzError *error) {
    CzRobustJudged found = {0};
    robust->result->n_round++;
    const CzStatus status = judge(robust, round, &found, n_new, error);
    cz_robust_judged_free(&found);
    return status;
}

/* A start that passes in the scenarios of the file is judged first, as a round without a search, so
 * that no search ends worse than it began. */
static CzStatus judge_start(Robust *robust, CzError *error) {
    CzEvaluation evaluation;
    CzRobustRound *round = NULL;
    int n_new = 0;
    memcpy(robust->x, robust->best, (size_t)robust->n_variable * sizeof *robust->x);
    CZ_TRY(cz_evaluate(robust->plain, 1, robust->x, false, &evaluation, error));
    const bool passes = evaluation.status == CZ_OK && evaluation.violation <= 0;
    cz_evaluation_free(&evaluation);
    if (!passes)
        return CZ_OK;
    CZ_TRY(begin_round(robust, &round, error));
    return end_round(robust, round, &n_new, error);
}

static CzStatus run_round(Robust *robust, bool *goes_on, CzError *error) {
    CzRobustRound *round = NULL;
    int n_new = 0;
    CZ_TRY(begin_round(robust, &round, error));
    CZ_TRY(search(robust, round, error));
    *goes_on = false;
    if (is_stopped(robust) && robust->result->sampling != NULL)
        return CZ_OK; /* a result is there, and a judgement of this design would be cut short */
    CZ_TRY(end_round(robust, round, &n_new, error));
    const bool has_more = robust->options.evaluations - robust->n_trial >= MIN_EVALUATIONS &&
                          robust->result->n_round < MAX_ROUNDS;
    robust->n_idle = n_new > 0 || robust->has_improved ? 0 : robust->n_idle + 1;
    *goes_on = has_more && !(holds(robust) && n_new == 0) && robust->n_idle < MAX_IDLE &&
               !is_stopped(robust);
    robust->options.seed++; /* a further round begins with other points */
    return CZ_OK;
}

/* ---- the outcome ----------------------------------------------------------------------------- */

static void conclude(const Robust *robust, CzOutcome *outcome) {
    const CzRobust *result = robust->result;
    const bool has_envelope = cz_problem_input(robust->problem)->uncertainty.n_envelope > 0;
    const bool is_challenged = result->challenge != NULL && !result->challenge->is_interrupted;
    const char *why = "the design holds in all samples";
    outcome->status = CZ_OUTCOME_INFEASIBLE;
    if (is_stopped(robust)) {
        outcome->status = CZ_OUTCOME_INTERRUPTED;
        why = "interrupted";
    } else if (result->sampling->nominal.violation > 0 ||
               outcome->best_evaluation.status != CZ_OK) {
        why = "the best design fails in the scenarios of the file";
    } else if (cz_robust_violation_in(result->sampling) > 0) {
        why = "the best design fails in samples";
    } else if (!holds(robust)) {
        why = "the adversary breaks the best design";
    } else if (has_envelope && !is_challenged) {
        why = "the best design was not challenged";
    } else if (outcome->best_evaluation.violation > 0) {
        why = "the best design fails in a scenario that was added";
    } else {
        outcome->status = CZ_OUTCOME_FEASIBLE;
        if (has_envelope)
            why = "the design holds in all samples, and the adversary does not break it";
    }
    const long left = robust->options.evaluations - robust->n_trial;
    snprintf(outcome->why_stopped, sizeof outcome->why_stopped, "%s%s", why,
             outcome->status == CZ_OUTCOME_INFEASIBLE && left < MIN_EVALUATIONS
                 ? "; no evaluations are left"
                 : "");
}

/* The samples of the best design by whole runs, where they were brief. */
static CzStatus sample_best(Robust *robust, CzError *error) {
    CzRobust *result = robust->result;
    const CzRobustJudge by = judge_of(robust);
    CzSampling *whole = NULL;
    if (holds(robust) || is_stopped(robust))
        return CZ_OK;
    CZ_TRY(cz_robust_sample(&by, result->designed, false, &whole, error));
    cz_sampling_free(result->sampling);
    result->sampling = whole;
    return CZ_OK;
}

/* The next best design that is verified and holds, where the best one is not verified; it is the
 * result as a round without a search. */
static CzStatus find_verified(Robust *robust, CzOutcome *outcome, CzError *error) {
    CzRobust *result = robust->result;
    const CzRobustJudge by = judge_of(robust);
    CzRobustJudged judged = {0};
    CzRobustRound *round = NULL;
    CzStatus status =
        cz_robust_find_verified(&by, result->evaluator, &robust->options, outcome, &judged, error);
    if (status == CZ_STATUS_INTERRUPTED) {
        outcome->status = CZ_OUTCOME_INTERRUPTED;
        snprintf(outcome->why_stopped, sizeof outcome->why_stopped,
                 "interrupted during the verification");
    } else if (status == CZ_OK && judged.sampling != NULL) {
        status = add_round(result, &round, error);
    }
    if (round != NULL) {
        result->n_round++;
        cz_robust_fill_round(round, &judged);
        take_judged(result, &judged);
        memcpy(robust->best, outcome->best, (size_t)robust->n_variable * sizeof *robust->best);
    }
    cz_robust_judged_free(&judged);
    cz_outcome_note_rejected(outcome);
    return status == CZ_STATUS_INTERRUPTED ? CZ_OK : status;
}

static CzStatus fill_outcome(Robust *robust, CzError *error) {
    CzRobust *result = robust->result;
    const size_t n = (size_t)robust->n_variable, n_trial = (size_t)robust->n_trial;
    CZ_TRY(sample_best(robust, error));
    CZ_TRY(build(robust, error));
    CZ_TRY(cz_outcome_create(result->evaluator, robust->n_trial, &result->outcome, error));
    CzOutcome *outcome = result->outcome;
    memcpy(outcome->best, robust->best, n * sizeof *outcome->best);
    memcpy(outcome->trial, robust->trial, n_trial * sizeof *outcome->trial);
    memcpy(outcome->trial_x, robust->trial_x, n_trial * n * sizeof *outcome->trial_x);
    outcome->width = robust->options.width;
    cz_outcome_mark_bounds(result->evaluator, outcome);
    if (is_stopped(robust))
        CZ_TRY(cz_outcome_leave_out(result->evaluator, 0, NULL, error));
    CZ_TRY(cz_outcome_evaluate_start(result->evaluator, outcome, error));
    CZ_TRY(
        cz_evaluate(result->evaluator, 1, outcome->best, true, &outcome->best_evaluation, error));
    if (is_stopped(robust)) /* not all scenarios were run again */
        outcome->best_evaluation.violation =
            fmax(outcome->best_evaluation.violation, result->sampling->nominal.violation);
    conclude(robust, outcome);
    CZ_TRY(cz_outcome_verify(result->evaluator, &robust->options, outcome, error));
    CZ_TRY(find_verified(robust, outcome, error));
    CZ_TRY(cz_outcome_record_start(result->evaluator, outcome, error));
    CZ_TRY(cz_sensitivity_take(result->evaluator, robust->options.stop, outcome, error));
    CZ_TRY(cz_margins_order(result->evaluator, outcome, error));
    return cz_stationarity_find(result->evaluator, outcome, error);
}

static CzStatus run(Robust *robust, CzError *error) {
    bool goes_on = true;
    CZ_TRY(cz_evaluator_build(robust->problem, robust->evaluator_options, &robust->plain, error));
    CZ_TRY(cz_optimise_fill_defaults(robust->plain, &robust->options, error));
    robust->n_variable = cz_evaluator_n_variable(robust->plain);
    const size_t n = (size_t)robust->n_variable;
    robust->x = calloc(2 * n, sizeof *robust->x);
    if (robust->x == NULL)
        return cz_no_memory(error, "the designs");
    robust->best = robust->x + n;
    for (size_t i = 0; i < n; i++)
        robust->best[i] = robust->options.start != NULL
                              ? robust->options.start[i]
                              : cz_evaluator_variable(robust->plain, (int)i)->start;
    CZ_TRY(judge_start(robust, error));
    while (goes_on)
        CZ_TRY(run_round(robust, &goes_on, error));
    return fill_outcome(robust, error);
}

CzStatus cz_optimise_robust(const CzProblem *problem, const CzEvaluatorOptions *evaluator_options,
                            const CzOptimiseOptions *options, CzRobust **result, CzError *error) {
    const double began = cz_clock();
    Robust robust = {.problem = problem,
                     .evaluator_options = evaluator_options,
                     .options = options != NULL ? *options : cz_optimise_options_default()};
    *result = robust.result = calloc(1, sizeof **result);
    if (*result != NULL)
        (*result)->added = calloc(1, sizeof *(*result)->added);
    const CzStatus status = *result != NULL && (*result)->added != NULL
                                ? run(&robust, error)
                                : cz_no_memory(error, "a search");
    cz_evaluator_free(robust.plain);
    free(robust.trial);
    free(robust.trial_x);
    free(robust.x);
    if (status == CZ_OK) {
        (*result)->outcome->wall_s = cz_clock() - began;
        return CZ_OK;
    }
    cz_robust_free(*result);
    *result = NULL;
    return status;
}

void cz_robust_free(CzRobust *robust) {
    if (robust == NULL)
        return;
    cz_outcome_free(robust->outcome);
    cz_challenge_free(robust->challenge);
    cz_sampling_free(robust->sampling);
    cz_problem_free(robust->designed);
    cz_evaluator_free(robust->evaluator);
    cz_problem_free(robust->problem);
    if (robust->added != NULL)
        cz_arena_free(&robust->added->arena);
    free(robust->added);
    free(robust->round);
    free(robust);
}
