/* Challenges a design. */
#include "optimise/challenge.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/clock.h"
#include "base/error.h"
#include "evaluate/draws.h"
#include "evaluate/tasks.h"

CzChallengeOptions cz_challenge_options_default(void) {
    return (CzChallengeOptions){.n_run = 500, .seed = -1, .most_weak = 10};
}

/* ---- memory ---------------------------------------------------------------------------------- */

void cz_challenge_drop(CzChallenge *challenge, int point) {
    free(challenge->point[point].message);
    challenge->point[point] = (CzChallengePoint){.state = CZ_SAMPLE_NOT_RUN,
                                                 .verdict = CZ_VERDICT_NOT_CHECKED,
                                                 .margin = NAN,
                                                 .check = -1,
                                                 .phase = ""};
    for (int i = 0; i < challenge->n_check; i++) {
        challenge->margin[(long)point * challenge->n_check + i] = NAN;
        challenge->verdict[(long)point * challenge->n_check + i] = CZ_VERDICT_NOT_CHECKED;
    }
}

void cz_challenge_move(CzChallenge *challenge, int from, int to) {
    const long n = challenge->n_draw, n_check = challenge->n_check;
    if (from == to)
        return;
    cz_challenge_drop(challenge, to);
    challenge->point[to] = challenge->point[from];
    memcpy(challenge->parts->u + to * n, challenge->parts->u + from * n,
           (size_t)n * sizeof(double));
    memcpy(challenge->value + to * n, challenge->value + from * n, (size_t)n * sizeof(double));
    memcpy(challenge->margin + to * n_check, challenge->margin + from * n_check,
           (size_t)n_check * sizeof(double));
    memcpy(challenge->verdict + to * n_check, challenge->verdict + from * n_check,
           (size_t)n_check * sizeof *challenge->verdict);
    challenge->point[from].message = NULL;
    cz_challenge_drop(challenge, from);
}

static CzStatus make_room(CzChallenge *challenge, CzError *error) {
    CzChallengeParts *parts = challenge->parts;
    const size_t n = (size_t)challenge->most_points, n_draw = (size_t)challenge->n_draw;
    challenge->point = calloc(n, sizeof *challenge->point);
    challenge->value = calloc(n * n_draw, sizeof *challenge->value);
    challenge->margin = calloc(n * (size_t)challenge->n_check + 1, sizeof *challenge->margin);
    challenge->verdict = calloc(n * (size_t)challenge->n_check + 1, sizeof *challenge->verdict);
    parts->u = cz_arena_numbers(&parts->arena, n * n_draw);
    if (challenge->verdict == NULL || challenge->point == NULL || challenge->value == NULL ||
        challenge->margin == NULL || parts->u == NULL)
        return cz_no_memory(error, "the points of a challenge");
    for (int i = 0; i < challenge->most_points; i++)
        cz_challenge_drop(challenge, i);
    return CZ_OK;
}

/* ---- before the first run -------------------------------------------------------------------- */

/* The envelope as draws, then the scatter. */
static CzStatus list_draws(CzChallenge *challenge, CzError *error) {
    const CzUncertainty *uncertainty = &cz_problem_input(challenge->problem)->uncertainty;
    CzArena *arena = &challenge->parts->arena;
    CzDraw *scatter = NULL, *draw;
    int n_scatter = 0;
    if (!uncertainty->given || uncertainty->n_envelope + uncertainty->n_parameters == 0)
        return cz_fail(error, CZ_STATUS_INPUT,
                       "the problem has neither an envelope nor scatter" CZ_HELP
                       "write 'uncertainty:' with 'envelope:' or 'parameters:'");
    CZ_TRY(cz_draws_list(challenge->problem, challenge->scenario[0], arena, &n_scatter, &scatter,
                         error));
    challenge->n_span = uncertainty->n_envelope;
    challenge->n_draw = challenge->n_span + n_scatter;
    draw = cz_arena_allocate(arena, (size_t)challenge->n_draw, sizeof *draw);
    if (draw == NULL)
        return cz_no_memory(error, "the numbers of a challenge");
    for (int i = 0; i < challenge->n_span; i++) {
        CzSpan *span = &uncertainty->envelope[i];
        CZ_TRY(cz_draw_of_span(challenge->problem, challenge->scenario[0], span, &draw[i], error));
    }
    if (n_scatter > 0)
        memcpy(draw + challenge->n_span, scatter, (size_t)n_scatter * sizeof *draw);
    challenge->draw = draw;
    return CZ_OK;
}

/* Adds the checks at a point whose values are given; values that the reader refuses add none. */
static CzStatus add_checks(CzChallenge *challenge, const double *value, CzError *error) {
    CzChallengeParts *parts = challenge->parts;
    CzCaseBench bench;
    const int first = 0;
    CzStatus status = cz_case_bench_build(&parts->cases, 1, &first, value, &bench, error);
    if (status == CZ_OK)
        status = cz_case_checks_add(&parts->cases, &bench, &parts->arena, &parts->checks, error);
    cz_case_bench_free(&bench);
    return status == CZ_STATUS_INPUT ? CZ_OK : status;
}

/* Lists the checks: of the design without changes, and with each number at either end, because a
 * speed may change the rules of a scenario. */
static CzStatus list_checks(CzChallenge *challenge, const CzCaseBench *unchanged, CzError *error) {
    CzChallengeParts *parts = challenge->parts;
    double *value = cz_arena_numbers(&parts->arena, (size_t)challenge->n_draw);
    if (value == NULL)
        return cz_no_memory(error, "the checks of a challenge");
    CZ_TRY(cz_case_checks_add(&parts->cases, unchanged, &parts->arena, &parts->checks, error));
    for (int end = 0; end < 2 * challenge->n_draw; end++) {
        for (int d = 0; d < challenge->n_draw; d++)
            value[d] = cz_challenge_value_at(&challenge->draw[d], d != end / 2 ? 0.5 : end % 2);
        CZ_TRY(add_checks(challenge, value, error));
    }
    challenge->n_check = parts->checks.n;
    return CZ_OK;
}

/* The listed checks without results. */
static CzStatus begin_checks(CzChallenge *challenge, CzError *error) {
    CzChallengeParts *parts = challenge->parts;
    const size_t n = (size_t)challenge->n_check;
    challenge->check = cz_arena_allocate(&parts->arena, n + 1, sizeof *challenge->check);
    if (challenge->check == NULL)
        return cz_no_memory(error, "the checks of a challenge");
    for (int i = 0; i < challenge->n_check; i++) {
        const CzCaseCheck *check = &parts->checks.check[i];
        const int scenario = challenge->scenario[check->scenario];
        challenge->check[i] =
            (CzChallengedCheck){.name = check->name,
                                .scenario = cz_problem_scenario_name(challenge->problem, scenario),
                                .is_flag = check->is_flag,
                                .nominal = NAN,
                                .least = NAN,
                                .worst = -1};
    }
    return CZ_OK;
}

/* Runs the design without changes, for the margins that the checks have there. */
static CzStatus run_nominal(CzChallenge *challenge, const CzCaseBench *bench, CzError *error) {
    CzChallengeParts *parts = challenge->parts;
    CzCheckResult *result =
        cz_arena_allocate(&parts->arena, (size_t)challenge->n_check + 1, sizeof *result);
    if (result == NULL)
        return cz_no_memory(error, "the checks of a challenge");
    CzEvaluation evaluation = {0};
    CzJudgedCase judged = {0};
    cz_evaluator_set_stop(bench->evaluator, parts->options.stop);
    CzStatus status = cz_evaluator_repeat(bench->evaluator, 1, &bench->evaluator->manner, parts->x,
                                          &evaluation, error);
    if (status == CZ_OK)
        status = cz_challenge_judge(challenge, bench, &evaluation, 0, result, &judged, error);
    free(judged.message);
    for (int i = 0; status == CZ_OK && i < challenge->n_check; i++)
        challenge->check[i].nominal = result[i].margin;
    cz_evaluation_free(&evaluation);
    return status;
}

CzStatus cz_challenge_unchanged(CzChallenge *challenge, CzCaseBench *bench, CzError *error) {
    const CzProblem *problem = challenge->problem;
    const CzUncertainty *uncertainty = &cz_problem_input(problem)->uncertainty;
    CzChallengeParts *parts = challenge->parts;
    const CzTexts *names =
        uncertainty->challenged.n_text > 0 ? &uncertainty->challenged : &uncertainty->scenarios;
    *bench = (CzCaseBench){0};
    CZ_TRY(cz_cases_scenarios(problem, names, &parts->arena, &challenge->n_scenario,
                              &challenge->scenario, error));
    CZ_TRY(list_draws(challenge, error));
    challenge->seed = parts->options.seed >= 0 ? parts->options.seed : uncertainty->seed;
    challenge->most_points = parts->options.n_run;
    parts->cases = (CzCases){.problem = problem,
                             .n_scenario = challenge->n_scenario,
                             .scenario = challenge->scenario,
                             .n_draw = challenge->n_draw,
                             .draw = challenge->draw,
                             .word = "challenge",
                             .n_earlier = cz_cases_n_earlier(problem, "challenge")};
    const int unchanged = CZ_UNCHANGED_CASE;
    return cz_case_bench_build(&parts->cases, 1, &unchanged, NULL, bench, error);
}

CzStatus cz_challenge_begin(CzChallenge *challenge, const CzCaseBench *unchanged, CzError *error) {
    CZ_TRY(list_checks(challenge, unchanged, error));
    CZ_TRY(begin_checks(challenge, error));
    return make_room(challenge, error);
}

static CzStatus begin(CzChallenge *challenge, CzError *error) {
    CzCaseBench bench;
    CzStatus status = cz_challenge_unchanged(challenge, &bench, error);
    if (status == CZ_OK)
        status = cz_challenge_begin(challenge, &bench, error);
    if (status == CZ_OK)
        status = run_nominal(challenge, &bench, error);
    cz_case_bench_free(&bench);
    return status;
}

/* ---- the challenge --------------------------------------------------------------------------- */

/* Smallest margins of the checks over all points. */
static void count(CzChallenge *challenge) {
    for (int i = 0; i < challenge->n_point; i++) {
        challenge->n_fail += challenge->point[i].verdict == CZ_VERDICT_FAIL;
        challenge->n_failed += challenge->point[i].state != CZ_SAMPLE_DONE;
    }
    for (int c = 0; c < challenge->n_check; c++)
        for (int i = 0; i < challenge->n_point; i++) {
            CzChallengedCheck *check = &challenge->check[c];
            const double margin = cz_challenge_margin(challenge, i, c);
            if (margin < check->least || (isnan(check->least) && !isnan(margin))) {
                check->least = margin;
                check->worst = i;
            }
            check->n_fail +=
                challenge->verdict[(long)i * challenge->n_check + c] == CZ_VERDICT_FAIL;
        }
}

static CzStatus challenge_design(CzChallenge *challenge, CzError *error) {
    CzStatus status = begin(challenge, error);
    if (status == CZ_OK)
        status = cz_challenge_search(challenge, error);
    if (status == CZ_STATUS_INTERRUPTED)
        challenge->is_interrupted = true;
    else
        CZ_TRY(status);
    count(challenge);
    CZ_TRY(cz_challenge_find_weak(challenge, error));
    challenge->judgement = challenge->is_broken ? CZ_VERDICT_FAIL
                           : challenge->is_interrupted || challenge->n_weak == 0
                               ? CZ_VERDICT_NOT_CHECKED
                               : challenge->weak[0].verdict;
    return CZ_OK;
}

CzChallenge *cz_challenge_create(const CzProblem *problem, const CzChallengeOptions *options) {
    CzChallenge *made = calloc(1, sizeof *made);
    CzChallengeParts *parts = calloc(1, sizeof *parts);
    if (made == NULL || parts == NULL) {
        free(made);
        free(parts);
        return NULL;
    }
    made->problem = problem;
    made->parts = parts;
    parts->options = *options;
    atomic_flag_clear(&parts->is_reporting);
    return made;
}

CzStatus cz_challenge(const CzProblem *problem, const double *x, const CzChallengeOptions *options,
                      CzChallenge **challenge, CzError *error) {
    const double started = cz_clock();
    const CzChallengeOptions given = options != NULL ? *options : cz_challenge_options_default();
    CzChallenge *made = cz_challenge_create(problem, &given);
    *challenge = NULL;
    if (made == NULL)
        return cz_no_memory(error, "a challenge");
    made->parts->x = x;
    made->parts->study = cz_challenge_study(made, cz_executor_choose(given.executor, given.n_job));
    const CzStatus status = challenge_design(made, error);
    cz_study_end(&made->parts->study);
    made->wall_s = cz_clock() - started;
    if (status == CZ_OK)
        *challenge = made;
    else
        cz_challenge_free(made);
    return status;
}

void cz_challenge_free(CzChallenge *challenge) {
    if (challenge == NULL)
        return;
    for (int i = 0; challenge->point != NULL && i < challenge->most_points; i++)
        free(challenge->point[i].message);
    for (int i = 0; i < challenge->n_weak; i++)
        free(challenge->weak[i].message);
    cz_arena_free(&challenge->parts->arena);
    free(challenge->point);
    free(challenge->value);
    free(challenge->margin);
    free(challenge->verdict);
    free(challenge->weak);
    free(challenge->parts);
    free(challenge);
}
