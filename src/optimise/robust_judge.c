/* Judges one design against scatter. */
#include "optimise/robust_judge.h"

#include <math.h>

#include "base/error.h"
#include "evaluate/sampling.h"
#include "optimise/robust_cases.h"

static bool is_stopped(const CzRobustJudge *judge) {
    return judge->stop != NULL && *judge->stop != 0;
}

void cz_robust_judged_free(CzRobustJudged *judged) {
    cz_challenge_free(judged->challenge);
    cz_sampling_free(judged->sampling);
    cz_problem_free(judged->designed);
    *judged = (CzRobustJudged){0};
}

/* Samples and adversary run where the search runs. */
static void take_executor(const CzRobustJudge *judge, int *n_job, const CzExecutor **executor) {
    const CzEvaluatorOptions *options = judge->evaluator_options;
    *n_job = options != NULL ? options->n_job : 0;
    *executor = options != NULL ? options->executor : NULL;
}

CzStatus cz_robust_sample(const CzRobustJudge *judge, const CzProblem *designed, bool brief,
                          CzSampling **sampling, CzError *error) {
    CzSampleOptions options = cz_sample_options_default();
    options.brief = brief;
    take_executor(judge, &options.n_job, &options.executor);
    options.stop = judge->stop;
    judge->show("samples", judge->data);
    return cz_sample_problem(designed, &options, sampling, error);
}

/* Asks the adversary. */
static CzStatus challenge(const CzRobustJudge *judge, const CzProblem *designed,
                          CzChallenge **challenge, CzError *error) {
    CzChallengeOptions options = cz_challenge_options_default();
    take_executor(judge, &options.n_job, &options.executor);
    options.stop = judge->stop;
    options.most_weak = CZ_ROBUST_MAX_NEW;
    judge->show("adversary", judge->data);
    return cz_challenge(designed, NULL, &options, challenge, error);
}

static bool passes_in_samples(const CzRobustJudged *judged) {
    return cz_robust_violation_in(judged->sampling) <= 0 &&
           judged->sampling->nominal.violation <= 0;
}

bool cz_robust_passes(const CzRobustJudged *judged) {
    return passes_in_samples(judged) &&
           (judged->challenge == NULL || !judged->challenge->is_broken);
}

CzStatus cz_robust_judge(const CzRobustJudge *judge, const double *x, CzRobustJudged *judged,
                         CzError *error) {
    const CzInput *input = cz_problem_input(cz_evaluator_problem(judge->plain));
    CZ_TRY(cz_evaluator_read_design(judge->plain, x, &judged->designed, error));
    CZ_TRY(cz_robust_sample(judge, judged->designed, true, &judged->sampling, error));
    if (cz_robust_violation_in(judged->sampling) > 0 || is_stopped(judge))
        return CZ_OK;
    cz_sampling_free(judged->sampling);
    judged->sampling = NULL;
    CZ_TRY(cz_robust_sample(judge, judged->designed, false, &judged->sampling, error));
    if (!passes_in_samples(judged) || input->uncertainty.n_envelope == 0 || is_stopped(judge))
        return CZ_OK;
    return challenge(judge, judged->designed, &judged->challenge, error);
}

/* Smallest margin of the scenarios of the file. */
static double nominal_margin(const CzSampling *sampling) {
    double smallest = INFINITY;
    for (int i = 0; i < sampling->nominal.n_check; i++)
        smallest = fmin(smallest, sampling->nominal.check[i].margin); /* ignores NaN */
    return smallest;
}

void cz_robust_fill_round(CzRobustRound *round, const CzRobustJudged *judged) {
    const CzSampling *sampling = judged->sampling;
    round->nominal_margin = nominal_margin(sampling);
    round->required_margin = INFINITY;
    for (int c = 0; c < sampling->n_check; c++)
        round->required_margin = fmin(round->required_margin, sampling->check[c].required);
    round->n_sample = sampling->n_run;
    round->n_pass = sampling->passing.n_pass;
    if (judged->challenge != NULL)
        round->n_weak = judged->challenge->is_broken ? judged->challenge->n_weak : 0;
}
