/* Curves of a corridor: factors to the scenarios of a case to a verdict. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "base/text.h"
#include "evaluate/compose.h"
#include "evaluate/tasks.h"
#include "optimise/corridor.h"

/* ---- judging --------------------------------------------------------------------------------- */

/* Notes why a run failed. */
static void note_failure(const CzCorridor *corridor, const CzRunSummary *run, int scenario,
                         CzTriedCurve *curve) {
    const char *name = cz_problem_scenario_name(corridor->problem, corridor->scenario[scenario]);
    const char *reason = run->failure[0] != '\0' ? run->failure : cz_failure_of(run);
    if (curve->state == CZ_SAMPLE_DONE)
        snprintf(curve->message, sizeof curve->message, "%s: %.200s", name, reason);
    curve->state = CZ_SAMPLE_RUN_FAILED;
}

/* Keeps the worst check. */
static void keep_worst(const CzCorridor *corridor, const CzCheckResult *worst, int scenario,
                       CzTriedCurve *curve) {
    curve->margin = worst->margin;
    cz_text_copy(curve->check, sizeof curve->check, worst->name);
    cz_text_copy(curve->scenario, sizeof curve->scenario,
                 cz_problem_scenario_name(corridor->problem, corridor->scenario[scenario]));
    cz_text_copy(curve->where, sizeof curve->where, worst->where);
}

/* Judges the k-th curve of a bench by the checks of its scenarios; `own` has room for them. */
static void judge(const CzCorridor *corridor, const CzCaseBench *bench,
                  const CzEvaluation *evaluation, int k, CzCheckResult *own, CzTriedCurve *curve) {
    const int n_scenario = corridor->n_scenario;
    CzEvaluation all = {.check = own};
    const CzCheckResult *worst = NULL;
    int worst_scenario = 0;
    curve->state = CZ_SAMPLE_DONE;
    curve->margin = NAN;
    for (int j = 0; j < n_scenario; j++) {
        const int run = k * n_scenario + j;
        const CzRunSummary *summary = cz_run_summary(evaluation->run[run]);
        const int scene = cz_problem_n_scenario(corridor->problem) + run;
        const char *name = bench->evaluator->scene[scene].name;
        all.beyond_validity |= summary->beyond_validity;
        if (cz_failure_of(summary) != NULL)
            note_failure(corridor, summary, j, curve);
        for (int i = 0; i < evaluation->n_check; i++) {
            if (strcmp(evaluation->check[i].scenario, name) != 0)
                continue;
            CzCheckResult *result = &own[all.n_check++];
            *result = evaluation->check[i];
            if (worst == NULL || cz_check_is_worse(result, worst)) {
                worst = result;
                worst_scenario = j;
            }
        }
    }
    curve->verdict =
        curve->state == CZ_SAMPLE_DONE ? cz_verdict_over(&all, 0, NULL) : CZ_VERDICT_FAIL;
    if (worst != NULL && curve->state == CZ_SAMPLE_DONE)
        keep_worst(corridor, worst, worst_scenario, curve);
    if (all.beyond_validity && (worst == NULL || worst->verdict != CZ_VERDICT_FAIL))
        snprintf(curve->message, sizeof curve->message, "a vehicle climbed");
}

/* The names of the checks of a case, each once. */
static CzStatus list_checks(CzCorridor *corridor, int n, const CzCheckResult *result,
                            CzError *error) {
    CzArena *arena = &corridor->parts->arena;
    const char **name = cz_arena_allocate(arena, (size_t)n + 1, sizeof *name);
    for (int i = 0; name != NULL && i < n; i++)
        if (!cz_text_is_among(result[i].name, corridor->n_check, name)) {
            name[corridor->n_check] =
                cz_arena_copy_text(arena, result[i].name, strlen(result[i].name));
            corridor->n_check += name[corridor->n_check] != NULL;
        }
    corridor->check = name;
    return arena->out_of_memory ? cz_no_memory(error, "the checks of a corridor") : CZ_OK;
}

/* ---- runs ------------------------------------------------------------------------------------ */

static CzStatus run_bench(CzCorridor *corridor, const CzCaseBench *bench, int n,
                          CzTriedCurve *curve, CzError *error) {
    const CzManner brief = {.step_factor = 1,
                            .integrator = CZ_INTEGRATOR_ZHAI,
                            .track = CZ_TRACK_USE_SEARCH,
                            .brief = true};
    CzEvaluation evaluation = {0};
    cz_evaluator_set_stop(bench->evaluator, corridor->parts->options.stop);
    CzStatus status = cz_evaluator_repeat(bench->evaluator, 1,
                                          curve->is_whole ? &bench->evaluator->manner : &brief,
                                          NULL, &evaluation, error);
    CzCheckResult *own = malloc(((size_t)evaluation.n_check + 1) * sizeof *own);
    if (own == NULL && status == CZ_OK)
        status = cz_no_memory(error, "the results of a curve");
    for (int k = 0; status == CZ_OK && k < n; k++)
        judge(corridor, bench, &evaluation, k, own, &curve[k]);
    if (status == CZ_OK && curve[0].shape == CZ_CURVE_NOMINAL && corridor->check == NULL)
        status = list_checks(corridor, evaluation.n_check, evaluation.check, error);
    free(own);
    cz_evaluation_free(&evaluation);
    return status;
}

/* Values of the draws of n curves, to be freed; NULL without memory. */
static double *make_values(const CzCorridor *corridor, const CzCases *cases, int n,
                           const CzTriedCurve *curve) {
    const int n_draw = cases->n_draw, n_scatter = curve[0].sample >= 0 ? corridor->n_draw : 0;
    double *value = malloc((size_t)n * (size_t)n_draw * sizeof *value);
    for (int k = 0; value != NULL && k < n; k++) {
        double *row = value + (size_t)k * (size_t)n_draw;
        if (n_scatter > 0)
            memcpy(row, corridor->value + (size_t)curve[k].sample * (size_t)n_scatter,
                   (size_t)n_scatter * sizeof *row);
        cz_corridor_set_values(corridor, curve[k].factor, row + n_scatter);
    }
    return value;
}

/* Notes a curve that the reader refuses, with the rule alone. */
static void refuse(CzTriedCurve *curve, const CzError *mistake) {
    const char *rule = strstr(mistake->message, "': ");
    rule = rule != NULL ? rule + 3 : mistake->message;
    const int n = (int)strcspn(rule, ";");
    curve->state = CZ_SAMPLE_INVALID;
    curve->verdict = CZ_VERDICT_FAIL;
    curve->margin = NAN;
    snprintf(curve->message, sizeof curve->message, "%.*s", n < 255 ? n : 255, rule);
}

/* When the reader refuses one of several curves, each of them is read by itself. */
CzStatus cz_corridor_run_in_thread(CzCorridor *corridor, int n, CzTriedCurve *curve,
                                   CzError *error) {
    const CzCorridorParts *parts = corridor->parts;
    const CzCases *cases = curve[0].sample >= 0 ? &parts->with_scatter : &parts->bare;
    CzCaseBench bench;
    CzError mistake = {0};
    double *value = make_values(corridor, cases, n, curve);
    if (value == NULL)
        return cz_no_memory(error, "the values of a curve");
    int number[CZ_CURVES_AT_ONCE];
    for (int k = 0; k < n; k++)
        number[k] = k;
    CzStatus status = cz_case_bench_build(cases, n, number, value, &bench, &mistake);
    free(value);
    if (status == CZ_OK) {
        status = run_bench(corridor, &bench, n, curve, error);
    } else if (status == CZ_STATUS_INPUT && n == 1) {
        refuse(curve, &mistake);
        status = CZ_OK;
    } else if (status == CZ_STATUS_INPUT) {
        status = CZ_OK;
        for (int k = 0; k < n && status == CZ_OK; k++)
            status = cz_corridor_run_in_thread(corridor, 1, &curve[k], error);
    } else if (error != NULL) {
        *error = mistake;
    }
    cz_case_bench_free(&bench);
    return status;
}

/* Curves that are run side by side. */
typedef struct Batch {
    CzCorridor *corridor;
    int n;
    CzTriedCurve *curve; /* (n) */
} Batch;

/* Curves of a task; *n is their number. */
static CzTriedCurve *curves_of(const Batch *batch, int index, int *n) {
    const int first = index * CZ_CURVES_AT_ONCE, left = batch->n - first;
    *n = left < CZ_CURVES_AT_ONCE ? left : CZ_CURVES_AT_ONCE;
    return batch->curve + first;
}

static CzStatus run_task(int index, void *data, CzError *error) {
    const Batch *batch = data;
    int n;
    CzTriedCurve *curve = curves_of(batch, index, &n);
    return cz_corridor_run_in_thread(batch->corridor, n, curve, error);
}

/* The first curve lists the checks, so that it is run here. */
static bool request_curves(int index, void *data, CzMemoryText *request) {
    const Batch *batch = data;
    int n;
    const CzTriedCurve *curve = curves_of(batch, index, &n);
    cz_put_int(request, CZ_CORRIDOR_CURVES);
    cz_put_int(request, n);
    cz_put(request, curve, (size_t)n, sizeof *curve);
    return batch->corridor->check != NULL && !cz_corridor_is_stopped(batch->corridor);
}

static CzStatus take_curves(int index, void *data, CzReading *answer, CzError *error) {
    int n;
    CzTriedCurve *curve = curves_of(data, index, &n);
    cz_get(answer, curve, (size_t)n, sizeof *curve);
    return answer->has_ended ? cz_no_memory(error, "the results of a curve") : CZ_OK;
}

CzStatus cz_corridor_answer_curves(CzCorridor *corridor, CzReading *request, CzMemoryText *answer,
                                   CzError *error) {
    CzTriedCurve curve[CZ_CURVES_AT_ONCE];
    const int n = cz_get_int(request);
    if (n < 1 || n > CZ_CURVES_AT_ONCE)
        return cz_no_memory(error, "a task");
    cz_get(request, curve, (size_t)n, sizeof *curve);
    CZ_TRY(cz_corridor_run_in_thread(corridor, n, curve, error));
    cz_put(answer, curve, (size_t)n, sizeof *curve);
    return CZ_OK;
}

CzStatus cz_corridor_run(CzCorridor *corridor, int n, CzTriedCurve *curve, CzError *error) {
    Batch batch = {.corridor = corridor, .n = n, .curve = curve};
    const CzTaskData plain = {&corridor->parts->study, request_curves, take_curves};
    for (int k = 0; k < n; k++)
        curve[k].state = CZ_SAMPLE_NOT_RUN;
    return cz_tasks_share(&plain, (n + CZ_CURVES_AT_ONCE - 1) / CZ_CURVES_AT_ONCE, run_task, &batch,
                          error);
}
