/* Statistics of a sampling: shares, quantiles, rank correlations, and the judgement that the file
 * requires. */
#include "evaluate/sampling.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "statistics/quantile.h"
#include "statistics/rank.h"
#include "statistics/share.h"

/* Working memory. */
typedef struct Statistics {
    CzSampling *sampling;
    int n;                           /* samples that were run, in order */
    int *run;                        /* their numbers (n) */
    double *sorted, *rank, *of_draw; /* (n) each */
    double *draw_rank;               /* ranks of every draw (n_draw x n) */
} Statistics;

double cz_sample_quantile_share(int index) {
    static const double shares[CZ_N_SAMPLE_QUANTILE] = {0.05, 0.5, 0.95};
    return shares[index];
}

static double margin_at(const CzSampling *sampling, int sample, int check) {
    return sampling->margin[(size_t)sample * (size_t)sampling->n_check + (size_t)check];
}

static CzVerdict verdict_at(const CzSampling *sampling, int sample, int check) {
    return sampling->verdict[(size_t)sample * (size_t)sampling->n_check + (size_t)check];
}

/* ---- shares ---------------------------------------------------------------------------------- */

/* The smallest margin of a sample, below all others when a run failed or its values are refused. */
static double smallest_of(const CzSample *sample) {
    return sample->state == CZ_SAMPLE_DONE ? sample->margin : -INFINITY;
}

/* Share of passing samples among the first n that were run. */
static CzSampledShare share_of(const Statistics *statistics, int n) {
    const CzSampling *sampling = statistics->sampling;
    CzSampledShare share = {.n = n, .share = NAN, .low = NAN, .high = NAN, .margin = NAN};
    int n_margin = 0;
    for (int i = 0; i < n; i++) {
        const CzSample *sample = &sampling->sample[statistics->run[i]];
        share.n_pass += sample->state == CZ_SAMPLE_DONE && cz_verdict_passes(sample->verdict);
        if (!isnan(smallest_of(sample)))
            statistics->sorted[n_margin++] = smallest_of(sample);
    }
    if (n == 0)
        return share;
    share.share = (double)share.n_pass / n;
    cz_share_interval(share.n_pass, n, &share.low, &share.high);
    cz_sort_numbers(n_margin, statistics->sorted);
    share.margin = cz_quantile_of(n_margin, statistics->sorted, cz_sample_quantile_share(0));
    return share;
}

static CzStatus set_convergence(Statistics *statistics, CzError *error) {
    CzSampling *sampling = statistics->sampling;
    enum { MAX_DOUBLINGS = 32 }; /* doublings of an int, and the last */
    sampling->convergence = malloc(MAX_DOUBLINGS * sizeof *sampling->convergence);
    if (sampling->convergence == NULL)
        return cz_no_memory(error, "the statistics of a sample");
    for (long long n = 1; n < statistics->n; n *= 2)
        sampling->convergence[sampling->n_convergence++] = share_of(statistics, (int)n);
    sampling->passing = share_of(statistics, statistics->n);
    if (statistics->n > 0)
        sampling->convergence[sampling->n_convergence++] = sampling->passing;
    return CZ_OK;
}

/* ---- margins --------------------------------------------------------------------------------- */

/* Quantiles of the first n numbers of `sorted`. */
static void set_quantiles(const Statistics *statistics, int n, CzSampledMargin *margin) {
    cz_sort_numbers(n, statistics->sorted);
    margin->least = n > 0 ? statistics->sorted[0] : NAN;
    for (int i = 0; i < CZ_N_SAMPLE_QUANTILE; i++)
        margin->quantile[i] = cz_quantile_of(n, statistics->sorted, cz_sample_quantile_share(i));
}

static void set_smallest(const Statistics *statistics) {
    CzSampling *sampling = statistics->sampling;
    CzSampledMargin *smallest = &sampling->smallest;
    int n = 0;
    smallest->worst = -1;
    for (int i = 0; i < statistics->n; i++) {
        const int k = statistics->run[i];
        const double margin = smallest_of(&sampling->sample[k]);
        if (isnan(margin))
            continue;
        if (smallest->worst < 0 || margin < smallest_of(&sampling->sample[smallest->worst]))
            smallest->worst = k;
        statistics->sorted[n++] = margin;
    }
    set_quantiles(statistics, n, smallest);
}

/* The statistic of a check's margins that the file requires; `sorted` has n of them. */
static double required_of(const Statistics *statistics, int n) {
    const CzUncertainty *uncertainty =
        &cz_problem_input(statistics->sampling->problem)->uncertainty;
    if (n == 0)
        return NAN;
    if (uncertainty->judged_by == CZ_STATISTIC_QUANTILE)
        return cz_quantile_of(n, statistics->sorted, 1 - uncertainty->quantile);
    if (uncertainty->judged_by != CZ_STATISTIC_MEAN_MINUS || isinf(statistics->sorted[0]))
        return statistics->sorted[0];
    const double deviation = n > 1 ? cz_deviation_of(n, statistics->sorted) : 0;
    return cz_mean_of(n, statistics->sorted) - uncertainty->deviations * deviation;
}

/* Quantiles, worst sample and number of failures of a check. */
static void set_check(const Statistics *statistics, int c) {
    CzSampling *sampling = statistics->sampling;
    CzSampledCheck *check = &sampling->check[c];
    int n = 0;
    check->margin.worst = -1;
    for (int i = 0; i < statistics->n; i++) {
        const int k = statistics->run[i], worst = check->margin.worst;
        const double margin = margin_at(sampling, k, c);
        const bool fails = verdict_at(sampling, k, c) == CZ_VERDICT_FAIL;
        check->n_fail += fails;
        if (isnan(margin)) {
            if (fails && worst < 0)
                check->margin.worst = k;
            continue;
        }
        if (worst < 0 || !(margin_at(sampling, worst, c) <= margin))
            check->margin.worst = k;
        statistics->sorted[n++] = margin;
    }
    set_quantiles(statistics, n, &check->margin);
    check->required = required_of(statistics, n);
}

/* ---- correlations ---------------------------------------------------------------------------- */

/* What a check is correlated by: its margin, or whether it passes. NaN where it has none. */
static double score_of(const CzSampling *sampling, int sample, int check) {
    if (!sampling->check[check].is_flag)
        return margin_at(sampling, sample, check);
    switch (verdict_at(sampling, sample, check)) {
    case CZ_VERDICT_FAIL:
        return 0;
    case CZ_VERDICT_NOT_CHECKED:
        return NAN;
    case CZ_VERDICT_PASS:
    case CZ_VERDICT_PROVISIONAL:
        break;
    }
    return 1;
}

/* Ranks of a draw in the samples where the check has a score, whose numbers are `chosen`. */
static bool rank_draw(const Statistics *statistics, int d, int n, const int *chosen, double *rank) {
    const CzSampling *sampling = statistics->sampling;
    for (int i = 0; i < n; i++)
        statistics->of_draw[i] =
            sampling->value[(size_t)chosen[i] * (size_t)sampling->n_draw + (size_t)d];
    return cz_rank(n, statistics->of_draw, rank);
}

/* Correlations of a check; ranks of the draws are those of all samples where all have a score. */
static bool correlate(Statistics *statistics, int c, int *chosen) {
    CzSampling *sampling = statistics->sampling;
    CzSampledCheck *check = &sampling->check[c];
    int n = 0;
    for (int i = 0; i < statistics->n; i++) {
        const double score = score_of(sampling, statistics->run[i], c);
        if (isnan(score))
            continue;
        chosen[n] = statistics->run[i];
        statistics->sorted[n++] = score;
    }
    check->strongest = -1;
    if (!cz_rank(n, statistics->sorted, statistics->rank))
        return false;
    for (int d = 0; d < sampling->n_draw; d++) {
        double *rank = statistics->draw_rank + (size_t)d * (size_t)statistics->n;
        double *own = n < statistics->n ? statistics->of_draw + statistics->n : rank;
        if (n < statistics->n && !rank_draw(statistics, d, n, chosen, own))
            return false;
        check->correlation[d] = cz_rank_correlation(n, own, statistics->rank);
        const double size = fabs(check->correlation[d]);
        if (!isnan(size) &&
            (check->strongest < 0 || size > fabs(check->correlation[check->strongest])))
            check->strongest = d;
    }
    return true;
}

static bool correlate_all(Statistics *statistics) {
    const CzSampling *sampling = statistics->sampling;
    int *chosen = malloc(((size_t)statistics->n + 1) * sizeof *chosen);
    bool fits = chosen != NULL;
    for (int d = 0; d < sampling->n_draw && fits; d++)
        fits = rank_draw(statistics, d, statistics->n, statistics->run,
                         statistics->draw_rank + (size_t)d * (size_t)statistics->n);
    for (int c = 0; c < sampling->n_check && fits; c++)
        fits = correlate(statistics, c, chosen);
    free(chosen);
    return fits;
}

/* ---- judgement ------------------------------------------------------------------------------- */

/* Number of samples that may fail. */
static double n_allowed(const CzSampling *sampling) {
    const CzUncertainty *uncertainty = &cz_problem_input(sampling->problem)->uncertainty;
    const bool by_quantile = uncertainty->judged_by == CZ_STATISTIC_QUANTILE;
    return by_quantile ? (1 - uncertainty->quantile) * sampling->n_run * (1 + 1e-9) : 0;
}

/* Number of samples without valid results: a run failed, the reader refuses their values, or a
 * vehicle climbed. */
static int n_invalid(const CzSampling *sampling) {
    int n = 0;
    for (int k = 0; k < sampling->n_sample; k++) {
        const CzSample *sample = &sampling->sample[k];
        n += sample->state == CZ_SAMPLE_RUN_FAILED || sample->state == CZ_SAMPLE_INVALID ||
             sample->beyond_validity;
    }
    return n;
}

/* Whether the samples satisfy a check as the file requires. A yes or no has no margin: then the
 * number of samples that fail it counts. */
static bool satisfies(const CzSampling *sampling, const CzSampledCheck *check) {
    if (check->is_flag || isnan(check->required))
        return check->n_fail <= n_allowed(sampling);
    return check->required >= 0;
}

static CzVerdict judge(CzSampling *sampling) {
    bool satisfied = sampling->nominal.verdict != CZ_VERDICT_FAIL;
    for (int c = 0; c < sampling->n_check; c++) {
        CzSampledCheck *check = &sampling->check[c];
        check->is_satisfied = satisfies(sampling, check);
        satisfied &= check->is_satisfied;
    }
    if (!satisfied || n_invalid(sampling) > n_allowed(sampling))
        return CZ_VERDICT_FAIL;
    return sampling->n_run < sampling->n_sample ? CZ_VERDICT_NOT_CHECKED
                                                : sampling->nominal.verdict;
}

CzStatus cz_sampling_conclude(CzSampling *sampling, CzError *error) {
    const size_t n_sample = (size_t)sampling->n_sample;
    Statistics statistics = {.sampling = sampling,
                             .run = malloc(n_sample * sizeof(int)),
                             .sorted = malloc(n_sample * sizeof(double)),
                             .rank = malloc(n_sample * sizeof(double)),
                             .of_draw = malloc(2 * n_sample * sizeof(double)),
                             .draw_rank =
                                 malloc((size_t)sampling->n_draw * n_sample * sizeof(double))};
    CzStatus status = CZ_STATUS_NO_MEMORY;
    if (statistics.run != NULL && statistics.sorted != NULL && statistics.rank != NULL &&
        statistics.of_draw != NULL && statistics.draw_rank != NULL) {
        for (int k = 0; k < sampling->n_sample; k++) {
            const CzSampleState state = sampling->sample[k].state;
            if (state == CZ_SAMPLE_NOT_RUN)
                continue;
            statistics.run[statistics.n++] = k;
            sampling->n_failed += state != CZ_SAMPLE_DONE;
        }
        sampling->n_run = statistics.n;
        status = set_convergence(&statistics, error);
        set_smallest(&statistics);
        for (int c = 0; c < sampling->n_check; c++)
            set_check(&statistics, c);
        if (status == CZ_OK && !correlate_all(&statistics))
            status = CZ_STATUS_NO_MEMORY;
        sampling->judgement = judge(sampling);
    }
    free(statistics.run);
    free(statistics.sorted);
    free(statistics.rank);
    free(statistics.of_draw);
    free(statistics.draw_rank);
    return status == CZ_STATUS_NO_MEMORY ? cz_no_memory(error, "the statistics of a sample")
                                         : status;
}
