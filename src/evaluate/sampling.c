/* Samples: the problem is read again with every sample's scenarios, and run.
 *
 *   draws --values--> cases of some samples --problem/cases.c--> problem --evaluator--> margins
 *
 * A task has a few samples, so that memory does not grow with their number. Tasks are started in
 * waves, between which progress is reported and the stop flag is checked; results are stored by
 * sample, so that neither threads nor shards change a bit of them.
 */
#include "evaluate/sampling.h"

#include <stdlib.h>
#include <string.h>

#include "base/clock.h"
#include "base/error.h"
#include "evaluate/tasks.h"
#include "problem/problem_bytes.h"
#include "simulate/batch.h"

enum {
    MIN_PER_TASK = 4,   /* samples, which share the set-up of the track (measured) */
    MAX_PER_TASK = 16,  /* in memory at a time (ours) */
    TASKS_PER_PLACE = 2 /* of a wave */
};

/* Common data of all samples. */
typedef struct Sampler {
    const CzSampleOptions *options;
    CzSampling *sampling;
    int n_due;
    int *due;  /* samples to run (n_due) */
    int first; /* of the wave, in that list */
    int n_per_task;
    CzStudy study;
} Sampler;

CzSampleOptions cz_sample_options_default(void) {
    return (CzSampleOptions){.seed = -1, .shard = 1, .n_shard = 1};
}

/* An empty sampling; NULL without memory. */
static CzSampling *create(void) {
    CzSampling *sampling = calloc(1, sizeof *sampling);
    if (sampling != NULL)
        sampling->parts = calloc(1, sizeof *sampling->parts);
    if (sampling == NULL || sampling->parts != NULL)
        return sampling;
    cz_sampling_free(sampling);
    return NULL;
}

/* ---- running --------------------------------------------------------------------------------- */

/* Runs the samples of a bench, or the nominal design. */
static CzStatus run_bench(const Sampler *sampler, const CzCaseBench *bench, int n,
                          const int *sample, CzError *error) {
    CzEvaluation evaluation = {0};
    cz_evaluator_set_stop(bench->evaluator, sampler->options->stop);
    CzManner manner = bench->evaluator->manner;
    manner.brief = sampler->options->brief;
    manner.track = manner.brief ? CZ_TRACK_USE_SEARCH : manner.track;
    CzStatus status = cz_evaluator_repeat(bench->evaluator, 1, &manner, NULL, &evaluation, error);
    if (status == CZ_OK && sample[0] == CZ_UNCHANGED_CASE)
        cz_sampling_keep_bare(sampler->sampling, bench, &evaluation);
    for (int k = 0; status == CZ_OK && sample[0] != CZ_UNCHANGED_CASE && k < n; k++)
        status = cz_sampling_keep(sampler->sampling, bench, &evaluation, sample[k], k, error);
    cz_evaluation_free(&evaluation);
    return status;
}

/* Notes a sample whose values the reader refuses. */
static CzStatus refuse(CzSampling *sampling, int sample, const CzError *mistake, CzError *error) {
    CzSample *refused = &sampling->sample[sample];
    refused->state = CZ_SAMPLE_INVALID;
    refused->verdict = CZ_VERDICT_FAIL;
    refused->message = malloc(sizeof mistake->message);
    if (refused->message == NULL)
        return cz_no_memory(error, "the results of a sample");
    snprintf(refused->message, sizeof mistake->message, "%s", mistake->message);
    return CZ_OK;
}

/* Runs some samples together; when the reader refuses the values of one of them, each by itself. */
static CzStatus run_samples(const Sampler *sampler, int n, const int *sample, CzError *error);

static CzStatus run_each(const Sampler *sampler, int n, const int *sample, CzError *error) {
    for (int k = 0; k < n; k++)
        CZ_TRY(run_samples(sampler, 1, &sample[k], error));
    return CZ_OK;
}

static CzStatus run_samples(const Sampler *sampler, int n, const int *sample, CzError *error) {
    CzCaseBench bench;
    CzError mistake = {0};
    CzStatus status = cz_case_bench_build(&sampler->sampling->parts->cases, n, sample,
                                          sampler->sampling->value, &bench, &mistake);
    if (status == CZ_OK)
        status = run_bench(sampler, &bench, n, sample, error);
    else if (status == CZ_STATUS_INPUT && n == 1)
        status = refuse(sampler->sampling, sample[0], &mistake, error);
    else if (status == CZ_STATUS_INPUT)
        status = run_each(sampler, n, sample, error);
    else if (error != NULL)
        *error = mistake;
    cz_case_bench_free(&bench);
    return status;
}

/* The samples of a task; *n is their number. */
static const int *samples_of(const Sampler *sampler, int index, int *n) {
    const int first = sampler->first + index * sampler->n_per_task, left = sampler->n_due - first;
    *n = left < sampler->n_per_task ? left : sampler->n_per_task;
    return sampler->due + first;
}

static CzStatus run_task(int index, void *data, CzError *error) {
    const Sampler *sampler = data;
    int n;
    const int *sample = samples_of(sampler, index, &n);
    const CzStatus status = run_samples(sampler, n, sample, error);
    return status == CZ_STATUS_INTERRUPTED ? CZ_OK : status;
}

static bool is_stopped(const CzSampleOptions *options) {
    return options->stop != NULL && *options->stop != 0;
}

/* ---- samples in workers ---------------------------------------------------------------------- */

/* What the results of a sample depend on. A worker draws the values again. */
static void describe_sampler(const void *data, CzMemoryText *description) {
    const Sampler *sampler = data;
    const CzSampling *sampling = sampler->sampling;
    cz_problem_put(description, sampling->problem);
    cz_put_int(description, sampler->options->brief);
    cz_put(description, &sampling->seed, 1, sizeof sampling->seed);
    cz_put_int(description, sampling->n_sample);
    cz_put_int(description, sampling->n_draw);
    cz_put_int(description, sampling->n_check);
    for (int i = 0; i < sampling->n_check; i++)
        cz_put_numbers(description, &sampling->check[i].bare, 1);
}

static bool request_task(int index, void *data, CzMemoryText *request) {
    const Sampler *sampler = data;
    int n;
    const int *sample = samples_of(sampler, index, &n);
    cz_put_int(request, n);
    cz_put(request, sample, (size_t)n, sizeof *sample);
    return !is_stopped(sampler->options);
}

/* Margins and verdicts of a sample begin at this place. */
static size_t row_of(const CzSampling *sampling, int sample) {
    return (size_t)sample * (size_t)sampling->n_check;
}

static void put_sample(CzMemoryText *answer, const CzSampling *sampling, int sample) {
    const size_t row = row_of(sampling, sample), n = (size_t)sampling->n_check;
    cz_put(answer, &sampling->sample[sample], 1, sizeof *sampling->sample);
    cz_put_text(answer, sampling->sample[sample].message);
    cz_put_numbers(answer, sampling->margin + row, n);
    cz_put(answer, sampling->verdict + row, n, sizeof *sampling->verdict);
}

static CzStatus get_sample(CzReading *answer, CzSampling *sampling, int sample, CzError *error) {
    const size_t row = row_of(sampling, sample), n = (size_t)sampling->n_check;
    CzSample *kept = &sampling->sample[sample];
    cz_get(answer, kept, 1, sizeof *kept);
    kept->message = cz_get_own_text(answer);
    cz_get_numbers(answer, sampling->margin + row, n);
    cz_get(answer, sampling->verdict + row, n, sizeof *sampling->verdict);
    return answer->has_ended ? cz_no_memory(error, "the results of a sample") : CZ_OK;
}

static CzStatus take_task(int index, void *data, CzReading *answer, CzError *error) {
    const Sampler *sampler = data;
    int n;
    const int *sample = samples_of(sampler, index, &n);
    for (int k = 0; k < n; k++)
        CZ_TRY(get_sample(answer, sampler->sampling, sample[k], error));
    return CZ_OK;
}

/* The study of a worker. */
typedef struct Opened {
    CzProblemSteps problem;
    Sampler sampler;
    CzSampleOptions options;
} Opened;

static CzStatus open_draws(Opened *opened, CzReading *description, CzError *error) {
    CzSampling *sampling = opened->sampler.sampling;
    CzSampleOptions *options = &opened->options;
    CZ_TRY(cz_problem_get(description, &opened->problem, error));
    sampling->problem = cz_problem_of(&opened->problem);
    options->brief = cz_get_int(description) != 0;
    cz_get(description, &options->seed, 1, sizeof options->seed);
    options->n_sample = cz_get_int(description);
    CZ_TRY(cz_sampling_begin_draws(sampling, options, error));
    CZ_TRY(cz_sampling_begin_checks(sampling, error));
    const int n_draw = cz_get_int(description), n_check = cz_get_int(description);
    if (n_draw != sampling->n_draw || n_check != sampling->n_check)
        return cz_fail(error, CZ_STATUS_INPUT, "the samples have other draws or checks here");
    for (int i = 0; i < n_check; i++)
        cz_get_numbers(description, &sampling->check[i].bare, 1);
    return CZ_OK;
}

static CzStatus open_samples(CzReading *description, void **study, CzError *error) {
    Opened *opened = *study = calloc(1, sizeof *opened);
    CzSampling *sampling = opened != NULL ? create() : NULL;
    if (sampling == NULL)
        return cz_no_memory(error, "a study");
    CzEvaluatorOptions options = cz_evaluator_options_default();
    options.n_job = 1;
    opened->options = cz_sample_options_default();
    opened->sampler = (Sampler){.options = &opened->options, .sampling = sampling};
    CZ_TRY(open_draws(opened, description, error));
    CZ_TRY(cz_evaluator_build(sampling->problem, &options, &sampling->parts->evaluator, error));
    sampling->parts->cases.beside = sampling->parts->evaluator;
    return CZ_OK;
}

static CzStatus answer_samples(void *study, CzReading *request, CzMemoryText *answer,
                               CzError *error) {
    const Opened *opened = study;
    CzSampling *sampling = opened->sampler.sampling;
    const int n = cz_get_int(request);
    int sample[MAX_PER_TASK];
    if (n < 1 || n > MAX_PER_TASK)
        return cz_no_memory(error, "a task");
    cz_get(request, sample, (size_t)n, sizeof *sample);
    CZ_TRY(run_samples(&opened->sampler, n, sample, error));
    for (int k = 0; k < n; k++) {
        put_sample(answer, sampling, sample[k]);
        if (sampling->sample[sample[k]].state == CZ_SAMPLE_INVALID)
            return cz_fail(error, CZ_STATUS_INPUT, "the reader refuses a sample");
    }
    return CZ_OK;
}

static void close_samples(void *study) {
    Opened *opened = study;
    if (opened == NULL)
        return;
    cz_sampling_free(opened->sampler.sampling);
    cz_problem_steps_free(&opened->problem);
    free(opened);
}

const CzStudyKind cz_study_of_samples = {open_samples, answer_samples, close_samples};

/* ---- all samples ----------------------------------------------------------------------------- */

/* As many samples as fill the lanes, but not so many that a place has none. */
static int count_per_task(const Sampler *sampler, int n_place) {
    const CzSamplingParts *parts = sampler->sampling->parts;
    const CzCases *cases = &parts->cases;
    const CzModel *model = parts->evaluator->model[cases->scenario[0]];
    const int n_fill = model != NULL ? cz_simulate_batch_width(model) / cases->n_scenario : 0;
    const int n_even = (sampler->n_due + n_place - 1) / n_place;
    const int n = n_fill < MAX_PER_TASK ? n_fill : MAX_PER_TASK;
    const int at_most = n_even > MIN_PER_TASK ? n_even : MIN_PER_TASK;
    return n < MIN_PER_TASK ? MIN_PER_TASK : n < at_most ? n : at_most;
}

static CzStatus run_due(Sampler *sampler, CzError *error) {
    const CzSampleOptions *options = sampler->options;
    const CzExecutor executor = cz_executor_choose(options->executor, options->n_job);
    const int n_wave = executor.n_place * TASKS_PER_PLACE;
    const CzTaskData plain = {&sampler->study, request_task, take_task};
    sampler->n_per_task = count_per_task(sampler, executor.n_place);
    sampler->study = (CzStudy){.executor = executor,
                               .kind = CZ_STUDY_OF_SAMPLES,
                               .describe = describe_sampler,
                               .data = sampler};
    while (sampler->first < sampler->n_due && !is_stopped(options)) {
        const int left =
            (sampler->n_due - sampler->first + sampler->n_per_task - 1) / sampler->n_per_task;
        const int n_task = left < n_wave ? left : n_wave;
        CZ_TRY(cz_tasks_share(&plain, n_task, run_task, sampler, error));
        sampler->first += n_task * sampler->n_per_task;
        if (sampler->first > sampler->n_due)
            sampler->first = sampler->n_due;
        if (options->progress != NULL)
            options->progress(sampler->first, sampler->n_due, options->progress_data);
    }
    sampler->sampling->is_interrupted = is_stopped(options);
    return CZ_OK;
}

/* Runs the samples of the shard, but not those that are known already. */
static CzStatus run_all(Sampler *sampler, CzError *error) {
    CzSampling *sampling = sampler->sampling;
    if (sampler->options->recall != NULL)
        CZ_TRY(sampler->options->recall(sampling, sampler->options->recall_data, error));
    sampler->due = malloc((size_t)sampling->n_sample * sizeof *sampler->due);
    if (sampler->due == NULL)
        return cz_no_memory(error, "the samples");
    for (int k = sampling->begin; k < sampling->end; k++)
        if (sampling->sample[k].state == CZ_SAMPLE_NOT_RUN)
            sampler->due[sampler->n_due++] = k;
    const CzStatus status = run_due(sampler, error);
    cz_study_end(&sampler->study);
    free(sampler->due);
    return status;
}

/* Runs the nominal design, with and without reserves. */
static CzStatus run_nominal(const Sampler *sampler, CzError *error) {
    CzSampling *sampling = sampler->sampling;
    CzEvaluatorOptions options = cz_evaluator_options_default();
    options.n_job = sampler->options->n_job;
    options.executor = sampler->options->executor;
    CZ_TRY(cz_evaluator_build(sampling->problem, &options, &sampling->parts->evaluator, error));
    sampling->parts->cases.beside = sampling->parts->evaluator;
    cz_evaluator_set_stop(sampling->parts->evaluator, sampler->options->stop);
    CZ_TRY(cz_evaluate(sampling->parts->evaluator, 1, NULL, false, &sampling->nominal, error));
    cz_sampling_keep_nominal(sampling);
    CzCaseBench bench;
    const int nominal = CZ_UNCHANGED_CASE;
    CzStatus status =
        cz_case_bench_build(&sampling->parts->cases, 1, &nominal, NULL, &bench, error);
    if (status == CZ_OK)
        status = run_bench(sampler, &bench, 1, &nominal, error);
    cz_case_bench_free(&bench);
    return status;
}

static CzStatus read_problem(const char *file, const CzProblemOptions *problem_options,
                             const CzSampleOptions *options, CzProblem **problem, CzError *error) {
    return options->text != NULL
               ? cz_problem_read_text(options->text, options->n_text, "<standard input>", ".",
                                      problem_options, problem, error)
               : cz_problem_read(file, problem_options, problem, error);
}

static CzStatus sample(Sampler *sampler, CzError *error) {
    CZ_TRY(cz_sampling_begin_draws(sampler->sampling, sampler->options, error));
    CZ_TRY(cz_sampling_begin_checks(sampler->sampling, error));
    const CzStatus status = run_nominal(sampler, error);
    if (status == CZ_STATUS_INTERRUPTED)
        sampler->sampling->is_interrupted = true;
    else if (status != CZ_OK)
        return status;
    else
        CZ_TRY(run_all(sampler, error));
    return cz_sampling_conclude(sampler->sampling, error);
}

/* Passes a sampling on, or frees it where the status is a failure; returns the status. */
static CzStatus pass_on(CzSampling *made, double started, CzStatus status, CzSampling **sampling) {
    made->wall_s = cz_clock() - started;
    *sampling = status == CZ_OK ? made : NULL;
    if (status != CZ_OK)
        cz_sampling_free(made);
    return status;
}

CzStatus cz_sample(const char *file, const CzProblemOptions *problem_options,
                   const CzSampleOptions *options, CzSampling **sampling, CzError *error) {
    const double started = cz_clock();
    const CzProblemOptions none = cz_problem_options_default();
    CzSampling *made = *sampling = create();
    if (made == NULL)
        return cz_no_memory(error, "a sampling");
    Sampler sampler = {.options = options, .sampling = made};
    CzStatus status = read_problem(file, problem_options != NULL ? problem_options : &none, options,
                                   &made->own_problem, error);
    made->problem = made->own_problem;
    if (status == CZ_OK)
        status = sample(&sampler, error);
    return pass_on(made, started, status, sampling);
}

CzStatus cz_sample_problem(const CzProblem *problem, const CzSampleOptions *options,
                           CzSampling **sampling, CzError *error) {
    const double started = cz_clock();
    CzSampling *made = *sampling = create();
    if (made == NULL)
        return cz_no_memory(error, "a sampling");
    Sampler sampler = {.options = options, .sampling = made};
    made->problem = problem;
    return pass_on(made, started, sample(&sampler, error), sampling);
}

void cz_sampling_free(CzSampling *sampling) {
    if (sampling == NULL)
        return;
    for (int k = 0; sampling->sample != NULL && k < sampling->n_sample; k++)
        free(sampling->sample[k].message);
    cz_evaluation_free(&sampling->nominal);
    if (sampling->parts != NULL) {
        cz_evaluator_free(sampling->parts->evaluator);
        cz_arena_free(&sampling->parts->arena);
    }
    cz_problem_free(sampling->own_problem);
    free(sampling->value);
    free(sampling->sample);
    free(sampling->margin);
    free(sampling->verdict);
    free(sampling->convergence);
    free(sampling->parts);
    free(sampling);
}
