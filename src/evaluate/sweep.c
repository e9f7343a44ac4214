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
#include "evaluate/sweep_curves.h"
#include "evaluate/sweep_reach.h"
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
    CzStudy study;
} Sweeping;

/* ---- one point ------------------------------------------------------------------------------- */

/* Reads the problem with the values of a point; `point` NULL reads it as written. */
static CzStatus read_problem(const Sweeping *sweeping, const CzSweepPoint *point,
                             CzProblem **problem, CzError *error) {
    const CzSweepOptions *options = sweeping->options;
    CzProblemOptions with = *sweeping->problem_options;
    char text[CZ_MAX_AXES][sizeof options->axis->path + CZ_NUMBER_TEXT + 1];
    const char **set = malloc(((size_t)with.n_set + CZ_MAX_AXES) * sizeof *set);
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

static CzStatus read_point(const void *data, const CzSweepPoint *point, CzProblem **problem,
                           CzError *error) {
    return read_problem(data, point, problem, error);
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
        const int index[CZ_MAX_AXES] = {sweep->n_axis == 2 ? i / n_last : i, i % n_last};
        for (int k = 0; k < sweep->n_axis; k++)
            point->value[k] = cz_sweep_axis_value(&sweep->axis[k], index[k]);
        point->state = CZ_SWEEP_NOT_RUN;
        point->verdict = CZ_VERDICT_NOT_CHECKED;
        point->margin = NAN;
        for (int k = 0; k < CZ_MAX_SWEPT_METRICS; k++)
            point->metric[k] = NAN;
    }
}

static CzStatus prepare(Sweeping *sweeping, CzError *error) {
    const CzSweepOptions *options = sweeping->options;
    CzSweep *sweep = sweeping->sweep;
    if (options->n_axis < 1 || options->n_axis > CZ_MAX_AXES)
        return cz_fail(error, CZ_STATUS_INPUT, "a sweep has one or two paths, not %d",
                       options->n_axis);
    if (options->n_axis == 2 && cz_key_same_stem(options->axis[0].path, options->axis[1].path))
        return cz_fail(error, CZ_STATUS_INPUT,
                       "both paths of the sweep name one value: '%.160s' and '%.160s'",
                       options->axis[0].path, options->axis[1].path);
    if (options->n_metric > CZ_MAX_SWEPT_METRICS)
        return cz_fail(error, CZ_STATUS_INPUT, "a sweep prints at most %d metrics",
                       (int)CZ_MAX_SWEPT_METRICS);
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
    CZ_TRY(read_problem(sweeping, NULL, &sweep->problem, error));
    return cz_sweep_find_unreached(sweep, options->scenario, error);
}

static bool is_stopped(const CzSweepOptions *options) {
    return options->stop != NULL && *options->stop != 0;
}

/* ---- points in workers ----------------------------------------------------------------------- */

/* Paths of a sweep are those of the file, which each point reads again, so a worker reads it too.
 */
static void describe_sweep(const void *data, CzMemoryText *description) {
    const Sweeping *sweeping = data;
    const CzSweepOptions *options = sweeping->options;
    cz_put_text(description, sweeping->file);
    cz_put_int(description, options->text != NULL);
    cz_put_int(description, (int)options->n_text);
    cz_put(description, options->text, options->n_text, 1);
    cz_put_texts(description, sweeping->problem_options->n_set, sweeping->problem_options->set);
    cz_put_text(description, sweeping->problem_options->share_folder);
    cz_put_int(description, options->n_axis);
    cz_put(description, options->axis, (size_t)options->n_axis, sizeof *options->axis);
    cz_put_texts(description, options->n_metric, options->metric);
    cz_put_texts(description, options->n_check, options->check);
    cz_put_text(description, options->scenario);
}

static bool request_point(int index, void *data, CzMemoryText *request) {
    const Sweeping *sweeping = data;
    cz_put_int(request, sweeping->first + index);
    return !is_stopped(sweeping->options);
}

static CzStatus take_point(int index, void *data, CzReading *answer, CzError *error) {
    const Sweeping *sweeping = data;
    CzSweepPoint *point = &sweeping->sweep->point[sweeping->first + index];
    cz_get(answer, point, 1, sizeof *point);
    return answer->has_ended ? cz_no_memory(error, "a point") : CZ_OK;
}

/* The study of a worker. */
typedef struct Opened {
    CzArena arena; /* of the description */
    CzProblemOptions problem_options;
    CzSweepOptions options;
    Sweeping sweeping;
} Opened;

static CzStatus open_sweep(CzReading *description, void **study, CzError *error) {
    Opened *opened = *study = calloc(1, sizeof *opened);
    if (opened == NULL)
        return cz_no_memory(error, "a study");
    CzArena *arena = &opened->arena;
    CzProblemOptions *problem_options = &opened->problem_options;
    CzSweepOptions *options = &opened->options;
    *options = cz_sweep_options_default();
    Sweeping *sweeping = &opened->sweeping;
    *sweeping = (Sweeping){.problem_options = problem_options, .options = options};
    sweeping->file = cz_get_text(description, arena);
    const bool has_text = cz_get_int(description) != 0;
    const int n_text = cz_get_int(description);
    const char *text = cz_get_items(description, arena, n_text, 1);
    options->text = has_text ? text : NULL;
    options->n_text = (size_t)n_text;
    problem_options->set = cz_get_texts(description, arena, &problem_options->n_set);
    problem_options->share_folder = cz_get_text(description, arena);
    options->n_axis = cz_get_int(description);
    options->axis = cz_get_items(description, arena, options->n_axis, sizeof *options->axis);
    options->metric = cz_get_texts(description, arena, &options->n_metric);
    options->check = cz_get_texts(description, arena, &options->n_check);
    options->scenario = cz_get_text(description, arena);
    sweeping->sweep = calloc(1, sizeof *sweeping->sweep);
    if (sweeping->sweep == NULL || arena->out_of_memory || description->has_ended)
        return cz_no_memory(error, "a study");
    return prepare(sweeping, error);
}

static CzStatus answer_point(void *study, CzReading *request, CzMemoryText *answer,
                             CzError *error) {
    Sweeping *sweeping = &((Opened *)study)->sweeping;
    const CzSweep *sweep = sweeping->sweep;
    const int i = cz_get_int(request);
    if (i < 0 || i >= sweep->n_point)
        return cz_no_memory(error, "a task");
    CzError mistake = {0}; /* a point that is refused writes to it */
    sweeping->first = i;
    const CzStatus status = run_point(0, sweeping, &mistake);
    if (status != CZ_OK)
        *error = mistake;
    CZ_TRY(status);
    if (sweep->point[i].state == CZ_SWEEP_INVALID)
        return cz_fail(error, CZ_STATUS_INPUT, "the reader refuses a point");
    cz_put(answer, &sweep->point[i], 1, sizeof sweep->point[i]);
    return CZ_OK;
}

static void close_sweep(void *study) {
    Opened *opened = study;
    if (opened == NULL)
        return;
    cz_sweep_free(opened->sweeping.sweep);
    cz_arena_free(&opened->arena);
    free(opened);
}

const CzStudyKind cz_study_of_points = {open_sweep, answer_point, close_sweep};

/* ---- the sweep ------------------------------------------------------------------------------- */

static CzStatus run_all(Sweeping *sweeping, CzError *error) {
    const CzSweepOptions *options = sweeping->options;
    const CzExecutor executor = cz_executor_choose(options->executor, options->n_job);
    const CzTaskData plain = {&sweeping->study, request_point, take_point};
    CzSweep *sweep = sweeping->sweep;
    const int n_wave = executor.n_place * POINTS_PER_PLACE;
    sweeping->study = (CzStudy){.executor = executor,
                                .kind = CZ_STUDY_OF_POINTS,
                                .describe = describe_sweep,
                                .data = sweeping};
    if (options->recall != NULL)
        CZ_TRY(options->recall(sweep, options->recall_data, error));
    sweeping->first = sweep->begin;
    while (sweeping->first < sweep->end && !is_stopped(options)) {
        const int left = sweep->end - sweeping->first, n = left < n_wave ? left : n_wave;
        CZ_TRY(cz_tasks_share(&plain, n, run_point, sweeping, error));
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
    cz_study_end(&sweeping.study);
    if (status == CZ_OK)
        status = conclude(&sweeping, error);
    if (status == CZ_OK && options->curves && options->n_shard == 1) {
        if (!is_stopped(options))
            status = cz_sweep_record(*sweep, options, read_point, &sweeping, error);
        (*sweep)->is_interrupted = is_stopped(options);
    }
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
    cz_sweep_free_curves(sweep);
    free(sweep->unreached);
    free(sweep->point);
    free(sweep);
}
