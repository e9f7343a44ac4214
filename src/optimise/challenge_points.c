/* Points of a challenge: scaled values to changed scenarios to margins. */
#include "optimise/challenge.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "evaluate/compose.h"
#include "evaluate/tasks.h"

/* ---- values ---------------------------------------------------------------------------------- */

double cz_challenge_value_at(const CzDraw *draw, double u) {
    const double at = u >= 1 ? draw->high : draw->low + u * (draw->high - draw->low);
    double nearest = at;
    for (int i = 0; i < draw->n_value; i++)
        if (i == 0 || fabs(draw->value[i] - at) < fabs(nearest - at))
            nearest = draw->value[i];
    return nearest;
}

static void set_values(CzChallenge *challenge, int point) {
    const long first = (long)point * challenge->n_draw;
    for (int d = 0; d < challenge->n_draw; d++)
        challenge->value[first + d] =
            cz_challenge_value_at(&challenge->draw[d], challenge->parts->u[first + d]);
}

int cz_challenge_n_change(const CzChallenge *challenge) {
    return cz_cases_n_change(&challenge->parts->cases);
}

void cz_challenge_changes(const CzChallenge *challenge, int point, CzCaseChange *change) {
    cz_case_changes(&challenge->parts->cases, challenge->value + (long)point * challenge->n_draw,
                    change);
}

/* ---- judging --------------------------------------------------------------------------------- */

static void add_result(const CzCheckResult *added, int check, CzCheckResult *result,
                       CzJudgedCase *judged) {
    const bool is_known = added->verdict != CZ_VERDICT_NOT_CHECKED && !isnan(added->value);
    result[check] = *added;
    judged->n_fail += added->verdict == CZ_VERDICT_FAIL;
    if (is_known && (judged->check < 0 || cz_check_is_worse(added, &result[judged->check])))
        judged->check = check;
}

/* Adds the results of one scenario of a case. */
static void add_scenario(const CzChallenge *challenge, const char *name,
                         const CzEvaluation *evaluation, int scenario, CzCheckResult *result,
                         CzJudgedCase *judged) {
    for (int i = 0; i < evaluation->n_check; i++) {
        const int check =
            cz_case_check_of(&challenge->parts->checks, evaluation, i, scenario, name);
        if (check >= 0)
            add_result(&evaluation->check[i], check, result, judged);
    }
}

/* Verdict over the checks that the case has. */
static CzVerdict verdict_of(const CzChallenge *challenge, const CzCheckResult *result,
                            const CzJudgedCase *judged) {
    CzVerdict verdict = CZ_VERDICT_PASS;
    int n = 0;
    for (int i = 0; i < challenge->n_check; i++) {
        if (result[i].name == NULL)
            continue;
        n++;
        if (result[i].verdict == CZ_VERDICT_NOT_CHECKED ||
            (result[i].verdict == CZ_VERDICT_PROVISIONAL && verdict == CZ_VERDICT_PASS))
            verdict = result[i].verdict;
    }
    return judged->state != CZ_SAMPLE_DONE || judged->n_fail > 0 || judged->beyond_validity
               ? CZ_VERDICT_FAIL
           : n == 0 ? CZ_VERDICT_NOT_CHECKED
                    : verdict;
}

CzStatus cz_challenge_judge(const CzChallenge *challenge, const CzCaseBench *bench,
                            const CzEvaluation *evaluation, int k, CzCheckResult *result,
                            CzJudgedCase *judged, CzError *error) {
    const CzCases *cases = &challenge->parts->cases;
    const int first = cz_problem_n_scenario(challenge->problem) + k * cases->n_scenario;
    *judged = (CzJudgedCase){.state = CZ_SAMPLE_DONE, .check = -1};
    for (int i = 0; i < challenge->n_check; i++)
        result[i] = (CzCheckResult){.value = NAN, .margin = NAN, .verdict = CZ_VERDICT_NOT_CHECKED};
    for (int j = 0; j < cases->n_scenario; j++) {
        const CzRunSummary *run = cz_run_summary(evaluation->run[k * cases->n_scenario + j]);
        judged->beyond_validity |= run->beyond_validity;
        add_scenario(challenge, bench->evaluator->scene[first + j].name, evaluation, j, result,
                     judged);
        if (cz_failure_of(run) == NULL || judged->message != NULL)
            continue;
        judged->state = CZ_SAMPLE_RUN_FAILED;
        judged->message = cz_case_failure(
            run, cz_problem_scenario_name(challenge->problem, challenge->scenario[j]));
        if (judged->message == NULL)
            return cz_no_memory(error, "the results of a point");
    }
    judged->verdict = verdict_of(challenge, result, judged);
    return CZ_OK;
}

/* ---- runs ------------------------------------------------------------------------------------ */

/* Stores the results of a point. A check with a margin at the design without changes, but none in a
 * run beyond validity, is below all others there. */
static void keep(CzChallenge *challenge, int at, const CzCheckResult *result,
                 const CzJudgedCase *judged) {
    CzChallengePoint *point = &challenge->point[at];
    point->state = judged->state;
    point->verdict = judged->verdict;
    point->check = judged->check;
    point->margin = judged->check >= 0 ? result[judged->check].margin : NAN;
    point->message = judged->message;
    for (int i = 0; i < challenge->n_check; i++) {
        const bool is_lost = judged->beyond_validity && isnan(result[i].margin) &&
                             !isnan(challenge->check[i].nominal);
        challenge->margin[(long)at * challenge->n_check + i] =
            is_lost ? -INFINITY : result[i].margin;
        challenge->verdict[(long)at * challenge->n_check + i] = result[i].verdict;
    }
}

/* Stores margins that stand for a yes or no. */
static void keep_flags(CzChallenge *challenge, int at, const CzCaseBench *bench,
                       const CzEvaluation *evaluation, int k, const CzCheckResult *result) {
    const int n_scenario = challenge->parts->cases.n_scenario;
    for (int i = 0; i < challenge->n_check; i++) {
        const int run = k * n_scenario + challenge->parts->checks.check[i].scenario;
        if (challenge->check[i].is_flag)
            challenge->margin[(long)at * challenge->n_check + i] = cz_challenge_flag_margin(
                challenge, bench, cz_problem_n_scenario(challenge->problem) + run,
                cz_run_summary(evaluation->run[run]), result, i);
    }
}

/* Stores a point whose values the reader refuses. */
static CzStatus keep_refused(CzChallenge *challenge, int at, const CzError *mistake,
                             CzError *error) {
    CzChallengePoint *point = &challenge->point[at];
    point->state = CZ_SAMPLE_INVALID;
    point->verdict = CZ_VERDICT_FAIL;
    point->message = malloc(sizeof mistake->message);
    if (point->message == NULL)
        return cz_no_memory(error, "the results of a point");
    snprintf(point->message, sizeof mistake->message, "%s", mistake->message);
    return CZ_OK;
}

static CzStatus run_bench(CzChallenge *challenge, const CzCaseBench *bench, int first, int n,
                          CzError *error) {
    const CzManner manner = {.step_factor = 1,
                             .integrator = CZ_INTEGRATOR_ZHAI,
                             .track = CZ_TRACK_USE_SEARCH,
                             .brief = true};
    CzEvaluation evaluation = {0};
    CzCheckResult *result = malloc(((size_t)challenge->n_check + 1) * sizeof *result);
    if (result == NULL)
        return cz_no_memory(error, "the results of a point");
    cz_evaluator_set_stop(bench->evaluator, challenge->parts->options.stop);
    CzStatus status =
        cz_evaluator_repeat(bench->evaluator, 1, &manner, challenge->parts->x, &evaluation, error);
    for (int k = 0; k < n && status == CZ_OK; k++) {
        CzJudgedCase judged;
        status = cz_challenge_judge(challenge, bench, &evaluation, k, result, &judged, error);
        keep(challenge, first + k, result, &judged);
        if (status == CZ_OK)
            keep_flags(challenge, first + k, bench, &evaluation, k, result);
    }
    cz_evaluation_free(&evaluation);
    free(result);
    return status;
}

/* One thread at a time reports. */
void cz_challenge_report(CzChallenge *challenge, int n) {
    CzChallengeParts *parts = challenge->parts;
    const int n_done = atomic_fetch_add(&parts->n_done, n) + n;
    if (parts->options.progress == NULL || atomic_flag_test_and_set(&parts->is_reporting))
        return;
    parts->options.progress(n_done, parts->options.n_run, parts->options.progress_data);
    atomic_flag_clear(&parts->is_reporting);
}

bool cz_challenge_is_stopped(const CzChallenge *challenge) {
    const volatile sig_atomic_t *stop = challenge->parts->options.stop;
    return stop != NULL && *stop != 0;
}

/* Where the reader refuses one of several points, each of them is read by itself. */
CzStatus cz_challenge_run(CzChallenge *challenge, int first, int n, CzError *error) {
    CzCaseBench bench;
    CzError mistake = {0};
    int number[CZ_POINTS_PER_TASK];
    if (cz_challenge_is_stopped(challenge)) /* no models are built for points that will not run */
        return CZ_STATUS_INTERRUPTED;
    for (int k = 0; k < n; k++) {
        number[k] = first + k;
        set_values(challenge, first + k);
    }
    CzStatus status = cz_case_bench_build(&challenge->parts->cases, n, number, challenge->value,
                                          &bench, &mistake);
    if (status == CZ_OK) {
        status = run_bench(challenge, &bench, first, n, error);
    } else if (status == CZ_STATUS_INPUT && n == 1) {
        status = keep_refused(challenge, first, &mistake, error);
    } else if (status == CZ_STATUS_INPUT) {
        status = CZ_OK;
        for (int k = 0; k < n && status == CZ_OK; k++)
            status = cz_challenge_run(challenge, first + k, 1, error);
        n = 0; /* reported already */
    } else if (error != NULL) {
        *error = mistake;
    }
    cz_case_bench_free(&bench);
    if (status == CZ_OK && n > 0)
        cz_challenge_report(challenge, n);
    return status;
}

static CzStatus run_task(int index, void *data, CzError *error) {
    const CzPointBatch *batch = data;
    int n;
    const int first = cz_points_of(batch, index, &n);
    return cz_challenge_run(batch->challenge, first, n, error);
}

CzStatus cz_challenge_run_batch(CzChallenge *challenge, int first, int n, CzError *error) {
    CzPointBatch batch = {.challenge = challenge, .first = first, .n = n};
    const CzTaskData plain = cz_points_as_data(challenge);
    return cz_tasks_share(&plain, (n + CZ_POINTS_PER_TASK - 1) / CZ_POINTS_PER_TASK, run_task,
                          &batch, error);
}
