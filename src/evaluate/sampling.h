/* Parts of a sampling, and its steps. */
#ifndef CZ_EVALUATE_SAMPLING_H
#define CZ_EVALUATE_SAMPLING_H

#include "crushzone/sample.h"
#include "evaluate/cases.h"

/* Memory that a sampling owns besides its arrays. */
typedef struct CzSamplingParts {
    CzArena arena;          /* of draws and texts */
    CzEvaluator *evaluator; /* of the nominal design, for the texts of its evaluation */
    CzCases cases;
    CzCaseChecks checks; /* the checks of the sampling */
} CzSamplingParts;

/* ---- before the first run (sampling_begin.c) ---- */

/* Lists scenarios and draws, and fills the values of all samples, also those of other shards.
 * Statuses: CZ_OK, CZ_STATUS_INPUT, CZ_STATUS_NO_MEMORY. */
CZ_MUST_CHECK CzStatus cz_sampling_begin_draws(CzSampling *sampling, const CzSampleOptions *options,
                                               CzError *error);
/* Lists the checks of a sample. Statuses: CZ_OK, CZ_STATUS_INPUT when the reader refuses the values
 * of every sample, CZ_STATUS_NO_MEMORY. */
CZ_MUST_CHECK CzStatus cz_sampling_begin_checks(CzSampling *sampling, CzError *error);

/* ---- results (sampling_results.c, sampling_statistics.c) ---- */

/* Keeps the results of the k-th sample of a bench. Status: CZ_STATUS_NO_MEMORY. */
CZ_MUST_CHECK CzStatus cz_sampling_keep(CzSampling *sampling, const CzCaseBench *bench,
                                        const CzEvaluation *evaluation, int sample, int k,
                                        CzError *error);
/* Keeps the margins of the nominal design: without reserves, and with them. */
void cz_sampling_keep_bare(CzSampling *sampling, const CzCaseBench *bench,
                           const CzEvaluation *evaluation);
void cz_sampling_keep_nominal(CzSampling *sampling);

/* Computes shares, quantiles, correlations and judgement from the samples that were run. Status:
 * CZ_STATUS_NO_MEMORY. */
CZ_MUST_CHECK CzStatus cz_sampling_conclude(CzSampling *sampling, CzError *error);

#endif
