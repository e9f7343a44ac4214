/* Parts of a sampling, and its steps. */
#ifndef CZ_EVALUATE_SAMPLING_H
#define CZ_EVALUATE_SAMPLING_H

#include "crushzone/sample.h"
#include "evaluate/evaluator_parts.h"

/* Memory that a sampling owns besides its arrays. */
typedef struct CzSamplingParts {
    CzArena arena;          /* of draws and texts */
    CzEvaluator *evaluator; /* of the nominal design, for the texts of its evaluation */
    const int *scenario;    /* scenarios of the problem that are sampled (n_scenario) */
    int n_scenario;
    int *check_scenario; /* of each check, as a place in that list (n_check) */
} CzSamplingParts;

/* Number of the sample without changes. */
enum { CZ_NOMINAL_SAMPLE = -1 };

/* ---- before the first run (sampling_begin.c) ---- */

/* Lists scenarios and draws, and fills the values of all samples, also those of other shards.
 * Statuses: CZ_OK, CZ_STATUS_INPUT, CZ_STATUS_NO_MEMORY. */
CZ_MUST_CHECK CzStatus cz_sampling_begin_draws(CzSampling *sampling, const CzSampleOptions *options,
                                               CzError *error);
/* Lists the checks of a sample. Statuses: CZ_OK, CZ_STATUS_INPUT when the reader refuses the values
 * of every sample, CZ_STATUS_NO_MEMORY. */
CZ_MUST_CHECK CzStatus cz_sampling_begin_checks(CzSampling *sampling, CzError *error);

/* ---- runs (sample_cases.c, sample_names.c) ---- */

/* A problem with the scenarios of some samples, and its evaluator, which runs nothing else. The
 * scenarios of a sample follow one another, behind those of the file. */
typedef struct CzSampleBench {
    CzProblem *problem;
    CzEvaluator *evaluator;
} CzSampleBench;

/* Builds the bench of n samples, or of CZ_NOMINAL_SAMPLE alone, which is the nominal design without
 * its reserves; freed also after a failure. Statuses: CZ_OK, CZ_STATUS_INPUT when the reader
 * refuses the values of a sample, CZ_STATUS_NO_MEMORY. */
CZ_MUST_CHECK CzStatus cz_sample_bench_build(const CzSampling *sampling, int n, const int *sample,
                                             CzSampleBench *bench, CzError *error);
void cz_sample_bench_free(CzSampleBench *bench);

/* Name of a scenario of the problem in a sample, which is counted from 0. */
void cz_sample_case_name(const CzSampling *sampling, int scenario, int sample,
                         char name[CZ_NAME_ROOM]);

/* ---- results (sampling_results.c, sampling_statistics.c) ---- */

/* Keeps the results of the k-th sample of a bench. Status: CZ_STATUS_NO_MEMORY. */
CZ_MUST_CHECK CzStatus cz_sampling_keep(CzSampling *sampling, const CzSampleBench *bench,
                                        const CzEvaluation *evaluation, int sample, int k,
                                        CzError *error);
/* The n-th check of a name, from 0, of a sampled scenario; -1 when there is none. */
int cz_sampling_find_check(const CzSampling *sampling, int scenario, const char *name, int n);
/* Keeps the margins of the nominal design: without reserves, and with them. */
void cz_sampling_keep_bare(CzSampling *sampling, const CzSampleBench *bench,
                           const CzEvaluation *evaluation);
void cz_sampling_keep_nominal(CzSampling *sampling);

/* Computes shares, quantiles, correlations and judgement from the samples that were run. Status:
 * CZ_STATUS_NO_MEMORY. */
CZ_MUST_CHECK CzStatus cz_sampling_conclude(CzSampling *sampling, CzError *error);

#endif
