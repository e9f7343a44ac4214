/* A challenge in workers: its points, adversaries and full runs as plain data. */
#include "optimise/challenge.h"

#include <math.h>
#include <stdlib.h>

#include "base/error.h"
#include "problem/problem_bytes.h"

/* Kinds of tasks. */
enum { POINTS, ADVERSARY, FULL_RUN };

/* Whether a worker can run tasks: designs of a caller are not described. */
static bool begin_request(const CzChallenge *challenge, int kind, CzMemoryText *request) {
    cz_put_int(request, kind);
    return challenge->parts->x == NULL && !cz_challenge_is_stopped(challenge);
}

/* ---- points ---------------------------------------------------------------------------------- */

static void put_point(CzMemoryText *bytes, const CzChallenge *challenge, int point) {
    const size_t n = (size_t)challenge->n_draw, n_check = (size_t)challenge->n_check;
    const size_t at = (size_t)point;
    cz_put(bytes, &challenge->point[point], 1, sizeof *challenge->point);
    cz_put_text(bytes, challenge->point[point].message);
    cz_put_numbers(bytes, challenge->parts->u + at * n, n);
    cz_put_numbers(bytes, challenge->value + at * n, n);
    cz_put_numbers(bytes, challenge->margin + at * n_check, n_check);
    cz_put(bytes, challenge->verdict + at * n_check, n_check, sizeof *challenge->verdict);
}

/* The phase of a point remains. */
static void get_point(CzReading *reading, CzChallenge *challenge, int point, const char *phase) {
    const size_t n = (size_t)challenge->n_draw, n_check = (size_t)challenge->n_check;
    const size_t at = (size_t)point;
    CzChallengePoint *got = &challenge->point[point];
    free(got->message);
    cz_get(reading, got, 1, sizeof *got);
    got->phase = phase;
    got->message = cz_get_own_text(reading);
    cz_get_numbers(reading, challenge->parts->u + at * n, n);
    cz_get_numbers(reading, challenge->value + at * n, n);
    cz_get_numbers(reading, challenge->margin + at * n_check, n_check);
    cz_get(reading, challenge->verdict + at * n_check, n_check, sizeof *challenge->verdict);
}

/* Points that the reader refuses have a message about this process's file, which their owner
 * writes. */
static bool has_refused(const CzChallenge *challenge, int first, int n) {
    for (int i = first; i < first + n; i++)
        if (challenge->point[i].state == CZ_SAMPLE_INVALID)
            return true;
    return false;
}

static CzStatus put_results(CzMemoryText *answer, const CzChallenge *challenge, int first, int n,
                            CzError *error) {
    if (has_refused(challenge, first, n))
        return cz_fail(error, CZ_STATUS_INPUT, "the reader refuses a point");
    for (int i = first; i < first + n; i++)
        put_point(answer, challenge, i);
    return CZ_OK;
}

static CzStatus get_results(CzReading *answer, CzChallenge *challenge, int first, int n,
                            const char *phase, CzError *error) {
    for (int i = first; i < first + n; i++)
        get_point(answer, challenge, i, phase);
    cz_challenge_report(challenge, n);
    return answer->has_ended ? cz_no_memory(error, "the results of a point") : CZ_OK;
}

static bool request_points(int index, void *data, CzMemoryText *request) {
    const CzPointBatch *batch = data;
    int n;
    const int first = cz_points_of(batch, index, &n);
    const size_t n_draw = (size_t)batch->challenge->n_draw;
    const bool is_possible = begin_request(batch->challenge, POINTS, request);
    cz_put_int(request, first);
    cz_put_int(request, n);
    cz_put_numbers(request, batch->challenge->parts->u + (size_t)first * n_draw,
                   (size_t)n * n_draw);
    return is_possible;
}

static CzStatus take_points(int index, void *data, CzReading *answer, CzError *error) {
    const CzPointBatch *batch = data;
    int n;
    const int first = cz_points_of(batch, index, &n);
    return get_results(answer, batch->challenge, first, n, batch->challenge->point[first].phase,
                       error);
}

static CzStatus answer_points(CzChallenge *challenge, CzReading *request, CzMemoryText *answer,
                              CzError *error) {
    const size_t n_draw = (size_t)challenge->n_draw;
    const int first = cz_get_int(request), n = cz_get_int(request);
    if (first < 0 || n < 1 || n > CZ_POINTS_PER_TASK || first + n > challenge->most_points)
        return cz_no_memory(error, "a task");
    for (int i = first; i < first + n; i++)
        cz_challenge_drop(challenge, i);
    cz_get_numbers(request, challenge->parts->u + (size_t)first * n_draw, (size_t)n * n_draw);
    CZ_TRY(cz_challenge_run(challenge, first, n, error));
    return put_results(answer, challenge, first, n, error);
}

/* ---- adversaries ----------------------------------------------------------------------------- */

/* An adversary knows all points of earlier rounds. */
static bool request_adversary(int index, void *data, CzMemoryText *request) {
    const CzAdversary *adversary = &((const CzAdversary *)data)[index];
    const CzChallenge *challenge = adversary->challenge;
    const bool is_possible = begin_request(challenge, ADVERSARY, request);
    cz_put(request, adversary, 1, sizeof *adversary);
    cz_put_text(request, adversary->algorithm);
    cz_put_int(request, challenge->n_point);
    for (int i = 0; i < challenge->n_point; i++)
        put_point(request, challenge, i);
    return is_possible;
}

static CzStatus take_adversary(int index, void *data, CzReading *answer, CzError *error) {
    CzAdversary *adversary = &((CzAdversary *)data)[index];
    const int n = cz_get_int(answer);
    if (n < 0 || n > adversary->n)
        return cz_no_memory(error, "the results of an adversary");
    adversary->n_run = n;
    return get_results(answer, adversary->challenge, adversary->first, n, adversary->phase, error);
}

static CzStatus answer_adversary(CzChallenge *challenge, CzReading *request, CzMemoryText *answer,
                                 CzError *error) {
    CzAdversary own;
    CzArena arena = {0};
    cz_get(request, &own, 1, sizeof own);
    own.algorithm = cz_get_text(request, &arena);
    own.challenge = challenge;
    own.phase = "";
    challenge->n_point = cz_get_int(request);
    const bool is_whole = own.algorithm != NULL && challenge->n_point <= own.first &&
                          own.first + own.n <= challenge->most_points;
    CzStatus status = is_whole ? CZ_OK : cz_no_memory(error, "a task");
    for (int i = 0; is_whole && i < challenge->most_points; i++)
        cz_challenge_drop(challenge, i);
    for (int i = 0; is_whole && i < challenge->n_point; i++)
        get_point(request, challenge, i, "");
    if (is_whole)
        status = cz_adversary_run(&own, error);
    if (status == CZ_OK) {
        cz_put_int(answer, own.n_run);
        status = put_results(answer, challenge, own.first, own.n_run, error);
    }
    cz_arena_free(&arena);
    return status;
}

/* ---- full runs ------------------------------------------------------------------------------- */

static bool request_full_run(int index, void *data, CzMemoryText *request) {
    const CzFullRun *run = &((const CzFullRun *)data)[index];
    const CzChallenge *challenge = run->challenge;
    const size_t n_draw = (size_t)challenge->n_draw;
    cz_put_int(request, FULL_RUN); /* also after an interruption */
    cz_put_int(request, run->point);
    cz_put_numbers(request, challenge->value + (size_t)run->point * n_draw, n_draw);
    return challenge->parts->x == NULL;
}

/* Texts of a result, in this order. */
enum { N_TEXT = 9 };
static void list_texts(CzCheckResult *result, const char **text[N_TEXT]) {
    const char **const all[N_TEXT] = {&result->name,   &result->scenario, &result->family,
                                      &result->unit,   &result->why,      &result->profile,
                                      &result->clause, &result->source,   &result->confidence};
    for (int i = 0; i < N_TEXT; i++)
        text[i] = all[i];
}

static void put_result(CzMemoryText *bytes, const CzCheckResult *result) {
    CzCheckResult copy = *result;
    const char **text[N_TEXT];
    list_texts(&copy, text);
    cz_put(bytes, result, 1, sizeof *result);
    for (int i = 0; i < N_TEXT; i++)
        cz_put_text(bytes, *text[i]);
}

static void get_result(CzReading *reading, CzArena *arena, CzCheckResult *result) {
    const char **text[N_TEXT];
    cz_get(reading, result, 1, sizeof *result);
    list_texts(result, text);
    for (int i = 0; i < N_TEXT; i++)
        *text[i] = cz_get_text(reading, arena);
}

static CzStatus take_full_run(int index, void *data, CzReading *answer, CzError *error) {
    CzFullRun *run = &((CzFullRun *)data)[index];
    const int n_check = run->challenge->n_check;
    cz_get(answer, &run->judged, 1, sizeof run->judged);
    run->judged.message = cz_get_own_text(answer);
    run->result = malloc(((size_t)n_check + 1) * sizeof *run->result);
    for (int i = 0; run->result != NULL && i < n_check; i++)
        get_result(answer, &run->texts, &run->result[i]);
    return run->result == NULL || run->texts.out_of_memory || answer->has_ended
               ? cz_no_memory(error, "a weak point")
               : CZ_OK;
}

static CzStatus answer_full_run(CzChallenge *challenge, CzReading *request, CzMemoryText *answer,
                                CzError *error) {
    const size_t n_draw = (size_t)challenge->n_draw;
    CzFullRun run = {.challenge = challenge, .point = cz_get_int(request)};
    if (run.point < 0 || run.point >= challenge->most_points)
        return cz_no_memory(error, "a task");
    cz_get_numbers(request, challenge->value + (size_t)run.point * n_draw, n_draw);
    CzStatus status = cz_full_run(&run, error);
    if (status == CZ_OK && run.result == NULL)
        status = cz_fail(error, CZ_STATUS_INPUT, "the reader refuses a point");
    if (status == CZ_OK) {
        cz_put(answer, &run.judged, 1, sizeof run.judged);
        cz_put_text(answer, run.judged.message);
        for (int i = 0; i < challenge->n_check; i++)
            put_result(answer, &run.result[i]);
    }
    cz_full_run_free(&run);
    return status;
}

/* ---- the study ------------------------------------------------------------------------------- */

static void describe(const void *data, CzMemoryText *description) {
    const CzChallenge *challenge = data;
    const CzChallengeOptions *options = &challenge->parts->options;
    cz_problem_put(description, challenge->problem);
    cz_put_int(description, options->n_run);
    cz_put(description, &challenge->seed, 1, sizeof challenge->seed);
    cz_put_int(description, challenge->n_draw);
    cz_put_int(description, challenge->n_check);
    for (int i = 0; i < challenge->n_check; i++)
        cz_put_numbers(description, &challenge->check[i].nominal, 1);
}

/* The study of a worker. */
typedef struct Opened {
    CzProblemSteps problem;
    CzChallenge *challenge;
} Opened;

static CzStatus open_lists(CzChallenge *challenge, CzError *error) {
    CzCaseBench bench;
    CzStatus status = cz_challenge_unchanged(challenge, &bench, error);
    if (status == CZ_OK)
        status = cz_challenge_begin(challenge, &bench, error);
    cz_case_bench_free(&bench);
    return status;
}

static CzStatus open_challenge(CzReading *description, void **study, CzError *error) {
    Opened *opened = *study = calloc(1, sizeof *opened);
    if (opened == NULL)
        return cz_no_memory(error, "a study");
    CzChallengeOptions options = cz_challenge_options_default();
    CZ_TRY(cz_problem_get(description, &opened->problem, error));
    options.n_run = cz_get_int(description);
    cz_get(description, &options.seed, 1, sizeof options.seed);
    opened->challenge = cz_challenge_create(cz_problem_of(&opened->problem), &options);
    if (opened->challenge == NULL)
        return cz_no_memory(error, "a study");
    CZ_TRY(open_lists(opened->challenge, error));
    const int n_draw = cz_get_int(description), n_check = cz_get_int(description);
    if (n_draw != opened->challenge->n_draw || n_check != opened->challenge->n_check)
        return cz_fail(error, CZ_STATUS_INPUT, "the challenge has other draws or checks here");
    for (int i = 0; i < n_check; i++)
        cz_get_numbers(description, &opened->challenge->check[i].nominal, 1);
    return CZ_OK;
}

static CzStatus answer_task(void *study, CzReading *request, CzMemoryText *answer, CzError *error) {
    CzChallenge *challenge = ((Opened *)study)->challenge;
    switch (cz_get_int(request)) {
    case POINTS:
        return answer_points(challenge, request, answer, error);
    case ADVERSARY:
        return answer_adversary(challenge, request, answer, error);
    case FULL_RUN:
        return answer_full_run(challenge, request, answer, error);
    default:
        return cz_no_memory(error, "a task");
    }
}

static void close_challenge(void *study) {
    Opened *opened = study;
    if (opened == NULL)
        return;
    cz_challenge_free(opened->challenge);
    cz_problem_steps_free(&opened->problem);
    free(opened);
}

const CzStudyKind cz_study_of_challenge = {open_challenge, answer_task, close_challenge};

CzStudy cz_challenge_study(const CzChallenge *challenge, CzExecutor executor) {
    return (CzStudy){.executor = executor,
                     .kind = CZ_STUDY_OF_CHALLENGE,
                     .describe = describe,
                     .data = challenge};
}

CzTaskData cz_points_as_data(CzChallenge *challenge) {
    return (CzTaskData){&challenge->parts->study, request_points, take_points};
}

CzTaskData cz_adversaries_as_data(CzChallenge *challenge) {
    return (CzTaskData){&challenge->parts->study, request_adversary, take_adversary};
}

CzTaskData cz_full_runs_as_data(CzChallenge *challenge) {
    return (CzTaskData){&challenge->parts->study, request_full_run, take_full_run};
}
