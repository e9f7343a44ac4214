/* Histories of the points of a sweep: completed points, at most CZ_MAX_SWEPT_CURVES of them at
 * equal distances, run once more with everything recorded. */
#include "evaluate/sweep_curves.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "evaluate/evaluator_parts.h"
#include "evaluate/tasks.h"

typedef struct Recording {
    CzSweep *sweep;
    const CzSweepOptions *options;
    CzPointReader *read;
    const void *data;
} Recording;

/* ---- which ---- */

/* The scenario that was asked for, else that of the worst point's check, else the first one. */
static void choose_scenario(CzSweep *sweep, const char *asked) {
    const char *worst = sweep->worst >= 0 ? sweep->point[sweep->worst].scenario : "";
    int scenario = 0;
    CzError none;
    const bool is_asked =
        asked != NULL && cz_problem_find_scenario(sweep->problem, asked, &scenario, &none) == CZ_OK;
    if (!is_asked && cz_problem_find_scenario(sweep->problem, worst, &scenario, &none) != CZ_OK)
        scenario = 0;
    snprintf(sweep->curve_scenario, sizeof sweep->curve_scenario, "%s",
             cz_problem_scenario_name(sweep->problem, scenario));
}

/* Chooses the points; false without memory. */
static bool choose_points(CzSweep *sweep) {
    int n_done = 0, n_seen = 0;
    sweep->curve = calloc(CZ_MAX_SWEPT_CURVES, sizeof *sweep->curve);
    if (sweep->curve == NULL)
        return false;
    for (int i = 0; i < sweep->n_point; i++)
        n_done += sweep->point[i].state == CZ_SWEEP_DONE;
    const int n = n_done < CZ_MAX_SWEPT_CURVES ? n_done : CZ_MAX_SWEPT_CURVES;
    for (int i = 0; i < sweep->n_point && sweep->n_curve < n; i++) {
        if (sweep->point[i].state != CZ_SWEEP_DONE)
            continue;
        const int next = n > 1 ? sweep->n_curve * (n_done - 1) / (n - 1) : 0;
        if (n_seen++ == next)
            sweep->curve[sweep->n_curve++].point = i;
    }
    return true;
}

/* ---- one point ---- */

/* Copies a channel, NULL when it was not recorded; false without memory. */
static bool copy_channel(const CzRun *run, CzChannel channel, int place, double **copy) {
    const double *value = cz_run_channel(run, channel, place);
    const size_t size = (size_t)cz_run_n_sample(run) * sizeof *value;
    if (value == NULL || size == 0)
        return true;
    *copy = malloc(size);
    if (*copy == NULL)
        return false;
    memcpy(*copy, value, size);
    return true;
}

static CzStatus keep_run(const CzRun *run, int colliding, CzSweepCurve *curve, CzError *error) {
    curve->n = cz_run_n_sample(run);
    const bool is_kept =
        copy_channel(run, CZ_CHANNEL_TIME, 0, &curve->time) &&
        copy_channel(run, CZ_CHANNEL_INTERFACE_FORCE, colliding, &curve->force) &&
        copy_channel(run, CZ_CHANNEL_INTERFACE_CLOSURE, colliding, &curve->closure) &&
        copy_channel(run, CZ_CHANNEL_BODY_SPEED, colliding, &curve->speed);
    for (int i = 0; is_kept && curve->closure != NULL && i < curve->n; i++)
        if (curve->closure[i] < 0) /* the cars have parted */
            curve->closure[i] = NAN;
    return is_kept ? CZ_OK : cz_no_memory(error, "the curves of a sweep");
}

static CzStatus run_point(const Recording *recording, CzProblem *problem, CzSweepCurve *curve,
                          CzError *error) {
    CzEvaluatorOptions options = cz_evaluator_options_default();
    CzEvaluator *evaluator = NULL;
    CzEvaluation evaluation = {0};
    options.n_job = 1;
    options.scenario = recording->sweep->curve_scenario;
    CZ_TRY(cz_evaluator_build(problem, &options, &evaluator, error));
    cz_evaluator_set_stop(evaluator, recording->options->stop);
    CzStatus status = cz_evaluate(evaluator, 1, NULL, true, &evaluation, error);
    for (int s = 0; status == CZ_OK && s < evaluation.n_run; s++)
        if (evaluation.run[s] != NULL)
            status = keep_run(evaluation.run[s], evaluator->scene[s].colliding, curve, error);
    cz_evaluation_free(&evaluation);
    cz_evaluator_free(evaluator);
    return status;
}

/* A point that cannot be run has no curve. */
static CzStatus record_point(int index, void *data, CzError *error) {
    const Recording *recording = data;
    CzSweepCurve *curve = &recording->sweep->curve[index];
    CzProblem *problem = NULL;
    CzStatus status =
        recording->read(recording->data, &recording->sweep->point[curve->point], &problem, error);
    if (status == CZ_OK)
        status = run_point(recording, problem, curve, error);
    cz_problem_free(problem);
    return status == CZ_STATUS_NO_MEMORY ? status : CZ_OK;
}

/* ---- all ---- */

CzStatus cz_sweep_record(CzSweep *sweep, const CzSweepOptions *options, CzPointReader *read,
                         const void *data, CzError *error) {
    Recording recording = {sweep, options, read, data};
    const CzExecutor threads = cz_executor_choose(NULL, options->n_job);
    if (!choose_points(sweep))
        return cz_no_memory(error, "the curves of a sweep");
    choose_scenario(sweep, options->scenario);
    CZ_TRY(cz_tasks_run(&threads, sweep->n_curve, record_point, &recording, error));
    if (options->stop != NULL && *options->stop != 0)
        cz_sweep_free_curves(sweep);
    return CZ_OK;
}

void cz_sweep_free_curves(CzSweep *sweep) {
    for (int i = 0; i < sweep->n_curve; i++) {
        free(sweep->curve[i].time);
        free(sweep->curve[i].force);
        free(sweep->curve[i].closure);
        free(sweep->curve[i].speed);
    }
    free(sweep->curve);
    sweep->curve = NULL;
    sweep->n_curve = 0;
}
