/* Sweeps: for each point the problem is reread with other values and run.
 *
 * Points are tasks of one thread each. They are started in waves, between which progress is
 * reported and the stop flag is checked.
 */
#include "crushzone/sweep.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/clock.h"
#include "base/error.h"
#include "base/number.h"
#include "base/text.h"
#include "evaluate/compose.h"
#include "evaluate/tasks.h"
#include "text/units.h"

enum { POINTS_PER_PLACE = 4 }; /* of a wave, for each of the tasks side by side */

/* Common data of all points. */
typedef struct Sweeping {
    const char *file;
    const CzProblemOptions *problem_options;
    const CzSweepOptions *options;
    CzSweep *sweep;
    int first;           /* point of the wave */
    CzError first_error; /* of the first point whose problem is invalid */
} Sweeping;

/* ---- one point ------------------------------------------------------------------------------- */

/* Reads the problem with the values of a point; `point` NULL reads it as written. */
static CzStatus read_problem(const Sweeping *sweeping, const CzSweepPoint *point,
                             CzProblem **problem, CzError *error) {
    const CzSweepOptions *options = sweeping->options;
    CzProblemOptions with = *sweeping->problem_options;
    char text[CZ_MOST_AXES][sizeof options->axis->path + CZ_NUMBER_TEXT + 1];
    const char **set = malloc(((size_t)with.n_set + CZ_MOST_AXES) * sizeof *set);
    if (set == NULL)
        return cz_no_memory(error, "the settings of a point");
    for (int i = 0; i < with.n_set; i++)
        set[i] = with.set[i];
    for (int i = 0; point != NULL && i < options->n_axis; i++) {
        char number[CZ_NUMBER_TEXT];
        snprintf(text[i], sizeof text[i], "%s=%s", options->axis[i].path,
                 cz_number_print(number, point->value[i]));
        set[with.n_set++] = text[i];
    }
    with.set = set;
    const CzStatus status =
        options->text != NULL ? cz_problem_read_text(options->text, options->n_text,
                                                     "<standard input>", ".", &with, problem, error)
                              : cz_problem_read(sweeping->file, &with, problem, error);
    free(set);
    return status;
}

/* Values of the metrics over all scenarios. */
static void read_metrics(const CzEvaluation *evaluation, CzSweepPoint *point) {
    point->beyond_validity = evaluation->beyond_validity;
    for (int k = 0; k < evaluation->n_value; k++) {
        const CzValueResult *value = &evaluation->value[k];
        point->metric[k] = value->value;
        if (value->scenario != NULL)
            snprintf(point->metric_where[k], sizeof point->metric_where[k], "%s%s%s", value->where,
                     value->where[0] != '\0' ? ", " : "", value->scenario);
    }
}

/* Whether a check decides rather than another one: if one fails, the worst of the failed ones, else
 * the one with the smallest margin. */
static bool is_nearer(const CzCheckResult *check, const CzCheckResult *other) {
    return !isnan(check->value) && (other == NULL || cz_check_is_worse(check, other));
}

/* Verdict over the requested checks, and the check that decides. */
static CzStatus judge(const CzSweepOptions *options, const CzEvaluation *evaluation,
                      CzSweepPoint *point, CzError *error) {
    const CzCheckResult *deciding = NULL;
    bool any = false;
    for (int i = 0; i < evaluation->n_check; i++) {
        const CzCheckResult *check = &evaluation->check[i];
        if (options->n_check > 0 &&
            !cz_text_is_among(check->name, options->n_check, options->check))
            continue;
        any = true;
        if (is_nearer(check, deciding))
            deciding = check;
    }
    if (!any && options->n_check > 0)
        return cz_fail(error, CZ_STATUS_INPUT, "the problem has no check '%.200s'",
                       options->check[0]);
    point->verdict = cz_verdict_over(evaluation, options->n_check, options->check);
    const bool by_check = deciding != NULL && deciding->verdict == CZ_VERDICT_FAIL;
    if (point->verdict == CZ_VERDICT_FAIL && !by_check) {
        snprintf(point->message, sizeof point->message,
                 "a vehicle climbed: later results are beyond the model");
        return CZ_OK;
    }
    if (deciding == NULL)
        return CZ_OK;
    point->margin = deciding->margin;
    snprintf(point->check, sizeof point->check, "%s", deciding->name);
    snprintf(point->scenario, sizeof point->scenario, "%s", deciding->scenario);
    snprintf(point->where, sizeof point->where, "%s", deciding->where);
    return CZ_OK;
}

static CzStatus evaluate(const Sweeping *sweeping, CzProblem *problem, CzSweepPoint *point,
                         CzError *error) {
    CzEvaluatorOptions options = cz_evaluator_options_default();
    options.n_job = 1;
    options.scenario = sweeping->options->scenario;
    CzEvaluator *evaluator = NULL;
    CzEvaluation evaluation = {0};
    CzStatus status = cz_evaluator_build(problem, &options, &evaluator, error);
    if (status != CZ_OK)
        return status;
    cz_evaluator_set_stop(evaluator, sweeping->options->stop);
    status = cz_evaluator_set_values(evaluator, sweeping->options->n_metric,
                                     sweeping->options->metric, error);
    if (status == CZ_OK)
        status = cz_evaluate(evaluator, 1, NULL, false, &evaluation, error);
    if (status == CZ_OK && evaluation.status != CZ_OK) {
        point->state = CZ_SWEEP_RUN_FAILED;
        snprintf(point->message, sizeof point->message, "%s", evaluation.failure);
    } else if (status == CZ_OK) {
        point->state = CZ_SWEEP_DONE;
        read_metrics(&evaluation, point);
        status = judge(sweeping->options, &evaluation, point, error);
    }
    cz_evaluation_free(&evaluation);
    cz_evaluator_free(evaluator);
    return status;
}

/* An invalid or interrupted point is a result and not a failure. */
static CzStatus run_point(int index, void *data, CzError *error) {
    Sweeping *sweeping = data;
    const int i = sweeping->first + index;
    CzSweepPoint *point = &sweeping->sweep->point[i];
    CzProblem *problem = NULL;
    if (point->state != CZ_SWEEP_NOT_RUN) /* known already */
        return CZ_OK;
    CzStatus status = read_problem(sweeping, point, &problem, error);
    if (status == CZ_OK)
        status = evaluate(sweeping, problem, point, error);
    cz_problem_free(problem);
    if (status == CZ_STATUS_INPUT) {
        point->state = CZ_SWEEP_INVALID;
        snprintf(point->message, sizeof point->message, "%.511s", error->message);
        if (i == 0)
            sweeping->first_error = *error;
    }
    return status == CZ_STATUS_INPUT || status == CZ_STATUS_INTERRUPTED ? CZ_OK : status;
}

/* ---- all points ------------------------------------------------------------------------------ */

static void lay_out(CzSweep *sweep) {
    for (int i = 0; i < sweep->n_point; i++) {
        CzSweepPoint *point = &sweep->point[i];
        const int n_last = sweep->axis[sweep->n_axis - 1].n;
        const int index[CZ_MOST_AXES] = {sweep->n_axis == 2 ? i / n_last : i, i % n_last};
        for (int k = 0; k < sweep->n_axis; k++)
            point->value[k] = cz_sweep_axis_value(&sweep->axis[k], index[k]);
        point->state = CZ_SWEEP_NOT_RUN;
        point->verdict = CZ_VERDICT_NOT_CHECKED;
        point->margin = NAN;
        for (int k = 0; k < CZ_MOST_SWEPT_METRICS; k++)
            point->metric[k] = NAN;
    }
}

static CzStatus prepare(Sweeping *sweeping, CzError *error) {
    const CzSweepOptions *options = sweeping->options;
    CzSweep *sweep = sweeping->sweep;
    if (options->n_axis < 1 || options->n_axis > CZ_MOST_AXES)
        return cz_fail(error, CZ_STATUS_INPUT, "a sweep has one or two paths, not %d",
                       options->n_axis);
    if (options->n_axis == 2 && cz_key_same_stem(options->axis[0].path, options->axis[1].path))
        return cz_fail(error, CZ_STATUS_INPUT,
                       "both paths of the sweep name one value: '%.160s' and '%.160s'",
                       options->axis[0].path, options->axis[1].path);
    if (options->n_metric > CZ_MOST_SWEPT_METRICS)
        return cz_fail(error, CZ_STATUS_INPUT, "a sweep prints at most %d metrics",
                       (int)CZ_MOST_SWEPT_METRICS);
    sweep->n_axis = options->n_axis;
    sweep->n_metric = options->n_metric;
    sweep->n_point = 1;
    for (int k = 0; k < options->n_axis; k++) {
        sweep->axis[k] = options->axis[k];
        sweep->n_point *= options->axis[k].n;
    }
    for (int k = 0; k < options->n_metric; k++) {
        CzMetric metric;
        CZ_TRY(cz_metric_parse(options->metric[k], &metric, error));
        snprintf(sweep->metric[k], sizeof sweep->metric[k], "%s", options->metric[k]);
        sweep->metric_unit[k] = metric.kind->unit->text;
        sweep->metric_doc[k] = metric.kind->doc;
    }
    sweep->point = calloc((size_t)sweep->n_point, sizeof *sweep->point);
    if (sweep->point == NULL)
        return cz_no_memory(error, "the points");
    lay_out(sweep);
    sweep->shard = options->shard;
    sweep->n_shard = options->n_shard;
    CZ_TRY(cz_tasks_cut(sweep->n_point, "points", options->shard, options->n_shard, &sweep->begin,
                        &sweep->end, error));
    return read_problem(sweeping, NULL, &sweep->problem, error);
}

static bool is_stopped(const CzSweepOptions *options) {
    return options->stop != NULL && *options->stop != 0;
}

static CzStatus run_all(Sweeping *sweeping, CzError *error) {
    const CzSweepOptions *options = sweeping->options;
    const CzExecutor executor = cz_executor_choose(options->executor, options->n_job);
    CzSweep *sweep = sweeping->sweep;
    const int n_wave = executor.n_place * POINTS_PER_PLACE;
    if (options->recall != NULL)
        CZ_TRY(options->recall(sweep, options->recall_data, error));
    sweeping->first = sweep->begin;
    while (sweeping->first < sweep->end && !is_stopped(options)) {
        const int left = sweep->end - sweeping->first, n = left < n_wave ? left : n_wave;
        CZ_TRY(cz_tasks_run(&executor, n, run_point, sweeping, error));
        sweeping->first += n;
        if (options->progress != NULL)
            options->progress(sweeping->first - sweep->begin, sweep->end - sweep->begin,
                              options->progress_data);
    }
    sweeping->sweep->is_interrupted = is_stopped(options);
    return CZ_OK;
}

/* Sort key of a point in the search for the worst: run failures first, then points that fail by
 * their margins, then those that fail by a yes or no, then the rest by margin; NaN for a point
 * without a margin. */
static double order_of(const CzSweepPoint *point) {
    const double most = 1e9, margin = fmin(fmax(point->margin, -most), most);
    if (point->state == CZ_SWEEP_RUN_FAILED)
        return -4 * most;
    if (point->state != CZ_SWEEP_DONE)
        return NAN;
    if (point->verdict == CZ_VERDICT_FAIL)
        return -2 * most + (isnan(point->margin) ? 0 : margin);
    return isnan(point->margin) ? NAN : margin;
}

/* Names the worst point; a sweep whose points are all invalid fails. */
static CzStatus conclude(const Sweeping *sweeping, CzError *error) {
    CzSweep *sweep = sweeping->sweep;
    bool any_valid = false;
    for (int i = 0; i < sweep->n_point; i++)
        any_valid |= sweep->point[i].state != CZ_SWEEP_INVALID;
    if (!any_valid && sweeping->first_error.status == CZ_OK) /* known from elsewhere */
        return cz_fail(error, CZ_STATUS_INPUT, "%s", sweep->point[0].message);
    if (!any_valid && error != NULL)
        *error = sweeping->first_error;
    if (!any_valid)
        return CZ_STATUS_INPUT;
    sweep->worst = -1;
    for (int i = 0; i < sweep->n_point; i++) {
        const double order = order_of(&sweep->point[i]);
        if (!isnan(order) && (sweep->worst < 0 || order < order_of(&sweep->point[sweep->worst])))
            sweep->worst = i;
    }
    return CZ_OK;
}

CzStatus cz_sweep(const char *file, const CzProblemOptions *problem_options,
                  const CzSweepOptions *options, CzSweep **sweep, CzError *error) {
    const double started = cz_clock();
    const CzProblemOptions none = cz_problem_options_default();
    *sweep = calloc(1, sizeof **sweep);
    if (*sweep == NULL)
        return cz_no_memory(error, "a sweep");
    Sweeping sweeping = {.file = file,
                         .problem_options = problem_options != NULL ? problem_options : &none,
                         .options = options,
                         .sweep = *sweep};
    CzStatus status = prepare(&sweeping, error);
    if (status == CZ_OK)
        status = run_all(&sweeping, error);
    if (status == CZ_OK)
        status = conclude(&sweeping, error);
    (*sweep)->wall_s = cz_clock() - started;
    if (status == CZ_OK)
        return CZ_OK;
    cz_sweep_free(*sweep);
    *sweep = NULL;
    return status;
}

void cz_sweep_free(CzSweep *sweep) {
    if (sweep == NULL)
        return;
    cz_problem_free(sweep->problem);
    free(sweep->point);
    free(sweep);
}
