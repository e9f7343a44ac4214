/* What a sampling needs before its first run: scenarios, draws with their values, checks. */
#include "evaluate/sampling.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "base/number.h"
#include "base/text.h"
#include "evaluate/draws.h"
#include "problem/keys.h"

/* Whether a scenario is sampled: those that the file names, or all but overload cases. */
static bool is_sampled(const CzTexts *names, const CzScenario *scenario) {
    if (names->n_text == 0)
        return !(scenario->mass_factor >= CZ_OVERLOAD_FACTOR * (1 - 1e-9));
    return cz_text_is_among(scenario->name, names->n_text, names->text) ||
           (scenario->family != NULL &&
            cz_text_is_among(scenario->family, names->n_text, names->text));
}

static CzStatus list_scenarios(CzSampling *sampling, CzError *error) {
    const CzProblem *problem = sampling->problem;
    const CzInput *input = cz_problem_input(problem);
    const CzUncertainty *uncertainty = &input->uncertainty;
    CzSamplingParts *parts = sampling->parts;
    int *scenario = cz_arena_allocate(&parts->arena, (size_t)input->n_scenarios, sizeof *scenario);
    if (scenario == NULL)
        return cz_no_memory(error, "the scenarios of a sample");
    for (int s = 0; s < input->n_scenarios; s++)
        if (is_sampled(&uncertainty->scenarios, &input->scenarios[s]))
            scenario[parts->n_scenario++] = s;
    parts->scenario = scenario;
    if (parts->n_scenario == 0)
        return cz_problem_fail(problem, &uncertainty->scenarios, error, "no scenario is sampled");
    return CZ_OK;
}

/* The samples of a shard: equal runs of samples, some of them one longer where they differ. */
static CzStatus cut_shard(CzSampling *sampling, const CzSampleOptions *options, CzError *error) {
    const long long n = sampling->n_sample, of = options->n_shard;
    if (of < 1 || options->shard < 1 || options->shard > of || of > n)
        return cz_fail(error, CZ_STATUS_INPUT,
                       "there is no shard %d of %d of %lld samples" CZ_HELP
                       "shards count from 1 to their number, which is at most that of the samples",
                       options->shard, options->n_shard, n);
    sampling->begin = (int)((options->shard - 1) * n / of);
    sampling->end = (int)(options->shard * n / of);
    sampling->shard = options->shard;
    sampling->n_shard = options->n_shard;
    return CZ_OK;
}

static const char *words_of_judge(const CzUncertainty *uncertainty, CzArena *arena) {
    char text[120];
    if (uncertainty->judged_by == CZ_STATISTIC_QUANTILE)
        snprintf(text, sizeof text, "margin that %s %% of the samples reach",
                 CZ_SHORT(100 * uncertainty->quantile));
    else if (uncertainty->judged_by == CZ_STATISTIC_MEAN_MINUS)
        snprintf(text, sizeof text, "mean margin less %s standard deviations",
                 CZ_SHORT(uncertainty->deviations));
    else
        snprintf(text, sizeof text, "smallest margin of the samples");
    return cz_arena_copy_text(arena, text, strlen(text));
}

CzStatus cz_sampling_begin_draws(CzSampling *sampling, const CzSampleOptions *options,
                                 CzError *error) {
    CzSamplingParts *parts = sampling->parts;
    const CzProblem *problem = sampling->problem;
    const CzUncertainty *uncertainty = &cz_problem_input(problem)->uncertainty;
    if (!uncertainty->given || uncertainty->n_parameters == 0)
        return cz_fail(error, CZ_STATUS_INPUT,
                       "the problem has no uncertain numbers" CZ_HELP
                       "list them under 'uncertainty: parameters:'");
    sampling->n_sample = options->n_sample > 0 ? options->n_sample : uncertainty->samples;
    sampling->seed = options->seed >= 0 ? options->seed : uncertainty->seed;
    sampling->method = cz_word_sets[CZ_WORDS_SAMPLING].word[uncertainty->sampling].word;
    sampling->judged_by = words_of_judge(uncertainty, &parts->arena);
    if (sampling->judged_by == NULL)
        return cz_no_memory(error, "a sampling");
    CZ_TRY(cut_shard(sampling, options, error));
    CZ_TRY(list_scenarios(sampling, error));
    CZ_TRY(cz_draws_list(problem, parts->scenario[0], &parts->arena, &sampling->n_draw,
                         &sampling->draw, error));
    const size_t n_value = (size_t)sampling->n_sample * (size_t)sampling->n_draw;
    sampling->value = malloc(n_value * sizeof *sampling->value);
    sampling->sample = calloc((size_t)sampling->n_sample, sizeof *sampling->sample);
    if (sampling->value == NULL || sampling->sample == NULL)
        return cz_no_memory(error, "the values of a sample");
    for (int k = 0; k < sampling->n_sample; k++)
        sampling->sample[k] = (CzSample){.state = CZ_SAMPLE_NOT_RUN,
                                         .verdict = CZ_VERDICT_NOT_CHECKED,
                                         .margin = NAN,
                                         .check = -1};
    return cz_draws_fill(problem, sampling->seed, sampling->n_sample, sampling->n_draw,
                         sampling->draw, sampling->value, error);
}

/* Sampled scenario of a check of an evaluator whose cases begin with scene `first`; -1 for none. */
static int case_of_check(const CzEvaluator *evaluator, int check, int first, int n_scenario) {
    const char *name = cz_check_scenario(&evaluator->list.check[check], evaluator->scene);
    for (int j = 0; j < n_scenario; j++)
        if (strcmp(name, evaluator->scene[first + j].name) == 0)
            return j;
    return -1;
}

/* Number of checks before this one that have its name and scenario. */
static int n_before(const CzEvaluator *evaluator, int check) {
    const CzCheck *list = evaluator->list.check;
    const char *scenario = cz_check_scenario(&list[check], evaluator->scene);
    int n = 0;
    for (int i = 0; i < check; i++)
        n += !list[i].is_target && strcmp(list[i].name, list[check].name) == 0 &&
             strcmp(cz_check_scenario(&list[i], evaluator->scene), scenario) == 0;
    return n;
}

/* Adds the checks of the first sample of a bench that are not listed yet. */
static CzStatus add_checks(CzSampling *sampling, const CzEvaluator *evaluator, CzError *error) {
    const CzSamplingParts *parts = sampling->parts;
    CzArena *arena = &sampling->parts->arena;
    const int first = cz_problem_n_scenario(sampling->problem);
    const size_t room = (size_t)(sampling->n_check + evaluator->list.n_check) + 1;
    CzSampledCheck *list = cz_arena_allocate(arena, room, sizeof *list);
    int *of_check = cz_arena_allocate(arena, room, sizeof *of_check);
    if (list == NULL || of_check == NULL)
        return cz_no_memory(error, "the checks of a sample");
    for (int i = 0; i < sampling->n_check; i++) {
        list[i] = sampling->check[i];
        of_check[i] = parts->check_scenario[i];
    }
    sampling->check = list;
    sampling->parts->check_scenario = of_check;
    for (int i = 0; i < evaluator->list.n_check; i++) {
        const CzCheck *check = &evaluator->list.check[i];
        const int j = check->is_target ? -1 : case_of_check(evaluator, i, first, parts->n_scenario);
        if (j < 0 || cz_sampling_find_check(sampling, j, check->name, n_before(evaluator, i)) >= 0)
            continue;
        const int n = sampling->n_check++;
        of_check[n] = j;
        list[n] = (CzSampledCheck){
            .name = cz_arena_copy_text(arena, check->name, strlen(check->name)),
            .scenario = cz_problem_scenario_name(sampling->problem, parts->scenario[j]),
            .is_flag = check->scale == CZ_FLAG_SCALE,
            .nominal = NAN,
            .bare = NAN,
            .strongest = -1,
            .correlation = cz_arena_allocate(arena, (size_t)sampling->n_draw, sizeof(double))};
        if (list[n].name == NULL || list[n].correlation == NULL)
            return cz_no_memory(error, "the checks of a sample");
    }
    return CZ_OK;
}

/* Lists the checks of the nominal design without its reserves, then those of the first sample that
 * the reader accepts: only there are rules of the design, and a changed speed may change the rules
 * of a scenario. */
static CzStatus list_checks(CzSampling *sampling, CzError *error) {
    CzStatus status = CZ_STATUS_INPUT;
    for (int k = CZ_NOMINAL_SAMPLE; k < sampling->n_sample; k++) {
        CzSampleBench bench;
        CzError *first_error = k <= 0 ? error : NULL; /* of many that are refused */
        status = cz_sample_bench_build(sampling, 1, &k, &bench, first_error);
        if (status == CZ_OK)
            status = add_checks(sampling, bench.evaluator, error);
        cz_sample_bench_free(&bench);
        if (k != CZ_NOMINAL_SAMPLE && status != CZ_STATUS_INPUT)
            break;
    }
    return status;
}

CzStatus cz_sampling_begin_checks(CzSampling *sampling, CzError *error) {
    CZ_TRY(list_checks(sampling, error));
    const size_t n = (size_t)sampling->n_sample * (size_t)sampling->n_check;
    sampling->margin = malloc((n + 1) * sizeof *sampling->margin);
    sampling->verdict = malloc((n + 1) * sizeof *sampling->verdict);
    if (sampling->margin == NULL || sampling->verdict == NULL)
        return cz_no_memory(error, "the margins of the samples");
    for (size_t i = 0; i < n; i++) {
        sampling->margin[i] = NAN;
        sampling->verdict[i] = CZ_VERDICT_NOT_CHECKED;
    }
    return CZ_OK;
}
