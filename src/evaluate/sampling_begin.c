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
#include "evaluate/tasks.h"
#include "problem/keys.h"

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
    sampling->shard = options->shard;
    sampling->n_shard = options->n_shard;
    CZ_TRY(cz_tasks_cut(sampling->n_sample, "samples", options->shard, options->n_shard,
                        &sampling->begin, &sampling->end, error));
    CzCases *cases = &parts->cases;
    *cases = (CzCases){
        .problem = problem, .word = "sample", .n_earlier = cz_cases_n_earlier(problem, "sample")};
    CZ_TRY(cz_cases_scenarios(problem, &uncertainty->scenarios, &parts->arena, &cases->n_scenario,
                              &cases->scenario, error));
    CZ_TRY(cz_draws_list(problem, cases->scenario[0], &parts->arena, &sampling->n_draw,
                         &sampling->draw, error));
    cases->n_draw = sampling->n_draw;
    cases->draw = sampling->draw;
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

/* Lists the checks of the nominal design without its reserves, then those of the first sample that
 * the reader accepts: only there are rules of the design, and a changed speed may change the rules
 * of a scenario. */
static CzStatus list_checks(CzSampling *sampling, CzError *error) {
    CzSamplingParts *parts = sampling->parts;
    CzStatus status = CZ_STATUS_INPUT;
    for (int k = CZ_UNCHANGED_CASE; k < sampling->n_sample; k++) {
        CzCaseBench bench;
        CzError *first_error = k <= 0 ? error : NULL; /* of many that are refused */
        status = cz_case_bench_build(&parts->cases, 1, &k, sampling->value, &bench, first_error);
        if (status == CZ_OK)
            status =
                cz_case_checks_add(&parts->cases, &bench, &parts->arena, &parts->checks, error);
        cz_case_bench_free(&bench);
        if (k != CZ_UNCHANGED_CASE && status != CZ_STATUS_INPUT)
            break;
    }
    return status;
}

/* The listed checks without results. */
static CzStatus begin_results(CzSampling *sampling, CzError *error) {
    CzSamplingParts *parts = sampling->parts;
    CzArena *arena = &parts->arena;
    sampling->n_check = parts->checks.n;
    sampling->check =
        cz_arena_allocate(arena, (size_t)sampling->n_check + 1, sizeof *sampling->check);
    if (sampling->check == NULL)
        return cz_no_memory(error, "the checks of a sample");
    for (int i = 0; i < sampling->n_check; i++) {
        const CzCaseCheck *check = &parts->checks.check[i];
        const int scenario = parts->cases.scenario[check->scenario];
        sampling->check[i] =
            (CzSampledCheck){.name = check->name,
                             .scenario = cz_problem_scenario_name(sampling->problem, scenario),
                             .is_flag = check->is_flag,
                             .nominal = NAN,
                             .bare = NAN,
                             .strongest = -1,
                             .correlation = cz_arena_numbers(arena, (size_t)sampling->n_draw)};
        if (sampling->check[i].correlation == NULL)
            return cz_no_memory(error, "the checks of a sample");
    }
    return CZ_OK;
}

CzStatus cz_sampling_begin_checks(CzSampling *sampling, CzError *error) {
    CZ_TRY(list_checks(sampling, error));
    CZ_TRY(begin_results(sampling, error));
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
