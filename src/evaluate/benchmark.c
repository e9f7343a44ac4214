/* Times of the scenarios of a problem: each round runs every scenario once, so that other work on
 * the machine affects all of them equally. */
#include "crushzone/benchmark.h"

#include <stdio.h>
#include <stdlib.h>

#include "base/clock.h"
#include "base/error.h"
#include "evaluate/evaluator_parts.h"
#include "simulate/batch.h"

enum { ROUNDS = 5 };

static const struct {
    const char *key, *text;
} timed_words[CZ_N_TIMED] = {
#define CZ_TIMED(constant, key, text, doc) [constant] = {key, text},
#include "crushzone/timed.def"
#undef CZ_TIMED
};

const char *cz_timed_key(CzTimed timed) {
    return timed_words[timed].key;
}

const char *cz_timed_text(CzTimed timed) {
    return timed_words[timed].text;
}

CzBenchmarkOptions cz_benchmark_options_default(void) {
    return (CzBenchmarkOptions){.n_round = ROUNDS};
}

/* One scenario while it is timed. */
typedef struct Timing {
    const CzEvaluator *evaluator;
    int scene;
    CzScenarioTimes *times;
    CzBenchmark *benchmark;
    int n_done, n_all;          /* rounds of all scenarios */
    double *sample[CZ_N_TIMED]; /* [s] (n_round) */
} Timing;

static void note_failure(CzBenchmark *benchmark, const CzRunSummary *summary) {
    const bool is_incomplete = summary->ended == CZ_ENDED_INCOMPLETE;
    if (benchmark->status != CZ_OK || (summary->status == CZ_OK && !is_incomplete))
        return;
    benchmark->status = CZ_STATUS_RUN_FAILED;
    snprintf(benchmark->failure, sizeof benchmark->failure, "scenario '%.48s': %.250s",
             summary->scenario,
             summary->failure[0] != '\0' ? summary->failure : cz_ended_text(summary->ended));
}

static CzStatus time_setup(const Timing *timing, double *sample, CzError *error) {
    CzModel *model = NULL;
    const double started = cz_processor_clock();
    const CzStatus status =
        cz_model_build(timing->evaluator->problem, timing->scene, &model, error);
    *sample = cz_processor_clock() - started;
    cz_model_free(model);
    return status;
}

static CzStatus time_runs(const Timing *timing, int n_design, bool records, double *sample,
                          CzError *error) {
    const CzModel *model = timing->evaluator->model[timing->scene];
    CzSimulateOptions options = cz_simulate_options_default();
    CzRun *run[CZ_BENCHMARK_WIDTH] = {NULL};
    CzPlannedRun planned[CZ_BENCHMARK_WIDTH];
    for (int i = 0; i < n_design; i++)
        planned[i] = (CzPlannedRun){model, NULL};
    options.record = records;
    const double started = cz_processor_clock();
    const CzStatus status = cz_simulate_batch(n_design, planned, &options, run, error);
    *sample = (cz_processor_clock() - started) / n_design;
    if (status != CZ_OK)
        return status;
    const CzRunSummary *summary = cz_run_summary(run[0]);
    timing->times->n_step = summary->n_step;
    timing->times->simulated = summary->simulated;
    note_failure(timing->benchmark, summary);
    for (int i = 0; i < n_design; i++)
        cz_run_free(run[i]);
    return CZ_OK;
}

static CzStatus time_round(const Timing *timing, int round, CzError *error) {
    double *const *sample = timing->sample;
    CZ_TRY(time_setup(timing, &sample[CZ_TIMED_SETUP][round], error));
    CZ_TRY(time_runs(timing, 1, false, &sample[CZ_TIMED_RUN][round], error));
    CZ_TRY(time_runs(timing, 1, true, &sample[CZ_TIMED_RECORDED][round], error));
    return time_runs(timing, CZ_BENCHMARK_WIDTH, false, &sample[CZ_TIMED_BATCH][round], error);
}

static int by_size(const void *a, const void *b) {
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static CzStatus time_scenario(Timing *timing, const CzBenchmarkOptions *options, CzError *error) {
    CzScenarioTimes *times = timing->times;
    const int n = options->n_round;
    times->scenario = cz_problem_scenario_name(timing->evaluator->problem, timing->scene);
    times->n_vehicle = timing->evaluator->n_vehicle;
    for (int round = 0; round < n; round++) {
        if (options->stop != NULL && *options->stop != 0)
            return cz_fail(error, CZ_STATUS_INTERRUPTED, "the benchmark was interrupted");
        CZ_TRY(time_round(timing, round, error));
        if (options->progress != NULL)
            options->progress(++timing->n_done, timing->n_all, options->progress_data);
    }
    for (int timed = 0; timed < CZ_N_TIMED; timed++) {
        double *sample = timing->sample[timed];
        qsort(sample, (size_t)n, sizeof *sample, by_size);
        times->time[timed] = (CzTiming){sample[0], sample[n / 2], n};
    }
    return CZ_OK;
}

static CzStatus time_all(const CzEvaluator *evaluator, const CzBenchmarkOptions *options,
                         double *room, CzBenchmark *benchmark, CzError *error) {
    Timing timing = {.evaluator = evaluator, .benchmark = benchmark};
    for (int timed = 0; timed < CZ_N_TIMED; timed++)
        timing.sample[timed] = room + timed * options->n_round;
    for (int scene = 0; scene < evaluator->n_scene; scene++)
        timing.n_all += evaluator->model[scene] != NULL ? options->n_round : 0;
    for (int scene = 0; scene < evaluator->n_scene; scene++) {
        if (evaluator->model[scene] == NULL)
            continue; /* left out */
        timing.scene = scene;
        timing.times = &benchmark->scenario[benchmark->n_scenario];
        CZ_TRY(time_scenario(&timing, options, error));
        benchmark->n_scenario++;
    }
    return CZ_OK;
}

CzStatus cz_benchmark(const CzEvaluator *evaluator, const CzBenchmarkOptions *options,
                      CzBenchmark **benchmark, CzError *error) {
    CzBenchmarkOptions chosen = options != NULL ? *options : cz_benchmark_options_default();
    chosen.n_round = chosen.n_round > 0 ? chosen.n_round : 1;
    const double started = cz_clock();
    CzBenchmark *made = calloc(1, sizeof *made);
    double *room = calloc((size_t)chosen.n_round * CZ_N_TIMED, sizeof *room);
    if (made != NULL)
        made->scenario = calloc((size_t)evaluator->n_scene, sizeof *made->scenario);
    CzStatus status = CZ_OK;
    if (made == NULL || room == NULL || made->scenario == NULL)
        status = cz_no_memory(error, "the benchmark");
    if (status == CZ_OK)
        status = time_all(evaluator, &chosen, room, made, error);
    free(room);
    if (status != CZ_OK) {
        cz_benchmark_free(made);
        return status;
    }
    made->wall_s = cz_clock() - started;
    *benchmark = made;
    return CZ_OK;
}

void cz_benchmark_free(CzBenchmark *benchmark) {
    if (benchmark == NULL)
        return;
    free(benchmark->scenario);
    free(benchmark);
}
