/* Results of samples: checks of their scenarios to margins, verdicts and reasons of failures. */
#include "evaluate/sampling.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "evaluate/compose.h"

/* One sample while its results are kept. */
typedef struct Keeper {
    CzSampling *sampling;
    const CzEvaluation *evaluation; /* of the bench */
    int sample;
    CzEvaluation own; /* its checks alone */
    int deciding;     /* the worst of them; -1 while there is none */
} Keeper;

/* Adds a result to the sample, which belongs to a check of the sampling. A check that has a margin
 * at the nominal design, but none in a run that failed or left the validity of the model, is below
 * all others there. */
static void keep_result(Keeper *keeper, const CzCheckResult *result, int check, bool has_failed) {
    CzSampling *sampling = keeper->sampling;
    CzSample *kept = &sampling->sample[keeper->sample];
    const size_t at = (size_t)keeper->sample * (size_t)sampling->n_check + (size_t)check;
    const bool is_lost = (has_failed || result->beyond_validity) && isnan(result->margin) &&
                         !isnan(sampling->check[check].bare);
    const double margin = is_lost ? -INFINITY : result->margin;
    const bool fails = has_failed && result->verdict == CZ_VERDICT_NOT_CHECKED;
    sampling->margin[at] = margin;
    sampling->verdict[at] = fails ? CZ_VERDICT_FAIL : result->verdict;
    if (!isnan(margin) && (isnan(kept->margin) || margin < kept->margin))
        kept->margin = margin;
    if (result->verdict != CZ_VERDICT_NOT_CHECKED &&
        (keeper->deciding < 0 || cz_check_is_worse(result, &keeper->own.check[keeper->deciding]))) {
        keeper->deciding = keeper->own.n_check;
        kept->check = check;
    }
    keeper->own.check[keeper->own.n_check++] = *result;
}

/* Notes a run that failed or is incomplete; false without memory. */
static bool keep_failure(CzSample *kept, const CzRunSummary *run, const char *scenario) {
    kept->state = CZ_SAMPLE_RUN_FAILED;
    if (kept->message == NULL)
        kept->message = cz_case_failure(run, scenario);
    return kept->message != NULL;
}

/* Keeps a scenario of the sample, which is scenario s of the bench; the runs begin behind the
 * scenarios of the file. */
static bool keep_scenario(Keeper *keeper, const CzCaseBench *bench, int scenario, int s) {
    const CzSampling *sampling = keeper->sampling;
    const CzEvaluation *evaluation = keeper->evaluation;
    const CzRunSummary *run =
        cz_run_summary(evaluation->run[s - cz_problem_n_scenario(sampling->problem)]);
    const char *name = bench->evaluator->scene[s].name;
    const bool has_failed = cz_failure_of(run) != NULL;
    CzSample *kept = &keeper->sampling->sample[keeper->sample];
    kept->beyond_validity |= run->beyond_validity;
    for (int i = 0; i < evaluation->n_check; i++) {
        const int check = cz_case_check_of(&sampling->parts->checks, evaluation, i, scenario, name);
        if (check >= 0)
            keep_result(keeper, &evaluation->check[i], check, has_failed);
    }
    return !has_failed ||
           keep_failure(kept, run,
                        cz_problem_scenario_name(sampling->problem,
                                                 sampling->parts->cases.scenario[scenario]));
}

/* Keeps the k-th sample of a bench. */
CzStatus cz_sampling_keep(CzSampling *sampling, const CzCaseBench *bench,
                          const CzEvaluation *evaluation, int sample, int k, CzError *error) {
    const int n_scenario = sampling->parts->cases.n_scenario;
    const int first = cz_problem_n_scenario(sampling->problem) + k * n_scenario;
    Keeper keeper = {.sampling = sampling,
                     .evaluation = evaluation,
                     .sample = sample,
                     .own.check =
                         malloc(((size_t)evaluation->n_check + 1) * sizeof *evaluation->check),
                     .deciding = -1};
    CzSample *kept = &sampling->sample[sample];
    bool fits = keeper.own.check != NULL;
    kept->state = CZ_SAMPLE_DONE;
    for (int j = 0; fits && j < n_scenario; j++)
        fits = keep_scenario(&keeper, bench, j, first + j);
    keeper.own.beyond_validity = kept->beyond_validity;
    kept->verdict =
        kept->state == CZ_SAMPLE_DONE ? cz_verdict_over(&keeper.own, 0, NULL) : CZ_VERDICT_FAIL;
    free(keeper.own.check);
    return fits ? CZ_OK : cz_no_memory(error, "the results of a sample");
}

void cz_sampling_keep_bare(CzSampling *sampling, const CzCaseBench *bench,
                           const CzEvaluation *evaluation) {
    const int first = cz_problem_n_scenario(sampling->problem);
    for (int j = 0; j < sampling->parts->cases.n_scenario; j++)
        for (int i = 0; i < evaluation->n_check; i++) {
            const int check = cz_case_check_of(&sampling->parts->checks, evaluation, i, j,
                                               bench->evaluator->scene[first + j].name);
            if (check >= 0)
                sampling->check[check].bare = evaluation->check[i].margin;
        }
}

void cz_sampling_keep_nominal(CzSampling *sampling) {
    const CzEvaluation *evaluation = &sampling->nominal;
    static const char design[] = "design"; /* its rules are those of each sample */
    for (int j = 0; j < sampling->parts->cases.n_scenario; j++) {
        const char *name =
            cz_problem_scenario_name(sampling->problem, sampling->parts->cases.scenario[j]);
        for (int i = 0; i < evaluation->n_check; i++) {
            const bool is_of_design = strcmp(evaluation->check[i].scenario, design) == 0;
            const int check = cz_case_check_of(&sampling->parts->checks, evaluation, i, j,
                                               is_of_design ? design : name);
            if (check >= 0)
                sampling->check[check].nominal = evaluation->check[i].margin;
        }
    }
}
